"""What every bench of a single module begins with."""

from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge, Timer


async def after_reset(dut, **inputs):
    """Start the clock, set all inputs (to 0 but for those given), reset; returns at a falling edge of the clock."""
    for signal in dut:
        if signal._name.endswith("_i") and signal._name != "clk_i":
            signal.value = inputs.get(signal._name, 0)
    dut.rst_i.value = 1
    Clock(dut.clk_i, 10, "ns").start()
    await ClockCycles(dut.clk_i, 3)
    await FallingEdge(dut.clk_i)
    dut.rst_i.value = 0


async def clocks(dut, count=1):
    for _ in range(count):
        await FallingEdge(dut.clk_i)


async def pulse(dut, signal, **inputs):
    """Raise a signal for one clock, with other inputs set."""
    for name, value in inputs.items():
        getattr(dut, name).value = value
    signal.value = 1
    await FallingEdge(dut.clk_i)
    signal.value = 0


async def settled():
    """A moment later, when outputs have followed the inputs set at the falling edge."""
    await Timer(1, "ns")


async def reset(dut):
    """A reset in the middle, one clock long."""
    await pulse(dut, dut.rst_i)
