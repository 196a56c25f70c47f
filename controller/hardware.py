"""The only place that chooses drivers for a board."""

from __future__ import annotations

from pathlib import Path

from controller.board import Board, data_folder
from controller.event_loop import Clock
from controller.fpga.build_hash import build_hash
from controller.fpga.simulated_link import SimulatedLink


def open_link(board: Board, clock: Clock) -> SimulatedLink:
    """Link of a board: the bit-exact model of the gateware in the source tree."""
    return SimulatedLink(board.link, clock.now_s, build_hash(data_folder("fpga_rtl")))


def recording_path(board: Board, given: str | None) -> Path:
    """File to replay: the one asked for, else the board's own."""
    return board.folder / board.touch.recording if given is None else Path(given)
