"""Picture of `haptic-panel tolerance --plot`: how many plates are good with each bank, and what each tolerance costs alone."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from controller.workshop.physics.pictures.figure_file import save_figure

LOOKS = {  # of each bank: color and title
    "model": ("C3", "the model's bank"),
    "clock": ("C0", "the same, best bit clock"),
    "calibrated": ("black", "calibrated bank"),
}


def plot_tolerance(path: Path, figures: dict[str, Any]) -> None:
    """Draw the figures of a study; raises ConfigError if the file cannot be written."""
    alone = figures["alone"]
    figure = Figure(figsize=(11, 4.4), layout="constrained")
    panels = figure.subplots(1, 2 if alone else 1, squeeze=False)[0]
    shares, plates = panels[0], figures["plates"]
    for bank, (color, title) in LOOKS.items():
        weakest = np.sort(figures["weakest"][bank])
        good = figures["banks"][bank]["good"]
        edges, above = np.concatenate([[-1], weakest, [2]]), np.append(1 - np.arange(plates + 1) / plates, 0)
        shares.step(edges, 100 * above, where="post", color=color, label=f"{title}: {100 * good:.3g} %")
    shares.axvline(figures["least"], color="0.5", lw=1, ls="--")
    every = np.concatenate(list(figures["weakest"].values()))
    shares.set(xlim=(min(0.0, every.min()), max(1.05, every.max())), ylim=(0, 103))
    shares.set_xlabel("amplitude at the weakest place, over the design's")
    shares.set_ylabel("plates with at least that (%)")
    shares.set_title(f"{plates} plates; good from {figures['least']:g} on", fontsize=10)
    shares.legend(loc="lower left", fontsize=8)
    shares.grid(color="0.9", lw=0.5)
    if alone:
        _draw_costs(panels[1], alone, figures["alone_plates"])
    save_figure(figure, path, 110)


def _draw_costs(costs: Any, alone: dict[str, dict[str, dict[str, float]]], plates: int) -> None:
    """Amplitude that each tolerance leaves alone, the dearest on top: the mean as a bar from the design's, the worst as a dot."""
    names = sorted(alone, key=lambda name: -alone[name]["model"]["mean"])
    at = np.arange(len(names))
    for index, (bank, (color, _)) in enumerate(LOOKS.items()):
        rows = at + 0.27 * (1 - index)
        costs.barh(rows, [alone[name][bank]["mean"] - 1 for name in names], 0.25, left=1, color=color)
        costs.plot([alone[name][bank]["worst"] for name in names], rows, ".", ms=5, color=color)
    costs.set_yticks(at, [name.rsplit("_", 1)[0].replace("_", " ") for name in names], fontsize=8)
    costs.set_xlabel("amplitude, over the design's: mean (bar), worst plate (dot)")
    costs.set_title(f"each tolerance alone, {plates} plates", fontsize=10)
    costs.axvline(1, color="0.5", lw=0.8)
    costs.grid(axis="x", color="0.9", lw=0.5)
