"""Bring-up of an FPGA: what it is, whether the link carries every bit, whether its memory keeps them, whether each wire moves.

Every step is a function of an open session, so it is the same for the model, the compiled Verilog and a board on a bench.
"""

from __future__ import annotations

import math
import selectors
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from controller.board.board import Board
from controller.errors import LinkError
from controller.fpga import frames
from controller.fpga.capture import Capture
from controller.fpga.frames import ALL_CHANNELS, CRC, ECHO_DELAY_BYTES, FRAME_BYTES, HEADER
from controller.fpga.registers import (
    CHANNELS,
    LOAD_PAYLOAD_MAX_BYTES,
    READ_MEMORY,
    READ_QUEUE,
    Register,
    Start,
)
from controller.fpga.session import Session

SEED = 1
TEST_FRAMES = 8  # in one message: as many bytes as an upload
CHIRP_LOW_HZ, CHIRP_HIGH_HZ = 1e3, 20e3  # heard by anybody, and 1 to 2 edges where an emission has 10
CHIRP_REPETITIONS = 20
CHIRP_DUTY = 0.1


class Clock(Protocol):
    """The loop's clock: its time, and how it waits."""

    def now_s(self) -> float:
        """Time in s."""

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Return at `until_s` or earlier."""


@dataclass(frozen=True, slots=True)
class BitErrors:
    """Bits sent in TEST frames and what became of them."""

    frames: int
    frames_refused: int  # by the FPGA, for sync word, length or CRC
    answers_damaged: int
    bits: int  # that came back, there and back again
    wrong_bits: int


@dataclass(frozen=True, slots=True)
class Checked:
    """What bring-up found; `complaints` say what is wrong and what to do, one sentence each."""

    registers: dict[str, int]
    bit_errors: BitErrors
    slots: int
    slots_damaged: int
    channels: list[int]  # whose chirps ran to their end
    channels_moved: list[list[int]] | None  # for each of them, the pins that moved; None without sight of the pins
    complaints: list[str]


def check(
    session: Session,
    board: Board,
    clock: Clock,
    bits: float,
    channels: Sequence[int],
    pause_s: float = 0.0,
    progress: Callable[[int, int], None] = lambda *_: None,
    take_capture: Callable[[], Capture] | None = None,
) -> Checked:
    """All of bring-up, one thing after the other; outputs are off at the end.

    Parameters
    ----------
    bits : float
        Random bits to send at least.
    channels : sequence of int
        To chirp on.
    pause_s : float
        Silence behind each channel's chirps, for somebody who listens.
    progress : callable
        Told of the bits sent and of all there are to send.
    take_capture : callable or None
        What the pins did since the last call, where that can be seen.
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
    for channel in channel_self_test(session, board, clock, channels, pause_s, lambda: take_capture and take_capture()):
        chirped.append(channel)
        if take_capture:
            moved.append(_moved(take_capture()))
    wrong = [channel for channel, pins in zip(chirped, moved, strict=False) if pins != [channel]]
    if wrong:
        complaints.append(f"channels {wrong} moved other pins than their own, or none: check the pin constraints")
    return Checked(registers, errors, board.link.slots, damaged, chirped, moved if take_capture else None, complaints)


def _moved(capture: Capture) -> list[int]:
    """Channels whose pins went there and back."""
    changed = int(np.bitwise_or.reduce(capture.words[1:] ^ capture.words[:-1], initial=0))
    return [channel for channel in range(CHANNELS) if changed >> channel & 1]


def identify(session: Session) -> dict[str, int]:
    """Every register that can be read, by its name."""
    return {register.name.lower(): session.exchange.read(register) for register in Register if register.access != "WO"}


