"""A board of a folder of its own, and what prepares its scenes."""

import shutil

import msgspec
import pytest

from controller.device.bank.reader import Bank
from controller.device.service.scenes.scene_reload import SceneChanger

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'


@pytest.fixture
def folder(board, tmp_path):
    shutil.copy(board.folder / "board.toml", tmp_path)
    (tmp_path / "scene.toml").write_text(CLICK)
    (tmp_path / "bad.toml").write_text("[[regions]]\nname = 7\n")
    return tmp_path


@pytest.fixture
def bank(bank_file, folder, board):
    with Bank.open(shutil.copy(bank_file, folder / "own.bank"), board) as opened:
        yield opened


@pytest.fixture
def changer(board, folder, bank):
    changer = SceneChanger(msgspec.structs.replace(board, folder=folder), "scene", bank, expect=lambda header: header.board_digest)
    yield changer
    changer.close()
