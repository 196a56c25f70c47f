"""Measurements of a simulated plate: exact motion, faults that are what they say, the same files for the same seed."""

import json
from functools import cache

import msgspec
import numpy as np
import pytest
from small_plate import small_board
from tables import each_row

from controller.cli import main
from controller.device.bank.packing import channel_bits
from controller.device.board.board import load_board
from controller.errors import CalibrationError, ConfigError
from controller.workshop.calibration.recording.excitation import drive_words, period_s
from controller.workshop.calibration.recording.simulated_measurement import (
    Flaws,
    RecordingSettings,
    simulate_measurement,
)
from controller.workshop.calibration.records.measurements import read_measurement
from controller.workshop.physics.finger import Finger, point_motion
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.motion import PlateMotion
from controller.workshop.physics.responses.impulse_response import ResponseModel

NAMES = tuple("abcdef")
POINTS_M = np.array([[0.01, 0.012], [0.03, 0.02], [0.05, 0.04], [0.06, 0.01], [0.02, 0.04], [0.035, 0.03]])
SHORT = RecordingSettings(record_s=2e-3)
NOISY = Flaws()


@cache
def board():
    """A plate of 70 x 50 mm that is nearly still after 2 ms."""
    small, changed = small_board(), msgspec.structs.replace
    return changed(small, plate=changed(small.plate, decay_time_ms=0.3))


def simulated(folder, faults=NOISY, recording=SHORT):
    figures = simulate_measurement(folder, board(), board(), NAMES, POINTS_M, recording, faults)
    found = read_measurement(folder, board())
    values = [None if point in found.missing else found.records(point).values for point in range(len(NAMES))]
    return figures, found, values


def test_the_motion_of_points_is_the_sum_of_the_banks_responses(tmp_path):
    """Independent: the pulse responses from which banks are built, superposed; and differences for the derivatives."""
    on = board()
    words = np.random.default_rng(1).integers(0, 1 << 32, 200, np.uint64).astype(np.uint32) & np.uint32(on.channel_mask)
    volts = channel_bits(words) * on.driver.supply_v
    responses = ResponseModel(on).responses(POINTS_M)[:, :200]
    expected = np.array([[np.sum(volts[: j + 1] * h[j::-1]) for j in range(200)] for h in responses])
    motion = PlateMotion(on, modes_of(on))
    steps_v = np.diff(np.concatenate([0 * volts[:1], volts]), axis=0)[:, :, None]
    step_s, times_s = np.arange(200) * on.waveform.bit_period_s, np.arange(1, 201) * on.waveform.bit_period_s
    got = motion.of_points(POINTS_M, step_s, steps_v, times_s - 1e-15, "m")[:, 0]
    error = np.abs(got - expected).max() / np.abs(expected).max()
    wrong = PlateMotion(on, drifted(modes_of(on), 0.01))
    off = wrong.of_points(POINTS_M, step_s, steps_v, times_s - 1e-15, "m")[:, 0]
    off_by = np.abs(off - expected).max() / np.abs(expected).max()
    print(f"largest error of 200 words {error:.1e} of the largest motion, {off_by:.2f} with frequencies 1 % off")
    assert error < 1e-5, "single precision"
    assert off_by > 0.05
    for lower, higher in (("m", "m/s"), ("m/s", "m/s^2")):
        at = times_s[-3:] + 0.7e-6
        around = [motion.of_points(POINTS_M[:2], step_s, steps_v, at + by, lower).astype(float) for by in (-2e-8, 2e-8)]
        derived = motion.of_points(POINTS_M[:2], step_s, steps_v, at, higher)
        assert np.allclose((around[1] - around[0]) / 4e-8, derived, rtol=0, atol=0.02 * np.abs(derived).max())


def test_a_measurement_holds_what_the_plate_does_and_noise_of_the_level_asked_for(tmp_path):
    clean = simulated(tmp_path / "clean", Flaws(snr_db=200))[2]
    figures, found, values = simulated(tmp_path / "noisy", Flaws(snr_db=30), RecordingSettings(record_s=2e-3, repetitions=3))
    noise = np.array(values) - np.array(clean)
    snr_db = 20 * np.log10(np.sqrt(np.mean(np.square(clean))) / noise.std())
    assert snr_db == pytest.approx(30, abs=1)
    assert found.drive.emissions == figures["emissions"] == 8
    assert np.array_equal(found.points_m, POINTS_M)
    before = round(0.2e-3 * 250e3)
    assert np.abs(np.array(clean)[..., : before - 1]).max() < 1e-3 * figures["rms"], "nothing before the first word"


