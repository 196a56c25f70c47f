"""Where the responses of a bank come from: a model, measurements, or measurements completed by a model."""

from __future__ import annotations

from typing import Any, Literal, Protocol

import msgspec
import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray


class SourceFile(msgspec.Struct, frozen=True):
    """A file that responses were learned from: its name and the SHA-256 of its bytes, in hex."""

    name: str
    sha256: str


class Provenance(msgspec.Struct, frozen=True, omit_defaults=True):
    """Origin of responses, kept in a bank's header.

    Attributes
    ----------
    kind
        `modelled`, `measured`, or `completed`: measured, with gaps filled by a model.
    model
        Plate model in words: theory, edges, damping; of measured responses, what interpolates between points.
    files
        Measurements.
    date
        Of the measurements, ISO 8601.
    temperature_c
        Of the plate while it was measured.
    points
        Number of points that were measured.
    kept
        Expected share of the amplitude that drive words from these responses keep on the plate they come from: (median, least)
        over points left out. Absent for models, which say nothing about a plate.
    """

    kind: Literal["modelled", "measured", "completed"]
    model: str
    files: tuple[SourceFile, ...] = ()
    date: str | None = None
    temperature_c: float | None = None
    points: int | None = None
    kept: tuple[float, float] | None = None


class ResponseSource(Protocol):
    """Responses of any point of a board's plate."""

    @property
    def provenance(self) -> Provenance:
        """Where they come from."""

    @property
    def samples(self) -> int:
        """Samples of a response: those of an emission."""

    def responses(
        self,
        points_m: ArrayLike,
        band_limited: bool = False,
        dtype: DTypeLike = np.float64,
        out: NDArray[np.floating[Any]] | None = None,
    ) -> NDArray[np.floating[Any]]:
        """Responses at `points_m`, (point, 2) in m, in the order of time: (point, sample, 32), m per V held for one bit period.

        Sample j is the displacement (j + 1) bit periods after the start of the pulse. Zero for channels without an actuator.
        """

    def entry_responses(
        self, points_m: ArrayLike, out: NDArray[np.floating[Any]] | None = None, dtype: DTypeLike = np.float32
    ) -> NDArray[np.floating[Any]]:
        """What a bank keeps: band-limited and reversed in time, then what the band leaves out as means over `REST_SAMPLES`.

        (point, sample + row of rest, 32).
        """