def bit_errors(
    session: Session, bits: float, rng: np.random.Generator, progress: Callable[[int, int], None] = lambda *_: None
) -> BitErrors:
    """Send random bits, have them sent back, and count what is wrong with them.

    Over a UART nothing is sent back: only refused frames and damaged answers are counted.

    Parameters
    ----------
    bits : float
        To be sent, at least.
    progress : callable
        Told how many were sent so far, and of how many.
    """
    exchange = session.exchange
    frame_bytes = HEADER.size + LOAD_PAYLOAD_MAX_BYTES + CRC.size
    lengths = [frame_bytes] * TEST_FRAMES
    refused_before = exchange.read(Register.FRAME_ERRORS)
    sent = damaged = back = wrong = 0
    messages = max(math.ceil(bits / (8 * frame_bytes * TEST_FRAMES)), 1)
    for message in range(messages):
        end = 0
        for number in range(TEST_FRAMES):
            payload = rng.bytes(LOAD_PAYLOAD_MAX_BYTES)
            end = frames.pack_test(exchange.sent, end, exchange.sequence + number, payload)
        damaged += exchange.unchecked(lengths)
        there = np.frombuffer(exchange.sent[:end], np.uint8).reshape(TEST_FRAMES, frame_bytes)
        here = np.frombuffer(exchange.received[:end], np.uint8).reshape(TEST_FRAMES, frame_bytes)
        echo = here[:, FRAME_BYTES:]
        if echo.any():
            wrong += int(np.unpackbits(echo ^ there[:, FRAME_BYTES - ECHO_DELAY_BYTES : -ECHO_DELAY_BYTES]).sum())
            back += 8 * echo.size
        sent += TEST_FRAMES
        progress(message + 1, messages)
    refused = exchange.read(Register.FRAME_ERRORS) - refused_before
    return BitErrors(sent, refused, damaged, back, wrong)


def read_slot(session: Session, slot: int, length_words: int) -> bytes:
    """The first words of a slot, out of the FPGA's memory.

    Raises
    ------
    Refused
        If the slot holds fewer.
    """
    words = [session.exchange.read_address(READ_MEMORY + 1024 * slot + word) for word in range(length_words)]
    return np.array(words, "<u4").tobytes()


def read_queue(session: Session) -> list[tuple[int, ...]]:
    """The words of every play that waits, head first."""
    queued = session.exchange.read(Register.QUEUE)
    return [tuple(session.exchange.read_address(READ_QUEUE + 8 * number + word) for word in range(6)) for number in range(queued)]


def memory_errors(session: Session, board: Board, rng: np.random.Generator) -> int:
    """Fill every slot with random words, have them checked and read back; how many slots did not keep them."""
    wrong = 0
    for slot in range(board.link.slots):
        words = rng.bytes(4 * board.waveform.samples)
        session.upload(slot, memoryview(words))
        loaded = session.exchange.read(Register.SLOTS_LOADED) >> slot & 1
        crc = session.exchange.read_slot_crc(slot)
        wrong += not loaded or crc != zlib.crc32(words) or read_slot(session, slot, board.waveform.samples) != words
    return wrong


def chirp_words(board: Board) -> NDArray[np.uint32]:
    """(sample,) words of a square chirp on all channels: few edges, and a sound that is heard by ear."""
    duration_s = board.waveform.duration_s
    time_s = np.arange(board.waveform.samples) * board.waveform.bit_period_s
    cycles = CHIRP_LOW_HZ * time_s + (CHIRP_HIGH_HZ - CHIRP_LOW_HZ) * time_s**2 / (2 * duration_s)
    return np.where(cycles % 1 < 0.5, np.uint32(0), np.uint32(ALL_CHANNELS))


def channel_self_test(
    session: Session,
    board: Board,
    clock: Clock,
    channels: Sequence[int],
    pause_s: float = 0.0,
    armed: Callable[[], object] = lambda: None,
) -> Iterator[int]:
    """Chirp on one channel after the other, all others idle; yields each channel behind its chirp.

    Whoever listens, or looks at the pins, finds dead and swapped wires. Outputs are off at the end. Without a channel
    nothing is armed.

    Raises
    ------
    LinkError
        If a channel's chirp did not run to its end.
    """
    if not channels:
        return
    period_s = board.waveform.duration_s / min(CHIRP_DUTY, board.limits.max_duty)
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
            for channel in channels:
                before = session.heartbeat().emissions
                session.play(0, CHIRP_REPETITIONS, period_s, stop=False, start=Start.NOW, mask=1 << channel)
                rest(session.ready_s() + CHIRP_REPETITIONS * period_s + pause_s)
                done = session.heartbeat().emissions - before & ALL_CHANNELS
                if done != CHIRP_REPETITIONS:
                    raise LinkError(f"channel {channel}: {done} of {CHIRP_REPETITIONS} chirps ran to their end")
                yield channel
            rest(session.disarm())
        finally:
            session.off()
