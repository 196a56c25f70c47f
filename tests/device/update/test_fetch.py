"""Releases into the store: what is there is not fetched, what breaks off is gone on with, what is wrong is refused."""

import hashlib
import os
import random
import re
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from repository_fixture import NOW, Device, Publisher

from controller.device.update.download.fetch import TransferStatistics, fetch
from controller.device.update.settings import UpdateSettings
from controller.errors import UpdateError

BANK, PIECE = 400_000, 4_000
SMALL = {"wheels/a.whl": b"wheel", "sbom.cdx.json": b"{}"}


def slow(*values):
    return pytest.param(*values, marks=pytest.mark.slow)


def bank(seed=1):
    return random.Random(seed).randbytes(BANK)


def changed(data, *pieces):
    made = bytearray(data)
    for piece in pieces:
        made[piece * PIECE : (piece + 1) * PIECE] = random.Random(f"new {piece}").randbytes(PIECE)
    return bytes(made)


class Case:
    """A repository with releases 1.0 and 1.1, whose banks differ in 3 of 100 pieces; the device has 1.0 unless set otherwise."""

    def __init__(self, folder, serve, old=None, new=None, installed=True):
        self.publisher = Publisher(folder / "repository")
        self.device = Device(folder, self.publisher.root)
        self.old = bank() if old is None else old
        self.new = changed(self.old, 10, 11, 80) if new is None else new
        self.one = self.publisher.release("1.0", 1, {"banks/b.bank": self.old} | SMALL, cut=PIECE)
        if installed:
            self.fetch(str(self.publisher.folder))
            self.device.install(self.one)
        self.two = self.publisher.release("1.1", 2, {"banks/b.bank": self.new} | SMALL | {"wheels/a.whl": b"new wheel"}, cut=PIECE)
        self.file = next(file for file in self.two.files if file.path == "banks/b.bank")
        self.bank_path = self.publisher.file(self.file.target).relative_to(self.publisher.folder)
        self.server = serve(self.publisher.folder)
        self.steps = []

    def fetch(self, source=None):
        self.figures = TransferStatistics()
        return fetch(
            self.device.layout,
            UpdateSettings(),
            source or self.server.address,
            lambda done, total: self.steps.append((done, total)) if hasattr(self, "steps") else None,
            NOW,
            self.figures,
        )

    def refused(self, said, source=None):
        before = self.device.kept()
        with pytest.raises(UpdateError, match=said) as reported:
            self.fetch(source)
        assert "\n" not in str(reported.value)
        self.unharmed(before)
        return str(reported.value)

    def unharmed(self, before):
        """All is as it was; but files that came whole before the failure may be in the store, each under its own hash."""
        release, files = self.device.kept()
        assert release == before[0]
        assert {name: files.get(name) for name in before[1]} == before[1]
        for name in files.keys() - before[1].keys():
            assert Path(name).parent == self.device.layout.store
            assert Path(name).name == hashlib.sha256(files[name]).hexdigest()

    def asked(self):
        """Ranges of the bank that were asked for since last time."""
        ranges = [wanted for path, wanted in self.server.requests if path == f"/{self.bank_path}"]
        self.server.requests.clear()
        return ranges

    def is_whole(self):
        stored = self.device.layout.store / self.file.sha256
        return stored.read_bytes() == self.new and stored.stat().st_mode & 0o777 == 0o444


def test_of_a_changed_bank_only_what_changed_is_fetched(tmp_path, serve):
    case = Case(tmp_path, serve)
    case.fetch()
    assert case.is_whole()
    assert case.asked() == ["bytes=40000-47999", "bytes=320000-323999"]
    assert case.figures.reused_bytes == BANK - 3 * PIECE
    assert case.figures.release_bytes == case.two.total_bytes
    assert case.figures.kept_bytes == len(SMALL["sbom.cdx.json"])
    assert 3 * PIECE < case.figures.fetched_bytes < 0.05 * BANK
    assert case.steps[-1] == (case.two.total_bytes,) * 2
    assert case.steps == sorted(case.steps)


