"""spi_peripheral: bytes both ways at every ratio and phase of the clocks, and chip select as the frame.

The controller here moves its pins at real times, odd ones against the clock, keeps to no more than the contract in
the head of spi_peripheral.v, and reads MISO at the rise of SCK. The clock is 10 ns.
"""

import random

import cocotb
import pytest
from clocked import after_reset, clocks
from cocotb.triggers import FallingEdge, RisingEdge, Timer
from cocotb.utils import get_sim_time

CLOCK_NS = 10
SELECT_TO_SCK_NS = 5 * CLOCK_NS
SCK_TO_RELEASE_NS = 3 * CLOCK_NS
SELECT_HIGH_NS = 4 * CLOCK_NS
LEAD_IN = 8  # answers of its own before the loop-back
# SCK high, SCK low in ns: a third of the clock and its two extremes, a sixth, odd ones, slow
FAST = (15, 15)
LEVELS = [FAST, (10, 20), (20, 10), (30, 30), (15.3, 15.3), (16.7, 14.1), (17.9, 17.9), (20.3, 21.1), (33, 35.5), (141, 93)]


class Link:
    """What stands behind the peripheral: answers with LEAD_IN bytes of its own, then with byte k-2 as byte k.

    `frames` holds (bytes, partial) of every frame that ended, `answers` what was taken since the last select.
    """

    def __init__(self, dut):
        self.dut, self.frames, self.selects = dut, [], 0
        self.bytes, self.answers, self.valid_tick, self.tick = [], [], -1, 0
        cocotb.start_soon(self._serve())

    def _next(self):
        number = len(self.answers)
        return number * 77 + 0x81 & 0xFF if number < LEAD_IN else self.bytes[number - 2]

    async def _serve(self):
        dut = self.dut
        while True:
            await RisingEdge(dut.clk_i)  # reads what held before the edge
            self.tick += 1
            if dut.select_o.value:
                self.selects += 1
                self.bytes, self.answers = [], []
            if dut.answer_take_o.value:
                self.answers.append(int(dut.answer_i.value))
            if dut.byte_valid_o.value:
                self.bytes.append(int(dut.byte_o.value))
                self.valid_tick = self.tick
            if dut.release_o.value:
                assert self.valid_tick < self.tick, "the last byte comes before release"
                self.frames.append((bytes(self.bytes), bool(dut.partial_o.value)))
            if len(self.answers) < LEAD_IN or len(self.bytes) > len(self.answers) - 2:
                dut.answer_i.value = self._next()


def pause(ns):
    return Timer(round(1000 * ns), "ps")


