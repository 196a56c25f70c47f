"""Work-precision figures: time, memory, bytes and energy of every method against the errors of its drive words.

In the manner of the SciML benchmarks: one curve for each method, one point for each of its settings, and the Pareto front of
those that no other one beats in both. `haptic-panel benchmark` runs it; `work_precision_diagrams` draws it.
"""

import itertools
import json
import tempfile
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from controller.device.board.board import Board
from controller.workshop.benchmark.baselines import Baselines
from controller.workshop.benchmark.building import building_figures
from controller.workshop.benchmark.device.interleaved import CallTiming, interleaved
from controller.workshop.benchmark.environment import environment
from controller.workshop.benchmark.fingers_scenes import FINGERS, FingerScene, scenes
from controller.workshop.benchmark.judge import Errors
from controller.workshop.benchmark.methods.candidate import Candidate
from controller.workshop.benchmark.methods.laboratory import Laboratory
from controller.workshop.benchmark.methods.registry import all_candidates
from controller.workshop.benchmark.pareto import AXES, front
from controller.workshop.benchmark.scene_errors import Effort, SceneErrors, SceneEvaluation, bench_of, full
from controller.workshop.workers.map_kept import map_kept
from controller.workshop.workers.workers import ALONE, Workers

Figures = dict[str, Any]
Progress = Callable[[int, int], None]
SCHEMA_VERSION = 1
KEPT = ".*.scenes"
BETTER_HIGH = {"contrast", "amplitude_over_unfiltered", "felt_um"}  # the worst of these is the smallest

QUICK = Effort(each=8, random_scenes=8, tabled_scenes=2, timed_scenes=2, turns=5, longest_s=0.2, slow_methods=False)
FULL = Effort(each=8, random_scenes=100, tabled_scenes=100, timed_scenes=3, turns=25, longest_s=0.5, slow_methods=True)


def work_precision(
    board: Board,
    effort: Effort,
    seed: int = 1,  # of the scenes. Errors of equal seeds are equal
    *,
    kept: Path,  # folder in which the errors of each scene are kept as they come; the caller removes what `KEPT` matches there
    timing: bool = True,  # whether times are measured, by this process alone
    workers: Workers = ALONE,  # who finds errors
    candidates: Callable[[Laboratory], list[Candidate]] = all_candidates,  # makes the methods
    progress: Progress = lambda _done, _total: None,  # called with the turns of timing that are done and all there are
) -> Figures:
    """Measure errors and costs of all methods. Plain values, as `tests/workshop/benchmark/work_precision.schema.json` says.

    Raises what `map_kept` raises.
    """
    surroundings = environment()  # first: the load of the machine is still that of others
    given = SceneErrors(board, effort, seed, candidates)
    drawn = scenes(board, seed, effort.each, effort.random_scenes)
    touched = {number: number for number, scene in enumerate(drawn) if scene.points}
    mapped = map_kept(given, touched, kept / KEPT.replace("*", given.name()), workers, what="scenes", unit="scene")
    with threadpool_limits(1, "blas"):
        bench = bench_of(given)
    found: list[dict[str, list[Errors]]] = [{} for _ in bench.methods]
    for number in touched:
        for index, errors in json.loads(mapped.results[number]).items():
            found[int(index)].setdefault(drawn[number].family, []).append(errors)
    times: dict[int, dict[int, CallTiming]] = {}
    measured: Figures = {"baselines": [], "left_out": [], "machine": {}, "building": []}
    if timing:
        off_grid = _off_grid(drawn)
        done, total = itertools.count(1), len(off_grid) * effort.turns
        with threadpool_limits(1, "blas"), tempfile.TemporaryDirectory() as folder:
            times, measured = _timings(bench, Path(folder), off_grid, effort, lambda: progress(next(done), total))
    settings = [_setting(method, index, found[index], times, measured["baselines"]) for index, method in enumerate(bench.methods)]
    families = dict.fromkeys(scene.family for scene in drawn)
    return {
        "version": SCHEMA_VERSION,
        "board": board.name,
        "seed": seed,
        "effort": asdict(effort),
        "environment": surroundings,
        "workers": mapped.figures(),
        "modes": bench.judge.modes,
        "modes_in_band": bench.judge.modes_in_band,
        "scenes": {family: sum(scene.family == family for scene in drawn) for family in families},
        "settings": settings,
        **measured,
        "fronts": _fronts(settings, families),
    }


def _timings(
    bench: SceneEvaluation,
    folder: Path,
    off_grid: dict[int, list[FingerScene]],
    effort: Effort,
    step: Callable[[], None],
) -> tuple[dict[int, dict[int, CallTiming]], Figures]:
    """Times of methods, by number of fingers and by their index; and of all else that is timed, as `work_precision` returns it."""
    board = bench.laboratory.board
    machine = Baselines(board, bench.laboratory.bank(board.bank.pitch_mm * 1e-3), folder)
    times: dict[int, dict[int, CallTiming]] = {}
    baselines: list[Figures] = []
    for count, some in off_grid.items():
        times[count], besides = _times(bench, machine, count, some, effort, step)
        baselines += besides
    return times, {
        "baselines": baselines,
        "left_out": machine.left_out,
        "machine": machine.rates(bench.judge.modes),
        "building": building_figures(board, bench.judge, off_grid.get(1, [])),
    }


def _off_grid(drawn: Sequence[FingerScene]) -> dict[int, list[FingerScene]]:
    """Scenes between the cells of a bank, by their number of fingers: those on which methods are timed."""
    found = {count: [scene for scene in drawn if scene.family == f"{count} off grid"] for count in FINGERS}
    return {count: some for count, some in found.items() if some}


def _fronts(settings: Sequence[Figures], families: Iterable[str]) -> dict[str, list[int]]:
    """`front` of each axis and family; nothing is compared on a plate that idles."""
    return {f"{axis}, {family}": front(settings, axis, family) for axis in AXES for family in families if family != "idle"}


def _times(
    bench: SceneEvaluation,
    machine: Baselines,
    fingers: int,
    timed: Sequence[FingerScene],
    effort: Effort,
    step: Callable[[], None],
) -> tuple[dict[int, CallTiming], list[Figures]]:
    """Times of methods, by their index, and of the baselines, all taking turns."""
    timed = timed[: effort.timed_scenes]
    methods = bench.methods
    bench.laboratory.prepare([place for scene in timed for place in scene.expected])
    able = [index for index, method in enumerate(methods) if fingers <= method.most_fingers]
    jobs: list[list[Callable[[], object]]] = [[_call(methods[index], scene) for scene in timed] for index in able]
    besides = machine.jobs([full(scene) for scene in timed])
    timings = interleaved([*jobs, *(job.calls for job in besides)], effort.turns, effort.longest_s, step)
    rows = [
        {"name": job.name, "fingers": fingers, **asdict(timing)} for job, timing in zip(besides, timings[len(able) :], strict=True)
    ]
    return dict(zip(able, timings, strict=False)), rows


def _call(method: Candidate, scene: FingerScene) -> Callable[[], object]:
    points, null = full(scene), scene.null
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
