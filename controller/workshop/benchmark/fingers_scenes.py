"""Scenes of the work-precision diagrams: where fingers are at T, and where a panel says that they are."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from controller.arrays import Floats, Reals
from controller.device.bank.grid import Grid
from controller.device.board.board import Board
from controller.device.touch.prediction import Motion
from controller.device.waveforms.pad import pad_places

Place = tuple[float, float]

INNER_M = 30e-3  # nearer to an edge, its mirror image correlates neighbouring responses: a family of its own
MARGIN_M = 12e-3
APART_M = 12e-3  # smallest distance between fingers; nearer ones take turns on the device
NULL_M = (10e-3, 40e-3)  # distance of a finger that shall feel nothing from the nearest that shall
SQUARE_M = 10e-3  # of the paper's four foci (fig. 9)
LAG_S = 15e-3  # from a finger's place to its report, as of a real panel (prediction: device/touch/README.md)
REPORT_PERIOD_S = 8e-3
NOISE_M = 0.05e-3
RESOLUTION_M = 0.1e-3
AHEAD_S = 3.4e-3  # from the report's arrival to T: an upload of 1.4 ms and an emission of 2 ms
REPORTS = 24
DRIFT = 5e-3  # of all modal frequencies
FINGERS = (1, 2, 4, 10)


@dataclass(frozen=True)
class FingerScene:
    """Fingers of one emission."""

    family: str  # scenes of one kind are summarised together
    points: tuple[Place, ...]  # each (x_m, y_m): where the fingers are at T; none: nobody touches the panel
    expected: tuple[Place, ...]  # each (x_m, y_m): where the host expects them at T; the same as `points` for fingers at rest
    null: Place  # (x_m, y_m): a finger that shall feel nothing
    detuning: float = 1.0  # ratio of the plate's modal frequencies to those of which responses are known

    @property
    def needed(self) -> tuple[Place, ...]:
        """Places whose responses composing may need: where fingers are expected, and the pad of the one that shall feel nothing."""
        return (*self.expected, *pad_places(*self.null))


def still(family: str, points: Sequence[Place], null: Place, detuning: float = 1.0) -> FingerScene:
    """A scene whose fingers do not move."""
    places = tuple(points)
    return FingerScene(family, places, places, null, detuning)


def scenes(board: Board, seed: int, each: int, random_scenes: int) -> list[FingerScene]:
    """Draw the scenes of a benchmark, `each` of every family; random ones have one to ten fingers at least 12 mm from the edges."""
    random = np.random.default_rng(seed)
    grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3)
    size = np.array([board.plate.length_m, board.plate.width_m])
    inner_m = min(INNER_M, 0.3 * float(size.min()))
    made: list[FingerScene] = []

    def drawn(fingers: int, margin_m: float) -> list[Place]:
        return _apart(random, fingers, np.full(2, margin_m), size - margin_m)

    def null(points: Sequence[Place]) -> Place:
        return _null(random, points, size)

    def add(family: str, points_of: Callable[[], Sequence[Place]], count: int = each) -> None:
        for _ in range(count):
            points = points_of()
            made.append(still(family, points, null(points)))

    def on_grid(fingers: int) -> list[Place]:
        return [grid.place(grid.nearest(*point)[0]) for point in drawn(fingers, inner_m)]

    def beside_a_cell() -> list[Place]:
        """Within the snap distance: equally often on equal areas."""
        around, away_m = random.uniform(0, 2 * np.pi), board.bank.snap_mm * 1e-3 * float(np.sqrt(random.uniform()))
        ((x_m, y_m),) = on_grid(1)
        return [(x_m + away_m * float(np.cos(around)), y_m + away_m * float(np.sin(around)))]

    def square() -> list[Place]:
        x_m, y_m = random.uniform(inner_m, size - inner_m).tolist()
        half = SQUARE_M / 2
        return [(x_m - half, y_m - half), (x_m + half, y_m - half), (x_m + half, y_m + half), (x_m - half, y_m + half)]

    for fingers in FINGERS:
        add(f"{fingers} off grid", partial(drawn, fingers, inner_m))
    for fingers in (1, 4):
        add(f"{fingers} on grid", partial(on_grid, fingers))
    add("1 beside a cell", beside_a_cell)
    add("1 near an edge", lambda: [_near_edge(random, size)])
    add("four foci of the paper", square)
    alone = [scene for scene in made if scene.family == "1 off grid"]
    for detuning in (1 - DRIFT, 1 + DRIFT):
        made += [still(f"1 at {100 * (detuning - 1):+.1f} % drift", scene.points, scene.null, detuning) for scene in alone]
    for speed_m_s in (0.05, 0.2):
        for _ in range(each):
            points = drawn(1, inner_m)
            made += _sliding(random, points[0], speed_m_s, null(points))
    add("random", lambda: drawn(int(random.integers(1, 11)), MARGIN_M), random_scenes)
    made.append(still("idle", (), (float(size[0]) / 2, float(size[1]) / 2)))
    return made


def _apart(random: np.random.Generator, fingers: int, near: Floats, far: Floats) -> list[Place]:
    """Random places at least `APART_M` from each other; closer on a plate that is too small for that."""
    apart_m = min(APART_M, 0.5 * float(np.sqrt(np.prod(far - near) / fingers)))
    while True:
        places = random.uniform(near, far, (fingers, 2))
        between_m = np.hypot(*(places[:, None] - places).transpose(2, 0, 1)) + np.eye(fingers)
        if between_m.min() >= apart_m:
            return [(x_m, y_m) for x_m, y_m in places.tolist()]


def _null(random: np.random.Generator, points: Sequence[Place], size: Floats) -> Place:
    """A place between 10 and 40 mm from the nearest point; the one farthest from them if there is none in 1000 tries."""
    best, place = -1.0, (0.0, 0.0)
    for x_m, y_m in random.uniform(MARGIN_M, size - MARGIN_M, (1000, 2)).tolist():
        nearest_m = min((float(np.hypot(x_m - px_m, y_m - py_m)) for px_m, py_m in points), default=NULL_M[0])
        if NULL_M[0] <= nearest_m <= NULL_M[1]:
            return x_m, y_m
        if nearest_m > best:
            best, place = nearest_m, (x_m, y_m)
    return place


def _near_edge(random: np.random.Generator, size: Floats) -> Place:
    """A place between `MARGIN_M` and `INNER_M` from the nearest edge."""
    while True:
        x_m, y_m = random.uniform(MARGIN_M, size - MARGIN_M).tolist()
        if min(x_m, y_m, size[0] - x_m, size[1] - y_m) <= INNER_M:
            return x_m, y_m


def motion_of(places_m: Floats, times_s: Reals) -> Motion:
    """What the product knows of a finger by its reports: (report, 2) and (report,)."""
    reports = zip(*places_m.T.tolist(), times_s.tolist(), strict=True)
    motion = Motion(*next(reports))
    for report in reports:
        motion.report(*report)
    return motion


def _sliding(random: np.random.Generator, point: Place, speed_m_s: float, null: Place) -> tuple[FingerScene, FingerScene]:
    """A finger that moves in a straight line and is at `point` at T: as predicted, and as last reported.

    The panel reports with lag, noise and steps.
    """
    around = float(random.uniform(0, 2 * np.pi))
    velocity = speed_m_s * np.array([np.cos(around), np.sin(around)])
    waited_s = float(random.uniform(0, REPORT_PERIOD_S))  # since the last report, when the emission is prepared
    arrived_s = (np.arange(REPORTS) - REPORTS + 1) * REPORT_PERIOD_S - waited_s - AHEAD_S  # before T
    places = np.array(point) + velocity * (arrived_s - LAG_S)[:, None] + random.normal(0, NOISE_M, (REPORTS, 2))
    places = np.rint(places / RESOLUTION_M) * RESOLUTION_M
    predicted = motion_of(places, arrived_s).predict(0.0, -AHEAD_S, LAG_S, REPORT_PERIOD_S)
    last = (float(places[-1, 0]), float(places[-1, 1]))
    family = f"1 sliding at {1e3 * speed_m_s:g} mm/s"
    return FingerScene(family, (point,), (predicted,), null), FingerScene(f"{family}, unpredicted", (point,), (last,), null)
