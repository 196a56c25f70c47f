"""Register access to a device on an I2C bus by combined messages (smbus2 `i2c_rdwr`): a report exceeds an SMBus block."""

from __future__ import annotations

import contextlib
import ctypes
import errno
import fcntl
from collections import Counter
from collections.abc import Iterator
from typing import Any, Final

from controller.errors import TouchError

MAX_ATTEMPTS: Final = 3
# Errors of adapters without an acknowledge: ENXIO, EREMOTEIO (Pi), ENODEV; of a disturbed transfer: EIO, EAGAIN.
# ETIMEDOUT, a bus that hangs, is not retried: each attempt would delay touches once more.
RETRIED_ERRNOS: Final = (errno.ENXIO, errno.EREMOTEIO, errno.ENODEV, errno.EIO, errno.EAGAIN)
# What adapters answer where a device does not acknowledge: a register that it refuses, or no device at all
REFUSED_ERRNOS: Final = (errno.ENXIO, errno.EREMOTEIO, errno.ENODEV, errno.EIO)
I2C_TIMEOUT: Final = 0x0702  # linux/i2c-dev.h, in units of 10 ms
TIMEOUT_10MS: Final = 3  # of the adapter, instead of a second; not every adapter keeps to it


def write_message(address: int, data: bytes) -> Any:
    """A message that writes to a device."""
    import smbus2

    return smbus2.i2c_msg.write(address, data)


@contextlib.contextmanager
def unless_refused() -> Iterator[None]:
    """Go on behind the block if the device does not acknowledge; raises OSError if the bus fails in another way."""
    try:
        yield
    except OSError as error:
        if error.errno not in REFUSED_ERRNOS:
            raise


class Transfer:
    """A read of consecutive registers, with its buffer, made once and used for every report.

    `register` is the address of the first register, as it is sent.
    """

    def __init__(self, address: int, register: bytes, size_bytes: int) -> None:
        import smbus2

        self.messages: tuple[Any, Any] = (write_message(address, register), smbus2.i2c_msg.read(address, size_bytes))
        start = ctypes.addressof(self.messages[1].buf.contents)  # the message keeps its buffer alive
        self.data = memoryview((ctypes.c_uint8 * size_bytes).from_address(start)).cast("B")  # as read last


class I2cBus:
    """An open bus.

    `path` is such as /dev/i2c-1; `warnings` counts `bus_retried`. Raises TouchError if it cannot be opened, or its adapter has no
    combined messages.
    """

    def __init__(self, path: str, warnings: Counter[str]) -> None:
        import smbus2

        self._warnings = warnings
        try:
            self._bus = smbus2.SMBus(path)
        except OSError as error:
            raise TouchError(_open_error(path, error)) from error
        if not self._bus.funcs & smbus2.I2cFunc.I2C:
            self._bus.close()
            raise TouchError(f"the adapter of {path} has no plain I2C transfers, which the touch panel needs; use another bus")
        assert self._bus.fd is not None
        with contextlib.suppress(OSError):
            fcntl.ioctl(self._bus.fd, I2C_TIMEOUT, TIMEOUT_10MS)

    def fetch(self, transfer: Transfer) -> None:
        """Read into the buffer of a `transfer`; raises OSError if the last attempt fails."""
        self._run(transfer.messages)

    def read(self, address: int, register: bytes, size_bytes: int) -> bytes:
        """Read registers once; raises OSError if the last attempt fails."""
        transfer = Transfer(address, register, size_bytes)
        self.fetch(transfer)
        return bytes(transfer.data)

    def ask(self, address: int, register: bytes, size_bytes: int) -> bytes | None:
        """Read registers that the device may lack; None if it does not acknowledge them.

        Raises OSError if the bus fails in another way.
        """
        with unless_refused():
            return self.read(address, register, size_bytes)
        return None

    def offer(self, address: int, data: bytes) -> bool:
        """Write registers that the device may lack; False if it does not acknowledge them.

        Raises OSError if the bus fails in another way.
        """
        with unless_refused():
            self.write(address, data)
            return True
        return False

    def send(self, message: Any) -> None:
        """Send a `message` made with `write_message`; raises OSError if the last attempt fails."""
        self._run((message,))

    def write(self, address: int, data: bytes) -> None:
        """Write registers: `data` is the register's address and the values; raises OSError if the last attempt fails."""
        self.send(write_message(address, data))

    def close(self) -> None:
        """Close the bus."""
        self._bus.close()

    def _run(self, messages: tuple[Any, ...]) -> None:
        for attempt in range(1, MAX_ATTEMPTS + 1):
            try:
                self._bus.i2c_rdwr(*messages)
            except OSError as error:
                if attempt == MAX_ATTEMPTS or error.errno not in RETRIED_ERRNOS:
                    raise
                self._warnings["bus_retried"] += 1
            else:
                return


def _open_error(path: str, error: OSError) -> str:
    if error.errno in (errno.EACCES, errno.EPERM):
        return f"{path} may not be opened by this user: add it to the group that owns the device (on Debian: i2c)"
    if error.errno in (errno.ENOENT, errno.ENODEV, errno.ENXIO):
        return f"there is no I2C bus {path}: is it enabled (on a Pi: dtparam=i2c_arm=on) and i2c-dev loaded?"
    return f"{path} cannot be opened as an I2C bus ({error.strerror})"
