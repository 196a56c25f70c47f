"""spi_peripheral: bytes both ways at every ratio of the clocks, and chip select as the frame."""

import random

import cocotb
from clocked import after_reset, clocks
from cocotb.triggers import RisingEdge, Timer


class Bytes:
    """Answers with counted bytes and keeps what comes in, frame by frame."""

    def __init__(self, dut):
        self.dut, self.received, self.ended, self.taken = dut, b"", [], 0
        cocotb.start_soon(self._serve())

    async def _serve(self):
        dut = self.dut
        while True:
            dut.answer_i.value = (self.taken * 77 + 0x81) & 0xFF
            await RisingEdge(dut.clk_i)
            if dut.select_o.value:
                self.received = b""
            if dut.byte_valid_o.value:
                self.received += bytes([int(dut.byte_o.value)])
            if dut.release_o.value:
                self.ended.append((self.received, bool(dut.partial_o.value)))
            self.taken += int(dut.answer_take_o.value)


async def transfer(dut, data, bits, half_ns):
    dut.spi_cs_n_i.value = 0
    await Timer(50, "ns")
    answer = 0
    for bit in range(bits):
        dut.spi_mosi_i.value = data[bit // 8] >> (7 - bit % 8) & 1
        await Timer(half_ns, "ns")
        answer = answer << 1 | int(dut.spi_miso_o.value)
        dut.spi_sck_i.value = 1
        await Timer(half_ns, "ns")
        dut.spi_sck_i.value = 0
    await Timer(half_ns, "ns")
    dut.spi_cs_n_i.value = 1
    await Timer(40, "ns")
    return answer


@cocotb.test(timeout_time=500, timeout_unit="us")
async def carries_bytes_both_ways_at_a_sixth_of_the_clock_and_slower(dut):
    await after_reset(dut, spi_cs_n_i=1)
    link = Bytes(dut)
    await clocks(dut, 5)
    for half_ns in (30, 33, 35.5, 41, 70):
        await Timer(random.randrange(1, 10), "ns")
        data = random.randbytes(6)
        before = link.taken
        answer = await transfer(dut, data, 48, half_ns)
        await clocks(dut, 5)
        assert link.ended.pop() == (data, False)
        assert answer.to_bytes(6, "big") == bytes((before + n) * 77 + 0x81 & 0xFF for n in range(6))
        assert dut.spi_miso_o.value == 0
    assert link.ended == []


@cocotb.test(timeout_time=100, timeout_unit="us")
async def reports_bits_that_make_no_byte_and_forgets_them(dut):
    await after_reset(dut, spi_cs_n_i=1)
    link = Bytes(dut)
    await clocks(dut, 5)
    await transfer(dut, b"\xa5\xc3", 13, 30)
    await transfer(dut, b"\x96", 8, 30)
    await clocks(dut, 5)
    assert link.ended == [(b"\xa5", True), (b"\x96", False)]


@cocotb.test(timeout_time=100, timeout_unit="us")
async def ignores_a_select_without_sck_and_sck_without_a_select(dut):
    await after_reset(dut, spi_cs_n_i=1)
    link = Bytes(dut)
    await clocks(dut, 5)
    await transfer(dut, b"", 0, 30)
    for _ in range(16):
        dut.spi_sck_i.value = 1 - int(dut.spi_sck_i.value)
        await Timer(30, "ns")
    await clocks(dut, 5)
    assert link.ended == []
    await transfer(dut, b"\x3c", 8, 30)
    await clocks(dut, 5)
    assert link.ended == [(b"\x3c", False)]


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_frame_under_way_at_reset_is_not_one(dut):
    await after_reset(dut, spi_cs_n_i=0)
    link = Bytes(dut)
    await clocks(dut, 5)
    await transfer(dut, b"\xff\xff", 16, 30)
    await clocks(dut, 5)
    assert link.ended == []
