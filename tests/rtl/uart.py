"""The other end of a UART in simulation: 8N1 at a rate of its own, and a watch over the byte link behind the gateware.

The reference for the framing is the PyPI package `cobs`, of which the gateware knows nothing.
"""

import random

import cocotb
from cobs import cobs
from cocotb.triggers import FallingEdge, RisingEdge, Timer
from cocotb.utils import get_sim_time

CLOCK_NS = 10


def bit_ns(dut):
    """Length of a bit as the gateware should have it; the benches' clock is 10 ns whatever CLOCK_HZ says."""
    return CLOCK_NS * int(dut.CLOCK_HZ.value) / int(dut.BAUD.value)


class Wire:
    """Drives uart_rx_i and reads uart_tx_o; `rate` 1.02 sends 2 % faster than nominal."""

    def __init__(self, dut):
        self.dut, self.bit_ns, self.rate = dut, bit_ns(dut), 1.0
        self.answers, self.starts_ns = [], []  # frames read, decoded; when each of their bytes' start bits fell
        self.heard = bytearray()  # all bytes read
        self._reading = cocotb.start_soon(self._read())

    def forget(self):
        """The gateware was reset: what it was sending ends here."""
        self._reading.cancel()
        self.answers.clear()
        self.heard.clear()
        self._reading = cocotb.start_soon(self._read())

    async def bits(self, count):
        await Timer(round(1000 * count * self.bit_ns / self.rate), "ps")

    async def send_byte(self, byte, stop=1):
        for level in (0, *(byte >> bit & 1 for bit in range(8)), stop):
            self.dut.uart_rx_i.value = level
            await self.bits(1)
        self.dut.uart_rx_i.value = 1

    async def send(self, wire):
        for byte in wire:
            await self.send_byte(byte)

    async def frame(self, payload):
        await self.send(cobs.encode(payload) + b"\0")

    async def _read(self):
        line = bytearray()
        while True:
            await FallingEdge(self.dut.uart_tx_o)
            self.starts_ns.append(get_sim_time("ns"))
            await Timer(round(1500 * self.bit_ns), "ps")
            byte = 0
            for bit in range(8):
                byte |= int(self.dut.uart_tx_o.value) << bit
                await Timer(round(1000 * self.bit_ns), "ps")
            assert self.dut.uart_tx_o.value == 1, "stop bit"
            line.append(byte)
            self.heard.append(byte)
            if byte == 0:
                self.answers.append(cobs.decode(bytes(line[:-1])))
                line.clear()


class ByteLink:
    """What frame_decoder and status_encoder see: frames as (bytes, partial), and answers of `size` bytes given out."""

    def __init__(self, dut, size):
        self.dut, self.size = dut, size
        self.frames = []
        self.selects = 0
        self.given = []  # the answers that were taken
        self._open = None
        self._last_ns = 0.0
        for task in (self._select(), self._bytes(), self._release()):
            cocotb.start_soon(task)

    def forget(self):
        """The gateware was reset: the frame that was open has no end."""
        self._open = None
        self.frames.clear()

    async def _select(self):
        while True:
            await RisingEdge(self.dut.select_o)
            self.selects += 1
            assert self._open is None, "a frame within a frame"
            self._open, self._last_ns = bytearray(), get_sim_time("ns")
            cocotb.start_soon(self._answer())

    async def _bytes(self):
        while True:
            await RisingEdge(self.dut.byte_valid_o)
            now = get_sim_time("ns")
            assert now >= self._last_ns + CLOCK_NS, "a byte with select_o"
            self._open.append(int(self.dut.byte_o.value))
            self._last_ns = now

    async def _release(self):
        while True:
            await RisingEdge(self.dut.release_o)
            assert get_sim_time("ns") >= self._last_ns + CLOCK_NS, "release_o with the last byte"
            self.frames.append((bytes(self._open), bool(self.dut.partial_o.value)))
            self._open = None

    async def _answer(self):
        """As status_encoder: the first byte is there the clock after select_o, the next one the clock after each take."""
        dut = self.dut
        dut.answer_i.value = 0xEE  # before the snapshot
        answer = bytes(random.choice((0, 0, 1, 37, 255, random.randrange(256))) for _ in range(self.size))
        taken = 0
        await RisingEdge(dut.clk_i)
        for _ in range(self.size + 4):
            dut.answer_i.value = answer[taken] if taken < self.size else 0xEE
            await FallingEdge(dut.clk_i)
            taken += int(dut.answer_take_o.value)
            await RisingEdge(dut.clk_i)
        assert taken in (0, self.size)
        if taken:
            self.given.append(answer)
