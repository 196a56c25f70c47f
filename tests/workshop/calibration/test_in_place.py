"""Measuring in place: the product's own player, limits and outputs; recorders that lag, lose samples, lie or are absent."""

import os
import sys
import threading
import tty
import types
import zlib

import msgspec
import numpy as np
import pytest
from small_plate import WHOLE, small_board
from tables import each_row

from controller.cli import main
from controller.clocks import VirtualClock
from controller.device.bank.packing import channel_bits
from controller.device.board.board import load_board
from controller.device.service.drivers import open_session
from controller.errors import CalibrationError, LinkError
from controller.workshop.calibration.recording.alignment import begin_of, shifted
from controller.workshop.calibration.recording.excitation import drive_words
from controller.workshop.calibration.recording.in_place import BEFORE_S, Excitation, InPlace
from controller.workshop.calibration.recording.recorders import AlsaRecorder, SerialRecorder
from controller.workshop.calibration.recording.simulated_recorder import SimulatedRecorder
from controller.workshop.calibration.records.measurements import read_measurement
from controller.workshop.gateware.simulated_link import open_simulated
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.motion import PlateMotion

RATE_HZ = 250e3
PLACE_M = np.array([0.03, 0.02])
RECORD_S, PERIOD_S = 2.2e-3, 3e-3


@pytest.fixture(scope="module")
def board():
    small, changed = small_board(), msgspec.structs.replace
    return changed(small, plate=changed(small.plate, decay_time_ms=0.2), actuators=small.actuators[:2])


class Kept:
    """A recorder's pins, of which the last capture can be looked at."""

    def __init__(self, link):
        self.link, self.clock_hz, self.tick, self.last = link, link.clock_hz, link.tick, None

    def take_captures(self):
        (self.last,) = self.link.take_captures()
        return [self.last]


def panel(board, repetitions=2, rate_hz=RATE_HZ, recorder=None):
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    pins = Kept(link)
    recorder = recorder or SimulatedRecorder(board, pins, clock.now_s, rate_hz, "m/s", board.actuators[0].channel)
    recorder.place_m = PLACE_M
    words = drive_words(board)
    session = open_session(link, board, clock.now_s)
    sync = board.actuators[0].channel
    return InPlace(session, board, clock, recorder, Excitation(words, repetitions, PERIOD_S, RECORD_S), sync), words, pins, link


def is_off(link):
    """Whether the outputs are off a ramp later."""
    now_s = link._now_s()
    link._now_s = lambda: now_s + 0.1
    link.close()
    capture = link.take_capture()
    assert capture.hv.any(), "they were on"
    return not capture.hv[-1] and not capture.words[-1]


def exact(board, words, times_s=None, place_m=PLACE_M):
    """Records of the same emissions without an FPGA: (emission, sample)."""
    levels = [np.concatenate([[board.idle_word], emission, [board.idle_word]]).astype(np.uint32) for emission in words]
    steps_v = np.diff(np.stack([channel_bits(level).astype(float) for level in levels], axis=2), axis=0) * board.driver.supply_v
    if times_s is None:
        times_s = np.arange(round((BEFORE_S + RECORD_S) * RATE_HZ)) / RATE_HZ - BEFORE_S
    step_s = np.arange(words.shape[1] + 1) * board.waveform.bit_period_s
    return PlateMotion(board, modes_of(board)).of_points(place_m[None], step_s, steps_v, times_s)[0]


def test_what_is_recorded_is_what_the_words_do_and_the_pins_are_the_words_bit_for_bit(board):
    played, words, pins, _ = panel(board)
    records = played.measure()
    expected = exact(board, words)
    error = [np.sqrt(np.mean((records[:, r] - expected) ** 2) / np.mean(expected**2)) for r in range(2)]
    print(f"rms difference of two repetitions from the exact motion: {error[0]:.4f}, {error[1]:.4f} of its rms")
    assert max(error) < 0.01, "a hundredth of a sample of misalignment"
    rolled = np.roll(expected, 1, axis=-1)
    assert np.sqrt(np.mean((records[:, 0] - rolled) ** 2) / np.mean(expected**2)) > 0.2, "a slip by a sample is noticed"
    capture, bit = pins.last, board.bit_ticks
    emissions = iter(np.repeat(words, 2, axis=0))
    for focus in capture.focus_ticks.astype(np.int64):
        at = focus - words.shape[1] * bit + np.arange(words.shape[1]) * bit
        held = capture.words[np.searchsorted(capture.ticks.astype(np.int64), at, side="right") - 1]
        assert np.array_equal(held, next(emissions)), "the pins are the words"
    assert len(capture.focus_ticks) == 4
    apart = np.diff(capture.focus_ticks.astype(np.int64))
    assert set(apart.tolist()) == {round(PERIOD_S * board.link.clock_hz)}, "to one clock of the FPGA"
    assert not capture.hv[-1], "outputs off"
    assert not capture.words[-1]


