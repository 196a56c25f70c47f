"""Optimised drive words of many cells, kept in a file beside the bank until the bank is there (`workshop/workers/`).

Of a measured plate, its field lies in a file beside that, which all who compute read.

A cell's words do not depend on where and with which others they are computed (`workshop/bank_builder/methods/exact.py`).
"""

import glob
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from controller.arrays import Floats, Words
from controller.device.bank.packing import WORD, channel_bits
from controller.device.board.board import Board
from controller.errors import WorkersError
from controller.workshop.bank_builder.methods.aims import DescentAim
from controller.workshop.bank_builder.methods.descent import CELLS_AT_ONCE, Descent
from controller.workshop.bank_builder.methods.field_form import FieldForm
from controller.workshop.bank_builder.methods.measured_plate import MeasuredPlate
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.workers.map_kept import Mapped, map_kept
from controller.workshop.workers.workers import Workers

Cell = tuple[Any, ...]  # x_m, y_m; where the plate was measured, its plain drive words too

# Raised whenever the words that methods/ finds for a cell change; an optimised bank of another version is optimised again.
# tests/workshop/bank_builder/test_optimised.py has the words of this version.
METHOD_VERSION = 2
CELLS_OF_A_STRANGER = 8  # some seconds of work
OF_BUILD = ("words", "plate", "cells")  # ends of the names of files that are there while a bank is built


@dataclass(frozen=True)
class Optimise:
    """All that determines the words of cells but where these lie."""

    board: Board
    highest_hz: float
    aim: DescentAim
    plate: Path | None = None  # file of a measured plate, in place of the board's model

    def __call__(self, cells: Sequence[Cell]) -> list[bytes]:
        """Drive words of some cells."""
        plain = np.stack([np.frombuffer(cell[2], WORD) for cell in cells]) if self.plate else None
        entries = self.method.entries([cell[:2] for cell in cells], plain)
        return [np.ascontiguousarray(words, WORD).tobytes() for words in entries]

    @property
    def method(self) -> Descent:
        """What does it; kept."""
        return _method(self.board, self.highest_hz, self.aim, self.plate)


def reported(board: Board, aim: DescentAim, plate: MeasuredPlate | None = None) -> dict[str, Any]:
    """What determines the words besides the board's physics and the cell, for a bank: aim, limit, version of the method.

    Of a measured plate, also the share of the field's energy that its points do not foresee.
    """
    found = {**asdict(aim), "max_edge_rate_hz": board.limits.max_edge_rate_hz, "method": METHOD_VERSION}
    return found if plate is None else found | {"unforeseen": plate.unforeseen}


@lru_cache(maxsize=1)
def _method(board: Board, highest_hz: float, aim: DescentAim, file: Path | None) -> Descent:
    if file is None:
        return Descent(board, ResponseModel(board, highest_hz), aim)
    try:
        return Descent(board, MeasuredPlate.read(file), aim)
    except (OSError, ValueError) as error:
        raise WorkersError(
            f"{file}: a worker cannot read it ({error}): let all workers mount the folder at the same path"
        ) from error


def kept_path(bank: Path, inputs_sha256: str, end: str = "words") -> Path:
    """File that keeps what is done of the bank at `bank`, by the hash of all that determines it; `end`: one of `OF_BUILD`."""
    return bank.with_name(f".{bank.name}.{inputs_sha256[:16]}.{end}")


def remove_kept(bank: Path) -> None:
    """Remove what is kept of any build of the bank at `bank`."""
    for end in OF_BUILD:
        for file in bank.parent.glob(f".{glob.escape(bank.name)}.*.{end}"):
            file.unlink(missing_ok=True)


def optimised_words(
    optimise: Optimise, cells: Mapping[int, Cell], kept: Path, workers: Workers, *, progress: bool = False
) -> tuple[Words, Mapped]:
    """Optimise the entries of some cells, by number: (cell, sample), the same bits whoever does it, and who did.

    Parameters and errors as of `map_kept`.
    """
    mapped = map_kept(
        optimise,
        cells,
        kept,
        workers,
        at_once=CELLS_OF_A_STRANGER if workers.strangers else CELLS_AT_ONCE,
        what=f"optimised, {optimise.aim.name}" if progress else "",
        unit="cell",
    )
    words: Words = np.frombuffer(b"".join(mapped.results[number] for number in cells), WORD)
    return words.reshape(len(cells), -1), mapped


def contrast_of_plain(form: FieldForm, plate: MeasuredPlate, points_m: Floats, plain: Words, words: Words) -> dict[str, float]:
    """Median contrast of optimised drive words over that of plain ones, (cell, sample) each, on a measured plate.

    `by_responses`: as the field is interpolated, with the amplitude that was measured. `with_error`: besides, the share that is not
    foreseen is as strong as under plain words.
    """
    places, shapes = [form.surroundings(point_m) for point_m in points_m], form.shapes(points_m)
    amplitude, field = np.empty((2, 2, len(places)))
    for index, some in enumerate((plain, words)):
        levels = np.stack([channel_bits(one) for one in some], axis=1).astype(np.float64)
        amplitude[index] = np.sum(shapes * form.modal(levels, plate.first_line), axis=1)
        field[index] = form.mean_square(form.modal(levels), places)
    moves = (field[0] > 0) & (amplitude[0] > 0)
    louder, left = amplitude[1][moves] / amplitude[0][moves], field[1][moves] / field[0][moves]
    sure = (1 - plate.unforeseen) * left + plate.unforeseen
    return {
        "by_responses": round(float(np.median(louder / np.sqrt(left))), 3),
        "with_error": round(float(np.median(louder / np.sqrt(sure))), 3),
    }
