"""`haptic-panel run`: run a board's panel, or simulate it."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from controller.commands.bank import open_bank
from controller.commands.common.arguments import Declare
from controller.commands.common.expected import expected_of
from controller.commands.common.fpga_link import open_fpga_of
from controller.commands.common.named_board import named_board
from controller.commands.common.output import picture_path, progress_bar, show
from controller.console import tell
from controller.device.bank.inspection import measured_at
from controller.device.bank.memory import memory_fit
from controller.device.board.board import Board, simulated
from controller.device.board.panel_status import FOLDER as RUNTIME_FOLDER
from controller.device.board.paths import state_folder
from controller.device.scene.edge_rate import edge_warnings
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.service.drivers import recording_path
from controller.device.service.installation import is_installed
from controller.errors import ConfigError, UsageError
from controller.log import Priority

if TYPE_CHECKING:
    from controller.device.application_socket.command_socket import CommandSocket
    from controller.workshop.simulation.drift import Drift
    from controller.workshop.simulation.focus_evaluation import Evaluated


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    play = declare(
        example="haptic-panel run --board simulated --scene keyboard --speed max",
        parents=[common],
        description="On a board with devices: play the scene for the fingers on its touch panel, until SIGTERM or Ctrl-C; "
        "SIGHUP reads the scene again. On the simulated board, or with --link: replay a touch recording through the event loop, "
        "the frame protocol and the gateware, apply every emission to a simulated plate, and print what the fingers felt. "
        "Builds the board's bank when it is missing or stale.",
    )
    play.add_argument(
        "--replay",
        metavar="FILE",
        help="recording instead of the panel: of haptic-panel record, evemu, libinput record, evtest or getevent "
        "(default: the board's own, if it has no panel)",
    )
    play.add_argument("--scene", metavar="S", help="name beside the board's file, or path (default: the board's own)")
    play.add_argument(
        "--bank", metavar="FILE", help="play from this bank; it is refused, not rebuilt, if it does not fit the board"
    )
    play.add_argument(
        "--link", choices=["model", "rtl"], help="instead of the board's FPGA: its model, or its Verilog, compiled; simulates all"
    )
    play.add_argument(
        "--speed", choices=["1", "max"], help="1: real time (default); max: as fast as the machine goes (always with --link rtl)"
    )
    play.add_argument(
        "--plate",
        metavar="B",
        action="append",
        default=[],
        help="simulated: play on the plate, patches and driver of another board, by name, folder or file; or KEY=VALUE of [plate], "
        "such as edges=free; may be repeated",
    )
    drift = play.add_mutually_exclusive_group()
    drift.add_argument(
        "--drift-percent", type=float, metavar="D", help="simulated: all frequencies of the plate are higher by so much (-5 to 5)"
    )
    drift.add_argument(
        "--drift", metavar="FILE", help="simulated: the same over time: CSV with time_s,drift_percent and, if it errs, sensor_c"
    )
    play.add_argument(
        "--sensor",
        choices=["board", "assumed", "none"],
        help="of temperature, with a drift: the board's (default), one of -200 ppm/K, or none, so that nothing corrects the drift",
    )
    play.add_argument("--plot", metavar="FILE", help="draw the plate at T, fingers and a cross-section (.png, .svg, .pdf)")
    play.add_argument("--verbose", action="store_true", help="print every count and latency too")
    play.set_defaults(command=run)


def run(options: argparse.Namespace) -> int:
    """Run the board's panel, or simulate it."""
    board = named_board(options.board)
    devices = board.link.kind != "simulated" or (board.touch.has_device and not board.link.device)
    if devices and options.link is None:
        return _serve(options, board)
    return _simulate(options, board)


def _serve(options: argparse.Namespace, board: Board) -> int:
    """Run the service with the board's devices."""
    from controller.commands.common.tables import service_table
    from controller.commands.run.report import served
    from controller.device.service.migration import migrate
    from controller.device.service.run import serve

    if board.is_the_systems:
        for said in migrate(state_folder(board)):
            tell(said)
    simulating = (
        options.plot is not None,
        options.speed == "max",
        bool(options.plate),
        options.drift_percent is not None,
        options.drift,
    )
    if any(simulating):
        raise ConfigError("--plot, --speed max, --plate, --drift are for simulated panels: add --link model to simulate this board")
    scene_file = find_scene(board, options.scene)
    scene = load_scene(scene_file, board)
    replay = None
    if options.replay or not board.touch.has_device:
        from controller.device.touch.recordings.recording import Recording

        replay = Recording.open(recording_path(board, options.replay))
    with open_bank(options, board, scene, scene_file, keep=True) as bank:
        for warning in edge_warnings(scene, board, *bank.worst_edges):
            tell(f"{scene_file}: {warning}", Priority.WARNING)
        expect = partial(expected_of, board=board)
        expected = expect(bank.header)
        if expected is not None and expected.cause and measured_at(bank.path):
            tell(f"{bank.path}: its amplitude on this panel has no lower bound: {expected.cause}", Priority.WARNING)
        ran = serve(board, scene, str(scene_file), bank, replay, open_fpga_of(board), _application_socket(board), expect)
        figures = {
            "bank": str(bank.path),
            "memory": memory_fit(board).in_words(),
            "expected": expected and expected.figures(),
        } | ran
    show(options, figures, service_table if options.verbose else served)
    return 0