def test_the_same_seed_gives_the_same_bytes_and_an_interrupted_simulation_goes_on(tmp_path):
    for name in ("a", "b"):
        simulated(tmp_path / name, Flaws(drift=0.001))
    files = sorted(file.relative_to(tmp_path / "a") for file in (tmp_path / "a").rglob("*") if file.is_file())
    assert len(files) == len(NAMES) + 4
    for lost in ("c", "e"):
        (tmp_path / f"b/records/{lost}.npy").unlink()
    kept = (tmp_path / "b/records/a.npy").stat().st_mtime_ns
    simulated(tmp_path / "b", Flaws(drift=0.001))
    assert (tmp_path / "b/records/a.npy").stat().st_mtime_ns == kept
    for file in files:
        assert (tmp_path / "a" / file).read_bytes() == (tmp_path / "b" / file).read_bytes(), file
    with pytest.raises(CalibrationError, match="holds a simulation with other options"):
        simulated(tmp_path / "b", Flaws(drift=0.002))
    (tmp_path / "c").mkdir()
    (tmp_path / "c/mine.txt").write_text("mine")
    with pytest.raises(CalibrationError, match="is not empty, and holds no simulation"):
        simulated(tmp_path / "c")


def test_faults_are_what_they_say(tmp_path):
    quiet = {"snr_db": 200.0}
    a, b = (actuator.channel for actuator in board().actuators[:2])
    clean = np.array(simulated(tmp_path / "clean", Flaws(**quiet))[2])
    only = {
        q: np.array(
            simulated(
                tmp_path / f"only{q}",
                Flaws(dead=tuple(x.channel for x in board().actuators if x.channel != q), **quiet),
            )[2]
        )
        for q in (a, b)
    }
    dead, inverted = (np.array(simulated(tmp_path / name, Flaws(**{name: (a,)}, **quiet))[2]) for name in ("dead", "inverted"))
    close = {"rtol": 0, "atol": 1e-4 * np.abs(clean).max()}
    assert np.allclose(clean - dead, only[a], **close)
    assert np.allclose(clean - inverted, 2 * only[a], **close)
    swapped = np.array(simulated(tmp_path / "swapped", Flaws(swapped=((a, b),), **quiet))[2])
    assert not np.allclose(swapped, clean, **close)
    clipped = np.array(simulated(tmp_path / "clip", Flaws(clip=0.1, **quiet))[2])
    assert np.allclose(clipped, np.clip(clean, clipped.min(), clipped.max()), **close)
    late = np.array(simulated(tmp_path / "late", Flaws(delay_s=40e-6, **quiet))[2])
    assert np.allclose(late[..., :-10], clean[..., 10:], **close), "a record that begins late begins with what comes later"
    settings = json.dumps(msgspec.to_builtins(read_measurement(tmp_path / "late", board()).settings))
    assert '"first_sample_us": null' in settings
    fast = np.array(simulated(tmp_path / "fast", Flaws(clock_ppm=2000, **quiet))[2])
    assert np.allclose(fast[..., 500], clean[..., 499], rtol=0, atol=0.05 * np.abs(clean).max())
    figures, found, _ = simulated(tmp_path / "missing", Flaws(missing=0.34))
    assert figures["missing"] == len(found.missing) == 2
    assert not np.allclose(np.array(simulated(tmp_path / "drift", Flaws(drift=5e-3, **quiet))[2])[-1], clean[-1], **close)


def test_places_gains_and_the_sensors_mass_are_what_they_say(tmp_path):
    quiet, displacement = {"snr_db": 200.0}, RecordingSettings(record_s=2e-3, quantity="m")
    clean = np.array(simulated(tmp_path / "clean", Flaws(**quiet))[2])
    close = {"rtol": 0, "atol": 1e-4 * np.abs(clean).max()}
    middle_m = np.array([0.035, 0.025])
    flaws = Flaws(offset_m=(1e-3, -2e-3), rotation=0.02, scale=0.98, mirror="y runs the other way", **quiet)
    cos, sin = 0.98 * np.cos(0.02), 0.98 * np.sin(0.02)
    places_m = (POINTS_M - middle_m) * [1, -1] @ np.array([[cos, sin], [-sin, cos]]) + middle_m + [1e-3, -2e-3]
    _, found, moved = simulated(tmp_path / "frame", flaws)
    simulate_measurement(tmp_path / "there", board(), board(), NAMES, places_m, SHORT, Flaws(**quiet))
    there = read_measurement(tmp_path / "there", board())
    assert np.array_equal(found.points_m, POINTS_M), "the files state other places than were measured"
    assert np.allclose(moved, [there.records(point).values for point in range(len(NAMES))], **close)
    gains = np.array(simulated(tmp_path / "gain", Flaws(gain=0.2, **quiet))[2]).std(axis=(1, 2, 3)) / clean.std(axis=(1, 2, 3))
    assert 0.1 < np.log(gains).std() < 0.4
    assert simulated(tmp_path / "off", Flaws(offset_m=(30e-3, 0.0), **quiet))[1].missing == (2, 3), "beside the plate"
    _, found, heavy = simulated(tmp_path / "mass", Flaws(sensor_mass_kg=5e-5, **quiet), displacement)
    light = np.array(simulated(tmp_path / "light", Flaws(**quiet), displacement)[2])[:, 0, 0]
    times_s = found.settings.records.first_sample_us * 1e-6 + np.arange(heavy[0].shape[2]) / 250e3
    motion = point_motion(board(), modes_of(board()), np.load(tmp_path / "mass/drive.npy")[0], POINTS_M[:1], after_s=0.0)
    during = (times_s > 0.1e-3) & (times_s < motion.end_s)
    expected = motion.displacement({0: Finger(5e-5)}, times_s[during] - motion.end_s)[:, 0]
    got = heavy[0][0, 0, during]
    error, without = (np.std(one - expected) / np.std(expected) for one in (got, light[0, during]))
    print(f"under 50 mg {error:.3f} of what a finger of that mass does, without {without:.2f}")
    assert error < 0.03
    assert without > 0.3


