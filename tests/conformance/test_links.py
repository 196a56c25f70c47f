"""SPI and UART at once: neither spoils or holds up a frame of the other, each reports on itself, and only the link that armed
keeps the outputs on. What the scripts do is done to the model and to the compiled Verilog, and compared change by change."""

import zlib
from dataclasses import asdict

import numpy as np
import pytest
from cobs import cobs
from pin_script import (
    BIT_TICKS,
    BUILD_HASH,
    FRAME_TICKS,
    JUDGED_TICKS,
    LINES,
    MODEL,
    RAMP_TICKS,
    SETTLE_TICKS,
    UART,
    Script,
    assert_same,
    perform_on_both,
)
from tables import each_row

from controller.device.fpga import frames
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import Control, Register, Result, Start, State
from controller.device.fpga.status import parse_status
from controller.workshop.gateware.pin_timing import frame_ticks
from controller.workshop.gateware.rtl_build import clocked_design

HEARTBEAT_TICKS = 20_000
PAUSE_TICKS = 60  # in which a short frame of the UART has room
UART_FRAME_TICKS = UART.bit_tick(0, FRAME_BYTES + 4, 0)
WORDS = np.arange(1, 31, dtype=np.uint32) * 0x01010101


def both(run, rtl):
    """The answers by SPI and the capture, which are the same of both."""
    left, right = perform_on_both(run, rtl)
    assert_same(left, right)
    answers, capture = left
    return [parse_status(answer) if len(answer) >= FRAME_BYTES else None for answer in answers], capture


