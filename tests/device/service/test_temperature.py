"""The bit clock follows a sensor that may be absent, lie, or come back."""

import errno
import math
import socket
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.devices import Temperature
from controller.device.board.worker import WorkerEnded
from controller.device.service import temperature_sensors
from controller.device.service.temperature import HOLD_S, JUMP_C, RETRY_S, Thermometer
from controller.device.service.temperature_sensors import ANSWER, HANGS_S, Hwmon, SensorProcess, lm75_c, serve_sensor

SETTINGS = Temperature(kind="hwmon", device="plate", coefficient_per_k=-100e-6)


class Given:
    """A sensor that says what it is given: numbers, or errors that it raises."""

    def __init__(self, *readings):
        self.readings = list(readings)
        self.asked = 0

    def read_c(self):
        self.asked += 1
        reading = self.readings.pop(0)
        if isinstance(reading, OSError):
            raise reading
        return reading

    def close(self):
        pass


@each_row(  # datasheets of LM75B (table 10), TMP75 and TMP102 (table 5), TMP1075 (table 7-1)
    ("high", "low", "temperature_c"),
    [
        (0x7F, 0xF0, 127.9375),
        (0x64, 0x00, 100),
        (0x19, 0x00, 25),
        (0x00, 0x80, 0.5),
        (0x00, 0x10, 0.0625),
        (0x00, 0x00, 0),
        (0xFF, 0xF0, -0.0625),
        (0xFF, 0x80, -0.5),
        (0xE7, 0x00, -25),
        (0xC9, 0x00, -55),
        (0x80, 0x00, -128),
    ],
)
def test_the_words_of_the_datasheets(high, low, temperature_c):
    assert lm75_c(low << 8 | high) == temperature_c


@given(st.floats(-40, 100), st.floats(-1e-2, 1e-2))
def test_the_scale_is_one_at_the_reference_and_linear_in_between(reading_c, coefficient):
    settings = Temperature(kind="hwmon", device="x", coefficient_per_k=coefficient, reference_c=20.0)
    assert settings.scale(20.0) == 1
    assert settings.scale(reading_c) == pytest.approx(1 + coefficient * (reading_c - 20))


def test_warm_glass_is_played_slower():
    assert Thermometer(SETTINGS, Given(33.0)).scale(0.0) == pytest.approx(0.999)


def test_a_reading_out_of_range_is_refused_counted_and_reported():
    thermometer = Thermometer(SETTINGS, Given(33.0, 85.1, -20.1, math.nan, 34.0))
    scale = thermometer.scale(0.0)
    assert [thermometer.scale(at) for at in (2.0, 4.0, 6.0)] == [scale] * 3
    assert thermometer.refused == 3
    assert "says nan °C" in thermometer.cause
    assert thermometer.scale(8.0) < scale
    assert thermometer.cause == ""


def test_a_jump_is_believed_when_it_is_said_twice():
    thermometer = Thermometer(SETTINGS, Given(23.0, 60.0, 23.5, 60.0, 61.0))
    assert thermometer.scale(0.0) == 1
    assert thermometer.scale(2.0) == 1
    assert thermometer.temperature_c == 23.0
    thermometer.scale(4.0)
    assert thermometer.temperature_c == 23.5
    thermometer.scale(6.0)
    assert (thermometer.temperature_c, thermometer.refused) == (23.5, 2)
    thermometer.scale(8.0)
    assert (thermometer.temperature_c, thermometer.cause) == (61.0, "")


def test_a_jump_is_said_twice_by_readings_no_further_apart_than_that():
    thermometer = Thermometer(SETTINGS, Given(20.0, 50.0, 50.0 + JUMP_C))
    for time_s in (0.0, 2.0, 4.0):
        thermometer.scale(time_s)
    assert (thermometer.temperature_c, thermometer.refused) == (55.0, 1)


def test_the_first_reading_is_no_jump_and_one_just_small_enough_is_none():
    thermometer = Thermometer(SETTINGS, Given(60.0, 60.0 + JUMP_C))
    thermometer.scale(0.0)
    thermometer.scale(2.0)
    assert (thermometer.temperature_c, thermometer.refused) == (65.0, 0)


def test_a_lost_sensor_leaves_its_last_word_for_a_stated_time_and_is_asked_again():
    sensor = Given(33.0, *[OSError(errno.EREMOTEIO, "Remote I/O error")] * 100)
    thermometer = Thermometer(SETTINGS, sensor)
    scale = thermometer.scale(0.0)
    assert scale != 1
    assert thermometer.scale(2.0) == scale
    assert "no temperature sensor answers at plate" in thermometer.cause
    asked = sensor.asked
    assert thermometer.scale(2.0 + RETRY_S - 0.1) == scale
    assert sensor.asked == asked, "a stuck bus is left alone for a while"
    assert thermometer.scale(HOLD_S) == scale
    assert sensor.asked == asked + 1
    assert thermometer.scale(HOLD_S + 0.1) == 1
    sensor.readings = [30.0]
    assert thermometer.scale(HOLD_S + RETRY_S) == pytest.approx(0.9993)
    assert thermometer.failed == 2


