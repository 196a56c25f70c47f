"""The gateware as a model: the same bits at the same tick as the Verilog, going from change to change.

Ticks are clocks since reset was released. An input that changes at tick t is sampled by the clock
edge that ends tick t; `haptic_core.v` says through how many registers it then passes. Within a tick
everything is decided from the state as it was, as flip-flops do.
"""

from __future__ import annotations

from bisect import insort
from enum import Enum
from typing import NamedTuple

from controller.fpga.build_parameters import Parameters
from controller.fpga.capture import Capture
from controller.fpga.frames import ECHO_DELAY_BYTES, FRAME_BYTES, HEADER
from controller.fpga.registers import CHUNK_WORDS, FILTER_TICKS, Fault, FrameType, Register, Result, Start, State
from controller.fpga.status import Status, pack_status
from controller.gateware_model.commands import Commands
from controller.gateware_model.decoder import Frame, decode
from controller.gateware_model.gate import PIN_TICKS, Gate
from controller.gateware_model.gateware import TRIGGER_HIGH_TICKS, InputTiming, Permit, Port, UartTiming, sck_rise_tick
from controller.gateware_model.lines import Lines
from controller.gateware_model.player import DECISION_TICKS, Play
from controller.gateware_model.uart import BEGIN_TICKS, BYTE_TO_PULSE_TICKS, DELIVER_TICKS, UartSide

INPUT_TICKS = 2  # two flip-flops: a pin's edge at t is seen in the state of t + 2
TRIGGER_TICKS = INPUT_TICKS + FILTER_TICKS - 1  # until the pin has been seen high for long enough
JUDGE_TICKS = 4  # from the rise of chip select to the tick in which its frame is carried out
LANDED_TICKS = 4  # from the rise of SCK that ends a word of a LOAD to the tick in which it is written
EMPTY_TICKS = 2  # from the rise of chip select to the last tick of a selection without any bit
RATE_TICKS = 1  # beyond the time between the edges of chip select, for which a LOAD is found to have lasted


class _Kind(Enum):
    PERMIT = 0
    PERMIT_NOTED = 1
    TRIGGER = 2
    ENDED = 3
    FRAME = 4
    UNDERRUN = 5
    LANDING = 6  # the first word of a LOAD is written
    UART_BYTE = 7
    UART_JUDGED = 8
    UART_BEGIN = 9  # the core's turn is the UART's


_UARTS_TURN = (_Kind.UART_BEGIN, _Kind.LANDING, _Kind.FRAME)


class _Event(NamedTuple):
    tick: int
    kind: _Kind
    permit: Permit = Permit.RUN
    level: bool = False  # of the permit
    frame: Frame = Frame(Result.OK)
    ticks: int = 0  # that the frame took
    landing_busy: bool = False  # when it began
    landing_live: bool = False
    queue_full: bool = False
    port: Port = Port.SPI
    byte: int = 0


