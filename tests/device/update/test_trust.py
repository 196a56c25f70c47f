"""What the owner did not sign is refused, with one line; releases, store and manifest stay as they were."""

import copy
import fcntl
import json
import os
import random
import shutil
from datetime import UTC, datetime, timedelta

import pytest
from repository_fixture import NOW, Device, Publisher, copied, key
from tables import each_row
from tuf.api.metadata import Metadata, MetaFile, Root, Snapshot, Targets, Timestamp

from controller.device.update.download.fetch import check, fetch
from controller.device.update.manifest import MANIFEST_BYTES_MAX, Channel
from controller.device.update.settings import UpdateSettings
from controller.device.update.trust import clock
from controller.errors import UpdateError

ONE = {"wheels/a.whl": b"wheel one", "boards/b/board.toml": b"board"}
TWO = {"wheels/a.whl": b"wheel two", "boards/b/board.toml": b"board"}


def quiet(done, total):
    assert 0 <= done <= total


class Case:
    """A repository in a folder with release 1.0, a device with it, and 1.1 published since."""

    def __init__(self, folder):
        self.publisher = Publisher(folder / "repository")
        self.one = self.publisher.release("1.0", 1, ONE)
        self.old = copied(self.publisher.folder, folder / "old")
        self.device = Device(folder, self.publisher.root)
        assert self.fetch() == self.one
        self.device.install(self.one)
        self.two = self.publisher.release("1.1", 2, TWO)
        self.folder = folder

    def moved(self, folder):
        """A copy elsewhere."""
        for name in ("repository", "haptic-panel"):
            shutil.copytree(self.folder / name, folder / name, symlinks=True, copy_function=shutil.copy)
        shutil.copyfile(self.folder / "root.json", folder / "root.json")
        other = copy.copy(self)
        other.publisher, other.device = self.publisher.moved(folder / "repository"), Device(folder)
        return other

    def fetch(self, source=None, now=NOW):
        return fetch(self.device.layout, UpdateSettings(), str(source or self.publisher.folder), quiet, now)

    def refused(self, said, source=None, now=NOW):
        before = self.device.kept()
        with pytest.raises(UpdateError, match=said) as reported:
            self.fetch(source, now)
        assert "\n" not in str(reported.value)
        assert self.device.kept() == before
        return str(reported.value)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return Case(tmp_path_factory.mktemp("made"))


@pytest.fixture
def case(made, tmp_path, monkeypatch):
    monkeypatch.setattr(os, "fsync", lambda _: None)  # its tests are those of power cuts
    return made.moved(tmp_path)


def test_what_the_owner_signed_is_fetched(case):
    offer, missing_bytes = check(case.device.layout, UpdateSettings(), str(case.publisher.folder), NOW)
    assert (offer.manifest, offer.installed, offer.refused, offer.is_new) == (case.two, case.one, "", True)
    assert missing_bytes == len(TWO["wheels/a.whl"])
    assert case.fetch() == case.two
    for file in case.two.files:
        stored = case.device.layout.store / file.sha256
        assert stored.read_bytes() == TWO[file.path]
        assert stored.stat().st_mode & 0o777 == 0o444
    assert (case.device.layout.download / "release.json").read_bytes() == case.two.to_json()
    assert (case.device.layout.download / "counter").read_text() == "2\n"
    case.device.install(case.two)
    before = case.device.kept()
    assert case.fetch() == case.two
    assert case.device.kept() == before


@pytest.mark.parametrize("role", ["root", "targets", "snapshot", "timestamp"])
def test_wrong_keys_are_refused(case, role):
    publisher = case.publisher
    publisher.signers[role] = [key("stranger")]
    if role == "root":  # a new root that the old root's key has not signed
        publisher.sign_root()
    publisher.publish()
    assert case.publisher.folder.name in case.refused("is not signed by this device's owner")


def test_another_owners_repository_is_refused(case, tmp_path):
    other = Publisher(tmp_path / "other", "another")
    other.release("9.0", 9, TWO)
    case.refused("is not signed by this device's owner", other.folder)


def test_a_trusted_root_of_another_owner_refuses_ours(case, tmp_path):
    case.device.layout.trusted_root.write_bytes(Publisher(tmp_path / "other", "another").root)
    case.refused("is not signed by this device's owner")


def test_a_damaged_trusted_root_is_reported(case):
    for root in (b"", b"{}", b"<html>"):
        case.device.layout.trusted_root.write_bytes(root)
        case.refused("root.json: is no root.json of a repository")


def test_an_absent_trusted_root_is_reported(case):
    case.device.layout.trusted_root.unlink()
    case.refused("root.json: cannot be read")


