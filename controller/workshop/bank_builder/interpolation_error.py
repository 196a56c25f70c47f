"""What a bank's pitch costs: foci between cells against exact ones there, at a sample of places, while the bank is built.

A focus between cells is composed from the four responses around it, or is that of the nearest cell. What of the exact focus's
displacement it reaches falls with the pitch over the wavelength, to nothing and below.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Floats, Indices, Reals
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.bank.grid import Grid
from controller.device.bank.packing import as_words, channel_bits, drive_words
from controller.device.board.board import Board
from controller.device.board.relations.bank import coarse
from controller.errors import ConfigError
from controller.workshop.physics.responses.response_source import ResponseSource

ROWS, PLACES_PER_ROW = 6, 8  # of the sample: 48 places; those of a row share their y, which makes their responses cheap
SEED = 1
WARN_WORST_ERROR = 0.05  # the worst place of the sample loses more than this: the builder warns
DIGITS = 3  # of what a bank tells: the rest differs between machines


@dataclass(frozen=True, eq=False)
class InterpolationError:
    """Amplitude lost at places between cells, 1 - A / A_exact, with A_exact that of the sign of the exact response there."""

    distance_m: Floats  # (place,): from each place to the nearest cell
    # interpolated, nearest: (place,): of the sign of the four responses around, interpolated; of the nearest cell's own words
    interpolated: Floats
    nearest: Floats

    def within(self, snap_m: float) -> Floats:
        """Error of each place, (place,), where a finger at most `snap_m` from a cell plays that cell."""
        return np.where(self.distance_m <= snap_m, self.nearest, self.interpolated)

    def summary(self) -> dict[str, Any]:
        """For a bank's parameters: number of places, median and worst error of both; empty without a place."""
        if not len(self.distance_m):
            return {}
        figures: dict[str, Any] = {"places": len(self.distance_m)}
        for name, errors in (("interpolated", self.interpolated), ("nearest_cell", self.nearest)):
            figures[name] = {"median": round(float(np.median(errors)), DIGITS), "worst": round(float(errors.max()), DIGITS)}
        return figures


def interpolation_error(board: Board, source: ResponseSource, grid: Grid, cells: Bools) -> InterpolationError:
    """Evaluate a grid at random places between the `cells` (cells of the grid,) that are built.

    A place is evaluated where all four around it are; there may be none.
    """
    distances, interpolated, nearest = [], [], []
    for row, places_m in _sample(grid, cells):
        columns = np.array([(place[0] - grid.x0_m) // grid.pitch_m for place in places_m], int)
        firsts = row * grid.nx + columns
        exact = _responses(board, source, places_m)
        pairs = [np.concatenate([firsts + by, firsts + by + 1]) for by in (0, grid.nx)]  # of one y each, which makes them cheap
        around = np.stack([_responses(board, source, _cell_places(grid, pair)) for pair in pairs])
        around = around.reshape(4, len(firsts), *around.shape[2:])
        for index, (x_m, y_m) in enumerate(places_m.tolist()):
            weights = np.array(grid.corners(x_m, y_m)[1], np.float32)
            rests = np.repeat(exact[index, board.waveform.samples :], REST_SAMPLES, axis=0)[: board.waveform.samples]
            here, four = exact[index, : board.waveform.samples], around[:, index, : board.waveform.samples]
            reached = [
                _displacement(drive_words(response, board.idle_word), here + rests, board.idle_word)
                for response in (here, np.tensordot(weights, four, 1), four[int(weights.argmax())])
            ]
            distances.append(grid.nearest(x_m, y_m)[1])
            interpolated.append(1 - reached[1] / reached[0] if reached[0] else 0.0)
            nearest.append(1 - reached[2] / reached[0] if reached[0] else 0.0)
    return InterpolationError(np.array(distances), np.array(interpolated), np.array(nearest))


def _sample(grid: Grid, cells: Bools) -> list[tuple[int, Floats]]:
    """Rows of the grid, and places in the squares above each, (place, 2), all of one y."""
    if grid.nx < 2 or grid.ny < 2:
        return []
    there = cells.reshape(grid.ny, grid.nx)
    squares = there[:-1, :-1] & there[:-1, 1:] & there[1:, :-1] & there[1:, 1:]
    random = np.random.default_rng(SEED)
    rows = np.flatnonzero(squares.any(axis=1))
    if not rows.size:
        return []
    sample = []
    chosen = random.choice(rows, ROWS, replace=len(rows) < ROWS)
    for row, beyond in zip(chosen.tolist(), random.permutation(ROWS).tolist(), strict=True):
        columns = random.choice(np.flatnonzero(squares[row]), PLACES_PER_ROW)
        x_m = grid.x0_m + (columns + (random.permutation(PLACES_PER_ROW) + 0.5) / PLACES_PER_ROW) * grid.pitch_m
        y_m = grid.y0_m + (row + (beyond + 0.5) / ROWS) * grid.pitch_m
        sample.append((row, np.column_stack([x_m, np.full(PLACES_PER_ROW, y_m)])))
    return sample


def _cell_places(grid: Grid, cells: Indices) -> Floats:
    return np.array([grid.place(cell) for cell in cells.tolist()])


def _responses(board: Board, source: ResponseSource, places_m: Floats) -> Reals:
    rows = board.waveform.samples + math.ceil(board.waveform.samples / REST_SAMPLES)
    return source.entry_responses(places_m, out=np.empty((len(places_m), rows, board.channels), np.float32))


def _displacement(words: NDArray[np.uint32], whole: Reals, idle_word: int) -> float:
    """Displacement at T from rest at the idle word, for each volt, of words at a place with a whole response (sample, channel)."""
    idle_bits = channel_bits(as_words(idle_word, words))[0].astype(np.float32)
    return float(np.vdot(channel_bits(words) - idle_bits, whole))


def interpolation_warning(summary: dict[str, Any]) -> str:
    """Why a bank should have a smaller pitch, by the `summary` of its error; empty: it need not."""
    if not summary or summary["interpolated"]["worst"] <= WARN_WORST_ERROR:
        return ""
    lost = summary["interpolated"]
    return (
        f"a finger between cells loses {100 * lost['median']:.3g} % of its amplitude, {100 * lost['worst']:.3g} % at the worst of"
        f" {summary['places']} places (more than {100 * WARN_WORST_ERROR:g} %): a smaller pitch serves it better"
    )


def refuse_coarse(board: Board, pitch_m: float) -> None:
    """Refuse a pitch that is not the board's own by the relation that its own keeps (`panel_relations.coarse`).

    Raises ConfigError.
    """
    for why in coarse(board, pitch_m * 1e3):
        raise ConfigError(f"board {board.name!r}: {why}")
