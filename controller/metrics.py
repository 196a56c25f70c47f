"""Counters and latency histograms of the hot path, in constant memory."""

from __future__ import annotations

import math
from array import array
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Final

import numpy as np

SUB_BITS: Final = 7  # 128 buckets per octave: a percentile is off by at most 0.8 %
FIRST_BITS: Final = SUB_BITS + 1  # a duration of no more bits has a bucket of its own
PERCENTILES = {"p50": 0.5, "p99": 0.99, "p999": 0.999}
BOUNDS_US = (50, 100, 200, 500, 1_000, 2_000, 5_000, 10_000, 20_000, 50_000, 100_000, 200_000)  # of `LatencyHistogram.coarse`
P999_SAMPLES = 10_000  # with fewer records p999 is left out: it would be that of ten records at most


class LatencyHistogram:
    """Durations in ns in logarithmic buckets; `record` allocates nothing and takes constant time."""

    def __init__(self) -> None:
        self.worst_ns = 0  # the longest duration recorded
        self._buckets = array("Q", bytes(8 * (64 << SUB_BITS)))

    @property
    def count(self) -> int:
        """Durations recorded."""
        return int(np.frombuffer(self._buckets, np.uint64, _index(self.worst_ns) + 1).sum())

    def record(self, duration_ns: int) -> None:
        """Count one duration; a negative one (the clock was stepped) counts as 0."""
        if duration_ns <= 0:
            self._buckets[0] += 1
            return
        is_worst = duration_ns > self.worst_ns
        if is_worst:
            self.worst_ns = duration_ns
        octave = duration_ns.bit_length() - FIRST_BITS
        self._buckets[(octave << SUB_BITS) + (duration_ns >> octave) if octave > 0 else duration_ns] += 1

    def percentiles_ns(self, fractions: Sequence[float]) -> list[float]:
        """For each fraction, 0 to 1, the duration in ns that as many records do not exceed, within 0.8 %; NaN without any."""
        count = self.count
        if not count:
            return [math.nan] * len(fractions)
        seen = np.cumsum(
            np.frombuffer(self._buckets, np.uint64, _index(self.worst_ns) + 1)
        )  # a loop in Python would take a millisecond
        found = np.searchsorted(seen, [max(fraction * count, 0.5) for fraction in fractions]).tolist()
        return [min(_middle_ns(index), float(self.worst_ns)) for index in found]

    def coarse(self) -> dict[str, Any]:
        """`{count, counts, sum_us}`: all records, those up to each of `BOUNDS_US`, and their sum; both within 0.8 %."""
        count = self.count
        if not count:
            return {"count": 0, "counts": [0] * len(BOUNDS_US), "sum_us": 0.0}
        last = _index(self.worst_ns)
        buckets = np.frombuffer(self._buckets, np.uint64, last + 1)
        seen = np.cumsum(buckets)
        counts = [int(seen[min(_index(1000 * bound_us), last)]) for bound_us in BOUNDS_US]
        octave = np.maximum((np.arange(last + 1) >> SUB_BITS) - 1, 0)
        middles_ns = np.ldexp(np.arange(last + 1) - (octave << SUB_BITS) + 0.5 * (octave > 0), octave)
        return {"count": count, "counts": counts, "sum_us": round(float(buckets @ middles_ns) * 1e-3, 3)}

    def buckets_us(self) -> list[list[float]]:
        """[upper bound in µs, count] of every bucket with records."""
        return [[_upper_ns(index) * 1e-3, count] for index, count in enumerate(self._buckets) if count]

    def export(self, *, histograms: bool = True) -> dict[str, Any]:
        """`summary_us`, with `histograms` also the buckets as `buckets_us` returns them; ready for JSON."""
        return self.summary_us() | ({"histogram": self.buckets_us()} if histograms else {})

    def summary_us(self) -> dict[str, float | int | None]:
        """`{count, p50, p99, p999, worst}`, durations in µs; None where there are too few records."""
        count = self.count
        if not count:
            return {"count": 0, **dict.fromkeys(PERCENTILES), "worst": None}
        known = [round(value_ns * 1e-3, 3) for value_ns in self.percentiles_ns(tuple(PERCENTILES.values()))]
        named: dict[str, float | int | None] = dict(zip(PERCENTILES, known, strict=True))
        if count < P999_SAMPLES:
            named["p999"] = None
        return {"count": count, **named, "worst": round(self.worst_ns * 1e-3, 3)}


