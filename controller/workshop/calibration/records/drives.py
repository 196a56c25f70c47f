"""What was played while a plate was measured, as spectra: words, sweeps, samples, impulses."""

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.signal import CZT

from controller.arrays import Bools, Complex, Floats
from controller.device.bank.packing import channel_bits
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.records.measurement_file import (
    NAME,
    DriveTable,
    ImpulsesDrive,
    SamplesDrive,
    SweepDrive,
    WordsDrive,
)
from controller.workshop.calibration.records.record_formats import load_array

MOST_WORDS = 4_000_000  # of an emission, and of all of them
SWEEP_OVERSAMPLING = 16  # samples of a period of a sweep's highest frequency
LEAST_SWEEP_RATE_HZ = 1e6  # or the spectrum of a low sweep repeats within the band


@dataclass(frozen=True, eq=False)
class Drive:
    """Emissions that were played."""

    volts: Floats  # (emission or 1, channel or 1, sample): each sample held until the next; difference from the level at rest
    rate_hz: float  # of these samples
    drives: Bools  # (emission, channel): which channels an emission drives
    held: bool = True  # whether samples are held; else they are those of a continuous drive

    @property
    def emissions(self) -> int:
        """Number of emissions."""
        return len(self.drives)

    @property
    def duration_s(self) -> float:
        """Length of an emission."""
        return float(self.volts.shape[2] / self.rate_hz)

    def spectra(self, first_hz: float, step_hz: float, count: int, bit_period_s: float) -> Complex:
        """Each channel's drive, as a number of pulses of 1 V of one bit period.

        No frequency is a multiple of 1 / `bit_period_s`. Returns (emission, channel, count) in V: what the spectrum of a response
        to such a pulse is multiplied with.
        """
        frequency_hz: Floats = first_hz + step_hz * np.arange(count, dtype=np.float64)
        found = transform(self.volts, self.rate_hz, first_hz, step_hz, count)
        period_s = 1 / self.rate_hz
        shape = held_spectrum(frequency_hz, period_s) if self.held else np.full(count, period_s)
        found = found * (shape / held_spectrum(frequency_hz, bit_period_s))
        return np.where(self.drives[:, :, None], found, 0)


def transform(values: NDArray[np.floating], rate_hz: float, first_hz: float, step_hz: float, count: int) -> Complex:
    """Sum of values[..., n] exp(-2 pi i f n / rate) at `count` frequencies: (..., count), exact at any rate."""
    return _chirp_transform(values.shape[-1], count, first_hz / rate_hz, step_hz / rate_hz)(values)


@lru_cache(maxsize=4)
def _chirp_transform(samples: int, count: int, first: float, step: float) -> CZT:
    return CZT(samples, count, np.exp(-2j * np.pi * step), np.exp(2j * np.pi * first))


def held_spectrum(frequency_hz: Floats, period_s: float) -> Complex:
    """Spectrum of a pulse of 1 from time 0, `period_s` long; in s."""
    phase = np.pi * frequency_hz * period_s
    spectrum: Complex = period_s * np.sinc(phase / np.pi) * np.exp(-1j * phase)
    return spectrum


def read_drive(folder: Path, table: DriveTable, board: Board) -> Drive:
    """The drive that a `measurement.toml` describes, of a board's channels.

    Raises CalibrationError, naming the file: absent, of another kind or shape, or too long; or a channel that the board has not.
    """
    if isinstance(table, WordsDrive):
        return _words(folder, table, board)
    if (most := max(table.channels)) >= board.channels:
        raise CalibrationError(f"{folder / NAME}: drive.channels: {most} is beyond the {board.channels} of board {board.name!r}")
    one_by_one: Bools = np.arange(board.channels) == np.array(table.channels)[:, None]
    match table:
        case SweepDrive():
            return Drive(_sweep(table)[None, None], _sweep_rate_hz(table), one_by_one, held=False)
        case SamplesDrive():
            return Drive(_samples(folder, table), table.rate_hz, one_by_one)
        case ImpulsesDrive():
            return Drive(np.full((1, 1, 1), table.supply_v), table.bit_clock_hz, one_by_one)


