"""The waveform that tests one channel: a chirp through the band, while all other channels stay at their idle levels."""

from __future__ import annotations

from typing import Final

import numpy as np

from controller.device.board.panel import CHANNELS

SAMPLES_A_PERIOD: Final = 6  # at least; a bit clock too slow for the band's end goes as far as that


def chirp_words(channel: int, samples: int, bit_clock_hz: float, idle_word: int, band_hz: tuple[float, float]) -> memoryview:
    """Drive words of a linear chirp on one channel, which begins at that channel's idle level.

    The chirp begins and ends at the board's band. The words have 4 bytes a sample, as they go to the wire; bit q of `idle_word` is
    the level of channel q at rest. Raises ValueError if there is no such channel.
    """
    if not 0 <= channel < CHANNELS:
        raise ValueError(f"channel {channel} is not 0 to {CHANNELS - 1}")
    low_hz, high_hz = (min(end_hz, bit_clock_hz / SAMPLES_A_PERIOD) for end_hz in band_hz)
    at_s = np.arange(samples) / bit_clock_hz
    periods = at_s * (low_hz + (high_hz - low_hz) * at_s / (2 * samples / bit_clock_hz))
    is_turned = np.floor(2 * periods).astype(np.int64) % 2 == 1
    words = np.where(is_turned, idle_word ^ (1 << channel), idle_word)
    return memoryview(words.astype("<u4").tobytes())
