"""Picture of an interpolation: what each point left out keeps, over the plate, and how many keep how much."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from controller.device.board.board import Board
from controller.workshop.calibration.fits.decay_fit import Decay
from controller.workshop.calibration.interpolation.interpolated import InterpolatedResponses
from controller.workshop.calibration.interpolation.wave_fit import WaveFit
from controller.workshop.physics.pictures.figure_file import draw_plate, save_figure


def plot_leave_out(path: Path, board: Board, source: InterpolatedResponses, waves: WaveFit, decays: list[Decay]) -> None:
    """Draw it to a PNG, SVG or PDF file; raises ConfigError if the file cannot be written."""
    found = source.leave_out
    evaluated = ~np.isnan(found.kept)
    lost = 1 - found.kept[evaluated]
    x_mm, y_mm = found.points_m[evaluated].T * 1e3
    plate = board.plate

    figure = Figure(figsize=(10, 8.5), layout="constrained")
    (above, shares), (wave, decay) = figure.subplots(2, 2, width_ratios=[1.7, 1], height_ratios=[1.6, 1])
    size = float(np.clip(9000 / max(evaluated.sum(), 1), 10, 160))
    dots = above.scatter(
        x_mm, y_mm, size, np.clip(100 * lost, 0.01, None), cmap="viridis_r", norm="log", edgecolors="0.4", linewidths=0.3
    )
    figure.colorbar(dots, ax=above, label="amplitude lost at a point left out (%)", shrink=0.85)
    draw_plate(above, board)
    median, least = source.provenance.kept or (np.nan, np.nan)
    above.set_title(f"{source.provenance.model}\nleft out: {median:.4f} kept at the median, {least:.3f} at least", fontsize=10)

    shares.plot(np.sort(100 * lost), np.arange(1, lost.size + 1) / max(lost.size, 1), color="black", drawstyle="steps-post")
    shares.set(xscale="log", xlabel="amplitude lost (%)", ylabel="share of the points", ylim=(0, 1.02))
    shares.grid(color="0.9")

    low_hz, high_hz = board.waveform.band_low_hz, board.waveform.band_high_hz
    frequency_hz = np.linspace(low_hz, high_hz, 200)
    fitted = waves.dispersion.factor + waves.dispersion.slope_per_hz * (frequency_hz - waves.dispersion.reference_hz)
    wave.plot(frequency_hz * 1e-3, 100 * (fitted - 1), color="black", lw=1)
    wave.errorbar(
        np.array(waves.frequency_hz) * 1e-3, 100 * (np.array(waves.factors) - 1), 100 * waves.scatter, fmt="o", color="crimson"
    )
    wave.axhline(0, color="0.7", lw=0.6)
    wave.set(xlabel="frequency (kHz)", ylabel="wavenumber beside\nboard.toml's (%)")
    for one in decays:
        middle_khz, half_khz = (one.low_hz + one.high_hz) * 0.5e-3, (one.high_hz - one.low_hz) * 0.5e-3
        error_ms = one.error_s * 1e3 if np.isfinite(one.error_s) else 0.0
        decay.errorbar(middle_khz, one.time_s * 1e3, error_ms, half_khz, fmt="o", color="crimson")
    decay.axhline(plate.decay_time_ms, color="0.5", lw=1, ls="--", label="board.toml")
    decay.set(xlabel="frequency (kHz)", ylabel="decay time (ms)")
    decay.set_ylim(0, 1.4 * max([plate.decay_time_ms, *(one.time_s * 1e3 for one in decays)]))
    decay.legend(fontsize=8, loc="lower right")
    save_figure(figure, path, 120)
