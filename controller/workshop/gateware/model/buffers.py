"""Waveform buffers of the gateware model: `waveform_buffer.v`, with the CRC check of what was stored."""

import zlib
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.device.fpga.registers import CHUNK_WORDS, CHUNKS, WAVEFORM_WORDS, Result

CHECK_TICKS = 5  # from the execution of a STORE to the end of its check, in addition to one tick for each word
ADDRESS_TICKS = 4  # a READ of memory must not follow other addresses of the memory sooner


class _Check(NamedTuple):
    slot: int
    intact: bool
    crc: int
    until: int


class Buffers:
    """The waveform buffers: one for each slot, and the landing buffer for uploads; STORE exchanges two of them."""

    def __init__(self, slots: int) -> None:
        self._words = np.zeros((slots + 1, WAVEFORM_WORDS), np.uint32)
        self.slot_buffer = list(range(slots))
        self.slot_words = [0] * slots  # 0: nothing stored
        self.landing = slots
        self.chunk_words = [0] * CHUNKS  # in the landing buffer; 0: not accepted
        self._slot_crc = [0] * slots
        self._intact = [False] * slots
        self._check: _Check | None = None
        self._checked_until = 0

    def waveform(self, buffer: int) -> NDArray[np.uint32]:
        """View of a whole buffer, (1000,) uint32."""
        return self._words[buffer, :]

    def write(self, chunk: int, payload: memoryview) -> None:
        """Write the `payload` of a LOAD to the landing buffer; the chunk counts only once the frame is accepted."""
        first = chunk * CHUNK_WORDS
        words = np.frombuffer(payload, "<u4")
        self._words[self.landing, first : first + len(words)] = words
        self.chunk_words[chunk] = 0

    def checking(self, tick: int) -> bool:
        """Whether some slot is being checked in `tick`."""
        if self._check and tick >= self._check.until:
            slot, intact, crc, until = self._check
            self._intact[slot], self._slot_crc[slot] = intact, crc
            self._checked_until = until
            self._check = None
        return self._check is not None

    def checking_slot(self, tick: int, slot: int) -> bool:
        """Whether `slot` is being checked in `tick`."""
        return self.checking(tick) and self._check is not None and self._check.slot == slot

    def intact(self, tick: int, slot: int) -> bool:
        """Whether the content of `slot` has been checked by `tick` and matches its CRC."""
        return not self.checking_slot(tick, slot) and self._intact[slot]

    def store(self, tick: int, slot: int, length_words: int, crc: int, *, live: bool) -> Result:
        """Exchange the landing buffer for that of a slot, and begin its check.

        `crc` is what it must have; `live`: whether the landing buffer plays, or waits to. Returns OK, or why nothing was stored.
        """
        if slot >= len(self.slot_buffer):
            return Result.BAD_SLOT
        if not 1 <= length_words <= WAVEFORM_WORDS:
            return Result.BAD_VALUE
        if live or self.checking(tick):
            return Result.BUSY
        for chunk, words in enumerate(self.chunk_words):
            if words < min(length_words - chunk * CHUNK_WORDS, CHUNK_WORDS):
                return Result.INCOMPLETE
        self.landing, self.slot_buffer[slot] = self.slot_buffer[slot], self.landing
        self.slot_words[slot] = length_words
        self._intact[slot] = False
        self.chunk_words = [0] * CHUNKS
        found = zlib.crc32(self.waveform(self.slot_buffer[slot])[:length_words].astype("<u4").tobytes())
        self._check = _Check(slot, found == crc, found, tick + length_words + CHECK_TICKS)
        return Result.OK

    def loaded(self, tick: int) -> int:
        """Value of SLOTS_LOADED in `tick`: bit k is set if slot k holds a waveform whose CRC matches."""
        return sum(1 << slot for slot in range(len(self.slot_words)) if self.intact(tick, slot))

    def chunks(self) -> int:
        """Bit k is set if chunk k of the landing buffer was accepted."""
        return sum(1 << chunk for chunk, words in enumerate(self.chunk_words) if words)

    def read_crc(self, tick: int, slot: int) -> tuple[Result, int]:
        """Result and value of reading the CRC of `slot` in `tick`."""
        if slot >= len(self.slot_buffer):
            return Result.BAD_SLOT, 0
        if not self.slot_words[slot]:
            return Result.EMPTY_SLOT, 0
        if self.checking_slot(tick, slot):
            return Result.BUSY, 0
        return Result.OK, self._slot_crc[slot]

    def read_memory(self, tick: int, slot: int, word: int, played_until: dict[int, int]) -> tuple[Result, int]:
        """Result and value of reading a word of a slot, which is BUSY during and shortly after a check or an emission.

        `played_until` has for each buffer the tick after its last emission.
        """
        if slot >= len(self.slot_buffer):
            return Result.BAD_SLOT, 0
        if word >= self.slot_words[slot]:
            return Result.BAD_RANGE, 0
        buffer = self.slot_buffer[slot]
        if self.checking(tick) or tick < max(self._checked_until, played_until.get(buffer, 0)) + ADDRESS_TICKS:
            return Result.BUSY, 0
        return Result.OK, int(self.waveform(buffer)[word])
