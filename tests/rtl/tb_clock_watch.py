"""clock_watch: a clock that stops, or is slow, is lost in time; one that runs is not, however far its watch is off."""

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import Timer

CLOCK_PS = 16_000  # the ULX3S'
WATCH_PS = 64e6 / 310  # of its oscillator, which may be 15 % off
LOST_NS = 3_000


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def a_clock_is_lost_while_it_does_not_run_and_never_while_it_does(dut):
    for off in (0.85, 1.0, 1.15):
        clock = Clock(dut.clk_i, CLOCK_PS, "ps")
        watch = Clock(dut.watch_i, 2 * round(WATCH_PS / off / 2), "ps")
        dut.clk_i.value = 0
        watch.start()
        await Timer(2 * LOST_NS, "ns")
        assert dut.lost_o.value == 1, "from the beginning"
        clock.start()
        await Timer(LOST_NS, "ns")
        for _ in range(200):
            assert dut.lost_o.value == 0
            await Timer(99, "ns")
        for phase_ps in range(0, 16_000, 3_700):
            clock.stop()
            await Timer(LOST_NS, "ns")
            assert dut.lost_o.value == 1, (off, phase_ps)
            clock.start()
            await Timer(LOST_NS * 1000 + phase_ps, "ps")
            assert dut.lost_o.value == 0
        clock.stop()
        slow = Clock(dut.clk_i, 20 * CLOCK_PS, "ps")
        slow.start()
        await Timer(2 * LOST_NS, "ns")
        lost = 0
        for _ in range(100):
            await Timer(99, "ns")
            lost += int(dut.lost_o.value)
        assert lost > 50, "what is left of a clock is none"
        slow.stop()
        watch.stop()
