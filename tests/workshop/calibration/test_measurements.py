"""Measurement folders: every format of records reads as it was written; what is damaged, hostile or inconsistent is refused."""

import shutil
import wave
from functools import cache

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from small_plate import small_board
from tables import each_row

from controller.errors import CalibrationError
from controller.workshop.calibration.records import drives
from controller.workshop.calibration.records.measurement_file import (
    ImpulsesDrive,
    MeasurementFile,
    RecordsTable,
    SamplesDrive,
    SweepDrive,
    WordsDrive,
    read_settings,
)
from controller.workshop.calibration.records.measurement_writer import write_measurement, write_records
from controller.workshop.calibration.records.measurements import read_measurement

RATE_HZ = 1e6
NAMES = ("1", "2", "7")
POINTS_M = np.array([[0.01, 0.02], [0.03, 0.0123456], [0.07, 0.05]])
VALUES = np.random.default_rng(1).normal(size=(3, 2, 3, 50)) * 1e-3  # point, emission, repetition, sample
SWEEP = SweepDrive(start_hz=16e3, stop_hz=74e3, duration_ms=2, amplitude_v=30, channels=(4, 9))


@cache
def board():
    return small_board()


def described(files="point_{point}.npy", drive=SWEEP, points="points.csv", **records):
    table = RecordsTable(**({"files": files, "unit": "m/s", "repetitions": 3} | records))
    return MeasurementFile(date="2026-11-22T18:40:00Z", sample_rate_hz=RATE_HZ, records=table, drive=drive, points=points)


def folder_of(folder, values=VALUES, **reported):
    write_measurement(folder, described(**reported), NAMES, POINTS_M, records=list(values))
    return folder


@each_row(
    ("files", "points", "tolerance"),
    [
        ("point_{point}.npy", "points.csv", 0),
        ("p{point}/{channel}.npy", "points.csv", 0),
        ("{point}_{emission}_{repetition}.npz", "points.csv", 0),
        ("{repetition}.npy", "points.csv", None),
        ("{point}-{channel}-{repetition}.wav", "points.csv", 1e-9),
        ("all.npy", "points.csv", 0),
        ("all.npz", None, 0),
        ("{point}.uff", "points.csv", 1e-13),
        ("all.uff", None, 1e-13),
        ("all.unv", "points.csv", 1e-13),
    ],
)
def test_every_format_reads_as_it_was_written(tmp_path, files, points, tolerance):
    if tolerance is None:  # written by hand: one file for a repetition, with all points
        write_measurement(tmp_path, described(files), NAMES, POINTS_M)
        for repetition in range(3):
            np.save(tmp_path / f"{repetition}.npy", VALUES[:, :, repetition])
    else:
        folder_of(tmp_path, files=files, points=points)
    found = read_measurement(tmp_path, board())
    assert found.settings == described(files, points=points)
    assert found.names == (("0", "1", "2") if files == "all.npz" else NAMES)
    assert np.allclose(found.points_m, POINTS_M, atol=1e-12)
    assert found.missing == ()
    for point in range(3):
        records = found.records(point)
        assert np.allclose(records.values, VALUES[point], rtol=0, atol=tolerance or 0)
        assert records.there.all()
        assert not records.clipped.any()
        assert records.files


