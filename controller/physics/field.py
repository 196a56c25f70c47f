"""Displacement of the whole plate at one focus time T, and the figures of merit of a focus.

Everything is computed from modal amplitudes, so a map is two small matrix products, and times around
T need no stepping. Displacements are relative to the position at rest at the idle word: the static
deflection by the idle levels never changes, so neither a finger nor a vibrometer detects it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from controller.physics.plate import PlateModes
from controller.physics.step_response import StepResponse

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Point = tuple[float, float]

MAP_STEP_M = 2e-3
OUTSIDE_M = 10e-3  # contrast is relative to points farther than this from the focus
LINE_M = np.arange(-120, 121) * 0.05e-3  # where the spot is measured
CREST_M = np.arange(-16, 17) * 0.25e-3  # search range for the crest of a spot: less than half a wavelength at 70 kHz
AROUND_S = np.arange(-50, 51) * 0.1e-6


@dataclass(frozen=True)
class FocusMetrics:
    """Figures of merit of one focus.

    Attributes
    ----------
    amplitude_m : float
        Displacement at the focus at T.
    contrast : float
        Its size over the rms displacement outside 10 mm of every focus.
    contrast_all : float
        The same over all points of the map.
    spot_m : float
        Full width at half height, mean over x, y and both diagonals.
    peak_offset_s : float
        Time of the largest displacement within 5 us of T, from T.
    """

    amplitude_m: float
    contrast: float
    contrast_all: float
    spot_m: float
    peak_offset_s: float


@dataclass(frozen=True, eq=False)
class Field:
    """State of plate and drivers at T, up to the steps of voltage before T.

    Attributes
    ----------
    pole_amplitudes : (pole,) complex array
        Of the plate's free oscillations at T, m.
    driver_amplitudes : (mode, 2) complex array
        Of the part that follows the drivers' own settling, m.
    level : (mode,) array
        Where the voltages played last would hold each mode, from the rest position, m.
    near_s : (edge,) array
        Times of the voltage steps around T, relative to T; those at T or later are not in the state.
    near_force : (mode, edge) array
        Their forces on the modes, N.
    """

    modes: PlateModes
    step: StepResponse
    pole_amplitudes: Complex
    driver_amplitudes: Complex
    level: Floats
    near_s: Floats
    near_force: Floats

    @cached_property
    def modal(self) -> Floats:
        """Displacement of each mode at T in m: (mode,)."""
        modal: Floats = self.level + self.step.by_mode(self.pole_amplitudes.real) + self.driver_amplitudes.real.sum(1)
        return modal

    @cached_property
    def _matrix(self) -> Floats:
        """`modal` by order: (m, n)."""
        matrix = np.zeros((self.modes.x_order.max(), self.modes.y_order.max()))
        matrix[self.modes.x_order - 1, self.modes.y_order - 1] = self.modal
        return matrix

    def at(self, points_m: ArrayLike) -> Floats:
        """Displacement at T in m, (point,), at `points_m`, (point, 2)."""
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        along_x = self.modes.x_sines(points[:, 0]) @ self._matrix
        values: Floats = np.einsum("pn,pn->p", along_x, self.modes.y_sines(points[:, 1]))
        return values

    def map(self, step_m: float = MAP_STEP_M) -> tuple[Floats, Floats, Floats]:
        """Displacement at T over the plate: x (nx,), y (ny,), u (ny, nx), all in m; points at most `step_m` apart."""
        x, y = _centres(self.modes.length_m, step_m), _centres(self.modes.width_m, step_m)
        return x, y, self.modes.y_sines(y) @ (self._matrix.T @ self.modes.x_sines(x).T)

    def around(self, point_m: Point) -> Floats:
        """Displacement in m of `point_m` at the times `AROUND_S` from T: exact, steps of voltage in between included."""
        shape = self.modes.mode_shapes(point_m)[0]
        rows = shape[self.step.mode_of_pole]
        tables = _tables(self.step)
        u = float(shape @ self.level) + _oscillation(tables, rows * self.pole_amplitudes, shape @ self.driver_amplitudes)
        for edge_s, force in zip(self.near_s, self.near_force.T, strict=True):
            # the state holds the steps before T: take each out again for times before it; add those after T
            here = np.greater(AROUND_S, edge_s) if edge_s >= 0 else np.less(AROUND_S, edge_s)
            poles = rows * force[self.step.mode_of_pole] * self.step.residues * np.exp(-self.step.poles * edge_s)
            drivers = (shape * force) @ self.step.driver_residues * np.exp(-self.step.driver_poles * edge_s)
            pushed = float((shape * force) @ self.step.static) + _oscillation(tables, poles, drivers, here)
            u[here] += pushed if edge_s >= 0 else -pushed
        return u

    def focus_metrics(self, x_m: float, y_m: float, foci: Sequence[Point] = ()) -> FocusMetrics:
        """Figures of merit of the focus at (x_m, y_m).

        Parameters
        ----------
        foci : sequence of (x_m, y_m)
            All points focused on at this time; contrast is taken outside 10 mm of any. Default: this one.
        """
        amplitude = float(self.at((x_m, y_m))[0])
        x, y, u = self.map()
        outside = np.ones(u.shape, np.bool_)
        for fx, fy in foci or [(x_m, y_m)]:
            outside &= np.hypot(x - fx, (y - fy)[:, None]) > OUTSIDE_M
        squared = u**2
        return FocusMetrics(
            amplitude_m=amplitude,
            contrast=_ratio_to_rms(amplitude, float(squared[outside].mean()) if outside.any() else 0.0),
            contrast_all=_ratio_to_rms(amplitude, float(squared.mean())),
            spot_m=self._spot(self.crest(x_m, y_m), amplitude),
            peak_offset_s=self._peak_offset((x_m, y_m), amplitude),
        )

    def crest(self, x_m: float, y_m: float) -> Point:
        """Place in m of the spot's crest at T: the extremum of the sign of (x_m, y_m), within 4 mm of it along x and y."""
        x = x_m + CREST_M[(x_m + CREST_M >= 0) & (x_m + CREST_M <= self.modes.length_m)]
        y = y_m + CREST_M[(y_m + CREST_M >= 0) & (y_m + CREST_M <= self.modes.width_m)]
        u = self.modes.x_sines(x) @ self._matrix @ self.modes.y_sines(y).T
        u *= 1.0 if self.at((x_m, y_m))[0] >= 0 else -1.0
        i, j = np.unravel_index(int(np.argmax(u)), u.shape)
        step = float(CREST_M[1] - CREST_M[0])
        return float(x[i]) + step * _vertex(u[:, j], int(i)), float(y[j]) + step * _vertex(u[i], int(j))

    def _spot(self, crest: Point, amplitude: float) -> float:
        widths = []
        for dx, dy in ((1.0, 0.0), (0.0, 1.0), (0.5**0.5, 0.5**0.5), (0.5**0.5, -(0.5**0.5))):
            x, y = crest[0] + dx * LINE_M, crest[1] + dy * LINE_M
            on_plate = (x >= 0) & (x <= self.modes.length_m) & (y >= 0) & (y <= self.modes.width_m)
            line = np.where(on_plate, self.at(np.column_stack([x, y])), 0.0)
            widths.append(half_width(line if amplitude >= 0 else -line))
        return float(np.mean(widths))

    def _peak_offset(self, point_m: Point, amplitude: float) -> float:
        u = self.around(point_m) * (1 if amplitude >= 0 else -1)
        top = int(np.argmax(u))
        return float(AROUND_S[top] + _vertex(u, top) * (AROUND_S[1] - AROUND_S[0]))


