"""A plate whose frequencies drift: what fingers get with the bit clock that follows the temperature, and without, end to end."""

import json
import math

import msgspec
import numpy as np
import pytest
from scripted_evemu import evemu
from small_plate import small_board
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.devices import Temperature
from controller.device.board.plate.patches import Patches
from controller.device.scene.scene import load_scene
from controller.device.service import run as service_run
from controller.device.service import temperature
from controller.device.service.temperature import Thermometer
from controller.device.touch.recordings.recording import Recording
from controller.errors import ConfigError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.gateware.simulated_link import SimulatedLink, open_simulated
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.simulation.drift import ASSUMED, Drift, since
from controller.workshop.simulation.focus_evaluation import judge
from controller.workshop.simulation.other_plate import on_other_plate, on_plate_of
from controller.workshop.simulation.run_figures import report
from controller.workshop.simulation.simulated_run import Hardware, play

CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'
PER_K = ASSUMED.coefficient_per_k
KELVIN = 0.005 / PER_K  # of +0.5 %
PLACES_MM = [(20.0, 15.0), (30.0, 25.0), (45.0, 35.0)]  # centres of cells


@pytest.fixture(scope="module")
def panel(tmp_path_factory):
    """A small plate that plays for 2 ms as the whole one does, with its bank and a scene of clicks; its board, and both files."""
    board, changed = small_board(), msgspec.structs.replace
    board = changed(
        board,
        waveform=changed(board.waveform, duration_ms=2.0),
        bank=changed(board.bank, coarse=True, pitch_mm=5.0),
        temperature=msgspec.structs.replace(ASSUMED, period_s=0.1),
        touch=changed(board.touch, x_mm_from_axes=(70.0, 0.0, 0.0), y_mm_from_axes=(0.0, 50.0, 0.0)),
    )
    folder = tmp_path_factory.mktemp("drift")
    build_bank(BankRequest(board, folder / "b.bank", 5e-3))
    (folder / "s.toml").write_text(CLICK)
    return board, folder / "b.bank", folder / "s.toml"


def taps(times=(0.5, 1.0, 1.5)):
    places = [PLACES_MM[k % len(PLACES_MM)] for k in range(len(times))]
    reports = [r for at, place in zip(times, places, strict=True) for r in ((at, {0: place}), (at + 0.1, {0: None}))]
    text = evemu((0.0, {1: (60.0, 45.0)}), (0.01, {1: None}), *reports)
    return Recording(text.replace("2100", "700").replace("1480", "500"), "taps")


def played(panel, drift, *, times=(0.5, 1.0, 1.5), sensed=True, scene=None):
    board, bank_file, scene_file = panel
    if not sensed:
        board = msgspec.structs.replace(board, temperature=None)
    with Bank.open(bank_file, board) as bank:
        return play(
            board, load_scene(scene or scene_file, board), bank, taps(times), real_time=False, hardware=Hardware(drift=drift)
        )


def kept(run):
    """Share of A_ref of the plate as it was, of the taps after the first."""
    return [focus.relative_amplitude for focus in judge(run).foci[1:]]


@pytest.mark.parametrize("percent", [0.5, pytest.param(-0.5, marks=pytest.mark.slow)])
def test_half_a_percent_costs_forty_percent_and_the_bit_clock_has_it_back(panel, percent):
    board, _, _ = panel
    run = played(panel, Drift.constant(percent))
    with_sensor, without = kept(run), kept(played(panel, Drift.constant(percent), sensed=False))
    print(f"{percent:+} %: kept {min(with_sensor):.4f} at least with the bit clock, {np.median(without):.3f} without it")
    assert min(with_sensor) >= 0.99
    assert 0.45 < np.median(without) < 0.75
    reported = report(run, judge(run).foci)["drift"]
    assert reported["bit_clock_scale"] == pytest.approx(1 + percent / 100, abs=1e-6)
    assert reported["bit_clock_step_ppm"] == pytest.approx(1e6 / (board.bit_ticks << 16))
    assert reported["sensor_c"] == pytest.approx(23 + math.copysign(KELVIN, KELVIN * percent))
    json.dumps(reported)


