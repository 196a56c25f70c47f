"""Statuses checked all at once: the same by the compiled kernel, by its twin, and one by one."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device import kernel
from controller.device.fpga.frames import FRAME_BYTES
from controller.device.fpga.registers import Fault, Result, State
from controller.device.fpga.status import DONE, Status, pack_status
from controller.device.kernel import twin

SEQUENCE, START = 254, 12  # numbers go on with 0 behind 255
NONE = Fault(0)


def statuses(count, result=Result.OK, faults=NONE):
    buffer = bytearray(b"\xee" * (START + count * FRAME_BYTES + 5))
    end = START
    for number in range(count):
        last = number == count - 1
        status = Status(
            result if last else Result.OK,
            SEQUENCE + number & 0xFF,
            State.ARMED,
            faults if last else NONE,
            7,
            number,
            10**12 + number,
            3,
        )
        end = pack_status(buffer, end, status)
    return buffer


def good(answers, start, count, sequence=SEQUENCE):
    by_kernel = kernel.statuses_good(answers, start, count, DONE, sequence)
    assert by_kernel is twin.statuses_good(answers, start, count, DONE, sequence)
    return by_kernel


@each_row("count", [0, 1, 2, 5])
def test_statuses_of_frames_that_were_done_are_good(count):
    assert good(statuses(count), START, count)
    assert good(statuses(count), START, count, SEQUENCE + 256)
    assert good(statuses(count), START, count, SEQUENCE + 1) == (count == 0)


@each_row("result", [result for result in Result if result is not Result.OK])
def test_one_that_was_not_done_is_found(result):
    assert not good(statuses(3, result), START, 3)
    assert good(statuses(3, result), START, 2)


@each_row("fault", list(Fault))
def test_a_fault_is_found(fault):
    assert not good(statuses(2, faults=fault), START, 2)


@given(st.integers(0, 3 * 8 * FRAME_BYTES - 1))
def test_any_damaged_bit_is_found(bit):
    answers = statuses(3)
    answers[START + bit // 8] ^= 1 << bit % 8
    assert not good(answers, START, 3)


@each_row(("start", "count"), [(0, 3), (-1, 1), (START, -1), (2 * FRAME_BYTES, 1), (10**9, 0)])
def test_statuses_beyond_the_buffer_are_refused(start, count):
    for checked in (kernel.statuses_good, twin.statuses_good):
        with pytest.raises(ValueError, match="statuses from byte"):
            checked(bytes(2 * FRAME_BYTES + 3), start, count, DONE, 0)
