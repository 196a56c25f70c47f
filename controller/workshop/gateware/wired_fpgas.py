"""Several simulated FPGAs of one panel: one clock, one SPI with a chip select for each, one trigger line, one line of run permit.

The line of the run permit is high while the host drives it and no FPGA reports a fault: each fault pin pulls it low
(boards/README.md). All are computed side by side, none farther ahead of the others than the line takes, so that what a fault of one
does to the others comes in time.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Final

import numpy as np

from controller.device.board.board import Board
from controller.device.fpga.capture import Capture
from controller.device.fpga.links.link_group import LinkGroup
from controller.device.service.drivers import gateware_hash
from controller.workshop.gateware.actual_panel import gateware_of
from controller.workshop.gateware.gateware import Gateware, GatewareFactory, Permit
from controller.workshop.gateware.model.empty import EmptyFpga
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.pin_timing import READY_TICKS, TRIGGER_HIGH_TICKS
from controller.workshop.gateware.rtl_gateware import FOLLOWED_TICKS, RtlGateware
from controller.workshop.gateware.simulated_link import Bus, SimulatedLink, open_simulated

LINE_TICKS: Final = 2 * FOLLOWED_TICKS  # from a fault pin to all permit pins, at most: 5 us at 80 MHz, 1 kohm and 5 nF


class WiredFpgas:
    """FPGAs on the same lines, as the gateware of each; the reset of each ends at its `ready_ticks`, 0 by default."""

    def __init__(self, gatewares: Sequence[Gateware], ready_ticks: Sequence[int] = ()) -> None:
        self.members = tuple(WiredFpga(self, number) for number in range(len(gatewares)))
        self.gatewares = tuple(gatewares)
        self.ready_ticks = tuple(ready_ticks) or (0,) * len(gatewares)
        self._permit = self._line = False  # what the host gives, and what is left of it on the line
        for number, gateware in enumerate(self.gatewares):
            if isinstance(gateware, RtlGateware):
                gateware.followed = partial(self._follow, number)

    @property
    def now(self) -> int:
        """The current tick: counted since reset by an FPGA whose `ready_ticks` is 0."""
        return min(self._now(number) for number in range(len(self.gatewares)))

    def advance(self, tick: int) -> None:
        """Advance all to `tick`; does nothing if that has passed."""
        while (now := self.now) < tick:
            changes = [
                change + ready
                for gateware, ready in zip(self.gatewares, self.ready_ticks, strict=True)
                if (change := gateware.next_change()) is not None
            ]
            self._pass_faults(min([tick, *(max(change, now) + LINE_TICKS // 2 for change in changes)]))

    def permit(self, number: int, tick: int, *, level: bool, which: Permit) -> None:
        """Set the host's run permit, which is that of all, or the temperature pin of one of them."""
        self.advance(tick)
        if which is Permit.RUN:
            self._permit = level
            self._drive_line(tick)
        else:
            self.gatewares[number].permit(self._own(number, tick), level=level, which=which)

    def trigger(self, tick: int, high_ticks: int) -> None:
        """Raise the trigger pins of all."""
        self.advance(tick)
        for number, gateware in enumerate(self.gatewares):
            gateware.trigger(self._own(number, tick), high_ticks)

    def exchange(
        self, number: int, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview
    ) -> None:
        """Exchange a frame with one of them."""
        self.advance(select_tick)
        self.gatewares[number].exchange(self._own(number, select_tick), self._own(number, release_tick), mosi, miso)

    def take_capture(self, number: int) -> Capture:
        """Changes of the output pins of one of them since the last call, by the common ticks."""
        capture, ready = self.gatewares[number].take_capture(), np.uint64(self.ready_ticks[number])
        return replace(capture, **{name: getattr(capture, name) + ready for name in vars(capture) if name.endswith("ticks")})

    def _now(self, number: int) -> int:
        return self.gatewares[number].now + self.ready_ticks[number]

    def _own(self, number: int, tick: int) -> int:
        """A tick as one of them counts it; its first, before its reset has ended."""
        return max(tick - self.ready_ticks[number], 0)

    def _follow(self, number: int, own_tick: int) -> None:
        """Have the others reach the tick at which one of them is within a frame."""
        self._pass_faults(own_tick + self.ready_ticks[number])

    def _pass_faults(self, tick: int) -> None:
        """Advance all to `tick`, not more than half the time of the line, and pass on what their fault pins say then."""
        for gateware, ready in zip(self.gatewares, self.ready_ticks, strict=True):
            gateware.advance(tick - ready)
        if (self._permit and not self._any_fault) != self._line:
            self._drive_line(tick + LINE_TICKS // 2)

    @property
    def _any_fault(self) -> bool:
        return any(gateware.fault for gateware in self.gatewares)

    def _drive_line(self, tick: int) -> None:
        self._line = self._permit and not self._any_fault
        for number, gateware in enumerate(self.gatewares):
            gateware.permit(self._own(number, tick), level=self._line, which=Permit.RUN)


class WiredFpga:
    """One of several FPGAs on the same lines: a `Gateware`, by the ticks of all."""

    def __init__(self, panel: WiredFpgas, number: int) -> None:
        self._panel = panel
        self._number = number

    @property
    def now(self) -> int:
        """As in `Gateware`."""
        return self._panel.now

    @property
    def fault(self) -> bool:
        """As in `Gateware`."""
        return self._panel.gatewares[self._number].fault

    def next_change(self) -> int | None:
        """As in `Gateware`: what the lines bring is not known before."""
        return self.now

    def advance(self, tick: int) -> None:
        """As in `Gateware`, of all FPGAs."""
        self._panel.advance(tick)

    def permit(self, tick: int, *, level: bool, which: Permit = Permit.RUN) -> None:
        """As in `Gateware`; the run permit is that of all."""
        self._panel.permit(self._number, tick, level=level, which=which)

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:
        """As in `Gateware`, of all FPGAs."""
        self._panel.trigger(tick, high_ticks)

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """As in `Gateware`."""
        self._panel.exchange(self._number, select_tick, release_tick, mosi, miso)

    def take_capture(self) -> Capture:
        """As in `Gateware`."""
        return self._panel.take_capture(self._number)


class SimulatedFpgas(LinkGroup):
    """`LinkGroup` to simulated FPGAs of a board, just reset, each at its `ready_ticks`."""

    def __init__(
        self, board: Board, now_s: Callable[[], float], gateware: GatewareFactory = GatewareModel, ready_ticks: Sequence[int] = ()
    ) -> None:
        built = [gateware_of(one, gateware_hash()) for one in board.fpga_boards]
        self.panel = WiredFpgas([EmptyFpga() if one is None else gateware(one) for one in built], ready_ticks)
        bus = Bus(now_s(), max(self.panel.ready_ticks) + READY_TICKS)
        self.timed = [
            SimulatedLink(one.link, now_s, member, bus) for one, member in zip(board.fpga_boards, self.panel.members, strict=True)
        ]
        super().__init__(self.timed)
        self.gateware = self.panel.members[0]  # which advances all
        self.clock_hz = board.link.clock_hz
        self.tick, self.time_s = self.timed[0].tick, self.timed[0].time_s

    @property
    def speed(self) -> float:
        """Simulated time over the time it took to compute."""
        return self.panel.now / self.clock_hz / (self.blocked_ns * 1e-9)

    def take_captures(self) -> list[Capture]:
        """Changes of the output pins of each FPGA since the last call."""
        return [link.take_capture() for link in self.timed]


def open_simulated_panel(
    board: Board, now_s: Callable[[], float], gateware: GatewareFactory = GatewareModel
) -> SimulatedLink | SimulatedFpgas:
    """As `open_simulated`, of a board of one FPGA or several."""
    return SimulatedFpgas(board, now_s, gateware) if board.link.fpga else open_simulated(board, now_s, gateware)
