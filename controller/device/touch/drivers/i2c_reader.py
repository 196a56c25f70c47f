"""Driver of touch controllers on an I2C bus: when to read them, and how to recover when they do not answer.

The chip signals a report by an edge of its interrupt line. An edge may be missed, so a panel that is touched is also polled
every `TOUCHED_POLL_S`, and an idle one every `IDLE_POLL_S`, which detects that it is lost. Until the line has proved that it
announces reports, and where it does not or is not there, the chip is polled at the rate of its scans (`interrupt_watch.py`).
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Final, Protocol

from gpiod.line import Edge

from controller.device.board.touch_panels import I2cTouch
from controller.device.touch import event_codes as ev
from controller.device.touch.drivers.contact_events import ContactEvents, ReportedContact
from controller.device.touch.drivers.i2c_bus import I2cBus
from controller.device.touch.drivers.interrupt_watch import InterruptWatch
from controller.device.touch.drivers.panel_lines import PanelLines
from controller.device.touch.event_reader import DeviceDescription, Event
from controller.errors import TouchError

TOUCHED_POLL_S: Final = 0.03
IDLE_POLL_S: Final = 0.1  # no longer than most taps: a line that breaks is noticed by the next one or two
NOT_READY_DELAYS_S: Final = (0.002, 0.004, 0.008, 0.01)  # before reading again after an edge without a report
STUCK_TIMEOUT_S: Final = 0.5  # without a report of a touched chip: then it is started again
RETRY_S: Final = 0.5  # between attempts to start a lost chip


class Chip(Protocol):
    """A touch controller: its start sequence, and how a report is read."""

    name: str  # in messages
    scan_s: float  # time between its scans for contacts, as far as known; another one perhaps after each start
    # `fetch` gives a report once, and None as long as there is no other; else it gives the state, again and again
    marks_reports: bool

    def start(self, bus: I2cBus, lines: PanelLines) -> Iterator[float]:
        """Reset and identify the chip; yields the time in s to wait before the next step.

        Raises OSError if it does not answer; TouchError if another device answers.
        """

    @property
    def description(self) -> DeviceDescription:
        """Description of the chip as it was started last; another object after each start."""

    @property
    def rising(self) -> bool:
        """Whether the interrupt line rises to signal a report; else it falls."""

    def fetch(self, bus: I2cBus) -> Sequence[ReportedContact] | None:
        """Read the newest report: all contacts that are down.

        None if there is no new report, or none that can be believed. Raises OSError if it does not answer; ValueError if the report
        has impossible content.
        """


class I2cReader:
    """An `EventReader` of a chip on a bus.

    `settings` gives bus and lines, unless they are `wired` already; `warnings` is shared with the chip. Raises TouchError if bus,
    lines or chip are absent.
    """

    def __init__(
        self, settings: I2cTouch, chip: Chip, warnings: Counter[str], wired: tuple[PanelLines, I2cBus] | None = None
    ) -> None:
        self.warnings = warnings
        self._chip = chip
        lines = settings.interrupt_chip, settings.interrupt_line, settings.reset_line
        self._lines, self._bus = wired or (PanelLines(*lines), I2cBus(settings.bus, warnings))
        self._contacts = ContactEvents(sized=False)
        self.present = False  # whether the chip answered the last transfer
        self.fileno = self._lines.fileno  # of the interrupt line
        self._starting: Iterator[float] | None = None
        self._next_s = 0.0
        self._edge_s: float | None = None  # of an edge without a report so far
        self._not_ready = 0
        self._report_s = 0.0
        self._watch = InterruptWatch(warnings, wired=self._lines.has_interrupt)
        self._rest_seen = False
        try:
            for wait_s in self._start():
                time.sleep(wait_s)  # in the panel's own process
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
        """Description of the chip as it was started last."""
        return self._chip.description

    def next_time_s(self) -> float | None:
        """When to read without an edge, or to do the next step of a start."""
        return self._next_s

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of the newest report by `now_s`; see `EventReader.read`."""
        if not self.present:
            if now_s >= self._next_s:
                self._continue_start(now_s)
            return ()
        meanwhile_s = None
        try:
            edge_s = self._edge(now_s)
            if edge_s is not None:
                self._edge_s, self._not_ready = edge_s, 0
            elif now_s < self._next_s:
                return ()
            contacts = self._chip.fetch(self._bus)
            meanwhile_s = self._edge(now_s) if self._edge_s is None and (contacts or self._contacts.down) else None
            if not (self._rest_seen or contacts or self._contacts.down) and (contacts is not None or self._chip.marks_reports):
                self._look_at_rest()
        except OSError:
            return self._lost(now_s, "panel_lost")
        except ValueError:
            self.warnings["report_absurd"] += 1
            contacts = None
        if contacts is None:
            return self._no_report(now_s)
        announced_s, self._edge_s = self._edge_s, None
        time_s = next((edge_s for edge_s in (announced_s, meanwhile_s) if edge_s is not None), now_s)
        events = self._contacts.report(contacts, time_s)
        if events or self._chip.marks_reports:
            self._watch.report(announced=announced_s is not None, edge_meanwhile=meanwhile_s is not None)
        self._report_s = now_s
        self._next_s = now_s + self._poll_s()
        return events

    def close(self) -> None:
        """Close bus and lines."""
        self._lines.close()
        self._bus.close()
        self.present = False

    def _no_report(self, now_s: float) -> Sequence[Event]:
        if self._contacts.down and now_s - self._report_s > STUCK_TIMEOUT_S:
            return self._lost(now_s, "contact_stuck")
        if self._edge_s is not None and self._not_ready < len(NOT_READY_DELAYS_S):
            self._next_s = now_s + NOT_READY_DELAYS_S[self._not_ready]
            self._not_ready += 1
        else:
            self._edge_s = None
            self._next_s = now_s + self._poll_s()
        return ()

    def _poll_s(self) -> float:
        """Time until the chip is read without an edge."""
        if self._watch.polled:
            return self._chip.scan_s
        return TOUCHED_POLL_S if self._contacts.down else IDLE_POLL_S

    def _edge(self, now_s: float) -> float | None:
        """Time of the last edge since it was asked for, None if there was none; a line with edges without end is let go."""
        before = self._lines.edges
        edge_s = self._lines.read_edges()
        if edge_s is not None:
            self._watch.edges(self._lines.edges - before, now_s)
            if self._watch.ignored:
                self._lines.release_interrupt()
        return edge_s

    def _look_at_rest(self) -> None:
        """Compare the interrupt line with the level that it rests at, once after each start, when nothing is touched."""
        self._rest_seen = True
        high = self._lines.interrupt_high()
        if high is not None and high is self._chip.rising:
            self.warnings["interrupt_active"] += 1

    def _lost(self, now_s: float, kind: str) -> Sequence[Event]:
        """Lift every contact of a lost chip, which is started again after `RETRY_S`."""
        self.warnings[kind] += 1
        self.present = False
        self._edge_s = None
        self._lines.release_interrupt()
        self._next_s = now_s + RETRY_S
        return self._contacts.report((), now_s)

    def _start(self) -> Iterator[float]:
        yield from self._chip.start(self._bus, self._lines)
        self._lines.listen(Edge.RISING if self._chip.rising else Edge.FALLING)
        self._contacts = ContactEvents(sized=ev.ABS_MT_TOUCH_MAJOR in self._chip.description.axes)
        self._watch.started()
        self._rest_seen = False
        self.present = True

    def _continue_start(self, now_s: float) -> None:
        """Do one step of a start; other reads go on between the steps."""
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
            self._lines.release_interrupt()
            self._next_s = now_s + RETRY_S
