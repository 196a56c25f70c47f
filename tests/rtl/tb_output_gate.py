"""output_gate: what it lets through, and each way in which it shuts.

Every output is compared, tick for tick, with `Reference`, which keeps the ticks of what happened and no counters.
"""

import itertools
import random

import cocotb
from clocked import after_reset, clocks, settled

from controller.device.fpga.registers import Fault

HEARTBEAT_TICKS = 40
ALIVE_HALF_TICKS = 7  # as test_rtl.py sets it
SETTLE_TICKS, REST_TICKS = 9, 50  # as benches.py sets them
LIMITS = Fault(31 << 4)
EDGES = Fault.CHANNEL_EDGES | Fault.TOTAL_EDGES  # found out later, so that they count while off too
BIT_TICKS = 5
ALL = 0xFFFFFFFF
OFF, SETTLING, RAMP_UP, ON, STOPPING, RAMP_DOWN = "off", "settling", "ramp_up", "armed", "stopping", "ramp_down"
STATES = (OFF, SETTLING, RAMP_UP, ON, STOPPING, RAMP_DOWN)
PULSES = ("arm", "disarm", "clear", "heartbeat", "underrun", "ramp_done", "ended")
DRIVE_TICKS = 3  # drive_i is so much later than the state it belongs to


class Reference:
    def __init__(self):
        self.state, self.states = OFF, [OFF] * DRIVE_TICKS  # now, and in the ticks before
        self.heard = None  # tick and timeout of the last heartbeat
        self.fault, self.fault_count, self.fault_time, self.underruns, self.emissions = Fault(0), 0, 0, 0, 0
        self.channel = 0
        self.open_since = None  # tick in which the enable rose
        self.settled_tick = None  # the last of SETTLING
        self.rests_until = 0  # the tick from which on a fault by a limit can be cleared
        self.focus_until = 0

    def alive(self, tick):
        return self.heard is not None and tick <= self.heard[0] + self.heard[1]

    @property
    def live(self):
        """Something is on, or on its way to the pins."""
        return self.open_since is not None or any(state != OFF for state in (self.state, *self.states))

    def causes(self, tick, inputs):
        causes = Fault(inputs["limits"] << 4)
        if not self.live:
            return causes & EDGES
        for cause, holds in (
            (Fault.NO_PERMIT, not inputs["run_permit"]),
            (Fault.HOST_SILENT, not self.alive(tick)),
            (Fault.OVER_TEMPERATURE, not inputs["temperature_good"]),
            (Fault.UNDERRUN, inputs["underrun"]),
        ):
            if holds:
                causes |= cause
        return causes

    def expected(self, tick, inputs):
        return {f"{state}_o": self.state == state for state in STATES} | {
            "alive_o": self.alive(tick),
            "shut_o": bool(self.causes(tick, inputs)),
            "fault_o": self.fault,
            "faulted_o": self.fault != 0,
            "fault_count_o": self.fault_count,
            "fault_time_o": self.fault_time,
            "underruns_o": self.underruns,
            "emissions_o": self.emissions,
            "channel_o": self.channel,
            "hv_enable_o": self.open_since is not None,
            "hv_alive_o": self.open_since is not None and (tick - self.open_since) // ALIVE_HALF_TICKS % 2 == 0,
            "focus_o": tick < self.focus_until,
        }

    def advance(self, tick, inputs):
        causes, live, faulted = self.causes(tick, inputs), self.live, bool(self.fault)
        shut = bool(causes)
        opens = not shut and self.states[0] != OFF
        self.channel = inputs["drive"] & inputs["channel_mask"] if opens and self.states[0] != SETTLING else 0
        if not opens:
            self.open_since, self.focus_until = None, 0
        else:
            if self.open_since is None:
                self.open_since = tick + 1
            if inputs["ended"]:
                self.emissions += 1
                self.focus_until = tick + 1 + inputs["bit_ticks"]
        if inputs["clear"]:
            self.fault &= LIMITS if tick < self.rests_until else Fault(0)
        self.fault |= causes
        if causes & LIMITS:
            self.rests_until = tick + 1 + REST_TICKS
        if shut and not faulted:
            self.fault_count += 1
            self.fault_time = inputs["now"]
        self.underruns += bool(inputs["underrun"]) and live
        if inputs["heartbeat"]:
            self.heard = tick, inputs["heartbeat_ticks"]
        elif not self.alive(tick):
            self.heard = None
        self.states = [*self.states[1:], self.state]
        match self.state:
            case "off" if inputs["arm"]:
                self.state, self.settled_tick = SETTLING, tick + SETTLE_TICKS
            case "settling" if inputs["disarm"]:
                self.state = OFF
            case "settling" if tick == self.settled_tick:
                self.state = RAMP_UP
            case "ramp_up" if inputs["disarm"]:
                self.state = RAMP_DOWN
            case "ramp_up" if inputs["ramp_done"]:
                self.state = ON
            case "armed" if inputs["disarm"]:
                self.state = STOPPING
            case "stopping" if inputs["settled"]:
                self.state = RAMP_DOWN
            case "ramp_down" if inputs["ramp_done"]:
                self.state = OFF
        if shut:
            self.state, self.states = OFF, [OFF] * DRIVE_TICKS


