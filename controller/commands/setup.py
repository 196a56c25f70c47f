"""`haptic-panel setup`: the board folder of a new panel, from a few questions or flags, and the rest of the way."""

import argparse
import subprocess
import sys
from pathlib import Path
from typing import Any

from msgspec.inspect import Field, StrType

from controller.commands.common.arguments import Declare
from controller.commands.common.output import show
from controller.console import tell
from controller.device.board.board import Board
from controller.device.board.descriptions import described, structs_of, type_info, unit_of
from controller.device.board.records import as_record
from controller.device.board.reference import attributes
from controller.device.board.touch_panels import touch_record
from controller.device.doctor.way import WayStep, in_lines, way
from controller.device.service.installation import NO_WORKSHOP, is_installed
from controller.device.setup.answers import SetupAnswers, wanted_of
from controller.device.setup.board_folder import write_board
from controller.errors import ConfigError

FIELDS = {field.encode_name: field for field in structs_of(type_info(SetupAnswers))[0].fields}
STDERR = 2  # of this process, also where sys.stderr is no file
POSSIBLE_MM = 20.0  # of every length that is still to be asked


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        example="haptic-panel setup /etc/haptic-panel/boards/panel",
        description="Make the board folder of a new panel: board.toml, scene, and what its bitstream is built from. Asks for what "
        "no option gives; where stdin is no terminal, defaults are taken. Prints the rest of the way, of which `doctor` ticks off "
        "what is done.",
    )
    command.add_argument("folder", type=Path, help="folder to make; its name is the board's")
    texts = attributes(SetupAnswers)
    for name, field in FIELDS.items():
        option = f"--{name.replace('_', '-')}"
        command.add_argument(option, metavar=unit_of(name) or name.upper(), help=f"{texts[name].rstrip('.')}{_default(field)}")
    command.add_argument(
        "--touch-key",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="key of [touch], such as bus=/dev/i2c-1; may be repeated",
    )
    command.add_argument("--build", action="store_true", help="build bitstream and bank too: minutes; needs a checkout's extras")
    command.add_argument("--json", action="store_true", help="print one JSON object and nothing else on stdout; asks nothing")
    command.set_defaults(command=setup)


def setup(options: argparse.Namespace) -> int:
    """Make the folder of a board, and print what is left to do."""
    asks = sys.stdin is not None and sys.stdin.isatty() and not options.json
    given = {name: _number(value) for name in FIELDS if (value := getattr(options, name)) is not None}
    missing = [f"--{name.replace('_', '-')}" for name, field in FIELDS.items() if field.required and name not in given]
    if missing and not asks:
        raise ConfigError(f"give {', '.join(missing)}: nothing is asked for where stdin is no terminal, or with --json")
    answers = _asked(given) if asks else as_record("", given, SetupAnswers)
    touch = _touch_keys(answers.touch, options.touch_key, asks=asks)
    board = write_board(options.folder, answers, touch)
    built = _build(board) if options.build else []
    show(
        options,
        {"board": board.name, "folder": str(board.folder), "built": built, "way": [step._asdict() for step in way(board)]},
        _table,
    )
    return 0


def _asked(given: dict[str, Any]) -> SetupAnswers:
    """All answers, those that were not given asked for one by one; each as soon as it is there is checked."""
    found, texts = dict(given), attributes(SetupAnswers)
    for name, field in FIELDS.items():
        while name not in found:
            kind = described(field.type, unit_of(name))
            answer = _ask(f"{texts[name].rstrip('.')} ({kind}{_default(field, '; Enter: ', '')})")
            if not answer and not field.required:
                break
            problem = _problem(name, _number(answer), found)
            if problem:
                tell(problem)
            else:
                found[name] = _number(answer)
    return as_record("", found, SetupAnswers)


def _problem(name: str, value: Any, found: dict[str, Any]) -> str:
    """Why an answer is none, beside those that were given so far; empty: it is one."""
    later = {other: POSSIBLE_MM for other, field in FIELDS.items() if field.required and other not in found}
    try:
        as_record("", {**later, **found, name: value}, SetupAnswers)
    except ConfigError as error:
        return str(error)
    return ""


def _touch_keys(kind: str, pairs: list[str], *, asks: bool) -> dict[str, Any]:
    """Keys of [touch] by KEY=VALUE, and those that this kind needs besides."""
    record = touch_record(kind)
    assert record is not None
    texts = attributes(record)
    words = {field.encode_name for field in structs_of(type_info(record))[0].fields if isinstance(field.type, StrType)}
    found: dict[str, Any] = {}
    for pair in pairs:
        key, equals, value = pair.partition("=")
        if not equals:
            raise ConfigError(f"--touch-key {pair}: give KEY=VALUE, such as bus=/dev/i2c-1")
        found[key] = value if key in words else _number(value)  # a line of a GPIO chip may be called "25"
    missing = [field for field in wanted_of(kind) if field.name not in found]
    if missing and not asks:
        raise ConfigError("; ".join(f"touch {kind} needs --touch-key {field.name}=…: {texts[field.name]}" for field in missing))
    for field in missing:
        answer = _ask(f"{texts[field.name].rstrip('.')} (touch.{field.name})")
        found[field.name] = answer if field.name in words else _number(answer)
    return found


def _ask(question: str) -> str:
    """What is typed at the terminal; its end, Ctrl-D, ends all questions."""
    try:
        return input(f"{question}: ").strip()
    except EOFError:
        raise ConfigError("the questions were not answered to their end: nothing is written") from None


def _build(board: Board) -> list[str]:
    """Build bitstream and bank by this program's own commands; the names of those that were built."""
    if not is_installed("workshop"):
        raise ConfigError(f"{board.folder} is written; --build: {NO_WORKSHOP}")
    built = []
    for name, arguments in (
        ("bitstream", ["gateware", "build", "--board", str(board.folder), "--out", str(board.folder / board.bitstream)]),
        ("bank", ["bank", "build", "--board", str(board.folder)]),
    ):
        if subprocess.run([sys.executable, "-m", "controller", *arguments], stdout=STDERR, check=False).returncode == 0:
            built.append(name)
        else:
            tell(f"the {name} was not built; later: haptic-panel {' '.join(arguments)}")
    return built


def _number(text: str) -> Any:
    """The value that a text is in TOML, if it is a number; else itself."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def _default(field: Field, before: str = " (default: ", after: str = ")") -> str:
    """What is taken where nothing is given, in brackets; empty: it must be given."""
    value = field.default
    return "" if field.required else f"{before}{f'{value:g}' if isinstance(value, float) else value}{after}"


def _table(figures: dict[str, Any]) -> str:
    lines = in_lines(WayStep(**step) for step in figures["way"])
    return "\n".join([f"{figures['folder']} is written, and checked. The rest of the way:", *lines])
