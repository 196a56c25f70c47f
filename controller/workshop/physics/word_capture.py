"""Pins and stages that play words without an FPGA."""

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.bank.packing import as_words, channel_bits
from controller.device.board.board import Board
from controller.device.fpga.capture import Capture


def idle_levels(board: Board) -> Floats:
    """Level of each channel at rest, 0 or 1: (channel,)."""
    levels: Floats = channel_bits(np.array([board.idle_word], np.uint32))[0].astype(np.float64)
    return levels


def volts_above_idle(board: Board, words: NDArray[np.uint32]) -> Floats:
    """Voltage of each channel's stage above that at rest: (sample, channel)."""
    above = channel_bits(words).astype(np.float64) - channel_bits(as_words(board.idle_word, words))
    above *= board.driver.supply_v
    return above


def capture_of_words(
    words: NDArray[np.uint32], bit_ticks: int, idle_word: int, start_tick: int, period_ticks: int = 0, repetitions: int = 1
) -> Capture:
    """Pins that idle from tick 0 on and play `words` from `start_tick` on, without an FPGA.

    A word is held for `bit_ticks`; repetitions are `period_ticks` from start to start, between which the pins hold `idle_word`.
    """
    starts = start_tick + np.arange(repetitions) * period_ticks
    length = len(words) * bit_ticks
    emission = np.arange(len(words) + 1) * bit_ticks
    ticks = np.concatenate([[0], (starts[:, None] + emission).ravel()])
    idle = as_words(idle_word, words)
    played = np.concatenate([idle, *[words, idle] * repetitions])
    last = np.append(ticks[1:] != ticks[:-1], True)  # back to back, the next emission's first word counts
    ticks, played = ticks[last], played[last]
    changed = np.diff(played, axis=0, prepend=np.zeros_like(idle)).reshape(len(played), -1).any(axis=1)
    ticks, played = ticks[changed], played[changed]
    return Capture(
        ticks=ticks.astype(np.uint64),
        words=played,
        hv=np.ones(played.shape, np.uint8),
        focus_ticks=(starts + length).astype(np.uint64),
    )
