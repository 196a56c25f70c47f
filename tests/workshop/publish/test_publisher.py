"""A repository signed by two people: what is published when, and what is refused."""

import contextlib
import copy
import errno
import io
import shutil

import pytest
from repository_fixture import Device
from tiny_release import NOW, PASSPHRASE, TinyRepository, release_folder
from tuf.api.exceptions import DownloadHTTPError, UnsignedMetadataError
from tuf.api.metadata import Metadata
from tuf.ngclient import Updater
from tuf.ngclient.fetcher import FetcherInterface

from controller.device.update.download.fetch import TransferStatistics, check, fetch
from controller.device.update.settings import UpdateSettings
from controller.errors import UpdateError
from controller.workshop.publish import metadata, publisher, repository_files
from controller.workshop.publish.keys import new_key, open_key, read_public
from controller.workshop.publish.publications import draft_keys, draft_releases
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.release_folder import read_release
from controller.workshop.publish.stick import export


class Folder(FetcherInterface):
    """python-tuf's own client reads the repository's folder."""

    def __init__(self, folder):
        self.folder = folder

    def _fetch(self, url):
        file = self.folder / url.removeprefix("file://")
        if not file.exists():
            raise DownloadHTTPError("absent", 404)
        return iter([file.read_bytes()])


def client(folder, place, root):
    place.mkdir(exist_ok=True)
    (place / "targets").mkdir(exist_ok=True)
    made = Updater(str(place), "file://metadata", str(place / "targets"), "file://targets", Folder(folder), bootstrap=root)
    made.refresh()
    return made


@pytest.fixture(autouse=True)
def clock(monkeypatch):
    """The owner's computers: a timestamp made later than these would be too far from the last."""
    monkeypatch.setattr(metadata, "now", lambda: NOW)


@pytest.fixture
def keys(tmp_path):
    (tmp_path / "keys").mkdir()
    return tmp_path / "keys"


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    folder = tmp_path_factory.mktemp("first")
    return TinyRepository(folder / "repository", folder / "keys")


@pytest.fixture
def repository(first, tmp_path):
    """A copy of the first: keys take longer than anything else here."""
    mine = copy.copy(first)
    shutil.copytree(first.folder.parent, tmp_path, dirs_exist_ok=True)
    mine.folder, mine.signers = tmp_path / "repository", dict(first.signers)
    return mine


def refused(call, *said):
    """One line, which says all of this."""
    with pytest.raises(UpdateError) as caught:
        call()
    text = str(caught.value)
    assert "\n" not in text
    for words in said:
        assert words in text, text


def test_a_client_finds_every_file_of_a_release_through_its_channel(tmp_path, repository):
    manifest = release_folder(tmp_path / "1", "1.0.0", 1)
    assert read_release(tmp_path / "1") == manifest
    repository.publish(tmp_path / "1")
    updater = client(repository.folder, tmp_path / "client", repository.root_json.read_bytes())
    for target in ["channels/stable.json", manifest.target, *(file.target for file in manifest.files)]:
        assert updater.download_target(updater.get_targetinfo(target))
    bank = next(file for file in manifest.files if file.path == "banks/tiny.bank")
    assert updater.get_targetinfo(bank.index_target)


def test_nothing_is_published_by_one_signature_of_two(tmp_path, repository):
    release_folder(tmp_path / "1")
    with Repository.opened(repository.folder) as opened:
        draft_releases(opened, [tmp_path / "1"], "stable", NOW)
    assert not repository.sign("alice", "publisher")
    with Repository.opened(repository.folder) as opened:
        assert opened.lacking() == "targets lacks 1 of bob"
    assert (
        client(repository.folder, tmp_path / "client", repository.root_json.read_bytes()).get_targetinfo("channels/stable.json")
        is None
    )
    assert repository.sign("bob")
    assert client(repository.folder, tmp_path / "client", repository.root_json.read_bytes()).get_targetinfo("channels/stable.json")


def command(*words):
    from controller.cli import main

    return main(["update", "repository", *map(str, words)])


def test_the_private_part_of_a_key_needs_its_passphrase(keys):
    public = new_key(keys / "alice.pem", PASSPHRASE)
    assert (keys / "alice.pem").stat().st_mode & 0o777 == 0o600
    assert open_key(keys / "alice.pem", PASSPHRASE).public_key.keyid == read_public(public).keyid
    before = (keys / "alice.pem").read_bytes()
    refused(lambda: open_key(keys / "alice.pem", "wrong"), "alice.pem: the passphrase does not open it")
    refused(lambda: open_key(keys / "bob.pem", PASSPHRASE), "bob.pem: the key cannot be read")
    refused(lambda: open_key(public, PASSPHRASE), "alice.pub: is no key that a passphrase protects")
    refused(lambda: new_key(keys / "alice.pem", PASSPHRASE), "never overwritten")
    refused(lambda: new_key(keys / "carol.pem", "short"), "too short")
    assert (keys / "alice.pem").read_bytes() == before
    assert not (keys / "carol.pem").exists()


