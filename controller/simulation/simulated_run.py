"""A whole run on a simulated panel: recording, event loop, gateware, plate, and what came of it.

The loop runs first, against the model of the gateware or its compiled Verilog. Only then the plate twin looks at the captured
channel pins, so that its computing cannot disturb any latency. What was meant (which finger, which
point) comes from the loop's own account; where the finger really was at T, from the recording.
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
from controller.loop.playback import Played
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
REAL_SETTLE_S = 0.3  # in real time, on a busy machine
REFERENCE_ROUNDS = 2000
SPOILED_S = 10e-3  # of the host, late: a finger goes on by a third of a spot meanwhile, and where it was aimed at is no more
Point = tuple[float, float]


@dataclass(frozen=True)
class Focus:
    """One focus of one emission, as the finger under it would have met it."""

    time_s: float  # T, in the recording's time
    emission: Emission
    x_m: float  # the finger at T; an untracked spot itself
    y_m: float
    relative_amplitude: float  # over what this point could have alone
    exact_share: float  # over what was asked for: its amplitude of what exact composition at the fingers' places gives it
    metrics: FocusMetrics
    distance_m: float  # from there to the crest of the spot


@dataclass(frozen=True)
class Judged:
    """Every focus of a run, and the field and foci of the one moment most worth a picture."""

    foci: list[Focus]
    field: Field | None
    shown: list[Focus]
    left_out: int  # emissions not judged, because of Ctrl-C or SIGTERM


@dataclass(frozen=True)
class Run:
    """What the loop did; `capture` is all that the plate gets to see."""

    board: Board
    recording: Recording
    source: RecordingSource
    tracks: dict[int, Track]  # by the loop's numbers: of all contacts that were the finger
    counters: Counters
    capture: Capture
    played: list[Played]
    link: SimulatedLink
    start_s: float
    real_time: bool
    touch: dict[str, Any]  # of the tracker
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
    real_time : bool
        Else in virtual time, as fast as the machine goes and the same every time.
    ready : callable
        Called when the simulated panel is armed.
    gateware : GatewareFactory
        What computes the gateware's pins.

    Raises
    ------
    FaultError, LinkError
        As the event loop does.
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
    """Why the figures of the foci tell of this machine and not of the panel; empty: they tell of the panel.

    In virtual time what this machine does meanwhile changes nothing.
    """
    if not real_time:
        return ""
    stages = (counters.report_latency, counters.upload_latency.host, counters.resident_latency.host)
    late_s = max(stage.worst_ns for stage in stages) * 1e-9
    advice = "end other work, or replay with --speed max"
    if counters.host_silent:
        return f"this machine was busy: the host fell silent ({counters.host_silent} ×) and the FPGA switched off; {advice}"
    if late_s > SPOILED_S:
        return f"this machine was busy: the host was late by {late_s * 1e3:.0f} ms, and fingers had moved on; {advice}"
    return ""


def copy_and_checksum(size: int) -> LatencyHistogram:
    """Time of what an upload cannot do without: one copy of its bytes and one CRC pass over them."""
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
    """Let the plate twin play the captured pins, and judge every focus where its finger was at T; Ctrl-C cuts it short.

    Parameters
    ----------
    progress : callable, optional
        Told of emissions judged and emissions in all.
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
    """All foci of one emission, each where its finger was."""
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
    """Every focus tick of the capture with what the loop wanted there: the emissions of the last start before it began."""
    starts_ticks = [run.link.tick(played.trigger_s) if played.at_ticks is None else played.at_ticks for played in run.played]
    most_ticks = round(0.99 * run.board.waveform.duration_s * run.link.clock_hz)
    meant = []
    for tick in run.capture.focus_ticks.tolist():
        meant.append((tick, run.played[bisect_right(starts_ticks, tick - most_ticks) - 1].emissions))
    return meant


def _worth_showing(foci: list[Focus]) -> tuple[int, float]:
    """Most fingers that are apart from all others, then the largest of the weakest focus."""
    apart = [
        focus.emission.finger is not None
        and all(np.hypot(focus.x_m - other.x_m, focus.y_m - other.y_m) > OUTSIDE_M for other in foci if other is not focus)
        for focus in foci
    ]
    return sum(apart), min((focus.metrics.amplitude_m for focus in foci), default=0.0)


def _place(tracks: dict[int, Track], emission: Emission, time_s: float) -> Point:
    """Where the finger was at T; an untracked spot is where it is."""
    if emission.finger is None:
        return emission.x_m, emission.y_m
    return tracks[emission.finger].position(time_s)


def report(run: Run, foci: list[Focus]) -> dict[str, Any]:
    """All figures of a run, ready for JSON; units are in the names."""
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
    """Median and worst of every figure; None without any focus."""
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
    """Emissions by how many fingers they served: the finger that fell shortest of exact composition, and all distances."""
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
    """Those that are numbers: on the plate's very rim nothing can move."""
    return [value for value in values if np.isfinite(value)]
