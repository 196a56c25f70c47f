"""Banks of random responses, and of smooth ones: for tests of the file and of what is composed from it."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from controller.device.bank.file_format import Header, creator
from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS, drive_words, quantise
from controller.device.bank.provenance import as_parameter
from controller.device.board.board import Board
from controller.workshop.bank_builder.writer import BankWriter

IDLE_WORD = 0x69969669
MakeBank = Callable[..., dict[int, np.ndarray]]
WAVE_SAMPLES = 200


@pytest.fixture(scope="session")
def make_bank(board: Board) -> MakeBank:
    """Write a bank of random responses, or of those given, with nothing outside the band; returns the responses by cell."""

    def make(
        path: Path,
        grid: Grid | None = None,
        cells=None,
        samples=9,
        seed=0,
        responses=None,
        rests=None,
        digest=None,
        compositions=None,
        provenance=None,
        **reported,
    ):
        grid = grid or Grid(5e-3, 3, 2, 5e-3, 6e-3)
        cells = np.ones(grid.cells, bool) if cells is None else np.asarray(cells, bool)
        if responses is None:
            random = np.random.default_rng(seed)
            responses = {int(c): 1e-9 * random.standard_normal((samples, CHANNELS)) for c in np.flatnonzero(cells)}
        reported = {"board": "simulated", "channel_edges": samples + 1, "all_edges": CHANNELS} | reported
        if provenance is not None:
            reported["responses"] = as_parameter(provenance)
        composed = compositions or {}
        header = Header(creator(), digest or board.digest(), grid, 500e3, samples, len(responses), reported, len(composed))
        with BankWriter(path, header, cells) as writer:
            for cell, response in responses.items():
                rest = np.zeros((header.rest_rows, CHANNELS)) if rests is None else rests[cell]
                writer.add(cell, drive_words(response, IDLE_WORD), *quantise(np.concatenate([response, rest])))
            for points, words in composed.items():
                writer.add_composition(points, words)
        return responses

    return make


class Waves:
    """Plane waves of 10-25 mm in random directions: responses as smooth over the plate as the real ones."""

    def __init__(self, seed: int, modes: int = 60) -> None:
        random = np.random.default_rng(seed)
        angle, length_m = random.uniform(0, 2 * np.pi, modes), random.uniform(10e-3, 25e-3, modes)
        self.wave = 2 * np.pi / length_m * np.array([np.cos(angle), np.sin(angle)])
        self.phase = random.uniform(0, 2 * np.pi, modes)
        self.time = np.exp(2j * np.pi * np.outer(random.uniform(0.04, 0.14, modes), np.arange(WAVE_SAMPLES)))
        self.coupling = 1e-10 * (random.standard_normal((modes, CHANNELS)) + 1j * random.standard_normal((modes, CHANNELS)))

    def at(self, x_m: float, y_m: float) -> np.ndarray:
        shape = np.cos(np.array([x_m, y_m]) @ self.wave + self.phase)
        return np.einsum("m,mn,mq->nq", shape, self.time, self.coupling).real


@pytest.fixture(scope="session")
def waves() -> Waves:
    return Waves(3)
