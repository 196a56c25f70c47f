"""An Elo SmartSet touch panel at a serial port, and a finger on it."""

import contextlib
import os
import shutil
import struct
import threading
from pathlib import Path

LARGEST = 4095  # of each axis
FIRST, STREAM, LAST = 1, 2, 4  # status of a packet
PERIOD_S = 0.02


class SerialPanel:
    """A touch panel at the port `device`."""

    def __init__(self):
        self._host, self._panel = os.openpty()
        self.device = os.ttyname(self._panel)

    def belongs_to(self, group):
        """Let a group open the port, as udev does."""
        shutil.chown(self.device, group=group)
        Path(self.device).chmod(0o660)

    @contextlib.contextmanager
    def finger(self, places):
        """A finger that goes from place to place (x, y of its axes), 50 times a second, and is lifted at the end."""
        lifted = threading.Event()

        def move():
            status = FIRST
            for place in places:
                self._send(*place, status)
                status = STREAM
                if lifted.wait(PERIOD_S):
                    break
            self._send(*place, LAST)

        thread = threading.Thread(target=move)
        thread.start()
        try:
            yield
        finally:
            lifted.set()
            thread.join()

    def _send(self, x, y, status):
        """A packet: 'U', 'T', status, x, y, z, checksum."""
        body = struct.pack("<2sBHHH", b"UT", status, x, y, 255)
        os.write(self._host, body + bytes([(0xAA + sum(body)) & 0xFF]))
