"""500 devices, and a release that is bad on 25 boards in a way that no trial shows: how many ever have it."""

import os
import random
from datetime import UTC, datetime, timedelta

import msgspec
import pytest
from repository_fixture import NOW
from test_fall_back import Device as FallBack
from test_fall_back import cutting
from test_fleet import report
from test_rollout import DAY, steps
from tiny_release import TinyRepository, release_folder

from controller.device.board.panel_status import LatencyStatus
from controller.device.update.download.fetch import fetch
from controller.device.update.installed import update_state
from controller.device.update.judge import Verdict
from controller.device.update.layout import MANIFEST, Layout
from controller.device.update.requests import ask
from controller.device.update.settings import UpdateSettings
from controller.device.update.trial import judge_trial
from controller.device.update.trust.offer import NotYetError
from controller.device.update.trust.rollout import place_ppm
from controller.workshop.publish.fleet import Fleet, Tally, fleet_table, proposal, read_fleet, rollout_figures
from controller.workshop.publish.publications import draft_stop
from controller.workshop.publish.publisher import Repository

DEVICES, BAD = 500, 25
SHARES = (1, 2, 10, 50, 100)  # in percent, every other day
ROLLOUT = steps(*((share, 2 * index) for index, share in enumerate(SHARES)))
SLOW = LatencyStatus(50_000, 3000.0, 8000.0, 20_000.0)  # as a bad board reports after a day; a trial has too few emissions for it


def drawn(seed):
    """Machine-ids of a fleet, and those of its bad boards."""
    names = random.Random(seed)
    identities = [f"{names.getrandbits(128):032x}" for _ in range(DEVICES)]
    return identities, set(names.sample(identities, BAD))


def stopped_at(seed):
    """The step, by its number, at which a stop is proposed."""
    identities, bad = drawn(seed)
    places = {name: place_ppm(name, "1.1.0") for name in identities}
    for number, step in enumerate(ROLLOUT.steps):
        having = [name for name in identities if places[name] < step.share_ppm]
        faulted = len(bad.intersection(having))
        tally = Tally(healthy=len(having) - faulted, faulted=faulted)
        fleet = Fleet(DEVICES, {"1.1.0": tally, "1.0.0": Tally(healthy=DEVICES - len(having))})
        if proposal("1.1.0", ROLLOUT, fleet, step.at)[0] == "stop":
            return number
    return len(ROLLOUT.steps)


def test_how_soon_a_rollout_stops_is_as_chance_has_it():
    """One bad board among the first 2 % is all that can show: 1 - 0.98^25 = 40 % of fleets; no rule has more to go by."""
    ends = [stopped_at(seed) for seed in range(1000)]
    early = sum(number <= 1 for number in ends) / len(ends)
    by_tenth = sum(number <= 2 for number in ends) / len(ends)
    print(f"stopped at the first 2 %: {early:.1%}, by 10 %: {by_tenth:.1%}")
    assert early == pytest.approx(1 - 0.98**25, abs=0.047)  # 3 sigma
    assert by_tenth > 0.8
    assert sum(number <= 3 for number in ends) > 0.99 * len(ends)


class PowerCutError(Exception):
    """The computer goes off."""