def test_the_same_from_a_folder(tmp_path, serve):
    case = Case(tmp_path, serve)
    case.fetch(str(case.publisher.folder))
    assert case.is_whole()
    assert case.figures.reused_bytes == BANK - 3 * PIECE
    assert case.server.requests == []  # no network


def test_pieces_that_moved_are_found_by_the_old_banks_index(tmp_path, serve):
    old = bank()
    pieces = [old[at : at + PIECE] for at in range(0, BANK, PIECE)]
    moved = b"".join([pieces[5], *reversed(pieces)])
    case = Case(tmp_path, serve, old, moved)
    for kept in (case.device.layout.download / "indexes").iterdir():
        kept.unlink()  # then the repository's
    case.fetch()
    assert case.is_whole()
    assert case.figures.fetched_bytes < 0.05 * BANK


def test_a_bank_that_the_repository_does_not_know_serves_where_it_is_the_same(tmp_path, serve):
    case = Case(tmp_path, serve)
    for kept in (case.device.layout.download / "indexes").iterdir():
        kept.unlink()
    (old,) = [file for file in case.one.files if file.path.startswith("banks/")]
    del case.publisher.targets[old.index_target]
    case.publisher.publish()
    case.fetch()
    assert case.is_whole()
    assert case.figures.reused_bytes == BANK - 3 * PIECE


@pytest.mark.parametrize(
    "why", ["wrong index", "all new", *(slow(why) for why in ("no index", "damaged index", "index of another", "first bank"))]
)
def test_else_the_whole_bank_is_fetched(tmp_path, serve, why):
    case = Case(tmp_path, serve, new=bank(2) if why == "all new" else None, installed=why != "first bank")
    index = case.file.index_target
    if why == "no index":
        del case.publisher.targets[index]
    elif why == "damaged index":
        case.publisher.targets[index] = b"HPNLIDX1 and no more"
    elif why == "wrong index":  # of an owner who made a mistake: all its pieces are those of the old bank
        (old,) = [file for file in case.one.files if file.path.startswith("banks/")]
        case.publisher.targets[index] = case.publisher.targets[old.index_target]
    elif why == "index of another":
        case.publisher.file(index).write_bytes(b"x" * len(case.publisher.targets[index]))
    if why not in {"all new", "first bank", "index of another"}:
        case.publisher.publish()
    case.fetch()
    assert case.is_whole()
    assert case.asked() == [f"bytes=0-{BANK - 1}"]


def test_an_old_bank_that_is_damaged_gives_what_is_left_of_it(tmp_path, serve):
    case = Case(tmp_path, serve)
    (old,) = [file for file in case.one.files if file.path.startswith("banks/")]
    stored = case.device.layout.store / old.sha256
    stored.chmod(0o644)
    with stored.open("r+b") as file:
        file.seek(50 * PIECE)
        file.write(b"damage")
    case.fetch()
    assert case.is_whole()
    assert case.figures.reused_bytes == BANK - 4 * PIECE


def test_a_range_that_lies_is_found_out(tmp_path, serve):
    """The whole file's hash decides."""
    case = Case(tmp_path, serve)

    def lie(handler):
        wanted = re.fullmatch(r"bytes=(\d+)-(\d+)", handler.headers.get("Range") or "")
        if case.bank_path.name not in handler.path or int(wanted[2]) == BANK - 1:
            return False
        handler.answer(206, bytes(int(wanted[2]) - int(wanted[1]) + 1), Content_Range=f"bytes {wanted[1]}-{wanted[2]}/{BANK}")
        return True

    case.server.instead = lie
    case.fetch()
    assert case.is_whole()
    assert case.asked()[-1] == f"bytes=0-{BANK - 1}"


def test_a_server_without_ranges_sends_the_whole_bank(tmp_path, serve):
    case = Case(tmp_path, serve)
    case.server.ranges = False
    case.fetch()
    assert case.is_whole()


