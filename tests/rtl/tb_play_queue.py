"""play_queue: first come, first played; what the head is, when, and what can be read back."""

import random
from dataclasses import dataclass

import cocotb
from clocked import after_reset, clocks, settled

from controller.device.fpga.registers import QUEUE_PLAYS, Result, Start

BEGINS = {"triggered": Start.TRIGGER, "scheduled": Start.TIME, "immediate": Start.NOW}  # flags of the head
FETCH = 9  # ticks until the head is valid, after the push or the pop that made it the head


@dataclass
class Play:
    words: list
    buffer: int
    length: int
    live: int = 0

    def fields(self):
        """What the six words of a PLAY say, by the protocol."""
        w = self.words
        return {
            "buffer_o": self.buffer,
            "length_o": self.length,
            "first_o": w[0] & 0x3FF,
            "count_o": w[1] & 0xFFFF,
            **{f"{name}_o": w[1] >> 16 & 3 == start for name, start in BEGINS.items()},
            "polarity_o": w[1] >> 24 & 1,
            "period_ticks_o": w[2],
            "mask_o": w[3],
            "when_o": w[4] | w[5] << 32,
            "delayed_o": w[1] >> 16 & 3 != Start.TIME and w[4] != 0,
            "delayed_one_o": w[4] == 1,
        }


def random_play(**fields):
    words = [random.choice([0, 1, 0xFFFFFFFF, random.getrandbits(32)]) for _ in range(6)]
    return Play(words, random.randrange(8), random.randrange(1, 1001), **fields)


class Reference:
    """Plays in their order, and the tick from which the head is valid."""

    def __init__(self):
        self.plays, self.valid_from, self.full = [], None, False
        self.busy = range(0)  # ticks in which the head is fetched: its words cannot be read

    def valid(self, tick):
        return self.valid_from is not None and tick >= self.valid_from

    def advance(self, tick, *, push=None, pop=False, drop=False, select=False):
        if select:
            self.full = len(self.plays) == QUEUE_PLAYS
        new_head = pop or (push is not None and not self.plays)
        if pop:
            self.plays.pop(0)
        if push is not None:
            self.plays.append(push)
        if drop:
            self.plays.clear()
            self.valid_from = None
        elif new_head:
            self.valid_from = tick + FETCH if self.plays else None
        if drop or new_head:
            self.busy = range(tick + (1 if pop else 2), tick + FETCH) if self.plays else range(0)


