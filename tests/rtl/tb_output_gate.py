"""output_gate: what it lets through, and each way in which it shuts."""

import itertools

import cocotb
from clocked import after_reset, clocks, pulse

HEARTBEAT_TICKS = 40
ALL = 0xFFFFFFFF
NO_PERMIT, HOST_SILENT = 0b01, 0b10


async def armed(dut):
    """Fed, armed and ramped up, with all channels asked high."""
    settings = {"run_permit_i": 1, "heartbeat_ticks_i": HEARTBEAT_TICKS, "channel_mask_i": ALL, "drive_i": ALL, "bit_ticks_i": 5}
    await after_reset(dut, **settings)
    await clocks(dut, 3)
    assert dut.channel_o.value == 0
    assert dut.off_o.value == 1
    await arm(dut)


async def arm(dut):
    await feed(dut)
    await pulse(dut, dut.arm_i)
    assert dut.ramp_up_o.value == 1
    await pulse(dut, dut.ramp_done_i)
    assert dut.armed_o.value == 1
    await clocks(dut, 3)
    assert (int(dut.channel_o.value), int(dut.hv_enable_o.value)) == (ALL, 1)


async def feed(dut):
    await pulse(dut, dut.heartbeat_i)


def is_shut(dut):
    pins = (dut.channel_o, dut.hv_enable_o, dut.focus_o, dut.hv_alive_o)
    return not any(int(pin.value) for pin in pins)


@cocotb.test(timeout_time=10, timeout_unit="us")
async def shuts_when_the_host_falls_silent_and_keeps_the_cause(dut):
    await armed(dut)
    await feed(dut)
    for _ in range(HEARTBEAT_TICKS):
        assert dut.alive_o.value == 1
        assert not is_shut(dut)
        await clocks(dut)
    assert dut.alive_o.value == 0
    await clocks(dut)
    assert is_shut(dut)
    await feed(dut)
    await clocks(dut, 5)
    assert dut.fault_o.value == HOST_SILENT
    assert is_shut(dut)


@cocotb.test(timeout_time=10, timeout_unit="us")
async def shuts_with_the_clock_after_the_permit_goes_in_every_state(dut):
    for state in ("ramp_up", "armed", "ramp_down"):
        await armed(dut)
        if state == "ramp_up":
            await pulse(dut, dut.disarm_i)
            await pulse(dut, dut.ramp_done_i)
            await feed(dut)
            await pulse(dut, dut.arm_i)
        elif state == "ramp_down":
            await pulse(dut, dut.disarm_i)
        assert getattr(dut, f"{state}_o").value == 1
        await clocks(dut, 3)
        dut.run_permit_i.value = 0
        dut.ended_i.value = 1
        await clocks(dut)
        dut.ended_i.value = 0
        dut.run_permit_i.value = 1
        for _ in range(5):
            assert is_shut(dut)
            assert dut.off_o.value == 1
            await clocks(dut)
        assert dut.fault_o.value == NO_PERMIT
        assert dut.emissions_o.value == 0
        await pulse(dut, dut.clear_i)
        assert dut.fault_o.value == 0


@cocotb.test(timeout_time=10, timeout_unit="us")
async def does_not_reopen_for_a_moment_when_a_fault_is_cleared_at_once(dut):
    await armed(dut)
    dut.run_permit_i.value = 0
    await clocks(dut)
    dut.run_permit_i.value = 1
    await pulse(dut, dut.clear_i)
    for _ in range(5):
        assert is_shut(dut)
        await clocks(dut)


@cocotb.test(timeout_time=10, timeout_unit="us")
async def a_fault_in_the_very_clock_of_a_clear_is_kept(dut):
    await armed(dut)
    dut.run_permit_i.value = 0
    await pulse(dut, dut.clear_i)
    assert dut.fault_o.value == NO_PERMIT
    assert is_shut(dut)


@cocotb.test(timeout_time=10, timeout_unit="us")
async def stays_open_through_the_ramp_down_and_no_longer(dut):
    await armed(dut)
    await pulse(dut, dut.disarm_i)
    assert dut.ramp_down_o.value == 1
    await clocks(dut, 5)
    assert not is_shut(dut)
    await pulse(dut, dut.disarm_i)
    assert dut.ramp_down_o.value == 1
    await pulse(dut, dut.ramp_done_i)
    await clocks(dut, 3)
    assert is_shut(dut)
    assert dut.fault_o.value == 0
    dut.run_permit_i.value = 0
    await clocks(dut, HEARTBEAT_TICKS + 5)
    assert dut.fault_o.value == 0, "off: no outputs to shut, no fault"


@cocotb.test(timeout_time=10, timeout_unit="us")
async def turns_back_even_in_the_clock_in_which_the_ramp_up_ends(dut):
    await armed(dut)
    await pulse(dut, dut.disarm_i)
    await pulse(dut, dut.ramp_done_i)
    await feed(dut)
    await pulse(dut, dut.arm_i)
    dut.disarm_i.value = 1
    await pulse(dut, dut.ramp_done_i)
    dut.disarm_i.value = 0
    assert dut.ramp_down_o.value == 1


@cocotb.test(timeout_time=10, timeout_unit="us")
async def lets_only_masked_in_channels_through(dut):
    await armed(dut)
    dut.channel_mask_i.value = 0x0F0F00FF
    await clocks(dut)
    assert int(dut.channel_o.value) == 0x0F0F00FF
    dut.drive_i.value = 0x12345678
    await clocks(dut)
    assert int(dut.channel_o.value) == 0x12345678 & 0x0F0F00FF


@cocotb.test(timeout_time=10, timeout_unit="us")
async def the_focus_pin_is_high_for_one_drive_word_and_each_end_is_counted(dut):
    await armed(dut)
    await pulse(dut, dut.ended_i)
    high = 0
    while dut.focus_o.value:
        high += 1
        await clocks(dut)
    assert high == 5
    for _ in range(2):  # ends one drive word apart: high all the while
        await pulse(dut, dut.ended_i)
        for _ in range(4):
            assert dut.focus_o.value == 1
            await clocks(dut)
    assert dut.emissions_o.value == 3


@cocotb.test(timeout_time=20, timeout_unit="us")
async def gives_signs_of_life_only_while_open(dut):
    await armed(dut)
    levels = []
    for _ in range(60):
        await feed(dut)
        levels.append(int(dut.hv_alive_o.value))
    changes = [n for n in range(1, 60) if levels[n] != levels[n - 1]]
    assert {later - earlier for earlier, later in itertools.pairwise(changes)} == {7}