def test_one_key_cannot_count_as_two(keys):
    public = new_key(keys / "alice.pem", PASSPHRASE)
    text = public.read_text()
    key_id = read_public(public).keyid
    public.write_text(text.replace(key_id, key_id[::-1]))
    refused(lambda: read_public(public), "alice.pub: is no public part of a key")
    for damaged in (text.encode().replace(b"alice", b"\xe2lice"), b"[" * 100_000, b""):
        public.write_bytes(damaged)
        refused(lambda: read_public(public), "alice.pub: is no public part of a key")


def draft(repository, *folders, channel="stable"):
    with Repository.opened(repository.folder) as opened:
        draft_releases(opened, folders, channel, repository.now)


def test_what_may_not_follow_is_refused_and_changes_nothing(tmp_path, repository):
    release_folder(tmp_path / "1", "1.0.0", 5)
    repository.publish(tmp_path / "1")
    before = sorted(path.name for path in repository.folder.rglob("*"))
    release_folder(tmp_path / "2", "1.1.0", 5)
    refused(lambda: draft(repository, tmp_path / "2"), "counter 5 is not larger than 5 of version 1.0.0", "--counter 6")
    release_folder(tmp_path / "3", "1.0.0", 6, files={"banks/tiny.bank": b"other"}, pieces={})
    refused(lambda: draft(repository, tmp_path / "3"), "version 1.0.0", "give it another version")
    refused(lambda: draft(repository, tmp_path / "none"), "none: is no folder that")
    refused(lambda: draft(repository, tmp_path / "2", channel="../beta"), "is no name of a channel")
    assert sorted(path.name for path in repository.folder.rglob("*")) == before
    with Repository.opened(repository.folder) as opened:
        refused(lambda: opened.sign(repository.signers["bob"]), "nothing waits for signatures")


@pytest.mark.parametrize("what", ["file", "manifest", "index", "more", "less", "link"])
def test_a_release_that_was_altered_after_it_was_made_is_refused(tmp_path, repository, what):
    manifest = release_folder(tmp_path / "1")
    file = tmp_path / "1" / "gateware/tiny.bit"
    index = tmp_path / "1" / next(file for file in manifest.files if file.path.startswith("banks/")).index_target
    if what == "file":
        file.write_bytes(b"gateward\n")
    elif what == "manifest":
        text = (tmp_path / "1/release.json").read_text()
        (tmp_path / "1/release.json").write_text(text.replace('"counter": 1', '"counter":  2'))
    elif what == "index":
        index.write_bytes(index.read_bytes()[:-1] + bytes([index.read_bytes()[-1] ^ 1]))
    elif what == "more":
        (tmp_path / "1/boards/tiny/more.toml").touch()
    elif what == "less":
        file.unlink()
    else:
        file.rename(tmp_path / "elsewhere")
        file.symlink_to(tmp_path / "elsewhere")
    refused(lambda: draft(repository, tmp_path / "1"), "altered")
    assert not (repository.folder / "draft").exists()


def test_only_one_process_at_a_time_works_on_a_repository(repository, capsys):
    with Repository.opened(repository.folder):
        assert command("renew", repository.folder) == 1
    assert "another process works on this repository" in capsys.readouterr().err


def test_no_key_is_used_from_within_a_repository(tmp_path, repository, monkeypatch, capsys):
    monkeypatch.setenv("HAPTIC_PANEL_PASSPHRASE", PASSPHRASE)
    inside = repository.folder / "targets/alice.pem"
    inside.write_bytes((tmp_path / "keys/alice.pem").read_bytes())
    for words in (("sign", repository.folder, "--key", inside), ("key", repository.folder / "metadata/carol.pem")):
        assert command("renew", repository.folder) in (0, 1)
        assert command(*words) == 1
        assert "a key must not lie in the repository" in capsys.readouterr().err
    assert not (repository.folder / "metadata/carol.pem").exists()


def test_a_passphrase_comes_from_file_environment_or_terminal(tmp_path, repository, monkeypatch, capsys):
    assert command("renew", repository.folder) == 0
    key = ("sign", repository.folder, "--key", tmp_path / "keys/publisher.pem")
    monkeypatch.setattr("sys.stdin", io.StringIO())
    assert command(*key) == 1
    assert "asked at a terminal" in capsys.readouterr().err
    (tmp_path / "passphrase").write_text("wrong\n")
    assert command(*key, "--passphrase-file", tmp_path / "passphrase") == 1
    assert "passphrase does not open it" in capsys.readouterr().err
    (tmp_path / "passphrase").write_text(f"{PASSPHRASE}\n")
    assert command(*key, "--passphrase-file", tmp_path / "passphrase") == 0
    assert "published" in capsys.readouterr().out


