"""A link to simulated gateware (the model, or the compiled Verilog), in place of SPI and GPIO.

Frames take as long as on the board's wire: a frame begins when the wire is free, chip select is low for its bits at SCK, and the
next frame follows after a pause. The gateware's clock follows the loop's clock, so that a replay in virtual time and one in real
time go through the same ticks.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from controller.device.board.board import Board
from controller.device.board.devices import LinkSettings
from controller.device.fpga.capture import Capture
from controller.device.service.drivers import gateware_hash
from controller.workshop.gateware.actual_panel import gateware_of
from controller.workshop.gateware.gateware import Gateware, GatewareFactory, Permit
from controller.workshop.gateware.model.empty import EmptyFpga
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.pin_timing import READY_TICKS

SELECT_PAUSE_SCK = 2  # SCK periods with chip select high between frames, and from its edges to the first and last bit
SELECT_PAUSE_TICKS = 10  # and at least this many FPGA clocks
TRIGGER_AFTER_TICKS = 8  # from the end of the last frame to the trigger: the frame must have been executed


@dataclass
class Bus:
    """The wires on which frames go, which several FPGAs may share; tick 0 is `start_s` on the loop's clock."""

    start_s: float
    free_tick: int = READY_TICKS  # when they are free


class SimulatedLink:
    """`Link` to simulated gateware.

    The gateware was just reset; its permits are set here. Tick 0 is the present value of `now_s`, unless the `bus` is shared.
    """

    def __init__(self, settings: LinkSettings, now_s: Callable[[], float], gateware: Gateware, bus: Bus | None = None) -> None:
        self.bytes_sent = 0
        self.wire_ns = 0
        self.blocked_ns = 0
        self.clock_hz = settings.clock_hz
        self._now_s = now_s
        self._bus = bus or Bus(now_s())
        self.sck_hz = 0.0
        self.set_sck_hz(settings.sck_hz)
        self.gateware = gateware
        for permit in Permit:
            gateware.permit(0, level=True, which=permit)

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Send frames and store the answers, each at its time on the wire; parameters as in `Link.exchange`."""
        started_ns = time.perf_counter_ns()
        first = tick = max(self._tick_now(), self._bus.free_tick)
        start = 0
        for length in lengths:
            release = tick + round(8 * length * self._ticks_per_bit) + self._pause_ticks
            self.gateware.exchange(tick, release, sent[start : start + length], received[start : start + length])
            tick = release + self._pause_ticks
            start += length
        self._bus.free_tick = tick
        self.bytes_sent += start
        self.wire_ns += round((tick - first) / self.clock_hz * 1e9)
        self.blocked_ns += time.perf_counter_ns() - started_ns

    def trigger(self) -> float:
        """Pulse the trigger pin, now or after the frames sent before; returns the time of its edge in s, on the loop's clock."""
        started_ns = time.perf_counter_ns()
        tick = max(self._tick_now(), self._bus.free_tick + TRIGGER_AFTER_TICKS)
        self.gateware.trigger(tick)
        self._bus.free_tick = max(self._bus.free_tick, tick)
        self.blocked_ns += time.perf_counter_ns() - started_ns
        return self.time_s(tick)

    def wire_free_s(self) -> float:
        """When the frames sent so far have left the wire and been executed, on the loop's clock."""
        return self.time_s(self._bus.free_tick + TRIGGER_AFTER_TICKS)

    def tick(self, time_s: float) -> int:
        """Tick of the gateware at `time_s` on the loop's clock."""
        return round((time_s - self._bus.start_s) * self.clock_hz)

    def time_s(self, tick: int) -> float:
        """Time in s on the loop's clock at a tick of the gateware."""
        return self._bus.start_s + tick / self.clock_hz

    def set_sck_hz(self, sck_hz: int) -> float:
        """Set SCK to `sck_hz` for the next frames; returns it."""
        self.sck_hz = float(sck_hz)
        self._ticks_per_bit = self.clock_hz / sck_hz
        self._pause_ticks = max(round(SELECT_PAUSE_SCK * self._ticks_per_bit), SELECT_PAUSE_TICKS)
        return self.sck_hz

    def close(self) -> None:
        """Advance the gateware to the present, so that captures are complete."""
        started_ns = time.perf_counter_ns()
        self.gateware.advance(max(self._tick_now(), self._bus.free_tick))
        self.blocked_ns += time.perf_counter_ns() - started_ns

    @property
    def speed(self) -> float:
        """Simulated time over the time it took to compute."""
        return self.gateware.now / self.clock_hz / (self.blocked_ns * 1e-9)

    def take_capture(self) -> Capture:
        """Changes of the output pins since the last call."""
        return self.gateware.take_capture()

    def take_captures(self) -> list[Capture]:
        """That of its only FPGA."""
        return [self.take_capture()]

    def _tick_now(self) -> int:
        return self.tick(self._now_s())


def open_simulated(board: Board, now_s: Callable[[], float], gateware: GatewareFactory = GatewareModel) -> SimulatedLink:
    """Link to the simulated FPGA of a board, just reset. `gateware` makes it: the model, or the compiled Verilog.

    Raises ConfigError or GatewareError if what is really there of the panel, or in its flash, cannot be read.
    """
    parameters = gateware_of(board, gateware_hash())
    return SimulatedLink(board.link, now_s, EmptyFpga() if parameters is None else gateware(parameters))
