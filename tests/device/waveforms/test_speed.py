"""Benchmarks: `pytest -o addopts=--import-mode=importlib --benchmark-only tests/device/waveforms/test_speed.py`."""

import zlib

import numpy as np
import pytest

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.waveforms.composition import Composer

GRID = Grid(5e-3, 7, 6, 5e-3, 6e-3)


@pytest.fixture(scope="module")
def bank(tmp_path_factory, make_bank):
    path = tmp_path_factory.mktemp("bank") / "bank"
    make_bank(path, GRID, samples=1000)
    with Bank.open(path) as opened:
        yield opened


def test_frames_of_a_cell(benchmark, bank):
    benchmark(bank.drive.frames, 20)


def places(count):
    return np.random.default_rng(count).uniform([6e-3, 7e-3], [34e-3, 30e-3], (count, 2)).tolist()


@pytest.mark.parametrize("amplitude", [1.0, 0.5])
@pytest.mark.parametrize("count", [1, 2, 4, 10])
def test_compose(benchmark, bank, count, amplitude):
    benchmark(Composer(bank, 0).compose, [(*place, amplitude) for place in places(count)])


@pytest.mark.parametrize("count", [1, 2, 4, 10])
def test_copy_of_the_responses_that_are_composed(benchmark, bank, count):
    """What composing cannot do without: every byte of four cells for each point is read once."""
    patches = [[bank.responses.response(cell)[0] for cell in bank.grid.corners(*place)[0]] for place in places(count)]
    room = np.empty_like(patches[0][0])

    def read():
        for patch in patches:
            for levels in patch:
                np.copyto(room, levels)

    benchmark(read)


def test_memcpy_and_crc_of_the_same_bytes(benchmark, bank):
    words, copy = bank.drive.words(20), memoryview(bytearray(4000))

    def copy_and_check():
        copy[:] = words
        return zlib.crc32(copy)

    benchmark(copy_and_check)