@pytest.mark.parametrize(("what", "files", "refused_at"), [("release", 3, None), ("keys", 4, 3)])
def test_a_publication_that_stops_anywhere_goes_on(tmp_path, repository, monkeypatch, what, files, refused_at):
    """With a key for targets changed, root and timestamp belong together: between the two, clients refuse and try again."""
    if what == "release":
        release_folder(tmp_path / "1")
        draft(repository, tmp_path / "1")
    else:
        carol = read_public(new_key(tmp_path / "keys/carol.pem", PASSPHRASE))
        repository.signers["carol"] = open_key(tmp_path / "keys/carol.pem", PASSPHRASE)
        roles = ("root", "targets")
        with Repository.opened(repository.folder) as opened:
            bob = repository.public["bob"]
            draft_keys(opened, {role: [carol] for role in roles}, {role: [bob] for role in roles}, None, NOW)
    with Repository.opened(repository.folder) as opened:
        for signer in repository.signers.values():
            with contextlib.suppress(UpdateError):  # carol's counts for keys alone
                opened.sign(signer)
    write, root = publisher.write_durably, repository.root_json.read_bytes()
    for stop in range(files + 1):
        left = iter(range(stop))

        def stopping(path, data, mode=0o644, left=left):
            if next(left, None) is None:
                raise KeyboardInterrupt
            write(path, data, mode)

        monkeypatch.setattr(publisher, "write_durably", stopping)
        with Repository.opened(repository.folder) as opened:
            if stop < files:
                with pytest.raises(KeyboardInterrupt):
                    opened.publish()
            else:
                assert opened.publish()
        if stop == refused_at:
            with pytest.raises(UnsignedMetadataError):
                client(repository.folder, tmp_path / f"client{stop}", root)
        else:
            seen = client(repository.folder, tmp_path / f"client{stop}", root).get_targetinfo("channels/stable.json")
            assert (seen is not None) == (what == "release" and stop == files)


def test_a_stick_is_older_than_the_repository_from_then_on(tmp_path, repository):
    release_folder(tmp_path / "1")
    repository.publish(tmp_path / "1")
    with Repository.opened(repository.folder) as opened:
        assert export(opened, tmp_path / "stick", repository.signers["publisher"], NOW) > 16_384
        refused(
            lambda: export(opened, repository.folder / "stick", repository.signers["publisher"], NOW), "is the repository itself"
        )
        refused(lambda: export(opened, tmp_path / "stick2", repository.signers["alice"], NOW), "a key for timestamp", "publisher")
    stick = Metadata.from_file(str(tmp_path / "stick/metadata/timestamp.json")).signed
    online = Metadata.from_file(str(repository.folder / "metadata/timestamp.json")).signed
    assert online.version == stick.version + 1
    assert ((stick.expires - NOW).days, (online.expires - NOW).days) == (365, 90)
    root = repository.root_json.read_bytes()
    for folder in (tmp_path / "stick", repository.folder):
        assert client(folder, tmp_path / "client", root).get_targetinfo("channels/stable.json")
    other = TinyRepository(tmp_path / "other", tmp_path / "other_keys")
    with Repository.opened(other.folder) as opened:
        refused(
            lambda: export(opened, tmp_path / "stick", other.signers["publisher"], NOW), "holds the repository of another owner"
        )


def test_a_signature_counts_only_for_the_draft_it_was_made_of(tmp_path, repository):
    release_folder(tmp_path / "1")
    draft(repository, tmp_path / "1")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (repository.folder / "draft").rename(elsewhere / "draft")
    (elsewhere / "metadata").symlink_to(repository.folder / "metadata")
    with Repository.opened(elsewhere) as opened:
        opened.sign(repository.signers["bob"])
        assert not opened.publish()
    release_folder(tmp_path / "2", "2.0.0", 2)
    draft(repository, tmp_path / "2")
    with Repository.opened(repository.folder) as opened:
        refused(lambda: opened.take(elsewhere), "is not a copy of")
        stranger = open_key(new_key(tmp_path / "eve.pem", PASSPHRASE).with_suffix(".pem"), PASSPHRASE)
        refused(lambda: opened.sign(stranger), "counts for nothing", "alice, bob, publisher")
        assert "targets lacks 2 of alice, bob" in opened.lacking()


