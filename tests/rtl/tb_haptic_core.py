"""haptic_core: frames go in over the SPI pins, words come out on the channels, all as the model says."""

import itertools
import random

import cocotb
import pytest
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge
from panel import (
    BIT_TICKS,
    BUILD_HASH,
    CLOCK_HZ,
    HEARTBEAT_TICKS_MAX,
    IDLE_WORD,
    RAMP_SAMPLES,
    SCK_HALF_NS,
    SLOTS,
    Panel,
    bank_entry_words,
    random_words,
)

from controller.errors import LinkError
from controller.fpga import frames
from controller.fpga.registers import IDENTITY_MAGIC, TRIGGER_LATENCY_TICKS, Control, Fault, Register, Result, State

SHORT = 20  # words of most waveforms here
FIRST_WORD_TICKS = 1 + TRIGGER_LATENCY_TICKS  # tick 0 ends with the first clock edge that samples the trigger


def words_between(panel, first_tick, last_tick):
    return [entry for entry in panel.words if first_tick <= entry[0] <= last_tick]


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def plays_a_bank_entry_bit_for_bit(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    words = bank_entry_words()
    await panel.upload(1, words)
    await panel.send(frames.pack_play, 1)
    before = await panel.status()
    assert State.PENDING in before.state
    assert before.result is Result.OK
    start = await panel.trigger() + FIRST_WORD_TICKS
    await panel.wait(len(words) * BIT_TICKS + 20)
    end = start + len(words) * BIT_TICKS
    levels = [IDLE_WORD, *words.tolist()]
    sent = [(start + BIT_TICKS * n, word) for n, word in enumerate(levels[1:]) if word != levels[n]]
    assert words_between(panel, start - BIT_TICKS, end + BIT_TICKS) == [*sent, (end, IDLE_WORD)]
    assert panel.focus_ticks == [end]
    assert (await panel.status()).emissions == 1
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def first_word_comes_a_constant_number_of_clocks_after_the_trigger_at_any_sck(dut):
    assert TRIGGER_LATENCY_TICKS <= 8
    panel = await Panel.after_reset(dut)
    await panel.arm()
    for number, half_ns in enumerate((30, 35, 43, 67)):  # clk/6, clk/7, clk/8.6, clk/13.4
        panel.sck_half_ns = half_ns
        words = random_words(SHORT)
        await panel.upload(number % 2, words)
        await panel.send(frames.pack_play, number % 2)
        await panel.wait(random.randrange(50))
        start = await panel.trigger() + FIRST_WORD_TICKS
        await panel.wait(SHORT * BIT_TICKS + 20)
        assert words_between(panel, start - 6, start) == [(start, int(words[0]))]
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def refuses_a_damaged_frame_says_why_and_takes_the_next_good_one(dut):
    panel = await Panel.after_reset(dut)
    await panel.write(Register.IDLE_WORD, 1)
    good = bytearray(32)
    frames.pack_write(good, 0, 77, Register.IDLE_WORD, 0xBAD0BAD0)
    damaged = [
        (bytes(good[:31]), Result.BAD_LENGTH),
        (bytes(good[:5]), Result.BAD_LENGTH),
        (bytes(good[:9] + good[10:]), Result.BAD_LENGTH),
        (bytes(good) + b"\0", Result.BAD_LENGTH),
        (bytes(good[:1]), Result.BAD_LENGTH),
    ]
    for bit in [0, 15, 16, 32, 40, 255, *random.sample(range(256), 10)]:
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
    for bits in (1, 7, 255, 257):  # no whole number of bytes
        await panel.exchange(bytes(good) + b"\0", bits)
        assert (await panel.status()).result is (Result.BAD_LENGTH if bits > 16 else Result.BAD_SYNC)
        errors += 1
    await panel.exchange(b"", 0)  # no SCK edge: nothing happened
    assert (await panel.status()).result is Result.OK
    assert await panel.read(Register.FRAME_ERRORS) == errors
    assert await panel.read(Register.IDLE_WORD) == 1
    assert await panel.result_of(frames.pack_write, Register.IDLE_WORD, 2) is Result.OK
    assert await panel.read(Register.IDLE_WORD) == 2


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_damaged_load_does_not_count_and_spoils_nothing_else(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    words = random_words(SHORT)
    await panel.upload(0, random_words(SHORT))
    for damage in (lambda load: load[:-1], lambda load: load[:20], lambda load: load + bytes(8)):
        load = bytearray(12 + 4 * SHORT)
        frames.pack_load(load, 0, 9, 0, memoryview(random_words(SHORT).tobytes()))
        await panel.send(frames.pack_load, 0, memoryview(words.tobytes()))
        await panel.exchange(bytes(damage(load)))
        assert await panel.result_of(frames.pack_store, 1, SHORT) is Result.INCOMPLETE
    await panel.upload(1, words)
    await panel.send(frames.pack_play, 1)
    start = await panel.trigger() + FIRST_WORD_TICKS
    await panel.wait(SHORT * BIT_TICKS + 20)
    assert words_between(panel, start, start) == [(start, int(words[0]))]
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def loading_and_storing_never_disturb_what_plays_or_waits(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    old, new = random_words(125), random_words(SHORT)
    await panel.upload(0, old)
    await panel.send(frames.pack_play, 0, count=0, period_ticks=125 * BIT_TICKS)
    await panel.trigger()
    await panel.upload(0, new)  # stored while the old one sounds
    assert State.LANDING_BUSY in (await panel.status()).state
    assert await panel.result_of(frames.pack_load, 0, memoryview(bytes(500))) is Result.BUSY
    await panel.send(frames.pack_play, 0)
    await panel.control(Control.STOP)
    load = (frames.pack_load, 0, memoryview(bytes(500)))
    assert await panel.result_of(*load) is Result.BUSY, "it was when the frame began, if not when it ended"
    assert State.LANDING_BUSY not in (await panel.status()).state
    assert await panel.result_of(frames.pack_load, 0, memoryview(bytes(500))) is Result.OK
    assert {word for tick, word in panel.words if tick > panel.focus_ticks[0]} <= {*old.tolist(), IDLE_WORD}
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def shuts_within_the_timeout_when_the_host_falls_silent_and_keeps_the_cause(dut):
    panel = await Panel.after_reset(dut)
    heartbeat_ticks = 6000
    await panel.arm(heartbeat_ticks)
    await panel.upload(0, random_words(SHORT))
    await panel.send(frames.pack_play, 0, count=0, period_ticks=SHORT * BIT_TICKS)
    await panel.trigger()
    await panel.status()
    heard = panel.tick
    damaged = bytearray(32)
    frames.pack_nop(damaged, 0, 1)
    damaged[20] ^= 1
    for _ in range(3):
        await panel.exchange(bytes(damaged))  # no sign of life
    await panel.wait(heard + heartbeat_ticks + 10 - panel.tick)
    assert panel.levels[-1][1] == 0
    assert panel.words[-1][1] == 0
    assert heard - 10 <= panel.levels[-1][0] - heartbeat_ticks <= heard + 2
    status = await panel.status()
    assert status.faults == Fault.HOST_SILENT
    assert not status.state & (State.ARMED | State.PLAYING | State.REPEATING | State.HV_ENABLE)
    assert await panel.result_of(frames.pack_arm, BUILD_HASH) is Result.FAULTED
    assert await panel.result_of(frames.pack_play, 0) is Result.FAULTED
    assert await panel.read(Register.FAULT) == Fault.HOST_SILENT
    await panel.control(Control.CLEAR)
    await panel.arm_again()
    assert (await panel.status()).faults == Fault(0)
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_trigger_while_unarmed_or_with_nothing_to_play_is_counted_and_ignored(dut):
    panel = await Panel.after_reset(dut)
    await panel.trigger()
    assert await panel.result_of(frames.pack_play, 0) is Result.NOT_ARMED
    await panel.trigger()
    await panel.wait(50)
    assert panel.words == []
    await panel.arm()
    await panel.upload(0, random_words(SHORT))
    await panel.send(frames.pack_play, 0)
    await panel.trigger()
    await panel.wait(10)
    await panel.trigger()  # during the emission
    await panel.wait(SHORT * BIT_TICKS)
    await panel.trigger()  # after it
    await panel.wait(SHORT * BIT_TICKS)
    status = await panel.status()
    assert (status.trigger_count, status.emissions) == (5, 1)
    assert await panel.read(Register.TRIGGERS_IGNORED) == 4
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def is_low_within_four_clocks_of_a_lost_permit(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    await panel.upload(0, random_words(SHORT) | 1)
    await panel.send(frames.pack_play, 0, count=3, period_ticks=300)
    await panel.trigger()
    await panel.wait(4 * BIT_TICKS)
    lost = panel.tick
    panel.permit(False)
    await panel.wait(4)
    assert dut.channel_o.value == 0
    assert dut.hv_enable_o.value == 0
    assert dut.focus_o.value == 0
    assert lost < panel.levels[-1][0] <= lost + 4
    panel.permit(True)
    await panel.wait(400)
    assert panel.levels[-1][1] == 0
    status = await panel.status()
    assert status.faults == Fault.NO_PERMIT
    assert status.emissions == 0
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def arms_only_with_the_right_key_and_permit_and_glides_both_ways(dut):
    panel = await Panel.after_reset(dut)
    assert await panel.result_of(frames.pack_arm, BUILD_HASH) is Result.NO_PERMIT
    assert await panel.result_of(frames.pack_arm, BUILD_HASH ^ 1) is Result.BAD_KEY
    assert panel.levels == []
    await panel.arm()
    assert await panel.result_of(frames.pack_write, Register.CHANNEL_MASK, 0) is Result.ARMED
    await panel.control(Control.DISARM)
    await panel.wait(RAMP_SAMPLES * BIT_TICKS + 10)
    assert panel.levels[-1][1] == 0
    assert panel.words[-1][1] == 0
    await panel.write(Register.RAMP_SAMPLES, 1500)  # long enough to be turned back on the way
    await panel.write(Register.CHANNEL_MASK, 0xFF00FFFF)
    await panel.send(frames.pack_arm, BUILD_HASH)
    await panel.wait(300)
    await panel.control(Control.DISARM)
    assert State.RAMPING in (await panel.status()).state
    await panel.wait(6000)
    assert (await panel.status()).state == State.RUN_PERMIT | State.HEARTBEAT
    masked = [word for tick, word in panel.words if tick > panel.levels[-2][0]]
    assert len(masked) > 100
    assert all(word in (0, IDLE_WORD & 0xFF00FFFF) for word in masked)
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def disarming_drops_what_plays_and_what_waits(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    await panel.upload(0, random_words(SHORT))
    await panel.send(frames.pack_play, 0, count=0, period_ticks=100)
    await panel.trigger()
    await panel.send(frames.pack_play, 0)
    await panel.control(Control.DISARM)
    assert not (await panel.status()).state & (State.PLAYING | State.REPEATING | State.PENDING)
    await panel.arm_again()
    await panel.trigger()
    await panel.wait(300)
    assert (await panel.status()).state == State.ARMED | State.HV_ENABLE | State.RUN_PERMIT | State.HEARTBEAT
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def gives_signs_of_life_at_10_khz_while_the_outputs_are_on(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    edges = []
    for _ in range(6):
        await RisingEdge(dut.hv_alive_o)
        edges.append(panel.tick)
    periods = {later - earlier for earlier, later in itertools.pairwise(edges)}
    assert len(periods) == 1
    assert CLOCK_HZ / periods.pop() >= 10_000
    panel.permit(False)
    await panel.wait(5)
    for _ in range(200):
        await FallingEdge(dut.clk_i)
        assert dut.hv_alive_o.value == 0


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def says_what_it_is(dut):
    panel = await Panel.after_reset(dut)
    expected = dict.fromkeys(Register, 0) | {
        Register.IDENTITY: IDENTITY_MAGIC,
        Register.PROTOCOL: 1,
        Register.BUILD_HASH: BUILD_HASH,
        Register.CLOCK_HZ: CLOCK_HZ,
        Register.GEOMETRY: SLOTS | 1000 << 8 | 32 << 24,
        Register.BIT_TICKS: 4,
        Register.RAMP_SAMPLES: 5000,
        Register.HEARTBEAT_TICKS: HEARTBEAT_TICKS_MAX,
        Register.CHANNEL_MASK: 0xFFFFFFFF,
    }
    for register, value in expected.items():
        assert await panel.read(register) == value, register.name
    panel.check_against_model()


@cocotb.test(timeout_time=5, timeout_unit="ms")
async def a_reset_in_the_middle_of_everything_leaves_nothing_behind(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    await panel.upload(0, random_words(SHORT))
    await panel.send(frames.pack_play, 0, count=0, period_ticks=200)
    await panel.trigger()
    frame = cocotb.start_soon(panel.status())
    await panel.wait(700)
    dut.rst_i.value = 1
    dut.trigger_i.value = 1  # no edge: it was high before anything was seen
    await ClockCycles(dut.clk_i, 4)
    await FallingEdge(dut.clk_i)
    assert dut.channel_o.value == 0
    assert dut.hv_enable_o.value == 0
    dut.rst_i.value = 0
    with pytest.raises(LinkError):  # the rest of the answer
        await frame
    status = await panel.status()
    assert (status.result, status.state, status.trigger_count) == (Result.OK, State.RUN_PERMIT, 0)
    assert await panel.read(Register.FRAME_ERRORS) == 0
    assert await panel.read(Register.SLOTS_LOADED) == 0


async def act_at_random(panel):
    """One random action, with triggers as near to its effect as can be."""
    slot, length = random.randrange(SLOTS + 1), random.choice([1, 2, 3, 5, 8, SHORT])
    period = length * BIT_TICKS + random.choice([-1, 0, 0, 1, 2, 7, 150])
    kinds = {"play": 30, "load": 12, "store": 14, "trigger": 25, "wait": 10, "stop": 5, "disarm": 3, "arm": 3, "permit": 2}
    kinds |= {"clear": 2, "read": 4, "write": 3, "damaged": 2}
    action = random.choices(list(kinds), list(kinds.values()))[0]
    if action == "play":
        await panel.send(frames.pack_play, slot, count=random.choice([0, 1, 1, 2, 3]), period_ticks=period)
    elif action == "load":
        chunk = random.choices([0, 7, 8], [9, 1, 1])[0]
        await panel.send(frames.pack_load, chunk, memoryview(random_words(length).tobytes()))
    elif action == "store":
        await panel.send(frames.pack_store, slot, length)
    elif action == "trigger":
        for _ in range(random.randrange(1, 4)):
            await panel.trigger()
            await panel.wait(max(random.choice([0, 5, length * BIT_TICKS - 3, length * BIT_TICKS - 4, period - 4]), 1))
    elif action == "wait":
        await panel.wait(random.randrange(1, 200))
    elif action == "read":
        await panel.send(frames.pack_read, random.randrange(18))
    elif action == "write":
        await panel.write(random.choice([0, 6, 7, 9, 16]), random.choice([0, 1, 3, 4, 6, 0x10000, IDLE_WORD]))
    elif action == "permit":
        panel.permit(False)
        await panel.wait(random.randrange(1, 6))
        panel.permit(True)
    elif action == "damaged":
        frame = bytearray(44)
        end = frames.pack_load(frame, 0, 1, 0, memoryview(random_words(8).tobytes()))
        frame[random.randrange(end)] ^= 1 << random.randrange(8)
        await panel.exchange(bytes(frame[: random.choice([end, random.randrange(1, end)])]))
    elif action == "arm":
        await panel.send(frames.pack_arm, BUILD_HASH)
    else:
        await panel.control({"stop": Control.STOP, "disarm": Control.DISARM, "clear": Control.CLEAR}[action])
    if random.random() < 0.4:  # chip select rose four ticks ago, and its frame is carried out now
        await panel.trigger()


@cocotb.test(timeout_time=100, timeout_unit="ms")
async def does_what_the_model_does_through_random_sequences(dut):
    panel = await Panel.after_reset(dut)
    await panel.arm()
    for slot in range(SLOTS):
        await panel.upload(slot, random_words(SHORT))
    for number in range(400):
        panel.sck_half_ns = random.choice([SCK_HALF_NS, SCK_HALF_NS, 34])
        await act_at_random(panel)
        if number % 20 == 19:  # back to work, whatever the state
            await panel.control(Control.CLEAR)
            await panel.write(Register.BIT_TICKS, BIT_TICKS)
            await panel.write(Register.HEARTBEAT_TICKS, HEARTBEAT_TICKS_MAX)
            await panel.send(frames.pack_arm, BUILD_HASH)
            await panel.wait(RAMP_SAMPLES * BIT_TICKS + 10)
    capture = panel.check_against_model()
    assert len(capture.focus_ticks) > 100, "too few emissions to mean anything"
    with pytest.raises(AssertionError, match="model"):
        panel.check_against_model(late_trigger_ticks=1)
