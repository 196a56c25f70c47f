"""What devices report, brought into a folder by whatever the owner uses: `haptic-panel status --json`, or figures for Prometheus.

NAME.json is of one device; NAME.prom is what `haptic-panel metrics` gives of one, or what Prometheus gives of many
(`/federate`), by their label `instance`.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

import msgspec
from prometheus_client.parser import text_string_to_metric_families
from prometheus_client.samples import Sample

from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import BYTES_MAX, SERVES, LatencyStatus, PanelStatus
from controller.device.board.validation import NO_JSON
from controller.device.update.installed import UpdateState
from controller.device.update.judge import WAITS, too_slow
from controller.device.update.layout import RELEASE_NAME
from controller.errors import UpdateError
from controller.regular_file import read_regular

PROMETHEUS_BYTES_MAX: Final = 64 << 20  # of 2,000 devices
DAMAGED: Final = (ValueError, IndexError, KeyError, TypeError, OverflowError)  # what the parser raises for text that it cannot read
JSON, PROMETHEUS = ".json", ".prom"
EXPECTED: Final = {
    JSON: "what `haptic-panel status --json` prints",
    PROMETHEUS: "what `haptic-panel metrics` or Prometheus gives of panels",
}


@dataclass(frozen=True, slots=True)
class Report:
    """What one device reports of releases."""

    version: str  # the release that it has
    failed: tuple[str, ...]  # those that it went back from
    is_faulted: bool  # it does not serve, or too slowly; one that waits for permit or touch panel is not at fault
    heard: datetime

    def __post_init__(self) -> None:
        for name in (self.version, *self.failed):
            if not RELEASE_NAME.fullmatch(name):
                raise ValueError(f"{name!r} is no name of a release")


class DeviceStatus(PanelStatus, frozen=True, kw_only=True):
    """What `haptic-panel status --json` prints."""

    updates: UpdateState
    old: str = ""  # why it was not the panel's present state

    def report(self, heard: datetime) -> Report:
        """What counts of it."""
        is_faulted = bool(self.old or too_slow(self)) or not (self.serves or self.state in WAITS)
        return Report(self.updates.in_use or self.release, self.updates.failed, is_faulted, heard)


@dataclass(frozen=True, slots=True)
class Latencies:
    """The host's own work, as a status has it."""

    upload: LatencyStatus
    resident: LatencyStatus


def read_reports(folder: Path) -> tuple[list[Report], list[str]]:
    """The last report of each device, by its name, and the files that are none, a line each.

    Raises UpdateError if the folder cannot be read, or has no report.
    """
    try:
        files = sorted(file for file in folder.iterdir() if file.suffix in EXPECTED and not file.name.startswith("."))
    except OSError as error:
        raise UpdateError(f"{folder}: cannot be read ({error.strerror}): give the folder of the devices' reports") from error
    reports: dict[str, Report] = {}
    broken: list[str] = []
    for file in files:
        try:
            for device, report in _read(file, broken):
                if device not in reports or reports[device].heard < report.heard:
                    reports[device] = report
        except OSError as error:
            broken.append(f"{file}: cannot be read ({error.strerror})")
        except (*NO_JSON, *DAMAGED) as error:
            broken.append(_unread(file, error))
    if not reports:
        raise UpdateError(
            f"{folder}: has no report of a device ({len(broken)} broken files): a file NAME.json or NAME.prom for each is expected"
        )
    return list(reports.values()), broken


def _read(file: Path, broken: list[str]) -> Iterator[tuple[str, Report]]:
    """Reports in a file, by device: the `instance` of its samples, if any; one whose samples are no report joins what is broken."""
    heard = datetime.fromtimestamp(file.stat().st_mtime, UTC)
    if file.suffix == JSON:
        yield file.stem, _decoder.decode(read_regular(file, BYTES_MAX)).report(heard)
        return
    text = read_regular(file, PROMETHEUS_BYTES_MAX).decode()
    devices: dict[str, list[Sample]] = defaultdict(list)
    for family in text_string_to_metric_families(text):
        for sample in family.samples:
            if sample.name.startswith("haptic_panel_"):
                devices[sample.labels.get("instance", file.stem)].append(sample)
    if not devices:
        raise ValueError("no figures of a panel")
    for device, samples in devices.items():
        try:
            yield device, _report(samples, heard)
        except DAMAGED as error:
            broken.append(_unread(file, error, device))


def _unread(file: Path, error: Exception, device: str = "") -> str:
    return f"{file}: {f'{device!r} ' if device else ''}is not {EXPECTED[file.suffix]}: {str(error)[:200]!r}"


def _report(samples: Iterable[Sample], heard: datetime) -> Report:
    found: Mapping[str, list[Sample]] = defaultdict(list)
    for sample in samples:
        found[sample.name.removeprefix("haptic_panel_")].append(sample)
    named = [sample.labels["in_use"] for sample in found["update_info"]] + [one.labels["version"] for one in found["release_info"]]
    version = next(filter(None, named), "")
    failed = tuple(sample.labels["version"] for sample in found["update_failed"] if sample.value)
    states = [PanelState(sample.labels["state"]) for sample in found["state"] if sample.value]
    up, times = found["up"], [float(one.timestamp) for one in found["up"] if one.timestamp is not None]
    if len(up) != 1 or len(states) != up[0].value:
        raise ValueError("haptic_panel_up or haptic_panel_state is not there once")
    serves = bool(states) and (states[0] in SERVES or states[0] in WAITS)
    slow = too_slow(Latencies(_latency(found, "upload"), _latency(found, "resident")))
    return Report(version, failed, bool(slow) or not serves, datetime.fromtimestamp(times[0], UTC) if times else heard)


def _latency(found: Mapping[str, list[Sample]], play: str) -> LatencyStatus:
    """The host's own work for plays of a kind; quantiles between the bounds of buckets, as Prometheus has them."""
    of_kind = [one for one in found["host_latency_seconds_bucket"] if one.labels["play"] == play]
    buckets = sorted((float(one.labels["le"]), one.value) for one in of_kind)
    count = buckets[-1][1] if buckets else 0.0

    def quantile_us(share: float) -> float:
        below_s, before = 0.0, 0.0
        for bound_s, counted in buckets:
            if counted >= share * count:
                part = (share * count - before) / (counted - before) if counted > before else 1.0
                return 1e6 * (below_s if bound_s == float("inf") else below_s + part * (bound_s - below_s))
            below_s, before = bound_s, counted
        raise ValueError("buckets of haptic_panel_host_latency_seconds decrease")

    return LatencyStatus(int(count), quantile_us(0.5), quantile_us(0.99)) if count else LatencyStatus()


_decoder: Final = msgspec.json.Decoder(DeviceStatus)
