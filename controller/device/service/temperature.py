"""The plate's temperature, and the bit clock that follows from it.

Warm glass is softer and its waves slower: waveforms computed for one temperature are played at another by scaling the bit
clock. Glass follows the room within minutes, so it is enough to read the sensor every few seconds, and to hold a reading for
minutes.
"""

from __future__ import annotations

import errno
import math
from typing import Final

from controller.device.board.devices import Temperature
from controller.device.service.temperature_sensors import Sensor, sensor_of

HOLD_S: Final = 600.0  # the last valid reading is used for this long, then the reference temperature
JUMP_C: Final = 5.0  # largest step between two readings; a larger one is accepted if the next reading confirms it
RETRY_S: Final = 10.0  # after a failure: on a stuck bus each attempt takes BUS_TIMEOUT_MS


class Thermometer:
    """A temperature sensor with a check of its readings, which holds the last valid one while the sensor is missing.

    `sensor` None: the one that the settings name; it may be missing and be connected later.
    """

    def __init__(self, settings: Temperature, sensor: Sensor | None = None) -> None:
        self.temperature_c = math.nan  # the last valid reading; NaN before the first, and once it is older than `HOLD_S`
        self.refused = 0  # readings out of range, or too far from the readings before and after
        self.failed = 0  # attempts that failed
        self.cause = ""  # why the last attempt gave no valid reading; empty if it did
        self._settings = settings
        self._sensor = sensor or sensor_of(settings)
        self.close = self._sensor.close
        self._good_s = -math.inf
        self._doubtful_c = math.nan  # the reading before, if its step was too large
        self._retry_s = -math.inf

    def scale(self, now_s: float) -> float:
        """Read the sensor; returns the factor of the bit clock, 1 while no temperature is known."""
        if now_s >= self._retry_s:
            self._read(now_s)
        if now_s - self._good_s > HOLD_S:
            self.temperature_c = math.nan
        return 1.0 if math.isnan(self.temperature_c) else self._settings.scale(self.temperature_c)

    def _read(self, now_s: float) -> None:
        settings = self._settings
        try:
            reading_c = self._sensor.read_c()
        except OSError as error:
            self.failed += 1
            self._retry_s = now_s + RETRY_S
            self.cause = _why_not(settings, error)
            return
        if reading_c is None:
            return
        if not settings.lowest_c <= reading_c <= settings.highest_c:
            self.refused += 1
            self.cause = f"the temperature sensor says {reading_c:g} °C, outside {settings.lowest_c:g} to {settings.highest_c:g}"
            return
        doubtful_c, self._doubtful_c = self._doubtful_c, math.nan
        if abs(reading_c - self.temperature_c) > JUMP_C and not abs(reading_c - doubtful_c) <= JUMP_C:  # NaN is no jump
            self._doubtful_c = reading_c
            self.refused += 1
            self.cause = f"the temperature sensor jumped from {self.temperature_c:g} to {reading_c:g} °C"
            return
        self.temperature_c = reading_c
        self._good_s = now_s
        self.cause = ""


def _why_not(settings: Temperature, error: OSError) -> str:
    where = settings.device if settings.kind == "hwmon" else f"{settings.device}, address 0x{settings.address:02X}"
    if error.errno == errno.EBUSY:
        return f"the temperature sensor at {where} belongs to a driver of the kernel: set temperature.kind to 'hwmon'"
    if error.errno in (errno.EACCES, errno.EPERM):
        return f"the temperature sensor at {where} may not be read by this user: add it to the group that owns it (on Debian: i2c)"
    if error.errno in (errno.ENXIO, errno.EREMOTEIO, errno.ENODEV, errno.ENOENT):
        return f"no temperature sensor answers at {where} ({error.strerror}): check temperature.device and the wiring"
    return f"the temperature sensor at {where} cannot be read: {error.strerror}"
