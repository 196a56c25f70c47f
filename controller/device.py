"""The service: a board's real panel and FPGA under the event loop, until a signal comes or the FPGA forbids it."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

from controller.application_socket.command_socket import CommandSocket
from controller.assembly import Assembly, assemble
from controller.bank.reader import Bank
from controller.board import Board
from controller.clocks import MonotonicClock
from controller.hardware import open_link, open_session, open_thermometer, open_touch, tracked
from controller.housekeeping import Housekeeping
from controller.prepare_scene import populate
from controller.scene import Scene
from controller.scene_change import SceneChanger
from controller.service import Notifier, Watchdog, enter_realtime, tell
from controller.touch.live_source import LiveSource
from controller.touch.recording import Recording
from controller.touch.tracker import Tracker
from controller.touch.warnings import in_words

REPLAY_AFTER_S = 0.3  # beyond the ramp


def serve(board: Board, scene: Scene, scene_name: str, bank: Bank, replay: Recording | None = None) -> dict[str, Any]:
    """Run a panel.

    Parameters
    ----------
    replay : Recording, optional
        Touches from a recording instead of the board's panel; the service ends with it.

    Returns
    -------
    dict
        Counters and latencies, ready for JSON.

    Raises
    ------
    LinkError, TouchError
        If the FPGA or the panel is not there at the start.
    FaultError
        If the FPGA has switched off for a reason that the host may not clear.
    """
    clock = MonotonicClock()
    with ExitStack() as stack:
        notifier = stack.enter_context(Notifier.from_environment())
        cells = populate(bank, scene, scene_name)  # before memory is locked and anything is armed
        link = open_link(board, clock.now_s)
        stack.callback(link.close)
        session = open_session(link, board, clock.now_s)
        start_s = clock.now_s() + board.limits.arming_s + REPLAY_AFTER_S
        touch = open_touch(board, replay, start_s)
        stack.callback(touch.close)
        source = tracked(touch, board)
        commands = CommandSocket(board, board.application_socket) if board.application_socket else None
        if commands is not None:
            stack.callback(commands.close)
        change = SceneChanger(board, scene_name, bank)
        stack.callback(change.close)
        thermometer = open_thermometer(board)
        if thermometer is not None:
            stack.callback(thermometer.close)
        housekeeping = Housekeeping(board, session, notifier, Watchdog.from_environment(notifier), thermometer)
        assembly = assemble(
            board,
            scene,
            bank,
            clock,
            session,
            source,
            commands=commands,
            change=change,
            progress=housekeeping.progress,
        )
        assembly.selection.prepare()
        housekeeping.watch(assembly.loop, assembly.counters, touch if isinstance(touch, LiveSource) else None)
        for warning in enter_realtime(board.realtime):
            tell(warning)
        tell(f"board {board.name!r}, scene {scene_name!r}, {cells} cells of {bank.path}")
        assembly.loop.run(_ready(notifier, board))
        notifier.stopping("outputs are off")
        return _figures(board, assembly, housekeeping, source)


def _ready(notifier: Notifier, board: Board) -> Callable[[], None]:
    def ready() -> None:
        tell("the outputs are on")
        notifier.ready(f"playing on board {board.name!r}")

    return ready


def _figures(board: Board, assembly: Assembly, housekeeping: Housekeeping, source: Tracker) -> dict[str, Any]:
    said = {
        "board": board.name,
        "warnings": in_words(source.warnings),
        "bit_clock_scale": housekeeping.scale,
        "touch": source.figures(),
    }
    return said | assembly.counters.export()
