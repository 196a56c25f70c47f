"""The office's one key used by a thief, and clocks that were wrong for a day: devices take updates again, and no old ones."""

import shutil
from datetime import UTC, datetime, timedelta

import pytest
from repository_fixture import Device, copied
from tables import each_row
from tiny_release import NOW, PASSPHRASE, TinyRepository, release_folder
from tuf.api.metadata import Metadata

from controller.cli import main
from controller.device.update.download.fetch import fetch
from controller.device.update.settings import UpdateSettings
from controller.device.update.trust import clock
from controller.errors import UpdateError
from controller.workshop.publish import metadata
from controller.workshop.publish.keys import new_key, open_key, read_public
from controller.workshop.publish.metadata import ROLES
from controller.workshop.publish.publications import draft_keys, draft_releases, draft_renewal
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.stick import export

DAY = timedelta(days=1)
NO_CLOCK = datetime(1970, 1, 1, tzinfo=UTC)


class Fleet:
    """An owner's repository, and one device of the many that read it; it has release 1.0.0."""

    def __init__(self, folder):
        self.folder = folder
        self.owner = TinyRepository(folder / "repository", folder / "keys")
        self.key = self.owner.signers["publisher"]  # will be stolen
        self.device = Device(folder, self.owner.root_json.read_bytes())
        self.one = self.release("1.0.0", 1)
        assert self.update() == self.one
        self.device.install(self.one)
        self.old = copied(self.owner.folder, folder / "old")

    def release(self, version, counter):
        release_folder(self.folder / version, version, counter, built_s=0)
        return self.owner.publish(self.folder / version)

    def update(self, source=None, now=NO_CLOCK):
        return fetch(self.device.layout, UpdateSettings(), str(source or self.owner.folder), lambda *_: None, now)

    def kept(self):
        return clock.Kept.read(self.device.layout.download / "clock")

    def stolen(self, issued, versions=1):
        """A repository whose timestamp a thief of the one key has made."""
        attacked = copied(self.owner.folder, self.folder / f"attacked at {clock.as_text(issued)}, {versions}")
        file = attacked / "metadata/timestamp.json"
        timestamp = Metadata.from_file(str(file))
        timestamp.signed.version += versions
        timestamp.signed.unrecognized_fields["x-issued"] = clock.as_text(issued)
        timestamp.signed.expires = issued + 3650 * DAY
        timestamp.sign(self.key)
        timestamp.to_file(str(file))
        return attacked

    def renew(self):
        with Repository.opened(self.owner.folder) as repository:
            draft_renewal(repository, self.owner.now)
            assert self.signed(repository)

    def signed(self, repository):
        """Whether a draft was published, once all whose keys count have signed it."""
        counting = {key_id for role in ROLES if repository.drafted(role) for key_id in repository.signers(role)}
        for signer in self.owner.signers.values():
            if signer.public_key.keyid in counting:
                repository.sign(signer)
        return repository.publish()

    def rotate(self):
        """Another key for the office, signed by two people."""
        public = read_public(new_key(self.folder / "keys/office2.pem", PASSPHRASE))
        signer, stolen = open_key(self.folder / "keys/office2.pem", PASSPHRASE), self.owner.public["publisher"]
        change = [{role: [key] for role in ("snapshot", "timestamp")} for key in (public, stolen)]
        with Repository.opened(self.owner.folder) as repository:
            draft_keys(repository, *change, None, self.owner.now)
        self.owner.signers["publisher"], self.owner.public["publisher"] = signer, public
        assert self.owner.sign()


@pytest.fixture
def fleet(tmp_path):
    return Fleet(tmp_path)


def test_a_stolen_timestamp_key_used_once_is_over_with_the_owners_next_timestamps(fleet):
    """Without a rotation, without a clock, and with one."""
    attacked = fleet.stolen(NOW + 3650 * DAY)
    for _ in range(20):  # looked at every day
        assert fleet.update(attacked) == fleet.one
    assert fleet.kept().moment == NOW + 90 * DAY
    fleet.owner.now = NOW + 30 * DAY
    fleet.renew()  # of the version that the thief has used, too
    fleet.renew()
    two = fleet.release("1.1.0", 2)
    for now in (NO_CLOCK, fleet.owner.now):
        assert fleet.update(now=now) == two
    with pytest.raises(UpdateError, match="is older than what this device has seen"):
        fleet.update(fleet.old)


def test_a_stolen_timestamp_key_used_on_and_on_is_over_with_a_rotation(fleet):
    for versions in range(1, 10):
        assert fleet.update(fleet.stolen(NOW + 3650 * DAY, versions)) == fleet.one
    assert fleet.kept().moment == NOW + 730 * DAY  # never beyond what two people have signed
    fleet.owner.now = NOW + 5 * DAY
    with pytest.raises(UpdateError, match="is older than what this device has seen"):  # its versions are behind the thief's
        fleet.update()
    fleet.rotate()
    two = fleet.release("1.1.0", 2)
    assert fleet.update() == two
    assert fleet.kept() == clock.Kept(NOW + 5 * DAY, 2, 4)
    for old in (fleet.old, fleet.stolen(NOW + 3650 * DAY, 20)):
        with pytest.raises(UpdateError, match=r"is older than what|is not signed by this device's owner"):
            fleet.update(old)


