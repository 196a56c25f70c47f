"""What a compact bank loses: its words against those of exact responses, at a sample of places, by the kernel that plays it."""

from __future__ import annotations

import math
from array import array
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.device import kernel
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.bank.packing import CHANNELS, channel_bits, drive_words
from controller.device.board.board import Board
from controller.workshop.bank_builder.compact.design import CompactDesign
from controller.workshop.bank_builder.interpolation_error import DIGITS
from controller.workshop.physics.responses.response_source import ResponseSource

PLACES: Final = 48
SEED: Final = 2  # other places than those from which pulses were learned


def loss(
    board: Board, source: ResponseSource, design: CompactDesign, there: NDArray[np.bool_], parts: tuple[Any, Any, bytes]
) -> dict[str, Any]:
    """Amplitude lost by words of a compact bank, as `InterpolationError.summary` reports it.

    `there` are cells that have rows; `parts` are rows (cell, byte), scales (cell,) and tables of all cells. Empty without a place.
    """
    words = bytearray(4 * design.samples)
    compose = _composing(board, design, there, parts, words)
    plate, samples = board.plate, design.samples
    points_m = np.random.default_rng(SEED).uniform((0, 0), (plate.length_m, plate.width_m), (PLACES, 2))
    grid = design.grid
    inside = (points_m >= (grid.x0_m, grid.y0_m)).all(axis=1)
    inside &= (points_m <= grid.place(grid.cells - 1)).all(axis=1)
    rows = samples + math.ceil(samples / REST_SAMPLES)
    lost = []
    for place in points_m[inside]:
        if not compose(tuple(place.tolist())):
            continue
        exact = source.entry_responses(place[None], out=np.empty((1, rows, CHANNELS), np.float32))[0].astype(np.float64)
        whole = exact[:samples] + np.repeat(exact[samples:], REST_SAMPLES, axis=0)[:samples]
        best, reached = (
            _displacement(some, whole, board.idle_word)
            for some in (drive_words(exact[:samples], board.idle_word), np.frombuffer(words, "<u4"))
        )
        lost.append(1 - reached / best if best else 0.0)
    if not lost:
        return {}
    worst, median = (round(float(of(lost)), DIGITS + 1) for of in (np.max, np.median))
    return {"places": len(lost), "interpolated": {"median": median, "worst": worst}}


def _composing(
    board: Board, design: CompactDesign, there: NDArray[np.bool_], parts: tuple[Any, Any, bytes], words: bytearray
) -> Any:
    """What composes a place (x_m, y_m) at full amplitude into `words`; False where a cell is missing."""
    rows, scales, tables = parts
    grid, samples = design.grid, design.samples
    stride = rows.shape[1]
    numbers = samples, stride, grid.nx, grid.ny, grid.cells, board.idle_word, kernel.GROUP_SAMPLES
    entries = array("i", np.where(there, np.arange(grid.cells), -1).tolist())
    bank = kernel.BankBuffers(
        kernel.PLAN.pack(*numbers, grid.pitch_m, grid.x0_m, grid.y0_m),
        memoryview(entries),
        memoryview(array("f", scales.tolist())),
        b"\1" * grid.cells,
        memoryview(rows).cast("B"),
        tables,
    )
    room = bytearray(kernel.room_bytes(samples))
    return lambda place: kernel.compose(words, room, bank, [(*place, 1.0)]) < 0


def _displacement(words: NDArray[np.uint32], whole: NDArray[np.float64], idle_word: int) -> float:
    idle_bits = channel_bits(np.array([idle_word], np.uint32))[0].astype(np.float64)
    return float(((channel_bits(words) - idle_bits) * whole).sum())
