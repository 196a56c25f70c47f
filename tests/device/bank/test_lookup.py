"""Which bank of a board is played: where the release brings one, the device computed one, or its plate was measured."""

import dataclasses

import msgspec
import numpy as np
import pytest

from controller.device.bank import file_format, lookup
from controller.device.bank.grid import Grid
from controller.device.bank.lookup import find_bank
from controller.device.bank.provenance import Provenance
from controller.device.bank.reader import Bank
from controller.device.board.paths import BANK_FORMAT, bank_path, earlier_bank_path
from controller.errors import BankError

MEASURED = Provenance("measured", "cosines", points=250)
MODELLED = Provenance("modelled", "free edges")


@dataclasses.dataclass
class Device:
    """Where the banks of a board may be, and what makes them."""

    board: object
    release: object
    make: object

    def bank(self, path, provenance, pitch_m=None, **options):
        path.parent.mkdir(parents=True, exist_ok=True)
        grid = Grid.of(self.board.plate, pitch_m or self.board.bank.pitch_mm * 1e-3)
        self.make(path, grid, np.arange(grid.cells) == 0, provenance=provenance, **options)
        return path

    @property
    def found(self):
        return find_bank(self.board)


@pytest.fixture
def device(board, make_bank, tmp_path, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "state"))
    release = tmp_path / "releases/2.0"
    monkeypatch.setattr(lookup, "running_release", lambda: release)
    return Device(board, release / "banks" / f"{board.key}.bank", make_bank)


def test_a_banks_name_tells_the_format_of_its_file():
    assert BANK_FORMAT == file_format.VERSION


def test_without_any_it_is_where_one_is_built(device):
    assert device.found.path == bank_path(device.board)
    assert not device.found.of_release


def test_the_releases_comes_before_one_that_the_device_computed_and_says_so(device):
    own = device.bank(bank_path(device.board), MODELLED)
    assert device.found.path == own
    device.bank(device.release, MODELLED)
    assert (device.found.path, device.found.of_release) == (device.release, True)
    assert str(own) in device.found.why


@pytest.mark.parametrize("path", [bank_path, earlier_bank_path])
def test_one_that_was_measured_on_the_device_comes_first_by_whichever_name(device, path):
    device.bank(device.release, MEASURED)
    own = device.bank(path(device.board), MEASURED)
    assert device.found.path == own
    assert f"measured on this device, hence before {device.release}" in device.found.why


def test_a_damaged_one_is_reported_and_not_passed_over(device):
    device.bank(device.release, MODELLED)
    own = device.bank(bank_path(device.board), MEASURED)
    own.write_bytes(own.read_bytes()[:5000])
    assert device.found.path == own
    with pytest.raises(BankError, match="truncated"):
        Bank.open(device.found.path, device.board)


def test_a_damaged_one_of_the_release_is_reported_too(device):
    device.bank(device.release, MODELLED)
    device.release.write_bytes(b"HPBANK" + bytes(5000))
    assert device.found.path == device.release


def test_one_of_the_release_for_another_board_or_pitch_is_passed_over_and_said(device):
    own = bank_path(device.board)
    device.bank(device.release, MODELLED, digest=bytes(32))
    assert (device.found.path, device.found.why) == (own, f"the device's own: {device.release} is of another board")
    device.bank(device.release, MODELLED, pitch_m=9e-3)
    assert device.found.path == own
    assert "its cells are 9 mm apart" in device.found.why


def test_after_a_change_of_format_each_release_finds_its_own(device, monkeypatch):
    own = device.bank(bank_path(device.board), MEASURED)
    earlier = device.bank(earlier_bank_path(device.board), MODELLED)
    with monkeypatch.context() as later:
        later.setattr("controller.device.board.paths.BANK_FORMAT", 5)
        later.setattr(lookup, "VERSION", 5)
        assert device.found.path == bank_path(device.board) == own.with_name(f"{device.board.key}.v5.bank")
    assert device.found.path == own
    own.unlink()
    assert device.found.path == earlier


def test_a_board_of_the_release_is_the_systems(board, tmp_path, monkeypatch):
    import shutil

    from controller.device.board import lookup as boards
    from controller.device.board.board import load_board

    folder = tmp_path / "boards" / "panel"
    shutil.copytree(board.folder, folder)
    monkeypatch.setattr(boards, "running_release", lambda: tmp_path)
    monkeypatch.setattr(boards, "SYSTEM_BOARDS", tmp_path / "etc")
    found = load_board(boards.find_board("panel"))
    assert (found.folder, found.called, found.is_the_systems) == (folder, "panel", True)
    shutil.copytree(board.folder, tmp_path / "etc/panel")
    assert boards.find_board("panel") == tmp_path / "etc/panel", "the owner's comes first"
    assert msgspec.structs.replace(board, folder=tmp_path / "elsewhere").is_the_systems is False
