"""`haptic-panel calibrate-touch`: map of the touch panel's axes to the plate, from touches at known places."""

import argparse
import selectors
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from controller.clocks import Clock, MonotonicClock, VirtualClock
from controller.commands.common.arguments import Declare, require_within
from controller.commands.common.output import show
from controller.console import tell
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.board.relations.touch import axes
from controller.device.service.drivers import open_touch
from controller.device.touch.live_source import LiveSource
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.source import TouchSource
from controller.device.touch_calibration.calibration import (
    HOLD_S,
    MAX_TARGETS,
    Calibration,
    Point,
    StationaryTouches,
    calibrate,
    check_targets,
    default_targets,
)
from controller.device.touch_calibration.touch_table import board_lines, check_writable, write_calibration
from controller.errors import CalibrationError, UsageError


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        parents=[common],
        example="haptic-panel calibrate-touch --board panel --write",
        description="Ask for a touch on each of 3 to 5 targets in turn, with one finger held still for a moment, and print the two "
        "lines for [touch] of board.toml with their residual. Coordinates are in mm from the plate's corner, x along the length.",
    )
    command.add_argument("--targets", type=int, choices=(3, 4, 5), help="how many (default: 5)")
    command.add_argument(
        "--at", nargs=2, type=float, action="append", metavar=("X_MM", "Y_MM"), help="a target of your own; give each of them"
    )
    what = command.add_mutually_exclusive_group()
    what.add_argument("--ghosts", action="store_true", help="instead: play while nobody touches the panel, and determine ghost_ms")
    command.add_argument(
        "--socket",
        metavar="S",
        help="of a panel whose service plays, by its application socket; prints the lines. --lag of such a panel is for the page",
    )
    what.add_argument("--lag", action="store_true", help="instead: slide a finger together with a mouse, and determine lag_ms")
    command.add_argument("--bank", metavar="FILE", help="with --ghosts: play from this bank")
    command.add_argument(
        "--reference",
        metavar="DEVICE",
        help="with --lag: the mouse, best by its path below /dev/input/by-id; -: steps of a page's mouse on stdin, with --socket",
    )
    command.add_argument("--seconds", type=float, metavar="N", help="with --lag: for so long (default: 20)")
    command.add_argument("--out", metavar="FILE", help="with --ghosts or --lag: store the measurement, for --replay")
    command.add_argument("--replay", metavar="FILE", help="take the touches from a recording, not from the board's panel")
    command.add_argument("--write", action="store_true", help="change these lines of the board's board.toml")
    command.set_defaults(command=calibrate_touch)


def calibrate_touch(options: argparse.Namespace) -> int:
    """Ask for touches and print, or write, the map that follows; with --ghosts or --lag determine these values instead."""
    _refuse_what_makes_no_sense(options)
    if options.socket is not None:
        from controller.commands.calibrate_touch.running import calibrate_running

        return calibrate_running(options)
    if options.ghosts:
        from controller.commands.calibrate_touch.ghosts import calibrate_ghosts

        return calibrate_ghosts(options)
    if options.lag:
        from controller.commands.calibrate_touch.lag import calibrate_lag

        return calibrate_lag(options)
    board = load_board(find_board(options.board), without=[axes])
    targets = (
        [(x_mm, y_mm) for x_mm, y_mm in options.at] if options.at else default_targets(board.plate, options.targets or MAX_TARGETS)
    )
    check_targets(targets, board.plate)
    if options.write:
        check_writable(board.folder / "board.toml")
    source, clock = _opened(board, options.replay, targets)
    try:
        touches = _touches(source, clock, targets, board)
    finally:
        source.close()
    found = calibrate(targets, touches, board.plate)
    file = board.folder / "board.toml"
    if options.write:
        write_calibration(file, found)
    show(options, _figures(board, targets, found, file if options.write else None), _table)
    return 0


def _opened(board: Board, replay: str | None, targets: Sequence[Point]) -> tuple[TouchSource, Clock]:
    """The board's panel on axes of 0 to 1, a recording of it, or the panel that is there of a simulated board."""
    if replay:
        return open_touch(_bare(board), Recording.open(Path(replay))), VirtualClock()
    if board.link.kind == "simulated" and board.link.device:
        from controller.workshop.simulation.simulated_touch import marks_touched

        return LiveSource(marks_touched(board, targets), _bare(board)), VirtualClock()
    return open_touch(_bare(board)), MonotonicClock()


