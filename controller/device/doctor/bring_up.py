"""Bring-up tests of an FPGA: identity, bit errors of the link, waveform memory, and each output channel.

Each test is a function of an open session, so that it runs the same on the model, the compiled Verilog and a real board.
"""

from __future__ import annotations

import selectors
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.clocks import Clock
from controller.device.board.board import Board
from controller.device.board.plate.patches import discs
from controller.device.doctor.bit_errors import BitErrors, bit_errors
from controller.device.fpga.capture import Capture
from controller.device.fpga.frames import ALL_CHANNELS, Play
from controller.device.fpga.registers import CHANNELS, READ_MEMORY, Register, Start
from controller.device.fpga.session import Session
from controller.errors import LinkError

SEED = 1
CHIRP_LOW_HZ, CHIRP_HIGH_HZ = 1e3, 20e3  # audible, and 1 to 2 edges where an emission has 10
CHIRP_REPETITIONS = 20
CHIRP_DUTY = 0.1


class Chirps(NamedTuple):
    """What a listener hears: which channels, one after the other."""

    channels: Sequence[int]
    pause_s: float = 0.0  # silence after the chirps of each
    announce: Callable[[int], None] = lambda _channel: None  # called with the channel that is to chirp


@dataclass(frozen=True, slots=True)
class BringUpReport:
    """Results of bring-up; `complaints` say what is wrong and what to do, one sentence each."""

    registers: dict[str, int]
    bit_errors: BitErrors
    slots: int
    slots_damaged: int
    channels: list[int]  # that played all their chirps
    channels_moved: list[list[int]] | None  # for each of them, the pins that moved; None if the pins cannot be observed
    complaints: list[str]


def check(
    session: Session,
    board: Board,
    clock: Clock,
    bits: float,  # least number of random bits to send
    chirps: Chirps,  # outputs are on for them
    progress: Callable[[int, int], None] = lambda *_: None,  # called with the number of messages of random bits sent, and of all
    take_capture: Callable[[], Capture] | None = None,  # returns what the pins did since its last call, if they can be observed
) -> BringUpReport:
    """Run all tests of bring-up; the outputs are off at the end.

    Raises LinkError if the link fails, or a channel does not play all its chirps.
    """
    rng = np.random.default_rng(SEED)
    registers = identify(session)
    errors = bit_errors(session, bits, rng, progress)
    damaged = memory_errors(session, board, rng)
    complaints = []
    if errors.frames_refused or errors.answers_damaged or errors.wrong_bits:
        complaints.append("the link damages bits: shorten its wires, join the grounds, or lower its rate")
    if damaged:
        complaints.append(f"{damaged} of {board.link.slots} slots do not keep what they are given: check the FPGA's supply")
    chirped: list[int] = []
    moved: list[list[int]] = []
    for channel in channel_self_test(session, board, clock, chirps, lambda: take_capture and take_capture()):
        chirped.append(channel)
        if take_capture:
            moved.append(channels_moved(take_capture()))
    wrong = [channel for channel, pins in zip(chirped, moved, strict=False) if pins != [channel]]
    if wrong:
        complaints.append(f"channels {wrong} moved other pins than their own, or none: check the pin constraints")
    return BringUpReport(registers, errors, board.link.slots, damaged, chirped, moved if take_capture else None, complaints)


def channels_moved(capture: Capture) -> list[int]:
    """Channels whose pins changed."""
    changed = int(np.bitwise_or.reduce(capture.words[1:] ^ capture.words[:-1], initial=0))
    return [channel for channel in range(CHANNELS) if changed >> channel & 1]


def identify(session: Session) -> dict[str, int]:
    """Values of all readable registers of the FPGA of `session`, by name in lower case."""
    return {register.name.lower(): session.exchange.read(register) for register in Register if register.access != "WO"}


