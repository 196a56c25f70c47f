"""play_check: which plays are accepted, which refused, and for which of the reasons first."""

import random
from dataclasses import dataclass, replace

import cocotb
from clocked import after_reset, clocks, reset, settled

from controller.device.fpga.registers import PLAY_LANDING, Result, Start

REST_TICKS = 2  # argument, slot and word 0 rest before words 0 to 2 are there
BEGIN_TO_ACCEPT = 29  # ticks from words 0 to 2 to the first in which the frame may be accepted: 28 between
ASK_TICKS = REST_TICKS + BEGIN_TO_ACCEPT
LEAD = 28  # a time is met if it is this many ticks, or more, behind the tick in which its frame is accepted
NAMES = [
    "argument", "first", "asked", "count", "start", "polarity", "period", "when", "bit_period", "emission_ticks",
    "slot_good", "slot_buffer", "slot_words", "slot_intact", "slot_checking", "landing", "arriving", "fast",
    "armed", "faulted", "queued", "full",
]  # fmt: skip

FETCH_GAP_TICKS = 2  # so that the next play can be fetched


@dataclass(frozen=True)
class Play:
    """A PLAY of words 10 to 29 of a slot with 100, and all that decides whether it is good: it is."""

    argument: int = 1
    first: int = 10
    asked: int = 20
    count: int = 1
    start: int = Start.TRIGGER
    polarity: int = 0
    period: int = 0
    when: int = 0
    bit_period: int = 0x5_8000
    emission_ticks: int = 110
    slot_good: int = 1
    slot_buffer: int = 5
    slot_words: int = 100
    slot_intact: int = 1
    slot_checking: int = 0
    landing: int = 3
    arriving: int = 1
    fast: int = 1
    armed: int = 1
    faulted: int = 0
    queued: int = 0
    full: int = 0

    @property
    def live(self):
        return self.argument == PLAY_LANDING

    @property
    def words(self):
        held = 1000 if self.live else self.slot_words
        return self.asked or held - self.first

    @property
    def ticks(self):
        return self.words * self.bit_period >> 16

    @property
    def rest(self):
        return self.bit_period >> 16


class Reference:
    """Results in their order, by the contract; what is scheduled is kept as the tick from which another may begin."""

    def __init__(self):
        self.free_from = 0

    def judge(self, play, accepted):
        """Result of a play whose frame is accepted in this tick; a good one is scheduled."""
        held = 1000 if play.live else play.slot_words
        scheduled = play.start == Start.TIME
        in_range = play.first < held and play.first + play.asked <= held and not (play.live and play.first)
        period_good = play.period == play.ticks or play.period >= play.ticks + play.rest
        reasons = (
            (Result.BAD_SLOT, not play.live and not play.slot_good),
            (Result.FAULTED, play.faulted),
            (Result.NOT_ARMED, not play.armed),
            (Result.EMPTY_SLOT, not play.live and not play.slot_words),
            (Result.BUSY, not play.live and play.slot_checking),
            (Result.SLOT_DAMAGED, not play.live and not play.slot_intact),
            (Result.INCOMPLETE, play.live and not play.arriving),
            (Result.LINK_SLOW, play.live and not play.fast),
            (Result.BUSY, play.live and play.queued),
            (Result.BAD_RANGE, not in_range),
            (Result.BAD_VALUE, play.start > 2 or play.polarity > 1),
            (Result.TOO_LONG, play.ticks > play.emission_ticks),
            (Result.BAD_PERIOD, play.count != 1 and not period_good),
            (Result.QUEUE_FULL, play.full),
            (Result.TOO_LATE, scheduled and play.when < accepted + LEAD),
            (Result.OVERLAP, scheduled and play.when < self.free_from),
        )
        for reason, holds in reasons:
            if holds:
                return reason
        if scheduled:
            self.free_from = play.when + (max(play.count, 1) - 1) * play.period + play.ticks + play.rest + FETCH_GAP_TICKS
        return Result.OK


