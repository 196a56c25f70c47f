"""How much all frequencies of a plate have changed between two measurements of the same points: its temperature coefficient.

A plate that becomes softer plays the same responses more slowly. The stretch of time that makes both measurements most alike is
found to a hundredth of a percent and better, as responses ring for a hundred periods.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

from controller.arrays import Floats, Indices
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.interpolation.spectra import Bins
from controller.workshop.calibration.interpolation.wave_fit import lowest
from controller.workshop.calibration.learned import LearnedResponses

SAME_PLACE_M = 0.3e-3
RECORDS = 96  # at most
GROUPS = 8  # whose scatter says how sure the ratio is
WIDEST = 0.02
COARSE = 0.0005  # step
FINE: Floats = np.linspace(-0.0005, 0.0005, 11)
UNSTRETCHED = 0.01  # of the drift: the drivers' part of the responses keeps its time
LEAST_ALIKE = 0.5  # correlation of the two at best


@dataclass(frozen=True)
class FittedDrift:
    """What one plate did between two measurements."""

    frequency_ratio: float  # frequencies of the later one over those of the earlier one
    error: float  # standard deviation of the ratio
    alike: float  # correlation of the responses when time is stretched by it
    kelvin: float | None  # how much warmer the later one was

    @property
    def coefficient_per_k(self) -> tuple[float, float] | None:
        """Relative change per kelvin as in [temperature] of board.toml, and its standard deviation; None if undetermined."""
        if self.kelvin is None or abs(self.kelvin) < 1:
            return None
        return (self.frequency_ratio - 1) / self.kelvin, self.error / abs(self.kelvin)


def fit_drift(board: Board, earlier: LearnedResponses, later: LearnedResponses) -> FittedDrift:
    """Compare two measurements.

    Raises CalibrationError if they share no point, or are not of one plate whose frequencies differ by 2 % at most.
    """
    distance_m, nearest = (np.asarray(found) for found in cKDTree(earlier.points_m).query(later.points_m))
    places = [(int(nearest[point]), int(point)) for point in np.flatnonzero(distance_m <= SAME_PLACE_M)]
    pairs = [
        (one, other, int(channel)) for one, other in places for channel in np.flatnonzero(earlier.known[one] & later.known[other])
    ]
    if len(pairs) < GROUPS:
        raise CalibrationError(
            f"the two measurements share {len(pairs)} records within {SAME_PLACE_M * 1e3:g} mm: measure the same points twice"
        )
    random = np.random.default_rng(1)
    chosen = [pairs[index] for index in random.permutation(len(pairs))[:RECORDS]]
    samples = min(earlier.responses.shape[1], later.responses.shape[1])
    before, after = (
        np.stack([responses[pair[which], :samples, pair[2]] for pair in chosen])
        for which, responses in ((0, earlier.responses), (1, later.responses))
    )
    found = stretch(board, before, after, WIDEST)
    if found.alike < LEAST_ALIKE:
        raise CalibrationError(
            f"the two measurements do not agree when time is stretched by up to {WIDEST:.0%} ({found.alike:.2f} alike at best):"
            " not one plate, or other positions or channels"
        )
    warmer = (
        None
        if earlier.provenance.temperature_c is None or later.provenance.temperature_c is None
        else later.provenance.temperature_c - earlier.provenance.temperature_c
    )
    return FittedDrift(found.ratio, found.error, found.alike, warmer)


class Stretch(NamedTuple):
    """By what time is stretched from some responses to others."""

    ratio: float  # frequencies of the others over those of the first
    error: float  # standard deviation
    alike: float  # correlation when time is stretched by it
    alike_before: float  # correlation when it is not


def stretch(board: Board, before: NDArray[np.floating], after: NDArray[np.floating], widest: float) -> Stretch:
    """The stretch of time, by up to `widest` either way, that makes responses (record, sample) of two states most alike."""
    samples = before.shape[1]
    time = np.arange(1.0, samples + 1)  # sample j is j + 1 bit periods after the start
    spline = CubicSpline(time, _band_limited(board, before), axis=1)
    until = int(samples / (1 + widest)) - 1
    measured = _band_limited(board, after)[:, :until]
    scale = np.sqrt((measured**2).sum())

    def alike(ratios: Floats, some: Indices) -> Floats:
        """Correlation of some records at each ratio: (ratio,)."""
        stretched = [spline(time[:until] * ratio)[some] for ratio in ratios.tolist()]
        return np.array([(one * measured[some]).sum() / np.sqrt((one**2).sum()) / scale for one in stretched])

    every = np.arange(len(before))
    coarse: Floats = np.linspace(1 - widest, 1 + widest, 2 * round(widest / COARSE) + 1)
    fine: Floats = float(coarse[alike(coarse, every).argmax()]) + FINE
    found = alike(fine, every)
    ratio = lowest(fine, -found)
    parts = np.array_split(np.random.default_rng(1).permutation(every), GROUPS)
    scatter = float(np.std([lowest(fine, -alike(fine, part)) for part in parts], ddof=1) / np.sqrt(GROUPS))
    error = float(np.hypot(scatter, UNSTRETCHED * (ratio - 1)))
    return Stretch(ratio, error, float(found.max()), float(alike(np.ones(1), every)[0]))


def _band_limited(board: Board, records: NDArray[np.floating]) -> Floats:
    """Of whole records, (record, sample)."""
    waveform = board.waveform
    bins = Bins.of(waveform, records.shape[1])
    spectra = np.fft.rfft(records, bins.length)[:, : bins.gain.size] * bins.gain
    return np.fft.irfft(spectra, bins.length)[:, : records.shape[1]].astype(np.float64)
