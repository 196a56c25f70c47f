"""A host for tests that drives the pins of the gateware model: frames, triggers, captures."""

import zlib

import numpy as np

from controller.device.fpga import frames
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import FRAME_BYTES, Play
from controller.device.fpga.registers import CHUNK_WORDS, TRIGGER_LATENCY_TICKS, Control, Register, Result, State
from controller.device.fpga.status import parse_status
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.pin_timing import frame_ticks

CLOCK_HZ = 20_000_000
HASH = 0xC0FFEE
SLOTS = 2
HEARTBEAT_TICKS = 400_000
SETTLE_TICKS = 60
PARAMETERS = BuildParameters(
    clock_hz=CLOCK_HZ,
    slots=SLOTS,
    build_hash=HASH,
    board=int.from_bytes(b"SIM ", "little"),
    bit_period_reset=40 << 16,
    ramp_samples_reset=5000,
    channel_mask_max=0xFFFFFFFF,
    hv_settle_ticks=SETTLE_TICKS,
    heartbeat_ticks_max=HEARTBEAT_TICKS,
    edge_window_ticks=CLOCK_HZ // 4,
    pulse_ticks_min=8,
    channel_edges_max=125_000,
    total_edges_max=4_000_000,
    emission_ticks_max=CLOCK_HZ // 100,
    duty_share_max=65_536,
    duty_ticks_max=CLOCK_HZ,
)
BIT_TICKS = 10  # 2 MHz, the fastest
SLOWEST_BIT_TICKS = 200
RAMP_SAMPLES = 8
IDLE = 0x0F0F0F0F
LATENCY = TRIGGER_LATENCY_TICKS + 1  # ticks from the trigger's rise to the first word: the pin is sampled as its tick ends
COMMAND_TICKS = 6  # from the tick in which a TRIGGER command is carried out
NOW_TICKS = 14  # from the tick in which a play without a wait is carried out
FETCHED_TICKS = 5  # from there until a trigger's rise can start it
ON = State.RUN_PERMIT | State.TEMPERATURE_GOOD | State.HEARTBEAT
ARMED = ON | State.ARMED | State.HV_ENABLE
WORDS = np.arange(1, 31, dtype=np.uint32)
T = len(WORDS) * BIT_TICKS


class Host:
    """Sends frames to a model as fast as its timing allows; `tick` is when the last one is executed."""

    def __init__(self, parameters=PARAMETERS, start=10, permits=Permit):
        self.model = GatewareModel(parameters)
        self.tick = start
        self.ticks_per_byte = 48
        self.sequence = 0
        for permit in permits:
            self.model.permit(1, level=True, which=permit)
        self._buffer = bytearray(frames.LOAD_FRAME_BYTES)

    def exchange(self, frame):
        answer = bytearray(len(frame))
        release = self.tick + max(5 + len(frame) * self.ticks_per_byte, frame_ticks(0))
        self.model.exchange(self.tick, release, frame, memoryview(answer))
        self.tick = release + 4
        return answer

    def packed(self, pack, *arguments, **named):
        self.sequence += 1
        end = pack(self._buffer, 0, self.sequence, *arguments, **named)
        return bytes(self._buffer[:end])

    def send(self, pack, *arguments, **named):
        """Send a frame; returns the status received with it, None if the frame is too short for one."""
        answer = self.exchange(self.packed(pack, *arguments, **named))
        return parse_status(answer) if len(answer) >= FRAME_BYTES else None

    def status(self):
        return self.send(frames.pack_nop)

    def result(self, pack, *arguments, **named):
        self.send(pack, *arguments, **named)
        return self.status().result

    def control(self, command):
        return self.result(frames.pack_control, command)

    def write(self, register, value):
        return self.result(frames.pack_write, register, value)

    def read(self, address):
        self.send(frames.pack_read, address)
        status = self.status()
        assert status.result is Result.OK
        return status.data

    def read_time(self, low):
        return self.read(low) | self.read(low + 1) << 32

    def load(self, words, chunk=0):
        self.send(frames.pack_load, chunk, memoryview(np.asarray(words, "<u4")).cast("B"))

    def upload(self, slot, words=WORDS, crc=None):
        """Send an upload, with STORE last; its result is not yet fetched."""
        for chunk in range(-(-len(words) // CHUNK_WORDS)):
            self.load(words[CHUNK_WORDS * chunk : CHUNK_WORDS * (chunk + 1)], chunk)
        crc = zlib.crc32(np.asarray(words, "<u4").tobytes()) if crc is None else crc
        self.send(frames.pack_store, slot, len(words), crc)

    def store(self, slot, words=WORDS):
        self.upload(slot, words)
        assert self.status().result is Result.OK
        self.tick += len(words)

    def settings(self, **values):
        values = {"IDLE_WORD": IDLE, "BIT_PERIOD": BIT_TICKS << 16, "RAMP_SAMPLES": RAMP_SAMPLES} | values
        for name, value in values.items():
            assert self.write(Register[name], value) is Result.OK, name

    def unlock_and_arm(self):
        self.send(frames.pack_unlock, HASH)
        self.send(frames.pack_control, Control.ARM)
        return self.status().result

    def arm(self, **settings):
        self.settings(**settings)
        assert self.unlock_and_arm() is Result.OK
        self.tick += SETTLE_TICKS + RAMP_SAMPLES * SLOWEST_BIT_TICKS
        return self

    def play(self, slot=0, **named):
        """Queue a play and wait until a trigger can start it; returns the tick in which it was executed."""
        self.send(frames.pack_play, Play(slot, **named))
        carried_out = self.tick
        assert self.status().result is Result.OK
        return carried_out

    def trigger(self, high_ticks=4):
        tick = self.tick
        self.model.trigger(tick, high_ticks)
        self.tick += 8  # high for four clocks, low for four
        return tick + LATENCY

    def pins_after(self, ticks):
        self.tick += ticks
        self.model.advance(self.tick)
        return self.model.take_capture()


def word_at(capture, tick):
    """Channel pins at a tick, in a capture that begins before it."""
    return int(capture.words[np.searchsorted(capture.ticks, tick, "right") - 1])


def words_from(capture, start, number, bit_ticks=BIT_TICKS):
    return [word_at(capture, start + bit_ticks * n) for n in range(number)]
