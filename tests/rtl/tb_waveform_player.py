"""waveform_player: one trigger starts one accepted play, each word is held its time, repetitions keep their period."""

import cocotb
from clocked import after_reset, clocks, pulse

from controller.fpga.registers import Result

IDLE, BIT_TICKS = 0xAAAA5555, 4
SOUND = 3  # clocks from the trigger pulse to the first word on drive_o


class Player:
    """A player whose memory holds word = buffer << 16 | index; drive_o clock by clock."""

    def __init__(self, dut):
        self.dut = dut

    @classmethod
    async def ready(cls, dut):
        settings = {"idle_word_i": IDLE, "bit_ticks_i": BIT_TICKS, "armed_i": 1, "slot_good_i": 1, "landing_i": 2}
        await after_reset(dut, **settings)
        player = cls(dut)
        cocotb.start_soon(player._memory())
        await clocks(dut, 3)
        return player

    async def _memory(self):
        dut = self.dut
        while True:
            address = int(dut.read_buffer_o.value) << 16 | int(dut.read_word_o.value)
            await clocks(dut)
            dut.read_data_i.value = address

    async def play(self, buffer=1, words=3, count=1, period=0):
        dut = self.dut
        dut.slot_buffer_i.value, dut.slot_words_i.value = buffer, words
        dut.count_i.value, dut.period_ticks_i.value = count, period
        await clocks(dut, 3)
        result = Result(int(dut.play_result_o.value))
        await pulse(dut, dut.play_i)
        return result

    async def drive(self, ticks):
        seen = []
        for _ in range(ticks):
            await clocks(self.dut)
            seen.append(int(self.dut.drive_o.value))
        return seen


def emission(buffer, words):
    return [buffer << 16 | n for n in range(words) for _ in range(BIT_TICKS)]


@cocotb.test(timeout_time=100, timeout_unit="us")
async def plays_each_word_its_time_and_then_the_idle_word(dut):
    player = await Player.ready(dut)
    assert await player.play(words=5) is Result.OK
    assert dut.pending_o.value == 1
    await pulse(dut, dut.trigger_i)
    assert dut.pending_o.value == 0
    assert await player.drive(26) == [IDLE] * (SOUND - 2) + emission(1, 5) + [IDLE] * 5
    await pulse(dut, dut.trigger_i)
    assert set(await player.drive(30)) == {IDLE}
    assert (int(dut.triggers_o.value), int(dut.ignored_o.value)) == (2, 1)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def repeats_exactly_a_period_apart_as_often_as_asked(dut):
    player = await Player.ready(dut)
    for count, period in ((3, 12), (2, 13), (4, 30)):
        await player.play(count=count, period=period)
        await pulse(dut, dut.trigger_i)
        once = emission(1, 3) + [IDLE] * (period - 12)
        assert await player.drive(1 + count * period + 20) == [IDLE] + once * count + [IDLE] * 20


@cocotb.test(timeout_time=100, timeout_unit="us")
async def goes_on_endlessly_until_stopped_and_ends_the_last_emission(dut):
    player = await Player.ready(dut)
    await player.play(count=0, period=20)
    await pulse(dut, dut.trigger_i)
    seen = await player.drive(1 + 20 * 5)
    assert seen == [IDLE] + (emission(1, 3) + [IDLE] * 8) * 5
    assert dut.repeating_o.value == 1
    await clocks(dut, 2)
    await pulse(dut, dut.stop_i)
    assert dut.playing_o.value == 1
    seen = await player.drive(100)
    assert [word for word in seen if word != IDLE][-1] == 1 << 16 | 2
    assert set(seen[20:]) == {IDLE}
    assert dut.repeating_o.value == 0


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_pending_play_starts_in_a_pause_but_never_cuts_an_emission(dut):
    player = await Player.ready(dut)
    await player.play(count=0, period=40)
    await pulse(dut, dut.trigger_i)
    await player.play(buffer=2, words=2)
    assert dut.landing_busy_o.value == 1, "what waits may not be overwritten"
    await pulse(dut, dut.trigger_i)
    assert dut.pending_o.value == 1
    await clocks(dut, 20)
    dut.landing_i.value = 1
    await clocks(dut)
    assert dut.playing_o.value == 0
    assert dut.landing_busy_o.value == 1, "it will sound again after its pause"
    dut.landing_i.value = 2
    await pulse(dut, dut.trigger_i)
    assert await player.drive(100) == [IDLE] * (SOUND - 2) + emission(2, 2) + [IDLE] * 91
    assert int(dut.ignored_o.value) == 1
    assert dut.landing_busy_o.value == 0


@cocotb.test(timeout_time=100, timeout_unit="us")
async def says_why_it_does_not_take_a_play(dut):
    player = await Player.ready(dut)
    assert await player.play(count=2, period=11) is Result.BAD_VALUE
    assert await player.play(count=0, period=11) is Result.BAD_VALUE
    assert await player.play(words=0) is Result.EMPTY_SLOT
    for signal, value, reason in (
        (dut.armed_i, 0, Result.NOT_ARMED),
        (dut.faulted_i, 1, Result.FAULTED),
        (dut.slot_good_i, 0, Result.BAD_SLOT),
    ):
        before = int(signal.value)
        signal.value = value
        assert await player.play() is reason
        assert dut.pending_o.value == 0
        signal.value = before
    assert await player.play(count=2, period=12) is Result.OK
    assert await player.play() is Result.BUSY


@cocotb.test(timeout_time=100, timeout_unit="us")
async def drops_everything_at_once_and_counts_only_what_ran_to_its_end(dut):
    player = await Player.ready(dut)
    await player.play(count=0, period=12)
    await pulse(dut, dut.trigger_i)
    ends = []
    for tick in range(40):
        await clocks(dut)
        if dut.ended_o.value:
            ends.append(tick)
    assert ends == [12 + SOUND - 2 + 12 * n for n in range(3)]  # with the first word after the emission
    while not (dut.playing_o.value and int(dut.read_word_o.value) == 1):
        await clocks(dut)
    await pulse(dut, dut.drop_i)
    assert (int(dut.playing_o.value), int(dut.repeating_o.value)) == (0, 0)
    assert set((await player.drive(40))[2:]) == {IDLE}
    await player.play(words=1)
    await pulse(dut, dut.trigger_i)
    await clocks(dut, BIT_TICKS)
    await pulse(dut, dut.fault_i)  # while the end is on its way to the pins
    for _ in range(10):
        assert dut.ended_o.value == 0
        await clocks(dut)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def while_ramping_all_idle_channels_follow_the_bit(dut):
    player = await Player.ready(dut)
    dut.ramping_i.value = 1
    await clocks(dut)
    for bit in (0, 1, 1, 0):
        dut.ramp_bit_i.value = bit
        assert await player.drive(1) == [IDLE * bit]