def test_a_record_that_was_interrupted_is_missing_and_an_old_one_stays(tmp_path, monkeypatch):
    folder_of(tmp_path / "old")
    before = (tmp_path / "old" / "point_2.npy").read_bytes()

    def half(file, array):
        file.write_bytes(before[: len(before) // 2])
        raise KeyboardInterrupt

    monkeypatch.setattr(np, "save", half)
    for folder in ("old", "new"):
        with pytest.raises(KeyboardInterrupt):
            write_records(tmp_path / folder, described(), "2", VALUES[1])
        assert not list((tmp_path / folder).glob(".*")), "nothing is left of the attempt"
    assert (tmp_path / "old" / "point_2.npy").read_bytes() == before
    assert not (tmp_path / "new" / "point_2.npy").exists()


def test_records_that_run_through_are_cut_at_the_periods(tmp_path):
    running = np.random.default_rng(2).normal(size=(3, 700))
    folder_of(tmp_path, running, period_ms=0.1002, drive=msgspec.structs.replace(SWEEP, duration_ms=0.1))
    found = read_measurement(tmp_path, board()).records(1)
    starts = np.round(np.arange(6) * 100.2).astype(int)
    assert found.values.shape == (2, 3, 100)
    for place, start in zip(np.ndindex(2, 3), starts, strict=True):
        assert np.array_equal(found.values[place], running[1, start : start + 100])
        assert found.first_s[place] == start / RATE_HZ
    np.save(tmp_path / "point_2.npy", running[1, :500])
    with pytest.raises(CalibrationError, match="point 2: 500 samples, too few for 6 emissions"):
        read_measurement(tmp_path, board()).records(1)


@each_row(("bits", "largest"), [(8, 1 << 7), (16, 1 << 15), (24, 1 << 23), (32, 1 << 31)])
def test_wav_of_any_width_is_read_in_its_unit(tmp_path, bits, largest):
    """As recorders write them: the wave module of Python, not the writer under test."""
    samples = (np.linspace(-0.9, 0.9, 50) * largest).astype(np.int64)
    table = {"files": "{point}.wav", "unit": "V", "v_per_m_s": 8.0, "full_scale": 10.0, "repetitions": 1, "track": 2}
    write_measurement(tmp_path, described(drive=msgspec.structs.replace(SWEEP, channels=(3,)), **table), NAMES, POINTS_M)
    for name in NAMES:
        with wave.open(str(tmp_path / f"{name}.wav"), "wb") as file:
            file.setparams((2, bits // 8, int(RATE_HZ), 0, "NONE", ""))
            both = np.column_stack([samples * 0, samples]) + (128 if bits == 8 else 0)
            file.writeframes(b"".join(int(v).to_bytes(bits // 8, "little", signed=bits > 8) for v in both.ravel()))
    found = read_measurement(tmp_path, board()).records(0).values[0, 0]
    assert np.array_equal(found, samples / largest * 10 / 8)  # V of the converter, over V per m/s


def test_uff_of_analysers_is_read(tmp_path):
    """Binary sets of type 58 in single precision, nodes of type 15 in mm: written here by the words of the format's description."""
    folder_of(tmp_path, files="all.uff", points=None)
    samples = (VALUES[:, 0, 0] * 1e3).astype("<f4")  # mm/s
    units = f"{-1:6}\n{164:6}\n{5:10}{'mm':20}{1:10}\n{1e3:25.16E}{1.0:25.16E}{1.0:25.16E}\n{0.0:25.16E}\n{-1:6}\n"
    nodes = "".join(
        f"{n:>10}{0:10}{0:10}{0:10}{x * 1e3:13.5E}{y * 1e3:13.5E}{0.0:13.5E}\n" for n, (x, y) in zip(NAMES, POINTS_M, strict=True)
    )
    file = (units + f"{-1:6}\n{15:6}\n{nodes}{-1:6}\n").encode()
    for name, record in zip(NAMES, samples, strict=True):
        head = f"{-1:6}\n{58:6}b{1:6}{2:6}{11:12}{record.nbytes:12}{0:6}{0:6}{0:12}{0:12}\n" + "NONE\n" * 5
        head += f"{1:5}{0:10}{0:5}{0:10} {'NONE':10}{name:>10}{3:4} {'NONE':10}{0:10}{0:4}\n"
        head += f"{2:10}{len(record):10}{1:10}{0.0:13.5E}{1 / RATE_HZ:13.5E}{0.0:13.5E}\n"
        head += "".join(f"{kind:10}{0:5}{0:5}{0:5} {'NONE':20} {'NONE':20}\n" for kind in (17, 11, 0, 0))
        file += head.encode() + record.tobytes() + f"\n{-1:6}\n".encode()
    (tmp_path / "all.uff").write_bytes(file)
    text = (tmp_path / "measurement.toml").read_text().replace("repetitions = 3", "repetitions = 1").replace("[4, 9]", "[4]")
    (tmp_path / "measurement.toml").write_text(text)
    found = read_measurement(tmp_path, board())
    assert np.allclose(found.points_m, POINTS_M, rtol=1e-5)
    for point in range(3):
        assert np.allclose(found.records(point).values[0, 0], VALUES[point, 0, 0], rtol=1e-6)


def test_missing_points_and_emissions_are_reported(tmp_path):
    folder_of(tmp_path, [VALUES[0], None, VALUES[2]], files="{point}_{channel}.npy")
    (tmp_path / "1_9.npy").unlink()
    found = read_measurement(tmp_path, board())
    assert found.missing == (1,)
    assert not found.records(1).there.any()
    assert np.array_equal(found.records(0).there, [[True] * 3, [False] * 3])
    for files in ("all.npy", "all.uff"):
        other = folder_of(tmp_path / files, [VALUES[0], None, VALUES[2]], files=files)
        found = read_measurement(other, board())
        assert found.missing == (1,)
        assert not found.records(1).there.any()
        assert found.records(2).there.all()


def test_clipped_records_are_seen(tmp_path):
    values = VALUES.copy()
    values[1, 0, 2] = np.clip(values[1, 0, 2], -5e-4, 5e-4)
    values[2, 1] = 0  # silent is not clipped
    found = read_measurement(folder_of(tmp_path, values), board())
    assert np.argwhere(found.records(1).clipped).tolist() == [[0, 2]]
    assert not found.records(0).clipped.any()
    assert not found.records(2).clipped.any()


WORDS = WordsDrive(file="drive.npy", bit_clock_hz=500e3, supply_v=60.0)


@each_row(
    ("damage", "said"),
    [
        ({"points.csv": "x,y\n"}, r"points.csv: its first line is not point,x_mm,y_mm"),
        ({"points.csv": "point,x_mm,y_mm\n1,2\n"}, r"points.csv: line 2: '1,2' is not a name and two numbers"),
        ({"points.csv": "point,x_mm,y_mm\n1,nan,2\n"}, r"point 1: x_mm = nan is off the plate"),
        ({"points.csv": "point,x_mm,y_mm\n1,71,2\n"}, r"point 1: x_mm = 71 is off the plate \(0 to 70 mm\)"),
        ({"points.csv": "point,x_mm,y_mm\n1,1,2\n1,2,2\n"}, r"point 1 is there twice"),
        ({"points.csv": "point,x_mm,y_mm\n1,1,2\n2,1,2\n"}, r"points 1 and 2 are the same place, 1, 2 mm"),
        ({"points.csv": "point,x_mm,y_mm\n../1,1,2\n"}, r"point '../1': its name may have"),
        ({"points.csv": "point,x_mm,y_mm\n"}, r"no points"),
        ({"points.csv": b"\xff\xfe\xff"}, r"points.csv: no CSV file"),
        ({"points.csv": None}, r"points.csv: cannot be read"),
        ({"measurement.toml": None}, r"measurement.toml: cannot be read"),
        ({"measurement.toml": "date = 3"}, r"measurement.toml: date = 3"),
        ({"point_9.npy": b"x"}, r"point_9.npy: of no point, emission or repetition"),
        ({"point_1.npy": b"\x93NUMPY"}, r"point_1.npy: cannot be read"),
        ({"point_1.npy": np.zeros((2, 2, 50))}, r"point_1.npy: an array \(2, 2, 50\).*should hold 2 x 3 records"),
        ({"point_1.npy": np.full((2, 3, 50), np.inf)}, r"point 1: emission 0, repetition 0: samples that are no numbers"),
        ({"point_1.npy": np.zeros((2, 3, 50), np.int16)}, r"point 1: whole numbers; give records.full_scale"),
        ({"point_1.npy": np.zeros((2, 3, 50), complex)}, r"point_1.npy: complex128 \(2, 3, 50\) is no array of real samples"),
        ({"point_1.npy": np.zeros((2, 3, 0))}, r"is no array of real samples"),
        ({"point_1.npy": np.array([[object()]])}, r"point_1.npy: cannot be read \(Array can't be memory-mapped"),
    ],
)
def test_a_damaged_folder_is_refused_with_file_and_point(tmp_path, damage, said):
    folder_of(tmp_path)
    for name, content in damage.items():
        if isinstance(content, np.ndarray):
            np.save(tmp_path / name, content)
        elif content is None:
            (tmp_path / name).unlink()
        else:
            (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(CalibrationError, match=said) as error:
        read_measurement(tmp_path, board()).records(0)
    assert "\n" not in str(error.value)
    assert error.value.exit_code == 78


@each_row(
    ("old", "new", "said"),
    [
        ('unit = "m/s"', 'unit = "mm/s"', r"records.unit = 'mm/s': must be one of 'V', 'm', 'm/s', 'm/s\^2'"),
        ('unit = "m/s"', 'unit = "V"', r"unit = 'V' needs one of v_per_m, v_per_m_s, v_per_m_s2"),
        ('unit = "m/s"', 'unit = "m/s"\nv_per_m = 3.0', r"v_per_m is of use with unit = 'V'"),
        ('unit = "m/s"', 'unit = "m/s"\nunits = "m"', r"records.units = 'm': unknown key; did you mean unit\?"),
        ("point_{point}", "../point_{point}", r"records.files = '../point_{point}.npy': must be the name of a file in the folder"),
        ("point_{point}", "/etc/{point}", r"must be the name of a file in the folder"),
        ("point_{point}", "{point}_{frog}", r"unknown field {frog}; there are channel, emission"),
        ("point_{point}", "{point", r"records.files|expected '}'"),
        ("point_{point}", "{point}_{channel}_{emission}", r"{emission} or {channel}, not both"),
        ("{point}.npy", "{point}.mat", r"ends with one of .npy, .npz, .wav, .uff, .unv"),
        ("channels = [4, 9]", "channels = [4, 32]", r"drive.channels: 32 is beyond the 32 of board 'simulated'"),
        ('kind = "sweep"', 'kind = "sweap"', r"drive.kind = 'sweap'.*did you mean sweep\?"),
        ("stop_hz = 74000.0", "stop_hz = 16000.0", r"start_hz and stop_hz are both 16000"),
        ("repetitions = 3", "repetitions = 3\nperiod_ms = 1.9", r"drive.duration_ms = 2 is longer than records.period_ms = 1.9"),
        ("sample_rate_hz = 1000000.0", "sample_rate_hz = nan", r"sample_rate_hz = nan: must be a finite number"),
        ("sample_rate_hz = 1000000.0", "sample_rate_hz = 44.1", r"sample_rate_hz = 44.1: must be a number from 1000 to"),
        ('"2026-11-22T18:40:00Z"', '"yesterday"', r"date = 'yesterday'"),
        ('points = "points.csv"\n', "", r"points is missing: the name of a CSV file"),
    ],
)
def test_a_wrong_key_is_named(tmp_path, old, new, said):
    file = folder_of(tmp_path) / "measurement.toml"
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))
    with pytest.raises(CalibrationError, match=said) as error:
        read_measurement(tmp_path, board())
    assert str(error.value).startswith(str(file))


def test_uff_of_another_rate_quantity_or_node_is_refused(tmp_path):
    folder_of(tmp_path, files="{point}.uff")
    file = tmp_path / "measurement.toml"
    right = file.read_text()
    for old, new, said in (
        ('unit = "m/s"', 'unit = "m"', r"1.uff: point 1: records of m/s, and records.unit = 'm'"),
        ("sample_rate_hz = 1000000.0", "sample_rate_hz = 999000.0", r"1.uff: 1e\+06 samples a second, and sample_rate_hz = 999000"),
        ("repetitions = 3", "repetitions = 2", r"1.uff: point 1: a record of emission 0, repetition 2"),
    ):
        file.write_text(right.replace(old, new))
        with pytest.raises(CalibrationError, match=said):
            read_measurement(tmp_path, board()).records(0)
    file.write_text(right)
    shutil.copy(tmp_path / "2.uff", tmp_path / "1.uff")
    with pytest.raises(CalibrationError, match=r"1.uff: a record of point 2, in the file of point 1"):
        read_measurement(tmp_path, board()).records(0)


def test_drives_are_checked(tmp_path):
    words = np.random.default_rng(3).integers(0, 1 << 32, (2, 100), np.uint32)
    for drive, array, said in (
        (WORDS, words, None),
        (WORDS, words.astype(np.uint64), "drive.npy: uint64"),
        (WORDS, np.zeros((2, 100), np.uint32), "every word is the idle word"),
        (SamplesDrive(file="drive.npy", rate_hz=1e6, channels=(1, 2)), np.ones((2, 10)), None),
        (SamplesDrive(file="drive.npy", rate_hz=1e6, channels=(1, 2)), np.ones((3, 10)), r"not volts"),
        (SamplesDrive(file="drive.npy", rate_hz=1e6, channels=(1, 2)), np.full((2, 10), np.nan), "no numbers"),
        (ImpulsesDrive(bit_clock_hz=500e3, supply_v=60, channels=(1, 2)), None, None),
    ):
        write_measurement(tmp_path, described(drive=drive), NAMES, POINTS_M)
        if array is not None:
            np.save(tmp_path / "drive.npy", array)
        if said:
            with pytest.raises(CalibrationError, match=said):
                read_measurement(tmp_path, board())
        else:
            assert read_measurement(tmp_path, board()).drive.emissions == 2
    (tmp_path / "drive.npy").unlink()
    write_measurement(tmp_path, described(drive=WORDS), NAMES, POINTS_M)
    with pytest.raises(CalibrationError, match=r"drive.npy: cannot be read"):
        read_measurement(tmp_path, board())


def test_a_drive_has_a_largest_size(tmp_path, monkeypatch):
    for drive, array, said in (
        (WORDS, np.arange(200, dtype=np.uint32).reshape(2, 100), "drive.npy: 200 drive words, more than 199"),
        (SamplesDrive(file="drive.npy", rate_hz=1e6, channels=(1, 2)), np.ones((2, 100)), "drive.npy: 200 samples, more than 199"),
    ):
        write_measurement(tmp_path, described(drive=drive), NAMES, POINTS_M)
        np.save(tmp_path / "drive.npy", array)
        monkeypatch.setattr(drives, "MOST_WORDS", 200)
        assert read_measurement(tmp_path, board()).drive.emissions == 2
        monkeypatch.setattr(drives, "MOST_WORDS", 199)
        with pytest.raises(CalibrationError, match=said):
            read_measurement(tmp_path, board())


@pytest.fixture(scope="module")
def whole_files(tmp_path_factory):
    """One small file of every format, as bytes."""
    found = {}
    for files in ("all.npy", "all.npz", "all.uff", "{point}_{channel}_{repetition}.wav"):
        folder = folder_of(tmp_path_factory.mktemp("whole"), files=files)
        name = "1_4_0.wav" if "wav" in files else files
        found[files] = folder, folder / name, (folder / name).read_bytes()
    return found


@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_no_damage_to_a_file_of_records_is_more_than_one_line(whole_files, data):
    """Cut short, or with bytes changed: read, or refused by the one error."""
    folder, file, right = whole_files[data.draw(st.sampled_from(sorted(whole_files)))]
    damaged = bytearray(right)
    for at, value in data.draw(st.lists(st.tuples(st.integers(0, min(len(right), 2000) - 1), st.integers(0, 255)), max_size=4)):
        damaged[at] = value
    file.write_bytes(damaged[: data.draw(st.integers(0, len(right)))])
    try:
        read_measurement(folder, board()).records(0)
    except CalibrationError as error:
        if "\n" in str(error) or str(folder) not in str(error):
            raise AssertionError(str(error)) from error
    finally:
        file.write_bytes(right)


@settings(max_examples=40, deadline=None)
@given(
    text=st.text(max_size=200)
    | st.lists(st.sampled_from(["point,x_mm,y_mm", "1,2,3", "a,1e400,2", "b,-0,0.0", '"', ",,"])).map("\n".join)
)
def test_any_points_file_is_read_or_refused(whole_files, text):
    folder = whole_files["all.npy"][0]
    right = (folder / "points.csv").read_bytes()
    (folder / "points.csv").write_text(text, encoding="utf-8", errors="replace")
    try:
        found = read_measurement(folder, board())
        assert np.isfinite(found.points_m).all()
    except CalibrationError as error:
        if "\n" in str(error):
            raise AssertionError(str(error)) from error
    finally:
        (folder / "points.csv").write_bytes(right)


@settings(max_examples=20, deadline=None)
@given(
    temperature_c=st.none() | st.floats(-50, 150),
    drive=st.sampled_from([SWEEP, WORDS, ImpulsesDrive(bit_clock_hz=5e5, supply_v=60, channels=(0, 31))]),
    rate_hz=st.floats(1e3, 1e9),
    first_us=st.none() | st.floats(-1e6, 1e6),
)
def test_settings_survive_their_file(whole_files, temperature_c, drive, rate_hz, first_us):
    folder = whole_files["all.npy"][0].parent / "toml"
    reported = msgspec.structs.replace(
        described(drive=drive, first_sample_us=first_us), temperature_c=temperature_c, sample_rate_hz=rate_hz
    )
    write_measurement(folder, reported, NAMES, POINTS_M)
    assert read_settings(folder) == reported
