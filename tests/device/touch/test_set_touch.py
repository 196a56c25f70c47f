"""Lines for [touch], put into a board by root's script: nothing else of what a less trusted program says is taken."""

import os
import subprocess
import tomllib
from pathlib import Path

import pytest
from tables import each_row

ROOT = Path(__file__).parents[3]
SCRIPT = ROOT / "systemd/set-touch"
BOARD = (ROOT / "boards/ulx3s/board.toml").read_text()
AXES = "x_mm_from_axes = [1.000, -2.500, 3.0]\ny_mm_from_axes = [0.000, 148.000, -0.125]\n"


@pytest.fixture
def board(tmp_path):
    """board.toml of a board called `panel`."""
    (tmp_path / "panel").mkdir()
    file = tmp_path / "panel/board.toml"
    file.write_text(BOARD)
    file.chmod(0o640)
    return file


def put(board, said, name="panel"):
    """What the script does with this."""
    environment = os.environ | {"BOARDS": str(board.parent.parent)}
    return subprocess.run([SCRIPT, name], input=said, capture_output=True, text=True, check=False, env=environment)


def test_the_lines_of_a_calibration_are_put_where_they_belong(board):
    said = AXES + "residual: 0.10 mm rms\nfor [touch] of board.toml (--write puts them there)\n"
    done = put(board, said)
    assert (done.returncode, done.stdout, done.stderr) == (0, f"{said}written to {board}\n", "")
    before, after = BOARD.splitlines(), board.read_text().splitlines()
    changed = [new for old, new in zip(before, after, strict=True) if old != new]
    assert changed == AXES.splitlines()
    assert board.stat().st_mode & 0o777 == 0o640
    assert list(board.parent.iterdir()) == [board]


def test_a_key_that_is_absent_is_put_first_and_comments_stay(board):
    assert put(board, "ghost_ms = 12.0\nlag_ms = 4.5\n").returncode == 0
    touch = tomllib.loads(board.read_text())["touch"]
    assert (touch["ghost_ms"], touch["lag_ms"]) == (12.0, 4.5)
    assert {key: value for key, value in touch.items() if key not in ("ghost_ms", "lag_ms")} == {
        key: value for key, value in tomllib.loads(BOARD)["touch"].items() if key not in ("ghost_ms", "lag_ms")
    }
    assert [line.count("#") for line in board.read_text().splitlines() if line.startswith("lag_ms")] == [1]


@each_row(
    "said",
    [
        "",
        "max_duty = 1.0\n",
        "ghost_ms = 1e9\n",
        "ghost_ms = 1.0 # \n",
        "ghost_ms = $(touch /tmp/x)\n",
        "ghost_ms = 12345678.0\n",
        " ghost_ms = 1.0\n",
        "x_mm_from_axes = [1, 2]\n",
        "x_mm_from_axes = [1, 2, 3]; y = 1\n",
        "x_mm_from_axes = [1, 2, nan]\n",
        "ghost_ms = 1.0" * 10_000,
    ],
)
def test_anything_else_changes_nothing(board, said):
    done = put(board, said)
    assert done.returncode == 78
    assert "no line for [touch] was found" in done.stderr
    assert board.read_text() == BOARD


@each_row(
    "text",
    [
        BOARD.replace("[touch]", "[tuch]"),
        BOARD.replace("x_mm_from_axes = [210.0, 0.0, 0.0]", "x_mm_from_axes = [\n210.0, 0.0, 0.0]"),
        BOARD.replace("x_mm_from_axes = [210.0, 0.0, 0.0]", "x_mm_from_axes = [210.0, 0.0, 0.0]\nx_mm_from_axes = [1.0, 0.0, 0.0]"),
        BOARD.replace("x_mm_from_axes = [210.0, 0.0, 0.0]", ""),
    ],
)
def test_a_board_that_is_written_otherwise_stays_as_it_is(board, text):
    assert text != BOARD
    board.write_text(text)
    done = put(board, AXES)
    assert (done.returncode, board.read_text()) == (78, text)
    assert all(line in done.stderr for line in AXES.splitlines())
    assert list(board.parent.iterdir()) == [board]


@each_row("name", ["../panel", "", ".", "panel/x", "-x", "other"])
def test_another_name_is_refused(board, name):
    assert put(board, AXES, name).returncode == 78
    assert board.read_text() == BOARD
