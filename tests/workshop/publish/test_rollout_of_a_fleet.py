"""500 devices, and a release that is bad on 25 boards in a way that no trial shows: how many ever have it."""

import os
import random
from bisect import bisect_left
from datetime import UTC, datetime, timedelta

import msgspec
import numpy as np
import pytest
from repository_fixture import NOW
from scipy.stats import binom, hypergeom, poisson
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
from controller.workshop.publish.fleet import Fleet, Tally, at_least, fleet_table, proposal, read_fleet, rollout_figures
from controller.workshop.publish.publications import draft_open, draft_stop
from controller.workshop.publish.publisher import Repository

DEVICES, BAD = 500, 25
HARMED_MAX = 10  # 2 % of them
SHARES = (1, 2, 5, 10, 20, 50, 100)  # in percent, every other day: as publishing.md recommends
ROLLOUT = steps(*((share, 2 * index) for index, share in enumerate(SHARES)))
SLOW = LatencyStatus(50_000, 3000.0, 8000.0, 20_000.0)  # as a bad board reports after a day; a trial has too few emissions for it


def drawn(seed):
    """Machine-ids of a fleet, and those of its bad boards."""
    names = random.Random(seed)
    identities = [f"{names.getrandbits(128):032x}" for _ in range(DEVICES)]
    return identities, set(names.sample(identities, BAD))


def outcome(seed):
    """How many devices have a release by the product's rule, how many of them are bad, and the first bad one's place in line."""
    identities, bad = drawn(seed)
    places = sorted(place_ppm(name, "1.1.0") for name in identities)
    of_bad = sorted(place_ppm(name, "1.1.0") for name in bad)
    opened_ppm, now = 0, NOW
    for _ in ROLLOUT.steps:
        now += 2 * DAY
        having, faulted = (bisect_left(each, ROLLOUT.share_ppm(now, opened_ppm)) for each in (places, of_bad))
        tally = Tally(healthy=having - faulted, faulted=faulted)
        fleet = Fleet(DEVICES, {"1.1.0": tally, "1.0.0": Tally(healthy=DEVICES - having)})
        if proposal("1.1.0", ROLLOUT, opened_ppm, fleet, now)[0] != "open":
            break
        opened_ppm = next(step.share_ppm for step in ROLLOUT.steps[1:] if step.share_ppm > opened_ppm)
    return having, faulted, 1 + bisect_left(places, of_bad[0])


def harmed_more(shares, bad, most=HARMED_MAX):
    """Probability that more than `most` of the bad devices ever have a release: none below a step, so many up to the next."""
    steps = zip((0, *shares[:-1]), shares, strict=True)
    return sum((1 - below / 100) ** bad * binom.sf(most, bad, (share - below) / (100 - below)) for below, share in steps)


def test_few_devices_are_harmed_however_many_are_bad():
    """By design: growth waits for each step's opening, and one bad device withholds it. Larger steps would not do."""
    assert harmed_more(SHARES, BAD) == pytest.approx(0.0012, abs=1e-4)
    any_number = np.arange(1, DEVICES + 1)
    assert harmed_more(SHARES, any_number).max() == pytest.approx(0.0134, abs=1e-4)
    assert harmed_more((1, 10, 50, 100), any_number).max() == pytest.approx(0.18, abs=0.01)
    assert harmed_more(SHARES, np.arange(1, 251), 5).max() < 0.05 < harmed_more(SHARES, np.arange(1, 201), 4).max()


def test_chance_is_that_of_poisson_also_in_a_large_fleet():
    for expected in (0.0, 0.3, 5.0, 800.0, 20_000.0):
        for count in (0, 1, 7, round(expected), round(1.1 * expected) + 20):
            assert at_least(count, expected) == pytest.approx(poisson.sf(count - 1, expected), abs=1e-9)


def test_the_rule_does_what_the_formula_says():
    """1,000 fleets of which 5 % are bad: harmed, in the mean and at most, and how many have it, as chance gives.

    No rule that is shown a fault by bad boards alone ends before the first of them has the release.
    """
    having, harmed, first = np.array([outcome(seed) for seed in range(1000)]).T
    ends, few = np.mean(having <= HARMED_MAX), np.mean(first <= HARMED_MAX)
    print(f"harmed: {harmed.mean():.2f} in the mean, at most {harmed.max()}")
    print(f"have it: {having.mean():.0f} in the mean, in 95 % of fleets at most {np.quantile(having, 0.95):.0f}")
    print(f"at most {HARMED_MAX} have it in {ends:.0%} of fleets; the first bad board is among so many in {few:.0%}")
    assert harmed.max() <= HARMED_MAX
    assert harmed.mean() == pytest.approx(1.51, abs=0.1)
    assert having.mean() == pytest.approx(0.058 * DEVICES, abs=3)
    assert np.all(having[harmed > 0] >= first[harmed > 0])
    assert few == pytest.approx(hypergeom.sf(0, DEVICES, BAD, HARMED_MAX), abs=0.05)
    assert ends == pytest.approx(0.33, abs=0.05)
    assert np.mean(harmed == 0) == pytest.approx(0.99**DEVICES, abs=0.01)  # no device is among the first 1 %


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


SEED = 0  # any will do


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
    for day in range(3 * len(SHARES)):
        now = NOW + day * DAY
        for panel, name in zip(panels, identities, strict=True):
            panel.look(repository.folder, now)
            (reports / f"{name}.json").write_bytes(panel.reported(now + 0.9 * DAY, bad=name in bad))
            os.utime(reports / f"{name}.json", ((now + 0.9 * DAY).timestamp(),) * 2)
        evening = NOW + (day + 0.9) * DAY
        with Repository.opened(repository.folder) as opened:
            figures = rollout_figures(opened, "stable", read_fleet(reports, evening, 86_400), evening)
            propose = figures["offers"][0]["propose"]
            if propose in ("stop", "hold") and stopped is None:
                held, stopped = propose, day
                with capfd.disabled():
                    print(f"\n{fleet_table(figures)}")
            if propose == "open":
                draft_open(opened, "1.1.0", evening)
            elif stopped is not None and day == stopped + 3:  # nobody looked before: nothing grew meanwhile
                draft_stop(opened, "1.1.0", evening)
        if propose == "open" or (stopped is not None and day == stopped + 3):
            assert repository.sign("publisher")
        elif stopped is not None and day > stopped + 5:
            break
    having = [panel for panel in panels if panel.since]
    harmed = [panel for panel, name in zip(panels, identities, strict=True) if panel.since and name in bad]
    with capfd.disabled():
        print(
            f"\n{held} on day {stopped}: {len(having)} of {DEVICES} devices ever had it, {len(harmed)} of them bad; "
            f"{sum(p.cuts for p in panels)} power cuts"
        )
    assert 0 < len(harmed) <= HARMED_MAX
    assert all(panel.since <= NOW + stopped * DAY for panel in having)
    assert all(panel.layout.is_complete(panel.current) for panel in panels)  # no bricks
    assert {panel.current for panel in panels if panel.since is None} == {"1.0.0"}
