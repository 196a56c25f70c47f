"""The only place that chooses drivers for a board: so far simulated gateware, serial ports and recordings."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from controller.board import Board, data_folder
from controller.fpga.build_hash import build_hash
from controller.fpga.gateware import GatewareFactory, Parameters
from controller.fpga.model import GatewareModel
from controller.fpga.serial_link import SerialLink
from controller.fpga.session import Session
from controller.fpga.simulated_link import SimulatedLink

UNHURRIED_S = 0.5  # for an answer over a serial port: bring-up may be done from a busy laptop, through any bridge


def open_fpga(board: Board, now_s: Callable[[], float], gateware: GatewareFactory = GatewareModel) -> tuple[SimulatedLink, Session]:
    """Link and session of a board's FPGA, which is checked to run the gateware that belongs to this software.

    Parameters
    ----------
    gateware : GatewareFactory
        What computes the gateware's pins.

    Raises
    ------
    LinkError
        If it does not answer or is another one.
    """
    built_from = build_hash(data_folder("fpga_rtl"))
    settings = board.link
    link = SimulatedLink(settings, now_s, gateware(Parameters.of(settings.clock_hz, settings.slots, built_from)))
    return link, Session(link, board, built_from, now_s)


def open_serial(board: Board, now_s: Callable[[], float]) -> tuple[SerialLink, Session]:
    """Link and session of an FPGA at the board's serial port.

    Raises
    ------
    LinkError
        If the port cannot be opened, or what answers there is another FPGA.
    """
    link = SerialLink(board.link.device, board.link.baud, now_s, UNHURRIED_S)
    return link, Session(link, board, build_hash(data_folder("fpga_rtl")), now_s)


def recording_path(board: Board, given: str | None) -> Path:
    """File to replay: the one asked for, else the board's own."""
    return board.folder / board.touch.recording if given is None else Path(given)
