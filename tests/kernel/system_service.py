"""Runs in the guest under systemd and udev: the whole service, from a finger on an event device to the pins of its FPGA.

The panel is a uinput device, the FPGA the gateware's model behind the kernel's spidev and gpio-sim lines. Times here are
not those of a board: what is asserted is what happens, and in which order.
"""

import os
import signal
from pathlib import Path

import panel_board
from evdev import AbsInfo, UInput
from evdev import ecodes as e
from far_end_spi import FarEnd
from gpio_lines import GpioLines
from the_service import (
    UNIT,
    cell,
    fresh_start,
    install,
    journal,
    main_pid,
    restarted,
    run,
    said,
    shown,
    status_of,
    wait_for,
    wait_for_emission,
)

from controller.device.board.board import load_board

LINES = ["TRIGGER", "PERMIT"]
LINK = """kind = "spi"
clock_hz = 80_000_000
sck_hz = 25_000_000
slots = 4
device = "/dev/spidev0.0"
gpio_chip = "panel-lines"
trigger_line = "TRIGGER"
permit_line = "PERMIT"
"""
NAME = "test panel"
WIDTH, HEIGHT = 2100, 1480  # tenths of a millimetre
CELL = 45  # of the background; another than the beacon's, which is played all the time


PROBE = """import sys
for path in sys.argv[1:]:
    try:
        open(path, 'rb+', buffering=0)
        print('opened', path)
    except OSError as error:
        print(error)
"""


class Panel:
    """A touch panel of the kernel's: protocol B, unplugged by `close`."""

    def __init__(self):
        axes = [
            (e.ABS_X, WIDTH),
            (e.ABS_Y, HEIGHT),
            (e.ABS_MT_SLOT, 9),
            (e.ABS_MT_TRACKING_ID, 65535),
            (e.ABS_MT_POSITION_X, WIDTH),
            (e.ABS_MT_POSITION_Y, HEIGHT),
        ]
        abilities = {e.EV_KEY: [e.BTN_TOUCH], e.EV_ABS: [(code, AbsInfo(0, 0, largest, 0, 0, 0)) for code, largest in axes]}
        self._device = UInput(abilities, name=NAME, input_props=[e.INPUT_PROP_DIRECT])
        self.path = self._device.device.path
        self._touches = 0
        run("udevadm", "settle")

    def tap(self, x_m, y_m):
        """A finger comes, is seen twice, and goes."""
        self._touches += 1
        x, y = round(x_m * 1e4), round(y_m * 1e4)
        self._write((e.ABS_MT_TRACKING_ID, self._touches), (e.ABS_MT_POSITION_X, x), (e.ABS_MT_POSITION_Y, y), down=1)
        self._write((e.ABS_MT_POSITION_X, x + 1), down=1)
        self._write((e.ABS_MT_TRACKING_ID, -1), down=0)

    def close(self):
        """Pull its plug."""
        self._device.close()

    def _write(self, *events, down):
        for code, value in events:
            self._device.write(e.EV_ABS, code, value)
        self._device.write(e.EV_KEY, e.BTN_TOUCH, down)
        self._device.syn()


class Bench:
    """What stands round the service, from the first test on."""

    def __init__(self):
        install("systemd-modules-load")  # the guest's modules are in its initrd
        panel_board.write(f'kind = "linux_input"\ndevice = "{NAME}"', LINK)
        self.lines = GpioLines("panel-lines", LINES)
        self.panel = Panel()
        self.far_end = FarEnd(load_board(panel_board.BOARD), LINES)

    def outputs_are(self, on):
        """Wait until the FPGA's outputs are on, or off."""
        wait_for(f"outputs {'on' if on else 'off'}", lambda: self.far_end.pins()["hv"] == on)

    def running(self):
        """The service with its outputs on; its process. It is started only if need be, as that takes the guest half a minute."""
        pid = main_pid() or fresh_start()
        self.outputs_are(1)
        return pid

    def finger_is_felt(self):
        """Tap on a cell until its entry in the bank has been on the FPGA's pins, bit for bit."""
        place, words = cell(CELL)
        wait_for_emission(self.far_end, words, lambda: self.panel.tap(*place))


