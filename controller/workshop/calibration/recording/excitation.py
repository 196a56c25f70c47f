"""What is played to learn a plate: emissions of 1-bit chirps or noise on all channels at once, distinguished by their signs.

An emission lasts 2 ms, the most that the FPGA plays. Every channel plays the same sequence in each, with the sign that a Hadamard
matrix gives channel and emission: as many emissions as there are channels, rounded up to a power of 2, tell all of them apart, with
as much energy of each channel as if it had played alone in every one of them.
"""

from typing import Final, Literal

import numpy as np
from scipy.linalg import hadamard

from controller.arrays import Bools, Words
from controller.device.bank import packing
from controller.device.board.board import Board
from controller.errors import ConfigError

Kind = Literal["chirp", "noise"]

BEYOND: Final = 0.8, 1.06  # of the band's edges: what is swept, so that its edges are learned too


def drive_words(board: Board, kind: Kind = "chirp", seed: int = 1) -> Words:
    """Drive words of all emissions (emission, word), or (emission, word, FPGA); bit q is channel q.

    "chirp": sign of a chirp through the waveform's band, whose spectrum is flat; "noise": of noise limited to it. Raises
    ConfigError if a channel has more edges than the limits of the board allow in an emission.
    """
    high = _chirp(board) if kind == "chirp" else _noise(board, seed)
    channels = [actuator.channel for actuator in board.actuators]
    order = 1 << (len(channels) - 1).bit_length()
    random = np.random.default_rng(0)  # else one emission drives all channels alike, and one channel plays the same in all
    signs = hadamard(order) * random.choice((-1, 1), (order, 1)) * random.choice((-1, 1), order)
    same = signs[:, : len(channels)] > 0  # (emission, channel)
    bits = np.zeros((order, len(high), board.channels), np.int8)
    bits[:, :, channels] = same[:, None, :] == high[None, :, None]
    words: Words = np.stack([packing.drive_words(emission) for emission in bits])
    edges_hz = np.count_nonzero(np.diff(high)) / board.waveform.duration_s
    if edges_hz > board.limits.max_edge_rate_hz:
        raise ConfigError(
            f"a {kind} has {edges_hz:,.0f} edges a second, above limits.max_edge_rate_hz = {board.limits.max_edge_rate_hz:,.0f}"
        )
    return words


def ringing_s(board: Board) -> float:
    """Time for which the plate rings after an emission, in s."""
    damping = board.plate.damping
    times_ms = [at.decay_time_ms for at in damping.decay_times] if damping else [board.plate.decay_time_ms]
    return 8e-3 * max(times_ms)


def period_s(board: Board, ring_s: float) -> float:
    """Least time from one emission to the next: its length, what rings on, and what the limits of the board ask for."""
    limits, edges_hz = board.limits, 2 * board.waveform.band_high_hz * BEYOND[1]
    in_emission = edges_hz * board.waveform.duration_s
    apart_s = max(in_emission / limits.max_channel_edge_rate_hz, len(board.actuators) * in_emission / limits.max_total_edge_rate_hz)
    return max(board.waveform.duration_s + ring_s, board.waveform.duration_s / limits.max_duty, apart_s)


def _chirp(board: Board) -> Bools:
    """Signs of a chirp, (word,)."""
    waveform = board.waveform
    low_hz, high_hz = waveform.band_low_hz * BEYOND[0], waveform.band_high_hz * BEYOND[1]
    time_s = (np.arange(waveform.samples) + 0.5) * waveform.bit_period_s
    cycles = low_hz * time_s + (high_hz - low_hz) * time_s**2 / (2 * waveform.duration_s)
    return cycles % 1 < 0.5


def _noise(board: Board, seed: int) -> Bools:
    """Signs of band-limited noise, (word,)."""
    waveform = board.waveform
    spectrum = np.fft.rfft(np.random.default_rng(seed).standard_normal(waveform.samples))
    frequency_hz = np.fft.rfftfreq(waveform.samples, waveform.bit_period_s)
    spectrum[(frequency_hz < waveform.band_low_hz * BEYOND[0]) | (frequency_hz > waveform.band_high_hz * BEYOND[1])] = 0
    return np.fft.irfft(spectrum, waveform.samples) > 0
