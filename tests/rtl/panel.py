"""The pins of haptic_core in simulation: an SPI controller, a recorder, and the model given the same inputs.

A tick is a clock since reset: an input changed at tick t is sampled by the clock edge that ends tick t,
an output of tick t is on its pin after the edge that begins it. Inputs move half a nanosecond beside any
clock edge, so at every ratio of SCK to the clock it is plain which edge samples them.
"""

import os
import random
from pathlib import Path

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge, Timer, ValueChange
from cocotb.utils import get_sim_time

from controller.bank.reader import Bank
from controller.fpga import frames
from controller.fpga.frames import FRAME_BYTES, parse_status
from controller.fpga.model import GatewareModel
from controller.fpga.registers import Register, Result, State

CLOCK_NS = 10
SCK_HALF_NS = 3 * CLOCK_NS  # clk/6, the fastest allowed
SELECT_TO_SCK_NS = 5 * CLOCK_NS
SELECT_HIGH_NS = 4 * CLOCK_NS

CLOCK_HZ = 1_000_000
SLOTS = 2
BUILD_HASH = 0x600DF00D
HEARTBEAT_TICKS_MAX = 60_000
PARAMETERS = {
    "CLOCK_HZ": CLOCK_HZ,
    "SLOTS": SLOTS,
    "BUILD_HASH": BUILD_HASH,
    "HEARTBEAT_TICKS_MAX": HEARTBEAT_TICKS_MAX,
}

IDLE_WORD = 0x96969696
RAMP_SAMPLES = 9
BIT_TICKS = 4


def bank_entry_words():
    """(1000,) drive words of the entry of a real bank that test_rtl.py has built."""
    with Bank.open(Path(os.environ["HAPTIC_PANEL_TEST_BANK"])) as bank:
        (cell,) = np.flatnonzero(bank.cells).tolist()
        return np.frombuffer(bytes(bank.words(cell)), "<u4")