def test_rotated_keys_are_followed_from_the_first_root(case):
    publisher = case.publisher
    publisher.signers["targets"] = [key("targets 2")]
    publisher.sign_root()
    old_root = publisher.signers["root"]
    publisher.signers["root"] = [key("root 2")]
    publisher.sign_root([*old_root, key("root 2")])
    publisher.publish()
    assert case.fetch() == case.two


def test_an_old_repository_is_refused(case):
    case.fetch()
    assert "take a newer copy" in case.refused("is older than what this device has seen", case.old)


@pytest.mark.parametrize("emptied", [("metadata",), ("metadata", "counter"), ("metadata", "counter", "clock", "parts", "indexes")])
def test_an_old_repository_is_refused_after_all_metadata_was_lost(case, emptied):
    """The client by itself accepts it."""
    case.fetch()
    case.device.install(case.two)
    for name in emptied:
        place = case.device.layout.download / name
        shutil.rmtree(place) if place.is_dir() else place.unlink(missing_ok=True)
    case.refused("has counter 1, this device has had 2: no way back", case.old)


def test_a_release_of_the_counter_that_was_installed_is_taken_if_it_is_another(case):
    """Such as one whose notes were corrected; a smaller counter is refused, above."""
    case.fetch()
    again = case.publisher.release("2.1", case.two.counter, TWO)
    offer, _ = check(case.device.layout, UpdateSettings(), str(case.publisher.folder), NOW)
    assert (offer.manifest, offer.refused, offer.is_new) == (again, "", True)


def test_an_old_repository_is_refused_although_the_newer_release_is_not_installed(case):
    case.fetch()
    shutil.rmtree(case.device.layout.download / "metadata")
    offer, _ = check(case.device.layout, UpdateSettings(), str(case.old), NOW)
    assert offer.manifest == offer.installed == case.one  # the one in use: nothing to do
    assert not offer.is_new


@pytest.mark.parametrize(("role", "days"), [("timestamp", 91), ("snapshot", 731), ("targets", 731), ("root", 1826)])
def test_a_frozen_repository_is_refused(case, role, days):
    publisher = case.publisher
    publisher.days = dict.fromkeys(publisher.days, 4000) | {role: days - 1}
    if role == "root":
        publisher.sign_root()
    publisher.publish()
    said = case.refused("is expired", now=NOW + timedelta(days=days))
    assert "its owner has to sign it again, or this device's clock is wrong" in said
    assert case.fetch(now=NOW + timedelta(days=days - 2)) == case.two


def test_parts_of_different_ages_are_refused(case):
    metadata = case.publisher.folder / "metadata"
    shutil.copy(metadata / "1.targets.json", metadata / "2.targets.json")
    case.refused("of mixed ages")


def test_an_old_snapshot_under_a_new_timestamp_is_refused(case):
    case.fetch()
    publisher = case.publisher
    publisher.sign("timestamp", Timestamp(snapshot_meta=MetaFile(1)))
    case.refused("of mixed ages")


@pytest.mark.parametrize("name", ["timestamp", "2.snapshot", "2.targets"])
def test_garbage_is_no_metadata(case, name):
    for data in (b"", b"{", b"<html>login</html>", b"null", b"[]", b'{"signed": 1}', b"\xff" * 100):
        (case.publisher.folder / "metadata" / f"{name}.json").write_bytes(data)
        assert "does this network ask for a login" in case.refused("has no signed metadata")


def test_metadata_without_end_is_refused(case):
    for name in ("2.targets", "2.snapshot", "timestamp", "2.root"):
        (case.publisher.folder / "metadata" / f"{name}.json").write_bytes(b" " * 3_000_000)
        case.refused("more, or less, than was signed")


def test_a_platform_without_a_release_is_reported(case):
    case.publisher.offer("stable", {"riscv64-cp311": "releases/1.1/riscv64-cp311.json"})
    case.refused("has no release for .*, but for riscv64-cp311")


def test_a_damaged_channel_is_reported(case):
    for data in (b"", b"[]", b"null", b"{}", b'{"releases": {"a": 1}}', b'{"releases": {}, "x": 1}', b"[" * 60_000):
        case.publisher.targets["channels/stable.json"] = data
        case.publisher.publish()
        case.refused("channels/stable.json: ")


