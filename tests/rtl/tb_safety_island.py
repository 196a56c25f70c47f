"""safety_island: what it is asked for is clamped to what is built in, whoever asks; permits from their pins."""

import cocotb
from clocked import after_reset, clocks, pulse

from controller.device.fpga.registers import Fault

BUILT_IN = {  # as benches.py has them
    "channel_mask": 0x0000FFFF,
    "heartbeat_ticks": 900,
    "channel_edges": 40,
    "total_edges": 300,
    "emission_ticks": 50,
    "duty_share": 20_000,
    "duty_ticks": 100,
    "pulse_ticks": 3,
}
SETTLE_TICKS = 9
ALL = 0xFFFFFFFF
ASKED = dict.fromkeys(BUILT_IN, ALL) | {"pulse_ticks": 0, "duty_share": 0x1FFFF}
DRIVE_TICKS = 3
DECIDED_TICKS = 38  # from drive_i to a fault: pins, and 36 ticks at most until edges are too many


async def ramping_up(dut, **asked):
    """Behind an ARM whose supply has settled, with everything asked for that can be, but for what is given."""
    await after_reset(dut, run_permit_i=1, temperature_ok_i=1, bit_ticks_i=5, **{f"{k}_i": v for k, v in (ASKED | asked).items()})
    await clocks(dut, 5)
    await pulse(dut, dut.arm_i, heard_i=1)
    dut.heard_i.value = 0
    await clocks(dut, SETTLE_TICKS)


async def armed(dut, **asked):
    """The outputs on, behind `ramping_up`."""
    await ramping_up(dut, **asked)
    await pulse(dut, dut.ramp_done_i)
    await clocks(dut, DRIVE_TICKS + 1)
    assert dut.armed_o.value == 1
    assert dut.hv_enable_o.value == 1


def fault(dut):
    return Fault(int(dut.fault_o.value))


async def toggled(dut, channels, every, edges=1000):
    """Edges of these channels, one every this many clocks, that it took to a fault; None if this many took it to none."""
    for edge in range(1, edges + 1):
        dut.drive_i.value = channels * (edge % 2)
        await clocks(dut, every)
        if fault(dut):
            return edge
    return None


@cocotb.test(timeout_time=100, timeout_unit="us")
async def asked_for_more_edges_it_gives_those_built_in_and_asked_for_fewer_those(dut):
    for asked, given in ((ALL, 40), (41, 40), (40, 40), (12, 12)):
        await armed(dut, channel_edges=asked)
        assert await toggled(dut, 0x2, 5, edges=given) is None
        await clocks(dut, DECIDED_TICKS)
        assert not fault(dut)
        dut.drive_i.value = 0x2 * ((given + 1) % 2)
        await clocks(dut, DECIDED_TICKS)
        assert fault(dut) == Fault.CHANNEL_EDGES
        assert dut.fault_channels_o.value == 0x2
    for asked, given in ((ALL, 300), (160, 160)):
        await armed(dut, total_edges=asked)
        assert await toggled(dut, 0xFFFF, 5) == given // 16 + 1
        assert fault(dut) == Fault.TOTAL_EDGES


@cocotb.test(timeout_time=100, timeout_unit="us")
async def what_is_asked_for_while_anything_is_on_does_not_count(dut):
    await armed(dut, channel_edges=12)
    dut.channel_edges_i.value = 40
    await clocks(dut, 50)
    assert await toggled(dut, 0x2, DECIDED_TICKS) == 13


async def off_with_the_edge(dut, way):
    """One edge more of channel 1, upwards, and in that clock what has the outputs off before its turn can come."""
    if way == "ramp down":
        dut.settled_i.value = 1
        await pulse(dut, dut.disarm_i)
        await clocks(dut)
        await pulse(dut, dut.ramp_done_i)
        await clocks(dut, DRIVE_TICKS - 1)
    else:
        dut.run_permit_i.value = 0
        await clocks(dut)
    dut.drive_i.value = 0x2
    await clocks(dut, 2)
    assert dut.hv_enable_o.value == 0
    dut.run_permit_i.value = 1


@cocotb.test(timeout_time=200, timeout_unit="us")
async def edges_too_many_that_are_found_out_once_all_is_off_are_a_fault_like_any_other(dut):
    for way, other in (("ramp down", Fault(0)), ("permit", Fault.NO_PERMIT)):
        for wait in range(0, 32, 5):
            await armed(dut, channel_edges=40)
            await clocks(dut, wait)
            assert await toggled(dut, 0x2, 5, edges=40) is None
            await clocks(dut, DECIDED_TICKS)
            await off_with_the_edge(dut, way)
            assert fault(dut) == other, "its turn has not been"
            await clocks(dut, DECIDED_TICKS)
            assert fault(dut) == other | Fault.CHANNEL_EDGES, way
            assert int(dut.fault_channels_o.value) & 0x2
            assert dut.fault_count_o.value == 1
            await pulse(dut, dut.clear_i)
            assert fault(dut) == Fault.CHANNEL_EDGES, "cleared before a window has passed"
            await pulse(dut, dut.arm_i)
            assert dut.off_o.value == 1
        await clocks(dut, 480)
        await pulse(dut, dut.clear_i)
        assert not fault(dut)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def edges_too_many_of_all_that_are_found_out_once_all_is_off_are_a_fault_like_any_other(dut):
    await armed(dut, total_edges=161)
    assert await toggled(dut, 0xFFFF, 5, edges=10) is None
    dut.run_permit_i.value = 0
    await clocks(dut)
    dut.drive_i.value = 0xFFFF
    await clocks(dut, 2)
    assert fault(dut) == Fault.NO_PERMIT
    await clocks(dut, 4)
    assert fault(dut) == Fault.NO_PERMIT | Fault.TOTAL_EDGES


