"""What the reference stage and its supply (boards/stage) do, by ngspice, and whether the gateware's limits protect them.

    .venv/bin/python -m controller.workshop.benchmark.stage.power_stage  # the figures; exit 1 if one is beyond its limit
    .venv/bin/python -m controller.workshop.benchmark.stage.power_stage --wrong-parts  # which check finds which wrong part

`controller.generate` writes them into boards/stage/README.md. Each figure is the worst of the corners: thresholds of the
transistors and both supplies at the ends of what data sheets allow.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

from controller.console import program, say, tell
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.build_parameters import BuildParameters
from controller.workshop.benchmark.stage import stage_benches, supply_benches
from controller.workshop.benchmark.stage.stage_circuit import Measured, Parts, digest

BOARD: Final = "ulx3s"
BEGIN: Final = "<!-- figures of the netlists"
END: Final = "<!-- end of figures -->"
INPUT_LOW_V: Final = 0.8  # what every input of the 74AHCT family takes for low
Bench = Callable[[Board, Parts], Measured]
BENCHES: Final[dict[str, Bench]] = {
    "edges": stage_benches.edges,
    "faults": stage_benches.faults,
    "heat": stage_benches.heat,
    "all off": supply_benches.all_off,
    "start-up": supply_benches.start_up,
    "supply gone": supply_benches.supply_gone,
    "supply": supply_benches.supply,
}
# (what is wrong, parts, bench that finds it)
WRONG_PARTS: Final[tuple[tuple[str, dict[str, float], str], ...]] = (
    ("no dead time (R2 100 ohm)", {"low_gate_ohm": 100}, "edges"),
    ("gate resistor R2 ten times too large", {"low_gate_ohm": 39e3}, "edges"),
    ("series resistor 1 kohm", {"series_ohm": 1000}, "edges"),
    ("gate pull-up R5 ten times too large", {"gate_pull_up_ohm": 120e3}, "edges"),
    ("hold resistor R3 ten times too large", {"hold_ohm": 47e3}, "edges"),
    ("boost capacitor C2 ten times too large", {"boost_f": 2.2e-9}, "edges"),
    ("no leg resistors, no dead time", {"leg_ohm": 1, "low_gate_ohm": 100}, "faults"),
    ("no dead time, at a fault", {"low_gate_ohm": 100}, "faults"),
    ("series resistor 1 kohm, by its heat", {"series_ohm": 1000, "leg_ohm": 20}, "heat"),
    ("patch of 4 nF", {"patch_f": 4e-9}, "edges"),
    ("no pull-downs", {"pull_down_ohm": 1e9, "supply_pull_down_ohm": 1e9}, "start-up"),
    ("pull-downs of 10 kohm", {"pull_down_ohm": 10e3, "supply_pull_down_ohm": 10e3}, "start-up"),
    ("no gate pull-up R5", {"gate_pull_up_ohm": 1e9}, "start-up"),
    ("no resistor R9 across the patch", {"bleeder_ohm": 1e9}, "supply gone"),
    ("store C22 ten times too large", {"store_f": 1e-6}, "supply"),
    ("no resistor R23 across it", {"store_ohm": 1e9}, "supply"),
    ("bulk C24 ten times too large", {"bulk_f": 15e-6}, "supply"),
    ("no dead time, all channels together", {"low_gate_ohm": 100}, "all off"),
)  # fmt: skip


@dataclass(frozen=True)
class Figure:
    """One measured figure and its limit."""

    name: str  # what was measured
    value: float  # value, limit: in `unit`
    unit: str
    limit: float
    most: bool  # whether the limit is the most that the figure may be, or the least
    why: str  # where the limit comes from

    @property
    def good(self) -> bool:
        """Whether the figure is within its limit; a figure that could not be measured is not."""
        return bool(self.value <= self.limit if self.most else self.value >= self.limit)


def limits(board: Board) -> dict[str, tuple[str, float, bool, str]]:
    """Unit, limit, whether it is the most or the least, and its reason, for each figure by name."""
    shortest_us, rate_hz = board.limits.min_pulse_us, board.limits.max_channel_edge_rate_hz
    permitted_w = board.limits.resistor_rating_w * board.limits.derating
    settle_us = BuildParameters.of(board, 0).hv_settle_ticks / board.link.clock_hz * 1e6
    most, least = True, False
    return {
        "rise and fall of the stage, 10 to 90 %": ("ns", 500, most, "a quarter of a bit at 500 kHz"),
        "rise of the patch, 10 to 90 %, typical": ("us", 7, most, "the filter of board.toml: 6.4 us"),
        "patch against the driver of board.toml, typical": ("%", 2, most, "banks are computed with it"),
        "delay of the two edges apart": ("ns", 500, most, "a quarter of a bit"),
        "through both switches, at an edge": ("mA", 75, most, "what a ZVP3310F carries for good"),
        "charge through both switches, an edge": ("nC", 5, most, "16 mW at the edge limit"),
        "gate of the high side": ("V", 16, most, "20 V is its rating"),
        "held high, of the supply": ("%", 99, least, "half of the channels idle high for hours"),
        "through both switches, pulses of 4 to 512 ns": ("mA", 170, most, "what a BSS123 carries for good"),
        "charge through both, pulses of 4 to 512 ns": ("nC", 20, most, "1 uJ, once a fault"),
        "patch after a pulse of 16 ns": ("V", 6, most, "not felt, nothing latches"),
        "stage after the last pulse": ("V", 0.1, most, "low is 0 V"),
        "shortest pulse of board.toml, at the stage": ("us", shortest_us * 2 / 3, least, "two thirds of what went in"),
        "series resistor at the edge limit of a channel": ("W", permitted_w, most, "half of its 0.5 W for good"),
        "the same by the formula of `bank info --power`": ("W", permitted_w, most, "of R, L, C alone"),
        "edge limit that this resistor would bear": ("kHz", rate_hz * 1e-3, least, "max_channel_edge_rate_hz"),
        "hotter switch at the edge limit": ("mW", 165, most, "half of 0.33 W"),
        "level shifter of a channel that idles high": ("mW", 175, most, "half of an MMBT5551's 0.35 W"),
        "from the 60 V supply at the edge limit of all channels": ("W", 15, most, "60 V, 0.25 A"),
        "rail when 32 channels rise and fall together, most": ("V", 80, most, "100 V parts"),
        "through both switches then": ("mA", 75, most, "as at one edge"),
        "patches 50 us after": ("V", 1, most, "off is off"),
        "pins of an FPGA that is not configured": ("V", INPUT_LOW_V, most, "low for a 74AHCT"),
        "switched supply then": ("V", 1, most, "hv_enable off"),
        "stage then, were the switch shorted": ("V", 2, most, "the second protection alone"),
        "patch 10 ms after the 5 V are gone, channel high": ("V", 1, most, "both switches open, R9"),
        "patch 10 ms after the 60 V are gone, channel high": ("V", 1, most, "the rail follows its source"),
        "from hv_enable to 98 % of the supply": ("us", settle_us, most, "limits.hv_settle_us: the first edge comes then"),
        "from the last beat of hv_alive to an open switch": ("ms", 10, most, "it stops high or low, hv_enable still high"),
        "heat in the switch at switching on": ("mJ", 10, most, "a SOT-223 takes 10 mJ in 1 ms"),
    }


def measure(board: Board, parts: Parts | None = None, benches: Sequence[str] = tuple(BENCHES)) -> list[Figure]:
    """All figures of some benches.

    The figures are compared with the limits of `board`; `parts` take the place of those of the netlists, by the names of their
    parameters; `benches` are of `BENCHES`. Raises ControllerError if ngspice is missing or fails.
    """
    known = limits(board)
    measured = {name: value for bench in benches for name, value in BENCHES[bench](board, parts or {}).items()}
    return [Figure(name, value, *known[name]) for name, value in measured.items()]


def table(figures: Sequence[Figure]) -> str:
    """The figures as rows of a table in Markdown."""
    rows = []
    for figure in figures:
        value, limit = (f"{number:.{3 if abs(number) < 1000 else 4}g} {figure.unit}" for number in (figure.value, figure.limit))
        rows.append(f"| {figure.name} | {value} | {'at most' if figure.most else 'at least'} {limit} | {figure.why} |")
    return "\n".join(["| figure, worst corner | measured | limit | because |", "|---|---|---|---|", *rows])


def with_figures(readme: str) -> str:
    """The README's text with the figures of these netlists, which are measured again only where the netlists have changed."""
    head, _, rest = readme.partition(BEGIN)
    if rest.startswith(f" {digest()} -->"):
        return readme
    return f"{head}{BEGIN} {digest()} -->\n{table(measure(load_board(find_board(BOARD))))}\n{END}{rest.partition(END)[2]}"


