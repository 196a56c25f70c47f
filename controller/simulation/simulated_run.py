"""A whole run on a simulated panel: recording, event loop, gateware and plate, and the figures of every focus.

The loop runs first, against the gateware model or the compiled Verilog. The plate twin evaluates the captured channel pins
only afterwards, so that its computing time does not affect latencies. The intended finger and point come from the loop's
record of what it played; the finger's true place at T comes from the recording.
"""

from __future__ import annotations

import contextlib
import time
import zlib
from bisect import bisect_right
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from controller.bank.reader import Bank
from controller.board.board import Board
from controller.clocks import MonotonicClock, VirtualClock
from controller.fpga.capture import Capture
from controller.gateware_model.gateware import GatewareFactory
from controller.gateware_model.model import GatewareModel
from controller.gateware_model.simulated_link import SimulatedLink
from controller.loop.records import Played
from controller.loop.wiring import assemble
from controller.metrics import STAGES, Counters, LatencyHistogram
from controller.physics.field import OUTSIDE_M, Field, FocusMetrics
from controller.physics.plate_twin import PlateTwin
from controller.scene.emission import Emission
from controller.scene.scene import Scene
from controller.service.drivers import open_session, open_simulated, tracked
from controller.touch.recording import Recording, Track
from controller.touch.replay import RecordingSource
from controller.touch.reports import describe_warnings

SETTLE_S = 50e-3  # between arming and the first event of the recording
REAL_SETTLE_S = 0.3  # the same in real time, for a busy machine
REFERENCE_ROUNDS = 2000
SPOILED_S = (
    10e-3  # host latency from which figures of foci are not those of the panel: a finger moves by a third of a spot meanwhile
)
Point = tuple[float, float]


@dataclass(frozen=True)
class Focus:
    """One focus of one emission, evaluated where its finger was at T."""

    time_s: float  # T, in the recording's time
    emission: Emission
    x_m: float  # true place of the finger at T; of an emission without a finger, its own place
    y_m: float
    relative_amplitude: float  # relative to a single focus at this point
    exact_share: float  # relative to exact composition at the fingers' true places, times the amplitude asked for
    metrics: FocusMetrics
    distance_m: float  # from there to the maximum of the spot


@dataclass(frozen=True)
class Judged:
    """Every focus of a run, and the field and foci of the emission chosen for the picture."""

    foci: list[Focus]
    field: Field | None
    shown: list[Focus]
    left_out: int  # emissions not evaluated, because of Ctrl-C or SIGTERM


@dataclass(frozen=True)
class Run:
    """Record of a run. The plate twin sees only `capture`; everything else is for the figures."""

    board: Board
    recording: Recording
    source: RecordingSource
    tracks: dict[int, Track]  # by the loop's finger number: all contacts of that finger joined
    counters: Counters
    capture: Capture
    played: list[Played]
    link: SimulatedLink
    start_s: float
    real_time: bool
    touch: dict[str, Any]  # figures of the tracker
    lookups: int
    response_mapped: bool
    reference: LatencyHistogram