@pytest.mark.slow
def test_a_correction_wrong_by_a_tenth_is_noticed(panel):
    wrong = Drift(np.zeros(1), np.full(1, 5e-3), np.full(1, 23 + 0.8 * KELVIN))
    assert kept(played(panel, wrong)) < kept(played(panel, Drift.constant(0.5)))


@pytest.mark.slow
def test_a_plate_that_warms_is_followed(panel):
    drift = Drift(np.array([0.0, 6.0]), np.array([0.0, 5e-3]))
    times = tuple(np.arange(1, 7.0).tolist())
    corrected, alone = (kept(played(panel, drift, times=times, sensed=sensed)) for sensed in (True, False))
    assert min(corrected) >= 0.985, "the sensor is read every 0.1 s, in which the plate drifts by 80 ppm"
    assert alone[0] > 0.97
    assert alone[-1] < 0.75


@pytest.mark.parametrize(
    ("said_c", "expected"),
    [
        ([23.0 + KELVIN, math.nan, math.nan], [1.0, 1.0, 1.0]),  # fails: its last reading is used
        ([23.0 + KELVIN, -40.0, 99.0], [1.0, 1.0, 1.0]),  # lies: beyond lowest_c and highest_c nothing is believed
        ([23.0 + KELVIN, 23.0, 23.0], [1.0, 0.6, 0.6]),  # jumps by 25 K, and stays there: believed at the second reading
        ([math.nan, math.nan, math.nan], [0.6, 0.6, 0.6]),  # never there: the board's own bit clock
    ],
    ids=["fails", "lies", "jumps", "absent"],
)
def test_a_sensor_that_errs(panel, said_c, expected, monkeypatch):
    drift = Drift(np.array([0.0, 0.8, 1.3]), np.full(3, 5e-3), np.array(said_c))
    monkeypatch.setattr(temperature, "RETRY_S", 0.1)
    got = kept(played(panel, drift))
    assert got == pytest.approx(expected, abs=0.16)
    assert [share > 0.98 for share in got] == [share == 1 for share in expected]


def test_a_sensor_that_jumps_once_is_not_believed_and_one_that_stays_away_is_forgotten(panel, monkeypatch):
    once = Drift(np.array([0.0, 0.40, 0.50]), np.full(3, 5e-3), np.array([23 + KELVIN, 60.0, 23 + KELVIN]))
    run = played(panel, once)
    assert min(kept(run)) >= 0.99
    monkeypatch.setattr(temperature, "HOLD_S", 0.6)
    gone = Drift(np.array([0.0, 0.3]), np.full(2, 5e-3), np.array([23 + KELVIN, math.nan]))
    shares = kept(played(panel, gone))
    assert shares[0] >= 0.99
    assert max(shares[1:]) < 0.75, "after HOLD_S the reference temperature is assumed"


def test_fixed_emitters_that_the_fpga_repeats_without_a_pause_let_the_bit_clock_follow(panel, tmp_path):
    """An FPGA that plays takes no bit clock, and one that repeats is never idle: the repetition is interrupted for it."""
    (tmp_path / "spot.toml").write_text(
        '[[regions]]\nname = "spot"\nshape = "circle"\nx_mm = 32.5\ny_mm = 22.5\nradius_mm = 2.0\n'
        'effects = [{ effect = "always", rate_hz = 500.0 }]\n'
    )
    steps = Drift(np.array([0.0, 0.2, 0.201]), np.array([0.0, 0.0, 5e-3]))
    run = played(panel, steps, times=(0.6,), scene=tmp_path / "spot.toml")
    assert run.bit_clock.scale == pytest.approx(1.005, abs=1e-6)
    foci_s = (run.capture.focus_ticks / run.link.clock_hz - run.start_s)[5:]
    gaps = np.diff(foci_s)
    assert (gaps > 2.5e-3).sum() == 1, "interrupted once"
    assert gaps.max() < 12e-3
    assert np.all(np.abs(gaps / 2e-3 - np.round(gaps / 2e-3)) < 0.01), "and in its pulse before and after"


