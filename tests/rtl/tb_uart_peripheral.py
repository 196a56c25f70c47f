"""uart_peripheral: frames and answers as COBS over 8N1, and what becomes of a line that breaks, glitches or drifts."""

import random

import cocotb
from clocked import after_reset, clocks
from cobs import cobs
from cocotb.triggers import FallingEdge
from uart import ByteLink, Wire

ANSWER = 36
ANSWER_BITS = 10 * (ANSWER + 2)


async def begin(dut):
    await after_reset(dut, uart_rx_i=1)
    wire, link = Wire(dut), ByteLink(dut, ANSWER)
    await wire.bits(2)
    await wire.send(b"\0")
    return wire, link


async def silence(wire):
    """Until the longest answer has gone."""
    await wire.bits(ANSWER_BITS + 20)


def payload(size, zeros):
    """Random bytes of which about the share `zeros` is 0."""
    return bytes(0 if random.random() < zeros else random.randrange(1, 256) for _ in range(size))


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def frames_come_out_as_they_were_and_each_is_answered(dut):
    wire, link = await begin(dut)
    sent = [payload(random.randrange(40, 120), random.choice((0.0, 0.1, 0.5, 1.0))) for _ in range(12)]
    for frame in sent:
        await wire.frame(frame)
    await silence(wire)
    assert link.frames == [(frame, False) for frame in sent]
    assert wire.answers == link.given
    assert len(wire.answers) == len(sent)


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def blocks_of_254_bytes_and_more_come_out_as_they_were(dut):
    wire, link = await begin(dut)
    long = payload(515, 0.0)
    sent = [long[:253], long[:254], long[:255], long[:254] + b"\0", long[:254] + b"\0\0", long[:508], long, b"\0" * 512]
    for frame in sent:
        await wire.frame(frame)
    await silence(wire)
    assert link.frames == [(frame, False) for frame in sent]
    assert wire.answers == link.given


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def either_end_may_be_two_percent_off(dut):
    wire, link = await begin(dut)
    for rate in (0.98, 1.02):
        wire.rate = rate
        link.frames.clear()
        sent = [payload(60, 0.1), payload(60, 0.9), b"\xff" * 60, b"\x55" * 60]
        for frame in sent:
            await wire.frame(frame)
            await wire.bits(random.random())
        await silence(wire)
        assert link.frames == [(frame, False) for frame in sent], rate
    assert wire.answers == link.given


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def the_rate_is_right_to_a_thousandth(dut):
    """37 bytes from start bit to start bit; a clock more per bit would be 1 % at 100 clocks a bit."""
    wire, _ = await begin(dut)
    await wire.frame(payload(50, 0.1))
    await silence(wire)
    assert len(wire.starts_ns) == ANSWER + 2
    byte_ns = (wire.starts_ns[-1] - wire.starts_ns[0]) / (ANSWER + 1)
    error = byte_ns / (10 * wire.bit_ns) - 1
    dut._log.info("rate off by %.4f %%", 100 * error)
    assert abs(error) < 1e-3


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def the_answer_goes_out_while_the_frame_comes_in(dut):
    wire, link = await begin(dut)
    await wire.frame(payload(200, 0.1))
    assert len(link.given) == 1
    assert wire.answers == link.given, "sent long before the frame's end"


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_frame_that_begins_before_the_last_answer_has_gone_gets_none_but_counts(dut):
    wire, link = await begin(dut)
    sent = [payload(size, 0.2) for size in (5, 6, 60, 60)]
    for frame in sent:
        await wire.frame(frame)
    await silence(wire)
    assert link.frames == [(frame, False) for frame in sent]
    assert link.selects == 4
    assert wire.answers == link.given
    assert len(wire.answers) == 2, "of the first; of the third none: its answer's wire was still in use; of the fourth"


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def two_zeros_before_each_short_frame_keep_every_answer_from_a_host_that_is_too_fast(dut):
    """What serial_link.py sends, at a host 4 % faster than the gateware."""
    wire, link = await begin(dut)
    wire.rate = 1.04
    for _ in range(16):
        await wire.send(b"\0\0")
        await wire.frame(payload(ANSWER, 0.2))
    await silence(wire)
    assert len(link.frames) == len(wire.answers) == 16
    assert wire.answers == link.given


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def without_those_zeros_answers_are_left_out(dut):
    wire, link = await begin(dut)
    wire.rate = 1.04
    for _ in range(16):
        await wire.frame(payload(ANSWER, 0.2))
    await silence(wire)
    assert len(link.frames) == 16
    assert 8 <= len(wire.answers) < 16


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def zeros_alone_are_no_frames(dut):
    wire, link = await begin(dut)
    await wire.send(bytes(5))
    assert link.selects == 0
    await wire.frame(b"after")
    await wire.frame(b"")
    await silence(wire)
    assert link.frames == [(b"after", False), (b"", False)]


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def malformed_frames_are_reported_and_the_next_one_is_whole(dut):
    wire, link = await begin(dut)
    await wire.send(b"\x05abc\0")  # one byte short
    await wire.send(b"\x03ab\xff\0")  # the block announced is not there
    await wire.send(b"\xff\0")
    await wire.frame(b"whole")
    await silence(wire)
    assert link.frames == [(b"abc", True), (b"ab\0", True), (b"", True), (b"whole", False)]


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_missing_stop_bit_refuses_the_frame_wherever_it_is(dut):
    wire, link = await begin(dut)
    frame = payload(20, 0.3)
    line = cobs.encode(frame)
    for damaged in (0, 1, 10, len(line) - 1, len(line)):
        link.frames.clear()
        for number, byte in enumerate(line + b"\0"):
            await wire.send_byte(byte, stop=int(number != damaged))
            if number == damaged:
                await wire.bits(1)
        await wire.frame(frame)
        await wire.bits(5)
        assert [partial for _, partial in link.frames] == [True, False], damaged
        assert link.frames[1][0] == frame
        await silence(wire)


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_break_ends_a_frame_as_refused_and_between_frames_is_nothing(dut):
    wire, link = await begin(dut)
    dut.uart_rx_i.value = 0
    await wire.bits(200)
    dut.uart_rx_i.value = 1
    await wire.bits(1)
    assert link.selects == 0
    await wire.frame(b"one")
    await wire.send(cobs.encode(b"cut off")[:4])
    dut.uart_rx_i.value = 0
    await wire.bits(25)
    dut.uart_rx_i.value = 1
    await wire.bits(1)
    await wire.frame(b"two")
    await silence(wire)
    assert link.frames == [(b"one", False), (b"cut", True), (b"two", False)]


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def glitches_shorter_than_half_a_bit_are_not_seen(dut):
    wire, link = await begin(dut)
    for _ in range(20):
        dut.uart_rx_i.value = 0
        await wire.bits(random.uniform(0.05, 0.35))
        dut.uart_rx_i.value = 1
        await wire.bits(random.uniform(0.6, 12))
    assert link.selects == 0
    await wire.frame(b"after")
    await silence(wire)
    assert link.frames == [(b"after", False)]


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def a_missing_delimiter_or_any_garbage_costs_its_own_frame_only(dut):
    wire, link = await begin(dut)
    one, two = payload(30, 0.1), payload(40, 0.1)
    await wire.send(cobs.encode(one))  # and no zero
    await wire.frame(two)
    await wire.frame(b"next")
    assert len(link.frames) == 2
    assert link.frames[0][0] != two
    assert link.frames[1] == (b"next", False)
    for _ in range(4):
        garbage = payload(random.randrange(1, 1200), 0.0)
        await wire.send(garbage + b"\0")
        await wire.frame(two)
        await wire.bits(5)
        assert link.frames[-1] == (two, False)
    await silence(wire)
    assert wire.answers == link.given


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def any_stream_of_bytes_is_read_as_the_reference_reads_it(dut):
    wire, link = await begin(dut)
    stream = bytes(random.choice((0, 1, 2, 3, 4, 30, 255, random.randrange(256))) for _ in range(3000)) + b"\0"
    await wire.send(stream)
    await wire.bits(5)
    expected = []
    for line in stream.split(b"\0"):
        if line:
            try:
                expected.append((cobs.decode(line), False))
            except cobs.DecodeError:
                expected.append((None, True))
    assert len(link.frames) == len(expected)
    for (frame, partial), (reference, malformed) in zip(link.frames, expected, strict=True):
        assert partial == malformed
        assert malformed or frame == reference


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def after_a_reset_in_the_middle_nothing_counts_until_a_zero(dut):
    wire, link = await begin(dut)
    for _ in range(4):
        sending = cocotb.start_soon(wire.frame(payload(30, 0.0)))
        await wire.bits(random.uniform(20, 250))
        await FallingEdge(dut.clk_i)
        dut.rst_i.value = 1
        await clocks(dut, 2)
        assert dut.uart_tx_o.value == 1
        assert dut.select_o.value == dut.release_o.value == dut.byte_valid_o.value == dut.answer_take_o.value == 0
        dut.rst_i.value = 0
        link.forget()
        wire.forget()
        await sending
        assert link.frames == [], "the rest of a frame is not one"
        assert not wire.heard, "nor does the rest of an answer follow"
        await wire.send(b"\0")
        await wire.frame(b"whole")
        await wire.bits(5)
        assert link.frames == [(b"whole", False)]
        await silence(wire)
        assert wire.answers == link.given[-1:]


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def a_line_that_is_low_when_reset_ends_is_no_byte(dut):
    await after_reset(dut, uart_rx_i=0)
    wire, link = Wire(dut), ByteLink(dut, ANSWER)
    await wire.bits(30)
    dut.uart_rx_i.value = 1
    await wire.bits(1)
    await wire.frame(b"no zero was seen yet")
    await wire.frame(b"whole")
    await silence(wire)
    assert link.frames == [(b"whole", False)]
