"""Responses of points that lie in rows, as the cells of a grid do: small GEMMs in place of a large one.

Where a mode's shape is a product of a factor along x and one along y, the sum over modes can be taken over y's factors first, once
for each row of points with the same y, and then over x's for each point: some 15 times fewer multiplications than the sum over all
modes at every point, and each of them still in a GEMM. The products of kernel and force are never written out: the forces of the
modes of one factor along x, weighted for a row, are the right factor of a GEMM whose left factor is the kernel of those modes.
"""

from itertools import pairwise

import numpy as np

from controller.arrays import Floats, Indices, Reals
from controller.workshop.physics.modes.modes import TensorFactors

POINTS_PER_ROW = 8  # fewer points a row than this on average, and the one large GEMM is as fast


def in_rows(points_m: Floats) -> bool:
    """Whether enough of `points_m`, (point, 2), share their y for `RowResponses` to be faster."""
    return len(points_m) >= POINTS_PER_ROW * len(np.unique(points_m[:, 1]))


class RowResponses:
    """Sum over modes of shape(point) kernel(sample) force(channel), for points in rows.

    `factors` are those of the modes' shapes, `forces` (mode, channel), `kernel` (sample, mode) in float32 or float64, the type of
    the result.
    """

    def __init__(self, factors: TensorFactors, forces: Floats, kernel: Reals) -> None:
        by_order = np.argsort(factors.x_index, kind="stable")
        ends = np.searchsorted(factors.x_index[by_order], np.arange(factors.x_index.max() + 2)).tolist()
        self._factors = factors
        self._y_index = factors.y_index[by_order]
        self._forces = forces[by_order].astype(kernel.dtype)
        self._kernel = np.ascontiguousarray(kernel[:, by_order])
        self._orders = [slice(first, last) for first, last in pairwise(ends)]  # the modes of each factor along x
        self._summed = np.empty((len(self._orders), len(kernel), forces.shape[1]), kernel.dtype)

    def fill(self, points_m: Floats, out: Reals) -> None:
        """Compute the responses of points (point, 2), fastest when the points of a row follow each other.

        `out` (point, sample, channel) is C-contiguous, of the kernel's type.
        """
        kernel, summed = self._kernel, self._summed
        rows_m, row_of = np.unique(points_m[:, 1], return_inverse=True)
        y_factors = self._factors.along_y(rows_m).astype(kernel.dtype)
        x_factors = self._factors.along_x(points_m[:, 0]).astype(kernel.dtype)
        flat_sum, flat = summed.reshape(len(summed), -1), out.reshape(len(points_m), -1)
        for row, along_y in enumerate(y_factors[:, self._y_index]):
            weighted = along_y[:, None] * self._forces
            for order, some in enumerate(self._orders):
                np.matmul(kernel[:, some], weighted[some], out=summed[order])
            members = _slice_or_index(np.flatnonzero(row_of == row))
            if isinstance(members, slice):
                np.matmul(x_factors[members], flat_sum, out=flat[members])
            else:
                flat[members] = x_factors[members] @ flat_sum


def _slice_or_index(index: Indices) -> slice | Indices:
    """The same points as a slice where they follow each other: a view, so that a GEMM can write to it."""
    first, last = int(index[0]), int(index[-1])
    return slice(first, last + 1) if last - first == len(index) - 1 else index