def _application_socket(board: Board) -> Callable[[], CommandSocket] | None:
    """What opens the board's application socket; None if it has none, or this installation cannot serve it."""
    if board.application_socket is None:
        return None
    if not is_installed("device.application_socket"):
        tell("board.toml: [application_socket] is not served: this installation has no controller/device/application_socket")
        return None
    folder = Path(board.application_socket.path).parent
    if folder == RUNTIME_FOLDER and "RUNTIME_DIRECTORY" not in os.environ and not folder.is_dir():
        tell(f"board.toml: [application_socket] is not served: the service has {folder}, a run by hand needs another path")
        return None
    from controller.device.application_socket.command_socket import CommandSocket

    return partial(CommandSocket, board, board.application_socket)


def _simulate(options: argparse.Namespace, board: Board) -> int:
    """Replay a recording on the simulated panel, and print what its fingers would have felt."""
    from threadpoolctl import threadpool_limits

    from controller.commands.common.tables import run_table
    from controller.commands.gateware import gateware_factory
    from controller.commands.run.report import felt
    from controller.device.touch.recordings.recording import Recording
    from controller.workshop.gateware.actual_panel import actual_panel
    from controller.workshop.simulation import focus_evaluation, run_figures, simulated_run
    from controller.workshop.simulation.other_plate import on_other_plate

    picture = picture_path(options)
    board = simulated(board)
    plate = on_other_plate(actual_panel(board).of(board), options.plate)
    board, drift = _drifting(options, board)
    scene_file = find_scene(board, options.scene)
    scene = load_scene(scene_file, board)
    recording = Recording.open(recording_path(board, options.replay))
    gateware, real_time = gateware_factory(options)

    def ready() -> None:
        if real_time:
            tell(f"playing {recording.name} in real time, {recording.duration_s:.0f} s (Ctrl-C ends it)")

    # the loop's and the twin's products are small: a second BLAS thread costs more to wake than it saves
    with open_bank(options, board, scene, scene_file) as bank, threadpool_limits(1, "blas"):
        overdone = [f"{scene_file}: {warning}" for warning in edge_warnings(scene, board, *bank.worst_edges)]
        for warning in overdone:
            tell(warning)
        done = simulated_run.play(
            board,
            scene,
            bank,
            recording,
            real_time=real_time,
            ready=ready,
            hardware=simulated_run.Hardware(gateware, plate, drift),
        )
        expected = expected_of(bank.header, board, plate)
        evaluated = focus_evaluation.judge(done, progress_bar("plate"))
    if evaluated.left_out:
        tell(f"interrupted: {evaluated.left_out} emissions are not in the figures of the foci")
    asked = {"link": options.link or "model", "bank": str(bank.path), "memory": memory_fit(board).in_words()}
    asked |= {"expected": None if expected is None else expected.figures(done.bit_clock.temperature_c if done.bit_clock else None)}
    figures = asked | run_figures.report(done, evaluated.foci)
    for warning in figures["warnings"]:
        tell(warning)
    figures["warnings"] = [*overdone, *figures["warnings"]]
    show(options, figures, run_table if options.verbose else felt)
    if picture:
        _plot_run(picture, board, evaluated, recording.name)
    return 0


def _drifting(options: argparse.Namespace, board: Board) -> tuple[Board, Drift | None]:
    """The board with the temperature sensor that is asked for, and the drift."""
    from controller.workshop.simulation.drift import ASSUMED, Drift

    if options.drift_percent is not None:
        drift = Drift.constant(options.drift_percent)
    elif options.drift:
        drift = Drift.read(Path(options.drift))
    else:
        if options.sensor:
            raise UsageError("--sensor is of no use without --drift-percent or --drift")
        return board, None
    if options.sensor == "assumed":
        return msgspec.structs.replace(board, temperature=ASSUMED), drift
    if options.sensor == "none":
        return msgspec.structs.replace(board, temperature=None), drift
    if board.temperature is None:
        tell("the board has no [temperature], so nothing corrects the drift: add --sensor assumed")
    return board, drift


def _plot_run(path: Path, board: Board, evaluated: Evaluated, recording: str) -> None:
    from controller.workshop.physics.pictures.plot import plot_focus

    if evaluated.field is None:
        tell("nothing was played, so there is nothing to draw")
        return
    foci = sorted(evaluated.shown, key=lambda focus: -abs(focus.metrics.amplitude_m))
    fingers = sum(focus.emission.finger is not None for focus in foci)
    title = f"{recording}, t = {foci[0].time_s:.3f} s: {fingers} finger{'s' * (fingers != 1)} at once"
    plot_focus(path, board, evaluated.field, [(focus.x_m, focus.y_m) for focus in foci], title)
