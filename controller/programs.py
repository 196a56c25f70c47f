"""Programs of others: run with a time limit, ended with all they started, reported by how they ended and what they said last."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import BinaryIO, Final, NamedTuple

from controller.errors import ControllerError

SAID_BYTES: Final = 4096  # of what a program said, its end
SAID_CHARACTERS: Final = 160  # of its last line
ENDS_S: Final = 1.0  # that a killed program may need: a driver that hangs keeps it longer
SHOWN_EVERY_S: Final = 0.1
PERMANENT: Final = (FileNotFoundError, PermissionError, NotADirectoryError)  # of a start: the next would fail likewise


class ProgramError(ControllerError):
    """A program failed, did not end in time, or cannot be started; the message names it and has its last line."""

    def __init__(self, message: str, code: int | None = None, said: str = "") -> None:
        super().__init__(message)
        self.code = code  # its exit code; negative: the signal that ended it; None: it did not end by itself, or was not started
        self.said = said  # all that it wrote, its messages first


class CannotStart(ProgramError):
    """It is missing or not permitted: another try would not help."""

    exit_code = 78


class Output(NamedTuple):
    """What a program wrote, as text."""

    out: str
    err: str


def run_program(
    command: Sequence[str | Path],
    limit_s: float,  # time after which it is ended, with all that it started
    *,
    # How often it is run at most: more than once where a bus, a network or a machine short of memory may fail for a moment
    attempts: int = 1,
    package: str = "",  # debian's package of it, named where it is missing
    cwd: Path | None = None,
    environment: Mapping[str, str] | None = None,  # instead of this process's
    good: Collection[int] = (0,),  # exit codes that are no failure
    shown: bool = False,  # repeat on standard error what it writes, while it writes it
) -> Output:
    """Run a program of others, without standard input, until it succeeds.

    Raises CannotStart if it is missing or may not be run; ProgramError if the last attempt fails: how it ended, and its last line.
    """
    words = [os.fspath(word) for word in command]
    for left in reversed(range(attempts)):
        try:
            return _run(words, limit_s, package, cwd, environment, good, shown=shown)
        except CannotStart:
            raise
        except ProgramError as error:
            if not left:
                many = f" ({attempts} attempts)" if attempts > 1 else ""
                raise ProgramError(f"{error}{many}", error.code, error.said) from error
    raise AssertionError("at least one attempt")


def start(
    words: Sequence[str],
    out: int,
    err: int,
    *,
    package: str = "",
    cwd: Path | None = None,
    environment: Mapping[str, str] | None = None,
) -> subprocess.Popen[bytes]:
    """Start a program in a session of its own, which `end` ends; its output goes to two open files.

    Raises CannotStart if it is missing or may not be run; ProgramError if it cannot be started now.
    """
    try:
        return subprocess.Popen(
            words, stdin=subprocess.DEVNULL, stdout=out, stderr=err, cwd=cwd, env=environment, start_new_session=True
        )
    except PERMANENT as error:
        if package and isinstance(error, FileNotFoundError):
            raise CannotStart(f"{words[0]} is not installed: apt-get install {package}") from error
        raise CannotStart(f"{words[0]} cannot be started ({error.strerror})") from error
    except OSError as error:
        raise ProgramError(f"{words[0]} cannot be started ({error.strerror})") from error


def end(process: subprocess.Popen[bytes]) -> None:
    """End a program and all that it started."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(ENDS_S)


def repeat(out: BinaryIO, shown: int) -> int:
    """Repeat on standard error what a program has written into a file after its first `shown` bytes; how many bytes that is."""
    new = os.pread(out.fileno(), 1 << 20, shown)
    with contextlib.suppress(OSError):  # full or closed
        os.write(sys.__stderr__.fileno() if sys.__stderr__ else 2, new)
    return len(new)


def how_it_ended(name: str, code: int, said: str) -> str:
    """Sentence on a program that failed, by its exit code (negative: a signal) and what it said."""
    ended = f"was ended by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code}"
    return f"{name} {ended}{': ' * bool(said)}{said}"


def last_line(said: str) -> str:
    """The last line of a program's output that has any text, short enough for a message."""
    lines = [line.strip() for line in said[-SAID_BYTES:].splitlines() if line.strip()]
    return "".join(filter(str.isprintable, lines[-1]))[-SAID_CHARACTERS:] if lines else ""


def _run(
    words: Sequence[str],
    limit_s: float,
    package: str,
    cwd: Path | None,
    environment: Mapping[str, str] | None,
    good: Collection[int],
    *,
    shown: bool,
) -> Output:
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:  # a pipe is held open by what a program leaves behind
        merged = out if shown else err
        process = start(words, out.fileno(), merged.fileno(), package=package, cwd=cwd, environment=environment)
        try:
            code = _shown_until_it_ends(process, out, limit_s) if shown else process.wait(limit_s)
        except subprocess.TimeoutExpired:
            end(process)
            code = None
        except BaseException:
            end(process)
            raise
        output = Output(_written(out), _written(err))
    if code in good:
        return output
    said = last_line(output.err) or last_line(output.out)
    if code is None:
        raise ProgramError(f"{words[0]} did not end within {limit_s:g} s{': ' * bool(said)}{said}", None, output.err + output.out)
    raise ProgramError(how_it_ended(words[0], code, said), code, output.err + output.out)


def _shown_until_it_ends(process: subprocess.Popen[bytes], out: BinaryIO, limit_s: float) -> int:
    end_s, shown = time.monotonic() + limit_s, 0
    while True:
        try:
            code = process.wait(SHOWN_EVERY_S)
        except subprocess.TimeoutExpired:
            code = None
        shown += repeat(out, shown)
        if code is not None:
            return code
        if time.monotonic() >= end_s:
            raise subprocess.TimeoutExpired(process.args, limit_s)


def _written(file: BinaryIO) -> str:
    return os.pread(file.fileno(), os.fstat(file.fileno()).st_size, 0).decode(errors="replace")
