"""The gateware as a model: the same bits at the same tick as the Verilog, going from change to change.

Ticks are clocks since reset was released. An input that changes at tick t is sampled by the clock
edge that ends tick t; `haptic_core.v` says through how many registers it then passes. Within a tick
everything is decided from the state as it was, as flip-flops do.
"""

from __future__ import annotations

from bisect import insort
from collections.abc import Callable
from enum import Enum
from functools import partial
from typing import NamedTuple

from controller.fpga.capture import Capture
from controller.fpga.frames import FRAME_BYTES, HEADER, Status, pack_status
from controller.fpga.gateware import InputTiming
from controller.fpga.model_decoder import Frame, judge
from controller.fpga.model_gate import PIN_TICKS, Gate, OutputGate
from controller.fpga.model_player import Buffers, Play, Player
from controller.fpga.model_registers import RegisterFile
from controller.fpga.registers import CHUNKS, PROTOCOL_VERSION, Control, FrameType, Register, Result, State

INPUT_TICKS = 2  # two flip-flops: a pin's edge at t is seen in the state of t + 2
JUDGE_TICKS = 4  # from the rise of chip select to the tick in which its frame is carried out


class _Kind(Enum):
    PERMIT = 0
    TRIGGER = 1
    ENDED = 2
    FRAME = 3


class _Event(NamedTuple):
    tick: int
    kind: _Kind
    level: bool = False  # of the permit
    frame: Frame = Frame(Result.OK)
    landing_busy: bool = False  # when the frame began


Effect = Callable[[int], None]


