"""Simulated gateware that loses its supply or is reset, to test how the host recovers."""

from __future__ import annotations

import numpy as np

from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.capture import Capture
from controller.workshop.gateware.gateware import Gateware, GatewareFactory, Permit
from controller.workshop.gateware.pin_timing import READY_TICKS, TRIGGER_HIGH_TICKS

OPEN_LINE = 0xFF  # MISO while nothing drives it


class RestartingGateware:
    """`Gateware` that is replaced by a new one at each `restart`; its ticks continue, the new one's own clock begins at 0.

    Parameters
    ----------
    factory : GatewareFactory
        Makes each gateware.
    parameters : BuildParameters
        Of each.
    """

    def __init__(self, factory: GatewareFactory, parameters: BuildParameters) -> None:
        self._factory = factory
        self._parameters = parameters
        self._origin = 0
        self._gateware: Gateware = factory(parameters)
        self._levels = dict.fromkeys(Permit, False)
        self._captures: list[Capture] = []
        self._last = (0, 0)

    @property
    def now(self) -> int:
        """The current tick."""
        return self._origin + self._gateware.now

    @property
    def fault(self) -> bool:
        """Whether a fault is latched, or the fault pin is pulled up since there is no supply."""
        return not self._gateware.now or self._gateware.fault

    def next_change(self) -> int | None:
        """As in `Gateware`."""
        change = self._gateware.next_change()
        return None if change is None else self._origin + change

    def restart(self, tick: int, dark_ticks: int) -> None:
        """Remove the supply at `tick`: all outputs are low from then on; reset ends `dark_ticks` later."""
        self.advance(tick)
        self._take()
        if self._last != (0, 0):
            self._last = (0, 0)
            self._captures.append(_low(max(tick, self.now)))
        self._origin = max(tick, self.now) + dark_ticks
        self._gateware = self._factory(self._parameters)
        for which, level in self._levels.items():
            self._gateware.permit(0, level=level, which=which)

    def advance(self, tick: int) -> None:
        """Advance to `tick`; does nothing if that has passed."""
        if tick > self._origin:
            self._gateware.advance(tick - self._origin)

    def permit(self, tick: int, *, level: bool, which: Permit = Permit.RUN) -> None:
        """Set a permit pin; without supply that takes effect when reset ends."""
        self._levels[which] = level
        self._gateware.permit(max(tick - self._origin, 0), level=level, which=which)

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:
        """Raise the trigger pin; without supply it has no effect."""
        if tick - self._origin >= READY_TICKS:
            self._gateware.trigger(tick - self._origin, high_ticks)

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """Exchange one frame; without supply MISO is open."""
        if select_tick - self._origin >= READY_TICKS:
            self._gateware.exchange(select_tick - self._origin, release_tick - self._origin, mosi, miso)
        else:
            miso[:] = bytes([OPEN_LINE]) * len(miso)

    def take_capture(self) -> Capture:
        """Changes of the output pins since the last capture, over all restarts."""
        self._take()
        captures, self._captures = self._captures, []
        return Capture(
            np.concatenate([capture.ticks for capture in captures]),
            np.concatenate([capture.words for capture in captures]),
            np.concatenate([capture.hv for capture in captures]),
            np.concatenate([capture.focus_ticks for capture in captures]),
        )

    def _take(self) -> None:
        capture = self._gateware.take_capture()
        origin = np.uint64(self._origin)
        if capture.ticks.size:
            self._last = (int(capture.words[-1]), int(capture.hv[-1]))
        self._captures.append(Capture(capture.ticks + origin, capture.words, capture.hv, capture.focus_ticks + origin))


def _low(tick: int) -> Capture:
    return Capture(np.array([tick], np.uint64), np.zeros(1, np.uint32), np.zeros(1, np.uint8), np.zeros(0, np.uint64))
