"""Picture of what optimising an entry gains: the plate at T, plain and optimised, in decibels below the focus."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from controller.device.board.board import Board
from controller.workshop.physics.field import Field
from controller.workshop.physics.pictures.figure_file import save_figure

SHOWN_DB = 60.0


def plot_optimised(path: Path, board: Board, point_m: tuple[float, float], fields: Sequence[tuple[str, Field]]) -> None:
    """Draw fields of foci at one point side by side to a .png, .svg or .pdf file, each with its title.

    Raises ConfigError if the file cannot be written.
    """
    figure = Figure(figsize=(4.2 * len(fields), 3.4), layout="constrained")
    places = figure.subplots(1, len(fields), sharey=True)
    for axes, (name, field) in zip(places, fields, strict=True):
        x, y, u = field.map(field.scale.map_step_m / 2)
        level = 20 * np.log10(np.maximum(np.abs(u), 1e-15) / abs(field.at(point_m)[0]))
        picture = axes.pcolormesh(
            x * 1e3, y * 1e3, level, cmap="gray_r", vmin=-SHOWN_DB, vmax=0, shading="nearest", rasterized=True
        )
        radius_mm = field.scale.outside_m * 1e3
        axes.add_patch(Circle((point_m[0] * 1e3, point_m[1] * 1e3), radius_mm, fill=False, color="black", lw=0.8, ls="--"))
        axes.set(aspect="equal", xlabel="x (mm)", title=name)
        axes.set(xlim=(0, board.plate.length_mm), ylim=(0, board.plate.width_mm))
    places[0].set(ylabel="y (mm)")
    figure.colorbar(picture, ax=places, label="|displacement| at T (dB of the focus)", shrink=0.9)
    save_figure(figure, path, 90)
