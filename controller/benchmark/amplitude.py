"""What composing from a bank reaches on the plate: amplitudes asked for and got, places between cells, edges.

Everything is judged by responses of the whole displacement in float64, all modes, at the very points:
none of it goes through the bank.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from controller.bank.grid import Grid
from controller.bank.packing import WORD, edges
from controller.bank.reader import Bank
from controller.bank_builder.build import build_bank
from controller.benchmark.focus_figures import emit, random_points, spread
from controller.board.board import Board
from controller.physics.plate_twin import PlateTwin
from controller.waveforms.composition import Composer
from controller.waveforms.selection import REUSE_RADIUS_M

Floats = NDArray[np.float64]
Figures = dict[str, Any]
Words = NDArray[np.uint32]

MARGIN_M = 12e-3  # of fingers that are composed, from the plate's edges
APART_M = 8e-3  # fingers nearer than this are no two fingers
FINGERS = (1, 2, 4, 10)
AMPLITUDES = (0.25, 0.5, 0.75, 1.0)


def amplitude_figures(board: Board, seed: int, scenes: int = 20, pitch_m: float | None = None) -> Figures:
    """Figures over random scenes, none left out.

    Parameters
    ----------
    scenes : int
        Of each number of fingers; so many single points are judged, too.
    pitch_m : float, optional
        Of the bank, which holds only the cells that are needed; the board's own by default.

    Returns
    -------
    dict
        `fingers`: for each number, `asked` and `got`, shares of what exact composition gives each finger at full
        amplitude, and `error_percent`. `single`: by amplitude, contrast and spot over those of full amplitude, edges.
        `between_cells`: relative amplitude interpolated and of the nearest entry, and what `REUSE_RADIUS_M` beside loses.
    """
    random = np.random.default_rng(seed)
    played = [[_scene(board, random, fingers) for _ in range(scenes)] for fingers in FINGERS]
    singles = random_points(board, seed, scenes)
    around = random.uniform(0, 2 * np.pi, scenes)
    beside = singles + REUSE_RADIUS_M * np.column_stack([np.cos(around), np.sin(around)])
    places = np.concatenate([np.array(scene)[:, :2] for some in played for scene in some] + [singles, beside])
    with threadpool_limits(1, "blas"), tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bank"
        pitch_m = board.bank.pitch_mm * 1e-3 if pitch_m is None else pitch_m
        build_bank(board, path, pitch_m, _cells(board, places, pitch_m), measure_sgemm=False)
        with Bank.open(path, board) as bank:
            composer, twin = Composer(bank, board.idle_word), PlateTwin(board)
            return {
                "seed": seed,
                "scenes": scenes,
                "pitch_mm": pitch_m * 1e3,
                "fingers": {str(len(some[0])): _mixed(composer, twin, some) for some in played},
                "single": {f"{amplitude:g}": _single(composer, twin, singles, amplitude) for amplitude in AMPLITUDES},
                "between_cells": _between_cells(bank, composer, twin, singles, beside),
            }


def _scene(board: Board, random: np.random.Generator, fingers: int) -> list[tuple[float, float, float]]:
    """Fingers at random places that are apart, with random amplitudes from 0.25 to 1."""
    far = np.array([board.plate.length_m, board.plate.width_m]) - MARGIN_M
    while True:
        places = random.uniform(MARGIN_M, far, (fingers, 2))
        between_m = np.hypot(*(places[:, None] - places).transpose(2, 0, 1)) + np.eye(fingers)
        if between_m.min() >= APART_M:
            return [(float(x_m), float(y_m), float(random.uniform(0.25, 1))) for x_m, y_m in places]


def _cells(board: Board, places: Floats, pitch_m: float) -> NDArray[np.bool_]:
    """Those that the places need."""
    grid = Grid.of(board.plate, pitch_m)
    cells = np.zeros(grid.cells, bool)
    for x_m, y_m in places.tolist():
        cells[list(grid.corners(x_m, y_m)[0])] = True
    return cells


def _words(composer: Composer, scene: list[tuple[float, float, float]]) -> Words:
    return np.frombuffer(composer.compose(scene), WORD).astype(np.uint32)


def _mixed(composer: Composer, twin: PlateTwin, scenes: list[list[tuple[float, float, float]]]) -> Figures:
    """Amplitudes of fingers that each ask for their own."""
    asked: list[float] = []
    got: list[float] = []
    for scene in scenes:
        places = tuple((x_m, y_m) for x_m, y_m, _ in scene)
        got.extend(emit(twin, _words(composer, scene)).at(places) / twin.exact_amplitudes(places))
        asked.extend(amplitude for _, _, amplitude in scene)
    error = 100 * np.abs(np.array(got) / asked - 1)
    percent = spread(error.tolist()) | {"p95": float(np.quantile(error, 0.95))}
    return {"error_percent": percent, "asked": asked, "got": [float(share) for share in got]}


def _single(composer: Composer, twin: PlateTwin, points: Floats, amplitude: float) -> Figures:
    """One finger: what is left of contrast and spot, and of edges from the idle word and back to it."""
    idle = np.array([twin.board.idle_word], np.uint32)
    contrast, spot, busiest, together = [], [], [], []
    for x_m, y_m in points.tolist():
        words, full = (_words(composer, [(x_m, y_m, share)]) for share in (amplitude, 1.0))
        less, most = (emit(twin, some).focus_metrics(x_m, y_m) for some in (words, full))
        contrast.append(less.contrast / most.contrast)
        spot.append(less.spot_m / most.spot_m)
        counts = edges(np.concatenate([idle, words, idle]))
        busiest.append(float(counts.max()))
        together.append(float(counts.sum()))
    figures = {"contrast_of_full": contrast, "spot_of_full": spot, "edges_busiest_channel": busiest, "edges_all": together}
    return {name: spread(values) for name, values in figures.items()}


def _between_cells(bank: Bank, composer: Composer, twin: PlateTwin, points: Floats, beside: Floats) -> Figures:
    """Relative amplitude of points wherever they lie, at full amplitude."""
    interpolated, nearest, near = [], [], []
    for (x_m, y_m), (other_x_m, other_y_m) in zip(points.tolist(), beside.tolist(), strict=True):
        reference_m = twin.reference_amplitude(x_m, y_m)
        entry = np.frombuffer(bank.words(bank.grid.nearest(x_m, y_m)[0]), WORD)
        here, cell, there = (
            float(emit(twin, words).at([(x_m, y_m)])[0])
            for words in (_words(composer, [(x_m, y_m, 1.0)]), entry, _words(composer, [(other_x_m, other_y_m, 1.0)]))
        )
        interpolated.append(here / reference_m)
        nearest.append(cell / reference_m)
        near.append(there / here)
    return {
        "interpolated": spread(interpolated),
        "nearest_entry": spread(nearest),
        f"{REUSE_RADIUS_M * 1e3:g}_mm_beside": spread(near),
    }