@program
def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table, or what finds the wrong parts; 1 if a figure is beyond its limit, or a wrong part is not found."""
    parser = argparse.ArgumentParser(
        prog="python -m controller.workshop.benchmark.stage.power_stage", description=(__doc__ or "").partition("\n")[0]
    )
    parser.add_argument("--board", default=BOARD, help="whose limits and driver are taken (%(default)s)")
    parser.add_argument(
        "--wrong-parts", action="store_true", help="exchange parts, one after the other, and say which figure shows it"
    )
    options = parser.parse_args(arguments)
    board = load_board(find_board(options.board))
    if options.wrong_parts:
        missed = 0
        for what, parts, bench in WRONG_PARTS:
            bad = [
                f"{figure.name}: {figure.value:.3g} {figure.unit}" for figure in measure(board, parts, [bench]) if not figure.good
            ]
            missed += not bad
            say(f"{what}: {'; '.join(bad) or 'NOT FOUND'}")
        return int(missed > 0)
    figures = measure(board)
    say(table(figures))
    beyond = [figure for figure in figures if not figure.good]
    for figure in beyond:
        tell(f"beyond its limit: {figure.name}: {figure.value:.3g} {figure.unit}, {figure.limit:.3g} {figure.unit}")
    return int(bool(beyond))


if __name__ == "__main__":
    sys.exit(main())
