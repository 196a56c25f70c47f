"""The service: a board's touch panel and FPGA with the event loop, until a signal or a fault that ends it."""

from __future__ import annotations

import signal
import time
from collections import Counter
from collections.abc import Callable
from contextlib import ExitStack, closing
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from controller.clocks import MonotonicClock
from controller.device.bank.expectation import Expectation
from controller.device.bank.file_format import Header
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.panel_state import Condition
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.event_loop import EventLoop
from controller.device.loop.wiring import Assembly, assemble
from controller.device.scene.scene import Scene
from controller.device.service.check_beside import check_responses_beside
from controller.device.service.drivers import (
    OpenLink,
    await_panel,
    await_session,
    await_thermometer,
    open_link,
    open_touch,
    tracked,
)
from controller.device.service.housekeeping import Housekeeping
from controller.device.service.realtime import enter_realtime
from controller.device.service.reloading import ReloadFile
from controller.device.service.scenes.layer_preparer import LayerPreparer
from controller.device.service.scenes.prepare_scene import cells_of
from controller.device.service.scenes.scene_reload import SceneChanger
from controller.device.service.status_file import StatusFile
from controller.device.service.systemd import Notifier, Watchdog
from controller.device.service.tracing.trace_file import TraceFile
from controller.device.service.unfelt import left_out, unfelt
from controller.device.touch.drivers.awaited_reader import AwaitedReader
from controller.device.touch.drivers.panel_process import PanelProcess
from controller.device.touch.live_source import LiveSource
from controller.device.touch.reports import describe_warnings, off_plate_warning
from controller.device.touch.source import TouchSource
from controller.device.touch.tracker import Tracker
from controller.errors import ControllerError
from controller.log import LOG, Event, log

if TYPE_CHECKING:
    from controller.device.application_socket.command_socket import CommandSocket
    from controller.device.touch.recordings.recording import Recording

REPLAY_AFTER_S = 0.3  # from the end of the ramp to the start of a recording


def serve(
    board: Board,
    scene: Scene,
    scene_name: str,  # name or path of the scene, for reloads and the log
    bank: Bank,  # open; it has all cells that the scene can need
    replay: Recording | None = None,  # touches from a recording instead of the board's panel; the service ends with it
    open_fpga: OpenLink = open_link,  # opens the link to the FPGA, if that is a simulated one
    open_commands: Callable[[], CommandSocket] | None = None,  # opens what others command the panel by
    expect: Callable[[Header], Expectation | None] = lambda _: None,  # what a bank will do, for those who watch emissions
) -> dict[str, Any]:
    """Run a panel.

    Returns counters and latencies, ready for JSON. Raises IncompatibleFpga if the FPGA does not have the gateware or limits that
    software and board require, also after it was loaded. The service waits for an FPGA or touch panel that is not connected. Raises
    FaultError if the FPGA has switched off because of a fault that the host must not clear.
    """
    with ExitStack() as stack:
        # Before there is a loop whose trace it asks for, it would end the process.
        stack.callback(signal.signal, signal.SIGUSR1, signal.signal(signal.SIGUSR1, signal.SIG_IGN))
        notifier = stack.enter_context(Notifier.from_environment())
        status = stack.enter_context(closing(StatusFile.from_environment(board.name)))
        trace = TraceFile.from_environment(board.name, board.waveform.duration_s)
        stack.callback(lambda: trace.close(time.monotonic()))
        change = stack.enter_context(closing(SceneChanger(board, scene_name, bank, expect=expect)))
        cells = cells_of(bank, scene, scene_name)
        bank.drive.check_frames(cells)  # before memory is locked and anything is armed
        check_responses_beside(bank, cells)
        layers = stack.enter_context(closing(LayerPreparer(board, bank, cells))) if open_commands else None
        panel = _connect(stack, board, replay, open_fpga, layers)
        panel.context.emissions.expected = expect(bank.header)
        commands = open_commands() if open_commands else None
        if commands is not None:
            stack.callback(commands.close)
        thermometer = await_thermometer(board)
        if thermometer is not None:
            stack.callback(thermometer.close)
        housekeeping = Housekeeping(
            board, panel.context.session, notifier, Watchdog.from_environment(notifier), thermometer, ReloadFile.from_environment()
        )
        watch = Watch(housekeeping.progress, housekeeping.emission_started, housekeeping.scene_changed, (status, trace))
        assembly = assemble(panel.context, scene, bank, commands=commands, change=change, watch=watch)
        if commands is not None and commands.disarmed_by:
            assembly.loop.control.switch(on=False, by=commands.disarmed_by)
        assembly.selection.prepare()
        trace.watch(panel.context.trace)
        status.watch(assembly.counters, assembly.waiting, panel.tracker.counts, panel.remarks)
        reported = (status.changed,) if commands is None else (status.changed, commands.changed)
        housekeeping.watch(assembly.loop, panel.reader, reported, panel.tracker.counts)
        for warning in enter_realtime(board.realtime):
            log(warning, Event.NOT_REALTIME)
        log(f"board {board.name!r}, scene {scene_name!r}, {len(cells)} cells of {bank.path}", Event.STARTED)
        _run(assembly.loop, notifier, status)
        return _figures(board, assembly, housekeeping, panel.tracker)


def _run(loop: EventLoop, notifier: Notifier, status: StatusFile) -> None:
    """Run the loop; the service manager and the status file say how it ended."""
    try:
        loop.run()
    except ControllerError as error:
        notifier.stopping(f"{loop.outputs.state.value}: {error}")
        status.changed(Condition(loop.outputs.state, str(error)))
        raise
    notifier.stopping("outputs are off")


@dataclass(frozen=True, slots=True)
class _ConnectedPanel:
    """The board's FPGA and its touch panel, or a recording in place of that (`reader` is None then)."""

    context: LoopContext
    tracker: Tracker
    reader: AwaitedReader | PanelProcess | None

    def remarks(self) -> tuple[Counter[str], str]:
        """Anomalies of the touch panel by kind, and what its driver says of it."""
        return self.tracker.warnings, self.reader.description.remark if self.reader else ""


def _connect(
    stack: ExitStack, board: Board, replay: Recording | None, open_fpga: OpenLink, layers: LayerPreparer | None
) -> _ConnectedPanel:
    """Open what may be connected later: the FPGA, and the touch panel unless a recording is replayed."""
    clock = MonotonicClock()
    link, session = await_session(board, clock.now_s, open_fpga)
    stack.callback(link.close)
    for one in session.of_each:
        if one.loader is not None:
            stack.callback(one.loader.close)
    reader = await_panel(board) if replay is None else None
    if reader is not None:
        live = LiveSource(reader, board)
        touch: TouchSource = live
        silence = live.silence
    else:
        touch = open_touch(board, replay, clock.now_s() + board.limits.arming_s + REPLAY_AFTER_S)
        silence = None
    stack.callback(touch.close)
    tracker = tracked(touch, board)
    return _ConnectedPanel(LoopContext(board, clock, session, tracker, silence=silence, layers=layers), tracker, reader)


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
        "unfelt": unfelt(counts.points, counts.refused, assembly.counters.foci, left_out(assembly.counters.skipped)),
    }
    return said | assembly.counters.export() | {"schedule": assembly.timing.figures()}
