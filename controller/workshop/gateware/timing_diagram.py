"""Timing diagrams as in a data sheet, one picture for each table of fpga_rtl/timing (`controller.generate` draws them).

A picture contains the hash of its table, so that a test finds pictures that are out of date. Long intervals without a
change are cut out, and the traces are broken there.
"""

import re
import tempfile
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
from matplotlib.figure import Figure

from controller.device.fpga.frames import CRC, HEADER
from controller.device.fpga.registers import LOAD_PAYLOAD_MIN_BYTES, SHORT_PAYLOAD_BYTES
from controller.workshop.gateware.pin_timing import TRIGGER_HIGH_TICKS, frame_ticks
from controller.workshop.gateware.timing_table import IDLE, INPUTS, Case, Change, drive_words, load_cases

PINS: Final = {
    "frame": "SPI frame",
    "trigger": "trigger_i",
    "permit": "run_permit_i",
    "temperature": "temperature_ok_i",
    "channel": "channel_o[31:0]",
    "hv_enable": "hv_enable_o",
    "focus": "focus_o",
    "waiting": "waiting_o",
    "fault": "fault_o",
}
BUSES: Final = ("frame", "channel")
ALWAYS: Final = ("channel", "hv_enable", "focus")
HIGH_AT_FIRST: Final = ("permit", "temperature", "hv_enable")  # while armed

LONGEST_TICKS: Final = 14  # longer intervals without a change are cut
CUT: Final = 6.0  # to this width, in ticks
FRAME: Final = 15.0  # or to this one, in which the name of a frame has room
LEAD: Final = 4.0  # ticks shown before the first change and after the last
INCH: Final = 0.17  # width of a tick
LETTER: Final = 0.38  # width of a letter of 7.5 points, in ticks
ROW: Final = 1.0
HEIGHT: Final = 0.56
COLOURS: Final = {"in": "#1f4e79", "out": "#7a1f1f", "bus": "#f3efe6", "grid": "0.82"}
_DIGEST: Final = re.compile(r"table ([0-9a-f]{16})")


class TimeAxis:
    """Horizontal axis of a picture: position of each tick in drawn ticks; `cuts` are the positions of cut intervals."""

    def __init__(self, case: Case) -> None:
        frames = {change.tick: change.value for change in case.inputs if change.signal == "frame"}
        self.labels = sorted({change.tick for change in (*case.inputs, *case.outputs)} | {0})
        begins = {tick - length_ticks(text) for tick, text in frames.items()}
        ends = {change.tick + pulse_ticks(case, change) for change in (*case.inputs, *case.outputs)}
        self.ticks = sorted({*self.labels, *begins, *ends})
        self.cuts: list[float] = []
        self._at = {self.ticks[0]: LEAD}
        for before, tick in pairwise(self.ticks):
            gap = float(tick - before)
            if gap > LONGEST_TICKS:
                gap = max(FRAME, LETTER * len(frames[tick]) + 6) if tick in frames else CUT
                self.cuts.append(self._at[before] + (2.0 if tick in frames else 0.75 * gap))
            self._at[tick] = self._at[before] + gap
        self.end = self._at[self.ticks[-1]] + 2 * LEAD

    def at(self, tick: int) -> float:
        """Place of a tick of the table, or of one a little later."""
        known = max((other for other in self.ticks if other <= tick), default=self.ticks[0])
        return self._at[known] + tick - known


def pulse_ticks(case: Case, change: Change) -> int:
    """Length of a pulse in ticks; 0 if the change is a level."""
    if change.signal == "trigger":
        return int(change.value or TRIGGER_HIGH_TICKS)
    return int(case.bit_ticks) if change.signal == "focus" else 0


def length_ticks(text: str) -> int:
    """Ticks for which chip select is low during a frame, given as text (`LOAD 0x11*8`), at the highest SCK."""
    kind, *words = text.split()
    payload = max(4 * len(drive_words(" ".join(words))), LOAD_PAYLOAD_MIN_BYTES) if kind == "LOAD" else SHORT_PAYLOAD_BYTES
    return frame_ticks(HEADER.size + payload + CRC.size)


def draw(case: Case, path: Path) -> None:
    """Draw the table of a case to an SVG or PNG file."""
    axis = TimeAxis(case)
    changes = (*case.inputs, *case.outputs)
    signals = [signal for signal in PINS if signal in ALWAYS or any(change.signal == signal for change in changes)]
    width, height = axis.end * INCH + 1.75, ROW * len(signals) * 0.42 + 0.88
    with mpl.rc_context({"svg.hashsalt": case.name, "font.size": 8.5, "font.family": "DejaVu Sans"}):
        figure = Figure(figsize=(width, height))
        plot = figure.add_axes((1.5 / width, 0.45 / height, (axis.end * INCH) / width, (height - 0.80) / height))
        for row, signal in enumerate(reversed(signals)):
            base = row * ROW
            plot.text(-0.7, base + HEIGHT / 2, PINS[signal], ha="right", va="center", family="DejaVu Sans Mono", size=8)
            own = [change for change in changes if change.signal == signal]
            colour = COLOURS["in" if signal in INPUTS else "out"]
            if signal in BUSES:
                _bus(plot, axis, base, _stretches(case, axis, signal, own), colour)
            else:
                _level(plot, axis, base, _edges(case, axis, signal, own), colour)
        _time(plot, axis, len(signals) * ROW)
        plot.set(xlim=(0, axis.end), ylim=(-0.25, len(signals) * ROW))
        plot.axis("off")
        figure.text(0.12 / width, 1 - 0.12 / height, case.title, size=9.5, weight="bold", va="top")
        metadata = {"Description": f"table {case.digest}"}
        figure.savefig(path, dpi=150, metadata=metadata | ({"Date": None} if path.suffix == ".svg" else {}))


