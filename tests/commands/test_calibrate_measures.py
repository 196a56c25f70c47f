"""`calibrate-touch --ghosts` and `--lag` from the command line to the line in board.toml."""

import json
import os
import shutil

import pytest
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.commands.calibrate_touch import ghosts as calibrate_ghosts
from controller.device.board.board import load_board
from controller.device.touch_calibration.event_capture import EventCapture
from controller.device.touch_calibration.touch_table import with_value
from controller.errors import CalibrationError, FaultError
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.simulated_link import open_simulated
from controller.workshop.simulation.ghostly_panel import GhostlyPanel, Ghosts, pins_of


@pytest.fixture
def copied(board, tmp_path):
    folder = tmp_path / "panel"
    shutil.copytree(board.folder, folder)
    return folder


def test_a_mouse_that_is_absent_is_named(copied, capsys):
    far_end, near_end = os.openpty()
    file = copied / "board.toml"
    panel = f'kind = "serial_panel"\ndevice = "{os.ttyname(near_end)}"\n'
    text = file.read_text().replace('kind = "recording"\nrecording = "demo.evemu"\n', panel)
    assert "serial_panel" in text
    file.write_text(text)
    arguments = ["calibrate-touch", "--lag", "--board", str(copied), "--reference", "/dev/input/none"]
    try:
        assert main(arguments) == 69
    finally:
        os.close(far_end)
        os.close(near_end)
    assert "/dev/input/none: the mouse cannot be opened" in capsys.readouterr().err


def test_ghosts_are_measured_stored_evaluated_again_and_written(copied, bank_file, tmp_path, capsys):
    """The simulated panel's ghosts live for 1 to 3 reports of 7 ms: gone 28 ms after an emission at the latest."""
    kept, before = tmp_path / "ghosts.evemu", (copied / "board.toml").read_text().splitlines()
    common = ["calibrate-touch", "--ghosts", "--board", str(copied), "--json"]
    assert main([*common, "--bank", str(bank_file), "--out", str(kept)]) == 0
    out, err = capsys.readouterr()
    figures = json.loads(out)
    assert "a simulated panel: what it does is made up" in err
    assert figures["emissions"] >= 200
    assert figures["ghosts"] >= 60
    assert 28.0 <= figures["ghost_ms"] <= 34.0
    assert figures["size_mm"] == {"median": 6.0, "largest": 6.0}
    assert figures["appears_ms"]["latest"] <= 9.0
    assert figures["written"] is None
    assert (copied / "board.toml").read_text().splitlines() == before
    assert main([*common, "--replay", str(kept), "--write"]) == 0
    again = json.loads(capsys.readouterr().out)
    assert again == figures | {"written": str(copied / "board.toml")}
    after = (copied / "board.toml").read_text().splitlines()
    assert [line for line in after if line not in before] == [f"ghost_ms = {figures['ghost_ms']:.1f}"]
    assert load_board(copied).touch.ghost_ms == figures["ghost_ms"]
    assert main([*common[:-1], "--replay", str(kept)]) == 0
    assert capsys.readouterr().out.splitlines()[0] == f"ghost_ms = {figures['ghost_ms']:.1f}"


