"""Responses of another source, changed one point at a time by what is linear and causal: what a finger or a drift makes of them."""

from abc import ABC, abstractmethod

import msgspec
import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from controller.arrays import Reals
from controller.device.bank.file_format import REST_SAMPLES
from controller.workshop.physics.responses.response_source import ResponseSource


class TransformedResponses(ABC):
    """A `ResponseSource` made from another; `said` is what provenance adds."""

    def __init__(self, source: ResponseSource, said: str) -> None:
        self._source = source
        self.samples, self.bit_clock_hz, self.plate_m = source.samples, source.bit_clock_hz, source.plate_m
        self.provenance = msgspec.structs.replace(source.provenance, model=f"{source.provenance.model}, {said}")

    @property
    def working_bytes(self) -> float:
        """Bytes that it takes beyond those of responses that nothing changes, if they are worth counting."""
        return self._source.working_bytes if isinstance(self._source, TransformedResponses) else 0.0

    @abstractmethod
    def _transform(self, free: Reals, points_m: ArrayLike, period_s: float) -> None:
        """Change responses, (point, sample, 32) in the order of time, in place."""

    def responses(
        self, points_m: ArrayLike, *, band_limited: bool = False, dtype: DTypeLike = np.float64, out: Reals | None = None
    ) -> Reals:
        """As `ResponseSource.responses`."""
        found = self._source.responses(points_m, band_limited=band_limited, dtype=dtype, out=out)
        self._transform(found, points_m, 1 / self.bit_clock_hz)
        return found

    def drive_order_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As `ResponseSource.drive_order_responses`."""
        found = self._source.drive_order_responses(points_m, out, dtype)
        self._transform(found[:, ::-1], points_m, 1 / self.bit_clock_hz)
        return found

    def entry_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As `ResponseSource.entry_responses`; what the band leaves out is changed as the means that it is."""
        found = self._source.entry_responses(points_m, out, dtype)
        self._transform(found[:, : self.samples][:, ::-1], points_m, 1 / self.bit_clock_hz)
        self._transform(found[:, self.samples :][:, ::-1], points_m, REST_SAMPLES / self.bit_clock_hz)
        return found
