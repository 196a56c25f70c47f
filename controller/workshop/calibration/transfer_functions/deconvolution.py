"""Records and what was played become transfer functions: per-bin least squares over emissions and repetitions.

The spectrum of a record is Y = sum over channels of H D + noise, with H the response to a pulse of 1 V of one bit period of the
board and D what was played as a number of such pulses (`drives`). Over all emissions and repetitions

    H = (D* D + epsilon I)^-1 D* Y,    epsilon = `REGULARISATION` times the mean of D* D's diagonal in the band.

With one channel at a time D* D is diagonal, and this is S_yx / (S_xx + epsilon). Records are transformed at frequencies of the
board's bit clock, whatever the recorder's rate and its error, so there is no other resampling. What D does not excite is left at
zero.
"""

from dataclasses import replace
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Complex, Floats
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.records.drives import Drive, held_spectrum, transform
from controller.workshop.calibration.records.measurements import Measurement, PointRecords
from controller.workshop.calibration.transfer_functions.transfers import RawBins, Transfers
from controller.workshop.physics.motion import DERIVATIVE

Kind = TypeVar("Kind", np.bool_, np.float64, np.complex64)

REGULARISATION = 1e-5  # one sequence of noise leaves a bias of its root
RESOLVED = 0.9  # share of a channel's response that the drive determines, in the mean over the band
EXCITED = 1e-3  # of the power of a drive where it is strongest, in the mean over `SMOOTH_HZ`
SMOOTH_HZ = 1e3
TAPER_HZ = 3e3  # from what is excited to what is not
LEAST_SHARE = 1e-3  # of the energy of a drive that lies in the band
NYQUIST_SHARE = 0.9  # of the recorder's half rate that its filter passes
EARLIEST_S = 0.9e-3  # before the pulse, where noise is looked for


