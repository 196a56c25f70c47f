"""Rows of several foci and of repetition (paper, fig. 9 and appendix A)."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.device_composition import DeviceComposition
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.benchmark.focus.focus_figures import SETTLED, SQUARE_M, emit
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.design import design
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.word_capture import capture_of_words

Floats = NDArray[np.float64]
Figures = dict[str, Any]

REPETITIONS = 20
PAPER_PERIOD_MS = 2.0
SHORT_MS = (0.5, 1.0, 1.5)  # durations and periods of faster repetition: emissions do not overlap
LONG_MS = (2.5, 3.0, 4.0)  # periods of slower repetition


def corners_m(centre_m: Floats) -> Floats:
    """Four foci 10 mm apart round a centre: (4, 2)."""
    return centre_m + SQUARE_M / 2 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])


def four_foci_rows(panel: PaperPanel) -> list[Row]:
    """Rows of four foci at once: plain sum, then sign, as in the paper, and the device's composition from a bank."""
    centres = panel.points_m
    plain, spots, devices = [], [], []
    twin = panel.twin
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bank"
        pitch_m = panel.board.bank.pitch_mm * 1e-3
        grid = Grid.of(panel.board.plate, pitch_m)
        cells = np.zeros(grid.cells, bool)
        for x_m, y_m in np.concatenate([corners_m(centre) for centre in centres]).tolist():
            cells[list(grid.corners(x_m, y_m)[0])] = True
        build_bank(BankRequest(panel.board, path, pitch_m, cells))
        with Bank.open(path, panel.board) as bank:
            composer = DeviceComposition(panel.board, bank)
            for centre in centres:
                corners = corners_m(centre)
                alone = np.array([twin.reference_amplitude(*corner) for corner in corners.tolist()])
                responses = twin.responses.drive_order_responses(corners, dtype=np.float64)
                field = emit(twin, focus(responses, [1.0] * 4, panel.board.idle_word))
                plain.append(field.at(corners) / alone)
                foci = [(x_m, y_m) for x_m, y_m in corners.tolist()]
                spots += [field.focus_metrics(*corner, foci).spot_m * 1e3 for corner in foci]
                words = composer.design([(x_m, y_m, 1.0) for x_m, y_m in foci]).words
                devices.append(np.abs(emit(twin, words).at(corners)) / alone)
    worst = np.min(devices, axis=1) / np.min(plain, axis=1)
    return rows({"four_plain": plain, "four_device": devices, "four_device_worst": worst, "four_spot_mm": spots})


def repetition_rows(panel: PaperPanel, count: int, curve: Figures) -> list[Row]:
    """Rows of 20 repetitions at 500 Hz, of the first `count` foci, and of those at Tr = tau, of `repetition_curve`."""
    found = np.array([_contrasts(panel.twin, panel, index, PAPER_PERIOD_MS) for index in range(count)])
    return rows(
        {
            "repetition": found[:, 0, -1] / found[:, 0, 0],
            "repetition_tau": curve["contrast_kept"][curve["period_ms"].index(1.0)],
            "repetition_amplitude": found[:, 1, -1] / found[:, 1, 0],
        },
        {"repetition": design.repetition_factor(PAPER_PERIOD_MS * 1e-3, panel.board.plate.decay_time_s)},
    )


def repetition_curve(panel: PaperPanel, count: int) -> Figures:
    """Contrast kept over the period Tr, appendix A beside it: medians of the first `count` foci."""
    found_rows = []
    tau_s = panel.board.plate.decay_time_s
    for period_ms in (*SHORT_MS, PAPER_PERIOD_MS, *LONG_MS):
        duration_ms = min(period_ms, panel.board.waveform.duration_ms)
        waveform = msgspec.structs.replace(panel.board.waveform, duration_ms=duration_ms)
        twin = PlateTwin(msgspec.structs.replace(panel.board, waveform=waveform))
        found = np.array([_contrasts(twin, panel, index, period_ms) for index in range(count)])
        law = design.repetition_factor(period_ms * 1e-3, tau_s)
        found_rows.append((period_ms, float(np.median(found[:, 0, -1] / found[:, 0, 0])), law))
    period_ms_, kept, laws = (list(column) for column in zip(*found_rows, strict=True))
    return {"period_ms": period_ms_, "contrast_kept": kept, "appendix_a": laws}


def _contrasts(twin: PlateTwin, panel: PaperPanel, index: int, period_ms: float) -> Floats:
    """Contrast, amplitude at the first and last focus time of a series: (2, 2). Shorter emissions play the end of the words."""
    board = twin.board
    words = panel.words[index][-board.waveform.samples :]
    clock_hz = board.bit_ticks * board.waveform.bit_clock_hz
    settled = round(SETTLED / float(np.min(-twin.step.poles.real)) * clock_hz)
    period = round(period_ms * 1e-3 * clock_hz)
    capture = capture_of_words(words, board.bit_ticks, board.idle_word, settled, period, REPETITIONS)
    x_m, y_m = panel.points_m[index].tolist()
    fields = list(twin.fields(capture, clock_hz))
    evaluated = [field.focus_metrics(x_m, y_m) for field in (fields[0], fields[-1])]
    return np.array([[one.contrast for one in evaluated], [one.amplitude_m for one in evaluated]])


def four_foci_maps(panel: PaperPanel) -> Figures:
    """One focus and four, on lines and on a square of 40 mm, for the picture (figs. 6 and 9), in µm."""
    centre = np.array([panel.board.plate.length_m, panel.board.plate.width_m]) * np.array([0.55, 0.45])
    twin = panel.twin
    one = emit(twin, focus(twin.responses.drive_order_responses(centre[None], dtype=np.float64), [1.0], panel.board.idle_word))
    corners = corners_m(centre)
    four = emit(twin, focus(twin.responses.drive_order_responses(corners, dtype=np.float64), [1.0] * 4, panel.board.idle_word))
    along_m = np.linspace(0, panel.board.plate.length_m, 841)
    square_m = np.linspace(-20e-3, 20e-3, 81)
    return {
        "x_mm": (along_m * 1e3).tolist(),
        "one_um": (one.at(np.column_stack([along_m, np.full_like(along_m, centre[1])])) * 1e6).tolist(),
        "square_mm": (square_m * 1e3).tolist(),
        "four_um": (panel.modes.on_grid(four.modal, centre[0] + square_m, centre[1] + square_m) * 1e6).tolist(),
    }
