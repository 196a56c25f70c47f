"""The bit clock follows the plate's temperature, in the turns of the event loop."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from controller.device.fpga.session import Session
from controller.device.loop.event_loop import EventLoop
from controller.log import Event, log

if TYPE_CHECKING:
    from controller.device.service.temperature import Thermometer

FIRST_S: Final = 0.1  # between attempts until the first temperature
LEAST_STEP: Final = 20e-6  # of the scale: costs 1e-5 of the amplitude, and a repetition is not interrupted for a sensor's noise


class BitClock:
    """Scales an FPGA's bit clock as the thermometer says, whenever nothing plays; it is read every `period_s`."""

    def __init__(self, session: Session, thermometer: Thermometer, period_s: float) -> None:
        self.scale = 1.0  # factor of the bit clock that the FPGA uses now
        self.temperature_c: float | None = None  # of the plate; None while unknown
        self._session = session
        self._thermometer = thermometer
        self._period_s = period_s
        self._read_s = -math.inf
        self._wanted = 1.0
        self._cause = ""

    def follow(self, loop: EventLoop, now_s: float) -> None:
        """Read the thermometer if that is due, and set the bit clock if it differs; call it while the FPGA can be reached.

        A setting that the FPGA cannot take while it plays is made in a later turn. A repetition, which leaves it no time, is
        interrupted.
        """
        if self._read_s <= now_s:
            self._read(now_s)
        if self._wanted == self.scale:
            return
        if self._session.set_bit_period(self._wanted):
            self.scale = self._wanted
            loop.stretch(1 / self.scale)
        else:
            loop.pause_repetition(now_s)

    def _read(self, now_s: float) -> None:
        wanted, temperature_c = self._thermometer.scale(now_s), self._thermometer.temperature_c
        unknown = math.isnan(temperature_c) and not self._thermometer.cause  # the sensor has not answered yet
        self._read_s = now_s + (min(FIRST_S, self._period_s) if unknown else self._period_s)
        self.temperature_c = None if math.isnan(temperature_c) else temperature_c
        self._wanted = wanted if abs(wanted - self.scale) >= LEAST_STEP else self.scale
        if self._thermometer.cause != self._cause:
            self._cause = self._thermometer.cause
            if self._cause:
                log(self._cause, Event.SENSOR_LOST)
            else:
                log("the temperature sensor is read again", Event.SENSOR_BACK)