class Bench:
    def __init__(self, dut):
        self.dut, self.tick, self.reference = dut, 0, Reference()
        self.now = random.getrandbits(40)
        self.settings = {
            "run_permit": 1,
            "temperature_good": 1,
            "heartbeat_ticks": HEARTBEAT_TICKS,
            "channel_mask": ALL,
            "drive": ALL,
            "bit_ticks": BIT_TICKS,
            "limits": 0,
            "settled": 0,
        }

    @classmethod
    async def ready(cls, dut):
        await after_reset(dut)
        return cls(dut)

    @classmethod
    async def armed(cls, dut, state=ON):
        """In the given state, with all channels asked high, and open."""
        bench = await cls.ready(dut)
        await bench.step(5)
        await bench.arm()
        if state != SETTLING:
            await bench.step(SETTLE_TICKS)
        if state not in (SETTLING, RAMP_UP):
            await bench.step(ramp_done=1)
        if state in (STOPPING, RAMP_DOWN):
            await bench.step(disarm=1)
        if state == RAMP_DOWN:
            bench.settings["settled"] = 1
            await bench.step()
        await bench.step(DRIVE_TICKS + 1, heartbeat=1)
        assert bench.is_open() or (state == SETTLING and dut.hv_enable_o.value == 1)
        assert bench.reference.state == state
        return bench

    async def arm(self):
        await self.step(heartbeat=1)
        await self.step(arm=1)

    async def step(self, count=1, **pulses):
        """`count` ticks, with pulses in the first; compares all outputs of each."""
        dut = self.dut
        for _ in range(count):
            inputs = self.settings | dict.fromkeys(PULSES, 0) | {"now": self.now + self.tick} | pulses
            pulses = {}
            for name, value in inputs.items():
                getattr(dut, f"{name}_i").value = value
            await settled()
            expected = self.reference.expected(self.tick, inputs)
            pairs = {name: (int(getattr(dut, name).value), int(value)) for name, value in expected.items()}
            wrong = {name: pair for name, pair in pairs.items() if pair[0] != pair[1]}
            assert not wrong, f"tick {self.tick}: seen and expected differ in {wrong} with {inputs}"
            self.reference.advance(self.tick, inputs)
            self.tick += 1
            await clocks(dut)

    async def reset(self):
        self.dut.rst_i.value = 1
        await clocks(self.dut)
        self.dut.rst_i.value = 0
        self.tick, self.reference = 0, Reference()

    def is_shut(self):
        dut = self.dut
        return not any(int(pin.value) for pin in (dut.channel_o, dut.hv_enable_o, dut.focus_o, dut.hv_alive_o))

    def is_open(self):
        return int(self.dut.channel_o.value) == ALL and bool(self.dut.hv_enable_o.value)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def opens_with_the_first_word_of_the_ramp_once_the_high_voltage_has_settled(dut):
    bench = await Bench.ready(dut)
    await bench.step(20)
    await bench.arm()
    assert dut.settling_o.value == 1
    for _ in range(DRIVE_TICKS + 1):
        assert bench.is_shut()
        await bench.step()
    for _ in range(SETTLE_TICKS):
        assert dut.hv_enable_o.value == 1
        assert dut.channel_o.value == 0
        await bench.step()
    assert bench.is_open(), "the first word of the ramp: what drive_i showed before is older than that state"
    assert dut.ramp_up_o.value == 1