def cut_at(case, *ends):
    """The server breaks off bank after this many bytes, one after the other."""
    left = list(ends)

    def cut(handler):
        if case.bank_path.name not in handler.path or not left:
            return False
        wanted = re.fullmatch(r"bytes=(\d+)-(\d+)", handler.headers["Range"])
        start, stop = int(wanted[1]), int(wanted[2]) + 1
        body = case.new[start : start + left.pop(0)]
        handler.answer(206, body, Content_Length=stop - start, Content_Range=f"bytes {start}-{stop - 1}/{BANK}")
        handler.close_connection = len(body) < stop - start
        return True

    case.server.instead = cut


def test_a_connection_that_breaks_is_gone_on_with_at_once(tmp_path, serve):
    case = Case(tmp_path, serve, installed=False)
    cut_at(case, 200_000, 100_000)
    case.fetch()
    assert case.is_whole()
    assert case.asked() == [f"bytes={start}-{BANK - 1}" for start in (0, 200_000, 300_000)]
    assert BANK < case.figures.fetched_bytes < BANK + 20_000


def test_what_broke_off_for_good_is_gone_on_with_next_time(tmp_path, serve):
    case = Case(tmp_path, serve, installed=False)
    cut_at(case, 200_000, 0, 100_000, 1000)
    case.refused("the connection broke")
    case.refused("what came is kept")
    case.fetch()
    assert case.is_whole()
    assert case.asked() == [f"bytes={start}-{BANK - 1}" for start in (0, 200_000, 200_000, 300_000, 301_000)]
    assert not list((case.device.layout.download / "parts").iterdir())


def test_a_server_that_breaks_off_and_sends_no_ranges_is_reported(tmp_path, serve):
    case = Case(tmp_path, serve, installed=False)
    cut_at(case, 200_000)
    case.server.ranges = False
    case.refused("the server sends whole files only")
    case.fetch()
    assert case.is_whole()


def test_pieces_that_came_are_not_fetched_again(tmp_path, serve):
    case = Case(tmp_path, serve)
    cut_at(case, 8000, 1000)
    case.refused("the connection broke")
    assert case.asked() == ["bytes=40000-47999", "bytes=320000-323999"]
    case.fetch()
    assert case.is_whole()
    assert case.asked() == ["bytes=320000-323999"]


@pytest.mark.parametrize("begun", [bytes(BANK), slow(b"wrong"), slow(bytes(BANK + 1))])
def test_a_part_that_is_wrong_is_fetched_again(tmp_path, serve, begun):
    """Such as after a power cut, or of a longer file."""
    case = Case(tmp_path, serve, installed=False)
    parts = case.device.layout.download / "parts"
    parts.mkdir(parents=True)
    (parts / case.file.sha256).write_bytes(begun)
    (parts / ("0" * 64)).write_bytes(b"of a release of the past")
    case.fetch()
    assert case.is_whole()
    assert not list(parts.iterdir())


def test_a_damaged_file_in_the_store_is_fetched_again(tmp_path, serve):
    case = Case(tmp_path, serve)
    case.fetch()
    stored = case.device.layout.store / case.file.sha256
    stored.chmod(0o644)
    stored.write_bytes(b"damaged")
    case.fetch()
    assert case.is_whole()


@pytest.mark.parametrize("installed", [True, slow(False)])
@pytest.mark.parametrize("how", ["flipped", slow("short"), "long", slow("gone")])
def test_files_that_are_not_the_signed_ones_are_refused(tmp_path, serve, how, installed):
    case = Case(tmp_path, serve, installed=installed, new=bank(3))
    file = case.publisher.folder / case.bank_path
    wrong = {"flipped": changed(case.new, 0), "short": case.new[:-1], "long": case.new + b"x", "gone": b""}[how]
    file.write_bytes(wrong)
    if how == "gone":
        file.unlink()
    for source in (case.server.address, str(case.publisher.folder)):
        if (how, source) == ("long", str(case.publisher.folder)):  # what was signed is there, and more is not read
            continue
        if how == "long":
            case.server.ranges = False
        case.refused("not the signed one|than was signed|missing|is not there|answers 404|ended|another range", source)
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(case.new)
    case.fetch()
    assert case.is_whole()


