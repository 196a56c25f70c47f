"""Which cells serve a place between them, and with what weights: nearest, bilinear, polynomials of third order, the band's own."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import j0

from controller.arrays import Floats, Indices
from controller.device.bank.grid import Grid
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.benchmark.methods.response_table import Stencil
from controller.workshop.physics.modes.modes import Modes

Interpolation = Callable[[Grid, float, float], Stencil]
LOOKUP_STEPS = 20  # of a pitch, for tabulated weights
REGULARISATION = 1e-4  # of a response's power: noise that weights do not amplify


def nearest(grid: Grid, x_m: float, y_m: float) -> Stencil:
    """The cell nearest to a place."""
    return Stencil(np.array([grid.nearest(x_m, y_m)[0]]), np.ones(1, np.float32))


def bilinear(grid: Grid, x_m: float, y_m: float) -> Stencil:
    """The four cells around a place."""
    cells, weights = grid.corners(x_m, y_m)
    return Stencil(np.array(cells), np.array(weights, np.float32))


def cubic(grid: Grid, x_m: float, y_m: float) -> Stencil:
    """The 4 x 4 cells around a place, by the polynomial of third order through them."""
    return _product(grid, x_m, y_m, 4, _lagrange)


def _lagrange(offset: float, size: int) -> Floats:
    """Weights of the polynomial through `size` cells at 0, 1, ..., for a place at `offset`."""
    nodes = np.arange(size)
    weights = np.ones(size)
    for index in nodes:
        others = nodes[nodes != index]
        weights[index] = np.prod((offset - others) / (index - others))
    return weights


def _product(grid: Grid, x_m: float, y_m: float, size: int, along: Callable[[float, int], Floats]) -> Stencil:
    x, x_offset = block(grid.nx, (x_m - grid.x0_m) / grid.pitch_m, size)
    y, y_offset = block(grid.ny, (y_m - grid.y0_m) / grid.pitch_m, size)
    weights = np.outer(along(y_offset, len(y)), along(x_offset, len(x)))
    return Stencil((y[:, None] * grid.nx + x).ravel(), weights.ravel().astype(np.float32))


def block(count: int, position: float, size: int) -> tuple[Indices, float]:
    """Indices of `size` cells around a position, within the grid, and the position from the first of them on."""
    size = min(size, count)
    position = min(max(position, 0.0), count - 1.0)
    first = min(max(math.floor(position) - (size - 1) // 2, 0), count - size)
    return np.arange(first, first + size), position - first


@dataclass
class BandInterpolation:
    """Weights that leave the least error for waves of the waveform's band from all directions, tabulated.

    The responses of places at a distance r correlate as the mean of J0(k r) over the wave numbers k in the band. The best
    linear weights solve the normal equations of these correlations (kriging; optimum interpolation of a random wave field).
    """

    board: Board
    modes: Modes  # of its plate: they say which wave numbers are in the band
    size: int  # of the block of cells
    _tables: dict[tuple[float, int, int], NDArray[np.float32]] = field(default_factory=dict)

    def __call__(self, grid: Grid, x_m: float, y_m: float) -> Stencil:
        """Cells and weights for a place."""
        x, x_offset = block(grid.nx, (x_m - grid.x0_m) / grid.pitch_m, self.size)
        y, y_offset = block(grid.ny, (y_m - grid.y0_m) / grid.pitch_m, self.size)
        steps = round(y_offset * LOOKUP_STEPS), round(x_offset * LOOKUP_STEPS)
        weights = self._table(grid.pitch_m, len(y), len(x))[steps]
        return Stencil((y[:, None] * grid.nx + x).ravel(), weights)

    def table_bytes(self) -> int:
        """Memory of the weights for places within the middle cell of a block."""
        return 4 * (LOOKUP_STEPS + 1) ** 2 * self.size**2

    def _table(self, pitch_m: float, rows: int, columns: int) -> NDArray[np.float32]:
        key = pitch_m, rows, columns
        if key not in self._tables:
            self._tables[key] = self._weights(pitch_m, rows, columns)
        return self._tables[key]

    def _weights(self, pitch_m: float, rows: int, columns: int) -> NDArray[np.float32]:
        """Weights for each place of the lattice: (y step, x step, cell)."""
        iy, ix = np.divmod(np.arange(rows * columns), columns)
        between_m = pitch_m * np.hypot(ix - ix[:, None], iy - iy[:, None])
        alike = self._correlation(between_m) + REGULARISATION * np.eye(len(ix))
        y, x = (np.arange((count - 1) * LOOKUP_STEPS + 1) / LOOKUP_STEPS for count in (rows, columns))
        to_cells_m = pitch_m * np.hypot(x[None, :, None] - ix, y[:, None, None] - iy)
        wanted = self._correlation(to_cells_m)
        solved = np.linalg.solve(alike, wanted.reshape(-1, len(ix)).T)
        return np.ascontiguousarray(solved.T, np.float32).reshape(len(y), len(x), -1)

    def _correlation(self, distance_m: Floats) -> Floats:
        low_hz, high_hz = self.board.waveform.band_low_hz, self.board.waveform.band_high_hz
        hz = self.modes.angular_frequency / (2 * np.pi)
        number = 2 * np.pi / bending_wavelength_m(self.board.plate, 1.0) * np.sqrt(hz)  # of the waves of each mode, in 1/m
        in_band: NDArray[Any] = number[(hz >= low_hz) & (hz <= high_hz)]
        far = np.linspace(0, float(distance_m.max()) + 1e-6, 2000)
        mean = j0(np.outer(far, in_band[:: max(len(in_band) // 256, 1)])).mean(axis=1)
        found: Floats = np.interp(distance_m, far, mean)
        return found
