"""One file for a board's bank, whoever asks; what root makes for the service is the service's."""

import os
import pwd

import msgspec
import numpy as np
import pytest

from controller.device.bank.grid import Grid
from controller.device.board import lookup, paths
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.paths import bank_path, build_line, make_folder, state_folder
from controller.workshop.bank_builder.bank_fit import fit

ROOT_ONLY = pytest.mark.skipif(os.geteuid() != 0, reason="only root gives files away")


@pytest.fixture(autouse=True)
def no_state_folder(monkeypatch):
    monkeypatch.delenv("STATE_DIRECTORY", raising=False)


@pytest.fixture
def panel(tmp_path, monkeypatch):
    """A board of /etc, copied from another and still named as that one is."""
    folder = tmp_path / "etc" / "panel"
    folder.mkdir(parents=True)
    text = (find_board("ulx3s") / "board.toml").read_text()
    (folder / "board.toml").write_text(text)
    monkeypatch.setattr(lookup, "SYSTEM_BOARDS", folder.parent)
    monkeypatch.setattr(paths, "SERVICE_STATE", tmp_path / "var" / "haptic-panel")
    return load_board(find_board("panel"))


def test_a_device_has_a_board_of_its_own_once_there_is_one_called_panel(panel, tmp_path, monkeypatch):
    assert lookup.own_board() == "panel"
    monkeypatch.setattr(lookup, "SYSTEM_BOARDS", tmp_path / "empty")
    assert lookup.own_board() == "simulated"


def test_a_board_of_etc_has_its_bank_in_the_services_folder_by_the_name_it_is_called_by(panel, tmp_path, monkeypatch):
    assert panel.called == "panel"
    expected = tmp_path / "var" / "haptic-panel" / "banks" / "panel.v9.bank"
    assert bank_path(panel) == expected
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "var" / "haptic-panel"))
    assert bank_path(panel) == expected, "the service itself looks where root and the doctor look"
    monkeypatch.delenv("STATE_DIRECTORY")
    monkeypatch.chdir(panel.folder)
    assert bank_path(load_board(find_board("."))) == expected, "by whatever path it was given"


def test_any_other_boards_bank_lies_in_the_users_cache(board, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert bank_path(board) == tmp_path / "haptic-panel" / "banks" / "simulated.v9.bank"
    assert state_folder() == tmp_path / "haptic-panel"


def test_another_pitch_has_a_file_of_its_own(board):
    own = bank_path(board)
    assert bank_path(board, board.bank.pitch_mm * 1e-3) == own
    assert bank_path(board, 5e-3) == own.with_name("simulated-5mm.v9.bank")


def test_the_line_that_builds_a_bank_builds_that_bank(board, tmp_path):
    assert build_line(bank_path(board), board) == "haptic-panel bank build --board simulated"
    assert build_line(tmp_path / "my bank", board) == f"haptic-panel bank build --board simulated --out '{tmp_path}/my bank'"
    assert build_line(tmp_path, "x; rm -rf ~").startswith("haptic-panel bank build --board 'x; rm -rf ~'")


@ROOT_ONLY
def test_folders_that_root_makes_for_the_service_are_the_services(panel, tmp_path, monkeypatch):
    monkeypatch.setattr(paths, "service_user", lambda: pwd.getpwnam("nobody"))
    (tmp_path / "var").mkdir()
    folder = bank_path(panel).parent
    make_folder(folder)
    for place in (folder, folder.parent):
        assert (place.owner(), place.stat().st_mode & 0o777) == ("nobody", 0o750)
    assert folder.parent.parent.owner() == "root"
    os.chown(folder, 0, 0)
    make_folder(folder)
    assert folder.owner() == "nobody", "one that root made before the user was there is given to it too"


@ROOT_ONLY
def test_a_bank_that_root_builds_belongs_to_whom_its_folder_does(tmp_path, make_bank):
    user = pwd.getpwnam("nobody")
    folder = tmp_path / "banks"
    folder.mkdir()
    os.chown(folder, user.pw_uid, user.pw_gid)
    make_bank(folder / "panel.bank")
    assert (folder / "panel.bank").stat()[4:6] == (user.pw_uid, user.pw_gid)
    elsewhere = tmp_path / "not there yet"
    (folder / "link.bank").symlink_to(elsewhere)
    make_bank(folder / "link.bank")
    assert not elsewhere.exists(), "root is led nowhere by a link in a folder that is another's"
    assert not (folder / "link.bank").is_symlink()


def test_a_folder_that_cannot_be_made_is_one_line_with_what_to_do(panel, monkeypatch):
    monkeypatch.setattr(paths, "SERVICE_STATE", paths.Path("/proc/nothing"))
    with pytest.raises(
        paths.BankError, match=r"/proc/nothing.*cannot be made .*root and the user haptic-panel may; else give --out"
    ):
        make_folder(bank_path(panel).parent)


def test_the_board_of_a_folder_without_a_name_is_called_by_its_own(board):
    assert msgspec.structs.replace(board, folder=paths.Path("/")).key == "simulated"


@ROOT_ONLY
def test_a_bank_that_this_user_may_not_read_is_reported_and_not_built_again(panel, tmp_path, make_bank):
    for place in (tmp_path, *tmp_path.parents):
        if place != paths.Path("/"):
            place.chmod(place.stat().st_mode | 0o11)
    path = bank_path(panel)
    path.parent.mkdir(parents=True)
    make_bank(path)
    path.chmod(0o600)
    os.seteuid(pwd.getpwnam("nobody").pw_uid)
    try:
        with pytest.raises(paths.BankError, match=r"panel\.v9\.bank: cannot be read \(Permission denied\)$"):
            fit(path, panel, np.ones(Grid.of(panel.plate, panel.bank.pitch_mm * 1e-3).cells, bool))
    finally:
        os.seteuid(0)
