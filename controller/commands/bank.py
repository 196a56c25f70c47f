"""`haptic-panel bank`: build, describe and verify banks of precomputed waveforms."""

import argparse
import contextlib
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

from controller.commands.common.arguments import Declare, natural
from controller.commands.common.expected import expected_of
from controller.commands.common.named_board import board_of, named_board
from controller.commands.common.output import progress_bar, show
from controller.commands.common.worker_options import UNLESS_OPTIMISED, add_worker_options, workers_of_bank
from controller.console import tell
from controller.device.bank.expectation import in_words
from controller.device.bank.inspection import bank_info, header_of, measured_at, verify_bank
from controller.device.bank.lookup import FoundBank, bank_as_it_is, find_bank
from controller.device.bank.memory import memory_fit
from controller.device.bank.provenance import MEASURE_AGAIN
from controller.device.bank.reader import Bank
from controller.device.board.board import Board, of_one_fpga
from controller.device.board.lookup import fpga_files
from controller.device.board.paths import bank_path, build_line, is_there
from controller.device.scene.scene import Scene, load_scene
from controller.device.scene.scene_file import find_scene
from controller.errors import BankError


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    bank = declare(
        example="haptic-panel bank build --board simulated --pitch-mm 4 --out plate.bank",
        description="A bank holds the precomputed drive waveform of each place on the plate; `haptic-panel run` plays from it.",
    )
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
        choices=("contrast", "quiet", "balanced", "loud", "cool", "felt"),
        help="optimise every entry: more contrast, less sound, both, a fifth more amplitude, or less heat in the stages; about half"
        " a second of a core a cell (default: none)",
    )
    build.add_argument(
        "--compact",
        action="store_true",
        help="a twentieth of the size: responses in four bits, all waveforms composed (default: as compose.method says)",
    )
    add_worker_options(build, UNLESS_OPTIMISED)
    build.set_defaults(command=bank_build)
    choices = actions.add_parser("choices", parents=[common], help="what pitch and memory cost a scene, and what auto would choose")
    choices.add_argument("--scene", metavar="S", help="the scene (default: the board's own)")
    choices.add_argument(
        "--methods",
        type=natural,
        nargs="?",
        const=4,
        metavar="FOCI",
        help="what each method of making drive words buys on this plate instead: felt amplitude, edges, heat, dB(A) of FOCI foci"
        " (default: 4; two minutes of a core)",
    )
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
                "--power",
                action="store_true",
                help="edges, loss and power of the driver stages, and the limits that follow; dB(A) and stress by the model",
            )


def bank_build(options: argparse.Namespace) -> int:
    """Build a bank for a board: for the whole plate, or for the cells that a scene can reach."""
    board = named_board(options.board)
    with _builder_installed(bank_path(board)):
        from controller.workshop.bank_builder.methods.aims import AIMS
        from controller.workshop.bank_builder.own_bank import order, warn_of_pitch
    wanted = order(board, find_scene(board, options.scene) if options.scene else None, options.pitch_mm, compact=options.compact)
    path = Path(options.out) if options.out else wanted.own_path
    if measured_at(path):
        again = f"{MEASURE_AGAIN} --optimise {options.optimise}" if options.optimise else MEASURE_AGAIN
        tell(f"{path}: its responses were measured, and become modelled; by what was measured: {again}")
    workers = workers_of_bank(options)
    try:
        report = wanted.build(path, aim=AIMS.get(options.optimise), workers=workers, memory_mb=options.memory_mb)
    except KeyboardInterrupt:
        if options.optimise or not workers.is_this_process:
            tell("what was done is kept: the same command goes on from there")
        raise
    warn_of_pitch(path, report)
    show(options, asdict(report), _build_table)
    if path != (played := find_bank(board)).path:
        tell(f"run plays from {played.path} ({played.why}) unless given --bank {path}")
    return 0


def bank_choices(options: argparse.Namespace) -> int:
    """Show the settings on the front of error, time and bytes for a scene and which `auto` chooses, or what methods buy."""
    board = board_of(options)
    if options.methods is not None:
        of_one_fpga(board)
        with _builder_installed(bank_path(board)):
            from controller.workshop.benchmark.builder_methods import method_figures
        found = method_figures(board, options.methods, progress=progress_bar("methods"))
        show(options, {"board": board.name, "foci": options.methods, "methods": found}, _methods_table)
        return 0
    with _builder_installed(bank_path(board)):
        from controller.workshop.bank_builder.own_bank import chosen
    scene_file = find_scene(board, options.scene)
    found = chosen(board, load_scene(scene_file, board), scene_file) | {"memory": memory_fit(board).in_words()}
    show(options, found, _choices_table)
    return 0