def test_an_endless_file_ends_at_its_signed_length(tmp_path, serve):
    case = Case(tmp_path, serve, installed=False, new=bank(3))
    case.server.ranges = False

    def endless(handler):
        if case.bank_path.name not in handler.path:
            return False
        handler.answer(200, Content_Length=None, Connection="close")
        sent = 0
        while sent < 100 * BANK:
            try:
                sent += handler.wfile.write(bytes(65536))
            except OSError:
                break
        assert sent < 99 * BANK
        return True

    case.server.instead = endless
    case.refused("not the signed one")
    assert case.figures.fetched_bytes < BANK + 100_000


def test_a_repository_that_changes_meanwhile(tmp_path, serve):
    """A newer release, then the old one's files taken away: what was verified first is fetched, or nothing."""
    case = Case(tmp_path, serve)
    later = []

    def change(handler):
        if "/targets/releases/" in handler.path and not later:
            later.append(case.publisher.release("1.2", 3, SMALL | {"banks/b.bank": changed(case.new, 5)}, cut=PIECE))
        return False

    case.server.instead = change
    assert case.fetch() == case.two
    assert case.is_whole()
    assert case.fetch() == later[0]


def test_files_that_are_taken_away_meanwhile(tmp_path, serve):
    case = Case(tmp_path, serve)
    case.server.instead = lambda handler: case.bank_path.name in handler.path and (handler.answer(404) or True)
    case.refused("answers 404")


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ({"status": 200, "body": b"<html>login</html>", "Content_Type": "text/html"}, "does this network ask for a login"),
        ({"status": 200, "body": b"<html>login</html>"}, "does this network ask for a login"),
        slow({"status": 302, "Location": "http://127.0.0.1:1/"}, "redirects are not followed"),
        slow({"status": 500}, "answers 500"),
        slow({"status": 404}, "answers 404"),
    ],
)
def test_a_network_that_is_none(tmp_path, serve, answer, said):
    case = Case(tmp_path, serve)
    case.server.instead = lambda handler: handler.answer(**answer) or True
    case.refused(said)


def test_a_stick_that_is_pulled_while_it_is_read(tmp_path, serve, monkeypatch):
    case = Case(tmp_path, serve, installed=False)
    stick = case.publisher.folder

    def pull(done, total):
        if done > 200_000 and stick.exists():
            stick.rename(tmp_path / "elsewhere")

    before = case.device.kept()
    with pytest.raises(UpdateError, match="was the stick pulled"):
        fetch(case.device.layout, UpdateSettings(), str(stick), pull, NOW)
    case.unharmed(before)
    case.refused("is the stick plugged in", str(stick))
    (tmp_path / "elsewhere").rename(stick)
    case.fetch(str(stick))
    assert case.is_whole()


def test_what_will_not_fit_is_not_begun(tmp_path, serve, monkeypatch):
    case = Case(tmp_path, serve)
    monkeypatch.setattr(os, "statvfs", lambda _: SimpleNamespace(f_bavail=1000, f_frsize=4096))
    said = case.refused("needs [0-9,]+ bytes, 4,096,000 are free: make room")
    assert "release 1.1" in said
    assert case.asked() == []


FULL = """
import resource, signal, sys
from pathlib import Path
from controller.errors import UpdateError
from controller.device.update.download.fetch import fetch
from controller.device.update.layout import Layout
from controller.device.update.settings import UpdateSettings
from repository_fixture import NOW
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (250_000, 250_000))
folder = Path(sys.argv[1])
try:
    fetch(Layout(folder / "haptic-panel", folder / "root.json"), UpdateSettings(), str(folder / "repository"), lambda *_: None, NOW)
except UpdateError as error:
    print(error)
"""


