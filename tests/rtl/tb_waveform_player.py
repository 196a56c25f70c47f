"""waveform_player: what begins when, how long each word is held, and what stop, disarm and fault leave of it.

Everything that comes out is compared, tick for tick, with `Reference`, which keeps absolute times and no pipeline:
a decision in tick d has the first word on drive_o in tick d + 4 and on the pins in tick d + 5.
"""

import random
from dataclasses import dataclass, field

import cocotb
from clocked import after_reset, clocks, settled

from controller.device.fpga.registers import Start

IDLE = 0xAAAA5555
ALL = 0xFFFFFFFF
BIT_PERIOD = 4 << 16
BEGINS = {"triggered": Start.TRIGGER, "scheduled": Start.TIME, "immediate": Start.NOW}  # flags of the head
DRIVE, PINS = 4, 5  # ticks from the decision to the first word on drive_o, on the pins
REFILL = 9  # ticks from one head of the queue to the next, at least


@dataclass
class Play:
    buffer: int = 1
    first: int = 0
    length: int = 3
    count: int = 1
    start: Start = Start.TRIGGER
    polarity: int = 0
    period: int = 0
    mask: int = ALL
    when: int = 0
    live: int = 0


@dataclass
class Emission:
    play: Play
    decided: int
    period: int  # of a bit, in 65536ths of a tick
    whole: bool = True
    end: int = field(init=False)  # last tick of its last word, as a state; three later on drive_o

    def __post_init__(self):
        self.end = self.decided + (self.play.length * self.period >> 16)

    def word(self, tick):
        """Number of the word on the pins at a tick."""
        return (((tick - self.decided) << 16) - 1) // self.period


def memory(buffer, word):
    """What the buffers hold: any words that differ."""
    return (buffer + 1) * 0x9E3779B1 + word * 0x85EBCA77 & ALL