class Deconvolution:
    """Deconvolves the records of a measurement.

    `length` is the samples of a record. Raises CalibrationError if the recorder is too slow for the band, or what was played
    determines no channel, with what to do.
    """

    def __init__(self, measurement: Measurement, board: Board, length: int) -> None:
        settings = measurement.settings
        first_s = (settings.records.first_sample_us or 0.0) * 1e-6
        self.length = length
        self.bins = RawBins.of(board, length / settings.sample_rate_hz + max(first_s, 0.0))
        highest_hz, half_hz = self.bins.frequency_hz[self.bins.gain > 0.5][-1], settings.sample_rate_hz / 2
        if highest_hz > NYQUIST_SHARE * half_hz:
            raise CalibrationError(
                f"{measurement.folder}: sample_rate_hz = {settings.sample_rate_hz:g} is too low for the band, which needs"
                f" {2 * highest_hz / NYQUIST_SHARE:.0f}: set the recorder to that or more"
            )
        self._rate_hz = settings.sample_rate_hz
        self._first_s = first_s
        period_s = (settings.records.period_ms or 0.0) * 1e-3
        shape = measurement.drive.emissions, measurement.repetitions
        self._starts_s = period_s * np.arange(shape[0] * shape[1], dtype=np.float64).reshape(shape)
        self._to_displacement = (2j * np.pi * self.bins.frequency_hz) ** -DERIVATIVE[settings.records.quantity[0]]
        drive = measurement.drive
        self._duration_s = drive.duration_s
        played = drive.spectra(self.bins.frequency_hz[0], self.bins.step_hz, len(self.bins.gain), 1 / board.waveform.bit_clock_hz)
        self.driven: Bools = np.asarray(drive.drives.any(axis=0))
        self._drives = drive.drives[:, self.driven]
        end_s, needed_s = length / self._rate_hz + first_s, drive.duration_s + board.waveform.duration_s / 2
        if end_s < needed_s:
            raise CalibrationError(
                f"{measurement.folder}: records of {length:,} samples end {end_s * 1e3:.3g} ms after the start of a drive of"
                f" {drive.duration_s * 1e3:.3g} ms: record until {needed_s * 1e3:.3g} ms at least, better until the plate is still"
            )
        self._played: Complex = np.ascontiguousarray(played[:, self.driven].transpose(2, 0, 1))  # (bin, emission, channel)
        self._excited = self._excited_bins(measurement, drive)
        self._taper = _tapered(self._excited, max(int(TAPER_HZ / self.bins.step_hz), 1))
        self._in_band = (self.bins.gain > 0.5) & self._excited
        power = (abs(self._played[self._in_band]) ** 2).sum(axis=1).mean(axis=0)
        self._epsilon = REGULARISATION * float(power.mean()) * measurement.repetitions
        self._operators: dict[bytes, tuple[Complex, Floats, Floats, Floats]] = {}

    def spectra(self, records: PointRecords, clock_ppm: float = 0.0) -> Complex:
        """Spectra of a point's records as displacement, (emission, repetition, bin) in m s; of what is not there zero.

        The recorder's clock is faster than the player's by `clock_ppm`.
        """
        rate_hz = self._rate_hz * (1 + clock_ppm * 1e-6)
        there = np.where(records.there[:, :, None], records.values, 0.0)
        frequency_hz = self.bins.frequency_hz
        found = transform(there, rate_hz, frequency_hz[0], self.bins.step_hz, len(frequency_hz)) / rate_hz
        first_s = self._first_s + records.first_s * (self._rate_hz / rate_hz) - self._starts_s[:, : records.first_s.shape[1]]
        found *= np.exp(-2j * np.pi * frequency_hz * first_s[:, :, None])
        found *= self._to_displacement
        return found

    def learn(self, records: PointRecords, clock_ppm: float) -> Transfers:
        """Transfer functions of a point from what is `sound` of its records."""
        found = self.transfers(self.spectra(records, clock_ppm), records.sound)
        return replace(found, clipped=int(records.clipped.sum()))

    @property
    def covered(self) -> int:
        """Samples of a response that every drive sample has in the records."""
        end_s = self.length / self._rate_hz + self._first_s
        return max(int((end_s - self._duration_s) * self.bins.bit_clock_hz), 0)

    @property
    def spreads_noise(self) -> bool:
        """Whether noise of a record comes to lie before the pulse too: not if what was played is short."""
        return self._duration_s >= EARLIEST_S

    def transfers(self, spectra: Complex, there: Bools) -> Transfers:
        """Least squares over what is there (emission, repetition) of `spectra` (emission, repetition, bin)."""
        count = there.sum(axis=1)
        inverse, spread, resolution, leverage = self._operator(count)
        mean = (spectra * there[:, :, None]).sum(axis=1) / np.maximum(count, 1)[:, None]  # (emission, bin)
        transfer = (inverse @ mean.T[:, :, None])[:, :, 0]  # (bin, channel)
        fitted = (self._played @ transfer[:, :, None])[:, :, 0].T
        squares = (abs(spectra - fitted[:, None]) ** 2 * there[:, :, None]).sum(axis=1)  # (emission, bin)
        freedom = self._drives.T @ (count - leverage)  # of each channel's emissions
        in_band = self._in_band
        noise = np.full(transfer.shape, np.nan)
        reported = freedom > 0.5
        noise[:, reported] = (squares.T @ self._drives)[:, reported] / freedom[reported]
        variance = noise * spread
        weight = (abs(self._played) ** 2 * count[:, None]).sum(axis=1)
        signal = abs(transfer) ** 2 * weight
        explained = np.maximum(signal - noise, 0)
        with np.errstate(invalid="ignore", divide="ignore"):
            coherence = (explained / (explained + noise * np.maximum(self._drives.T @ count, 1)))[in_band].mean(axis=0)
        power = float((abs(spectra[..., in_band]) ** 2 * there[:, :, None]).sum())
        residual = float(squares[:, in_band].sum()) / power if power and reported.any() else np.nan
        resolved = resolution[in_band].mean(axis=0) > RESOLVED
        return Transfers(
            transfer=self._of_all(np.where(resolved, transfer, 0).T.astype(np.complex64)),
            resolved=self._of_all(resolved),
            variance=self._of_all(variance[in_band].mean(axis=0), np.nan),
            coherence=self._of_all(coherence, np.nan),
            residual=residual,
        )

    @cached_property
    def excited_hz(self) -> tuple[float, float]:
        """Lowest and highest frequency at which what was played determines every channel that it drives.

        Raises CalibrationError if there is none.
        """
        everything = np.ones(self._played.shape[1], int)
        resolution = self._operator(everything)[2]
        if (resolution[self._in_band].mean(axis=0) <= RESOLVED).any():
            emissions, channels = self._played.shape[1:]
            raise CalibrationError(
                f"{emissions} emissions do not determine {channels} channels that they drive together: play {channels} or more,"
                " each with words of its own, or one channel at a time"
            )
        excited = self.bins.frequency_hz[self._excited]
        return float(excited[0]), float(excited[-1])

    def _excited_bins(self, measurement: Measurement, drive: Drive) -> Bools:
        """Frequencies at which every channel's drive has power enough."""
        power = (abs(self._played) ** 2).sum(axis=1)
        held = held_spectrum(self.bins.frequency_hz, 1 / self.bins.bit_clock_hz)
        inside = 2 * self.bins.step_hz * (power * abs(held[:, None]) ** 2).sum(axis=0)
        whole = np.broadcast_to((drive.volts**2).sum(axis=2) / drive.rate_hz, drive.drives.shape)
        share = inside / np.where(drive.drives, whole, 0).sum(axis=0)[self.driven]
        if share.min() < LEAST_SHARE:
            channel = int(np.flatnonzero(self.driven)[share.argmin()])
            raise CalibrationError(
                f"{measurement.folder}: what channel {channel} played holds {share.min():.1e} of its energy in the band from"
                f" {self.bins.frequency_hz[0] / 1e3:.0f} to {self.bins.frequency_hz[-1] / 1e3:.0f} kHz: nothing to learn from"
            )
        width = max(int(SMOOTH_HZ / self.bins.step_hz), 1)
        smooth = np.stack([np.convolve(own, np.ones(width) / width, "same") for own in power.T])
        return np.asarray((smooth > EXCITED * smooth.max(axis=1, keepdims=True)).all(axis=0))

    def _of_all(self, of_driven: NDArray[Kind], otherwise: float = 0) -> NDArray[Kind]:
        """What is of the channels that were driven, with those that were not."""
        whole = np.full((len(self.driven), *of_driven.shape[1:]), otherwise, of_driven.dtype)
        whole[self.driven] = of_driven
        return whole

    def _operator(self, count: NDArray[np.int_]) -> tuple[Complex, Floats, Floats, Floats]:
        """For this many repetitions of each emission: the inverse (bin, channel, emission), what it makes of a variance of 1, and
        its resolution (bin, channel), and the leverage of each emission.
        """
        key = count.tobytes()
        if key not in self._operators:
            played = self._played
            adjoint = played.conj().swapaxes(1, 2) * count
            normal = adjoint @ played
            ridge = normal + self._epsilon * np.eye(normal.shape[1])
            inverse = np.linalg.solve(ridge, adjoint).astype(np.complex128, copy=False)
            inverse *= self._taper[:, None, None]
            seen = inverse @ played
            spread = (abs(inverse) ** 2 / np.maximum(count, 1)).sum(axis=2)
            leverage = np.einsum("kec,kce->e", played, inverse).real / self._excited.sum()
            self._operators[key] = inverse, spread, np.einsum("kcc->kc", seen).real, leverage
        return self._operators[key]


def _tapered(mask: Bools, width: int) -> Floats:
    """1 well inside of `mask`, falling to 0 at its ends over this many bins; the ends of the array are inside."""
    padded = np.pad(mask.astype(np.float64), 2 * width, mode="edge")
    inner = np.convolve(padded, np.ones(2 * width + 1), "same") > 2 * width + 0.5
    window = np.hanning(2 * width + 3)[1:-1]
    return np.asarray(np.convolve(inner, window / window.sum(), "same")[2 * width : -2 * width] * mask)
