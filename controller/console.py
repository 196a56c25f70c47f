"""Output of commands: results on standard output, messages on standard error; in any locale, and with either full or closed.

All that is printed goes through `say` and `tell`, and each program's `main` is a `program`.
"""

from __future__ import annotations

import codecs
import contextlib
import io
import os
import sys
import unicodedata
from collections.abc import Callable
from functools import wraps
from typing import Any, Final, ParamSpec, TextIO

from controller.errors import ControllerError
from controller.log import Priority, line

SIMILAR: Final = {  # what an encoding may lack, by what is printed in its place
    "µ": "u", "μ": "u", "λ": "lambda", "Ω": "ohm", "τ": "tau", "×": "x", "·": "*", "°": "deg", "–": "-", "—": "-", "−": "-",
    "→": "->", "≤": "<=", "≥": ">=", "±": "+-", "…": "...", "‘": "'", "’": "'", "“": '"', "”": '"', "√": "sqrt",
}  # fmt: skip
Arguments = ParamSpec("Arguments")
INTERRUPTED: Final = 130  # exit code of a program that Ctrl-C ended


class OutputError(ControllerError):
    """Standard output takes nothing more."""


class ReaderGone(OutputError):
    """Nobody reads standard output any more, which is no news to its reader: the message is empty."""


def say(text: str, end: str = "\n") -> None:
    """Print a result on standard output; raises OutputError if it is full, or nobody reads it."""
    _write(text + end)


def tell(message: str, priority: Priority = Priority.INFO) -> None:
    """Print a message as one line on standard error; it is lost where that is full or closed."""
    try:
        sys.stderr.write(line(message, priority) + "\n")
        sys.stderr.flush()
    except (AttributeError, ValueError, OSError):  # none, closed, full
        _abandon(sys.stderr)


def flush() -> None:
    """Hand over what was said; raises OutputError if standard output is full, or nobody reads it."""
    _write("")


def is_unicode() -> bool:
    """Whether standard output has every character."""
    return codecs.lookup(getattr(sys.stdout, "encoding", None) or "utf-8").name.startswith("utf")


def program(main: Callable[Arguments, int]) -> Callable[Arguments, int]:
    """Decorate the `main` of a program, which returns its exit code: errors become one line and a code, and what was said is out.

    A SystemExit stays one: argparse raises it after a mistake and after its help.
    """

    @wraps(main)
    def ended(*arguments: Arguments.args, **named: Arguments.kwargs) -> int:
        return _exit_code(lambda: main(*arguments, **named))

    return ended


def _exit_code(command: Callable[[], int]) -> int:
    _replace_what_is_lacking()
    ended: SystemExit | None = None
    code = 0
    try:
        try:
            code = command()
        except SystemExit as end:
            ended = end
        flush()
    except ControllerError as error:
        if str(error):
            tell(str(error), Priority.ERROR)
        code, ended = error.exit_code, None
    except OSError as error:
        tell(str(error), Priority.ERROR)
        code = 1
    except MemoryError:
        tell("not enough memory for what was asked", Priority.ERROR)
        code = 1
    except KeyboardInterrupt:
        tell("interrupted", Priority.ERROR)
        code = INTERRUPTED
    with contextlib.suppress(OutputError):  # of an error; it has been reported
        flush()
    if ended is not None:
        raise ended
    return code


def _write(text: str) -> None:
    if sys.stdout is None:  # it was closed when the program began
        return
    try:
        sys.stdout.write(text)
        if not text or sys.stdout.isatty():
            sys.stdout.flush()
    except BrokenPipeError as error:
        _abandon(sys.stdout)
        raise ReaderGone from error
    except (OSError, ValueError) as error:
        _abandon(sys.stdout)
        why = error.strerror if isinstance(error, OSError) else "it is closed"
        raise OutputError(f"the output cannot be written ({why})") from error


def _abandon(stream: TextIO | None) -> None:
    """Let a stream lead nowhere: what it still holds would fail again when Python ends, and change the exit code to 120."""
    with contextlib.suppress(AttributeError, ValueError, OSError):
        fd = stream.fileno()  # type: ignore[union-attr]
        null = os.open(os.devnull, os.O_WRONLY | os.O_CLOEXEC)
        os.dup2(null, fd)
        os.close(null)
        stream.flush()  # type: ignore[union-attr]


def _replace_what_is_lacking() -> None:
    """Have both streams print something similar where their encoding lacks a character."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="haptic_panel.similar")


def _similar(error: UnicodeError) -> tuple[str, int]:
    assert isinstance(error, UnicodeEncodeError)
    lacking = error.object[error.start : error.end]
    return "".join(map(_in_ascii, lacking)), error.end


def _in_ascii(character: str) -> str:
    code = ord(character)
    if 0xDC80 <= code <= 0xDCFF:  # a byte of a file name that is no text
        return f"\\x{code & 0xFF:02x}"
    plain = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return SIMILAR.get(character) or plain or "?"


_handler: Any = _similar
codecs.register_error("haptic_panel.similar", _handler)
