"""Work-precision figures: time, memory, bytes and energy of every method against the errors of its drive words.

In the manner of the SciML benchmarks: one curve for each method, one point for each of its settings, and the Pareto front of
those that no other one beats in both. `haptic-panel benchmark` runs it; `work_precision_diagrams` draws it.
"""

import itertools
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from controller.device.board.board import Board
from controller.device.kernel import Point
from controller.workshop.benchmark.baselines import Baselines
from controller.workshop.benchmark.building import building_figures
from controller.workshop.benchmark.device.interleaved import CallTiming, interleaved
from controller.workshop.benchmark.environment import environment
from controller.workshop.benchmark.fingers_scenes import FINGERS, FingerScene, scenes
from controller.workshop.benchmark.judge import Errors, Judge
from controller.workshop.benchmark.methods.candidate import Candidate
from controller.workshop.benchmark.methods.laboratory import Laboratory
from controller.workshop.benchmark.methods.registry import all_candidates
from controller.workshop.benchmark.pareto import AXES, front
from controller.workshop.benchmark.processes import USABLE, in_processes

Figures = dict[str, Any]
Progress = Callable[[int, int], None]
TabledScene = tuple[FingerScene, bool]  # and whether methods from tables of responses take part in it
SCHEMA_VERSION = 1
PLACES_AT_ONCE = 90  # whose cells are held: 0.7 GB; all that --quick needs, so that none are computed twice
BETTER_HIGH = {"contrast", "amplitude_over_unfiltered", "felt_um"}  # the worst of these is the smallest


@dataclass(frozen=True)
class Effort:
    """How much is measured."""

    each: int  # scenes of each family
    random_scenes: int  # further scenes of one to ten fingers
    tabled_scenes: int  # scenes of each family in which methods from tables of responses take part
    timed_scenes: int  # scenes of each number of fingers on which methods are timed
    turns: int  # calls of each method for each of them
    longest_s: float  # of timing a method for one number of fingers, beyond its first turns
    slow_methods: bool  # whether methods that take tenths of a second take part


QUICK = Effort(each=8, random_scenes=8, tabled_scenes=2, timed_scenes=2, turns=5, longest_s=0.2, slow_methods=False)
FULL = Effort(each=8, random_scenes=100, tabled_scenes=100, timed_scenes=3, turns=25, longest_s=0.5, slow_methods=True)


def work_precision(
    board: Board,
    effort: Effort,
    seed: int = 1,  # of the scenes. Errors of equal seeds are equal
    *,
    timing: bool = True,  # whether times are measured, by this process alone
    processes: int = USABLE,  # that evaluate scenes
    candidates: Callable[[Laboratory], list[Candidate]] = all_candidates,  # makes the methods
    progress: Progress = lambda _done, _total: None,  # called with what is done and all there is to do
) -> Figures:
    """Measure errors and costs of all methods. Plain values, as `tests/workshop/benchmark/work_precision.schema.json` says."""
    surroundings = environment()  # first: the load of the machine is still that of others
    drawn = scenes(board, seed, effort.each, effort.random_scenes)
    places = [place for scene in drawn for place in scene.needed]
    with threadpool_limits(1, "blas"), tempfile.TemporaryDirectory() as folder:
        laboratory = Laboratory(board, Path(folder), places)
        try:
            methods = [method for method in candidates(laboratory) if effort.slow_methods or not method.slow]
            judge = Judge(board, {scene.detuning for scene in drawn})
            off_grid = _off_grid(drawn)
            done, total = itertools.count(1), len(drawn) + (len(off_grid) * effort.turns if timing else 0)

            def step() -> None:
                progress(next(done), total)

            found = _errors(laboratory, judge, methods, _tabled(drawn, effort.tabled_scenes), processes, step)
            times: dict[int, dict[int, CallTiming]] = {}
            measured: Figures = {"baselines": [], "left_out": [], "machine": {}, "building": []}
            if timing:
                times, measured = _timings(laboratory, Path(folder), judge, methods, off_grid, effort, step)
        finally:
            laboratory.close()
    settings = [_setting(method, index, found[index], times, measured["baselines"]) for index, method in enumerate(methods)]
    families = dict.fromkeys(scene.family for scene in drawn)
    return {
        "version": SCHEMA_VERSION,
        "board": board.name,
        "seed": seed,
        "effort": asdict(effort),
        "environment": surroundings,
        "modes": judge.modes,
        "modes_in_band": judge.modes_in_band,
        "scenes": {family: sum(scene.family == family for scene in drawn) for family in families},
        "settings": settings,
        **measured,
        "fronts": _fronts(settings, families),
    }


def _timings(
    laboratory: Laboratory,
    folder: Path,
    judge: Judge,
    methods: Sequence[Candidate],
    off_grid: dict[int, list[FingerScene]],
    effort: Effort,
    step: Callable[[], None],
) -> tuple[dict[int, dict[int, CallTiming]], Figures]:
    """Times of methods, by number of fingers and by their index; and of all else that is timed, as `work_precision` returns it."""
    board = laboratory.board
    machine = Baselines(board, laboratory.bank(board.bank.pitch_mm * 1e-3), folder)
    times: dict[int, dict[int, CallTiming]] = {}
    baselines: list[Figures] = []
    for count, some in off_grid.items():
        times[count], besides = _times(laboratory, machine, methods, count, some, effort, step)
        baselines += besides
    return times, {
        "baselines": baselines,
        "left_out": machine.left_out,
        "machine": machine.rates(judge.modes),
        "building": building_figures(board, judge, off_grid.get(1, [])),
    }


