"""A touch panel on a real interface as a source of touch samples: what a driver reads goes through the decoder."""

from __future__ import annotations

from collections import Counter

from controller.board.board import Board
from controller.touch import event_codes as ev
from controller.touch.axes import Axes, AxisRange
from controller.touch.decoder import Decoder
from controller.touch.event_reader import EventReader
from controller.touch.panel import Counts, Protocol, protocol_of_device
from controller.touch.report_times import ReportTimes
from controller.touch.samples import TouchSample


class LiveSource:
    """A panel's reader and its decoder; a `TouchSource`.

    A panel that goes away has its fingers released; when it is back, with whatever axes it has then, new ones begin.

    Parameters
    ----------
    reader : EventReader
        The driver.
    board : Board
        Gives the plate and where the panel's axes lie on it.
    """

    def __init__(self, reader: EventReader, board: Board) -> None:
        self._reader = reader
        self._board = board
        self._own_warnings: Counter[str] = Counter()
        self._times = ReportTimes(self._own_warnings)
        self._decoder: Decoder | None = None
        self._decoder = self._renewed()

    @property
    def axes(self) -> Axes:
        """Axes of the panel as it was opened last."""
        return self._axes

    @property
    def counts(self) -> Counts:
        """Reports, contacts and fingers so far, from before a loss too."""
        return self._decoder.counts if self._decoder else Counts()

    @property
    def warnings(self) -> Counter[str]:
        """Of the driver, of the decoder, and of times."""
        decoded = self._decoder.warnings if self._decoder else Counter[str]()
        return self._reader.warnings + decoded + self._own_warnings

    @property
    def present(self) -> bool:
        """Whether the panel is there."""
        return self._reader.present

    def fileno(self) -> int | None:
        """The driver's file; another one after the panel was opened again, none while it is lost."""
        return self._reader.fileno()

    def next_time_s(self) -> float | None:
        """When to call `read` though the file is not readable."""
        return self._reader.next_time_s()

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of at most one report; see `TouchSource.read`."""
        events = self._reader.read(now_s)
        if not events:
            return ()
        if self._reader.description is not self._description:
            self._decoder = self._renewed()
        assert self._decoder is not None
        feed = self._decoder.feed
        time_s = self._times.settled(events[-1][3], now_s)
        samples = None
        for kind, code, value, _ in events:
            samples = feed(kind, code, value, time_s)
        return samples or ()

    def close(self) -> None:
        """Give the panel back."""
        self._reader.close()

    def _renewed(self) -> Decoder:
        """A decoder for the device as its reader describes it now."""
        self._description = description = self._reader.description
        protocol = protocol_of_device(description.axes)
        codes = ev.POSITIONS_SINGLE if protocol is Protocol.SINGLE else ev.POSITIONS
        x, y = (AxisRange(description.axes[code].minimum, description.axes[code].maximum) for code in codes)
        self._axes = Axes(self._board, x, y)
        slots = description.axes.get(ev.ABS_MT_SLOT)
        return Decoder(self._axes, protocol, last_slot=slots.maximum if slots else None, after=self._decoder)
