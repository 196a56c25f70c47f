"""Runs in the guest: two FPGAs of one panel on the kernel's own spidev, a chip select each, and on shared GPIO lines.

The gateware's model is at both far ends, on the wires of boards/simulated_64: one trigger line, one line of run permit and faults.
In one test it is the compiled Verilog, whose clock is 1 MHz as in guest_gateware.py.
"""

import contextlib
import json
import re
import subprocess
import sys
import time
from functools import cache
from pathlib import Path

import gpiod
import msgspec
import numpy as np
from evdev import AbsInfo, UInput
from evdev import ecodes as e
from far_end_spi import FarEnd
from gpio_lines import GpioLines
from guest_gateware import at_1_mhz
from guest_link import BIND, CLOCK, SLOWNESS, TIMEOUT_MS, refusal
from host_gateware import HostGateware
from panel_board import table

from controller.clocks import MonotonicClock
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.devices import LinkedFpga, LinkSettings
from controller.device.board.lookup import find_board, fpga_files
from controller.device.doctor.doctor import look
from controller.device.fpga.exchange import FpgaReset, OutOfStep
from controller.device.fpga.frames import Play, joined
from controller.device.fpga.registers import Fault, Start
from controller.device.loop.context import LoopContext
from controller.device.loop.outputs import Outputs
from controller.device.service.drivers import await_session, open_link
from controller.errors import ControllerError, FaultError, LinkError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.gateware.wired_fpgas import LINE_TICKS

NAMES = ["TRIGGER", "PERMIT", "CONFIGURED0", "CONFIGURED1"]
SIMULATED = load_board(find_board("simulated_64"))
LINK = LinkSettings(
    kind="spi",
    clock_hz=80_000_000,
    sck_hz=25_000_000,
    slots=4,
    gpio_chip="pair",
    trigger_line="TRIGGER",
    permit_line="PERMIT",
    fpga=(
        LinkedFpga(device="/dev/spidev0.0", configured_line="CONFIGURED0"),
        LinkedFpga(device="/dev/spidev0.1", configured_line="CONFIGURED1"),
    ),
)
BOARD = msgspec.structs.replace(SIMULATED, link=LINK, limits=msgspec.structs.replace(SIMULATED.limits, heartbeat_timeout_ms=250.0))
PARTS = [np.random.default_rng(seed).integers(0, 1 << 32, 1000, dtype=np.uint32).tobytes() for seed in (7, 8)]
WORDS = joined([memoryview(part) for part in PARTS])


@cache
def lines():
    """The chip with the lines of the panel."""
    chip = GpioLines("pair", NAMES)
    for number in range(2):
        chip.pull(f"CONFIGURED{number}", 1)
    return chip


def setup_module():
    lines()
    TIMEOUT_MS.write_text("20000")


@contextlib.contextmanager
def unplugged():
    """The second FPGA's chip select is not there."""
    (BIND / "unbind").write_text("spi0.1")
    try:
        yield
    finally:
        (BIND / "bind").write_text("spi0.1")


def with_fpga(number, **changes):
    """The board with another table of one FPGA."""
    fpga = list(LINK.fpga)
    fpga[number] = msgspec.structs.replace(fpga[number], **changes)
    return msgspec.structs.replace(BOARD, link=msgspec.structs.replace(LINK, fpga=tuple(fpga)))


class Panel:
    """Far ends, links and session as the service has them."""

    def __init__(self, far_end, board=BOARD, clock=CLOCK):
        self.far_end, self.board, self.clock = far_end, board, clock
        self.parts = [part[: 4 * board.waveform.samples] for part in PARTS]
        self.link, self.session = await_session(board, clock.now_s)
        self.outputs = Outputs(LoopContext(board, clock, self.session, None))

    def come_on(self):
        """As the loop does it, without waiting in between; what is said while it does not."""
        said = []
        while not self.outputs.on:
            try:
                self.outputs.advance(self.clock.now_s())
            except (LinkError, FaultError) as error:
                self.outputs.failed(error, self.clock.now_s())
            if self.outputs.cause and self.outputs.cause not in said:
                said.append(self.outputs.cause)
        return said

    def lost(self):
        """The error by which heartbeats find that something is wrong."""
        while True:
            try:
                self.session.heartbeat()
            except ControllerError as error:
                return error

    def recover(self, error):
        self.outputs.failed(error, self.clock.now_s())
        return self.come_on()

    def hv(self):
        return [self.far_end.pins(number)["hv"] for number in range(2)]

    def plays(self):
        """Plays by the trigger, then at a time; both FPGAs have their own words on their pins in the same ticks."""
        for number in range(2):
            self.far_end.emissions(number)
        begun = len(self.far_end.pins()["starts"])
        before = self.session.heartbeat().emissions
        self.session.upload_and_play(Play(1), joined([memoryview(part) for part in self.parts]), stop=False)
        self.session.trigger()
        while self.session.heartbeat().emissions < before + 1:
            pass
        when = self.session.heartbeat().timestamp_ticks + self.board.link.clock_hz // 20
        self.session.play(Play(1, start=Start.TIME, when_ticks=when), stop=False)
        while self.session.heartbeat().emissions < before + 2:
            pass
        starts = [self.far_end.pins(number)["starts"][-2:] for number in range(2)]
        assert starts[0] == starts[1], starts
        assert len(self.far_end.pins()["starts"]) == begun + 2
        for number, part in enumerate(self.parts):
            assert self.far_end.emissions(number) == [part, part]

    def close(self):
        self.link.close()
        self.far_end.close()


