"""The output pins of the gateware model as a list of stretches, turned into ticks and words when asked for.

A stretch is a row of words, each held for the same number of ticks, the last one until the next
stretch begins. What happens later but begins earlier (a fault cuts what is still in the pipeline)
replaces what was foreseen, so nothing has to be computed before it is known.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.fpga.capture import Capture

Words = NDArray[np.uint32]


class Stretch(NamedTuple):
    """`words[i]` on the pins from `start + i * word_ticks`."""

    start: int
    words: Words
    word_ticks: int
    hv: int


class Pins:
    """Channel pins, high-voltage enable and focus pin since the last capture."""

    def __init__(self) -> None:
        self._stretches = [Stretch(0, np.zeros(1, np.uint32), 1, 0)]
        self._shown = 1  # words of the first stretch that earlier captures had
        self._last = (0, 0)  # word and enable at the end of the last capture
        self._focus_ticks: list[int] = []
        self._focus_until = 0

    def put(self, start: int, words: Words, word_ticks: int, hv: int) -> None:
        """From tick `start` on, play `words`."""
        while self._stretches[-1].start >= start and len(self._stretches) > 1:
            self._stretches.pop()
        self._stretches.append(Stretch(start, words, word_ticks, hv))

    def hv_at(self, tick: int) -> int:
        """The high-voltage enable at a tick not before the last capture."""
        for stretch in reversed(self._stretches):
            if stretch.start <= tick:
                return stretch.hv
        return 0

    def focus(self, tick: int, hold_ticks: int) -> None:
        """An emission ends at `tick`: the focus pin goes high, or stays so."""
        if tick > self._focus_until:
            self._focus_ticks.append(tick)
        self._focus_until = tick + hold_ticks

    def cut_focus(self) -> None:
        """The focus pin is low again."""
        self._focus_until = 0

    def take(self, now: int) -> Capture:
        """Everything up to tick `now` that no earlier capture had."""
        ticks: list[NDArray[np.uint64]] = []
        words: list[Words] = []
        levels: list[NDArray[np.uint8]] = []
        first = self._shown
        known = [stretch for stretch in self._stretches if stretch.start <= now]
        for stretch, following in zip(known, [*known[1:], None], strict=True):
            until = following.start if following else now + 1
            end = min(len(stretch.words), -(-(until - stretch.start) // stretch.word_ticks))
            count = max(end - first, 0)
            begin = stretch.start + first * stretch.word_ticks
            ticks.append(np.uint64(begin) + np.arange(count, dtype=np.uint64) * np.uint64(stretch.word_ticks))
            words.append(stretch.words[first : first + count])
            levels.append(np.full(count, stretch.hv, np.uint8))
            self._shown = max(end, first)
            first = 0
        self._stretches = self._stretches[len(known) - 1 :]
        all_words = np.concatenate(words)
        all_levels = np.concatenate(levels)
        word_before, level_before = self._last
        changed = (np.diff(all_words, prepend=np.uint32(word_before)) != 0) | (
            np.diff(all_levels, prepend=np.uint8(level_before)) != 0
        )
        if all_words.size:
            self._last = (int(all_words[-1]), int(all_levels[-1]))
        focus_ticks = np.array(self._focus_ticks, np.uint64)
        self._focus_ticks = []
        return Capture(np.concatenate(ticks)[changed], all_words[changed], all_levels[changed], focus_ticks)


def modulate(levels: range, full_scale: int, errors: tuple[int, int] = (0, 0)) -> tuple[list[bool], tuple[int, int]]:
    """Turn levels of 0 to `full_scale` into one bit each by second-order error feedback, as `idle_ramp.v`.

    `v = level + 2 e1 - e2`, the bit is `2 v >= full_scale`, and the error `v - bit * full_scale` is kept
    within 1.5 full scales: without a limit the loop rings near both ends, where one bit has no headroom.

    Returns
    -------
    (list of bool, (int, int))
        The bits and the last two errors, latest first.
    """
    recent, older = errors
    limit = full_scale + (full_scale >> 1)
    bits = []
    for level in levels:
        value = level + 2 * recent - older
        bit = 2 * value >= full_scale
        bits.append(bit)
        older = recent
        recent = max(-limit, min(limit, value - full_scale if bit else value))
    return bits, (recent, older)


@lru_cache(maxsize=8)
def ramp_bits(samples: int, *, up: bool) -> NDArray[np.bool_]:
    """(sample,) the whole ramp between 0 and full scale: 1, 2 ... samples, or back to 0."""
    levels = range(1, samples + 1) if up else range(samples - 1, -1, -1)
    return np.array(modulate(levels, samples)[0], bool)


def turned_ramp_bits(samples: int, reached: int) -> NDArray[np.bool_]:
    """(sample,) the way down of a ramp that had come to level `reached` of `samples` when it was turned back."""
    _, errors = modulate(range(1, reached + 1), samples)
    return np.array(modulate(range(reached - 1, -1, -1), samples, errors)[0], bool)
