"""The way of a new panel on a simulated one that is wrong as real ones are: each step's command, what it finds, how that is mended.

Nothing is known here of what is wrong: the commands of the page "A panel of your own" are run as a person would run them, and what
they say is mended as they say, with a soldering iron (what is there) or an editor (board.toml).
"""

import re
import shlex
import subprocess
import sys
from collections.abc import Generator, Iterator
from typing import Final, NamedTuple

from controller.device.board.board import Board
from controller.device.fpga.bitstreams.bitstream import Identity, sealed
from controller.device.fpga.build_parameters import top_parameters
from controller.device.service.drivers import gateware_hash
from controller.errors import ControllerError
from controller.workshop.simulation.remedies import BUILT, REMEDIES, Bench, Remedy, faults_of

MOST_TRIES: Final = 4  # of a command, each after what was mended
GOOD_PERCENT: Final = 97  # of what the plate that is there can do, at the median of the fingers
TELLING: Final = re.compile(
    r"^(PASS|ok +(?:identity|bits)|points left out|bank: )|felt \d+ pulses|: loaded$|^residual: |is written, and checked"
)
SETUP: Final = (
    *("--length-mm", "110", "--width-mm", "80", "--thickness-mm", "1.1", "--held", "free", "--discs", "5", "--fpga", "simulated"),
    *("--touch", "gt911", "--touch-key", "bus=/dev/i2c-1", "--touch-key", "interrupt_chip=pinctrl-bcm2711"),
    *("--touch-key", "interrupt_line=GPIO4"),
)
SENSOR: Final = "--repetitions", "1", "--noise", "1e-4", "--yes"  # noise in m/s: 40 dB
UNDECIDED: Final = 75  # exit code of `calibrate wiring`: the points do not tell
TAPS: Final = tuple((0.2 + 0.1 * number, 0.25 + 0.08 * (number * 4 % 7)) for number in range(7))  # shares of length and width
TAP_S: Final = 0.1
TAPS_APART_S: Final = 0.3


class RehearsalError(ControllerError):
    """A command did not end as the page says."""


class Done(NamedTuple):
    """A command that ended."""

    command: str
    code: int
    said: list[str]  # lines that matter
    mended: list[str]  # what was then done


def rehearse(bench: Bench) -> Iterator[Done]:
    """Go the way with a folder that does not exist yet, one command after another.

    Raises RehearsalError if a command does not end as it should, or something that is wrong was not found.
    """
    wanted = faults_of(bench.wrong)
    folder, board = str(bench.folder), ("--board", str(bench.folder))
    points, taps = (str(bench.folder / name) for name in ("points.csv", "taps.evemu"))
    yield from _step(bench, "setup", folder, *SETUP)
    bench.first = bench.board
    bench.solder()
    yield from _step(bench, "board", "check", folder)
    yield from _called_and_mended(bench, "doctor", "--link", *board)  # the bank is not there yet, for one
    yield from _step(bench, "bank", "build", *board)
    yield from _step(bench, "doctor", "--link", *board)
    yield from _step(bench, "calibrate-touch", *board, "--write")
    yield from _step(bench, "calibrate", "channels", *board)
    yield from _step(bench, "bank", "build", *board)
    yield from _step(bench, "calibrate", "plan", *board, "--out", points)
    records = yield from _measured(bench, points)
    yield from _step(bench, "calibrate", "check", records, *board)
    yield from _step(bench, "calibrate", "bank", records, *board, "--model")
    (bench.folder / "taps.evemu").write_text(taps_on(bench.board), encoding="utf-8")
    *_, felt = played = list(_step(bench, "run", *board, "--replay", taps, "--speed", "max"))
    yield from played
    share = re.search(r"felt \d+ pulses: (\d+) % of what this panel can do", felt.said[0])
    if share is None or int(share[1]) < GOOD_PERCENT:
        raise RehearsalError(f"a finger does not feel {GOOD_PERCENT} % of what this panel can do: {felt.said[0]}")
    if missed := wanted - bench.found:
        raise RehearsalError(f"nothing has named {', '.join(sorted(missed))}")