def picture_digest(path: Path) -> str | None:
    """Hash of the table from which an SVG file was drawn; None if the file is absent or contains none."""
    found = _DIGEST.search(path.read_text()) if path.exists() else None
    return found[1] if found else None


def _edges(case: Case, axis: TimeAxis, signal: str, own: Sequence[Change]) -> list[tuple[float, int]]:
    """(position, level from there on) of a pin."""
    armed = case.setup == "armed"
    edges = [(0.0, int(signal in HIGH_AT_FIRST and (armed or signal != "hv_enable")))]
    for change in own:
        lasts = pulse_ticks(case, change)
        edges.append((axis.at(change.tick), 1 if lasts else int(change.value)))
        if lasts:
            edges.append((axis.at(change.tick + lasts), 0))
    return edges


def _stretches(case: Case, axis: TimeAxis, signal: str, own: Sequence[Change]) -> list[tuple[float, float, str]]:
    """(begin, end, text) of each value of a bus, by position."""
    if signal == "frame":
        return [(axis.at(change.tick - length_ticks(change.value)), axis.at(change.tick), change.value) for change in own]
    first = IDLE if case.setup == "armed" else "0"
    begins = [(0.0, first), *((axis.at(change.tick), change.value) for change in own)]
    ends = [begin for begin, _ in begins[1:]] + [axis.end]
    return [(begin, end, value) for (begin, value), end in zip(begins, ends, strict=True)]


def _level(plot: Any, axis: TimeAxis, base: float, edges: list[tuple[float, int]], colour: str) -> None:
    places, levels = zip(*edges, (axis.end, edges[-1][1]), strict=True)
    plot.step(places, [base + HEIGHT * level for level in levels], where="post", color=colour, lw=1.2)


def _bus(plot: Any, axis: TimeAxis, base: float, stretches: list[tuple[float, float, str]], colour: str) -> None:
    middle = base + HEIGHT / 2
    plot.plot([0, axis.end], [middle, middle], color=colour, lw=1.0, zorder=1)
    for begin, end, text in stretches:
        left, right = begin or -1.0, end + (end == axis.end)  # what goes on beyond the picture has no end in it
        plot.broken_barh([(left, right - left)], (base, HEIGHT), facecolor=COLOURS["bus"], edgecolor=colour, lw=1.0, zorder=2)
        size = 7.5 * min(1.0, (end - begin - 0.7) / (LETTER * len(text)))
        box = {"facecolor": COLOURS["bus"], "edgecolor": "none", "pad": 0.3}
        plot.text((begin + end) / 2, middle, text, ha="center", va="center", size=size, zorder=6, bbox=box)


def _time(plot: Any, axis: TimeAxis, top: float) -> None:
    """Draw grid, tick labels and breaks; a label too close to the one before goes to a second line."""
    plot.vlines([axis.at(tick) for tick in axis.labels], -0.12, top - 0.3, color=COLOURS["grid"], lw=0.6, zorder=0)
    line_of_label, last = 0, -10.0
    for tick in axis.labels:
        place = axis.at(tick)
        line_of_label = 1 - line_of_label if place - last < 0.75 * len(str(tick)) + 0.6 else 0
        plot.text(place, -0.2 - 0.42 * line_of_label, str(tick), ha="center", va="top", size=7.5)
        last = place
    plot.text(-0.7, -0.2, "tick", ha="right", va="top", size=7.5, color="0.35")
    for place in axis.cuts:
        plot.axvspan(place - 0.3, place + 0.3, color="white", zorder=4)
        plot.vlines([place - 0.3, place + 0.3], -0.15, top - 0.3, color="0.45", lw=0.8, zorder=5)


def diagrams(folder: Path) -> dict[Path, str]:
    """Picture of every table of a folder; one that says that it is of its table is kept."""
    found = {}
    with tempfile.TemporaryDirectory() as drawn:
        for case in load_cases(folder):
            path, other = folder / f"{case.name}.svg", Path(drawn) / f"{case.name}.svg"
            if picture_digest(path) != case.digest:
                draw(case, other)
            found[path] = (other if other.exists() else path).read_text(encoding="utf-8")
    return found