def read_slot(session: Session, slot: int, length_words: int) -> bytes:
    """Read the first words of a slot from the FPGA's memory.

    Returns 4 bytes for each word. Raises Refused if the slot holds fewer words.
    """
    words = [session.exchange.read_address(READ_MEMORY + 1024 * slot + word) for word in range(length_words)]
    return np.array(words, "<u4").tobytes()


def memory_errors(session: Session, board: Board, rng: np.random.Generator) -> int:
    """Fill every slot with random words, read them and their CRC back, and count the slots that differ."""
    wrong = 0
    for slot in range(board.link.slots):
        words = rng.bytes(4 * board.waveform.samples)
        session.upload(slot, memoryview(words))
        loaded = session.exchange.read(Register.SLOTS_LOADED) >> slot & 1
        crc = session.exchange.read_slot_crc(slot)
        wrong += not loaded or crc != zlib.crc32(words) or read_slot(session, slot, board.waveform.samples) != words
    return wrong


def chirp_words(board: Board) -> NDArray[np.uint32]:
    """Drive words of a square chirp on all channels, (samples,) uint32 for `board`: audible, with few edges."""
    duration_s = board.waveform.duration_s
    time_s = np.arange(board.waveform.samples) * board.waveform.bit_period_s
    cycles = CHIRP_LOW_HZ * time_s + (CHIRP_HIGH_HZ - CHIRP_LOW_HZ) * time_s**2 / (2 * duration_s)
    return np.where(cycles % 1 < 0.5, np.uint32(0), np.uint32(ALL_CHANNELS))


def chirp_period_s(board: Board) -> float:
    """From the beginning of one chirp to the next."""
    return board.waveform.duration_s / min(CHIRP_DUTY, board.limits.max_duty)


def chirp_in_words(board: Board, channel: int) -> str:
    """Where a channel should be heard, of those of a board."""
    own = next(actuator for actuator in board.actuators if actuator.channel == channel)
    disc = next(group for group in discs(board.actuators) if own in group)
    *most, last = sorted(one.channel for one in disc)
    of = f", disc of channels {', '.join(map(str, most))} and {last}" if most else ""
    return f"channel {channel} chirps: patch at x = {own.x_mm:g}, y = {own.y_mm:g} mm{of}"


def channel_self_test(
    session: Session,
    board: Board,
    clock: Clock,
    chirps: Chirps,
    armed: Callable[[], object] = lambda: None,  # called once the outputs are armed
) -> Iterator[int]:
    """Play chirps on one channel after another, all others idle, so that a listener finds dead and swapped wires.

    The outputs are off at the end. Without channels nothing is armed.

    Yields each channel after its chirps. Raises LinkError if a channel does not play all its chirps.
    """
    if not chirps.channels:
        return
    period_s = chirp_period_s(board)
    with selectors.DefaultSelector() as selector:

        def rest(until_s: float) -> None:
            while clock.now_s() < until_s:
                if clock.now_s() >= session.heartbeat_due_s:
                    session.heartbeat()
                clock.wait(selector, min(until_s, session.heartbeat_due_s))

        session.upload(0, memoryview(chirp_words(board).astype("<u4").tobytes()))
        try:
            rest(session.arm())
            session.require_armed()
            armed()
            for channel in chirps.channels:
                chirps.announce(channel)
                before = session.heartbeat().emissions
                period_ticks = session.timing.period_ticks(period_s)
                play = Play(0, emissions=CHIRP_REPETITIONS, start=Start.NOW, period_ticks=period_ticks, mask=1 << channel)
                session.play(play, stop=False)
                rest(session.earliest_trigger_s() + CHIRP_REPETITIONS * period_s + chirps.pause_s)
                done = session.heartbeat().emissions - before & ALL_CHANNELS
                if done < CHIRP_REPETITIONS:  # a message that was sent again may have played one more
                    raise LinkError(f"channel {channel}: {done} of {CHIRP_REPETITIONS} chirps ran to their end")
                yield channel
            rest(session.disarm())
        finally:
            session.off()
