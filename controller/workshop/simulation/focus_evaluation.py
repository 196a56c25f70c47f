"""Evaluation of a simulated run: the plate twin plays the captured channel pins, and every focus is compared with its finger.

The intended finger and point come from the loop's record of what it played; the finger's true place at T comes from the
recording.
"""

import contextlib
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np

from controller.device.scene.emission import Emission
from controller.device.touch.recordings.recording import Track
from controller.workshop.physics.field import Field, FocusMetrics
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.simulation.drift import FORGOTTEN, since
from controller.workshop.simulation.simulated_run import Run

Point = tuple[float, float]


@dataclass(frozen=True)
class Focus:
    """One focus of one emission, evaluated where its finger was at T; amplitudes are those of a kick to either side."""

    time_s: float  # T, in the recording's time
    emission: Emission
    x_m: float  # true place of the finger at T; of an emission without a finger, its own place
    y_m: float
    relative_amplitude: float  # relative to a single focus at this point
    exact_share: float  # relative to exact composition at the fingers' true places, times the amplitude asked for
    metrics: FocusMetrics
    distance_m: float  # from there to the maximum of the spot


@dataclass(frozen=True)
class Evaluated:
    """Every focus of a run, and the field and foci of the emission chosen for the picture."""

    foci: list[Focus]
    field: Field | None
    shown: list[Focus]
    left_out: int  # emissions not evaluated, because of Ctrl-C or SIGTERM


def judge(run: Run, progress: Callable[[int, int], None] | None = None) -> Evaluated:
    """Play the captured pins on the plate twin and evaluate every focus where its finger was at T; Ctrl-C ends it early.

    `progress` is called with the number of emissions evaluated and of all emissions.
    """
    meant = foci_meant(run)
    evaluated = Evaluated([], None, [], len(meant))
    with contextlib.suppress(KeyboardInterrupt):
        for done, ((tick, emissions), (twin, field)) in enumerate(zip(meant, _fields(run), strict=True), 1):
            together = _judge_moment(run, twin, field, run.link.time_s(tick) - run.start_s, emissions)
            better = _worth_showing(together, twin.scale.outside_m) > _worth_showing(evaluated.shown, twin.scale.outside_m)
            shown = (field, together) if better else (evaluated.field, evaluated.shown)
            evaluated.foci.extend(together)
            evaluated = Evaluated(evaluated.foci, *shown, len(meant) - done)
            if progress:
                progress(done, len(meant))
    return evaluated


def _fields(run: Run) -> Iterator[tuple[PlateTwin, Field]]:
    """The twin as it is at every focus of a run, with its displacement then."""
    drift = run.drift
    if drift is None:
        twin = PlateTwin(run.plate)
        yield from ((twin, field) for field in twin.fields(run.capture, run.link.clock_hz))
        return
    modes = modes_of(run.plate)
    remembered_ticks = round(FORGOTTEN / modes.decay_rate.min() * run.link.clock_hz)
    ticks = run.capture.focus_ticks.tolist()
    for by, some in groupby(ticks, lambda tick: drift.level(run.link.time_s(tick) - run.start_s)):
        foci = np.array(list(some), np.uint64)
        twin = PlateTwin(run.plate, modes=drifted(modes, by))
        part = replace(since(run.capture, int(foci[0]) - remembered_ticks), focus_ticks=foci)
        yield from ((twin, field) for field in twin.fields(part, run.link.clock_hz))


def _judge_moment(run: Run, twin: PlateTwin, field: Field, time_s: float, emissions: tuple[Emission, ...]) -> list[Focus]:
    """Evaluate all foci of one emission, each where its finger was."""
    places = [_place(run.tracks, emission, time_s) for emission in emissions]
    exact_m = twin.exact_amplitudes(tuple(places))
    together = []
    for emission, (x_m, y_m), asked_m in zip(emissions, places, exact_m.tolist(), strict=True):
        metrics = field.focus_metrics(x_m, y_m, places)
        crest_x_m, crest_y_m = field.crest(emission.x_m, emission.y_m)
        reference_m = twin.reference_amplitude(x_m, y_m)
        amplitude_m = abs(metrics.amplitude_m)
        relative = amplitude_m / reference_m if reference_m else float("nan")
        exact_share = amplitude_m / (emission.amplitude * asked_m) if asked_m > 0 else float("nan")
        distance_m = float(np.hypot(crest_x_m - x_m, crest_y_m - y_m))
        together.append(Focus(time_s, emission, x_m, y_m, relative, exact_share, metrics, distance_m))
    return together


def foci_meant(run: Run) -> list[tuple[int, tuple[Emission, ...]]]:
    """(tick, emissions) of every focus in the run's capture: the emissions are those of the last start before it."""
    starts_ticks = [run.link.tick(played.trigger_s) if played.at_ticks is None else played.at_ticks for played in run.played]
    most_ticks = round(0.9 * run.board.waveform.duration_s * run.link.clock_hz)
    meant = []
    for tick in run.capture.focus_ticks.tolist():
        meant.append((tick, run.played[bisect_right(starts_ticks, tick - most_ticks) - 1].emissions))
    return meant


def _worth_showing(foci: list[Focus], apart_m: float) -> tuple[int, float]:
    """Rank of an emission for the picture: number of fingers `apart_m` from others, then amplitude of its weakest focus."""
    apart = [
        focus.emission.finger is not None
        and all(np.hypot(focus.x_m - other.x_m, focus.y_m - other.y_m) > apart_m for other in foci if other is not focus)
        for focus in foci
    ]
    return sum(apart), min((abs(focus.metrics.amplitude_m) for focus in foci), default=0.0)


def _place(tracks: dict[int, Track], emission: Emission, time_s: float) -> Point:
    """True place of the finger at `time_s`; without a finger, the emission's own place."""
    if emission.finger is None:
        return emission.x_m, emission.y_m
    return tracks[emission.finger].position(time_s)