def _words(folder: Path, table: WordsDrive, board: Board) -> Drive:
    file = folder / table.file
    words, idle = load_array(file), np.array(table.idle_word, "<u4")
    of_each = (len(board.link.fpga),) if board.link.fpga else ()
    if words.dtype.kind != "u" or words.dtype.itemsize != 4 or words.ndim - len(of_each) not in (1, 2) or not words.size:
        each = ", FPGA" if of_each else ""
        raise CalibrationError(
            f"{file}: {words.dtype} {words.shape}, not drive words: uint32 (emission, word{each}) or (word,{each[1:]})"
        )
    if idle.shape != of_each or words.shape[words.ndim - len(of_each) :] != of_each:
        raise CalibrationError(
            f"{file}: drive words and drive.idle_word are not of the {max(len(board.link.fpga), 1)} FPGAs of board {board.name!r}"
        )
    if words.size > MOST_WORDS:
        raise CalibrationError(f"{file}: {words.size:,} drive words, more than {MOST_WORDS:,}")
    words = words.reshape(-1, words.shape[-1 - len(of_each)], *of_each).astype("<u4")
    bits = np.stack([channel_bits(emission) for emission in words]).astype(np.float64)  # (emission, word, channel)
    levels = bits - channel_bits(idle[None])
    volts = np.ascontiguousarray(levels.swapaxes(1, 2)) * table.supply_v
    drives = np.asarray(volts.any(axis=2), np.bool_)
    if not drives.any():
        raise CalibrationError(f"{file}: every word is the idle word {idle.tolist()}: nothing was played")
    return Drive(volts, table.bit_clock_hz, drives)


def _samples(folder: Path, table: SamplesDrive) -> Floats:
    """Volts, (emission or 1, 1, sample)."""
    file = folder / table.file
    volts = load_array(file)
    count = len(table.channels)
    fits = volts.ndim == 1 or (volts.ndim == 2 and len(volts) == count)
    if volts.dtype.kind not in "fiu" or not fits or not volts.size:
        raise CalibrationError(
            f"{file}: {volts.dtype} {volts.shape}, not volts: (sample,), or ({count}, sample) for drive.channels"
        )
    if volts.size > MOST_WORDS:
        raise CalibrationError(f"{file}: {volts.size:,} samples, more than {MOST_WORDS:,}")
    volts = np.atleast_2d(volts).astype(np.float64)[:, None]
    if not np.isfinite(volts).all() or not volts.any(axis=2).all():
        raise CalibrationError(f"{file}: samples that are no numbers, or an emission that is silent")
    return volts


def _sweep_rate_hz(table: SweepDrive) -> float:
    return max(SWEEP_OVERSAMPLING * max(table.start_hz, table.stop_hz), LEAST_SWEEP_RATE_HZ)


def _sweep(table: SweepDrive) -> Floats:
    """Samples of a swept sine from its start to its end, the two at half their weight: the trapezoidal rule."""
    rate_hz, length_s = _sweep_rate_hz(table), table.duration_ms * 1e-3
    count = round(length_s * rate_hz)
    if not 1 <= count <= 16 * MOST_WORDS:
        raise CalibrationError(f"drive.duration_ms = {table.duration_ms:g}: too long for a sweep to {table.stop_hz:g} Hz")
    time_s = np.arange(count + 1) / rate_hz
    if table.spacing == "linear":
        cycles = table.start_hz * time_s + (table.stop_hz - table.start_hz) / (2 * length_s) * time_s**2
    else:
        rise = np.log(table.stop_hz / table.start_hz)
        cycles = table.start_hz * length_s / rise * np.expm1(rise * time_s / length_s)
    fade_s = table.fade_ms * 1e-3
    gain = np.sin(np.pi / 2 * np.clip(np.minimum(time_s, length_s - time_s) / max(fade_s, 1e-12), 0, 1)) ** 2
    volts: Floats = table.amplitude_v * gain * np.sin(2 * np.pi * cycles)
    volts[[0, -1]] /= 2
    return volts
