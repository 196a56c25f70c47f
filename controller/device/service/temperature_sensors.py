"""Sensors of the plate's temperature: those with a kernel driver (hwmon), the LM75 family on an I2C bus, and either in a process.

A bus may hang or be slow, so the service reads its sensor in a process of its own.
"""

from __future__ import annotations

import contextlib
import ctypes
import errno
import fcntl
import os
import socket
import struct
import time
from pathlib import Path
from typing import Final, Protocol

from smbus2 import SMBus

from controller.device.board.devices import Temperature
from controller.device.board.worker import Worker, WorkerEnded

HWMON: Final = Path("/sys/class/hwmon")
TEMPERATURE_REGISTER: Final = 0  # of the LM75 family
STEP_C: Final = 1 / 256  # value of the lowest of the 16 bits
I2C_RETRIES: Final = 0x0701  # linux/i2c-dev.h
I2C_TIMEOUT: Final = 0x0702
BUS_TIMEOUT_MS: Final = 20
HANGS_S: Final = 5.0  # without an answer, after which the process counts as hanging
ANSWER: Final = struct.Struct("=id")  # errno and temperature in °C, followed by the error's text


class Sensor(Protocol):
    """A temperature sensor."""

    def read_c(self) -> float | None:
        """Temperature in °C; None if a `SensorProcess` has not answered yet.

        Raises OSError if the sensor cannot be read; the next call opens it again.
        """

    def close(self) -> None:
        """Close the sensor."""


class SensorProcess:
    """A sensor read by a process of its own, so that a bus that hangs, or takes 0.7 s as 1-Wire does, delays no heartbeat.

    Each call of `read_c` requests the next reading, so a reading is as old as the time between two calls.

    The worker runs `serve_sensor`.
    """

    def __init__(self, worker: Worker) -> None:
        self._worker = worker
        self.close = worker.close
        self._ask()

    def read_c(self) -> float | None:
        """The reading requested last, in °C; None while it has not arrived."""
        try:
            answer = self._worker.receive()
        except WorkerEnded:
            raise OSError(errno.EPIPE, "the process that reads it has ended") from None
        if answer is None:
            if time.monotonic() - self._asked_s > HANGS_S:
                raise OSError(errno.ETIMEDOUT, "it does not answer, or its bus hangs")
            return None
        number, reading_c = ANSWER.unpack_from(answer)
        said = bytes(answer[ANSWER.size :]).decode(errors="replace")
        self._ask()
        if number:
            raise OSError(number, said)
        return float(reading_c)

    def _ask(self) -> None:
        self._asked_s = time.monotonic()
        self._worker.send(b"?")


def serve_sensor(sensor: Sensor, loop: socket.socket) -> None:
    """Read a sensor at each request of the loop, until its end of the socket is closed; may block."""
    while loop.recv(1):
        try:
            answer = ANSWER.pack(0, sensor.read_c())
        except OSError as error:
            answer = ANSWER.pack(error.errno or errno.EIO, 0.0) + (error.strerror or "").encode()[:1024]
        loop.send(answer)


class Hwmon:
    """A sensor with a kernel driver: sysfs gives thousandths of a degree (Documentation/hwmon/sysfs-interface).

    `device` is the path of a temp*_input, or the name of a chip, of which temp1_input is read.
    """

    def __init__(self, device: str) -> None:
        self._device = device
        self._fd = -1

    def read_c(self) -> float:
        """Temperature in °C."""
        try:
            if self._fd < 0:
                self._fd = os.open(self._path(), os.O_RDONLY | os.O_CLOEXEC)
            return int(os.pread(self._fd, 32, 0)) * 1e-3
        except ValueError:
            self.close()
            raise OSError(errno.EIO, "its reading is not a number") from None
        except OSError:
            self.close()
            raise

    def close(self) -> None:
        """Close the file."""
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1

    def _path(self) -> str:
        if "/" in self._device:
            return self._device
        names = []
        for chip in sorted(HWMON.glob("hwmon*")):
            name = (chip / "name").read_text().strip()
            if name == self._device:
                return str(chip / "temp1_input")
            names.append(name)
        raise OSError(errno.ENODEV, f"no hwmon chip has this name; there are: {', '.join(names) or 'none'}")


class Lm75:
    """LM75, TMP75, TMP102 and compatible chips: register 0 is the temperature, two's complement, most significant byte first.

    Depending on the chip, 9 to 16 bits are significant; the rest are 0 (LM75B datasheet 7.4.3; TMP75 7.5.1.2; TMP102 normal mode).

    `bus` is such as /dev/i2c-1; `address` is 0x48 to 0x4F, by the chip's pins.
    """

    def __init__(self, bus: str, address: int) -> None:
        self._bus_name = bus
        self._address = address
        self._bus: SMBus | None = None

    def read_c(self) -> float:
        """Temperature in °C: one word on the bus, 0.4 ms at 100 kHz."""
        try:
            if self._bus is None:
                self._bus = SMBus(self._bus_name)
                if self._bus.fd is not None:
                    fcntl.ioctl(self._bus.fd, I2C_TIMEOUT, BUS_TIMEOUT_MS // 10)
                    fcntl.ioctl(self._bus.fd, I2C_RETRIES, 0)
            return lm75_c(self._bus.read_word_data(self._address, TEMPERATURE_REGISTER))
        except OSError:
            self.close()
            raise

    def close(self) -> None:
        """Close the bus."""
        if self._bus is not None:
            with contextlib.suppress(OSError):
                self._bus.close()
            self._bus = None


def lm75_c(word: int) -> float:
    """Temperature in °C from an SMBus word; its low byte, which arrives first, is the chip's high byte."""
    return ctypes.c_int16((word & 0xFF) << 8 | word >> 8 & 0xFF).value * STEP_C


def sensor_of(settings: Temperature) -> Sensor:
    """The sensor that the settings name; it may be missing and be connected later."""
    return Hwmon(settings.device) if settings.kind == "hwmon" else Lm75(settings.device, settings.address)
