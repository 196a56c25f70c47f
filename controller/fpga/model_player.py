"""Buffers and player of the gateware model: `waveform_buffer.v` and `waveform_player.v`, from change to change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controller.fpga.registers import CHUNK_WORDS, CHUNKS, WAVEFORM_WORDS, Result


class Buffers:
    """One waveform buffer more than there are slots, behind a map: the odd one out is where uploads land."""

    def __init__(self, slots: int) -> None:
        self._words = np.zeros((slots + 1, WAVEFORM_WORDS), np.uint32)
        self.slot_buffer = list(range(slots))
        self.slot_words = [0] * slots  # 0: nothing stored
        self.landing = slots
        self._chunk_words = [0] * CHUNKS

    def waveform(self, buffer: int, length_words: int) -> NDArray[np.uint32]:
        """View of the first words of a buffer."""
        return self._words[buffer, :length_words]

    def write(self, chunk: int, payload: memoryview) -> None:
        """Words of a LOAD enter the landing buffer; its chunk does not count until the frame is accepted."""
        first = chunk * CHUNK_WORDS
        words = np.frombuffer(payload, "<u4")
        self._words[self.landing, first : first + len(words)] = words
        self._chunk_words[chunk] = 0

    def count(self, chunk: int, words: int) -> None:
        """The frame that brought a chunk is accepted."""
        self._chunk_words[chunk] = words

    def store(self, slot: int, length_words: int) -> Result:
        """Give the landing buffer to a slot; the slot's old one is where the next upload lands."""
        if slot >= len(self.slot_buffer):
            return Result.BAD_SLOT
        if not 1 <= length_words <= WAVEFORM_WORDS:
            return Result.BAD_VALUE
        for chunk, words in enumerate(self._chunk_words):
            if words < min(length_words - chunk * CHUNK_WORDS, CHUNK_WORDS):
                return Result.INCOMPLETE
        self.landing, self.slot_buffer[slot] = self.slot_buffer[slot], self.landing
        self.slot_words[slot] = length_words
        self._chunk_words = [0] * CHUNKS
        return Result.OK

    def loaded(self) -> int:
        """Bit k: slot k holds a waveform."""
        return sum(1 << slot for slot, words in enumerate(self.slot_words) if words)


@dataclass(frozen=True, slots=True)
class Play:
    """An accepted play command; it keeps the buffer it was accepted with."""

    buffer: int
    length_words: int
    count: int  # 0: endless
    period_ticks: int


class Player:
    """The running play and the pending one. Ticks are those of the player's state, before the output pipeline."""

    def __init__(self) -> None:
        self.pending: Play | None = None
        self.running: Play | None = None  # sounding, or in the pause before its next emission
        self.playing = False
        self.remaining = 0  # emissions after this one
        self._start = 0
        self._end = 0

    @property
    def repeating(self) -> bool:
        """More emissions of the running play are to come."""
        return self.running is not None and (self.remaining > 0 or self.running.count == 0)

    def uses(self, buffer: int) -> bool:
        """The running or the pending play needs what is in this buffer."""
        return any(play is not None and play.buffer == buffer for play in (self.running, self.pending))

    def next_change(self) -> int | None:
        """Last tick before an emission ends or the next of a repetition begins."""
        if self.playing:
            return self._end - 1
        return self._due if self.running else None

    def is_last(self, tick: int) -> bool:
        """The emission that sounds ends after this tick."""
        return self.playing and tick == self._end - 1

    def is_due(self, tick: int) -> bool:
        """The next emission of a repetition begins after this tick."""
        return self.repeating and tick == self._due

    @property
    def _due(self) -> int:
        assert self.running
        return self._start + self.running.period_ticks - 1

    def start(self, play: Play, tick: int, bit_ticks: int, *, again: bool) -> None:
        """Sound `play` from the tick after `tick`; `again`: as the next emission of the running repetition."""
        if again:
            self.remaining = max(self.remaining - 1, 0)
        else:
            self.remaining = max(play.count - 1, 0)
        self.running = play
        self.playing = True
        self._start = tick + 1
        self._end = self._start + play.length_words * bit_ticks

    def end(self) -> None:
        """The emission is over."""
        self.playing = False
        if not self.repeating:
            self.running = None

    def stop(self) -> None:
        """Drop the pending play; let the running one end with its current emission."""
        self.pending = None
        self.remaining = 0
        if not self.playing:
            self.running = None
        elif self.running is not None:
            self.running = Play(self.running.buffer, self.running.length_words, 1, self.running.period_ticks)

    def drop(self) -> None:
        """Forget everything."""
        self.pending = self.running = None
        self.playing = False
        self.remaining = 0
