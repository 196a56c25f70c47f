"""register_file: which registers take which values when, what is read, and what CONTROL turns into."""

import random

import cocotb
from clocked import after_reset, clocks, settled

from controller.device.fpga.registers import (
    BIT_CLOCK_HZ_MAX,
    BIT_CLOCK_HZ_MIN,
    BIT_TICKS_MIN,
    CHANNELS,
    FILTER_TICKS,
    IDENTITY_MAGIC,
    PROTOCOL_VERSION,
    QUEUE_PLAYS,
    RAMP_SAMPLES_MAX,
    TRIGGER_LATENCY_TICKS,
    WAVEFORM_WORDS,
    Control,
    Kind,
    Register,
    Result,
)
from controller.workshop.gateware.register_lines import signal

ALL = 0xFFFFFFFF
PULSES = {Control.ARM: "arm_o", Control.DISARM: "disarm_o", Control.CLEAR: "clear_o", Control.STOP: "stop_o"}
PULSES |= {Control.TRIGGER: "trigger_o"}
TIMES = {register: f"{signal(register)}_i" for register in Register if register.kind is Kind.TIME_LOW}
INPUTS = {register: (f"{signal(register)}_i", register.bits) for register in Register if register.kind in (Kind.LIVE, Kind.COUNTER)}
FIRST_UNKNOWN = max(Register) + 1


