"""`haptic-panel bank`: build, describe and verify banks of precomputed waveforms."""

from __future__ import annotations

import argparse
import contextlib
import os
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from controller.bank.grid import Grid
from controller.bank.inspection import (
    Fit,
    asked_of,
    bank_info,
    choice_of,
    fit,
    measured_at,
    optimised_for,
    verify_bank,
    wrong_pitch,
)
from controller.bank.lookup import FoundBank, find_bank
from controller.bank.provenance import MEASURE_AGAIN
from controller.bank.reader import Bank
from controller.board.board import Board, load_board
from controller.board.lookup import find_board
from controller.board.paths import bank_path, build_line, is_there
from controller.commands.named_board import named_board
from controller.commands.output import progress_bar, show
from controller.console import tell
from controller.errors import BankError, ConfigError, UsageError
from controller.scene.coverage import cells_needed
from controller.scene.scene import Scene, Spot, load_scene
from controller.scene.scene_file import find_scene

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from controller.bank_builder.build import BuildReport
    from controller.commands.output import Declare

SMALLEST_PITCH_MM = 0.5
MET_AHEAD_M = 5e-3  # beyond its region, a moving finger is met this far ahead; farther, where it was


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    bank = declare()
    actions = bank.add_subparsers(title="actions", metavar="ACTION", required=True)
    build = actions.add_parser("build", parents=[common], help="compute a bank from the board's plate model")
    build.add_argument("--scene", metavar="S", help="only cells that this scene can reach (default: the whole plate)")
    build.add_argument(
        "--pitch-mm", type=float, metavar="P", help="distance of the cells in mm (default: the board's bank.pitch_mm)"
    )
    build.add_argument("--out", metavar="F", help="file to write (default: where run looks for the board's bank, which is printed)")
    build.add_argument(
        "--memory-mb",
        type=float,
        metavar="M",
        help="memory that the build may take, in MB (default: 1500); refused if it needs more",
    )
    build.add_argument(
        "--optimise",
        choices=("contrast", "quiet", "balanced"),
        help="optimise every entry: more contrast, less sound, or both; about half a second of a core a cell (default: neither)",
    )
    build.add_argument("--workers", type=int, metavar="N", help="processes that optimise (default: one for each core)")
    build.add_argument("--dask", metavar="ADDRESS", help="optimise on the workers of this dask scheduler, tcp://HOST:PORT")
    build.set_defaults(command=bank_build)
    choices = actions.add_parser("choices", parents=[common], help="what pitch and memory cost a scene, and what auto would choose")
    choices.add_argument("--scene", metavar="S", help="the scene (default: the board's own)")
    choices.set_defaults(command=bank_choices)
    for name, action, text in (
        ("info", bank_describe, "describe what a bank holds and what it was computed from"),
        ("verify", bank_verify, "check every bit of a bank"),
    ):
        command = actions.add_parser(name, parents=[common], help=text, description=f"{text.capitalize()}.")
        command.add_argument("file", nargs="?", metavar="FILE", help="the bank (default: the board's own)")
        command.set_defaults(command=action)
        if name == "info":
            command.add_argument(
                "--power", action="store_true", help="edges, loss and power of the driver stages, and the limits that follow"
            )


def bank_build(options: argparse.Namespace) -> int:
    """Build a bank for a board: for the whole plate, or for the cells that a scene can reach."""
    board = named_board(options.board)
    scene_file = find_scene(board, options.scene) if options.scene else None
    scene = load_scene(scene_file, board) if scene_file else None
    if options.pitch_mm is not None and not options.pitch_mm >= SMALLEST_PITCH_MM:  # NaN too
        raise ConfigError(f"--pitch-mm: pitch_mm = {options.pitch_mm:g} is not {SMALLEST_PITCH_MM:g} or more")
    if options.optimise is None and (options.workers is not None or options.dask is not None):
        raise UsageError("--workers and --dask are of use with --optimise: a plain bank takes seconds")
    if options.workers is not None and (options.workers < 1 or options.dask is not None):
        raise UsageError("--workers: 1 or more processes of this computer, and not with --dask")
    choice = None
    if board.compose.method == "auto" and options.pitch_mm is None:
        scene_file = scene_file or find_scene(board)
        scene = scene or load_scene(scene_file, board)
        choice = _choose(board, scene, scene_file)
        tell(f"{scene_file.name}: {choice['why']}")
    pitch_m = _pitch_m(board, choice) if options.pitch_mm is None else options.pitch_mm * 1e-3
    own = bank_path(board, None if choice else pitch_m)
    path = Path(options.out) if options.out else own
    cells = None if scene is None else _cells(board, pitch_m, scene)
    name, spots = (scene_file.name, scene.spots) if scene_file and scene else (None, ())
    if measured_at(path):
        tell(f"{path}: its responses were measured, and become modelled; back: {MEASURE_AGAIN}")
    report = _build(board, path, pitch_m, cells, name, spots, choice, measure=True, options=options)
    show(options, asdict(report), _build_table)
    if path != (played := find_bank(board)).path:
        tell(f"run plays from {played.path} ({played.why}) unless told --bank {path}")
    return 0


