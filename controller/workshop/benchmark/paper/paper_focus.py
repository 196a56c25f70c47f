"""Rows of one focus (paper, section IV-B, figs. 6 and 7): amplitude, spot, contrast, duration, and the idle word's worth."""

from __future__ import annotations

import numpy as np

from controller.workshop.benchmark.focus.focus_emission import field_of_pulse, pulse_s
from controller.workshop.benchmark.focus.focus_figures import emit, idling_low
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row, rows
from controller.workshop.physics.design import design
from controller.workshop.physics.field import Field, half_width
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.plate_twin import PlateTwin

HALF_POWER = 0.5**0.5


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
