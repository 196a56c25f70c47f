"""What a panel of given numbers reaches, by the statistics of its modes: amplitude, what a finger feels of it, and heat."""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any, Final

import msgspec

from controller.device.board.board import Board
from controller.device.board.panel import Driver
from controller.device.board.plate.parts import Parts
from controller.device.board.relations.stage_heat import worst_edge_j
from controller.errors import ConfigError
from controller.workshop.physics.design.design_inputs import DesignInputs, inputs_of, plate_of
from controller.workshop.physics.design.sound_estimate import exposure_pa2_s, surface_density
from controller.workshop.physics.felt import LIGHT_TOUCH
from controller.workshop.physics.focal_spectrum import FocalSpectrum
from controller.workshop.physics.sound import decibels
from controller.workshop.physics.stress import ceramic_stress_pa, field_v_m, plate_stress_pa

STEP: Final = 1.1  # of a number, to see what it adds
STEPPED: Final = ("supply_v", "channels", "size_mm", "thickness_mm", "decay_time_ms", "duration_ms", "band_low_hz", "band_high_hz")


class PanelEstimate:
    """A panel's plate, stage and spectrum, and what follows."""

    def __init__(self, board: Board, given: DesignInputs, parts: Parts | None = None) -> None:
        numbers = msgspec.structs.asdict(given)
        self.given, self.parts = given, parts or board.parts
        self.plate = plate_of(board.plate, numbers)
        self.driver = msgspec.structs.replace(board.driver, **{name: numbers[name] for name in Driver.__struct_fields__})
        band_hz = given.band_low_hz, given.band_high_hz
        self.spectrum = FocalSpectrum.of(self.plate, self.driver, given.size_mm * 1e-3, band_hz, given.bit_clock_hz)
        self._permitted_w = board.limits.resistor_rating_w * board.limits.derating

    @cached_property
    def possible_m(self) -> float:
        """Amplitude of a focus on the bare plate that the patches reach."""
        given = self.given
        return self.spectrum.amplitude_m(given.supply_v / 2, given.channels, given.duration_ms * 1e-3, given.decay_time_ms * 1e-3)

    @property
    def amplitude_m(self) -> float:
        """Amplitude of a focus on the bare plate: the one asked for, or what the patches reach."""
        return self.possible_m if self.given.amplitude_um is None else self.given.amplitude_um * 1e-6

    @cached_property
    def left(self) -> float:
        """Share of it that a point mass leaves on an infinite plate."""
        return self.spectrum.mass_attenuation(self.given.finger_mg * 1e-6)

    @cached_property
    def felt_um(self) -> float:
        """What the finger feels, as `felt.py` has it, of a light touch's damping and stiffness."""
        load = replace(LIGHT_TOUCH, mass_kg=self.given.finger_mg * 1e-6)
        return self.spectrum.felt_amplitude_m(self.amplitude_m, load) * 1e6

    @cached_property
    def stress(self) -> dict[str, float]:
        """Stress at the focus on the bare plate, as `focal_stress` finds it."""
        curvature = self.amplitude_m * self.spectrum.curvature_per_m2
        found = {"plate_mpa": float(plate_stress_pa(self.plate, curvature, curvature, 0.0)) * 1e-6}
        if self.parts is not None:
            found["ceramic_mpa"] = ceramic_stress_pa(self.parts, self.plate, curvature, self.given.supply_v) * 1e-6
            found["field_mv_m"] = field_v_m(self.parts, self.given.supply_v) * 1e-6
        return found

    @cached_property
    def sound(self) -> dict[str, float]:
        """A-weighted levels at 0.3 m: exposure by an emission, and the level of one every Tr."""
        exposure_db = decibels(exposure_pa2_s(self.plate, *surface_density(self.spectrum, self.driver, self.given)))
        return {"exposure_db": exposure_db, "repeated_db": exposure_db - 10 * math.log10(self.given.period_ms * 1e-3)}

    @cached_property
    def resistor_w(self) -> float:
        """Heat in the resistor of a channel that emits without a pause."""
        return self.spectrum.resistor_w(self.driver, self.given.bit_clock_hz)

    @property
    def edge_limit_hz(self) -> float:
        """Edges a second that a resistor as the board's bears with any waveform."""
        return self._permitted_w / worst_edge_j(self.driver)


def gains_percent(board: Board, changes: Mapping[str, float], parts: Parts | None, now: PanelEstimate) -> dict[str, float]:
    """Growth of the felt amplitude if one number is 10 % larger, and with it what follows from it; the largest first."""
    found: dict[str, float] = {}
    for name in STEPPED:
        try:
            one: Any = getattr(now.given, name) * STEP
            given = inputs_of(board, {**changes, name: round(one) if name == "channels" else one}, parts)
        except ConfigError:
            continue
        found[name] = 100 * (PanelEstimate(board, given).felt_um / now.felt_um - 1)
    return dict(sorted(found.items(), key=lambda one: -one[1]))
