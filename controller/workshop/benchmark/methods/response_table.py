"""Responses of a grid's cells in 8, 4, 2 or 1 bits a sample, for the cells that scenes need.

A response decays as the plate does, exp(-t / tau), in all cells alike. A factor that all responses of a sample have in common
changes no sign of their sum, so responses are stored flat, divided by that decay: fewer bits then serve early and late samples
alike.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Indices, Reals
from controller.device.bank.grid import Grid
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.workshop.physics.responses.impulse_response import ResponseModel

Floats = NDArray[np.float32]
CELLS_AT_ONCE = 256
# Loudest level in units of the rms that is not cut: 8 bits up to the maximum, fewer by what distorts a normal distribution least
LOUDEST_RMS = {4: 2.6, 2: 1.494, 1: 0.798}


@dataclass(frozen=True)
class Stencil:
    """Cells around a point and the weights with which their responses are summed."""

    cells: Indices
    weights: Floats


class ResponseTable:
    """Packed responses of some cells of a grid.

    Each value has 8, 4, 2 or 1 bits; with a `projection` (coefficient, sample), coefficients are kept in place of samples.
    """

    def __init__(self, board: Board, pitch_m: float, bits: int, projection: Floats | None = None) -> None:
        self.grid = Grid.of(board.plate, pitch_m)
        self._bits = bits
        self._projection = projection
        rows = board.waveform.samples if projection is None else len(projection)
        self._row_bytes = rows * CHANNELS * bits // 8
        # Of all cells of the grid, not only of those that are here
        self.memory_bytes = self.grid.cells * (self._row_bytes + 4)  # with a scale each
        self._row_of = np.full(self.grid.cells, -1)
        self._scale = np.zeros(0, np.float32)
        self._packed = np.zeros((0, self._row_bytes), np.uint8)
        self._held: list[tuple[NDArray[np.uint8], Floats]] = []

    def hold(self, cells: Indices, flat: Reals) -> None:
        """Take the responses of further cells: (cell, sample, 32), in drive order, flat; `take` after the last of them."""
        values = flat if self._projection is None else np.matmul(self._projection, flat)
        packed, scale = pack(values.reshape(len(cells), -1), self._bits)
        self._row_of[cells] = np.arange(len(cells)) + sum(len(some) for _, some in self._held)
        self._held.append((packed, scale))

    def take(self) -> None:
        """All cells are there."""
        if self._held:
            self._packed, self._scale = (np.concatenate(some) for some in zip(*self._held, strict=True))
            self._held.clear()

    def forget(self) -> None:
        """Let all cells go."""
        self._row_of[:] = -1
        self._scale, self._packed = np.zeros(0, np.float32), np.zeros((0, self._row_bytes), np.uint8)
        self._held.clear()

    def interpolate(self, stencil: Stencil, first_sample: int = 0) -> Floats:
        """Flat response of a place, from the row of `first_sample` on: (values,)."""
        rows = self._row_of[stencil.cells]
        levels = unpack(self._packed[rows, first_sample * CHANNELS * self._bits // 8 :], self._bits)
        response: Floats = (stencil.weights * self._scale[rows]) @ levels
        return response


def fill(board: Board, model: ResponseModel, wanted: Sequence[tuple[ResponseTable, Indices]]) -> None:
    """Compute the responses of cells once and give them to tables of one grid: to each its cells, in ascending order."""
    cells = np.unique(np.concatenate([some for _, some in wanted]))
    rising = decay(board)[::-1, None].astype(np.float32)
    for first in range(0, len(cells), CELLS_AT_ONCE):
        part = cells[first : first + CELLS_AT_ONCE]
        flat = model.drive_order_responses(wanted[0][0].grid.points()[part]) / rising
        for table, own in wanted:
            here = np.isin(part, own)
            if here.any():
                table.hold(part[here], flat[here])
    for table, _ in wanted:
        table.take()


def decay(board: Board) -> NDArray[np.float64]:
    """exp(-t / tau) at each sample: (sample,)."""
    samples = board.waveform.samples
    fallen: NDArray[np.float64] = np.exp(-np.arange(samples) * (board.waveform.bit_period_s / board.plate.decay_time_s))
    return fallen


def pack(values: Reals, bits: int) -> tuple[NDArray[np.uint8], Floats]:
    """Round rows of values to `bits` bits and pack them, the first value in the highest bits of a byte.

    `values` are (row, value); of 8 `bits` they are whole numbers of -127 to 127, of 4, 2 or 1 odd numbers, so that none is zero.
    Returns the bytes (row, value * bits / 8) and what a level of 1 means (row,).
    """
    if bits == 8:
        scale = np.maximum(np.abs(values).max(axis=1), 1e-30) / 127
        return np.rint(values / scale[:, None]).astype(np.int8).view(np.uint8), scale.astype(np.float32)
    steps = 1 << bits
    scale = np.maximum(np.sqrt((values**2).mean(axis=1)), 1e-30) * (LOUDEST_RMS[bits] / (steps - 1))
    numbers = np.clip(np.floor(values / (2 * scale[:, None])) + steps // 2, 0, steps - 1).astype(np.uint8)
    each = numbers.reshape(len(values), -1, 8 // bits)
    packed = np.zeros(each.shape[:2], np.uint8)
    for index in range(8 // bits):
        packed |= each[:, :, index] << (8 - bits * (index + 1))
    return packed, scale.astype(np.float32)


def unpack(packed: NDArray[np.uint8], bits: int) -> Floats:
    """Levels of packed rows as float32: (row, value)."""
    if bits == 8:
        return packed.view(np.int8).astype(np.float32)
    return _levels(bits)[packed].reshape(len(packed), -1)


@cache
def _levels(bits: int) -> Floats:
    """Levels in each byte: (256, 8 / bits)."""
    numbers = np.arange(256)[:, None] >> np.arange(8 - bits, -1, -bits) & (1 << bits) - 1
    return (2 * numbers - ((1 << bits) - 1)).astype(np.float32)
