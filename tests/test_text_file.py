"""One reader for the text files of people: marks, encodings and line ends are no fault, other bytes are named by line."""

import codecs

import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.scene.scene_file import read_scene
from controller.device.touch_calibration.touch_table import write_value
from controller.errors import ConfigError
from controller.text_file import NotText, decoded, read_text
from controller.workshop.calibration.records.points import read_points
from controller.workshop.simulation.drift import Drift

TEXT = 'name = "µ"\nx = 1\n'
WRITTEN = {
    "plain": TEXT.encode(),
    "UTF-8 with a mark": codecs.BOM_UTF8 + TEXT.encode(),
    "little-endian": codecs.BOM_UTF16_LE + TEXT.encode("utf-16-le"),
    "big-endian": codecs.BOM_UTF16_BE + TEXT.encode("utf-16-be"),
    "line ends of Windows": codecs.BOM_UTF8 + TEXT.replace("\n", "\r\n").encode(),
    "old line ends": TEXT.replace("\n", "\r").encode(),
}


@each_row("written", WRITTEN.values(), ids=WRITTEN)
def test_text_is_text_however_it_was_saved(tmp_path, written):
    (tmp_path / "file").write_bytes(written)
    assert read_text(tmp_path / "file") == TEXT


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"a\nb\n\xe9t\xe9\n", "line 3 is not UTF-8: save the file as UTF-8"),
        (codecs.BOM_UTF16_LE + "a\nb".encode("utf-16-le") + b"\x00", "line 2 is not UTF-16-LE"),
    ],
)
def test_what_is_no_text_is_refused_by_line(data, said):
    with pytest.raises(NotText, match=said):
        decoded(data)


def test_a_file_without_end_is_not_read_to_its_end(tmp_path):
    (tmp_path / "long").write_bytes(b"12345")
    assert read_text(tmp_path / "long", 5) == "12345"
    with pytest.raises(NotText, match="larger than the 4 bytes"):
        read_text(tmp_path / "long", 4)


@pytest.fixture
def with_mark(tmp_path):
    """A copy of a file with a byte order mark and the line ends of Windows."""

    def copied(file, name):
        text = file.read_text() if hasattr(file, "read_text") else file
        (tmp_path / name).write_bytes(codecs.BOM_UTF8 + text.replace("\n", "\r\n").encode())
        return tmp_path / name

    return copied


def test_each_file_of_a_panel_may_have_a_mark(with_mark, tmp_path):
    folder = find_board("simulated")
    with_mark(folder / "board.toml", "board.toml")
    board = load_board(tmp_path)
    assert read_scene(with_mark(folder / "scene.toml", "scene.toml"), board).regions
    assert Drift.read(with_mark("time_s,drift_percent\n0,0.1\n1,0.2\n", "drift.csv")).level(1.0) == pytest.approx(2e-3)
    assert len(read_points(with_mark("point,x_mm,y_mm\n1,10,20\n", "points.csv"), board)[0]) == 1


def test_a_board_with_a_mark_can_be_written_to(with_mark, tmp_path):
    file = with_mark(find_board("simulated") / "board.toml", "board.toml")
    write_value(file, "lag_ms", 3.5)
    assert load_board(tmp_path).touch.lag_ms == 3.5
    assert b"\r\n" in file.read_bytes(), "its line ends stay"


def test_a_board_that_is_no_text_says_where(tmp_path):
    (tmp_path / "board.toml").write_bytes(b'name = "caf\xe9"\n')
    with pytest.raises(ConfigError, match=r"board\.toml: not valid TOML: line 1 is not UTF-8: save the file as UTF-8"):
        load_board(tmp_path)