def test_a_lag_is_measured_stored_evaluated_again_and_written(copied, tmp_path, capsys):
    kept = tmp_path / "strokes.evemu"
    common = ["calibrate-touch", "--lag", "--board", str(copied)]
    assert main([*common, "--json", "--out", str(kept)]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures["lag_ms"] == pytest.approx(12.0, abs=0.5 + figures["error_ms"]["chance"])
    assert figures["error_ms"]["mouse"] == 0.5
    for _ in range(2):  # the line is put there, then changed
        assert main([*common, "--replay", str(kept), "--write"]) == 0
        out = capsys.readouterr().out
        assert out.splitlines()[0] == f"lag_ms = {figures['lag_ms']:.1f}"
        assert f"written to {copied / 'board.toml'}" in out
        assert load_board(copied).touch.lag_ms == figures["lag_ms"]


@each_row(
    ("options", "what"),
    [
        (["--ghosts", "--at", "30", "30"], "--at is of no use here: it is for the axes, without --ghosts"),
        (["--lag", "--targets", "3"], "--targets is of no use here: it is for the axes, without --lag"),
        (["--lag", "--bank", "x"], "--bank is of no use here: it goes with --ghosts"),
        (["--ghosts", "--reference", "/dev/input/event0"], "--reference is of no use here: it goes with --lag"),
        (["--seconds", "20"], "--seconds is of no use here: it goes with --lag"),
        (["--out", "x"], "--out is of no use here: it goes with --ghosts or --lag"),
        (["--lag", "--reference", "-"], "--reference - is of no use without --socket: name the mouse's device"),
        (["--lag", "--out", "x", "--replay", "y"], "--out is of no use with --replay"),
        (["--lag", "--reference", "x", "--replay", "y"], "--reference is of no use with --replay"),
    ],
)
def test_options_that_do_not_go_together_are_refused_with_what_they_go_with(options, what, capsys):
    assert main(["calibrate-touch", *options]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert what in err


@each_row("options", [["--ghosts", "--lag"], ["--lag", "--seconds", "nan"], ["--lag", "--seconds", "many"]])
def test_what_is_no_option_is_refused_by_the_parser(options, capsys):
    assert main(["calibrate-touch", *options]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert "--" in err.removesuffix("(haptic-panel calibrate-touch --help)\n")


def test_devices_that_a_measurement_needs_and_a_board_has_not_are_asked_for(copied, tmp_path, capsys):
    (copied / "board.toml").write_text(
        (copied / "board.toml").read_text().replace('kind = "recording"', 'kind = "linux_input"\ndevice = "/dev/input/none"')
        .replace('recording = "demo.evemu"\n', "")
    )  # fmt: skip
    before = (copied / "board.toml").read_bytes()
    for options, code, what in (
        (["--ghosts"], 78, "has a simulated FPGA"),
        (["--lag"], 78, "--lag needs --reference DEVICE"),
        (["--lag", "--reference", "/dev/input/nothing"], 69, "/dev/input/none"),
        (["--lag", "--replay", str(tmp_path / "none.evemu"), "--write"], 69, "cannot be read"),
    ):
        assert main(["calibrate-touch", "--board", str(copied), *options]) == code
        err = capsys.readouterr().err
        assert what in err
        assert err.count("\n") == 1
    assert (copied / "board.toml").read_bytes() == before


def played(board, bank_file, fingers=(), permit=True):
    from controller.device.bank.reader import Bank

    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    if not permit:
        link.gateware.permit(0, level=False, which=next(iter(Permit)))
    panel = GhostlyPanel(board, fingers, pins_of(link), Ghosts(0.0, (1, 1)), until_s=1e6)
    with Bank.open(bank_file, board) as bank:
        return calibrate_ghosts._play(board, bank, clock, link, EventCapture(panel)), clock.now_s()


def test_a_finger_on_the_panel_ends_the_measurement_early_and_is_said(board, bank_file):
    from controller.device.touch.recordings.recording import Recording
    from controller.device.touch_calibration.ghost_figures import ghost_figures

    text, ended_s = played(board, bank_file, [(5.0, 60.0, (50, 50))])
    assert ended_s < 8.0
    with pytest.raises(CalibrationError, match="off the panel and do it again"):
        ghost_figures(Recording(text), board)


def test_an_fpga_that_does_not_come_on_is_not_waited_for_for_ever(board, bank_file):
    with pytest.raises(FaultError, match="do not come on"):
        played(board, bank_file, permit=False)


@each_row(
    ("text", "expected"),
    [
        ("[touch]\nghost_ms = 30.0 # why\n[link]\nghost_ms = 1\n", "[touch]\nghost_ms = 12.0 # why\n[link]\nghost_ms = 1\n"),
        ("[touch]  # panel\r\nkind = 'x'\r\n", "[touch]  # panel\r\nghost_ms = 12.0\r\nkind = 'x'\r\n"),
        ("a = 1\n[touch]\n# ghost_ms = 3\nb = [1,\n 2]\n", "a = 1\n[touch]\nghost_ms = 12.0\n# ghost_ms = 3\nb = [1,\n 2]\n"),
        ("[link]\nghost_ms = 1\n[touch]\nlag_ms = 2\n", "[link]\nghost_ms = 1\n[touch]\nghost_ms = 12.0\nlag_ms = 2\n"),
    ],
)
def test_one_number_of_the_board_is_changed_and_nothing_else(text, expected):
    assert with_value(text, "ghost_ms", 12.0) == expected


@each_row(
    "text",
    ["touch = { ghost_ms = 3 }\n", "a = 1\n", "[touch]\n'ghost_ms' = 3\n", 'text = """\n[touch]\n"""\n[touch]\nlag_ms = 1\n'],
)
def test_a_board_that_is_written_otherwise_is_left_to_its_owner(text):
    with pytest.raises(CalibrationError, match="by hand"):
        with_value(text, "ghost_ms", 12.0)
