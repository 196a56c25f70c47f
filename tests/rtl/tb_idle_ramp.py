"""idle_ramp: the bits of the model, up, down and turned back on the way."""

import random

import cocotb
from clocked import after_reset, clocks, reset

from controller.workshop.gateware.model.pins import ramp_bits, turned_ramp_bits


async def bits_while(dut, signal, bit_ticks, most=10_000):
    """Raise up_i or down_i until the glide is done; its bits, two clocks late, sampled in the middle of each."""
    signal.value = 1
    bits, done = [], False
    for tick in range(most):
        await clocks(dut)
        if tick % bit_ticks == 1:
            bits.append(bool(dut.bit_o.value))
        assert not bits or int(dut.bit_o.value) == bits[-1], "changed within a drive word"
        if dut.done_o.value:
            done = True
            await clocks(dut)
            break
    signal.value = 0
    return bits, done


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def glides_up_and_down_as_the_model_does(dut):
    few = [(samples, random.choice([4, 4, 5, 6])) for samples in range(1, 24)]
    for samples, bit_ticks in (*few, (500, 4), (97, 7)):
        await after_reset(dut, samples_i=samples, bit_ticks_i=bit_ticks)
        assert await bits_while(dut, dut.up_i, bit_ticks) == (ramp_bits(samples, up=True).tolist(), True)
        dut.stay_i.value = 1
        await clocks(dut, random.randrange(1, 20))
        dut.stay_i.value = 0
        assert await bits_while(dut, dut.down_i, bit_ticks) == (ramp_bits(samples, up=False).tolist(), True)


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def turns_back_from_where_it_is(dut):
    for reached in (1, 37, 199):
        samples, bit_ticks = 200, 6
        await after_reset(dut, samples_i=samples, bit_ticks_i=bit_ticks)
        bits, done = await bits_while(dut, dut.up_i, bit_ticks, most=reached * bit_ticks)
        assert bits == ramp_bits(samples, up=True)[:reached].tolist()
        assert not done
        assert await bits_while(dut, dut.down_i, bit_ticks) == (turned_ramp_bits(samples, reached).tolist(), True)


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def turned_back_at_the_very_top_it_comes_down_as_from_rest(dut):
    samples, bit_ticks = 103, 4
    await after_reset(dut, samples_i=samples, bit_ticks_i=bit_ticks)
    await bits_while(dut, dut.up_i, bit_ticks)
    assert await bits_while(dut, dut.down_i, bit_ticks) == (ramp_bits(samples, up=False).tolist(), True)


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def begins_anew_after_being_shut(dut):
    await after_reset(dut, samples_i=300, bit_ticks_i=4)
    await bits_while(dut, dut.up_i, 4, most=555)
    await clocks(dut, 3)
    assert await bits_while(dut, dut.up_i, 4) == (ramp_bits(300, up=True).tolist(), True)


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def a_reset_in_the_middle_puts_the_level_back_to_zero(dut):
    for reached in (3, 100, 555):
        await after_reset(dut, samples_i=300, bit_ticks_i=4, stay_i=1)
        await bits_while(dut, dut.up_i, 4, most=reached)
        await reset(dut)
        assert dut.bit_o.value == 0
        await clocks(dut, random.randrange(3))
        assert await bits_while(dut, dut.up_i, 4) == (ramp_bits(300, up=True).tolist(), True)
