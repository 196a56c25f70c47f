"""What somebody does about what a command says of a panel: with a soldering iron (what is there) or an editor (board.toml)."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, NamedTuple

import msgspec

from controller.device.board.board import Board, load_board
from controller.workshop.simulation.wrong_panel import WrongPanel


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
    Remedy("another plate", "the glass is .* longer|its edges are not the plate's|frequencies are (.*) off", lambda *_: ""),
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
