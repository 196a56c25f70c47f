"""Benchmarks: `pytest -o addopts=--import-mode=importlib --benchmark-only tests/bank/test_speed.py`."""

import zlib

import numpy as np
import pytest

from controller.bank.composition import Composer
from controller.bank.grid import Grid
from controller.bank.reader import Bank

GRID = Grid(5e-3, 7, 6, 5e-3, 6e-3)


@pytest.fixture(scope="module")
def bank(tmp_path_factory, make_bank):
    path = tmp_path_factory.mktemp("bank") / "bank"
    make_bank(path, GRID, samples=1000)
    with Bank.open(path) as opened:
        yield opened


def test_words_of_a_cell(benchmark, bank):
    benchmark(bank.words, 20)


@pytest.mark.parametrize("count", [1, 2, 4, 10])
def test_compose(benchmark, bank, count):
    points = [(*place, 1.0) for place in np.random.default_rng(count).uniform([6e-3, 7e-3], [34e-3, 30e-3], (count, 2)).tolist()]
    benchmark(Composer(bank, 0).compose, points)


def test_memcpy_and_crc_of_the_same_bytes(benchmark, bank):
    words, copy = bank.words(20), memoryview(bytearray(4000))

    def copy_and_check():
        copy[:] = words
        return zlib.crc32(copy)

    benchmark(copy_and_check)
