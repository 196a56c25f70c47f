"""Queue and player of the gateware model: `play_queue.v`, `play_check.v` and `waveform_player.v`, from change to change.

Ticks are those of the player's state, before the output pipeline.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from controller.device.fpga.registers import QUEUE_PLAYS, Start
from controller.workshop.gateware.model.gate import PIN_TICKS

FETCH_TICKS = 9  # from the acceptance of a play, or the start of the one before, until it is at the head of the queue
DECISION_TICKS = PIN_TICKS + 1  # from the tick in which a play is started to its first word on the pins


def word_tick(number: int, bit_period: int) -> int:
    """Ticks from the first word of an emission to word `number`, with `bit_period` in 65536ths of a tick."""
    return number * bit_period >> 16


@dataclass(frozen=True, slots=True)
class AcceptedPlay:
    """An accepted PLAY, with the buffer that its slot had then."""

    buffer: int
    first: int
    length: int
    count: int  # 0: endless
    period_ticks: int
    start: Start
    when: int  # delay or time
    mask: int
    inverted: bool
    live: bool  # from the landing buffer, during its upload
    raw: tuple[int, ...]  # words of its frame

    def words(self, waveform: NDArray[np.uint32], idle_word: int, first: int, end: int) -> NDArray[np.uint32]:
        """Drive words `first` to `end` of `waveform`, (end - first,) uint32, after polarity; masked channels have `idle_word`."""
        data = waveform[self.first + first : self.first + end]
        if self.inverted:
            data = ~data
        mask = np.uint32(self.mask)
        return data & mask | np.uint32(idle_word & ~self.mask & 0xFFFFFFFF)


class Queue:
    """The queue of accepted plays that have not started."""

    def __init__(self) -> None:
        self.plays: list[AcceptedPlay] = []
        self._head_from = 0
        self._popped = -FETCH_TICKS

    @property
    def full(self) -> bool:
        """Whether the queue is full."""
        return len(self.plays) == QUEUE_PLAYS

    def push(self, tick: int, play: AcceptedPlay) -> None:
        """Append a play that is accepted in `tick`."""
        if not self.plays:
            self._head_from = max(self._head_from, tick + FETCH_TICKS)
        self.plays.append(play)

    def pop(self, tick: int) -> AcceptedPlay:
        """Remove and return the head, which starts in `tick`."""
        self._popped = tick
        self._head_from = tick + FETCH_TICKS
        return self.plays.pop(0)

    def drop(self, tick: int) -> None:
        """Remove all plays in `tick`."""
        self.plays.clear()
        self._head_from = tick

    def head(self, tick: int) -> AcceptedPlay | None:
        """The play at the head, if it has been fetched from memory by `tick`; else None."""
        return self.plays[0] if self.plays and tick >= self._head_from else None

    @property
    def head_from(self) -> int:
        """First tick in which the head has been fetched, if there is a play."""
        return self._head_from

    def fetching(self, tick: int) -> bool:
        """Whether the next head is being fetched in `tick`, so that a READ of the queue is BUSY."""
        return self._popped < tick < self._popped + FETCH_TICKS


class Player:
    """The current play: in an emission, delayed, or in the pause before its next emission."""

    def __init__(self) -> None:
        self.running: AcceptedPlay | None = None
        self.playing = False
        self.remaining = 0  # emissions after this one
        self.release_tick: int | None = None  # in which a delayed play starts its emission
        self.free_from = 0  # first tick in which another play may start, if no emission plays
        self.played_until: dict[int, int] = {}  # of each buffer: the tick after its last emission
        self.start = 0  # first tick of the current emission, or of the last one
        self.end = 0
        self.halting = False
        self.known_words = 0  # of a live emission: words already passed to the pins

    @property
    def repeating(self) -> bool:
        """Whether the current play has more emissions to come."""
        return self.running is not None and (self.remaining > 0 or self.running.count == 0)

    @property
    def live(self) -> bool:
        """Whether the current play comes from the landing buffer."""
        return self.running is not None and self.running.live

    @property
    def delayed(self) -> bool:
        """Whether the current play waits for its delay."""
        return self.release_tick is not None

    def settled(self, tick: int) -> bool:
        """Whether no emission plays in `tick`, and the idle word has been held for a bit period."""
        return not self.playing and tick >= self.free_from

    def quiet(self, tick: int) -> bool:
        """Whether there is no current play in `tick`, and the idle word has been held for a bit period."""
        return self.settled(tick) and self.running is None

    def next_change(self) -> int | None:
        """Next tick after which an emission ends or starts without further input; None if there is none."""
        ticks = [self.end - 1] if self.playing else []
        if self.repeating and not self.delayed:
            ticks.append(self.due_tick)
        if self.release_tick is not None:
            ticks.append(self.release_tick)
        return min(ticks, default=None)

    @property
    def due_tick(self) -> int:
        """Last tick before the next emission of a repetition."""
        assert self.running
        return self.start - 1 + self.running.period_ticks

    def begin(self, play: AcceptedPlay, tick: int) -> None:
        """Make a play the current one in `tick`; it may still wait for its delay."""
        self.running = play
        self.remaining = max(play.count - 1, 0)
        delay_ticks = 0 if play.start is Start.TIME else play.when & 0xFFFFFFFF
        self.release_tick = tick + delay_ticks if delay_ticks else None

    def start_emission(self, tick: int, bit_period: int) -> None:
        """Start an emission of the current play after `tick`, with `bit_period` in 65536ths of a tick."""
        assert self.running
        self.playing = True
        self.release_tick = None
        self.start = tick + 1
        self.end = self.start + word_tick(self.running.length, bit_period)
        self.known_words = 0

    def finish(self, tick: int, bit_ticks: int) -> None:
        """End the emission, whose last tick is `tick`; the idle word follows for `bit_ticks` at least."""
        assert self.running
        self.playing = False
        self.halting = False
        self.played_until[self.running.buffer] = tick + 1
        self.free_from = tick + bit_ticks
        if not self.repeating:
            self.running = None

    def stop(self) -> None:
        """End the play after its current emission."""
        self.remaining = 0
        self.release_tick = None
        if not self.playing:
            self.running = None
        elif self.running is not None and self.running.count == 0:
            self.running = replace(self.running, count=1)

    def halt(self, tick: int, bit_period: int) -> None:
        """End the play after the drive word that plays in `tick`, with `bit_period` in 65536ths of a tick."""
        self.stop()
        if self.playing:
            number = ((tick + 1 - self.start) << 16) // bit_period
            while self.start + word_tick(number, bit_period) < tick + 1:
                number += 1
            ends = self.start + word_tick(number, bit_period)
            self.halting = ends < self.end
            self.end = ends

    def drop(self, tick: int) -> None:
        """Switch everything off after `tick`."""
        if self.playing and self.running and self.start <= tick:
            self.played_until[self.running.buffer] = tick + 1
        self.running = None
        self.playing = self.halting = False
        self.remaining = 0
        self.release_tick = None
        self.free_from = 0
