"""The compiled Verilog as a `Gateware`: slower than the model, but the code that the FPGA runs.

The library contains clock, SPI and the recording of pins (fpga_rtl/simulation/wrapper.cpp); only whole frames and whole
captures pass through this module.
"""

import ctypes
import os
import weakref
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.capture import Capture
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.pin_timing import TRIGGER_HIGH_TICKS, InputTiming, UartTiming, sck_rise_tick
from controller.workshop.gateware.rtl_build import Design, build_library

TRIGGER: Final = 0  # pins, as in wrapper.cpp
PINS: Final = {Permit.RUN: 1, Permit.TEMPERATURE: 2}
UART: Final = 3
FOLLOWED_TICKS: Final = 200
LINES: Final = ("alive_ticks", "waiting_ticks", "fault_ticks", "miso_ticks", "uart_ticks")  # as in wrapper.cpp


class RtlGateware:
    """`haptic_core.v` with its pins: a `Gateware`.

    `compiling` is called before the library is built, which takes several seconds; its design is `core_design()` by default.
    Raises LinkError if the library cannot be built.
    """

    def __init__(
        self, parameters: BuildParameters, compiling: Callable[[], None] = lambda: None, design: Design | None = None
    ) -> None:
        self._library = _load(build_library(parameters.verilog(), compiling, design))
        self._panel = self._library.panel_open()
        weakref.finalize(self, self._library.panel_close, self._panel)
        self._timing = InputTiming()
        self._uart = UartTiming.of(parameters)
        self._fault = False  # `fault_o` at the end of the last capture
        # Called while a frame is on the wire, every `FOLLOWED_TICKS`, with the tick reached; None: frames are exchanged whole
        self.followed: Callable[[int], None] | None = None

    @property
    def now(self) -> int:
        """Tick up to which it has been computed."""
        return int(self._library.panel_now(self._panel))

    @property
    def fault(self) -> bool:
        """Whether `fault_o` is high."""
        return self._fault ^ bool(self._library.panel_line_changes(self._panel, LINES.index("fault_ticks")) & 1)

    def next_change(self) -> int | None:
        """The next tick: what happens in it is not known before."""
        return self.now

    def advance(self, tick: int) -> None:
        """Compute up to `tick`; earlier ticks change nothing."""
        self._library.panel_run(self._panel, max(tick, 0))

    def permit(self, tick: int, *, level: bool, which: Permit = Permit.RUN) -> None:
        """Drive the permit pin `which` to `level` at `tick`; both pins are low at tick 0."""
        self._not_past("a permit changes", tick)
        self._library.panel_set(self._panel, PINS[which], tick, level)

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:
        """Raise the trigger pin at `tick` for `high_ticks`; see `Gateware`."""
        self._not_past("the trigger rises", tick)
        self._timing.trigger(tick, high_ticks)
        self._library.panel_set(self._panel, TRIGGER, tick, True)
        self._library.panel_set(self._panel, TRIGGER, tick + high_ticks, False)

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """Exchange a frame, SCK evenly spaced between two edges of chip select; computed up to `release_tick`."""
        self._not_past("chip select falls", select_tick)
        sent = np.frombuffer(mosi, np.uint8) if len(mosi) else np.empty(0, np.uint8)
        self._timing.frame(select_tick, release_tick, sent.size)
        if self.followed is not None and sent.size:
            miso[:] = self._exchange_in_steps(select_tick, release_tick, sent).data
            return
        received = np.empty(sent.size, np.uint8)
        self._library.panel_exchange(self._panel, select_tick, release_tick, sent.size, sent.ctypes.data, received.ctypes.data)
        miso[:] = received.data

    def uart(self, tick: int, wire: bytes) -> int:
        """Send the bytes of `wire` over the UART without gaps from `tick` on; the tick at which the last stop bit ends."""
        self._not_past("a byte begins", tick)
        for number, byte in enumerate(wire):
            for bit, level in enumerate((0, *(byte >> bit & 1 for bit in range(8)), 1)):
                self._library.panel_set(self._panel, UART, self._uart.bit_tick(tick, number, bit), level)
        return self._uart.bit_tick(tick, len(wire), 0)

    def wave(self, levels: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Drive the SPI pins tick by tick from `now` on, to simulate damaged lines.

        `levels` (tick,): bit 0 is chip select (high is idle), bit 1 SCK, bit 2 MOSI. Returns MISO after each tick (tick,).
        """
        miso = np.empty(levels.size, np.uint8)
        self._library.panel_wave(self._panel, levels.size, levels.ctypes.data, miso.ctypes.data)
        return miso

    def _exchange_in_steps(self, select_tick: int, release_tick: int, sent: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """As `exchange`, with `followed` called on the way; computed up to one tick behind `release_tick`."""
        assert self.followed is not None
        bits = 8 * sent.size
        rises = np.array([sck_rise_tick(select_tick, release_tick, sent.size, bit) for bit in range(bits + 1)]) - select_tick
        falls = (rises[:-1] + rises[1:]) // 2
        ticks = np.arange(release_tick - select_tick)
        bit = np.minimum(np.searchsorted(falls, ticks, "right"), bits - 1)
        levels = np.ones(len(ticks) + 1, np.uint8)  # chip select rises behind the frame
        levels[:-1] = 2 * ((ticks >= rises[bit]) & (ticks < falls[bit])) + 4 * np.unpackbits(sent)[bit]
        self.advance(select_tick)
        miso = []
        for first in range(0, len(levels), FOLLOWED_TICKS):
            miso.append(self.wave(levels[first : first + FOLLOWED_TICKS]))
            self.followed(self.now)
        return np.packbits(np.concatenate(miso)[rises[:-1] - 1])

    def take_capture(self) -> Capture:
        """Return and clear the recorded changes of the output pins since the last capture."""
        self._fault = self.fault
        changes = self._library.panel_changes(self._panel)
        capture = Capture(
            np.empty(changes, np.uint64),
            np.empty(changes, np.uint32),
            np.empty(changes, np.uint8),
            np.empty(self._library.panel_foci(self._panel), np.uint64),
            *(np.empty(self._library.panel_line_changes(self._panel, number), np.uint64) for number in range(len(LINES))),
        )
        arrays = (capture.ticks, capture.words, capture.hv, capture.focus_ticks)
        self._library.panel_take(self._panel, *(array.ctypes.data for array in arrays))
        for number, name in enumerate(LINES):
            self._library.panel_take_line(self._panel, number, getattr(capture, name).ctypes.data)
        return capture

    def trace(self, path: Path, tick_ps: float, ticks: range, *, inside: bool) -> None:
        """Write these ticks of the pins and of decoded frames to an FST file, or with `inside` all signals; of `traced_design`.

        Raises OSError if it cannot be written.
        """
        if not self._library.panel_trace(self._panel, os.fsencode(path), tick_ps, ticks.start, ticks.stop, inside):
            raise OSError(f"{path}: cannot be written")

    def close_trace(self) -> None:
        """Write what is left of the trace."""
        self._library.panel_close_trace(self._panel)

    def _not_past(self, what: str, tick: int) -> None:
        if tick < self.now:
            raise ValueError(f"{what} at tick {tick}, after the gateware has gone to tick {self.now}")


@cache
def _load(path: Path) -> Any:
    """Load the library once and declare its functions; it is never unloaded."""
    library = ctypes.CDLL(str(path))
    panel, tick, number, address = ctypes.c_void_p, ctypes.c_uint64, ctypes.c_size_t, ctypes.c_void_p
    for name, result, arguments in (
        ("panel_open", panel, []),
        ("panel_close", None, [panel]),
        ("panel_now", tick, [panel]),
        ("panel_set", None, [panel, ctypes.c_uint32, tick, ctypes.c_uint32]),
        ("panel_run", None, [panel, tick]),
        ("panel_exchange", None, [panel, tick, tick, number, address, address]),
        ("panel_wave", None, [panel, number, address, address]),
        ("panel_changes", number, [panel]),
        ("panel_foci", number, [panel]),
        ("panel_take", None, [panel, address, address, address, address]),
        ("panel_line_changes", number, [panel, ctypes.c_uint32]),
        ("panel_take_line", None, [panel, ctypes.c_uint32, address]),
        ("panel_trace", ctypes.c_uint32, [panel, ctypes.c_char_p, ctypes.c_double, tick, tick, ctypes.c_uint32]),
        ("panel_close_trace", None, [panel]),
    ):
        function = getattr(library, name, None)
        if function is None:  # of a build without traces
            continue
        function.restype, function.argtypes = result, arguments
    return library
