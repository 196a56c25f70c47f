"""The command line: arguments, exit codes, printing. Every subcommand is one call into a room.

The offline room is imported only by the commands that need it: a device may lack its packages.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from controller import __version__
from controller.bank.grid import Grid
from controller.bank.inspection import bank_info, is_current, verify_bank
from controller.bank.location import bank_path
from controller.bank.reader import Bank
from controller.board import Board, find_board, load_board
from controller.errors import BankError, ConfigError, ControllerError
from controller.event_loop import MonotonicClock, VirtualClock
from controller.fpga.gateware import GatewareFactory
from controller.fpga.model import GatewareModel
from controller.hardware import open_fpga, open_serial, recording_path
from controller.scene import Scene, edge_warnings, load_scene, reach
from controller.scene_file import find_scene
from controller.tables import plain_table, power_table, run_table
from controller.touch.recording import Recording

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from controller.offline.bank_builder import BuildReport
    from controller.offline.simulated_run import Judged

SMALLEST_PITCH_MM = 0.5
OFFLINE_HINT = "this command needs the offline tools: pip install 'haptic-panel[offline]'"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; its exit code (0, or 2 usage, 78 configuration, 69 device missing, 1 otherwise)."""
    options = _parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # outside the event loop it ends a command as Ctrl-C does
    command: Callable[[argparse.Namespace], int] = options.command
    try:
        return command(options)
    except ControllerError as error:
        print(f"haptic-panel: {error}", file=sys.stderr)
        return error.exit_code
    except ModuleNotFoundError as error:
        if error.name in {"scipy", "matplotlib", "tqdm", "threadpoolctl"}:
            print(f"haptic-panel: {OFFLINE_HINT} ({error.name} is missing)", file=sys.stderr)
            return 69
        raise
    except BrokenPipeError:
        sys.stderr.close()
        return 1
    except OSError as error:
        print(f"haptic-panel: {error}", file=sys.stderr)
        return 1
    except MemoryError:
        print("haptic-panel: not enough memory for what was asked", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("haptic-panel: interrupted", file=sys.stderr)
        return 130


def run(options: argparse.Namespace) -> int:
    """Replay a recording on the simulated panel and print what its fingers would have felt."""
    from threadpoolctl import threadpool_limits

    from controller.offline import simulated_run

    picture = _picture(options)
    board = load_board(find_board(options.board))
    scene_file = find_scene(board, options.scene or board.scene)
    scene = load_scene(scene_file, board)
    recording = Recording.open(recording_path(board, options.replay))
    gateware, real_time = _gateware(options)

    def ready() -> None:
        if real_time:
            print(
                f"haptic-panel: playing {recording.name} in real time, {recording.duration_s:.0f} s (Ctrl-C ends it)",
                file=sys.stderr,
            )

    # the loop's and the twin's products are small: a second BLAS thread costs more to wake than it saves
    with _open_bank(options, board, scene, scene_file) as bank, threadpool_limits(1, "blas"):
        overdone = [f"{scene_file}: {warning}" for warning in edge_warnings(scene, board, *bank.worst_edges)]
        for warning in overdone:
            print(f"haptic-panel: {warning}", file=sys.stderr)
        done = simulated_run.play(board, scene, bank, recording, real_time=real_time, ready=ready, gateware=gateware)
        judged = simulated_run.judge(done, _progress("plate"))
    if judged.left_out:
        print(f"haptic-panel: interrupted: {judged.left_out} emissions are not in the figures of the foci", file=sys.stderr)
    figures = {"link": options.link} | simulated_run.report(done, judged.foci)
    for warning in figures["warnings"]:
        print(f"haptic-panel: {warning}", file=sys.stderr)
    figures["warnings"] = overdone + figures["warnings"]
    _show(options, figures, run_table)
    if picture:
        _plot_run(picture, board, judged, recording.name)
    return 0


def gateware_check(options: argparse.Namespace) -> int:
    """Bring up an FPGA, simulated or at a serial port: identity, link, memory and every channel."""
    from controller.fpga import bring_up

    board = load_board(find_board(options.board))
    if options.device:
        serial = msgspec.structs.replace(board.link, kind="serial", device=options.device, baud=options.baud)
        board = msgspec.structs.replace(board, link=serial)
    channels = _channels(options, board)
    if board.link.kind == "serial":
        clock: MonotonicClock | VirtualClock = MonotonicClock()
        link, session = open_serial(board, clock.now_s)
        done = bring_up.check(session, board, clock, options.bits, channels, options.pause_s, _progress("bits"))
        link.close()
    else:
        clock = VirtualClock()
        simulated, session = open_fpga(board, clock.now_s, _gateware(options)[0])
        done = bring_up.check(
            session,
            board,
            clock,
            options.bits,
            _channels(options, board),
            options.pause_s,
            _progress("bits"),
            simulated.take_capture,
        )
    _show(options, asdict(done), plain_table)
    for complaint in done.complaints:
        print(f"haptic-panel: {complaint}", file=sys.stderr)
    return 1 if done.complaints else 0


def _channels(options: argparse.Namespace, board: Board) -> list[int]:
    """Channels to chirp on: those asked for, else all that the board has."""
    there = [actuator.channel for actuator in board.actuators]
    for channel in options.channel or []:
        if channel not in there:
            raise ConfigError(f"--channel: board {board.name!r} has no channel {channel}")
    return sorted(options.channel or there)


def _gateware(options: argparse.Namespace) -> tuple[GatewareFactory, bool]:
    """What computes the gateware's pins, and whether in real time."""
    if options.link == "model":
        return GatewareModel, getattr(options, "speed", "max") != "max"
    from controller.offline.rtl_gateware import RtlGateware

    if getattr(options, "speed", "max") == "1":
        raise ConfigError("--link rtl is slower than real time, and the FPGA would call the host silent: use --speed max")

    def compiling() -> None:
        print("haptic-panel: compiling the gateware, about 10 s", file=sys.stderr)

    return partial(RtlGateware, compiling=compiling), False


def bank_build(options: argparse.Namespace) -> int:
    """Build a bank for a board: of the whole plate, or of the cells that a scene can reach."""
    board = load_board(find_board(options.board))
    scene_file = find_scene(board, options.scene) if options.scene else None
    scene = load_scene(scene_file, board) if scene_file else None
    if options.pitch_mm is not None and not options.pitch_mm >= SMALLEST_PITCH_MM:  # NaN too
        raise ConfigError(f"--pitch-mm: pitch_mm = {options.pitch_mm:g} is not {SMALLEST_PITCH_MM:g} or more")
    path = Path(options.out) if options.out else bank_path(board.name, scene_file.stem if scene_file else "plate")
    pitch_m = (board.bank.pitch_mm if options.pitch_mm is None else options.pitch_mm) * 1e-3
    name = scene_file.name if scene_file else None
    _show(options, asdict(_build(board, path, pitch_m, scene, name, measure=True)), plain_table)
    return 0


def bank_tell(options: argparse.Namespace) -> int:
    """Say what a bank holds and what it was computed from, or what playing it costs the driver stages."""
    if options.power:
        from controller.offline.power import power_report

        board = load_board(find_board(options.board))
        with Bank.open(_bank_file(options), board) as bank:
            _show(options, power_report(board, bank, progress=_progress("losses")), power_table)
        return 0
    _show(options, bank_info(_bank_file(options)), plain_table)
    return 0


def bank_check(options: argparse.Namespace) -> int:
    """Check every bit of a bank."""
    _show(options, verify_bank(_bank_file(options)), plain_table)
    return 0


def _bank_file(options: argparse.Namespace) -> Path:
    """The file given, else the board's bank that was built last."""
    if options.file:
        return Path(options.file)
    board = load_board(find_board(options.board))
    banks = sorted(bank_path(board.name, "x").parent.glob(f"{board.name}-*.bank"), key=lambda file: file.stat().st_mtime)
    if not banks:
        raise BankError(f"board {board.name!r} has no bank yet; build it: haptic-panel bank build --board {board.called}")
    return banks[-1]


def focus(options: argparse.Namespace) -> int:
    """Focus on points of the plate and say how good the focus is; or measure the figures of the README."""
    from controller.offline.work_precision import figures, focus_on

    picture = _picture(options)
    board = load_board(find_board(options.board))
    if options.figures:
        _show(options, figures(board, options.seed), plain_table)
        return 0
    if options.idle_figures:
        from controller.offline.idle_figures import idle_figures

        found = idle_figures(board, options.seed)
        if picture:
            from controller.offline.plot_idle import plot_idle

            plot_idle(picture, board, found)
        _show(options, found, plain_table)
        return 0
    if not options.at:
        raise ConfigError("focus where? give --at X_MM Y_MM once for each point, or --figures, or --idle-figures")
    points_m = [(_on_plate(x_mm, board.plate.length_mm), _on_plate(y_mm, board.plate.width_mm)) for x_mm, y_mm in options.at]
    field, rows = focus_on(board, points_m)
    if picture:
        from controller.offline.plot import plot_focus

        plot_focus(picture, board, field, points_m, f"focus on {len(points_m)} point{'s' * (len(points_m) != 1)}")
    _show(options, {"board": board.name, "foci": rows}, lambda shown: "\n\n".join(map(plain_table, shown["foci"])))
    return 0


def _on_plate(position_mm: float, extent_mm: float) -> float:
    """Position in m of a focus.

    Raises
    ------
    ConfigError
        If nothing can move there.
    """
    if not 0 < position_mm < extent_mm:  # NaN too
        raise ConfigError(f"--at {position_mm:g}: not inside the plate (0 to {extent_mm:g} mm)")
    return position_mm * 1e-3


def _open_bank(options: argparse.Namespace, board: Board, scene: Scene, scene_file: Path) -> Bank:
    """Bank asked for, or the board's own, which is built again when it is missing, damaged, or of another board or scene."""
    if options.bank:
        return Bank.open(Path(options.bank), board)
    path = bank_path(board.name, scene_file.stem)
    pitch_m = board.bank.pitch_mm * 1e-3
    if not is_current(path, board, pitch_m, _cells(board, pitch_m, scene)):
        print(f"haptic-panel: building the bank {path}", file=sys.stderr)
        _build(board, path, pitch_m, scene, scene_file.name, measure=False)
    return Bank.open(path, board)


def _cells(board: Board, pitch_m: float, scene: Scene) -> NDArray[np.bool_]:
    return reach(scene, Grid.of(board.plate, pitch_m).points(), pitch_m)


def _build(board: Board, path: Path, pitch_m: float, scene: Scene | None, name: str | None, *, measure: bool) -> BuildReport:
    from controller.offline.bank_builder import build_bank

    cells = None if scene is None else _cells(board, pitch_m, scene)
    return build_bank(board, path, pitch_m, cells, scene=name, progress=True, measure_sgemm=measure)


def _natural(text: str) -> int:
    """Argument that is a whole number from 0."""
    if not text.isascii() or not text.isdigit():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0")
    return int(text)


def _picture(options: argparse.Namespace) -> Path | None:
    """File asked for with --plot, refused before any work if it could not be written."""
    if not options.plot:
        return None
    from controller.offline.plot import check_picture

    check_picture(Path(options.plot))
    return Path(options.plot)


def _plot_run(path: Path, board: Board, judged: Judged, recording: str) -> None:
    from controller.offline.plot import plot_focus

    if judged.field is None:
        print("haptic-panel: nothing was played, so there is nothing to draw", file=sys.stderr)
        return
    foci = sorted(judged.shown, key=lambda focus: -focus.metrics.amplitude_m)
    fingers = sum(focus.emission.finger is not None for focus in foci)
    title = f"{recording}, t = {foci[0].time_s:.3f} s: {fingers} finger{'s' * (fingers != 1)} at once"
    plot_focus(path, board, judged.field, [(focus.x_m, focus.y_m) for focus in foci], title)


def _progress(what: str) -> Callable[[int, int], None]:
    """A progress bar on stderr for work over 2 s, told of what is done and the total; silent when stderr is no terminal."""
    from tqdm import tqdm

    bar = tqdm(desc=what, disable=None, delay=2, leave=False)

    def progress(done: int, total: int) -> None:
        bar.total = total
        bar.update(done - bar.n)
        if done >= total:
            bar.close()

    return progress


def _show(options: argparse.Namespace, figures: dict[str, Any], table: Callable[[dict[str, Any]], str]) -> None:
    print(json.dumps(figures, allow_nan=False) if options.json else table(figures))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="haptic-panel",
        description="Controller of a glass panel that pushes back under each finger.",
        epilog="exit codes: 0 done, 2 usage, 69 device missing, 78 configuration or bank, 1 otherwise",
    )
    parser.add_argument("--version", action="version", version=f"haptic-panel {__version__}")
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--board", default="simulated", metavar="B", help="name, or folder with a board.toml (default: simulated)")
    common.add_argument("--json", action="store_true", help="print one JSON object and nothing else on stdout")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)

    play = commands.add_parser(
        "run",
        parents=[common],
        help="replay a touch recording on the simulated panel",
        description="Replay a touch recording through the event loop, the frame protocol and the gateware, let a simulated "
        "plate feel every emission, and print what the fingers felt. Builds the board's bank when it is missing or stale.",
    )
    play.add_argument("--replay", metavar="FILE", help="evemu recording (default: the board's own)")
    play.add_argument("--scene", metavar="S", help="name beside the board's file, or path (default: the board's own)")
    play.add_argument(
        "--bank", metavar="FILE", help="play from this bank; it is refused, not rebuilt, if it does not fit the board"
    )
    play.add_argument(
        "--link", choices=["model", "rtl"], default="model", help="the FPGA: its model (default), or its Verilog, compiled"
    )
    play.add_argument(
        "--speed", choices=["1", "max"], help="1: real time (default); max: as fast as the machine goes (always with --link rtl)"
    )
    play.add_argument("--plot", metavar="FILE", help="draw the plate at T, fingers and a cross-section (.png, .svg, .pdf)")
    play.set_defaults(command=run)

    gateware = commands.add_parser("gateware", help="bring up an FPGA").add_subparsers(metavar="COMMAND", required=True)
    check = gateware.add_parser(
        "check",
        parents=[common],
        help="identity, link, memory and every channel of an FPGA",
        description="Read what the FPGA says of itself, send random bits and count those that come back wrong, fill and read "
        "back every slot, and chirp on one channel after the other. Outputs are on during the chirps, if the permits are given.",
    )
    check.add_argument("--link", choices=["model", "rtl"], default="model", help="as for run, while the board's link is simulated")
    check.add_argument("--device", metavar="TTY", help="serial port of a real FPGA, such as /dev/ttyUSB0")
    check.add_argument("--baud", type=int, default=1_000_000, metavar="N", help="rate that its gateware was built for (1000000)")
    check.add_argument("--bits", type=float, default=1e5, metavar="N", help="random bits to send at least (default: 1e5)")
    check.add_argument(
        "--channel", type=int, action="append", metavar="Q", help="chirp on this channel only; may be given again (default: all)"
    )
    check.add_argument("--pause-s", type=float, default=0.0, metavar="S", help="silence behind each channel's chirps")
    check.set_defaults(command=gateware_check)

    bank = commands.add_parser("bank", help="build, look at and check banks of precomputed waveforms")
    actions = bank.add_subparsers(title="actions", metavar="ACTION", required=True)
    build = actions.add_parser("build", parents=[common], help="compute a bank from the board's plate model")
    build.add_argument("--scene", metavar="S", help="only cells that this scene can reach (default: the whole plate)")
    build.add_argument("--pitch-mm", type=float, metavar="P", help="distance of the cells (default: the board's bank.pitch_mm)")
    build.add_argument("--out", metavar="F", help="file to write (default: in the state or cache folder)")
    build.set_defaults(command=bank_build)
    for name, action, text in (
        ("info", bank_tell, "say what a bank holds and what it was computed from"),
        ("verify", bank_check, "check every bit of a bank"),
    ):
        command = actions.add_parser(name, parents=[common], help=text, description=f"{text.capitalize()}.")
        command.add_argument("file", nargs="?", metavar="FILE", help="the bank (default: the board's bank built last)")
        command.set_defaults(command=action)
        if name == "info":
            command.add_argument("--power", action="store_true", help="edges, loss and power of the stages, and limits for them")

    point = commands.add_parser(
        "focus",
        parents=[common],
        help="focus on given points of the model plate, and judge the focus",
        description="Compute the waveform for one or several points without a bank and judge the focus on the plate model.",
    )
    point.add_argument("--at", nargs=2, type=float, action="append", metavar=("X_MM", "Y_MM"), help="a point; may be repeated")
    point.add_argument("--figures", action="store_true", help="measure the figures of the README at random points instead")
    point.add_argument(
        "--idle-figures", action="store_true", help="measure what the idle word and its ramp are worth instead; --plot draws it"
    )
    point.add_argument("--seed", type=_natural, default=1, help="of the random points (default: 1)")
    point.add_argument("--plot", metavar="FILE", help="draw the plate at T (.png, .svg, .pdf)")
    point.set_defaults(command=focus)
    return parser
