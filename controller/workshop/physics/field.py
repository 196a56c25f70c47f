"""Displacement of the whole plate at one focus time T, and the figures of merit of a focus.

Everything is computed from modal amplitudes, so a map is two small matrix products, and times around
T need no stepping. Displacements are relative to the position at rest at the idle word: the static
deflection by the idle levels never changes, so neither a finger nor a vibrometer detects it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from controller.arrays import Complex, Floats
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.physics.modes.modes import Modes, at_points
from controller.workshop.physics.plate import MIDDLE_HZ, WAVELENGTH_M, wave_scale
from controller.workshop.physics.responses.step_response import StepResponse

Point = tuple[float, float]

# On the paper's plate; `FocusScale` has them for others
MAP_STEP_M = 2e-3
OUTSIDE_M = 10e-3  # contrast is relative to points farther than this from the focus
LINE_M: Floats = np.arange(-120.0, 121) * 0.05e-3  # where the spot is measured
CREST_M: Floats = np.arange(-16.0, 17) * 0.25e-3  # search range for the crest of a spot: less than half a wavelength at 70 kHz
AROUND_S: Floats = np.arange(-50.0, 51) * 0.1e-6


@dataclass(frozen=True, eq=False)
class FocusScale:
    """Where a focus is measured: lengths go with the wavelength in the middle of the band, times with its period."""

    map_step_m: float = MAP_STEP_M  # largest distance of the points of a map
    # Contrast is relative to points farther than this from every focus: 0.95 wavelengths, 10 mm on the paper's plate
    outside_m: float = OUTSIDE_M
    line_m: Floats = field(default_factory=LINE_M.copy)  # (241,): offsets at which the spot is measured: 1.14 wavelengths, 12 mm
    crest_m: Floats = field(default_factory=CREST_M.copy)  # (33,): offsets among which the crest of a spot is searched
    around_s: Floats = field(default_factory=AROUND_S.copy)  # (101,): times from T: 0.225 periods before and after, 5 us
    wave_m: float = WAVELENGTH_M  # the wavelength itself

    @property
    def circle_m(self) -> float:
        """Radius in m of the circle around a focus in pictures: 8 mm on the paper's plate, a fingertip."""
        return 0.8 * self.outside_m

    @classmethod
    def of(cls, board: Board) -> Self:
        """Scale of a board, its factors rounded to three digits: exactly one for the shipped boards."""
        longer = wave_scale(board)
        slower = float(f"{MIDDLE_HZ / board.waveform.middle_hz:.3g}")
        wave_m = bending_wavelength_m(board.plate, board.waveform.middle_hz)
        return cls(MAP_STEP_M * longer, OUTSIDE_M * longer, LINE_M * longer, CREST_M * longer, AROUND_S * slower, wave_m)


@dataclass(frozen=True)
class FocusMetrics:
    """Figures of merit of one focus."""

    amplitude_m: float  # displacement at the focus at T
    # Its size over the rms displacement farther than `FocusScale.outside_m` from every focus: 10 mm on the paper's plate
    contrast: float
    contrast_all: float  # the same over all points of the map
    spot_m: float  # full width at half height, mean over x, y and both diagonals
    spot_wavelengths: float  # the same over the wavelength in the middle of the band
    peak_offset_s: float  # time of the largest displacement within `FocusScale.around_s` of T, from T: 5 us on the paper's plate


