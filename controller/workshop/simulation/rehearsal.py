"""The way of a new panel on a simulated one that is wrong as real ones are: each step's command, what it finds, how that is mended.

Nothing is known here of what is wrong: the commands of the page "A panel of your own" are run as a person would run them, and what
they say is mended as they say, with a soldering iron (what is there) or an editor (board.toml).
"""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, NamedTuple

import msgspec

from controller.device.board.board import Board, load_board
from controller.device.fpga.bitstream import Identity, sealed
from controller.device.fpga.build_parameters import top_parameters
from controller.device.service.drivers import gateware_hash
from controller.errors import ControllerError
from controller.workshop.simulation.wrong_panel import WrongPanel

MOST_TRIES: Final = 4  # of a command, each after what was mended
GOOD_PERCENT: Final = 97  # of what the plate that is there can do, at the median of the fingers
TELLING: Final = re.compile(
    r"^(PASS|ok +(?:identity|bits)|points left out|bank: )|felt \d+ pulses|: loaded$|is written, and checked"
)
SETUP: Final = (
    *("--length-mm", "110", "--width-mm", "80", "--thickness-mm", "1.1", "--held", "free", "--discs", "5", "--fpga", "simulated"),
    *("--touch", "gt911", "--touch-key", "bus=/dev/i2c-1", "--touch-key", "interrupt_chip=pinctrl-bcm2711"),
    *("--touch-key", "interrupt_line=GPIO4"),
)
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


@dataclass
class Bench:
    """The simulated panel on the bench."""

    folder: Path  # of its board
    wrong: WrongPanel  # what still is
    tools: bool  # whether bitstreams are built: minutes; else they are nothing but their headers
    first: Board = field(init=False)  # as setup wrote it
    found: set[str] = field(default_factory=set)  # what was found wrong so far

    @property
    def board(self) -> Board:
        """The board as its board.toml says now."""
        return load_board(self.folder)

    def solder(self, **changes: Any) -> None:
        """Change what is there."""
        self.wrong = msgspec.structs.replace(self.wrong, **changes)
        (self.folder / self.first.link.device).write_text(self.wrong.text(self.first), encoding="utf-8")

    def edit(self, change: Callable[[str], str]) -> None:
        """Change board.toml."""
        file = self.folder / "board.toml"
        file.write_text(change(file.read_text(encoding="utf-8")), encoding="utf-8")

    def without_channels(self, channels: set[int]) -> None:
        """Take actuators out of board.toml."""
        there = "|".join(map(str, sorted(channels)))
        self.edit(lambda text: re.sub(rf"^ *\{{ channel = ({there}),.*\n", "", text, flags=re.MULTILINE))


class Remedy(NamedTuple):
    """What somebody does who reads a line like this."""

    fault: str  # what is then found
    line: str  # regular expression
    does: Callable[[Bench, list[re.Match[str]]], str]  # given all such lines; what was done, in words


def _wires_exchanged(bench: Bench, lines: list[re.Match[str]]) -> str:
    pairs = {frozenset((int(line[1]), int(line[2]))) for line in lines}
    bench.solder(swapped=tuple(pair for pair in bench.wrong.swapped if frozenset(pair) not in pairs))
    return "wires exchanged: " + ", ".join(" and ".join(map(str, sorted(pair))) for pair in pairs)


def _left_out(bench: Bench, lines: list[re.Match[str]]) -> str:
    channels = {int(number) for line in lines for number in re.findall(r"\d+", line[1])}
    bench.without_channels(channels)
    return f"no wire was loose: actuators {', '.join(map(str, sorted(channels)))} taken out of board.toml"


def _measured(bench: Bench, _: list[re.Match[str]]) -> str:
    driver, wrong = bench.first.driver, bench.wrong
    keys = {"resistance_ohm": driver.resistance_ohm * wrong.resistance, "capacitance_f": driver.capacitance_f * wrong.capacitance}
    there = "".join(f"{key} = {value:.4g}\n" for key, value in keys.items())
    bench.edit(lambda text: re.sub(r"^\[driver\]\n", f"[driver]\n{there}", text, flags=re.MULTILINE))
    return f"measured with an LCR meter, and written to [driver]: {there.replace(chr(10), ' ').strip()}"


