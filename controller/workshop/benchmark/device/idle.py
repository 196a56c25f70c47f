"""Figures under "Idle word and ramp": contrast with and without an idle word, and the sound of arming and disarming.

`haptic-panel focus --idle-figures` makes them. Audible energies (`audible.surface_energy`) are in dB relative to the median
single emission from the board's idle word. The ramp's bits are those of the gateware model; the two references, a step and
a first-order density, are made here. `--plot` draws the plate with and without idle word, and the sound of ramps.
"""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.arrays import Bools, Floats, Reals
from controller.device.board.board import Board
from controller.workshop.benchmark.focus.focus_figures import emit, idling_low, random_points, spread
from controller.workshop.benchmark.focus.sound_figures import ramp_samples, ramp_words
from controller.workshop.gateware.model.pins import ramp_bits
from controller.workshop.physics.audible import AUDIBLE_HZ, surface_energy, surface_spectrum
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.pictures.figure_file import save_figure
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel

RAMPS_MS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
NOTHING = np.zeros(0, np.uint32)
MAP_STEP_M = 0.5e-3
BAND_HZ = 500.0  # over which the spectra are averaged
SHOWN_UM = 1.0
FIRST_ORDER_MS = 50.0


def idle_figures(board: Board, seed: int = 1, points: int = 20) -> dict[str, Any]:
    """Evaluate a board's idle word and ramp over random points at least 10 mm from the edges; none is left out.

    `contrast`, `amplitude_um`: with the idle word and with all channels idle low. `emission_m2_per_s`: audible energy of the median
    emission. `emission_db`: energy of each emission including its return to the idle word; `return_db`: of that return alone.
    `arming_db`, `disarming_db`: of the board's own ramp, of a step and of other ramps.
    """
    with threadpool_limits(1, "blas"):
        model = ResponseModel(board)
        twins = {"idle_word": PlateTwin(board), "all_low": PlateTwin(idling_low(board))}
        places = tqdm(random_points(board, seed, points).tolist(), desc="idle word", unit="point", disable=None, delay=2)
        rows = [_of_point(board, model, twins, x_m, y_m) for x_m, y_m in places]
        emission = float(np.median([row["emission.idle_word"] for row in rows]))

        def of_points(what: str, scale: Callable[[float], float] = float) -> dict[str, dict[str, float]]:
            return {name: spread([scale(row[f"{what}.{name}"]) for row in rows]) for name in twins}

        def decibels(energy: float) -> float:
            return 10 * float(np.log10(energy / emission))

        return {
            "board": board.name,
            "seed": seed,
            "points": points,
            "ramp_ms": board.limits.ramp_ms,
            "contrast": of_points("contrast"),
            "amplitude_um": of_points("amplitude_um"),
            "emission_m2_per_s": emission,
            "emission_db": of_points("emission", decibels),
            "return_db": of_points("return", decibels),
            **_of_ramps(board, decibels),
        }


def _of_point(board: Board, model: ResponseModel, twins: Mapping[str, PlateTwin], x_m: float, y_m: float) -> dict[str, float]:
    """Contrast, amplitude and audible energies of a focus at a point, for the idle word of each twin."""
    drive_order = model.drive_order_responses([(x_m, y_m)], dtype=np.float64)
    row: dict[str, float] = {}
    for name, twin in twins.items():
        idle = twin.board.idle_word
        words = focus(drive_order, [1.0], idle)
        evaluated = emit(twin, words).focus_metrics(x_m, y_m)
        row[f"contrast.{name}"] = evaluated.contrast
        row[f"amplitude_um.{name}"] = evaluated.amplitude_m * 1e6
        row[f"emission.{name}"] = surface_energy(board, words, idle)
        row[f"return.{name}"] = surface_energy(board, NOTHING, idle, before_word=int(words[-1]))
    return row


def _of_ramps(board: Board, decibels: Callable[[float], float]) -> dict[str, Any]:
    """Audible energy of arming and disarming, with the board's own ramp and with others."""

    def arming(bits: Bools) -> float:
        return decibels(surface_energy(board, ramp_words(board, bits), board.idle_word, before_word=0))

    own = ramp_samples(board, board.limits.ramp_ms)
    leaving = ramp_words(board, ramp_bits(own, up=False))
    return {
        "arming_db": {
            "own_ramp": arming(ramp_bits(own, up=True)),
            "instant": arming(np.zeros(0, np.bool_)),
            "second_order": {f"{ms:g}_ms": arming(ramp_bits(ramp_samples(board, ms), up=True)) for ms in RAMPS_MS},
            "first_order": {f"{ms:g}_ms": arming(first_order_bits(ramp_samples(board, ms))) for ms in RAMPS_MS},
        },
        "disarming_db": {
            "own_ramp": decibels(surface_energy(board, leaving, 0, before_word=board.idle_word)),
            "instant": decibels(surface_energy(board, NOTHING, 0, before_word=board.idle_word)),
        },
    }


def first_order_bits(samples: int) -> Bools:
    """First-order density of a linear ramp, (sample,) bits: high whenever the accumulated level passes a whole number."""
    return np.diff(np.cumsum(np.arange(1, samples + 1)) // samples, prepend=0) > 0


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


def _draw_maps(figure: Figure, pair: tuple[Axes, Axes], board: Board, drive_order: Reals, figures: dict[str, Any]) -> None:
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


def _draw_spectra(axes: Axes, board: Board, drive_order: Reals, figures: dict[str, Any]) -> None:
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
