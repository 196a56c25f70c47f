"""A repository signed by two people: what is published when, and what is refused."""

import pytest
from tiny_release import NOW, PASSPHRASE, TinyRepository, release_folder
from tuf.ngclient import Updater
from tuf.ngclient.fetcher import FetcherInterface

from controller.errors import UpdateError
from controller.update.keys import new_key, open_key, read_public
from controller.update.publications import draft_releases
from controller.update.publisher import Repository
from controller.update.release_folder import read_release


class Folder(FetcherInterface):
    """python-tuf's own client reads the repository's folder."""

    def __init__(self, folder):
        self.folder = folder

    def _fetch(self, url):
        from tuf.api.exceptions import DownloadHTTPError

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


@pytest.fixture
def keys(tmp_path):
    (tmp_path / "keys").mkdir()
    return tmp_path / "keys"


@pytest.fixture
def repository(tmp_path):
    return TinyRepository(tmp_path / "repository", tmp_path / "keys")


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