class Reference:
    """The same as the header of waveform_player.v and the protocol say, in absolute ticks."""

    def __init__(self):
        self.play = self.emission = self.delayed_until = None
        self.left = 0  # emissions still to come; None: without end
        self.next_start = None
        self.busy_until = None  # last tick that sounded or ramped
        self.past_words = [None] * 3  # (play, word), "ramp" or None, of the last three states
        self.ends = []  # last ticks of whole emissions on their way to the pins
        self.head_before = None
        self.triggers = self.ignored = self.missed = self.trigger_time = self.emission_time = 0
        self.ramp_bit = 0  # of the last tick
        self.overtaken = False
        self.first_tick = True

    def playing(self, tick):
        return self.emission is not None and tick <= self.emission.end

    def expected(self, tick, inputs):
        """Outputs of this tick, and what is decided in it."""
        head, trigger = inputs["head"], inputs["trigger"]
        ticks = inputs["bit_period"] >> 16
        playing = self.playing(tick)
        resting = not playing and self.busy_until is not None and tick < self.busy_until + ticks
        delayed = self.delayed_until is not None
        repeating = self.left != 0
        halted = inputs["stop"] or inputs["disarm"]  # what begins with a fault ends with it
        room = inputs["armed"] and not (playing or resting or delayed)
        free = room and not halted
        seen = head if self.head_before is head else None  # a time is compared one tick ahead
        begins = (
            free
            and head is not None
            and {
                Start.TRIGGER: bool(trigger),
                Start.NOW: self.left in (0, None),
                Start.TIME: seen is not None and head.when - PINS == tick,
            }[head.start]
        )
        missed = seen is not None and head.start == Start.TIME and head.when - PINS < tick
        waits = begins and head.start != Start.TIME and head.when & ALL != 0
        again = not begins and not halted and self.next_start is not None and repeating and tick == self.next_start
        released = not halted and delayed and tick == self.delayed_until
        start = (begins and not waits) or again or released
        used = playing or delayed or repeating
        self.decision = begins, waits, again, released, missed
        outputs = {
            "pop_o": begins or missed,
            "start_o": start,
            "playing_o": playing,
            "delayed_o": delayed,
            "repeating_o": repeating,
            "settled_o": not playing and not resting,
            "quiet_o": not used and not resting,
            "waiting_o": head is not None and head.start == Start.TRIGGER and room,
            "landing_used_o": used and self.play.buffer == inputs["landing"] and not self.play.live,
            "live_o": used and bool(self.play.live),
            "ended_o": tick - 4 in self.ends,
            "triggers_o": self.triggers,
            "ignored_o": self.ignored,
            "missed_o": self.missed,
            "trigger_time_o": self.trigger_time,
            "emission_time_o": self.emission_time,
        }
        if playing:
            word = self.emission.word(tick)
            outputs["read_buffer_o"], outputs["read_word_o"] = self.play.buffer, self.play.first + word
            if self.play.first == 0:
                outputs["read_chunk_o"], outputs["read_within_o"] = word // 125 % 8, word % 125
        outputs["underrun_o"] = self.overtaken  # in the tick before
        match self.past_words[0]:
            case _ if self.first_tick:
                outputs["drive_o"] = 0
            case None:
                outputs["drive_o"] = IDLE
            case "ramp":
                outputs["drive_o"] = IDLE * self.ramp_bit
            case (play, word):
                bits = memory(play.buffer, play.first + word) ^ (ALL if play.polarity else 0)
                outputs["drive_o"] = bits & play.mask | IDLE & ~play.mask & ALL
        return outputs

    def advance(self, tick, inputs):
        """What the decisions of this tick make of the next."""
        begins, waits, again, released, missed = self.decision
        head = inputs["head"]
        playing = self.playing(tick)
        state = "ramp" if inputs["ramping"] else (self.play, self.emission.word(tick)) if playing else None
        self.past_words = [*self.past_words[1:], state]
        self.overtaken = playing and bool(self.play.live) and self.emission.word(tick) >= inputs["arrived"]
        self.ramp_bit = inputs["ramp_bit"]
        self.first_tick = False
        if playing or inputs["ramping"]:
            self.busy_until = tick
        if inputs["trigger"]:
            self.triggers += 1
            self.trigger_time = tick
            self.ignored += not (begins and head.start == Start.TRIGGER)
        self.missed += missed
        if playing and tick == self.emission.end and self.emission.whole:
            self.ends = [*self.ends[-1:], tick]
        if begins:
            self.play = head
            self.left = None if head.count == 0 else head.count - 1
            self.delayed_until = tick + (head.when & ALL) if waits else None
            self.next_start = None
        if again and self.left is not None:
            self.left -= 1
        if released:
            self.delayed_until = None
        if (begins and not waits) or again or released:
            self.emission = Emission(self.play, tick, inputs["bit_period"])
            self.next_start = tick + self.play.period
            self.emission_time = tick + PINS
        if inputs["stop"] or inputs["disarm"]:
            self.left, self.delayed_until = 0, None
        if inputs["disarm"] and playing:
            emission = self.emission
            end = emission.decided + ((emission.word(tick) + 1) * emission.period >> 16)
            emission.whole, emission.end = emission.whole and end == emission.end, end
        if inputs["fault"]:
            self.emission, self.left, self.delayed_until, self.busy_until, self.ends = None, 0, None, None, []
        self.head_before = None if begins or missed else head


