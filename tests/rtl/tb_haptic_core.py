"""haptic_core: frames go in over the pins, words come out on the channels, all as the model says."""

import os
import random
import zlib
from itertools import pairwise

import cocotb
import numpy as np
import pytest
from cobs import cobs
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge, Timer
from panel import (
    BIT_TICKS,
    BUILD_HASH,
    CLOCK_HZ,
    CLOCK_NS,
    FRAME_TICKS,
    IDLE_WORD,
    JUDGED_TICKS,
    PAD_TICKS,
    PARAMETERS,
    RAMP_SAMPLES,
    RAMP_TICKS,
    SLOTS,
    UART_BIT_TICKS,
    Panel,
    bank_entry_words,
    random_words,
    shortest_pulse_ticks,
)
from random_script import random_script

from controller.device.fpga import frames
from controller.device.fpga.configuration import LIMITS
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import (
    FILTER_TICKS,
    IDENTITY_MAGIC,
    PLAY_LANDING,
    PROTOCOL_VERSION,
    QUEUE_PLAYS,
    READ_QUEUE,
    READ_SLOT_CRC,
    TIME_LEAD_TICKS,
    TRIGGER_LATENCY_TICKS,
    Control,
    Fault,
    FrameType,
    Register,
    Result,
    Start,
    State,
)
from controller.device.fpga.status import parse_status
from controller.errors import LinkError
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.edge_counts import turn
from controller.workshop.gateware.model.limits import LATEST_TICKS, TURN_TICKS
from controller.workshop.gateware.model.player import FETCH_TICKS

SHORT = 20  # words of most waveforms here
SOUNDING = SHORT * BIT_TICKS
FIRST_WORD_TICKS = 1 + TRIGGER_LATENCY_TICKS  # tick 0 ends with the first clock edge that samples the trigger
FINE = (BIT_TICKS << 16) + 21846  # 6 1/3 ticks a word
UART_BYTE = 10 * UART_BIT_TICKS
RANDOM_FRAMES = int(os.environ.get("HAPTIC_PANEL_RANDOM_FRAMES", "40"))  # 1000 with `pytest -m slow`
WHOLE = RANDOM_FRAMES >= 1000  # every offset of what a random one, or every third, stands for otherwise
SCRIPTS_LATE = 2 if WHOLE else 1  # of which the model also gets inputs one tick late
ON = State.RUN_PERMIT | State.TEMPERATURE_GOOD | State.HEARTBEAT | State.ARMED | State.HV_ENABLE
OFF = State.RUN_PERMIT | State.TEMPERATURE_GOOD | State.HEARTBEAT  # the link that armed was heard a moment ago


def words_between(panel, first_tick, last_tick):
    return [entry for entry in panel.words if first_tick <= entry[0] <= last_tick]


def shown(start, words, bit_period=BIT_TICKS << 16):
    """Changes of the channels by an emission whose first word is on the pins at tick `start`, and by the idle word behind it."""
    ticks = [start + (number * bit_period >> 16) for number in range(len(words) + 1)]
    levels = [IDLE_WORD, *map(int, words), IDLE_WORD]
    return [(tick, word) for tick, (before, word) in zip(ticks, pairwise(levels), strict=True) if word != before]


