"""Responses of points that lie in rows, as the cells of a grid do: two small GEMMs in place of a large one.

A mode's shape is sin(m pi x / a) sin(n pi y / b), so the sum over modes can be taken over n first, once
for each row of points with the same y, and then over m for each point: some 15 times fewer
multiplications than the sum over all modes at every point, and each of them still in a GEMM.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.board.panel import CHANNELS
from controller.physics.plate import PlateModes

Reals = NDArray[np.floating[Any]]

SAMPLES_PER_GEMM = 16  # 512 columns: large enough for full speed, small enough to stay in the cache
POINTS_PER_ROW = 8  # fewer points a row than this on average, and the one large GEMM is as fast


def in_rows(points_m: NDArray[np.float64]) -> bool:
    """Whether enough of `points_m`, (point, 2), share their y for `responses_in_rows` to be faster."""
    return len(points_m) >= POINTS_PER_ROW * len(np.unique(points_m[:, 1]))


def responses_in_rows(
    modes: PlateModes, forces: NDArray[np.float64], kernel: Reals, points_m: NDArray[np.float64], out: Reals
) -> None:
    """Fill `out` (point, sample, 32) with sum over modes of shape(point) kernel(sample) force(channel).

    Parameters
    ----------
    forces : (mode, 32) array
    kernel : (sample, mode) array
    points_m : (point, 2) array
        In any order; fastest when the points of a row follow each other.
    out : (point, sample, 32) array, C-contiguous, of the kernel's type
    """
    kind = kernel.dtype
    samples = len(kernel)
    x_orders, y_orders = int(modes.x_order.max()), int(modes.y_order.max())
    place = (modes.x_order - 1) * y_orders + modes.y_order - 1  # modes as a rectangle of orders, zero where there is none
    by_order = np.zeros((x_orders * y_orders, samples), kind)
    by_order[place] = kernel.T
    force_by_order = np.zeros((x_orders * y_orders, CHANNELS), kind)
    force_by_order[place] = forces

    rows_m, row_of = np.unique(points_m[:, 1], return_inverse=True)
    y_sines = modes.y_sines(rows_m).astype(kind)
    members = [_slice_or_index(np.flatnonzero(row_of == row)) for row in range(len(rows_m))]
    x_sines = [modes.x_sines(points_m[some, 0]).astype(kind) for some in members]

    flat = out.reshape(len(points_m), samples * CHANNELS)
    driven = np.empty((x_orders * y_orders, SAMPLES_PER_GEMM, CHANNELS), kind)
    summed = np.empty((x_orders, len(rows_m), SAMPLES_PER_GEMM * CHANNELS), kind)
    for first in range(0, samples, SAMPLES_PER_GEMM):
        last = min(first + SAMPLES_PER_GEMM, samples)
        columns = (last - first) * CHANNELS
        part = driven[:, : last - first]
        np.multiply(by_order[:, first:last, None], force_by_order[:, None, :], out=part)
        np.matmul(y_sines, part.reshape(x_orders, y_orders, columns), out=summed[:, :, :columns])
        for row, (some, sines) in enumerate(zip(members, x_sines, strict=True)):
            if isinstance(some, slice):
                np.matmul(sines, summed[:, row, :columns], out=flat[some, first * CHANNELS : last * CHANNELS])
            else:
                flat[some, first * CHANNELS : last * CHANNELS] = sines @ summed[:, row, :columns]


def _slice_or_index(index: NDArray[np.intp]) -> slice | NDArray[np.intp]:
    """The same points as a slice where they follow each other: a view, so that a GEMM can write to it."""
    first, last = int(index[0]), int(index[-1])
    return slice(first, last + 1) if last - first == len(index) - 1 else index