def bank_choices(options: argparse.Namespace) -> int:
    """Show the settings of a bank on the front of error, time and bytes for a scene, and which of them `auto` chooses."""
    board = load_board(find_board(options.board))
    scene_file = find_scene(board, options.scene)
    show(options, _choose(board, load_scene(scene_file, board), scene_file), _choices_table)
    return 0


def _choices_table(choice: dict[str, Any]) -> str:
    lines = [f"{'pitch (mm)':>10}  {'cells within (mm)':>17}  {'loses at most':>13}  {'lone finger (us)':>16}  {'MB':>6}"]
    for pitch_mm, snap_mm, error, lone_us, size in choice["front"]:
        chosen = (pitch_mm, snap_mm) == (choice["pitch_mm"], choice["snap_mm"] if choice["composes"] else None)
        played = "no responses" if snap_mm is None else f"{snap_mm:g}"
        lines.append(
            f"{pitch_mm:>10g}  {played:>17}  {100 * error:>11.1f} %  {lone_us:>16.2f}  {size / 1e6:>6.1f}{'  <- auto' * chosen}"
        )
    return "\n".join([*lines, choice["why"]])


def bank_describe(options: argparse.Namespace) -> int:
    """Describe what a bank holds and what it was computed from; with --power, the load on the driver stages."""
    if options.power:
        from controller.benchmark.power import power_report
        from controller.commands.tables import power_table

        board = load_board(find_board(options.board))
        with Bank.open(_bank_file(options).path, board) as bank:
            show(options, power_report(board, bank, progress=progress_bar("losses")), power_table)
        return 0
    from controller.commands.tables import plain_table

    def table(figures: dict[str, Any]) -> str:
        """Without the parts of what the line `responses` says."""
        parameters = {name: value for name, value in figures["parameters"].items() if name != "responses"}
        return plain_table(figures | {"parameters": parameters})

    found = _bank_file(options)
    show(options, bank_info(found.path) | {"chosen": found.why}, table)
    return 0


def bank_verify(options: argparse.Namespace) -> int:
    """Check every bit of a bank."""
    file = _bank_file(options).path
    try:
        found = verify_bank(file, progress_bar("bytes"))
    except BankError as error:
        raise BankError(f"FAIL: {error}") from error
    show(options, found, _verify_table)
    return 0


def _verify_table(figures: dict[str, Any]) -> str:
    told = f"{figures['cells']:,} cells, {figures['bytes']:,} bytes"
    return f"bank: {figures['path']}, {told}\nPASS: every bit is as it was written"


def open_bank(options: argparse.Namespace, board: Board, scene: Scene, scene_file: Path, *, keep: bool = False) -> Bank:
    """The bank of --bank, or the board's own, which is built if it is missing, and rebuilt if it does not fit.

    Parameters
    ----------
    keep : bool
        Build only a missing bank: the service of a panel never replaces a bank.

    Raises
    ------
    BankError
        If the given bank does not fit the board, or the board's own cannot be built.
    """
    if options.bank:
        return Bank.open(Path(options.bank), board)
    found_bank = find_bank(board)
    path = found_bank.path
    if (keep and is_there(path)) or found_bank.of_release:
        bank = Bank.open(path, board)
        if wrong := wrong_pitch(bank, board):
            bank.close()
            raise BankError(f"{path}: {wrong}; rebuild it: {bank.rebuild}")
        return bank
    choice, found = None, None
    if board.compose.method == "auto":
        there = choice_of(path)
        choice = there if there and there["asked"] == asked_of(board, scene_file) else _choose(board, scene, scene_file)
        if there and any(there[name] != choice[name] for name in ("pitch_mm", "snap_mm", "composes")):
            found = Fit(f"{scene_file.name} needs {choice['why'].partition(':')[0]}", _cells(board, _pitch_m(board, choice), scene))
    pitch_m = _pitch_m(board, choice)
    found = found or fit(path, board, _cells(board, pitch_m, scene))
    if found.reason:
        if measured_at(path):
            raise BankError(
                f"{path}: {found.reason}; its responses were measured, so it is not replaced by one from the plate model: build it"
                f" again, {MEASURE_AGAIN}, or give another with --bank"
            )
        count = int(found.cells.sum())
        tell(f"building the bank {path}: {found.reason}; {count:,} cells, some seconds")
        if aim := optimised_for(path):
            tell(f"its entries were optimised, and become plain: {build_line(path, board)} --optimise {aim}")
        path = bank_path(board)
        _build(board, path, pitch_m, found.cells, scene_file.name, scene.spots, choice, measure=False)
    return Bank.open(path, board)


