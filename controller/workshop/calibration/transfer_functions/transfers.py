"""Transfer functions of a point in bins of frequency, and the responses in time that they are."""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len

from controller.arrays import Bools, Floats
from controller.device.board.board import Board
from controller.workshop.physics.responses.modal_response import edge_width_hz


@dataclass(frozen=True, eq=False)
class RawBins:
    """Frequencies at which responses are found: multiples of bit_clock_hz / length."""

    bit_clock_hz: float
    length: int  # samples of the bit clock after which a response would repeat; longer than any record
    first: int  # number of the lowest
    gain: Floats  # (bin,): 1 wherever the waveform's filter passes anything; falls to 0 beyond, over half the filter's edge

    @classmethod
    def of(cls, board: Board, longest_s: float) -> Self:
        """Bins of a board's band, for records that end `longest_s` after the start of their emission."""
        waveform = board.waveform
        length = next_fast_len(int(np.ceil(1.1 * longest_s * waveform.bit_clock_hz)) + waveform.samples, real=True)
        edge_hz = edge_width_hz((waveform.band_low_hz, waveform.band_high_hz))
        low_hz, high_hz = waveform.band_low_hz - edge_hz / 2, waveform.band_high_hz + edge_hz / 2
        step_hz = waveform.bit_clock_hz / length
        highest_hz = min(high_hz + edge_hz / 2, waveform.bit_clock_hz / 2 - step_hz)
        first = int(np.ceil((low_hz - edge_hz / 2) / step_hz))
        frequency_hz = step_hz * np.arange(first, int(highest_hz / step_hz) + 1)
        outside_hz = np.maximum(np.maximum(low_hz - frequency_hz, frequency_hz - high_hz), 0)
        gain: Floats = np.cos(np.pi / 2 * np.minimum(outside_hz / (edge_hz / 2), 1)) ** 2
        return cls(waveform.bit_clock_hz, length, first, gain)

    @property
    def step_hz(self) -> float:
        """From bin to bin."""
        return self.bit_clock_hz / self.length

    @cached_property
    def frequency_hz(self) -> Floats:
        """Of each bin."""
        return self.step_hz * np.arange(self.first, self.first + len(self.gain), dtype=np.float64)

    def response(self, transfer: NDArray[np.complexfloating], delay_s: float = 0.0) -> Floats:
        """Responses in time (..., length) in m per V, from transfer functions (..., bin) in m s per V.

        Sample j is (j + 1) bit periods after the start of the pulse, the last ones before it. What happened is `delay_s` later in
        the records than they say; that is taken out.
        """
        spectrum = np.zeros((*transfer.shape[:-1], self.length // 2 + 1), np.complex128)
        turn = np.exp(2j * np.pi * self.frequency_hz * (delay_s + 1 / self.bit_clock_hz))
        spectrum[..., self.first : self.first + len(self.gain)] = transfer * (self.gain * turn * self.bit_clock_hz)
        return np.fft.irfft(spectrum, self.length, axis=-1)


@dataclass(frozen=True, eq=False)
class Transfers:
    """Transfer functions of one point."""

    transfer: NDArray[np.complex64]  # (32, bin): in m s per V; zero where not resolved
    resolved: Bools  # (32,): whether the records that are there determine the channel
    # (32,): of the real and imaginary parts of `transfer` together, mean over the bins; NaN where nothing is left to tell it
    # from
    variance: Floats
    # (32,): share of the power of the records that a channel's drive explains, of what it and noise make, mean over the band
    coherence: Floats
    residual: float  # power of the records that no drive explains, over all of their power; NaN where nothing is left
    clipped: int = 0  # records that were left out since they are clipped