@cocotb.test(timeout_time=100, timeout_unit="us")
async def limits_asked_for_once_all_is_off_neither_hide_edges_made_before_nor_make_them_too_many(dut):
    for asked, later, found in ((12, 40, Fault.CHANNEL_EDGES), (40, 12, Fault(0))):
        await armed(dut, channel_edges=asked)
        assert await toggled(dut, 0x2, 5, edges=12) is None
        await off_with_the_edge(dut, "ramp down")
        dut.channel_edges_i.value = later
        await clocks(dut, DECIDED_TICKS)
        assert fault(dut) == found
    for asked, later, found in ((160, 300, Fault.TOTAL_EDGES), (300, 160, Fault(0))):
        await armed(dut, total_edges=asked)
        assert await toggled(dut, 0xFFFF, 5, edges=10) is None
        await off_with_the_edge(dut, "ramp down")
        dut.total_edges_i.value = later
        await clocks(dut, DECIDED_TICKS)
        assert fault(dut) == found


@cocotb.test(timeout_time=100, timeout_unit="us")
async def asked_for_shorter_pulses_it_takes_those_built_in(dut):
    for asked, ticks, bad in ((0, 3, False), (0, 2, True), (2, 2, True), (5, 3, True), (5, 5, False)):
        await armed(dut, pulse_ticks=asked)
        await toggled(dut, 0x8, ticks, edges=5)
        await clocks(dut, 4)
        assert fault(dut) == (Fault.SHORT_PULSE if bad else Fault(0)), (asked, ticks)


async def ticks_of_activity(dut, restart_every):
    """Clocks that something plays until a fault."""
    await pulse(dut, dut.start_i)
    dut.playing_i.value = 1
    for ticks in range(1, 1000):
        dut.start_i.value = int(ticks % restart_every == 0)
        await clocks(dut)
        if fault(dut):
            dut.playing_i.value = 0
            return ticks
    return None


@cocotb.test(timeout_time=100, timeout_unit="us")
async def asked_for_longer_emissions_or_more_duty_it_takes_those_built_in(dut):
    for asked, given in ((ALL, 50), (20, 20)):
        await armed(dut, emission_ticks=asked)
        assert given < await ticks_of_activity(dut, 1000) <= given + 3
        assert fault(dut) == Fault.LONG_EMISSION
    for share, budget, given in ((0x1FFFF, ALL, 144), (0x1FFFF, 50, 72), (0, ALL, 100), (0, 30, 30)):
        await armed(dut, duty_share=share, duty_ticks=budget)
        assert given - SETTLE_TICKS < await ticks_of_activity(dut, 40) <= given + 4, (share, budget)
        assert fault(dut) == Fault.DUTY


@cocotb.test(timeout_time=100, timeout_unit="us")
async def asked_for_more_patience_it_has_what_is_built_in(dut):
    for asked, given in ((ALL, 900), (100, 100)):
        await armed(dut, heartbeat_ticks=asked)
        ticks = 0
        while not fault(dut) and ticks < 1000:
            await clocks(dut)
            ticks += 1
        assert fault(dut) == Fault.HOST_SILENT
        assert given - 20 < ticks < given


