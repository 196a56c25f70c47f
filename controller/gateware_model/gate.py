"""Arming, ramps, faults and the words on the pins of the gateware model: `output_gate.v` and `idle_ramp.v`."""

from __future__ import annotations

from enum import Enum

import numpy as np
from numpy.typing import NDArray

from controller.fpga.registers import Fault
from controller.gateware_model.gateware import Permit
from controller.gateware_model.limits import StageLimits
from controller.gateware_model.pins import Pins, Segment, ramp_bits, turned_ramp_bits
from controller.gateware_model.registers import RegisterFile

PIN_TICKS = 4  # from the state of player and ramp to the pins: memory, register, selection, gate
LIMITS = Fault.SHORT_PULSE | Fault.CHANNEL_EDGES | Fault.TOTAL_EDGES | Fault.LONG_EMISSION | Fault.DUTY
ALIVE_HZ_4 = 40_000  # `hv_alive_o` changes twice as often as its 20 kHz have periods
_LIMITS_SHIFT = int(Fault.SHORT_PULSE).bit_length() - 1


class Gate(Enum):
    """Where the outputs stand."""

    OFF = 0
    RAMP_UP = 1
    ON = 2
    STOPPING = 3
    RAMP_DOWN = 4
    SETTLING = 5


class OutputGate:
    """What stands between a waveform and the pins; ticks are those of the state, PIN_TICKS before the pins."""

    def __init__(self, registers: RegisterFile) -> None:
        self._registers = registers
        self.limits = StageLimits(registers.limits, registers.parameters.edge_window_ticks)
        self.pins = Pins(self.limits, max(registers.parameters.clock_hz // ALIVE_HZ_4, 1))
        self.state = Gate.OFF
        self.faults = Fault(0)
        self._rest_until = 0  # the tick from which on a fault by a limit can be cleared
        self.fault_tick = 0
        self.permits = dict.fromkeys(Permit, False)
        self.silent_from = 0  # the tick from which on the host counts as silent
        self.ramp_end = 0
        self._ramp_start = 0
        self._ramp_from = 0  # the tick of STOPPING from which on the way down may begin
        self._settled_tick = 0  # the last of SETTLING
        self._live_until = 0  # what was on its way as the state came to OFF has passed the pins in this tick

    @property
    def ramping(self) -> bool:
        """Gliding up or down, or about to."""
        return self.state in (Gate.SETTLING, Gate.RAMP_UP, Gate.STOPPING, Gate.RAMP_DOWN)

    def live(self, tick: int) -> bool:
        """Anything is on, the pins at least: a cause of a fault counts."""
        return self.state is not Gate.OFF or tick < self._live_until

    def next_change(self, now: int) -> int | None:
        """The tick of the next end of a ramp or of the next fault that can be foreseen."""
        if not self.live(now):
            return None
        ticks = [self.silent_from if all(self.permits.values()) else now]
        limit = self.limits.next_change(now)
        if limit is not None:
            ticks.append(limit)
        if self.state is Gate.OFF:
            return change if (change := max(min(ticks), now)) < self._live_until else None
        if self.state is Gate.SETTLING:
            ticks.append(self._settled_tick)
        elif self.state is Gate.STOPPING:
            ticks.append(self._ramp_from)
        elif self.ramping:
            ticks.append(self.ramp_end - 1)
        return max(min(ticks), now)

    def cause(self, tick: int) -> Fault:
        """Why the outputs have to go off in this tick, but for an underrun."""
        if not self.live(tick):
            return Fault(0)
        cause = Fault(self.limits.cause(tick) << _LIMITS_SHIFT)
        if not self.permits[Permit.RUN]:
            cause |= Fault.NO_PERMIT
        if not self.permits[Permit.TEMPERATURE]:
            cause |= Fault.OVER_TEMPERATURE
        return cause | Fault.HOST_SILENT if tick >= self.silent_from else cause

    def hear(self, tick: int) -> None:
        """An accepted frame is a sign of life."""
        self.silent_from = tick + 1 + self._registers.heartbeat_ticks

    def arm(self, tick: int) -> None:
        """Have the high voltage settle, then glide to the idle word."""
        self.state = Gate.SETTLING
        self._settled_tick = tick + self._registers.parameters.hv_settle_ticks
        self.pins.put_word(tick + 1 + PIN_TICKS, 0, hv=1)

    def disarm(self, tick: int, settled_from: int) -> None:
        """Glide to 0, once the idle word is old enough, or back from where the way up has come to."""
        samples, bit_ticks = self._registers.ramp_samples, self._registers.bit_ticks
        if self.state is Gate.SETTLING:
            self._come_to_off(tick + 1)
        elif self.state is Gate.ON:
            self.state = Gate.STOPPING
            self._ramp_from = max(tick + 1, settled_from)
        elif self.state is Gate.RAMP_UP and tick == self.ramp_end - 1:
            self._ramp(tick + 1, Gate.RAMP_DOWN, ramp_bits(samples, up=False))
        elif self.state is Gate.RAMP_UP:
            reached = (tick - self._ramp_start) // bit_ticks + 1
            turn = self._ramp_start + reached * bit_ticks  # at the next drive word
            self._ramp(turn, Gate.RAMP_DOWN, turned_ramp_bits(samples, reached))

    def move_ramp(self, tick: int) -> bool:
        """Begin or end a ramp with this tick; True if one ends."""
        if self.state is Gate.SETTLING and tick == self._settled_tick:
            self._ramp(tick + 1, Gate.RAMP_UP, ramp_bits(self._registers.ramp_samples, up=True))
        elif self.state is Gate.STOPPING and tick == self._ramp_from:
            self._ramp(tick + 1, Gate.RAMP_DOWN, ramp_bits(self._registers.ramp_samples, up=False))
        elif self.state in (Gate.RAMP_UP, Gate.RAMP_DOWN) and tick == self.ramp_end - 1:
            if self.state is Gate.RAMP_UP:
                self.state = Gate.ON
                self.pins.put_word(self.ramp_end + PIN_TICKS, self._registers.idle_word, hv=1)
            else:
                self._come_to_off(self.ramp_end)
            self.limits.activity(self.ramp_end, active=False)
            return True
        return False

    def play(self, tick: int, words: NDArray[np.uint32], first: int = 0) -> None:
        """Words of an emission that began at state tick `tick`, of which they are those from the `first` on."""
        masked = words & np.uint32(self._registers.channel_mask)
        self.pins.put(Segment(tick + PIN_TICKS, masked, self._registers.bit_period, 1, first))

    def idle(self, tick: int) -> None:
        """The idle word, from state tick `tick` on."""
        self.pins.put_word(tick + PIN_TICKS, self._registers.idle_word, hv=1)

    def shut(self, tick: int, cause: Fault) -> None:
        """Outputs low with the next tick, whatever is still on its way to them."""
        self.faults |= cause
        if cause & LIMITS:
            self._rest_until = tick + 1 + self._registers.parameters.edge_window_ticks
        self.fault_tick = tick
        self.state = Gate.OFF
        self._live_until = tick + 1
        self.pins.put_word(tick + 1, 0, hv=0)
        self.pins.cut_focus()
        self.limits.activity(tick + 1, active=False)
        self.limits.emission(tick + 1, playing=False)

    def clear(self, tick: int) -> None:
        """Forget the causes of a fault, but for those of a limit while it rests."""
        self.faults &= LIMITS if tick < self._rest_until else Fault(0)
        self.limits.clear(tick)

    def _come_to_off(self, tick: int) -> None:
        """Off from state tick `tick` on, without a fault: the words on their way still come."""
        self.state = Gate.OFF
        self._live_until = tick + PIN_TICKS
        self.pins.put_word(tick + PIN_TICKS, 0, hv=0)

    def _ramp(self, tick: int, state: Gate, bits: NDArray[np.bool_]) -> None:
        bit_ticks = self._registers.bit_ticks
        self.state = state
        self._ramp_start = tick
        self.ramp_end = tick + len(bits) * bit_ticks
        words = bits * np.uint32(self._registers.idle_word)
        self.pins.put(Segment(tick + PIN_TICKS, words, bit_ticks << 16, 1))
        self.limits.activity(tick, active=True)
