"""Responses between cells: bilinear, in whole numbers of 16 bits, and so the same on every machine.

The weights of the four cells are 256ths that sum to 256, so that levels of 8 bits fill 16 bits and never
overflow; rounding a weight moves the point by less than a 500th of a pitch. Half as many bytes as
float32 go through the cache, which is what an interpolation costs.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from controller.bank.packing import CHANNELS
from controller.bank.reader import Bank

LINE_BYTES = 64
WEIGHT_SUM = 256  # four roundings may add 2: 258 * 127 is still within 16 bits


class Interpolation:
    """Interpolates responses of a bank in memory taken once.

    Parameters
    ----------
    bank : Bank
        The open bank; its response section is mapped with the first interpolation.
    response_rows : int
        How many rows of a response: its samples, or those and the rest outside the band.
    """

    def __init__(self, bank: Bank, response_rows: int) -> None:
        values = response_rows * CHANNELS
        self._values = values
        self._bank = bank
        self._grid = bank.grid
        self._part = aligned(values)
        self._weights = [np.empty((), np.int16) for _ in range(4)]

    def at(self, x_m: float, y_m: float, out: NDArray[np.int16]) -> None:
        """Response at a point, in a unit that differs from point to point.

        Parameters
        ----------
        x_m, y_m : float
            Points beyond the outermost cells take the nearest place among the cells.
        out : (response_rows * 32,) int16 array
            Filled, in drive order.

        Raises
        ------
        BankError
            If a cell that the point needs is not in the bank, or damaged.
        ValueError
            If the point is not finite.
        """
        cell, columns, rows, right, up = self._grid.patch(x_m, y_m)
        levels = self._bank.response_patch(cell, columns, rows)[:, :, : self._values]
        np.copyto(out, levels[0, 0])
        if rows == columns == 1:
            return
        self._weigh(cell, columns, rows, right, up)
        part, weights = self._part, self._weights
        np.multiply(out, weights[0], out=out)
        for index in range(1, rows * columns):  # one by one: a ufunc that broadcasts allocates, and two arrays stay in the cache
            np.copyto(part, levels[divmod(index, columns)])
            np.multiply(part, weights[index], out=part)
            np.add(out, part, out=out)

    def _weigh(self, cell: int, columns: int, rows: int, right: float, up: float) -> None:
        """Weights of the cells: bilinear, times each one's scale, in 256ths of all."""
        scale = self._bank.scale_of_cell
        shares = [(1 - up) * (1 - right) * scale[cell]]
        if columns == 2:
            shares.append((1 - up) * right * scale[cell + 1])
        if rows == 2:
            above = cell + self._grid.nx
            shares.append(up * (1 - right) * scale[above])
            if columns == 2:
                shares.append(up * right * scale[above + 1])
        total = sum(shares)
        unit = WEIGHT_SUM / total if total else 0.0
        for weight, share in zip(self._weights, shares, strict=False):
            weight[...] = round(share * unit)


def aligned(values: int) -> NDArray[np.int16]:
    """Array of a number of values that begins at a cache line: vectors that straddle two lines cost a tenth more time."""
    room = np.empty(2 * values + LINE_BYTES, np.uint8)
    begin = -room.ctypes.data % LINE_BYTES
    return room[begin : begin + 2 * values].view(np.int16)
