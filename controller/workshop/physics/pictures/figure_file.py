"""What pictures of a plate have in common: its patches, and the file."""

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from controller.device.board.board import Board
from controller.errors import ConfigError


def draw_plate(plate: Axes, board: Board) -> None:
    """Extent of a board's plate in mm, and the outlines of its patches."""
    plate.set(aspect="equal", xlim=(0, board.plate.length_mm), ylim=(0, board.plate.width_mm), xlabel="x (mm)", ylabel="y (mm)")
    for actuator in board.actuators:
        corner = (actuator.x_mm - actuator.size_mm / 2, actuator.y_mm - actuator.size_mm / 2)
        plate.add_patch(Rectangle(corner, actuator.size_mm, actuator.size_mm, fill=False, color="0.35", lw=0.8))


def save_figure(figure: Figure, path: Path, dpi: int) -> None:
    """Write a figure to a .png, .svg or .pdf file; raises ConfigError if it cannot be written."""
    try:
        figure.savefig(path, dpi=dpi)
    except (OSError, ValueError) as error:
        raise ConfigError(f"{path}: the picture cannot be written ({error})") from error