def uart_answers(capture):
    """Statuses that came back by the UART, read off the changes of its line, of which the first is a fall."""
    ticks = capture.uart_ticks.astype(np.int64)
    wire, free = bytearray(), 0
    for start in ticks[::2]:
        if start >= free:
            middles = [UART.bit_tick(int(start), 0, bit) + UART.bit_tick(0, 0, 1) // 2 for bit in range(10)]
            low, *bits, high = (1 - np.searchsorted(ticks, middles, side="right") % 2).tolist()
            assert (low, high) == (0, 1)
            wire.append(sum(level << bit for bit, level in enumerate(bits)))
            free = middles[-1]
    return [parse_status(cobs.decode(answer)) for answer in bytes(wire).split(b"\0")[:-1]]


def settled(heartbeat_ticks=HEARTBEAT_TICKS):
    run = Script()
    run.settings()
    run.send(frames.pack_write, Register.HEARTBEAT_TICKS, heartbeat_ticks)
    return run


def arm_by_uart(run):
    """The tick in which its ARM is carried out."""
    run.uart(run.uart_frame(frames.pack_unlock, BUILD_HASH))
    end = run.uart(run.uart_frame(frames.pack_control, Control.ARM))
    run.wait_for_the_uart(SETTLE_TICKS + RAMP_TICKS + 300)
    return end


def off_tick(capture):
    """When the high voltage went off for the last time."""
    assert not capture.hv[-1]
    return int(capture.ticks[-1])


def test_polling_over_the_uart_does_not_keep_on_what_the_spi_has_armed(rtl):
    run = settled()
    armed = run.arm() + JUDGED_TICKS
    for _ in range(8):
        run.uart(run.uart_frame(frames.pack_nop))
    run.wait_for_the_uart(UART_FRAME_TICKS)
    assert run.tick > armed + HEARTBEAT_TICKS + 2 * UART_FRAME_TICKS
    _, capture = both(run, rtl)
    assert off_tick(capture) == armed + 1 + HEARTBEAT_TICKS + 1  # the ARM, and nothing else
    assert len([status for status in uart_answers(capture) if status.result is Result.OK]) == 8


def test_polling_over_the_spi_does_not_keep_on_what_the_uart_has_armed(rtl):
    run = settled()
    run.status()
    arm_by_uart(run)
    for _ in range(2 * HEARTBEAT_TICKS // FRAME_TICKS):
        run.status()
    statuses, capture = both(run, rtl)
    last = uart_answers(capture)[-1]
    assert last.sequence == 1  # of the UNLOCK: the ARM is answered by nothing that came behind it
    assert any(State.HV_ENABLE in status.state for status in statuses)
    assert State.HEARTBEAT not in statuses[-1].state
    on = int(capture.ticks[np.flatnonzero(capture.hv)[0]])
    assert HEARTBEAT_TICKS - 10 < off_tick(capture) - on < HEARTBEAT_TICKS + 10


@pytest.mark.parametrize("port", ["spi", "uart"])
def test_the_link_that_armed_keeps_the_outputs_on(rtl, port):
    run = settled()
    if port == "spi":
        run.arm()
    else:
        run.status()
        arm_by_uart(run)
    begun = run.tick
    while run.tick < begun + 3 * HEARTBEAT_TICKS:
        if port == "spi":
            run.status()
            run.wait(HEARTBEAT_TICKS // 3)
        else:
            run.uart(run.uart_frame(frames.pack_nop))
            run.wait_for_the_uart(HEARTBEAT_TICKS // 3)
    last = run.tick
    run.wait(2 * HEARTBEAT_TICKS)
    _, capture = both(run, rtl)
    assert off_tick(capture) > last


def test_what_came_before_the_arm_does_not_count(rtl):
    """Nor does a frame while nothing is armed: the state says that nobody is heard."""
    run = settled()
    run.status()
    run.wait(HEARTBEAT_TICKS // 2)
    run.status()
    armed = run.arm() + JUDGED_TICKS
    run.wait(2 * HEARTBEAT_TICKS)
    statuses, capture = both(run, rtl)
    assert off_tick(capture) == armed + HEARTBEAT_TICKS + 2
    assert not any(State.HEARTBEAT in status.state for status in statuses)


def test_each_link_reports_on_itself_alone(rtl):
    run = settled()
    run.uart(run.uart_frame(frames.pack_read, Register.CLOCK_HZ))
    for _ in range(12):
        run.send(frames.pack_read, Register.IDENTITY)
        run.wait(PAUSE_TICKS)
    damaged = bytearray(run.uart_frame(frames.pack_nop))
    damaged[9] ^= 0x10
    run.uart(bytes(damaged))
    run.sequence += 3  # numbers skip by SPI
    for _ in range(12):
        run.send(frames.pack_read, Register.FRAME_ERRORS)
        run.wait(PAUSE_TICKS)
    run.send(frames.pack_read, Register.SEQUENCE_GAPS)
    run.uart(run.uart_frame(frames.pack_read, Register.FRAME_ERRORS))  # its number skips the damaged one
    run.uart(run.uart_frame(frames.pack_read, Register.SEQUENCE_GAPS))
    run.uart(run.uart_frame(frames.pack_nop))
    run.status()
    run.wait_for_the_uart(UART_FRAME_TICKS)
    statuses, capture = both(run, rtl)
    assert {status.result for status in statuses} == {Result.OK}
    assert (statuses[-2].data, statuses[-1].data) == (0, 1)
    by_uart = uart_answers(capture)
    assert [status.result for status in by_uart] == [Result.OK, Result.OK, Result.BAD_CRC, Result.OK, Result.OK]
    assert [status.sequence for status in by_uart] == [0, 1, 1, 3, 4]
    assert [status.data for status in by_uart[1:]] == [12_000_000, 12_000_000, 1, 1]


def test_unlocking_by_one_link_does_not_let_the_other_arm_and_noise_does_not_lock_again(rtl):
    run = settled()
    run.send(frames.pack_unlock, BUILD_HASH)
    run.uart(run.uart_frame(frames.pack_control, Control.ARM))
    run.uart(b"\0noise\0more of it\0")
    run.uart(run.uart_frame(frames.pack_nop))
    run.wait_for_the_uart(300)
    run.control(Control.ARM)
    run.wait(SETTLE_TICKS + RAMP_TICKS + 10)
    run.status()
    statuses, capture = both(run, rtl)
    assert uart_answers(capture)[1].result is Result.LOCKED
    assert State.ARMED in statuses[-1].state


@each_row("seed", range(3))
def test_a_flood_of_random_bytes_on_the_uart_costs_the_spi_no_frame(rtl, seed):
    rng = np.random.default_rng(seed)
    run = settled()
    run.arm()
    begun = len(run.steps)
    noise = rng.integers(0, 256, 900, dtype=np.uint8)
    noise[rng.random(900) < 0.2] = 0
    end = run.uart(noise.tobytes())
    count = 0
    while run.tick < end:
        run.slack_ticks = int(rng.integers(0, 3))
        if count % 20 == 0:
            run.upload(count % 2, WORDS)
        run.send(frames.pack_read, Register.FRAME_ERRORS)
        run.wait(int(rng.choice([0, 1, 5, 50, 300])))
        count += 1
    run.status()
    statuses, _ = both(run, rtl)
    sent = sum(method == "exchange" for method, _ in run.steps[begun:])
    assert sent > 100
    of_these = statuses[-sent + 1 :]
    assert {status.result for status in of_these} == {Result.OK}
    numbers = [status.sequence for status in of_these]
    assert numbers == [(numbers[0] + step) & 0xFF for step in range(len(numbers))]
    assert {status.data for status in of_these} == {0}, "none was refused"
    assert State.ARMED in of_these[-1].state


@each_row("offset", range(0, 60, 7))
def test_a_frame_of_the_uart_waits_for_a_pause_of_the_spi_whenever_that_begins(rtl, offset):
    """Chip select falls at every clock of the frame's turn: it is carried out once, and the SPI's frame too."""
    run = settled()
    run.arm()
    run.upload(0, WORDS)
    end = run.uart(run.uart_frame(frames.pack_play, Play(0, start=Start.NOW)))
    run.tick = end - UART.bit_tick(0, 0, 1) + offset
    for _ in range(3):
        run.status()
    run.wait(FRAME_TICKS)
    run.status()
    run.status()
    statuses, capture = both(run, rtl)
    assert {status.result for status in statuses} == {Result.OK}
    assert statuses[-1].emissions == len(capture.focus_ticks) == 1


def test_a_frame_that_finds_the_one_before_still_waiting_is_busy(rtl):
    run = settled()
    begin = run.tick
    end = run.uart(
        *(run.uart_frame(frames.pack_read, register) for register in (Register.CLOCK_HZ, Register.IDENTITY, Register.PROTOCOL))
    )
    while run.tick < end:
        run.send(frames.pack_test, bytes(500))  # with the shortest pauses: no frame has room between
    run.wait(200)
    run.uart(run.uart_frame(frames.pack_nop))
    run.wait_for_the_uart(UART_FRAME_TICKS)
    statuses, capture = both(run, rtl)
    assert {status.result for status in statuses} == {Result.OK}
    last = uart_answers(capture)[-1]
    assert (last.sequence, last.data) == (1, 12_000_000)
    assert begin < end


def test_an_upload_over_the_uart_plays_and_is_never_fast(rtl):
    run = settled(2_000_000)
    run.arm()
    run.uart(
        run.uart_frame(frames.pack_load, 0, memoryview(WORDS.tobytes())),
        run.uart_frame(frames.pack_play, Play(0xFFFF, length=30, start=Start.NOW)),
        run.uart_frame(frames.pack_nop),
    )
    run.wait_for_the_uart(300)
    run.uart(
        run.uart_frame(frames.pack_store, 1, 30, zlib.crc32(WORDS)),
        run.uart_frame(frames.pack_play, Play(1, start=Start.NOW)),
        run.uart_frame(frames.pack_nop),
    )
    run.wait_for_the_uart(UART_FRAME_TICKS)
    _, capture = both(run, rtl)
    results = [status.result for status in uart_answers(capture)]
    assert results == [Result.OK, Result.OK, Result.LINK_SLOW, Result.OK, Result.OK, Result.OK]
    assert capture.focus_ticks.size == 1
    assert [word for word in capture.words.tolist() if word in WORDS.tolist()] == WORDS.tolist()


def test_a_load_by_the_uart_is_not_taken_for_as_fast_as_one_by_the_spi_a_moment_before(rtl):
    run = settled(2_000_000)
    run.send(frames.pack_write, Register.BIT_PERIOD, 120 << 16)
    run.arm()
    run.wait(RAMP_TICKS * 20)
    fast = memoryview(np.arange(125, dtype=np.uint32).tobytes())
    end = run.uart(run.uart_frame(frames.pack_load, 0, memoryview(WORDS.tobytes())))
    run.tick = end - frame_ticks(len(fast) + 12) - 200
    run.send(frames.pack_load, 1, fast)
    run.wait_for_the_uart(200)
    run.send(frames.pack_play, Play(0xFFFF, length=30, start=Start.NOW))
    run.status()
    statuses, _ = both(run, rtl)
    assert statuses[-1].result is Result.LINK_SLOW
    assert statuses[-1].chunks == 0b11


def load_by_uart(run, chunk, words):
    """A LOAD by the UART, carried out before what follows."""
    run.uart(run.uart_frame(frames.pack_load, chunk, memoryview(np.asarray(words, np.uint32).tobytes())))
    run.wait_for_the_uart(UART_FRAME_TICKS)  # its answer is longer than such a frame


def test_a_load_by_the_uart_spares_what_still_plays_from_the_landing_buffer(rtl):
    """A slot is stored again while it plays: its words are in the landing buffer until it has ended."""
    run = settled(2_000_000)
    run.upload(0, WORDS)
    run.arm()
    run.send(frames.pack_play, Play(0, emissions=0, period_ticks=BIT_TICKS * len(WORDS), start=Start.NOW))
    run.wait(100)
    run.upload(0, WORDS[::-1])
    load_by_uart(run, 0, [0xBAD, 0xBAD])
    run.control(Control.STOP)
    run.wait(1000)
    load_by_uart(run, 0, [0x600D])
    run.uart(run.uart_frame(frames.pack_nop))
    run.wait_for_the_uart(UART_FRAME_TICKS)
    _, capture = both(run, rtl)
    assert [status.result for status in uart_answers(capture)][1:] == [Result.BUSY, Result.OK]
    assert 0xBAD not in capture.words


def test_a_load_by_the_uart_brings_a_live_play_new_chunks_only(rtl):
    run = settled(2_000_000)
    run.send(frames.pack_write, Register.BIT_PERIOD, 120 << 16)
    run.send(frames.pack_write, Register.EMISSION_TICKS, 120_000)
    run.arm()
    run.wait(RAMP_TICKS * 20)
    words = np.arange(1, 251, dtype=np.uint32)
    run.send(frames.pack_load, 0, memoryview(words[:125].tobytes()))
    run.send(frames.pack_play, Play(0xFFFF, length=200, start=Start.NOW))
    load_by_uart(run, 1, words[125:135])
    load_by_uart(run, 0, [0xBAD])
    run.uart(run.uart_frame(frames.pack_nop))
    run.wait_for_the_uart(UART_FRAME_TICKS)
    _, capture = both(run, rtl)
    assert [status.result for status in uart_answers(capture)][1:] == [Result.OK, Result.BUSY]
    played = [word for word in capture.words.tolist() if word in words]
    assert played == words[:135].tolist(), "then an underrun"


@pytest.mark.parametrize("port", ["spi", "uart"])
def test_a_load_of_a_chunk_that_does_not_exist_leaves_those_that_do(rtl, port):
    run = settled()
    data = memoryview(WORDS.tobytes())
    run.send(frames.pack_load, 0, data)
    frame = bytearray(run.packed(frames.pack_load, 0, memoryview(bytes(len(data)))))
    frame[6] = 8
    frame[-4:] = zlib.crc32(frame[:-4]).to_bytes(4, "little")
    if port == "spi":
        run.exchange(frame)
    else:
        run.uart(b"\0\0" + cobs.encode(bytes(frame)) + b"\0")
        run.wait_for_the_uart(300)
    run.store(0, WORDS)
    run.status()
    run.send(frames.pack_read, Register.SLOTS_LOADED)
    run.status()
    statuses, _ = both(run, rtl)
    assert statuses[-1].data == 0b1


@each_row("bytes_apart", [0, 37, 38, 39])
def test_an_answer_waits_for_the_last_byte_of_the_one_before(rtl, bytes_apart):
    """Frames are shorter than their answers: whose answer finds no room gets none, in every tick at which that ends."""
    run = settled()
    lone = run.uart_frame(frames.pack_load, 0, memoryview(WORDS[:1].tobytes()))
    for ticks in range(-60, 150, 7):
        begin = run.tick
        run.uart(lone)
        run.uart(lone, tick=max(run.tick, begin + UART.bit_tick(0, bytes_apart, 0) + ticks))
        run.wait_for_the_uart(UART_FRAME_TICKS + 2000)
    both(run, rtl)


def test_every_line_moves_in_these_comparisons(rtl):
    run = settled()
    run.arm()
    run.upload(0, WORDS)
    run.send(frames.pack_play, Play(0))
    run.wait(PAUSE_TICKS)
    run.uart(run.uart_frame(frames.pack_nop))
    run.trigger()
    run.permit(False)
    run.wait_for_the_uart(UART_FRAME_TICKS)
    _, capture = both(run, rtl)
    assert all(getattr(capture, name).size for name in LINES)


class WithoutUart(BuildParameters):
    """Of a board whose top.v has no UART."""

    def verilog(self):
        return super().verilog() | {"UART": 0}


@pytest.mark.slow
def test_gateware_without_a_uart_is_that_of_a_uart_on_which_nothing_comes(rtl):
    """What comes on its pin is not even an error, and its line rests. Leaps look into the UART, so every clock is computed."""

    def without(parameters):
        return rtl(WithoutUart(**asdict(parameters)), design=clocked_design())

    def script(noise):
        run = settled(200_000)
        if noise:
            run.uart(run.uart_frame(frames.pack_control, Control.DISARM), bytes(range(256)))
        run.upload(0, WORDS)
        run.arm()
        for start in (Start.NOW, Start.TRIGGER):
            run.send(frames.pack_play, Play(0, length=0, emissions=1, start=start))
            run.trigger()
            run.wait(20_000)
        run.send(frames.pack_read, Register.FRAME_ERRORS)
        run.wait(60_000)
        run.status()
        return run

    answers, capture = script(noise=False).perform(MODEL)
    others, other_capture = script(noise=True).perform(without)
    assert_same((answers, capture), (others, other_capture))
    assert capture.uart_ticks.size == 0
    assert capture.focus_ticks.size > 0
