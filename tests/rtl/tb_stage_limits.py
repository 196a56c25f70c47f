"""stage_limits: each limit at its value and one beyond it, at the tick it promises; random days against the reference."""

import random

import cocotb
from clocked import after_reset, clocks
from limits_reference import CHANNEL_EDGES, DUTY, LONG_EMISSION, NO_LIMITS, SHORT_PULSE, TOTAL_EDGES, Inputs, limits_reference

WINDOW_TICKS = 480  # as in BENCHES; resting turns have a longer one
PART_TICKS = 32
ALL = 0xFFFFFFFF


def decided(tick, channel):
    """Tick in which a change of a channel is a cause, if it is one: 3 behind its turn, which sees changes 2 ticks old."""
    return next(turn for turn in range(tick + 2, tick + 34) if turn % 32 == channel) + 3


async def follow(dut, inputs, **limits):
    """Outputs of every tick from reset on; they must be the reference's."""
    settings = NO_LIMITS | limits
    await after_reset(dut, **{f"{name}_i": value for name, value in settings.items()})
    seen = []
    for now in inputs:
        dut.channel_i.value, dut.clear_i.value = now.word, now.clear
        dut.active_i.value, dut.emission_i.value, dut.start_i.value = now.active, now.emission, now.start
        seen.append(tuple(int(signal.value) for signal in (dut.cause_o, dut.channels_o, dut.duty_level_o)))
        await clocks(dut)
    window_ticks = int(dut.EDGE_WINDOW_TICKS.value)
    expected = [(o.cause, o.channels, o.duty_level) for o in limits_reference(inputs, settings, window_ticks)]
    for tick, (got, due) in enumerate(zip(seen, expected, strict=False)):
        assert got == due, f"tick {tick}: {got} for {due}, {settings}"
    return seen


def causes(seen):
    """The ticks in which something is wrong."""
    return {tick: cause for tick, (cause, _, _) in enumerate(seen) if cause}


def pins(changes, ticks):
    """Inputs with `changes`, {tick: word}."""
    word, inputs = 0, []
    for tick in range(ticks):
        word = changes.get(tick, word)
        inputs.append(Inputs(word))
    return inputs


def toggles(channels, count, first=0, every=5):
    return {first + n * every: channels * ((n + 1) % 2) for n in range(count)}


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_pulse_may_be_as_short_as_the_limit_and_no_shorter(dut):
    for ticks in (1, 2, 7, 40):
        at = {10: 0x4, 10 + ticks: 0}
        assert causes(await follow(dut, pins(at, 80), pulse_ticks=ticks)) == {}
        seen = await follow(dut, pins(at, 80), pulse_ticks=ticks + 1)
        assert causes(seen) == {12 + ticks: SHORT_PULSE}
        assert seen[12 + ticks][1] == 0x4
        two = {10: 0x4, 10 + ticks: 0xC}  # one change each
        assert causes(await follow(dut, pins(two, 80), pulse_ticks=50)) == {}


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_chain_of_close_changes_is_evaluated_strictly_until_the_pins_rest(dut):
    chain = {10: 0x1, 16: 0x3, 22: 0x2}  # the pulse on channel 0 is 12 ticks long
    assert causes(await follow(dut, pins(chain, 60), pulse_ticks=6)) == {}
    assert causes(await follow(dut, pins(chain, 60), pulse_ticks=7)) == {24: SHORT_PULSE}
    assert causes(await follow(dut, pins(chain | {16: 0x3, 30: 0x2}, 60), pulse_ticks=8)) == {24: SHORT_PULSE}
    assert causes(await follow(dut, pins({10: 0x1, 13: 0x3, 23: 0x2}, 60), pulse_ticks=8)) == {}


@cocotb.test(timeout_time=200, timeout_unit="us")
async def each_channel_may_make_as_many_edges_in_a_window_as_its_limit(dut):
    for limit, every in ((0, 5), (1, 5), (30, 5), (62, 3), (63, 3), (64, 2), (65, 2), (150, 1)):
        for channel in (0, 13, 31):
            at = toggles(1 << channel, limit + 1, every=every, first=2)
            tick = decided(2 + limit * every, channel)
            assert causes(await follow(dut, pins(at, 230), channel_edges=limit + 1)) == {}
            seen = await follow(dut, pins(at, 230), channel_edges=limit)
            assert causes(seen) == {tick: CHANNEL_EDGES}
            assert seen[tick][1] == 1 << channel


