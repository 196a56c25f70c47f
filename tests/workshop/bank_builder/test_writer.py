import errno
import os
import resource
import signal
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from tables import each_row

from controller.device.bank.file_format import Header
from controller.device.bank.grid import Grid
from controller.device.bank.inspection import verify_bank
from controller.device.bank.reader import Bank
from controller.errors import BankError
from controller.workshop.bank_builder.writer import BankWriter

GRID = Grid(5e-3, 3, 2, 5e-3, 6e-3)
ALL = np.ones(6, bool)
WORDS, LEVELS = np.arange(9, dtype="<u4"), np.ones((14, 32), np.int8)


def header(entries: int = 6, samples: int = 9) -> Header:
    return Header("test", bytes(32), GRID, 500e3, samples, entries)


@pytest.fixture
def old(tmp_path, make_bank):
    """Path of a bank that must survive; afterwards it must be as it was, and alone."""
    folder = tmp_path / "folder [1]"
    folder.mkdir()
    make_bank(folder / "bank")
    before = (folder / "bank").read_bytes()
    yield folder / "bank"
    assert (folder / "bank").read_bytes() == before
    assert [file.name for file in folder.iterdir()] == ["bank"]


def write_all(path, samples=9):
    reported = header(samples=samples)
    levels = np.resize(LEVELS, (samples + reported.rest_rows, 32))
    with BankWriter(path, reported, ALL) as writer:
        for cell in range(6):
            writer.add(
                cell,
                np.resize(WORDS, samples).astype("<u4"),
                levels,
                1e-9,
            )


def test_a_new_bank_takes_the_place_of_the_old_one_and_can_be_read_by_others(tmp_path, make_bank):
    path = tmp_path / "bank"
    make_bank(path)
    mask = os.umask(0o022)
    try:
        write_all(path)
    finally:
        os.umask(mask)
    assert verify_bank(path)["good"]
    with Bank.open(path) as bank:
        assert bank.drive.words(5) == WORDS.tobytes()
        assert bank.header.creator == "test"
    assert path.stat().st_mode & 0o777 == 0o644
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, RuntimeError])
def test_an_interrupted_build_leaves_the_old_bank_and_nothing_else(old, interruption):
    def interrupted():
        with BankWriter(old, header(), ALL) as writer:
            writer.add(0, WORDS, LEVELS, 1e-9)
            raise interruption

    with pytest.raises(interruption):
        interrupted()


def test_a_bank_without_all_its_entries_is_never_put_in_place(old):
    with pytest.raises(BankError, match="5 of 6 entries were never written"), BankWriter(old, header(), ALL) as writer:
        writer.add(0, WORDS, LEVELS, 1e-9)


@each_row(
    ("entry", "reason"),
    [
        ((1, WORDS, LEVELS, 1e-9), "not asked for"),
        ((0, WORDS, LEVELS, 1e-9), "its entry already"),
        ((2, WORDS[:8], LEVELS, 1e-9), "9 samples"),
        ((2, WORDS.astype(">u4"), LEVELS, 1e-9), "9 samples"),
        ((2, WORDS, LEVELS[:, :31], 1e-9), "9 samples"),
        ((2, WORDS, LEVELS[:9], 1e-9), "14 rows"),
        ((2, WORDS, LEVELS.astype(float), 1e-9), "9 samples"),
    ],
    afresh=[old],
)
def test_refuses_an_entry_that_does_not_belong(old, entry, reason):
    def misled():
        with BankWriter(old, header(3), np.arange(6) % 2 == 0) as writer:
            writer.add(0, WORDS, LEVELS, 1e-9)
            writer.add(*entry)

    with pytest.raises(ValueError, match=reason):
        misled()


@pytest.mark.parametrize("cells", [np.ones(5, bool), np.zeros(6, bool)])
def test_refuses_cells_that_do_not_fit_the_header(old, cells):
    with pytest.raises(ValueError, match="do not fit"):
        BankWriter(old, header(), cells)


