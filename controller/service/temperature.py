"""The plate's temperature and the bit clock that follows from it.

Warm glass is softer and its waves slower: what was computed at one temperature is played at another by scaling its
time. The glass follows the room within minutes, so a sensor is asked every few seconds and may be away for a while.
"""

from __future__ import annotations

import errno
import math
from typing import Final

from controller.board.devices import Temperature
from controller.service.temperature_sensors import Sensor, sensor_of

HOLD_S: Final = 600.0  # the last good reading is kept so long, then the reference temperature is assumed
JUMP_C: Final = 5.0  # between two readings; a larger one is believed when the next one says the same
RETRY_S: Final = 10.0  # after a failure: a stuck bus may hold each attempt up for BUS_TIMEOUT_MS


def bit_clock_scale(settings: Temperature, temperature_c: float) -> float:
    """By how much faster than at the reference temperature to play."""
    return 1 + settings.coefficient_per_k * (temperature_c - settings.reference_c)


class Thermometer:
    """A sensor whose nonsense is refused and whose absence is borne for a while.

    Parameters
    ----------
    settings : Temperature
    sensor : Sensor or None
        None: the one that the settings name; it may be absent, and come later.

    Attributes
    ----------
    temperature_c : float
        The last good reading; NaN before the first and when it has become too old.
    refused : int
        Readings out of range, or apart from the ones around them.
    failed : int
        Attempts at which the sensor could not be read.
    cause : str
        Why the last attempt gave nothing; empty if it did.
    """

    def __init__(self, settings: Temperature, sensor: Sensor | None = None) -> None:
        self.temperature_c = math.nan
        self.refused = 0
        self.failed = 0
        self.cause = ""
        self._settings = settings
        self._sensor = sensor or sensor_of(settings)
        self._good_s = -math.inf
        self._doubtful_c = math.nan  # the reading before, if it was a jump
        self._retry_s = -math.inf

    def scale(self, now_s: float) -> float:
        """Ask the sensor; what the bit clock is to be scaled by, 1 as long as no temperature is known."""
        if now_s >= self._retry_s:
            self._read(now_s)
        if now_s - self._good_s > HOLD_S:
            self.temperature_c = math.nan
        return 1.0 if math.isnan(self.temperature_c) else bit_clock_scale(self._settings, self.temperature_c)

    def close(self) -> None:
        """Let go of the sensor."""
        self._sensor.close()

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
