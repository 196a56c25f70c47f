"""The core of the gateware model: all that happens in one tick, and the status that a link is answered.

Within a tick everything is decided from the state before it, as flip-flops do; of conflicting changes the later one here wins, as
in the Verilog.
"""

from dataclasses import dataclass

from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import FRAME_BYTES
from controller.device.fpga.registers import Fault, Register, Result, State
from controller.device.fpga.status import Status, pack_status
from controller.workshop.gateware.gateware import Permit, Port
from controller.workshop.gateware.model.commands import Commands, Effect
from controller.workshop.gateware.model.decoder import Frame
from controller.workshop.gateware.model.events import EventKind, Events, GatewareEvent
from controller.workshop.gateware.model.gate import GateState
from controller.workshop.gateware.model.sequencer import Sequencer
from controller.workshop.gateware.model.uart import BEGIN_TICKS, DELIVER_TICKS, UartPeripheral
from controller.workshop.gateware.pin_timing import UartTiming

_DELIVERY = (EventKind.UART_BEGIN, EventKind.LANDING, EventKind.FRAME)


@dataclass(slots=True)
class _Seen:
    """What happens in one tick."""

    cause: Fault  # of outputs being switched off
    permits: dict[Permit, bool]  # as they are after the tick
    trigger: bool = False
    ended: bool = False  # an emission
    noted: bool = False  # a change of a permit
    frame: GatewareEvent | None = None
    landing: GatewareEvent | None = None
    decoded: Frame | None = None  # of the UART


