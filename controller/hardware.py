"""The only place that chooses drivers for a board: so far the model of the gateware and recordings."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from controller.board import Board, data_folder
from controller.fpga.build_hash import build_hash
from controller.fpga.session import Session
from controller.fpga.simulated_link import SimulatedLink


def open_fpga(board: Board, now_s: Callable[[], float]) -> tuple[SimulatedLink, Session]:
    """Link and session of a board's FPGA, which is checked to run the gateware that belongs to this software.

    Raises
    ------
    LinkError
        If it does not answer or is another one.
    """
    gateware = build_hash(data_folder("fpga_rtl"))
    link = SimulatedLink(board.link, now_s, gateware)
    return link, Session(link, board, gateware, now_s)


def recording_path(board: Board, given: str | None) -> Path:
    """File to replay: the one asked for, else the board's own."""
    return board.folder / board.touch.recording if given is None else Path(given)