def _soldered(bench: Bench, _: list[re.Match[str]]) -> str:
    bench.solder(dead_interrupt=False)
    return "its interrupt line soldered"


REMEDIES: Final = (
    Remedy("an empty FPGA", "only ones came back", lambda *_: "its bitstream is built and loaded"),
    Remedy("swapped wires", r"channels (\d+) and (\d+) (?:are|look) swapped", _wires_exchanged),
    Remedy("dead patches", r"(channel \d+): nothing was felt", _left_out),
    Remedy("dead patches", r"(channels? [\d, and]+) dead: ", _left_out),
    Remedy("a dead interrupt line", "touch panel: .* interrupt line no edge", _soldered),
    Remedy("another bitstream", "built with the limits of another board", lambda *_: "built and loaded again"),
    Remedy("other stages", "the stages' R C is .* off board.toml's", _measured),
    Remedy("a frame that is off", "points lie elsewhere than stated, corrected: (.*)", lambda *_: ""),
    Remedy("another plate", "its edges are not the plate's|frequencies are (.*) off", lambda *_: ""),
)
BUILT: Final = {"an empty FPGA", "another bitstream"}  # after these the bitstream is built and loaded


def faults_of(wrong: WrongPanel) -> set[str]:
    """What has to be found."""
    return {
        name
        for name, there in {
            "an empty FPGA": wrong.empty_fpga,
            "swapped wires": wrong.swapped,
            "dead patches": wrong.dead,
            "a dead interrupt line": wrong.dead_interrupt,
            "other stages": (wrong.resistance, wrong.capacitance) != (1.0, 1.0),
            "a frame that is off": wrong.frame != type(wrong.frame)(),
            "another plate": wrong.longer_mm or wrong.wider_mm or wrong.plate,
        }.items()
        if there
    }


def rehearse(bench: Bench) -> Iterator[Done]:
    """Go the way with a folder that does not exist yet, one command after another.

    Raises RehearsalError if a command does not end as it should, or something that is wrong was not found.
    """
    wanted = faults_of(bench.wrong)
    folder, board = str(bench.folder), ("--board", str(bench.folder))
    points, records, taps = (str(bench.folder / name) for name in ("points.csv", "measured", "taps.evemu"))
    yield from _step(bench, "setup", folder, *SETUP)
    bench.first = bench.board
    bench.solder()
    yield from _step(bench, "board", "check", folder)
    yield from _step(bench, "doctor", "--link", *board)
    yield from _step(bench, "bank", "build", *board)
    yield from _step(bench, "doctor", "--link", *board)
    yield from _step(bench, "calibrate", "channels", *board)
    yield from _step(bench, "bank", "build", *board)
    yield from _step(bench, "calibrate", "plan", *board, "--out", points)
    measure = ("--points", points, "--repetitions", "1", "--noise", "1e-4", "--yes")
    yield from _step(bench, "calibrate", "measure", records, *board, *measure)
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


def _step(bench: Bench, *arguments: str) -> Iterator[Done]:
    """Run a command, mend what it says, and run it again until it says nothing more."""
    for _ in range(MOST_TRIES):
        done = _called(*arguments)
        matched = {remedy: [found for line in done.said if (found := re.search(remedy.line, line))] for remedy in REMEDIES}
        matched = {remedy: lines for remedy, lines in matched.items() if lines}
        mended = [did for remedy, lines in matched.items() if (did := remedy.does(bench, lines))]
        bench.found |= {remedy.fault for remedy in matched}
        yield done._replace(said=_telling(done, matched), mended=mended)
        if BUILT & {remedy.fault for remedy in matched}:
            yield from _built(bench)
            if "doctor" in arguments:
                return  # it is called again once the bank is there
        if not mended:
            break
    if done.code:
        raise RehearsalError(f"{done.command}: exit code {done.code}: {done.said[-1]}")


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
