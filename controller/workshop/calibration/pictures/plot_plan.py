"""Picture of a plan: points in the order of the head's path, and the share of the amplitude that is foreseen between them."""

from pathlib import Path

from matplotlib.figure import Figure

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.workshop.physics.pictures.figure_file import draw_plate, save_figure


def plot_plan(path: Path, board: Board, points_m: Floats, places_m: Floats, shares: Floats) -> None:
    """Draw it to a PNG, SVG or PDF file.

    `points_m` (point, 2) are in the order of the path; `shares` (place,) are foreseen at `places_m` (place, 2). Raises ConfigError
    if the file cannot be written.
    """
    figure = Figure(figsize=(9, 6.5), layout="constrained")
    plate = figure.subplots()
    dots = plate.scatter(
        places_m[:, 0] * 1e3, places_m[:, 1] * 1e3, 30, 100 * (1 - shares), cmap="YlOrRd", marker="s", linewidths=0, alpha=0.8
    )
    figure.colorbar(dots, ax=plate, label="amplitude that is not foreseen (%)", shrink=0.8)
    x_mm, y_mm = points_m.T * 1e3
    plate.plot(x_mm, y_mm, color="0.6", lw=0.6, zorder=1)
    plate.scatter(x_mm, y_mm, 9, color="black", zorder=2)
    plate.scatter(x_mm[:1], y_mm[:1], 60, facecolors="none", edgecolors="black", zorder=3)
    draw_plate(plate, board)
    plate.set_title(f"{len(points_m)} points; the circle is where the path begins")
    save_figure(figure, path, 120)
