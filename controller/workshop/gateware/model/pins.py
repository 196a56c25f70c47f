"""The output pins of the gateware model as a list of segments, expanded to ticks and words when a capture is taken.

A segment is a row of words, each held for a bit period, the last one until the next segment begins. A later event that takes
effect earlier (a fault cuts what is still in the pipeline) replaces the segments planned from there on.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Words
from controller.device.fpga.capture import Capture
from controller.workshop.gateware.model.limits import StageLimits

WHOLE = 1 << 16  # one tick, in parts of a tick


class Segment(NamedTuple):
    """`words[i]` on the pins from `start + floor((first + i) * period / 65536)`."""

    start: int
    words: Words
    period: int  # in 65536ths of a tick
    hv: int
    first: int = 0

    def ticks(self) -> NDArray[np.int64]:
        """Ticks in which the words reach the pins, (n,) int64."""
        numbers = np.arange(self.first, self.first + len(self.words), dtype=np.int64)
        return self.start + (numbers * self.period >> 16)

    @property
    def begin(self) -> int:
        """Tick in which the first word reaches the pins."""
        return self.start + (self.first * self.period >> 16)


class Pins:
    """Channel pins, high-voltage enable, alive and focus pin since the last capture.

    The limits check every segment; `alive_half_ticks` is half a period of `hv_alive_o`.
    """

    def __init__(self, limits: StageLimits, alive_half_ticks: int) -> None:
        self._limits = limits
        self._alive_half_ticks = alive_half_ticks
        self._on_from: int | None = None  # a rise of `hv_alive_o`, the last before the end of the last capture; None: it is low
        self._taken_until = -1
        self._segments = [Segment(0, np.zeros(1, np.uint32), WHOLE, 0)]
        self._shown = 1  # words of the first segment that earlier captures contained
        self._last = (0, 0)  # word and enable at the end of the last capture
        self._focus_ticks: list[int] = []
        self._focus_until = 0

    def put(self, segment: Segment) -> None:
        """Plan a segment; it replaces what was planned from its beginning on."""
        begin = segment.begin
        while self._segments[-1].begin >= begin and len(self._segments) > 1:
            self._segments.pop()
        self._segments.append(segment)
        self._limits.show(segment.ticks(), segment.words)

    def put_word(self, tick: int, word: int, *, hv: int) -> None:
        """Plan that the pins hold one word from `tick` on, with the high-voltage enable `hv`."""
        self.put(Segment(tick, np.array([word], np.uint32), WHOLE, hv))

    def hv_at(self, tick: int) -> int:
        """Level of the high-voltage enable at `tick`, which must not be before the last capture."""
        for segment in reversed(self._segments):
            if segment.begin <= tick:
                return segment.hv
        return 0

    def focus(self, tick: int, hold_ticks: int) -> None:
        """Set the focus pin high from `tick`, at which an emission ends, for `hold_ticks`."""
        if tick > self._focus_until:
            self._focus_ticks.append(tick)
        self._focus_until = tick + hold_ticks

    def cut_focus(self) -> None:
        """Set the focus pin low."""
        self._focus_until = 0

    def take(self, now: int) -> Capture:
        """Capture of everything up to tick `now` since the last capture."""
        ticks: list[NDArray[np.int64]] = []
        words: list[Words] = []
        levels: list[NDArray[np.uint8]] = []
        first = self._shown
        known = [segment for segment in self._segments if segment.begin <= now]
        for segment, following in zip(known, [*known[1:], None], strict=True):
            until = following.begin if following else now + 1
            all_ticks = segment.ticks()
            end = int(np.searchsorted(all_ticks, until))
            ticks.append(all_ticks[first:end])
            words.append(segment.words[first:end])
            levels.append(np.full(max(end - first, 0), segment.hv, np.uint8))
            self._shown = max(end, first)
            first = 0
        self._segments = self._segments[len(known) - 1 :]
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
        all_ticks = np.concatenate(ticks)[changed]
        alive = self._alive(all_ticks, all_levels[changed], level_before, now)
        return Capture(all_ticks.astype(np.uint64), all_words[changed], all_levels[changed], focus_ticks, alive_ticks=alive)

    def _alive(self, ticks: NDArray[np.int64], levels: NDArray[np.uint8], level_before: int, now: int) -> NDArray[np.uint64]:
        """Ticks of changes of `hv_alive_o`: a square wave while the high voltage is enabled, low otherwise."""
        changes = []
        switched = np.diff(levels, prepend=np.uint8(level_before)) != 0
        edges = [*zip(ticks[switched].tolist(), levels[switched].tolist(), strict=True), (now + 1, None)]
        for tick, level in edges:
            if self._on_from is not None:
                toggles = np.arange(self._on_from, tick, self._alive_half_ticks)
                changes.append(toggles[toggles > self._taken_until])
                if level == 0 and len(toggles) % 2:
                    changes.append(np.array([tick]))
            if level is not None:
                self._on_from = tick if level else None
        self._taken_until = now
        if self._on_from is not None:  # keeps the phase, without the periods that earlier captures contained
            self._on_from += max(now - self._on_from, 0) // (2 * self._alive_half_ticks) * 2 * self._alive_half_ticks
        return np.concatenate([np.zeros(0, np.int64), *changes]).astype(np.uint64)


def modulate(levels: range, full_scale: int, errors: tuple[int, int] = (0, 0)) -> tuple[list[bool], tuple[int, int]]:
    """Second-order sigma-delta modulation of levels to one bit each, as `idle_ramp.v`.

    `v = level + 2 e1 - e2`, the bit is `2 v >= full_scale`, and the error `v - bit * full_scale` is limited to 1.5 full scales:
    without the limit the loop rings near both ends, where one bit has no headroom.

    `levels` are 0 to `full_scale`; `errors` are the last two of the bits before, latest first. Returns the bits, and the last two
    errors, latest first.
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
def ramp_bits(samples: int, *, up: bool) -> Bools:
    """Bits of a whole ramp up or down, (samples,) bool; `up`: levels 1, 2 ... samples, otherwise back to 0."""
    levels = range(1, samples + 1) if up else range(samples - 1, -1, -1)
    return np.array(modulate(levels, samples)[0], bool)


def turned_ramp_bits(samples: int, reached: int) -> Bools:
    """Bits of the way down, (reached,) bool, of a ramp up that was reversed at level `reached` of `samples`."""
    _, errors = modulate(range(1, reached + 1), samples)
    return np.array(modulate(range(reached - 1, -1, -1), samples, errors)[0], bool)
