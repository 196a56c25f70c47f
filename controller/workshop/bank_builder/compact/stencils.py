"""Weights of the cells around a place, and how the error of rounding a cell is passed on to the next ones.

A response is a sum of plane waves of known power. The weights around a place solve the normal equations of what cells hold and of
the noise of their rounding (kriging); what cells hold is not the response there, but what these weights turn into the responses
all around with the least error (a prefilter, as that of B-splines). Each follows from the other, in turns. The noise of rounding
is shaped: what is lost by rounding a cell is taken from its neighbours, as far as their weights let it through least (error
diffusion by the prediction error filter of the weights' own correlations).
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.bank.grid import Grid
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.kernel import compact_twin
from controller.workshop.bank_builder.compact.pulses import ROUNDING_NOISE

WHOLE: Final = 8192  # what a weight of 1 is
REACH: Final = 3  # cells
ROUNDS: Final = 40
SIZE: Final = 64  # of the torus on which errors that are passed on correlate
DIRECTIONS: Final = 6  # of waves, in an eighth of a turn
ROUND_FROM: Final = 5  # cells across: such stencils have no corners, which take time and weigh little
MET_AT: Final = 6  # places a pitch, at which errors count
# Rows and columns back to cells that were rounded before, over which errors are passed on
BACK: Final = np.array([(dy, dx) for dy in range(-REACH, 1) for dx in range(-REACH, REACH + 1) if dy < 0 or dx < 0])


@dataclass(frozen=True, eq=False)
class CompactStencil:
    """Weights of `across` x `across` cells around a place on a lattice of `steps` a pitch, and how errors of cells add up."""

    across: int
    steps: int  # of a pitch, to which places are rounded
    table: NDArray[np.int16]  # (y step, x step, cell): the other half is its mirror image
    together: list[tuple[int, int, float]]  # rows and columns to another cell, and how much its error counts with that of this one
    error: tuple[float, float]  # expected square error over that of the response, mean and at the worst place
    let_through: float  # of the noise of rounding, over the power of what cells hold

    def met_by(self, grid: Grid, steps: tuple[int, int]) -> tuple[list[int], Floats]:
        """Cells around a place of the grid in whole steps along x and y, and their shares of it."""
        layer = compact_twin.PulseLayer(self.across, self.steps, 1, 1, 1)
        first_x, x = compact_twin.along(steps[0] / self.steps, 1.0, grid.nx, layer)
        first_y, y = compact_twin.along(steps[1] / self.steps, 1.0, grid.ny, layer)
        table = self.table.reshape(*self.table.shape[:2], self.across, self.across)
        cells = [(first_y + row) * grid.nx + first_x + column for row in range(self.across) for column in range(self.across)]
        return cells, compact_twin.shares(table, layer, x, y).ravel() / WHOLE


class _Waves:
    """Plane waves from all sides, their wave numbers in pitches and powers, which sum to 1."""

    def __init__(self, plate: Plate, pitch_m: float, power: NDArray[Any], frequency_hz: NDArray[Any]) -> None:
        number = 2 * np.pi * pitch_m / bending_wavelength_m(plate, 1.0) * np.sqrt(frequency_hz)
        angle = (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS * np.pi / 4
        sides = [np.outer(number, turn).ravel() for turn in (np.cos(angle), np.sin(angle))]
        self.x, self.y = np.concatenate(sides), np.concatenate(sides[::-1])
        self.power = np.tile(np.repeat(power / power.sum(), DIRECTIONS), 2) / (2 * DIRECTIONS)

    def standing(self, y: Floats, x: Floats) -> Floats:
        """What waves have at places, those from opposite sides together: (place, wave)."""
        return np.cos(np.outer(y, self.y)) * np.cos(np.outer(x, self.x))


class _Fit:
    """Weights around a place, and what cells hold for them, in turns."""

    def __init__(self, waves: _Waves, across: int) -> None:
        self._waves = waves
        rows, columns = np.divmod(np.arange(across**2), across)
        corner = np.isin(rows, (0, across - 1)) & np.isin(columns, (0, across - 1)) & (across >= ROUND_FROM)
        self.cells = np.flatnonzero(~corner)
        self.y, self.x = rows[self.cells].astype(np.float64), columns[self.cells].astype(np.float64)
        low = across / 2 - 1
        middle = low + (np.arange(MET_AT) + 0.5) / MET_AT
        at_y, at_x = (part.ravel() for part in np.meshgrid(middle, middle, indexing="ij"))
        to_y, to_x = self.y[:, None] - at_y, self.x[:, None] - at_x
        self._to_places = waves.standing(to_y.ravel(), to_x.ravel())
        self._between = waves.standing((self.y[:, None] - self.y).ravel(), (self.x[:, None] - self.x).ravel())
        self._turned = np.exp(1j * (waves.y[:, None, None] * to_y + waves.x[:, None, None] * to_x))
        self._rows, self._columns = (np.rint(part[:, None] - part).astype(int) % SIZE for part in (self.y, self.x))
        self.own, self.error, self.let_through = np.zeros((SIZE, SIZE)), np.zeros(1), 0.0
        filtered, share = np.ones_like(waves.power), np.zeros(len(BACK))
        for _ in range(ROUNDS):
            filtered, share = self._turn(filtered, share)

    def _turn(self, filtered: Floats, share: Floats) -> tuple[Floats, Floats]:
        """What cells hold of each wave, and the shares of their errors that are passed on, from those before."""
        cells, power = len(self.cells), self._waves.power
        self._kept = filtered * power
        held = (self._between @ (filtered * self._kept)).reshape(cells, cells)
        wanted = (self._to_places @ self._kept).reshape(cells, -1)
        noise = ROUNDING_NOISE * held[0, 0] * _shape(share)[self._rows, self._columns]
        self._normal = held + noise
        weights = np.linalg.solve(self._normal, wanted)
        self.error = 1 - 2 * (weights * wanted).sum(axis=0) + np.einsum("ip,ij,jp->p", weights, self._normal, weights)
        self.let_through = float(np.einsum("ip,ij,jp->p", weights, noise, weights).mean() / held[0, 0])
        self.own = np.zeros((SIZE, SIZE))
        np.add.at(self.own, (self._rows, self._columns), weights @ weights.T / weights.shape[1])
        passed = np.einsum("wcp,cp->wp", self._turned, weights)
        return passed.real.mean(axis=1) / ((np.abs(passed) ** 2).mean(axis=1) + self.let_through), _passed_on(self.own)

    def table(self, across: int, steps: int) -> Floats:
        """Weights of the cells around each place of a quarter of the stencil: (y step, x step, cell)."""
        half = (across - 1) * steps // 2 + 1
        away = np.arange(-(half - 1), (across - 1) * steps + 1) / steps
        of_rows, of_columns = (np.cos(np.outer(away, number)) for number in (self._waves.y, self._waves.x))
        alike = (of_rows * self._kept) @ of_columns.T
        at = half - 1 - np.arange(half)
        from_rows, from_columns = (np.rint(part * steps).astype(int)[:, None] + at for part in (self.y, self.x))
        wanted = alike[from_rows[:, :, None], from_columns[:, None, :]]
        found = np.zeros((half, half, across**2))
        found[:, :, self.cells] = np.linalg.solve(self._normal, wanted.reshape(len(self.cells), -1)).T.reshape(half, half, -1)
        return found


def stencil(
    plate: Plate, pitch_m: float, across: int, steps: int, power: NDArray[Any], frequency_hz: NDArray[Any]
) -> CompactStencil:
    """The stencil for waves whose `power` at each `frequency_hz` is given."""
    fit = _Fit(_Waves(plate, pitch_m, power, frequency_hz), across)
    table = fit.table(across, steps)
    near = range(1 - across, across)
    return CompactStencil(
        across,
        steps,
        np.rint(table * WHOLE).astype(np.int16),
        [(row, column, float(fit.own[row, column] / fit.own[0, 0])) for row in near for column in near if row or column],
        (float(fit.error.mean()), float(fit.error.max())),
        fit.let_through,
    )


def _passed_on(own: Floats) -> Floats:
    """Shares of their errors that a cell takes back from those rounded before, by the correlations of weights at each distance."""
    between = (BACK[:, None] - BACK) % SIZE
    among = own[between[..., 0], between[..., 1]] + 1e-3 * own[0, 0] * np.eye(len(BACK))
    return np.linalg.solve(among, own[BACK[:, 0] % SIZE, BACK[:, 1] % SIZE])


def _shape(share: Floats) -> Floats:
    """Correlations, on a torus, of errors that are passed on."""
    kept = np.zeros((SIZE, SIZE))
    kept[0, 0] = 1
    kept[BACK[:, 0] % SIZE, BACK[:, 1] % SIZE] = -share
    return np.fft.ifft2(np.abs(np.fft.fft2(kept)) ** 2).real