@cocotb.test(timeout_time=100, timeout_unit="us")
async def disarming_while_the_high_voltage_settles_moves_no_channel(dut):
    for ticks in range(SETTLE_TICKS):
        bench = await Bench.ready(dut)
        await bench.arm()
        await bench.step(ticks)
        await bench.step(disarm=1)
        assert dut.off_o.value == 1
        for _ in range(SETTLE_TICKS + DRIVE_TICKS + 2):
            assert dut.channel_o.value == 0
            await bench.step(heartbeat=1)
        assert bench.is_shut()


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_permit_lost_while_words_are_on_their_way_behind_the_ramp_down_is_kept(dut):
    for name, cause in (("run_permit", Fault.NO_PERMIT), ("temperature_good", Fault.OVER_TEMPERATURE)):
        for ticks in range(DRIVE_TICKS + 3):
            bench = await Bench.armed(dut, RAMP_DOWN)
            await bench.step(ramp_done=1)
            await bench.step(ticks)
            on = bool(dut.hv_enable_o.value)
            assert on == (ticks <= DRIVE_TICKS)
            await bench.step(**{name: 0})
            assert bench.is_shut()
            assert Fault(int(dut.fault_o.value)) == (cause if on else Fault(0))


@cocotb.test(timeout_time=100, timeout_unit="us")
async def without_a_clock_everything_is_low_at_once_and_stays_so_until_it_is_armed_again(dut):
    for state in STATES[1:]:
        bench = await Bench.armed(dut, state)
        await bench.step(ended=1)
        assert dut.hv_enable_o.value == 1
        dut.clock_lost_i.value = 1
        await settled()  # no edge of the clock has come
        assert bench.is_shut()
        await clocks(dut, 3)
        assert bench.is_shut()
        dut.clock_lost_i.value = 0
        await bench.reset()  # as the board's top does
        await bench.step(20)
        assert bench.is_shut()


@cocotb.test(timeout_time=100, timeout_unit="us")
async def only_an_arm_that_is_asked_for_leads_out_of_off(dut):
    bench = await Bench.ready(dut)
    for pulse in (*PULSES[1:], "settled"):
        await bench.step(3, **{pulse: 1})
        assert dut.off_o.value == 1
    await bench.step(heartbeat=1)
    bench.settings |= {"run_permit": 0, "temperature_good": 0, "limits": 31 & ~(EDGES.value >> 4)}
    await bench.step(5, underrun=1)
    assert (int(dut.fault_o.value), int(dut.underruns_o.value)) == (0, 0), "off: no outputs to shut, no fault"


@cocotb.test(timeout_time=100, timeout_unit="us")
async def edges_too_many_that_are_found_out_while_off_are_kept_like_any_fault_and_counted_if_there_is_none(dut):
    for limits in (2, 4, 6):
        bench = await Bench.ready(dut)
        at = bench.now + bench.tick
        await bench.step(limits=limits)
        await bench.step(3)
        await bench.step(limits=limits)
        assert Fault(int(dut.fault_o.value)) == Fault(limits << 4)
        assert (int(dut.fault_count_o.value), int(dut.fault_time_o.value)) == (1, at)
        await bench.step(REST_TICKS - 1)
        await bench.step(clear=1)
        assert Fault(int(dut.fault_o.value)) == Fault(limits << 4), "the last tick of a rest since the last of them"
        await bench.step(clear=1)
        assert int(dut.fault_o.value) == 0
        await bench.arm()
        await bench.step(SETTLE_TICKS + 10)
        assert bench.is_open()


