"""Length and width of the glass, if they are not board.toml's: those with which its model best foresees points left out.

The corner at the origin, from which patches are measured, stays; the edges are taken to be of the stated kind. Glass of another
size is a little like other edges: it is to be believed where it foresees much better than waves in all directions do.
"""

from collections.abc import Callable
from typing import Final, NamedTuple, Self

import msgspec
import numpy as np

from controller.arrays import Floats
from controller.device.board.board import Board

COARSE_MM: Final = np.arange(-5.0, 6.0)
FINE_MM: Final = np.array([-0.5, 0.0, 0.5])
FINEST_MM: Final = 0.3 * FINE_MM  # the valley is skew: by the half millimetre its lowest place was up to 0.05 mm off in all bins
FRAME_SHARE: Final = 1.5  # of points' offset, by which glass seems larger: once for its far edge, twice for its middle
SEARCHES: Final = (COARSE_MM, COARSE_MM, FINE_MM, FINE_MM, FINEST_MM, FINEST_MM)  # of length and width in turn


class GlassSize(NamedTuple):
    """By how much the glass is larger than board.toml says, with standard deviations."""

    longer_mm: float
    wider_mm: float
    longer_error_mm: float = 0.0
    wider_error_mm: float = 0.0

    def of(self, board: Board) -> Board:
        """The board with this glass."""
        plate = board.plate
        there = msgspec.structs.replace(plate, length_mm=plate.length_mm + self.longer_mm, width_mm=plate.width_mm + self.wider_mm)
        return msgspec.structs.replace(board, plate=there)

    def in_frame(self, offset_error_m: tuple[float, float]) -> Self:
        """The same, of points whose offset is known to this."""
        x_mm, y_mm = (1e3 * FRAME_SHARE * error_m for error_m in offset_error_m)
        longer_mm, wider_mm = float(np.hypot(self.longer_error_mm, x_mm)), float(np.hypot(self.wider_error_mm, y_mm))
        return self._replace(longer_error_mm=longer_mm, wider_error_mm=wider_mm)

    def in_words(self) -> str:
        """Figures with their standard deviations."""
        longer = f"{self.longer_mm:+.2f} ± {self.longer_error_mm:.2f} mm longer"
        return f"{longer}, {self.wider_mm:+.2f} ± {self.wider_error_mm:.2f} mm wider"


def fit_size(
    board: Board,
    left: Callable[[Board], Floats],  # of the glass of a board: share of the energy that is not foreseen, (bin,)
    progress: Callable[[int, int], None] = lambda _done, _total: None,  # called with the work done and all of it
) -> GlassSize:
    """Search length, then width, then both finer; errors from the scatter over frequencies, as a jackknife."""
    size, error, done = np.zeros(2), np.zeros(2), 0
    for number, offsets_mm in enumerate(SEARCHES):
        axis = number % 2
        shares = []
        for off_mm in offsets_mm:
            there = size + off_mm * np.eye(2)[axis]
            shares.append(left(GlassSize(float(there[0]), float(there[1])).of(board)))
            progress(done := done + 1, sum(map(len, SEARCHES)))
        table = np.array(shares)  # (size, bin)
        if offsets_mm is COARSE_MM:
            size[axis] += offsets_mm[table.mean(axis=1).argmin()]
            continue
        without = [_lowest(offsets_mm, np.delete(table, bin_, axis=1).mean(axis=1)) for bin_ in range(table.shape[1])]
        error[axis] = np.sqrt((len(without) - 1) * np.var(without))
        size[axis] += _lowest(offsets_mm, table.mean(axis=1))
    return GlassSize(float(size[0]), float(size[1]), float(error[0]), float(error[1]))


def _lowest(offsets_mm: Floats, shares: Floats) -> float:
    """Lowest place of the parabola through the shares at three offsets, in mm; at most a step away."""
    before, here, after = shares.tolist()
    bend = before - 2 * here + after
    return float(np.clip(0.5 * (before - after) / bend, -1, 1) * offsets_mm[2]) if bend > 0 else 0.0