async def armed(dut, *lengths, **settings):
    """A panel with as many slots uploaded, and their words."""
    panel = await Panel.after_reset(dut)
    await panel.arm(**settings)
    waveforms = [random_words(length) for length in lengths]
    for slot, words in enumerate(waveforms):
        await panel.upload(slot, words)
    return panel, *waveforms


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def plays_a_bank_entry_bit_for_bit(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    words = bank_entry_words()
    await panel.upload(1, words)
    await panel.send(frames.pack_play, Play(1))
    await panel.wait(10)
    before = await panel.status()
    assert State.PENDING | State.WAITING in before.state
    assert before.result is Result.OK
    start = await panel.trigger() + FIRST_WORD_TICKS
    await panel.wait(len(words) * BIT_TICKS + 20)
    end = start + len(words) * BIT_TICKS
    assert words_between(panel, start - BIT_TICKS, end + BIT_TICKS) == shown(start, words)
    assert panel.focus_ticks == [end]
    assert (await panel.status()).emissions == 1
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def first_word_comes_a_constant_number_of_clocks_after_the_trigger_at_any_sck(dut):
    assert TRIGGER_LATENCY_TICKS == 8
    panel = await Panel.after_reset(dut)
    await panel.arm()
    for number, half_ns in enumerate((10, 11, 17, 22, 43)):  # clk/2, clk/2.2, clk/3.4, clk/4.4, clk/8.6
        panel.sck_half_ns = half_ns
        words = random_words(SHORT)
        await panel.upload(number % SLOTS, words)
        await panel.play(number % SLOTS)
        await panel.wait(random.randrange(50))
        start = await panel.trigger() + 1 + 8
        await panel.wait(SOUNDING + 20)
        assert words_between(panel, start - 7, start) == [(start, int(words[0]))]
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_trigger_shorter_than_three_clocks_is_a_glitch(dut):
    panel, words = await armed(dut, SHORT)
    await panel.play()
    for high_ticks in (1, 2, 1, 2):
        await panel.trigger(high_ticks)
    await panel.wait(20)
    status = await panel.status()
    assert (status.trigger_count, status.queued) == (0, 1)
    assert panel.words[-1][1] == IDLE_WORD
    start = await panel.trigger(FILTER_TICKS) + FIRST_WORD_TICKS
    await panel.wait(SOUNDING + 20)
    assert panel.words[-len(shown(start, words)) :] == shown(start, words)
    assert (await panel.status()).trigger_count == 1
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_trigger_counts_if_three_clocks_in_a_row_sample_it_high_and_once_until_three_sample_it_low(dut):
    panel = await Panel.after_reset(dut)
    counted = 0
    for width_ns in range(18, 35, 2):
        for begin_ns in range(1, 10, 2):  # behind where inputs move: the clock's edge is 4.5 ns later
            await Timer(begin_ns, "ns")
            dut.trigger_i.value = 1
            await Timer(width_ns, "ns")
            dut.trigger_i.value = 0
            await Timer(100 - begin_ns - width_ns, "ns")
            first = begin_ns - 4.5
            counted += sum(first < edge < first + width_ns for edge in range(0, 60, 10)) >= FILTER_TICKS
    assert 10 < counted < 35
    assert (await panel.status()).trigger_count == counted
    for low_ticks in (1, 2, 3, 4):
        for level, ticks in ((1, 5), (0, low_ticks), (1, 5), (0, 8)):
            dut.trigger_i.value = level
            await panel.wait(ticks)
        counted += 2 if low_ticks >= FILTER_TICKS else 1
        assert (await panel.status()).trigger_count == counted


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_scheduled_play_begins_at_its_tick_exactly(dut):
    panel, words = await armed(dut, SHORT)
    scheduled = []

    async def schedule(lead):
        """A play that begins so long after its frame is accepted; what becomes of it."""
        when = panel.tick + FRAME_TICKS + JUDGED_TICKS + lead
        await panel.send(frames.pack_play, Play(0, start=Start.TIME, when_ticks=when))
        assert when == panel.release_tick + JUDGED_TICKS + lead
        scheduled.append(when)

    seen = len(panel.words)
    expected = []
    assert TIME_LEAD_TICKS == 30
    for lead in (28, 29, 30, 31, 77, 2000):  # 28: the time compared is that of two ticks ago
        await schedule(lead)
        await panel.until(scheduled[-1] + SOUNDING + 20)
        expected += shown(scheduled[-1], words)
        assert panel.words[seen:] == expected
        assert await panel.read(Register.EMISSION_TIME_LOW) == scheduled[-1]
    for lead in (27, 0, -100):
        await schedule(lead)
        assert (await panel.status()).result is Result.TOO_LATE
    await schedule(5000)
    free = scheduled[-1] + SOUNDING + BIT_TICKS + 2  # the idle word, and until the next play is fetched
    for when in (scheduled[-1] - 1000, free - 1):
        assert await panel.result_of(frames.pack_play, Play(0, start=Start.TIME, when_ticks=when)) is Result.OVERLAP
    await panel.send(frames.pack_play, Play(0, start=Start.TIME, when_ticks=free))
    await panel.until(free + SOUNDING + 20)
    assert panel.words[seen:] == expected + shown(scheduled[-1], words) + shown(free, words)
    assert await panel.read(Register.PLAYS_MISSED) == 0
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def eight_plays_wait_their_turn_and_the_ninth_is_refused(dut):
    panel, *waveforms = await armed(dut, SHORT, 7, 3)
    plays = [(number % SLOTS, 0xFFFFFFFF >> number) for number in range(QUEUE_PLAYS)]
    for number, (slot, mask) in enumerate(plays):
        await panel.send(frames.pack_play, Play(slot, mask=mask))
        assert (await panel.status()).queued == number + 1
    assert await panel.result_of(frames.pack_play, Play(0)) is Result.QUEUE_FULL
    assert await panel.read(READ_QUEUE + 8 * 7 + 3) == plays[7][1]
    assert await panel.read(Register.QUEUE) == 8
    for beyond in (6, 8 * 8, 8 * 8 + 3):  # a word, a play that there is not
        assert await panel.result_of(frames.pack_read, READ_QUEUE + beyond) is Result.BAD_RANGE
    seen = len(panel.words)
    expected = []
    for slot, mask in plays:
        start = await panel.trigger() + FIRST_WORD_TICKS
        expected += shown(start, waveforms[slot] & np.uint32(mask) | np.uint32(IDLE_WORD & ~mask))
        await panel.wait(SOUNDING + 20)
    assert panel.words[seen:] == expected
    await panel.trigger()
    status = await panel.status()
    assert (status.queued, status.emissions, status.ignored) == (0, QUEUE_PLAYS, 1)
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def plays_that_start_now_follow_one_another_a_bit_period_apart(dut):
    panel, *waveforms = await armed(dut, SHORT, 7, 3)
    await panel.play(0)
    for slot in (1, 2, 1):
        await panel.send(frames.pack_play, Play(slot, start=Start.NOW))
    seen = len(panel.words)
    tick = await panel.trigger() + FIRST_WORD_TICKS
    await panel.wait(400)
    expected = []
    for slot in (0, 1, 2, 1):
        expected += shown(tick, waveforms[slot])
        tick += (len(waveforms[slot]) + 1) * BIT_TICKS
    assert panel.words[seen:] == expected
    await panel.send(frames.pack_play, Play(2, start=Start.NOW, when_ticks=40))
    start = panel.release_tick + JUDGED_TICKS + FETCH_TICKS + 40 + 5
    await panel.wait(120)
    assert panel.words[seen + len(expected) :] == shown(start, waveforms[2])
    assert (await panel.status()).trigger_count == 1
    panel.check_against_model()


def loads_of(words):
    return [memoryview(words[125 * chunk : 125 * (chunk + 1)].tobytes()) for chunk in range(-(-len(words) // 125))]


SLOW_WORD_TICKS = 110  # of a bit clock at which a chunk of the fastest SCK arrives faster than it plays


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_waveform_plays_while_it_arrives(dut):
    panel, _ = await armed(dut, 1, bit_period=SLOW_WORD_TICKS << 16)
    words = random_words(300)
    loads = loads_of(words)
    assert await panel.result_of(frames.pack_play, Play(PLAY_LANDING)) is Result.INCOMPLETE
    panel.sck_half_ns = 18  # 125 words in more ticks than they last
    await panel.send(frames.pack_load, 0, loads[0])
    assert await panel.result_of(frames.pack_play, Play(PLAY_LANDING, length=300)) is Result.LINK_SLOW
    panel.sck_half_ns = 15
    await panel.send(frames.pack_load, 0, loads[0])
    await panel.send(frames.pack_play, Play(PLAY_LANDING, length=300))
    await panel.wait(20)
    start = await panel.trigger() + FIRST_WORD_TICKS
    seen = len(panel.words)
    for chunk in (1, 2):
        status = await panel.send(frames.pack_load, chunk, loads[chunk])
        assert status.state & (State.PLAYING | State.LANDING_BUSY) == State.PLAYING
        assert status.chunks == (1 << chunk) - 1
    assert panel.tick < start + 250 * SLOW_WORD_TICKS
    store = (frames.pack_store, 1, 300, zlib.crc32(words))
    assert await panel.result_of(*store) is Result.BUSY
    await panel.until(start + 300 * SLOW_WORD_TICKS + 20)
    assert panel.words[seen:] == shown(start, words, SLOW_WORD_TICKS << 16)
    assert await panel.result_of(*store) is Result.OK
    assert await panel.read(READ_SLOT_CRC + 1) == zlib.crc32(words)
    panel.check_against_model()


@cocotb.test(timeout_time=10, timeout_unit="ms")
@cocotb.parametrize(tail=["missing", "damaged"])
async def a_word_that_has_not_arrived_shuts_the_outputs_and_never_plays(dut, tail):
    panel, _ = await armed(dut, 1, bit_period=SLOW_WORD_TICKS << 16)
    words = random_words(250) | 1
    loads = loads_of(words)
    await panel.send(frames.pack_load, 0, loads[0])
    await panel.send(frames.pack_play, Play(PLAY_LANDING, length=250, start=Start.NOW))
    start = panel.release_tick + JUDGED_TICKS + FETCH_TICKS + 5
    seen = len(panel.words)
    if tail == "damaged":
        damaged = bytearray(panel.packed(frames.pack_load, 1, loads[1]))
        damaged[400] ^= 4
        await panel.exchange(bytes(damaged))
        panel.sequence -= 1
    due = start + 125 * SLOW_WORD_TICKS  # when word 125 would be on the pins
    await panel.until(due + 200)
    (off_tick, word) = panel.words[-1]
    assert word == 0
    assert due - 4 <= off_tick <= due
    assert panel.levels[-1] == (off_tick, 0)
    assert panel.words[seen:-1] == shown(start, words[:125], SLOW_WORD_TICKS << 16)[: len(panel.words) - seen - 1]
    assert len(panel.words) - seen - 1 > 120
    status = await panel.status()
    assert status.faults == Fault.UNDERRUN
    assert await panel.read(Register.UNDERRUNS) == 1
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_slot_whose_crc_does_not_match_is_not_played(dut):
    panel, _ = await armed(dut, SHORT)
    bad = random_words(SHORT)
    await panel.send(frames.pack_load, 0, memoryview(bad.tobytes()))
    assert await panel.result_of(frames.pack_store, 1, SHORT, zlib.crc32(bad) ^ 1 << 17) is Result.OK
    assert await panel.result_of(frames.pack_play, Play(1)) is Result.SLOT_DAMAGED
    assert await panel.result_of(frames.pack_play, Play(2)) is Result.EMPTY_SLOT
    assert await panel.result_of(frames.pack_play, Play(SLOTS)) is Result.BAD_SLOT
    assert await panel.read(Register.SLOTS_LOADED) == 0b01
    assert await panel.read(READ_SLOT_CRC + 1) == zlib.crc32(bad)
    seen = len(panel.words)
    await panel.trigger()
    await panel.wait(2 * SOUNDING)
    assert panel.words[seen:] == []
    await panel.upload(1, bad)
    await panel.play(1)
    await panel.trigger()
    await panel.wait(SOUNDING + 20)
    assert len(panel.focus_ticks) == 1
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def words_begin_at_the_floor_of_a_bit_period_with_a_fraction(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm(bit_period=FINE)
    words = random_words(125)
    await panel.upload(0, words)
    for _ in range(2):  # the fraction starts again with each emission
        await panel.play()
        seen = len(panel.words)
        start = await panel.trigger() + FIRST_WORD_TICKS
        await panel.wait(900)
        assert panel.words[seen:] == shown(start, words, FINE)
        assert panel.focus_ticks[-1] == start + (125 * FINE >> 16) == start + 791
    assert {b - a for (a, _), (b, _) in pairwise(panel.words[seen:])} == {6, 7}
    await panel.write(Register.BIT_PERIOD, (7 << 16) + 1)
    await panel.play()
    assert await panel.result_of(frames.pack_write, Register.BIT_PERIOD, FINE) is Result.BUSY
    seen = len(panel.words)
    start = await panel.trigger() + FIRST_WORD_TICKS
    await panel.wait(900)
    assert panel.words[seen:] == shown(start, words, 7 << 16)
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def refuses_a_damaged_frame_says_why_and_takes_the_next_good_one(dut):
    panel = await Panel.after_reset(dut)
    await panel.write(Register.IDLE_WORD, 1)
    good = bytearray(FRAME_BYTES)
    frames.pack_write(good, 0, 77, Register.IDLE_WORD, 0xBAD0BAD0)
    damaged = [
        (bytes(good[:35]), Result.BAD_LENGTH),
        (bytes(good[:5]), Result.BAD_LENGTH),
        (bytes(good[:9] + good[10:]), Result.BAD_LENGTH),
        (bytes(good) + b"\0", Result.BAD_LENGTH),
        (bytes(good[:1]), Result.BAD_LENGTH),
    ]
    for bit in [0, 15, 16, 32, 40, 287, *random.sample(range(288), 10)]:
        flipped = bytearray(good)
        flipped[bit // 8] ^= 1 << bit % 8
        reason = Result.BAD_SYNC if bit < 16 else Result.BAD_LENGTH if 32 <= bit < 48 else Result.BAD_CRC
        damaged.append((bytes(flipped), reason))
    for frame, reason in damaged:
        sequence = panel.sequence
        await panel.exchange(frame)
        status = await panel.status()
        assert (status.result, status.sequence) == (reason, sequence & 0xFF)
    errors = len(damaged)
    panel.check_against_model()
    for bits in (1, 7, 287, 289):  # no whole number of bytes
        await panel.exchange(bytes(good) + b"\0", bits)
        assert (await panel.status()).result is (Result.BAD_LENGTH if bits > 16 else Result.BAD_SYNC)
        errors += 1
    await panel.exchange(b"", 0)  # no SCK edge: nothing happened
    assert (await panel.status()).result is Result.OK
    assert await panel.read(Register.FRAME_ERRORS) == errors
    assert await panel.read(Register.SEQUENCE_GAPS) == 0
    assert await panel.read(Register.IDLE_WORD) == 1
    assert await panel.result_of(frames.pack_write, Register.IDLE_WORD, 2) is Result.OK
    assert await panel.read(Register.IDLE_WORD) == 2


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_damaged_load_does_not_count_and_spoils_nothing_else(dut):
    panel, _ = await armed(dut, SHORT)
    words = random_words(SHORT)
    for damage in (lambda load: load[:-1], lambda load: load[:20], lambda load: load + bytes(8)):
        load = bytearray(12 + 4 * SHORT)
        frames.pack_load(load, 0, 9, 0, memoryview(random_words(SHORT).tobytes()))
        await panel.send(frames.pack_load, 0, memoryview(words.tobytes()))
        await panel.exchange(bytes(damage(load)))
        assert await panel.result_of(frames.pack_store, 1, SHORT, zlib.crc32(words)) is Result.INCOMPLETE
    await panel.upload(1, words)
    await panel.send(frames.pack_play, Play(1))
    await panel.wait(20)
    start = await panel.trigger() + FIRST_WORD_TICKS
    await panel.wait(SOUNDING + 20)
    assert words_between(panel, start, panel.tick) == shown(start, words)
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def loading_and_storing_never_disturb_what_plays_or_waits(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    old, new = random_words(125), random_words(SHORT)
    await panel.upload(0, old)
    await panel.send(frames.pack_play, Play(0, emissions=0, period_ticks=125 * BIT_TICKS))
    await panel.wait(20)
    await panel.trigger()
    await panel.upload(0, new)  # stored while the old one sounds
    assert State.LANDING_BUSY in (await panel.status()).state
    load = (frames.pack_load, 0, memoryview(bytes(500)))
    assert await panel.result_of(*load) is Result.BUSY
    await panel.play(0)
    await panel.control(Control.STOP)
    assert await panel.result_of(*load) is Result.BUSY, "it was when the frame began, if not when it ended"
    assert State.LANDING_BUSY not in (await panel.status()).state
    assert await panel.result_of(*load) is Result.OK
    assert {word for tick, word in panel.words if tick > panel.focus_ticks[0]} <= {*old.tolist(), IDLE_WORD}
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def shuts_within_the_timeout_when_the_host_falls_silent_and_keeps_the_cause(dut):
    heartbeat_ticks = 6000
    panel, _ = await armed(dut, SHORT, HEARTBEAT_TICKS=heartbeat_ticks)
    await panel.send(frames.pack_play, Play(0, emissions=0, period_ticks=SOUNDING))
    await panel.wait(20)
    await panel.trigger()
    await panel.status()
    heard = panel.release_tick + JUDGED_TICKS
    damaged = bytearray(FRAME_BYTES)
    frames.pack_nop(damaged, 0, 1)
    damaged[20] ^= 1
    for _ in range(3):
        await panel.exchange(bytes(damaged))  # no sign of life
    await panel.until(heard + heartbeat_ticks + 10)
    assert panel.levels[-1] == (heard + heartbeat_ticks + 2, 0)
    assert panel.words[-1][1] == 0
    status = await panel.status()
    assert status.faults == Fault.HOST_SILENT
    assert not status.state & (State.ARMED | State.PLAYING | State.REPEATING | State.HV_ENABLE)
    await panel.unlock_and_arm()
    assert (await panel.status()).result is Result.FAULTED
    assert await panel.result_of(frames.pack_play, Play(0)) is Result.FAULTED
    assert await panel.read(Register.FAULT) == Fault.HOST_SILENT
    await panel.control(Control.CLEAR)
    await panel.arm_again()
    assert (await panel.status()).faults == Fault(0)
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_trigger_while_unarmed_or_with_nothing_to_play_is_counted_and_ignored(dut):
    panel = await Panel.after_reset(dut)
    await panel.trigger()
    assert await panel.result_of(frames.pack_play, Play(0)) is Result.NOT_ARMED
    await panel.trigger()
    await panel.wait(50)
    assert panel.words == []
    await panel.arm()
    await panel.upload(0, random_words(SHORT))
    await panel.play()
    await panel.trigger()
    await panel.wait(10)
    await panel.trigger()  # during the emission
    await panel.wait(SOUNDING)
    await panel.trigger()  # after it
    await panel.wait(SOUNDING)
    status = await panel.status()
    assert (status.trigger_count, status.emissions, status.ignored) == (5, 1, 4)
    assert await panel.read(Register.TRIGGERS_IGNORED) == 4
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
@cocotb.parametrize(which=list(Permit))
async def is_low_within_four_clocks_of_a_lost_permit_and_says_so(dut, which):
    fault = {Permit.RUN: Fault.NO_PERMIT, Permit.TEMPERATURE: Fault.OVER_TEMPERATURE}[which]
    panel = await Panel.after_reset(dut)
    await panel.arm()
    await panel.upload(0, random_words(SHORT) | 1)
    await panel.play(emissions=3, period_ticks=300)
    await panel.trigger()
    await panel.wait(4 * BIT_TICKS)
    lost = panel.tick
    panel.permit(False, which)
    await panel.wait(4)
    for output in (dut.channel_o, dut.hv_enable_o, dut.hv_alive_o, dut.focus_o, dut.waiting_o):
        assert output.value == 0, output._name
    off_tick = panel.levels[-1][0]
    assert off_tick == lost + 3, "two clocks of the synchroniser, and the next; a fourth where it is caught in its edge"
    assert panel.words[-1] == (off_tick, 0)
    assert panel.faults == [(off_tick + PAD_TICKS, 1)]
    panel.permit(True, which)
    await panel.wait(400)
    assert panel.levels[-1] == (off_tick, 0)
    status = await panel.status()
    assert status.faults == fault
    assert status.emissions == 0
    assert await panel.read(Register.FAULT_TIME_LOW) == off_tick - 1
    assert await panel.read(Register.FAULT_COUNT) == 1
    await panel.unlock_and_arm()
    assert (await panel.status()).result is Result.FAULTED
    await panel.control(Control.CLEAR)
    cleared = panel.release_tick + JUDGED_TICKS + 1
    panel.permit(False, which)
    await panel.wait(10)
    await panel.unlock_and_arm()
    assert (await panel.status()).result is Result.NO_PERMIT
    assert panel.levels[-1] == (off_tick, 0)
    assert panel.faults == [(off_tick + PAD_TICKS, 1), (cleared + PAD_TICKS, 0)]
    panel.permit(True, which)
    await panel.wait(10)
    await panel.arm_again()
    panel.check_against_model()


TOGGLING = np.array([0xFFFFFFFF, 1] * (SHORT // 2), np.uint32)  # never all low, so that shutting is a change


@cocotb.test(timeout_time=10, timeout_unit="ms")
@cocotb.parametrize(limit=["CHANNEL_EDGES", "TOTAL_EDGES", "DUTY_TICKS"])
async def a_limit_of_the_stages_shuts_the_outputs_within_its_clocks(dut, limit):
    most = {"CHANNEL_EDGES": 61, "TOTAL_EDGES": 1500, "DUTY_TICKS": 1000}[limit]
    window = PARAMETERS.edge_window_ticks
    panel = await Panel.after_reset(dut)
    await panel.arm(**{limit: most}, DUTY_SHARE=0 if limit == "DUTY_TICKS" else 65536)
    words = TOGGLING if limit != "CHANNEL_EDGES" else TOGGLING & np.uint32(1 << 13) | np.uint32(IDLE_WORD & ~(1 << 13))
    await panel.upload(0, words)
    await panel.send(frames.pack_play, Play(0, emissions=0, period_ticks=SOUNDING))
    await panel.until((panel.tick // window + 1) * window + 3)
    begun = len(panel.words)
    start = await panel.trigger() + FIRST_WORD_TICKS
    await panel.wait(3000)
    off_tick = panel.levels[-1][0]
    before = [IDLE_WORD, *(word for _, word in panel.words[begun:])]
    edges = [(tick, old ^ new) for (tick, new), old in zip(panel.words[begun:-1], before, strict=False)]
    if limit == "DUTY_TICKS":
        ramp = RAMP_TICKS  # it is activity too; the pins are 4 ticks behind what counts, the fault is 2 ahead
        cause, expected = Fault.DUTY, start - 4 + most - ramp
    elif limit == "TOTAL_EDGES":
        made = np.cumsum([changed.bit_count() for _, changed in edges])
        cause, expected = Fault.TOTAL_EDGES, edges[int(np.argmax(made > most))][0]
    else:
        made = np.cumsum([changed >> 13 & 1 for _, changed in edges])
        first = edges[int(np.argmax(made > most))][0]
        cause, expected = Fault.CHANNEL_EDGES, turn(first, 13) + TURN_TICKS
        assert expected <= first + LATEST_TICKS
        assert not any(changed & ~(1 << 13) for _, changed in edges)
    assert expected < off_tick <= expected + 4
    assert panel.words[-1] == (off_tick, 0)
    assert (await panel.status()).faults == cause
    assert await panel.read(Register.FAULT_CHANNELS) == (1 << 13 if limit == "CHANNEL_EDGES" else 0)
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def an_emission_longer_than_allowed_is_refused_before_it_begins(dut):
    panel, _ = await armed(dut, SHORT, EMISSION_TICKS=SOUNDING - 1)
    assert await panel.result_of(frames.pack_play, Play(0)) is Result.TOO_LONG
    assert await panel.result_of(frames.pack_play, Play(0, length=SHORT - 1)) is Result.OK
    await panel.trigger()
    await panel.wait(SOUNDING + 20)
    assert len(panel.focus_ticks) == 1
    assert await panel.result_of(frames.pack_play, Play(0, emissions=2, period_ticks=(SHORT - 1) * BIT_TICKS)) is Result.TOO_LONG
    short = {"length": SHORT - 1, "emissions": 2}
    sounding = (SHORT - 1) * BIT_TICKS
    assert await panel.result_of(frames.pack_play, Play(0, **short, period_ticks=sounding + BIT_TICKS - 1)) is Result.BAD_PERIOD
    assert await panel.result_of(frames.pack_play, Play(0, **short, period_ticks=sounding)) is Result.OK
    assert await panel.result_of(frames.pack_play, Play(0, first=1, length=SHORT)) is Result.BAD_RANGE
    panel.check_against_model()


@cocotb.test(timeout_time=10, timeout_unit="ms")
async def arms_only_with_the_right_key_and_permits_and_glides_both_ways(dut):
    panel = await Panel.after_reset(dut)
    key = (IDENTITY_MAGIC, PROTOCOL_VERSION, BUILD_HASH)
    unlock = (frames.pack_short, FrameType.WRITE, Register.CONTROL, Control.UNLOCK)

    async def unlocked_by(*words):
        def pack(buffer, offset, sequence):
            return frames.pack_short(buffer, offset, unlock[1], sequence, unlock[2], unlock[3], *words)

        await panel.send(pack)
        result = (await panel.send(frames.pack_control, Control.ARM)).result
        return result, (await panel.status()).result

    assert await panel.result_of(frames.pack_control, Control.ARM) is Result.LOCKED
    assert await unlocked_by(*key) == (Result.OK, Result.NO_PERMIT)
    for which in Permit:
        panel.permit(True, which)
        panel.permit(False, Permit(1 - which))
        assert await unlocked_by(*key) == (Result.OK, Result.NO_PERMIT)
    panel.permit_all()
    for wrong in range(3):
        words = list(key)
        words[wrong] ^= 1
        assert await unlocked_by(*words) == (Result.BAD_KEY, Result.LOCKED)
    await panel.send(frames.pack_unlock, BUILD_HASH)
    await panel.status()  # in between
    assert await panel.result_of(frames.pack_control, Control.ARM) is Result.LOCKED
    assert panel.levels == []
    await panel.arm()
    assert await panel.result_of(frames.pack_write, Register.CHANNEL_MASK, 0) is Result.ARMED
    assert await unlocked_by(*key) == (Result.OK, Result.ARMED)
    await panel.control(Control.DISARM)
    await panel.wait(RAMP_TICKS + 20)
    assert panel.levels[-1][1] == 0
    assert panel.words[-1][1] == 0
    await panel.write(Register.RAMP_SAMPLES, 1500)  # long enough to be turned back on the way
    await panel.write(Register.CHANNEL_MASK, 0xFF00FFFF)
    await panel.unlock_and_arm()
    await panel.wait(4000)
    await panel.control(Control.DISARM)
    assert State.RAMPING in (await panel.status()).state
    await panel.wait(9000)
    assert (await panel.status()).state == OFF
    masked = [word for tick, word in panel.words if tick > panel.levels[-2][0]]
    assert len(masked) > 100
    assert set(masked) == {0, IDLE_WORD & 0xFF00FFFF}
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def disarming_drops_what_plays_and_what_waits(dut):
    panel, _ = await armed(dut, SHORT)
    await panel.send(frames.pack_play, Play(0, emissions=0, period_ticks=SOUNDING + 100))
    await panel.wait(20)
    await panel.trigger()
    await panel.play(0)
    await panel.control(Control.DISARM)
    await panel.wait(2 * BIT_TICKS)  # the current word
    assert not (await panel.status()).state & (State.PLAYING | State.REPEATING | State.PENDING)
    await panel.arm_again()
    await panel.trigger()
    await panel.wait(300)
    assert (await panel.status()).state == ON
    panel.check_against_model()


@cocotb.test(timeout_time=20, timeout_unit="ms")
@cocotb.parametrize(bit_period=[BIT_TICKS << 16, FINE])
async def disarming_in_the_middle_of_a_word_makes_no_short_pulse(dut, bit_period):
    """At every tick of a word, and around the end of an emission: the word and the idle word behind it are whole."""
    panel = await Panel.after_reset(dut)
    await panel.arm(bit_period=bit_period)
    words = np.array([0x55555555 << number % 2 & 0xFFFFFFFF for number in range(3)], np.uint32)  # every channel, every word
    await panel.upload(0, words)
    sounding, lengths = len(words) * bit_period >> 16, set()
    for offset in range(0, sounding + 2 * BIT_TICKS, 1 if WHOLE or bit_period != FINE else 3):
        await panel.send(frames.pack_play, Play(0))
        control = cocotb.start_soon(panel.control(Control.DISARM))
        await panel.wait(FRAME_TICKS + JUDGED_TICKS - offset - 4)
        seen = len(panel.words)
        state_tick = await panel.trigger() + 5  # of the first word, four ticks before the pins
        await control
        disarmed = panel.release_tick + JUDGED_TICKS
        assert disarmed == state_tick + offset - 1
        whole = 0  # words that have begun by then
        while whole < len(words) and state_tick + (whole * bit_period >> 16) <= disarmed:
            whole += 1
        expected = shown(state_tick + 4, words[:whole], bit_period) if whole else []
        await panel.wait(RAMP_TICKS + sounding + 60)
        assert panel.levels[-1][1] == 0
        assert panel.words[seen : seen + len(expected)] == expected
        if expected:
            assert panel.words[seen + len(expected)][0] >= expected[-1][0] + BIT_TICKS
        lengths.add(whole)
        await panel.arm_again(RAMP_SAMPLES * bit_period >> 16)
    assert lengths == set(range(4)), "from before the first word to behind the last"
    assert len(panel.focus_ticks) > 3
    assert shortest_pulse_ticks(panel.words) == BIT_TICKS
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def gives_signs_of_life_at_10_khz_while_the_outputs_are_on_and_only_then(dut):
    panel = await Panel.after_reset(dut)
    await panel.wait(2000)
    assert panel.alive == []
    await panel.arm()
    edges = []
    for _ in range(6):
        await RisingEdge(dut.hv_alive_o)
        edges.append(panel.tick)
    periods = {later - earlier for earlier, later in pairwise(edges)}
    assert len(periods) == 1
    assert CLOCK_HZ / periods.pop() >= 10_000
    await Timer(CLOCK_NS // 2, "ns")
    panel.permit(False)
    await panel.wait(5)
    seen = len(panel.alive)
    for _ in range(2000):
        await FallingEdge(dut.clk_i)
        assert dut.hv_alive_o.value == 0
    assert len(panel.alive) == seen
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def the_waiting_line_is_high_from_an_accepted_play_to_its_trigger(dut):
    panel, _ = await armed(dut, SHORT)
    await panel.send(frames.pack_play, Play(0))
    accepted = panel.release_tick + JUDGED_TICKS
    await panel.wait(20)
    assert panel.waits == [(accepted + FETCH_TICKS + PAD_TICKS, 1)]
    tick = await panel.trigger()
    assert panel.waits[1:] == [(tick + 5 + PAD_TICKS, 0)]
    await panel.send(frames.pack_play, Play(0))  # accepted after the emission has ended
    await panel.send(frames.pack_play, Play(SLOTS))  # refused
    await panel.trigger()
    await panel.send(frames.pack_play, Play(0, start=Start.NOW))
    await panel.status()
    assert [level for _, level in panel.waits] == [1, 0, 1, 0], "no trigger is asked for what starts by itself"
    await panel.play(0)
    await panel.control(Control.STOP)
    await panel.status()
    assert [level for _, level in panel.waits[4:]] == [1, 0]
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def says_what_it_is(dut):
    panel = await Panel.after_reset(dut)
    parameters = PARAMETERS
    expected = dict.fromkeys(Register, 0) | {
        Register.IDENTITY: IDENTITY_MAGIC,
        Register.PROTOCOL: 2,
        Register.BUILD_HASH: BUILD_HASH,
        Register.BOARD: parameters.board,
        Register.CLOCK_HZ: CLOCK_HZ,
        Register.GEOMETRY: SLOTS | 1000 << 8 | 32 << 24,
        Register.PARAMETERS: 8 | 8 << 8 | 3 << 16,
        Register.EDGE_WINDOW_TICKS: parameters.edge_window_ticks,
        Register.CHANNEL_MASK: 0xFFFFFFFF,
        Register.BIT_PERIOD: parameters.bit_period_reset,
        Register.RAMP_SAMPLES: parameters.ramp_samples_reset,
        Register.HEARTBEAT_TICKS: parameters.heartbeat_ticks_max,
        Register.PULSE_TICKS: parameters.pulse_ticks_min,
        Register.CHANNEL_EDGES: parameters.channel_edges_max,
        Register.TOTAL_EDGES: parameters.total_edges_max,
        Register.EMISSION_TICKS: parameters.emission_ticks_max,
        Register.DUTY_SHARE: parameters.duty_share_max,
        Register.DUTY_TICKS: parameters.duty_ticks_max,
    }
    expected |= {register: getattr(parameters, register.name.lower()) for register in LIMITS}
    await panel.send(frames.pack_read, Register.IDENTITY)
    for register, following in pairwise([*expected, Register.IDENTITY]):
        assert (await panel.send(frames.pack_read, following)).data == expected[register], register.name
    assert await panel.result_of(frames.pack_read, len(Register)) is Result.UNKNOWN_REGISTER
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_test_frame_comes_back_behind_the_status(dut):
    panel = await Panel.after_reset(dut)
    for size in (20, 36, 500):
        frame = panel.packed(frames.pack_test, random.randbytes(size))
        answer = await panel.exchange(frame)
        assert answer[FRAME_BYTES:] == frame[FRAME_BYTES - 2 : -2]
        assert len(answer) < FRAME_BYTES or parse_status(answer).result is Result.OK
    status = await panel.status()
    assert (status.result, status.sequence) == (Result.OK, panel.sequence - 1)
    await panel.exchange(panel.packed(frames.pack_load, 0, memoryview(random.randbytes(60))))
    assert panel.answers[-1][FRAME_BYTES:] == bytes(36), "only a TEST is sent back"
    flipped = bytearray(panel.packed(frames.pack_test, random.randbytes(100)))
    flipped[50] ^= 0x10  # what a bit-error-rate test is for
    assert (await panel.exchange(bytes(flipped)))[52] == flipped[50]
    panel.sequence -= 1
    assert (await panel.status()).result is Result.BAD_CRC
    panel.check_against_model()


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def frames_over_the_uart_reach_the_same_core(dut):
    panel, words = await armed(dut, SHORT)
    await panel.open_uart()
    await panel.status()
    by_spi = await panel.status()
    by_uart = parse_status(await panel.exchange_by_uart(panel.packed(frames.pack_nop)))
    panel.sequence -= 1
    again = await panel.status()
    assert (by_uart.sequence, again.sequence) == (0, by_spi.sequence + 1)
    assert by_spi.timestamp_ticks < by_uart.timestamp_ticks < again.timestamp_ticks
    same = by_uart._replace(sequence=by_spi.sequence, timestamp_ticks=by_spi.timestamp_ticks, data=by_spi.data)
    assert same == by_spi
    new = random_words(SHORT)
    await panel.exchange_by_uart(panel.packed(frames.pack_load, 0, memoryview(new.tobytes())))
    await panel.exchange_by_uart(panel.packed(frames.pack_store, 1, SHORT, zlib.crc32(new)))
    await panel.exchange_by_uart(panel.packed(frames.pack_play, Play(1)))
    assert (await panel.status()).result is Result.OK
    seen = len(panel.words)
    start = await panel.trigger() + FIRST_WORD_TICKS
    await panel.wait(SOUNDING + 20)
    assert panel.words[seen:] == shown(start, new)
    damaged = bytearray(panel.packed(frames.pack_control, Control.DISARM))
    damaged[9] ^= 1
    await panel.exchange_by_uart(damaged)
    panel.sequence -= 1
    status = parse_status(await panel.exchange_by_uart(panel.packed(frames.pack_read, Register.EMISSIONS)))
    assert status.result is Result.BAD_CRC
    status = parse_status(await panel.exchange_by_uart(panel.packed(frames.pack_nop)))
    assert (status.data, status.emissions, status.state) == (1, 1, ON)
    assert words is not None
    panel.check_against_model()


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def frames_on_both_links_at_once_are_both_carried_out(dut):
    panel, words = await armed(dut, SHORT)
    await panel.open_uart()
    panel.sck_half_ns = 15
    begins = [(0, tick) for tick in random.sample(range(38 * UART_BYTE), 10 if WHOLE else 4)]
    begins += [
        (0, 38 * UART_BYTE - UART_BIT_TICKS + tick) for tick in range(0, 60, 11 if WHOLE else 20)
    ]  # around the turn of the UART's
    begins += [(random.randrange(1, FRAME_TICKS - 2 * UART_BYTE), 0) for _ in range(3)]
    done = 0
    for number, (uart_begins, spi_begins) in enumerate(begins):
        seen = len(panel.words)
        frame = panel.packed(frames.pack_play, Play(0, start=Start.NOW))

        wire = cobs.encode(uart_play(number + 1)) + b"\0"

        async def by_uart(wire=wire, ticks=uart_begins):
            await panel.wait(ticks)
            await panel.send_by_uart(wire)

        async def by_spi(frame=frame, ticks=spi_begins):
            await panel.wait(ticks)
            await panel.exchange(frame)

        for task in [cocotb.start_soon(by_uart()), cocotb.start_soon(by_spi())]:
            await task
        await panel.wait(4 * UART_BYTE + 3 * SOUNDING)  # the rest of the UART's answer
        done += 2
        status = await panel.status()
        assert (status.result, status.emissions, status.faults) == (Result.OK, done, Fault(0)), (uart_begins, spi_begins)
        inverted = [change[1] for change in shown(0, words ^ np.uint32(0xFFFFFFFF))]
        plain = [change[1] for change in shown(0, words)]
        assert [change[1] for change in panel.words[seen:]] in (plain + inverted, inverted + plain)
        for register in (Register.FRAME_ERRORS, Register.SEQUENCE_GAPS):
            assert await panel.read(register) == 0
    panel.check_against_model()


def uart_play(sequence):
    """A PLAY of the other polarity, as the UART numbers its frames."""
    frame = bytearray(FRAME_BYTES)
    frames.pack_play(frame, 0, sequence, Play(0, start=Start.NOW, inverted=True))
    return bytes(frame)


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def a_reset_in_the_middle_of_everything_leaves_nothing_behind(dut):
    panel = await Panel.after_reset(dut)
    for number in range(4):
        await panel.arm()
        await panel.upload(0, random_words(SHORT))
        await panel.open_uart()
        await panel.play(0, emissions=0, period_ticks=SOUNDING)
        for slot_start in (Start.NOW, Start.TRIGGER):
            await panel.send(frames.pack_play, Play(0, start=slot_start))
        await panel.trigger()
        wire = cocotb.start_soon(panel.wire.send(cobs.encode(panel.packed(frames.pack_play, Play(0))) + b"\0"))
        frame = cocotb.start_soon(panel.exchange(panel.packed(frames.pack_store, 1, SHORT, 0)))
        await panel.wait(random.randrange(5, FRAME_TICKS - 60))
        assert dut.hv_enable_o.value == 1
        dut.rst_i.value = 1
        dut.trigger_i.value = 1  # no edge: it was high before anything was seen
        await ClockCycles(dut.clk_i, 2)
        await FallingEdge(dut.clk_i)
        outputs = (dut.channel_o, dut.hv_enable_o, dut.hv_alive_o, dut.focus_o, dut.waiting_o, dut.fault_o)
        for output in outputs:
            assert output.value == 0, output._name
        assert dut.uart_tx_o.value == 1
        old, panel = panel, await panel.reset(inputs_rest=False)
        with pytest.raises(LinkError):  # the rest of the answer
            parse_status(await frame)
        await wire
        await old.wait(100)
        panel.inputs.append((0, "permit", (True, Permit.RUN)))
        panel.inputs.append((0, "permit", (True, Permit.TEMPERATURE)))
        status = await panel.status()
        assert (status.result, status.state, status.trigger_count) == (
            Result.OK,
            State.RUN_PERMIT | State.TEMPERATURE_GOOD,
            0,
        ), number
        for register in (Register.FRAME_ERRORS, Register.SLOTS_LOADED, Register.QUEUE, Register.FAULT_COUNT, Register.TRIGGERS):
            assert await panel.read(register) == 0
        assert await panel.read(Register.BIT_PERIOD) == CLOCK_HZ // 500_000 << 16
        dut.trigger_i.value = 0
        await panel.wait(10)
    panel.check_against_model()


def scripts_of(frames_wanted):
    """Seeds and random scripts, until they have this many frames together."""
    seed, done = 0, 0
    while done < frames_wanted:
        script = random_script(seed)
        yield seed, script
        done += sum(method == "exchange" for method, _ in script.steps)
        seed += 1


@cocotb.test(timeout_time=200, timeout_unit="ms")
async def does_what_the_model_does_through_random_sequences(dut):
    """The scripts of tests/conformance, each from a reset into whatever the one before has left."""
    panel = await Panel.after_reset(dut)
    emissions, noticed = 0, dict.fromkeys(("permit", "trigger", "exchange"), 0)
    for seed, script in scripts_of(RANDOM_FRAMES):
        if seed:
            panel = await panel.reset()
        await panel.perform(script)
        try:
            emissions += len(panel.check_against_model().focus_ticks)
        except AssertionError as error:
            raise AssertionError(f"random_script({seed}): {error}") from None
        for late in noticed if seed < SCRIPTS_LATE else ():
            try:
                panel.check_against_model(late)
            except AssertionError:
                noticed[late] += 1
    assert emissions > RANDOM_FRAMES // 2, "too few emissions to mean anything"
    assert noticed == dict.fromkeys(noticed, SCRIPTS_LATE), "one tick more of any input is a difference"
