"""Execution of frames in the gateware model: results as in `haptic_core.v`, and their effects."""

from collections.abc import Callable
from typing import NamedTuple

from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.registers import (
    CHUNKS,
    IDENTITY_MAGIC,
    PLAY_LANDING,
    PROTOCOL_VERSION,
    TIME_LEAD_TICKS,
    WAVEFORM_WORDS,
    Control,
    FrameType,
    Register,
    Result,
    Start,
)
from controller.workshop.gateware.gateware import Port
from controller.workshop.gateware.model.buffers import Buffers
from controller.workshop.gateware.model.decoder import Frame
from controller.workshop.gateware.model.gate import GateState, OutputGate
from controller.workshop.gateware.model.player import AcceptedPlay, Player, Queue, word_tick
from controller.workshop.gateware.model.readout import LinkState, Readout, Telemetry
from controller.workshop.gateware.model.registers import RegisterFile

FETCH_GAP_TICKS = 2  # after a scheduled play and its idle word, so that even the shortest leaves time to fetch the next
LEAD_TICKS = TIME_LEAD_TICKS - 2  # the time of a scheduled play is compared with that of two ticks before


class Effect(NamedTuple):
    """What a frame changes at the end of its tick."""

    take: Callable[[int], None]
    halts: bool = False  # no play starts in its tick
    triggers: bool = False
    arms: bool = False


