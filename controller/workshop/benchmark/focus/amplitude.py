"""Figures under "Amplitude": amplitudes reached on the plate by composing from a bank.

`haptic-panel focus --amplitude-figures` makes them: requested against reached amplitude, places between cells, edges. What fingers
get is what the device plays for them, with places and amplitudes rounded as it rounds them; the reference is the whole displacement
in float64, with all modes, at the very points, and does not use the bank.
"""

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from threadpoolctl import threadpool_limits

from controller.arrays import Floats, Words
from controller.device.bank.grid import Grid
from controller.device.bank.packing import WORD, edges
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.fpga.frames import ReadyFrames
from controller.device.waveforms.selection import REUSE_RADIUS_M, Selection
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.design import DesignMethod
from controller.workshop.bank_builder.methods.device_composition import DeviceComposition
from controller.workshop.bank_builder.request import BankRequest, cells_around
from controller.workshop.benchmark.focus.focus_figures import emit, random_points, spread
from controller.workshop.physics.pictures.figure_file import save_figure
from controller.workshop.physics.plate import wave_scale
from controller.workshop.physics.plate_twin import PlateTwin

Figures = dict[str, Any]
Scene = list[tuple[float, float, float]]  # x_m, y_m, amplitude of each finger

# On the paper's plate; on others they go with the length of its waves
MARGIN_M = 12e-3  # distance of fingers from the plate's edges
SEPARATION_M = 8e-3  # smallest distance between two fingers
FINGERS = (1, 2, 3, 4, 6, 8, 10)
AMPLITUDES = (MIN_AMPLITUDE, 0.25, 0.5, 0.75, 1.0)


def amplitude_figures(board: Board, seed: int, scenes: int = 20, pitch_m: float | None = None) -> Figures:
    """Evaluate random scenes of 1 to 10 fingers, this many of each number, and as many single points; none is left out.

    The bank, of the board's own pitch by default, holds only the cells needed here. `fingers`: for each number of fingers, `asked`
    and `got`, as shares of what exact composition gives each finger at full amplitude, and `error_percent`, where each finger asks
    for an amplitude of its own, and where all ask for the same. `single`: for each
    amplitude, contrast and spot relative to full amplitude, and edges. `between_cells`: relative amplitude when interpolated and
    from the nearest entry, and `REUSE_RADIUS_M` beside the point.
    """
    random = np.random.default_rng(seed)
    played = [[_scene(board, random, fingers) for _ in range(scenes)] for fingers in FINGERS]
    singles = random_points(board, seed, scenes)
    around = random.uniform(0, 2 * np.pi, scenes)
    reuse_m = REUSE_RADIUS_M * wave_scale(board)
    beside = singles + reuse_m * np.column_stack([np.cos(around), np.sin(around)])
    places = np.concatenate([np.array(scene)[:, :2] for some in played for scene in some] + [singles, beside])
    with threadpool_limits(1, "blas"), tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bank"
        pitch_m = board.bank.pitch_mm * 1e-3 if pitch_m is None else pitch_m
        build_bank(BankRequest(board, path, pitch_m, cells_around(Grid.of(board.plate, pitch_m), places.tolist())))
        with Bank.open(path, board) as bank:
            composer, twin = DeviceComposition(board, bank), PlateTwin(board)
            selection = Selection(bank, board.bank.snap_mm * 1e-3, board.idle_word)
            return {
                "seed": seed,
                "scenes": scenes,
                "pitch_mm": pitch_m * 1e3,
                "fingers": {str(len(some[0])): _mixed(selection, bank, twin, some) for some in played},
                "single": {f"{amplitude:g}": _single(composer, twin, singles, amplitude) for amplitude in AMPLITUDES},
                "between_cells": _between_cells(bank, composer, twin, singles, beside),
            }


def _scene(board: Board, random: np.random.Generator, fingers: int) -> Scene:
    """(x_m, y_m, amplitude) of fingers at random places, as far apart as there is room for; amplitudes from the least to 1.

    Ascending, as the device has them: of as many points up as down, the first one is up.
    """
    sides, scale = np.array([board.plate.length_m, board.plate.width_m]), wave_scale(board)
    margin = np.minimum(MARGIN_M * scale, 0.4 * sides)
    far = sides - margin
    apart_m = min(SEPARATION_M * scale, 0.2 * float((far - margin).min()))  # ten fingers have room
    while True:
        places = random.uniform(margin, far, (fingers, 2))
        between_m = np.hypot(*(places[:, None] - places).transpose(2, 0, 1)) + np.eye(fingers)
        if between_m.min() >= apart_m:
            return sorted((float(x_m), float(y_m), float(random.uniform(MIN_AMPLITUDE, 1))) for x_m, y_m in places)


def _words(composer: DesignMethod, scene: Scene) -> Words:
    return composer.design(scene).words


def _mixed(selection: Selection, bank: Bank, twin: PlateTwin, scenes: list[Scene]) -> Figures:
    """Requested and reached amplitudes of fingers that are composed together."""
    asked, got = _reached(selection, bank, twin, scenes)
    percent = {"each_its_own": _errors(asked, got)}
    for amplitude in AMPLITUDES:
        alike = [[(x_m, y_m, amplitude) for x_m, y_m, _ in scene] for scene in scenes]
        percent[f"all_{amplitude:g}"] = _errors(*_reached(selection, bank, twin, alike))
    return {"error_percent": percent, "asked": asked, "got": got}