@pytest.mark.parametrize("rotated", [False, True])
def test_what_was_kept_still_refuses_an_old_repository_after_all_metadata_was_lost(fleet, rotated):
    """A device without a clock; its counter of releases is as far as the old repository's."""
    fleet.owner.now = NOW + 60 * DAY
    if rotated:
        fleet.rotate()
    fleet.renew()
    fleet.update()
    fleet.owner.now = NOW + 120 * DAY
    fleet.renew()
    fleet.update()
    shutil.rmtree(fleet.device.layout.download / "metadata")
    with pytest.raises(UpdateError, match=r"timestamp.json is expired \(it is 2027-03-22T12:00:00Z here\)"):
        fleet.update(fleet.old)
    assert fleet.update() == fleet.one


def test_a_time_that_an_earlier_release_has_kept_is_believed_no_longer(fleet):
    """A fleet that was stopped by such a timestamp already."""
    (fleet.device.layout.download / "clock").write_text("2031-11-21T12:00:00Z\n")
    assert clock.earliest(fleet.device.layout.download / "clock", 0) == datetime(2031, 11, 21, 12, tzinfo=UTC)
    assert fleet.update(now=NOW) == fleet.one
    assert fleet.kept() == clock.Kept(NOW, 1, 2)


def test_a_damaged_file_holds_no_time(fleet):
    file = fleet.device.layout.download / "clock"
    for text in ("2026-11-22T12:00:00Z 1", "2026-11-22T12:00:00Z x 2", "2026-11-22T12:00:00Z 1 2 3", "\n", "\xe2"):
        file.write_bytes(text.encode("latin-1"))
        assert clock.Kept.read(file) is None
        assert fleet.update() == fleet.one
        assert fleet.kept() == clock.Kept(NOW, 1, 2)


WRONG = [(-1, "earlier than the last one"), (91, "more than 90 days after the last one"), (3650, "more than 90 days after")]


@each_row(("days", "said"), WRONG, afresh=[fleet])
def test_nothing_is_drafted_by_a_clock_that_is_wrong(fleet, days, said):
    wrong = NOW + days * DAY
    release_folder(fleet.folder / "2.0.0", "2.0.0", 2)
    before = (fleet.owner.folder / "metadata/timestamp.json").read_bytes()
    with Repository.opened(fleet.owner.folder) as repository:
        drafts = (
            lambda: draft_renewal(repository, wrong),
            lambda: draft_releases(repository, [fleet.folder / "2.0.0"], "stable", wrong),
            lambda: draft_keys(repository, {}, {}, 1, wrong),
            lambda: export(repository, fleet.folder / "stick", fleet.owner.signers["publisher"], wrong),
        )
        for draft in drafts:
            with pytest.raises(UpdateError, match=said):
                draft()
        assert not repository.draft.exists()
    assert (fleet.owner.folder / "metadata/timestamp.json").read_bytes() == before
    for near in (NOW, NOW + 90 * DAY):
        fleet.owner.now = near
        fleet.renew()


@each_row(("days", "said"), WRONG, afresh=[fleet])
def test_no_draft_of_a_clock_that_is_wrong_is_signed(fleet, days, said):
    """Made by an earlier release, or while another timestamp was published."""
    wrong = NOW + days * DAY
    with Repository.opened(fleet.owner.folder, dated=f"{wrong:%Y-%m-%d}") as repository:
        draft_renewal(repository, wrong)
    for dated in (None, f"{NOW:%Y-%m-%d}"):
        with Repository.opened(fleet.owner.folder, dated=dated) as repository, pytest.raises(UpdateError, match=said):
            repository.sign(fleet.owner.signers["publisher"])
    with Repository.opened(fleet.owner.folder, dated=f"{wrong:%Y-%m-%d}") as repository:  # two people know better
        assert fleet.signed(repository)


def test_the_commands_take_a_date_that_was_looked_up(fleet, monkeypatch, capsys):
    def command(*words):
        return main(["update", "repository", *map(str, words)])

    monkeypatch.setenv("HAPTIC_PANEL_PASSPHRASE", PASSPHRASE)
    key = fleet.folder / "keys/publisher.pem"
    monkeypatch.setattr(metadata, "now", lambda: NOW + 100 * DAY)
    assert command("renew", fleet.owner.folder) == 1
    assert capsys.readouterr().err.endswith("if it is right, add --date 2027-03-02\n")
    assert command("renew", fleet.owner.folder, "--date", "tomorrow") == 2
    assert "'tomorrow' is no date such as 2027-03-28" in capsys.readouterr().err
    assert command("renew", fleet.owner.folder, "--date", "2027-03-02") == 0
    assert command("sign", fleet.owner.folder, "--key", key) == 1
    assert "add --date 2027-03-02" in capsys.readouterr().err
    assert command("sign", fleet.owner.folder, "--key", key, "--date", "2027-03-02") == 0
    assert fleet.update() == fleet.one


@each_row("days", [-1, 91, 3650], afresh=[fleet])
def test_a_signer_with_another_clock_does_not_sign(fleet, monkeypatch, capsys, days):
    """The first draft too, which follows none."""
    monkeypatch.setenv("HAPTIC_PANEL_PASSPHRASE", PASSPHRASE)
    with Repository.opened(fleet.owner.folder) as repository:
        draft_renewal(repository, NOW)
    words = ["update", "repository", "sign", str(fleet.owner.folder), "--key", str(fleet.folder / "keys/publisher.pem")]
    monkeypatch.setattr(metadata, "now", lambda: NOW + days * DAY)
    assert main(words) == 1
    reported = capsys.readouterr().err
    assert "timestamp.json: was made at 2026-11-22T12:00:00Z, and it is" in reported
    assert "timestamp version 3 of 2026-11-22, until 2027-02-20" in reported
    monkeypatch.setattr(metadata, "now", lambda: NOW + 89 * DAY)
    assert main(words) == 0
