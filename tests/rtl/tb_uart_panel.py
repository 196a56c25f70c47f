"""SerialLink itself against the Verilog: its port is the simulated wire, its timeouts are in simulated time."""

import random
from types import SimpleNamespace
from unittest import mock

import cocotb
import numpy as np
from clocked import after_reset
from cocotb.task import bridge, resume
from cocotb.triggers import RisingEdge, Timer
from uart import Wire

from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES
from controller.device.fpga.links import serial_link
from controller.device.fpga.registers import Result, State
from controller.device.fpga.status import parse_status
from controller.device.kernel import load_frames_bytes, pack_loads
from controller.errors import LinkError

WORDS = np.random.default_rng(3).integers(0, 1 << 32, 1000, dtype=np.uint32)
WORDS[100:140] = 0
QUIET_NS = 400_000  # three answers


class Port:
    """What SerialLink asks of serial.Serial, at a wire; `damage` may change what is written."""

    is_open = True

    def __init__(self, wire):
        self.wire = wire
        self.damage = lambda data: data
        self._to_go = bytearray()
        self._come = wire.heard
        cocotb.start_soon(self._pump())

    async def _pump(self):
        while True:
            while self._to_go:
                await self.wire.send_byte(self._to_go.pop(0))
            await Timer(100, "ns")

    @property
    def in_waiting(self):
        return len(self._come)

    def write(self, data):
        self._to_go += self.damage(bytes(data))
        return len(data)

    @resume
    async def read(self, size):
        quiet_ns = 0
        while len(self._come) < size and quiet_ns < QUIET_NS:
            before = len(self._come)
            await Timer(5, "us")
            quiet_ns = 0 if len(self._come) > before or self._to_go else quiet_ns + 5000
        data = bytes(self._come[:size])
        del self._come[:size]
        return data

    def set_low_latency_mode(self, _on):
        raise ValueError

    def close(self):
        pass


async def begin(dut):
    await after_reset(dut, uart_rx_i=1)
    wire = Wire(dut)
    await wire.bits(3)
    port = Port(wire)
    with mock.patch.object(serial_link, "serial", SimpleNamespace(Serial=lambda *_args, **_kwargs: port)):
        link = serial_link.SerialLink("simulation", int(dut.BAUD.value), lambda: 0.0)
    return port, link


def pack_message(upload, sequence):
    """An upload and two NOPs, or five NOPs: the message and the lengths of its frames."""
    sent = memoryview(bytearray(frames.UPLOAD_BYTES + 8 * FRAME_BYTES))
    lengths = []
    end = 0
    if upload:
        words = memoryview(WORDS).cast("B")
        pack_loads(sent, sequence, words)
        end = load_frames_bytes(words.nbytes)
        lengths = [piece.stop - piece.start for piece in frames.upload_slices(len(WORDS))]
    for _ in range(2 if upload else 5):
        end = frames.pack_nop(sent, end, sequence + len(lengths))
        lengths.append(FRAME_BYTES)
    return sent[:end], lengths


def exchange(link, upload, sequence):
    """The statuses that come back."""
    sent, lengths = pack_message(upload, sequence)
    received = memoryview(bytearray(b"\xee" * len(sent)))
    link.exchange(sent, lengths, received)
    return [parse_status(received, sum(lengths[:number])) for number in range(len(lengths))]


@cocotb.test(timeout_time=100, timeout_unit="ms")
async def a_message_with_an_upload_arrives_and_every_frame_is_answered_about_the_one_before(dut):
    _, link = await begin(dut)
    written = []

    async def record():
        while True:
            await RisingEdge(dut.write_o)
            written.append(int(dut.write_data_o.value))

    cocotb.start_soon(record())
    for upload, sequence in ((True, 250), (False, 40)):
        statuses = await bridge(exchange)(link, upload, sequence)
        assert [status.result for status in statuses] == [Result.OK] * len(statuses)
        numbers = [(sequence + n) & 0xFF for n in range(len(statuses) - 1)]
        assert [status.sequence for status in statuses[1:]] == numbers
        times = [status.timestamp_ticks for status in statuses]
        assert times == sorted(times)
        assert statuses[0].state == State.RUN_PERMIT
        assert statuses[0].data == 0x00FF0001
    assert written == WORDS.tolist()


@cocotb.test(timeout_time=100, timeout_unit="ms")
async def what_is_lost_or_damaged_costs_one_message_and_is_never_taken_for_good(dut):
    port, link = await begin(dut)
    await bridge(exchange)(link, False, 1)
    for number in range(8):
        place, kind = random.randrange(3, 5 * (FRAME_BYTES + 4)), random.choice(("lose", "flip"))

        def damage(data, place=place, kind=kind):
            if len(data) < place:
                return data
            return data[:place] + (b"" if kind == "lose" else bytes([data[place - 1] ^ 0x20])) + data[place + 1 :]

        port.damage = damage
        try:
            statuses = await bridge(exchange)(link, False, 10 * number)
            good = [s.sequence == 10 * number + n and s.result is Result.OK for n, s in enumerate(statuses[1:])]
            assert not all(good) or place > 4 * (FRAME_BYTES + 4), (place, kind, statuses)
        except LinkError as error:
            dut._log.info("%s", error)
        port.damage = lambda data: data
        statuses = await bridge(exchange)(link, False, 100 + number)
        assert [s.sequence for s in statuses[1:]] == [100 + number + n for n in range(4)]
