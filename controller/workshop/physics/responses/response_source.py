"""Where the responses of a bank come from: a model, measurements, or measurements completed by a model."""

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from controller.arrays import Reals
from controller.device.bank.provenance import Provenance, SourceFile

__all__ = ["Provenance", "ResponseSource", "SourceFile"]


class ResponseSource(Protocol):
    """Responses of any point of a board's plate."""

    @property
    def provenance(self) -> Provenance:
        """Where they come from."""

    @property
    def samples(self) -> int:
        """Samples of a response: those of an emission."""

    @property
    def bit_clock_hz(self) -> float:
        """Rate of the samples."""

    @property
    def plate_m(self) -> tuple[float, float]:
        """Extent along x and y of the plate that they are of."""

    def responses(
        self,
        points_m: ArrayLike,
        *,
        band_limited: bool = False,
        dtype: DTypeLike = np.float64,
        out: Reals | None = None,
    ) -> Reals:
        """Responses at `points_m`, (point, 2) in m, in the order of time: (point, sample, channel), m per V held for a bit period.

        Sample j is the displacement (j + 1) bit periods after the start of the pulse. Zero for channels without an actuator.
        """

    def drive_order_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """`responses`, band-limited and reversed in time: sample n belongs to drive word n, and sum(v * response) is u at T."""

    def entry_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """What a bank keeps: `drive_order_responses`, then what the band leaves out as means over `REST_SAMPLES`.

        (point, sample + row of rest, channel).
        """


def room(out: Reals | None, shape: tuple[int, ...], dtype: DTypeLike) -> Reals:
    """`out`, or a new array of this shape and type; raises ValueError if `out` has another."""
    kind = np.dtype(dtype)
    if out is None:
        return np.empty(shape, kind)
    if out.shape != shape or out.dtype != kind:
        raise ValueError(f"out is {out.dtype} {out.shape}, not {kind} {shape}")
    return out
