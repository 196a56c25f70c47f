"""Weights of cells in four bits, with a scale for each block of weights and channel; errors are passed on from cell to cell."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.device.bank.packing import CHANNELS, SCALE_BITS
from controller.device.kernel import compact_twin
from controller.workshop.bank_builder.compact.stencils import CompactStencil

Reals = NDArray[np.floating[Any]]

LOUDEST_RMS: Final = 2.5  # of a block: louder weights are cut
SCALES: Final = 255  # largest scale of a block, in 256ths of the cell's
PASSES: Final = 1  # in which cells are rounded again, each for the errors of all others


def rounded(weights: Reals, nx: int, block_rows: int, stencil: CompactStencil) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """Rows of a compact bank from the weights of all cells of a grid, (cell, weight, 32), row by row of `nx`.

    Returns the bytes (cell, byte), and for each cell m per V of a level (cell,).
    """
    cells, count, _ = weights.shape
    ny = cells // nx
    block_of = np.arange(count) // block_rows
    parts, scales = _scales(weights, block_of)
    numbers = np.zeros(weights.shape, np.uint8)
    rounding, errors = (np.zeros((ny, nx, count, CHANNELS), np.float32) for _ in range(2))
    for turn in range(1 + PASSES):
        others = stencil.together if turn else stencil.passed_on
        known = errors if turn else rounding
        for cell in range(cells):
            iy, ix = divmod(cell, nx)
            wanted = weights[cell].astype(np.float32)
            for dy, dx, share in others:
                if 0 <= iy + dy < ny and 0 <= ix + dx < nx:
                    wanted -= np.float32(share) * known[iy + dy, ix + dx]
            step = (parts[cell].astype(np.float32) * (scales[cell] / 256))[block_of]
            with np.errstate(divide="ignore", invalid="ignore"):
                half = np.floor(np.nan_to_num(wanted / (2 * step), posinf=0, neginf=0))
            numbers[cell] = np.clip(half + (compact_twin.LOUDEST + 1) // 2, 0, compact_twin.LOUDEST)
            played = (2 * numbers[cell].astype(np.float32) - compact_twin.LOUDEST) * step
            rounding[iy, ix], errors[iy, ix] = played - wanted, played - weights[cell]
    rows = np.zeros((cells, compact_twin.row_bytes(count, block_rows)), np.uint8)
    for cell in range(cells):
        rows[cell, : count * CHANNELS // 2] = compact_twin.packed(numbers[cell])
        rows[cell, count * CHANNELS // 2 :] = parts[cell][:, compact_twin.ORDER].ravel()
    return rows, scales


def _scales(weights: Reals, block_of: NDArray[np.intp]) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """Scales of blocks (cell, block, 32) in 256ths of the cells' own (cell,), which have 13 significant bits."""
    starts, sizes = np.flatnonzero(np.diff(block_of, prepend=-1)), np.bincount(block_of)[:, None]
    parts, scales = np.zeros((len(weights), len(starts), CHANNELS), np.uint8), np.zeros(len(weights), np.float32)
    for cell, own in enumerate(weights):
        level = np.sqrt(np.add.reduceat(own**2, starts, axis=0) / sizes) * (LOUDEST_RMS / compact_twin.LOUDEST)
        mantissa, exponent = math.frexp(float(level.max()) * 256 / SCALES)
        scale = np.float32(math.ldexp(math.ceil(math.ldexp(mantissa, SCALE_BITS)), exponent - SCALE_BITS))
        if scale >= np.finfo(np.float32).tiny:
            scales[cell], parts[cell] = scale, np.minimum(np.ceil(level * (256 / scale)), SCALES)
    return parts, scales
