"""What all touch panels on an I2C bus have in common: when to ask them, and what to do when they do not answer.

The chip says by an edge of its interrupt line that a report is there. An edge may be missed, so a panel that is touched
is asked now and then without one, and so is an idle one, seldom, which notices that it is gone.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Final, Protocol

from gpiod.line import Edge

from controller.board.devices import I2cTouch
from controller.errors import TouchError
from controller.touch import event_codes as ev
from controller.touch.contact_events import Contact, ContactEvents
from controller.touch.event_reader import DeviceDescription, Event
from controller.touch.i2c_bus import I2cBus
from controller.touch.panel_lines import PanelLines

TOUCHED_POLL_S: Final = 0.03
IDLE_POLL_S: Final = 1.0
NOT_READY_S: Final = (0.002, 0.004, 0.008, 0.01)  # waits for the report that an edge has announced
STUCK_S: Final = 0.5  # a chip that is touched and gives no report for so long is started again
RETRY_S: Final = 0.5  # between attempts to start a chip that is gone


class Chip(Protocol):
    """A touch controller: how it is started, and how a report is read from it."""

    name: str

    def start(self, bus: I2cBus, lines: PanelLines) -> Iterator[float]:
        """Reset it and find out what it is, yielding times in s to wait in between.

        Raises
        ------
        OSError
            If it does not answer.
        TouchError
            If something else does.
        """

    @property
    def description(self) -> DeviceDescription:
        """Of the chip as it was started last; another object each time."""

    @property
    def edge(self) -> Edge:
        """The edge that announces a report."""

    def fetch(self, bus: I2cBus) -> Sequence[Contact] | None:
        """Contacts of the newest report; None if there is no new one.

        Raises
        ------
        OSError
            If it does not answer.
        ValueError
            If the report cannot be meant.
        """


class I2cReader:
    """An `EventReader` of a chip on a bus.

    Parameters
    ----------
    settings : I2cTouch
        Bus and lines.
    chip : Chip
        What answers there.
    warnings : Counter of str
        The chip's counter too.

    Raises
    ------
    TouchError
        If bus, lines or chip are not there.
    """

    def __init__(self, settings: I2cTouch, chip: Chip, warnings: Counter[str]) -> None:
        self.warnings = warnings
        self._chip = chip
        self._lines = PanelLines(settings.interrupt_chip, settings.interrupt_line, settings.reset_line)
        self._bus = I2cBus(settings.bus, warnings)
        self._contacts = ContactEvents(sized=False)
        self._present = False
        self._starting: Iterator[float] | None = None
        self._next_s = 0.0
        self._edge_s: float | None = None  # of an edge whose report was not ready
        self._not_ready = 0
        self._report_s = 0.0
        try:
            for wait_s in self._start():
                time.sleep(wait_s)  # before the loop runs
        except OSError as error:
            self.close()
            raise TouchError(
                f"{chip.name} on {settings.bus} does not answer ({error.strerror}): check power, wiring, address and bus"
            ) from error
        except TouchError:
            self.close()
            raise

    @property
    def description(self) -> DeviceDescription:
        """Of the chip as it was started last."""
        return self._chip.description

    @property
    def present(self) -> bool:
        """Whether the chip answered when it was asked last."""
        return self._present

    def fileno(self) -> int | None:
        """Events of the interrupt line."""
        return self._lines.fileno()

    def next_time_s(self) -> float | None:
        """When to ask without an edge, or to go on starting."""
        return self._next_s

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of the newest report; see `EventReader.read`."""
        if not self._present:
            if now_s >= self._next_s:
                self._go_on_starting(now_s)
            return ()
        try:
            edge_s = self._lines.take_edges()
            if edge_s is not None:
                self._edge_s, self._not_ready = edge_s, 0
            elif now_s < self._next_s:
                return ()
            contacts = self._chip.fetch(self._bus)
        except OSError:
            return self._lost(now_s, "panel_lost")
        except ValueError:
            self.warnings["report_absurd"] += 1
            contacts = None
        if contacts is None:
            return self._nothing_new(now_s)
        time_s = now_s if self._edge_s is None else self._edge_s
        events = self._contacts.report(contacts, time_s)
        self._edge_s = None
        self._report_s = now_s
        self._next_s = now_s + (TOUCHED_POLL_S if self._contacts.down else IDLE_POLL_S)
        return events

    def close(self) -> None:
        """Give bus and lines back."""
        self._lines.close()
        self._bus.close()
        self._present = False

    def _nothing_new(self, now_s: float) -> Sequence[Event]:
        if self._contacts.down and now_s - self._report_s > STUCK_S:
            return self._lost(now_s, "contact_stuck")
        if self._edge_s is not None and self._not_ready < len(NOT_READY_S):
            self._next_s = now_s + NOT_READY_S[self._not_ready]
            self._not_ready += 1
        else:
            self._edge_s = None
            self._next_s = now_s + (TOUCHED_POLL_S if self._contacts.down else IDLE_POLL_S)
        return ()

    def _lost(self, now_s: float, kind: str) -> Sequence[Event]:
        """Lift every contact; the chip is started again after a while."""
        self.warnings[kind] += 1
        self._present = False
        self._edge_s = None
        self._lines.rest()
        self._next_s = now_s + RETRY_S
        return self._contacts.report((), now_s)

    def _start(self) -> Iterator[float]:
        yield from self._chip.start(self._bus, self._lines)
        self._lines.listen(self._chip.edge)
        self._contacts = ContactEvents(sized=ev.ABS_MT_TOUCH_MAJOR in self._chip.description.axes)
        self._present = True

    def _go_on_starting(self, now_s: float) -> None:
        """One step of a start: the loop goes on while the chip wakes up."""
        if self._starting is None:
            self._starting = self._start()
        try:
            self._next_s = now_s + next(self._starting)
        except StopIteration:
            self._starting = None
            self._report_s = now_s
            self._next_s = now_s
        except (OSError, TouchError):
            self._starting = None
            self._lines.rest()
            self._next_s = now_s + RETRY_S
