"""status_encoder: the answer that controller.device.fpga.frames reads, as of the beginning of a frame."""

import random

import cocotb
from clocked import after_reset, clocks, pulse, reset

from controller.device.fpga.frames import ECHO_DELAY_BYTES, FRAME_BYTES
from controller.device.fpga.registers import Fault, Result, State
from controller.device.fpga.status import Status, pack_status

NAMES = (
    "result_i",
    "sequence_i",
    "state_i",
    "fault_i",
    "data_i",
    "triggers_i",
    "timestamp_i",
    "emissions_i",
    "queued_i",
    "chunks_i",
    "ignored_i",
)
REPLIES = ("result_i", "sequence_i", "data_i")  # taken a clock later
BITS = (8, 8, 16, 16, 32, 32, 64, 32, 8, 8, 16)


def packed(values):
    """The 36 bytes of a status of these values, made by the host's own code."""
    buffer = bytearray(FRAME_BYTES)
    result, sequence, state, fault, *rest = values
    pack_status(buffer, 0, Status(Result(result), sequence, State(state), Fault(fault), *rest))
    return bytes(buffer)


async def snapshot(dut, values):
    given = dict(zip(NAMES, values, strict=True))
    replies = [given.pop(name) for name in REPLIES]
    await pulse(dut, dut.select_i, **given, **{name: random.getrandbits(8) for name in REPLIES})
    for name in given:
        getattr(dut, name).value = 0  # what changes afterwards is of no account
    for name, value in zip(REPLIES, replies, strict=True):
        getattr(dut, name).value = value
    if int(dut.byte_o.value) == 0x5A and random.random() < 0.5:
        return  # taken in the very next clock
    await clocks(dut, 1)
    for name in REPLIES:
        getattr(dut, name).value = 0


async def exchange(dut, count, mosi=b""):
    """Take `count` bytes as spi_peripheral does: byte k is taken before byte k - 1 has come in whole."""
    answer = bytearray()
    for number in range(count):
        answer.append(int(dut.byte_o.value))
        await pulse(dut, dut.take_i)
        await clocks(dut, random.randrange(3))
        if 0 < number <= len(mosi):
            await pulse(dut, dut.byte_valid_i, byte_i=mosi[number - 1])
            dut.byte_i.value = random.getrandbits(8)
            await clocks(dut, random.randrange(2))
    return bytes(answer)


def random_values():
    return [random.choice(list(Result)), *(random.choice([0, (1 << n) - 1, random.getrandbits(n)]) for n in BITS[1:])]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def sends_a_snapshot_its_crc_and_then_zeros(dut):
    await after_reset(dut)
    for turn in range(20):
        values = random_values()
        await snapshot(dut, values)
        answer = await exchange(dut, 130, random.randbytes(130) if turn % 2 else b"")
        assert answer[:FRAME_BYTES] == packed(values)
        assert not any(answer[FRAME_BYTES:])


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def each_field_has_its_place(dut):
    await after_reset(dut)
    for place, bits in enumerate(BITS[1:], 1):
        for value in (1, 1 << bits - 1, (1 << bits) - 1):
            values = [Result.OK] + [0] * 10
            values[place] = value
            await snapshot(dut, values)
            assert await exchange(dut, FRAME_BYTES) == packed(values), NAMES[place]


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def behind_the_status_a_test_gets_back_what_it_brought_two_bytes_later(dut):
    await after_reset(dut, echo_i=1)
    for length in (36, 37, 100, 512):
        values, mosi = random_values(), random.randbytes(length)
        await snapshot(dut, values)
        answer = await exchange(dut, length, mosi)
        assert answer[:FRAME_BYTES] == packed(values), "within the status nothing comes back"
        assert answer[FRAME_BYTES:] == mosi[FRAME_BYTES - ECHO_DELAY_BYTES : length - ECHO_DELAY_BYTES]
    dut.echo_i.value = 0
    await clocks(dut)
    assert dut.byte_o.value == 0, "once it is no TEST, nothing does"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_new_frame_or_a_reset_in_the_middle_begins_anew(dut):
    await after_reset(dut)
    for taken in (0, 1, 31, 32, 34, 35, 36, 40):
        await snapshot(dut, random_values())
        await exchange(dut, taken)
        values = random_values()
        await snapshot(dut, values)
        assert await exchange(dut, 40) == packed(values) + bytes(4)
        await snapshot(dut, random_values())
        await exchange(dut, taken)
        await reset(dut)
        assert dut.byte_o.value == 0
        values = random_values()
        await snapshot(dut, values)
        assert await exchange(dut, 40) == packed(values) + bytes(4)
    dut.echo_i.value = 1
    await pulse(dut, dut.byte_valid_i, byte_i=0x77)
    await reset(dut)
    assert (await exchange(dut, 37))[36] == 0, "what came before a reset does not come back"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def nothing_moves_unless_it_is_taken(dut):
    await after_reset(dut)
    values = random_values()
    await snapshot(dut, values)
    for number in (0, 15, 31, 32, 35):
        while True:
            byte = int(dut.byte_o.value)
            assert byte == packed(values)[number]
            await clocks(dut, 7)
            assert int(dut.byte_o.value) == byte
            break
        following = {0: 15, 15: 16, 31: 1, 32: 3, 35: 1}[number]
        await exchange(dut, following)
    assert dut.byte_o.value == 0