class Panel(FallBack):
    """A device with its folders, the fall-back script, and a clock, whose power is cut now and then while it updates."""

    def __init__(self, root, machine_id, repository, chance):
        self.chance = chance
        self.layout = Layout(root, repository.root_json, root / "machine-id")
        for name in ("releases", "store", "state", "requests", "download", "tools"):
            (root / name).mkdir(parents=True)
        self.tools = root / "tools"
        self.layout.machine_id.write_text(f"{machine_id}\n")
        self.late = chance.random() < 0.1  # without a clock: it begins in 1970 at each start
        self.since, self.cuts = None, 0

    def adopt(self, manifest):
        """The first release, as the Debian package installs it."""
        self.build(manifest)
        (self.layout.state / "current").write_text(f"{manifest.version}\n")
        self.layout.current.symlink_to(f"releases/{manifest.version}")

    def build(self, manifest):
        """As `install` does, but for its environment."""
        if not self.layout.release(manifest.version).exists():
            self.add(manifest.version)
            (self.layout.release(manifest.version) / MANIFEST).write_bytes(manifest.to_json())

    def look(self, source, now):
        """What haptic-panel-update.service does each day, until nothing is left to do."""
        manifest, clock = None, datetime(1970, 1, 1, tzinfo=UTC) if self.late else now
        while manifest is None:
            try:
                manifest = fetch(self.layout, UpdateSettings(), str(source), self.progress, clock)
            except PowerCutError:
                self.cuts += 1
            except NotYetError:
                return
        if manifest.version == self.current:
            return
        self.unit_state("active")
        self.build(manifest)
        self.asked_for("trial", manifest.version)
        assert self.evaluated(manifest.version) is Verdict.GOOD
        self.asked_for("good", manifest.version)
        assert (self.current, self.layout.word("current"), self.layout.word("trial")) == (manifest.version, manifest.version, "")
        self.since = now

    def progress(self, *_):
        if self.chance.random() < 0.1:
            raise PowerCutError

    def asked_for(self, what, version):
        """Ask the fall-back script, cut at one of its commands; then the device starts again, on a whole release."""
        ask(self.layout, what, version)
        cut = self.run("requests", path=cutting(self, self.chance.randrange(1, 12), before=self.chance.random() < 0.5))
        self.cuts += cut.returncode < 0
        for command in ("boot", "requests", "boot") if cut.returncode < 0 else ("boot",):
            self.run(command)
            assert self.layout.is_complete(self.current)

    def evaluated(self, version):
        """The trial, by the product's code on a clock of its own: the board serves, bad or not."""
        file, clock = self.layout.root / "status.json", [500.0]

        def wait(seconds):
            clock[0] += seconds
            file.write_bytes(msgspec.json.encode(report(version, written_s=clock[0], heartbeats=int(clock[0]))))

        wait(1.0)
        return judge_trial(self.layout, 20.0, lambda _: None, file, lambda: clock[0], wait)

    def reported(self, now, *, bad):
        """What `haptic-panel status --json` prints."""
        slow = {"upload": SLOW} if bad and self.since and now - self.since > timedelta(hours=12) else {}
        return msgspec.json.encode(report(self.current, updates=update_state(self.layout), **slow))


SEED = 4  # a fleet in which one of the first 2 % of the devices has a bad board


@pytest.mark.slow
def test_a_release_that_only_the_field_shows_to_be_bad_stops_by_itself(tmp_path, monkeypatch, capfd):
    """The real client, trial, fall-back script, reports and signatures; power cuts throughout; a tenth has no clock."""
    monkeypatch.setattr(os, "fsync", lambda _: None)  # its tests are those of power cuts
    monkeypatch.setattr("controller.device.update.download.fetch.RESERVE_BYTES", 0)
    repository = TinyRepository(tmp_path / "repository", tmp_path / "keys")
    for counter, version in enumerate(("1.0.0", "1.1.0"), 1):
        release_folder(tmp_path / version, version, counter)
    first = repository.publish(tmp_path / "1.0.0")
    repository.publish(tmp_path / "1.1.0", rollout=ROLLOUT)
    identities, bad = drawn(SEED)
    chance = random.Random(SEED)
    panels = [Panel(tmp_path / "devices" / name, name, repository, chance) for name in identities]
    for panel in panels:
        panel.adopt(first)
    reports, stopped = tmp_path / "reports", None
    reports.mkdir()
    for day in range(2 * len(SHARES)):
        now = NOW + day * DAY
        for panel, name in zip(panels, identities, strict=True):
            panel.look(repository.folder, now)
            (reports / f"{name}.json").write_bytes(panel.reported(now + 0.9 * DAY, bad=name in bad))
            os.utime(reports / f"{name}.json", ((now + 0.9 * DAY).timestamp(),) * 2)
        evening = NOW + (day + 0.9) * DAY
        with Repository.opened(repository.folder) as opened:
            figures = rollout_figures(opened, "stable", read_fleet(reports, evening, 86_400), evening)
            if stopped is None and figures["offers"][0]["propose"] == "stop":
                draft_stop(opened, "1.1.0", evening)
                stopped = day
                with capfd.disabled():
                    print(f"\n{fleet_table(figures)}")
        if stopped == day:
            assert repository.sign("publisher")
        elif stopped is not None and day > stopped + 2:
            break
    having = [panel for panel in panels if panel.since]
    with capfd.disabled():
        print(
            f"\nstopped on day {stopped}: {len(having)} of {DEVICES} devices ever had it; {sum(p.cuts for p in panels)} power cuts"
        )
    assert stopped is not None
    assert 0 < len(having) <= 0.02 * DEVICES
    assert all(panel.layout.is_complete(panel.current) for panel in panels)  # no bricks
    assert {panel.current for panel in panels if panel.since is None} == {"1.0.0"}