@dataclass(frozen=True, eq=False)
class Field:
    """State of plate and drivers at T, up to the steps of voltage before T."""

    modes: Modes
    step: StepResponse
    pole_amplitudes: Complex  # (pole,): of the plate's free oscillations at T, m
    driver_amplitudes: Complex  # (mode, 2): of the part that follows the drivers' own settling, m
    level: Floats  # (mode,): where the voltages played last would hold each mode, from the rest position, m
    near_s: Floats  # (edge,): times of the voltage steps around T, relative to T; those at T or later are not in the state
    near_force: Floats  # (mode, edge): their forces on the modes, N
    # (mode, 2): as `driver_amplitudes`, at the first of the times around T, from the steps before that: a driver may forget
    # within nanoseconds, so its state cannot be stepped back from T
    early_driver_amplitudes: Complex
    scale: FocusScale  # where the focus is measured

    @classmethod
    def of_modal(cls, modes: Modes, step: StepResponse, modal: Floats, scale: FocusScale) -> Self:
        """A plate whose modes are displaced by `modal` at T, in m: (mode,); of no other time anything is known."""
        settled = np.zeros((modes.count, 2), np.complex128)
        return cls(
            modes=modes,
            step=step,
            pole_amplitudes=np.zeros(step.poles.size, np.complex128),
            driver_amplitudes=settled,
            level=modal,
            near_s=np.zeros(0),
            near_force=np.zeros((modes.count, 0)),
            early_driver_amplitudes=settled,
            scale=scale,
        )

    @cached_property
    def modal(self) -> Floats:
        """Displacement of each mode at T in m: (mode,)."""
        modal: Floats = self.level + self.step.by_mode(self.pole_amplitudes.real) + self.driver_amplitudes.real.sum(1)
        return modal

    @cached_property
    def modal_velocity(self) -> Floats:
        """Velocity of each mode at T in m/s: (mode,)."""
        of_poles = self.step.by_mode((self.step.poles * self.pole_amplitudes).real)
        velocity: Floats = of_poles + (self.driver_amplitudes * self.step.driver_poles).real.sum(1)
        return velocity

    def at(self, points_m: ArrayLike) -> Floats:
        """Displacement at T in m, (point,), at `points_m`, (point, 2)."""
        return at_points(self.modes, self.modal, points_m)

    def map(self, step_m: float | None = None) -> tuple[Floats, Floats, Floats]:
        """Displacement at T over the plate: x (nx,), y (ny,), u (ny, nx), all in m; at most `step_m` (of the scale) apart."""
        step_m = self.scale.map_step_m if step_m is None else step_m
        x, y = map_axis(self.modes.length_m, step_m), map_axis(self.modes.width_m, step_m)
        return x, y, self.modes.on_grid(self.modal, x, y)

    def around(self, point_m: Point) -> Floats:
        """Displacement in m of `point_m` at the times `FocusScale.around_s` from T: exact, steps of voltage in between included."""
        shape = self.modes.shapes(point_m)[0]
        rows = shape[self.step.mode_of_pole]
        times_s = self.scale.around_s
        decay, driver_decay = _tables(self.step, self.scale)
        u: Floats = float(shape @ self.level) + (decay @ (rows * self.pole_amplitudes)).real
        u += (driver_decay @ (shape @ self.early_driver_amplitudes)).real
        for edge_s, force in zip(self.near_s, self.near_force.T, strict=True):
            # the state of the plate holds the steps before T: take each out again for times before it; add those after T
            here = np.greater(times_s, edge_s) if edge_s >= 0 else np.less(times_s, edge_s)
            poles = rows * force[self.step.mode_of_pole] * self.step.residues * np.exp(-self.step.poles * edge_s)
            pushed = float((shape * force) @ self.step.static) + (decay[here] @ poles).real
            u[here] += pushed if edge_s >= 0 else -pushed
            since = here if edge_s >= 0 else ~here  # of the drivers the state begins with the first of the times
            settling = np.exp(np.outer(times_s[since] - edge_s, self.step.driver_poles))
            u[since] += (settling @ ((shape * force) @ self.step.driver_residues)).real
        return u

    def focus_metrics(self, x_m: float, y_m: float, foci: Sequence[Point] = ()) -> FocusMetrics:
        """Figures of merit of the focus at (x_m, y_m).

        `foci` are all points focused on at this time, by default this one; contrast is taken outside 10 mm (of the scale) of any.
        """
        amplitude = float(self.at((x_m, y_m))[0])
        x, y, u = self.map()
        outside = np.ones(u.shape, np.bool_)
        for fx, fy in foci or [(x_m, y_m)]:
            outside &= np.hypot(x - fx, (y - fy)[:, None]) > self.scale.outside_m
        squared = u**2
        spot_m = self._spot(self.crest(x_m, y_m), amplitude)
        return FocusMetrics(
            amplitude_m=amplitude,
            contrast=_ratio_to_rms(amplitude, float(squared[outside].mean()) if outside.any() else 0.0),
            contrast_all=_ratio_to_rms(amplitude, float(squared.mean())),
            spot_m=spot_m,
            spot_wavelengths=spot_m / self.scale.wave_m,
            peak_offset_s=self._peak_offset((x_m, y_m), amplitude),
        )

    def crest(self, x_m: float, y_m: float) -> Point:
        """Place in m of the spot's crest at T: the extremum of the sign of (x_m, y_m), within 4 mm (scaled) of it along x and y."""
        crest_m = self.scale.crest_m
        x = x_m + crest_m[(x_m + crest_m >= 0) & (x_m + crest_m <= self.modes.length_m)]
        y = y_m + crest_m[(y_m + crest_m >= 0) & (y_m + crest_m <= self.modes.width_m)]
        u = self.modes.on_grid(self.modal, x, y)
        u *= 1.0 if self.at((x_m, y_m))[0] >= 0 else -1.0
        j, i = np.unravel_index(int(np.argmax(u)), u.shape)
        step = float(crest_m[1] - crest_m[0])
        return float(x[i]) + step * _vertex(u[j], int(i)), float(y[j]) + step * _vertex(u[:, i], int(j))

    def _spot(self, crest: Point, amplitude: float) -> float:
        widths = []
        for dx, dy in ((1.0, 0.0), (0.0, 1.0), (0.5**0.5, 0.5**0.5), (0.5**0.5, -(0.5**0.5))):
            x, y = crest[0] + dx * self.scale.line_m, crest[1] + dy * self.scale.line_m
            on_plate = (x >= 0) & (x <= self.modes.length_m) & (y >= 0) & (y <= self.modes.width_m)
            line = np.where(on_plate, self.at(np.column_stack([x, y])), 0.0)
            widths.append(half_width(line if amplitude >= 0 else -line, self.scale.line_m))
        return float(np.mean(widths))

    def _peak_offset(self, point_m: Point, amplitude: float) -> float:
        u = self.around(point_m) * (1 if amplitude >= 0 else -1)
        top = int(np.argmax(u))
        times_s = self.scale.around_s
        return float(times_s[top] + _vertex(u, top) * (times_s[1] - times_s[0]))


