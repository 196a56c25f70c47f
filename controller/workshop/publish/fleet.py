"""How a rollout fares, by what devices report: `haptic-panel status --json` of each in a file, brought by whatever the owner uses.

These files are not signed: they decide nothing. A stop, or other steps, are proposed to the owner, who signs them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

import msgspec

from controller.device.board.panel_status import BYTES_MAX, PanelStatus
from controller.device.board.validation import NO_JSON
from controller.device.update.installed import UpdateState
from controller.device.update.judge import WAITS, too_slow
from controller.device.update.layout import RELEASE_NAME
from controller.device.update.trust.clock import as_text
from controller.device.update.trust.rollout import ALL_PPM, Rollout, percent, read_rollout, stopped_by
from controller.errors import UpdateError
from controller.regular_file import read_regular
from controller.workshop.publish.publications import channel_of
from controller.workshop.publish.publisher import Repository

BAD_MAX: Final = 0.02  # share of the devices with a release, above which it is stopped
WORSE: Final = 2.0  # than devices with other releases, where their share is above that bound
HEARD_MIN: Final = 0.8  # share of the devices that are due, which must have been heard of before the next step


class DeviceReport(PanelStatus, frozen=True, kw_only=True):
    """What `haptic-panel status --json` prints."""

    updates: UpdateState
    old: str = ""  # why it was not the panel's present state

    def __post_init__(self) -> None:
        for name in (self.version, *self.updates.failed):
            if not RELEASE_NAME.fullmatch(name):
                raise ValueError(f"{name!r} is no name of a release")

    @property
    def version(self) -> str:
        """The release that it has."""
        return self.updates.in_use or self.release

    @property
    def is_faulted(self) -> bool:
        """Whether the panel does not serve, or too slowly; one that waits for permit or touch panel is not at fault."""
        return bool(self.old or too_slow(self)) or not (self.serves or self.state in WAITS)


@dataclass(slots=True)
class Tally:
    """Devices of a release: those that have it, and those that went back from it."""

    healthy: int = 0
    faulted: int = 0
    silent: int = 0  # not heard of for long, or not yet since the release before: nothing is known of them
    rolled_back: int = 0

    @property
    def heard(self) -> int:
        """Devices of which it is known how the release serves."""
        return self.healthy + self.bad

    @property
    def bad(self) -> int:
        """Devices that the release does not serve."""
        return self.faulted + self.rolled_back


@dataclass(slots=True)
class Fleet:
    """What is known of all devices."""

    devices: int = 0
    releases: dict[str, Tally] = field(default_factory=dict)  # by version
    broken: list[str] = field(default_factory=list)  # files that are no report, a line each


def read_fleet(folder: Path, now: datetime, silent_s: float) -> Fleet:
    """Reports in a folder; those older than `silent_s` are of silent devices.

    Raises UpdateError if the folder cannot be read, or has no report.
    """
    try:
        files = sorted(file for file in folder.iterdir() if file.suffix == ".json" and not file.name.startswith("."))
    except OSError as error:
        raise UpdateError(f"{folder}: cannot be read ({error.strerror}): give the folder of the devices' reports") from error
    reports, broken = [], []
    for file in files:
        try:
            heard = datetime.fromtimestamp(file.stat().st_mtime, UTC)
            reports.append((_decoder.decode(read_regular(file, BYTES_MAX)), (now - heard).total_seconds() > silent_s))
        except OSError as error:
            broken.append(f"{file}: cannot be read ({error.strerror})")
        except NO_JSON as error:
            broken.append(f"{file}: is not what `haptic-panel status --json` prints: {error}")
    if not reports:
        raise UpdateError(
            f"{folder}: has no report of a device ({len(broken)} broken files): a file NAME.json for each is expected"
        )
    return tallied(reports, broken)


def tallied(reports: Iterable[tuple[DeviceReport, bool]], broken: Iterable[str] = ()) -> Fleet:
    """Counts of reports, each with whether the device is silent."""
    fleet = Fleet(broken=list(broken))
    for report, silent in reports:
        fleet.devices += 1
        tally = fleet.releases.setdefault(report.version, Tally())
        if silent:
            tally.silent += 1
        elif report.is_faulted:
            tally.faulted += 1
        else:
            tally.healthy += 1
        for version in report.updates.failed:
            fleet.releases.setdefault(version, Tally()).rolled_back += 1
    return fleet


def proposal(version: str, rollout: Rollout | None, fleet: Fleet, now: datetime) -> tuple[str, str]:
    """What to do about a release, `stop`, `wait` or `go on`, and why.

    Stop: more than 2 % of the devices heard of are faulted or rolled back, and more than twice the share of the other releases'
    devices that are faulted. Wait: less than 80 % of the devices that are due were heard of. Else the next step may come.
    """
    tally = fleet.releases.get(version, Tally())
    others = [other for name, other in fleet.releases.items() if name != version]
    served = sum(other.healthy + other.faulted for other in others)
    elsewhere = sum(other.faulted for other in others) / served if served else 0.0
    most = max(BAD_MAX, WORSE * elsewhere)
    if tally.bad > most * tally.heard:
        return "stop", f"{tally.bad} of {tally.heard} devices are faulted or rolled back, more than {most:.1%}"
    share_ppm = rollout.share_ppm(now) if rollout else ALL_PPM
    due = fleet.devices * share_ppm / ALL_PPM
    if tally.heard < HEARD_MIN * due:
        return "wait", f"{tally.heard} of about {due:.0f} devices that are due were heard of"
    after = next((step for step in rollout.steps if step.at > now), None) if rollout else None
    if after:
        return "go on", f"next: {after}"
    return "go on", f"it is for {percent(share_ppm)}{'' if share_ppm == ALL_PPM else ', and no further step is set'}"


def rollout_figures(repository: Repository, channel: str, fleet: Fleet, now: datetime) -> dict[str, Any]:
    """Devices by release, and what to do about each release that a channel offers.

    Raises UpdateError if the channel offers none.
    """
    targets, timestamp = repository.published("targets"), repository.published("timestamp")
    known: Mapping[str, Any] = targets.signed.targets if targets else {}
    stopped = stopped_by(timestamp.signed, str(repository.folder)) if timestamp else []
    offers = []
    for path in sorted(channel_of(repository, known, channel).releases.values()):
        version, rollout = path.split("/")[1], read_rollout(known[path].custom, f"{repository.folder}: {path}")
        propose, why = ("stopped", "no further device takes it") if version in stopped else proposal(version, rollout, fleet, now)
        share = (rollout.share_ppm(now) if rollout else ALL_PPM) / ALL_PPM
        offers.append({"version": version, "manifest": path, "share": share, "propose": propose, "why": why})
    if not offers:
        raise UpdateError(f"{repository.folder}: channel {channel} offers no release")
    tallies = {version: asdict(tally) for version, tally in sorted(fleet.releases.items())}
    return {
        "channel": channel,
        "at": as_text(now),
        "devices": fleet.devices,
        "releases": tallies,
        "offers": offers,
        "broken": fleet.broken,
    }


def fleet_table(figures: dict[str, Any]) -> str:
    """The same figures as a table."""
    columns = ("healthy", "faulted", "silent", "rolled_back")
    broken = f", {len(figures['broken'])} broken files" if figures["broken"] else ""
    lines = [
        f"{figures['devices']} devices{broken}",
        f"{'release':<24}" + "".join(f"{name.replace('_', ' '):>13}" for name in columns),
    ]
    lines += [f"{name:<24}" + "".join(f"{tally[key]:>13}" for key in columns) for name, tally in figures["releases"].items()]
    lines += [f"{offer['manifest']}: {offer['propose']}: {offer['why']}" for offer in figures["offers"]]
    lines += [f"BROKEN {file}" for file in figures["broken"]]
    return "\n".join(lines)


_decoder: Final = msgspec.json.Decoder(DeviceReport)