async def transfer(dut, data, bits=None, levels=FAST, lead_ns=SELECT_TO_SCK_NS, tail_ns=SCK_TO_RELEASE_NS, high_ns=SELECT_HIGH_NS):
    """One chip-select assertion; returns the bits of MISO at the rises of SCK as a number."""
    high, low = levels
    answer, bits = 0, 8 * len(data) if bits is None else bits
    dut.spi_cs_n_i.value = 0
    dut.spi_mosi_i.value = data[0] >> 7 if data else 0
    await pause(lead_ns)
    for bit in range(bits):
        answer = answer << 1 | int(dut.spi_miso_o.value)
        dut.spi_sck_i.value = 1
        await pause(high)
        dut.spi_sck_i.value = 0
        if bit + 1 < bits:
            dut.spi_mosi_i.value = data[(bit + 1) // 8] >> (7 - (bit + 1) % 8) & 1
            await pause(low)
    await pause(max(tail_ns - high, 0.1))
    dut.spi_cs_n_i.value = 1
    await pause(high_ns)
    return answer


def foreseen(data):
    """MISO bytes of a frame."""
    return bytes(k * 77 + 0x81 & 0xFF if k < LEAD_IN else data[k - 2] for k in range(len(data)))


async def begin(dut, **inputs):
    await after_reset(dut, **{"spi_cs_n_i": 1, **inputs})
    link = Link(dut)
    await clocks(dut, 5)
    return link


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def carries_bytes_both_ways_and_loops_back_at_every_ratio_and_phase(dut):
    link = await begin(dut)
    for levels in LEVELS:
        for length in (1, 2, 3, LEAD_IN + 1, random.randrange(4, 40)):
            await Timer(random.randrange(1, 10_000), "ps")
            data = random.randbytes(length)
            answer = await transfer(dut, data, levels=levels)
            assert link.frames.pop() == (data, False), levels
            assert answer.to_bytes(length, "big") == foreseen(data), levels
            assert dut.spi_miso_o.value == 0
    assert link.frames == []


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def frames_follow_each_other_with_the_shortest_pauses_at_any_phase(dut):
    link = await begin(dut)
    sent = []
    for _ in range(150):
        data = random.randbytes(random.randrange(1, 7))
        bits = random.choice([8 * len(data)] * 3 + [random.randrange(1, 8 * len(data) + 1)])
        high_ns = random.uniform(10, 20)
        levels = (high_ns, 30 - high_ns + random.choice([0.001, 0.002, 7.777]))
        answer = await transfer(dut, data, bits, levels, SELECT_TO_SCK_NS + random.uniform(0, 1.5))
        sent.append((data[: bits // 8], bits % 8 != 0))
        assert answer == int.from_bytes(foreseen(data), "big") >> (8 * len(data) - bits)
    await clocks(dut, 5)
    assert link.frames == sent


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def pulses_come_at_the_ticks_the_rest_counts_on(dut):
    await begin(dut)

    async def ticks_until(signal, start_ns):
        await RisingEdge(signal)
        return (get_sim_time("ns") - start_ns) / CLOCK_NS

    for offset_ps in (1, 2500, 5000, 7500, 9999):
        await RisingEdge(dut.clk_i)  # begins tick t
        tick_ns = get_sim_time("ns")
        await Timer(offset_ps, "ps")
        selected = cocotb.start_soon(ticks_until(dut.select_o, tick_ns))
        taken = cocotb.start_soon(ticks_until(dut.answer_take_o, tick_ns))
        valid = cocotb.start_soon(ticks_until(dut.byte_valid_o, tick_ns))
        released = cocotb.start_soon(ticks_until(dut.release_o, tick_ns))
        await transfer(dut, b"\x5a", high_ns=100)
        assert (await selected, await taken) == (2, 3)
        rise = 5 + 7 * 3  # the last one
        assert await valid == rise + 3
        assert await released == rise + 3 + 3


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def an_answer_is_taken_after_the_byte_it_may_repeat_and_before_it_is_sent(dut):
    await begin(dut)
    events = []

    async def watch():
        while True:
            await RisingEdge(dut.clk_i)
            for name in ("select_o", "answer_take_o", "byte_valid_o", "release_o"):
                if getattr(dut, name).value:
                    events.append(name.split("_")[0])

    cocotb.start_soon(watch())
    await transfer(dut, bytes(4))
    await clocks(dut, 3)
    assert events == ["select", "answer", "answer", *["byte", "answer"] * 4, "release"]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def reports_bits_that_make_no_byte_and_forgets_them(dut):
    link = await begin(dut)
    for bits in range(1, 18):
        await transfer(dut, b"\xa5\xc3\x99", bits)
        assert link.frames.pop() == (b"\xa5\xc3"[: bits // 8], bits % 8 != 0)
        await transfer(dut, b"\x96")
        assert link.frames.pop() == (b"\x96", False)


async def noise(dut, edges):
    for edge in range(edges):
        dut.spi_sck_i.value = edge + 1 & 1
        dut.spi_mosi_i.value = random.getrandbits(1)
        await Timer(random.randrange(5_000, 40_000), "ps")


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def ignores_a_select_without_sck_and_sck_without_a_select(dut):
    link = await begin(dut)
    await transfer(dut, b"", 0)
    for bits in (0, 5, 8, 24):
        await noise(dut, 2 * random.randrange(1, 30))
        await Timer(SELECT_HIGH_NS, "ns")
        assert link.frames == []
        await transfer(dut, b"\x3c\x77\xf0", bits)
        assert link.frames == ([(b"\x3c\x77\xf0"[: bits // 8], bits % 8 != 0)] if bits else [])
        link.frames.clear()


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_glitch_of_chip_select_is_no_frame_and_ends_none(dut):
    link = await begin(dut)
    for place_ps in range(500, 10_000, 1_500):  # none of them across the rise of the clock
        selects = link.selects
        await RisingEdge(dut.clk_i)
        await Timer(place_ps, "ps")
        dut.spi_cs_n_i.value = 0
        await Timer(400, "ps")
        dut.spi_cs_n_i.value = 1
        await Timer(SELECT_HIGH_NS, "ns")
        assert link.selects == selects
    for width_ns in (11, 25, 42):  # seen, but no SCK
        dut.spi_cs_n_i.value = 0
        await Timer(width_ns, "ns")
        dut.spi_cs_n_i.value = 1
        await Timer(SELECT_HIGH_NS, "ns")
    assert link.frames == []

    async def glitch():
        for _ in range(20):
            await FallingEdge(dut.spi_sck_i)
            await FallingEdge(dut.clk_i)
            dut.spi_cs_n_i.value = 1
            await Timer(1, "ns")
            dut.spi_cs_n_i.value = 0

    data = random.randbytes(6)
    glitches = cocotb.start_soon(glitch())
    answer = await transfer(dut, data, levels=(31, 45))
    glitches.cancel()
    assert link.frames == [(data, False)]
    assert answer.to_bytes(6, "big") == foreseen(data)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_frame_under_way_at_reset_is_not_one(dut):
    link = await begin(dut, spi_cs_n_i=0)
    await transfer(dut, b"\xff\xff")
    assert link.frames == []
    for offset_ns in (0.3, 21, 51, 100.7, 222.2, 290, 321, 351):  # of 2 bytes in 50 + 16 * 30 ns
        running = cocotb.start_soon(transfer(dut, b"\x12\x34", high_ns=100))
        await pause(offset_ns)
        await FallingEdge(dut.clk_i)
        dut.rst_i.value = 1
        await FallingEdge(dut.clk_i)
        dut.rst_i.value = 0
        await running
        assert link.frames == []
        answer = await transfer(dut, b"\xc0\xde")
        assert link.frames.pop() == (b"\xc0\xde", False)
        assert answer.to_bytes(2, "big") == foreseen(b"\xc0\xde")


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def less_than_the_contract_is_seen_by_these_tests(dut):
    link = await begin(dut)
    data = b"\xa5\x5a\xc3"
    await transfer(dut, data, lead_ns=20)  # the first rise of SCK falls into the reset of what SCK clocks
    with pytest.raises(AssertionError):
        assert link.frames.pop() == (data, False)