@cocotb.test(timeout_time=100, timeout_unit="us")
async def shuts_when_the_host_falls_silent_and_keeps_the_cause(dut):
    bench = await Bench.armed(dut)
    await bench.step(heartbeat=1)
    for _ in range(HEARTBEAT_TICKS):
        assert dut.alive_o.value == 1
        assert bench.is_open()
        await bench.step()
    assert dut.alive_o.value == 0
    await bench.step(heartbeat=1)  # a tick too late
    assert bench.is_shut()
    await bench.step(5)
    assert Fault(int(dut.fault_o.value)) == Fault.HOST_SILENT
    assert bench.is_shut()
    bench = await Bench.armed(dut)
    for _ in range(5):  # the last tick in which it may come
        await bench.step(heartbeat=1)
        await bench.step(HEARTBEAT_TICKS - 1)
    await bench.step(heartbeat=1)
    assert bench.is_open()
    bench = await Bench.ready(dut)
    await bench.step(arm=1)  # never heard of it
    await bench.step()
    assert Fault(int(dut.fault_o.value)) == Fault.HOST_SILENT


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def shuts_with_the_next_clock_for_each_cause_in_each_state_and_counts_it_once(dut):
    causes = {
        Fault.NO_PERMIT: {"run_permit": 0},
        Fault.OVER_TEMPERATURE: {"temperature_good": 0},
        Fault.UNDERRUN: {"underrun": 1},
        Fault.SHORT_PULSE: {"limits": 1},
        Fault.CHANNEL_EDGES: {"limits": 2},
        Fault.TOTAL_EDGES: {"limits": 4},
        Fault.LONG_EMISSION: {"limits": 8},
        Fault.DUTY: {"limits": 16},
        Fault.NO_PERMIT | Fault.DUTY | Fault.SHORT_PULSE: {"run_permit": 0, "limits": 17},
    }
    for state in STATES[1:]:
        for cause, change in causes.items():
            bench = await Bench.armed(dut, state)
            at = bench.now + bench.tick
            await bench.step(ended=1, arm=1, ramp_done=1, **change)
            for _ in range(6):
                assert bench.is_shut()
                assert dut.off_o.value == 1
                await bench.step()
            assert Fault(int(dut.fault_o.value)) == cause
            assert (int(dut.fault_count_o.value), int(dut.fault_time_o.value)) == (1, at)
            assert int(dut.emissions_o.value) == 0
            assert int(dut.underruns_o.value) == ("underrun" in change)
            if cause & LIMITS:
                await bench.step(clear=1)
                assert Fault(int(dut.fault_o.value)) == cause & LIMITS, "the stages rest"
                await bench.step(REST_TICKS - 8)
                assert bench.is_shut()
                await bench.step(clear=1)
                assert Fault(int(dut.fault_o.value)) == cause & LIMITS, "the last tick"
            await bench.step(clear=1)
            assert int(dut.fault_o.value) == 0
            assert int(dut.fault_count_o.value) == 1, "counted for good"
            await bench.arm()
            await bench.step(SETTLE_TICKS + 10)
            assert bench.is_open()


@cocotb.test(timeout_time=100, timeout_unit="us")
async def causes_add_up_until_they_are_cleared(dut):
    bench = await Bench.armed(dut)
    await bench.step(run_permit=0)
    await bench.arm()
    await bench.step(2)
    await bench.step(limits=8)
    assert Fault(int(dut.fault_o.value)) == Fault.NO_PERMIT | Fault.LONG_EMISSION
    assert int(dut.fault_count_o.value) == 1, "added to what is there"
    await bench.arm()
    await bench.step(2)
    await bench.step(temperature_good=0, clear=1)
    assert Fault(int(dut.fault_o.value)) == Fault.OVER_TEMPERATURE | Fault.LONG_EMISSION, "one in the very clock of a clear is kept"


@cocotb.test(timeout_time=100, timeout_unit="us")
async def does_not_reopen_for_a_moment_when_a_fault_is_cleared_and_armed_at_once(dut):
    for gap in range(5):
        bench = await Bench.armed(dut)
        await bench.step(run_permit=0)
        await bench.step(clear=1)
        await bench.step(gap)
        bench.settings["drive"] = 0x12345678
        await bench.step(arm=1)
        for _ in range(DRIVE_TICKS):
            assert bench.is_shut()
            await bench.step()
        for _ in range(SETTLE_TICKS + 1):
            assert dut.channel_o.value == 0
            await bench.step(heartbeat=1)
        assert int(dut.channel_o.value) == 0x12345678


@cocotb.test(timeout_time=100, timeout_unit="us")
async def disarming_waits_until_all_is_settled_and_stays_open_through_the_ramp(dut):
    bench = await Bench.armed(dut)
    await bench.step(disarm=1)
    assert dut.stopping_o.value == 1
    await bench.step(10, disarm=1)
    await bench.step(ramp_done=1)
    assert dut.stopping_o.value == 1
    await bench.step(settled=1)
    assert dut.ramp_down_o.value == 1
    await bench.step(5, disarm=1)
    assert bench.is_open()
    await bench.step(ramp_done=1)
    assert dut.off_o.value == 1
    for _ in range(DRIVE_TICKS):
        assert bench.is_open(), "what the ramp sent last is still on its way"
        await bench.step()
    await bench.step()
    assert bench.is_shut()
    assert int(dut.fault_o.value) == 0


@cocotb.test(timeout_time=100, timeout_unit="us")
async def turns_back_even_in_the_clock_in_which_the_ramp_up_ends(dut):
    bench = await Bench.armed(dut, RAMP_UP)
    await bench.step(ramp_done=1, disarm=1)
    assert dut.ramp_down_o.value == 1


@cocotb.test(timeout_time=100, timeout_unit="us")
async def lets_only_masked_in_channels_through(dut):
    bench = await Bench.armed(dut)
    for mask in (0x0F0F00FF, 0, 1, 0x80000000):
        for drive in (ALL, 0x12345678, 0):
            bench.settings |= {"channel_mask": mask, "drive": drive}
            await bench.step()
            assert int(dut.channel_o.value) == drive & mask


