"""The far end of the guest's I2C bus: a touch controller from its data sheet, with its interrupt and reset pins on GPIO lines."""

import contextlib
import errno
import os
import select
import struct
import threading
from pathlib import Path

READ = 0x0001  # I2C_M_RD
POLL_MS = 1  # how often the pins that the host drives are looked at
HANG_MS = 60  # what labdev waits for an answer, as an adapter's timeout


def bus_path():
    """Device of the adapter whose far end is a program."""
    for bus in Path("/sys/bus/i2c/devices").glob("i2c-*"):
        if (bus / "name").read_text() == "labdev i2c\n":
            return f"/dev/{bus.name}"
    raise AssertionError("no labdev adapter")


class FarEnd:
    """Serves one chip from a thread until it is closed.

    Parameters
    ----------
    chip : RegisterChip
        With `pins(reset, interrupt)` if it looks at what the host drives.
    lines : GpioLines
        With TOUCH_INT and TOUCH_RST.
    """

    def __init__(self, chip, lines):
        self.chip = chip
        self.lines = lines
        self.lock = threading.Lock()
        Path("/sys/module/labdev/parameters/timeout_ms").write_text(str(HANG_MS))
        self._far_end = os.open("/dev/labi2c", os.O_RDWR)
        self._stop = False
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def touch(self, held, pulse=True, **more):
        """Let the chip find these contacts and, if it has a report of them, say so by its interrupt pin."""
        with self.lock:
            reported = self.chip.touch(held, **more)
        if reported is not False and pulse:
            self.lines.pull("TOUCH_INT", 0)
            self.lines.pull("TOUCH_INT", 1)

    def close(self):
        """End the thread; nobody answers on the bus from then on."""
        self._stop = True
        self._thread.join(5.0)
        assert not self._thread.is_alive()
        os.close(self._far_end)

    def _serve(self):
        poll = select.poll()
        poll.register(self._far_end, select.POLLIN)
        reset = True
        while not self._stop:
            if hasattr(self.chip, "pins"):
                reset_before = reset
                interrupt_before = bool(self.lines.value("TOUCH_INT"))
                reset = bool(self.lines.value("TOUCH_RST"))
                if reset != reset_before:
                    interrupt = bool(self.lines.value("TOUCH_INT")) or interrupt_before
                    with self.lock:
                        self.chip.pins(reset=reset, interrupt=interrupt)
            if poll.poll(POLL_MS):
                self._answer(os.read(self._far_end, 1 << 16))

    def _answer(self, request):
        messages = []
        (count,) = struct.unpack_from("<I", request)
        start = 4
        for _ in range(count):
            address, flags, length = struct.unpack_from("<HHH", request, start)
            start += 6
            if flags & READ:
                messages.append((address, flags, length))
            else:
                messages.append((address, flags, request[start : start + length]))
                start += length
        try:
            with self.lock:
                answer = struct.pack("<i", count) + self.chip.transfer(messages)
        except Exception as fault:
            if type(fault).__name__ == "BusHangs":
                return  # labdev's time runs out
            answer = struct.pack("<i", -errno.ENXIO)
        with contextlib.suppress(OSError):
            os.write(self._far_end, answer)
