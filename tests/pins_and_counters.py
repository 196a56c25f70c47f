"""What the loop counted as played against what the pins played, and gateware behind wires that lose and change things."""

from __future__ import annotations

import zlib
from collections import Counter

import numpy as np

from controller.device.fpga.exchange import Refused
from controller.device.fpga.frames import ReadyFrames
from controller.device.fpga.registers import FrameType, Result

WORDS = 1000


def crc_of(waveform):
    """CRC-32 that the FPGA is to find for what is uploaded."""
    return waveform.crc if isinstance(waveform, ReadyFrames) else zlib.crc32(waveform)


def emissions_on_pins(capture, bit_ticks):
    """Tick of the first word, and CRC-32 of the words, of each emission that the pins played to its end."""
    changes = capture.ticks.astype(np.int64)
    emissions = []
    for tick in capture.focus_ticks.astype(np.int64).tolist():
        sampled = tick - bit_ticks * np.arange(WORDS, 0, -1)
        words = capture.words[np.searchsorted(changes, sampled, side="right") - 1]
        emissions.append((tick - WORDS * bit_ticks, zlib.crc32(words.astype("<u4").tobytes())))
    return emissions


class Notes:
    """Notes the waveform of each play that a session has accepted, for `Played`."""

    def __init__(self, session):
        self.crcs = {}  # of what was sent to each slot, as the host sees it
        self.last = None  # CRC-32 of the waveform that was accepted last
        self.starts = []
        self._session = session
        self._upload, self._both, self._play = session.upload, session.upload_and_play, session.play
        session.upload, session.upload_and_play, session.play = self._uploaded, self._uploaded_and_played, self._resident_played

    def _uploaded(self, slot, waveform, *how):
        self.crcs.pop(slot, None)
        self._upload(slot, waveform, *how)
        self.crcs[slot] = crc_of(waveform)

    def _uploaded_and_played(self, play, waveform, **how):
        self.crcs.pop(play.slot, None)
        try:
            self._both(play, waveform, **how)
        except Refused as refusal:
            if refusal.result is Result.TOO_LATE:  # stored, not played
                self.crcs[play.slot] = crc_of(waveform)
            raise
        self.crcs[play.slot] = self.last = crc_of(waveform)

    def _resident_played(self, play, **how):
        self._play(play, **how)
        self.last = self.crcs[play.slot]

    def ticks(self, link):
        """(tick, CRC-32) of each start."""
        return [(link.tick(p.trigger_s) if p.at_ticks is None else p.at_ticks, crc) for p, crc in self.starts]

    def started(self, played):
        self.starts.append((played, self.last))


class Damage:
    """Gateware behind wires on which what `strikes` names goes wrong, counted from when `armed` is set.

    `strikes` is asked for each frame, its answer and each trigger, as ("to", n), ("from", n), ("trigger", n): None for no damage;
    "bit": one bit is flipped; "lost": the frame, answer or edge does not arrive; "twice": the trigger line rises twice.
    """

    def __init__(self, gateware, strikes, bit=100):
        self._gateware = gateware
        self._strikes = strikes
        self._bit = bit
        self.armed = False
        self.frames = self.triggers = 0
        self.plays = []  # frames that are a PLAY
        self.struck = []

    def __getattr__(self, name):
        return getattr(self._gateware, name)

    def _strike(self, kind, number):
        strike = self._strikes(kind, number) if self.armed else None
        if strike:
            self.struck.append((kind, number, strike))
        return strike

    def exchange(self, select_tick, release_tick, mosi, miso):
        number = self.frames
        self.frames += self.armed
        if self.armed and mosi[2] == FrameType.PLAY:
            self.plays.append(number)
        to, back = self._strike("to", number), self._strike("from", number)
        sent = bytearray(mosi)
        if to == "bit":
            sent[self._bit // 8 % len(sent)] ^= 1 << self._bit % 8
        if to == "lost":
            miso[:] = bytes([0xFF]) * len(miso)
        else:
            self._gateware.exchange(select_tick, release_tick, sent, miso)
        if back == "bit":
            miso[self._bit // 8 % 36] ^= 1 << self._bit % 8
        elif back == "lost":
            miso[:] = bytes(len(miso))

    def trigger(self, tick, *how):
        number = self.triggers
        self.triggers += self.armed
        strike = self._strike("trigger", number)
        if strike != "lost":
            self._gateware.trigger(tick, *how)


def match(emissions, starts, bit_ticks):
    """Emissions of the pins whose words are not those of the start before them, by tick; and how many each start has."""
    begun = np.array([tick for tick, _ in starts], np.int64)
    others, found = [], Counter()
    for tick, crc in emissions:
        index = int(np.searchsorted(begun, tick + 4 * bit_ticks, side="right")) - 1
        if index < 0 or crc != starts[index][1]:
            others.append(tick)
        else:
            found[index] += 1
    return others, found


def assert_pins_equal_counters(capture, notes, counters, link, bit_ticks):
    """Each emission on the pins is one that was started, with its words, and each that was started is there or counted as lost.

    Only for runs whose outputs stayed on.
    """
    others, found = match(emissions_on_pins(capture, bit_ticks), notes.ticks(link), bit_ticks)
    assert not others, f"other words than were meant at {others}: {counters.link}"
    absent = [index for index in range(len(notes.starts)) if not found[index]]
    twice = [index for index, (played, _) in enumerate(notes.starts) if found[index] > 1 and played.count == 1]
    assert not twice, f"played more than once: {twice}"
    assert len(absent) == counters.link.emissions_lost, f"{len(absent)} not on the pins ({absent}), counted: {counters.link}"
    assert counters.emissions == len(notes.starts)
