"""Weights of cells in four bits, each block of a channel with a scale of its own; errors of cells and weights balance each other.

What counts is the error between cells, a sum over cells and pulses, so each weight is rounded for the errors of all others, in
turns, those of cells that no place shares at once (coordinate descent).
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Indices, Reals
from controller.device.bank.packing import CHANNELS, SCALE_BITS
from controller.device.kernel import compact_twin
from controller.workshop.bank_builder.compact.stencils import CompactStencil

LOUDEST_RMS: Final = 2.5  # of a block: louder weights are cut; times one of these, whichever leaves the least error
TRIED: Final = (0.75, 0.85, 0.95, 1.05, 1.2)
BASES: Final = 255  # largest scale of a channel, in 256ths of the cell's
PASSES: Final = 3
LEAST_TOGETHER: Final = 1e-3  # of two weights: less is left out


def rounded(
    weights: Reals, nx: int, block_rows: int, stencil: CompactStencil, together: Reals
) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
    """Rows of a compact bank from the weights of all cells of a grid, (cell, weight, 32), row by row of `nx`.

    `together` is as of `Pulses`. Returns the bytes (cell, byte), and for each cell m per V of a level (cell,).
    """
    cells, count, _ = weights.shape
    block_of = np.arange(count) // block_rows
    bases, parts, scales = _scales(weights, block_of)
    steps = (scales / 256)[:, None, None] * bases[:, None, :] * ((parts + np.float32(1)) / np.float32(16))
    played = _Descent(weights.reshape(-1, nx, count, CHANNELS), steps.reshape(-1, nx, *steps.shape[1:]), block_of)
    for _ in range(PASSES):
        played.improve(stencil, together)
    numbers = played.numbers().reshape(weights.shape)
    rows = np.zeros((cells, compact_twin.row_bytes(count, block_rows)), np.uint8)
    for cell in range(cells):
        packed = compact_twin.packed(numbers[cell]), bases[cell, compact_twin.ORDER], compact_twin.packed(parts[cell])
        rows[cell] = np.concatenate(packed)
    return rows, scales


class _Descent:
    """Errors of all weights, which shrink; `steps` (row, column, block, 32) are half the distances of levels."""

    def __init__(self, weights: Reals, steps: Reals, block_of: Indices) -> None:
        self._weights, self._steps, self._block_of = weights, steps, block_of
        reach = compact_twin.MAX_ACROSS
        ny, nx, count, channels = weights.shape
        self._padded = np.zeros((ny + 2 * reach, nx + 2 * reach, count, channels), np.float32)
        self._errors = self._padded[reach : reach + ny, reach : reach + nx]
        self._errors[:] = _level(weights, steps[:, :, block_of]) - weights

    def improve(self, stencil: CompactStencil, together: Reals) -> None:
        """Round every weight again for the errors of all others."""
        share = (together / together.diagonal()[:, None]).astype(np.float32)
        met = np.abs(np.subtract(*np.nonzero(np.abs(share) > LEAST_TOGETHER))).max()
        for first_y in range(stencil.across):
            for first_x in range(stencil.across):
                self._improve_apart(
                    (slice(first_y, None, stencil.across), slice(first_x, None, stencil.across)), stencil, share, met
                )

    def _improve_apart(self, some: tuple[slice, slice], stencil: CompactStencil, share: Reals, met: int) -> None:
        """The same of cells that no place shares."""
        own, weights, steps = self._errors[some], self._weights[some], self._steps[some]
        total, reach, (ny, nx) = own.copy(), compact_twin.MAX_ACROSS, self._errors.shape[:2]
        for dy, dx, part in stencil.together:
            shifted = self._padded[reach + dy : reach + dy + ny, reach + dx : reach + dx + nx]
            total += np.float32(part) * shifted[some]
        for weight in range(total.shape[2]):
            near = slice(max(0, weight - met), weight + met + 1)
            of_others = np.tensordot(total[:, :, near], share[weight, near], (2, 0)) - own[:, :, weight]
            wanted = weights[:, :, weight]
            error = _level(wanted - of_others, steps[:, :, self._block_of[weight]]) - wanted
            total[:, :, weight] += error - own[:, :, weight]
            own[:, :, weight] = error

    def numbers(self) -> NDArray[np.uint8]:
        """Numbers of the levels, 0 to 15."""
        steps = np.maximum(self._steps, np.finfo(np.float32).tiny)[:, :, self._block_of]
        found = np.rint(((self._weights + self._errors) / steps + compact_twin.LOUDEST) / 2)
        return np.clip(found, 0, compact_twin.LOUDEST).astype(np.uint8)


def _level(wanted: Reals, steps: Reals) -> Reals:
    """The nearest level."""
    half = (compact_twin.LOUDEST + 1) // 2
    with np.errstate(divide="ignore", invalid="ignore"):
        number = np.clip(np.floor(np.nan_to_num(wanted / (2 * steps), posinf=0, neginf=0)), -half, half - 1)
    return (2 * number + 1) * steps


def _scales(weights: Reals, block_of: Indices) -> tuple[NDArray[np.uint8], NDArray[np.uint8], NDArray[np.float32]]:
    """Scales of channels (cell, 32), of blocks (cell, block, 32), and of cells (cell,).

    Those of channels are 256ths of the cells', which have 13 significant bits; those of blocks 16ths of these, less 1.
    """
    starts, sizes = np.flatnonzero(np.diff(block_of, prepend=-1)), np.bincount(block_of)[:, None]
    bases, scales = np.zeros((len(weights), CHANNELS), np.uint8), np.zeros(len(weights), np.float32)
    parts = np.zeros((len(weights), len(starts), CHANNELS), np.uint8)
    for cell, own in enumerate(weights):
        level = np.sqrt(np.add.reduceat(own**2, starts, axis=0) / sizes) * (LOUDEST_RMS / compact_twin.LOUDEST)
        tried = np.array(TRIED)[:, None, None] * level
        errors = [np.add.reduceat((_level(own, one[block_of]) - own) ** 2, starts, axis=0) for one in tried]
        level = np.take_along_axis(tried, np.argmin(errors, axis=0)[None], 0)[0]
        mantissa, exponent = math.frexp(float(level.max()) * 256 / BASES)
        scale = np.float32(math.ldexp(math.ceil(math.ldexp(mantissa, SCALE_BITS)), exponent - SCALE_BITS))
        if scale < np.finfo(np.float32).tiny:
            continue
        scales[cell], bases[cell] = scale, np.minimum(np.ceil(level.max(axis=0) * (256 / scale)), BASES)
        base = np.maximum(bases[cell] * (scale / 256), np.finfo(np.float32).tiny)
        parts[cell] = np.clip(np.rint(level / base * 16) - 1, 0, compact_twin.LOUDEST)
    return bases, parts, scales