def test_an_absent_channel_is_reported(case):
    settings = UpdateSettings(channel="nightly")
    with pytest.raises(UpdateError, match=r"has no channels/nightly\.json"):
        fetch(case.device.layout, settings, str(case.publisher.folder), quiet, NOW)


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"counter": 0}, "has counter 0, this device has had 1"),
        ({"minimum_counter": 2}, "needs a release of counter 2 or more before it: install that first"),
        ({"fall_back": 2}, "needs a newer Debian package haptic-panel"),
    ],
)
def test_a_release_that_does_not_fit_is_reported(case, fields, said):
    case.publisher.release("1.2", **({"counter": 3, "files": TWO} | fields))
    offer, missing_bytes = check(case.device.layout, UpdateSettings(), str(case.publisher.folder), NOW)
    assert said in offer.refused
    assert (offer.is_new, missing_bytes) == (False, 0)
    case.refused(said)


def test_a_release_that_failed_here_is_not_taken_again(case):
    (case.device.layout.state / "failed").write_text("0.9\n1.1\n")
    case.refused("release 1.1 has failed on this device: a later one is needed")
    three = case.publisher.release("1.2", 3, TWO)
    assert case.fetch() == three


def test_where_the_failed_cannot_be_read_nothing_is_taken(case):
    (case.device.layout.state / "failed").mkdir()
    case.refused("state/failed: cannot be read .Is a directory., so that no release is taken")


def test_a_manifest_under_another_releases_name_is_refused(case):
    target = case.two.target.replace("1.1", "7.0")
    case.publisher.targets[target] = case.two.to_json()
    case.publisher.offer("stable", {case.two.platform: target})
    case.refused("is the manifest of releases/1.1/")


def test_names_that_leave_the_release_are_refused(case):
    data = json.loads(case.two.to_json())
    for path in ("../etc/passwd", "/etc/passwd", "boards/../../x", "a//b", "a/./b", ".complete", "a\x00b", "a\nb"):
        data["files"][0]["path"] = path
        case.publisher.targets[case.two.target] = json.dumps(data).encode()
        case.publisher.publish()
        case.refused("is no path inside of a release")


@each_row("content", [b"", b'{"version": "1', b'{"version": "\xe2"}', b"\xff\xfe", b"[" * 50_000])
def test_a_manifest_or_a_channel_that_is_no_json_is_refused(case, content):
    manifest = case.publisher.targets[case.two.target]
    case.publisher.targets[case.two.target] = content
    case.publisher.publish()
    case.refused(f"{case.two.target}: is not JSON")
    case.publisher.targets[case.two.target] = manifest
    case.publisher.targets[Channel.target("stable")] = content
    case.publisher.publish()
    case.refused("is no channel")
    case.publisher.offer("stable", {case.two.platform: case.two.target})


def test_a_huge_manifest_is_refused_unread(case):
    case.publisher.targets[case.two.target] = bytes(MANIFEST_BYTES_MAX + 1)
    case.publisher.publish()
    case.refused("more than the 1,000,000 of any such file")


def test_a_manifest_that_contradicts_the_repository_is_refused(case):
    data = json.loads(case.two.to_json())
    data["files"][0]["size_bytes"] += 1
    case.publisher.targets[case.two.target] = json.dumps(data).encode()
    case.publisher.publish()
    case.refused("signed with two different lengths")


def test_a_manifest_with_a_file_that_is_not_there_is_refused(case):
    del case.publisher.targets[next(file.target for file in case.two.files if file.path == "wheels/a.whl")]
    case.publisher.publish()
    case.refused("was the release added to it whole")


def test_what_a_killed_client_left_is_removed(case):
    left = case.device.layout.download / "metadata/tmpabc12345"
    left.write_bytes(b"half of a timestamp")
    assert case.fetch() == case.two
    assert not left.exists()


def test_one_process_at_a_time(case):
    with (case.device.layout.download / "lock").open("ab") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        case.refused("lock: another update is at work")


# The clock


def test_a_device_without_a_clock_refuses_what_has_expired(case):
    """It begins at 1970: what it knows for sure counts."""
    wrong = datetime(1970, 1, 1, tzinfo=UTC)
    assert case.fetch(now=wrong) == case.two
    assert (case.device.layout.download / "clock").read_text() == "2026-11-22T12:00:00Z 1 2\n"
    publisher = case.publisher
    publisher.now = NOW + timedelta(days=200)
    publisher.publish()
    case.fetch(now=wrong)
    publisher.now = NOW - timedelta(days=91)  # expired a day ago, by what was learned first
    publisher.issued = NOW
    publisher.publish()
    case.refused("it is 2027-06-10T12:00:00Z here", now=wrong)


def test_the_release_in_use_says_what_time_it_is_at_least(case):
    shutil.rmtree(case.device.layout.download)
    case.device.install(case.publisher.release("1.1.1", 2, TWO, built_s=int((NOW + timedelta(days=100)).timestamp())))
    case.refused("timestamp.json is expired", now=datetime(1970, 1, 1, tzinfo=UTC))