def _reached(selection: Selection, bank: Bank, twin: PlateTwin, scenes: list[Scene]) -> tuple[list[float], list[float]]:
    """What all fingers of some scenes ask for, and what they get by what the device plays."""
    asked: list[float] = []
    got: list[float] = []
    for scene in scenes:
        key, places = selection.key(scene), tuple((x_m, y_m) for x_m, y_m, _ in scene)
        played = bank.drive.words(key) if isinstance(key, int) else selection.waveform(key)
        assert not isinstance(played, ReadyFrames)
        words = np.frombuffer(played, WORD).copy()
        got.extend((np.abs(emit(twin, words).at(places)) / twin.exact_amplitudes(places)).tolist())
        asked.extend(amplitude for _, _, amplitude in scene)
    return asked, got


def _errors(asked: list[float], got: list[float]) -> dict[str, float]:
    error = 100 * np.abs(np.array(got) / asked - 1)
    return {"median": float(np.median(error)), "p95": float(np.quantile(error, 0.95)), "max": float(error.max())}


def _single(composer: DesignMethod, twin: PlateTwin, points: Floats, amplitude: float) -> Figures:
    """One finger: contrast and spot relative to full amplitude; edges, including those from and to the idle word."""
    idle = np.array([twin.board.idle_word], np.uint32)
    contrast, spot, busiest, together = [], [], [], []
    for x_m, y_m in points.tolist():
        words, full = (_words(composer, [(x_m, y_m, share)]) for share in (amplitude, 1.0))
        less, most = (emit(twin, some).focus_metrics(x_m, y_m) for some in (words, full))
        contrast.append(less.contrast / most.contrast)
        spot.append(less.spot_m / most.spot_m)
        counts = edges(np.concatenate([idle, words, idle]))
        busiest.append(float(counts.max()))
        together.append(float(counts.sum()))
    figures = {"contrast_of_full": contrast, "spot_of_full": spot, "edges_busiest_channel": busiest, "edges_all": together}
    return {name: spread(values) for name, values in figures.items()}


def _between_cells(bank: Bank, composer: DesignMethod, twin: PlateTwin, points: Floats, beside: Floats) -> Figures:
    """Relative amplitude at points anywhere between cells, at full amplitude."""
    interpolated, nearest, near = [], [], []
    for (x_m, y_m), (other_x_m, other_y_m) in zip(points.tolist(), beside.tolist(), strict=True):
        reference_m = twin.reference_amplitude(x_m, y_m)
        entry = np.frombuffer(bank.drive.words(bank.grid.nearest(x_m, y_m)[0]), WORD)
        here, cell, there = (
            float(emit(twin, words).at([(x_m, y_m)])[0])
            for words in (_words(composer, [(x_m, y_m, 1.0)]), entry, _words(composer, [(other_x_m, other_y_m, 1.0)]))
        )
        interpolated.append(here / reference_m)
        nearest.append(cell / reference_m)
        near.append(there / here)
    return {
        "interpolated": spread(interpolated),
        "nearest_entry": spread(nearest),
        f"{REUSE_RADIUS_M * 1e3:g}_mm_beside": spread(near),
    }


def plot_amplitude(path: Path, figures: dict[str, Any]) -> None:
    """Draw the figures of `amplitude_figures` to a .png, .svg or .pdf file; raises ConfigError if the file cannot be written."""
    figure = Figure(figsize=(11, 4.5), layout="constrained")
    against, errors, single = figure.subplots(1, 3)
    ends = np.array([0.2, 1.05])
    against.fill_between(ends, 0.95 * ends, 1.05 * ends, color="0.9", label="within 5 %")
    errors.axhspan(-5, 5, color="0.9")
    for (fingers, found), marker in zip(figures["fingers"].items(), "os^vD*.", strict=True):
        asked, got = np.array(found["asked"]), np.array(found["got"])
        label = f"{fingers} finger{'s' * (fingers != '1')}"
        against.plot(asked, got, marker, ms=4, label=label)
        errors.plot(asked, 100 * (got / asked - 1), marker, ms=4, label=label)
    against.set(xlabel="amplitude asked for", ylabel="of what exact composition gives at full", aspect="equal", title="got")
    against.legend(fontsize=8)
    errors.set(xlabel="amplitude asked for", ylabel="error (%)", ylim=(-15, 15), title="error")
    amplitudes = [float(amplitude) for amplitude in figures["single"]]
    for name, label in (
        ("contrast_of_full", "contrast"),
        ("spot_of_full", "spot"),
        ("edges_busiest_channel", "edges, busiest channel"),
        ("edges_all", "edges, all"),
    ):
        rows = np.array([[row[name][kind] for kind in ("min", "median", "max")] for row in figures["single"].values()])
        rows /= rows[-1, 1]
        reach = np.abs(rows[:, [0, 2]] - rows[:, [1]]).T
        single.errorbar(amplitudes, rows[:, 1], reach, fmt="o-", ms=4, capsize=3, label=label)
    single.set(xlabel="amplitude", ylabel="over the median at full amplitude", ylim=(0, None), title="one finger")
    single.legend(fontsize=8)
    save_figure(figure, path, 110)
