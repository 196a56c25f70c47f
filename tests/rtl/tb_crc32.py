"""crc32: the sum that zlib computes."""

import random
import zlib

import cocotb
from clocked import after_reset, clocks, pulse

RESIDUE = 0xDEBB20E3


@cocotb.test(timeout_time=100, timeout_unit="us")
async def is_the_crc_of_zlib_for_any_bytes_at_any_pace(dut):
    await after_reset(dut)
    for length in (0, 1, 2, 3, 60):
        data = random.randbytes(length)
        await pulse(dut, dut.clear_i)
        for number, byte in enumerate(data + zlib.crc32(data).to_bytes(4, "little")):
            if number == length:
                assert int(dut.crc_o.value) ^ 0xFFFFFFFF == zlib.crc32(data)
            await pulse(dut, dut.valid_i, byte_i=byte)
            dut.byte_i.value = random.getrandbits(8)  # not valid: of no account
            await clocks(dut, random.randrange(3))
        assert int(dut.crc_o.value) == RESIDUE
