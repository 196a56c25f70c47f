"""A simulated panel in real time with an application socket, to develop a user interface against.

Loop, scene, bank, socket and scheduling are those of the device. The FPGA is its model; up to four fingers move.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from controller.clocks import MonotonicClock
from controller.device.application_socket.command_socket import CommandSocket
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.devices import ApplicationSocket
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
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.log import Priority, log
from controller.workshop.gateware.simulated_link import open_simulated

REPORT_S = 1 / 60
SWING_S = 4.0
SWINGS_MM = (  # of each finger its centre, x and y, and how far it goes along x, with the sine, and y, with the cosine
    (60.0, 50.0, 20.0, 0.0),
    (150.0, 95.0, 20.0, 0.0),
    (55.0, 108.0, 16.0, 16.0),
    (168.0, 42.0, 0.0, 20.0),
)
AXES = "A: 2f 0 9 0 0 0\nA: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\nA: 39 0 65535 0 0 0\n"  # tenths of a millimetre on the plate
DRAIN_S = 1.0  # interval at which the captured pins are discarded


def serve(
    board: Board, settings: ApplicationSocket, bank: Bank, touched_s: float, ready: Callable[[], None], fingers: int = 2
) -> None:
    """Run the simulated panel until SIGTERM or SIGINT.

    `settings` of the socket take the place of the board's; `bank` is of the whole plate. At most `len(SWINGS_MM)` `fingers` are
    down for `touched_s`; `ready` is called once the outputs are on. Raises ControllerError if scene or socket cannot be opened, or
    from the event loop.
    """
    clock = MonotonicClock()
    scene = load_scene(find_scene(board), board)
    populate(bank, scene, board.scene)
    layers = LayerPreparer(board, bank, cells_of(bank, scene, board.scene))
    recording = Recording(_moving(touched_s, fingers), "fingers that move to and fro")
    commands = CommandSocket(board, settings)
    link = open_simulated(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    source = tracked(RecordingSource(recording, recording.axes(board), clock.now_s() + 0.2), board)
    change = SceneChanger(board, board.scene, bank)
    for warning in enter_realtime(board.realtime):
        log(warning, Priority.WARNING)
    drain_s = clock.now_s()

    def progress(now_s: float) -> None:
        nonlocal drain_s
        housekeeping.progress(now_s)
        if now_s >= drain_s:
            drain_s = now_s + DRAIN_S
            link.take_capture()

    notifier = Notifier("")
    housekeeping = Housekeeping(board, session, notifier, Watchdog(notifier, math.inf), None)
    try:
        assembly = assemble(
            LoopContext(board, clock, session, source, layers=layers),
            scene,
            bank,
            commands=commands,
            change=change,
            watch=Watch(progress, housekeeping.emission_started, housekeeping.scene_changed),
        )
        housekeeping.watch(assembly.loop, None, [commands.changed])
        assembly.loop.run(ready)
    finally:
        change.close()
        layers.close()
        commands.close()
        link.close()


def _moving(seconds: float, fingers: int) -> str:
    """Recording of fingers that stay down and move to and fro, or round and round."""
    lines = [AXES]
    for number in range(math.ceil(seconds / REPORT_S)):
        at_s = number * REPORT_S
        angle = 2 * math.pi * at_s / SWING_S
        for slot, (centre_x_mm, centre_y_mm, along_x_mm, along_y_mm) in enumerate(SWINGS_MM[:fingers]):
            x_mm, y_mm = centre_x_mm + along_x_mm * math.sin(angle), centre_y_mm + along_y_mm * math.cos(angle)
            events = [(0x2F, slot), *([(0x39, slot)] if number == 0 else []), (0x35, 10 * x_mm), (0x36, 10 * y_mm)]
            lines += [f"E: {at_s:.6f} 0003 {code:04x} {round(value):04d}\n" for code, value in events]
        lines.append(f"E: {at_s:.6f} 0000 0000 0000\n")
    return "".join(lines)
