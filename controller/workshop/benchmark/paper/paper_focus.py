"""Rows of one focus (paper, section IV-B, figs. 6 and 7): amplitude, spot, contrast, duration, and the idle word's worth."""

from __future__ import annotations

import numpy as np

from controller.workshop.benchmark.focus.focus_emission import field_of_pulse, pulse_s
from controller.workshop.benchmark.focus.focus_figures import emit, idling_low
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.benchmark.paper.paper_row import Row
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
    return [
        Row.of(
            "amplitude_um",
            "amplitude (µm)",
            7.68,
            panel.amplitudes_m * 1e6,
            "the piezo constant is fitted to this one figure: the median says nothing, the spread does",
        ),
        Row.of(
            "spot_half_mm",
            "spot, full width at half height (mm)",
            5.2,
            [one.spot_m * 1e3 for one in evaluated],
            "the paper does not say at which height; patches and drivers favour the lower band, so wider than λ/2",
        ),
        Row.of("spot_3db_mm", "spot, full width at −3 dB (mm)", 5.2, np.array(narrow) * 1e3, "the same spots, higher up"),
        Row.of(
            "contrast",
            "contrast, rms outside 10 mm",
            29.0,
            [one.contrast for one in evaluated],
            "the paper does not say over which points; its 29 is this one's size",
        ),
        Row.of(
            "contrast_all",
            "contrast, rms over all points",
            24.0,
            [one.contrast_all for one in evaluated],
            "what eq. (1) is about; the band is weighted by patches and drivers, so fewer modes count",
        ),
        Row.of(
            "duration_us",
            "duration of the focus at half height (µs)",
            7.0,
            np.array(lasting) * 1e6,
            "eq. (4) is half a period of the highest frequency; the band's middle is lower",
        ),
        idle_row(panel),
    ]


def idle_row(panel: PaperPanel) -> Row:
    """Contrast if every channel rests at 0 V instead of half of each disc's quadrants high."""
    low = idling_low(panel.board)
    twin = PlateTwin(low)
    found = []
    for response, point in zip(panel.in_band, panel.points_m.tolist(), strict=True):
        found.append(emit(twin, focus(response[None], [1.0], low.idle_word)).focus_metrics(*point).contrast)
    why = "0–60 V from rest at 0 V is a step of 30 V on all channels: 29 needs levels that idle in the middle, as ours do"
    return Row.of("contrast_idle_low", "contrast of a single emission from 0 V, outside 10 mm", 29.0, found, why)


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
    rows = []
    for kind, name, law in (("one_bit", "1-bit drive", "1 − e^(−T/τ)"), ("linear", "linear time reversal", "1 − e^(−2T/τ)")):
        grown = curves[f"{kind}_um"][at] / curves[f"{kind}_um"][-1]
        expected = curves[f"{kind}_law_um"][at] / curves[f"{kind}_law_um"][-1]
        why = f"{law}; the paper's law is that of linear time reversal" if kind == "one_bit" else f"{law}, section III-B"
        rows.append(Row.of(f"duration_{kind}", f"amplitude at T = 2 ms over that at 4 ms, {name}", expected, grown, why))
    return rows