class Dead:
    """A recorder of silence."""

    triggered, rate_hz = False, RATE_HZ

    def begin(self, samples, alive):  # noqa: ARG002
        self.samples = samples

    def read(self, alive):  # noqa: ARG002
        return np.random.default_rng(1).normal(size=(self.samples, 2)) * 1e-6


def test_outputs_are_off_after_every_error(board):
    played, _, _, link = panel(board, recorder=Dead())
    with pytest.raises(CalibrationError, match="emission 0, repetition 0: the track of the drive does not hear"):
        played.measure()
    assert is_off(link)

    class Interrupted(Dead):
        def begin(self, samples, alive):  # noqa: ARG002
            raise KeyboardInterrupt

    played, _, _, link = panel(board, recorder=Interrupted())
    with pytest.raises(KeyboardInterrupt):
        played.measure()
    assert is_off(link)


@pytest.mark.parametrize("rate_hz", [192e3, 1e6])
def test_an_emission_is_found_to_a_fiftieth_of_a_sample(rate_hz):
    levels = (drive_words(WHOLE)[5] >> 3 & 1).astype(bool)
    for begin in (700.0, 700.37, 812.5):
        fine = (np.arange(3000 * 64) + 0.5) / (rate_hz * 64) - 0.5 / rate_hz
        word = np.floor((fine - begin / rate_hz) * 500e3).astype(int)
        heard = np.where((word >= 0) & (word < 1000), levels[np.clip(word, 0, 999)], 0).reshape(3000, 64).mean(axis=1)
        noisy = 0.2 - 0.3 * heard + 0.01 * np.random.default_rng(1).normal(size=3000)
        assert begin_of(noisy, rate_hz, levels, 500e3, 750, 100) == pytest.approx(begin, abs=0.02)
    with pytest.raises(CalibrationError, match="ends before the last emission"):
        begin_of(noisy[:400], rate_hz, levels, 500e3, 750, 100)


def test_of_emissions_that_are_alike_the_first_is_found():
    """A later one that happens to be heard a little better was taken for it, and the last ones then were missing."""
    levels = (drive_words(WHOLE)[5] >> 3 & 1).astype(bool)
    sync = 0.001 * np.random.default_rng(1).normal(size=30_000)
    for begin, height in ((3000, 1.0), (8000, -1.01), (13000, 1.02)):
        sync[begin : begin + len(levels)] += height * levels  # at 500 kHz every sample is a word
    assert begin_of(sync, 500e3, levels, 500e3, 9000, 9000) == pytest.approx(3000, abs=1)
    assert begin_of(sync, 500e3, levels, 500e3, 8010, 20) == pytest.approx(8000, abs=1)


def test_a_shift_by_a_fraction_is_a_delay():
    time = np.arange(2000.0)
    wave = np.sin(0.9 * time) * np.exp(-(((time - 1000) / 200) ** 2))
    moved = shifted(wave, 900.25, 100, 400)
    at = 800.25 + np.arange(400)
    assert np.allclose(moved, np.sin(0.9 * at) * np.exp(-(((at - 1000) / 200) ** 2)), atol=1e-3)
    assert not shifted(wave, -500.0, 10, 50).any()


class Sensor:
    """The far end of a serial port, in a thread."""

    def __init__(self, answers):
        near, self.far = os.openpty()
        tty.setraw(near)
        self.device = os.ttyname(self.far)
        self.near, self.asked = near, []
        tty.setraw(self.far)
        self._answers = answers
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self):
        line = b""
        while True:
            try:
                byte = os.read(self.near, 1)
            except OSError:
                return
            line += byte
            if line.endswith(b"\n"):
                self.asked.append(line)
                os.write(self.near, self._answers(line))
                line = b""


def with_crc(samples):
    data = samples.astype("<i2").tobytes()
    return data + zlib.crc32(data).to_bytes(4, "little")


HELLO = b"SENSOR 1 400000 2.5 4000\n"


