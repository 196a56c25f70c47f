"""Picture of `haptic-panel design --sweep --plot`: one small diagram for each figure over what is swept."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from controller.workshop.physics.pictures.figure_file import save_figure

COLUMNS = 3


def plot_sweep(
    path: Path,  # file to write: .png, .svg or .pdf
    swept: str,  # name of the number
    values: Sequence[float],  # of the number
    rows: Sequence[Mapping[str, Any]],  # `design_figures` at each value
    titles: Mapping[str, str],  # of each figure that is drawn, its title
    # Of figures that are to be large, the value from which they are enough: drawn as a line, with the best of the sweep
    wanted: Mapping[str, float],
) -> None:
    """Draw figures over a number of the design; raises ConfigError if the file cannot be written."""
    lines = -(-len(titles) // COLUMNS)
    figure = Figure(figsize=(11, 2.7 * lines), layout="constrained")
    panels = figure.subplots(lines, COLUMNS, squeeze=False).ravel()
    for panel, (name, title) in zip(panels, titles.items(), strict=False):
        drawn = np.array([np.nan if row[name] is None else row[name] for row in rows], np.float64)
        panel.plot(values, drawn, color="black", lw=1, marker="." if len(values) < 40 else None)
        panel.set_title(title, fontsize=9)
        if name in wanted:
            panel.axhline(wanted[name], color="C3", lw=1, ls="--")
            best = int(np.nanargmax(drawn))
            panel.plot(values[best], drawn[best], "o", color="C3")
            panel.annotate(f" {drawn[best]:.3g} at {values[best]:.3g}", (values[best], drawn[best]), fontsize=8, va="bottom")
        panel.set_xlabel(swept)
        panel.set_ylim(0, 1.1 * max(float(np.nanmax(drawn, initial=0)), wanted.get(name, 0)) or 1)
        panel.grid(color="0.85", lw=0.5)
    for panel in panels[len(titles) :]:
        panel.axis("off")
    save_figure(figure, path, 110)