class Bench:
    def __init__(self, dut):
        self.dut, self.tick, self.reference = dut, 0, Reference()

    @classmethod
    async def ready(cls, dut, now=0):
        await after_reset(dut, now_i=now, judge_i=1)
        bench = cls(dut)
        bench.tick = now
        await bench.step(2)
        return bench

    async def step(self, count=1):
        for _ in range(count):
            await clocks(self.dut)
            self.tick += 1
            self.dut.now_i.value = self.tick

    def show(self, play):
        for name in NAMES:
            getattr(self.dut, f"{name}_i").value = int(getattr(play, name))

    async def begin(self, play):
        """Words 0 to 2 of a frame are there, and what it names has rested."""
        self.show(play)
        await self.step(REST_TICKS)
        self.dut.begin_i.value = 1
        await self.step()
        self.dut.begin_i.value = 0

    async def ask(self, play, wait=BEGIN_TO_ACCEPT):
        """A whole PLAY frame: its lengths are known in one tick, it is accepted `wait` ticks later."""
        await self.begin(play)
        await self.step(wait - 1)
        self.dut.accept_i.value = 1
        await settled()
        result = Result(int(self.dut.result_o.value))
        expected = self.reference.judge(play, self.tick)
        assert result is expected, (result, expected, play, self.tick)
        if result is Result.OK:
            assert int(self.dut.length_o.value) == play.words
            assert int(self.dut.live_o.value) == play.live
            assert int(self.dut.buffer_o.value) == (play.landing if play.live else play.slot_buffer)
        await self.step()
        self.dut.accept_i.value = 0
        await self.step()  # a frame's words rest for a clock behind it
        return result

    async def forget(self):
        self.dut.forget_i.value = 1
        await self.step()
        self.dut.forget_i.value = 0
        self.reference = Reference()


