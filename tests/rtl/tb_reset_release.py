"""reset_release: 16 clocks from the clock's beginning to the end of the reset, none from its loss to a reset."""

import cocotb
from cocotb.triggers import Timer


async def clock(dut):
    for level in (1, 0):
        dut.clk_i.value = level
        await Timer(8, "ns")


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_reset_lasts_sixteen_clocks_and_begins_without_one(dut):
    for _ in range(3):
        dut.clk_i.value = dut.running_i.value = 0
        await Timer(1, "ns")
        assert dut.released_o.value == 0
        dut.running_i.value = 1
        for _ in range(16):
            assert dut.released_o.value == 0
            await clock(dut)
        for _ in range(20):
            assert dut.released_o.value == 1
            await clock(dut)