def half_width(line: Floats, line_m: Floats = LINE_M) -> float:
    """Full width at half height of a crest in the middle of a line sampled at `line_m`, in m.

    A crest that does not fall to half within the line has the width up to the line's end.
    """
    top = len(line_m) // 2
    half = float(line[top]) / 2
    step = float(line_m[1] - line_m[0])
    return step * (crossing(line[top:], half) + crossing(line[top::-1], half))


def _vertex(values: Floats, top: int) -> float:
    """Offset, in samples, of a parabola's vertex from the largest of its samples; 0 at the rim."""
    if top in (0, len(values) - 1):
        return 0.0
    before, at, after = (float(v) for v in values[top - 1 : top + 2])
    curvature = before - 2 * at + after
    return 0.5 * (before - after) / curvature if curvature else 0.0


def crossing(falling: Floats, half: float) -> float:
    """Samples from the first to where the line falls to `half`."""
    below = np.flatnonzero(falling <= half)
    if not below.size or below[0] == 0:
        return float(len(falling) - 1)
    i = int(below[0])
    return i - 1 + float((falling[i - 1] - half) / (falling[i - 1] - falling[i]))


@lru_cache(maxsize=2)
def _tables(step: StepResponse, scale: FocusScale) -> tuple[Complex, Complex]:
    """exp(pole * t) at the times around T, (time, pole) each: of the plate's poles from T, of the driver's from the first time."""
    times_s = scale.around_s
    return np.exp(np.outer(times_s, step.poles)), np.exp(np.outer(times_s - times_s[0], step.driver_poles))


def map_axis(extent_m: float, step_m: float) -> Floats:
    """Coordinates of a map's points along an axis of `extent_m`, (n,) in m: centres of equal cells of at most `step_m`."""
    count = int(np.ceil(extent_m / step_m - 1e-9))
    return np.linspace(0.5, count - 0.5, count) * (extent_m / count)


def _ratio_to_rms(amplitude: float, mean_square: float) -> float:
    return abs(amplitude) / mean_square**0.5 if mean_square > 0 else float("inf")