def bench(made=[]):  # noqa: B006
    """The one bench."""
    if not made:
        made.append(Bench())
    return made[0]


def test_it_is_installed_and_its_devices_belong_to_its_groups():
    bench()
    groups = {"/dev/spidev0.0": "spi", "/dev/i2c-0": "i2c", f"/dev/{bench().lines.chip}": "gpio", bench().panel.path: "input"}
    for device, group in groups.items():
        assert (Path(device).group(), Path(device).stat().st_mode & 0o777) == (group, 0o660), device


def test_it_may_open_its_own_devices_and_no_others():
    """Asked by a program in the service's place."""
    Path("/dev/labi2c").chmod(0o666)
    probe = Path("/run/probe.py")
    probe.write_text(PROBE)
    probe.chmod(0o644)
    settings = Path(f"/run/systemd/system/{UNIT}.service.d")
    settings.mkdir(parents=True)
    devices = ["/dev/spidev0.0", "/dev/i2c-0", f"/dev/{bench().lines.chip}", bench().panel.path, "/dev/labi2c", "/dev/uinput"]
    (settings / "probe.conf").write_text(
        "[Service]\nType=oneshot\nWatchdogSec=0\nRestart=no\nExecStart=\n"
        f"ExecStart=/opt/haptic-panel/current/venv/bin/python {probe} {' '.join(devices)}\n"
    )
    run("systemctl", "daemon-reload")
    try:
        run("systemctl", "start", UNIT)
        lines = journal().splitlines()
        assert [f"opened {device}" in lines for device in devices] == [True, True, True, True, False, True], lines[-10:]
        assert "[Errno 1] Operation not permitted: '/dev/labi2c'" in lines
    finally:
        (settings / "probe.conf").unlink()
        run("systemctl", "daemon-reload")


def test_it_starts_in_real_time_with_its_outputs_on():
    pid = bench().running()
    assert bench().lines.value("PERMIT") == 1
    assert "not in real time" not in said()
    assert os.sched_getscheduler(pid) == os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
    assert int(status_of(pid, "VmLck").split()[0]) > 0
    assert int(status_of(pid, "CapEff"), 16) == 0


def test_a_finger_is_felt():
    bench().finger_is_felt()


def test_unplugged_and_plugged_in_again_the_panel_goes_on():
    pid = bench().running()
    bench().finger_is_felt()
    bench().panel.close()
    bench().panel = Panel()
    bench().finger_is_felt()
    assert main_pid() == pid


def test_garbage_from_the_fpga_ends_in_outputs_off_and_good_answers_in_normal_work():
    pid = bench().running()
    bench().far_end.wire("noise")
    bench().outputs_are(0)
    bench().far_end.wire("good")
    bench().outputs_are(1)
    bench().finger_is_felt()
    assert main_pid() == pid


def test_an_fpga_that_was_without_supply_is_brought_up_again():
    pid = bench().running()
    before = said().count("waiting for FPGA: ")
    bench().far_end.reset(0.3)
    # whether the outputs are off already is not known yet
    wait_for("the outage said", lambda: said().count("waiting for FPGA: ") > before)
    bench().outputs_are(1)
    bench().finger_is_felt()
    assert main_pid() == pid


def test_killed_it_leaves_the_outputs_off_until_it_is_back():
    pid = bench().running()
    os.kill(pid, signal.SIGKILL)
    bench().outputs_are(0)  # by the FPGA itself: it hears nothing
    wait_for("the restart", lambda: restarted(pid))
    bench().outputs_are(1)
    bench().finger_is_felt()


def test_stopped_for_a_second_it_goes_on_after_the_fpga_has_switched_off():
    pid = bench().running()
    os.kill(pid, signal.SIGSTOP)
    bench().outputs_are(0)
    os.kill(pid, signal.SIGCONT)
    bench().outputs_are(1)
    bench().finger_is_felt()
    assert main_pid() == pid


def test_stopped_it_takes_the_permit_away():
    bench().running()
    run("systemctl", "stop", UNIT)
    assert (shown("Result"), shown("ExecMainStatus")) == ("success", "0")
    bench().outputs_are(0)
    assert bench().lines.value("PERMIT") == 0