class Bench:
    """Drives every input, tick by tick, as the queue and the buffers would, and compares every output."""

    def __init__(self, dut):
        self.dut = dut

    @classmethod
    async def ready(cls, dut, bit_period=BIT_PERIOD):
        await after_reset(dut, idle_word_i=IDLE)
        bench = cls(dut)
        bench.settings = {"armed": 1, "landing": 2, "bit_period": bit_period, "arrived": 1000, "ramping": 0, "ramp_bit": 0}
        bench.begin()
        return bench

    def begin(self):
        self.tick, self.reference, self.queue, self.head_from = 0, Reference(), [], 0
        self.addresses = [(0, 0), (0, 0)]
        self.drive, self.pops, self.starts, self.ended = [], [], [], []

    async def step(self, count=1, **pulses):
        """`count` ticks; pulses (trigger, stop, disarm, fault) in the first of them."""
        dut, s = self.dut, self.settings
        for _ in range(count):
            head = self.queue[0] if self.queue and self.tick >= self.head_from else None
            inputs = s | {"head": head} | {name: pulses.get(name, 0) for name in ("trigger", "stop", "disarm", "fault")}
            pulses = {}
            for name in ("armed", "landing", "bit_period", "ramping", "ramp_bit", "trigger", "stop", "disarm", "fault"):
                getattr(dut, f"{name}_i").value = inputs[name]
            dut.now_i.value = self.tick
            dut.head_i.value = head is not None
            shown = head or Play(*(random.getrandbits(2) for _ in range(10)))  # not valid: of no account
            dut.head_buffer_i.value, dut.head_first_i.value, dut.head_length_i.value = shown.buffer, shown.first, shown.length
            dut.head_count_i.value = shown.count
            for name, start in BEGINS.items():
                getattr(dut, f"head_{name}_i").value = head is not None and head.start == start
            dut.head_polarity_i.value, dut.head_period_ticks_i.value = shown.polarity & 1, shown.period
            dut.head_mask_i.value, dut.head_when_i.value, dut.head_live_i.value = shown.mask, shown.when, shown.live & 1
            dut.head_delayed_i.value = shown.start != Start.TIME and shown.when & ALL != 0  # as play_queue finds out
            dut.head_delayed_one_i.value = shown.when & ALL == 1
            dut.read_data_i.value = memory(*self.addresses[0])
            address = int(dut.read_buffer_o.value), int(dut.read_word_o.value)
            self.addresses = [self.addresses[1], address]
            dut.missing_i.value = int(dut.read_chunk_o.value) * 125 + int(dut.read_within_o.value) >= s["arrived"]
            await settled()
            expected = self.reference.expected(self.tick, inputs)
            seen = {name: int(getattr(dut, name).value) for name in expected}
            wrong = {name: (seen[name], int(value)) for name, value in expected.items() if seen[name] != int(value)}
            assert not wrong, f"tick {self.tick}: seen and expected differ in {wrong} with {inputs}"
            self.drive.append(seen["drive_o"])
            for name, log in (("pop_o", self.pops), ("start_o", self.starts), ("ended_o", self.ended)):
                if seen[name]:
                    log.append(self.tick)
            self.reference.advance(self.tick, inputs)
            if seen["pop_o"]:
                self.queue.pop(0)
                self.head_from = self.tick + REFILL
            if inputs["stop"] or inputs["disarm"] or inputs["fault"]:
                self.queue.clear()
                self.head_from = self.tick + REFILL
            self.tick += 1
            await clocks(dut)

    async def put(self, **fields):
        """A play in the queue, at its head from this tick on if there is none."""
        if not self.queue:
            self.head_from = max(self.head_from, self.tick)
        self.queue.append(Play(**fields))

    async def until(self, tick, **pulses):
        await self.step(tick - self.tick, **pulses)

    async def reset(self):
        self.dut.rst_i.value = 1
        await clocks(self.dut)
        self.dut.rst_i.value = 0
        self.begin()

    def words(self, first, last):
        """Runs of equal words on drive_o from tick `first` to `last`, as [word, ticks]."""
        runs = []
        for word in self.drive[first : last + 1]:
            if runs and runs[-1][0] == word:
                runs[-1][1] += 1
            else:
                runs.append([word, 1])
        return runs


