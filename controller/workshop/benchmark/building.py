"""What building a bank costs against what its responses lose: number of modes, precision, pitch.

Processor time is that of the responses of a block of rows, for as many rows as the whole grid has. The loss is that of one finger
whose words are the sign of such a response at its very place, in the band; of a pitch, interpolation included.
"""

import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from controller.device.bank.grid import Grid
from controller.device.bank.packing import drive_words
from controller.device.board.board import Board
from controller.workshop.benchmark.fingers_scenes import FingerScene
from controller.workshop.benchmark.judge import Judge
from controller.workshop.physics.responses.impulse_response import ResponseModel

Figures = dict[str, Any]
ABOVE_BAND_HZ = (-20e3, -10e3, -5e3, 0.0, 2e3, 4e3)  # highest mode, from the upper edge of the band on
ROWS = 2
PITCHES_MM = (1.0, 2.0, 2.5, 3.5, 5.0)
REPEATS = 2


def building_figures(board: Board, judge: Judge, drawn: Sequence[FingerScene]) -> list[Figures]:
    """Costs and losses of ways to build.

    Each scene has one finger. Figures: `curve`, `setting`, `seconds` of building the board's grid, `loss`: median of `bound_loss`;
    None for a pitch, whose loss is that of the methods that interpolate.
    """
    pitch_m = board.bank.pitch_mm * 1e-3
    found = []
    whole = ResponseModel(board)
    highest_hz = board.waveform.band_high_hz
    models = [
        (ResponseModel(board, highest_hz + above_hz), "float32", f"to {1e-3 * (highest_hz + above_hz):g} kHz")
        for above_hz in ABOVE_BAND_HZ
    ]
    models += [(whole, "float32", "all modes"), (whole, "float64", "all modes")]
    lost = []
    for scene in drawn:
        words = [
            drive_words(model.drive_order_responses(scene.expected, dtype=kind)[0], board.idle_word) for model, kind, _ in models
        ]
        lost.append([errors["bound_loss"] for errors in judge.errors(scene, words, [False] * len(words))])
    for (model, kind, label), losses in zip(models, np.transpose(lost).tolist(), strict=True):
        found.append(
            {
                "curve": f"number of modes, {kind}",
                "setting": f"{model.modes}, {label}",
                "seconds": _seconds(board, model, pitch_m, kind),
                "loss": float(np.median(losses)),
            }
        )
    for pitch_mm in PITCHES_MM:
        seconds = _seconds(board, whole, pitch_mm * 1e-3, "float32")
        found.append({"curve": "pitch, float32, all modes", "setting": f"{pitch_mm:g} mm", "seconds": seconds, "loss": None})
    return found


def _seconds(board: Board, model: ResponseModel, pitch_m: float, kind: str) -> float:
    """Processor time of all responses of a grid, from that of its first rows."""
    grid = Grid.of(board.plate, pitch_m)
    rows = min(ROWS, grid.ny)
    points_m = grid.points()[: rows * grid.nx]
    best = float("inf")
    for _ in range(REPEATS):
        begin = time.thread_time()
        model.drive_order_responses(points_m, dtype=kind)
        best = min(best, time.thread_time() - begin)
    return best * grid.ny / rows
