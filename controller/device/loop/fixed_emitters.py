"""The pulse of a scene's fixed emitters: emissions that repeat at a place without any finger."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

from controller.clocks import FPGA_NEVER, FpgaTime
from controller.device.loop.playing.batching import select_batch
from controller.device.scene.emission import Emission, emitter_emission
from controller.device.scene.scene import FixedEmitter, Scene

ROUNDING_S: Final = 1e-9  # a pulse reached exactly is reached


class FixedEmitters:
    """Fixed emitters, and the next pulse of each.

    Their pulse begins at `start_s`; the FPGA may repeat them unless `repeats` is false. `wave_scale` is that of the plate
    (`Bank.wave_scale`).
    """

    def __init__(
        self, emitters: Sequence[FixedEmitter], start_s: FpgaTime, wave_scale: float = 1.0, *, repeats: bool = True
    ) -> None:
        # Period in which the FPGA can repeat all of them as one waveform; None if it cannot
        self.common_period_s = common_period_s(emitters, wave_scale) if repeats else None
        self._start_s = start_s
        self._pulses = dict.fromkeys(emitters, 0)

    def due(self, now_s: FpgaTime, until_s: FpgaTime) -> list[Emission]:
        """Emissions whose pulse comes up to a time, of each fixed emitter one; pulses that `now_s` has passed are left out."""
        if not self._pulses:
            return []
        emissions = []
        for emitter, pulse in self._pulses.items():
            emission = emitter_emission(emitter, self._start_s, pulse)
            if emission.time_s <= until_s + ROUNDING_S:
                emissions.append(emission)
                missed = max(math.floor((now_s - emission.time_s) * emitter.rate_hz), 0)
                self._pulses[emitter] = pulse + missed + 1
        return emissions

    def restart(self, start_s: FpgaTime) -> None:
        """The pulse starts again."""
        self._start_s = start_s
        self._pulses = dict.fromkeys(self._pulses, 0)

    def before_start(self) -> list[Emission]:
        """What a batch takes along that is played one period before the pulse begins."""
        return [emitter_emission(emitter, self._start_s, -1)._replace(period_s=0.0) for emitter in self._pulses]

    def next_s(self) -> FpgaTime:
        """When the next pulse comes; inf without fixed emitters."""
        return min(
            [emitter_emission(emitter, self._start_s, pulse).time_s for emitter, pulse in self._pulses.items()], default=FPGA_NEVER
        )


def common_period_s(emitters: Sequence[FixedEmitter], wave_scale: float = 1.0) -> float | None:
    """Period in s in which the FPGA can repeat all fixed emitters as one waveform; None if they need turns, or there are none."""
    if not emitters or len({(emitter.rate_hz, emitter.phase) for emitter in emitters}) > 1:
        return None
    _, rest = select_batch([emitter_emission(emitter, FpgaTime(0.0), 0) for emitter in emitters], 0.0, wave_scale=wave_scale)
    return None if rest else 1 / emitters[0].rate_hz


def needs_responses(scene: Scene, wave_scale: float = 1.0) -> bool:
    """Whether a scene can ask for more than entries of cells and what its fixed emitters play together: composing, on the device.

    Otherwise each emission for a finger is alone, at full amplitude and without nulls, and all fixed emitters have one
    period. What a command may ask for is another matter.
    """
    for region in scene.regions:
        trains = (*region.press, *region.release, *region.enter, *region.leave)
        if region.felt and (region.nulled or not region.alternate):
            return True
        if any(train.amplitude != 1 or train.envelope for train in trains) or any(step.amplitude != 1 for step in region.spacings):
            return True
    return bool(scene.emitters) and common_period_s(scene.emitters, wave_scale) is None
