"""Motion of points of a plate at any times, by steps of voltage on its channels: what a sensor on the plate records.

Between two steps every pole decays freely, so that the motion at any time is exact, whatever the recorder's clock. The amplitudes
of the modes do not depend on the point: they are computed once for as many points as are asked for.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Complex, Floats
from controller.device.board.board import Board
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.step_response import StepResponse, channel_forces

AT_ONCE = 64  # times, or steps, whose modes are in memory together
SETTLED_V = 1e-6  # of a driver's transient
DERIVATIVE = {"m": 0, "m/s": 1, "m/s^2": 2}


class PlateMotion:
    """A plate at rest at 0 V, moved by its channels."""

    def __init__(self, board: Board, modes: Modes) -> None:
        self.modes = modes
        self.step = StepResponse.of(modes, DriverResponse.of(board.driver))
        self.forces = channel_forces(board, modes)

    def of_points(
        self, points_m: Floats, step_s: Floats, steps_v: Floats, times_s: Floats, quantity: str = "m/s"
    ) -> NDArray[np.float32]:
        """Motion of points in several emissions.

        `points_m` are (point, 2). Voltages step at the times `step_s` (step,), rising and the same in all emissions, by `steps_v`
        (step, channel, emission). `quantity` is "m", the displacement from the level at 0 V, or what it is derived to: "m/s",
        "m/s^2". Returns it (point, emission, sample) at `times_s` (sample,), which rise.
        """
        shapes = self.modes.shapes(points_m, np.float32)
        emissions = steps_v.shape[2]
        found = np.empty((len(points_m), emissions, len(times_s)), np.float32)
        first = 0
        for amplitudes in self._modes(step_s, steps_v, times_s, DERIVATIVE[quantity]):
            after = first + amplitudes.shape[1]
            flat = amplitudes.reshape(self.modes.count, -1)
            found[:, :, first:after] = (shapes @ flat).reshape(len(points_m), after - first, emissions).swapaxes(1, 2)
            first = after
        return found

    def _modes(self, step_s: Floats, steps_v: Floats, times_s: Floats, derivative: int) -> Iterator[NDArray[np.float32]]:
        """Amplitudes of the modes, (mode, some samples, emission), one after another."""
        step, emissions = self.step, steps_v.shape[2]
        count, pole_forces = step.static.size, self.forces[step.mode_of_pole]
        residues = (step.residues * step.poles**derivative)[:, None]
        driver_residues = step.driver_residues * step.driver_poles**derivative
        plate = np.zeros((step.poles.size, emissions), np.complex128)
        driver = np.zeros((2, steps_v.shape[1], emissions), np.complex128)
        level = np.zeros((count, emissions))
        done = np.searchsorted(step_s, times_s, side="right")  # steps before each time
        now_s, taken = min(0.0, float(step_s[0])) if len(step_s) else 0.0, 0
        ahead: Floats = np.zeros((0, 0, 0))  # forces of the next steps: (step, pole, emission)
        ahead_from = 0
        coast = _Coast(step, times_s, residues)
        for first in range(0, len(times_s), AT_ONCE):
            some = times_s[first : first + AT_ONCE]
            block = np.empty((count, len(some), emissions), np.float32)
            for index, (time_s, upto) in enumerate(zip(some.tolist(), done[first : first + AT_ONCE].tolist(), strict=True)):
                for number in range(taken, upto):
                    if number >= ahead_from + len(ahead):
                        ahead_from = number
                        ahead = np.matmul(pole_forces, steps_v[number : number + AT_ONCE])
                    passed_s = float(step_s[number]) - now_s
                    now_s = float(step_s[number])
                    plate *= np.exp(step.poles * passed_s)[:, None]
                    plate += ahead[number - ahead_from]
                    driver *= np.exp(step.driver_poles * passed_s)[:, None, None]
                    driver += steps_v[number]
                    if derivative == 0:
                        level += step.static[:, None] * (self.forces @ steps_v[number])
                taken = upto
                plate *= np.exp(step.poles * (time_s - now_s))[:, None]
                driver *= np.exp(step.driver_poles * (time_s - now_s))[:, None, None]
                now_s = time_s
                if index == 0 and done[first + len(some) - 1] == taken and coast.even and np.abs(driver).max() < SETTLED_V:
                    block[:] = coast.amplitudes(plate, len(some))
                    if derivative == 0:
                        block += level[:, None].astype(np.float32)
                    break
                moved = (residues * plate).real
                amplitudes = step.by_mode(moved) if len(moved) > count else moved
                for residue, state in zip(driver_residues.T, driver, strict=True):
                    amplitudes = amplitudes + (residue[:, None] * (self.forces @ state)).real
                block[:, index] = amplitudes + level if derivative == 0 else amplitudes
            yield block


class _Coast:
    """Free decay over a block of evenly spaced times, during which no voltage changes and the drivers have settled."""

    def __init__(self, step: StepResponse, times_s: Floats, residues: Complex) -> None:
        apart_s = np.diff(times_s)
        self.even = len(times_s) > AT_ONCE and bool(np.ptp(apart_s) < 1e-12)
        self._step = step
        self._decay: Complex = residues * np.exp(np.outer(step.poles, np.arange(AT_ONCE) * apart_s[0])) if self.even else residues

    def amplitudes(self, plate: Complex, count: int) -> NDArray[np.float32]:
        """Of the modes at `count` times from that of `plate` on: (mode, time, emission)."""
        decay = self._decay[:, :count]
        moved = decay.real[:, :, None] * plate.real[:, None] - decay.imag[:, :, None] * plate.imag[:, None]
        return self._step.by_mode(moved).astype(np.float32)