def half_width(line: Floats) -> float:
    """Full width at half height of a crest in the middle of a line sampled at `LINE_M`, in m.

    A crest that does not fall to half within the line has the width up to the line's end.
    """
    top = len(LINE_M) // 2
    half = float(line[top]) / 2
    return _crossing(line[top:], half) + _crossing(line[top::-1], half)


def _vertex(values: Floats, top: int) -> float:
    """Offset, in samples, of a parabola's vertex from the largest of its samples; 0 at the rim."""
    if top in (0, len(values) - 1):
        return 0.0
    before, at, after = (float(v) for v in values[top - 1 : top + 2])
    curvature = before - 2 * at + after
    return 0.5 * (before - after) / curvature if curvature else 0.0


def _crossing(falling: Floats, half: float) -> float:
    """Distance from the first sample to where the line falls to `half`."""
    step = float(LINE_M[1] - LINE_M[0])
    below = np.flatnonzero(falling <= half)
    if not below.size or below[0] == 0:
        return step * (len(falling) - 1)
    i = int(below[0])
    return step * (i - 1 + float((falling[i - 1] - half) / (falling[i - 1] - falling[i])))


@lru_cache(maxsize=2)
def _tables(step: StepResponse) -> tuple[Complex, Complex]:
    """exp(pole * t) of the plate's and the driver's poles at the times `AROUND_S`: (time, pole) each."""
    return np.exp(np.outer(AROUND_S, step.poles)), np.exp(np.outer(AROUND_S, step.driver_poles))


def _oscillation(
    tables: tuple[Complex, Complex], poles: Complex, drivers: Complex, here: slice | NDArray[np.bool_] = slice(None)
) -> Floats:
    """Re sum_p amplitude_p exp(pole_p t) at the times `AROUND_S[here]`."""
    result: Floats = (tables[0][here] @ poles + tables[1][here] @ drivers).real
    return result


def _centres(extent_m: float, step_m: float) -> Floats:
    count = int(np.ceil(extent_m / step_m - 1e-9))
    return np.linspace(0.5, count - 0.5, count) * (extent_m / count)


def _ratio_to_rms(amplitude: float, mean_square: float) -> float:
    return abs(amplitude) / mean_square**0.5 if mean_square > 0 else float("inf")
