"""Work-precision diagrams: one curve for each method, one point for each setting, the Pareto front behind them.

They are read without colour: each curve has a letter beside it, a marker and a line style, and its name in the key.
"""

from __future__ import annotations

import string
from collections.abc import Callable
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from controller.errors import ConfigError
from controller.workshop.benchmark.pareto import pareto_front
from controller.workshop.benchmark.work_precision import cost, main_error

Figures = dict[str, Any]
SUFFIXES = (".png", ".svg")
FLOOR = 1e-4  # errors below, and below zero, are drawn here
MARKERS = "osD^v<>pPX*hd8H"
LINES = ("-", "--", "-.", ":")
FRONT: dict[str, Any] = {"color": "0.8", "lw": 6, "solid_capstyle": "round", "zorder": 0}
FRONT_PAGE_TIME = (
    "nearest entry",
    "resident waveform",
    "device, compiled kernel",
    "device, NumPy twin",
    "packed words, bilinear vote",
    "baseband, 8 bits, bilinear",
    "modal bank, baseband",
    "full field, float64",
)
FRONT_PAGE_MEMORY = (
    "nearest entry",
    "device, compiled kernel",
    "baseband, 8 bits, band 4 × 4",
    "modal bank, baseband",
)
SHOWN_FINGERS = ("1", "2", "4", "10")
TIME, MEMORY = "time of composing, processor (µs)", "memory for the whole plate (MB)"
WIRE, HEAT = "bytes on the wire for an emission", "heat in the stages for an emission (mJ)"
LOST = "amplitude lost by the worst finger: 1 − A / bound"


def draw_all(folder: Path, figures: Figures) -> list[Path]:
    """Draw every diagram as PNG and SVG into a folder that is there; returns the files written.

    Raises ConfigError if one cannot be written.
    """
    timed = any(setting["time_us"] for setting in figures["settings"])
    written = []
    for name, draw in DIAGRAMS.items():
        if name in TIMED and not timed:
            continue
        figure = draw(figures)
        for suffix in SUFFIXES:
            path = folder / f"{name}{suffix}"
            try:
                figure.savefig(path, dpi=110)
            except OSError as error:
                raise ConfigError(f"{path}: the picture cannot be written ({error})") from error
            written.append(path)
    return written


def time_diagram(figures: Figures) -> Figure:
    """Error against time, for 1, 2, 4 and 10 fingers."""
    figure = Figure(figsize=(14, 11), layout="constrained")
    shown = [count for count in SHOWN_FINGERS if f"{count} off grid" in figures["scenes"]]
    for count, ax in zip(shown, figure.subplots(2, 2).flat, strict=False):
        family = f"{count} off grid"
        _curves(ax, figures, _cost("time", family), _main(family))
        _marks(ax, figures, int(count))
        ax.set(xlabel=TIME, ylabel=LOST, title=f"{count} finger{'s' * (count != '1')} between cells")
    _key(figure, figures)
    return figure


