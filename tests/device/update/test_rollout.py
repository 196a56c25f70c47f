"""A rollout in steps: who may take a release when, what a wrong clock changes, and what a stop does."""

import json
from datetime import timedelta
from functools import partial

import pytest
from repository_fixture import NOW, Device
from tables import each_row
from tiny_release import PASSPHRASE, TinyRepository, release_folder

from controller.cli import main
from controller.device.update.download.fetch import check, fetch
from controller.device.update.settings import UpdateSettings
from controller.device.update.trust.offer import NotYetError
from controller.device.update.trust.rollout import ALL_PPM, place_of, place_ppm, read_rollout
from controller.errors import UpdateError, UsageError
from controller.workshop.publish.publications import draft_open, draft_releases, draft_renewal, draft_rollout, draft_stop
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.shares import rollout_of
from controller.workshop.publish.stick import export

DAY = timedelta(days=1)
IDENTITIES = [f"{number:032x}" for number in range(2000)]
FIRST = min(IDENTITIES, key=lambda name: place_ppm(name, "1.0.0"))
LAST = max(IDENTITIES, key=lambda name: place_ppm(name, "1.0.0"))


def steps(*pairs):
    """Pairs of percent, and days from NOW."""
    return rollout_of([f"{percent}%@{(NOW + days * DAY).isoformat()}" for percent, days in pairs])


class Rolled:
    """A repository with a release in two steps, and devices of this identity."""

    def __init__(self, folder):
        self.folder = folder
        self.repository = TinyRepository(folder / "repository", folder / "keys")
        release_folder(folder / "1", "1.0.0", 1)
        self.draft(draft_releases, [folder / "1"], "stable", NOW, steps((1, 1), (100, 3)))

    def open(self, **what):
        self.draft(partial(draft_open, **what), "1.0.0", NOW, who=("publisher",))

    def draft(self, make, *arguments, who=()):
        with Repository.opened(self.repository.folder) as opened:
            make(opened, *arguments)
        assert self.repository.sign(*who)

    @property
    def opened(self):
        return Repository(self.repository.folder).published("timestamp").signed.unrecognized_fields["x-opened"]

    def device(self, identity):
        place = self.folder / identity
        place.mkdir()
        device = Device(place, self.repository.root_json.read_bytes())
        (place / "machine-id").write_text(f"{identity}\n")
        object.__setattr__(device.layout, "machine_id", place / "machine-id")
        return device

    def offer(self, device, now):
        return check(device.layout, UpdateSettings(), str(self.repository.folder), now)[0]

    def fetch(self, device, now):
        return fetch(device.layout, UpdateSettings(), str(self.repository.folder), lambda *_: None, now)


@pytest.fixture
def rolled(tmp_path):
    return Rolled(tmp_path)


