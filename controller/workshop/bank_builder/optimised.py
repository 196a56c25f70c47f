"""Optimised drive words of many cells, kept in a file beside the bank until the bank is there (`workshop/workers/`).

A cell's words do not depend on where and with which others they are computed (`workshop/bank_builder/methods/exact.py`).
"""

from __future__ import annotations

import glob
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.device.bank.packing import WORD
from controller.device.board.board import Board
from controller.workshop.bank_builder.methods.descent import CELLS_AT_ONCE, Descent, DescentAim
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.workers.map_kept import Mapped, map_kept
from controller.workshop.workers.workers import Workers

Words = NDArray[np.uint32]
Point = tuple[float, float]

# Raised whenever the words that methods/ finds for a cell change; an optimised bank of another version is optimised again.
# tests/workshop/bank_builder/test_optimised.py has the words of this version.
METHOD_VERSION = 2
CELLS_OF_A_STRANGER = 8  # some seconds of work


@dataclass(frozen=True)
class Optimise:
    """All that determines the words of cells but where these lie."""

    board: Board
    highest_hz: float
    aim: DescentAim

    def __call__(self, points_m: Sequence[Point]) -> list[bytes]:
        """Drive words of the cells at some points, (x_m, y_m) each."""
        entries = _method(self.board, self.highest_hz, self.aim).entries(points_m)
        return [np.ascontiguousarray(words, WORD).tobytes() for words in entries]


def reported(board: Board, aim: DescentAim) -> dict[str, Any]:
    """What determines the words besides the board's physics and the cell, for a bank: aim, limit, version of the method."""
    return {**asdict(aim), "max_edge_rate_hz": board.limits.max_edge_rate_hz, "method": METHOD_VERSION}


@lru_cache(maxsize=1)
def _method(board: Board, highest_hz: float, aim: DescentAim) -> Descent:
    return Descent(board, ResponseModel(board, highest_hz), aim)


def kept_path(bank: Path, inputs_sha256: str) -> Path:
    """File that keeps what is done of the bank at `bank`, by the hash of all that determines it."""
    return bank.with_name(f".{bank.name}.{inputs_sha256[:16]}.words")


def remove_kept(bank: Path) -> None:
    """Remove what is kept of any build of the bank at `bank`."""
    for file in bank.parent.glob(f".{glob.escape(bank.name)}.*.words"):
        file.unlink(missing_ok=True)


def optimised_words(
    optimise: Optimise, points_m: Mapping[int, Point], kept: Path, workers: Workers, *, progress: bool = False
) -> tuple[Words, Mapped]:
    """Optimise the entries of the cells at `points_m`, by number: (cell, sample), the same bits whoever does it, and who did.

    Parameters and errors as of `map_kept`.
    """
    mapped = map_kept(
        optimise,
        points_m,
        kept,
        workers,
        at_once=CELLS_OF_A_STRANGER if workers.strangers else CELLS_AT_ONCE,
        what=f"optimised, {optimise.aim.name}" if progress else "",
        unit="cell",
    )
    words: Words = np.frombuffer(b"".join(mapped.results[number] for number in points_m), WORD)
    return words.reshape(len(points_m), -1), mapped