class GatewareModel:
    """`haptic_core.v` with its pins: a `Gateware`.

    Parameters
    ----------
    parameters : Parameters
        Of the module.
    lines : bool
        Captures show every change of MISO and of the UART's line too.
    """

    def __init__(self, parameters: Parameters, *, lines: bool = False) -> None:
        self._commands = Commands(parameters)
        self._gate = self._commands.gate
        self._player = self._commands.player
        self._queue = self._commands.queue
        self._buffers = self._commands.buffers
        self._registers = self._commands.registers
        self._telemetry = self._commands.telemetry
        self._now = 0
        self._timing = InputTiming()
        self._events: list[_Event] = []
        self._permit_pins = dict.fromkeys(Permit, False)
        self._uart = UartSide(UartTiming.of(parameters))
        self._spi_until = 0  # the last tick in which a frame of the SPI has the core, as far as is known
        self._lines = Lines(noting_frames=lines)

    @property
    def now(self) -> int:
        """The tick the model has come to."""
        return self._now

    def advance(self, tick: int) -> None:
        """Go to `tick`; a tick already passed changes nothing."""
        while (change := self.next_change()) is not None and change < tick:
            self._lines.settle(change)
            self._step(change)
            self._now = change + 1
            self._lines.note(self._now, fault=bool(self._gate.faults), waiting_from=self._waiting_from())
            self._gate.limits.settle(change - PIN_TICKS)
        self._now = max(self._now, tick)

    def next_change(self) -> int | None:
        """The next tick in which something happens without further input; None if nothing will."""
        event = self._events[0].tick if self._events else None
        ticks = (event, self._player.next_change(), self._gate.next_change(self._now), self._head_tick(), self._arrival_tick())
        return min((tick for tick in ticks if tick is not None), default=None)

    def permit(self, tick: int, level: bool, which: Permit = Permit.RUN) -> None:
        """Drive a permit pin to `level` at `tick`; both are low at tick 0."""
        self._expect(_Event(tick + INPUT_TICKS - 1, _Kind.PERMIT, which, level))
        if level != self._permit_pins[which]:
            self._permit_pins[which] = level
            self._expect(_Event(tick + INPUT_TICKS, _Kind.PERMIT_NOTED))

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:
        """Raise the trigger pin at `tick`."""
        self._timing.trigger(tick, high_ticks)
        self._telemetry.trigger_pin.append((tick + INPUT_TICKS, tick + INPUT_TICKS + high_ticks))
        if high_ticks >= FILTER_TICKS:
            self._expect(_Event(tick + TRIGGER_TICKS, _Kind.TRIGGER))

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """One chip-select assertion; see `Gateware`."""
        if select_tick + INPUT_TICKS < self._now:
            raise ValueError(f"a frame for tick {select_tick} after the model has gone to tick {self._now}")
        self._timing.frame(select_tick, release_tick, len(mosi))
        self.advance(select_tick + INPUT_TICKS)
        answer = bytearray(max(FRAME_BYTES, len(miso)) + 1)
        pack_status(answer, 0, self.status())
        sent = memoryview(mosi).cast("B")
        if len(sent) >= FRAME_BYTES and sent[2] == FrameType.TEST:
            answer[FRAME_BYTES : len(sent) + 1] = sent[FRAME_BYTES - ECHO_DELAY_BYTES : len(sent) + 1 - ECHO_DELAY_BYTES]
        miso[:] = answer[: len(miso)]
        self._lines.exchange(select_tick, release_tick, answer, len(miso))
        self._spi_until = release_tick + (JUDGE_TICKS if len(sent) else EMPTY_TICKS)
        self._put_the_uart_off()
        if not len(sent):
            return
        frame = decode(sent)
        commands = self._commands
        busy, live = commands.landing_busy, commands.landing_live
        if frame.loaded_words:
            written = sck_rise_tick(select_tick, release_tick, len(sent), 8 * (HEADER.size + 4) - 1) + LANDED_TICKS
            self._expect(_Event(written, _Kind.LANDING, frame=frame, landing_busy=busy, landing_live=live))
        ticks = release_tick - select_tick + RATE_TICKS
        self._expect(
            _Event(
                release_tick + JUDGE_TICKS,
                _Kind.FRAME,
                frame=frame,
                ticks=ticks,
                landing_busy=busy,
                landing_live=live,
                queue_full=self._queue.full,
            )
        )

    def uart(self, tick: int, wire: bytes) -> int:
        """Send bytes over the UART, back to back, the first start bit at `tick`; the tick in which the last stop bit ends."""
        timing = self._uart.timing
        for number, byte in enumerate(wire):
            heard = timing.heard_tick(timing.bit_tick(tick, number, 0))
            self._expect(_Event(heard + BYTE_TO_PULSE_TICKS, _Kind.UART_BYTE, byte=byte))
        return timing.bit_tick(tick, len(wire), 0)

    def take_capture(self) -> Capture:
        """Everything that happened on the pins since the last capture, up to now."""
        capture = self._gate.pins.take(self._now)
        self._lines.settle(self._now)
        return self._lines.take(capture, self._now, self._uart.take_tx(self._now))

    def _expect(self, event: _Event) -> None:
        if event.tick < self._now:
            raise ValueError(f"{event.kind.name} for tick {event.tick} after the model has gone to tick {self._now}")
        insort(self._events, event, key=lambda entry: entry.tick)

    def _put_the_uart_off(self) -> None:
        """A frame of the SPI begins in this tick: one of the UART that was handed on is handed on again behind it."""
        if self._uart.pending is None:
            return
        self._events = [event for event in self._events if event.port is Port.SPI or event.kind not in _UARTS_TURN]
        self._expect(_Event(self._spi_until + 1, _Kind.UART_BEGIN, port=Port.UART))

    def _hand_on(self, tick: int) -> None:
        """The core is the UART's from this tick on, as long as no frame of the SPI begins."""
        frame, commands = self._uart.pending, self._commands
        assert frame
        event = _Event(
            tick + frame.payload_words + DELIVER_TICKS,
            _Kind.FRAME,
            frame=frame,
            landing_busy=commands.landing_busy,
            landing_live=commands.landing_live,
            queue_full=self._queue.full,
            port=Port.UART,
        )
        self._expect(event)
        if frame.loaded_words:
            self._expect(event._replace(tick=tick + 1, kind=_Kind.LANDING))

    def _hear(self, tick: int, byte: int) -> None:
        """A byte has come by the UART."""
        begins, frame = self._uart.hear(byte)
        if begins:
            answer = bytearray(FRAME_BYTES)
            pack_status(answer, 0, self.status(Port.UART, tick))
            self._uart.answer(tick, bytes(answer))
        if frame is not None:
            self._expect(_Event(tick + 1, _Kind.UART_JUDGED, frame=frame))

    def status(self, port: Port = Port.SPI, tick: int | None = None) -> Status:
        """What a link is answered whose frame's beginning is seen in this tick, now unless told otherwise."""
        gate, player, telemetry = self._gate, self._player, self._telemetry
        now = self._now if tick is None else tick
        link = telemetry.links[port]
        bits = (
            (State.ARMED, gate.state is Gate.ON),
            (State.RAMPING, gate.ramping),
            (State.PLAYING, player.playing),
            (State.REPEATING, player.repeating),
            (State.PENDING, bool(self._queue.plays)),
            (State.LANDING_BUSY, self._commands.landing_busy),
            (State.RUN_PERMIT, gate.permits[Permit.RUN]),
            (State.HEARTBEAT, now < gate.silent_from),
            (State.HV_ENABLE, gate.pins.hv_at(now)),
            (State.TEMPERATURE_GOOD, gate.permits[Permit.TEMPERATURE]),
            (State.CHECKING, self._buffers.checking(now)),
            (State.DELAYED, player.delayed),
            (State.WAITING, self._waiting(now)),
        )
        state = State(sum(bit for bit, holds in bits if holds))
        return Status(
            link.result,
            link.sequence,
            state,
            gate.faults,
            link.data,
            telemetry.counts[Register.TRIGGERS] & 0xFFFFFFFF,
            now,
            telemetry.counts[Register.EMISSIONS] & 0xFFFFFFFF,
            len(self._queue.plays),
            self._buffers.chunks(),
            telemetry.counts[Register.TRIGGERS_IGNORED] & 0xFFFF,
        )

    def _waiting(self, tick: int) -> bool:
        begin = self._waiting_from()
        return begin is not None and tick >= begin

    def _waiting_from(self) -> int | None:
        """The tick from which on the head waits for a trigger, if nothing else happens."""
        plays, player = self._queue.plays, self._player
        if not plays or plays[0].start is not Start.TRIGGER or self._gate.state is not Gate.ON or player.playing or player.delayed:
            return None
        return max(self._queue.head_from, player.free_from)

    def _free(self, tick: int) -> bool:
        """A play at the head may begin."""
        return self._gate.state is Gate.ON and self._player.settled(tick) and not self._player.delayed

    def _head_tick(self) -> int | None:
        """The next tick in which the head may begin, or be missed, without a trigger."""
        queue, player = self._queue, self._player
        if not queue.plays or queue.plays[0].start is Start.TRIGGER:
            return None
        head = queue.plays[0]
        if head.start is Start.TIME:
            return max(queue.head_from + 1, head.when - DECISION_TICKS, self._now)
        if player.playing or player.delayed or player.remaining or self._gate.state is not Gate.ON:
            return None
        return max(queue.head_from, player.free_from, self._now)

    def _arrival_tick(self) -> int | None:
        """The tick in which a live emission comes to a word that was not there when it was looked for last."""
        player = self._player
        if not player.playing or not player.live or player.running is None or player.known_words >= player.running.length:
            return None
        return max(player.start + (player.known_words * self._registers.bit_period >> 16), self._now)

    def _arrive(self) -> bool:
        """Give words to the pins that have arrived since; False if the one that is due has not."""
        player, known = self._player, self._player.known_words
        assert player.running
        chunk, within = divmod(known, CHUNK_WORDS)
        there = self._buffers.chunk_words[chunk]
        if within >= there:
            return False
        end = min(known - within + there, player.running.length)
        waveform = self._buffers.waveform(player.running.buffer)
        # copied: a later chunk is written into the same buffer while this one is shown
        words = player.running.words(waveform, self._registers.idle_word, known, end).copy()
        self._gate.play(player.start, words, known)
        player.known_words = end
        return True

    def _land(self, event: _Event) -> None:
        """Words of a LOAD are written, unless what is there plays; its chunk does not count until it is accepted."""
        chunk = event.frame.argument
        if not event.landing_busy and not (event.landing_live and self._buffers.chunk_words[chunk]):
            self._buffers.write(chunk, memoryview(event.frame.payload))

    def _step(self, tick: int) -> None:
        """All that happens in one tick; what comes later here wins, as in the Verilog."""
        cause = self._gate.cause(tick)
        trigger = ended = noted = False
        if tick == self._arrival_tick() and not self._arrive():
            self._expect(_Event(tick + 1, _Kind.UNDERRUN))
        frame: _Event | None = None
        landing: _Event | None = None
        judged: Frame | None = None
        permits = dict(self._gate.permits)
        while self._events and self._events[0].tick == tick:
            event = self._events.pop(0)
            if event.kind is _Kind.PERMIT:
                permits[event.permit] = event.level
            elif event.kind is _Kind.PERMIT_NOTED:
                noted = True
            elif event.kind is _Kind.UNDERRUN:
                cause |= Fault.UNDERRUN if self._gate.live(tick) else Fault(0)
            elif event.kind is _Kind.FRAME:
                frame = event
            elif event.kind is _Kind.LANDING:
                landing = event
            elif event.kind is _Kind.UART_BYTE:
                self._hear(tick, event.byte)
            elif event.kind is _Kind.UART_JUDGED:
                judged = event.frame
            elif event.kind is _Kind.UART_BEGIN:
                self._hand_on(tick)
            else:
                trigger |= event.kind is _Kind.TRIGGER
                ended |= event.kind is _Kind.ENDED
        effect = None
        if frame is not None:
            effect = self._commands.carry_out(
                tick,
                frame.port,
                frame.frame,
                frame.ticks,
                landing_busy=frame.landing_busy,
                landing_live=frame.landing_live,
                queue_full=frame.queue_full,
            )
            if frame.port is Port.UART:
                self._uart.pending = None
        if landing is not None:
            self._land(landing)
        if judged is not None and judged.refusal is not Result.OK:
            self._commands.refuse(Port.UART, judged.refusal)
        elif judged is not None:
            self._uart.pending = judged
            begin = max(tick + BEGIN_TICKS - 1, self._spi_until + 1)
            self._expect(_Event(begin, _Kind.UART_BEGIN, port=Port.UART))
        if ended and not cause:
            self._telemetry.counts[Register.EMISSIONS] += 1
            self._gate.pins.focus(tick + 1, self._registers.bit_ticks)
        halted = effect is not None and effect.halts
        self._move_player(tick, trigger, halted)
        if effect is not None:
            effect.take(tick)
            if effect.triggers:
                self._expect(_Event(tick + 1, _Kind.TRIGGER))
        if self._gate.move_ramp(tick):
            self._player.free_from = self._gate.ramp_end + self._registers.bit_ticks - 1
        if noted:
            self._telemetry.input_tick = tick
        if cause:
            self._telemetry.counts[Register.UNDERRUNS] += Fault.UNDERRUN in cause
            self._telemetry.counts[Register.FAULT_COUNT] += 1
            self._gate.shut(tick, cause)
            self._commands.drop(tick)
            self._player.drop(tick)
            self._events = [event for event in self._events if event.kind is not _Kind.ENDED]
        self._gate.permits = permits

    def _move_player(self, tick: int, trigger: bool, halted: bool) -> None:
        """Ends, next emissions of a repetition, triggers and scheduled starts of one tick."""
        player, telemetry = self._player, self._telemetry
        head = self._queue.head(tick)
        free = self._free(tick) and not halted
        begins: Play | None = None
        if head is not None:
            seen = tick > self._queue.head_from  # its time is looked at one tick after it is fetched
            due = head.start is Start.TIME and seen and head.when == tick + DECISION_TICKS
            at_once = head.start is Start.NOW and not player.remaining
            if free and (due or at_once or (trigger and head.start is Start.TRIGGER)):
                begins = self._queue.pop(tick)
            elif head.start is Start.TIME and seen and head.when < tick + DECISION_TICKS:
                self._queue.pop(tick)
                telemetry.counts[Register.PLAYS_MISSED] += 1
        if trigger:
            telemetry.counts[Register.TRIGGERS] += 1
            telemetry.trigger_tick = tick
            telemetry.counts[Register.TRIGGERS_IGNORED] += begins is None or begins.start is not Start.TRIGGER
        repeats = player.repeating and not player.delayed and tick == player.due_tick and begins is None and not halted
        released = player.release_tick == tick and not halted
        if player.playing and tick == player.end - 1:
            if not player.halting:
                self._expect(_Event(tick + PIN_TICKS, _Kind.ENDED))
            player.finish(tick, self._registers.bit_ticks)
            self._gate.idle(tick + 1)
            self._gate.limits.emission(tick + 1, playing=False)
            self._gate.limits.activity(tick + 1, active=False)
        if begins is not None:
            player.begin(begins, tick)
        if repeats and player.running is not None:
            player.remaining = max(player.remaining - 1, 0)
        if repeats or released or (begins is not None and not player.delayed):
            self._sound(tick)

    def _sound(self, tick: int) -> None:
        """The running play sounds from the next tick on."""
        player, gate = self._player, self._gate
        player.sound(tick, self._registers.bit_period)
        assert player.running
        self._telemetry.emission_tick = tick + DECISION_TICKS
        gate.limits.emission(tick + 1, playing=True)
        gate.limits.activity(tick + 1, active=True)
        if not player.running.live:
            waveform = self._buffers.waveform(player.running.buffer)
            words = player.running.words(waveform, self._registers.idle_word, 0, player.running.length)
            gate.play(tick + 1, words)
            player.known_words = player.running.length