@cocotb.test(timeout_time=100, timeout_unit="us")
async def the_focus_pin_is_high_for_one_drive_word_and_each_end_is_counted(dut):
    for bit_ticks in (4, BIT_TICKS, 30):
        bench = await Bench.armed(dut)
        bench.settings["bit_ticks"] = bit_ticks
        await bench.step(ended=1, heartbeat=1)
        for _ in range(bit_ticks):
            assert dut.focus_o.value == 1
            await bench.step()
        assert dut.focus_o.value == 0
        await bench.step(heartbeat=1)
        await bench.step(ended=1)
        await bench.step(bit_ticks - 1)
        await bench.step(bit_ticks + 2, ended=1, heartbeat=1)  # ends one drive word apart: high all the while
        assert int(dut.emissions_o.value) == 3


@cocotb.test(timeout_time=100, timeout_unit="us")
async def counters_carry_through_all_their_bits(dut):
    """A month of emissions in a few clocks: each register is set to what it would be then."""
    for bit in range(1, 32):
        bench = await Bench.armed(dut)
        dut.emissions_q.value = dut.underruns_q.value = dut.fault_count_q.value = (1 << bit) - 1
        bench.reference.emissions = bench.reference.underruns = bench.reference.fault_count = (1 << bit) - 1
        await bench.step(ended=1, heartbeat=1)
        await bench.step(underrun=1)
        await bench.step(2)
        for counter in (dut.emissions_o, dut.underruns_o, dut.fault_count_o):
            assert int(counter.value) == 1 << bit


@cocotb.test(timeout_time=100, timeout_unit="us")
async def gives_signs_of_life_only_while_open(dut):
    bench = await Bench.armed(dut)
    levels = []
    for _ in range(60):
        await bench.step(heartbeat=1)
        levels.append(int(dut.hv_alive_o.value))
    changes = [n for n in range(1, 60) if levels[n] != levels[n - 1]]
    assert {later - earlier for earlier, later in itertools.pairwise(changes)} == {ALIVE_HALF_TICKS}


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_reset_in_any_state_has_all_low_with_the_next_clock(dut):
    for state in STATES[1:]:
        bench = await Bench.armed(dut, state)
        await bench.step(ended=1)
        await bench.reset()
        assert bench.is_shut()
        assert dut.off_o.value == 1
        assert dut.alive_o.value == 0
        await bench.step(10)
    bench = await Bench.armed(dut)
    await bench.step(ended=1)
    await bench.step(limits=3, underrun=1)
    await bench.reset()
    counters = (dut.fault_o, dut.fault_count_o, dut.fault_time_o, dut.underruns_o, dut.emissions_o)
    assert not any(int(counter.value) for counter in counters)


@cocotb.test(timeout_time=100, timeout_unit="us")
async def a_state_that_does_not_exist_is_off(dut):
    for state in (6, 7):
        bench = await Bench.armed(dut)
        dut.state_q.value = state  # as a disturbed flip-flop would
        await settled()
        assert not any(int(getattr(dut, f"{name}_o").value) for name in STATES)
        await clocks(dut)
        assert dut.off_o.value == 1
        for _ in range(10):
            assert bench.is_shut(), "nothing that was on its way comes"
            await clocks(dut)


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def random_events_go_as_the_reference_says(dut):
    states = set()
    for _ in range(25):
        bench = await Bench.ready(dut)
        often = random.choice([0.05, 0.3])
        heard = random.choice([0.01, 0.1, 0.4])
        bench.settings["heartbeat_ticks"] = random.choice([1, 7, HEARTBEAT_TICKS])
        for _ in range(400):
            pulses = {name: 1 for name in ("arm", "disarm", "clear", "ramp_done", "ended", "settled") if random.random() < often}
            pulses |= {"heartbeat": 1} if random.random() < heard else {}
            pulses |= {"drive": random.getrandbits(32)}
            if random.random() < 0.03:
                pulses |= random.choice(
                    [{"run_permit": 0}, {"temperature_good": 0}, {"underrun": 1}, {"limits": random.getrandbits(5)}]
                )
            if random.random() < 0.05:
                pulses["bit_ticks"] = random.randrange(4, 12)
                pulses["channel_mask"] = random.getrandbits(32)
            await bench.step(**pulses)
            states.add(bench.reference.state)
            if random.random() < 0.003:
                await bench.reset()
    assert states == set(STATES)
