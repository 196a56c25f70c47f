"""A simulated panel in real time with an application socket, to develop a user interface against.

Loop, scene, bank, socket and scheduling are those of the device. The FPGA is its model; fingers are those of a recording.
"""

import math
from collections.abc import Callable
from datetime import UTC, datetime
from typing import NamedTuple

from controller.clocks import MonotonicClock
from controller.device.application_socket.command_socket import CommandSocket
from controller.device.bank.expectation import Expectation
from controller.device.bank.file_format import Header
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.devices import ApplicationSocket
from controller.device.board.identity import simulated_identity
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.service.housekeeping import Housekeeping
from controller.device.service.realtime import enter_realtime
from controller.device.service.scenes.layer_preparer import LayerPreparer
from controller.device.service.scenes.prepare_scene import cells_of, populate
from controller.device.service.scenes.scene_reload import SceneChanger
from controller.device.service.systemd import Notifier, Watchdog
from controller.device.service.tracing.trace_file import TraceFile
from controller.device.touch.live_source import LiveSource
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch.source import TouchSource
from controller.log import Priority, log
from controller.workshop.gateware.simulated_link import SimulatedLink
from controller.workshop.gateware.wired_fpgas import SimulatedFpgas, open_simulated_panel
from controller.workshop.simulation.ghostly_panel import GhostlyPanel, Ghosts, pins_of

REPORT_S = 1 / 60
SWING_S = 4.0
SWINGS_MM = (  # of each finger its centre, x and y, and how far it goes along x, with the sine, and y, with the cosine
    (60.0, 50.0, 20.0, 0.0),
    (150.0, 95.0, 20.0, 0.0),
    (55.0, 108.0, 16.0, 16.0),
    (168.0, 42.0, 0.0, 20.0),
)
AXES = "A: 2f 0 9 0 0 0\nA: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\nA: 39 0 65535 0 0 0\n"  # tenths of a millimetre on the plate
GHOST_LIVES, GHOST_MM = (1, 3), 6.0  # reports that a ghost lasts, and its size
DRAIN_S = 1.0  # interval at which the captured pins are discarded


class Touched(NamedTuple):
    """Who touches the panel."""

    # Makes the touches of a board's panel before a link, from a time in s of the host's clock on
    touches: Callable[[Board, SimulatedLink | SimulatedFpgas, float], TouchSource]
    takes_pins: bool  # whether they consume what the pins did


def serve(board: Board, settings: ApplicationSocket, bank: Bank, touched: Touched, ready: Callable[[], None]) -> None:
    """Run the simulated panel until SIGTERM or SIGINT.

    `settings` of the socket take the place of the board's; `bank` is of the whole plate. `ready` is called once the outputs are on.
    Raises ControllerError if scene or socket cannot be opened, or from the event loop.
    """
    clock = MonotonicClock()
    scene = load_scene(find_scene(board), board)
    populate(bank, scene, board.scene)
    layers = LayerPreparer(board, bank, cells_of(bank, scene, board.scene))
    commands = CommandSocket(board, settings)
    link = open_simulated_panel(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    begin_s = clock.now_s() + 0.2
    source = tracked(touched.touches(board, link, begin_s), board)

    def expect(header: Header) -> Expectation | None:
        return Expectation.of(header, board, simulated_identity(board), datetime.now(tz=UTC).date())

    change = SceneChanger(board, board.scene, bank, expect=expect)
    for warning in enter_realtime(board.realtime):
        log(warning, Priority.WARNING)
    drain_s = clock.now_s()

    def progress(now_s: float) -> None:
        nonlocal drain_s
        housekeeping.progress(now_s)
        if now_s >= drain_s and not touched.takes_pins:
            drain_s = now_s + DRAIN_S
            link.take_captures()

    notifier = Notifier("")
    trace = TraceFile.from_environment(board.name, board.waveform.duration_s)
    housekeeping = Housekeeping(board, session, notifier, Watchdog(notifier, math.inf), None)
    context = LoopContext(board, clock, session, source, layers=layers)
    context.emissions.expected = expect(bank.header)
    trace.watch(context.trace)
    try:
        assembly = assemble(
            context,
            scene,
            bank,
            commands=commands,
            change=change,
            watch=Watch(progress, housekeeping.emission_started, housekeeping.scene_changed, (trace,)),
        )
        housekeeping.watch(assembly.loop, None, [commands.changed])
        assembly.loop.run(ready)
    finally:
        trace.close(clock.now_s())
        change.close()
        layers.close()
        commands.close()
        link.close()


def replayed(recording: Recording) -> Touched:
    """Fingers of a recording, from the start once; those that it leaves down are lifted after its last event."""

    def touches(board: Board, _link: object, begin_s: float) -> TouchSource:
        return RecordingSource(recording, recording.axes(board), begin_s)

    return Touched(touches, takes_pins=False)


def ghostly(seconds: float, fingers: int, probability: float) -> Touched:
    """A panel in front of the pins, with fingers that move, and ghosts."""

    def touches(board: Board, link: SimulatedLink | SimulatedFpgas, begin_s: float) -> TouchSource:
        moved = [
            (begin_s, begin_s + seconds, lambda at_s, number=number: _place_mm(number, at_s - begin_s)) for number in range(fingers)
        ]
        ghosts = Ghosts(probability, GHOST_LIVES, GHOST_MM)
        return LiveSource(GhostlyPanel(board, moved, pins_of(link), ghosts, from_s=begin_s, until_s=math.inf), board)

    return Touched(touches, takes_pins=True)


def _place_mm(number: int, since_s: float) -> tuple[float, float]:
    """Where a finger is, so long after it began."""
    angle = 2 * math.pi * since_s / SWING_S
    centre_x_mm, centre_y_mm, along_x_mm, along_y_mm = SWINGS_MM[number]
    return centre_x_mm + along_x_mm * math.sin(angle), centre_y_mm + along_y_mm * math.cos(angle)


def moving(seconds: float, fingers: int) -> Recording:
    """Fingers, at most `len(SWINGS_MM)`, that stay down and move to and fro, or round and round."""
    lines = [AXES]
    for number in range(math.ceil(seconds / REPORT_S)):
        at_s = number * REPORT_S
        for slot in range(fingers):
            x_mm, y_mm = _place_mm(slot, at_s)
            events = [(0x2F, slot), *([(0x39, slot)] if number == 0 else []), (0x35, 10 * x_mm), (0x36, 10 * y_mm)]
            lines += [f"E: {at_s:.6f} 0003 {code:04x} {round(value):04d}\n" for code, value in events]
        lines.append(f"E: {at_s:.6f} 0000 0000 0000\n")
    return Recording("".join(lines), "fingers that move to and fro")
