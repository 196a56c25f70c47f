"""Rows of foci: one (paper, section IV-B, figs. 6 and 7), several (fig. 9), and repeated ones (appendix A)."""

import tempfile
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from controller.arrays import Floats
from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.device_composition import DeviceComposition
from controller.workshop.bank_builder.request import BankRequest, cells_around
from controller.workshop.benchmark.focus.focus_emission import field_of_pulse, pulse_s
from controller.workshop.benchmark.focus.focus_figures import SETTLED, SQUARE_M, emit, idling_low
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.design import design
from controller.workshop.physics.field import Field, half_width
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.word_capture import capture_of_words

Figures = dict[str, Any]

HALF_POWER = 0.5**0.5
REPETITIONS = 20
PAPER_PERIOD_MS = 2.0
SHORT_MS = (0.5, 1.0, 1.5)  # durations and periods of faster repetition: emissions do not overlap
LONG_MS = (2.5, 3.0, 4.0)  # periods of slower repetition


def focus_rows(panel: PaperPanel) -> list[Row]:
    """Rows of single foci."""
    evaluated = [field.focus_metrics(*point) for field, point in zip(panel.fields, panel.points_m.tolist(), strict=True)]
    lasting = [pulse_s(field_of_pulse(emission), *emission.points_m[0]) for emission in panel.emissions]
    narrow = [spot_m(field, point, HALF_POWER) for field, point in zip(panel.fields, panel.points_m.tolist(), strict=True)]
    return rows(
        {
            "amplitude_um": panel.amplitudes_m * 1e6,
            "spot_half_mm": [one.spot_m * 1e3 for one in evaluated],
            "spot_3db_mm": np.array(narrow) * 1e3,
            "contrast": [one.contrast for one in evaluated],
            "contrast_all": [one.contrast_all for one in evaluated],
            "duration_us": np.array(lasting) * 1e6,
            "contrast_idle_low": idle_low_contrasts(panel),
        }
    )


def idle_low_contrasts(panel: PaperPanel) -> list[float]:
    """Contrast of each focus if every channel rests at 0 V instead of half of each disc's quadrants high."""
    low = idling_low(panel.board)
    twin = PlateTwin(low)
    return [
        emit(twin, focus(response[None], [1.0], low.idle_word)).focus_metrics(*point).contrast
        for response, point in zip(panel.in_band, panel.points_m.tolist(), strict=True)
    ]


def spot_m(field: Field, point_m: tuple[float, float], height: float) -> float:
    """Full width in m of a spot at a share of its crest's height, mean over x, y and diagonals; at 0.5 `FocusMetrics.spot_m`."""
    x_m, y_m = field.crest(*point_m)
    line_m = field.scale.line_m
    found = []
    for dx, dy in ((1.0, 0.0), (0.0, 1.0), (0.5**0.5, 0.5**0.5), (0.5**0.5, -(0.5**0.5))):
        line = field.at(np.column_stack([x_m + dx * line_m, y_m + dy * line_m]))
        crest_m = float(line[len(line) // 2])
        lowered = (line - (2 * height - 1) * crest_m) * np.sign(crest_m)  # its half is the `height` of the crest
        found.append(half_width(lowered, line_m))
    return float(np.mean(found))


def longer_emission_amplitudes(panel: PaperPanel, longest_s: float) -> dict[str, list[float]]:
    """Amplitude over the duration T: 1-bit drive and linear time reversal of the same largest voltage, median of the foci.

    `duration_ms`; `one_bit_um` and `linear_um`, in the band; `one_bit_law` and `linear_law`: 1 - exp(-T / tau) and 1 - exp(-2 T /
    tau), scaled to the longest T.
    """
    period_s = panel.board.waveform.bit_period_s
    samples = round(longest_s / period_s)
    found = panel.band_responses(panel.points_m, period_s, samples)
    one_bit = np.median(np.cumsum(np.abs(found).sum(axis=2), axis=1), axis=0) * panel.half_supply_v
    largest = np.abs(found).max(axis=(1, 2))[:, None]
    linear = np.median(np.cumsum((found**2).sum(axis=2), axis=1) / largest, axis=0) * panel.half_supply_v
    duration_s = (np.arange(samples) + 1) * period_s
    tau_s = panel.board.plate.decay_time_s
    one_law = np.array([design.one_bit_share(t, tau_s) for t in duration_s])
    linear_law = np.array([design.linear_share(t, tau_s) for t in duration_s])
    return {
        "duration_ms": (duration_s * 1e3).tolist(),
        "one_bit_um": (one_bit * 1e6).tolist(),
        "linear_um": (linear * 1e6).tolist(),
        "one_bit_law_um": (one_law * one_bit[-1] / one_law[-1] * 1e6).tolist(),
        "linear_law_um": (linear_law * linear[-1] / linear_law[-1] * 1e6).tolist(),
    }


def duration_rows(curves: dict[str, list[float]]) -> list[Row]:
    """Rows of `longer_emission_amplitudes`: T = 2 ms over endless."""
    at = int(np.searchsorted(curves["duration_ms"], 2.0 - 1e-9))
    over = {name: values[at] / values[-1] for name, values in curves.items()}
    kinds = ("one_bit", "linear")
    return rows(
        {f"duration_{kind}": over[f"{kind}_um"] for kind in kinds}, {f"duration_{kind}": over[f"{kind}_law_um"] for kind in kinds}
    )


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
        places_m = np.concatenate([corners_m(centre) for centre in centres]).tolist()
        cells = cells_around(Grid.of(panel.board.plate, pitch_m), places_m)
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
