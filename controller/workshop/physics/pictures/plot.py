"""Pictures of a focus: the plate at T with fingers and actuators, and a cross-section (as the paper's fig. 6)."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from controller.device.board.board import Board
from controller.errors import ConfigError
from controller.workshop.physics.audible import AUDIBLE_HZ
from controller.workshop.physics.field import Field
from controller.workshop.physics.pictures.figure_file import draw_plate, save_figure
from controller.workshop.physics.pictures.focus_series import FocusSeries

KINDS = (".png", ".svg", ".pdf")
Point = tuple[float, float]
PERIODS = 6  # of the band's middle, before T
LEAST_DB = -80.0


def check_picture(path: Path) -> None:
    """Refuse a picture that could not be written, before the work for it is done.

    Raises ConfigError if its folder does not exist or is not writable, or its suffix is none of `KINDS`.
    """
    if path.suffix not in KINDS:
        raise ConfigError(f"{path}: a picture is {' or '.join(KINDS)}, by the ending of its name")
    if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        raise ConfigError(f"{path}: the picture cannot be written there")


def plot_focus(
    path: Path, board: Board, field: Field, foci: Sequence[Point], title: str, series: FocusSeries | None = None
) -> None:
    """Draw the field to a PNG, SVG or PDF file.

    `foci` (x_m, y_m) are where the fingers are; the first one gets the cross-section along x. `series` is drawn beside the plate:
    what happens over time at the first focus. Raises ConfigError if the file cannot be written.
    """
    x, y, u = field.map(field.scale.map_step_m / 4)
    u_um = u * 1e6
    across_m = np.linspace(0, board.plate.length_m, 2101)
    section_y_m = foci[0][1]
    section_um = field.at(np.column_stack([across_m, np.full_like(across_m, section_y_m)])) * 1e6
    largest = float(abs(u_um).max()) or 1.0

    figure = Figure(figsize=(8 if series is None else 14, 8.2), layout="constrained")
    left: Any = figure
    if series is not None:
        halves = figure.add_gridspec(1, 2, width_ratios=[8, 6])
        left = figure.add_subfigure(halves[0])
        draw_series(figure.add_subfigure(halves[1]), board, series)
    above, below = left.subplots(2, 1, height_ratios=[2.4, 1], sharex=True)
    picture = above.pcolormesh(
        x * 1e3, y * 1e3, u_um, cmap="RdBu_r", vmin=-largest, vmax=largest, shading="nearest", rasterized=True
    )
    left.colorbar(picture, ax=above, label="displacement at T (µm)")
    draw_plate(above, board)
    for focus_x_m, focus_y_m in foci:
        above.add_patch(Circle((focus_x_m * 1e3, focus_y_m * 1e3), field.scale.circle_m * 1e3, fill=False, color="black", lw=1.2))
    above.axhline(section_y_m * 1e3, color="black", lw=0.6, ls=":")
    above.set(xlabel="", title=title)
    below.plot(across_m * 1e3, section_um, color="black", lw=0.9)
    below.axhline(0, color="0.7", lw=0.6)
    below.set(xlabel="x (mm)", ylabel="displacement (µm)", title=f"cross-section at y = {section_y_m * 1e3:.1f} mm")
    save_figure(figure, path, 120)


def draw_series(figure: Any, board: Board, series: FocusSeries) -> None:
    """Draw voltages, displacement and spectrum of a focus."""
    waveform = board.waveform
    near_s = PERIODS / waveform.middle_hz
    time_us, time_ms, u_um = series.time_s * 1e6, series.time_s * 1e3, series.displacement_m * 1e6
    volts, whole, near, spectrum = figure.subplots(4, 1, height_ratios=[1.5, 1, 1, 1.2])

    shown = (series.time_s >= -near_s) & (series.time_s <= near_s / 3)
    tall = 1.5 * board.driver.supply_v
    for row, channel in enumerate(series.channels):
        volts.step(time_us[shown], series.stage_v[shown, row] - row * tall, where="pre", color="0.6", lw=0.8)
        volts.plot(time_us[shown], series.piezo_v[shown, row] - row * tall, color="black", lw=1)
        volts.text(time_us[shown][0], -row * tall, f"{channel} ", ha="right", va="bottom", fontsize=8)
    volts.axvline(0, color="black", lw=0.6, ls=":")
    volts.set(yticks=[], ylabel="channels", title=f"bits of 0 and {board.driver.supply_v:g} V (grey), voltage behind the driver")
    volts.set_xlabel("time from T (µs)")

    whole.plot(time_ms, u_um, color="black", lw=0.5)
    whole.set(xlabel="time from T (ms)", ylabel="µm", title="displacement of the focus", xlim=(time_ms[0], time_ms[-1]))

    shown = np.abs(series.time_s) <= near_s / 2
    near.plot(time_us[shown], u_um[shown], color="black", lw=1)
    near.axhline(0, color="0.7", lw=0.6)
    top = float(u_um[np.argmin(np.abs(series.time_s))])
    near.axhline(top / 2, color="0.4", lw=0.8, ls="--")
    near.set(xlabel="time from T (µs)", ylabel="µm", title="around T; dashed: half height")

    frequency_hz, size = series.spectrum()
    highest_hz = 1.5 * waveform.band_high_hz
    drawn = (frequency_hz > 0) & (frequency_hz <= highest_hz)
    largest = float(size[drawn].max()) or 1.0
    level_db = np.maximum(20 * np.log10(np.maximum(size[drawn] / largest, 1e-12)), LEAST_DB)
    spectrum.plot(frequency_hz[drawn] * 1e-3, level_db, color="black", lw=0.5)
    for edge_hz in (waveform.band_low_hz, waveform.band_high_hz):
        spectrum.axvline(edge_hz * 1e-3, color="black", lw=0.9, ls="--")
    spectrum.axvspan(0, min(AUDIBLE_HZ, highest_hz) * 1e-3, color="0.88", lw=0)
    spectrum.set(xlabel="frequency (kHz)", ylabel="dB", xlim=(0, highest_hz * 1e-3), ylim=(LEAST_DB, 5))
    spectrum.set_title("its spectrum; dashed: band, grey: audible")
    for panel in (volts, whole, near, spectrum):
        panel.title.set_fontsize(9)
