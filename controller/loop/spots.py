"""The beat of a scene's spots: emissions that repeat at a place without any finger."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

from controller.clocks import FPGA_NEVER, FpgaTime
from controller.loop.batching import select_batch
from controller.scene.emission import Emission, spot_emission
from controller.scene.scene import Scene, Spot

ROUNDING_S: Final = 1e-9  # a beat reached exactly is reached


class Spots:
    """Spots, and the next beat of each.

    Parameters
    ----------
    spots : sequence of Spot
    start_s : FpgaTime
        When their beat begins.
    repeats : bool
        Whether the FPGA may repeat them.
    wave_scale : float
        Of the plate (`Bank.wave_scale`).

    Attributes
    ----------
    common_period_s : float or None
        Period in which the FPGA can repeat all of them as one waveform; None if it cannot.
    """

    def __init__(self, spots: Sequence[Spot], start_s: FpgaTime, repeats: bool = True, wave_scale: float = 1.0) -> None:
        self.common_period_s = common_period_s(spots, wave_scale) if repeats else None
        self._start_s = start_s
        self._beats = dict.fromkeys(spots, 0)

    def due(self, now_s: FpgaTime, until_s: FpgaTime) -> list[Emission]:
        """Emissions whose beat comes up to a time, of each spot one; beats that `now_s` has passed are left out."""
        if not self._beats:
            return []
        emissions = []
        for spot, beat in self._beats.items():
            emission = spot_emission(spot, self._start_s, beat)
            if emission.time_s <= until_s + ROUNDING_S:
                emissions.append(emission)
                missed = max(math.floor((now_s - emission.time_s) * spot.rate_hz), 0)
                self._beats[spot] = beat + missed + 1
        return emissions

    def restart(self, start_s: FpgaTime) -> None:
        """The beat begins anew."""
        self._start_s = start_s
        self._beats = dict.fromkeys(self._beats, 0)

    def before_start(self) -> list[Emission]:
        """What a batch takes along that is played one period before the beat begins."""
        return [spot_emission(spot, self._start_s, -1)._replace(period_s=0.0) for spot in self._beats]

    def next_s(self) -> FpgaTime:
        """When the next beat comes; inf without spots."""
        return min([spot_emission(spot, self._start_s, beat).time_s for spot, beat in self._beats.items()], default=FPGA_NEVER)


def common_period_s(spots: Sequence[Spot], wave_scale: float = 1.0) -> float | None:
    """Period in s in which the FPGA can repeat all spots as one waveform; None if they need turns, or there are none."""
    if not spots or len({(spot.rate_hz, spot.phase) for spot in spots}) > 1:
        return None
    _, rest = select_batch([spot_emission(spot, FpgaTime(0.0), 0) for spot in spots], 0.0, wave_scale=wave_scale)
    return None if rest else 1 / spots[0].rate_hz


def needs_responses(scene: Scene, wave_scale: float = 1.0) -> bool:
    """Whether a scene can ask for more than entries of cells and what its spots play together: composing, on the device.

    Otherwise each emission for a finger is alone, at full amplitude and without quiet places, and all spots have one period. What a
    command may ask for is another matter.
    """
    for region in scene.regions:
        trains = (*region.press, *region.release, *region.enter, *region.leave)
        if region.felt and (region.quiet or not region.alternate):
            return True
        if any(train.amplitude != 1 or train.envelope for train in trains) or any(step.amplitude != 1 for step in region.spacings):
            return True
    return bool(scene.spots) and common_period_s(scene.spots, wave_scale) is None
