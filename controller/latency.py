"""Counting on the hot path: latency histograms of constant memory, and the counters of what was skipped."""

from __future__ import annotations

from array import array
from dataclasses import dataclass, field

SUB_BITS = 7  # 128 buckets per octave: a percentile is at most 0.8 % too low
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
        wanted = share * self.count
        seen = 0
        for index, count in enumerate(self._buckets):
            seen += count
            if count and seen >= wanted:
                octave = max((index >> SUB_BITS) - 1, 0)
                return min(float(((index - (octave << SUB_BITS)) << octave) + ((1 << octave) >> 1)), float(self.worst_ns))
        return float("nan")

    def summary_us(self) -> dict[str, float | int | None]:
        """`{count, p50, p99, p999, worst}` in µs; None where there are too few records to say."""
        share = {"p50": 0.5, "p99": 0.99, "p999": 0.999}
        known = {name: round(self.percentile_ns(value) * 1e-3, 3) if self.count else None for name, value in share.items()}
        if self.count < P999_SAMPLES:
            known["p999"] = None
        return {"count": self.count, **known, "worst": round(self.worst_ns * 1e-3, 3) if self.count else None}


@dataclass(slots=True)
class Stages:
    """The way of an emission from the read of its touch report to the trigger, in stages.

    host: our own work. wait: for the plate to fall silent. wire: bits on the wire. total: all three.
    """

    host: LatencyHistogram = field(default_factory=LatencyHistogram)
    wait: LatencyHistogram = field(default_factory=LatencyHistogram)
    wire: LatencyHistogram = field(default_factory=LatencyHistogram)
    total: LatencyHistogram = field(default_factory=LatencyHistogram)

    def record(self, host_ns: int, wait_ns: int, wire_ns: int) -> None:
        """Count one emission."""
        self.host.record(host_ns)
        self.wait.record(wait_ns)
        self.wire.record(wire_ns)
        self.total.record(host_ns + wait_ns + wire_ns)


@dataclass(slots=True)
class Skipped:
    """Work that a scene did not need, each counted where it was left out."""

    outside_region: int = 0  # touch samples that met no region: no lookup
    between_emissions: int = 0  # touch samples in a region with nothing due
    merged: int = 0  # emissions replaced by a newer one of the same finger before the plate was free
    uploads: int = 0  # emissions whose waveform was resident in a slot
    compositions: int = 0  # uploads of one finger on a cell: read from the bank as they are
    bad_entries: int = 0  # emissions left out because the bank's entry is damaged or absent
    refused: int = 0  # emissions that the FPGA did not accept


@dataclass(slots=True)
class Counters:
    """What one run of the event loop did."""

    emissions: int = 0  # triggers given for an accepted play command
    uploads: int = 0
    resident: int = 0
    heartbeats: int = 0
    bad_entry: str = ""  # why the first of `skipped.bad_entries` was left out
    host_silent: int = 0  # outputs switched off by the FPGA because this process had stalled; armed again
    skipped: Skipped = field(default_factory=Skipped)
    upload_latency: Stages = field(default_factory=Stages)
    resident_latency: Stages = field(default_factory=Stages)