@each_row(("number", "said"), [(errno.EBUSY, "kind to 'hwmon'"), (errno.EACCES, "group"), (errno.EIO, "cannot be read")])
def test_why_a_sensor_cannot_be_read_is_said_with_what_to_do(number, said):
    settings = Temperature(kind="lm75", device="/dev/i2c-1", coefficient_per_k=0.0)
    thermometer = Thermometer(settings, Given(OSError(number, "no")))
    assert thermometer.scale(0.0) == 1
    assert said in thermometer.cause
    assert "/dev/i2c-1, address 0x48" in thermometer.cause


def test_hwmon_is_found_by_name_and_by_path_and_again_after_it_was_away(tmp_path, monkeypatch):
    monkeypatch.setattr(temperature_sensors, "HWMON", tmp_path)
    by_name, by_path = Hwmon("plate"), Hwmon(str(tmp_path / "hwmon1" / "temp1_input"))
    with pytest.raises(OSError, match="there are: none"):
        by_name.read_c()
    for number, name, value in [(0, "cpu", "51000\n"), (1, "plate", "23500\n")]:
        (tmp_path / f"hwmon{number}").mkdir()
        (tmp_path / f"hwmon{number}" / "name").write_text(name + "\n")
        (tmp_path / f"hwmon{number}" / "temp1_input").write_text(value)
    assert by_name.read_c() == by_path.read_c() == 23.5
    (tmp_path / "hwmon1" / "temp1_input").write_text("-4125\n")
    assert by_name.read_c() == by_path.read_c() == -4.125
    (tmp_path / "hwmon1" / "temp1_input").write_text("fault\n")
    with pytest.raises(OSError, match="not a number"):
        by_path.read_c()
    (tmp_path / "hwmon1" / "temp1_input").write_text("24000\n")
    assert by_path.read_c() == 24.0
    by_name.close()
    by_path.close()
    with pytest.raises(OSError, match="there are: cpu, plate"):
        Hwmon("plat").read_c()


def test_a_board_without_its_sensor_plays_at_its_own_bit_clock():
    lm75 = Temperature(kind="lm75", device="/dev/i2c-none", coefficient_per_k=-1e-4)
    hwmon = Temperature(kind="hwmon", device="no such chip", coefficient_per_k=-1e-4)
    for settings in (lm75, hwmon):
        thermometer = Thermometer(settings)
        assert thermometer.scale(0.0) == 1
        assert "no temperature sensor answers" in thermometer.cause
        thermometer.close()


class Answers:
    """A worker that answers when it is commanded to."""

    def __init__(self):
        self.asked = 0
        self.answers = []

    def send(self, message):
        assert message
        self.asked += 1

    def receive(self):
        answer = self.answers.pop(0) if self.answers else None
        if answer is WorkerEnded:
            raise WorkerEnded
        return answer

    def close(self):
        pass


def test_a_sensor_that_has_not_answered_is_waited_for_and_one_that_never_does_is_reported(monkeypatch):
    now_s = [100.0]
    monkeypatch.setattr(temperature_sensors, "time", SimpleNamespace(monotonic=lambda: now_s[0]))
    worker = Answers()
    thermometer = Thermometer(SETTINGS, SensorProcess(worker))
    assert (thermometer.scale(0.0), thermometer.cause, worker.asked) == (1, "", 1)
    worker.answers = [memoryview(ANSWER.pack(0, 33.0))]
    assert thermometer.scale(2.0) == pytest.approx(0.999)
    assert worker.asked == 2, "the next one is asked for as one is taken"
    now_s[0] += HANGS_S + 0.1
    assert thermometer.scale(4.0) == pytest.approx(0.999)
    assert "hangs" in thermometer.cause
    assert worker.asked == 2, "nobody is asked twice"
    worker.answers = [memoryview(ANSWER.pack(errno.EREMOTEIO, 0.0) + b"Remote I/O error")]
    thermometer.scale(4.0 + RETRY_S)
    assert "no temperature sensor answers at plate (Remote I/O error)" in thermometer.cause
    worker.answers = [memoryview(ANSWER.pack(0, 30.0))]
    assert thermometer.scale(4.0 + 2 * RETRY_S) == pytest.approx(0.9993)
    assert thermometer.cause == ""
    worker.answers = [WorkerEnded]
    thermometer.scale(6.0 + 2 * RETRY_S)
    assert "has ended" in thermometer.cause


def test_the_process_of_a_sensor_answers_each_question_once_and_ends_with_the_loop():
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with ours, theirs:
        for _ in range(2):
            ours.send(b"?")
        ours.shutdown(socket.SHUT_WR)
        serve_sensor(Given(31.5, OSError(errno.EIO, "bad")), theirs)
        assert ANSWER.unpack_from(ours.recv(100)) == (0, 31.5)
        said = ours.recv(100)
    assert (ANSWER.unpack_from(said)[0], said[ANSWER.size :]) == (errno.EIO, b"bad")
