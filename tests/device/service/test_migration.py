"""Banks of the layout before releases are taken over, whatever interrupts it, and what an older release reads stays as it is."""

import os
import shutil

import pytest
from tables import each_row

from controller.device.bank.lookup import find_bank
from controller.device.bank.provenance import Provenance
from controller.device.board.paths import bank_path, earlier_bank_path
from controller.device.service import migration
from controller.device.service.migration import migrate

MEASURED, MODELLED = Provenance("measured", "cosines", points=250), Provenance("modelled", "free edges")


class PowerCutError(BaseException):
    """Nothing is done after it."""


@pytest.fixture
def state(board, make_bank, tmp_path, monkeypatch):
    """A state folder of before, with a measured bank."""
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    (tmp_path / "banks").mkdir()
    make_bank(earlier_bank_path(board), provenance=MEASURED)
    return tmp_path


def content(state):
    """All files by their names."""
    return {path.name: path.read_bytes() for path in (state / "banks").iterdir()}


def cut_after(monkeypatch, calls):
    """The power is cut after this many calls that change the disk; returns whether it was."""
    left = [calls]

    def counted(function):
        def call(*arguments, **options):
            if left[0] == 0:
                raise PowerCutError
            left[0] -= 1
            return function(*arguments, **options)

        return call

    for of, name in ((os, "link"), (os, "fsync"), (shutil, "copy2"), (migration.Path, "replace"), (migration.Path, "unlink")):
        monkeypatch.setattr(of, name, counted(getattr(of, name)))


def no_links(*_):
    raise PermissionError(1, "Operation not permitted")


@each_row("links", [True, False])
@each_row("renewed", [False, True], afresh=[state])
def test_a_power_cut_at_any_point_leaves_what_was_measured_and_the_next_start_goes_on(
    state, board, make_bank, monkeypatch, links, renewed
):
    """Renewed: an older release has calibrated the panel again, after it was taken over."""
    old, new = earlier_bank_path(board), bank_path(board)
    if renewed:
        make_bank(new, provenance=MEASURED, seed=1)
        os.utime(new, (1e9, 1e9))
    if not links:
        monkeypatch.setattr(os, "link", no_links)
    measured, replaced = old.read_bytes(), new.read_bytes() if renewed else None
    start = content(state)
    for calls in range(20):
        for path in (state / "banks").iterdir():
            path.unlink()
        for name, data in start.items():
            (state / "banks" / name).write_bytes(data)
        if renewed:
            os.utime(new, (1e9, 1e9))
        with monkeypatch.context() as patched:
            cut_after(patched, calls)
            try:
                done = bool(migrate(state))
            except PowerCutError:
                done = False
        assert find_bank(board).path.read_bytes() in (measured, replaced)
        migrate(state)
        assert old.read_bytes() == new.read_bytes() == measured
        assert replaced in (None, *content(state).values()), "a backup"
        assert migrate(state) == []
        if done:
            break
    assert done, "all points were reached"
    assert not [name for name in content(state) if name.endswith(".new")]
    assert calls >= 3


def test_a_computed_bank_never_takes_the_place_of_a_measured_one(state, board, make_bank):
    migrate(state)
    before = bank_path(board).read_bytes()
    make_bank(earlier_bank_path(board), provenance=MODELLED)
    os.utime(earlier_bank_path(board), (4e9, 4e9))
    assert migrate(state) == []
    assert bank_path(board).read_bytes() == before


def test_banks_of_another_format_and_what_cannot_be_written_are_left(state, board, monkeypatch):
    old = earlier_bank_path(board)
    other = old.with_name("other.bank")
    other.write_bytes(old.read_bytes()[:8] + b"\3\0\0\0" + bytes(5000))
    monkeypatch.setattr(migration, "_take", no_links)
    (said,) = migrate(state)
    assert said == f"{bank_path(board)}: cannot be taken over from {old} (Operation not permitted)"
    assert set(content(state)) == {old.name, other.name}
    assert find_bank(board).path == old


def test_there_need_be_nothing(tmp_path):
    assert migrate(tmp_path / "nothing") == []
