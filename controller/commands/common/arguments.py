"""The argument parser of the command line: a mistake is one line that names what was meant; help begins with an example."""

import argparse
import difflib
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Final, NoReturn

from controller.errors import UsageError

Declare = Callable[..., argparse.ArgumentParser]
"""Makes the parser of a command, by the arguments of `argparse.ArgumentParser`; `cli` has given name and help text."""

DECIMAL_COMMA: Final = re.compile(r"([+-]?\d*),(\d+)")
URL: Final = re.compile("[a-zA-Z][a-zA-Z0-9+.-]*://")
MOUNT_IT: Final = (
    "files are synced, renamed and mapped into memory, so mount it as a folder, or write to a disk and copy what is done"
)
MAX_MATCHED: Final = 60  # characters: difflib takes time that grows with their square


class Parser(argparse.ArgumentParser):
    """A parser that reports a mistake as a UsageError: one line, exit code 2.

    `example` is a command line, the first line of --help.
    """

    def __init__(self, *arguments: Any, example: str = "", **named: Any) -> None:
        super().__init__(*arguments, **named)
        self.example = example
        self.register("type", float, number)
        self.register("type", int, whole_number)

    def format_help(self) -> str:
        """Text of --help."""
        return f"example: {self.example}\n\n" * bool(self.example) + super().format_help()

    def error(self, message: str) -> NoReturn:
        """Raise a UsageError that also names the help of this command."""
        raise UsageError(f"{message.removeprefix('argument ')} ({self.prog} --help)")

    def parse_known_args(self, args: Sequence[str] | None = None, namespace: Any = None) -> Any:  # type: ignore[override]
        """As `argparse`, but without leftovers: only the parser of the subcommand knows which option was meant."""
        found, unknown = super().parse_known_args(args, namespace)
        if unknown:
            word = next((word for word in unknown if word.startswith("-")), unknown[0]).partition("=")[0]
            kind = "option" if word.startswith("-") else "argument"
            self.error(f"{word!r} is no {kind} of {self.prog}{meant(word, self._option_string_actions)}")
        return found, unknown

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is None or value in action.choices:
            return
        choices = [str(choice) for choice in action.choices]
        near = meant(str(value), choices) or f"; there are {', '.join(choices)}"
        if isinstance(action, argparse._SubParsersAction):
            raise argparse.ArgumentError(None, f"{value!r} is no {str(action.metavar).lower()}{near}")
        raise argparse.ArgumentError(action, f"{value!r} is not a choice{near}")

    def _get_values(self, action: argparse.Action, arg_strings: list[str]) -> Any:
        if "" in arg_strings and action.nargs != argparse.PARSER:  # that of a subcommand is its own parser's to report
            raise argparse.ArgumentError(action, "the value is empty")
        if action.dest == "out" and (urls := [text for text in arg_strings if URL.match(text)]):
            raise argparse.ArgumentError(action, f"{urls[0]!r} is a URL: {MOUNT_IT}")
        return super()._get_values(action, arg_strings)


def meant(word: str, known: Iterable[str]) -> str:
    """The nearest known word as the end of a message; empty if none is near."""
    near = difflib.get_close_matches(word, list(known), 1) if len(word) <= MAX_MATCHED else []
    return f"; did you mean {near[0]}?" if near else ""


def number(text: str) -> float:
    """Argument that is a finite number."""
    try:
        value = float(text)
    except ValueError:
        comma = DECIMAL_COMMA.fullmatch(text)
        instead = f": write {comma[1]}.{comma[2]}, with a decimal point instead of a comma" if comma else ""
        raise argparse.ArgumentTypeError(f"{text!r} is not a number{instead}") from None
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a finite number")
    return value


def whole_number(text: str) -> int:
    """Argument that is a whole number."""
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number") from None


def natural(text: str) -> int:
    """Argument that is a whole number from 0."""
    if not text.isascii() or not text.isdigit():
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0")
    return int(text)


def seconds(text: str) -> float:
    """Argument that is a time in s, above 0."""
    value = number(text)
    if not 0 < value < 1e9:
        raise argparse.ArgumentTypeError(f"{text!r} is not a time above 0 s")
    return value


def require_within(options: argparse.Namespace, ranges: Mapping[str, tuple[float, float]]) -> None:
    """Raise UsageError for an option whose number is outside of its range (least, most); one that was not given is None."""
    for name, (least, most) in ranges.items():
        value = getattr(options, name)
        if value is not None and not least <= value <= most:
            raise UsageError(f"--{name.replace('_', '-')} {value:g}: not from {least:g} to {most:g}")
