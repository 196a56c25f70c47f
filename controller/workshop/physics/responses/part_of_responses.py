"""Responses of the channels of one FPGA, from those of all that drive the plate."""

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from controller.arrays import Reals
from controller.device.board.panel import CHANNELS
from controller.workshop.physics.responses.response_source import ResponseSource


class PartOfResponses:
    """A `ResponseSource` of the channels of one of several FPGAs, by its number, from those of all."""

    def __init__(self, source: ResponseSource, number: int) -> None:
        self._source = source
        self._own = slice(CHANNELS * number, CHANNELS * (number + 1))
        self.provenance, self.samples = source.provenance, source.samples
        self.bit_clock_hz, self.plate_m = source.bit_clock_hz, source.plate_m

    def responses(
        self, points_m: ArrayLike, *, band_limited: bool = False, dtype: DTypeLike = np.float64, out: Reals | None = None
    ) -> Reals:
        """As in `ResponseSource`."""
        return self._part(self._source.responses(points_m, band_limited=band_limited, dtype=dtype), out)

    def drive_order_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As in `ResponseSource`."""
        return self._part(self._source.drive_order_responses(points_m, None, dtype), out)

    def entry_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As in `ResponseSource`."""
        return self._part(self._source.entry_responses(points_m, None, dtype), out)

    def _part(self, whole: Reals, out: Reals | None) -> Reals:
        own = whole[..., self._own]
        if out is None:
            return np.ascontiguousarray(own)
        out[:] = own
        return out
