"""Runs in the guest: boards/ulx3s/top.v, compiled with its bitstream's parameters, behind the kernel's spidev and GPIO lines.

SpiLink and board.toml are the product's own. The host computes the board; its time passes with each frame and when it is reported.
"""

import multiprocessing
import os
import selectors
import sys
import time
from functools import cache
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "board_top"))
from compiled_top import channels_of, files, signal_pins
from far_end_spi import HEADER, REQUEST_BYTES, GpioTrace
from gpio_lines import GpioLines
from host_gateware import ask

from controller.device.board.lookup import data_folder
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.frames import Play
from controller.device.fpga.links.spi_link import SpiLink
from controller.device.fpga.registers import Register, State
from controller.device.fpga.session import Session
from controller.errors import LinkError

ULX3S, WIRES = files("ulx3s").board, files("ulx3s").wires
LINK = ULX3S.link
NAMES = [f"GPIO{number}" for number in range(28)]
SPI = [WIRES[name] for name in ("GPIO11", "GPIO8", "GPIO10", "GPIO9")]
WORDS = np.random.default_rng(5).integers(0, 1 << 32, ULX3S.waveform.samples, dtype=np.uint32).repeat(8)[: ULX3S.waveform.samples]
US = 1_000_000  # in ps


@cache
def lines():
    """The Pi's lines."""
    return GpioLines(LINK.gpio_chip, NAMES)


def setup_module():
    lines()
    Path("/sys/module/labdev/parameters/timeout_ms").write_text("20000")


class FarEnd:
    """The board at the other ends of the Pi's wires, in a process of its own: its `configured` line drives the Pi's."""

    def __init__(self):
        context = multiprocessing.get_context("fork")
        self._pipe, theirs = context.Pipe()
        context.Process(target=self._serve, args=(theirs,), daemon=True).start()
        assert self._pipe.recv() == "ready"

    def board(self, what, *arguments):
        """Have something done with the board, behind all that came to its pins before."""
        self._pipe.send((what, arguments))
        return self._pipe.recv()

    def now_s(self):
        return self.board("board_now_s")

    def _serve(self, pipe):
        trace = GpioTrace(LINK.gpio_chip, NAMES)
        device = os.open("/dev/labspi", os.O_RDWR)
        ask("board_open")
        ask("board_oscillate", 0)
        ask("board_drive", signal_pins()["temperature good"] | WIRES["GPIO8"], 1)
        outputs = {name: WIRES[name] for name in (LINK.trigger_line, LINK.permit_line)}
        with selectors.DefaultSelector() as selector:
            for file in (device, trace.fd, pipe):
                selector.register(file, selectors.EVENT_READ)
            self._show_configured()
            pipe.send("ready")
            while True:
                due = {key.fileobj for key, _ in selector.select()}
                request = os.read(device, REQUEST_BYTES) if device in due else None
                for _, name, level in trace.read():  # what happened before that transfer
                    if name in outputs:
                        ask("board_drive", outputs[name], level)
                        ask("board_run", US)
                if request is not None:
                    speed_hz, size, *_ = HEADER.unpack_from(request)
                    os.write(device, ask("board_exchange", SPI, request[HEADER.size : HEADER.size + size], speed_hz))
                if pipe in due:
                    what, arguments = pipe.recv()
                    pipe.send(ask(what, *arguments))
                self._show_configured()

    @staticmethod
    def _show_configured():
        lines().pull(LINK.configured_line, int(ask("board_high", WIRES[LINK.configured_line])))


@cache
def far_end():
    return FarEnd()


@cache
def session():
    return Session(SpiLink(LINK, far_end().now_s), ULX3S, build_hash(data_folder("fpga_rtl")), far_end().now_s)


def high(name):
    return far_end().board("board_high", signal_pins()[name])


def refusal():
    """What is said of a link that cannot be opened."""
    try:
        SpiLink(LINK, time.monotonic)
    except LinkError as error:
        return str(error)
    return ""


def test_it_is_not_opened_while_it_has_no_clock():
    assert not high("configured")
    assert "is not configured: its line 'GPIO24' is low" in refusal()
    far_end().board("board_oscillate", 1)
    far_end().board("board_run", 3 * US)
    assert high("configured")


def test_it_is_known_and_armed():
    read = session().exchange.read
    assert read(Register.BOARD).to_bytes(4, "big") == b"ULX3"
    assert (read(Register.CLOCK_HZ), read(Register.GEOMETRY) & 0xFF) == (LINK.clock_hz, LINK.slots)
    armed_s = session().arm()
    while far_end().now_s() < armed_s:
        far_end().board("board_run", 2000 * US)
        session().heartbeat()
    session().require_armed()
    assert high("hv_enable")


def test_an_upload_plays_bit_for_bit_on_the_32_pins_behind_the_trigger_line():
    session().upload(3, memoryview(WORDS).cast("B"))
    session().play(Play(3), stop=False)
    assert State.WAITING in session().heartbeat().state
    far_end().board("board_take")
    session().trigger()
    emission_ps = round(ULX3S.waveform.duration_ms * 1e-3 * 1e12)
    while session().heartbeat().emissions == 0:
        far_end().board("board_run", emission_ps // 4)
    times, pins = far_end().board("board_take")
    times, words = times.astype(np.int64), channels_of(pins)
    changed = np.diff(words, prepend=np.uint32(ULX3S.idle_word)) != 0
    times, words = times[changed], words[changed]
    starts = times[0] + np.arange(len(WORDS)) * emission_ps // len(WORDS)
    assert np.array_equal(words[np.searchsorted(times, starts + 1, side="right") - 1], WORDS)
    assert (times[-1], words[-1]) == (times[0] + emission_ps, ULX3S.idle_word)


def test_without_the_hosts_permit_it_is_off():
    session().link.close()
    far_end().board("board_run", US)
    assert not high("hv_enable")
    assert not high("run permit")
