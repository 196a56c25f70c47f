"""The recorder's clock against the player's: the rate at which the records contradict a plate that is linear and causal least.

With a wrong rate, what was played at different times does not fit one transfer function, and responses begin before their pulse.
Records that run through tell the rate to a hundredth of a ppm; records of noise that are triggered one by one to a few ppm;
triggered impulses and single sweeps not at all, and need it no better.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar

from controller.arrays import Complex
from controller.workshop.calibration.records.measurements import PointRecords
from controller.workshop.calibration.transfer_functions.deconvolution import Deconvolution

WIDEST_PPM = 600.0
COARSE_PPM = 200.0
SIGNIFICANT = 6.0  # standard errors of four points: by chance once in a hundred
REPORTED = 0.5  # rise of the contradiction, over its least, within `COARSE_PPM`
BEFORE_S = 0.4e-3, 1.5e-3  # before its pulse there is no response; nearer, the filter still rings


@dataclass(frozen=True)
class RecorderClock:
    """What the records tell of the recorder's clock."""

    ppm: float  # by which it is faster than the player's; 0 where the records do not tell it from 0
    error_ppm: float  # standard error, from one point to another; NaN where the records do not tell

    @property
    def reported(self) -> bool:
        """Whether the records tell."""
        return not np.isnan(self.error_ppm)


def clock_of(deconvolution: Deconvolution, records: Sequence[PointRecords], delay_s: float) -> RecorderClock:
    """Estimate it from the records of a few points, which are late by `delay_s`, to 20 us."""
    span_s = max(float(one.first_s.max()) for one in records)
    if span_s == 0:
        records = [_averaged(one) for one in records]  # repetitions that were triggered alike tell the same
    at_once = deconvolution.spectra(records[0])
    frequency_hz = deconvolution.bins.frequency_hz

    def shifted(ppm: float) -> float:
        """Contradiction of one point, whose records are moved only."""
        turn = np.exp(2j * np.pi * frequency_hz * (1e-6 * ppm * records[0].first_s[:, :, None]))
        return _contradiction(deconvolution, at_once * turn, records[0], delay_s)

    def exact(ppm: float) -> float:
        return float(np.mean([_contradiction(deconvolution, deconvolution.spectra(one, ppm), one, delay_s) for one in records]))

    step = min(0.2e6 / (frequency_hz[-1] * span_s), COARSE_PPM) if span_s > 0 else COARSE_PPM
    tried = np.arange(-WIDEST_PPM, WIDEST_PPM + step, step)
    near = float(tried[np.argmin([(shifted if span_s > 0 else exact)(ppm) for ppm in tried])])
    found = [
        minimize_scalar(
            lambda ppm, one=one: _contradiction(deconvolution, deconvolution.spectra(one, ppm), one, delay_s),
            bounds=(near - 1.5 * step, near + 1.5 * step),
            method="bounded",
            options={"xatol": step * 2e-3},
        ).x
        for one in records
    ]
    ppm = float(np.mean(found))
    if min(exact(ppm - step), exact(ppm + step)) <= (1 + REPORTED) * exact(ppm):
        return RecorderClock(0.0, np.nan)
    error_ppm = float(np.std(found, ddof=1)) / len(found) ** 0.5 if len(found) > 1 else step / 4
    return RecorderClock(round(ppm, 2) if abs(ppm) > SIGNIFICANT * error_ppm else 0.0, error_ppm)


def _averaged(records: PointRecords) -> PointRecords:
    """Mean over the sound repetitions, as one."""
    count = records.sound.sum(axis=1)
    values = np.where(records.sound[:, :, None], records.values, 0).sum(axis=1) / np.maximum(count, 1)[:, None]
    there = (count > 0)[:, None]
    return replace(records, values=values[:, None], there=there, first_s=np.zeros(there.shape), clipped=~there)


def _contradiction(deconvolution: Deconvolution, spectra: Complex, records: PointRecords, delay_s: float) -> float:
    """Power that no drive explains, and that of responses before their pulse, each as a share."""
    found = deconvolution.transfers(spectra, records.sound)
    response = deconvolution.bins.response(found.transfer[found.resolved], delay_s)
    first, last = (round(before_s * deconvolution.bins.bit_clock_hz) for before_s in BEFORE_S)
    power = float((response**2).sum())
    early = float((response[:, -last:-first] ** 2).sum()) / power if power else 0.0
    return early + (0.0 if np.isnan(found.residual) else found.residual)
