"""Errors of all methods in each scene: what workers compute, a scene at a time, each process with a laboratory of its own."""

import hashlib
import json
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import controller
from controller.device.board.board import Board
from controller.device.kernel import Point
from controller.workshop.benchmark.fingers_scenes import FingerScene, scenes
from controller.workshop.benchmark.judge import Errors, Judge
from controller.workshop.benchmark.methods.candidate import Candidate
from controller.workshop.benchmark.methods.laboratory import Laboratory
from controller.workshop.benchmark.methods.registry import all_candidates


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


@dataclass(frozen=True)
class SceneErrors:
    """All that determines the errors: hashable, and the function that workers compute."""

    board: Board
    effort: Effort
    seed: int
    candidates: Callable[[Laboratory], list[Candidate]] = all_candidates  # makes the methods

    def __call__(self, items: Sequence[int]) -> list[bytes]:
        """Errors of each method that takes part in a scene, by its index, of scenes by their numbers."""
        return [json.dumps(bench_of(self).errors_in(number)).encode() for number in items]

    def name(self) -> str:
        """Hash of all that determines the results, which is all code of this package: the product's own methods are compared."""
        digest = hashlib.sha256(repr((self.board, self.effort, self.seed, self.candidates.__qualname__)).encode())
        for path in sorted(Path(controller.__file__).parent.rglob("*.[cp]*")):
            if path.suffix in {".c", ".py"}:
                digest.update(path.read_bytes())
        return digest.hexdigest()[:16]


class SceneEvaluation:
    """The scenes of a benchmark, its methods, and who finds their errors."""

    def __init__(self, given: SceneErrors) -> None:
        board, effort = given.board, given.effort
        self.scenes = scenes(board, given.seed, effort.each, effort.random_scenes)
        self.laboratory = Laboratory(board, [place for scene in self.scenes for place in scene.needed])
        self.methods = [method for method in given.candidates(self.laboratory) if effort.slow_methods or not method.slow]
        self.judge = Judge(board, {scene.detuning for scene in self.scenes})
        seen: Counter[str] = Counter()
        self._tabled = set()  # scenes in which methods from tables take part
        for number, scene in enumerate(self.scenes):
            seen[scene.family] += 1
            if seen[scene.family] <= effort.tabled_scenes:
                self._tabled.add(number)

    def errors_in(self, number: int) -> dict[int, Errors]:
        """Errors of those methods, by their index, that take part in a scene."""
        scene, tabled = self.scenes[number], number in self._tabled
        able = {
            index: method
            for index, method in enumerate(self.methods)
            if len(scene.points) <= method.most_fingers and (tabled or not method.tabled)
        }
        self.laboratory.prepare(scene.expected if tabled else [])
        words = [method.words_of(method.run(full(scene), scene.null)) for method in able.values()]
        several = len(scene.points) > 1
        evaluated = self.judge.errors(scene, words, [method.free_polarity and several for method in able.values()])
        return dict(zip(able, evaluated, strict=True))


@lru_cache(maxsize=1)
def bench_of(given: SceneErrors) -> SceneEvaluation:
    """That of a process: it takes ten seconds."""
    return SceneEvaluation(given)


def full(scene: FingerScene) -> list[Point]:
    """The places where fingers are expected, each at full amplitude."""
    return [(x_m, y_m, 1.0) for x_m, y_m in scene.expected]
