"""`haptic-panel calibrate check`: figures, picture, exit code, and a run that goes on where another one was."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from workshop.calibration.exact_records import BIT_CLOCK_HZ, NAMES, POINTS_M, board, displacement, noisy

from controller.cli import main
from controller.commands.calibrate.check import ACCEPTED
from controller.device.board.board import load_board
from controller.workshop.calibration.checking.checks import FATAL
from controller.workshop.calibration.records.measurement_file import MeasurementFile, RecordsTable, WordsDrive
from controller.workshop.calibration.records.measurement_writer import write_measurement

RATE_HZ = 200e3
WHOLE = Path(__file__).parents[3] / "boards" / "simulated" / "board.toml"


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """Folder of a measurement, without point 3, and folder of its board: the small plate as a file."""
    folder, panel = tmp_path_factory.mktemp("measured"), tmp_path_factory.mktemp("small")
    places = "".join(
        f"    {{ channel = {a.channel}, x_mm = {a.x_mm}, y_mm = {a.y_mm}, size_mm = {a.size_mm}, idle = {a.idle} }},\n"
        for a in board().actuators
    )
    text = re.sub(r"actuators = \[.*?^\]", f"actuators = [\n{places}]", WHOLE.read_text(), flags=re.DOTALL | re.MULTILINE)
    for old, new in (
        ("length_mm = 210.0", "length_mm = 70.0"),
        ("width_mm = 148.0", "width_mm = 50.0"),
        ("duration_ms = 2.0", "duration_ms = 0.8"),
    ):
        assert old in text
        text = text.replace(old, new)
    (panel / "board.toml").write_text(text)
    assert load_board(panel).digest() == board().digest()
    bits = np.random.default_rng(1).integers(0, 2, (9, 8, 400))
    volts = np.zeros((9, 32, 400))
    volts[:, :8] = bits * 60.0
    records = list(noisy(displacement(volts, BIT_CLOCK_HZ, np.arange(1400) / RATE_HZ, order=1)[:, :, None]))
    table = RecordsTable(files="{point}.npy", unit="m/s", first_sample_us=0.0)
    drive = WordsDrive(file="drive.npy", bit_clock_hz=BIT_CLOCK_HZ, supply_v=60.0)
    reported = MeasurementFile(
        date="2026-11-22", sample_rate_hz=RATE_HZ, points="points.csv", records=table, drive=drive, board_sha256="0" * 64
    )
    records[2] = None
    write_measurement(folder, reported, NAMES, POINTS_M, (bits << np.arange(8)[:, None]).sum(axis=1), records)
    return folder, panel


def checked(capsys, measured, *options):
    """Exit code, figures, what is on stderr."""
    folder, panel = measured
    code = main(["calibrate", "check", str(folder), "--board", str(panel), "--json", *options])
    out, err = capsys.readouterr()
    return code, json.loads(out) if out else None, err


def test_check_prints_figures_draws_and_goes_on_where_it_was(measured, tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "state"))
    folder, panel = measured
    before = {file: file.stat().st_mtime_ns for file in folder.iterdir()}
    code, figures, err = checked(capsys, measured, "--plot", str(tmp_path / "check.png"))
    assert (code, err) == (0, "")
    assert (tmp_path / "check.png").stat().st_size > 20_000
    assert {file: file.stat().st_mtime_ns for file in folder.iterdir()} == before  # nothing is written
    assert (figures["points"], figures["missing"], figures["learned_anew"]) == (12, 1, 11)
    assert figures["known_share"] == round(11 / 12, 4)
    assert figures["least_coherence"] > 0.9
    assert figures["snr_db"] > 35
    assert [row["known"] for row in figures["channels"]] == [11] * 8
    assert {one["kind"] for one in figures["findings"]} == {"missing", "board"}

    kept = sorted((tmp_path / "state" / "calibration").rglob("*.npz"))
    assert len(kept) == 11
    kept[0].unlink()  # as an interrupted run leaves it
    kept[1].write_bytes(b"damaged")
    again = checked(capsys, measured)[1]
    assert again["learned_anew"] == 2
    assert {**again, "learned_anew": 11} == figures

    file = folder / "5.npy"
    right = file.read_bytes()
    np.save(file, np.load(file) * 1.5)  # a changed file is learned again; what was learned from it before goes
    assert main(["calibrate", "check", str(folder), "--board", str(panel)]) == 0
    file.write_bytes(right)
    shown = capsys.readouterr().out
    assert "note: no records of point 3: left unknown" in shown
    assert re.search(r"^coherence +0\.9", shown, re.MULTILINE)
    others = set((tmp_path / "state" / "calibration").rglob("*.npz"))
    assert len(others) == 11
    assert others != set(kept)


def test_what_makes_a_wrong_bank_ends_with_78_unless_it_is_accepted(measured, tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path / "state"))
    folder, panel = measured
    for file in folder.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    words = np.load(tmp_path / "drive.npy") & 0x7F
    other = np.random.default_rng(2).integers(0, 2, words.shape, np.uint32) << 7
    np.save(tmp_path / "drive.npy", words | other)  # channel 7 did not play this
    code, figures, err = checked(capsys, (tmp_path, panel))
    assert code == 78
    assert figures["findings"][0]["channels"] == [7]
    assert "channel 7" in err
    assert err.count("\n") == 1
    assert err.rstrip().endswith("(to go on all the same: --accept dead)")
    code, figures, err = checked(capsys, (tmp_path / "nowhere", panel))
    assert (code, figures) == (78, None)
    assert "measurement.toml: cannot be read" in err


def test_what_makes_a_bank_wrong_is_what_may_be_accepted():
    assert set(ACCEPTED) == set(FATAL)
