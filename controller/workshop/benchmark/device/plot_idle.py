"""Picture for `haptic-panel focus --idle-figures --plot FILE`: the plate with and without idle word, the sound of ramps."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from controller.device.board.board import Board
from controller.workshop.benchmark.device.idle import NOTHING, RAMPS_MS, first_order_bits, ramp_samples, ramp_words
from controller.workshop.benchmark.focus.focus_figures import emit, idling_low, random_points
from controller.workshop.gateware.model.pins import ramp_bits
from controller.workshop.physics.audible import AUDIBLE_HZ, surface_spectrum
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.pictures.figure_file import save_figure
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel

Floats = NDArray[np.float64]
Responses = NDArray[np.floating[Any]]

MAP_STEP_M = 0.5e-3
BAND_HZ = 500.0  # over which the spectra are averaged
SHOWN_UM = 1.0
FIRST_ORDER_MS = 50.0


def plot_idle(path: Path, board: Board, figures: dict[str, Any]) -> None:
    """Draw a board's `idle_figures` to a .png, .svg or .pdf file; raises ConfigError if the file cannot be written."""
    x_m, y_m = random_points(board, figures["seed"], 1, board.plate.width_m / 3)[0].tolist()  # away from patches and edges
    drive_order = ResponseModel(board).drive_order_responses([(x_m, y_m)], dtype=np.float64)
    figure = Figure(figsize=(11, 8.5), layout="constrained")
    (left, right), (spectrum, ramps) = figure.subplots(2, 2)
    _draw_maps(figure, (left, right), board, drive_order, figures)
    _draw_spectra(spectrum, board, drive_order, figures)
    _draw_ramps(ramps, figures)
    save_figure(figure, path, 110)


def _draw_maps(figure: Figure, pair: tuple[Axes, Axes], board: Board, drive_order: Responses, figures: dict[str, Any]) -> None:
    """The plate at T of a focus: left with the board's idle word, right with all channels idle low."""
    left, right = pair
    for axes, idling, name in ((left, board, "idle_word"), (right, idling_low(board), "all_low")):
        x, y, u = emit(PlateTwin(idling), focus(drive_order, [1.0], idling.idle_word)).map(MAP_STEP_M)
        picture = axes.pcolormesh(
            x * 1e3, y * 1e3, u * 1e6, cmap="RdBu_r", vmin=-SHOWN_UM, vmax=SHOWN_UM, shading="nearest", rasterized=True
        )
        contrast = figures["contrast"][name]["median"]
        axes.set(
            aspect="equal", title=f"idle word {idling.idle_word:#010x}: contrast {contrast:.1f} (median of {figures['points']})"
        )
        axes.set(xlabel="x (mm)", ylabel="y (mm)")
    figure.colorbar(picture, ax=(left, right), label="displacement at T (µm), clipped", shrink=0.8)


def _draw_spectra(axes: Axes, board: Board, drive_order: Responses, figures: dict[str, Any]) -> None:
    """Audible spectra of an emission and of three ways to arm."""
    idle = board.idle_word
    own = ramp_samples(board, figures["ramp_ms"])
    slow = ramp_words(board, first_order_bits(ramp_samples(board, FIRST_ORDER_MS)))
    for words, before, label in (
        (focus(drive_order, [1.0], idle), idle, "one emission and the return to idle"),
        (NOTHING, 0, "arming at once"),
        (slow, 0, f"arming, first order, {FIRST_ORDER_MS:g} ms"),
        (ramp_words(board, ramp_bits(own, up=True)), 0, f"arming, second order, {figures['ramp_ms']:g} ms"),
    ):
        frequency, density = _in_bands(*surface_spectrum(board, words, idle, before_word=before)[:2])
        level = 10 * np.log10(density * AUDIBLE_HZ / figures["emission_m2_per_s"])
        axes.plot(frequency * 1e-3, level, label=label)
    axes.set(xlabel="frequency (kHz)", ylabel="density × 16 kHz (dB of an emission's energy)", xlim=(0, AUDIBLE_HZ * 1e-3))
    axes.set(ylim=(-60, 15), title="what can be heard")
    axes.legend(loc="lower right", fontsize=8)


def _draw_ramps(axes: Axes, figures: dict[str, Any]) -> None:
    """Audible energy of arming against the duration of the ramp."""
    for key, style in (("second_order", "o-"), ("first_order", "s--")):
        levels = [figures["arming_db"][key][f"{ms:g}_ms"] for ms in RAMPS_MS]
        axes.semilogx(RAMPS_MS, levels, style, label=f"density of {key.replace('_', ' ')}")
    for level, label, colour in (
        (0.0, "emission", "C0"),
        (figures["arming_db"]["instant"], "at once", "C1"),
        (figures["return_db"]["idle_word"]["median"], "return to idle after an emission", "C4"),
    ):
        axes.axhline(level, color=colour, ls=":", label=f"{label}: {level:.1f} dB")
    axes.plot([figures["ramp_ms"]], [figures["arming_db"]["own_ramp"]], "k*", ms=14, label="this board's ramp")
    axes.set(xlabel="duration of the ramp (ms)", ylabel="energy below 16 kHz (dB of an emission's)", title="arming")
    axes.set_xticks(RAMPS_MS, [f"{ms:g}" for ms in RAMPS_MS])
    axes.set_ylim(-25, 10)
    axes.legend(loc="upper left", fontsize=8)


def _in_bands(frequency: Floats, density: Floats) -> tuple[Floats, Floats]:
    """Centre frequencies of bands of `BAND_HZ`, and the mean density in each."""
    band = (frequency / BAND_HZ).astype(np.int64)
    count = np.bincount(band)
    middle: Floats = (np.arange(len(count), dtype=np.float64) + 0.5) * BAND_HZ
    return middle, np.bincount(band, density) / count