def _methods_table(figures: dict[str, Any]) -> str:
    rows: dict[str, dict[str, float]] = figures["methods"]
    heads = list(next(iter(rows.values())))
    lines = [
        f"medians of {figures['foci']} foci, over the board's own words but contrast and spot:",
        f"{'':<32}" + "".join(f"{head:>{max(len(head), 5) + 2}}" for head in heads),
    ]
    for method, found in rows.items():
        lines.append(f"{method:<32}" + "".join(f"{found[head]:>{max(len(head), 5) + 2}.2f}" for head in heads))
    return "\n".join(lines)


def _choices_table(choice: dict[str, Any]) -> str:
    lines = [f"{'pitch (mm)':>10}  {'cells within (mm)':>17}  {'loses at most':>13}  {'lone finger (us)':>16}  {'MB':>6}"]
    for pitch_mm, snap_mm, error, lone_us, size in choice["front"]:
        chosen = (pitch_mm, snap_mm) == (choice["pitch_mm"], choice["snap_mm"] if choice["composes"] else None)
        played = "no responses" if snap_mm is None else f"{snap_mm:g}"
        lines.append(
            f"{pitch_mm:>10g}  {played:>17}  {100 * error:>11.1f} %  {lone_us:>16.2f}  {size / 1e6:>6.1f}{'  <- auto' * chosen}"
        )
    return "\n".join([*lines, choice["why"], choice["memory"]])


def bank_describe(options: argparse.Namespace) -> int:
    """Describe what a bank holds and what it was computed from; with --power, the load on the driver stages, sound and stress."""
    if options.power:
        from controller.commands.common.tables import power_table
        from controller.workshop.benchmark.focus.bank_emissions import bank_emissions
        from controller.workshop.benchmark.stage.power import power_report

        board = of_one_fpga(board_of(options))
        with Bank.open(_bank_file(options).path, board) as bank:
            report = power_report(board, bank, progress=progress_bar("losses"))
            show(options, report | bank_emissions(board, bank), power_table)
        return 0
    from controller.commands.common.tables import plain_table

    def table(figures: dict[str, Any]) -> str:
        """Without the parts of what the line `responses` says."""
        parameters = {name: value for name, value in figures["parameters"].items() if name != "responses"}
        return plain_table(figures | {"parameters": parameters, "expected": figures["expected"]["said"]})

    found = _bank_file(options)
    show(options, bank_info(found.path) | {"chosen": found.why, "expected": _expected(options, found.path)}, table)
    return 0


def _expected(options: argparse.Namespace, path: Path) -> dict[str, Any]:
    """What a bank is expected to do on this panel; of a bank of another board only that it is one."""
    board = board_of(options)
    if header_of(path).board_digest != board.fpga_boards[0].digest():
        return {"said": f"nothing: the bank is not of board {board.name!r} (--board says which it is)"}
    with Bank.open(path, board) as bank:
        expected = expected_of(bank.header, board)
    figures = None if expected is None else expected.figures()
    return {"said": in_words(figures)} | (figures or {})


def bank_verify(options: argparse.Namespace) -> int:
    """Check every bit of a bank."""
    path = _bank_file(options).path
    fpgas = 0 if options.file else len(board_of(options).link.fpga)
    try:
        found = [verify_bank(file, progress_bar("bytes")) for file in fpga_files(path, fpgas)]
    except BankError as error:
        raise BankError(f"FAIL: {error}") from error
    show(options, found[0] | {"bytes": sum(one["bytes"] for one in found)}, _verify_table)
    return 0


def _verify_table(figures: dict[str, Any]) -> str:
    reported = f"{figures['cells']:,} cells, {figures['bytes']:,} bytes"
    return f"bank: {figures['path']}, {reported}\nPASS: every bit is as it was written"


def open_bank(options: argparse.Namespace, board: Board, scene: Scene, scene_file: Path, *, keep: bool = False) -> Bank:
    """The bank of --bank, or the board's own, which is built if it is missing and, unless `keep`, if it does not suit."""
    if bank := bank_as_it_is(board, options.bank, keep=keep):
        return bank
    with _builder_installed(bank_path(board)):
        from controller.workshop.bank_builder.own_bank import own_bank
    return own_bank(board, scene, scene_file)


def _bank_file(options: argparse.Namespace) -> FoundBank:
    """The file given, else the bank that the board plays."""
    if options.file:
        return FoundBank(Path(options.file), "given")
    board = board_of(options)
    found = find_bank(board)
    if not is_there(found.path):
        raise BankError(f"{found.path}: there is no such bank yet; build it: {build_line(found.path, board)}")
    return found


@contextlib.contextmanager
def _builder_installed(path: Path) -> Iterator[None]:
    """Around imports of what builds banks; BankError where it is not installed, as on a device."""
    try:
        yield
    except ModuleNotFoundError as error:
        from controller.device.service.installation import missing_package

        missing = missing_package(error.name)
        if missing is None:
            raise
        raise BankError(f"{path}: cannot be built here: {missing}; or build it on another computer and copy it there") from error


def _build_table(figures: dict[str, Any]) -> str:
    from controller.commands.common.tables import plain_table

    return f"{plain_table({name: value for name, value in figures.items() if name != 'path'})}\nbank: {figures['path']}"