def test_places_are_spread_evenly_and_unrelated_between_releases():
    """10,000 devices: of each tenth of the order as many as a binomial distribution allows (4 sigma)."""
    names = [f"{number:032x}" for number in range(10_000)]
    one, other = ([place_ppm(name, version) for name in names] for version in ("1.0.0", "1.1.0"))
    for places in (one, other):
        assert all(0 <= place < ALL_PPM for place in places)
        counts = [sum(place * 10 // ALL_PPM == tenth for place in places) for tenth in range(10)]
        assert all(abs(count - 1000) < 120 for count in counts)
    early = [a < ALL_PPM // 10 and b < ALL_PPM // 10 for a, b in zip(one, other, strict=True)]
    assert abs(sum(early) - 100) < 40
    assert place_ppm("1" * 32, "1.0.0") == 62_491  # by sha256sum: every release of a device has to agree on it


def test_a_share_comes_with_its_time(rolled):
    first, last = rolled.device(FIRST), rolled.device(LAST)
    assert "1 % of the devices" not in rolled.offer(first, NOW).waits
    assert "is for 0 % of the devices at 2026-11-22T12:00:00Z, and for this one from 2026-11-23" in rolled.offer(first, NOW).waits
    assert rolled.offer(first, NOW + DAY - timedelta(seconds=1)).waits
    assert rolled.offer(first, NOW + DAY).is_new
    before = last.kept()
    with pytest.raises(NotYetError, match=r"is for 1 % of the devices .* and for this one from 2026-11-25T12:00:00Z on, once its"):
        rolled.fetch(last, NOW + 9 * DAY)
    assert last.kept() == before
    rolled.open()
    assert "for this one from 2026-11-25T12:00:00Z on" in rolled.offer(last, NOW + 2 * DAY).waits
    assert "once" not in rolled.offer(last, NOW + 2 * DAY).waits
    assert rolled.fetch(last, NOW + 3 * DAY).version == "1.0.0"


def test_a_clock_that_is_late_is_led_by_the_signed_time(rolled):
    """Without a clock the timestamp's time counts; one that is ahead is early by no more than the timestamp's life."""
    device = rolled.device(FIRST)
    long_ago = NOW - 5000 * DAY
    assert rolled.offer(device, long_ago).waits
    rolled.draft(draft_renewal, NOW + DAY, who=("publisher",))
    assert rolled.offer(device, long_ago).is_new
    with pytest.raises(UpdateError, match="expired"):
        rolled.offer(device, NOW + 92 * DAY)


def test_a_device_without_an_identity_is_the_last(rolled):
    device = rolled.device(FIRST)
    for text in ("", "uninitialized\n", "é" * 16):
        device.layout.machine_id.write_text(text)
        assert place_of(device.layout, "1.0.0") == ALL_PPM - 1
    device.layout.machine_id.unlink()
    assert "from 2026-11-25" in rolled.offer(device, NOW + DAY).waits
    rolled.open()
    assert rolled.offer(device, NOW + 3 * DAY).is_new


def test_steps_are_opened_one_after_the_other_or_all(rolled):
    """By the office alone; the share stays open when a later release's step is, and goes with the last channel that offers it."""
    rolled.draft(draft_rollout, "1.0.0", steps((1, 0), (2, 1), (10, 2), (99, 3)), NOW)
    for what, opened in (({}, 20_000), ({}, 100_000), ({"everything": True}, 990_000)):
        rolled.open(**what)
        assert rolled.opened == {"1.0.0": opened}
    with (
        Repository.opened(rolled.repository.folder) as opened,
        pytest.raises(UpdateError, match=r"1\.0\.0 has no step that is not open"),
    ):
        draft_open(opened, "1.0.0", NOW)
    rolled.draft(draft_rollout, "1.0.0", steps((1, 0), (2, 4), (50, 5)), NOW)
    assert rolled.opened == {}, "other steps wait again: a share may go back, and nobody has looked at what follows it"
    rolled.open()
    assert rolled.opened == {"1.0.0": 20_000}
    release_folder(rolled.folder / "2", "1.0.1", 2)
    rolled.draft(draft_releases, [rolled.folder / "2"], "stable", NOW, steps((1, 0), (10, 1)))
    rolled.draft(draft_open, "1.0.1", NOW, who=("publisher",))
    assert rolled.opened == {"1.0.1": 100_000}


def test_a_stop_is_signed_by_one_and_no_command_undoes_it(rolled, tmp_path):
    has_it, has_not = rolled.device(FIRST), rolled.device(LAST)
    has_it.install(rolled.fetch(has_it, NOW + DAY))
    rolled.draft(draft_stop, "1.0.0", NOW + DAY, who=("publisher",))
    rolled.draft(draft_renewal, NOW + DAY, who=("publisher",))  # which forgets no stop
    assert "was stopped by its publisher" in rolled.offer(has_not, NOW + 9 * DAY).waits
    offer = rolled.offer(has_it, NOW + 9 * DAY)
    assert (offer.waits, offer.refused, offer.is_new) == ("", "", False)
    with Repository.opened(rolled.repository.folder) as opened:
        export(opened, tmp_path / "stick", rolled.repository.signers["publisher"], NOW + DAY)
        stick = check(has_not.layout, UpdateSettings(), str(tmp_path / "stick"), NOW + 9 * DAY)[0]
        assert "was stopped by its publisher" in stick.waits
        for make in (
            lambda: draft_stop(opened, "1.0.0", NOW + DAY),
            lambda: draft_rollout(opened, "1.0.0", steps((100, 0)), NOW + DAY),
            lambda: draft_releases(opened, [tmp_path / "1"], "beta", NOW + DAY),
        ):
            with pytest.raises(UpdateError, match=r"release 1\.0\.0 is stopped, for good"):
                make()
        with pytest.raises(UpdateError, match=r"has no release 9\.0"):
            draft_stop(opened, "9.0", NOW + DAY)
    release_folder(tmp_path / "2", "1.0.1", 2)
    rolled.draft(draft_releases, [tmp_path / "2"], "stable", NOW + DAY)
    assert rolled.offer(has_not, NOW + DAY).is_new
    assert rolled.offer(has_it, NOW + DAY).is_new


def test_other_steps_need_two_people(rolled):
    last = rolled.device(LAST)
    with Repository.opened(rolled.repository.folder) as opened:
        draft_rollout(opened, "1.0.0", steps((1, 0), (99.9999, 2)), NOW)
    assert not rolled.repository.sign("alice", "publisher")
    assert rolled.repository.sign("bob")
    assert "from 2026-11-24" in rolled.offer(last, NOW).waits
    rolled.open()
    assert rolled.offer(last, NOW + 2 * DAY).is_new


def test_steps_stay_when_a_release_joins_another_channel(rolled, tmp_path):
    rolled.draft(draft_releases, [tmp_path / "1"], "beta", NOW)
    assert rolled.offer(rolled.device(FIRST), NOW).waits


@each_row(
    ("shares", "said"),
    [
        (["1%"], "--share 1%: is no share from a time on"),
        (["1@2026-12-01T08:00Z"], "is no share"),
        (["nan%@2026-12-01T08:00Z"], "is no share"),
        (["-1%@2026-12-01T08:00Z"], "is no share"),
        (["1e999999999%@2026-12-01T08:00Z"], "is no share"),
        (["0.00001%@2026-12-01T08:00Z"], "is no share"),
        (["1%@2026-12-01T08:00"], "in UTC (Z) or with its zone"),
        (["1%@tomorrow"], "is no share"),
        (["1%@0001-01-01T00:00+14:00"], "is no share"),
        (["1%@1999-12-01T08:00Z"], "is not between 2020 and 2200"),
        (["0%@2026-12-01T08:00Z"], "must be above 0 and at most 100 %"),
        (["100.0001%@2026-12-01T08:00Z"], "must be above 0 and at most 100 %"),
        (["10%@2026-12-01T08:00Z", "1%@2026-12-02T08:00Z"], "1 % from 2026-12-02T08:00:00Z does not follow 10 %"),
        (["1%@2026-12-01T08:00Z", "1%@2026-12-02T08:00Z"], "shares and times both increase"),
        (["1%@2026-12-02T08:00Z", "10%@2026-12-01T08:00Z"], "shares and times both increase"),
        (["1%@2026-12-01T08:00Z", "10%@2026-12-01T09:00+01:00"], "shares and times both increase"),
        ([f"{n}%@2026-12-01T08:{n:02}Z" for n in range(1, 34)], "32"),
    ],
)
def test_shares_that_are_nonsense_are_refused(shares, said):
    with pytest.raises(UsageError) as reported:
        rollout_of(shares)
    assert said in str(reported.value)
    assert "\n" not in str(reported.value)


STEP = {"share_ppm": 10_000, "at": "2026-12-01T08:00:00Z"}


@each_row(
    "custom",
    [
        [],
        {"rollout": None},
        {"rollout": {}},
        {"rollout": {"steps": []}},
        {"rollout": {"steps": [STEP], "more": 1}},
        {"rollout": {"steps": [STEP, STEP]}},
        {"rollout": {"steps": [STEP | {"share_ppm": 0}]}},
        {"rollout": {"steps": [STEP | {"share_ppm": 1_000_001}]}},
        {"rollout": {"steps": [STEP | {"share_ppm": "10000"}]}},
        {"rollout": {"steps": [STEP | {"share_ppm": float("nan")}]}},
        {"rollout": {"steps": [STEP | {"at": "2026-12-01T08:00:00"}]}},
        {"rollout": {"steps": [STEP | {"at": "soon"}]}},
    ],
)
def test_signed_nonsense_hands_out_nothing(custom):
    with pytest.raises(UpdateError, match="refused; the repository has to be made again"):
        read_rollout(custom, "here")


@each_row(
    ("field", "value"),
    [
        ("x-stopped", "1.0.0"),
        ("x-opened", []),
        ("x-opened", {"1.0.0": 1_000_001}),
        ("x-opened", {"1.0.0": True}),
        ("x-opened", {"1.0.0": "1"}),
    ],
)
def test_a_timestamp_with_damaged_stops_or_openings_is_refused(tmp_path, field, value):
    rolled = Rolled(tmp_path)
    with Repository.opened(rolled.repository.folder) as opened:
        timestamp = opened.changed("timestamp", NOW)
        timestamp.signed.unrecognized_fields[field] = value
        opened.begin({"timestamp": timestamp})
    assert rolled.repository.sign("publisher")
    with pytest.raises(UpdateError, match=f"{field} of its timestamp is no (list|share)"):
        rolled.offer(rolled.device(FIRST), NOW + DAY)


def test_the_commands_say_it_in_one_line(tmp_path, monkeypatch, capsys):
    """Publisher: shares, what is signed, a stop. Device: exit code 0 and nothing to do."""
    repository = TinyRepository(tmp_path / "repository", tmp_path / "keys")
    monkeypatch.setattr("controller.workshop.publish.metadata.now", lambda: NOW)
    monkeypatch.setenv("HAPTIC_PANEL_PASSPHRASE", PASSPHRASE)
    release_folder(tmp_path / "1", "1.0.0", 1)
    folder = str(repository.folder)

    def publisher(*words, who=("alice", "bob", "publisher")):
        assert main(["update", "repository", *words]) == 0
        for name in who:
            assert main(["update", "repository", "sign", folder, "--key", str(tmp_path / f"keys/{name}.pem")]) == 0
        return capsys.readouterr()

    said = publisher("add", folder, str(tmp_path / "1"), "--share", "1%@2199-01-01T00:00Z").err
    assert ": 1 % from 2199-01-01T00:00:00Z" in said
    device = Device(tmp_path, repository.root_json.read_bytes())
    monkeypatch.setenv("HAPTIC_PANEL_ROOT", str(device.layout.root))
    monkeypatch.setenv("HAPTIC_PANEL_TRUSTED_ROOT", str(device.layout.trusted_root))
    for command in ("check", "download", "install"):
        assert main(["update", command, "--from", folder]) == 0
        said = capsys.readouterr().out
        assert said.count("\n") == 1
        assert "is for 0 % of the devices" in said
        assert said.endswith("nothing to do\n")
    publisher("rollout", folder, "1.0.0", "--share", "100%@2026-01-01T00:00Z")
    assert main(["update", "check", "--json", "--from", folder]) == 0
    assert json.loads(capsys.readouterr().out)["new"]
    publisher("rollout", folder, "1.0.0", "--share", "1%@2026-01-01T00:00Z", "--share", "100%@2026-01-02T00:00Z")
    assert "opened: steps of 1.0.0 up to 100 %" in publisher("open", folder, "1.0.0", who=("publisher",)).err
    assert main(["update", "check", "--json", "--from", folder]) == 0
    assert json.loads(capsys.readouterr().out)["new"]
    assert "stopped: 1.0.0" in publisher("stop", folder, "1.0.0", who=("publisher",)).err
    assert main(["update", "check", "--from", folder]) == 0
    assert (
        "was stopped by its publisher: only devices that have it keep it; no release stays: nothing to do"
        in capsys.readouterr().out
    )
    assert main(["update", "repository", "rollout", folder, "1.0.0", "--share", "1%"]) == 2
    assert "--share 1%: is no share" in capsys.readouterr().err