class Core:
    """`haptic_core.v` behind its input registers. `events` are what happens in which tick."""

    def __init__(self, parameters: BuildParameters, events: Events) -> None:
        self.commands = Commands(parameters)  # the parts of the model
        self.uart = UartPeripheral(UartTiming.of(parameters))
        self.spi_until = 0  # last tick in which the core is busy with a frame of the SPI, as far as is known
        self._events = events
        self._sequencer = Sequencer(self.commands, events)
        self._gate = self.commands.gate
        self._player = self.commands.player
        self._queue = self.commands.queue
        self._buffers = self.commands.buffers
        self._registers = self.commands.registers
        self._telemetry = self.commands.telemetry

    def next_change(self) -> int | None:
        """Next tick in which something happens without further input; None if nothing will."""
        sequencer = self._sequencer
        ticks = (
            self._events.next_tick,
            self._player.next_change(),
            self._gate.next_change(self._events.now),
            sequencer.head_tick(),
            sequencer.arrival_tick(),
        )
        return min((tick for tick in ticks if tick is not None), default=None)

    def waiting_from(self) -> int | None:
        """Tick from which on the head of the queue waits for a trigger, if nothing else happens; None if it does not."""
        return self._sequencer.waiting_from()

    def status(self, port: Port = Port.SPI, tick: int | None = None) -> Status:
        """The status with which a link is answered. The beginning of the frame is seen in `tick`, by default the current one."""
        gate, player, telemetry = self._gate, self._player, self._telemetry
        now = self._events.now if tick is None else tick
        link = telemetry.links[port]
        waiting_from = self.waiting_from()
        bits = (
            (State.ARMED, gate.state is GateState.ON),
            (State.RAMPING, gate.ramping),
            (State.PLAYING, player.playing),
            (State.REPEATING, player.repeating),
            (State.PENDING, bool(self._queue.plays)),
            (State.LANDING_BUSY, self.commands.landing_busy),
            (State.RUN_PERMIT, gate.permits[Permit.RUN]),
            (State.HEARTBEAT, now < gate.silent_from),
            (State.HV_ENABLE, gate.pins.hv_at(now)),
            (State.TEMPERATURE_GOOD, gate.permits[Permit.TEMPERATURE]),
            (State.CHECKING, self._buffers.checking(now)),
            (State.DELAYED, player.delayed),
            (State.WAITING, waiting_from is not None and now >= waiting_from),
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

    def step(self, tick: int) -> None:
        """Do everything that happens in `tick`."""
        seen, faulted = _Seen(self._gate.cause(tick), dict(self._gate.permits)), bool(self._gate.faults)
        if tick == self._sequencer.arrival_tick() and not self._sequencer.pass_arrived_words():
            self._events.add(GatewareEvent(tick + 1, EventKind.UNDERRUN))
        while (event := self._events.pop(tick)) is not None:
            self._look_at(tick, event, seen)
        effect = self._carry_out(tick, seen)
        if seen.ended and not seen.cause:
            self._telemetry.counts[Register.EMISSIONS] += 1
            self._gate.pins.focus(tick + 1, self._registers.bit_ticks)
        self._sequencer.step(tick, trigger=seen.trigger, halted=effect is not None and effect.halts)
        if effect is not None:
            effect.take(tick)
            if effect.triggers:
                self._events.add(GatewareEvent(tick + 1, EventKind.TRIGGER))
        if self._gate.move_ramp(tick):
            self._player.free_from = self._gate.ramp_end + self._registers.bit_ticks - 1
        if seen.noted:
            self._telemetry.input_tick = tick
        if seen.cause:
            self._shut(tick, seen.cause, counted=not faulted)
        self._gate.permits = seen.permits

    def _look_at(self, tick: int, event: GatewareEvent, seen: _Seen) -> None:
        match event.kind:
            case EventKind.PERMIT:
                seen.permits[event.permit] = event.level
            case EventKind.PERMIT_NOTED:
                seen.noted = True
            case EventKind.UNDERRUN:
                seen.cause |= Fault.UNDERRUN if self._gate.live(tick) else Fault(0)
            case EventKind.FRAME:
                seen.frame = event
            case EventKind.LANDING:
                seen.landing = event
            case EventKind.UART_BYTE:
                self._receive(tick, event.byte)
            case EventKind.UART_FRAME:
                seen.decoded = event.frame
            case EventKind.UART_BEGIN:
                self._begin_delivery(tick)
            case EventKind.TRIGGER:
                seen.trigger = True
            case EventKind.EMISSION_END:
                seen.ended = True

    def _carry_out(self, tick: int, seen: _Seen) -> Effect | None:
        """Execute the frame of the tick, and take over what has landed and what the UART has decoded."""
        effect, frame, decoded = None, seen.frame, seen.decoded
        if frame is not None:
            effect = self.commands.execute(
                tick,
                frame.port,
                frame.frame,
                frame.ticks,
                landing_busy=frame.landing_busy,
                landing_live=frame.landing_live,
                queue_full=frame.queue_full,
            )
            if frame.port is Port.UART:
                self.uart.pending = None
        if seen.landing is not None:
            self._land(seen.landing)
        if decoded is not None and decoded.refusal is not Result.OK:
            self.commands.refuse(Port.UART, decoded.refusal)
        elif decoded is not None:
            self.uart.pending = decoded
            begin = max(tick + BEGIN_TICKS - 1, self.spi_until + 1)
            self._events.add(GatewareEvent(begin, EventKind.UART_BEGIN, port=Port.UART))
        return effect

    def _shut(self, tick: int, cause: Fault, *, counted: bool) -> None:
        self._telemetry.counts[Register.UNDERRUNS] += Fault.UNDERRUN in cause
        if counted:
            self._telemetry.counts[Register.FAULT_COUNT] += 1
            self._gate.fault_tick = tick
        self._gate.shut(tick, cause)
        self.commands.drop(tick)
        self._player.drop(tick)
        self._events.remove(lambda event: event.kind is EventKind.EMISSION_END)

    def defer_uart(self) -> None:
        """Deliver the UART's frame after the frame of the SPI that begins now."""
        if self.uart.pending is None:
            return
        self._events.remove(lambda event: event.port is Port.UART and event.kind in _DELIVERY)
        self._events.add(GatewareEvent(self.spi_until + 1, EventKind.UART_BEGIN, port=Port.UART))

    def _begin_delivery(self, tick: int) -> None:
        """Begin to deliver the UART's frame to the core, unless a frame of the SPI begins before it is executed."""
        frame, commands = self.uart.pending, self.commands
        assert frame
        event = GatewareEvent(
            tick + frame.payload_words + DELIVER_TICKS,
            EventKind.FRAME,
            frame=frame,
            landing_busy=commands.landing_busy,
            landing_live=commands.landing_live,
            queue_full=self._queue.full,
            port=Port.UART,
        )
        self._events.add(event)
        if frame.loaded_words:
            self._events.add(event._replace(tick=tick + 1, kind=EventKind.LANDING))

    def _receive(self, tick: int, byte: int) -> None:
        """Receive a byte from the UART."""
        begins, frame = self.uart.receive(byte)
        if begins:
            answer = bytearray(FRAME_BYTES)
            pack_status(answer, 0, self.status(Port.UART, tick))
            self.uart.answer(tick, bytes(answer))
        if frame is not None:
            self._events.add(GatewareEvent(tick + 1, EventKind.UART_FRAME, frame=frame))

    def _land(self, event: GatewareEvent) -> None:
        """Write the words of a LOAD, unless that chunk plays; it counts only once the frame is accepted."""
        chunk = event.frame.argument
        if not event.landing_busy and not (event.landing_live and self._buffers.chunk_words[chunk]):
            self._buffers.write(chunk, memoryview(event.frame.payload))
