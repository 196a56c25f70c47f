"""Wires that are wrong, on a plate that the board's model is not: named where points suffice, never where they do not.

The twin's edges are free or clamped, and its shear is Mindlin's; the records have 30 dB of noise.
"""

import json
from functools import cache

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.calibration.checking.checks import dead_channels, wrong_wires
from controller.workshop.calibration.checking.wiring import FIRST_POINTS, wiring_of
from controller.workshop.calibration.frame import middle_m
from controller.workshop.calibration.learning.locating import locate
from controller.workshop.calibration.point_plan import scattered_points, wiring_points
from controller.workshop.calibration.transfer_functions.direct_wave import DirectWaves, direct_waves
from controller.workshop.calibration.transfer_functions.transfers import RawBins
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.responses.impulse_response import ResponseModel

BOARD = load_board(find_board("simulated"))
BINS = RawBins.of(BOARD, 10e-3)
CHANNELS = range(32)
FAULTS = {
    "right": {},
    "swapped": {"swapped": {(3, 9)}},
    "neighbours": {"swapped": {(17, 18)}},
    "inverted": {"inverted": {20}},
    "dead": {"dead": {14}},
    "all": {"swapped": {(3, 9), (17, 18)}, "inverted": {20}, "dead": {14}},
    "moved": {"moved": {(5, 30)}, "dead": {30}},
}


@cache
def twin(edges):
    there = msgspec.structs.replace(BOARD, plate=msgspec.structs.replace(BOARD.plate, edges=edges, theory="mindlin"))
    model = ResponseModel(there, modes=modes_of(there))
    model.samples = 5000
    return model


@cache
def transfers(edges, count, seed, margin_m):
    """Of points scattered so far from the edges, with 30 dB of noise: (point, channel, bin)."""
    points_m = scattered_points(BOARD, count, margin_m, seed=seed, avoid_actuators=True)
    records = twin(edges).responses(points_m, dtype=np.float32)
    records += np.random.default_rng(seed).normal(size=records.shape) * records.std() * 10 ** (-30 / 20)
    some = slice(BINS.first, BINS.first + len(BINS.gain))
    turn = np.exp(-2j * np.pi * BINS.frequency_hz / BINS.bit_clock_hz) / BINS.bit_clock_hz
    return points_m, (np.fft.rfft(records, BINS.length, axis=1)[:, some] * turn[:, None]).transpose(0, 2, 1)


def evaluated(edges, count, seed, margin_m, fault):
    """The verdict on a fault, and what it should be."""
    points_m, right = transfers(edges, count, seed, margin_m)
    measured, there = right.copy(), FAULTS[fault]
    for a, b in there.get("swapped", ()):
        measured[:, [a, b]] = measured[:, [b, a]]
    for channel, at in there.get("moved", ()):
        measured[:, channel] = right[:, at]
    for channel in there.get("inverted", ()):
        measured[:, channel] *= -1
    for channel in there.get("dead", ()):
        measured[:, channel] = right[:, channel] * 1e-3
    waves = direct_waves(BOARD, BINS, points_m, measured, np.ones(measured.shape[:2], bool), 60e-6)
    alive = [channel for channel in CHANNELS if channel not in there.get("dead", ())]
    return wiring_of(waves, CHANNELS, alive, count), there


EVERY = [(edges, count, margin_m) for edges in ("free", "clamped") for count in (3, 4, 6, 8, 10) for margin_m in (0.0, 0.03)]
SOME = [("free", 10, 0.03)]  # few points take a minute, clamped ones as long again


@pytest.mark.parametrize(
    ("edges", "count", "margin_m"), [pytest.param(*one, marks=() if one in SOME else pytest.mark.slow) for one in EVERY]
)
def test_nothing_is_accused_that_is_right_and_nothing_wrong_passes(edges, count, margin_m):
    verdicts = 0
    for fault in FAULTS:
        found, there = evaluated(edges, count, 5, margin_m, fault)
        wrong = {pair for name in ("swapped", "moved") for pair in there.get(name, ())}
        assert set(found.swapped) <= wrong
        assert set(found.inverted) <= there.get("inverted", set())
        assert not found.all_inverted
        if not found.undecided:
            assert set(found.swapped) == wrong
            assert set(found.inverted) == there.get("inverted", set())
            assert found.points_needed == count
        else:
            assert count < found.points_needed <= 40
        verdicts += not found.undecided
    if count == 3:
        assert verdicts == 0
    if count >= 8 and margin_m:
        assert verdicts == len(FAULTS)


def strengths(count, error, seed=1):
    """What regression gives, with chance of a known size."""
    random = np.random.default_rng(seed)
    strength, errors = np.full((32, 32), np.nan), np.full(32, np.nan)
    strength[:count, :count] = np.eye(count) + error * random.normal(size=(count, count))
    errors[:count] = error
    return DirectWaves(0.0, 1.0, strength, errors)


def test_the_points_that_are_needed_follow_from_the_error():
    assert not wiring_of(strengths(8, 0.05), range(8), range(8), 6).undecided
    needed = [wiring_of(strengths(8, error), range(8), range(8), 6).points_needed for error in (0.5, 1.0)]
    assert 6 < needed[0] < needed[1]
    alone = wiring_of(None, range(8), range(8), 3)
    assert (alone.undecided, alone.points_needed) == (tuple(range(8)), FIRST_POINTS)
    (said,) = wrong_wires(alone, range(8))
    assert said.message.startswith("undecided: all 8 channels: measured points (3) do not tell")
    assert "measure about 5 more" in said.message


