"""Runs in the guest: the compiled Verilog behind the kernel's spidev, trigger and permit lines.

Its clock is 1 MHz, which the host computes three times as fast; bit clock, SCK and the waveforms are as slow.
"""

import time
from functools import cache
from pathlib import Path

import msgspec
from far_end_spi import FarEnd
from gpio_lines import GpioLines
from host_gateware import HostGateware

from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.devices import LinkSettings
from controller.device.board.lookup import data_folder, find_board
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.exchange import HostSilent, Refused
from controller.device.fpga.frames import Play, pack_nop
from controller.device.fpga.links.spi_link import SpiLink
from controller.device.fpga.registers import Register, Result
from controller.device.fpga.session import Session
from controller.errors import ControllerError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest

NAMES = ["TRIGGER", "PERMIT"]
SETTINGS = LinkSettings(
    kind="spi",
    clock_hz=80_000_000,
    sck_hz=25_000_000,
    slots=4,
    device="/dev/spidev0.0",
    gpio_chip="panel",
    trigger_line="TRIGGER",
    permit_line="PERMIT",
)


def at_1_mhz(board):
    """A board of 80 MHz whose clock, SCK and waveforms are slow enough to be computed."""
    return msgspec.structs.replace(
        board,
        link=msgspec.structs.replace(board.link, clock_hz=1_000_000, sck_hz=500_000),
        waveform=msgspec.structs.replace(board.waveform, bit_clock_hz=250e3),
        limits=msgspec.structs.replace(board.limits, heartbeat_timeout_ms=250.0, min_pulse_us=4.0),
    )


BOARD = at_1_mhz(msgspec.structs.replace(load_board(find_board("simulated")), link=SETTINGS))
BANK, PITCH_M = Path("/run/coarse.bank"), 70e-3


def setup_module():
    build_bank(BankRequest(BOARD, BANK, PITCH_M))
    GpioLines("panel", NAMES)
    Path("/sys/module/labdev/parameters/timeout_ms").write_text("20000")


def raised(action):
    """The error that comes of an action that must not work, done until it comes."""
    try:
        while True:
            action()
    except ControllerError as error:
        return error


class Panel:
    """Far end, link and session, armed; one for all tests, as each costs seconds."""

    def __init__(self):
        self.far_end = FarEnd(BOARD, NAMES, HostGateware)
        self.session = Session(SpiLink(BOARD.link, time.monotonic), BOARD, build_hash(data_folder("fpga_rtl")), time.monotonic)
        self.arm()

    def arm(self):
        armed_s = self.session.arm()
        while time.monotonic() < armed_s:
            self.session.heartbeat()
        self.session.require_armed()

    def level(self, name):
        return self.far_end.pins()[name]


@cache
def panel():
    return Panel()


def test_it_is_known_by_its_identity_configured_and_armed():
    exchange = panel().session.exchange
    assert exchange.read(Register.CLOCK_HZ) == BOARD.link.clock_hz
    assert exchange.read(Register.IDLE_WORD) == BOARD.idle_word
    assert (panel().level("hv"), panel().level("word")) == (1, BOARD.idle_word)


def test_what_the_channel_pins_play_behind_the_trigger_line_is_the_banks_entry_bit_for_bit():
    session = panel().session
    with Bank.open(BANK, BOARD) as bank:
        entries = [bytes(bank.drive.words(cell)) for cell in (0, 1)]
    assert len(entries[0]) == 2000
    assert entries[0] != entries[1]
    for slot, entry in enumerate(entries):
        session.upload(slot, memoryview(entry))
    played = []
    for slot in (0, 1, 0):
        session.play(Play(slot), stop=False)
        assert session.heartbeat().emissions == len(played), "not before its trigger"
        session.trigger()
        played.append(entries[slot])
        while session.heartbeat().emissions < len(played):
            pass
    assert panel().far_end.emissions() == played


def test_a_damaged_frame_is_refused_and_the_next_one_taken():
    exchange = panel().session.exchange
    end = pack_nop(exchange.sent, 0, exchange.sequence)
    end = pack_nop(exchange.sent, end, exchange.sequence + 1)  # brings what became of the first
    panel().far_end.ask("damage", 1)
    error = raised(lambda: exchange.send_short(end))
    assert isinstance(error, Refused), error
    assert error.result is Result.BAD_CRC
    panel().session.heartbeat()


def test_after_silence_it_is_off_by_itself_until_it_is_armed_again():
    while panel().level("hv"):
        pass
    assert panel().level("word") == 0
    assert isinstance(raised(panel().session.heartbeat), HostSilent)
    panel().session.off()
    panel().session.bring_up()
    panel().arm()
    assert panel().level("hv") == 1
