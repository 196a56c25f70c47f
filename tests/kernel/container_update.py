"""Runs in the container, as root, under a systemd of its own: releases and what becomes of them, while a panel and an FPGA play.

Both outlive the service, and the FPGA notes each emission: how long nothing could be felt is measured there, and printed.
"""

import grp
import itertools
import time
from functools import cache
from pathlib import Path

import panel_board
from far_end_serial import FarEnd
from serial_finger import SerialPanel
from the_service import UNIT, fresh_start, install, run, wait_for

from controller.board.board import load_board
from controller.service.drivers import gateware_hash

TOUCH, FPGA = Path("/run/touch"), Path("/run/fpga")
LINK = f"""kind = "serial"
device = "{FPGA}"
baud = 3_000_000
clock_hz = 80_000_000
sck_hz = 25_000_000
slots = 16
"""


class Bench:
    """What stands round the service, from the first test on."""

    def __init__(self):
        install("udevadm")  # a container has no devices of its own
        panel_board.write(f'kind = "serial_panel"\ndevice = "{TOUCH}"', LINK)
        self.panel = SerialPanel()
        TOUCH.symlink_to(self.panel.device)
        self.panel.belongs_to("dialout")
        self.fpga = FarEnd(load_board(panel_board.BOARD), gateware_hash(), FPGA, grp.getgrnam("dialout").gr_gid)

    def finger(self):
        """A finger to and fro on the plate."""
        return self.panel.finger((x, 2000) for x in itertools.cycle([*range(1000, 3000, 100), *range(3000, 1000, -100)]))


@cache
def bench():
    """The one bench."""
    return Bench()


class Silence:
    """The longest time between two emissions, from before something is done to after it, as `longest_s`."""

    def __enter__(self):
        self._times_s = []
        self._wait_for_one()
        return self

    def __exit__(self, *_):
        self._wait_for_one()
        self.longest_s = max(after - before for before, after in itertools.pairwise(self._times_s))

    def _wait_for_one(self):
        """The emissions up to one from now on."""
        now_s = time.monotonic()

        def emitted():
            self._times_s += bench().fpga.focus_times_s()
            return bool(self._times_s) and self._times_s[-1] > now_s

        wait_for("an emission", emitted)


def test_panel_and_fpga_outlive_the_service():
    bench()
    fresh_start()
    with bench().finger(), Silence() as silence:
        run("systemctl", "restart", UNIT)
    print(f"{silence.longest_s:.2f} s without haptics: a restart")
