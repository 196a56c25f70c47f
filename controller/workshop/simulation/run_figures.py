"""Figures of a simulated run, ready for JSON: emissions, latencies, and the foci at the fingers' true places."""

from collections.abc import Callable, Iterable
from dataclasses import asdict
from typing import Any

import numpy as np

from controller.device.service.unfelt import left_out, unfelt
from controller.device.touch.reports import describe_warnings, off_plate_warning
from controller.metrics import STAGES, Counters
from controller.workshop.physics.felt import felt_amplitudes_um
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.simulation.focus_evaluation import Focus
from controller.workshop.simulation.simulated_run import Run

MOST_MODES = 10_000  # with which what is felt takes half a second
# Host latency from which figures of foci are not those of the panel: a finger moves by a third of a spot meanwhile.
SPOILED_S = 10e-3
COUNTED = (  # by the loop, as `Counters` has it
    *("uploads", "resident", "heartbeats", "host_silent", "scheduled", "late", "due", "foci", "composed_beforehand"),
    *("kept_still", "prefetched", "prefetch_wasted", "near", "outages"),
)


def report(run: Run, foci: list[Focus]) -> dict[str, Any]:
    """Collect all figures of a run and its `foci`, ready for JSON; units are in the names."""
    counts = run.source.counts
    counters = run.counters
    latency = {
        stage: {
            "uploads": getattr(counters.upload_latency, stage).summary_us(),
            "resident": getattr(counters.resident_latency, stage).summary_us(),
        }
        for stage in STAGES
    }
    tracked = [focus for focus in foci if focus.emission.finger is not None]
    warnings = describe_warnings(run.source.warnings)
    if off := off_plate_warning(counts.points, counts.off_plate):
        warnings.append(off)
    return {
        "board": run.board.name,
        "plate": run.plate.name,
        "recording": {
            "file": run.recording.name,
            "reports": counts.reports,
            "contacts": counts.contacts,
            "max_fingers": counts.max_fingers,
        },
        "warnings": [f"{run.recording.name}: {warning}" for warning in warnings]
        + ([f"{counters.skipped.bad_entries} × no emission: {counters.bad_entry}"] if counters.bad_entry else []),
        "emissions": int(run.capture.focus_ticks.size),
        "triggers": counters.emissions,
        **{name: getattr(counters, name) for name in COUNTED},
        "outputs_off": not (run.capture.hv[-1:].any() or run.capture.words[-1:].any()),
        "bytes_sent": run.link.bytes_sent,
        "gateware_speed": round(run.link.speed, 3),  # times real time
        "link_counts": asdict(counters.link),
        "skipped": asdict(counters.skipped),
        "touch": run.touch,
        "positions": {"reported": counts.points, "off_plate": counts.off_plate},
        "unfelt": unfelt(counts.points, counts.refused, counters.foci, left_out(counters.skipped)),
        "response_section_mapped": run.response_mapped,
        "latency_us": latency,
        "reference_us": {"copy_and_crc32_of_one_waveform": run.reference.summary_us()},
        "drift": _drift(run),
        "spoiled": spoiled(counters, real_time=run.real_time),
        "focus": _figures(tracked) | {"felt_light_touch_um": _felt_um(run, tracked)},
        "together": _together(tracked),
        "fixed_emitters": _figures([focus for focus in foci if focus.emission.finger is None]),
    }


def _drift(run: Run) -> dict[str, Any] | None:
    """How the plate's frequencies drifted, and what the bit clock made of it; None without a drift."""
    if run.drift is None:
        return None
    bit_clock, percent = run.bit_clock, 100 * run.drift.drift
    return {
        "least_percent": float(percent.min()),
        "most_percent": float(percent.max()),
        "corrected": bit_clock is not None,
        "bit_clock_scale": 1.0 if bit_clock is None else bit_clock.scale,
        "bit_clock_step_ppm": 1e6 / run.board.bit_period,
        "sensor_c": None if bit_clock is None else bit_clock.temperature_c,
    }


