"""What another user may put in place of a small file is refused at once, by every reader of such files: nobody waits for a pipe."""

import errno
import os
import socket
from pathlib import Path

import pytest
from tables import each_row

from controller.device.bank.inspection import header_of
from controller.device.bank.lookup import of_this_format
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.panel_status import read_status
from controller.device.fpga.bitstreams.bitstream import read_identity
from controller.device.service.reloading import _read as read_reload
from controller.device.touch.recordings.recording import Recording
from controller.device.update.installed import manifest_of, update_state
from controller.device.update.layout import Layout
from controller.device.update.manifest import ReleaseFile
from controller.device.update.trial import _read as read_trial
from controller.device.update.trial import keep_before
from controller.device.update.trust import clock
from controller.device.update.trust.offer import failed_releases, largest_counter
from controller.device.update.trust.validity import root_expiry
from controller.errors import BankError, ConfigError, ControllerError, TouchError, UpdateError
from controller.regular_file import read_regular

KINDS = ("pipe", "socket", "folder", "link", "device")


def put(path, kind):
    """Something else than a file, where a file is expected."""
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "socket":
        folder = os.open(path.parent, os.O_PATH)
        with socket.socket(socket.AF_UNIX) as made:
            made.bind(f"/proc/self/fd/{folder}/{path.name}")  # an address has 107 bytes
        os.close(folder)
    elif kind == "folder":
        path.mkdir()
    elif kind == "link":
        secret = path.with_name("another's file")
        secret.write_bytes(b"secret")
        path.symlink_to(secret)
    else:
        path.symlink_to("/dev/zero")  # without end; device nodes themselves are root's to make


@each_row(
    ("kind", "number", "said"),
    [
        ("pipe", errno.EINVAL, "not a regular file"),
        ("socket", errno.ENXIO, "No such device or address"),
        ("folder", errno.EISDIR, "Is a directory"),
        ("link", errno.ELOOP, "a symbolic link"),
        ("device", errno.ELOOP, "a symbolic link"),
    ],
)
def test_only_regular_files_are_read(tmp_path, kind, number, said):
    file = tmp_path / kind / "file"
    file.parent.mkdir()
    put(file, kind)
    before = len(list(Path("/proc/self/fd").iterdir()))
    with pytest.raises(OSError, match=said) as reported:
        read_regular(file, 100)
    assert (reported.value.errno, reported.value.filename) == (number, str(file))
    assert len(list(Path("/proc/self/fd").iterdir())) == before, "nothing is left open"


def test_links_are_followed_only_where_they_may_be_and_then_to_regular_files(tmp_path):
    put(tmp_path / "link", "link")
    put(tmp_path / "device", "device")
    assert read_regular(tmp_path / "link", 100, links=True) == b"secret"
    with pytest.raises(OSError, match="not a regular file"):
        read_regular(tmp_path / "device", 100, links=True)


def test_no_more_is_read_than_it_may_have(tmp_path):
    file = tmp_path / "file"
    for size in (0, 1, 65_536, 65_537, 200_000):
        file.write_bytes(bytes(size))
        assert read_regular(file, size) == bytes(size)
        if size:
            with pytest.raises(OSError, match=f"more than {size - 1:,} bytes"):
                read_regular(file, size - 1)
    os.truncate(file, 1 << 40)
    with pytest.raises(OSError, match="more than 1 MiB"):
        read_regular(file, 1 << 20)


def test_a_file_of_another_user_than_it_should_be_is_not_read(tmp_path):
    (tmp_path / "file").write_bytes(b"x")
    assert read_regular(tmp_path / "file", 100, owner=os.geteuid()) == b"x"
    with pytest.raises(PermissionError, match=f"belongs to user {os.geteuid()}, not to user 12345"):
        read_regular(tmp_path / "file", 100, owner=12345)
    with pytest.raises(FileNotFoundError):
        read_regular(tmp_path / "absent", 100)


def refused(error, said="cannot be read"):
    def check(call, path):
        with pytest.raises(error, match=said) as reported:
            call(path)
        assert "\n" not in str(reported.value)

    return check