def _off_grid(drawn: Sequence[FingerScene]) -> dict[int, list[FingerScene]]:
    """Scenes between the cells of a bank, by their number of fingers: those on which methods are timed."""
    found = {count: [scene for scene in drawn if scene.family == f"{count} off grid"] for count in FINGERS}
    return {count: some for count, some in found.items() if some}


def _fronts(settings: Sequence[Figures], families: Iterable[str]) -> dict[str, list[int]]:
    """`front` of each axis and family; nothing is compared on a plate that idles."""
    return {f"{axis}, {family}": front(settings, axis, family) for axis in AXES for family in families if family != "idle"}


def _full(scene: FingerScene) -> list[Point]:
    return [(x_m, y_m, 1.0) for x_m, y_m in scene.expected]


def _errors(
    laboratory: Laboratory,
    judge: Judge,
    methods: Sequence[Candidate],
    drawn: Sequence[TabledScene],
    processes: int,
    step: Callable[[], None],
) -> list[dict[str, list[Errors]]]:
    """Errors of each method by family."""
    found: list[dict[str, list[Errors]]] = [{} for _ in methods]
    for some in _at_once(drawn):
        laboratory.prepare([place for scene, tabled in some if tabled for place in scene.expected])
        evaluated = in_processes(partial(_judged, judge, methods), some, processes)
        for (scene, _), errors in zip(some, evaluated, strict=True):
            for index, one in errors.items():
                found[index].setdefault(scene.family, []).append(one)
            step()
    return found


def _judged(judge: Judge, methods: Sequence[Candidate], given: TabledScene) -> dict[int, Errors]:
    """Errors of those methods, by their index, that take part in a scene."""
    scene, tabled = given
    able = {
        index: method
        for index, method in enumerate(methods)
        if len(scene.points) <= method.most_fingers and (tabled or not method.tabled)
    }
    words = [method.words_of(method.run(_full(scene), scene.null)) for method in able.values()]
    evaluated = judge.errors(scene, words, [method.free_polarity and len(scene.points) > 1 for method in able.values()])
    return dict(zip(able, evaluated, strict=True))


def _tabled(drawn: Sequence[FingerScene], most: int) -> list[TabledScene]:
    """Scenes with a finger, and whether methods from tables take part: in a number of scenes of each family."""
    seen: Counter[str] = Counter()
    found = []
    for scene in drawn:
        if scene.points:
            seen[scene.family] += 1
            found.append((scene, seen[scene.family] <= most))
    return found


def _at_once(drawn: Sequence[TabledScene]) -> Iterator[list[TabledScene]]:
    """Successive scenes whose cells are held together."""
    some: list[TabledScene] = []
    places = 0
    for scene, tabled in drawn:
        more = len(scene.points) * tabled
        if some and places + more > PLACES_AT_ONCE:
            yield some
            some, places = [], 0
        some.append((scene, tabled))
        places += more
    if some:
        yield some


def _times(
    laboratory: Laboratory,
    machine: Baselines,
    methods: Sequence[Candidate],
    fingers: int,
    timed: Sequence[FingerScene],
    effort: Effort,
    step: Callable[[], None],
) -> tuple[dict[int, CallTiming], list[Figures]]:
    """Times of methods, by their index, and of the baselines, all taking turns."""
    timed = timed[: effort.timed_scenes]
    laboratory.prepare([place for scene in timed for place in scene.expected])
    able = [index for index, method in enumerate(methods) if fingers <= method.most_fingers]
    jobs: list[list[Callable[[], object]]] = [[_call(methods[index], scene) for scene in timed] for index in able]
    besides = machine.jobs([_full(scene) for scene in timed])
    timings = interleaved([*jobs, *(job.calls for job in besides)], effort.turns, effort.longest_s, step)
    rows = [
        {"name": job.name, "fingers": fingers, **asdict(timing)} for job, timing in zip(besides, timings[len(able) :], strict=True)
    ]
    return dict(zip(able, timings, strict=False)), rows


def _call(method: Candidate, scene: FingerScene) -> Callable[[], object]:
    points, null = _full(scene), scene.null
    return lambda: method.run(points, null)


def _setting(
    method: Candidate,
    index: int,
    errors: dict[str, list[Errors]],
    times: dict[int, dict[int, CallTiming]],
    baselines: Sequence[Figures],
) -> Figures:
    time_us = {}
    for count, timings in times.items():
        if index in timings:
            timing = timings[index]
            over = {row["name"]: timing.median_us / max(row["median_us"], 1e-3) for row in baselines if row["fingers"] == count}
            time_us[str(count)] = {**asdict(timing), "over": over}
    return {
        "curve": method.curve,
        "setting": method.setting,
        "memory_bytes": method.memory_bytes,
        "wire_bytes": method.wire_bytes,
        "time_us": time_us,
        "families": {family: _summary(some) for family, some in errors.items()},
    }


def _summary(errors: Sequence[Errors]) -> Figures:
    """Median and worst of each error."""
    found: Figures = {}
    for name in errors[0]:
        values = [error[name] for error in errors]
        found[name] = {
            "median": float(np.median(values)),
            "worst": float(min(values) if name in BETTER_HIGH else max(values)),
        }
    return found
