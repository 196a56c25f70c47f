"""Modes with other frequencies or other decay, and the same shapes: another theory, another damping, another temperature."""

import dataclasses
from typing import Any

from controller.arrays import Floats
from controller.workshop.physics.modes.modes import Modes


def retuned(modes: Modes, angular_frequency: Floats | None = None, decay_rate: Floats | None = None) -> Modes:
    """`modes` with other frequencies or rates, (mode,); None: as they are."""
    record: Any = modes  # whatever they are made of, no shape depends on these two
    frequency = modes.angular_frequency if angular_frequency is None else angular_frequency
    changed: Modes = dataclasses.replace(
        record, angular_frequency=frequency, decay_rate=modes.decay_rate if decay_rate is None else decay_rate
    )
    return changed


def drifted(modes: Modes, drift: float) -> Modes:
    """`modes` with all frequencies higher by the share `drift`: what another temperature does to glass."""
    return retuned(modes, modes.angular_frequency * (1 + drift))
