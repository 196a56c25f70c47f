"""What is at the far end of the emulated Pi's SPI0 and lines (fpga_wire.c has the messages): echoes for the probe, or gateware.

usage: far_end.py SOCKET OUT plain|BOARD     serves one machine and, when that has gone, writes what was seen to OUT, as JSON

The gateware is the product's model; its clock is the machine's virtual time.
"""

import contextlib
import hashlib
import json
import socket
import struct
import sys
from pathlib import Path
from statistics import median

import numpy as np

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.status import pack_status
from controller.device.service.drivers import gateware_hash
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import INPUT_TICKS, GatewareModel
from controller.workshop.gateware.pin_timing import SELECT_HIGH_TICKS, TRIGGER_PERIOD_TICKS, frame_ticks

HEADER = struct.Struct("<cBBBIQ")  # kind, line, level, 0, bytes, virtual time in ns
STATUS_BYTES = 36
TRIGGER, PERMIT = 25, 23
START_TICK = 10
MESSAGES_PER_CAPTURE = 500
NS = 1_000_000_000


class Echoes:
    """Frame k is answered with (k + i) & 255, as the probe expects."""

    frames = 0

    def select(self, _at_ns):
        return bytes(self.frames + i & 255 for i in range(STATUS_BYTES))

    def release(self, _at_ns, _sent):
        self.frames += 1

    def line(self, _number, _level, _at_ns):
        pass

    def seen(self):
        return {}


class Gateware:
    """The model of a board's gateware, its pins driven as the machine's time goes on."""

    def __init__(self, name):
        board = load_board(find_board(name))
        self._clock_hz = board.link.clock_hz
        self._model = GatewareModel(BuildParameters.of(board, gateware_hash()))
        self._model.permit(0, level=True, which=Permit.TEMPERATURE)
        self._start_ns = None
        self._free_tick = START_TICK
        self._select_tick = 0
        self._most_ahead_ticks = 0
        self._messages = 0
        self._sampled = np.arange(-board.waveform.samples, 0) * board.bit_ticks  # from the focus
        self._recent = np.zeros(0, np.int64), np.zeros(0, np.uint32)  # ticks and channel pins of the last changes
        self._emissions = []

    def _tick(self, at_ns):
        self._start_ns = at_ns - NS // self._clock_hz * START_TICK if self._start_ns is None else self._start_ns
        tick = (at_ns - self._start_ns) * self._clock_hz // NS
        self._most_ahead_ticks = max(self._most_ahead_ticks, self._free_tick - tick)
        return max(tick, self._free_tick)

    def select(self, at_ns):
        self._select_tick = self._tick(at_ns)
        self._model.advance(self._select_tick + INPUT_TICKS)
        answer = bytearray(STATUS_BYTES)
        pack_status(answer, 0, self._model.status())
        return bytes(answer)

    def release(self, at_ns, sent):
        if sent:
            release_tick = max(self._tick(at_ns), self._select_tick + frame_ticks(len(sent)))
            self._model.exchange(self._select_tick, release_tick, sent, memoryview(bytearray(len(sent))))
            self._free_tick = release_tick + SELECT_HIGH_TICKS
        self._messages += 1
        if self._messages % MESSAGES_PER_CAPTURE == 0:
            self._note()

    def line(self, number, level, at_ns):
        if number == TRIGGER and level:
            tick = self._tick(at_ns)
            self._model.trigger(tick + TRIGGER_PERIOD_TICKS)
            self._free_tick = tick + 2 * TRIGGER_PERIOD_TICKS
        elif number == PERMIT:
            self._model.permit(self._tick(at_ns), level=bool(level), which=Permit.RUN)

    def _note(self):
        """Sample the channel pins of each emission that has ended, bit by bit."""
        capture = self._model.take_capture()
        ticks = np.concatenate([self._recent[0], capture.ticks.astype(np.int64)])
        levels = np.concatenate([self._recent[1], capture.words])
        for focus_tick in capture.focus_ticks.astype(np.int64):
            words = levels[np.searchsorted(ticks, focus_tick + self._sampled, side="right") - 1].astype("<u4")
            self._emissions.append(hashlib.sha256(words.tobytes()).hexdigest())
        begun = slice(-self._sampled.size - 1, None)  # an emission that has not ended, and what was before it
        self._recent = ticks[begun], levels[begun]

    def seen(self):
        self._note()
        return {"emissions": self._emissions, "most_ahead_us": self._most_ahead_ticks * 1e6 / self._clock_hz}


def serve(machine, end):
    """Serve until the machine has gone; what was seen."""
    frames, triggers, permits, high_us, low_us = 0, 0, [], [], {}
    fell_ns = rose_ns = 0

    def read(size):
        data = b""
        while len(data) < size:
            if not (piece := machine.read(size - len(data))):
                raise EOFError
            data += piece
        return data

    with contextlib.suppress(EOFError, ConnectionError):
        while True:
            kind, number, level, _, size, at_ns = HEADER.unpack(read(HEADER.size))
            data = read(size)
            if kind == b"S":
                machine.write(end.select(at_ns))
                high_us += [(at_ns - rose_ns) / 1e3] if rose_ns else []
                fell_ns = at_ns
            elif kind == b"E":
                end.release(at_ns, data)
                rose_ns = at_ns
                frames += bool(data)
                low_us.setdefault(size, []).append((at_ns - fell_ns) / 1e3)
            else:
                triggers += number == TRIGGER and level
                permits += [level] * (number == PERMIT)
                end.line(number, level, at_ns)
    return {
        "frames": frames,
        "triggers": triggers,
        "permits": permits,
        "select_high_us": {"least": min(high_us, default=0), "median": median(high_us or [0])},
        "select_low_us": {n: {"least": min(us), "median": median(us), "frames": len(us)} for n, us in sorted(low_us.items()) if n},
        **end.seen(),
    }


def main(path, out, kind):
    end = Echoes() if kind == "plain" else Gateware(kind)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(path)
        server.listen(1)
        machine = server.accept()[0].makefile("rwb", buffering=0)
    Path(out).write_text(json.dumps(serve(machine, end), indent=1))


if __name__ == "__main__":
    main(*sys.argv[1:])