class Commands:
    """The parts of the model, and the execution of frames on them."""

    def __init__(self, parameters: BuildParameters) -> None:
        self.registers = RegisterFile(parameters)
        self.gate = OutputGate(self.registers)
        self.buffers = Buffers(parameters.slots)
        self.player = Player()
        self.queue = Queue()
        self.telemetry = Telemetry()
        self._readout = Readout(self.registers, self.gate, self.buffers, self.player, self.queue, self.telemetry)
        self._fast = False  # the last LOAD was at least as fast as its words play
        self._free_tick = 0  # when the last scheduled play has ended
        self._armed_by = Port.SPI

    @property
    def landing_busy(self) -> bool:
        """Whether a waveform that was in a slot still plays, or is queued, from what is now the landing buffer."""
        plays = [*self.queue.plays, self.player.running]
        return any(play is not None and play.buffer == self.buffers.landing and not play.live for play in plays)

    @property
    def landing_live(self) -> bool:
        """Whether a play of the landing buffer (PLAY_LANDING) is current or queued."""
        return self.player.live or any(play.live for play in self.queue.plays)

    def drop(self, tick: int) -> None:
        """Empty the queue in `tick`."""
        self.queue.drop(tick)
        self._free_tick = 0

    def refuse(self, port: Port, refusal: Result) -> None:
        """Record the `refusal` of a frame of `port`: for its sync word, length or CRC, or as BUSY."""
        link = self.telemetry.links[port]
        link.result, link.unlocked = refusal, False
        link.counts[Register.FRAME_ERRORS] += 1

    def execute(
        self, tick: int, port: Port, frame: Frame, ticks: int, *, landing_busy: bool, landing_live: bool, queue_full: bool
    ) -> Effect | None:
        """Execute a frame: record its result, decided from the state before the tick.

        The frame came by `port` and was on the wire for `ticks`; `landing_busy`, `landing_live` and `queue_full` are as they were
        when it began. The effect is to be taken after everything else of the tick.
        """
        if frame.refusal is not Result.OK:
            self.refuse(port, frame.refusal)
            return None
        telemetry = self.telemetry.links[port]
        telemetry.result = Result.OK
        unlocked, telemetry.unlocked = telemetry.unlocked, False
        effect: Effect | None = None
        if frame.kind == FrameType.READ:
            telemetry.result = self._readout.read(tick, telemetry, frame.argument)
        elif frame.kind == FrameType.WRITE and frame.argument == Register.CONTROL:
            telemetry.result, effect = self._control(telemetry, frame.words, unlocked=unlocked)
        elif frame.kind == FrameType.WRITE:
            telemetry.result = self._write(tick, frame.argument, frame.words[0])
        elif frame.kind == FrameType.LOAD:
            words = frame.loaded_words
            self._fast = port is Port.SPI and words * self.registers.bit_period >= ticks << 16
            telemetry.result = self._load(frame.argument, words, landing_busy=landing_busy, landing_live=landing_live)
        elif frame.kind == FrameType.STORE:
            length_words, crc = frame.words[:2]
            telemetry.result = self.buffers.store(tick, frame.argument, length_words, crc, live=self.landing_live)
        elif frame.kind == FrameType.PLAY:
            telemetry.result, effect = self._play(tick, frame, queue_full=queue_full)
        elif frame.kind not in (FrameType.NOP, FrameType.TEST):
            telemetry.result = Result.UNKNOWN_TYPE
        # a READ of SEQUENCE_GAPS does not count its own gap
        telemetry.counts[Register.SEQUENCE_GAPS] += frame.sequence != telemetry.sequence + 1 & 0xFF
        telemetry.sequence = frame.sequence
        if effect is not None and effect.arms:
            self._armed_by = port
            self.gate.heartbeat(tick)
        elif self.gate.state is not GateState.OFF and port is self._armed_by:
            self.gate.heartbeat(tick)
        return effect

    def _write(self, tick: int, address: int, value: int) -> Result:
        disarmed = self.gate.state is GateState.OFF
        still = self.gate.state in (GateState.OFF, GateState.ON) and self.player.quiet(tick) and not self.queue.plays
        result = self.registers.write(address, value, disarmed=disarmed, quiet=still)
        if result is Result.OK and address == Register.DUTY_SHARE:
            self.gate.limits.activity(tick + 2, active=False)  # the bucket is updated once more with the new share
        return result

    def _control(self, link: LinkState, words: tuple[int, ...], *, unlocked: bool) -> tuple[Result, Effect | None]:
        command, *key = words[:4]
        if command == Control.UNLOCK:
            if tuple(key) != (IDENTITY_MAGIC, PROTOCOL_VERSION, self.registers.parameters.build_hash):
                return Result.BAD_KEY, None
            link.unlocked = True
            return Result.OK, None
        if command == Control.ARM:
            if not unlocked:
                return Result.LOCKED, None
            if self.gate.state is not GateState.OFF:
                return Result.ARMED, None
            if self.gate.faults:
                return Result.FAULTED, None
            return (Result.OK, Effect(self.gate.arm, arms=True)) if all(self.gate.permits.values()) else (Result.NO_PERMIT, None)
        effects: dict[int, Effect] = {
            Control.DISARM: Effect(self._disarm, halts=True),
            Control.CLEAR: Effect(self.gate.clear),
            Control.STOP: Effect(self._stop, halts=True),
            Control.TRIGGER: Effect(lambda _: None, triggers=True),
        }
        effect = effects.get(command)
        return (Result.OK if effect else Result.BAD_VALUE), effect

    def _load(self, chunk: int, words: int, *, landing_busy: bool, landing_live: bool) -> Result:
        if chunk >= CHUNKS:
            return Result.BAD_CHUNK
        if landing_busy or (landing_live and self.buffers.chunk_words[chunk]):
            return Result.BUSY
        self.buffers.chunk_words[chunk] = words
        return Result.OK

    def _play(self, tick: int, frame: Frame, *, queue_full: bool) -> tuple[Result, Effect | None]:
        live = frame.argument == PLAY_LANDING
        result = self._playable(tick, frame.argument, live=live)
        if result is not Result.OK:
            return result, None
        held = WAVEFORM_WORDS if live else self.buffers.slot_words[frame.argument]
        first, asked = frame.words[0] & 0xFFFF, frame.words[0] >> 16
        count, kind, inverted = frame.words[1] & 0xFFFF, frame.words[1] >> 16 & 0xFF, frame.words[1] >> 24
        period_ticks, mask = frame.words[2:4]
        when = frame.words[4] | frame.words[5] << 32
        length = asked or held - first
        if first >= held or first + asked > held or (live and first):
            return Result.BAD_RANGE, None
        if kind > Start.TIME or inverted > 1:
            return Result.BAD_VALUE, None
        length_ticks = word_tick(length, self.registers.bit_period)
        rest = self.registers.bit_ticks
        if length_ticks > self.registers.limits.emission_ticks:
            return Result.TOO_LONG, None
        if count != 1 and period_ticks != length_ticks and period_ticks < length_ticks + rest:
            return Result.BAD_PERIOD, None
        if queue_full:
            return Result.QUEUE_FULL, None
        start = Start(kind)
        if start is Start.TIME and when < tick + LEAD_TICKS:
            return Result.TOO_LATE, None
        if start is Start.TIME and when < self._free_tick:
            return Result.OVERLAP, None
        buffer = self.buffers.landing if live else self.buffers.slot_buffer[frame.argument]
        play = AcceptedPlay(buffer, first, length, count, period_ticks, start, when, mask, bool(inverted), live, frame.words[:6])

        def push(tick: int) -> None:
            self.queue.push(tick, play)
            if start is Start.TIME:
                self._free_tick = (
                    when + max(count - 1, 0) * period_ticks + length_ticks + rest + FETCH_GAP_TICKS & 0xFFFFFFFFFFFFFFFF
                )

        return Result.OK, Effect(push)

    def _playable(self, tick: int, slot: int, *, live: bool) -> Result:
        """OK if there is a waveform to play and the outputs are armed; else why not."""
        buffers = self.buffers
        if not live and slot >= len(buffers.slot_buffer):
            return Result.BAD_SLOT
        if self.gate.faults:
            return Result.FAULTED
        if self.gate.state is not GateState.ON:
            return Result.NOT_ARMED
        if live:
            if not buffers.chunk_words[0]:
                return Result.INCOMPLETE
            if not self._fast:
                return Result.LINK_SLOW
            return Result.BUSY if self.queue.plays else Result.OK
        if not buffers.slot_words[slot]:
            return Result.EMPTY_SLOT
        if buffers.checking_slot(tick, slot):
            return Result.BUSY
        return Result.OK if buffers.intact(tick, slot) else Result.SLOT_DAMAGED

    def _stop(self, tick: int) -> None:
        self.player.stop()
        self.drop(tick)

    def _disarm(self, tick: int) -> None:
        player = self.player
        playing = player.playing
        player.halt(tick, self.registers.bit_period)
        if playing and player.end == tick + 1:
            player.finish(tick, self.registers.bit_ticks)
            self.gate.idle(tick + 1)
            self.gate.limits.emission(tick + 1, playing=False)
            self.gate.limits.activity(tick + 1, active=False)
        settled_from = player.end + self.registers.bit_ticks - 1 if player.playing else player.free_from
        self.drop(tick)
        self.gate.disarm(tick, settled_from)