def spoiled(counters: Counters, *, real_time: bool) -> str:
    """Explain why the figures of the foci are those of a busy machine and not of the panel.

    Empty: the figures are those of the panel. In virtual time a busy machine changes nothing.
    """
    if not real_time:
        return ""
    stages = (counters.report_latency, counters.upload_latency.host, counters.resident_latency.host)
    late_s = max(stage.worst_ns for stage in stages) * 1e-9
    advice = "end other work, or replay with --speed max"
    if counters.host_silent:
        return (
            f"this machine was busy: the host stopped its heartbeat ({counters.host_silent} ×) and the FPGA switched off; {advice}"
        )
    if late_s > SPOILED_S:
        return f"this machine was busy: the host was late by {late_s * 1e3:.0f} ms, and fingers had moved on; {advice}"
    return ""


def _figures(foci: list[Focus]) -> dict[str, Any]:
    """Median and worst of every figure; None for each if there is no focus."""
    columns: dict[str, tuple[list[float], Callable[[list[float]], float]]] = {
        "relative_amplitude": ([f.relative_amplitude for f in foci], min),
        "exact_share": ([f.exact_share for f in foci], min),
        "amplitude_um": ([abs(f.metrics.amplitude_m) * 1e6 for f in foci], min),
        "contrast": ([f.metrics.contrast for f in foci], min),
        "contrast_all": ([f.metrics.contrast_all for f in foci], min),
        "spot_mm": ([f.metrics.spot_m * 1e3 for f in foci], max),
        "spot_wavelengths": ([f.metrics.spot_wavelengths for f in foci], max),
        "distance_mm": ([f.distance_m * 1e3 for f in foci], max),
    }
    return {"count": len(foci)} | {name: _median_and(worst, values) for name, (values, worst) in columns.items()}


def _felt_um(run: Run, tracked: list[Focus]) -> float | None:
    """What a light touch feels (`physics.felt`) of the pulse with the median `exact_share`, with all its fingers on the plate.

    None without one, on a plate that drifts, and where this would take seconds.
    """
    known = sorted((focus for focus in tracked if np.isfinite(focus.exact_share)), key=lambda focus: focus.exact_share)
    if not known or run.drift is not None or (modes := modes_of(run.plate)).count > MOST_MODES:
        return None
    median, board = known[len(known) // 2], run.plate
    tick = min(run.capture.focus_ticks.tolist(), key=lambda tick: abs(run.link.time_s(tick) - run.start_s - median.time_s))
    starts = tick - np.arange(board.waveform.samples, 0, -1) * board.bit_ticks
    words = run.capture.words[np.searchsorted(run.capture.ticks, starts, "right") - 1]
    together = [focus for focus in tracked if focus.time_s == median.time_s]
    felt_um = felt_amplitudes_um(board, modes, words, [(focus.x_m, focus.y_m) for focus in together])
    return float(felt_um[together.index(median)])


def _together(tracked: list[Focus]) -> list[dict[str, Any]]:
    """Figures by number of fingers in an emission: `exact_share` of its worst finger, and all distances."""
    moments: dict[float, list[Focus]] = {}
    for focus in tracked:
        moments.setdefault(focus.time_s, []).append(focus)
    rows = []
    for fingers in sorted({len(foci) for foci in moments.values()}):
        served = [foci for foci in moments.values() if len(foci) == fingers]
        weakest = [min(_known(focus.exact_share for focus in foci), default=np.nan) for foci in served]
        distances_mm = [focus.distance_m * 1e3 for foci in served for focus in foci]
        row = {"fingers": fingers, "emissions": len(served)}
        rows.append(row | {"worst_finger_exact_share": _median_and(min, weakest), "distance_mm": _median_and(max, distances_mm)})
    return rows


def _median_and(worst: Callable[[list[float]], float], all_values: list[float]) -> dict[str, float | None]:
    values = _known(all_values)
    if not values:
        return {"median": None, "worst": None}
    return {"median": round(float(np.median(values)), 4), "worst": round(worst(values), 4)}


def _known(values: Iterable[float]) -> list[float]:
    """Finite values only: at the plate's rim the reference amplitude is 0."""
    return [value for value in values if np.isfinite(value)]
