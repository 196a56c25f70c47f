"""Motion of points of a plate at evenly spaced times, long after many steps: what a sensor hears of a whole session.

The same as `motion`, exactly: a pole passes from one time to the next by one factor, so that all times of a mode are one recursive
filter. The modes do not depend on the point; they are kept for the next one, if they fit.
"""

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Complex, Floats, blocks
from controller.workshop.physics.motion import DERIVATIVE, PlateMotion

MODES_AT_ONCE: Final = 16
KEPT_BYTES: Final = 256 << 20


class EvenMotion:
    """A plate at rest at 0 V, moved by steps at `step_s` (step,), rising, by `steps_v` (step, channel).

    Times are `apart_s` from one another, `count` of them from 0 on; `quantity` is "m", "m/s" or "m/s^2".
    """

    def __init__(self, plate: PlateMotion, step_s: Floats, steps_v: Floats, apart_s: float, count: int, quantity: str) -> None:
        self._plate, self._steps_v, self._apart_s, self._count = plate, steps_v, apart_s, count
        self._derivative = DERIVATIVE[quantity]
        self._sample = np.maximum(np.ceil(step_s / apart_s - 1e-9), 0).astype(np.int64)  # at which a step is first heard
        self._since_s = self._sample * apart_s - step_s
        self._kept: list[NDArray[np.float32]] = []

    def of_point(self, place_m: Floats) -> Floats:
        """Motion of a point (2,) at all times: (sample,)."""
        shapes = self._plate.modes.shapes(place_m[None], np.float32)[0]
        moved = np.zeros(self._count, np.float32)
        for some, amplitudes in zip(blocks(len(shapes), MODES_AT_ONCE), self._modes(), strict=True):
            moved += shapes[some] @ amplitudes
        return moved.astype(np.float64)

    def _modes(self) -> Iterator[NDArray[np.float32]]:
        """Amplitudes of some modes after others: (mode, sample)."""
        if self._kept:
            yield from self._kept
            return
        modes = self._plate.modes.count
        keeps = 4 * modes * self._count <= KEPT_BYTES
        drivers = [self._decaying(pole, self._steps_v.T) for pole in self._plate.step.driver_poles]  # of each (channel, sample)
        kept = []
        for some in blocks(modes, MODES_AT_ONCE):
            block = self._some(some, drivers)
            if keeps:
                kept.append(block)
            yield block
        self._kept = kept

    def _some(self, some: slice, drivers: list[Complex]) -> NDArray[np.float32]:
        step, forces = self._plate.step.part(some), self._plate.forces[some]
        forced = forces @ self._steps_v.T  # (mode, step)
        of_poles = np.stack([
            (residue * pole**self._derivative * self._decaying(pole, forced[mode][None])[0]).real
            for pole, residue, mode in zip(step.poles, step.residues, step.mode_of_pole, strict=True)
        ])  # fmt: skip
        moved = step.by_mode(of_poles)
        for residue, pole, state in zip(step.driver_residues.T, step.driver_poles, drivers, strict=True):
            moved += ((residue * pole**self._derivative)[:, None] * (forces @ state)).real
        if not self._derivative:
            moved += step.static[:, None] * self._summed(forced.astype(np.complex128)).cumsum(axis=1).real
        return moved.astype(np.float32)

    def _decaying(self, pole: complex, steps: Floats) -> Complex:
        """Sum of exponentials from each of `steps`, (row, step), on: (row, sample)."""
        from scipy.signal import lfilter  # noqa: PLC0415 - takes 0.3 s

        heard = self._summed(steps * np.exp(pole * self._since_s))
        return lfilter([1.0], [1.0, -np.exp(pole * self._apart_s)], heard)

    def _summed(self, values: Complex) -> Complex:
        """Values of all steps, (row, step), at the samples at which they are first heard: (row, sample)."""
        there = self._sample < self._count
        found = np.zeros((len(values), self._count), np.complex128)
        np.add.at(found.T, self._sample[there], values[:, there].T)
        return found
