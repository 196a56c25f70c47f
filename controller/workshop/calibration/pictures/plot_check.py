"""Picture of a measurement: coherence of each point over the plate, of each channel and point, and some responses."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from controller.device.board.board import Board
from controller.workshop.calibration.learning.learning import Learned
from controller.workshop.calibration.pictures.check_figures import snr_db
from controller.workshop.physics.pictures.figure_file import draw_plate, save_figure

SHOWN_POINTS = 3


def plot_check(path: Path, board: Board, learned: Learned) -> None:
    """Draw it to a PNG, SVG or PDF file; raises ConfigError if the file cannot be written."""
    measurement, found = learned.measurement, learned.responses
    channels = sorted(a.channel for a in board.actuators)
    coherence = np.where(np.isnan(found.coherence), found.known, found.coherence)[:, channels]
    reported = ~np.isnan(found.coherence[:, channels]).all()
    missing = np.isin(np.arange(len(measurement.names)), measurement.missing)
    x_mm, y_mm = found.points_m.T * 1e3

    figure = Figure(figsize=(10, 9.5), layout="constrained")
    rows: Any = figure.subfigures(2, 1, height_ratios=[1.15, 1])
    plate, table = rows[0].subplots(1, 2, width_ratios=[1.5, 1])
    what = "coherence" if reported else "known channels"
    size = float(np.clip(9000 / len(x_mm), 12, 160))
    least = float(min(coherence[~missing].mean(axis=1).min(initial=1.0), 0.9))
    dots = plate.scatter(x_mm[~missing], y_mm[~missing], size, coherence[~missing].mean(axis=1), cmap="viridis", vmin=least, vmax=1)
    plate.scatter(x_mm[missing], y_mm[missing], size, color="crimson", marker="x", label="no records")
    rows[0].colorbar(dots, ax=plate, label=f"{what}, mean over channels", shrink=0.8)
    draw_plate(plate, board)
    plate.set_title(f"{len(x_mm)} points, {int(missing.sum())} without records")
    if missing.any():
        plate.legend(loc="upper left", bbox_to_anchor=(0, -0.18), frameon=False)

    snr = snr_db(learned)[:, channels]
    shown = snr if np.isfinite(snr).any() else coherence
    picture = table.imshow(np.where(missing[:, None], np.nan, shown), aspect="auto", cmap="magma", interpolation="nearest")
    rows[0].colorbar(picture, ax=table, label="signal over noise (dB)" if shown is snr else what, shrink=0.8)
    table.set(xlabel="channel", ylabel="point, in the order of the file", title="each response; white: unknown")
    table.set_xticks(range(0, len(channels), 4), [str(channel) for channel in channels[::4]])

    time_ms = (np.arange(found.responses.shape[1]) + 1) / found.bit_clock_hz * 1e3
    known = np.flatnonzero(found.known.any(axis=1))
    chosen = known[np.linspace(0, len(known) - 1, min(SHOWN_POINTS, len(known))).astype(int)]
    below = np.atleast_1d(rows[1].subplots(max(len(chosen), 1), 1, sharex=True))
    for axes, point in zip(below, chosen, strict=False):
        channel = int(np.flatnonzero(found.known[point])[0])
        axes.plot(time_ms, found.responses[point, :, channel] * 1e12, lw=0.6, color="black")
        noise_pm = found.noise[point, channel] * 1e12
        if np.isfinite(noise_pm):
            axes.axhspan(-noise_pm, noise_pm, color="crimson", alpha=0.25, label=f"noise, {noise_pm:.2g} pm per V")
            axes.legend(loc="upper right", fontsize=8)
        axes.set(ylabel="pm per V", xlim=(0, time_ms[-1]))
        axes.set_title(
            f"point {measurement.names[point]} at {x_mm[point]:.1f}, {y_mm[point]:.1f} mm, channel {channel}", fontsize=9
        )
    below[-1].set_xlabel("time after the start of a pulse of one bit period (ms)")
    save_figure(figure, path, 120)