def _bank_file(options: argparse.Namespace) -> FoundBank:
    """The file given, else the bank that the board plays."""
    if options.file:
        return FoundBank(Path(options.file), "given")
    board = load_board(find_board(options.board))
    found = find_bank(board)
    if not is_there(found.path):
        raise BankError(f"{found.path}: there is no such bank yet; build it: {build_line(found.path, board)}")
    return found


def _choose(board: Board, scene: Scene, scene_file: Path) -> dict[str, Any]:
    """What `compose.method = "auto"` chooses for a scene."""
    with _builder_installed(bank_path(board)):
        from threadpoolctl import threadpool_limits

        from controller.bank_builder.choice import choose
    with threadpool_limits(1, "blas"):
        return choose(board, scene, scene_file, MET_AHEAD_M)


@contextlib.contextmanager
def _builder_installed(path: Path) -> Iterator[None]:
    """Around imports of what builds banks; BankError where it is not installed, as on a device."""
    try:
        yield
    except ModuleNotFoundError as error:
        from controller.service.installation import missing_package

        missing = missing_package(error.name)
        if missing is None:
            raise
        raise BankError(f"{path}: cannot be built here: {missing}; or build it on another computer and copy it there") from error


def _pitch_m(board: Board, choice: dict[str, Any] | None) -> float:
    return float(choice["pitch_mm"] if choice else board.bank.pitch_mm) * 1e-3


def _cells(board: Board, pitch_m: float, scene: Scene) -> NDArray[np.bool_]:
    from controller.physics.plate import wave_scale

    return cells_needed(scene, Grid.of(board.plate, pitch_m).points(), pitch_m, MET_AHEAD_M, wave_scale=wave_scale(board))


def _build(
    board: Board,
    path: Path,
    pitch_m: float,
    cells: NDArray[np.bool_] | None,
    scene: str | None,
    spots: Sequence[Spot],
    choice: dict[str, Any] | None = None,
    *,
    measure: bool,
    options: argparse.Namespace | None = None,
) -> BuildReport:
    """Build a bank; `options`: of `bank build`, where it says how."""
    with _builder_installed(path):
        from controller.bank_builder.build import build_bank
        from controller.bank_builder.interpolation_error import interpolation_warning, refuse_coarse
        from controller.bank_builder.optimised import ALONE, Workers
        from controller.waveform_design.descent import AIMS
    own_path = path == bank_path(board, None if choice else pitch_m)
    refuse_coarse(board, pitch_m)
    aim, workers = None, ALONE
    if options and options.optimise:
        aim, workers = AIMS[options.optimise], Workers(options.workers or len(os.sched_getaffinity(0)), options.dask)
    try:
        report = build_bank(
            board,
            path,
            pitch_m,
            cells,
            spots=spots,
            scene=scene,
            progress=True,
            measure_sgemm=measure,
            overwrite=own_path,
            aim=aim,
            workers=workers,
            choice=choice,
            memory_mb=options.memory_mb if options else None,
        )
    except KeyboardInterrupt:
        if aim:
            tell("what is optimised is kept: the same command goes on from there")
        raise
    if warning := interpolation_warning(report.interpolation_error):
        tell(f"{path}: {warning}")
    return report


def _build_table(figures: dict[str, Any]) -> str:
    from controller.commands.tables import plain_table

    return f"{plain_table({name: value for name, value in figures.items() if name != 'path'})}\nbank: {figures['path']}"
