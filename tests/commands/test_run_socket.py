"""Where `haptic-panel run` serves the socket of a shipped board: in the service, and by hand where there is a folder for it."""

import msgspec
import pytest
from tables import each_row

from controller.commands import run
from controller.device.board.board import load_board
from controller.device.board.devices import ApplicationSocket
from controller.device.board.lookup import find_board


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """In place of /run/haptic-panel, which the service has."""
    monkeypatch.delenv("RUNTIME_DIRECTORY", raising=False)
    monkeypatch.setattr(run, "RUNTIME_FOLDER", tmp_path / "haptic-panel")
    return tmp_path / "haptic-panel"


@each_row("name", ["ulx3s", "ulx3s_pi5"])
def test_a_board_with_devices_has_one_for_the_groups_of_the_package(name):
    settings = load_board(find_board(name)).application_socket
    groups = (settings.group, settings.operate_group, settings.regions_group, settings.look_group)
    assert groups == ("haptic-play", "haptic-operate", "haptic-play", "haptic-look")


def served(folder, changed):
    return run._application_socket(changed(application_socket=ApplicationSocket(path=str(folder / "panel.sock"))))


@pytest.fixture
def changed(board):
    return lambda **values: msgspec.structs.replace(board, **values)


def test_by_hand_without_the_services_folder_the_panel_plays_without_it_and_says_so(folder, changed, capsys):
    assert served(folder, changed) is None
    assert f"is not served: the service has {folder}" in capsys.readouterr().err


def test_with_the_folder_or_in_the_service_or_elsewhere_it_is_served(folder, changed, monkeypatch, tmp_path):
    assert served(tmp_path / "elsewhere", changed) is not None
    monkeypatch.setenv("RUNTIME_DIRECTORY", str(folder))
    assert served(folder, changed) is not None, "a service whose folder is missing is to fail"
    monkeypatch.delenv("RUNTIME_DIRECTORY")
    folder.mkdir()
    assert served(folder, changed) is not None