def _index(duration_ns: int) -> int:
    """Bucket of a duration."""
    octave = max(duration_ns.bit_length() - FIRST_BITS, 0)
    return (octave << SUB_BITS) + (duration_ns >> octave)


def _middle_ns(index: int) -> float:
    """Duration in the middle of a bucket."""
    octave = max((index >> SUB_BITS) - 1, 0)
    return float(((index - (octave << SUB_BITS)) << octave) + ((1 << octave) >> 1))


def _upper_ns(index: int) -> int:
    """First duration above a bucket."""
    octave = max((index >> SUB_BITS) - 1, 0)
    return (index - (octave << SUB_BITS) + 1) << octave


STAGES = ("decide", "frame", "wire", "wait", "trigger", "host", "total")


@dataclass(slots=True)
class Stages:
    """Latency of emissions, from the read of the touch report to the trigger, in consecutive stages."""

    # Read and track touches, evaluate the scene, choose the batch
    decide: LatencyHistogram = field(default_factory=LatencyHistogram)
    frame: LatencyHistogram = field(default_factory=LatencyHistogram)  # look up or compose the waveform, pack frames, check answers
    wire: LatencyHistogram = field(default_factory=LatencyHistogram)  # bits on the wire
    wait: LatencyHistogram = field(default_factory=LatencyHistogram)  # until the plate is free
    trigger: LatencyHistogram = field(default_factory=LatencyHistogram)  # the call that raises the trigger line
    host: LatencyHistogram = field(default_factory=LatencyHistogram)  # decide + frame + trigger: the host's own work
    total: LatencyHistogram = field(default_factory=LatencyHistogram)  # host + wire + wait

    def record(self, decide_ns: int, frame_ns: int, wire_ns: int, wait_ns: int, trigger_ns: int) -> None:
        """Count one emission: the durations of its stages in ns."""
        host_ns = decide_ns + frame_ns + trigger_ns
        self.decide.record(decide_ns)
        self.frame.record(frame_ns)
        self.wire.record(wire_ns)
        self.wait.record(wait_ns)
        self.trigger.record(trigger_ns)
        self.host.record(host_ns)
        self.total.record(host_ns + wire_ns + wait_ns)

    def export(self, *, histograms: bool = True) -> dict[str, dict[str, Any]]:
        """`LatencyHistogram.export` of each stage, by its name."""
        return {name: getattr(self, name).export(histograms=histograms) for name in STAGES}


NO_EMISSIONS: Final = ("outside_region", "between_emissions", "uploads", "compositions")  # work that was left out, of `Skipped`


@dataclass(slots=True)
class Skipped:
    """Work and emissions that were left out, by cause."""

    outside_region: int = 0  # touch samples outside of all regions
    between_emissions: int = 0  # touch samples in a region that made no emission due
    uploads: int = 0  # emissions whose waveform was resident
    compositions: int = 0  # uploads from the bank as they are: a cell, for one finger on it, or points composed beforehand
    merged: int = 0  # emissions replaced by a newer one of the same owner before the plate was free
    bad_entries: int = 0  # emissions whose bank entry is damaged or absent
    refused: int = 0  # emissions that the FPGA did not accept
    outputs_off: int = 0  # emissions due while the outputs were off, or lost with them before they began
    unconfirmed: int = 0  # emissions beyond the limit of a contact that the panel has not confirmed
    no_room: int = 0  # emissions of commands that waited when too many others came
    lifted: int = 0  # emissions that waited when their finger was lifted
    scene_changed: int = 0  # emissions that waited when another scene took over

    @property
    def emissions(self) -> int:
        """Emissions that were due and not played, of all causes."""
        return sum([getattr(self, cause) for cause in NOT_PLAYED])


NOT_PLAYED: Final = tuple([cause.name for cause in fields(Skipped) if cause.name not in NO_EMISSIONS])


