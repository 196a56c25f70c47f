"""Counting on the hot path: latency histograms of constant memory, and the counters of what was skipped."""

from __future__ import annotations

import math
from array import array
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

SUB_BITS = 7  # 128 buckets per octave: a percentile is at most 0.8 % too low
SHARES = {"p50": 0.5, "p99": 0.99, "p999": 0.999}
P999_SAMPLES = 10_000  # below this, the thousandth worst is chance


class LatencyHistogram:
    """Durations in ns in logarithmic buckets; `record` allocates nothing and costs the same for ever."""

    def __init__(self) -> None:
        self.count = 0
        self.worst_ns = 0
        self._buckets = array("Q", bytes(8 * (64 << SUB_BITS)))

    def record(self, duration_ns: int) -> None:
        """Count one duration; what a clock step has made negative counts as 0."""
        duration_ns = max(duration_ns, 0)
        self.count += 1
        self.worst_ns = max(self.worst_ns, duration_ns)
        octave = max(duration_ns.bit_length() - SUB_BITS - 1, 0)
        self._buckets[(octave << SUB_BITS) + (duration_ns >> octave)] += 1

    def percentile_ns(self, share: float) -> float:
        """Duration that `share` (0 to 1) of the records do not exceed, within 0.8 %; NaN without records."""
        return self._percentiles_ns((share,))[0]

    def _percentiles_ns(self, shares: Sequence[float]) -> list[float]:
        """Of each share; the buckets are summed once, and those above the worst record not at all."""
        if not self.count:
            return [math.nan] * len(shares)
        octave = max(self.worst_ns.bit_length() - SUB_BITS - 1, 0)
        last = (octave << SUB_BITS) + (self.worst_ns >> octave)
        seen = np.cumsum(np.frombuffer(self._buckets, np.uint64, last + 1))  # in Python it would keep the loop for a millisecond
        found = np.searchsorted(seen, [max(share * self.count, 0.5) for share in shares]).tolist()
        return [min(_middle_ns(index), float(self.worst_ns)) for index in found]

    def buckets_us(self) -> list[list[float]]:
        """[upper bound in us, count] of every bucket that has any."""
        return [[_upper_ns(index) * 1e-3, count] for index, count in enumerate(self._buckets) if count]

    def export(self, histogram: bool = True) -> dict[str, Any]:
        """The summary in us, and the histogram as [upper bound in us, count] of every bucket that has any."""
        return self.summary_us() | ({"histogram": self.buckets_us()} if histogram else {})

    def summary_us(self) -> dict[str, float | int | None]:
        """`{count, p50, p99, p999, worst}` in µs; None where there are too few records to say."""
        if not self.count:
            return {"count": 0, **dict.fromkeys(SHARES), "worst": None}
        known = [round(value_ns * 1e-3, 3) for value_ns in self._percentiles_ns(tuple(SHARES.values()))]
        named: dict[str, float | int | None] = dict(zip(SHARES, known, strict=True))
        if self.count < P999_SAMPLES:
            named["p999"] = None
        return {"count": self.count, **named, "worst": round(self.worst_ns * 1e-3, 3)}


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
    """The way of an emission from the read of its touch report to the trigger, in stages that follow each other.

    decide: read, tracked, scene asked. frame: waveform looked up or composed, frames made, answers checked.
    wire: bits on the wire. wait: for the plate to fall silent. trigger: the call that pulls the pin.
    host: decide + frame + trigger, our own work. total: host + wire + wait.
    """

    decide: LatencyHistogram = field(default_factory=LatencyHistogram)
    frame: LatencyHistogram = field(default_factory=LatencyHistogram)
    wire: LatencyHistogram = field(default_factory=LatencyHistogram)
    wait: LatencyHistogram = field(default_factory=LatencyHistogram)
    trigger: LatencyHistogram = field(default_factory=LatencyHistogram)
    host: LatencyHistogram = field(default_factory=LatencyHistogram)
    total: LatencyHistogram = field(default_factory=LatencyHistogram)

    def record(self, decide_ns: int, frame_ns: int, wire_ns: int, wait_ns: int, trigger_ns: int) -> None:
        """Count one emission."""
        host_ns = decide_ns + frame_ns + trigger_ns
        self.decide.record(decide_ns)
        self.frame.record(frame_ns)
        self.wire.record(wire_ns)
        self.wait.record(wait_ns)
        self.trigger.record(trigger_ns)
        self.host.record(host_ns)
        self.total.record(host_ns + wire_ns + wait_ns)

    def export(self, histograms: bool = True) -> dict[str, dict[str, Any]]:
        """Each stage as `LatencyHistogram.export` has it."""
        return {name: getattr(self, name).export(histograms) for name in STAGES}