def test_a_sensor_at_a_serial_port(board):
    samples = np.arange(-440, 440)
    sensor = Sensor(lambda line: HELLO if line == b"?\n" else b"OK\n" + with_crc(samples))
    recorder = SerialRecorder(sensor.device, 921_600)
    played, words, _, link = panel(board, repetitions=1, recorder=recorder)
    records = played.measure()
    assert records.shape == (len(words), 1, 880)
    assert np.array_equal(records[1, 0], samples * (2.5 / 32768))
    assert sensor.asked == [b"?\n", b"R 880\n", b"R 880\n"]
    capture = link.take_capture()
    assert len(capture.focus_ticks) == len(words)
    assert not capture.hv[-1]
    recorder.close()


@each_row(
    ("hello", "answer", "error", "said"),
    [
        (b"hello\n", b"", LinkError, "answers b'hello"),
        (b"SENSOR 1 0 1 10\n", b"", LinkError, "is it that port"),
        (b"SENSOR 1 1e5 1 10\n", b"", CalibrationError, "it holds 10 samples, not 20"),
        (HELLO, b"ERROR too hot\n", CalibrationError, "ERROR too hot"),
        (HELLO, b"OK\n" + with_crc(np.arange(20))[:-1] + b"!", CalibrationError, "damaged .CRC."),
        (HELLO, b"OK\n\1\2", CalibrationError, "0 of 20 samples: is its trigger input wired"),
    ],
)
def test_a_serial_sensor_that_fails(hello, answer, error, said, monkeypatch):
    monkeypatch.setattr("controller.workshop.calibration.recording.recorders.ANSWER_S", 0.3)
    sensor = Sensor(lambda line: hello if line == b"?\n" else answer)

    def use():
        recorder = SerialRecorder(sensor.device, 921_600)
        recorder.begin(20, lambda: None)
        recorder.read(lambda: None)

    with pytest.raises(error, match=said):
        use()


def test_a_serial_port_that_is_not_there():
    with pytest.raises(LinkError, match="/dev/no-such-port"):
        SerialRecorder("/dev/no-such-port", 9600)


class Card(types.ModuleType):
    """`sounddevice`, as far as it is used."""

    class PortAudioError(Exception):
        pass

    def __init__(self, track=None, status=None):
        super().__init__("sounddevice")
        self.track, self.status, self.asked = track, status, None

    def check_input_settings(self, device, **_):
        if device == "none":
            raise ValueError("No input device matching 'none'")

    def rec(self, samples, **asked):
        self.asked = asked | {"samples": samples}
        return self.track

    def wait(self):
        return self.status

    def stop(self):
        pass


def test_a_sound_card(monkeypatch):
    card = Card(np.array([[0.5, 0.1], [-0.25, 0.2]], np.float32))
    monkeypatch.setitem(sys.modules, "sounddevice", card)
    recorder = AlsaRecorder("hw:1", 192e3, 2.0)
    recorder.begin(2, lambda: None)
    assert np.allclose(recorder.read(lambda: None), [[1.0, 0.1], [-0.5, 0.2]])
    assert (card.asked["samples"], card.asked["samplerate"], card.asked["channels"]) == (2, 192e3, 2)
    recorder.close()
    card.status = "input overflow"
    with pytest.raises(CalibrationError, match=r"lost samples \(input overflow\)"):
        recorder.read(lambda: None)
    card.status, card.track[0, 0] = None, 1.0
    with pytest.raises(CalibrationError, match="clipped"):
        recorder.read(lambda: None)
    with pytest.raises(LinkError, match="'none' does not record two tracks at 192000 Hz"):
        AlsaRecorder("none", 192e3, 1.0)


def test_a_computer_without_sounddevice_or_portaudio_says_what_to_install(tmp_path, monkeypatch, capsys):
    (tmp_path / "p.csv").write_text("point,x_mm,y_mm\n1,20,30\n")
    arguments = ["calibrate", "measure", str(tmp_path / "m"), "--points", str(tmp_path / "p.csv"), "--alsa", "x", "--v-per-m", "1"]
    monkeypatch.setitem(sys.modules, "sounddevice", None)
    assert main(arguments) == 78
    assert "sounddevice is missing" in capsys.readouterr().err
    (tmp_path / "sounddevice.py").write_text("raise OSError('PortAudio library not found')")
    monkeypatch.delitem(sys.modules, "sounddevice")
    monkeypatch.syspath_prepend(tmp_path)
    assert main(arguments) == 78
    assert "apt install libportaudio2" in capsys.readouterr().err
    assert not (tmp_path / "m").exists()


