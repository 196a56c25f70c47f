"""How good the wires to an FPGA are: errors at each SCK, a bound for what was not seen, and the SCK that follows."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Protocol, runtime_checkable

import numpy as np

from controller.errors import LinkError
from controller.fpga import frames
from controller.fpga.bring_up import BitErrors, bit_errors
from controller.fpga.frames import FRAME_BYTES, LOAD_FRAME_BYTES
from controller.fpga.link import Link
from controller.fpga.registers import LOAD_PAYLOAD_MAX_BYTES
from controller.fpga.session import Session

SWEEP_STEPS = (1 / 16, 1 / 8, 1 / 4, 3 / 8, 1 / 2, 5 / 8, 3 / 4, 7 / 8, 1.0)  # of the board's SCK
MARGIN = 0.8  # below the slowest SCK that failed
CONFIDENCE = 0.95
TIMED_MESSAGES = 31


@runtime_checkable
class ClockedLink(Link, Protocol):
    """A link whose SCK can be set.

    Attributes
    ----------
    sck_hz : float
        What it is now.
    """

    sck_hz: float

    def set_sck_hz(self, sck_hz: int) -> float:
        """Ask for another one, at most the board's; what it is then."""


@dataclass(frozen=True, slots=True)
class SpeedResult:
    """What random bits met at one SCK."""

    asked_hz: int
    sck_hz: float
    bits: int
    errors: int
    trouble: str  # why it could not be measured; empty if it was

    @property
    def good(self) -> bool:
        """No error at all."""
        return not self.errors and not self.trouble


def error_rate_bound(errors: int, bits: int, confidence: float = CONFIDENCE) -> float:
    """The bit-error rate that is not exceeded, with this confidence: for no errors in N bits, 3 / N at 95 %.

    The exact bound of a Poisson count: the mean at which so few errors would be seen with 1 - confidence only.
    """
    if not bits:
        return 1.0

    def so_few(mean: float) -> float:
        return math.fsum(math.exp(k * math.log(mean) - mean - math.lgamma(k + 1)) for k in range(errors + 1))

    low, high = 1e-9, errors + 10 * math.sqrt(errors + 1) + 10
    for _ in range(100):
        middle = (low + high) / 2
        if so_few(middle) > 1 - confidence:
            low = middle
        else:
            high = middle
    return min(high / bits, 1.0)


def bit_error_count(found: BitErrors) -> tuple[int, int]:
    """(bits, errors): one damaged bit may show twice, in a refused frame and in its echo."""
    return found.bits or 8 * LOAD_FRAME_BYTES * found.frames, max(found.wrong_bits, found.frames_refused + found.answers_damaged)


def sweep(
    session: Session,
    link: ClockedLink,
    limit_hz: int,
    bits: float,
    rng: np.random.Generator,
    progress: Callable[[int, int], None] = lambda *_: None,
) -> list[SpeedResult]:
    """Send random bits at each step up to `limit_hz`; the link is left at the slowest.

    Parameters
    ----------
    bits : float
        To send at each step, at least.
    """
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
    """The SCK to ask for: the fastest without an error at it or below, and at most 0.8 of the slowest that had one.

    None if even the slowest had one.
    """
    failed_hz = min((speed.asked_hz for speed in speeds if not speed.good), default=math.inf)
    return max((speed.asked_hz for speed in speeds if speed.good and speed.asked_hz <= MARGIN * failed_hz), default=None)


def measured_sck_hz(session: Session, link: Link) -> float:
    """SCK by the clock on the wall: what a long frame takes more than a short one; the system call itself falls out.

    Right where a transfer is not delayed by other work: the median of a few is taken.
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