def _refuse_what_makes_no_sense(options: argparse.Namespace) -> None:
    """Raise for an option that does not belong to the chosen measurement."""
    require_within(options, {"seconds": (5, 600)})
    mode = "--ghosts" if options.ghosts else "--lag" if options.lag else ""
    belongs = {  # to what an option belongs; empty: to the axes
        "targets": ("",),
        "at": ("",),
        "bank": ("--ghosts",),
        "reference": ("--lag",),
        "seconds": ("--lag",),
        "out": ("--ghosts", "--lag"),
    }
    for name, modes in belongs.items():
        if getattr(options, name) is not None and mode not in modes:
            wanted = f"it goes with {' or '.join(modes)}" if modes[0] else f"it is for the axes, without {mode}"
            raise UsageError(f"--{name} is of no use here: {wanted}")
    by_page = options.reference == "-"
    if by_page and options.socket is None:
        raise UsageError("--reference - is of no use without --socket: name the mouse's device")
    for name in ("bank", "out", "replay", "write", *(() if by_page else ("lag",))):
        if options.socket is not None and getattr(options, name):
            raise UsageError(f"--{name} is of no use with --socket: stop the service, and leave out --socket")
    for name in ("out", "reference", "seconds", "bank"):
        if options.replay and getattr(options, name) is not None:
            raise UsageError(f"--{name} is of no use with --replay: nothing is measured")


def _bare(board: Board) -> Board:
    """The board with a panel that covers the plate exactly, so that positions are fractions of the axes and none is left out."""
    plate = board.plate
    whole = {"x_mm_from_axes": (plate.length_mm, 0.0, 0.0), "y_mm_from_axes": (0.0, plate.width_mm, 0.0), "no_finger_mm": ()}
    return msgspec.structs.replace(board, touch=msgspec.structs.replace(board.touch, **whole))


def _touches(source: TouchSource, clock: Clock, targets: Sequence[Point], board: Board) -> list[Point]:
    """Position of each touch on the panel's axes, 0 to 1."""
    found: list[Point] = []
    held = StationaryTouches()
    _ask(targets, 0)
    while len(found) < len(targets):
        source_s = source.next_time_s()
        next_s = min(held.due_s, float("inf") if source_s is None else source_s)
        fileno = source.fileno()
        if fileno is None and next_s == float("inf"):
            raise CalibrationError(
                f"the recording ends after {len(found)} of {len(targets)} touches:"
                f" it needs one finger at a time, held still for {HOLD_S:g} s on each target"
            )
        with selectors.DefaultSelector() as selector:
            if fileno is not None:
                selector.register(fileno, selectors.EVENT_READ)
            clock.wait(selector, next_s)
        now_s = clock.now_s()
        place = held.take(source.read(now_s), now_s)
        if place is not None:
            found.append((place[0] / board.plate.length_m, place[1] / board.plate.width_m))
            _ask(targets, len(found))
    return found


def _ask(targets: Sequence[Point], index: int) -> None:
    if index == len(targets):
        return
    x_mm, y_mm = targets[index]
    tell(f"touch {index + 1} of {len(targets)}: at x = {x_mm:.1f} mm, y = {y_mm:.1f} mm, and hold still")


def _figures(board: Board, targets: Sequence[Point], found: Calibration, written: Path | None) -> dict[str, Any]:
    return {
        "board": board.name,
        "targets_mm": [list(target) for target in targets],
        "x_mm_from_axes": [round(value, 3) + 0.0 for value in found.x_mm_from_axes],
        "y_mm_from_axes": [round(value, 3) + 0.0 for value in found.y_mm_from_axes],
        "lines": list(board_lines(found)),
        "residual_mm": {"rms": found.rms_mm, "worst": found.worst_mm} if found.residuals_mm else None,
        "written": None if written is None else str(written),
    }


def _table(figures: dict[str, Any]) -> str:
    evaluated = residual_words(figures["residual_mm"], len(figures["targets_mm"]))
    where = f"written to {figures['written']}" if figures["written"] else "for [touch] of board.toml (--write puts them there)"
    return "\n".join([*figures["lines"], evaluated, where])


def residual_words(residual: dict[str, float | None] | None, targets: int) -> str:
    """How well the touches of all targets agree, in words."""
    if residual is None:
        return "residual: none with 3 targets, which any map meets; take 4 or 5 to see whether they agree"
    return f"residual: {residual['rms']:.2f} mm rms, {residual['worst']:.2f} mm at the worst of {targets}, each against the others"
