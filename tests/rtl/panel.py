"""The pins of haptic_core in simulation: an SPI controller, a UART, a recorder, and the model given the same inputs.

A tick is a clock since reset: an input changed at tick t is sampled by the clock edge that ends tick t,
an output of tick t is on its pin after the edge that begins it. Inputs move half a nanosecond beside any
clock edge, so at every ratio of SCK to the clock it is plain which edge samples them.
"""

import os
import random
import zlib
from pathlib import Path

import cocotb
import numpy as np
from cobs import cobs
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge, Timer, ValueChange
from cocotb.types import Logic
from cocotb.utils import get_sim_time
from pin_script import (
    BIT_TICKS,
    BUILD_HASH,
    CLOCK_HZ,
    FRAME_TICKS,
    IDLE_WORD,
    JUDGED_TICKS,
    PARAMETERS,
    RAMP_SAMPLES,
    RAMP_TICKS,
    SETTLE_TICKS,
    SLOTS,
    UART,
    give,
)
from uart import Wire

from controller.device.bank.reader import Bank
from controller.device.fpga import frames
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import Control, Register, Result, State
from controller.device.fpga.status import parse_status
from controller.errors import LinkError
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import INPUT_TICKS, GatewareModel
from controller.workshop.gateware.pin_timing import (
    BAUD,
    READY_TICKS,
    SCK_TICKS,
    SCK_TO_RELEASE_TICKS,
    SELECT_HIGH_TICKS,
    SELECT_TO_SCK_TICKS,
    TRIGGER_HIGH_TICKS,
    TRIGGER_PERIOD_TICKS,
)

__all__ = [
    "BIT_TICKS",
    "BUILD_HASH",
    "CLOCK_HZ",
    "FRAME_TICKS",
    "IDLE_WORD",
    "JUDGED_TICKS",
    "PAD_TICKS",
    "PARAMETERS",
    "RAMP_SAMPLES",
    "RAMP_TICKS",
    "SETTLE_TICKS",
    "SLOTS",
    "Panel",
    "bank_entry_words",
    "random_words",
]

LEVELS = {"0": Logic(0), "1": Logic(1)}  # made once: a level is set a million times
CLOCK_NS = 10
CLOCK_PS = 1000 * CLOCK_NS
PHASE_PS = CLOCK_PS // 2 + 500  # within a tick: inputs move half a nanosecond behind the clock's fall
SCK_HALF_NS = SCK_TICKS * CLOCK_NS // 2  # half of the clock, the fastest allowed
SCK_TO_RELEASE_NS = SCK_TO_RELEASE_TICKS * CLOCK_NS
PAD_TICKS = 1  # from the state to waiting_o and fault_o, which have a register each
UART_BIT_TICKS = CLOCK_HZ // BAUD
UART_ANSWER_BITS = 12 * FRAME_BYTES  # more than an answer takes
ORDER = ("uart", "permit", "exchange", "trigger")  # in which a model is given what happens in one tick
PERMIT_PINS = {Permit.RUN: "run_permit_i", Permit.TEMPERATURE: "temperature_ok_i"}


def bank_entry_words():
    """(1000,) drive words of the entry of a real bank that test_rtl.py has built."""
    with Bank.open(Path(os.environ["HAPTIC_PANEL_TEST_BANK"])) as bank:
        (cell,) = np.flatnonzero(bank.cells).tolist()
        return np.frombuffer(bytes(bank.drive.words(cell)), "<u4")


