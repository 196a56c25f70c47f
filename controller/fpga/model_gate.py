"""Arming, ramps, faults and the words on the pins of the gateware model: `output_gate.v` and `idle_ramp.v`."""

from __future__ import annotations

from enum import Enum

import numpy as np
from numpy.typing import NDArray

from controller.fpga.model_pins import Pins, ramp_bits, turned_ramp_bits
from controller.fpga.model_registers import RegisterFile
from controller.fpga.registers import Fault

PIN_TICKS = 3  # from the state of player and ramp to the pins: memory, selection, gate


class Gate(Enum):
    """Where the outputs stand."""

    OFF = 0
    RAMP_UP = 1
    ON = 2
    RAMP_DOWN = 3


class OutputGate:
    """What stands between a waveform and the pins; ticks are those of the state, PIN_TICKS before the pins."""

    def __init__(self, registers: RegisterFile) -> None:
        self._registers = registers
        self.pins = Pins()
        self.state = Gate.OFF
        self.faults = Fault(0)
        self.permit = False
        self.silent_from = 0  # the tick from which on the host counts as silent
        self._ramp_start = 0
        self._ramp_end = 0

    @property
    def ramping(self) -> bool:
        """Gliding up or down."""
        return self.state in (Gate.RAMP_UP, Gate.RAMP_DOWN)

    def next_change(self, now: int) -> int | None:
        """The tick of the next end of a ramp or of the next fault that can be foreseen."""
        if self.state is Gate.OFF:
            return None
        fault = self.silent_from if self.permit else now
        return min(fault, self._ramp_end - 1) if self.ramping else fault

    def cause(self, tick: int) -> Fault:
        """Why the outputs have to go off in this tick."""
        if self.state is Gate.OFF:
            return Fault(0)
        cause = Fault(0) if self.permit else Fault.NO_PERMIT
        return cause | Fault.HOST_SILENT if tick >= self.silent_from else cause

    def hear(self, tick: int) -> None:
        """An accepted frame is a sign of life."""
        self.silent_from = tick + 1 + self._registers.heartbeat_ticks

    def arm(self, tick: int) -> None:
        """Glide to the idle word."""
        self._ramp(tick + 1, Gate.RAMP_UP, ramp_bits(self._registers.ramp_samples, up=True))

    def disarm(self, tick: int) -> None:
        """Glide to 0, from full scale or back from where the way up has come to."""
        samples, bit_ticks = self._registers.ramp_samples, self._registers.bit_ticks
        if self.state is Gate.ON:
            self._ramp(tick + 1, Gate.RAMP_DOWN, ramp_bits(samples, up=False))
        elif self.state is Gate.RAMP_UP:
            reached = (tick - self._ramp_start) // bit_ticks + 1
            turn = self._ramp_start + reached * bit_ticks  # at the next drive word
            self._ramp(turn, Gate.RAMP_DOWN, turned_ramp_bits(samples, reached))

    def end_ramp(self, tick: int) -> None:
        """Go on or off if the ramp ends with this tick."""
        if self.ramping and tick == self._ramp_end - 1:
            up = self.state is Gate.RAMP_UP
            self.state = Gate.ON if up else Gate.OFF
            self._put_word(self._ramp_end + PIN_TICKS, self._registers.idle_word if up else 0, hv=int(up))

    def play(self, tick: int, waveform: NDArray[np.uint32]) -> None:
        """The words of an emission, from state tick `tick` on."""
        words = waveform & np.uint32(self._registers.channel_mask)
        self.pins.put(tick + PIN_TICKS, words, self._registers.bit_ticks, 1)

    def idle(self, tick: int) -> None:
        """The idle word, from state tick `tick` on."""
        self._put_word(tick + PIN_TICKS, self._registers.idle_word, hv=1)

    def shut(self, tick: int, cause: Fault) -> None:
        """Outputs low with the next tick, whatever is still on its way to them."""
        self.faults |= cause
        self.state = Gate.OFF
        self._put_word(tick + 1, 0, hv=0)
        self.pins.cut_focus()

    def clear(self) -> None:
        """Forget the causes of a fault."""
        self.faults = Fault(0)

    def _ramp(self, tick: int, state: Gate, bits: NDArray[np.bool_]) -> None:
        bit_ticks = self._registers.bit_ticks
        self.state = state
        self._ramp_start = tick
        self._ramp_end = tick + len(bits) * bit_ticks
        self.pins.put(tick + PIN_TICKS, bits * np.uint32(self._registers.idle_word), bit_ticks, 1)

    def _put_word(self, tick: int, word: int, *, hv: int) -> None:
        self.pins.put(tick, np.array([word], np.uint32), 1, hv)
