"""Where to measure a plate, in what order, and how long it takes.

Either on a grid of half a wavelength, at the middle of its cells, which the interpolation by cosines takes as it is; or at far
fewer scattered points, for the interpolation by Bessel functions: a field of one frequency has as many degrees of freedom as half
wavelengths fit round the plate's edge, not as fit onto its area.
"""

import math
from dataclasses import dataclass

import numpy as np

from controller.arrays import Bools, Floats, Indices
from controller.device.board.board import Board
from controller.errors import ConfigError
from controller.workshop.calibration.dispersion import Dispersion

POINTS_PER_HALF_WAVE = 1.5  # of the plate's edge: 250 on the paper's plate
CANDIDATES = 12  # per point that is there already, of which the farthest from all is taken
MOST_POINTS = 20_000
WIRING_MARGIN_M = 30e-3  # from the edges, whose echoes hide which patch a wave came from
NONE = np.empty((0, 2))


@dataclass(frozen=True)
class PlanTiming:
    """How long one point takes."""

    record_s: float  # from the beginning of one record to that of the next: drive, decay and pause
    records: int  # at each point: channels times repetitions
    settle_s: float  # after the head has moved, until it is still
    speed_m_s: float  # of the head

    def whole_s(self, path_m: float, points: int) -> float:
        """Time for this many points on a path of `path_m`."""
        return points * (self.records * self.record_s + self.settle_s) + path_m / self.speed_m_s


def half_wave_m(board: Board) -> float:
    """Half a wavelength at the upper edge of a board's band, in m: what a regular grid may not exceed."""
    return Dispersion.of(board.plate).wavelength_m(board.waveform.band_high_hz) / 2


def scattered_count(board: Board) -> int:
    """How many scattered points a plate needs."""
    plate = board.plate
    return math.ceil(POINTS_PER_HALF_WAVE * 2 * (plate.length_m + plate.width_m) / half_wave_m(board))


def grid_points(board: Board) -> Floats:
    """Middles of the largest equal cells of at most half a wavelength that cover the plate, by rows to and fro: (point, 2) in m.

    Raises ConfigError if there would be too many.
    """
    extents, most_m = (board.plate.length_m, board.plate.width_m), half_wave_m(board)
    nx, ny = (math.ceil(extent / most_m - 1e-9) for extent in extents)
    if nx * ny > MOST_POINTS:
        raise ConfigError(
            f"a grid of half a wavelength ({most_m * 1e3:.2f} mm) on this plate has {nx * ny:,} points, above {MOST_POINTS:,}"
        )
    x_m, y_m = ((np.arange(count) + 0.5) * (extent / count) for count, extent in zip((nx, ny), extents, strict=True))
    return np.concatenate([np.column_stack([x_m[:: -1 if row % 2 else 1], np.full(nx, y)]) for row, y in enumerate(y_m)])


def scattered_points(
    board: Board,
    count: int,
    margin_m: float,
    *,
    avoid_actuators: bool = False,
    seed: int = 1,
    beside_m: Floats = NONE,  # (point, 2): points that are there already
) -> Floats:
    """Points scattered evenly and without a regular distance, in the order of a short path: (point, 2) in m.

    Each is the farthest from those before among random candidates (Mitchell's best candidate).

    `margin_m` is the least distance from the plate's edges; `avoid_actuators` keeps them off the patches. Raises ConfigError if the
    margin leaves no plate, or there would be too many points.
    """
    if not 0 < count <= MOST_POINTS:
        raise ConfigError(f"{count} points are not from 1 to {MOST_POINTS:,}")
    low, high = np.array([margin_m, margin_m]), np.array([board.plate.length_m, board.plate.width_m]) - margin_m
    if not (margin_m >= 0 and (low < high).all()):
        raise ConfigError(
            f"a margin of {margin_m * 1e3:g} mm leaves nothing of {board.plate.length_mm:g} x {board.plate.width_mm:g} mm"
        )
    random = np.random.default_rng(seed)
    pool = np.empty((0, 2))
    while len(pool) < 4 * count * CANDIDATES:
        some = random.uniform(low, high, (4 * count * CANDIDATES, 2))
        pool = np.concatenate([pool, some[~_on_actuators(board, some)] if avoid_actuators else some])
    nearest = np.hypot(*(pool[:, None] - beside_m).T).min(axis=0, initial=np.inf)
    points = np.empty((count, 2))
    for index in range(count):
        among = random.choice(len(pool), min(CANDIDATES * (index + 1), len(pool)), replace=False)
        points[index] = pool[among[np.argmax(nearest[among])]]
        np.minimum(nearest, np.hypot(*(pool - points[index]).T), out=nearest)
    return points[short_path(points)]


def wiring_points(board: Board, count: int, beside_m: Floats = NONE) -> Floats:
    """Points that tell which patch each channel drives, beside those that were measured: (point, 2) in m."""
    margin_m = min(WIRING_MARGIN_M, board.plate.length_m / 4, board.plate.width_m / 4)
    return scattered_points(board, count, margin_m, avoid_actuators=True, beside_m=beside_m)


def short_path(points_m: Floats) -> Indices:
    """Order of points, (point, 2), along strips to and fro: about 1.1 sqrt(area * points) long."""
    extent = np.ptp(points_m, axis=0)
    strips = max(round(math.sqrt(len(points_m) * extent[1] / (3 * extent[0] or 1))), 1)
    strip = np.minimum(((points_m[:, 1] - points_m[:, 1].min()) / (extent[1] or 1) * strips).astype(int), strips - 1)
    return np.lexsort((np.where(strip % 2, -1, 1) * points_m[:, 0], strip))


def path_m(points_m: Floats) -> float:
    """Length of the path through points in their order, in m."""
    return float(np.hypot(*np.diff(points_m, axis=0).T).sum())


def _on_actuators(board: Board, points_m: Floats) -> Bools:
    """Whether each point lies on a patch."""
    on = np.zeros(len(points_m), bool)
    for actuator in board.actuators:
        off_m = np.abs(points_m - np.array([actuator.x_mm, actuator.y_mm]) * 1e-3)
        on |= (off_m <= actuator.size_mm * 0.5e-3).all(axis=1)
    return on
