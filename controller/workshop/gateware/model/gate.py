"""Arming, ramps and faults of the gateware model, and the words on its pins: `output_gate.v` and `idle_ramp.v`."""

from enum import Enum

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools
from controller.device.fpga.registers import Fault
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.limits import StageLimits
from controller.workshop.gateware.model.pins import Pins, Segment, ramp_bits, turned_ramp_bits
from controller.workshop.gateware.model.registers import RegisterFile

PIN_TICKS = 4  # from the state of player and ramp to the pins: memory, register, multiplexer, gate
EDGES = Fault.CHANNEL_EDGES | Fault.TOTAL_EDGES  # found out some ticks after they were made, so that they count while off too
LIMITS = Fault.SHORT_PULSE | EDGES | Fault.LONG_EMISSION | Fault.DUTY
ALIVE_HZ_4 = 40_000  # twice the frequency of `hv_alive_o`, 20 kHz: it changes twice in a period
_LIMITS_SHIFT = int(Fault.SHORT_PULSE).bit_length() - 1


class GateState(Enum):
    """State of the outputs."""

    OFF = 0
    RAMP_UP = 1
    ON = 2
    STOPPING = 3
    RAMP_DOWN = 4
    SETTLING = 5


class OutputGate:
    """The gate between waveforms and pins; its ticks are those of the state, PIN_TICKS before the pins."""

    def __init__(self, registers: RegisterFile) -> None:
        self._registers = registers
        self.limits = StageLimits(registers.limits, registers.parameters.edge_window_ticks)
        self.pins = Pins(self.limits, max(registers.parameters.clock_hz // ALIVE_HZ_4, 1))
        self.state = GateState.OFF
        self.faults = Fault(0)
        self._rest_until = 0  # first tick in which a fault by a limit can be cleared
        self.fault_tick = 0
        self.permits = dict.fromkeys(Permit, False)
        self.silent_from = 0  # first tick of the heartbeat timeout
        self.ramp_end = 0
        self._ramp_start = 0
        self._ramp_from = 0  # first tick of STOPPING in which the ramp down may begin
        self._settled_tick = 0  # last tick of SETTLING
        self._live_until = 0  # after OFF, tick in which the last word in the pipeline has passed the pins

    @property
    def ramping(self) -> bool:
        """Whether the outputs ramp, or are about to."""
        return self.state in (GateState.SETTLING, GateState.RAMP_UP, GateState.STOPPING, GateState.RAMP_DOWN)

    def live(self, tick: int) -> bool:
        """Whether anything is on in `tick`, the pins at least, so that every cause leads to a fault."""
        return self.state is not GateState.OFF or tick < self._live_until

    def next_change(self, now: int) -> int | None:
        """Tick of the next end of a ramp or foreseeable fault from `now` on; None if there is none."""
        if not self.live(now):
            return self.limits.next_excess_edge(now)
        ticks = [self.silent_from if all(self.permits.values()) else now]
        limit = self.limits.next_change(now)
        if limit is not None:
            ticks.append(limit)
        if self.state is GateState.OFF:
            return change if (change := max(min(ticks), now)) < self._live_until else self.limits.next_excess_edge(now)
        if self.state is GateState.SETTLING:
            ticks.append(self._settled_tick)
        elif self.state is GateState.STOPPING:
            ticks.append(self._ramp_from)
        elif self.ramping:
            ticks.append(self.ramp_end - 1)
        return max(min(ticks), now)

    def cause(self, tick: int) -> Fault:
        """Causes for which the outputs must be switched off in `tick`, except an underrun."""
        cause = Fault(self.limits.cause(tick) << _LIMITS_SHIFT)
        if not self.live(tick):
            return cause & EDGES
        if not self.permits[Permit.RUN]:
            cause |= Fault.NO_PERMIT
        if not self.permits[Permit.TEMPERATURE]:
            cause |= Fault.OVER_TEMPERATURE
        return cause | Fault.HOST_SILENT if tick >= self.silent_from else cause

    def heartbeat(self, tick: int) -> None:
        """Restart the heartbeat timeout, for a frame accepted in `tick`."""
        self.silent_from = tick + 1 + self._registers.heartbeat_ticks

    def arm(self, tick: int) -> None:
        """Enable the high voltage in `tick`; the ramp up follows once it has settled."""
        self.state = GateState.SETTLING
        self._settled_tick = tick + self._registers.parameters.hv_settle_ticks
        self.pins.put_word(tick + 1 + PIN_TICKS, 0, hv=1)

    def disarm(self, tick: int, settled_from: int) -> None:
        """Ramp down to 0, or reverse a ramp up. The idle word has been held for a bit period from the tick `settled_from` on."""
        samples, bit_ticks = self._registers.ramp_samples, self._registers.bit_ticks
        if self.state is GateState.SETTLING:
            self._come_to_off(tick + 1)
        elif self.state is GateState.ON:
            self.state = GateState.STOPPING
            self._ramp_from = max(tick + 1, settled_from)
        elif self.state is GateState.RAMP_UP and tick == self.ramp_end - 1:
            self._ramp(tick + 1, GateState.RAMP_DOWN, ramp_bits(samples, up=False))
        elif self.state is GateState.RAMP_UP:
            reached = (tick - self._ramp_start) // bit_ticks + 1
            turn = self._ramp_start + reached * bit_ticks  # at the next drive word
            self._ramp(turn, GateState.RAMP_DOWN, turned_ramp_bits(samples, reached))

    def move_ramp(self, tick: int) -> bool:
        """Begin or end a ramp in `tick`; returns whether one ends."""
        if self.state is GateState.SETTLING and tick == self._settled_tick:
            self._ramp(tick + 1, GateState.RAMP_UP, ramp_bits(self._registers.ramp_samples, up=True))
        elif self.state is GateState.STOPPING and tick == self._ramp_from:
            self._ramp(tick + 1, GateState.RAMP_DOWN, ramp_bits(self._registers.ramp_samples, up=False))
        elif self.state in (GateState.RAMP_UP, GateState.RAMP_DOWN) and tick == self.ramp_end - 1:
            if self.state is GateState.RAMP_UP:
                self.state = GateState.ON
                self.pins.put_word(self.ramp_end + PIN_TICKS, self._registers.idle_word, hv=1)
            else:
                self._come_to_off(self.ramp_end)
            self.limits.activity(self.ramp_end, active=False)
            return True
        return False

    def play(self, tick: int, words: NDArray[np.uint32], first: int = 0) -> None:
        """Plan words of an emission that began in `tick`, of which `words`, (n,) uint32, are number `first` and later."""
        masked = words & np.uint32(self._registers.channel_mask)
        self.pins.put(Segment(tick + PIN_TICKS, masked, self._registers.bit_period, 1, first))

    def idle(self, tick: int) -> None:
        """Plan the idle word from `tick` on."""
        self.pins.put_word(tick + PIN_TICKS, self._registers.idle_word, hv=1)

    def shut(self, tick: int, cause: Fault) -> None:
        """Switch the outputs off for `cause` after `tick`, whatever is still in the pipeline."""
        self.faults |= cause
        if cause & LIMITS:
            self._rest_until = tick + 1 + self._registers.parameters.edge_window_ticks
        self.state = GateState.OFF
        self._live_until = tick + 1
        self.pins.put_word(tick + 1, 0, hv=0)
        self.pins.cut_focus()
        self.limits.activity(tick + 1, active=False)
        self.limits.emission(tick + 1, playing=False)

    def clear(self, tick: int) -> None:
        """Clear the causes of a fault in `tick`, except those of a limit until a window has passed since."""
        self.faults &= LIMITS if tick < self._rest_until else Fault(0)
        self.limits.clear(tick)

    def _come_to_off(self, tick: int) -> None:
        """Off from `tick` on without a fault; words in the pipeline still reach the pins."""
        self.state = GateState.OFF
        self._live_until = tick + PIN_TICKS
        self.pins.put_word(tick + PIN_TICKS, 0, hv=0)

    def _ramp(self, tick: int, state: GateState, bits: Bools) -> None:
        bit_ticks = self._registers.bit_ticks
        self.state = state
        self._ramp_start = tick
        self.ramp_end = tick + len(bits) * bit_ticks
        words = bits * np.uint32(self._registers.idle_word)
        self.pins.put(Segment(tick + PIN_TICKS, words, bit_ticks << 16, 1))
        self.limits.activity(tick, active=True)
