"""Recorders of a sensor on the plate: a sound card (ALSA, by PortAudio), and a sensor at a serial port."""

import re
import time
from collections.abc import Callable
from typing import Any, Final

import numpy as np

from controller.arrays import Floats
from controller.device.kernel.crc import intact
from controller.errors import CalibrationError, ConfigError, LinkError

GREETING: Final = re.compile(rb"SENSOR 1 ([0-9.e+]+) ([0-9.e+-]+) (\d+)\n")  # rate in Hz, full scale in the unit, most samples
ANSWER_S: Final = 2.0
POLL_S: Final = 10e-3  # between heartbeats, at least
MOST_LINE_BYTES: Final = 200


class AlsaRecorder:
    """Two tracks of a sound card: the sensor on the first, a channel's drive, divided to the card's level, on the second.

    `device` is the name or part of it, as `python -m sounddevice` lists them; `full_scale` is that of the card, in the sensor's
    unit. Raises ConfigError if sounddevice or PortAudio is missing; LinkError if there is no such device, or it does not record at
    this rate.
    """

    triggered = False

    def __init__(self, device: str, rate_hz: float, full_scale: float) -> None:
        self.rate_hz = rate_hz
        self._full_scale = full_scale
        self._device = device
        try:
            import sounddevice  # noqa: PLC0415 - of the extra `measure`, with the library PortAudio
        except OSError as error:
            raise ConfigError(f"sounddevice needs PortAudio ({error}): apt install libportaudio2") from error
        self._sounddevice: Any = sounddevice
        self._track: Any = None
        try:
            sounddevice.check_input_settings(device=device, channels=2, dtype="float32", samplerate=rate_hz)
        except (ValueError, sounddevice.PortAudioError) as error:
            raise LinkError(f"sound card {device!r} does not record two tracks at {rate_hz:g} Hz: {error}") from error

    def begin(self, samples: int, _alive: Callable[[], None]) -> None:
        """Begin to record; PortAudio's thread does it."""
        try:
            self._track = self._sounddevice.rec(
                samples, samplerate=self.rate_hz, channels=2, dtype="float32", device=self._device, blocking=False
            )
        except self._sounddevice.PortAudioError as error:
            raise LinkError(f"sound card {self._device!r}: {error}") from error

    def read(self, _alive: Callable[[], None]) -> Floats:
        """(sample, 2), in the sensor's unit."""
        status = self._sounddevice.wait()
        if status:
            raise CalibrationError(f"sound card {self._device!r} has lost samples ({status}): end other work, or lower the rate")
        if np.abs(self._track).max() >= 1:
            raise CalibrationError(f"sound card {self._device!r}: a track is clipped: lower its gain")
        both: Floats = np.asarray(self._track, np.float64) * np.array([self._full_scale, 1.0])
        return both

    def close(self) -> None:
        """Stop recording."""
        self._sounddevice.stop()


class SerialRecorder:
    r"""A sensor at a serial port, whose trigger input is wired to the FPGA's trigger.

    The host asks, each question a line ended by \n:

    - `?`: the sensor answers `SENSOR 1 RATE FULL_SCALE MOST`: samples a second, what 32,768 stands for in the sensor's unit, and
      the most samples of a record.
    - `R N`: it answers `OK`, or `ERROR` and why; after the trigger's edge it sends N samples of 16 bits, lowest byte first, and
      the CRC-32 (zlib) of these bytes, lowest byte first.

    Raises LinkError if the port cannot be opened, or no such sensor answers.
    """

    triggered = True

    def __init__(self, device: str, baud: int) -> None:
        import serial  # noqa: PLC0415 - a driver

        self._device, self._samples = device, 0
        try:
            self._port = serial.Serial(device, baud, timeout=POLL_S, exclusive=True)
            self._port.reset_input_buffer()
            self._port.write(b"?\n")
            said = self._line(_nobody)
        except (serial.SerialException, OSError) as error:
            raise LinkError(f"sensor at {device}: {error}") from error
        found = GREETING.fullmatch(said)
        try:
            if found is None:
                raise ValueError
            self.rate_hz, self._full_scale, self._most = float(found[1]), float(found[2]), int(found[3])
            if not (1e3 <= self.rate_hz <= 1e9 and 0 < self._full_scale < 1e12):
                raise ValueError
        except ValueError:
            self.close()
            raise LinkError(
                f"sensor at {device}: answers {said[:60]!r}, not SENSOR 1 and rate, full scale, most samples: is it that port?"
            ) from None

    def begin(self, samples: int, alive: Callable[[], None]) -> None:
        """Have the sensor wait for the trigger."""
        if samples > self._most:
            raise CalibrationError(f"sensor at {self._device}: it holds {self._most} samples, not {samples}: shorten --record-ms")
        self._samples = samples
        self._port.reset_input_buffer()  # of a record that was given up
        self._port.write(b"R %d\n" % samples)
        said = self._line(alive)
        if said != b"OK\n":
            raise CalibrationError(f"sensor at {self._device}: {said[:60].decode(errors='replace').strip() or 'does not answer'}")

    def read(self, alive: Callable[[], None]) -> Floats:
        """(sample, 1), in the sensor's unit."""
        size = 2 * self._samples
        until_s, data = time.monotonic() + 10 * size / self._port.baudrate + ANSWER_S, b""
        while len(data) < size + 4 and time.monotonic() < until_s:
            data += self._port.read(min(size + 4 - len(data), max(self._port.in_waiting, 1)))
            alive()
        if len(data) < size + 4:
            raise CalibrationError(
                f"sensor at {self._device}: {max(len(data) - 4, 0) // 2} of {self._samples} samples: is its trigger input wired?"
            )
        if not intact(data):
            raise CalibrationError(f"sensor at {self._device}: its samples arrived damaged (CRC): shorten the cable, lower --baud")
        return np.frombuffer(data[:size], "<i2")[:, None] * (self._full_scale / 32768)

    def close(self) -> None:
        """Close the port."""
        self._port.close()

    def _line(self, alive: Callable[[], None]) -> bytes:
        """The next line; what there is of it if it does not end in time."""
        until_s, said = time.monotonic() + ANSWER_S, b""
        while not said.endswith(b"\n") and len(said) < MOST_LINE_BYTES and time.monotonic() < until_s:
            said += self._port.read(1)
            alive()
        return said


def _nobody() -> None:
    """Nobody waits."""
