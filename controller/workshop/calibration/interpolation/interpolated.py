"""Measured responses at any place of the plate: what a bank is built from."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from controller.arrays import Bools, Floats, Reals, blocks
from controller.device.bank.provenance import Provenance
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.interpolation.kriging import Prior, SpectralField, foreseen_shares
from controller.workshop.calibration.interpolation.plate_size import GlassSize
from controller.workshop.calibration.interpolation.point_fit import PointFit
from controller.workshop.calibration.interpolation.spectra import Bins
from controller.workshop.physics.responses.response_source import room

LEAST_SHARE = 0.8  # foreseen from the places of the points; farther from them nothing is estimated, and no scene may ask for it
POINTS_AT_ONCE = 128  # transforms of 128 points take some 140 MB
BINS_ASKED = 8
QUARTILES = 1.349  # between the quartiles of a normal distribution, in standard deviations


@dataclass(frozen=True, eq=False)
class LeaveOut:
    """How well points left out are foreseen by the others."""

    points_m: Floats  # (point, 2)
    # (point,): sum of the measured responses with the signs of those foreseen, over the sum of their magnitudes: the share of
    # the amplitude that drive words from the others keep at that point. NaN where it was not evaluated
    kept: Floats
    # (point,): the former sum over the sum of the magnitudes foreseen: the amplitude that these words have there, over that which
    # the others foresee. NaN as `kept`
    over_foreseen: Floats
    # (bin,): what is measured at these points over what the others foresee, by least squares, 0 to 1: below what a drive excites it
    # is noise, and nothing of it is foreseen
    trusted: Floats

    def foreseen(self) -> tuple[float, float]:
        """Mean and standard deviation of the logarithm of the amplitude over that foreseen, by median and quartiles."""
        quartiles = np.nanquantile(np.log(np.maximum(self.over_foreseen, 1e-3)), (0.25, 0.5, 0.75))
        return round(float(quartiles[1]), 4), round(float(quartiles[2] - quartiles[0]) / QUARTILES, 4)

    def unforeseen(self) -> float:
        """Share of the energy in the band that is not foreseen, mean over the points: words by signs keep the correlation."""
        return round(float(np.nanmean(1 - self.kept**2)), 4)

    def summary(self) -> tuple[float, float]:
        """Median and least."""
        return round(float(np.nanmedian(self.kept)), 4), round(float(np.nanmin(self.kept)), 4)


class InterpolatedResponses:
    """A `ResponseSource` from measurements."""

    def __init__(
        self,
        board: Board,
        bins: Bins,
        field: SpectralField,
        provenance: Provenance,
        leave_out: LeaveOut,
        # what says how far from the measured points, (point, 2) in m, the field is known; None where it is known on the whole plate
        reach: tuple[Prior, Floats] | None,
        errors: PointFit | None = None,  # of the points, corrected; None where they were not looked for
        size: GlassSize | None = None,  # of the glass, where the model is of another than board.toml's
    ) -> None:
        self.provenance = provenance
        self.leave_out = leave_out
        self.errors = errors
        self.size = size
        self.samples = bins.samples
        self.bit_clock_hz = board.waveform.bit_clock_hz
        self.plate_m = (board.plate.length_m, board.plate.width_m)
        self._channels = board.channels
        self.bins = bins
        self.field = field
        self._reach = reach

    def foreseen(self, points_m: ArrayLike) -> Floats:
        """Share of the amplitude that is foreseen from the places of the measured points alone, at (point, 2) in m: (point,)."""
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        if self._reach is None:
            return np.ones(len(points))
        some = self.bins.in_band
        return foreseen_shares(*self._reach, points, some[:: max(len(some) // BINS_ASKED, 1)])

    def near_enough(self, points_m: Floats) -> Bools:
        """Whether responses are estimated at points, (point, 2) in m: (point,)."""
        return self.foreseen(points_m) >= LEAST_SHARE

    def responses(
        self,
        points_m: ArrayLike,
        *,
        band_limited: bool = False,
        dtype: DTypeLike = np.float64,
        out: Reals | None = None,
    ) -> Reals:
        """As `ResponseSource` says; beyond the band as far as it was measured, nothing above it.

        Raises CalibrationError if a point is too far from all that were measured; ValueError if `out` has another shape or type.
        """
        points = self._checked(points_m)
        out = room(out, (len(points), self.samples, self._channels), dtype)
        for some in blocks(len(points), POINTS_AT_ONCE):
            spectra = self.field.at(points[some])
            out[some] = self.bins.band_limited(spectra) if band_limited else self.bins.whole(spectra)
        return out

    def drive_order_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As `ResponseSource` says. Errors as in `responses`."""
        out = self.responses(points_m, band_limited=True, dtype=dtype, out=out)
        out[:] = out[:, ::-1].copy()
        return out

    def entry_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """As `ResponseSource` says; outside the band, rows of rest hold what was measured there. Errors as in `responses`."""
        points = self._checked(points_m)
        rows = self.bins.rest_rows
        out = room(out, (len(points), self.samples + rows, self._channels), dtype)
        for some in blocks(len(points), POINTS_AT_ONCE):
            spectra = self.field.at(points[some])
            out[some, : self.samples] = self.bins.band_limited(spectra)[:, ::-1]
            out[some, self.samples :] = self.bins.rest(spectra)
        return out

    def _checked(self, points_m: ArrayLike) -> Floats:
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        shares = self.foreseen(points)
        if points.size and shares.min() < LEAST_SHARE:
            x_mm, y_mm = points[shares.argmin()] * 1e3
            raise CalibrationError(
                f"x = {x_mm:.1f} mm, y = {y_mm:.1f} mm is too far from the measured points: {shares.min():.2f} of the amplitude is"
                f" foreseen there, below {LEAST_SHARE:g}; measure nearer to it"
            )
        return points
