"""waveform_buffer: what is stored is what is read, and nothing loaded touches it."""

import random

import cocotb
from clocked import after_reset, clocks, pulse

from controller.fpga.registers import Result

SLOTS = 2


async def load(dut, chunk, words, accepted=True, busy=0):
    for number, word in enumerate(words):
        await pulse(dut, dut.write_i, write_chunk_i=chunk, write_word_i=number, write_data_i=word)
    if accepted:
        dut.argument_i.value, dut.load_words_i.value, dut.landing_busy_i.value = chunk, len(words), busy
        dut.load_i.value = 1
        await clocks(dut)
        dut.load_i.value = 0
    return Result(int(dut.load_result_o.value))


async def store(dut, slot, length):
    dut.argument_i.value, dut.word0_i.value = slot, length
    await clocks(dut)
    result = Result(int(dut.store_result_o.value))
    await pulse(dut, dut.store_i)
    return result


async def contents(dut, slot):
    dut.argument_i.value = slot
    await clocks(dut)
    dut.read_buffer_i.value = int(dut.slot_buffer_o.value)
    words = []
    for number in range(int(dut.slot_words_o.value)):
        dut.read_word_i.value = number
        await clocks(dut)
        words.append(int(dut.read_data_o.value))
    return words


def random_words(count):
    return [random.getrandbits(32) for _ in range(count)]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def keeps_in_each_slot_what_was_stored_whatever_is_loaded_later(dut):
    await after_reset(dut)
    kept = {slot: [] for slot in range(SLOTS)}
    for turn, (slot, length) in enumerate([(0, 1000), (1, 126), (0, 7), (1, 250), (0, 125), (0, 20)]):
        words = random_words(length)
        order = list(range(0, length, 125))
        random.shuffle(order)
        for first in order:
            assert await load(dut, first // 125, words[first : first + 125]) is Result.OK
        assert {s: await contents(dut, s) for s in kept} == kept
        assert await store(dut, slot, length) is Result.OK
        kept[slot] = words
        assert {s: await contents(dut, s) for s in kept} == kept, turn
        assert int(dut.loaded_o.value) == sum(1 << s for s in kept if kept[s])


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def stores_only_what_has_arrived_whole(dut):
    await after_reset(dut)
    for chunk in (0, 1, 2):
        await load(dut, chunk, random_words(125 if chunk < 2 else 30))
    assert await store(dut, 0, 281) is Result.INCOMPLETE
    assert await store(dut, 0, 0) is Result.BAD_VALUE
    assert await store(dut, 0, 1001) is Result.BAD_VALUE
    assert await store(dut, 0, 0x10001) is Result.BAD_VALUE
    assert await store(dut, SLOTS, 280) is Result.BAD_SLOT
    await load(dut, 1, random_words(3), accepted=False)  # begun again, never accepted
    assert await store(dut, 0, 280) is Result.INCOMPLETE
    await load(dut, 1, random_words(124))
    assert await store(dut, 0, 280) is Result.INCOMPLETE
    await load(dut, 1, random_words(125))
    assert await store(dut, 0, 280) is Result.OK
    assert await store(dut, 0, 1) is Result.INCOMPLETE
    assert len(await contents(dut, 0)) == 280


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_load_that_was_refused_does_not_count(dut):
    await after_reset(dut)
    assert await load(dut, 0, [], busy=1) is Result.BUSY
    assert await store(dut, 0, 1) is Result.INCOMPLETE
    dut.argument_i.value = 8
    await clocks(dut)
    assert int(dut.load_result_o.value) == Result.BAD_CHUNK
