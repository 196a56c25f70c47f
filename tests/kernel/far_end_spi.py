"""What stands at the far end of the guest's SPI and GPIO wires: gateware, computed, in a process of its own.

Each transfer that labdev hands over is one chip-select assertion of the gateware; its trigger and permit pins follow
the lines of a gpio-sim chip, by the kernel's own trace of each level that a line is given. A board of several FPGAs has
gateware at each chip select, on the wires of boards/simulated_64: `number` says which of them.
"""

import contextlib
import multiprocessing
import os
import re
import selectors
import struct
import time
from pathlib import Path

import numpy as np
from host_gateware import HostGateware
from restarting_gateware import RestartingGateware

from controller.device.board.lookup import data_folder
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.pin_timing import SELECT_HIGH_TICKS, TRIGGER_PERIOD_TICKS, frame_ticks
from controller.workshop.gateware.wired_fpgas import WiredFpgas

HEADER = struct.Struct("<IIII")  # of labdev: speed in Hz, bytes, mode, whether chip select rises behind it
REQUEST_BYTES = 1 << 16
TRACES = Path("/sys/kernel/tracing")
TRACED = re.compile(r" (\d+\.\d+): gpio_value: (\d+) set (\d)")
LEAD_TICKS = 10  # of chip select around a frame's bits
NOISE = np.random.default_rng(1)


def inverted(answer, _):
    return bytes(byte ^ 0xFF for byte in answer)


def late(answer, _):
    return (int.from_bytes(answer, "big") >> 1).to_bytes(len(answer), "big")


WIRES = {  # what becomes of an answer on its way
    "good": lambda answer, _: answer,
    "zeros": lambda answer, _: bytes(len(answer)),
    "ones": lambda answer, _: b"\xff" * len(answer),
    "joined": lambda _, sent: sent,
    "noise": lambda answer, _: NOISE.bytes(len(answer)),
    "inverted": inverted,
    "late": late,
}


class GpioTrace:
    """Levels given to the lines of a chip, as the kernel traces them: (time on CLOCK_MONOTONIC in s, name, level)."""

    def __init__(self, label, names):
        if not (TRACES / "instances").is_dir():
            os.system(f"mount -t tracefs tracefs {TRACES}")
        self._folder = TRACES / "instances" / label
        self._folder.mkdir(exist_ok=True)  # one that a killed far end has left behind serves as well
        base = next(int((chip / "base").read_text()) for chip in _chips() if (chip / "label").read_text().strip() == label)
        self._names = {base + offset: name for offset, name in enumerate(names)}
        (self._folder / "trace").write_text("")  # but for what is in it
        (self._folder / "trace_clock").write_text("mono")
        (self._folder / "buffer_percent").write_text("0")  # whoever waits is woken by the first line
        (self._folder / "events/gpio/gpio_value/enable").write_text("1")
        self.fd = os.open(self._folder / "trace_pipe", os.O_RDONLY | os.O_NONBLOCK)

    def read(self):
        """What has come since the last call."""
        text = b""
        with contextlib.suppress(BlockingIOError):
            while piece := os.read(self.fd, 1 << 16):
                text += piece
        found = [(float(at), self._names.get(int(number)), int(level)) for at, number, level in TRACED.findall(text.decode())]
        return [entry for entry in found if entry[1] is not None]

    def close(self):
        os.close(self.fd)
        self._folder.rmdir()


def _chips():
    return Path("/sys/class/gpio").glob("gpiochip*")


class _Pins:
    """What the outputs of one FPGA have done so far."""

    def __init__(self, gateware, words, word_ticks):
        self._gateware, self._words, self._word_ticks = gateware, words, word_ticks
        self.hv = self.word = self.focus = 0
        self._recent = np.zeros(0, np.int64), np.zeros(0, np.uint32)  # ticks and channel pins of the last changes
        self.emissions = []  # drive words
        self.starts = []  # tick at which each ended emission had begun

    def note(self):
        """Note what they did since this was last done."""
        capture = self._gateware.take_capture()
        ticks = np.concatenate([self._recent[0], capture.ticks.astype(np.int64)])
        levels = np.concatenate([self._recent[1], capture.words])
        if capture.ticks.size:
            self.hv, self.word = int(capture.hv[-1]), int(capture.words[-1])
        foci = capture.focus_ticks.astype(np.int64)
        self.focus += foci.size
        sampled = np.arange(-self._words, 0) * self._word_ticks
        for focus in foci:
            self.emissions.append(levels[np.searchsorted(ticks, focus + sampled, side="right") - 1].astype("<u4").tobytes())
            self.starts.append(int(focus + sampled[0]))
        begun = slice(-self._words - 1, None)  # an emission that has not ended, and what was before it
        self._recent = ticks[begun], levels[begun]