class Panel:
    """Everything done to the pins since reset, and everything seen on them."""

    def __init__(self, dut):
        self.dut = dut
        self.sck_half_ns = SCK_HALF_NS
        self.sequence = 0
        self.release_tick = 0  # of the last frame
        self.inputs = []  # (tick, name of the model's method, its arguments after the tick)
        self.answers = []  # what came back, in the order of the exchanges
        self.words, self.levels, self.alive = [], [], []  # (tick, value) of channel_o, hv_enable_o and hv_alive_o
        self.waits, self.faults, self.foci = [], [], []  # of waiting_o, fault_o and focus_o
        self.tx = []  # of uart_tx_o
        self._frame = bytearray(frames.LOAD_FRAME_BYTES)

    @classmethod
    async def after_reset(cls, dut):
        """Start the clock, reset, and record from then on; all inputs are at rest, the permits low."""
        panel = cls(dut)
        panel._rest()
        dut.rst_i.value = 1
        Clock(dut.clk_i, CLOCK_NS, "ns").start()
        await ClockCycles(dut.clk_i, 3)
        await panel._begin()
        return panel

    async def reset(self, *, inputs_rest=True):
        """A reset in the middle of whatever there is; the panel as of then, that knows nothing of this one."""
        for recording in self._recordings:
            recording.cancel()
        await FallingEdge(self.dut.clk_i)
        self.dut.rst_i.value = 1
        if inputs_rest:
            self._rest()
        await ClockCycles(self.dut.clk_i, 1)
        panel = type(self)(self.dut)
        await panel._begin()
        return panel

    def _rest(self):
        dut = self.dut
        dut.spi_sck_i.value = dut.spi_mosi_i.value = dut.trigger_i.value = 0
        dut.run_permit_i.value = dut.temperature_ok_i.value = dut.clock_lost_i.value = 0
        dut.spi_cs_n_i.value = dut.uart_rx_i.value = 1

    async def _begin(self):
        """End a reset, as of whose last clock edge ticks are counted."""
        dut = self.dut
        self._origin_ps = get_sim_time("ps")
        await FallingEdge(dut.clk_i)
        dut.rst_i.value = 0
        await Timer(500, "ps")
        outputs = {
            dut.channel_o: self.words,
            dut.hv_enable_o: self.levels,
            dut.hv_alive_o: self.alive,
            dut.waiting_o: self.waits,
            dut.fault_o: self.faults,
            dut.focus_o: self.foci,
            dut.uart_tx_o: self.tx,
        }
        for output in outputs:
            assert output.value == (output is dut.uart_tx_o), output._name
        self._recordings = [cocotb.start_soon(self._record(output, changes)) for output, changes in outputs.items()]
        await self.until(READY_TICKS)  # when the synchronisers have seen every input at rest

    @property
    def tick(self):
        """The tick whose ending clock edge samples what is changed now."""
        return int((get_sim_time("ps") - self._origin_ps) // CLOCK_PS)

    @property
    def focus_ticks(self):
        """Rises of focus_o."""
        return [tick for tick, level in self.foci if level]

    async def _record(self, signal, changes):
        while True:
            await ValueChange(signal)
            changes.append((self.tick, int(signal.value)))

    async def wait(self, ticks):
        if ticks:
            await Timer(ticks * CLOCK_NS, "ns")

    async def until(self, tick):
        """Go to a tick; one that has passed is an error."""
        ahead_ps = self._origin_ps + tick * CLOCK_PS + PHASE_PS - get_sim_time("ps")
        assert ahead_ps > -CLOCK_PS // 2, f"tick {tick} has passed: it is {self.tick}"
        if ahead_ps > 0:
            await Timer(round(ahead_ps), "ps")

    def permit(self, level, which=Permit.RUN):
        getattr(self.dut, PERMIT_PINS[which]).value = int(level)
        self.inputs.append((self.tick, "permit", (bool(level), which)))

    async def trigger(self, high_ticks=TRIGGER_HIGH_TICKS):
        """Raise the trigger for four clocks, or fewer, and keep it low until it may rise again; returns the tick of its rise."""
        tick = self.tick
        self.dut.trigger_i.value = 1
        self.inputs.append((tick, "trigger", (high_ticks,)))
        await self.wait(high_ticks)
        self.dut.trigger_i.value = 0
        await self.wait(TRIGGER_PERIOD_TICKS - high_ticks)
        return tick

    async def exchange(self, frame, bits=None, release_tick=None):
        """One chip-select assertion, the first `bits` bits of the frame; returns what came back.

        It ends as soon as it may at this panel's SCK, or at `release_tick`, SCK as much slower as that allows.
        """
        dut, answer, sck, mosi, miso = self.dut, 0, self.dut.spi_sck_i, self.dut.spi_mosi_i, self.dut.spi_miso_o
        bits = 8 * len(frame) if bits is None else bits
        select_tick = self.tick
        half_ns = self.sck_half_ns
        if release_tick is not None and bits:
            room_ticks = release_tick - select_tick - SELECT_TO_SCK_TICKS - SCK_TO_RELEASE_TICKS
            half_ns = room_ticks * CLOCK_NS // (2 * bits - 2)
        half = Timer(half_ns, "ns")
        sent = "".join(f"{byte:08b}" for byte in frame)[:bits] + "0"
        dut.spi_cs_n_i.value = 0
        mosi.value, level = LEVELS[sent[0]], sent[0]
        low, high = LEVELS.values()
        await Timer(INPUT_TICKS * CLOCK_NS, "ns")
        enabled = bool(dut.hv_enable_o.value)
        await Timer(PAD_TICKS * CLOCK_NS, "ns")
        pins, fault = {State.WAITING: bool(dut.waiting_o.value), State.HV_ENABLE: enabled}, bool(dut.fault_o.value)
        await Timer((SELECT_TO_SCK_TICKS - INPUT_TICKS - PAD_TICKS) * CLOCK_NS, "ns")
        for number, following in enumerate(sent[1:], 1):  # mode 0: MOSI moves with the fall of SCK
            answer = answer << 1 | int(miso.value)
            sck.value = high
            if number == bits:
                half = Timer(SCK_TO_RELEASE_NS // 2, "ns")
            await half
            sck.value = low
            if following != level:
                mosi.value, level = LEVELS[following], following
            await half
        if release_tick is not None:
            await self.until(release_tick)
        self.release_tick = self.tick
        dut.spi_cs_n_i.value = 1
        came = answer.to_bytes(-(-bits // 8), "big")
        if bits % 8 == 0:
            self.inputs.append((select_tick, "exchange", (self.release_tick, bytes(frame[: bits // 8]))))
            self.answers.append(came)
            self._agrees(came, pins, fault)
        await Timer(SELECT_HIGH_TICKS * CLOCK_NS, "ns")
        return came

    def _agrees(self, answer, pins, fault):
        """What the status says of pins is what they were when it was taken."""
        try:
            status = parse_status(answer) if len(answer) >= FRAME_BYTES else None
        except LinkError:  # whoever sent the frame knows why
            return
        if status is not None:
            assert {flag: flag in status.state for flag in pins} == pins, status
            assert bool(status.faults) == fault, status

    async def exchange_by_uart(self, frame):
        """A frame over the UART; returns its answer."""
        wire = self.wire
        answered = len(wire.answers)
        await self.send_by_uart(cobs.encode(bytes(frame)) + b"\0")
        for _ in range(UART_ANSWER_BITS):
            if len(wire.answers) > answered:
                break
            await wire.bits(1)
        (answer,) = wire.answers[answered:]
        return answer

    async def send_by_uart(self, data):
        """Bytes back to back, that the model is given."""
        begin = self.tick
        self.inputs.append((begin, "uart", (data,)))
        await self.wire.send(data)
        assert self.tick == begin + 10 * len(data) * UART_BIT_TICKS

    async def open_uart(self):
        """The zero behind which the first frame may come."""
        self.wire = Wire(self.dut)
        await self.wire.bits(2)
        await self.send_by_uart(b"\0")

    def packed(self, pack, *arguments, **named):
        self.sequence += 1
        end = pack(self._frame, 0, self.sequence, *arguments, **named)
        return bytes(self._frame[:end])

    async def send(self, pack, *arguments, **named):
        """Pack a frame and send it; returns the status that came back, which is about the frame before."""
        return parse_status(await self.exchange(self.packed(pack, *arguments, **named)))

    async def status(self):
        return await self.send(frames.pack_nop)

    async def result_of(self, pack, *arguments, **named):
        """Send a frame and a NOP that fetches what became of it."""
        await self.send(pack, *arguments, **named)
        return (await self.status()).result

    async def read(self, register):
        await self.send(frames.pack_read, register)
        return (await self.status()).data

    async def write(self, register, value):
        assert await self.result_of(frames.pack_write, register, value) is Result.OK

    async def control(self, command):
        await self.send(frames.pack_control, command)

    def permit_all(self):
        for which in Permit:
            self.permit(True, which)

    async def arm(self, bit_period=BIT_TICKS << 16, **settings):
        """Permits, settings (names of registers and their values), arming, and the ramp waited for."""
        self.permit_all()
        settings = {"IDLE_WORD": IDLE_WORD, "BIT_PERIOD": bit_period, "RAMP_SAMPLES": RAMP_SAMPLES} | settings
        for name, value in settings.items():
            await self.write(Register[name], value)
        await self.arm_again(settings["RAMP_SAMPLES"] * bit_period >> 16)

    async def unlock_and_arm(self):
        """Both frames, whatever becomes of them."""
        await self.send(frames.pack_unlock, BUILD_HASH)
        await self.control(Control.ARM)

    async def arm_again(self, ramp_ticks=RAMP_TICKS):
        await self.unlock_and_arm()
        await self.wait(SETTLE_TICKS + ramp_ticks + 10)
        status = await self.status()
        assert status.result is Result.OK, status
        assert State.ARMED | State.HV_ENABLE in status.state, status

    async def upload(self, slot, words):
        """LOAD as many chunks as it takes, and STORE; the slot is checked when this returns."""
        data = memoryview(np.ascontiguousarray(words, "<u4")).cast("B")
        for chunk in range(-(-len(words) // 125)):
            await self.exchange(self.packed(frames.pack_load, chunk, data[500 * chunk : 500 * (chunk + 1)]))
        await self.send(frames.pack_store, slot, len(words), zlib.crc32(data))
        await self.wait(len(words))
        assert (await self.status()).result is Result.OK

    async def play(self, slot=0, **how):
        """A PLAY that is accepted."""
        assert await self.result_of(frames.pack_play, Play(slot, **how)) is Result.OK

    async def perform(self, script):
        """All steps of a script of tests/conformance/pin_script.py, each at its tick."""
        edges = []
        for method, (tick, *arguments) in script.steps:
            if method == "permit":
                level, which = arguments
                edges.append((tick, PERMIT_PINS[which], level))
            elif method == "uart":
                bits = [(0, *(byte >> bit & 1 for bit in range(8)), 1) for byte in arguments[0]]
                edges += [(UART.bit_tick(tick, n, bit), "uart_rx_i", bits[n][bit]) for n in range(len(bits)) for bit in range(10)]
            elif method == "trigger":
                edges += [(tick, "trigger_i", True), (tick + arguments[0], "trigger_i", False)]
            if method != "exchange":
                self.inputs.append((tick, method, tuple(arguments)))
        others = cocotb.start_soon(self._move(sorted(edges, key=lambda edge: edge[0])))
        for method, arguments in script.steps:
            if method == "exchange":
                select_tick, release_tick, frame = arguments
                await self.until(select_tick)
                await self.exchange(frame, release_tick=release_tick)
        await self.until(script.tick)
        await others

    async def _move(self, edges):
        for tick, pin, level in edges:
            await self.until(tick)
            getattr(self.dut, pin).value = int(level)

    def check_against_model(self, late=None):
        """The model, given the same inputs at the same ticks, has done the same to every pin and answered the same.

        Parameters
        ----------
        late : str
            "permit", "trigger" or "exchange": that kind of input comes to the model one tick late.
        """
        now = self.tick
        model = GatewareModel(PARAMETERS, lines=True)
        answers = []
        for at, method, arguments in sorted(self.inputs, key=lambda entry: (entry[0], ORDER.index(entry[1]))):
            tick = at + (method == late)
            if method == "exchange":
                release_tick, frame = arguments
                answers.append(bytearray(len(frame)))
                model.exchange(tick, release_tick + (method == late), frame, memoryview(answers[-1]))
            else:
                give(model, method, tick, *arguments)
        model.advance(now)
        capture = model.take_capture()
        for number, (seen, foreseen) in enumerate(zip(self.answers, answers, strict=True)):
            assert seen == foreseen[: len(seen)], f"answer {number}: {_readable(seen)}, model: {_readable(foreseen)}"
        hv = _changes(capture.ticks, capture.hv)
        _same("channel_o", self.words, _changes(capture.ticks, capture.words))
        _same("hv_enable_o", self.levels, hv)
        for name, seen, foreseen in (
            ("hv_alive_o", self.alive, capture.alive_ticks),
            ("waiting_o", self.waits, capture.waiting_ticks),
            ("fault_o", self.faults, capture.fault_ticks),
            ("uart_tx_o", self.tx, capture.uart_ticks),
        ):
            _same(name, [tick for tick, _ in seen], foreseen.tolist())
        _same("focus_o", self.focus_ticks, capture.focus_ticks.tolist())
        return capture


def shortest_pulse_ticks(words):
    """The shortest time between two changes of one channel, from all changes (tick, word) since reset."""
    last, shortest, before = {}, [], 0
    for tick, word in words:
        for channel in range(32):
            if (word ^ before) >> channel & 1:
                shortest.append(tick - last.get(channel, -1000))
                last[channel] = tick
        before = word
    return min(shortest)


def random_words(length):
    return np.array([random.getrandbits(32) for _ in range(length)], np.uint32)


def _changes(ticks, values):
    changed = np.diff(values.astype(np.int64), prepend=0) != 0
    return list(zip(ticks[changed].tolist(), values[changed].tolist(), strict=True))


def _same(name, seen, foreseen):
    different = next((pair for pair in zip(seen, foreseen, strict=False) if pair[0] != pair[1]), None)
    assert different is None, f"{name}: {different[0]}, model: {different[1]}"
    assert len(seen) == len(foreseen), f"{name}: {len(seen)} changes, model: {len(foreseen)}"


def _readable(answer):
    try:
        return parse_status(answer) if len(answer) >= FRAME_BYTES else bytes(answer)
    except LinkError:
        return bytes(answer)