class GatewareModel:
    """`haptic_core.v` with its pins: a `Gateware`."""

    def __init__(self, clock_hz: int, slots: int, build_hash: int, heartbeat_ticks_max: int) -> None:
        self._registers = RegisterFile(clock_hz, slots, build_hash, heartbeat_ticks_max)
        self._gate = OutputGate(self._registers)
        self._buffers = Buffers(slots)
        self._player = Player()
        self._now = 0
        self._timing = InputTiming()
        self._events: list[_Event] = []
        self._result = Result.OK
        self._sequence = 0
        self._data = 0
        self._triggers = 0
        self._ignored = 0
        self._emissions = 0
        self._frame_errors = 0

    @property
    def now(self) -> int:
        """The tick the model has come to."""
        return self._now

    def advance(self, tick: int) -> None:
        """Go to `tick`; a tick already passed changes nothing."""
        while (change := self.next_change()) is not None and change < tick:
            self._step(change)
            self._now = change + 1
        self._now = max(self._now, tick)

    def next_change(self) -> int | None:
        """The next tick in which something happens without further input; None if nothing will."""
        event = self._events[0].tick if self._events else None
        ticks = (event, self._player.next_change(), self._gate.next_change(self._now))
        return min((tick for tick in ticks if tick is not None), default=None)

    def permit(self, tick: int, level: bool) -> None:
        """Drive the run permit pin to `level` at `tick`; it is low at tick 0."""
        self._expect(_Event(tick + INPUT_TICKS - 1, _Kind.PERMIT, level=level))

    def trigger(self, tick: int) -> None:
        """Raise the trigger pin at `tick`."""
        self._timing.trigger(tick)
        self._expect(_Event(tick + INPUT_TICKS, _Kind.TRIGGER))

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """One chip-select assertion; see `Gateware`."""
        if select_tick + INPUT_TICKS < self._now:
            raise ValueError(f"a frame for tick {select_tick} after the model has gone to tick {self._now}")
        self._timing.frame(select_tick, release_tick, len(mosi))
        self.advance(select_tick + INPUT_TICKS)
        answer = bytearray(max(FRAME_BYTES, len(miso)))
        pack_status(answer, 0, self.status())
        miso[:] = answer[: len(miso)]
        sent = memoryview(mosi).cast("B")
        if not len(sent):
            return
        frame = judge(sent)
        landing_busy = self._player.uses(self._buffers.landing)
        if frame.loaded_words and not landing_busy:
            self._buffers.write(frame.argument, sent[HEADER.size : HEADER.size + 4 * frame.loaded_words])
        self._expect(_Event(release_tick + JUDGE_TICKS, _Kind.FRAME, frame=frame, landing_busy=landing_busy))

    def take_capture(self) -> Capture:
        """Everything that happened on the pins since the last capture, up to now."""
        return self._gate.pins.take(self._now)

    def _expect(self, event: _Event) -> None:
        if event.tick < self._now:
            raise ValueError(f"{event.kind.name} for tick {event.tick} after the model has gone to tick {self._now}")
        insort(self._events, event, key=lambda entry: entry.tick)

    def status(self) -> Status:
        """What a frame whose chip select fell two ticks ago would be answered."""
        gate, player = self._gate, self._player
        bits = (
            (State.ARMED, gate.state is Gate.ON),
            (State.RAMPING, gate.ramping),
            (State.PLAYING, player.playing),
            (State.REPEATING, player.repeating),
            (State.PENDING, player.pending is not None),
            (State.LANDING_BUSY, player.uses(self._buffers.landing)),
            (State.RUN_PERMIT, gate.permit),
            (State.HEARTBEAT, self._now < gate.silent_from),
            (State.HV_ENABLE, gate.pins.hv_at(self._now)),
        )
        state = State(sum(bit for bit, holds in bits if holds))
        return Status(
            self._result,
            self._sequence,
            state,
            gate.faults,
            self._data,
            self._triggers & 0xFFFFFFFF,
            self._now,
            self._emissions & 0xFFFFFFFF,
        )

    def _step(self, tick: int) -> None:
        """All that happens in one tick; what comes later here wins, as in the Verilog."""
        cause = self._gate.cause(tick)
        effect: Effect | None = None
        permit = self._gate.permit
        trigger = False
        ended = False
        while self._events and self._events[0].tick == tick:
            event = self._events.pop(0)
            if event.kind is _Kind.PERMIT:
                permit = event.level
            elif event.kind is _Kind.FRAME:
                effect = self._judged(tick, event)
            else:
                trigger |= event.kind is _Kind.TRIGGER
                ended |= event.kind is _Kind.ENDED
        if ended and not cause:
            self._emissions += 1
            self._gate.pins.focus(tick + 1, self._registers.bit_ticks)
        self._move_player(tick, trigger)
        self._gate.end_ramp(tick)
        if effect:
            effect(tick)
        if cause:
            self._gate.shut(tick, cause)
            self._player.drop()
            self._events = [event for event in self._events if event.kind is not _Kind.ENDED]
        self._gate.permit = permit

    def _judged(self, tick: int, event: _Event) -> Effect | None:
        """Result of a frame from the state as it was; its effect comes after everything else of the tick."""
        frame = event.frame
        effect: Effect | None = None
        self._result = frame.refusal
        if frame.refusal is not Result.OK:
            self._frame_errors += 1
            return None
        self._sequence = frame.sequence
        self._gate.hear(tick)
        if frame.kind == FrameType.READ:
            self._result = self._read(frame.argument)
        elif frame.kind == FrameType.WRITE and frame.argument == Register.CONTROL:
            self._result, effect = self._control(frame.words)
        elif frame.kind == FrameType.WRITE:
            disarmed = self._gate.state is Gate.OFF
            self._result = self._registers.write(frame.argument, frame.words[0], disarmed=disarmed)
        elif frame.kind == FrameType.LOAD:
            self._result = self._load(event)
        elif frame.kind == FrameType.STORE:
            self._result = self._buffers.store(frame.argument, frame.words[0])
        elif frame.kind == FrameType.PLAY:
            self._result, effect = self._play(frame)
        elif frame.kind != FrameType.NOP:
            self._result = Result.UNKNOWN_TYPE
        return effect

    def _read(self, address: int) -> Result:
        counters = {
            Register.CONTROL: 0,
            Register.FAULT: self._gate.faults,
            Register.TRIGGERS_IGNORED: self._ignored,
            Register.EMISSIONS: self._emissions,
            Register.FRAME_ERRORS: self._frame_errors,
            Register.SLOTS_LOADED: self._buffers.loaded(),
        }
        if address not in set(Register):
            return Result.UNKNOWN_REGISTER
        value = self._registers.read(address)
        self._data = (counters[Register(address)] if value is None else value) & 0xFFFFFFFF
        return Result.OK

    def _control(self, words: tuple[int, ...]) -> tuple[Result, Effect | None]:
        command, version, build_hash = words[:3]
        if command == Control.ARM:
            if (version, build_hash) != (PROTOCOL_VERSION, self._registers.build_hash):
                return Result.BAD_KEY, None
            if self._gate.state is not Gate.OFF:
                return Result.ARMED, None
            if self._gate.faults:
                return Result.FAULTED, None
            return (Result.OK, self._gate.arm) if self._gate.permit else (Result.NO_PERMIT, None)
        effects: dict[int, Effect] = {
            Control.DISARM: self._disarm,
            Control.CLEAR: lambda _: self._gate.clear(),
            Control.STOP: lambda _: self._player.stop(),
        }
        effect = effects.get(command)
        return (Result.OK if effect else Result.BAD_VALUE), effect

    def _load(self, event: _Event) -> Result:
        if event.frame.argument >= CHUNKS:
            return Result.BAD_CHUNK
        if event.landing_busy:
            return Result.BUSY
        self._buffers.count(event.frame.argument, event.frame.loaded_words)
        return Result.OK

    def _play(self, frame: Frame) -> tuple[Result, Effect | None]:
        slot, (count, period_ticks) = frame.argument, frame.words[:2]
        if slot >= len(self._buffers.slot_buffer):
            return Result.BAD_SLOT, None
        if self._gate.faults:
            return Result.FAULTED, None
        if self._gate.state is not Gate.ON:
            return Result.NOT_ARMED, None
        length_words = self._buffers.slot_words[slot]
        if not length_words:
            return Result.EMPTY_SLOT, None
        if self._player.pending:
            return Result.BUSY, None
        if count != 1 and period_ticks < length_words * self._registers.bit_ticks:
            return Result.BAD_VALUE, None
        play = Play(self._buffers.slot_buffer[slot], length_words, count, period_ticks)
        return Result.OK, partial(self._await_trigger, play)

    def _await_trigger(self, play: Play, _tick: int) -> None:
        self._player.pending = play

    def _move_player(self, tick: int, trigger: bool) -> None:
        """Ends, next emissions of a repetition and triggers of one tick."""
        player = self._player
        last, due = player.is_last(tick), player.is_due(tick)
        ready = player.pending if trigger and not player.playing else None
        if last:
            player.end()
            self._expect(_Event(tick + PIN_TICKS, _Kind.ENDED))
            self._gate.idle(tick + 1)
        if trigger:
            self._triggers += 1
            self._ignored += ready is None
        play = ready or (player.running if due else None)
        if ready:
            player.pending = None
        if play:
            player.start(play, tick, self._registers.bit_ticks, again=ready is None)
            self._gate.play(tick + 1, self._buffers.waveform(play.buffer, play.length_words))

    def _disarm(self, tick: int) -> None:
        self._player.drop()
        self._gate.disarm(tick)