def _gateware_of(factory, parameters):
    """The gateware that can be restarted, and all of it as its lines reach it; the compiled pair is wired on the host."""
    if factory is HostGateware and len(parameters) > 1:
        return [], factory.wired(parameters)
    restarting = [RestartingGateware(factory, one) for one in parameters]
    return restarting, WiredFpgas(restarting).members if len(parameters) > 1 else restarting


class _Gateware:
    """The gateware of each FPGA, its pins driven as time goes on."""

    def __init__(self, boards, factory, roles, slowness):
        parameters = [BuildParameters.of(board, build_hash(data_folder("fpga_rtl"))) for board in boards]
        self._restarting, self._fpgas = _gateware_of(factory, parameters)
        self._pins = [_Pins(fpga, boards[0].waveform.samples, boards[0].bit_ticks) for fpga in self._fpgas]
        self._bits_hz = parameters[0].clock_hz
        self._clock_hz = self._bits_hz / slowness
        self._start_s = time.monotonic()
        self._free_tick = 10
        self._roles = roles
        self._damaged = 0
        self._wires = ["good"] * len(boards)
        self.modes = set()
        for fpga in self._fpgas:
            fpga.permit(0, level=True, which=Permit.TEMPERATURE)
        if "permit" not in roles.values():
            self._fpgas[0].permit(0, level=True, which=Permit.RUN)

    def _tick(self, at_s):
        return max(round((at_s - self._start_s) * self._clock_hz), self._free_tick)

    def _now(self):
        """The tick to go to; a line that changed before and was not read yet will be taken to change then."""
        self._free_tick = self._tick(time.monotonic())
        return self._free_tick

    def line(self, at_s, name, level):
        """A line of the host has been given a level."""
        role, tick = self._roles.get(name), self._tick(at_s)
        if role == "trigger" and level:
            self._fpgas[0].trigger(tick + TRIGGER_PERIOD_TICKS)  # of several, all have this line
            self._free_tick = tick + 2 * TRIGGER_PERIOD_TICKS
        elif role == "permit":
            self._fpgas[0].permit(tick, level=bool(level), which=Permit.RUN)

    def transfer(self, request):
        """One chip-select assertion; what comes back, or None if nothing ever does."""
        speed_hz, size, mode, ends = HEADER.unpack_from(request)
        assert ends & 1, "a frame is one transfer"
        number = ends >> 8
        if self._wires[number] == "stuck":
            return None
        self.modes.add(mode)
        sent = request[HEADER.size : HEADER.size + size]
        if self._damaged:
            self._damaged -= 1
            sent = bytes([*sent[:-1], sent[-1] ^ 1])
        answer = bytearray(size)
        ticks = max(round(8 * size * self._bits_hz / speed_hz), frame_ticks(size)) + 2 * LEAD_TICKS
        select_tick = max(self._tick(time.monotonic()) - ticks, self._free_tick)  # its time on the wire has passed already
        self._free_tick = select_tick + ticks + SELECT_HIGH_TICKS
        self._fpgas[number].exchange(select_tick, select_tick + ticks, sent, memoryview(answer))
        time.sleep(max(self._start_s + self._free_tick / self._clock_hz - time.monotonic(), 0))  # a slow SCK takes its time
        return WIRES[self._wires[number]](bytes(answer), sent)

    def wire(self, kind, number):
        self._wires[number] = kind

    def damage(self, frames):
        """Of the next this many frames to the FPGA, the last bit will be wrong."""
        self._damaged = frames

    def reset(self, dark_s, number):
        """An FPGA loses its supply now, and is configured again so much of its time later."""
        tick = self._now()
        self._fpgas[0].advance(tick)
        self._restarting[number].restart(tick, round(dark_s * self._bits_hz))
        self._fpgas[0].advance(tick + 1)  # of several, the others' permit follows from here on

    def temperature(self, number, level):
        """The temperature pin of an FPGA is given a level now."""
        self._fpgas[number].permit(self._now(), level=level, which=Permit.TEMPERATURE)

    def cut_trigger(self, number):
        """The trigger line leads to this FPGA no more."""
        self._restarting[number].trigger = lambda *_: None

    def note(self):
        """Note what the pins did since this was last done: a little after each transfer, as all at once would hold one up."""
        for pins in self._pins:
            pins.note()

    def pins(self, number):
        """What the pins have come to, and the emissions that ran to their end so far."""
        self._fpgas[0].advance(self._now())
        self.note()
        of = self._pins[number]
        return {"hv": of.hv, "word": of.word, "focus": of.focus, "starts": of.starts, "modes": self.modes}

    def emissions(self, number):
        """Drive words on the channel pins in each emission that ended since this was last asked for, as bytes."""
        self.pins(number)
        emissions, self._pins[number].emissions = self._pins[number].emissions, []
        return emissions


