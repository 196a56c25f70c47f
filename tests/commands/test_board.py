"""`haptic-panel board`: what is found in a board and its scene, or what is wrong with them."""

import json
import re
import shutil

import pytest
from tables import each_row

from controller.cli import main
from controller.device.board.lookup import data_folder


@pytest.fixture
def copied(board, tmp_path):
    folder = tmp_path / "panel"
    shutil.copytree(board.folder, folder)
    return folder


def test_a_board_is_checked_with_its_scene_and_recording(copied, capsys):
    assert main(["board", "check", str(copied)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith(f"{copied / 'board.toml'}: board 'simulated', plate 210 × 148 × 0.5 mm, 32 channels")
    assert lines[1] == "devices: touch panel recording, link simulated"
    assert lines[2].startswith(f"{copied / 'scene.toml'}: 13 regions")
    assert lines[-1] == "PASS: every key is valid, and they go together"


@each_row("name", sorted(file.parent.name for file in data_folder("boards").glob("*/board.toml")))
def test_every_shipped_board_is_valid(name, capsys):
    assert main(["board", "check", name, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["board"] == name
    assert 1 <= found["channels"] <= (64 if name == "simulated_64" else 32)
    ms = found["first_word_ms"]
    table = (data_folder("boards") / "README.md").read_text().split("## From a touch")[1].split("##")[0]
    (row,) = re.findall(rf"^\|[^|]*\b{name}\b.*", table, re.MULTILINE)
    assert f"| {ms['panel']:g} ms" in row
    assert f"| {ms['upload'] * 1e3:,.0f} / {ms['play'] * 1e3:.0f} µs | {ms['trigger'] * 1e3:.3g} µs |" in row


@each_row(
    ("file", "was", "becomes", "said"),
    [
        ("board.toml", 'kind = "recording"', 'kind = "cst999"', "touch.kind = 'cst999': must be one of 'ft5x06', 'gt911', "),
        ("board.toml", "demo.evemu", "no.evemu", "touch.recording = 'no.evemu': there is no file"),
        ("scene.toml", 'shape = "rectangle"', 'shape = "square"', "shape = 'square': must be one of 'rectangle', 'circle'"),
    ],
    afresh=[copied],
)
def test_what_is_invalid_is_said_with_file_and_key(copied, capsys, file, was, becomes, said):
    text = (copied / file).read_text()
    assert was in text
    (copied / file).write_text(text.replace(was, becomes, 1))
    assert main(["board", "check", "--board", str(copied)]) == 78
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 1
    assert f"{copied / file}: " in err
    assert said in err


def test_reference_and_schemas_are_printed(capsys):
    assert main(["board", "reference"]) == 0
    assert "# scene.toml" in capsys.readouterr().out
    for arguments, title in (([], "Board"), (["--scene"], "SceneTable")):
        assert main(["board", "schema", *arguments]) == 0
        assert json.loads(capsys.readouterr().out)["$ref"] == f"#/$defs/{title}"