def test_a_circle_of_three_and_a_sensor_the_wrong_way_round():
    waves = strengths(8, 0.05)
    waves.strength[[1, 2, 3]] = waves.strength[[2, 3, 1]]
    waves.strength[:] *= -1
    found = wiring_of(waves, range(8), range(8), 6)
    assert (found.swapped, found.inverted, found.all_inverted) == (((1, 2, 3),), (), True)
    assert [one.kind for one in wrong_wires(found, range(8))] == ["swapped", "inverted"]


def test_a_weak_channel_has_no_verdict():
    waves = strengths(8, 0.05)
    waves.strength[4, 4] = 0.3
    found = wiring_of(waves, range(8), range(8), 6)
    assert found.undecided == (4,)
    power = np.full((3, 32), 4.0)
    power[:, 4] = 4e-4
    (dead,) = dead_channels(power, np.ones((3, 32)), range(8), np.ones(32, bool))
    assert (dead.channels, "4 is dead: 1.0% of the others'" in dead.message) == ((4,), True)


def test_no_points_are_asked_for_what_is_decided():
    """A pair of large errors that is decided all the same asked for 20."""
    waves = strengths(8, 0.05)
    waves.strength[[0, 1], [0, 1]], waves.error[:2], waves.strength[4, 4] = 2.0, 0.5, 0.3
    found = wiring_of(waves, range(8), range(8), 6)
    assert (found.undecided, found.points_needed) == ((4,), 7)


def test_points_beside_those_that_are_there_keep_off_them():
    before_m = wiring_points(BOARD, 6)
    more_m = wiring_points(BOARD, 3, before_m)
    apart_m = np.hypot(*(more_m[:, None] - before_m).T).min()
    assert apart_m > 0.02
    for points_m in (before_m, more_m):
        assert ((points_m >= 0.03) & (points_m <= np.array([0.18, 0.118]))).all()


def test_the_command_from_the_first_points_to_a_verdict(tmp_path, capsys):
    """Too few points, then as many more as it asks for."""
    folder, points = tmp_path / "wires", tmp_path / "points.csv"
    assert main(["calibrate", "wiring", str(folder), "--points", str(points)]) == 75
    err = capsys.readouterr().err
    assert f"{points}: {FIRST_POINTS} points, {FIRST_POINTS} of them to measure" in err
    assert f"calibrate measure {folder} --points {points}" in err
    rows = points.read_text().splitlines()
    assert len(rows) == 1 + FIRST_POINTS
    points.write_text("\n".join([*rows[:4], ""]))
    simulate = ["calibrate", "simulate", str(folder), "--points", str(points), "--plate", "theory=mindlin", "--snr-db", "30"]
    wires = ["--swapped", "3", "9", "--inverted", "20", "--dead", "14"]
    assert main([*simulate, *wires]) == 0
    capsys.readouterr()
    assert main(["calibrate", "wiring", str(folder), "--points", str(points), "--json"]) == 1  # the dead one needs no waves
    figures = json.loads(capsys.readouterr().out)
    assert figures["channels"]["dead"] == [[14]]
    assert (figures["channels"]["swapped"], figures["points"]) == ([], 3)
    assert len(figures["channels"]["undecided"][0]) > 20
    assert len(points.read_text().splitlines()) == 1 + figures["points_needed"]
    again = tmp_path / "again"
    simulate[2] = str(again)
    assert main([*simulate, *wires]) == 0
    capsys.readouterr()
    assert main(["calibrate", "wiring", str(again)]) == 1
    out = capsys.readouterr().out
    assert "channels 3 and 9 look swapped" in out
    assert "channel 20 looks inverted" in out
    assert "channel 14 is dead" in out
    assert "undecided" not in out


@each_row("off_m", [1e-3, 4e-3])
def test_points_that_lie_elsewhere_are_found_and_accuse_nobody(off_m):
    points_m, measured = transfers("free", 8, 5, 0.03)
    stated_m, resolved = points_m + np.array([off_m, 0]), np.ones(measured.shape[:2], bool)
    places_m = locate(BOARD, BINS, stated_m, measured, resolved).places(stated_m, middle_m(BOARD))
    assert abs(places_m - points_m).max() < 0.2e-3
    found = wiring_of(direct_waves(BOARD, BINS, places_m, measured, resolved, 60e-6), CHANNELS, CHANNELS, 8)
    assert (found.swapped, found.inverted, found.undecided) == ((), (), ())


@pytest.mark.slow
@pytest.mark.parametrize(("off_mm", "code", "said"), [("4", 1, "channels 3 and 9 look swapped"), ("14", 75, "undecided: all 32")])
def test_the_command_finds_the_frame_first_and_accuses_nobody_without_one(tmp_path, capsys, off_mm, code, said):
    """Beyond 12 mm there is no frame."""
    folder, points = str(tmp_path / "wires"), str(tmp_path / "points.csv")
    assert main(["calibrate", "wiring", folder, "--points", points]) == 75
    simulate = ["calibrate", "simulate", folder, "--points", points, "--plate", "edges=free", "--snr-db", "30"]
    assert main([*simulate, "--swapped", "3", "9", "--offset-mm", off_mm, "0"]) == 0
    capsys.readouterr()
    assert main(["calibrate", "wiring", folder]) == code
    out = capsys.readouterr().out
    assert out.startswith(said) or f"WRONG: {said}" in out
    assert out.count("\n") == 1
