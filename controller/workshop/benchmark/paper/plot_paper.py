"""Picture for `haptic-panel benchmark paper --plot FILE`: the paper's figures, simulated, with the paper's numbers marked.

It is read without colour: what is ours is solid with filled marks, what is the paper's dashed with open ones.
"""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from controller.workshop.physics.pictures.figure_file import save_figure

Figures = dict[str, Any]

OURS: dict[str, Any] = {"color": "black", "lw": 1.4}
THEIRS: dict[str, Any] = {"color": "black", "lw": 1.0, "ls": "--"}
OTHER: dict[str, Any] = {"color": "0.45", "lw": 1.2, "ls": ":"}
PAPER_MARK: dict[str, Any] = {"ls": "none", "marker": "o", "mfc": "white", "mec": "black", "ms": 8, "zorder": 3}
SHOWN_SKIN_MS = (-0.1, 0.6)


def plot_paper(path: Path, figures: Figures) -> None:
    """Draw the figures of `paper_figures` to a .png, .svg or .pdf file; raises ConfigError if the file cannot be written."""
    figure = Figure(figsize=(16, 13), layout="constrained")
    parts: Any = figure.subfigures(2, 1, height_ratios=[1.25, 1])
    for part, panels, shape in zip(parts, (CURVES, LISTS), ((2, 4), (1, 2)), strict=True):
        for ax, draw in zip(part.subplots(*shape).flat, panels, strict=True):
            draw(ax, figures)
    save_figure(figure, path, 90)


def cross_section(ax: Axes, figures: Figures) -> None:
    """One focus along the plate (fig. 6)."""
    curve = figures["curves"]["foci"]
    ax.plot(curve["x_mm"], curve["one_um"], **OURS)
    ax.axhline(7.68, **THEIRS, label="paper: 7.68 µm")
    middle = curve["x_mm"][int(np.argmax(curve["one_um"]))]
    half = max(curve["one_um"]) / 2
    ax.plot([middle - 2.6, middle + 2.6], [half, half], color="black", lw=3, label="paper: 5.2 mm")
    ax.set(xlabel="x (mm)", ylabel="displacement at T (µm)", title="Fig. 6: one focus", ylim=(-3, 11))
    ax.legend(fontsize=8, loc="upper left")


def four_foci(ax: Axes, figures: Figures) -> None:
    """Four foci in a square of 40 mm (fig. 9)."""
    curve = figures["curves"]["foci"]
    place = curve["square_mm"]
    values = np.array(curve["four_um"])
    picture = ax.pcolormesh(place, place, values, cmap="gray_r", shading="nearest", rasterized=True)
    ax.figure.colorbar(picture, ax=ax, label="µm", shrink=0.7)
    ax.plot([-5, 5, 5, -5], [-5, -5, 5, 5], "+", color="white", ms=8)
    row = _row(figures, "four_plain")
    here, paper = row["here"]["median"] * 7.68, 2.9
    ax.set(aspect="equal", xlabel="x (mm)", ylabel="y (mm)", title=f"Fig. 9: four foci of {here:.1f} µm (paper {paper:g})")


def energy(ax: Axes, figures: Figures) -> None:
    """Energy over time (fig. 8)."""
    curve = figures["curves"]["energy"]
    time_ms, total = np.array(curve["time_ms"]), np.array(curve["energy_uj"])
    ax.plot(time_ms, total, **OURS, label="here, all modes")
    ax.plot(time_ms, curve["kinetic_uj"], **OTHER, label="of it kinetic")
    late = time_ms >= 2
    ax.plot(
        time_ms[late], total[late][0] * np.exp(-(time_ms[late] - time_ms[late][0]) / 2), **THEIRS, label="printed: decay with 2 τ"
    )
    scanned = _row(figures, "energy_scan_uj")["here"]["median"]
    ax.plot([2], [scanned], "ks", ms=6, label=f"here, by a scan of 2 mm: {scanned:.0f} µJ")
    ax.plot([2], [90], **PAPER_MARK, label="paper: 90 µJ")
    ax.set(xlabel="time (ms)", ylabel="energy (µJ)", title="Fig. 8: energy in the plate", xlim=(0, 5), ylim=(0, 200))
    ax.legend(fontsize=8, loc="upper right")


def durations(ax: Axes, figures: Figures) -> None:
    """Amplitude over the duration of the emission."""
    curve = figures["curves"]["duration"]
    for kind, style, name, law in (("one_bit", "o", "1-bit", "1 − e^(−T/τ)"), ("linear", "^", "linear", "1 − e^(−2T/τ)")):
        ax.plot(curve["duration_ms"], curve[f"{kind}_um"], **OURS, marker=style, markevery=200, label=f"{name} drive")
        ax.plot(curve["duration_ms"], curve[f"{kind}_law_um"], **THEIRS, label=law)
    ax.plot([2], [7.68], **PAPER_MARK, label="paper")
    ax.set(xlabel="T (ms)", ylabel="amplitude (µm)", title="Amplitude over duration", xlim=(0, 4), ylim=(0, 14))
    ax.legend(fontsize=8, loc="upper left", ncols=2)