@contextmanager
def largest_file(size: int):
    """The kernel refuses to make a file larger, in the midst of writing it."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def test_room_that_runs_out_is_noticed_before_the_first_entry(old):
    with largest_file(40_000), pytest.raises(BankError, match=r"cannot be written \(File too large\)"):
        BankWriter(old, header(), ALL).__enter__()


def test_room_that_runs_out_in_the_midst_leaves_the_old_bank(old):
    def cramped():
        with BankWriter(old, header(), ALL) as writer:
            writer.add(0, WORDS, LEVELS, 1e-9)
            with largest_file(20_000):
                writer.add(1, WORDS, LEVELS, 1e-9)

    with pytest.raises(BankError, match=r"cannot be written \(File too large\)"):
        cramped()


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 128 kB, where we may mount one."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=128k", "tmpfs", folder]
    if os.geteuid() or subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("mounting a small file system needs root; the tests with a limit on the size of files stand in")
    try:
        yield folder
    finally:
        subprocess.run(["umount", folder], check=True)


def test_a_full_disk_leaves_the_old_bank(small_disk, make_bank):
    path = small_disk / "bank"
    make_bank(path)
    before = path.read_bytes()
    with pytest.raises(BankError, match="No space left on device"):
        write_all(path, samples=1000)
    assert path.read_bytes() == before
    assert list(small_disk.iterdir()) == [path]
    write_all(path)  # one that fits beside the old one


@contextmanager
def ordinary_user():
    """For root, nothing is unwritable; so be nobody for a moment."""
    root = os.geteuid() == 0
    if root:
        os.seteuid(65534)
    try:
        yield
    finally:
        if root:
            os.seteuid(0)


def test_a_folder_that_cannot_be_written_leaves_the_old_bank(make_bank):
    with tempfile.TemporaryDirectory() as name:  # not below tmp_path, which only its owner may enter
        path = Path(name) / "bank"
        make_bank(path)
        before = path.read_bytes()
        path.parent.chmod(0o555)
        try:
            with ordinary_user(), pytest.raises(BankError, match=r"cannot be written \(Permission denied\)"):
                write_all(path)
        finally:
            path.parent.chmod(0o755)
        assert path.read_bytes() == before


def test_refuses_a_folder_that_is_missing_and_a_path_that_is_a_folder(tmp_path):
    with pytest.raises(BankError, match="No such file"):
        write_all(tmp_path / "nowhere" / "bank")
    with pytest.raises(BankError, match="Is a directory"):
        write_all(tmp_path)
    assert not list(tmp_path.iterdir())


WRITER_THAT_STOPS = """
import sys, numpy as np
from pathlib import Path
from controller.device.bank.file_format import Header
from controller.device.bank.grid import Grid
from controller.workshop.bank_builder.writer import BankWriter
with BankWriter(Path(sys.argv[1]), Header("test", bytes(32), Grid(5e-3, 3, 2, 5e-3, 6e-3), 5e5, 9, 6), np.ones(6, bool)) as writer:
    writer.add(0, np.zeros(9, "<u4"), np.zeros((14, 32), np.int8), 1.0)
    print("half way", flush=True)
    sys.stdin.read()
"""


def test_a_killed_writer_leaves_the_old_bank_and_the_next_build_clears_up(tmp_path, make_bank):
    path = tmp_path / "bank [1]"
    make_bank(path, seed=1)
    before = path.read_bytes()
    with subprocess.Popen(
        [sys.executable, "-c", WRITER_THAT_STOPS, path], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        assert process.stdout.readline() == b"half way\n"
        (building,) = tmp_path.glob(".bank*.building")
        make_bank(path, seed=1)  # another build meanwhile: the living writer's file is left alone
        assert building.exists()
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert building.exists()
    assert path.read_bytes() == before
    (tmp_path / ".bank [1]note.12345678.building").touch()  # of another bank
    make_bank(path, seed=1)
    assert sorted(file.name for file in tmp_path.iterdir()) == [".bank [1]note.12345678.building", "bank [1]"]
    assert path.read_bytes() == before


def test_where_the_file_system_cannot_reserve_room_the_bank_is_written_all_the_same(tmp_path, monkeypatch):
    def not_here(*_):
        raise OSError(errno.EOPNOTSUPP, os.strerror(errno.EOPNOTSUPP))

    monkeypatch.setattr(os, "posix_fallocate", not_here)
    write_all(tmp_path / "bank")
    assert verify_bank(tmp_path / "bank")["good"]
