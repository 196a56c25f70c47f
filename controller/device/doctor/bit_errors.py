"""Bit errors of the link to an FPGA: random bits in TEST frames, compared with their echo."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from controller.device.fpga import frames
from controller.device.fpga.frames import ECHO_DELAY_BYTES, FRAME_BYTES, LOAD_FRAME_BYTES
from controller.device.fpga.registers import LOAD_PAYLOAD_MAX_BYTES, Register
from controller.device.fpga.session import Session

TEST_FRAMES = 8  # in one message: as many bytes as an upload


@dataclass(frozen=True, slots=True)
class BitErrors:
    """Result of sending random bits in TEST frames."""

    frames: int
    frames_refused: int  # by the FPGA, for sync word, length or CRC
    answers_damaged: int
    bits: int  # echoed: they passed the link in both directions
    wrong_bits: int


def bit_errors(
    session: Session, bits: float, rng: np.random.Generator, progress: Callable[[int, int], None] = lambda *_: None
) -> BitErrors:
    """Send random bits in TEST frames, compare them with the echo, and count errors.

    A UART has no echo: only refused frames and damaged answers are counted.

    At least `bits` are sent; `progress` is called with the number of messages sent, and of all.
    """
    exchange = session.exchange
    lengths = [LOAD_FRAME_BYTES] * TEST_FRAMES
    refused_before = exchange.read(Register.FRAME_ERRORS)
    sent = damaged = back = wrong = 0
    messages = max(math.ceil(bits / (8 * LOAD_FRAME_BYTES * TEST_FRAMES)), 1)
    for message in range(messages):
        end = 0
        for number in range(TEST_FRAMES):
            payload = rng.bytes(LOAD_PAYLOAD_MAX_BYTES)
            end = frames.pack_test(exchange.sent, end, exchange.sequence + number, payload)
        damaged += exchange.send_unchecked(lengths)
        there = np.frombuffer(exchange.sent[:end], np.uint8).reshape(TEST_FRAMES, LOAD_FRAME_BYTES)
        here = np.frombuffer(exchange.received[:end], np.uint8).reshape(TEST_FRAMES, LOAD_FRAME_BYTES)
        echo = here[:, FRAME_BYTES:]
        if echo.any():
            wrong += int(np.unpackbits(echo ^ there[:, FRAME_BYTES - ECHO_DELAY_BYTES : -ECHO_DELAY_BYTES]).sum())
            back += 8 * echo.size
        sent += TEST_FRAMES
        progress(message + 1, messages)
    refused = exchange.read(Register.FRAME_ERRORS) - refused_before
    return BitErrors(sent, refused, damaged, back, wrong)
