"""Interrupt and reset lines of a touch panel (gpiod 2), by the chip's label and the lines' names or numbers."""

from __future__ import annotations

import contextlib
import errno
from typing import Final

import gpiod
from gpiod.line import Direction, Edge, Value

from controller.device.board.gpio_chip import find_chip, find_lines
from controller.errors import TouchError

CONSUMER: Final = "haptic-panel touch"
READ_EDGES: Final = 16  # with one call; only the time of the last one counts
MAX_READS: Final = 64  # calls at a time: a line with noise has edges faster than they are read


class PanelLines:
    """Interrupt line and reset line of one panel, both optional.

    `chip_label` is such as pinctrl-bcm2711, empty without lines; `interrupt` and `reset` are names or numbers of lines of that
    chip, empty: there is none. Raises TouchError if there is no such chip or line, or a line is in use.
    """

    def __init__(self, chip_label: str, interrupt: str, reset: str = "") -> None:
        self.has_interrupt = bool(interrupt)  # has_interrupt, has_reset: whether there is such a line
        self.has_reset = bool(reset)
        self.edges = 0  # edges of the interrupt line that were consumed so far
        self._interrupt = interrupt
        self._reset = reset
        self._listening: gpiod.LineRequest | None = None
        self._driven: dict[str, gpiod.LineRequest] = {}
        self._path = ""
        self._offsets: dict[str, int] = {}
        wanted = [line for line in (interrupt, reset) if line]
        if wanted:
            self._path = str(find_chip(chip_label, TouchError))
            try:
                with gpiod.Chip(self._path) as chip:
                    self._offsets = find_lines(chip, chip_label, wanted, TouchError)
            except OSError as error:
                raise TouchError(f"GPIO chip {chip_label!r} ({self._path}) failed: {error.strerror}") from error

    def drive_reset(self, *, high: bool) -> None:
        """Drive the reset line `high` or low; low holds the panel in reset."""
        self._drive(self._reset, high=high)

    def drive_interrupt(self, *, high: bool) -> None:
        """Drive the interrupt line `high` or low: during reset its level selects the address of some chips."""
        self._drive(self._interrupt, high=high)

    def listen(self, edge: Edge) -> None:
        """Detect rising or falling edges (`edge`) of the interrupt line from now on, if there is one.

        Raises TouchError if the line is in use.
        """
        self._release(self._interrupt)
        if self.has_interrupt:
            settings = gpiod.LineSettings(direction=Direction.INPUT, edge_detection=edge)
            self._listening = self._request(self._interrupt, settings)

    def fileno(self) -> int | None:
        """File that is readable after an edge; None while edges are not detected."""
        return self._listening.fd if self._listening else None

    def interrupt_high(self) -> bool | None:
        """Level of the interrupt line; None while it is not listened to; raises OSError if its chip fails."""
        if self._listening is None:
            return None
        return bool(self._listening.get_value(self._offsets[self._interrupt]) is Value.ACTIVE)

    def read_edges(self) -> float | None:
        """Consume the edges so far; time of the last one in s on CLOCK_MONOTONIC, None if there was none."""
        time_s = None
        for _ in range(MAX_READS):
            if not (self._listening and self._listening.wait_edge_events(0)):
                break
            events = self._listening.read_edge_events(READ_EDGES)
            self.edges += len(events)
            time_s = events[-1].timestamp_ns * 1e-9
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

    def _drive(self, line: str, *, high: bool) -> None:
        value = Value.ACTIVE if high else Value.INACTIVE
        held = self._driven.get(line)
        if held:
            held.set_value(self._offsets[line], value)
            return
        if line == self._interrupt and self._listening:
            self._listening.release()
            self._listening = None
        self._driven[line] = self._request(line, gpiod.LineSettings(direction=Direction.OUTPUT, output_value=value))

    def _release(self, line: str) -> None:
        held = self._driven.pop(line, None)
        if held:
            with contextlib.suppress(OSError):
                held.release()

    def _request(self, line: str, settings: gpiod.LineSettings) -> gpiod.LineRequest:
        try:
            return gpiod.request_lines(self._path, consumer=CONSUMER, config={self._offsets[line]: settings})
        except OSError as error:
            busy = error.errno == errno.EBUSY
            reason = "is in use by another program or driver" if busy else f"cannot be requested ({error.strerror})"
            raise TouchError(f"line {line!r} of {self._path} {reason}; gpioinfo shows its consumer") from error