def test_a_device_follows_releases_keys_and_sticks(tmp_path, repository):
    """The device's own client, which fetches of a changed bank what has changed."""
    (tmp_path / "device").mkdir()
    device = Device(tmp_path / "device", repository.root_json.read_bytes())
    release_folder(tmp_path / "1", "1.0.0", 1)
    manifest = repository.publish(tmp_path / "1")
    assert fetch(device.layout, UpdateSettings(), str(repository.folder), print, now=NOW) == manifest
    device.install(manifest)
    for who in ("dora", "erin"):
        public = read_public(new_key(tmp_path / f"keys/{who}.pem", PASSPHRASE))
        leaver = repository.public["publisher" if who == "dora" else "bob"]
        roles = ("snapshot", "timestamp") if who == "dora" else ("root", "targets")
        repository.signers[who] = open_key(tmp_path / f"keys/{who}.pem", PASSPHRASE)
        with Repository.opened(repository.folder) as opened:
            draft_keys(opened, {role: [public] for role in roles}, {role: [leaver] for role in roles}, None, NOW)
            for name in ("alice", "bob", who) if who == "erin" else ("alice", "bob"):
                opened.sign(repository.signers[name])
            opened.sign(repository.signers["dora"])
            assert opened.publish()
    bank = bytearray((tmp_path / "1/banks/tiny.bank").read_bytes())
    bank[5000] ^= 1
    release_folder(tmp_path / "2", "1.1.0", 2, files={"banks/tiny.bank": bytes(bank)})
    draft(repository, tmp_path / "2")
    with Repository.opened(repository.folder) as opened:
        for name in ("alice", "erin", "dora"):
            opened.sign(repository.signers[name])
        assert opened.publish()
        export(opened, tmp_path / "stick", repository.signers["dora"], NOW)
    figures = TransferStatistics()
    newer = fetch(device.layout, UpdateSettings(), str(tmp_path / "stick"), print, now=NOW, figures=figures)
    assert newer.version == "1.1.0"
    assert figures.reused_bytes == 16_384 - 256
    assert all((device.layout.store / file.sha256).exists() for file in newer.files)
    assert check(device.layout, UpdateSettings(), str(repository.folder), now=NOW)[0].manifest == newer  # newer than the stick


def test_whoever_signs_a_copy_last_is_informed_what_comes_next(tmp_path, repository, monkeypatch, capsys):
    monkeypatch.setenv("HAPTIC_PANEL_PASSPHRASE", PASSPHRASE)
    release_folder(tmp_path / "1")
    draft(repository, tmp_path / "1")
    stick = tmp_path / "stick"
    for name in ("metadata", "draft"):
        shutil.copytree(repository.folder / name, stick / name)
    missing = tmp_path / "stik"
    assert command("sign", repository.folder, "--from", missing) == 1
    assert f"{missing}/draft: is not there" in capsys.readouterr().err
    for name in ("alice", "bob", "publisher"):
        capsys.readouterr()
        assert command("sign", stick, "--key", tmp_path / f"keys/{name}.pem") == 0
    assert capsys.readouterr().out.startswith(f"{stick}: a draft, signed by all: take it back to the repository: ")


def test_one_signs_only_what_one_has_made_oneself(tmp_path, repository, monkeypatch, capsys):
    monkeypatch.setenv("HAPTIC_PANEL_PASSPHRASE", PASSPHRASE)
    release_folder(tmp_path / "theirs", files={"gateware/tiny.bit": b"something else"})
    release_folder(tmp_path / "mine")
    draft(repository, tmp_path / "theirs")
    words = ("sign", repository.folder, "--key", tmp_path / "keys/bob.pem", "--same-as")
    assert command(*words, tmp_path / "mine") == 1
    assert "do not sign, find out who has changed what" in capsys.readouterr().err
    release_folder(tmp_path / "other", "7.0.0")
    assert command(*words, tmp_path / "other") == 1
    with Repository.opened(repository.folder) as opened:
        assert "targets lacks 2" in opened.lacking()
    assert command(*words, tmp_path / "theirs") == 0
    assert "targets lacks 1 of alice" in capsys.readouterr().out


def test_a_full_disk_is_reported_in_one_line_and_leaves_no_draft(tmp_path, repository, monkeypatch):
    release_folder(tmp_path / "1")
    before = [path.name for path in sorted(repository.folder.rglob("*")) if path.is_file()]

    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    for module, name in ((repository_files.shutil, "copyfileobj"), (publisher, "write_durably")):
        with monkeypatch.context() as patch:
            patch.setattr(module, name, full)
            refused(lambda: draft(repository, tmp_path / "1"), "cannot be written (No space left on device)", "make room")
            if module is not publisher:
                assert [path.name for path in sorted(repository.folder.rglob("*")) if path.is_file()] == before
    with monkeypatch.context() as patch:
        patch.setattr("controller.workshop.publish.release_folder.shutil.copyfile", full)
        refused(lambda: release_folder(tmp_path / "2", files={"banks/b.bank": repository.root_json}), "2: cannot be written")
    assert not list(tmp_path.glob("*2*"))
    assert not (repository.folder / "draft").exists()
    repository.publish(tmp_path / "1")
