"""Quality of the link to an FPGA: bit errors at several SCK rates, a bound of the error rate, and a recommended SCK."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Protocol, runtime_checkable

import numpy as np

from controller.device.doctor.bit_errors import BitErrors, bit_errors
from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES, LOAD_FRAME_BYTES
from controller.device.fpga.links.link import Link
from controller.device.fpga.registers import LOAD_PAYLOAD_MAX_BYTES
from controller.device.fpga.session import Session
from controller.errors import LinkError

SWEEP_STEPS = (1 / 16, 1 / 8, 1 / 4, 3 / 8, 1 / 2, 5 / 8, 3 / 4, 7 / 8, 1.0)  # of the board's SCK
MARGIN = 0.8  # below the slowest SCK that failed
CONFIDENCE = 0.95
TIMED_MESSAGES = 31


@runtime_checkable
class ClockedLink(Link, Protocol):
    """A link whose SCK can be set."""

    sck_hz: float  # actual SCK

    def set_sck_hz(self, sck_hz: int) -> float:
        """Set SCK to `sck_hz`, at most the board's; returns the actual SCK in Hz."""


@dataclass(frozen=True, slots=True)
class SpeedResult:
    """Result of sending random bits at one SCK."""

    asked_hz: int  # SCK asked for
    sck_hz: float  # actual SCK
    bits: int  # bits, errors: bits that were checked, and errors among them
    errors: int
    # Why nothing could be measured; empty if it could
    trouble: str  # why it could not be measured; empty if it was

    @property
    def good(self) -> bool:
        """Whether there was no error at all."""
        return not self.errors and not self.trouble


def error_rate_bound(errors: int, bits: int, confidence: float = CONFIDENCE) -> float:
    """Upper bound of the bit-error rate: for no errors in N bits, 3 / N at 95 %.

    Exact bound of a Poisson count: the rate at which so few `errors` have the probability 1 - `confidence`; 1 without bits.
    """
    if not bits:
        return 1.0

    def probability(mean: float) -> float:
        return math.fsum(math.exp(k * math.log(mean) - mean - math.lgamma(k + 1)) for k in range(errors + 1))

    low, high = 1e-9, errors + 10 * math.sqrt(errors + 1) + 10
    for _ in range(100):
        middle = (low + high) / 2
        if probability(middle) > 1 - confidence:
            low = middle
        else:
            high = middle
    return min(high / bits, 1.0)


def bit_error_count(found: BitErrors) -> tuple[int, int]:
    """Bits checked and errors among them; one damaged bit may show twice, as a refused frame and in its echo.

    Without echo (UART) all bits sent, and the frames and answers that were damaged.
    """
    return found.bits or 8 * LOAD_FRAME_BYTES * found.frames, max(found.wrong_bits, found.frames_refused + found.answers_damaged)


def sweep(
    session: Session,  # on `link`
    link: ClockedLink,
    limit_hz: int,  # highest SCK
    bits: float,  # least number of bits to send at each rate
    rng: np.random.Generator,
    progress: Callable[[int, int], None] = lambda *_: None,  # called with the number of rates done and of all
) -> list[SpeedResult]:
    """Send random bits at nine SCK rates up to `limit_hz`; leaves the link at the slowest, which is the first of the results."""
    speeds = []
    for number, step in enumerate(SWEEP_STEPS):
        asked_hz = round(limit_hz * step)
        sck_hz = link.set_sck_hz(asked_hz)
        try:
            found = bit_errors(session, bits, rng)
            speeds.append(SpeedResult(asked_hz, sck_hz, *bit_error_count(found), trouble=""))
        except LinkError as error:
            speeds.append(SpeedResult(asked_hz, sck_hz, 0, 1, trouble=str(error)))
        progress(number + 1, len(SWEEP_STEPS))
    link.set_sck_hz(speeds[0].asked_hz)
    return speeds


def proposed_sck_hz(speeds: Sequence[SpeedResult]) -> int | None:
    """Recommended SCK in Hz: the fastest without an error that is at most 0.8 times the slowest with one.

    None if every rate is too near to one with errors, or has some.
    """
    failed_hz = min((speed.asked_hz for speed in speeds if not speed.good), default=math.inf)
    return max((speed.asked_hz for speed in speeds if speed.good and speed.asked_hz <= MARGIN * failed_hz), default=None)


def measured_sck_hz(session: Session, link: Link) -> float:
    """SCK measured by the time that a long frame takes more than a short one, which cancels the time of the system call.

    The median of 31 of each, since other work on the host may delay some.

    Infinite if the times do not differ.
    """
    exchange = session.exchange
    taken_ns: dict[int, list[int]] = {FRAME_BYTES: [], LOAD_FRAME_BYTES: []}
    for _ in range(TIMED_MESSAGES):
        for size, times in taken_ns.items():
            if size == FRAME_BYTES:
                frames.pack_nop(exchange.sent, 0, exchange.sequence)
            else:
                frames.pack_test(exchange.sent, 0, exchange.sequence, bytes(LOAD_PAYLOAD_MAX_BYTES))
            before_ns = link.wire_ns
            exchange.send_unchecked([size])
            times.append(link.wire_ns - before_ns)
    more_ns = median(taken_ns[LOAD_FRAME_BYTES]) - median(taken_ns[FRAME_BYTES])
    return 8e9 * (LOAD_FRAME_BYTES - FRAME_BYTES) / more_ns if more_ns > 0 else math.inf
