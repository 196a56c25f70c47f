"""The service: a board's touch panel and FPGA with the event loop, until a signal or a fault that ends it."""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

from controller.application_socket.command_socket import CommandSocket
from controller.bank.reader import Bank
from controller.board.board import Board
from controller.board.panel_state import Condition
from controller.clocks import MonotonicClock
from controller.errors import ControllerError
from controller.log import LOG, Event, log
from controller.loop.wiring import Assembly, assemble
from controller.scene.scene import Scene
from controller.service.check_beside import check_responses_beside
from controller.service.drivers import await_panel, await_session, await_thermometer, open_touch, tracked
from controller.service.housekeeping import Housekeeping
from controller.service.prepare_scene import cells_of
from controller.service.realtime import enter_realtime
from controller.service.reloading import ReloadFile
from controller.service.scene_reload import SceneChanger
from controller.service.status_file import StatusFile
from controller.service.systemd import Notifier, Watchdog
from controller.touch.live_source import LiveSource
from controller.touch.reports import describe_warnings, off_plate_warning
from controller.touch.source import TouchSource
from controller.touch.tracker import Tracker

if TYPE_CHECKING:
    from controller.touch.recording import Recording

REPLAY_AFTER_S = 0.3  # from the end of the ramp to the start of a recording


def serve(board: Board, scene: Scene, scene_name: str, bank: Bank, replay: Recording | None = None) -> dict[str, Any]:
    """Run a panel.

    Parameters
    ----------
    board : Board
    scene : Scene
    scene_name : str
        Name or path of the scene, for reloads and the log.
    bank : Bank
        Open; it has all cells that the scene can need.
    replay : Recording, optional
        Touches from a recording instead of the board's panel; the service ends with it.

    Returns
    -------
    dict
        Counters and latencies, ready for JSON.

    Raises
    ------
    IncompatibleFpga
        If the FPGA does not have the gateware or limits that software and board require, also after it was loaded. The service
        waits for an FPGA or touch panel that is not connected.
    FaultError
        If the FPGA has switched off because of a fault that the host must not clear.
    """
    clock = MonotonicClock()
    with ExitStack() as stack:
        notifier = stack.enter_context(Notifier.from_environment())
        status = StatusFile.from_environment(board.name)
        stack.callback(status.close)
        change = SceneChanger(board, scene_name, bank)
        stack.callback(change.close)
        cells = cells_of(bank, scene, scene_name)
        bank.check_frames(cells)  # before memory is locked and anything is armed
        check_responses_beside(bank, cells)
        link, session = await_session(board, clock.now_s)
        stack.callback(link.close)
        if session.loader is not None:
            stack.callback(session.loader.close)
        panel = None
        touch: TouchSource
        if replay is None:
            panel = await_panel(board)
            touch = LiveSource(panel, board)
        else:
            touch = open_touch(board, replay, clock.now_s() + board.limits.arming_s + REPLAY_AFTER_S)
        stack.callback(touch.close)
        source = tracked(touch, board)
        commands = CommandSocket(board, board.application_socket) if board.application_socket else None
        if commands is not None:
            stack.callback(commands.close)
        thermometer = await_thermometer(board)
        if thermometer is not None:
            stack.callback(thermometer.close)
        housekeeping = Housekeeping(
            board, session, notifier, Watchdog.from_environment(notifier), thermometer, ReloadFile.from_environment()
        )
        assembly = assemble(
            board,
            scene,
            bank,
            clock,
            session,
            source,
            commands=commands,
            change=change,
            silence=touch.silence if isinstance(touch, LiveSource) else None,
            progress=housekeeping.progress,
            emission_started=housekeeping.emission_started,
            scene_changed=housekeeping.scene_changed,
            spare=status,
        )
        if commands is not None and commands.disarmed:
            assembly.loop.control.switch(on=False)
        assembly.selection.prepare()
        status.watch(
            assembly.counters,
            assembly.waiting,
            source.counts,
            lambda: (source.warnings, panel.description.remark if panel else ""),
        )
        told = (status.changed,) if commands is None else (status.changed, commands.changed)
        housekeeping.watch(assembly.loop, panel, told, source.counts)
        for warning in enter_realtime(board.realtime):
            log(warning, Event.NOT_REALTIME)
        log(f"board {board.name!r}, scene {scene_name!r}, {len(cells)} cells of {bank.path}", Event.STARTED)
        try:
            assembly.loop.run()
        except ControllerError as error:
            notifier.stopping(f"{assembly.loop.outputs.state.value}: {error}")
            status.changed(Condition(assembly.loop.outputs.state, str(error)))
            raise
        notifier.stopping("outputs are off")
        return _figures(board, assembly, housekeeping, source)


def _figures(board: Board, assembly: Assembly, housekeeping: Housekeeping, source: Tracker) -> dict[str, Any]:
    counts = source.counts
    off = off_plate_warning(counts.points, counts.off_plate)
    said = {
        "board": board.name,
        "state": housekeeping.condition.state.value,
        "cause": housekeeping.condition.cause,
        "log_lines_lost": LOG.lost,
        "warnings": describe_warnings(source.warnings) + ([off] if off else []),
        "bit_clock_scale": housekeeping.scale,
        "touch": source.figures(),
        "positions": {"reported": counts.points, "off_plate": counts.off_plate},
    }
    return said | assembly.counters.export() | {"schedule": assembly.timing.figures()}
