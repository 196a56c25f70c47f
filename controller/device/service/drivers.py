"""Selects and opens the drivers of a board. Each is imported when it is opened: other computers may lack its package."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from controller.device.board.board import Board
from controller.device.board.lookup import data_folder, running_release
from controller.device.board.worker import Worker
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.bitstreams.loader import BitstreamLoader
from controller.device.fpga.links.lazy_link import LazyGroup, LazyLink
from controller.device.fpga.links.link import Link
from controller.device.fpga.links.link_group import LinkGroup
from controller.device.fpga.session import Session
from controller.device.fpga.several.wide_session import WideSession
from controller.device.touch import panels
from controller.device.touch.drivers.awaited_reader import AwaitedReader
from controller.device.touch.drivers.panel_process import PanelProcess, PanelSettings
from controller.device.touch.event_reader import EventReader
from controller.device.touch.live_source import LiveSource
from controller.device.touch.source import TouchSource
from controller.device.touch.tracker import Tracker
from controller.errors import ConfigError, TouchError

if TYPE_CHECKING:
    from controller.device.service.temperature import Thermometer
    from controller.device.touch.recordings.recording import Recording

NO_PANEL = "board {!r} has no touch panel: give its [touch] a kind, or replay a recording"
OpenLink = Callable[[Board, Callable[[], float]], Link]  # of a board and the host's clock
UNHURRIED_S = 0.5  # for an answer over a serial port: bring-up may be done from a busy laptop, through any bridge


def gateware_hash() -> int:
    """Build hash of the gateware that belongs to this software."""
    return build_hash(data_folder("fpga_rtl"))


def open_link(board: Board, now_s: Callable[[], float], *, unhurried: bool = False) -> Link:
    """Link to a board's FPGA; to several of them a `LinkGroup`.

    An `unhurried` link waits longer for answers over a serial port: for bring-up, not for the event loop. Raises ConfigError if it
    is simulated; LinkError if its device cannot be opened.
    """
    if board.link.kind == "spi":
        from controller.device.fpga.links.spi_link import SpiLink, open_spi_links

        if board.link.fpga:
            return open_spi_links(board.link, [one.link for one in board.fpga_boards], now_s)
        return SpiLink(board.link, now_s)
    if board.link.kind == "serial":
        from controller.device.fpga.links.serial_link import LATENCY_S, SerialLink

        return SerialLink(board.link.device, board.link.baud, now_s, UNHURRIED_S if unhurried else LATENCY_S)
    raise ConfigError(f"the FPGA of board {board.name!r} is simulated: give it a [link] with kind spi or serial")


def await_session(board: Board, now_s: Callable[[], float], open_fpga: OpenLink = open_link) -> tuple[Link, Session]:
    """Link and session of an FPGA, or several, that may not be connected yet; nothing is sent before `bring_up`."""
    link: Link
    session: Session
    if board.link.fpga:
        link = group = LazyGroup(lambda: open_fpga(board, now_s), len(board.link.fpga), now_s)
        session = WideSession(group, board, gateware_hash(), now_s, bring_up=False)
    else:
        link = LazyLink(lambda: open_fpga(board, now_s), now_s)
        session = Session(link, board, gateware_hash(), now_s, bring_up=False)
    for one, own in zip(session.of_each, board.fpga_boards, strict=True):
        if own.gateware is not None:
            one.loader = BitstreamLoader(own.gateware, bitstream_path(own), now_s)
    return link, session


def bitstream_path(board: Board) -> Path:
    """Path of a board's bitstream: that of the release that runs, if it has one, else beside board.toml."""
    release = running_release()
    ours = release / "gateware" / board.bitstream if release else None
    return ours if ours is not None and ours.is_file() else board.beside(board.bitstream)


def open_session(link: Link, board: Board, now_s: Callable[[], float]) -> Session:
    """Bring up the FPGA at the other end of a link, and check that it runs the gateware of this software.

    Raises LinkError if it does not answer, or runs another gateware.
    """
    if isinstance(link, LinkGroup):
        return WideSession(link, board, gateware_hash(), now_s)
    return Session(link, board, gateware_hash(), now_s)


def open_panel(board: Board) -> EventReader:
    """Driver of a board's touch panel; raises TouchError if it is not there, or the board has none."""
    if not board.touch.has_device:
        raise TouchError(NO_PANEL.format(board.name))
    return panels.open_panel(board.touch)


def open_input(device: str, *, grab: bool = False) -> EventReader:
    """Driver of an input device of the kernel, by path or name; with `grab` other programs cannot read it.

    Raises TouchError if it is not there.
    """
    from controller.device.touch.drivers.event_device import LinuxInput

    return LinuxInput(device, grab=grab)


def open_touch(board: Board, replay: Recording | None = None, start_s: float = 0.0) -> TouchSource:
    """Touches of a board's panel, or of a recording that begins at `start_s` on the host's clock.

    Raises TouchError if the panel is not there.
    """
    if replay is not None:
        from controller.device.touch.recordings.replay import RecordingSource

        return RecordingSource(replay, replay.axes(board), start_s)
    return LiveSource(open_panel(board), board)


def await_panel(board: Board) -> AwaitedReader | PanelProcess:
    """Driver of a board's touch panel, which may not be connected yet. On an I2C bus, or shared, it has its own process.

    Call it before the loop gets real-time priority.

    Raises ConfigError if the board has none.
    """
    if not board.touch.has_device:
        raise ConfigError(NO_PANEL.format(board.name))
    if board.touch.runs_beside:
        settings = PanelSettings(board.touch, board.plate.length_m, board.plate.width_m)
        return PanelProcess(_beside("panel", board.realtime.priority, settings))
    reader = AwaitedReader(lambda: open_panel(board))
    reader.read(0.0)  # a first look, with the driver's import, which would keep the loop from its heartbeats
    return reader


def tracked(source: TouchSource, board: Board, bridged: Callable[[int, int], None] | None = None) -> Tracker:
    """Tracker of a board for a source of touches; for `bridged` see `Tracker`."""
    return Tracker(source, board.touch, board.plate.length_m, board.plate.width_m, bridged)


def await_thermometer(board: Board) -> Thermometer | None:
    """Thermometer of a board, its sensor read by a separate process; None if it has none. Call it before real-time priority."""
    if board.temperature is None:
        return None
    from controller.device.service.temperature import Thermometer
    from controller.device.service.temperature_sensors import SensorProcess

    return Thermometer(board.temperature, SensorProcess(_beside("thermometer", 0, board.temperature)))


def _beside(what: str, priority: int, settings: msgspec.Struct) -> Worker:
    """Start a helper process with `beside_loop`."""
    return Worker(["-m", "controller.device.service.beside_loop", what, str(priority), msgspec.json.encode(settings).decode()])


def recording_path(board: Board, given: str | None) -> Path:
    """Path of the recording to replay: the given one, else the board's.

    Raises ConfigError if none is given and the board names none.
    """
    if given is not None:
        return Path(given)
    if not board.touch.recording:
        raise ConfigError(f"board {board.name!r} names no recording to replay: give --replay FILE, or it touch.recording")
    return board.beside(board.touch.recording)