@pytest.mark.parametrize("installed", [slow(True), False])
def test_a_disk_that_takes_no_more(tmp_path, serve, installed):
    """Files end at 250 kB: writing fails in the middle of the bank."""
    case = Case(tmp_path, serve, installed=installed)
    before = case.device.kept()
    paths = os.pathsep.join([str(Path(__file__).parents[3]), str(Path(__file__).parent)])
    done = subprocess.run(
        [sys.executable, "-c", FULL, tmp_path], capture_output=True, text=True, check=True, env=os.environ | {"PYTHONPATH": paths}
    )
    assert re.search(r"cannot be read or written \(File too large\): make room on the disk\n$", done.stdout), done
    assert done.stdout.count("\n") == 1
    case.unharmed(before)
    assert not list((case.device.layout.download / "parts").iterdir())  # a full disk is not left full
    case.fetch()
    assert case.is_whole()


def test_a_folder_that_may_not_be_written(tmp_path, serve):
    """As with a disk that is read-only after an error."""
    case = Case(tmp_path, serve)
    (case.device.layout.download / "metadata").rename(tmp_path / "metadata")
    (case.device.layout.download / "metadata").write_bytes(b"")
    case.refused("metadata: cannot be read or written")


MOUNTED = "mount -t tmpfs -o size={size} none {root} && cp -a {kept}/. {root} && {then} exec {python} -c '{code}' {folder}"


@pytest.mark.slow
@pytest.mark.skipif(
    not shutil.which("unshare") or subprocess.run(["unshare", "-rm", "true"], capture_output=True, check=False).returncode != 0,
    reason="no file system may be mounted here",
)
@pytest.mark.parametrize(
    ("size", "then", "said"),
    [
        ("700k", "", "No space left on device): make room on the disk"),
        ("64m", "mount -o remount,ro {root} &&", "Read-only file system): see to it that the user haptic-update may write there"),
    ],
)
def test_a_real_disk_that_is_full_or_read_only(tmp_path, serve, size, then, said):
    case = Case(tmp_path, serve)
    root = case.device.layout.root
    kept = root.rename(tmp_path / "kept")
    root.mkdir()
    code = FULL.replace("resource.setrlimit(resource.RLIMIT_FSIZE, (250_000, 250_000))", "fetch_module.RESERVE_BYTES = -10**9")
    code = code.replace(
        "import resource, signal, sys", "import signal, sys\nfrom controller.device.update.download import fetch as fetch_module"
    )
    code += 'print(len(list((folder / "haptic-panel" / "download" / "parts").iterdir())))\n'
    code = code.replace("'", '"')
    then = then.format(root=root)
    script = MOUNTED.format(size=size, root=root, kept=kept, then=then, python=sys.executable, code=code, folder=tmp_path)
    environment = os.environ | {"PYTHONPATH": f"{Path(__file__).parents[3]}:{Path(__file__).parent}"}
    done = subprocess.run(["unshare", "-rm", "sh", "-c", script], capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, done.stderr
    line, parts = done.stdout.splitlines()
    assert line.endswith(said)
    assert parts == "0"


@pytest.mark.slow
def test_what_is_fetched_of_a_bank_of_which_a_hundredth_has_changed(tmp_path, serve, monkeypatch):
    """36 MB, 9,000 entries of 4,000 bytes; 90 of them are new."""
    old = random.Random(1).randbytes(36_000_000)
    new = changed(old, *random.Random(2).sample(range(9000), 90))
    case = Case(tmp_path, serve, old, new)
    case.server.requests.clear()
    case.server.sent_bytes = 0
    case.fetch()
    assert case.is_whole()
    figures = case.figures
    print(
        f"\n{figures.fetched_bytes:,} bytes fetched ({case.server.sent_bytes:,} sent) for a release of {figures.release_bytes:,}"
        f" ({figures.fetched_bytes / figures.release_bytes:.2%}) in {len(case.server.requests)} requests; {90 * PIECE:,} are new"
    )
    assert figures.fetched_bytes < 0.015 * figures.release_bytes
