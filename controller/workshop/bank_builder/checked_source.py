"""Responses that do not come from the board's own model: refused where they cannot be the board's."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from controller.device.bank.file_format import REST_SAMPLES
from controller.device.bank.packing import CHANNELS
from controller.device.board.board import Board
from controller.errors import ConfigError
from controller.workshop.physics.responses.response_source import ResponseSource

Reals = NDArray[np.floating[Any]]

SAME = 1e-6  # relative: numbers that differ by less are written in files


class CheckedSource:
    """A `ResponseSource` whose responses are checked before they are used.

    Raises ConfigError if the source is of another plate, bit clock or length of an emission.
    """

    def __init__(self, board: Board, source: ResponseSource) -> None:
        self._source = source
        self.provenance, self.samples = source.provenance, source.samples
        self.bit_clock_hz, self.plate_m = source.bit_clock_hz, source.plate_m
        self._undriven = np.setdiff1d(np.arange(CHANNELS), [a.channel for a in board.actuators])
        waveform, plate = board.waveform, board.plate
        for what, unit, reported, own in (
            ("a bit clock of", "Hz", source.bit_clock_hz, waveform.bit_clock_hz),
            ("an emission of", "samples", source.samples, waveform.samples),
            ("a plate whose length is", "m", source.plate_m[0], plate.length_m),
            ("a plate whose width is", "m", source.plate_m[1], plate.width_m),
        ):
            if abs(reported - own) > SAME * own:
                raise ConfigError(
                    f"board {board.name!r}: the {source.provenance.kind} responses are for {what} {reported:g} {unit}, the"
                    f" board has {own:g} {unit}: choose the board that was measured, or measure this one"
                )

    def responses(
        self, points_m: ArrayLike, *, band_limited: bool = False, dtype: DTypeLike = np.float64, out: Reals | None = None
    ) -> Reals:
        """As `ResponseSource.responses`."""
        found = self._source.responses(points_m, band_limited=band_limited, dtype=dtype, out=out)
        return self._checked(found, points_m, self.samples)

    def drive_order_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As `ResponseSource.drive_order_responses`."""
        return self._checked(self._source.drive_order_responses(points_m, out, dtype), points_m, self.samples)

    def entry_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As `ResponseSource.entry_responses`."""
        rows = self.samples + -(-self.samples // REST_SAMPLES)
        return self._checked(self._source.entry_responses(points_m, out, dtype), points_m, rows)

    def _checked(self, found: Reals, points_m: ArrayLike, rows: int) -> Reals:
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        if found.shape != (len(points), rows, CHANNELS):
            raise ConfigError(f"{self._called}: they are {found.shape}, not {(len(points), rows, CHANNELS)}")
        bad = np.flatnonzero(~np.isfinite(found).all(axis=(1, 2)))
        if bad.size:
            x_mm, y_mm = 1e3 * points[bad[0]]
            raise ConfigError(f"{self._called}: that of ({x_mm:g}, {y_mm:g}) mm has values that are not finite")
        moved = self._undriven[found[:, :, self._undriven].any(axis=(0, 1))]
        if moved.size:
            raise ConfigError(f"{self._called}: channel {moved[0]} moves the plate, but has no actuator on this board")
        return found

    @property
    def _called(self) -> str:
        return f"the {self.provenance.kind} responses cannot be used"