def panel():
    return contextlib.closing(Panel(FarEnd(BOARD, NAMES, slowness=SLOWNESS)))


def test_all_links_are_open_or_none_and_only_then_is_the_permit_given():
    with unplugged():
        assert "there is no /dev/spidev0.1 (there are: /dev/spidev0.0)" in refusal(lambda: open_link(BOARD, CLOCK.now_s))
    lines().pull("CONFIGURED1", 0)
    assert "is not configured: its line 'CONFIGURED1' is low" in refusal(lambda: open_link(BOARD, CLOCK.now_s))
    lines().pull("CONFIGURED1", 1)
    alias = Path("/run/second-fpga")
    alias.symlink_to("/dev/spidev0.0")
    same = with_fpga(1, device=str(alias))
    assert "/run/second-fpga is /dev/spidev0.0, as is that of another FPGA" in refusal(lambda: open_link(same, CLOCK.now_s))
    with gpiod.request_lines(f"/dev/{lines().chip}", consumer="oscilloscope", config={"CONFIGURED1": None}):
        assert "'CONFIGURED1' of GPIO chip 'pair' is in use by oscilloscope" in refusal(lambda: open_link(BOARD, CLOCK.now_s))
    assert lines().value("PERMIT") == 0
    link = open_link(BOARD, CLOCK.now_s)
    assert lines().value("PERMIT") == 1
    assert "in use by another" in refusal(lambda: open_link(BOARD, CLOCK.now_s))
    assert lines().value("PERMIT") == 1
    link.close()
    assert lines().value("PERMIT") == 0


def test_it_comes_on_when_the_last_is_there_and_all_pins_play_in_the_same_tick():
    with panel() as there:
        with unplugged():
            there.outputs.advance(CLOCK.now_s())
            assert "there is no /dev/spidev0.1" in there.outputs.cause
            assert there.hv() == [0, 0]
        there.come_on()
        assert there.hv() == [1, 1]
        there.plays()
        there.outputs.disarm()
        while not there.outputs.ramped_down(CLOCK.now_s()):
            pass
        assert there.hv() == [0, 0]


def test_one_without_supply_shuts_the_other_is_named_and_both_come_back_in_step():
    with panel() as there:
        there.come_on()
        there.far_end.reset(dark_s=0.6, number=1)
        time.sleep(1e-3 * SLOWNESS)
        assert there.hv() == [0, 0], "by the wire, before this host has noticed"
        error = there.lost()
        assert "FPGA 1: only ones came back" in str(error), error
        assert any("FPGA 1" in said for said in there.recover(error))
        there.far_end.reset(number=0)
        error = there.lost()
        assert isinstance(error, FpgaReset), error
        assert str(error).startswith("FPGA 0: the FPGA was reset")
        there.recover(error)
        assert there.hv() == [1, 1]
        there.plays()


def test_one_that_is_unplugged_takes_the_permit_from_both_until_both_answer():
    with panel() as there:
        there.come_on()
        with unplugged():
            error = there.lost()
            assert "FPGA 1: /dev/spidev0.1 was removed" in str(error), error
            assert lines().value("PERMIT") == 0
            assert there.hv() == [0, 0]
            there.outputs.failed(error, CLOCK.now_s())
            there.session.exchange.stop()  # a message to the first one succeeds
            assert lines().value("PERMIT") == 0
        there.come_on()
        assert lines().value("PERMIT") == 1
        there.plays()


def test_a_bus_that_is_stuck_to_one_is_the_cause_that_is_said():
    with panel() as there:
        there.come_on()
        there.far_end.wire("stuck", 1)
        TIMEOUT_MS.write_text("300")
        try:
            error = there.lost()
        finally:
            TIMEOUT_MS.write_text("20000")
        assert "FPGA 1: /dev/spidev0.1: the SPI controller did not finish a transfer" in str(error), error
        assert lines().value("PERMIT") == 0
        assert there.hv() == [0, 0]
        there.far_end.wire("good", 1)
        there.recover(error)
        assert there.hv() == [1, 1]


def test_one_that_misses_the_trigger_is_out_of_step_and_nothing_is_armed_until_it_is_wired():
    with panel() as there:
        there.come_on()
        there.far_end.ask("cut_trigger", 1)
        there.session.upload_and_play(Play(1), WORDS, stop=False)
        there.session.trigger()
        error = there.lost()
        assert isinstance(error, OutOfStep), error
        there.outputs.failed(error, CLOCK.now_s())
        while "FPGA 1 saw 0 edges of the trigger line" not in there.outputs.cause:
            there.outputs.advance(CLOCK.now_s())
        assert not there.outputs.on
        assert there.hv() == [0, 0]