def play(
    board: Board,
    scene: Scene,
    bank: Bank,
    recording: Recording,
    *,
    real_time: bool,
    ready: Callable[[], None] = lambda: None,
    gateware: GatewareFactory = GatewareModel,
) -> Run:
    """Replay a recording through the event loop into the gateware.

    Parameters
    ----------
    board : Board
    scene : Scene
    bank : Bank
        Holds the cells of the scene.
    recording : Recording
        Touches; without any, nothing is played.
    real_time : bool
        False: virtual time, as fast as the machine can and deterministic.
    ready : callable
        Called once the outputs are on.
    gateware : GatewareFactory
        Makes the gateware: the model by default, or the compiled Verilog.

    Returns
    -------
    Run

    Raises
    ------
    FaultError, LinkError
        From the event loop.
    """
    clock = MonotonicClock() if real_time else VirtualClock()
    link = open_simulated(board, clock.now_s, gateware)
    session = open_session(link, board, clock.now_s)
    played: list[Played] = []
    start_s = session.earliest_trigger_s() + board.limits.arming_s + (REAL_SETTLE_S if real_time else SETTLE_S)
    axes = recording.axes(board)
    tracks = recording.tracks(axes)
    if not tracks:  # without any touch nothing is played, spots included
        scene = Scene(())
    source = RecordingSource(recording, axes, start_s)
    contacts = {finger: [track] for finger, track in tracks.items()}
    tracker = tracked(source, board, lambda finger, contact: contacts[finger].append(tracks[contact]))
    assembly = assemble(board, scene, bank, clock, session, tracker, played=played.append)
    assembly.loop.run(ready)
    link.close()
    return Run(
        board=board,
        recording=recording,
        source=source,
        tracks={finger: Track.joined(finger, parts) for finger, parts in contacts.items()},
        counters=assembly.counters,
        capture=link.take_capture(),
        played=played,
        link=link,
        start_s=start_s,
        real_time=real_time,
        touch=tracker.figures(),
        lookups=bank.counters.lookups,
        response_mapped=assembly.selection.composes,
        reference=copy_and_checksum(board.waveform.samples * 4),
    )


def spoiled(counters: Counters, real_time: bool) -> str:
    """Explain why the figures of the foci are those of a busy machine and not of the panel.

    Parameters
    ----------
    counters : Counters
        Of the run.
    real_time : bool
        Whether it ran in real time; in virtual time a busy machine changes nothing.

    Returns
    -------
    str
        Empty: the figures are those of the panel.
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


def copy_and_checksum(size: int) -> LatencyHistogram:
    """Measure one copy and one CRC-32 of `size` bytes, which every upload needs: a lower bound of its host time."""
    histogram = LatencyHistogram()
    source = memoryview(bytes(np.random.default_rng(0).bytes(size)))
    target = memoryview(bytearray(size))
    for _ in range(REFERENCE_ROUNDS):
        started = time.perf_counter_ns()
        target[:] = source
        zlib.crc32(target)
        histogram.record(time.perf_counter_ns() - started)
    return histogram


def judge(run: Run, progress: Callable[[int, int], None] | None = None) -> Judged:
    """Play the captured pins on the plate twin and evaluate every focus where its finger was at T; Ctrl-C ends it early.

    Parameters
    ----------
    run : Run
    progress : callable, optional
        Called with the number of emissions evaluated and of all emissions.

    Returns
    -------
    Judged
    """
    twin = PlateTwin(run.board)
    meant = foci_meant(run)
    judged = Judged([], None, [], len(meant))
    moments = zip(meant, twin.fields(run.capture, run.link.clock_hz), strict=True)
    with contextlib.suppress(KeyboardInterrupt):
        for done, ((tick, emissions), field) in enumerate(moments, 1):
            together = _judge_moment(run, twin, field, run.link.time_s(tick) - run.start_s, emissions)
            better = _worth_showing(together) > _worth_showing(judged.shown)
            shown = (field, together) if better else (judged.field, judged.shown)
            judged.foci.extend(together)
            judged = Judged(judged.foci, *shown, len(meant) - done)
            if progress:
                progress(done, len(meant))
    return judged


def _judge_moment(run: Run, twin: PlateTwin, field: Field, time_s: float, emissions: tuple[Emission, ...]) -> list[Focus]:
    """Evaluate all foci of one emission, each where its finger was."""
    places = [_place(run.tracks, emission, time_s) for emission in emissions]
    exact_m = twin.exact_amplitudes(tuple(places))
    together = []
    for emission, (x_m, y_m), asked_m in zip(emissions, places, exact_m.tolist(), strict=True):
        metrics = field.focus_metrics(x_m, y_m, places)
        crest_x_m, crest_y_m = field.crest(emission.x_m, emission.y_m)
        reference_m = twin.reference_amplitude(x_m, y_m)
        relative = metrics.amplitude_m / reference_m if reference_m else float("nan")
        exact_share = metrics.amplitude_m / (emission.amplitude * asked_m) if asked_m > 0 else float("nan")
        distance_m = float(np.hypot(crest_x_m - x_m, crest_y_m - y_m))
        together.append(Focus(time_s, emission, x_m, y_m, relative, exact_share, metrics, distance_m))
    return together


def foci_meant(run: Run) -> list[tuple[int, tuple[Emission, ...]]]:
    """(tick, emissions) of every focus in the run's capture: the emissions are those of the last start before it."""
    starts_ticks = [run.link.tick(played.trigger_s) if played.at_ticks is None else played.at_ticks for played in run.played]
    most_ticks = round(0.99 * run.board.waveform.duration_s * run.link.clock_hz)
    meant = []
    for tick in run.capture.focus_ticks.tolist():
        meant.append((tick, run.played[bisect_right(starts_ticks, tick - most_ticks) - 1].emissions))
    return meant