class Reference:
    """Settings with their ranges, from what the gateware is built with; results in the order of the contract."""

    def __init__(self, dut):
        built = {name: int(getattr(dut, name).value) for name in ("CLOCK_HZ", "SLOTS", "BUILD_HASH", "BOARD", "EDGE_WINDOW_TICKS")}
        most = {name: int(getattr(dut, f"{name}_MAX").value) for name in LIMITED}
        self.pulse_min = int(dut.PULSE_TICKS_MIN.value)
        self.most = {Register[name]: value for name, value in most.items()}
        clock_hz = built["CLOCK_HZ"]
        self.bit_ticks_min = max(clock_hz // BIT_CLOCK_HZ_MAX, BIT_TICKS_MIN)
        self.bit_ticks_max = max(clock_hz // BIT_CLOCK_HZ_MIN, self.bit_ticks_min)
        self.constants = {
            Register.IDENTITY: IDENTITY_MAGIC,
            Register.PROTOCOL: PROTOCOL_VERSION,
            Register.BUILD_HASH: built["BUILD_HASH"],
            Register.BOARD: built["BOARD"],
            Register.CLOCK_HZ: clock_hz,
            Register.GEOMETRY: built["SLOTS"] | WAVEFORM_WORDS << 8 | CHANNELS << 24,
            Register.PARAMETERS: QUEUE_PLAYS | TRIGGER_LATENCY_TICKS << 8 | FILTER_TICKS << 16,
            Register.EDGE_WINDOW_TICKS: built["EDGE_WINDOW_TICKS"],
            Register.CONTROL: 0,
        } | {Register[name]: int(getattr(dut, name).value) for name in BUILT_IN_LIMITS}
        self.settings = {
            Register.IDLE_WORD: 0,
            Register.CHANNEL_MASK: self.constants[Register.CHANNEL_MASK_MAX],
            Register.BIT_PERIOD: int(dut.BIT_PERIOD_RESET.value),
            Register.RAMP_SAMPLES: int(dut.RAMP_SAMPLES_RESET.value),
            Register.PULSE_TICKS: self.pulse_min,
        } | self.most
        self.settings |= {r: r.reset for r in Register if r.access == "RW" and r not in self.settings}
        self.unlocked, self.high, self.frame_errors, self.gaps = False, 0, 0, 0

    def range_of(self, register):
        """Smallest and largest value allowed now."""
        match register:
            case Register.IDLE_WORD:
                return 0, ALL
            case Register.CHANNEL_MASK:
                return 0, self.constants[Register.CHANNEL_MASK_MAX]
            case Register.BIT_PERIOD:
                return max(self.bit_ticks_min, self.settings[Register.PULSE_TICKS]) << 16, self.bit_ticks_max << 16
            case Register.RAMP_SAMPLES:
                return 1, RAMP_SAMPLES_MAX
            case Register.PULSE_TICKS:
                return self.pulse_min, self.settings[Register.BIT_PERIOD] >> 16
            case Register.HEARTBEAT_TICKS:
                return 1, self.most[register]
            case _ if register in self.most:
                return 0, self.most[register]
        return register.low, register.used_bits if register.high is None else register.high

    def takes(self, register, value):
        """A value is within its range now, and a mask within that of the channels there are."""
        low, high = self.range_of(register)
        return low <= value <= high and (register != Register.CHANNEL_MASK or value & ~high == 0)

    def control(self, words, off, fault, permitted):
        match words[0]:
            case Control.UNLOCK:
                key = (IDENTITY_MAGIC, PROTOCOL_VERSION, self.constants[Register.BUILD_HASH])
                return Result.OK if tuple(words[1:]) == key else Result.BAD_KEY
            case Control.ARM:
                reasons = (
                    (Result.LOCKED, not self.unlocked),
                    (Result.ARMED, not off),
                    (Result.FAULTED, fault),
                    (Result.NO_PERMIT, not permitted),
                )
                return next((reason for reason, holds in reasons if holds), Result.OK)
            case Control.DISARM | Control.CLEAR | Control.STOP | Control.TRIGGER:
                return Result.OK
        return Result.BAD_VALUE

    def write(self, register, words, *, off, quiet, fault, permitted):
        """Result of an accepted WRITE, and the pulse it causes; remembers what it says."""
        unlocked = False
        pulse = None
        if register >= FIRST_UNKNOWN:
            result = Result.UNKNOWN_REGISTER
        elif register == Register.CONTROL:
            result = self.control(words, off, fault, permitted)
            if result is Result.OK:
                unlocked = words[0] == Control.UNLOCK
                pulse = PULSES.get(words[0])
        elif register not in self.settings:
            result = Result.READ_ONLY
        elif register == Register.BIT_PERIOD and not quiet:
            result = Result.BUSY
        elif register != Register.BIT_PERIOD and not off:
            result = Result.ARMED
        else:
            result = Result.OK if self.takes(register, words[0]) else Result.BAD_VALUE
            if result is Result.OK:
                self.settings[register] = words[0]
        self.unlocked = unlocked
        return result, pulse

    def read(self, register, inputs):
        """Result and value of an accepted READ."""
        self.unlocked = False
        if register >= FIRST_UNKNOWN:
            return Result.UNKNOWN_REGISTER, None
        name = Register(register).name
        if register in TIMES:
            value, self.high = inputs[TIMES[register]] & ALL, inputs[TIMES[register]] >> 32
        elif name.endswith("_TIME_HIGH"):
            value = self.high
        elif register in INPUTS:
            value = inputs[INPUTS[register][0]]
        elif register == Register.FRAME_ERRORS:
            value = self.frame_errors
        elif register == Register.SEQUENCE_GAPS:
            value = self.gaps
        else:
            value = (self.constants | self.settings)[register]
        return Result.OK, value


BUILT_IN_LIMITS = [r.name for r in Register if r.kind is Kind.BUILT_IN and r >= Register.HV_SETTLE_TICKS]
LIMITED = ("HEARTBEAT_TICKS", "CHANNEL_EDGES", "TOTAL_EDGES", "EMISSION_TICKS", "DUTY_SHARE", "DUTY_TICKS")


class Bench:
    def __init__(self, dut):
        self.dut = dut

    @classmethod
    async def ready(cls, dut):
        await after_reset(dut, judge_i=1)
        bench = cls(dut)
        bench.begin()
        return bench

    def begin(self):
        self.reference = Reference(self.dut)
        self.uart, self._other = False, (False, 0, 0, 0)
        self.dut.uart_i.value = 0
        self.state = {"off": 1, "quiet": 1, "fault": 0, "permitted": 1}
        self.inputs = {name: 0 for name, _ in INPUTS.values()} | dict.fromkeys(TIMES.values(), 0)

    def turn(self):
        """Frames come by the other link from now on."""
        reference = self.reference
        self.uart = not self.uart
        self.dut.uart_i.value = int(self.uart)
        own = (reference.unlocked, reference.high, reference.frame_errors, reference.gaps)
        (reference.unlocked, reference.high, reference.frame_errors, reference.gaps), self._other = self._other, own

    def show(self):
        for name, value in (self.inputs | {f"{name}_i": value for name, value in self.state.items()}).items():
            getattr(self.dut, name).value = value
        self.inputs["fault_i"] = self.state["fault"]
        self.inputs["faulted_i"] = self.state["fault"] != 0

    def check_settings(self):
        for register, value in self.reference.settings.items():
            assert int(getattr(self.dut, f"{register.name.lower()}_o").value) == value, register.name

    async def write(self, register, *words):
        """A WRITE as it is accepted; returns its result, and compares that, its pulse and all settings."""
        dut = self.dut
        self.show()
        words = [*words, *(0,) * (4 - len(words))]
        dut.address_i.value = register
        dut.words_i.value = sum(word << 32 * number for number, word in enumerate(words))
        await settled()
        assert self.pulses() == set(), "nothing before the frame is accepted"
        await clocks(dut, 2)  # they rest for so long, and longer
        dut.accept_i.value = dut.write_i.value = 1
        await settled()
        result = Result(int(dut.write_result_o.value))
        expected, pulse = self.reference.write(register, words, **self.state)
        assert result is expected, (register, [hex(word) for word in words], self.state)
        assert self.pulses() == ({pulse} if pulse else set())
        await clocks(dut)
        dut.accept_i.value = dut.write_i.value = 0
        await settled()
        self.check_settings()
        return result

    def pulses(self):
        return {name for name in PULSES.values() if getattr(self.dut, name).value}

    async def read(self, register):
        dut = self.dut
        self.show()
        dut.address_i.value = register
        await clocks(dut)  # it rests long before its frame ends
        dut.accept_i.value = dut.read_i.value = 1
        await settled()
        result, value = Result(int(dut.read_result_o.value)), int(dut.data_o.value)
        expected, wanted = self.reference.read(register, self.inputs)
        assert result is expected
        if result is Result.OK:
            assert value == wanted, (register, hex(value), hex(wanted))
        await clocks(dut)
        dut.accept_i.value = dut.read_i.value = 0
        return result, value

    async def other_frame(self, refused=False, gap=False):
        """A frame that is no READ or WRITE, or was refused."""
        dut = self.dut
        if refused:
            dut.refused_i.value = 0b10 if self.uart else 0b01
        else:
            dut.accept_i.value = 1
        dut.gap_i.value = gap
        await clocks(dut)
        dut.refused_i.value = dut.accept_i.value = dut.gap_i.value = 0
        await clocks(dut, 2)  # no frame ends so soon behind another
        self.reference.unlocked = False
        self.reference.frame_errors += refused
        self.reference.gaps += gap and not refused

    async def unlock(self):
        key = (IDENTITY_MAGIC, PROTOCOL_VERSION, self.reference.constants[Register.BUILD_HASH])
        return await self.write(Register.CONTROL, Control.UNLOCK, *key)

    async def arm(self):
        return await self.write(Register.CONTROL, Control.ARM)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def every_register_reads_what_it_says_after_reset(dut):
    bench = await Bench.ready(dut)
    await settled()
    bench.check_settings()
    for register in Register:
        assert (await bench.read(register))[0] is Result.OK
    for address in (FIRST_UNKNOWN, FIRST_UNKNOWN + 1, 63, 64, 0x100, 0x8000, 0xFFFF):
        assert (await bench.read(address))[0] is Result.UNKNOWN_REGISTER
        assert await bench.write(address, 1) is Result.UNKNOWN_REGISTER
    for bit in range(6, 16):  # nor is one of them taken for another
        for register in Register:
            low, _ = bench.reference.range_of(register) if register in bench.reference.settings else (Control.DISARM, 0)
            assert await bench.write(register | 1 << bit, low) is Result.UNKNOWN_REGISTER
            bench.inputs |= dict.fromkeys(TIMES.values(), random.getrandbits(64))
            assert (await bench.read(register | 1 << bit))[0] is Result.UNKNOWN_REGISTER
    assert await bench.read(Register.FAULT_TIME_HIGH) == (Result.OK, bench.reference.high)
    for register, (name, bits) in INPUTS.items():
        for value in ((1 << bits) - 1, 1 << bits - 1, 1):
            bench.inputs[name] = value
            if register is Register.FAULT:
                bench.state["fault"] = value
            assert await bench.read(register) == (Result.OK, value)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def settings_take_the_values_allowed_and_only_while_they_may(dut):
    bench = await Bench.ready(dut)
    reference = bench.reference
    for register in reference.settings:
        low, high = reference.range_of(register)
        within = [value for value in (low, high, low + 1, (low + high) // 2, (low + high) // 4) if reference.takes(register, value)]
        assert len(within) > 2
        for value in within:
            assert await bench.write(register, value, ALL, ALL, ALL) is Result.OK, (register.name, value)
            assert await bench.read(register) == (Result.OK, value)
        refused = [
            value
            for value in (low - 1, high + 1, ALL, 0x8000_0000 | low, low | 1 << 29, 1 << 19)
            if not reference.takes(register, value) and 0 <= value <= ALL
        ]
        for value in refused:
            assert await bench.write(register, value) is Result.BAD_VALUE, (register.name, value)
        is_period = register is Register.BIT_PERIOD
        bench.state |= {"off": int(is_period), "quiet": int(not is_period)}
        expected = Result.BUSY if is_period else Result.ARMED
        for value in (low, *refused):
            assert await bench.write(register, value) is expected, "that comes first"
        bench.state |= {"off": int(not is_period), "quiet": int(is_period)}
        assert await bench.write(register, low) is Result.OK, "the other of the two is of no account"
        bench.state |= {"off": 1, "quiet": 1}
        if register is Register.PULSE_TICKS:
            assert await bench.write(register, reference.pulse_min) is Result.OK
    for register in Register:
        if register.access == "RO":
            assert await bench.write(register, 1) is Result.READ_ONLY
        else:
            assert register in reference.settings or register is Register.CONTROL


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def the_shortest_pulse_and_the_bit_period_bound_each_other(dut):
    bench = await Bench.ready(dut)
    low, high = bench.reference.bit_ticks_min, bench.reference.bit_ticks_max
    assert await bench.write(Register.BIT_PERIOD, high << 16) is Result.OK
    assert await bench.write(Register.BIT_PERIOD, high << 16 | 1) is Result.BAD_VALUE
    assert await bench.write(Register.PULSE_TICKS, high + 1) is Result.BAD_VALUE
    assert await bench.write(Register.PULSE_TICKS, 0x1_0000 | high) is Result.BAD_VALUE
    assert await bench.write(Register.PULSE_TICKS, high) is Result.OK
    assert await bench.write(Register.BIT_PERIOD, (high << 16) - 1) is Result.BAD_VALUE
    middle = (low + high) // 2
    assert await bench.write(Register.PULSE_TICKS, middle) is Result.OK
    assert await bench.write(Register.BIT_PERIOD, middle << 16 | 0xFFFF) is Result.OK
    assert await bench.write(Register.PULSE_TICKS, middle + 1) is Result.BAD_VALUE
    assert await bench.write(Register.BIT_PERIOD, (middle << 16) - 1) is Result.BAD_VALUE


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def arming_needs_the_key_in_the_frame_directly_before(dut):
    bench = await Bench.ready(dut)
    assert await bench.arm() is Result.LOCKED
    assert await bench.unlock() is Result.OK
    assert await bench.arm() is Result.OK
    assert await bench.arm() is Result.LOCKED, "once"
    between = (
        bench.other_frame(),
        bench.other_frame(refused=True),
        bench.other_frame(gap=True),
        bench.read(Register.IDENTITY),
        bench.read(FIRST_UNKNOWN),
        bench.write(Register.IDLE_WORD, 5),
        bench.write(Register.IDENTITY, 5),
        bench.write(Register.CONTROL, Control.CLEAR),
        bench.write(Register.CONTROL, 99),
        bench.write(Register.CONTROL, Control.UNLOCK),
    )
    for frame in between:
        await bench.unlock()
        await frame
        assert await bench.arm() is Result.LOCKED
    key = [IDENTITY_MAGIC, PROTOCOL_VERSION, bench.reference.constants[Register.BUILD_HASH]]
    for place in range(3):
        for bit in (0, 7, 31):
            damaged = list(key)
            damaged[place] ^= 1 << bit
            assert await bench.write(Register.CONTROL, Control.UNLOCK, *damaged) is Result.BAD_KEY
            assert await bench.arm() is Result.LOCKED
    await bench.unlock()
    await clocks(dut, 50)
    assert await bench.arm() is Result.OK, "however long it takes"
    await bench.unlock()
    bench.state["off"] = 0
    assert await bench.unlock() is Result.OK, "whatever the state"


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def arming_says_what_is_in_its_way_the_lock_first(dut):
    bench = await Bench.ready(dut)
    reasons = ((Result.NO_PERMIT, {"permitted": 0}), (Result.FAULTED, {"fault": 0x100}), (Result.ARMED, {"off": 0}))
    for reason, change in reasons:
        bench.state |= change
        await bench.unlock()
        assert await bench.arm() is reason
        assert await bench.arm() is Result.LOCKED
    good = {"off": 1, "fault": 0, "permitted": 1, "quiet": 0}
    for reason, change in ((Result.OK, {}), *reasons):  # each alone
        bench.state |= good | change
        await bench.unlock()
        assert await bench.arm() is reason
    bench.state |= good
    for bit in range(16):
        bench.state["fault"] = 1 << bit
        await bench.unlock()
        assert await bench.arm() is Result.FAULTED


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def control_becomes_a_pulse_in_any_state_and_knows_no_other_words(dut):
    bench = await Bench.ready(dut)
    for state in ({}, {"off": 0, "quiet": 0}, {"fault": 1}, {"permitted": 0}):
        bench.state |= state
        for command in (Control.DISARM, Control.CLEAR, Control.STOP, Control.TRIGGER):
            assert await bench.write(Register.CONTROL, command) is Result.OK
    for word in (0, 7, 0x101, 0x8000_0002, ALL):
        assert await bench.write(Register.CONTROL, word, *[ALL] * 3) is Result.BAD_VALUE


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def the_low_half_of_a_time_holds_its_high_half(dut):
    bench = await Bench.ready(dut)
    for register, name in TIMES.items():
        other = next(iter(set(TIMES.values()) - {name}))
        bench.inputs |= {name: 0x1111_2222_3333_4444, other: 0x9999_AAAA_BBBB_CCCC}
        assert await bench.read(register) == (Result.OK, 0x3333_4444)
        bench.inputs[name] = 0x5555_6666_7777_8888
        dut.address_i.value = register
        bench.show()
        await clocks(dut, 3)  # looked at, but no READ was accepted
        for high in TIMES:
            assert await bench.read(high + 1) == (Result.OK, 0x1111_2222), "of the one whose LOW was read last"
        await bench.read(Register.FAULT)
        await bench.write(register, 0)
        assert await bench.read(register + 1) == (Result.OK, 0x1111_2222)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def counts_refused_frames_and_gaps(dut):
    bench = await Bench.ready(dut)
    for number in range(1, 5):
        await bench.other_frame(refused=True, gap=number % 2)
        assert await bench.read(Register.FRAME_ERRORS) == (Result.OK, number)
        assert await bench.read(Register.SEQUENCE_GAPS) == (Result.OK, number - 1)
        await bench.other_frame(gap=True)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def each_link_has_counts_a_held_half_and_a_lock_of_its_own(dut):
    bench = await Bench.ready(dut)
    low, high = Register.FAULT_TIME_LOW, Register.FAULT_TIME_HIGH
    assert await bench.unlock() is Result.OK
    bench.inputs["fault_time_i"] = 0x1111_2222_3333_4444
    await bench.read(low)
    bench.turn()  # to the UART
    assert await bench.arm() is Result.LOCKED
    await bench.other_frame(refused=True)
    await bench.other_frame(gap=True)
    bench.inputs["fault_time_i"] = 0x5555_6666_7777_8888
    await bench.read(low)
    assert await bench.read(Register.FRAME_ERRORS) == (Result.OK, 1)
    assert await bench.read(Register.SEQUENCE_GAPS) == (Result.OK, 1)
    assert await bench.unlock() is Result.OK
    bench.turn()  # and back: what the UART did between changes nothing for the SPI
    assert await bench.read(high) == (Result.OK, 0x1111_2222)
    assert await bench.read(Register.FRAME_ERRORS) == (Result.OK, 0)
    assert await bench.read(Register.SEQUENCE_GAPS) == (Result.OK, 0)
    bench.turn()
    assert await bench.read(high) == (Result.OK, 0x5555_6666)


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def random_frames_go_as_the_reference_says_and_a_reset_restores_all(dut):
    bench = await Bench.ready(dut)
    seen = set()
    for _ in range(4_000):
        for name, often in (("off", 0.7), ("quiet", 0.7), ("permitted", 0.8)):
            bench.state[name] = int(random.random() < often)
        bench.state["fault"] = random.choice([0, 0, 0, random.getrandbits(9)])
        for name, bits in (*INPUTS.values(), *((name, 64) for name in TIMES.values())):
            bench.inputs[name] = random.getrandbits(bits)
        bench.inputs["fault_i"] = bench.state["fault"]
        bench.inputs["faulted_i"] = bench.state["fault"] != 0
        if random.random() < 0.2:
            bench.turn()
        register = random.choice([*Register, *bench.reference.settings, random.getrandbits(16)])
        match random.randrange(8):
            case 0 | 1:
                await bench.read(register)
            case 2 | 3 | 4:
                low, high = bench.reference.range_of(register) if register in bench.reference.settings else (0, 8)
                values = [low, high, low - 1, high + 1, random.randrange(low, high + 1), random.getrandbits(32)]
                words = [random.choice(values) & ALL, *(random.getrandbits(32) for _ in range(3))]
                seen.add(await bench.write(register, *words))
            case 5:
                if await bench.unlock() is Result.OK and random.random() < 0.8:
                    seen.add(await bench.arm())
            case 6:
                await bench.other_frame(refused=random.random() < 0.5, gap=random.random() < 0.5)
            case 7:
                seen.add(await bench.write(Register.CONTROL, random.randrange(9)))
                if random.random() < 0.05:
                    dut.rst_i.value = 1
                    await clocks(dut)
                    dut.rst_i.value = 0
                    bench.begin()
                    bench.show()
                    await settled()
                    bench.check_settings()
                    assert await bench.arm() is Result.LOCKED
    expected = {Result.OK, Result.UNKNOWN_REGISTER, Result.READ_ONLY, Result.BAD_VALUE, Result.ARMED, Result.BUSY}
    assert seen >= expected | {Result.LOCKED, Result.BAD_KEY, Result.FAULTED, Result.NO_PERMIT}