@cocotb.test(timeout_time=200, timeout_unit="us")
async def all_channels_at_once_each_have_their_own_account(dut):
    at = toggles(ALL, 200, every=1)
    assert causes(await follow(dut, pins(at, 240), channel_edges=200)) == {}
    seen = await follow(dut, pins(at, 240), channel_edges=190)
    assert causes(seen) == dict.fromkeys(range(195, 236), CHANNEL_EDGES), "from turn 192 to the first that sees the last edge"
    assert seen[195][1] == 1


@cocotb.test(timeout_time=500, timeout_unit="us")
async def edges_count_in_their_part_and_the_fifteen_behind_it(dut):
    burst = toggles(0x10, 20, first=121, every=1)  # channel 4 begins a part at 5 * 32 + 4 - 33 = 131, all together at 128
    forgotten = 20 * PART_TICKS + 4 - 33  # the ten edges before tick 131
    assert causes(await follow(dut, pins(burst | {forgotten: 0x10}, forgotten + 40), channel_edges=20)) == {}
    early = await follow(dut, pins(burst | {forgotten - 1: 0x10}, forgotten + 40), channel_edges=20)
    assert causes(early) == {decided(forgotten - 1, 4): CHANNEL_EDGES}
    for tick, cause in ((19 * PART_TICKS, {}), (19 * PART_TICKS - 1, {19 * PART_TICKS + 2: TOTAL_EDGES})):
        assert causes(await follow(dut, pins(burst | {tick: 0x10}, tick + 8), total_edges=20)) == cause


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_steady_rate_may_last_as_long_as_it_keeps_the_limit(dut):
    ticks, every = 70 * PART_TICKS, 8
    steady = pins(toggles(0x20, ticks // every, every=every), ticks)
    most = 16 * PART_TICKS // every  # in 16 parts
    assert causes(await follow(dut, steady, channel_edges=most, total_edges=most)) == {}
    assert causes(await follow(dut, steady, channel_edges=most - 1, total_edges=most)) != {}
    assert causes(await follow(dut, steady, channel_edges=most, total_edges=most - 1)) != {}


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_limit_written_while_the_pins_rest_holds_for_what_was_counted_already(dut):
    for first, then in ((2**24 - 1, 31), (100, 31), (30, 31), (31, 33), (90, 93), (100, 20), (5, 6)):
        await after_reset(dut, **{f"{name}_i": value for name, value in NO_LIMITS.items()} | {"channel_edges_i": first})
        counted = min(first, 30) if first < 90 else 90
        trips = []
        for tick in range(340):
            if tick < counted or tick in range(135, 340, 40):
                dut.channel_i.value = int(dut.channel_i.value) ^ 0x80
            if tick == 130:  # when all of them have been counted
                dut.channel_edges_i.value = then
            trips.append(int(dut.cause_o.value) == CHANNEL_EDGES)
            await clocks(dut)
        assert trips.index(True) == decided(135 + 40 * max(then - counted, 0), 7)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def all_channels_together_have_a_limit(dut):
    at = {10: ALL, 20: 0x0000FFFF, 30: 0}  # 32 + 16 + 16
    assert causes(await follow(dut, pins(at, 60), total_edges=64)) == {}
    seen = await follow(dut, pins(at, 60), total_edges=63)
    assert causes(seen) == {33: TOTAL_EDGES}
    assert seen[40][1] == 0, "no one channel did it"


@cocotb.test(timeout_time=100, timeout_unit="us")
async def an_emission_may_sound_as_long_as_the_limit(dut):
    inputs = [Inputs(emission=10 <= tick < 40, start=tick == 9) for tick in range(60)]
    assert causes(await follow(dut, inputs, emission_ticks=30)) == {}
    assert causes(await follow(dut, inputs, emission_ticks=29)) == {40: LONG_EMISSION}
    assert causes(await follow(dut, inputs, emission_ticks=27)) == dict.fromkeys((38, 39, 40), LONG_EMISSION)
    again = [Inputs(emission=tick >= 10, start=tick % 30 == 9) for tick in range(160)]
    assert causes(await follow(dut, again, emission_ticks=30)) == {}
    assert causes(await follow(dut, again, emission_ticks=29)) == dict.fromkeys((40, 70, 100, 130), LONG_EMISSION)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def the_bucket_holds_its_budget_and_leaks(dut):
    inputs = [Inputs(active=5 <= tick < 45) for tick in range(120)]
    half = {"duty_share": 32768}
    seen = await follow(dut, inputs, **half, duty_ticks=20)
    assert causes(seen) == {}
    assert seen[45][2] == 20
    assert [seen[tick][2] for tick in (83, 84, 85, 86)] == [1, 0, 0, 0]
    assert causes(await follow(dut, inputs, **half, duty_ticks=19)) == {45: DUTY}
    assert causes(await follow(dut, inputs, duty_ticks=0)) == {}, "a share of one: always"
    assert causes(await follow(dut, inputs, duty_share=0, duty_ticks=38)) == {45: DUTY}


@cocotb.test(timeout_time=100, timeout_unit="us")
async def the_first_culprits_are_kept_until_cleared(dut):
    inputs = pins({10: 0x1, 12: 0, 30: 0x2, 32: 0, 50: 0x4, 52: 0}, 80)
    inputs[40].clear = True
    seen = await follow(dut, inputs, pulse_ticks=5)
    assert [seen[tick][1] for tick in (13, 14, 35, 41, 53, 54, 79)] == [0, 1, 1, 0, 0, 4, 4]
    inputs[40].clear, inputs[33].clear = False, True  # in the very clock in which the next ones come
    assert (await follow(dut, inputs, pulse_ticks=5))[34][1] == 0x2


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def random_days_are_as_in_the_reference(dut):
    tripped = 0
    for _ in range(12):
        gap, width = random.choice([1, 2, 8, 30]), random.choice([1, 3, 32])
        word, inputs, active = 0, [], False
        for _ in range(1500):
            if random.randrange(gap) == 0:
                word ^= random.getrandbits(32) & random.getrandbits(32) & (1 << width) - 1
            active ^= random.randrange(50) == 0
            start = random.randrange(60) == 0
            emission = (inputs[-1].start or (inputs[-1].emission and random.randrange(80) > 0)) if inputs else False
            inputs.append(Inputs(word, active, emission, start, random.randrange(300) == 0))
        edges = WINDOW_TICKS // gap // 4
        limits = {
            "pulse_ticks": random.choice([0, 1, 2, gap, 2 * gap, 65535]),
            "channel_edges": random.choice([random.randrange(2 * edges + 2), 2**24 - 1]),
            "total_edges": random.randrange(width * edges + 2),
            "emission_ticks": random.randrange(150),
            "duty_share": random.choice([0, 65536, random.randrange(65536)]),
            "duty_ticks": random.randrange(100),
        }
        for cause, _, _ in await follow(dut, inputs, **limits):
            tripped |= cause
    assert tripped == 31, "each of the five happens"


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def turns_that_rest_between_bursts_have_lost_nothing(dut):
    """With parts longer than turns stay awake; pulses alone at any distance from a burst, a part's beginning and each other."""
    tripped = 0
    for _ in range(6):
        word, inputs, gap = 0, [], 1
        for tick in range(3000):
            if tick % 150 == 0:
                gap = random.choice([1, 2, 7, 60, 70, 10**6])
            if random.randrange(gap) == 0:
                word ^= random.getrandbits(32) & random.getrandbits(32)
            inputs.append(Inputs(word))
        limits = {
            "channel_edges": random.randrange(10, 130),
            "total_edges": random.choice([2**29 - 1, random.randrange(300, 4000)]),
        }
        for cause, _, _ in await follow(dut, inputs, **limits):
            tripped |= cause
    assert tripped == CHANNEL_EDGES | TOTAL_EDGES