def test_the_verilog_at_both_chip_selects_plays_in_the_same_ticks_and_heat_at_one_shuts_both():
    board = at_1_mhz(BOARD)
    with contextlib.closing(Panel(FarEnd(board, NAMES, HostGateware), board, MonotonicClock())) as there:
        there.come_on()
        assert there.hv() == [1, 1]
        there.plays()
        there.far_end.ask("temperature", 1, False)
        time.sleep(2 * LINE_TICKS / board.link.clock_hz)  # at 1 MHz the line is as slow as the gateware
        assert there.hv() == [0, 0], "by the wire, before this host has noticed"
        error = there.lost()
        assert isinstance(error, FaultError), error
        assert (error.faults, str(error)[:7]) == (Fault.OVER_TEMPERATURE, "FPGA 1:")
        there.far_end.ask("temperature", 1, True)
        there.recover(error)
        assert there.hv() == [1, 1]
        there.plays()


def test_the_doctor_looks_at_each_chip_select_and_at_all_lines():
    findings = {finding.about: finding for finding in look(BOARD, CLOCK.now_s)}
    for about in ("SPI device of FPGA 0", "SPI device of FPGA 1", "GPIO lines"):
        assert findings[about].good, findings[about]
    assert "CONFIGURED0, CONFIGURED1" in findings["GPIO lines"].said
    with unplugged():
        findings = {finding.about: finding for finding in look(BOARD, CLOCK.now_s)}
    assert findings["SPI device of FPGA 0"].good
    assert "there is no /dev/spidev0.1" in findings["SPI device of FPGA 1"].said


SERVED = Path("/run/served")
SERVED_LINK = """kind = "spi"
clock_hz = 10_000_000
sck_hz = 2_500_000
slots = 4
gpio_chip = "pair"
trigger_line = "TRIGGER"
permit_line = "PERMIT"

[[link.fpga]]
device = "/dev/spidev0.0"
configured_line = "CONFIGURED0"

[[link.fpga]]
device = "/dev/spidev0.1"
configured_line = "CONFIGURED1"

[realtime]
priority = 0
lock_memory = false
"""
TOUCH = (
    f'kind = "linux_input"\ndevice = "{NAMES[0]} panel"\nx_mm_from_axes = [210.0, 0.0, 0.0]\ny_mm_from_axes = [0.0, 148.0, 0.0]\n'
)
CLICK = '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n'


def served_board():
    """The board of SERVED, with a bank of few cells for each FPGA; the place of one of them in m, and its entry of each."""
    SERVED.mkdir()
    text = re.sub(r"\n\[\[link\.fpga\]\].*\n", "\n", (SIMULATED.folder / "board.toml").read_text())
    text = table(table(text, "touch", TOUCH), "link", SERVED_LINK)
    text = text.replace("heartbeat_timeout_ms = 100.0", "heartbeat_timeout_ms = 250.0").replace("../simulated/scene", "scene")
    (SERVED / "board.toml").write_text(text)
    (SERVED / "scene.toml").write_text(CLICK)
    board, bank = load_board(SERVED), SERVED / "served.bank"
    for one, path in zip(board.fpga_boards, fpga_files(bank, 2), strict=True):
        build_bank(BankRequest(one, path, 70e-3))
    with Bank.open(bank, board) as opened:
        entries = [bytes(of.drive.words(1)) for of in (opened, *opened.others)]
        return board, opened.grid.place(1), entries


def test_run_plays_what_a_finger_feels_on_both_and_ends_with_all_off():
    board, (x_m, y_m), entries = served_board()
    finger = UInput(
        {e.EV_KEY: [e.BTN_TOUCH], e.EV_ABS: [(axis, AbsInfo(0, 0, 10_000, 0, 0, 0)) for axis in (e.ABS_X, e.ABS_Y)]},
        name=f"{NAMES[0]} panel",
        input_props=[e.INPUT_PROP_DIRECT],
    )
    far_end = FarEnd(board, NAMES)
    command = ["run", "--board", str(SERVED), "--bank", str(SERVED / "served.bank"), "--json"]
    interpreter = [sys.executable, "-m", "controller"]
    service = subprocess.Popen([*interpreter, *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        while [far_end.pins(number)["hv"] for number in range(2)] != [1, 1]:
            assert service.poll() is None, service.communicate()
            time.sleep(0.2)  # one processor computes all of it
        felt = [False, False]
        while not all(felt):
            assert service.poll() is None, service.communicate()
            for down in (1, 0):
                finger.write(e.EV_ABS, e.ABS_X, round(x_m / 0.21 * 10_000))
                finger.write(e.EV_ABS, e.ABS_Y, round(y_m / 0.148 * 10_000))
                finger.write(e.EV_KEY, e.BTN_TOUCH, down)
                finger.syn()
                time.sleep(0.1)
            for number, entry in enumerate(entries):
                felt[number] |= entry in far_end.emissions(number)
    finally:
        service.terminate()
        out, err = service.communicate()
    assert service.returncode == 0, err
    assert json.loads(out)["emissions"] >= 1
    assert [far_end.pins(number)["hv"] for number in range(2)] == [0, 0]
    assert lines().value("PERMIT") == 0
    far_end.close()
