"""Work-precision diagrams: one curve for each method, one point for each setting, the Pareto front behind them."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from controller.workshop.benchmark.pareto import cost, main_error
from controller.workshop.benchmark.work_precision_curves import (
    FLOOR,
    draw_curves,
    draw_key,
    draw_marks,
    letters_of,
    reported,
    style,
)
from controller.workshop.physics.pictures.figure_file import save_figure

Figures = dict[str, Any]
SUFFIXES = (".png", ".svg")
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
FELT = "felt amplitude lost: 1 − felt / most felt of any method"
FELT_FLOOR = 5e-3  # felt losses below are drawn here: methods differ by more, or are felt alike


def draw_all(folder: Path, figures: Figures) -> list[Path]:
    """Draw every diagram as PNG and SVG into a folder that is there; returns the files written.

    Raises ConfigError if one cannot be written.
    """
    timed = any(setting["time_us"] for setting in figures["settings"])
    names = [name for name in DIAGRAMS if timed or name not in TIMED]
    return [path for name in names for path in _draw(folder, figures, name)]


def _draw(folder: Path, figures: Figures, name: str) -> list[Path]:
    """Write one diagram, which is laid out once for its files."""
    figure = DIAGRAMS[name](figures)
    written = [folder / f"{name}{suffix}" for suffix in SUFFIXES]
    for path in written:
        save_figure(figure, path, 110)
        figure.set_layout_engine("none")
    return written


def time_diagram(
    figures: Figures, error_of: Callable[[str], Callable[[Figures], float | None]], label: str, floor: float
) -> Figure:
    """An error against time, for 1, 2, 4 and 10 fingers."""
    figure = Figure(figsize=(14, 11), layout="constrained")
    shown = [count for count in SHOWN_FINGERS if f"{count} off grid" in figures["scenes"]]
    for count, ax in zip(shown, figure.subplots(2, 2).flat, strict=False):
        family = f"{count} off grid"
        draw_curves(ax, figures, _cost("time", family), error_of(family), floor)
        draw_marks(ax, figures, int(count))
        ax.set(xlabel=TIME, ylabel=label, title=f"{count} finger{'s' * (count != '1')} between cells")
    draw_key(figure, figures)
    return figure


def front_page_diagram(figures: Figures) -> Figure:
    """One finger: amplitude and felt amplitude lost, against time and memory, of some methods named beside their curves."""
    figure = Figure(figsize=(12, 10.4), layout="constrained")
    axes = figure.subplots(2, 2, sharex="col", sharey="row")
    family = "1 off grid"
    for column, (curves, x_of, label) in enumerate(
        ((FRONT_PAGE_TIME, _cost("time", family), TIME), (FRONT_PAGE_MEMORY, _cost("memory", "", 1e-6), MEMORY))
    ):
        shown = {**figures, "settings": [setting for setting in figures["settings"] if setting["curve"] in curves]}
        draw_curves(axes[0, column], shown, x_of, _main(family), named=True)
        draw_curves(axes[1, column], shown, x_of, _felt(family), FELT_FLOOR, named=True)
        axes[1, column].set(xlabel=label)
        low, high = axes[1, column].get_xlim()
        axes[1, column].set_xlim(low / 1.5, high * 4)  # room for the names
    for ax, label, ends in zip(axes[:, 0], (LOST, FELT), ((0.6 * FLOOR, 10), (0.7 * FELT_FLOOR, 3)), strict=True):
        ax.set(ylabel=label, ylim=ends)
        draw_marks(ax, figures, 1)
    figure.suptitle(reported(figures), fontsize=8)
    return figure


def memory_diagram(figures: Figures) -> Figure:
    """Error against memory, for 1 and 4 fingers."""
    figure = Figure(figsize=(14, 6.5), layout="constrained")
    for count, ax in zip(("1", "4"), figure.subplots(1, 2), strict=True):
        draw_curves(ax, figures, _cost("memory", "", 1e-6), _main(f"{count} off grid"))
        ax.set(xlabel=MEMORY, ylabel=LOST, title=f"{count} finger{'s' * (count != '1')} between cells")
    draw_key(figure, figures)
    return figure


def wire_and_heat_diagram(figures: Figures) -> Figure:
    """Error against bytes on the wire and against heat in the stages."""
    figure = Figure(figsize=(14, 6.5), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    for ax, x_of, label in ((left, _cost("wire", ""), WIRE), (right, _median("1 off grid", "stage_j", 1e3), HEAT)):
        draw_curves(ax, figures, x_of, _main("1 off grid"))
        ax.set(xlabel=label, title="1 finger between cells")
    left.set(ylabel=LOST)
    draw_key(figure, figures)
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
        draw_curves(ax, figures, _cost("time", family), error, floor)
        ax.set(xlabel=TIME, ylabel=label)
    draw_key(figure, figures)
    return figure


def scenes_diagram(figures: Figures) -> Figure:
    """Median and worst loss of the finest setting of each curve, by family of scenes."""
    families = [family for family in figures["scenes"] if family != "idle"]
    finest: dict[str, Figures] = {}
    for setting in figures["settings"]:
        best = finest.get(setting["curve"])
        if best is None or _typical(setting) < _typical(best):
            finest[setting["curve"]] = setting
    letters = letters_of(figures)
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
            ax.plot(median, y, **{**style(order[curve]), "ms": 4, "ls": ""}, zorder=2)
            ax.annotate(letters[curve], (worst, y), xytext=(3, 0), textcoords="offset points", va="center", fontsize=5.5)
        ax.axhline(row + 0.5, color="0.85", lw=0.6)
    ax.set_yticks(range(len(families)), families)
    ax.invert_yaxis()
    ax.set(xscale="log", xlabel=f"{LOST}; marker: median, end of the line: worst scene; best setting of each method")
    draw_key(figure, figures)
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
        ax.plot([x for x, _, _ in points], [y for _, y, _ in points], **style(index), label=curve)
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


def _felt(family: str) -> Callable[[Figures], float | None]:
    return _median(family, "felt_loss")


def _inverse_contrast(setting: Figures) -> float | None:
    contrast = _median("1 off grid", "contrast")(setting)
    return 1 / contrast if contrast else None


def _median(family: str, error: str, factor: float = 1.0) -> Callable[[Figures], float | None]:
    """The median of an error of a setting; None if it has none."""

    def found(setting: Figures) -> float | None:
        errors = setting["families"].get(family)
        return None if errors is None else factor * float(errors[error]["median"])

    return found


TIMED = ("time", "felt", "errors", "front_page", "building")  # those that need times
DIAGRAMS: dict[str, Callable[[Figures], Figure]] = {
    "front_page": front_page_diagram,
    "time": partial(time_diagram, error_of=_main, label=LOST, floor=FLOOR),
    "felt": partial(time_diagram, error_of=_felt, label=FELT, floor=FELT_FLOOR),
    "memory": memory_diagram,
    "wire_and_heat": wire_and_heat_diagram,
    "errors": errors_diagram,
    "scenes": scenes_diagram,
    "building": building_diagram,
}