def test_the_service_itself_follows_a_sensor_of_the_kernel(panel, monkeypatch, tmp_path):
    """`serve`, with a file of sysfs and the replay of a recording: the pins on the drifted plate."""
    board, bank_file, scene_file = panel
    sensor, links = tmp_path / "temp1_input", []
    sensor.write_text(f"{round(1000 * (23 + KELVIN))}\n")
    settings = Temperature(kind="hwmon", device=str(sensor), coefficient_per_k=PER_K, period_s=0.1)
    board = msgspec.structs.replace(board, temperature=settings)

    class Kept(SimulatedLink):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            links.append(self)

    monkeypatch.setattr("controller.workshop.gateware.simulated_link.SimulatedLink", Kept)
    monkeypatch.setattr(service_run, "MonotonicClock", VirtualClock)
    said = []
    monkeypatch.setattr(service_run, "log", lambda line, event=None: said.append((line, event)))
    monkeypatch.setattr(service_run, "enter_realtime", lambda _: ["not in real time"])
    monkeypatch.setattr(service_run, "await_thermometer", lambda of: Thermometer(of.temperature))
    with Bank.open(bank_file, board) as bank:
        figures = service_run.serve(board, load_scene(scene_file, board), str(scene_file), bank, taps(), open_simulated)
    assert figures["bit_clock_scale"] == pytest.approx(1.005, abs=1e-6)
    assert figures["emissions"] == 4
    assert ("not in real time", service_run.Event.NOT_REALTIME) in said
    twins = [PlateTwin(board, modes=drifted(modes_of(board), by)) for by in (0.005, 0.0)]
    capture = links[0].take_capture()
    shares = []
    for twin in twins:
        fields = list(twin.fields(capture, links[0].clock_hz))[1:]
        points = [(x * 1e-3, y * 1e-3) for x, y in PLACES_MM]
        shares.append([abs(float(f.at([p])[0])) / twin.reference_amplitude(*p) for f, p in zip(fields, points, strict=True)])
    assert min(shares[0]) >= 0.99
    assert max(shares[1]) < 0.75, "on the plate that has not drifted the same words are wrong"


def test_part_of_a_capture_begins_with_the_levels_of_its_begin(panel):
    run = played(panel, Drift.constant(0.0), times=(0.5,))
    capture, tick = run.capture, int(run.capture.focus_ticks[0]) - 100
    part = since(capture, tick)
    assert part.ticks[0] == tick
    assert part.words[0] == capture.words[np.searchsorted(capture.ticks, tick, side="right") - 1]
    assert np.array_equal(part.ticks[1:], capture.ticks[capture.ticks > tick])
    assert np.array_equal(since(capture, -1).ticks, capture.ticks)


