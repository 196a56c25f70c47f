"""The same frames to a device: the same results, values and echoes as from the model.

`HAPTIC_PANEL_SERIAL=/dev/ttyUSB0 pytest tests/conformance/test_device.py` names a board (HAPTIC_PANEL_BAUD its rate), which
must be unpermitted or may glide its outputs. Without one, the model behind a pseudo-terminal has to pass.
"""

import os
import time
import zlib

import numpy as np
import pytest
from patience import SpareTime

from controller.device.board.lookup import data_folder
from controller.device.fpga import frames
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.links import serial_link
from controller.device.fpga.links.serial_link import SerialLink
from controller.device.fpga.registers import (
    READ_MEMORY,
    READ_QUEUE,
    READ_SLOT_CRC,
    Control,
    FrameType,
    Kind,
    Register,
    Start,
    State,
)
from controller.device.fpga.status import parse_status
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.serial_peer import PseudoTerminal, UartPanel

BUILD = build_hash(data_folder("fpga_rtl"))
BAUD = int(os.environ.get("HAPTIC_PANEL_BAUD", "1000000"))
PASSING = State.RUN_PERMIT | State.TEMPERATURE_GOOD | State.HEARTBEAT | State.CHECKING  # as the board is wired, and as time passes
OWN = {Register.BOARD, Register.INPUTS, Register.INPUT_TIME_LOW, Register.FRAME_ERRORS, Register.SEQUENCE_GAPS}
OWN |= {register for register in Register if register.kind is Kind.BUILT_IN}


@pytest.fixture
def link(board, monkeypatch):
    """The device, or what stands in for one."""
    device = os.environ.get("HAPTIC_PANEL_SERIAL")
    if device:
        opened = SerialLink(device, BAUD, time.monotonic)
        yield opened
        opened.close()
        return
    monkeypatch.setattr(serial_link, "time", SpareTime)
    model = GatewareModel(BuildParameters.of(board, BUILD))
    with PseudoTerminal(UartPanel(model, board.link.clock_hz, BAUD, time.monotonic).receive) as terminal:
        opened = SerialLink(terminal.device, BAUD, time.monotonic)
        yield opened
        opened.close()


class ModelLink:
    """The model, given one frame after the other."""

    def __init__(self, board):
        self._model = GatewareModel(BuildParameters.of(board, BUILD))
        self._tick = 100

    def exchange(self, sent, lengths, received):
        start = 0
        for length in lengths:
            release = self._tick + 20 * 8 * length
            self._model.exchange(self._tick, release, sent[start : start + length], received[start : start + length])
            self._tick = release + 100
            start += length


def conversation():
    """(what, frame) of everything that can be asked without playing."""
    words = np.random.default_rng(7).integers(0, 1 << 32, 300, np.uint32).astype("<u4")
    data = memoryview(words.tobytes())
    buffer = bytearray(frames.LOAD_FRAME_BYTES)
    asked = []

    def ask(what, pack, *arguments, **named):
        end = pack(buffer, 0, len(asked) + 1, *arguments, **named)
        asked.append((what, bytes(buffer[:end])))

    ask("begin", frames.pack_nop)
    for command in (Control.STOP, Control.CLEAR, Control.ARM, 99):
        ask(f"control {command}", frames.pack_control, command)
    ask("unlock with a wrong key", frames.pack_unlock, BUILD ^ 1)
    for register in Register:
        if register.access == "RO" and register not in OWN:
            ask(register.name, frames.pack_read, register)
        if register.access == "RW":
            for value in (0, 1, 0xFFFFFFFF):
                ask(f"{register.name} = {value}", frames.pack_write, register, value)
    ask("an unknown register", frames.pack_read, len(Register))
    ask("a register that is read only", frames.pack_write, Register.IDENTITY, 0)
    ask("an unknown type", frames.pack_short, FrameType.TEST + 1, 0)
    for chunk in range(3):
        ask(f"chunk {chunk}", frames.pack_load, chunk, data[500 * chunk : 500 * (chunk + 1)])
    ask("a chunk there is not", frames.pack_load, 8, data[:500])
    ask("too long", frames.pack_store, 0, 301, 0)
    ask("no such slot", frames.pack_store, 99, 300, 0)
    ask("a wrong CRC", frames.pack_store, 0, 300, 1)
    ask("the CRC that was found", frames.pack_read, READ_SLOT_CRC)
    ask("what is loaded", frames.pack_read, Register.SLOTS_LOADED)
    for chunk in range(3):
        ask(f"chunk {chunk}", frames.pack_load, chunk, data[500 * chunk : 500 * (chunk + 1)])
    ask("the right CRC", frames.pack_store, 1, 300, zlib.crc32(data))
    ask("what is loaded", frames.pack_read, Register.SLOTS_LOADED)
    for word in (0, 124, 125, 299, 300):
        ask(f"word {word}", frames.pack_read, READ_MEMORY + 1024 + word)
    ask("the queue", frames.pack_read, READ_QUEUE)
    for start in Start:
        ask("a play while disarmed", frames.pack_play, Play(1, start=start))
    ask("disarm", frames.pack_control, Control.DISARM)
    ask("end", frames.pack_nop)
    return asked


def answers(link, asked):
    """What becomes of each frame, as the status that comes with the next one says."""
    got = []
    for _, frame in asked:
        received = memoryview(bytearray(len(frame)))
        link.exchange(memoryview(frame), [len(frame)], received)
        status = parse_status(received[:FRAME_BYTES])
        got.append((status.result.name, status.sequence, status.state & ~PASSING, status.faults, status.data, status.chunks))
    return got[1:]


def test_a_device_answers_as_the_model_does(link, board):
    asked = conversation()
    for (what, _), device, model in zip(asked, answers(link, asked), answers(ModelLink(board), asked), strict=False):
        assert device == model, what


def test_a_register_that_reads_differently_is_seen(link, board):
    asked = conversation()
    model = answers(ModelLink(board), asked)
    place = next(index for index, (what, _) in enumerate(asked) if what == "word 124")
    other = [(what, frame if index != place else asked[place + 1][1]) for index, (what, frame) in enumerate(asked)]
    assert answers(link, other)[place] != model[place]
