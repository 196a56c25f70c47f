"""A board's FPGA and touch panel for a command: real ones, or simulated ones, which only the workshop has."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from controller.device.board.board import Board
from controller.device.fpga.capture import Capture
from controller.device.fpga.links.link import Link
from controller.device.service.drivers import OpenLink, open_link, open_panel
from controller.device.touch.event_reader import EventReader

if TYPE_CHECKING:
    from controller.workshop.gateware.gateware import GatewareFactory


def open_fpga_of(board: Board) -> OpenLink:
    """What opens the link to the FPGA of `board`."""
    if board.link.kind != "simulated":
        return open_link
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