@pytest.mark.parametrize("kind", ["chirp", "noise"])
def test_what_is_played_keeps_the_limits_and_tells_channels_apart(kind, board):
    words = drive_words(board, kind)
    bits = channel_bits(words.ravel()).reshape(32, 1000, 32).astype(float) * 2 - 1
    correlation = np.einsum("ewa,ewb->ab", bits, bits)
    assert np.array_equal(correlation, 32_000 * np.eye(32)), "each channel is reported from all others"
    spectrum = np.abs(np.fft.rfft(bits[0, :, 0]))[40:141]  # 20 to 70 kHz
    assert spectrum.min() > (0.5 if kind == "chirp" else 0.0) * np.median(spectrum)
    assert np.count_nonzero(np.diff(bits, axis=1), axis=1).max() / board.waveform.duration_s <= board.limits.max_edge_rate_hz
    limits = msgspec.structs.replace(board.limits, max_channel_edge_rate_hz=20e3, max_edge_rate_hz=50e3)
    assert period_s(msgspec.structs.replace(board, limits=limits), 1e-3) == pytest.approx(2 * 74.2e3 * 2e-3 / 20e3)
    with pytest.raises(ConfigError, match=r"edges a second, above limits\.max_edge_rate_hz = 50,000"):
        drive_words(msgspec.structs.replace(board, limits=limits), kind)


@each_row(
    ("arguments", "code", "said"),
    [
        (["--rate-khz", "100"], 2, "--rate-khz 100: not from 140"),
        (["--record-ms", "nan"], 2, "--record-ms: 'nan' is not a finite number"),
        (["--missing", "1"], 2, "--missing 1: not from 0 to 0.99"),
        (["--dead", "99"], 2, "--dead 99: board 'simulated' has no such channel"),
        (["--swapped", "1", "-1"], 2, "--swapped -1: board"),
        (["--scattered", "0"], 78, "0 points are not from 1"),
        (["--points", "/nowhere.csv"], 78, "/nowhere.csv"),
        (["--plate", "thickness_mm=-1"], 78, "--plate: thickness_mm = -1"),
    ],
)
def test_options_that_make_no_sense_are_refused(tmp_path, capsys, arguments, code, said):
    assert main(["calibrate", "simulate", str(tmp_path / "m"), *arguments]) == code
    refused = capsys.readouterr().err
    assert said in refused
    assert refused.count("\n") == 1
    assert not (tmp_path / "m").exists()


def test_the_command(tmp_path, capsys, board):
    text = (board.folder / "board.toml").read_text()
    head, rest = text.split("actuators = [\n")
    lines, tail = rest.split("]\n", 1)
    text = (
        head
        + "actuators = [\n"
        + "\n".join(lines.splitlines()[:2])
        + "\n]\n"
        + tail.replace("= 210.0", "= 60.0").replace("148.0", "40.0")
    )
    (tmp_path / "board.toml").write_text(text)
    (tmp_path / "p.csv").write_text("point,x_mm,y_mm\n1,20,30\n2,30.5,10\n")
    arguments = ["calibrate", "simulate", str(tmp_path / "m"), "--board", str(tmp_path), "--points", str(tmp_path / "p.csv")]
    assert main([*arguments, "--plate", "thickness_mm=0.6", "--json"]) == 0
    reported = json.loads(capsys.readouterr().out)
    assert (reported["points"], reported["emissions"]) == (2, 2)
    found = read_measurement(tmp_path / "m", load_board(tmp_path))
    assert found.names == ("1", "2")
    assert found.settings.board_sha256 == load_board(tmp_path).digest().hex()
