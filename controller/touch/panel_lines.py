"""The interrupt and reset lines of a touch panel (gpiod 2): chip by label, lines by name, as both outlast kernels."""

from __future__ import annotations

import contextlib
import errno
from pathlib import Path
from typing import Final

import gpiod
from gpiod.line import Direction, Edge, Value

from controller.errors import TouchError

CONSUMER: Final = "haptic-panel touch"
EDGES_AT_ONCE: Final = 16  # read together; only the last one's time counts


class PanelLines:
    """Both lines of one panel.

    Parameters
    ----------
    chip_label : str
        Label of the GPIO chip, such as pinctrl-bcm2711.
    interrupt, reset : str
        Names of lines of that chip; reset may be empty.

    Raises
    ------
    TouchError
        If there is no such chip or line, or one is taken.
    """

    def __init__(self, chip_label: str, interrupt: str, reset: str = "") -> None:
        self.has_reset = bool(reset)
        self._interrupt = interrupt
        self._reset = reset
        self._path = _chip_path(chip_label)
        self._listening: gpiod.LineRequest | None = None
        self._driven: dict[str, gpiod.LineRequest] = {}
        with gpiod.Chip(self._path) as chip:
            for name in filter(None, (interrupt, reset)):
                try:
                    chip.line_offset_from_id(name)
                except OSError as error:
                    raise TouchError(f"GPIO chip {chip_label!r} has no line {name!r}; gpioinfo lists what it has") from error

    def drive_reset(self, *, high: bool) -> None:
        """Pull the reset line; low holds the panel in reset."""
        self._drive(self._reset, high)

    def drive_interrupt(self, *, high: bool) -> None:
        """Pull the interrupt line ourselves: at reset its level tells some panels which address to take."""
        self._drive(self._interrupt, high)

    def listen(self, edge: Edge) -> None:
        """Wait for edges of the interrupt line from now on."""
        self._let_go(self._interrupt)
        settings = gpiod.LineSettings(direction=Direction.INPUT, edge_detection=edge)
        self._listening = self._request(self._interrupt, settings)

    def fileno(self) -> int | None:
        """File that is readable after an edge."""
        return self._listening.fd if self._listening else None

    def take_edges(self) -> float | None:
        """Forget the edges that have come; time of the last one in s, None if there was none."""
        time_s = None
        while self._listening and self._listening.wait_edge_events(0):
            time_s = self._listening.read_edge_events(EDGES_AT_ONCE)[-1].timestamp_ns * 1e-9
        return time_s

    def rest(self) -> None:
        """Let go of the interrupt line; the reset line stays as it is, so that the panel keeps running."""
        self._let_go(self._interrupt)
        if self._listening:
            with contextlib.suppress(OSError):
                self._listening.release()
            self._listening = None

    def close(self) -> None:
        """Let go of both lines."""
        self.rest()
        self._let_go(self._reset)

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

    def _let_go(self, name: str) -> None:
        held = self._driven.pop(name, None)
        if held:
            with contextlib.suppress(OSError):
                held.release()

    def _request(self, name: str, settings: gpiod.LineSettings) -> gpiod.LineRequest:
        try:
            return gpiod.request_lines(self._path, consumer=CONSUMER, config={name: settings})
        except OSError as error:
            reason = "is taken by another program or driver" if error.errno == errno.EBUSY else f"cannot be had ({error.strerror})"
            raise TouchError(f"line {name!r} of {self._path} {reason}; gpioinfo says by whom") from error


def _chip_path(label: str) -> str:
    labels = []
    refused = False
    for path in sorted(Path("/dev").glob("gpiochip*")):
        try:
            with gpiod.Chip(str(path)) as chip:
                found = chip.get_info().label
        except OSError as error:
            refused |= error.errno in (errno.EACCES, errno.EPERM)
            continue
        if found == label:
            return str(path)
        labels.append(found)
    if refused:
        raise TouchError("GPIO chips may not be opened by this user: add it to the group that owns them (on Debian: gpio)")
    raise TouchError(f"there is no GPIO chip labelled {label!r}; there is: {', '.join(labels) or 'none'}")