def answered(value):
    def check(call, path):
        assert call(path) == value

    return check


def layout_of(folder):
    return Layout(folder, folder / "root.json")


LOWER = frozenset({"pipe", "socket", "folder"})  # of files that may be links
READERS = {  # of each reader: file name, what reads it, what it then does
    "status": ("status.json", read_status, refused(ControllerError), KINDS),
    "status of a trial": ("status.json", read_trial, answered(None), KINDS),
    "reload": ("reload", read_reload, refused(ControllerError, "does the service run"), KINDS),
    "word": ("state/trial", lambda file: layout_of(file.parents[1]).word("trial"), answered(""), KINDS),
    "failed": ("state/failed", lambda file: failed_releases(layout_of(file.parents[1])), refused(UpdateError), KINDS),
    "counter": ("download/counter", lambda file: largest_counter(layout_of(file.parents[1]), None), answered(0), KINDS),
    "clock": ("download/clock", clock.Kept.read, answered(None), KINDS),
    "manifest": ("releases/1.0/release.json", lambda file: manifest_of(file.parent), answered(None), KINDS),
    "root": ("download/metadata/root.json", lambda file: root_expiry(layout_of(file.parents[2])), refused(UpdateError), LOWER),
    "stored": ("x", ReleaseFile(path="x", sha256="0" * 64, size_bytes=0).is_whole, refused(OSError, None), KINDS),
    "board": ("board.toml", load_board, refused(ConfigError), LOWER),
    "recording": ("a.events", Recording.open, refused(TouchError), LOWER),
    "bank": ("a.bank", Bank.open, refused(BankError), LOWER),
    "header of a bank": ("a.bank", header_of, refused(OSError, None), LOWER),
    "format of a bank": ("a.bank", of_this_format, answered(True), LOWER),
    "bitstream": ("a.bit", read_identity, refused(OSError, None), LOWER),
}


@each_row(("reader", "kind"), [(name, kind) for name, (*_, kinds) in READERS.items() for kind in sorted(kinds)])
def test_no_reader_waits_or_follows(tmp_path, reader, kind):
    name, read, check, _ = READERS[reader]
    folder = tmp_path / reader / kind
    folder.mkdir(parents=True)
    (folder / "root.json").write_bytes(b"{}")
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    put(path, kind)
    check(read, path)


@each_row("kind", KINDS)
def test_the_state_of_updates_names_what_is_damaged_and_goes_on(tmp_path, kind):
    layout = layout_of(tmp_path)
    for folder in (layout.state, layout.requests, layout.release("1.0")):
        folder.mkdir(parents=True)
    for file in (layout.state / "current", layout.state / "failed", layout.release("1.0") / "release.json"):
        put(file, kind)
    (layout.release("1.0") / ".complete").touch()
    state = update_state(layout)
    assert [release.counter for release in state.releases] == [None]
    assert [problem.partition(":")[0] for problem in state.problems[:3]] == [
        str(layout.state / "current"),
        str(layout.state / "failed"),
        str(layout.release("1.0") / "release.json"),
    ]


@each_row("kind", KINDS)
def test_an_update_is_asked_for_whatever_the_service_has_in_place_of_its_status(tmp_path, kind):
    layout = layout_of(tmp_path)
    layout.download.mkdir()
    (layout.download / "before.json").write_bytes(b"of an earlier update")
    put(tmp_path / "status.json", kind)
    keep_before(layout, tmp_path / "status.json")
    assert not (layout.download / "before.json").exists()


@pytest.mark.skipif(os.geteuid() != 0, reason="gives files to another user")
def test_a_status_is_that_of_the_user_whose_folder_it_lies_in(tmp_path):
    """Not one that somebody else was made to write there, or that was linked to."""
    (tmp_path / "status.json").write_bytes(b"{}")
    os.chown(tmp_path, 12345, 12345)
    with pytest.raises(ControllerError, match="belongs to user 0, not to user 12345"):
        read_status(tmp_path / "status.json")
    os.chown(tmp_path / "status.json", 12345, 12345)
    with pytest.raises(ControllerError, match="is no status of a panel"):
        read_status(tmp_path / "status.json")