def _measured(bench: Bench, points: str) -> Generator[Done, None, str]:
    """The folder of a measurement whose wires are right, or undecided; another one once they were mended."""
    board = "--board", str(bench.folder)
    for number in range(MOST_TRIES):
        records = str(bench.folder / f"measured{number or ''}")
        yield from _step(bench, "calibrate", "measure", records, *board, "--points", points, *SENSOR)
        done = yield from _called_and_mended(bench, "calibrate", "wiring", records, *board)
        if done.code in (0, UNDECIDED):
            return records
        if not done.mended:
            break
    raise RehearsalError(f"{done.command}: exit code {done.code}: {done.said[-1]}")


def _step(bench: Bench, *arguments: str) -> Iterator[Done]:
    """Run a command, mend what it says, and run it again until it says nothing more."""
    for _ in range(MOST_TRIES):
        done = yield from _called_and_mended(bench, *arguments)
        if not done.mended:
            break
    if done.code:
        raise RehearsalError(f"{done.command}: exit code {done.code}: {done.said[-1]}")


def _called_and_mended(bench: Bench, *arguments: str) -> Generator[Done, None, Done]:
    """Run a command, and mend what it says."""
    done = _called(*arguments)
    matched = {remedy: [found for line in done.said if (found := re.search(remedy.line, line))] for remedy in REMEDIES}
    matched = {remedy: lines for remedy, lines in matched.items() if lines}
    mended = [did for remedy, lines in matched.items() if (did := remedy.does(bench, lines))]
    bench.found |= {remedy.fault for remedy in matched}
    done = done._replace(said=_telling(done, matched), mended=mended)
    yield done
    if BUILT & {remedy.fault for remedy in matched}:
        yield from _built(bench)
    return done


def _telling(done: Done, matched: dict[Remedy, list[re.Match[str]]]) -> list[str]:
    """Lines that something was done about, and those that say what was reached; else the last one."""
    lines = [found.string for lines in matched.values() for found in lines]
    return [*lines, *filter(TELLING.search, done.said)] or done.said[-1:]


def _built(bench: Bench) -> Iterator[Done]:
    """Build the bitstream and load it."""
    board = bench.board
    out = bench.folder / board.bitstream
    if bench.tools:
        yield from _step(bench, "gateware", "build", "--board", str(bench.folder), "--out", str(out))
    else:
        out.write_bytes(header_alone(board))
    yield from _step(bench, "gateware", "load", "--board", str(bench.folder), "--flash")


def header_alone(board: Board) -> bytes:
    """A bitstream of a board without any logic: its header is all that the simulated FPGA reads."""
    parameters = top_parameters(board, gateware_hash())
    identity = Identity(board=board.name, top="", device="simulated", seed=0, parameters=parameters, sources="", tools={})
    return sealed(b"\xff\x00" + identity.comment().encode() + b"\0\xff")


def taps_on(board: Board) -> str:
    """A recording of one finger that taps one place after another."""
    plate = board.plate
    lines = ["A: 2f 0 9 0 0 0", f"A: 35 0 {round(10 * plate.length_mm)} 0 0 0", f"A: 36 0 {round(10 * plate.width_mm)} 0 0 0"]
    lines.append("A: 39 0 65535 0 0 0")
    for number, (along, across) in enumerate(TAPS):
        down_s = TAPS_APART_S * number
        place = (0x35, 10 * along * plate.length_mm), (0x36, 10 * across * plate.width_mm)
        for at_s, events in ((down_s, ((0x39, number), *place)), (down_s + TAP_S, ((0x39, -1),))):
            lines += [f"E: {at_s:.6f} 0003 {code:04x} {round(value):04d}" for code, value in ((0x2F, 0), *events)]
            lines.append(f"E: {at_s:.6f} 0000 0000 0000")
    return "\n".join([*lines, ""])


def _called(*arguments: str) -> Done:
    """A command of this program, as another process."""
    ended = subprocess.run(
        [sys.executable, "-m", "controller", *arguments], capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False
    )
    said = [line for text in (ended.stderr, ended.stdout) for line in text.splitlines() if line.strip()]
    if "Traceback" in ended.stderr:
        raise RehearsalError(f"haptic-panel {shlex.join(arguments)}: a traceback:\n{ended.stderr}")
    return Done(f"haptic-panel {shlex.join(arguments)}", ended.returncode, said or [""], [])