def emission(buffer=1, first=0, length=3, ticks=4):
    return [[memory(buffer, first + n), ticks] for n in range(length)]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def one_trigger_starts_one_play_whose_first_word_is_out_four_ticks_later(dut):
    bench = await Bench.ready(dut)
    await bench.step(5)
    await bench.put(length=5)
    await bench.step(3)
    decision = bench.tick
    await bench.step(trigger=1)
    await bench.step(40)
    assert bench.starts == bench.pops == [decision]
    assert bench.words(decision, decision + 40) == [[IDLE, DRIVE], *emission(length=5), [IDLE, 41 - DRIVE - 20]]
    assert bench.ended == [decision + 20 + DRIVE], "in the next tick the pins have ended it"
    assert int(dut.emission_time_o.value) == decision + PINS
    assert int(dut.trigger_time_o.value) == decision
    await bench.step(trigger=1)
    await bench.step(30)
    assert bench.starts == [decision], "nothing is left to start"
    assert (int(dut.triggers_o.value), int(dut.ignored_o.value)) == (2, 1)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_word_begins_at_the_whole_part_of_its_number_times_the_bit_period(dut):
    for bit_period, ticks in (
        (0x4_8000, [4, 5, 4, 5, 4, 5, 4, 5]),  # 4.5
        (0x4_0001, [4] * 8),
        (0x4_FFFF, [4, 5, 5, 5, 5, 5, 5, 5]),
        (0x5_5555, [5, 5, 5, 6, 5, 5, 6, 5]),  # 5 1/3, a little less: 15.9998 is 15
        (0xC8_0000, [200] * 8),
    ):
        bench = await Bench.ready(dut, bit_period)
        await bench.put(length=8)
        await bench.step(2)
        begin = bench.tick + DRIVE
        await bench.step(trigger=1)
        await bench.step(sum(ticks) + 20)
        runs = bench.words(begin, begin + sum(ticks) - 1)
        assert runs == [[memory(1, n), held] for n, held in enumerate(ticks)], hex(bit_period)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def repeats_exactly_a_period_apart_as_often_as_asked(dut):
    bench = await Bench.ready(dut)
    for count, period in ((3, 12), (2, 16), (4, 31), (1, 5)):  # 12: back to back; one alone has no period
        await bench.put(count=count, period=period)
        begin = bench.tick + DRIVE
        bench.starts.clear()
        await bench.step(trigger=1)
        await bench.step(count * period + 40)
        assert bench.starts == [begin - DRIVE + n * period for n in range(count)]
        pause = [[IDLE, period - 12]] if period > 12 else []
        wanted = [*emission(), *pause] * (count - 1) + emission()
        assert bench.words(begin, begin + (count - 1) * period + 11) == wanted
        assert set(bench.drive[begin + (count - 1) * period + 12 :]) == {IDLE}


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def goes_on_endlessly_until_stopped_and_ends_the_last_emission(dut):
    for phase in range(22):  # ticks from a start to the stop: within the emission, its pause, in the very tick of the next
        bench = await Bench.ready(dut)
        await bench.put(count=0, period=20)
        await bench.step(trigger=1)
        await bench.until(5 * 20 + phase)
        assert bench.starts == [20 * n for n in range(len(bench.starts))]
        assert dut.repeating_o.value == 1
        await bench.put(start=Start.NOW)
        await bench.step(stop=1)
        await bench.step(60)
        starts = [0, 20, 40, 60, 80, 100]
        if phase == 21:
            starts.append(120)
        if phase == 0:
            starts.remove(100)
        assert bench.starts == starts, phase
        assert bench.ended == [start + 12 + DRIVE for start in starts], "each of them ran to its end"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def begins_as_soon_as_the_idle_word_is_a_bit_period_old(dut):
    """The pulse in which the channels rest is never shorter than a word, and no longer than it must be."""
    for bit_period, length_ticks in ((4 << 16, 12), (0x5_8000, 16), (9 << 16, 27)):
        for start in (Start.NOW, Start.TRIGGER):
            bench = await Bench.ready(dut, bit_period)
            await bench.put(buffer=1)
            await bench.put(buffer=3, start=start)
            await bench.step(3)
            await bench.step(trigger=1)
            soonest = 3 + length_ticks + (bit_period >> 16)
            await bench.until(soonest - 1)
            await bench.step(trigger=1)  # too early by a tick
            await bench.step(trigger=1)
            await bench.step(60)
            assert bench.starts == [3, soonest]
            rest = bench.words(3 + DRIVE + length_ticks, soonest + DRIVE - 1)
            assert rest == [[IDLE, bit_period >> 16]]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_play_that_is_to_begin_now_lets_a_counted_repetition_end_and_replaces_an_endless_one(dut):
    bench = await Bench.ready(dut)
    await bench.put(count=3, period=40)
    await bench.put(buffer=3, start=Start.NOW, count=0, period=30)
    await bench.put(buffer=2, start=Start.NOW, length=2)
    await bench.step(trigger=1)
    await bench.step(200)
    endless = 80 + 12 + 4
    assert bench.starts == [0, 40, 80, endless, endless + 16]
    assert bench.pops == [0, endless, endless + 16]
    bench = await Bench.ready(dut)
    await bench.put(count=0, period=16)  # its pause is as short as it may be
    await bench.put(buffer=3, start=Start.NOW)
    await bench.step(trigger=1)
    await bench.step(100)
    assert bench.starts == [0, 16], "the new one begins instead of the repetition, in its tick"
    assert bench.words(DRIVE, DRIVE + 27) == [*emission(), [IDLE, 4], *emission(3)]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_trigger_starts_in_a_pause_but_never_cuts_an_emission(dut):
    for count in (0, 5):
        bench = await Bench.ready(dut)
        await bench.put(count=count, period=40)
        await bench.put(buffer=3, length=2)
        await bench.step(trigger=1)
        for phase in (12, 20, 30):
            await bench.until(phase)
            await bench.step(trigger=1)
        await bench.step(90)
        assert bench.starts == [0, 20]
        assert int(dut.ignored_o.value) == 2
        assert not dut.repeating_o.value


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_time_is_met_to_the_tick_or_missed(dut):
    for when in (15, 40, (1 << 32) + 3):  # the last is not near, though its low half is
        bench = await Bench.ready(dut)
        await bench.step(9)
        await bench.put(start=Start.TIME, when=when)
        await bench.step(60)
        if when < 1 << 32:
            assert bench.starts == [when - PINS]
            assert bench.drive[when - 2 : when] == [IDLE, memory(1, 0)], "drive_o is one tick before the pins"
        else:
            assert bench.starts == bench.pops == []
        assert int(dut.missed_o.value) == 0
    for late in (1, 2, 9, 10):  # the head is there from tick 10 on; 14 + 1 is the first time that can be met
        bench = await Bench.ready(dut)
        await bench.step(10)
        await bench.put(start=Start.TIME, when=16 - late)
        await bench.step(50)
        assert bench.starts == []
        assert bench.pops == [11]
        assert int(dut.missed_o.value) == 1
    bench = await Bench.ready(dut)
    bench.settings["armed"] = 0
    await bench.put(start=Start.TIME, when=30)
    await bench.step(50)
    assert (bench.starts, bench.pops) == ([], [26]), "one tick after it should have been decided on"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_time_is_missed_while_anything_sounds_and_met_as_soon_as_it_has_rested(dut):
    for late, starts in ((0, [10]), (1, [10, 26])):
        bench = await Bench.ready(dut)
        await bench.put(start=Start.TIME, when=10 + PINS)
        await bench.put(buffer=3, start=Start.TIME, when=10 + 12 + 3 + late + PINS)
        await bench.step(60)
        assert bench.starts == starts
        assert bench.pops == [10, 26]
        assert int(dut.missed_o.value) == 1 - late
    for count in (0, 9):  # a pause of a repetition is no sound: the time comes first
        bench = await Bench.ready(dut)
        await bench.put(start=Start.NOW, count=count, period=40)
        await bench.put(buffer=3, start=Start.TIME, when=100 + PINS)
        await bench.step(200)
        assert bench.starts == [0, 40, 80, 100]
    bench = await Bench.ready(dut)
    await bench.put(start=Start.NOW, when=50)
    await bench.put(buffer=3, start=Start.TIME, when=30)
    await bench.step(90)
    assert (bench.starts, int(dut.missed_o.value)) == ([50], 1), "nor does it cut a delay"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_delay_puts_the_first_word_off_by_as_many_ticks(dut):
    for delay in (1, 2, 50):
        for start in (Start.TRIGGER, Start.NOW):
            bench = await Bench.ready(dut)
            await bench.step(4)
            await bench.put(start=start, when=delay | 7 << 32, count=2, period=30)  # 32 bits of it count
            await bench.step(trigger=1)
            await bench.step(trigger=1)
            await bench.step(150)
            assert bench.starts == [4 + delay, 4 + delay + 30]
            assert int(dut.ignored_o.value) == (1 if start == Start.TRIGGER else 2)
            assert int(dut.emission_time_o.value) == bench.starts[-1] + PINS
    for moment in (5, 13, 14):  # stopped while it waits, in its very last tick, and a tick too late for that
        for command in ("stop", "disarm", "fault"):
            bench = await Bench.ready(dut)
            await bench.put(when=13)
            await bench.step(trigger=1)
            await bench.until(moment)
            await bench.step(**{command: 1})
            await bench.step(50)
            assert bench.starts == ([13] if moment == 14 or (moment, command) == (13, "fault") else [])
            if (moment, command) == (13, "fault"):
                assert set(bench.drive[1:]) == {IDLE}, "what begins with a fault ends with it"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_disarm_ends_the_emission_with_the_word_that_sounds(dut):
    for tick in range(1, 18):
        bench = await Bench.ready(dut)
        await bench.put(count=3, period=12)
        await bench.put(start=Start.NOW)
        await bench.step(trigger=1)
        await bench.until(tick)
        await bench.step(disarm=1)
        bench.settings["armed"] = 0
        await bench.step(60)
        words = -(-tick // 4)
        assert bench.words(DRIVE, DRIVE + 4 * words)[:-1] == (emission() * 2)[:words]
        assert set(bench.drive[DRIVE + 4 * words :]) == {IDLE}
        ends = [12 + DRIVE] if words >= 3 else []
        assert bench.ended == ends, "only what ran to its end has ended"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def nothing_begins_in_the_tick_of_a_command_nor_while_disarmed(dut):
    for command in ("stop", "disarm"):
        bench = await Bench.ready(dut)
        for fields in ({}, {"start": Start.NOW}, {"start": Start.TIME, "when": bench.tick + PINS}):
            await bench.step(3)
            await bench.put(**fields | ({"when": bench.tick + 3 + PINS} if "when" in fields else {}))
            if fields.get("start") != Start.NOW:
                await bench.step(3)
            await bench.step(trigger=1, **{command: 1})
            await bench.step(30)
        assert bench.starts == []
        assert int(dut.ignored_o.value) == 3
    for fields in ({}, {"start": Start.NOW}, {"start": Start.TIME, "when": 6 + PINS}):  # what begins with a fault ends with it
        bench = await Bench.ready(dut)
        bench.settings["armed"] = 0
        await bench.step(3)
        await bench.put(**fields)
        await bench.step(3)
        bench.settings["armed"] = 1
        await bench.step(trigger=1, fault=1)
        assert bench.pops == [6]
        await bench.step(40)
        assert (set(bench.drive[1:]), bench.ended) == ({IDLE}, [])
    bench = await Bench.ready(dut)
    bench.settings["armed"] = 0
    await bench.put(start=Start.NOW)
    await bench.step(20, trigger=1)
    bench.settings["armed"] = 1
    await bench.step(20)
    assert bench.starts == [20]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_fault_leaves_nothing_at_once(dut):
    for tick in range(1, 40):
        bench = await Bench.ready(dut)
        await bench.put(count=2, period=16)
        await bench.put(start=Start.NOW)
        await bench.step(trigger=1)
        await bench.until(tick)
        await bench.step(fault=1)
        assert [int(o.value) for o in (dut.playing_o, dut.repeating_o, dut.delayed_o)] == [0, 0, 0]
        assert [int(o.value) for o in (dut.settled_o, dut.quiet_o)] == [1, 1]
        await bench.step(50)
        assert set(bench.drive[tick + DRIVE :]) == {IDLE}
        assert bench.ended == [end + DRIVE for end in (12, 28) if end + DRIVE <= tick], "none that is still on its way"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_play_brings_its_own_part_of_the_channels_and_its_own_sign(dut):
    bench = await Bench.ready(dut)
    for mask, polarity in ((0, 0), (0, 1), (ALL, 1), (0x0F0F00FF, 0), (0x0F0F00FF, 1), (0x80000001, 1)):
        await bench.put(first=7, length=2, mask=mask, polarity=polarity, start=Start.NOW)
        start = bench.tick
        await bench.step(40)
        sign = ALL if polarity else 0
        expected = [((memory(1, 7 + n) ^ sign) & mask) | (IDLE & ~mask) for n in (0, 1)]
        assert [bench.drive[start + DRIVE + at] for at in (0, 3, 4, 7, 8)] == [*(2 * [expected[0]]), *(2 * [expected[1]]), IDLE]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def triggers_that_start_nothing_are_counted_as_ignored(dut):
    bench = await Bench.ready(dut)
    await bench.step(4)
    await bench.step(trigger=1)  # nothing waits
    await bench.put(start=Start.NOW)
    await bench.step(trigger=1)  # that began by itself
    await bench.put()
    await bench.step(30, trigger=1)  # something sounds
    await bench.step(trigger=1)
    await bench.put(start=Start.TIME, when=1000)
    await bench.step(30, trigger=1)
    bench.settings["armed"] = 0
    await bench.step(2, trigger=1)
    assert [int(o.value) for o in (dut.triggers_o, dut.ignored_o)] == [6, 5]
    assert int(dut.trigger_time_o.value) == bench.tick - 2


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def what_still_arrives_is_followed_word_by_word_and_overtaking_it_is_an_underrun(dut):
    for live, arrived in ((1, 1000), (1, 130), (0, 130)):
        bench = await Bench.ready(dut)
        await bench.put(buffer=2, length=260, live=live, start=Start.NOW)
        bench.settings["arrived"] = arrived
        underruns = 0
        for _ in range(700):
            await bench.step()
            underruns += int(dut.underrun_o.value)
            if dut.underrun_o.value:
                assert int(dut.read_word_o.value) >= 130
        assert (underruns > 0) is (live == 1 and arrived == 130)
        assert (int(dut.live_o.value), int(dut.landing_used_o.value)) == (live, 1 - live)
        bench.settings["arrived"] = 1000
        await bench.step(400)
        assert bench.ended == [4 * 260 + DRIVE]
        assert (int(dut.live_o.value), int(dut.landing_used_o.value)) == (0, 0)
    bench = await Bench.ready(dut)
    await bench.put(buffer=2, count=2, period=50, when=9)  # used as soon as it has begun to wait
    await bench.step(5)
    assert dut.landing_used_o.value == 0
    await bench.step(trigger=1)
    for _ in range(9 + 50 + 12):
        assert dut.landing_used_o.value == 1
        await bench.step()
    assert dut.landing_used_o.value == 0
    bench.settings["landing"] = 1
    await bench.put(buffer=2, start=Start.NOW)
    await bench.step(20)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def while_ramping_all_idle_channels_follow_the_bit_and_rest_behind_it(dut):
    bench = await Bench.ready(dut)
    bench.settings |= {"armed": 0, "ramping": 1}
    await bench.put(start=Start.NOW)
    for bit in (0, 0, 1, 1, 0, 1, 0, 0, 1):
        bench.settings["ramp_bit"] = bit
        await bench.step()
    bench.settings |= {"armed": 1, "ramping": 0, "ramp_bit": 1}
    await bench.step(40)
    assert bench.starts == [8 + 4], "a bit period behind the last tick of the ramp"
    assert bench.drive[3:12] == [IDLE * bit for bit in (1, 1, 0, 1, 0, 0, 1, 1, 1)]


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def a_reset_in_the_middle_forgets_everything(dut):
    for tick in (1, 3, 8, 13, 14, 17, 30):
        bench = await Bench.ready(dut)
        await bench.put(count=0, period=20, start=Start.NOW, when=2 if tick < 3 else 0)
        await bench.step(trigger=1)
        await bench.until(tick)
        await bench.reset()
        await bench.step(40)
        assert set(bench.drive[1:]) == {IDLE}
        await bench.put(start=Start.TIME, when=60)
        await bench.step(40)
        assert bench.starts == [60 - PINS], "time starts again"
    bench = await Bench.ready(dut)
    await bench.put(start=Start.NOW)
    await bench.step(2)
    await bench.step(disarm=1)  # which waits for the end of the word
    await bench.reset()
    await bench.put(start=Start.NOW)
    await bench.step(40)
    assert bench.ended == [12 + DRIVE], "and with the reset no more"


@cocotb.test(timeout_time=30, timeout_unit="ms")
async def random_sequences_go_as_the_reference_says(dut):
    seen = set()
    for _ in range(30):
        whole = random.choice([4, 4, 5, 7])
        bit_period = whole << 16 | random.choice([0, 0x8000, 0xFFFF, random.getrandbits(16)])
        bench = await Bench.ready(dut, bit_period)
        for _ in range(500):
            if len(bench.queue) < 3 and random.random() < 0.08:
                length = random.randrange(1, 6)
                ticks = length * bit_period >> 16
                start = random.choice(list(Start))
                when = bench.tick + random.randrange(60) if start == Start.TIME else random.choice([0, 0, 1, random.randrange(30)])
                await bench.put(
                    buffer=random.randrange(4),
                    first=random.choice([0, random.randrange(900)]),
                    length=length,
                    count=random.choice([0, 1, 1, 2, 3]),
                    start=start,
                    polarity=random.getrandbits(1),
                    period=ticks + random.choice([0, whole, whole + random.randrange(30)]),
                    mask=random.choice([ALL, random.getrandbits(32)]),
                    when=when,
                    live=int(random.random() < 0.2),
                )
            roll = random.random()
            pulses = {"trigger": 1} if random.random() < 0.1 else {}
            if roll < 0.015:
                pulses["stop"] = 1
            elif roll < 0.025:
                pulses["disarm"] = 1
            elif roll < 0.03:
                pulses["fault"] = 1
            elif roll < 0.032:
                await bench.reset()
            bench.settings["arrived"] = random.choice([0, 2, 1000])
            bench.settings["landing"] = random.randrange(4)
            if bench.settings["armed"]:
                if random.random() < 0.003:
                    bench.settings["armed"] = 0
            elif dut.settled_o.value and random.random() < 0.5:
                bench.settings["ramping"] = 1
            if bench.settings["ramping"]:
                bench.settings["ramp_bit"] = random.getrandbits(1)
                if random.random() < 0.1:
                    bench.settings |= {"ramping": 0, "armed": 1}
            await bench.step(**pulses)
            if pulses.get("disarm") or pulses.get("fault"):
                bench.settings |= {"armed": 0, "ramping": 0}
        seen |= {"start"} if bench.starts else set()
        seen |= {"missed"} if bench.reference.missed else set()
        seen |= {"ended"} if bench.ended else set()
    assert seen == {"start", "missed", "ended"}