class FarEnd:
    """Gateware behind /dev/labspi and the lines of a chip, until `close`.

    Parameters
    ----------
    board : Board
        Clock, slots, limits and line names that the host uses.
    names : sequence of str
        Of all lines of the chip, in their order.
    factory : GatewareFactory
        The model, or the Verilog compiled.
    slowness : float
        Seconds on the wall for one of the gateware: for a guest that may be held up. The host's clock has to be as slow.
    """

    def __init__(self, board, names, factory=GatewareModel, slowness=1.0):
        self.board, self._names, self._factory, self._slowness = board, names, factory, slowness
        context = multiprocessing.get_context("fork")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=self._serve, args=(theirs,), daemon=True)
        self._process.start()
        theirs.close()
        assert self._pipe.recv() == "ready"

    def ask(self, what, *arguments):
        """Have something done by the process, and its answer."""
        self._pipe.send((what, arguments))
        return self._pipe.recv()

    def wire(self, kind, number=0):
        """Damage answers from now on, as `WIRES` has it; "stuck": no transfer ever ends."""
        self.ask("wire", kind, number)

    def reset(self, dark_s=0.0, number=0):
        """Take the FPGA's supply away for so long."""
        self.ask("reset", dark_s, number)

    def pins(self, number=0):
        """Levels and emissions so far: hv, word, focus."""
        return self.ask("pins", number)

    def emissions(self, number=0):
        """Drive words of each emission that ended since the last call, as they were on the channel pins."""
        return self.ask("emissions", number)

    def close(self):
        """Nobody is at the far end any more: MISO is MOSI."""
        self._pipe.send(("close", ()))
        self._process.join()
        self._pipe.close()

    def _serve(self, pipe):
        settings = self.board.link
        roles = {settings.trigger_line: "trigger", settings.permit_line: "permit"}
        roles.pop("", None)
        trace = GpioTrace(settings.gpio_chip, self._names)
        gateware = _Gateware(self.board.fpga_boards, self._factory, roles, self._slowness)
        wires = os.open("/dev/labspi", os.O_RDWR)
        with selectors.DefaultSelector() as selector:
            for file in (wires, trace.fd, pipe):
                selector.register(file, selectors.EVENT_READ)
            pipe.send("ready")
            while True:
                ready = {key.fileobj for key, _ in selector.select()}
                request = os.read(wires, REQUEST_BYTES) if wires in ready else None
                for event in trace.read():  # what happened before that transfer
                    gateware.line(*event)
                if request is not None:
                    answer = gateware.transfer(request)
                    if answer is not None:
                        with contextlib.suppress(BrokenPipeError):  # the controller has given the transfer up
                            os.write(wires, answer)
                    gateware.note()
                if pipe in ready:
                    what, arguments = pipe.recv()
                    if what == "close":
                        break
                    pipe.send(getattr(gateware, what)(*arguments))
        os.close(wires)
        trace.close()
