"""permit_latch: a low of any length stops the pins at once, without a clock, and the core is told for clocks."""

import cocotb
from cocotb.triggers import Timer

HALF_NS = 8
PINS = ("run_permit", "temperature_ok")


async def clocks(dut, count):
    for _ in range(count):
        for level in (1, 0):
            dut.clk_i.value = level
            await Timer(HALF_NS, "ns")


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_low_of_either_pin_is_low_at_once_and_told_for_clocks(dut):
    for name, other in (PINS, PINS[::-1]):
        pin, told, others = getattr(dut, f"{name}_i"), getattr(dut, f"{name}_o"), getattr(dut, f"{other}_o")
        dut.clk_i.value = 0
        dut.run_permit_i.value = dut.temperature_ok_i.value = 1
        await clocks(dut, 20)
        assert dut.permitted_o.value == 1
        pin.value = 0
        await Timer(1, "ns")  # without a clock
        assert (int(dut.permitted_o.value), int(told.value), int(others.value)) == (0, 0, 1), "each has its own cause"
        pin.value = 1
        await Timer(1, "ns")
        seen = []
        for _ in range(12):
            seen.append((int(told.value), int(dut.permitted_o.value)))
            assert others.value == 1
            await clocks(dut, 1)
        assert seen == [(0, 0)] * 3 + [(1, 0)] * 7 + [(1, 1)] * 2
        pin.value = 0
        await clocks(dut, 30)
        assert (int(dut.permitted_o.value), int(told.value), int(others.value)) == (0, 0, 1)