def front_page_diagram(figures: Figures) -> Figure:
    """One finger: error against time and against memory, of some methods that are named beside their curves."""
    figure = Figure(figsize=(12, 5.6), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    family = "1 off grid"
    for ax, curves, x_of, label in (
        (left, FRONT_PAGE_TIME, _cost("time", family), TIME),
        (right, FRONT_PAGE_MEMORY, _cost("memory", "", 1e-6), MEMORY),
    ):
        shown = {**figures, "settings": [setting for setting in figures["settings"] if setting["curve"] in curves]}
        _curves(ax, shown, x_of, _main(family), named=True)
        ax.set(xlabel=label, ylim=(0.6 * FLOOR, 10))
    left.set(ylabel=LOST)
    _marks(left, figures, 1)
    for ax in (left, right):
        low, high = ax.get_xlim()
        ax.set_xlim(low / 1.5, high * 4)  # room for the names
    figure.suptitle(_reported(figures), fontsize=8)
    return figure


def memory_diagram(figures: Figures) -> Figure:
    """Error against memory, for 1 and 4 fingers."""
    figure = Figure(figsize=(14, 6.5), layout="constrained")
    for count, ax in zip(("1", "4"), figure.subplots(1, 2), strict=True):
        _curves(ax, figures, _cost("memory", "", 1e-6), _main(f"{count} off grid"))
        ax.set(xlabel=MEMORY, ylabel=LOST, title=f"{count} finger{'s' * (count != '1')} between cells")
    _key(figure, figures)
    return figure


def wire_and_heat_diagram(figures: Figures) -> Figure:
    """Error against bytes on the wire and against heat in the stages."""
    figure = Figure(figsize=(14, 6.5), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    family = "1 off grid"
    _curves(left, figures, _cost("wire", ""), _main(family))
    left.set(xlabel=WIRE, ylabel=LOST, title="1 finger between cells")
    heat = _median(family, "stage_j", 1e3)
    _curves(right, figures, heat, _main(family))
    right.set(xlabel=HEAT, title="1 finger between cells")
    _key(figure, figures)
    return figure


def errors_diagram(figures: Figures) -> Figure:
    """Every error against time, for one finger, and the worst finger of random scenes."""
    figure = Figure(figsize=(17, 11), layout="constrained")
    family = "1 off grid"
    panels = [
        ("1 − A / A_ref", _median(family, "loss")),
        ("largest |u| at another finger within 25 µs of T, over A", _median(family, "quiet")),
        ("1 / contrast (rms outside 10 mm over A)", _inverse_contrast),
        ("energy below 16 kHz ((m/s)² s)", _median(family, "audible_m2_per_s")),
        ("distance of the crest (mm)", _median(family, "crest_m", 1e3)),
        ("1 − A / A_ref at +0.5 % drift", _median("1 at +0.5 % drift", "loss")),
    ]
    for (label, error), ax in zip(panels, figure.subplots(2, 3).flat, strict=True):
        floor = 1e-12 if "energy" in label else FLOOR
        _curves(ax, figures, _cost("time", family), error, floor)
        ax.set(xlabel=TIME, ylabel=label)
    _key(figure, figures)
    return figure


def scenes_diagram(figures: Figures) -> Figure:
    """Median and worst loss of the finest setting of each curve, by family of scenes."""
    families = [family for family in figures["scenes"] if family != "idle"]
    finest: dict[str, Figures] = {}
    for setting in figures["settings"]:
        best = finest.get(setting["curve"])
        if best is None or _typical(setting) < _typical(best):
            finest[setting["curve"]] = setting
    letters = _letters(figures)
    order = {curve: index for index, curve in enumerate(letters)}
    figure = Figure(figsize=(13, 0.75 * len(families) + 3), layout="constrained")
    ax = figure.subplots()
    for row, family in enumerate(families):
        for place, (curve, setting) in enumerate(finest.items()):
            found = setting["families"].get(family)
            if found is None:
                continue
            y = row + 0.35 - 0.7 * place / max(len(finest) - 1, 1)
            median, worst = (max(found[main_error(family)][kind], FLOOR) for kind in ("median", "worst"))
            ax.plot([median, worst], [y, y], color="0.6", lw=0.8, zorder=1)
            ax.plot(median, y, **{**_style(order[curve]), "ms": 4, "ls": ""}, zorder=2)
            ax.annotate(letters[curve], (worst, y), xytext=(3, 0), textcoords="offset points", va="center", fontsize=5.5)
        ax.axhline(row + 0.5, color="0.85", lw=0.6)
    ax.set_yticks(range(len(families)), families)
    ax.invert_yaxis()
    ax.set(
        xscale="log",
        xlabel=f"{LOST}; marker: median, end of the line: worst scene; best setting of each method",
    )
    _key(figure, figures)
    return figure


def building_diagram(figures: Figures) -> Figure:
    """Loss against the time of building a bank's responses."""
    of_pitch = {
        setting["setting"]: setting["families"]["1 off grid"]["bound_loss"]["median"]
        for setting in figures["settings"]
        if setting["curve"] == "8 bits, bilinear"
    }
    figure = Figure(figsize=(8.5, 6), layout="constrained")
    ax = figure.subplots()
    for index, curve in enumerate(dict.fromkeys(row["curve"] for row in figures["building"])):
        points = []
        for row in figures["building"]:
            loss = of_pitch.get(row["setting"]) if row["loss"] is None else row["loss"]
            if row["curve"] == curve and loss is not None:
                points.append((row["seconds"], max(loss, FLOOR), row["setting"]))
        ax.plot([x for x, _, _ in points], [y for _, y, _ in points], **_style(index), label=curve)
        for x, y, label in points:
            ax.annotate(label, (x, y), xytext=(5, 3), textcoords="offset points", fontsize=6)
    ax.set(xscale="log", yscale="log", xlabel="processor time of the responses of the whole grid (s)", ylabel=LOST)
    ax.set_title("1 finger; modes and precision at its very place, pitch between cells (8 bits, bilinear)", fontsize=9)
    ax.grid(which="major", color="0.9", lw=0.6)
    ax.legend(fontsize=8)
    return figure


def _typical(setting: Figures) -> float:
    found = setting["families"].get("1 off grid")
    return float(found["bound_loss"]["median"]) if found else float("inf")


def _cost(axis: str, family: str, factor: float = 1.0) -> Callable[[Figures], float | None]:
    """A cost of a setting; None if it was not measured."""

    def found(setting: Figures) -> float | None:
        value = cost(setting, axis, family)
        return None if value is None else factor * value

    return found


def _main(family: str) -> Callable[[Figures], float | None]:
    return _median(family, main_error(family))


def _inverse_contrast(setting: Figures) -> float | None:
    contrast = _median("1 off grid", "contrast")(setting)
    return 1 / contrast if contrast else None


def _median(family: str, error: str, factor: float = 1.0) -> Callable[[Figures], float | None]:
    """The median of an error of a setting; None if it has none."""

    def found(setting: Figures) -> float | None:
        errors = setting["families"].get(family)
        return None if errors is None else factor * float(errors[error]["median"])

    return found


def _letters(figures: Figures) -> dict[str, str]:
    curves = dict.fromkeys(setting["curve"] for setting in figures["settings"])
    return {curve: string.ascii_uppercase[index % 26] + "'" * (index // 26) for index, curve in enumerate(curves)}


def _style(index: int) -> dict[str, Any]:
    return {
        "marker": MARKERS[index % len(MARKERS)],
        "ls": LINES[index % len(LINES)],
        "color": ("black", "0.35", "0.55")[index % 3],
        "mfc": "white" if index % 2 else None,
        "ms": 5,
        "lw": 0.9,
    }


def _curves(
    ax: Axes,
    figures: Figures,
    x_of: Callable[[Figures], float | None],
    y_of: Callable[[Figures], float | None],
    floor: float = FLOOR,
    *,
    named: bool = False,
) -> None:
    """All curves of an axes, and the front; beside each curve its letter, or its name."""
    letters = _letters(figures)
    everything: list[tuple[float, float]] = []
    for index, curve in enumerate(letters):
        points = []
        for setting in figures["settings"]:
            x, y = x_of(setting), y_of(setting)
            if setting["curve"] == curve and x is not None and y is not None and x > 0:
                points.append((x, max(y, floor), setting["setting"]))
        if not points:
            continue
        ax.plot([x for x, _, _ in points], [y for _, y, _ in points], **_style(index))
        for x, y, label in (points[0], points[-1])[-len(points) :]:  # between them they follow in order
            ax.annotate(label, (x, y), xytext=(3, -7), textcoords="offset points", fontsize=6 if named else 4.5, color="0.4")
        x, y, _ = points[-1]
        if named:
            ax.annotate(curve, (x, y), xytext=(2, 6), textcoords="offset points", fontsize=8, rotation=50, rotation_mode="anchor")
        else:
            ax.annotate(letters[curve], (x, y), xytext=(-9, 3), textcoords="offset points", fontsize=10, fontweight="bold")
        everything += [(x, y) for x, y, _ in points]
    front = [everything[index] for index in pareto_front([x for x, _ in everything], [y for _, y in everything])]
    if front:
        corners = [front[0]]
        for x, y in front[1:]:
            corners += [(x, corners[-1][1]), (x, y)]
        ax.plot([x for x, _ in corners], [y for _, y in corners], **FRONT)
    ax.set(xscale="log", yscale="log")
    ax.grid(which="major", color="0.9", lw=0.6)


def _marks(ax: Axes, figures: Figures, fingers: int) -> None:
    """Times of the baselines, as lines across."""
    marks = [(row["name"], row["median_us"]) for row in figures["baselines"] if row["fingers"] == fingers]
    if figures["machine"].get("wire_us"):
        marks.append(("upload on the wire", figures["machine"]["wire_us"]))
    for name, at_us in marks:
        ax.axvline(at_us, color="0.7", lw=0.8, ls=(0, (1, 2)), zorder=0)
        ax.annotate(
            name, (at_us, 0.01), xycoords=("data", "axes fraction"), rotation=90, fontsize=6, color="0.4", ha="right", va="bottom"
        )


def _key(figure: Figure, figures: Figures) -> None:
    """Names of the curves by letter, and what it was measured on."""
    handles = [
        Line2D([], [], label=f"{letter}  {curve}", **_style(index))
        for index, (curve, letter) in enumerate(_letters(figures).items())
    ]
    handles.append(Line2D([], [], label="Pareto front", **FRONT))
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=8, frameon=False)
    figure.suptitle(_reported(figures), fontsize=8)


def _reported(figures: Figures) -> str:
    reported = figures["environment"]
    return (
        f"{figures['board']}: {figures['modes']} modes, {figures['modes_in_band']} in the band; seed {figures['seed']}; "
        f"{reported['processor']}, one core; kernel {reported['kernel']}; commit {reported['commit']}"
    )


TIMED = ("time", "errors", "front_page", "building")  # those that need times
DIAGRAMS: dict[str, Callable[[Figures], Figure]] = {
    "front_page": front_page_diagram,
    "time": time_diagram,
    "memory": memory_diagram,
    "wire_and_heat": wire_and_heat_diagram,
    "errors": errors_diagram,
    "scenes": scenes_diagram,
    "building": building_diagram,
}