def repetition(ax: Axes, figures: Figures) -> None:
    """Contrast kept over the period (appendix A)."""
    curve = figures["curves"]["repetition"]
    period = np.linspace(0.2, 4, 100)
    ax.plot(period, np.sqrt(1 - np.exp(-2 * period)), **THEIRS, label="appendix A: √(1 − e^(−2Tr/τ))")
    ax.plot(curve["period_ms"], curve["contrast_kept"], "ko", label="20 repetitions, T = Tr up to 2 ms")
    ax.set(xlabel="period Tr (ms)", ylabel="contrast over that of a single emission", title="Repetition", ylim=(0.5, 1.05))
    ax.legend(fontsize=8, loc="lower right")


def finger(ax: Axes, figures: Figures) -> None:
    """What a finger's mass leaves (fig. 11)."""
    curve = figures["curves"]["finger"]
    ax.plot(curve["mass_mg"], curve["modal"], **OURS, marker="o", ms=4, label="point mass on the modal plate")
    ax.plot(curve["mass_mg"], curve["formula"], **THEIRS, label="eq. (7), Rs = 5 mm")
    ax.axhline(3 / 7, color="0.45", lw=1, label="fig. 11 at 1 N: 7 → 3 µm")
    ax.axvspan(0, 100, color="0.92", label="M measured by eq. (7): 0–100 mg")
    ax.set(
        xlabel="mass at the focus (mg)",
        ylabel="amplitude kept",
        title="Fig. 11: finger at the focus",
        ylim=(0, 1.02),
        xlim=(0, None),
    )
    ax.legend(fontsize=8)


def skin(ax: Axes, figures: Figures) -> None:
    """Skin thrown off the plate (fig. 12), illustrative."""
    curve = figures["curves"]["skin"]
    ax.plot(curve["time_ms"], curve["free_um"], **OTHER, label="plate without finger")
    for press_n, color, lw in zip(curve["shown_n"], ("black", "0.45"), (2.0, 1.4), strict=True):
        ax.plot(curve["time_ms"], curve[f"skin_um_{press_n:g}"], color=color, lw=lw, label=f"skin pressed with {press_n:g} N")
    ax.plot([0, 0.3], [25, 25], **THEIRS, marker="|", label="paper: 25 µm, 0.3 ms")
    ax.set(xlabel="time from T (ms)", ylabel="displacement (µm)", title="Fig. 12: skin thrown (illustrative)", ylim=(-7, 38))
    ax.set_xlim(*SHOWN_SKIN_MS)
    ax.legend(fontsize=8, loc="upper right")


def touches(ax: Axes, figures: Figures) -> None:
    """Height and duration of the throw over the force of the finger."""
    curve = figures["curves"]["skin"]
    ax.semilogx(curve["press_n"], curve["height_um"], **OURS, marker="o", label="thrown up by (µm)")
    ax.semilogx(
        curve["press_n"], np.array(curve["flight_ms"]) * 100, **OURS, marker="^", mfc="white", label="off the plate for (0.01 ms)"
    )
    ax.axhline(25, **THEIRS, label="paper: 25 µm")
    ax.axhline(30, **OTHER, label="paper: 0.3 ms")
    ax.set(xlabel="force of the finger (N)", ylabel="µm; 0.01 ms", title="Skin thrown (illustrative)", ylim=(0, None))
    ax.set_xticks(curve["press_n"], [f"{press_n:g}" for press_n in curve["press_n"]])
    ax.minorticks_off()
    ax.legend(fontsize=8)


def losses(ax: Axes, figures: Figures) -> None:
    """What approximations keep, beside the earlier trial."""
    rows = [row for row in figures["rows"] if row["quantity"].startswith("kept: ")]
    places = range(len(rows))
    ax.hlines(places, [row["here"]["p5"] for row in rows], [row["here"]["p95"] for row in rows], color="black", lw=1)
    ax.plot([row["paper"] for row in rows], places, **PAPER_MARK, label="earlier trial")
    ax.plot([row["here"]["median"] for row in rows], places, "k.", ms=7, zorder=4, label="here, 5–95 %")
    ax.grid(axis="x", color="0.85", lw=0.6)
    ax.invert_yaxis()
    ax.legend(fontsize=8, loc="center left")
    ax.set_yticks(places, [row["quantity"].removeprefix("kept: ") for row in rows], fontsize=7)
    ax.set(xlabel="amplitude kept", title="What approximations cost", xlim=(-0.08, 1.05))


def ratios(ax: Axes, figures: Figures) -> None:
    """Ratio of ours to the paper's."""
    rows = [row for row in figures["rows"] if row["paper"] and not row["trial"]]
    ax.plot([row["ratio"] for row in rows], range(len(rows)), "ko", ms=5)
    low, high = ([row["here"][end] / row["paper"] for row in rows] for end in ("p5", "p95"))
    ax.hlines(range(len(rows)), low, high, color="black", lw=1)
    ax.axvline(1, **THEIRS)
    ax.set_yticks(range(len(rows)), [row["quantity"] for row in rows], fontsize=7)
    ax.invert_yaxis()
    ax.set(xscale="log", xlabel="here over paper", title="All figures of the paper")
    ax.set_xticks([0.25, 0.5, 1, 2], ["1/4", "1/2", "1", "2"])
    ax.minorticks_off()
    ax.grid(axis="x", color="0.85", lw=0.6)


def _row(figures: Figures, key: str) -> Figures:
    return next(row for row in figures["rows"] if row["key"] == key)


CURVES = (cross_section, four_foci, energy, durations, repetition, finger, skin, touches)
LISTS = (losses, ratios)
