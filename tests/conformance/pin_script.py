"""Scripts: everything that is done to the pins, tick by tick, to be performed on any back-end.

A script knows no answers, so that every back-end gets exactly the same one. What happens on other
pins while a frame is on the wire comes before that frame in the script.
"""

import zlib
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np
from cobs import cobs

from controller.device.board.lookup import data_folder
from controller.device.fpga import frames
from controller.device.fpga.bitstreams.build_hash import build_hash
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.registers import Control, Register
from controller.device.fpga.status import parse_status
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.input_script import ExchangeStep, InputScript, PermitStep, TriggerStep, UartStep
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.pin_timing import (
    READY_TICKS,
    SELECT_HIGH_TICKS,
    SELECT_TO_SCK_TICKS,
    TRIGGER_HIGH_TICKS,
    TRIGGER_PERIOD_TICKS,
    UartTiming,
    frame_ticks,
)

# A slow clock, so that words of 6 ticks are within the fastest bit clock, yet a waveform can play while it arrives
CLOCK_HZ = 12_000_000
SLOTS = 3
BUILD_HASH = build_hash(data_folder("fpga_rtl"))
PARAMETERS = BuildParameters(
    clock_hz=CLOCK_HZ,
    slots=SLOTS,
    build_hash=BUILD_HASH,
    board=int.from_bytes(b"SIM ", "little"),
    bit_period_reset=24 << 16,
    ramp_samples_reset=5000,
    channel_mask_max=0xFFFFFFFF,
    hv_settle_ticks=700,  # longer than a frame: what comes meanwhile is evaluated
    heartbeat_ticks_max=3_000_000,
    edge_window_ticks=5000,
    pulse_ticks_min=4,
    channel_edges_max=100_000,
    total_edges_max=4_000_000,
    emission_ticks_max=120_000,
    duty_share_max=65_536,
    duty_ticks_max=400_000,
)

BIT_TICKS = 6
RAMP_SAMPLES = 9
UART = UartTiming.of(PARAMETERS)
RAMP_TICKS = RAMP_SAMPLES * BIT_TICKS
SETTLE_TICKS = PARAMETERS.hv_settle_ticks
IDLE_WORD = 0x96969696
FRAME_TICKS = frame_ticks(frames.FRAME_BYTES)
JUDGED_TICKS = 4  # from the rise of chip select to the tick in which a frame is carried out


MODEL = partial(GatewareModel, lines=True)  # that notes every change of MISO and of the UART's line too
STEPS = {"permit": PermitStep, "trigger": TriggerStep, "exchange": ExchangeStep, "uart": UartStep}  # as files have them
LINES = ("alive_ticks", "waiting_ticks", "fault_ticks", "miso_ticks", "uart_ticks")


def open_gateware(back_end):
    return back_end(PARAMETERS)


def give(gateware, method, tick, *others):
    """Do a step of a script to a back-end."""
    if method == "permit":
        level, which = others
        gateware.permit(tick, level=level, which=which)
    else:
        getattr(gateware, method)(tick, *others)


