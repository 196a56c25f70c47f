"""A board's FPGA and touch panel for a command: real ones, or simulated ones, which only the workshop has."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from controller.console import tell
from controller.device.board.board import Board
from controller.device.doctor.bring_up import CHIRP_REPETITIONS, Chirps, chirp_in_words, chirp_period_s
from controller.device.fpga.capture import Capture
from controller.device.fpga.links.link import Link
from controller.device.fpga.links.link_group import LinkGroup
from controller.device.service.drivers import OpenLink, open_link, open_panel
from controller.device.touch.event_reader import EventReader

if TYPE_CHECKING:
    from controller.workshop.gateware.gateware import GatewareFactory

LINK_RANGES = {"bits": (1, 1e10), "pause_s": (0, 60)}  # of the options of whoever examines a link: outputs are on between chirps


def open_fpga_of(board: Board) -> OpenLink:
    """What opens the link to the FPGA of `board`."""
    if board.link.kind != "simulated":
        return open_link
    if board.link.fpga:
        from controller.workshop.gateware.wired_fpgas import open_simulated_panel

        return open_simulated_panel
    from controller.workshop.gateware.simulated_link import open_simulated

    return open_simulated


def touch_panel_of(board: Board) -> Callable[[Board], EventReader]:
    """What opens the touch panel of a board: its own, or the one of a whole panel that is simulated."""
    if board.link.kind != "simulated" or not board.link.device:
        return open_panel
    from controller.workshop.simulation.simulated_touch import simulated_touch

    return simulated_touch


def fpga_link(
    board: Board, now_s: Callable[[], float], gateware: GatewareFactory | None = None
) -> tuple[Link, Callable[[], Capture] | None]:
    """Link for bring-up, which may wait longer for answers; of a simulated FPGA, made by `gateware`, also what its pins did.

    Raises LinkError if its device cannot be opened.
    """
    if board.link.kind != "simulated":
        return open_link(board, now_s, unhurried=True), None
    from controller.workshop.gateware.simulated_link import open_simulated

    link = open_simulated(board, now_s, gateware) if gateware else open_simulated(board, now_s)
    return link, link.take_capture


def fpga_links(
    board: Board, now_s: Callable[[], float], gateware: GatewareFactory | None = None
) -> tuple[LinkGroup, list[Callable[[], Capture]]]:
    """As `fpga_link`, of a board of several FPGAs: of simulated ones, what the pins of each did."""
    if board.link.kind != "simulated":
        links = open_link(board, now_s, unhurried=True)
        assert isinstance(links, LinkGroup)
        return links, []
    from controller.workshop.gateware.wired_fpgas import SimulatedFpgas

    simulated = SimulatedFpgas(board, now_s, gateware) if gateware else SimulatedFpgas(board, now_s)
    return simulated, [link.take_capture for link in simulated.timed]


def announced_chirps(board: Board, channels: Sequence[int], pause_s: float) -> Chirps:
    """Chirps on some channels of `board`; what there is to hear is said as each begins."""

    def announce(channel: int) -> None:
        if channel == channels[0]:
            lasts_s = CHIRP_REPETITIONS * chirp_period_s(board)
            tell(f"each channel purrs for {lasts_s:.2g} s at its patch; silence: stage, wire or patch; elsewhere: swapped wires")
        tell(chirp_in_words(board, channel))

    return Chirps(channels, pause_s, announce)