GOOD = Play()
LIVE = replace(GOOD, argument=PLAY_LANDING, first=0, slot_good=0, slot_words=0, slot_intact=0)
REASONS = (  # as they come, each with what brings it about in a slot's play, and in one of the landing buffer
    (Result.BAD_SLOT, {"slot_good": 0}, None),
    (Result.FAULTED, {"faulted": 1}, {"faulted": 1}),
    (Result.NOT_ARMED, {"armed": 0}, {"armed": 0}),
    (Result.EMPTY_SLOT, {"slot_words": 0}, None),
    (Result.BUSY, {"slot_checking": 1}, None),
    (Result.SLOT_DAMAGED, {"slot_intact": 0}, None),
    (Result.INCOMPLETE, None, {"arriving": 0}),
    (Result.LINK_SLOW, None, {"fast": 0}),
    (Result.BUSY, None, {"queued": 1}),
    (Result.BAD_RANGE, {"first": 81}, {"first": 1}),
    (Result.BAD_VALUE, {"polarity": 2}, {"polarity": 2}),
    (Result.TOO_LONG, {"emission_ticks": 109}, {"emission_ticks": 109}),
    (Result.BAD_PERIOD, {"count": 2, "period": 109}, {"count": 2, "period": 109}),
    (Result.QUEUE_FULL, {"full": 1}, {"full": 1}),
)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def names_the_first_of_all_its_reasons(dut):
    for kind, good in enumerate((GOOD, LIVE)):
        bench = await Bench.ready(dut)
        assert await bench.ask(good) is Result.OK
        reasons = [(result, changes[kind]) for result, *changes in REASONS if changes[kind]]
        everything = {"start": Start.TIME, "when": 0}
        assert await bench.ask(replace(good, **everything)) is Result.TOO_LATE
        for result, changes in reversed(reasons):
            assert await bench.ask(replace(good, **changes)) is result, "alone"
            everything |= changes
            assert await bench.ask(replace(good, **everything)) is result, "with all that come behind it"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_range_lies_within_the_waveform(dut):
    bench = await Bench.ready(dut)
    for held, good, bad in (
        (
            100,
            [(0, 0), (0, 100), (99, 0), (99, 1), (50, 50)],
            [(100, 0), (0, 101), (99, 2), (100, 1), (50, 51), (1024, 1), (0, 1124)],
        ),
        (1, [(0, 0), (0, 1)], [(1, 0), (0, 2), (1, 1)]),
        (1000, [(0, 0), (999, 1), (0, 1000)], [(1000, 0), (999, 2), (0xFFFF, 1), (1, 0xFFFF), (0xFFFF, 0xFFFF), (0x8000, 0x8000)]),
    ):
        fitting = replace(GOOD, slot_words=held, emission_ticks=5500)
        for first, asked in good:
            assert await bench.ask(replace(fitting, first=first, asked=asked)) is Result.OK, (held, first, asked)
            assert int(dut.length_o.value) == (asked or held - first)
        for first, asked in bad:
            assert await bench.ask(replace(fitting, first=first, asked=asked)) is Result.BAD_RANGE, (held, first, asked)
    landing = replace(LIVE, emission_ticks=5500)
    for asked in (0, 1, 1000):
        assert await bench.ask(replace(landing, asked=asked)) is Result.OK
        assert int(dut.length_o.value) == (asked or 1000)
    for first, asked in ((0, 1001), (1, 0), (1, 1), (0, 0xFFFF), (0x400, 1)):
        assert await bench.ask(replace(landing, first=first, asked=asked)) is Result.BAD_RANGE
    for argument in (0, 0x7FFF, 0xFFFE, 0xFEFF):
        assert await bench.ask(replace(GOOD, argument=argument, slot_good=0)) is Result.BAD_SLOT, "only one number means landing"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def start_and_polarity_are_among_those_there_are(dut):
    bench = await Bench.ready(dut)
    for start in range(256):
        expected = Result.OK if start < 2 else Result.TOO_LATE if start == 2 else Result.BAD_VALUE
        assert await bench.ask(replace(GOOD, start=start)) is expected
    for polarity in (0, 1, 2, 3, 4, 0x80, 0xFF):
        expected = Result.OK if polarity < 2 else Result.BAD_VALUE
        assert await bench.ask(replace(GOOD, polarity=polarity)) is expected


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def an_emission_lasts_the_whole_part_of_its_words_times_the_bit_period(dut):
    bench = await Bench.ready(dut)
    for words, bit_period in ((20, 0x5_8000), (3, 0x5_5555), (3, 0x5_5556), (1, 0x4_FFFF), (1000, 0xFFFF_FFFF), (1000, 0x4_0000)):
        play = replace(GOOD, first=0, asked=words, slot_words=1000, bit_period=bit_period)
        ticks, rest = play.ticks, play.rest
        assert await bench.ask(replace(play, emission_ticks=ticks)) is Result.OK
        assert await bench.ask(replace(play, emission_ticks=ticks - 1)) is Result.TOO_LONG
        for count in (0, 2, 3, 0xFFFF):
            allowed = replace(play, count=count, emission_ticks=ticks)
            for period in (ticks, ticks + rest, ticks + rest + 1, 0xFFFF_FFFF):
                assert await bench.ask(replace(allowed, period=period)) is Result.OK, (words, bit_period, period)
            for period in (0, ticks - 1, ticks + 1, ticks + rest - 1):
                assert await bench.ask(replace(allowed, period=period)) is Result.BAD_PERIOD, (words, bit_period, period)
        assert await bench.ask(replace(play, emission_ticks=ticks, period=ticks - 1)) is Result.OK, "one alone has no period"
    assert await bench.ask(replace(GOOD, asked=0, emission_ticks=495)) is Result.OK, "90 words to the end"
    assert await bench.ask(replace(GOOD, asked=0, emission_ticks=494)) is Result.TOO_LONG


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_time_is_far_enough_ahead_to_be_met(dut):
    for now in (0, (1 << 32) - 100, (1 << 63) + 5):
        bench = await Bench.ready(dut, now)
        for late in (1, 2, 1000):
            play = replace(GOOD, start=Start.TIME, when=max(0, bench.tick + ASK_TICKS + LEAD - late))
            assert await bench.ask(play) is Result.TOO_LATE
        for early in (0, 1000, 1 << 33):
            play = replace(GOOD, start=Start.TIME, when=bench.tick + ASK_TICKS + LEAD + early)
            assert await bench.ask(play) is Result.OK
            await bench.forget()
        for start in (Start.NOW, Start.TRIGGER):
            assert await bench.ask(replace(GOOD, start=start, when=1)) is Result.OK, "a delay is no time"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def what_is_scheduled_does_not_overlap(dut):
    for count, span in ((1, 110 + 5 + 2), (3, 2 * 200 + 117), (0, 117), (0xFFFF, 0xFFFE * 200 + 117)):
        bench = await Bench.ready(dut)
        scheduled = replace(GOOD, start=Start.TIME, count=count, period=200)
        when = 1_000
        assert await bench.ask(replace(scheduled, when=when)) is Result.OK
        assert await bench.ask(replace(scheduled, when=when + span - 1)) is Result.OVERLAP
        assert await bench.ask(replace(scheduled, when=when)) is Result.OVERLAP
        assert await bench.ask(replace(GOOD, when=when)) is Result.OK, "a trigger comes when it comes"
        assert await bench.ask(replace(scheduled, when=when + span, full=1)) is Result.QUEUE_FULL
        assert await bench.ask(replace(scheduled, when=when + span + 7)) is Result.OK, "refused ones take no time"
        assert await bench.ask(replace(scheduled, when=when + 2 * span + 6)) is Result.OVERLAP
        await bench.forget()
        assert await bench.ask(replace(scheduled, when=when + 1)) is Result.OK
    bench = await Bench.ready(dut)
    longest = replace(scheduled, period=0xFFFF_FFFF, count=0xFFFF, when=(1 << 40) + 1)
    assert await bench.ask(longest) is Result.OK
    end = longest.when + 0xFFFE * 0xFFFF_FFFF + 117
    assert await bench.ask(replace(scheduled, when=end - 1)) is Result.OVERLAP
    assert await bench.ask(replace(scheduled, when=end)) is Result.OK
    bench.show(replace(scheduled, when=2_000))  # shown, but its frame is not accepted
    await bench.step(5)
    await reset(dut)
    bench.tick += 1
    bench.reference = Reference()
    assert await bench.ask(replace(scheduled, when=1_000)) is Result.OK
    dut.forget_i.value = 1  # in the very tick of an acceptance: nothing stays
    assert await bench.ask(replace(scheduled, when=10_000_000_000)) is Result.OK
    dut.forget_i.value = 0
    bench.reference = Reference()
    assert await bench.ask(replace(scheduled, when=1_000)) is Result.OK


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_frame_that_never_ended_leaves_nothing_behind(dut):
    bench = await Bench.ready(dut)
    for cut in (0, 1, 10, 11, 12, 27, 28, 29):
        await bench.begin(replace(GOOD, asked=0, count=0xFFFF, period=0xFFFF_FFFF))
        await bench.step(cut)
        assert await bench.ask(replace(GOOD, count=3, period=110)) is Result.OK
        assert await bench.ask(replace(GOOD, count=3, period=109)) is Result.BAD_PERIOD
        await bench.begin(GOOD)
        await bench.step(cut)
        await reset(dut)
        bench.tick += 1
        bench.reference = Reference()