class Script:
    """A list of (method of the gateware, arguments), written as one would drive the pins."""

    performed = None  # the last one that was performed on any back-end

    def __init__(self):
        self.steps = []
        self.tick = READY_TICKS
        self.sequence = 0
        self.uart_sequence = 0
        self._uart_from = READY_TICKS
        self.slack_ticks = 0  # of the next frames: SCK slower than it might be
        self._trigger_from = READY_TICKS
        self._buffer = bytearray(frames.LOAD_FRAME_BYTES)

    def wait(self, ticks):
        self.tick += ticks

    def permit(self, level, tick=None, which=Permit.RUN):
        self.steps.append(("permit", (self.tick if tick is None else tick, level, which)))

    def trigger(self, tick=None, high_ticks=TRIGGER_HIGH_TICKS):
        """Raise the trigger, now or as soon as it may rise again after a tick to come; returns its tick."""
        tick = max(self.tick if tick is None else tick, self._trigger_from)
        self._trigger_from = tick + TRIGGER_PERIOD_TICKS
        self.steps.append(("trigger", (tick, high_ticks)))
        return tick

    def exchange(self, frame):
        """One chip-select assertion; returns the tick of its release."""
        release = self.tick + max(frame_ticks(len(frame)), SELECT_TO_SCK_TICKS) + self.slack_ticks
        self.steps.append(("exchange", (self.tick, release, bytes(frame))))
        self.tick = release + SELECT_HIGH_TICKS
        return release

    def uart(self, *wires, tick=None):
        """Send bytes over the UART, now or as soon as it is free, while the script goes on; the tick in which that ends."""
        begin = max(self.tick if tick is None else tick, self._uart_from)
        wire = b"".join(wires)
        self.steps.append(("uart", (begin, wire)))
        self._uart_from = UART.bit_tick(begin, len(wire), 0)
        return self._uart_from

    def uart_frame(self, pack, *arguments, **named):
        """The bytes of a frame by the UART, with two zeros before it as the host sends them."""
        self.uart_sequence += 1
        end = pack(self._buffer, 0, self.uart_sequence, *arguments, **named)
        return b"\0\0" + cobs.encode(bytes(self._buffer[:end])) + b"\0"

    @property
    def uart_is_free(self):
        return self.tick >= self._uart_from

    def wait_for_the_uart(self, ticks=0):
        """Until what it was given to send has come, and some more."""
        self.tick = max(self.tick, self._uart_from) + ticks

    def packed(self, pack, *arguments, **named):
        self.sequence += 1
        end = pack(self._buffer, 0, self.sequence, *arguments, **named)
        return bytes(self._buffer[:end])

    def send(self, pack, *arguments, **named):
        return self.exchange(self.packed(pack, *arguments, **named))

    def status(self):
        return self.send(frames.pack_nop)

    def control(self, command):
        return self.send(frames.pack_control, command)

    def settings(self, bit_period=BIT_TICKS << 16, ramp_samples=RAMP_SAMPLES):
        for permit in Permit:
            self.permit(True, which=permit)
        for register, value in (
            (Register.IDLE_WORD, IDLE_WORD),
            (Register.BIT_PERIOD, bit_period),
            (Register.RAMP_SAMPLES, ramp_samples),
        ):
            self.send(frames.pack_write, register, value)

    def arm(self):
        self.send(frames.pack_unlock, BUILD_HASH)
        release = self.control(Control.ARM)
        self.wait(SETTLE_TICKS + RAMP_TICKS + 10)
        return release

    def upload(self, slot, words):
        data = memoryview(np.ascontiguousarray(words, "<u4")).cast("B")
        for chunk in range(-(-len(words) // 125)):
            self.send(frames.pack_load, chunk, data[500 * chunk : 500 * (chunk + 1)])
        return self.store(slot, words)

    def store(self, slot, words):
        words = np.ascontiguousarray(words, "<u4")
        release = self.send(frames.pack_store, slot, len(words), zlib.crc32(words))
        self.wait(len(words))  # until the slot is checked, but for a few ticks that a frame takes anyway
        return release

    def perform(self, back_end, late=None):
        """Answers and capture; `late`: that kind of step comes one tick late."""
        Script.performed = self
        gateware = open_gateware(back_end)
        answers = []
        for method, arguments in self.steps:
            later = int(method == late)
            if method == "exchange":
                select_tick, release_tick, mosi = arguments
                answers.append(bytearray(len(mosi)))
                gateware.exchange(select_tick + later, release_tick + later, mosi, memoryview(answers[-1]))
            else:
                tick, *others = arguments
                give(gateware, method, tick + later, *others)
        gateware.advance(self.end_tick)
        return answers, gateware.take_capture()

    @property
    def end_tick(self):
        return max(self.tick, self._uart_from)

    def kept(self):
        """As `haptic-panel gateware waves` reads it."""
        return InputScript(PARAMETERS, self.end_tick, [STEPS[method](*arguments) for method, arguments in self.steps])


COMPILED = ThreadPoolExecutor(1)  # the compiled Verilog lets go of the interpreter: the model runs meanwhile


def perform_on_both(script, rtl):
    """What comes of a script on the model and on the compiled Verilog."""
    compiled = COMPILED.submit(script.perform, rtl)
    return script.perform(MODEL), compiled.result()


def assert_same(left, right):
    """Answer by answer and change by change."""
    (answers, capture), (other_answers, other_capture) = left, right
    for number, (answer, other) in enumerate(zip(answers, other_answers, strict=True)):
        assert answer == other, f"answer {number}: {readable(answer)} and {readable(other)}"
    assert_same_capture(capture, other_capture)


def assert_same_capture(capture, other):
    for name in ("focus_ticks", "ticks", "words", "hv", *LINES):
        values, others = getattr(capture, name), getattr(other, name)
        assert values.dtype == others.dtype
        assert np.array_equal(values, others), f"{name} differ: {difference(values, others)}"


def difference(values, others):
    shorter = min(len(values), len(others))
    index = next((i for i in range(shorter) if values[i] != others[i]), shorter)
    return f"from change {index}: {values[index : index + 3]} of {len(values)} and {others[index : index + 3]} of {len(others)}"


def readable(answer):
    return parse_status(answer) if len(answer) >= frames.FRAME_BYTES else bytes(answer)
