"""What a READ returns in the gateware model: registers, counters, slots' CRCs, the queue and waveform memory."""

from collections import deque
from dataclasses import dataclass, field

from controller.device.fpga.registers import READ_MEMORY, READ_QUEUE, READ_SLOT_CRC, Fault, Kind, Register, Result
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.buffers import Buffers
from controller.workshop.gateware.model.gate import OutputGate
from controller.workshop.gateware.model.player import Player, Queue
from controller.workshop.gateware.model.registers import RegisterFile


def _zeros(kind: Kind) -> dict[Register, int]:
    return {register: 0 for register in Register if register.kind is kind}


@dataclass
class LinkState:
    """State that each link has of its own."""

    result: Result = Result.OK
    sequence: int = 0
    data: int = 0
    high: int = 0  # high half of the time whose LOW was read last
    counts: dict[Register, int] = field(default_factory=lambda: _zeros(Kind.LINK_COUNTER))
    unlocked: bool = False  # by the previous frame


@dataclass
class Telemetry:
    """Counters and times that only READs and statuses report."""

    links: tuple[LinkState, LinkState] = field(default_factory=lambda: (LinkState(), LinkState()))  # by Port
    counts: dict[Register, int] = field(default_factory=lambda: _zeros(Kind.COUNTER))
    trigger_tick: int = 0
    emission_tick: int = 0
    input_tick: int = 0
    trigger_pin: deque[tuple[int, int]] = field(default_factory=lambda: deque(maxlen=64))  # intervals in which the pin is seen high


class Readout:
    """Answers READs from the state of the model's parts."""

    def __init__(
        self, registers: RegisterFile, gate: OutputGate, buffers: Buffers, player: Player, queue: Queue, telemetry: Telemetry
    ) -> None:
        self._registers = registers
        self._gate = gate
        self._buffers = buffers
        self._player = player
        self._queue = queue
        self._telemetry = telemetry

    def read(self, tick: int, link: LinkState, address: int) -> Result:
        """Carry out a READ of a frame that is executed in `tick`; its value becomes `link.data`. OK, or why nothing was read."""
        result, value = Result.OK, 0
        if address >= READ_MEMORY:
            slot, word = divmod(address - READ_MEMORY, 1024)
            player = self._player
            played_until = player.played_until
            if player.playing and player.running is not None and player.start < tick:
                played_until = played_until | {player.running.buffer: tick}
            result, value = self._buffers.read_memory(tick, slot, word, played_until)
        elif address >> 8 == READ_QUEUE >> 8:
            result, value = self._read_queue(tick, *divmod(address - READ_QUEUE, 8))
        elif address >> 8 == READ_SLOT_CRC >> 8:
            result, value = self._buffers.read_crc(tick, address - READ_SLOT_CRC)
        elif address not in set(Register):
            result = Result.UNKNOWN_REGISTER
        else:
            value = self._register(tick, link, Register(address))
        if result is Result.OK:
            link.data = value & 0xFFFFFFFF
        return result

    def _read_queue(self, tick: int, number: int, word: int) -> tuple[Result, int]:
        plays = self._queue.plays
        if number >= len(plays) or word > 5:
            return Result.BAD_RANGE, 0
        if self._queue.fetching(tick):
            return Result.BUSY, 0
        return Result.OK, plays[number].raw[word]

    def _register(self, tick: int, link: LinkState, register: Register) -> int:
        value = self._registers.read(register)
        if value is not None:
            return value
        telemetry, gate = self._telemetry, self._gate
        if register.kind is Kind.COUNTER:
            return telemetry.counts[register]
        if register.kind is Kind.LINK_COUNTER:
            return link.counts[register]
        if register.kind is Kind.TIME_HIGH:
            return link.high
        if register.kind is Kind.TIME_LOW:
            time = {
                Register.FAULT_TIME_LOW: gate.fault_tick,
                Register.INPUT_TIME_LOW: telemetry.input_tick,
                Register.TRIGGER_TIME_LOW: telemetry.trigger_tick,
                Register.EMISSION_TIME_LOW: telemetry.emission_tick,
            }[register]
            link.high = time >> 32
            return time
        at_fault = gate.faults & (Fault.SHORT_PULSE | Fault.CHANNEL_EDGES)
        trigger = any(start <= tick < end for start, end in telemetry.trigger_pin)
        return {
            Register.CONTROL: 0,
            Register.FAULT: int(gate.faults),
            Register.FAULT_CHANNELS: gate.limits.channels(tick) if at_fault else 0,
            Register.INPUTS: gate.permits[Permit.RUN] | gate.permits[Permit.TEMPERATURE] << 1 | trigger << 2,
            Register.SLOTS_LOADED: self._buffers.loaded(tick),
            Register.QUEUE: len(self._queue.plays),
            Register.DUTY_LEVEL: gate.limits.duty_level(tick),
        }[register]
