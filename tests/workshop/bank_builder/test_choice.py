"""What `compose.method = "auto"` chooses for shipped scenes, and why; a bank without responses plays its scene and no other."""

from dataclasses import replace

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.device.bank.inspection import bounds_of, wrong_pitch
from controller.device.bank.memory import memory_fit
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.devices import ApplicationSocket
from controller.device.board.lookup import find_board
from controller.device.board.paths import bank_path
from controller.device.loop.fixed_emitters import needs_responses
from controller.device.scene.coverage import cells_needed
from controller.device.scene.scene import load_scene
from controller.device.service.scenes.prepare_scene import populate
from controller.errors import BankError, ConfigError
from controller.workshop.bank_builder import choice as module
from controller.workshop.bank_builder.bank_fit import choice_of, fit
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.choice import Setting, choose, settings
from controller.workshop.bank_builder.own_bank import order
from controller.workshop.bank_builder.request import BankRequest
from tests.small_plate import small_board

SIMULATED = find_board("simulated")
MARGIN_M = 5e-3
KEYS = """
[[regions]]
name = "key"
shape = "rectangle"
x_mm = 20.0
y_mm = 20.0
width_mm = 15.0
height_mm = 10.0
policy = "alternate"
effects = ["click"]
"""


def auto(board, **bounds):
    return msgspec.structs.replace(board, compose=msgspec.structs.replace(board.compose, method="auto", **bounds))


@pytest.fixture(scope="module")
def board():
    return auto(load_board(SIMULATED))


@pytest.fixture(autouse=True)
def two_pitches(monkeypatch):
    monkeypatch.setattr(module, "PITCHES_MM", (1.25, 4.0))


def chosen(board, name):
    file = SIMULATED / f"{name}.toml"
    return choose(board, load_scene(file, board), file, MARGIN_M)


@pytest.mark.slow
def test_shipped_scenes_get_different_banks_for_a_reason(board):
    everything, keyboard, emitters = (chosen(board, name) for name in ("scene", "keyboard", "spots"))
    assert (everything["compact"], everything["composes"]) == (True, True), (
        "fingers between cells, several at once, on all the plate"
    )
    plain = [row for row in everything["front"] if row[4] > 5 * everything["bytes"]]
    assert any(row[2] < everything["error"] and row[3] < everything["lone_us"] for row in plain), "memory buys accuracy and time"
    assert not keyboard["compact"]
    assert (keyboard["pitch_mm"], keyboard["composes"]) == (1.25, False), "keys are felt one after the other, in full"
    assert keyboard["snap_mm"] > 1.25, "the nearest cell serves wherever the finger is"
    assert not emitters["composes"], "what they play together is composed beforehand"
    assert emitters["bytes"] < keyboard["bytes"]
    for reported in (everything, keyboard, emitters):
        assert reported["error"] <= board.compose.max_error
        assert reported["time_us"] <= board.compose.max_time_us
        assert "the smallest of" in reported["why"]


def test_a_board_without_the_memory_for_its_full_bank_gets_a_compact_one(tmp_path):
    board = small_board()
    full = memory_fit(board, 1).full_bytes
    assert full == build_bank(BankRequest(board, tmp_path / "full")).bytes
    for memory_bytes, compact in ((3.99 * full, True), (4.01 * full, False)):
        assert memory_fit(board, round(memory_bytes)).compact == compact
        given = msgspec.structs.replace(board, compose=msgspec.structs.replace(board.compose, memory_mb=memory_bytes / 1e6))
        wanted = order(given)
        assert (wanted.compact, wanted.own_path) == (compact, bank_path(given))
        assert ("too much: the board's is a compact one" in memory_fit(given).in_words()) == compact
        assert not order(given, pitch_mm=3.0).compact, "asked for"
    small = msgspec.structs.replace(board, compose=msgspec.structs.replace(board.compose, memory_mb=1.0))
    order(small).build(tmp_path / "bank")
    with Bank.open(tmp_path / "bank", small) as bank:
        assert (wrong_pitch(bank, small), wrong_pitch(bank, board)) == ("", "it is compact, as compose.method chose")
    assert fit(tmp_path / "bank", board, np.ones(3, bool)).reason


def test_auto_rather_takes_long_than_more_than_the_memory_suits(monkeypatch, tmp_path):
    quick = Setting(4.0, 1.0, True, 0.05, 400.0, 6.0, 80_000_000)
    small = Setting(4.1, 0.0, True, 0.02, 550.0, 12.0, 8_000_000, compact=True)
    monkeypatch.setattr(module, "settings", lambda *_: [quick, small])
    file = tmp_path / "keys.toml"
    file.write_text(KEYS)
    for memory_mb, best in ((321.0, quick), (319.0, small)):
        board = auto(small_board(), memory_mb=memory_mb)
        found = choose(board, load_scene(file, board), file, MARGIN_M)
        assert found["pitch_mm"] == best.pitch_mm
        assert ("though it takes 550 us: others take much memory" in found["why"]) == best.compact