@dataclass(slots=True)
class Skipped:
    """Work that a scene did not need, each counted where it was left out."""

    outside_region: int = 0  # touch samples that met no region: no lookup
    between_emissions: int = 0  # touch samples in a region with nothing due
    uploads: int = 0  # emissions whose waveform was resident in a slot
    compositions: int = 0  # uploads of one finger on a cell: read from the bank as they are
    merged: int = 0  # emissions replaced by a newer one of the same finger before the plate was free
    bad_entries: int = 0  # emissions left out because the bank's entry is damaged or absent
    refused: int = 0  # emissions that the FPGA did not accept
    outputs_off: int = 0  # emissions due while the outputs were off, or lost with them before they began
    unconfirmed: int = 0  # emissions beyond what a contact gets that the panel has not confirmed
    no_room: int = 0  # commands that waited when more came than wait at most
    lifted: int = 0  # emissions that still waited when their finger was lifted
    scene_changed: int = 0  # emissions that waited when another scene took over

    @property
    def emissions(self) -> int:
        """Emissions that were due and not played, for whatever reason."""
        waited = self.merged + self.no_room + self.lifted + self.scene_changed
        return waited + self.bad_entries + self.refused + self.outputs_off + self.unconfirmed


@dataclass(slots=True)
class Counters:
    """What one run of the event loop did."""

    due: int = 0  # emissions that fingers, spots and commands asked for: each in `foci`, in `skipped`, or waiting
    foci: int = 0  # of them, those played
    emissions: int = 0  # triggers given for an accepted play command, of one focus or several
    uploads: int = 0
    resident: int = 0
    heartbeats: int = 0
    scheduled: int = 0  # of the emissions: started by the FPGA at a time given beforehand
    late: int = 0  # beats that were handed over too late for their time, and played at once
    prefetched: int = 0  # waveforms sent ahead of a moving finger
    prefetch_wasted: int = 0  # of them, those that nothing played so far
    near: int = 0  # of the resident ones: a waveform made for a place very near
    bad_entry: str = ""  # why the first of `skipped.bad_entries` was left out
    host_silent: int = 0  # outputs switched off by the FPGA because this process had stalled; armed again
    outages: int = 0  # FPGA lost, reset or switched off for another cause
    outage: str = ""  # the cause of the last one
    outputs_off_s: float = 0.0  # time spent so
    scenes_loaded: int = 0
    scenes_refused: int = 0
    scene_refused: str = ""  # why the last one was
    reloads: int = 0  # of these, asked for by SIGHUP
    reload_refused: str = ""  # why the last one of them was; empty if it was not
    skipped: Skipped = field(default_factory=Skipped)
    report_latency: LatencyHistogram = field(default_factory=LatencyHistogram)  # from the kernel's timestamp to our read
    upload_latency: Stages = field(default_factory=Stages)
    resident_latency: Stages = field(default_factory=Stages)

    def export(self, histograms: bool = True) -> dict[str, Any]:
        """Everything, ready for JSON; with histograms it takes 12 ms and 200 kB, without 0.4 ms and 2 kB."""
        plain = {name: getattr(self, name) for name in self.__slots__ if isinstance(getattr(self, name), int | float | str)}
        return plain | {
            "skipped": asdict(self.skipped),
            "latency_us": {
                "report": self.report_latency.export(histograms),
                "uploads": self.upload_latency.export(histograms),
                "resident": self.resident_latency.export(histograms),
            },
        }