def random_play(tick, free_from):
    bit_period = random.choice([0x4_0000, 0x5_8000, 0xA0_1234, random.getrandbits(25) | 0x4_0000])
    live = random.random() < 0.3
    held = 1000 if live else random.choice([0, 1, 7, 1000, random.randrange(1001)])
    first = random.choice([0, 0, 0, 1, held, held - 1, random.randrange(1001)]) % 65536
    asked = random.choice([0, held, held - first, held - first + 1, random.randrange(1, 1001), random.getrandbits(16)]) % 65536
    play = Play(
        argument=PLAY_LANDING if live else random.randrange(16),
        first=first,
        asked=asked,
        count=random.choice([0, 1, 1, 2, random.getrandbits(16)]),
        start=random.choice([*Start, Start.TIME, random.getrandbits(8)]),
        polarity=random.choice([0, 1, 1, random.getrandbits(8)]),
        bit_period=bit_period,
        slot_good=int(random.random() < 0.95),
        slot_buffer=random.randrange(8),
        slot_words=random.randrange(1001) if live else held,
        slot_intact=int(random.random() < 0.95),
        slot_checking=int(random.random() < 0.05),
        landing=random.randrange(8),
        arriving=int(random.random() < 0.9),
        fast=int(random.random() < 0.9),
        armed=int(random.random() < 0.95),
        faulted=int(random.random() < 0.05),
        queued=random.choice([0, 0, 0, random.randrange(9)]),
        full=int(random.random() < 0.05),
    )
    ticks, rest = play.ticks & 0xFFFF_FFFF, play.rest
    periods = [ticks, ticks, ticks + rest, ticks + rest, ticks + rest - 1, ticks + 1, random.getrandbits(32)]
    early = tick + ASK_TICKS + LEAD
    whens = [early, early - 1, free_from, free_from, max(free_from - 1, 0), free_from + random.randrange(9), random.getrandbits(50)]
    return replace(
        play,
        period=random.choice(periods) & 0xFFFF_FFFF,
        emission_ticks=random.choice([ticks, ticks, 0xFFFF_FFFF, max(ticks - 1, 0)]),
        when=random.choice(whens),
    )


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def random_plays_are_evaluated_as_the_reference_says(dut):
    bench = await Bench.ready(dut)
    seen = set()
    for _ in range(4_000):
        play = random_play(bench.tick, bench.reference.free_from)
        seen.add(await bench.ask(play, wait=random.choice([BEGIN_TO_ACCEPT, BEGIN_TO_ACCEPT, 40])))
        if bench.reference.free_from > 1 << 40 or random.random() < 0.02:
            await bench.forget()
    assert seen == {Result.OK, *(result for result, *_ in REASONS), Result.TOO_LATE, Result.OVERLAP}