@pytest.fixture
def folder(board, tmp_path):
    """A board of two channels on a small plate, and two points."""
    whole = load_board(board.folder)
    head, rest = (whole.folder / "board.toml").read_text().split("actuators = [\n")
    two = "\n".join(rest.split("]\n", 1)[0].splitlines()[:2])
    tail = (
        rest.split("]\n", 1)[1]
        .replace("= 210.0", "= 60.0")
        .replace("148.0", "40.0")
        .replace("decay_time_ms = 1.0", "decay_time_ms = 0.1")
    )
    (tmp_path / "board.toml").write_text(f"{head}actuators = [\n{two}\n]\n{tail}")
    (tmp_path / "p.csv").write_text("point,x_mm,y_mm\na,20,30\nb,30.5,10\n")
    return tmp_path


def test_the_command_measures_what_is_missing_and_moves_the_head(folder, capsys):
    mover = folder / "move.sh"
    mover.write_text(f'#!/bin/sh\necho "$1 $2" >> {folder}/moved\n')
    mover.chmod(0o755)
    start = ["calibrate", "measure", str(folder / "m"), "--board", str(folder), "--points", str(folder / "p.csv")]
    arguments = [*start, "--repetitions", "1", "--rate-khz", "250", "--move", str(mover)]
    assert main(arguments) == 0
    assert (folder / "moved").read_text() == "20.0000 30.0000\n30.5000 10.0000\n"
    found = read_measurement(folder / "m", load_board(folder))
    first = found.records(0).values
    assert found.settings.records.first_sample_us == pytest.approx(-200)
    (folder / "m/records/b.npy").unlink()
    assert main(arguments) == 0
    assert (folder / "moved").read_text().splitlines()[2:] == ["30.5000 10.0000"]
    assert np.array_equal(read_measurement(folder / "m", load_board(folder)).records(0).values, first)
    capsys.readouterr()
    assert main([*arguments, "--drive", "noise", "--record-ms", "4"]) == 0, "nothing is missing"
    assert main([*arguments, "--repetitions", "2"]) == 78
    assert "records differs from this measurement" in capsys.readouterr().err
    (folder / "m/records/b.npy").unlink()
    mover.write_text("#!/bin/sh\nexit 3\n")
    assert main(arguments) == 78
    assert "point b (2 of 2): x = 30.50 mm, y = 10.00 mm: the head was not moved" in capsys.readouterr().err
    (folder / "full").mkdir()
    (folder / "full/mine").write_text("mine")
    arguments[2] = str(folder / "full")
    assert main(arguments) == 78
    assert "is not empty" in capsys.readouterr().err


def test_records_begin_when_their_file_says_at_a_rate_that_has_no_whole_number_of_samples_before(folder):
    """2 µs of 192 kHz, which a finger would pay with an eighth of the amplitude."""
    start = ["calibrate", "measure", str(folder / "m"), "--board", str(folder), "--points", str(folder / "p.csv")]
    assert main([*start, "--repetitions", "1", "--rate-khz", "192", "--yes"]) == 0
    board = load_board(folder)
    found = read_measurement(folder / "m", board)
    heard = found.records(0).values[:, 0]
    times_s = found.settings.records.first_sample_us * 1e-6 + np.arange(heard.shape[1]) / 192e3
    expected = exact(board, drive_words(board), times_s, np.array([0.02, 0.03]))
    assert np.sqrt(np.mean((heard - expected) ** 2) / np.mean(expected**2)) < 0.05


@each_row(
    ("arguments", "said"),
    [
        (["--alsa", "x"], "give the sensor's sensitivity"),
        (["--v-per-m", "1"], "of use with --alsa or --serial"),
        (["--alsa", "x", "--v-per-m", "1", "--plate", "edges=free"], "--plate and --noise are for the sensor of a simulated panel"),
        (["--rate-khz", "100"], "--rate-khz 100: not from 140"),
        (["--repetitions", "0"], "--repetitions 0: not from 1"),
        (["--sync", "30"], "--sync 30: board 'simulated' has no such channel"),
        (["--temperature-c", "nan"], "--temperature-c: 'nan' is not a finite number"),
    ],
)
def test_options_that_make_no_sense_are_refused(folder, capsys, arguments, said):
    start = ["calibrate", "measure", str(folder / "m"), "--board", str(folder), "--points", str(folder / "p.csv")]
    assert main([*start, *arguments]) == 2
    refused = capsys.readouterr().err
    assert said in refused
    assert refused.count("\n") == 1
    assert not (folder / "m").exists()
