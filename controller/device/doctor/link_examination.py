"""`doctor --link`: identity, bit errors and SCK of the link to an FPGA, its memory and its channels."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from controller.clocks import Clock
from controller.device.board.board import Board
from controller.device.doctor import bring_up
from controller.device.doctor.finding import Finding
from controller.device.doctor.link_check import (
    ClockedLink,
    bit_error_count,
    error_rate_bound,
    measured_sck_hz,
    proposed_sck_hz,
    sweep,
)
from controller.device.fpga.capture import Capture
from controller.device.fpga.frames import LOAD_FRAME_BYTES
from controller.device.fpga.links.link import Link
from controller.device.fpga.registers import LOAD_PAYLOAD_MAX_BYTES
from controller.device.fpga.session import Session
from controller.errors import ControllerError

SWEEP_SHARE = 0.1  # of the bits, at each speed of the sweep
SCK_SHARE = 0.7  # at least, of the SCK that was set: a driver's gaps take a fifth, a core clock that idles takes half


@dataclass(frozen=True, slots=True)
class LinkExamined:
    """Results of `doctor --link`: findings, and figures for --json."""

    findings: list[Finding]
    figures: dict[str, Any]


def examine_link(
    board: Board,
    link: Link,  # open
    open_session: Callable[[], Session],  # brings up the FPGA at the other end
    clock: Clock,
    bits: float,  # least number of random bits to send
    chirps: bring_up.Chirps,  # outputs are on for them; without channels they stay off
    progress: Callable[[int, int], None] = lambda *_: None,
    take_capture: Callable[[], Capture] | None = None,  # what the pins of a simulated FPGA did since the last call
) -> LinkExamined:
    """Examine the link: identity, bit errors in both directions, memory, channels, and the highest SCK without errors."""
    findings: list[Finding] = []
    figures: dict[str, Any] = {}
    clocked = link if isinstance(link, ClockedLink) else None
    try:
        session = open_session()
        findings.append(Finding("identity and settings", True, "the gateware of this software; each setting was read back"))
        if clocked is not None:
            findings.append(_swept(board, session, clocked, max(bits * SWEEP_SHARE, 1), figures, progress))
            if not findings[-1].good:
                return LinkExamined(findings, figures)
        done = bring_up.check(session, board, clock, bits, chirps, progress=progress, take_capture=take_capture)
    except ControllerError as error:
        return LinkExamined([*findings, Finding("link", False, str(error))], figures)
    sent, errors = bit_error_count(done.bit_errors)
    bound = error_rate_bound(errors, sent)
    figures["bit_errors"] = asdict(done.bit_errors) | {"error_rate_at_most": bound, "confidence": 0.95}
    figures["registers"] = done.registers
    findings.append(
        Finding("bits", not errors, f"{errors} errors in {sent:,} bits: fewer than {bound:.1e} of them are wrong (95 %)")
    )
    if board.link.kind == "spi":
        findings += _measured(board, session, link, figures)
    findings += [Finding("board", False, complaint) for complaint in done.complaints]
    if not done.complaints:
        seen = "" if take_capture is None else ", each moved its own pin"
        chirped = f"{len(done.channels)} channels chirped{seen}" if chirps.channels else "no channel was asked for"
        findings.append(Finding("board", True, f"{done.slots} slots keep what they are given; {chirped}"))
    return LinkExamined(findings, figures)


def _measured(board: Board, session: Session, link: Link, figures: dict[str, Any]) -> list[Finding]:
    """SCK of a real SPI link by the FPGA's clock; nothing is found where it cannot be measured."""
    from controller.device.fpga.links.spi_link import SpiLink

    assert isinstance(link, SpiLink)
    measured_hz = measured_sck_hz(session, link)
    figures["sck_measured_hz"] = _finite(measured_hz)
    figures["effective_hz"] = link.effective_hz
    return [evaluated_sck(board, measured_hz, link.sck_hz)] if math.isfinite(measured_hz) else []


def _swept(
    board: Board,
    session: Session,
    link: ClockedLink,
    bits: float,
    figures: dict[str, Any],
    progress: Callable[[int, int], None],
) -> Finding:
    """Measure bit errors at several SCK; the link is left at the proposed one."""
    speeds = sweep(session, link, board.link.sck_hz, bits, np.random.default_rng(bring_up.SEED), progress)
    proposal_hz = proposed_sck_hz(speeds)
    figures["sweep"] = [asdict(speed) for speed in speeds]
    figures["proposed_sck_hz"] = proposal_hz
    rule = "the fastest without an error, at most 0.8 of the slowest with one"
    if proposal_hz is None:
        worst = next((speed.trouble for speed in speeds if speed.trouble), "bits are damaged even at the slowest")
        return Finding("SCK", False, f"no SCK carries every bit ({worst}): look at the wires")
    sck_hz = link.set_sck_hz(proposal_hz)
    if proposal_hz < board.link.sck_hz:
        return Finding("SCK", False, f"set link.sck_hz = {proposal_hz} ({rule}), or shorten the wires and join the grounds")
    return Finding("SCK", True, f"{sck_hz / 1e6:g} MHz as the board says; no error from {speeds[0].sck_hz / 1e6:g} MHz on")


def arriving_sck_hz(board: Board) -> float:
    """Least SCK in Hz at which the FPGA plays a waveform while it arrives: a chunk's frame takes no longer than it plays."""
    words = LOAD_PAYLOAD_MAX_BYTES // 4
    return 8 * LOAD_FRAME_BYTES / (words * board.waveform.bit_period_s)


def evaluated_sck(board: Board, measured_hz: float, counted_hz: float) -> Finding:
    """Evaluate the SCK by the time that frames take, against the one that times on the wire are based on."""
    arriving_hz = arriving_sck_hz(board)
    arriving = "" if measured_hz >= arriving_hz else f"; the FPGA plays nothing while it arrives below {arriving_hz / 1e6:.3g} MHz"
    if measured_hz < SCK_SHARE * counted_hz:
        said = f"frames take as long as at {measured_hz / 1e6:.3g} MHz, not {counted_hz / 1e6:.3g}{arriving}"
        advice = "on a Raspberry Pi 3 or 4 hold the core clock (boards/raspberry_pi.md), and see that nothing else runs"
        return Finding("SCK measured", False, f"{said}: {advice}")
    return Finding("SCK measured", True, f"{measured_hz / 1e6:.3g} MHz by the time that frames take{arriving}")


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
