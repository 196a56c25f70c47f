"""indicator_pins: what is known a clock ago, and nothing without a clock."""

import cocotb
from clocked import after_reset, clocks, reset, settled


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def follows_a_clock_later(dut):
    await after_reset(dut)
    for waiting, fault in ((1, 0), (0, 1), (1, 1), (0, 0)):
        dut.waiting_i.value, dut.fault_i.value = waiting, fault
        await clocks(dut)
        assert (dut.waiting_o.value, dut.fault_o.value) == (waiting, fault)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def is_low_without_a_clock_and_in_reset(dut):
    await after_reset(dut, waiting_i=1, fault_i=1)
    await clocks(dut)
    assert (dut.waiting_o.value, dut.fault_o.value) == (1, 1)
    dut.clock_lost_i.value = 1
    await settled()  # far from an edge of the clock
    assert (dut.waiting_o.value, dut.fault_o.value) == (0, 0)
    dut.clock_lost_i.value = 0
    await clocks(dut)
    assert (dut.waiting_o.value, dut.fault_o.value) == (1, 1)
    await reset(dut)
    assert (dut.waiting_o.value, dut.fault_o.value) == (0, 0)
