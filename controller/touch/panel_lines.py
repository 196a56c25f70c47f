"""Interrupt and reset lines of a touch panel (gpiod 2): chip by label, lines by name, which stay the same across kernels."""

from __future__ import annotations

import contextlib
import errno
from typing import Final

import gpiod
from gpiod.line import Direction, Edge, Value

from controller.board.gpio_chip import find_chip
from controller.errors import TouchError

CONSUMER: Final = "haptic-panel touch"
READ_EDGES: Final = 16  # with one call; only the time of the last one counts


class PanelLines:
    """Interrupt line and optional reset line of one panel.

    Parameters
    ----------
    chip_label : str
        Label of the GPIO chip, such as pinctrl-bcm2711.
    interrupt, reset : str
        Names of lines of that chip; reset may be empty.

    Attributes
    ----------
    has_reset : bool
        Whether there is a reset line.

    Raises
    ------
    TouchError
        If there is no such chip or line, or a line is in use.
    """

    def __init__(self, chip_label: str, interrupt: str, reset: str = "") -> None:
        self.has_reset = bool(reset)
        self._interrupt = interrupt
        self._reset = reset
        self._path = str(find_chip(chip_label, TouchError))
        self._listening: gpiod.LineRequest | None = None
        self._driven: dict[str, gpiod.LineRequest] = {}
        with gpiod.Chip(self._path) as chip:
            for name in filter(None, (interrupt, reset)):
                try:
                    chip.line_offset_from_id(name)
                except OSError as error:
                    raise TouchError(f"GPIO chip {chip_label!r} has no line {name!r}; gpioinfo lists its lines") from error

    def drive_reset(self, *, high: bool) -> None:
        """Drive the reset line `high` or low; low holds the panel in reset."""
        self._drive(self._reset, high)

    def drive_interrupt(self, *, high: bool) -> None:
        """Drive the interrupt line `high` or low: during reset its level selects the address of some chips."""
        self._drive(self._interrupt, high)

    def listen(self, edge: Edge) -> None:
        """Detect rising or falling edges (`edge`) of the interrupt line from now on.

        Raises
        ------
        TouchError
            If the line is in use.
        """
        self._release(self._interrupt)
        settings = gpiod.LineSettings(direction=Direction.INPUT, edge_detection=edge)
        self._listening = self._request(self._interrupt, settings)

    def fileno(self) -> int | None:
        """File that is readable after an edge; None while edges are not detected."""
        return self._listening.fd if self._listening else None

    def read_edges(self) -> float | None:
        """Consume all edges so far; time of the last one in s on CLOCK_MONOTONIC, None if there was none."""
        time_s = None
        while self._listening and self._listening.wait_edge_events(0):
            time_s = self._listening.read_edge_events(READ_EDGES)[-1].timestamp_ns * 1e-9
        return time_s

    def release_interrupt(self) -> None:
        """Release the interrupt line; the reset line keeps its level, so that the panel keeps running."""
        self._release(self._interrupt)
        if self._listening:
            with contextlib.suppress(OSError):
                self._listening.release()
            self._listening = None

    def close(self) -> None:
        """Release both lines."""
        self.release_interrupt()
        self._release(self._reset)

    def _drive(self, name: str, high: bool) -> None:
        value = Value.ACTIVE if high else Value.INACTIVE
        held = self._driven.get(name)
        if held:
            held.set_value(name, value)
            return
        if name == self._interrupt and self._listening:
            self._listening.release()
            self._listening = None
        self._driven[name] = self._request(name, gpiod.LineSettings(direction=Direction.OUTPUT, output_value=value))

    def _release(self, name: str) -> None:
        held = self._driven.pop(name, None)
        if held:
            with contextlib.suppress(OSError):
                held.release()

    def _request(self, name: str, settings: gpiod.LineSettings) -> gpiod.LineRequest:
        try:
            return gpiod.request_lines(self._path, consumer=CONSUMER, config={name: settings})
        except OSError as error:
            busy = error.errno == errno.EBUSY
            reason = "is in use by another program or driver" if busy else f"cannot be requested ({error.strerror})"
            raise TouchError(f"line {name!r} of {self._path} {reason}; gpioinfo shows its consumer") from error