def test_the_choice_is_the_smallest_on_the_front_within_all_bounds(monkeypatch, tmp_path):
    board, file = auto(small_board()), tmp_path / "keys.toml"
    file.write_text(KEYS)
    scene = load_scene(file, board)
    found = settings(board, scene, MARGIN_M)
    monkeypatch.setattr(module, "settings", lambda *_: found)
    for max_error, max_time_us in ((0.3, 500.0), (0.05, 500.0), (0.3, 1.0)):
        reported = choose(auto(board, max_error=max_error, max_time_us=max_time_us), scene, file, MARGIN_M)
        within = [one for one in found if one.error <= max_error and one.time_us <= max_time_us]
        assert reported["bytes"] == min(one.bytes for one in within)
        assert reported["lone_us"] == min(one.lone_us for one in within if one.bytes == reported["bytes"])
    with pytest.raises(ConfigError, match=r"compose.max_error = 0.001 and compose.max_time_us = 1 cannot both be kept") as raised:
        choose(auto(board, max_error=0.001, max_time_us=1.0), scene, file, MARGIN_M)
    assert "\n" not in str(raised.value)
    size = choose(auto(board, max_error=0.05), scene, file, MARGIN_M)["bytes"]
    fits = auto(board, max_error=0.05, max_bank_mb=size / 1e6)
    assert choose(fits, scene, file, MARGIN_M)["asked"].items() >= bounds_of(fits).items()
    assert bounds_of(fits)["max_bank_mb"] == size / 1e6
    with pytest.raises(ConfigError, match=r"and compose.max_bank_mb = [\d.]+ cannot all be kept .* the smallest bank 0\.\d+ MB"):
        choose(auto(board, max_error=0.05, max_bank_mb=0.999 * size / 1e6), scene, file, MARGIN_M)


def test_a_setting_is_beaten_by_one_that_is_as_good_in_all_and_better_in_one():
    one = Setting(2.5, 1.0, True, error=0.08, time_us=164, lone_us=3.0, bytes=100)
    assert not one.beaten_by(one)
    for better in ({"error": 0.07}, {"lone_us": 2.0}, {"bytes": 99}):
        other = replace(one, **better)
        assert one.beaten_by(other)
        assert not other.beaten_by(one)


@each_row(("name", "needed"), [("scene", True), ("library", True), ("keyboard", False), ("spots", False)])
def test_a_scene_needs_responses_if_it_can_ask_for_anything_between_cells(board, name, needed):
    assert needs_responses(load_scene(SIMULATED / f"{name}.toml", board)) is needed


def test_places_kept_still_need_responses(tmp_path):
    board, file = small_board(), tmp_path / "keys.toml"
    for more, needed in (("", False), ('nulled = "others"\n', True)):
        file.write_text(KEYS.replace('policy = "alternate"\n', f'policy = "alternate"\n{more}'))
        assert needs_responses(load_scene(file, board)) is needed


def test_commands_can_ask_for_anything_so_a_board_with_a_socket_gets_responses(tmp_path):
    board, file = auto(small_board()), tmp_path / "keys.toml"
    file.write_text(KEYS)
    served = msgspec.structs.replace(board, application_socket=ApplicationSocket(path="/tmp/panel.sock"))
    assert not all(one.composes for one in settings(board, load_scene(file, board), MARGIN_M))
    assert all(one.composes for one in settings(served, load_scene(file, board), MARGIN_M))


def test_a_bank_without_responses_plays_its_scene_and_no_other(tmp_path):
    panel = auto(small_board(), max_error=0.3, max_time_us=1.0)
    file, other = tmp_path / "keys.toml", tmp_path / "soft.toml"
    file.write_text(KEYS)
    other.write_text(KEYS.replace("policy", "amplitude = 0.5\npolicy"))
    scene, soft = load_scene(file, panel), load_scene(other, panel)
    choice = choose(panel, scene, file, MARGIN_M)
    assert not choice["composes"]
    cells = cells_needed(
        scene, module.Grid.of(panel.plate, choice["pitch_mm"] * 1e-3).points(), choice["pitch_mm"] * 1e-3, MARGIN_M
    )
    path = tmp_path / "bank"
    report = build_bank(BankRequest(panel, path, choice["pitch_mm"] * 1e-3, cells, choice=choice))
    assert choice_of(path) == choice
    assert report.bytes < choice["bytes"] + 3 * 4096, "the header may take more pages than was reckoned"
    with Bank.open(path, panel) as bank:
        assert bank.sections["response"].size == 0
        assert bank.snap_m(panel) == choice["snap_mm"] * 1e-3
        assert bank.snap_m(small_board()) == choice["snap_mm"] * 1e-3, "it has nothing else to play, whatever the board says"
        assert wrong_pitch(bank, panel) == ""
        assert "it was not chosen for compose.max_error = 0.2" in wrong_pitch(bank, auto(panel, max_error=0.2))
        assert wrong_pitch(bank, small_board()) == "it holds no responses, as compose.method = auto chose"
        assert populate(bank, scene, "keys", responses=True) == int(
            cells_needed(scene, bank.grid.points(), bank.grid.pitch_m).sum()
        )
        with pytest.raises(BankError, match="holds no responses, from which soft needs waveforms composed"):
            populate(bank, soft, "soft")
        with pytest.raises(BankError, match="holds no responses, so only its cells are played"):
            bank.responses.check(int(cells.argmax()))
