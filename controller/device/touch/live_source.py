"""A touch panel on a real interface as a source of touch samples: events of its driver, decoded."""

from __future__ import annotations

from collections import Counter
from math import inf
from typing import TYPE_CHECKING

from controller.device.touch import event_codes as ev
from controller.device.touch.axes import AxisRange, PanelAxes
from controller.device.touch.decoder import Decoder
from controller.device.touch.event_codes import Protocol, protocol_of_device
from controller.device.touch.event_reader import EventReader
from controller.device.touch.reports import ReportClock
from controller.device.touch.source import Counts, Silence, TouchedPlate, TouchSample

if TYPE_CHECKING:
    from controller.device.board.board import Board


class LiveSource:
    """Driver and decoder of a panel; a `TouchSource`.

    When the panel is lost its fingers are released. After a reconnection its axes are read again and new fingers begin.
    """

    def __init__(self, reader: EventReader, board: Board | TouchedPlate) -> None:
        self.silence = Silence()  # to be set before a read by whoever waits for `fileno`
        self.touched = False  # see `TouchSource.touched`
        self._reader = reader
        self.fileno = reader.fileno  # it changes when the panel is opened again; None while the panel is lost
        self.close = reader.close
        self._board = board
        self._own_warnings: Counter[str] = Counter()
        self._clock = ReportClock(self._own_warnings)
        self._decoder = self._renewed(None)
        self.counts: Counts = self._decoder.counts  # reports, contacts and fingers since the start, reconnections included

    @property
    def warnings(self) -> Counter[str]:
        """Anomalies found by driver, decoder and report clock, by kind."""
        return self._reader.warnings + self._decoder.warnings + self._own_warnings

    @property
    def present(self) -> bool:
        """Whether the panel is connected."""
        return self._reader.present

    def next_time_s(self) -> float | None:
        """When the driver wants to be read (`EventReader.next_time_s`), or a decision is due without a report."""
        due_s, decision_s = self._reader.next_time_s(), self._decoder.due_s
        if decision_s == inf or (due_s is not None and due_s <= decision_s):
            return due_s
        return decision_s

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of at most one report by `now_s`; see `TouchSource.read`."""
        self.touched = False
        if self.silence.known:
            due_s = self._reader.next_time_s()
            if due_s is None or due_s > now_s:  # without a system call
                return self._decoder.overdue(now_s) if self._decoder.due_s <= now_s else ()
        events = self._reader.read(now_s)
        if not events:
            return self._decoder.overdue(now_s) if self._decoder.due_s <= now_s else ()
        if self._reader.description is not self._description:
            self._decoder = self._renewed(self._decoder)
        time_s = self._clock.corrected_s(events[-1][3], now_s)
        samples = self._decoder.feed_report(events, time_s)
        self.touched = self._decoder.touched
        return samples or ()

    def _renewed(self, before: Decoder | None) -> Decoder:
        """Decoder for the device as its driver describes it now, after the one before a reconnection."""
        self._description = description = self._reader.description
        protocol = protocol_of_device(description.axes)
        codes = ev.POSITIONS_SINGLE if protocol is Protocol.SINGLE else ev.POSITIONS
        x, y = (AxisRange(description.axes[code].minimum, description.axes[code].maximum) for code in codes)
        self.axes: PanelAxes = PanelAxes(self._board, x, y)
        slots = description.axes.get(ev.ABS_MT_SLOT)
        return Decoder(self.axes, protocol, last_slot=slots.maximum if slots else None, after=before)