class Panel:
    """Everything done to the pins since reset, and everything seen on them."""

    def __init__(self, dut):
        self.dut = dut
        self.sck_half_ns = SCK_HALF_NS
        self.sequence = 0
        self.inputs = []  # (tick, order within the tick, name of the model's method, its arguments after the tick)
        self.answers = []  # what came back, in the order of the exchanges
        self.words, self.levels, self.focus_ticks = [], [], []  # (tick, value) of channel_o and hv_enable_o; rises
        self._frame = bytearray(frames.LOAD_FRAME_BYTES)

    @classmethod
    async def after_reset(cls, dut):
        """Start the clock, reset, and record from then on; run permit and trigger are low."""
        panel = cls(dut)
        dut.spi_sck_i.value = dut.spi_mosi_i.value = dut.trigger_i.value = dut.run_permit_i.value = 0
        dut.spi_cs_n_i.value = dut.rst_i.value = 1
        Clock(dut.clk_i, CLOCK_NS, "ns").start()
        await ClockCycles(dut.clk_i, 3)
        panel._origin_ps = get_sim_time("ps")
        await FallingEdge(dut.clk_i)
        dut.rst_i.value = 0
        await Timer(500, "ps")
        assert dut.channel_o.value == 0
        assert dut.hv_enable_o.value == 0
        for record in (panel._record(dut.channel_o, panel.words), panel._record(dut.hv_enable_o, panel.levels)):
            cocotb.start_soon(record)
        cocotb.start_soon(panel._record_focus())
        await panel.wait(4)  # until the synchronisers have seen every input at rest
        return panel

    @property
    def tick(self):
        """The tick whose ending clock edge samples what is changed now."""
        return int((get_sim_time("ps") - self._origin_ps) // (1000 * CLOCK_NS))

    async def _record(self, signal, changes):
        while True:
            await ValueChange(signal)
            changes.append((self.tick, int(signal.value)))

    async def _record_focus(self):
        while True:
            await RisingEdge(self.dut.focus_o)
            self.focus_ticks.append(self.tick)

    async def wait(self, ticks):
        await Timer(ticks * CLOCK_NS, "ns")

    def permit(self, level):
        self.dut.run_permit_i.value = int(level)
        self.inputs.append((self.tick, 0, "permit", (bool(level),)))

    async def trigger(self):
        """Raise the trigger for two clocks and lower it for two; returns the tick of its rise."""
        tick = self.tick
        self.dut.trigger_i.value = 1
        self.inputs.append((tick, 2, "trigger", ()))
        await self.wait(2)
        self.dut.trigger_i.value = 0
        await self.wait(2)
        return tick

    async def exchange(self, frame, bits=None):
        """One chip-select assertion, the first `bits` bits of the frame; returns what came back."""
        dut, answer = self.dut, 0
        bits = 8 * len(frame) if bits is None else bits
        as_number = int.from_bytes(frame, "big")
        select_tick = self.tick
        dut.spi_cs_n_i.value = 0
        if self.sck_half_ns < SELECT_TO_SCK_NS:
            await Timer(SELECT_TO_SCK_NS - self.sck_half_ns, "ns")
        for bit in range(bits):
            dut.spi_mosi_i.value = (as_number >> (8 * len(frame) - 1 - bit)) & 1
            await Timer(self.sck_half_ns, "ns")
            answer = answer << 1 | int(dut.spi_miso_o.value)
            dut.spi_sck_i.value = 1
            await Timer(self.sck_half_ns, "ns")
            dut.spi_sck_i.value = 0
        await Timer(self.sck_half_ns, "ns")
        release_tick = self.tick
        dut.spi_cs_n_i.value = 1
        if bits % 8 == 0:
            self.inputs.append((select_tick, 1, "exchange", (release_tick, bytes(frame[: bits // 8]))))
            self.answers.append(answer.to_bytes(bits // 8, "big"))
        await Timer(SELECT_HIGH_NS, "ns")
        return answer.to_bytes(-(-bits // 8), "big")

    async def send(self, pack, *arguments, **named):
        """Pack a frame and send it; returns the status that came back, which is about the frame before."""
        self.sequence += 1
        end = pack(self._frame, 0, self.sequence, *arguments, **named)
        return parse_status(await self.exchange(bytes(self._frame[:end])))

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
        await self.send(frames.pack_write, register, value)

    async def control(self, command):
        await self.send(frames.pack_control, command)

    async def arm(self, heartbeat_ticks=HEARTBEAT_TICKS_MAX):
        """Settings, permit, arming, and the ramp waited for."""
        self.permit(True)
        await self.write(Register.IDLE_WORD, IDLE_WORD)
        await self.write(Register.BIT_TICKS, BIT_TICKS)
        await self.write(Register.RAMP_SAMPLES, RAMP_SAMPLES)
        await self.write(Register.HEARTBEAT_TICKS, heartbeat_ticks)
        await self.arm_again()

    async def arm_again(self):
        await self.send(frames.pack_arm, BUILD_HASH)
        await self.wait(RAMP_SAMPLES * BIT_TICKS + 10)
        status = await self.status()
        assert status.result is Result.OK, status
        assert State.ARMED | State.HV_ENABLE in status.state, status

    async def upload(self, slot, words):
        """LOAD as many chunks as it takes, and STORE."""
        data = memoryview(np.ascontiguousarray(words, "<u4")).cast("B")
        for chunk in range(-(-len(words) // 125)):
            await self.send(frames.pack_load, chunk, data[500 * chunk : 500 * (chunk + 1)])
        assert await self.result_of(frames.pack_store, slot, len(words)) is Result.OK

    def check_against_model(self, late_trigger_ticks=0):
        """The model, given the same inputs at the same ticks, has done the same to every pin and answered the same."""
        now = self.tick
        model = GatewareModel(CLOCK_HZ, SLOTS, BUILD_HASH, HEARTBEAT_TICKS_MAX)
        answers = []
        for tick, _, method, arguments in sorted(self.inputs, key=lambda entry: entry[:2]):
            if method == "exchange":
                answers.append(bytearray(len(arguments[1])))
                model.exchange(tick, *arguments, memoryview(answers[-1]))
            elif method == "trigger":
                model.trigger(tick + late_trigger_ticks)
            else:
                model.permit(tick, *arguments)
        model.advance(now)
        capture = model.take_capture()
        for number, (seen, foreseen) in enumerate(zip(self.answers, answers, strict=True)):
            assert seen == foreseen, f"answer {number}: {parse_status(seen)}, model: {_readable(foreseen)}"
        for name, seen, values in (("channel_o", self.words, capture.words), ("hv_enable_o", self.levels, capture.hv)):
            changed = np.diff(values.astype(np.int64), prepend=0) != 0
            foreseen = list(zip(capture.ticks[changed].tolist(), values[changed].tolist(), strict=True))
            different = next((pair for pair in zip(seen, foreseen, strict=False) if pair[0] != pair[1]), None)
            assert different is None, f"{name}: (tick, value) {different[0]}, model: {different[1]}"
            assert len(seen) == len(foreseen), f"{name}: {len(seen)} changes, model: {len(foreseen)}"
        assert self.focus_ticks == capture.focus_ticks.tolist()
        return capture


def _readable(answer):
    return parse_status(answer) if len(answer) >= FRAME_BYTES else answer


def random_words(length):
    return np.array([random.getrandbits(32) for _ in range(length)], np.uint32)
