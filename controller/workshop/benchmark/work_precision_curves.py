"""Curves of work-precision diagrams, which are read without colour: each has a letter, a marker and a line style, and a key."""

import string
from collections.abc import Callable
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from controller.workshop.benchmark.pareto import pareto_front

Figures = dict[str, Any]
FLOOR = 1e-4  # errors below, and below zero, are drawn here
MARKERS = "osD^v<>pPX*hd8H"
LINES = ("-", "--", "-.", ":")
FRONT: dict[str, Any] = {"color": "0.8", "lw": 6, "solid_capstyle": "round", "zorder": 0}


def letters_of(figures: Figures) -> dict[str, str]:
    """The letter of each curve."""
    curves = dict.fromkeys(setting["curve"] for setting in figures["settings"])
    return {curve: string.ascii_uppercase[index % 26] + "'" * (index // 26) for index, curve in enumerate(curves)}


def style(index: int) -> dict[str, Any]:
    """Marker and line of a curve by its number."""
    return {
        "marker": MARKERS[index % len(MARKERS)],
        "ls": LINES[index % len(LINES)],
        "color": ("black", "0.35", "0.55")[index % 3],
        "mfc": "white" if index % 2 else None,
        "ms": 5,
        "lw": 0.9,
    }


def draw_curves(
    ax: Axes,
    figures: Figures,
    x_of: Callable[[Figures], float | None],
    y_of: Callable[[Figures], float | None],
    floor: float = FLOOR,
    *,
    named: bool = False,
) -> None:
    """All curves of an axes, and the front; beside each curve its letter, or its name."""
    letters = letters_of(figures)
    everything: list[tuple[float, float]] = []
    for index, curve in enumerate(letters):
        points = []
        for setting in figures["settings"]:
            x, y = x_of(setting), y_of(setting)
            if setting["curve"] == curve and x is not None and y is not None and x > 0:
                points.append((x, max(y, floor), setting["setting"]))
        if not points:
            continue
        ax.plot([x for x, _, _ in points], [y for _, y, _ in points], **style(index))
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


def draw_marks(ax: Axes, figures: Figures, fingers: int) -> None:
    """Times of the baselines, as lines across."""
    marks = [(row["name"], row["median_us"]) for row in figures["baselines"] if row["fingers"] == fingers]
    if figures["machine"].get("wire_us"):
        marks.append(("upload on the wire", figures["machine"]["wire_us"]))
    for name, at_us in marks:
        ax.axvline(at_us, color="0.7", lw=0.8, ls=(0, (1, 2)), zorder=0)
        ax.annotate(
            name, (at_us, 0.01), xycoords=("data", "axes fraction"), rotation=90, fontsize=6, color="0.4", ha="right", va="bottom"
        )


def draw_key(figure: Figure, figures: Figures) -> None:
    """Names of the curves by letter, and what it was measured on."""
    handles = [
        Line2D([], [], label=f"{letter}  {curve}", **style(index))
        for index, (curve, letter) in enumerate(letters_of(figures).items())
    ]
    handles.append(Line2D([], [], label="Pareto front", **FRONT))
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=8, frameon=False)
    figure.suptitle(reported(figures), fontsize=8)


def reported(figures: Figures) -> str:
    """What was measured, on what, in a line."""
    machine = figures["environment"]
    return (
        f"{figures['board']}: {figures['modes']} modes, {figures['modes_in_band']} in the band; seed {figures['seed']}; "
        f"{machine['processor']}, one core; kernel {machine['kernel']}; commit {machine['commit']}"
    )
