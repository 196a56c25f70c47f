"""Another scene prepared by a child process: what it gives back, and what becomes of everything that can go wrong."""

import selectors
import shutil
import subprocess
import sys

import msgspec
import pytest

from controller import scene_change
from controller.bank.reader import Bank
from controller.errors import BankError, ConfigError
from controller.prepare_scene import populate
from controller.scene import Scene, load_scene
from controller.scene_change import SceneChanger

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
    changer = SceneChanger(msgspec.structs.replace(board, folder=folder), "scene", bank)
    yield changer
    changer.close()


def prepared(changer):
    """Wait as the loop does."""
    with selectors.DefaultSelector() as selector:
        while (done := changer.take()) is None:
            selector.register(changer.fileno(), selectors.EVENT_READ)
            selector.select()
            selector.unregister(changer.fileno())
    return done


def test_the_same_scene_read_again_is_the_one_in_the_file(changer, folder):
    (folder / "scene.toml").write_text(CLICK.replace('"all"', '"another"'))
    changer.begin(None, 0)
    done = prepared(changer)
    assert isinstance(done.scene, Scene)
    assert [area.name for area in done.scene.areas] == ["another"]
    assert (done.ticket, done.selection, done.reason) == (0, None, "")
    assert changer.fileno() is None


def test_a_bad_scene_is_told_with_its_file_and_key(changer):
    changer.begin("bad", 5)
    done = prepared(changer)
    assert (done.ticket, done.scene) == (5, None)
    assert "bad.toml" in done.reason
    assert "shape" in done.reason


def test_a_bank_that_took_the_place_of_the_old_one_is_opened(changer, bank_file, folder):
    shutil.copy(bank_file, folder / "new.bank")
    (folder / "new.bank").replace(folder / "own.bank")
    changer.begin(None, 0)
    selection = prepared(changer).selection
    assert selection.composes, "the memory for composing is taken before it plays"
    changer.begin(None, 0)
    assert prepared(changer).selection is None, "once"


def test_a_damaged_bank_leaves_the_old_one(changer, bank_file, folder):
    content = bytearray(bank_file.read_bytes())
    content[len(content) // 2] ^= 1
    (folder / "new.bank").write_bytes(content)
    (folder / "new.bank").replace(folder / "own.bank")
    changer.begin(None, 0)
    done = prepared(changer)
    assert (done.scene, done.selection) == (None, None)
    assert "damaged" in done.reason


def test_only_one_is_prepared_at_a_time_and_a_reload_meanwhile_is_not_lost(changer):
    changer.begin("scene", 1)
    with pytest.raises(ConfigError, match="another scene is being prepared"):
        changer.begin("bad", 2)
    changer.begin(None, 0)
    assert prepared(changer).ticket == 1
    assert changer.fileno() is not None, "the reload"
    assert prepared(changer).ticket == 0


def test_a_child_that_dies_is_a_refusal(changer, monkeypatch):
    monkeypatch.setattr(scene_change.sys, "executable", shutil.which("false"))
    changer.begin("scene", 3)
    done = prepared(changer)
    assert (done.ticket, done.scene) == (3, None)
    assert "failed" in done.reason


def test_no_process_left_is_a_refusal_and_not_the_end(changer, monkeypatch):
    monkeypatch.setattr(scene_change.sys, "executable", "/nowhere/python")
    changer.begin("scene", 4)
    done = changer.take()
    assert (done.ticket, done.scene) == (4, None)
    assert "No such file" in done.reason


def test_a_bank_that_lacks_what_the_scene_reaches_is_refused(board, bank, folder, tmp_path):
    from controller.offline.bank_builder import build_bank

    file = tmp_path / "corner.bank"
    reached = (bank.grid.points() < 0.06).all(axis=1)
    build_bank(board, file, bank.grid.pitch_m, reached, measure_sgemm=False)
    scene = load_scene(folder / "scene.toml", board)
    with Bank.open(file, board) as small, pytest.raises(BankError, match="has no entry for"):
        populate(small, scene, "scene.toml")
    assert populate(bank, scene, "scene.toml") == bank.grid.cells


def test_the_child_is_given_three_things_and_says_one(folder, bank):
    command = [sys.executable, "-m", "controller.prepare_scene", str(folder), "nowhere", str(bank.path)]
    done = subprocess.run(command, capture_output=True, check=True)
    assert b"nowhere" in done.stdout
    assert done.stderr == b""