@cocotb.test(timeout_time=100, timeout_unit="us")
async def only_frames_of_the_link_that_armed_keep_it_on(dut):
    for link, keeps in ((0, True), (1, False)):
        await armed(dut, heartbeat_ticks=100, link=0)
        dut.link_i.value = link
        for _ in range(6):
            await clocks(dut, 50)
            await pulse(dut, dut.heard_i)
        assert fault(dut) == (Fault(0) if keeps else Fault.HOST_SILENT)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def in_both_ramps_too(dut):
    for disarmed in (False, True):
        for link, keeps in ((0, True), (1, False)):
            await (armed if disarmed else ramping_up)(dut, heartbeat_ticks=40, link=0)
            if disarmed:
                await pulse(dut, dut.disarm_i)
            assert dut.hv_enable_o.value == 1
            dut.link_i.value = link
            for _ in range(5):  # for as long as the duty of a ramp permits
                await clocks(dut, 20)
                await pulse(dut, dut.heard_i)
            assert (dut.off_o.value == 0) == keeps
            assert fault(dut) == (Fault(0) if keeps else Fault.HOST_SILENT)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_channel_without_a_stage_never_moves(dut):
    for asked, given in ((ALL, 0xFFFF), (0xF0F0F0F0, 0xF0F0), (0, 0)):
        await armed(dut, channel_mask=asked)
        dut.drive_i.value = ALL
        await clocks(dut)
        assert int(dut.channel_o.value) == given


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_permit_counts_from_its_synchronised_input_with_the_next_clock_and_from_its_pin_with_the_third(dut):
    for name, cause in (("run_permit", Fault.NO_PERMIT), ("temperature_ok", Fault.OVER_TEMPERATURE)):
        pin, seen = getattr(dut, f"{name}_i"), getattr(dut, f"{name}_o")
        await armed(dut)
        dut.drive_i.value = ALL
        await clocks(dut)
        pin.value = 0
        await clocks(dut, 2)
        assert seen.value == 0
        assert dut.hv_enable_o.value == 1
        await clocks(dut)
        assert (int(dut.channel_o.value), int(dut.hv_enable_o.value), fault(dut)) == (0, 0, cause)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def arming_takes_both_permits_and_no_fault_whoever_says_that_it_may(dut):
    for name in ("run_permit_i", "temperature_ok_i"):
        await armed(dut)
        await pulse(dut, dut.disarm_i)
        getattr(dut, name).value = 0
        await clocks(dut, 10)
        assert fault(dut)
        await pulse(dut, dut.arm_i)
        assert dut.off_o.value == 1, "without its permit, and faulted"
        getattr(dut, name).value = 1
        await clocks(dut, 5)
        await pulse(dut, dut.arm_i)
        assert dut.off_o.value == 1, "faulted"
        await pulse(dut, dut.clear_i)
        getattr(dut, name).value = 0
        await clocks(dut, 5)
        await pulse(dut, dut.arm_i)
        assert dut.off_o.value == 1, "without its permit"
        getattr(dut, name).value = 1
        await clocks(dut, 5)
        await pulse(dut, dut.arm_i)
        assert dut.settling_o.value == 1


async def armed_again(dut, link, **asked):
    """Off by DISARM, without a reset, and on again by this link."""
    dut.settled_i.value = dut.ramp_done_i.value = 1
    await pulse(dut, dut.disarm_i)
    await clocks(dut, 2 * DRIVE_TICKS)
    assert dut.off_o.value == 1
    for name, value in asked.items():
        getattr(dut, f"{name}_i").value = value
    dut.link_i.value = link
    await clocks(dut, 2)
    await pulse(dut, dut.arm_i, heard_i=1)
    dut.heard_i.value = 0
    await clocks(dut, SETTLE_TICKS + DRIVE_TICKS + 2)
    assert dut.hv_enable_o.value == 1


@cocotb.test(timeout_time=200, timeout_unit="us")
async def armed_again_by_the_other_link_only_that_one_keeps_it_on(dut):
    for first, second, heard in ((1, 0, 1), (0, 1, 0), (1, 0, 0), (0, 1, 1)):
        await armed(dut, heartbeat_ticks=100, link=first)
        await armed_again(dut, second)
        dut.link_i.value = heard
        for _ in range(6):
            await clocks(dut, 40)
            await pulse(dut, dut.heard_i)
        assert fault(dut) == (Fault(0) if heard == second else Fault.HOST_SILENT), (first, second, heard)


@cocotb.test(timeout_time=200, timeout_unit="us")
async def a_second_arm_has_what_is_asked_for_then(dut):
    for asked, later, given in ((ALL, 60, 60), (60, ALL, 900), (300, 200, 200)):
        await armed(dut, heartbeat_ticks=asked)
        await armed_again(dut, 0, heartbeat_ticks=later)
        await pulse(dut, dut.heard_i)
        ticks = 0
        while not fault(dut) and ticks < 1000:
            await clocks(dut)
            ticks += 1
        assert fault(dut) == Fault.HOST_SILENT
        assert given - 3 <= ticks <= given + 3, (asked, later)
    await armed(dut)
    await armed_again(dut, 0, duty_share=0, duty_ticks=20)
    assert await ticks_of_activity(dut, 40) <= 24


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_permit_lost_for_one_clock_is_lost_and_so_it_is_the_second_time(dut):
    for name, cause in (("run_permit_i", Fault.NO_PERMIT), ("temperature_ok_i", Fault.OVER_TEMPERATURE)):
        await armed(dut)
        for count in (1, 2):
            getattr(dut, name).value = 0
            await clocks(dut)
            getattr(dut, name).value = 1
            await clocks(dut, 2)
            assert (int(dut.hv_enable_o.value), fault(dut)) == (0, cause)
            assert dut.fault_count_o.value == count
            await pulse(dut, dut.clear_i)
            dut.ramp_done_i.value = 1
            await pulse(dut, dut.arm_i, heard_i=1)
            await clocks(dut, SETTLE_TICKS + DRIVE_TICKS + 2)
            assert (int(dut.hv_enable_o.value), fault(dut)) == (1, Fault(0))