def test_a_clock_that_is_far_ahead_refuses_and_is_not_kept(case):
    said = case.refused("it is 2099-01-01T00:00:00Z here", now=datetime(2099, 1, 1, tzinfo=UTC))
    assert "this device's clock is wrong" in said
    assert case.fetch() == case.two


def test_a_free_running_clock_is_never_kept_and_a_synchronised_one_is(case, tmp_path):
    later = NOW + timedelta(days=60)
    case.fetch(now=later)
    file = case.device.layout.download / "clock"
    assert file.read_text() == "2026-11-22T12:00:00Z 1 2\n"
    set_from_network = tmp_path / "synchronized"
    set_from_network.touch()
    metadata = case.publisher.folder / "metadata"
    timestamp = Metadata[Timestamp].from_file(str(metadata / "timestamp.json")).signed
    targets = Metadata[Targets].from_file(str(metadata / "2.targets.json")).signed
    root = Metadata[Root].from_file(str(metadata / "1.root.json")).signed
    clock.keep(file, root, targets, timestamp, later, set_from_network)
    assert file.read_text() == "2027-01-21T12:00:00Z 1 2\n"
    clock.keep(file, root, targets, timestamp, datetime(2099, 1, 1, tzinfo=UTC), set_from_network)
    assert file.read_text() == clock.as_text(timestamp.expires) + " 1 2\n"
    clock.keep(file, root, targets, timestamp, NOW, set_from_network)  # never back
    assert file.read_text() == clock.as_text(timestamp.expires) + " 1 2\n"


def test_a_stolen_timestamp_key_cannot_move_the_time_beyond_what_is_valid(case):
    case.publisher.issued = datetime(2099, 1, 1, tzinfo=UTC)
    case.publisher.stamp()
    case.fetch()
    assert (case.device.layout.download / "clock").read_text() == "2027-02-20T12:00:00Z 1 3\n"
    assert "its owner has to sign it again" in case.refused("is expired", now=NOW + timedelta(days=91))


def test_a_time_that_is_none_is_left_out(case):
    file = case.device.layout.download / "clock"
    for text in ("tomorrow", "2026-11-22", "2026-13-22T12:00:00Z", "9" * 1000, ""):
        file.write_text(text)
        case.publisher.issued = text or "x"
        case.publisher.stamp()
        assert case.fetch() == case.two
        assert file.read_text() == text


def test_the_signed_document_itself_may_be_of_any_kind(case):
    """Root offered as targets, and so on."""
    metadata = case.publisher.folder / "metadata"
    for name in ("timestamp.json", "2.snapshot.json", "2.targets.json"):
        right = (metadata / name).read_bytes()
        for kind in (Root(), Snapshot(), Timestamp(), Targets()):
            (metadata / name).write_bytes(Metadata(kind).to_bytes())
            case.refused("refused|has no signed metadata")
        (metadata / name).write_bytes(right)
    assert case.fetch() == case.two


@pytest.mark.parametrize("seed", [0, 1, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(2, 400))])
def test_whatever_is_damaged_is_refused_or_of_no_use(case, seed):
    """Any file of the repository: bytes flipped, cut off, doubled, or those of another file."""
    rng = random.Random(seed)
    files = sorted(file for file in case.publisher.folder.rglob("*") if file.is_file())
    for _ in range(10):
        file = rng.choice(files)
        right = file.read_bytes()
        wrong = bytearray(right)
        match rng.randrange(5):
            case 0:
                for _ in range(rng.randint(1, 4)):
                    wrong[rng.randrange(len(wrong))] ^= 1 << rng.randrange(8)
            case 1:
                del wrong[rng.randrange(len(wrong)) :]
            case 2:
                wrong *= 2
            case 3:
                wrong[:] = rng.choice(files).read_bytes()
            case 4:
                start = rng.randrange(len(wrong))
                wrong[start : start + rng.randint(1, 9)] = rng.choice([b"null", b"[]", b"{}", b"1e999", b"-1", b'"', b"\xff", b""])
        file.write_bytes(wrong)
        before = case.device.kept()
        try:
            assert case.fetch() == case.two
        except UpdateError as error:
            assert "\n" not in str(error)  # noqa: PT017
            release, kept = case.device.kept()
            assert release == before[0]
            assert {name: kept[name] for name in before[1]} == before[1]
        file.write_bytes(right)
    assert case.fetch() == case.two
    for signed in case.two.files:
        assert (case.device.layout.store / signed.sha256).read_bytes() == TWO[signed.path]
