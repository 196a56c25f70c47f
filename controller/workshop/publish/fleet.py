"""How a rollout goes, by what devices report.

Reports are not signed: they decide nothing. The next step's opening, or a stop, is proposed to the owner, who signs it.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Any, Final

from controller.device.update.trust.clock import as_text
from controller.device.update.trust.rollout import ALL_PPM, Rollout, opened_by, percent, read_rollout, stopped_by
from controller.errors import UpdateError
from controller.workshop.publish.publications import channel_of
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.reports import Report, read_reports

BAD_MAX: Final = 0.02  # share of the devices with a release, above which it is stopped
WORSE: Final = 2.0  # than devices with other releases, where their share is above that bound
CHANCE_MAX: Final = 0.05  # probability below which faults are not put down to chance
HEARD_MIN: Final = 0.8  # share of the devices that are due, which must have been heard of before the next step


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
    """Reports in a folder; those older than `silent_s` are of silent devices; raises UpdateError as `read_reports`."""
    reports, broken = read_reports(folder)
    return tallied(((report, (now - report.heard).total_seconds() > silent_s) for report in reports), broken)


def tallied(reports: Iterable[tuple[Report, bool]], broken: Iterable[str] = ()) -> Fleet:
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
        for version in report.failed:
            fleet.releases.setdefault(version, Tally()).rolled_back += 1
    return fleet


def proposal(version: str, rollout: Rollout | None, opened_ppm: int, fleet: Fleet, now: datetime) -> tuple[str, str]:
    """What to do about a release, `stop`, `hold`, `wait`, `open` or `go on`, and why.

    Stop: two devices or more, above 2 % of those heard of, are faulted or rolled back, and more than twice the share of the other
    releases' devices that are faulted. Hold: the number that is faulted or rolled back, or was heard of with this release and fell
    silent, is one that chance exceeds in less than 5 % of cases, by the shares of the others. Wait: less than 80 % of the devices
    that are due were heard of, less what chance leaves out, or the next step's time has not come. Else it may be opened.
    """
    tally = fleet.releases.get(version, Tally())
    others = [other for name, other in fleet.releases.items() if name != version]
    served, silent = sum(other.healthy + other.faulted for other in others), sum(other.silent for other in others)
    elsewhere = sum(other.faulted for other in others) / served if served else 0.0
    known, quiet = tally.heard + tally.silent, silent / (served + silent) if served + silent else 0.0
    most, found = max(BAD_MAX, WORSE * elsewhere), f"{tally.bad} of {tally.heard} devices are faulted or rolled back"
    if tally.bad > 1 and tally.bad > most * tally.heard:
        return "stop", f"{found}, more than {most:.1%}"
    if at_least(tally.bad, elsewhere * tally.heard) < CHANCE_MAX:
        return "hold", f"{found}, {elsewhere:.1%} with other releases: look at them before a further step is opened"
    if served and at_least(tally.silent, quiet * known) < CHANCE_MAX:
        return "hold", f"{tally.silent} of {known} devices fell silent with it, {quiet:.1%} with other releases: look at them"
    share_ppm = rollout.share_ppm(now, opened_ppm) if rollout else ALL_PPM
    due = fleet.devices * share_ppm / ALL_PPM
    by_chance = 2 * math.sqrt(due * (1 - share_ppm / ALL_PPM))  # two standard deviations: each device's place is drawn
    if due and tally.heard < max(HEARD_MIN * due - by_chance, 1):
        return "wait", f"{tally.heard} of about {due:.0f} devices that are due were heard of"
    after = next((step for step in rollout.steps if step.share_ppm > share_ppm), None) if rollout else None
    if rollout and after and after not in rollout.open_steps(opened_ppm):
        return ("open", f"next: {after}") if after.at <= now else ("wait", f"for the time of the next step: {after}")
    if after:
        return "go on", f"next: {after}"
    return "go on", f"it is for {percent(share_ppm)}{'' if share_ppm == ALL_PPM else ', and no further step is set'}"


def at_least(count: int, expected: float) -> float:
    """Probability of `count` or more, where `expected` are expected, by Poisson's distribution."""
    if expected == 0:
        return float(count == 0)
    logs = (number * math.log(expected) - expected - math.lgamma(number + 1) for number in range(count))  # exp(-800) is 0
    return max(1.0 - math.fsum(map(math.exp, logs)), 0.0)


def rollout_figures(repository: Repository, channel: str, fleet: Fleet, now: datetime) -> dict[str, Any]:
    """Devices by release, and what to do about each release that a channel offers.

    Raises UpdateError if the channel offers none.
    """
    targets, timestamp = repository.published("targets"), repository.published("timestamp")
    known: Mapping[str, Any] = targets.signed.targets if targets else {}
    stopped = stopped_by(timestamp.signed, str(repository.folder)) if timestamp else []
    opened = opened_by(timestamp.signed, str(repository.folder)) if timestamp else {}
    offers = []
    for path in sorted(channel_of(repository, known, channel).releases.values()):
        version, rollout = path.split("/")[1], read_rollout(known[path].custom, f"{repository.folder}: {path}")
        opened_ppm = opened.get(version, 0)
        propose, why = "stopped", "no further device takes it"
        if version not in stopped:
            propose, why = proposal(version, rollout, opened_ppm, fleet, now)
        share = (rollout.share_ppm(now, opened_ppm) if rollout else ALL_PPM) / ALL_PPM
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
