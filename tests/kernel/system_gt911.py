"""Runs in the guest under systemd and udev: the whole service with the parts that have no driver in the kernel.

The panel is a GT911 by its data sheet behind i2c-dev, its interrupt on a GPIO line; the FPGA is the compiled Verilog behind
spidev, computed on the host.
"""

import os
import signal
import sys
from pathlib import Path

import far_end_i2c
import far_end_spi
import panel_board
from gpio_lines import GpioLines
from host_gateware import HostGateware
from the_service import UNIT, cell, fresh_start, install, journal, main_pid, run, said, wait_for, wait_for_emission

from controller.device.application_socket.client import PanelClient
from controller.device.board.board import load_board

sys.path.insert(0, str(Path(__file__).parents[1] / "device/touch"))

from peers.gt911_chip import STATUS, Gt911Chip

LINES = ["TRIGGER", "PERMIT", "TOUCH_INT", "TOUCH_RST"]
LINK = """kind = "spi"
clock_hz = 1_000_000
sck_hz = 500_000
slots = 4
device = "/dev/spidev0.0"
gpio_chip = "panel-lines"
trigger_line = "TRIGGER"
permit_line = "PERMIT"
"""
TOUCH = """kind = "gt911"
bus = "{bus}"
interrupt_chip = "panel-lines"
interrupt_line = "TOUCH_INT"
reset_line = "TOUCH_RST"
"""
CELL = 45  # of the background; another than the beacon's, which is played all the time


class Bench:
    """What stands round the service, from the first test on."""

    def __init__(self):
        install("systemd-modules-load")  # the guest's modules are in its initrd
        panel_board.write(TOUCH.format(bus=far_end_i2c.bus_path()), LINK, min_pulse_us=4.0)
        self.lines = GpioLines("panel-lines", LINES)
        self.lines.pull("TOUCH_INT", 1)
        self.lines.pull("TOUCH_RST", 1)
        self.fpga = far_end_spi.FarEnd(load_board(panel_board.BOARD), LINES, HostGateware)
        self.chip = Gt911Chip(width=2100, height=1480)
        self.panel = far_end_i2c.FarEnd(self.chip, self.lines)
        Path("/sys/module/labdev/parameters/timeout_ms").write_text("8000")  # of both buses

    def tap(self, x_m, y_m):
        """A finger comes, is seen twice, and goes."""
        place = (round(x_m * 1e4), round(y_m * 1e4))
        for held in ({0: place}, {0: place}, {}):
            self.panel.touch(held)
            wait_for("the report to be fetched", lambda: not self.chip.registers[STATUS] & 0x80)

    def finger_is_felt(self, damaged=0):
        """Tap on a cell until its entry in the bank has been on the FPGA's pins, bit for bit; so many frames are damaged first."""
        place, words = cell(CELL)
        self.fpga.ask("damage", damaged)
        wait_for_emission(self.fpga, words, lambda: self.tap(*place))

    def outputs_are(self, on):
        """Wait until the FPGA's outputs are on, or off."""
        wait_for(f"outputs {'on' if on else 'off'}", lambda: self.fpga.pins()["hv"] == on)


def bench(made=[]):  # noqa: B006
    """The one bench."""
    if not made:
        made.append(Bench())
    return made[0]


def teardown_module():
    run("systemctl", "stop", UNIT)  # before its lines are unplugged


def test_it_starts_with_both_of_them():
    bench()
    fresh_start()
    bench().outputs_are(1)
    assert bench().chip.address == 0x5D
    assert bench().lines.value("TOUCH_RST") == 1


def test_a_finger_plays_the_banks_entry_of_its_cell():
    bench().finger_is_felt()


def test_damaged_frames_change_nothing():
    pid = main_pid()
    bench().finger_is_felt(damaged=2)  # two heartbeats, if the finger comes later
    assert main_pid() == pid, journal()
    assert "outputs off" not in said(), said()


def heartbeats():
    """How many the service has given so far."""
    with PanelClient() as panel:
        return panel.figures()["heartbeats"]


def test_a_touch_bus_that_hangs_for_seconds_costs_no_heartbeat():
    """Of an adapter that does not keep to the time it is given: 8 s."""
    pid = main_pid()
    bench().chip.hangs = True
    bench().panel.touch({0: (700, 700)})
    wait_for("the transfer that does not end", lambda: not bench().chip.hangs)
    before = heartbeats()
    wait_for("heartbeats", lambda: heartbeats() >= before + 12)  # a second, at a timeout of 250 ms
    assert bench().fpga.pins()["hv"] == 1
    bench().finger_is_felt()
    assert main_pid() == pid, journal()


def test_stopped_for_a_while_it_goes_on_after_the_fpga_has_switched_off():
    pid = main_pid()
    os.kill(pid, signal.SIGSTOP)
    bench().outputs_are(0)
    os.kill(pid, signal.SIGCONT)
    bench().outputs_are(1)
    bench().finger_is_felt()
    assert main_pid() == pid, journal()