class Bench:
    def __init__(self, dut):
        self.dut, self.tick, self.reference = dut, 0, Reference()
        self.address_held = 0

    @classmethod
    async def ready(cls, dut):
        await after_reset(dut)
        return cls(dut)

    async def step(self, count=1, **pulses):
        for _ in range(count):
            await self._step(**pulses)
            pulses = {}

    async def _step(self, *, push=None, pop=False, drop=False, select=False, write=None):
        """One tick; compares all outputs of it."""
        dut, reference = self.dut, self.reference
        dut.push_i.value, dut.pop_i.value, dut.drop_i.value, dut.select_i.value = push is not None, pop, drop, select
        shown = push or random_play()
        dut.buffer_i.value, dut.length_i.value = shown.buffer, shown.length
        dut.live_i.value = shown.live if push else random.getrandbits(1)
        dut.write_i.value = write is not None
        dut.write_word_i.value, dut.write_data_i.value = write or (random.randrange(6), random.getrandbits(32))
        landing = random.randrange(8)
        dut.landing_i.value = landing
        await settled()
        expected = {
            "valid_o": reference.valid(self.tick),
            "queued_o": len(reference.plays),
            "full_o": reference.full,
            "landing_used_o": any(play.buffer == landing for play in reference.plays),
            "live_o": bool(reference.plays) and reference.plays[0].live,
        }
        valid = reference.valid(self.tick)
        expected |= reference.plays[0].fields() if valid else {f"{name}_o": 0 for name in BEGINS}
        wrong = {name: (int(getattr(dut, name).value), int(value)) for name, value in expected.items()}
        wrong = {name: pair for name, pair in wrong.items() if pair[0] != pair[1]}
        assert not wrong, f"tick {self.tick}: seen and expected differ in {wrong}"
        self.check_read()
        reference.advance(self.tick, push=push, pop=pop, drop=drop, select=select)
        self.tick += 1
        self.address_held += 1
        await clocks(dut)
        for signal in (dut.push_i, dut.pop_i, dut.drop_i, dut.select_i, dut.write_i):
            signal.value = 0

    def check_read(self):
        address = int(self.dut.address_i.value)
        index, word = address >> 3, address & 7
        plays = self.reference.plays
        result = Result(int(self.dut.read_result_o.value))
        if index >= len(plays) or word > 5:
            assert result is Result.BAD_RANGE
        elif self.tick in self.reference.busy:
            assert result is Result.BUSY, self.tick
        else:
            assert result is Result.OK, self.tick
            if self.address_held >= 1:
                assert int(self.dut.read_data_o.value) == plays[index].words[word], (self.tick, index, word)
        return result

    def address(self, index, word):
        self.dut.address_i.value = index << 3 | word
        self.address_held = 0

    async def frame(self, play, words=6, push=True, gap=0, **pulses):
        """A PLAY frame as it arrives; accepted and good if `push`."""
        await self.step(select=True)
        await self.step(gap)
        for number, word in enumerate(play.words[:words]):
            await self.step(write=(number, word))
            await self.step(gap)
        if push:
            await self.step(push=play, **pulses)

    async def reset(self):
        self.dut.rst_i.value = 1
        await clocks(self.dut)
        self.dut.rst_i.value = 0
        self.tick, self.reference, self.address_held = 0, Reference(), 0


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def the_head_is_valid_nine_ticks_after_the_push_or_the_pop_that_made_it_the_head(dut):
    bench = await Bench.ready(dut)
    for _ in range(10):
        first, second = random_play(), random_play()
        await bench.frame(first)
        pushed = bench.tick - 1
        while not dut.valid_o.value:
            await bench.step()
        assert bench.tick == pushed + FETCH
        await bench.frame(second)
        await bench.step(20)
        assert dut.valid_o.value == 1
        await bench.step(pop=True)
        popped = bench.tick - 1
        while not dut.valid_o.value:
            await bench.step()
        assert bench.tick == popped + FETCH
        assert int(dut.when_o.value) == second.words[4] | second.words[5] << 32
        await bench.step(pop=True)
        await bench.step(20)
        assert dut.valid_o.value == 0, "nothing follows"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def holds_eight_plays_in_their_order_and_is_full_as_of_the_frame(dut):
    bench = await Bench.ready(dut)
    plays = [random_play() for _ in range(QUEUE_PLAYS)]
    for number, play in enumerate(plays):
        await bench.frame(play)
        assert int(dut.queued_o.value) == number + 1
        assert dut.full_o.value == 0
    await bench.frame(random_play(), push=False)
    assert dut.full_o.value == 1
    await bench.step(20)  # and its words have damaged none: each step compares the head
    await bench.step(pop=True)
    await bench.step(12)
    assert dut.full_o.value == 1, "though there is room by now: the words of the frame were not kept"
    for place, play in enumerate(plays[1:]):
        for word in range(6):
            bench.address(place, word)
            await bench.step()
            assert int(dut.read_data_o.value) == play.words[word]
    ninth = random_play()
    await bench.frame(ninth)
    assert int(dut.queued_o.value) == QUEUE_PLAYS
    for play in (*plays[1:], ninth):
        await bench.step(15)
        assert int(dut.mask_o.value) == play.words[3]
        await bench.step(pop=True)
    assert int(dut.queued_o.value) == 0


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_frame_that_was_refused_or_cut_off_leaves_nothing(dut):
    bench = await Bench.ready(dut)
    for words in range(7):
        await bench.frame(random_play(), words=words, push=False)
        await bench.step(12)
        assert (int(dut.valid_o.value), int(dut.queued_o.value)) == (0, 0)
        await bench.frame(random_play())
        await bench.step(12)
        await bench.frame(random_play(), words=words, push=False)  # nor does it disturb the head
        await bench.step(3)
        await bench.step(pop=True)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def reading_back_is_refused_while_the_head_is_fetched_and_beyond_what_there_is(dut):
    bench = await Bench.ready(dut)
    bench.address(0, 0)
    await bench.step(3)
    assert bench.check_read() is Result.BAD_RANGE, "nothing is there"
    await bench.frame(random_play())
    results = []
    for _ in range(12):
        results.append(Result(int(dut.read_result_o.value)))
        await bench.step()
    assert results == [Result.OK] + [Result.BUSY] * 7 + [Result.OK] * 4, "fetched from the second tick after the push on"
    await bench.frame(random_play())
    await bench.step(pop=True)
    results = []
    for _ in range(12):
        results.append(Result(int(dut.read_result_o.value)))
        await bench.step()
    assert results == [Result.BUSY] * 8 + [Result.OK] * 4
    for address, expected in (
        (5, Result.OK),
        (6, Result.BAD_RANGE),
        (7, Result.BAD_RANGE),
        (8, Result.BAD_RANGE),
        (56, Result.BAD_RANGE),
    ):
        bench.address(address >> 3, address & 7)
        await bench.step()
        assert bench.check_read() is expected
    for _ in range(7):
        await bench.frame(random_play())
    bench.address(7, 5)
    await bench.step()
    assert bench.check_read() is Result.OK


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_drop_at_any_moment_empties_it(dut):
    bench = await Bench.ready(dut)
    for moment in range(14):
        for live in (0, 1):
            await bench.frame(random_play(live=live))
            if moment > 11:
                await bench.frame(random_play())
            await bench.step(moment)
            await bench.step(drop=True)
            assert [int(o.value) for o in (dut.valid_o, dut.queued_o, dut.live_o)] == [0, 0, 0]
            await bench.step(random.randrange(12))
            await bench.frame(random_play())  # the next is fetched as if it were the first
            await bench.step(15)
            await bench.step(pop=True)
    for together in ({"pop": True}, {"push": random_play(live=1)}, {"select": True}):
        await bench.frame(random_play())
        await bench.step(12)
        await bench.step(drop=True, **together)
        assert int(dut.queued_o.value) == 0
        await bench.step(15)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_push_in_the_tick_of_a_pop_counts_for_both(dut):
    bench = await Bench.ready(dut)
    await bench.frame(random_play(live=1))
    for live in (0, 1, 0):
        await bench.step(15)
        await bench.frame(random_play(live=live), pop=True)
        assert int(dut.queued_o.value) == 1
        assert int(dut.live_o.value) == live
        await bench.step(8)
    for _ in range(QUEUE_PLAYS - 1):
        await bench.frame(random_play())
    await bench.step(15)
    await bench.step(pop=True)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def the_landing_buffer_is_used_while_any_play_names_it(dut):
    bench = await Bench.ready(dut)
    for place in range(QUEUE_PLAYS):
        play = random_play()
        play.buffer = place
        await bench.frame(play)
        await bench.step(10)
    for place in range(QUEUE_PLAYS):
        for buffer in range(QUEUE_PLAYS):
            dut.landing_i.value = buffer
            await settled()
            assert dut.landing_used_o.value == (buffer >= place)
            await clocks(dut)
            bench.tick += 1
            bench.address_held += 1
        await bench.step(pop=True)
        await bench.step(10)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_reset_in_the_middle_empties_it(dut):
    bench = await Bench.ready(dut)
    for moment in range(12):
        for place in range(QUEUE_PLAYS):
            await bench.frame(random_play(live=int(place == 0)))
        await bench.step(select=True)
        await bench.step(15)
        if moment > 1:
            await bench.step(pop=True)
        await bench.step(moment)
        await bench.reset()
        fields = (dut.valid_o, dut.queued_o, dut.live_o, dut.full_o, dut.length_o, dut.mask_o, dut.when_o, dut.count_o)
        assert not any(int(field.value) for field in fields)
        await bench.step(15)
        await bench.frame(random_play())
        await bench.step(15)
        await bench.step(pop=True)


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def random_pushes_pops_and_drops_go_as_the_reference_says(dut):
    bench = await Bench.ready(dut)
    fullest = 0
    play, arriving = None, []
    for turn in range(12_000):
        patience = 0.004 if turn // 1500 % 2 else 0.08
        pulses = {"pop": bench.reference.valid(bench.tick) and random.random() < patience, "drop": random.random() < 0.002}
        if play is None and random.random() < 0.2:
            play = random_play(live=int(random.random() < 0.5 and not bench.reference.plays))
            arriving = [(number, word) for number, word in enumerate(play.words)]
            pulses["select"] = True
        elif arriving and random.random() < 0.5:
            pulses["write"] = arriving.pop(0)
        elif play and not arriving and random.random() < 0.3:
            if not bench.reference.full and not (play.live and bench.reference.plays) and random.random() < 0.9:
                pulses["push"] = play
            play = None
        if pulses["drop"] and play:
            play, arriving = None, []  # what drops comes by a frame, or has faulted: the rest of this one is refused
            pulses.pop("write", None)
        if random.random() < 0.3:
            bench.address(random.choice([0, 0, 1, random.randrange(8)]), random.randrange(8 if random.random() < 0.2 else 6))
        await bench.step(**pulses)
        fullest = max(fullest, len(bench.reference.plays))
        if random.random() < 0.0005:
            await bench.reset()
            play, arriving = None, []
    assert fullest == QUEUE_PLAYS
