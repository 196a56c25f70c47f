"""crc32_word: the sum that zlib computes over little-endian words."""

import random
import zlib

import cocotb
from clocked import after_reset, clocks, pulse, reset


async def feed(dut, words):
    for word in words:
        await pulse(dut, dut.valid_i, word_i=word)
        dut.word_i.value = random.getrandbits(32)  # not valid: of no account
        await clocks(dut, random.randrange(3))


def crc(words):
    return zlib.crc32(b"".join(word.to_bytes(4, "little") for word in words))


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def is_the_crc_of_zlib_for_any_words_at_any_pace(dut):
    await after_reset(dut)
    assert int(dut.crc_o.value) == crc([]), "after reset no word has come"
    for words in ([], [0], [0xFFFFFFFF], [1], [0x80000000], *([random.getrandbits(32) for _ in range(n)] for n in (2, 3, 60))):
        await pulse(dut, dut.clear_i)
        await feed(dut, words)
        assert int(dut.crc_o.value) == crc(words)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_reset_and_a_clear_forget_even_the_word_of_their_clock(dut):
    await after_reset(dut)
    for forget in (dut.clear_i, dut.rst_i):
        await feed(dut, [1, 2, 3])
        dut.valid_i.value = 1
        await pulse(dut, forget)
        dut.valid_i.value = 0
        assert int(dut.crc_o.value) == 0
        await feed(dut, [7])
        assert int(dut.crc_o.value) == crc([7])
    await reset(dut)
    assert int(dut.crc_o.value) == 0
