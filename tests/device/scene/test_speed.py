"""Benchmarks: `pytest -o addopts=--import-mode=importlib --benchmark-only tests/device/scene/test_speed.py`."""

import pytest

from controller.device.loop.playing.batching import select_batch
from controller.device.scene.emission import Emission
from controller.device.scene.fingers import ActiveEffects
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.touch.source import TouchSample

REPORTS = 1000


@pytest.fixture(scope="module")
def scene(board):
    return load_scene(find_scene(board, board.scene), board)


@pytest.mark.parametrize("way", ["over seven keys", "along the slider", "at rest"])
def test_a_thousand_touch_reports(benchmark, scene, way):
    x_m, y_m, step_m = {
        "over seven keys": (0.005, 0.03, 2.6e-3),
        "along the slider": (0.073, 0.09, 0.2e-3),
        "at rest": (0.1, 0.12, 0),
    }[way]
    samples = [TouchSample(1, x_m + (k * step_m) % 0.11, y_m, k * 1e-3, True) for k in range(REPORTS)]

    def slide():
        finger = ActiveEffects(scene, 1, x_m, y_m)
        finger.press(0.0)
        for _, x, y, time_s, _, _ in samples:
            finger.move(x, y, time_s)

    benchmark(slide)


def test_a_thousand_pulses_of_a_train(benchmark, scene):
    def pulse():
        active = ActiveEffects(scene, "command 1", 0.1, 0.1)
        active.start("train", 1.0, 0.0, ticket=1)
        for k in range(REPORTS):
            active.advance(k * 0.02)

    benchmark(pulse)


@pytest.mark.parametrize("count", [1, 4, 10])
def test_choose_what_plays_together(benchmark, count):
    due = [Emission(0.0, 0.02 * k, 0.07, k, "r", owner=k) for k in range(count)]
    benchmark(select_batch, due, 2e-3)