@each_row(
    ("text", "said"),
    [
        ("", "line 1: the columns are time_s,drift_percent"),
        ("time,drift\n0,0\n", "line 1: the columns are"),
        ("time_s,drift_percent\n", "has no values"),
        ("time_s,drift_percent\n0,0.1\n0,0.2\n", "line 3: time_s = 0 is not after"),
        ("time_s,drift_percent\n0,warm\n", "line 2: drift_percent = 'warm' is not a number"),
        ("time_s,drift_percent\n0,50\n", "line 2: drift_percent = 50: must be"),
        ("time_s,drift_percent\n0,nan\n", "line 2: drift_percent = nan: must be"),
        ("time_s,drift_percent\n0\n", "line 2: 1 values, not 2"),
        ("time_s,drift_percent,sensor_c\n0,0,x\n", "line 2: sensor_c = 'x'"),
    ],
)
def test_a_file_of_drifts_that_makes_no_sense_is_refused(tmp_path, text, said):
    (tmp_path / "d.csv").write_text(text)
    with pytest.raises(ConfigError, match=said):
        Drift.read(tmp_path / "d.csv")
    (tmp_path / "d.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ConfigError, match="cannot be read"):
        Drift.read(tmp_path / "d.csv")


def test_a_file_of_drifts(tmp_path):
    (tmp_path / "d.csv").write_text("time_s,drift_percent,sensor_c\n0,0.0,23\n10,0.4,\n20,0.5,21\n")
    drift = Drift.read(tmp_path / "d.csv")
    assert drift.at(5) == pytest.approx(0.002)
    assert drift.at(99) == pytest.approx(0.005)
    now_s = [0.0]
    sensor = drift.sensor(ASSUMED, lambda: now_s[0])
    assert sensor.read_c() == 23
    now_s[0] = 15
    with pytest.raises(OSError, match="fails"):
        sensor.read_c()
    now_s[0] = 20
    assert sensor.read_c() == 21


@each_row(
    ("arguments", "code", "said"),
    [
        (["--drift-percent", "7"], 78, "--drift-percent = 7: must be a number from -5 to 5"),
        (["--drift-percent", "nan"], 2, "--drift-percent: 'nan' is not a finite number"),
        (["--drift", "/nowhere.csv"], 78, "/nowhere.csv: cannot be read"),
        (["--sensor", "none"], 2, "--sensor is of no use"),
        (["--plate", "nowhere"], 78, "board 'nowhere' not found"),
    ],
)
def test_options_that_make_no_sense_are_refused(arguments, code, said, capsys):
    assert main(["run", "--speed", "max", *arguments]) == code
    refused = capsys.readouterr().err
    assert said in refused
    assert refused.count("\n") == 1


@each_row(
    ("table", "said"),
    [
        ("coefficient_per_k = 8e-3", r"lowest_c = -20 .* by 0\.656: an emission of 3\.0"),
        ("coefficient_per_k = 8e-3\nlowest_c = 20.0", r"highest_c = 85 .* a drive word of 106 clocks"),
        ("coefficient_per_k = -1e-2\nreference_c = 0.0", r"highest_c = 85 .*0\.15.*no glass"),
        ("coefficient_per_k = 1e-4\nreference_c = 99.0", r"reference_c = 99 is not between"),
    ],
)
def test_a_range_of_temperatures_that_the_fpga_could_not_follow_is_refused(board, tmp_path, table, said):
    """The FPGA would refuse the bit clock, or every emission, while the panel plays."""
    text = (board.folder / "board.toml").read_text()
    (tmp_path / "board.toml").write_text(f'{text}\n[temperature]\nkind = "hwmon"\ndevice = "plate"\n{table}\n')
    with pytest.raises(ConfigError, match=said):
        load_board(tmp_path)


def test_another_boards_plate_under_what_the_host_plays(board, tmp_path):
    text = (
        (board.folder / "board.toml")
        .read_text()
        .replace("idle = 1", "idle = 0")
        .replace("thickness_mm = 0.5", "thickness_mm = 0.6")
    )
    (tmp_path / "real.toml").write_text(text.replace('name = "simulated"', 'name = "real"'))
    on = on_other_plate(board, [str(tmp_path / "real.toml")])
    assert (on.name, on.plate.thickness_mm, on.idle_word) == ("real", 0.6, board.idle_word)
    (tmp_path / "real.toml").write_text("\n".join(line for line in text.split("\n") if "channel = 31" not in line))
    with pytest.raises(ConfigError, match="other channels"):
        on_other_plate(board, [str(tmp_path / "real.toml")])


def test_keys_of_the_plate_one_by_one(board):
    on = on_other_plate(
        board, ["simulated", "edges=free", "thickness_mm = 0.7", "edges={x0 = 'free', x1 = 'free', y0 = 'free', y1 = 'clamped'}"]
    )
    assert (on.plate.thickness_mm, on.plate.edges.y1) == (0.7, "clamped")
    for text, said in (
        ("thickness_mm=thick", "--plate: thickness_mm = 'thick'"),
        ("thick=1", "unknown key"),
        ("a/b", "not found"),
    ):
        with pytest.raises(ConfigError, match=said):
            on_other_plate(board, [text])


def test_a_plate_on_which_the_patches_do_not_fit_is_refused(board):
    assert on_other_plate(board, ["length_mm=203"]).plate.length_mm == 203
    with pytest.raises(
        ConfigError, match=r"^--plate: actuators\[\d+\]\.x_mm = 197\.5 puts the patch off the plate \(0 to 199.0 mm\)"
    ):
        on_other_plate(board, ["length_mm=199"])


def test_the_plate_of_another_board_has_that_boards_patches():
    board = small_board()
    heavy = msgspec.structs.replace(board, patches=Patches(mass_kg_m2=1.0, stiffness_ratio=2.0))
    assert on_plate_of(board, heavy).patches == heavy.patches
    assert on_plate_of(heavy, board).patches is None
