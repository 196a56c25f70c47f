"""`doctor --link` of several FPGAs: what they share, then the link of each by itself, the others off."""

from __future__ import annotations

import selectors
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from controller.clocks import Clock
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.device.doctor.bring_up import Chirps
from controller.device.doctor.finding import Finding
from controller.device.doctor.link_examination import LinkExamined, examine_link
from controller.device.fpga.capture import Capture
from controller.device.fpga.links.link import Link
from controller.device.fpga.links.link_group import LinkGroup
from controller.device.fpga.session import Session
from controller.device.fpga.several.wide_session import APART_TICKS, WideSession
from controller.errors import ControllerError

APART_S = 0.2  # between two pulses of the trigger: crystals that differ by 50 ppm are 10 us apart by then


def examine_links(
    board: Board,
    links: LinkGroup,  # open
    open_session: Callable[[Link, Board], Session],  # brings up all of them, or one
    clock: Clock,
    bits: float,
    chirps: Chirps,  # of the channels of all
    progress: Callable[[int, int], None] = lambda *_: None,
    captures: Sequence[Callable[[], Capture]] = (),  # of simulated FPGAs, what the pins of each did since the last call
) -> LinkExamined:
    """Examine trigger and clock, which all share, and each link as `examine_link` does; figures of each are in `fpgas`.

    Nothing chirps unless all have been brought up: a fault of one takes the permit from all.
    """
    shared = _shared(partial(open_session, links, board), clock)
    findings = [shared]
    figures: list[dict[str, Any]] = []
    for number, (one, link) in enumerate(zip(board.fpga_boards, links.links, strict=True)):
        examined = examine_link(
            one,
            link,
            partial(open_session, link, one),
            clock,
            bits,
            chirps_of(number, chirps) if shared.good else Chirps([]),
            progress,
            captures[number] if captures else None,
        )
        findings += [replace(found, about=f"FPGA {number}: {found.about}") for found in examined.findings]
        figures.append(examined.figures)
    return LinkExamined(findings, {"fpgas": figures})


def chirps_of(number: int, chirps: Chirps) -> Chirps:
    """Of the chirps of all FPGAs those of one, by its own channels."""
    first = CHANNELS * number
    own = [channel - first for channel in chirps.channels if first <= channel < first + CHANNELS]
    return Chirps(own, chirps.pause_s, lambda channel: chirps.announce(channel + first))


def _shared(open_session: Callable[[], Session], clock: Clock) -> Finding:
    """Whether all see the trigger, and count the ticks of one clock."""
    about = "trigger and clock"
    try:
        session = open_session()
        assert isinstance(session, WideSession)
        before = session.ahead_ticks
        with selectors.DefaultSelector() as selector:
            until_s = clock.now_s() + APART_S
            while clock.now_s() < until_s:
                clock.wait(selector, until_s)
        session.compare_ticks()
    except ControllerError as error:
        return Finding(about, False, f"{error}; nothing chirps")
    drifts = [after - then for after, then in zip(session.ahead_ticks, before, strict=True)]
    for number, ticks in enumerate(drifts, 1):
        if abs(ticks) > APART_TICKS:
            said = f"in {APART_S:g} s FPGA {number} counts {ticks} ticks more than FPGA 0: have all run from one oscillator"
            return Finding(about, False, said)
    return Finding(about, True, f"each FPGA sees the trigger, and all count the ticks of one clock (within {APART_TICKS})")