@dataclass(slots=True)
class LinkCounters:
    """Where what a status of the FPGA said was other than what the host believed, by cause."""

    messages_repeated: int = 0  # plays sent again since a frame or an answer was damaged, and no copy of them had been taken
    first_copies_taken: int = 0  # plays whose answer was damaged, which the FPGA had taken all the same
    triggers_lost: int = 0  # edges of the trigger that the FPGA did not see
    triggers_ignored: int = 0  # edges that it saw while nothing could start
    triggers_stray: int = 0  # edges that it saw and that this host did not send
    plays_stale: int = 0  # plays found waiting after they should have begun: removed
    plays_missed: int = 0  # emissions at a time that the FPGA let pass
    emissions_unexpected: int = 0  # emissions that nobody here started
    misplaced: int = 0  # emissions that played what the slot had held before, or on some FPGAs and not on all
    emissions_lost: int = 0  # emissions counted as played that never began, of all causes


@dataclass(slots=True)
class Counters:
    """Counters of one run of the event loop; they are only reported, nothing is decided by them."""

    due: int = 0  # emissions of fingers, spots and commands; each is counted in `foci` or `skipped` as well, or waits
    foci: int = 0  # of these, those that were played
    emissions: int = 0  # starts of an accepted play command, with one focus or several
    uploads: int = 0
    resident: int = 0
    heartbeats: int = 0
    scheduled: int = 0  # of `emissions`: started by the FPGA at a time given beforehand
    late: int = 0  # pulses that reached the FPGA too late for their time, and were played at once
    prefetched: int = 0  # waveforms uploaded for a predicted emission of a moving finger
    prefetch_wasted: int = 0  # of these, those that were not played so far
    composed_beforehand: int = 0  # of `uploads`: waveforms of several points that the bank has ready
    kept_still: int = 0  # of `uploads`: waveforms that keep other fingers still
    near: int = 0  # of `resident`: played with the waveform of a place near by
    bad_entry: str = ""  # why the first of `skipped.bad_entries` was left out
    host_silent: int = 0  # times the FPGA switched off since this process stalled; armed again
    stall_pauses: int = 0  # of these: times it was armed again only after a pause, since stalls came in a row
    outages: int = 0  # times the FPGA was lost, reset, or switched off for another cause
    outage: str = ""  # cause of the last one
    outage_causes: dict[str, int] = field(default_factory=dict)  # how often the FPGA named each fault; LINK: it was lost or reset
    idled: int = 0  # times the outputs were ramped down since nothing was touched
    outputs_off_s: float = 0.0  # in total, until they were on
    scenes_loaded: int = 0
    scenes_refused: int = 0
    scene_refused: str = ""  # why the last one was
    reloads: int = 0  # scenes loaded or refused that SIGHUP asked for
    reload_refused: str = ""  # why the last reload was refused; empty if it was not
    link: LinkCounters = field(default_factory=LinkCounters)
    skipped: Skipped = field(default_factory=Skipped)
    report_latency: LatencyHistogram = field(default_factory=LatencyHistogram)  # from the kernel's timestamp to our read
    upload_latency: Stages = field(default_factory=Stages)
    resident_latency: Stages = field(default_factory=Stages)

    def export(self, *, histograms: bool = True) -> dict[str, Any]:
        """All counters and latencies, ready for JSON; with histograms it takes 12 ms and 200 kB, without 0.4 ms and 2 kB."""
        each = {one.name: getattr(self, one.name) for one in fields(self)}  # compiled by mypyc it has no __slots__
        plain = {name: value for name, value in each.items() if isinstance(value, int | float | str)}
        return plain | {
            "outage_causes": dict(self.outage_causes),
            "link_counts": asdict(self.link),
            "skipped": asdict(self.skipped),
            "latency_us": {
                "report": self.report_latency.export(histograms=histograms),
                "uploads": self.upload_latency.export(histograms=histograms),
                "resident": self.resident_latency.export(histograms=histograms),
            },
        }

    def coarse_latency(self) -> dict[str, Any]:
        """Coarse histograms of the latencies that users feel: `bounds_us`, and `LatencyHistogram.coarse` of each; 0.2 ms."""
        return {
            "bounds_us": BOUNDS_US,
            "report": self.report_latency.coarse(),
            "uploads_host": self.upload_latency.host.coarse(),
            "uploads_total": self.upload_latency.total.coarse(),
            "resident_host": self.resident_latency.host.coarse(),
            "resident_total": self.resident_latency.total.coarse(),
        }
