"""What the bits of an emission move on a plate that was measured: its field at T in cosines, and its sound, without any mode.

The displacement of cosine j at T by a bit of channel q and sample n is a sum over the lines k of a cosine transform along the
samples, `lines[n, k] * moved[k, j, q]`: measured responses end where the band does, so a third of the lines hold all of it.
"""

import io
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from controller.arrays import Floats
from controller.device.board.panel import CHANNELS
from controller.durable import write_durably
from controller.workshop.bank_builder.methods.exact import rounded

# With 1,024 lines and 4,096 cosines, sums of products stay below 2^53
TABLE_BITS = 15  # of lines and of what they move
STATE_BITS = 22  # of what is summed over samples
WANTED_BITS = 24
SAMPLES_AT_ONCE = 20  # of `MeasuredDrive.moves`


@dataclass(frozen=True)
class CosineShapes:
    """Shapes cos(pi x_index x / length) cos(pi y_index y / width)."""

    length_m: float
    width_m: float
    x_index: NDArray[np.int64]  # x_index, y_index: (cosine,)
    y_index: NDArray[np.int64]

    @property
    def count(self) -> int:
        """Number of shapes."""
        return len(self.x_index)

    @property
    def mean_square(self) -> Floats:
        """Mean over the plate of each shape squared: (cosine,)."""
        return np.where(self.x_index > 0, 0.5, 1.0) * np.where(self.y_index > 0, 0.5, 1.0)

    @property
    def factors(self) -> Self:
        """The factors of the shapes: `TensorFactors`."""
        return self

    def along_x(self, x_m: ArrayLike) -> Floats:
        """Factors along x at `x_m`, (point,): (point, factor)."""
        return np.cos(np.outer(np.asarray(x_m, np.float64), np.arange(self.x_index.max() + 1)) * (np.pi / self.length_m))

    def along_y(self, y_m: ArrayLike) -> Floats:
        """Factors along y at `y_m`, (point,): (point, factor)."""
        return np.cos(np.outer(np.asarray(y_m, np.float64), np.arange(self.y_index.max() + 1)) * (np.pi / self.width_m))

    def shapes(self, points_m: ArrayLike) -> Floats:
        """Shapes at `points_m`, (point, 2) in m: (point, cosine)."""
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        return self.along_x(points[:, 0])[:, self.x_index] * self.along_y(points[:, 1])[:, self.y_index]


@dataclass(frozen=True, eq=False)
class MeasuredPlate:
    """What is known of a measured plate, as far as entries are optimised by it."""

    shapes: CosineShapes
    samples: int  # of an emission
    moved: NDArray[np.float32]  # (line, cosine, 32): in m per V
    heard: Floats  # (bin, 32, 32): energy at the surface up to 20 kHz, of bins as `AudibleForm` has them, in any unit
    unforeseen: float  # share of the field's energy that points left out do not foresee of each other
    first_line: int = 0  # lines below are a model's

    @property
    def modes(self) -> int:
        """Rows of what is computed for each emission: lines."""
        return len(self.moved)

    @property
    def working_bytes(self) -> float:
        """Memory that optimising takes beside `WORKING_BYTES` of `descent`: itself, read again, and in double precision."""
        return 4.0 * self.moved.nbytes

    def write(self, path: Path) -> None:
        """Write a file for `read`; raises OSError."""
        shapes, data = self.shapes, io.BytesIO()
        indices = np.stack([shapes.x_index, shapes.y_index])
        sizes = np.array([shapes.length_m, shapes.width_m, self.samples, self.unforeseen, self.first_line])
        np.savez(data, indices=indices, sizes=sizes, moved=self.moved, heard=self.heard)
        write_durably(path, data.getvalue())

    @classmethod
    def read(cls, path: Path) -> Self:
        """What `write` has written; raises OSError or ValueError."""
        with np.load(path) as file:
            length_m, width_m, samples, unforeseen, first_line = file["sizes"].tolist()
            shapes = CosineShapes(length_m, width_m, *file["indices"])
            return cls(shapes, int(samples), file["moved"], file["heard"], unforeseen, int(first_line))


class MeasuredDrive:
    """What bits move each cosine, in a unit of this class: as `ModalDrive`."""

    def __init__(self, plate: MeasuredPlate, size: Floats) -> None:
        """`size` (cosine,): by which shapes are multiplied."""
        lines, samples = len(plate.moved), plate.samples
        turns = np.outer(np.arange(samples) + 0.5, np.arange(lines)) * (np.pi / samples)
        moved = plate.moved / size[:, None]
        moved *= 2.0 ** (TABLE_BITS - int(np.frexp(max(moved.max(), -moved.min()))[1]))
        self._moved: Floats = np.rint(moved, out=moved)
        squares = np.einsum("kjq,kjq->jq", moved, moved)  # whole numbers: exact
        most = float(np.sqrt(squares.max()))  # so that moves become as large as those of modes
        waves = np.rint(np.cos(turns) * 2.0**TABLE_BITS) * 2.0**-TABLE_BITS
        self._lines: Floats = waves * 2.0 ** (TABLE_BITS - int(np.frexp(most)[1]))
        self._block: tuple[int, Floats] = (-1, np.zeros(0))

    def moves(self, sample: int) -> Floats:
        """What one bit of a sample moves each cosine, (cosine, 32): whole numbers."""
        first = sample - sample % SAMPLES_AT_ONCE
        if self._block[0] != first:
            lines = self._lines[first : first + SAMPLES_AT_ONCE]
            block = np.rint(lines @ self._moved.reshape(len(self._moved), -1))
            self._block = (first, block.reshape(len(lines), -1, CHANNELS))
        table: Floats = self._block[1][sample - first]
        return table

    def modal(self, deviations: Floats, first_line: int = 0) -> Floats:
        """Displacement of each cosine by levels above idle, by lines from one on: (sample, cell, 32) to (cell, cosine)."""
        cells = deviations.shape[1]
        by_line = self._lines.T @ deviations.reshape(len(deviations), -1)
        by_line = rounded(by_line.reshape(-1, cells, CHANNELS), STATE_BITS, (0, 2))
        found = np.zeros((cells, self._moved.shape[1]))
        for of_line, moved in zip(by_line[first_line:], self._moved[first_line:], strict=True):
            found += of_line @ moved.T
        return found

    def gradient(self, wanted: Floats) -> Floats:
        """Sum over the cosines of `wanted`, (cell, cosine), times what each bit moves them: (sample, cell, 32)."""
        driven = rounded(np.matmul(rounded(wanted, WANTED_BITS, 1), self._moved), WANTED_BITS, (0, 2))
        return (self._lines @ driven.reshape(len(driven), -1)).reshape(len(self._lines), -1, CHANNELS)