def _worth_showing(foci: list[Focus]) -> tuple[int, float]:
    """Rank of an emission for the picture: number of separate fingers, then amplitude of its weakest focus."""
    apart = [
        focus.emission.finger is not None
        and all(np.hypot(focus.x_m - other.x_m, focus.y_m - other.y_m) > OUTSIDE_M for other in foci if other is not focus)
        for focus in foci
    ]
    return sum(apart), min((focus.metrics.amplitude_m for focus in foci), default=0.0)


def _place(tracks: dict[int, Track], emission: Emission, time_s: float) -> Point:
    """True place of the finger at `time_s`; without a finger, the emission's own place."""
    if emission.finger is None:
        return emission.x_m, emission.y_m
    return tracks[emission.finger].position(time_s)


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
    return {
        "board": run.board.name,
        "recording": {
            "file": run.recording.name,
            "reports": counts.reports,
            "contacts": counts.contacts,
            "max_fingers": counts.max_fingers,
        },
        "warnings": [f"{run.recording.name}: {warning}" for warning in describe_warnings(run.source.warnings)]
        + ([f"{counters.skipped.bad_entries} × no emission: {counters.bad_entry}"] if counters.bad_entry else []),
        "emissions": int(run.capture.focus_ticks.size),
        "triggers": counters.emissions,
        "uploads": counters.uploads,
        "resident": counters.resident,
        "heartbeats": counters.heartbeats,
        "host_silent": counters.host_silent,
        "outputs_off": not (run.capture.hv[-1:].any() or run.capture.words[-1:].any()),
        "bytes_sent": run.link.bytes_sent,
        "gateware_speed": round(run.link.speed, 3),  # times real time
        "scheduled": counters.scheduled,
        "late": counters.late,
        "due": counters.due,
        "foci": counters.foci,
        "prefetched": counters.prefetched,
        "prefetch_wasted": counters.prefetch_wasted,
        "near": counters.near,
        "outages": counters.outages,
        "skipped": asdict(counters.skipped),
        "touch": run.touch,
        "response_section_mapped": run.response_mapped,
        "latency_us": latency,
        "reference_us": {"copy_and_crc32_of_one_waveform": run.reference.summary_us()},
        "spoiled": spoiled(counters, run.real_time),
        "focus": _figures(tracked),
        "together": _together(tracked),
        "untracked_spots": _figures([focus for focus in foci if focus.emission.finger is None]),
    }


def _figures(foci: list[Focus]) -> dict[str, Any]:
    """Median and worst of every figure; None for each if there is no focus."""
    columns: dict[str, tuple[list[float], Callable[[list[float]], float]]] = {
        "relative_amplitude": ([f.relative_amplitude for f in foci], min),
        "exact_share": ([f.exact_share for f in foci], min),
        "amplitude_um": ([f.metrics.amplitude_m * 1e6 for f in foci], min),
        "contrast": ([f.metrics.contrast for f in foci], min),
        "contrast_all": ([f.metrics.contrast_all for f in foci], min),
        "spot_mm": ([f.metrics.spot_m * 1e3 for f in foci], max),
        "distance_mm": ([f.distance_m * 1e3 for f in foci], max),
    }
    return {"count": len(foci)} | {name: _median_and(worst, values) for name, (values, worst) in columns.items()}


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
