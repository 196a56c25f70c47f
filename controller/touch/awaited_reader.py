"""A touch panel that may be absent when the service starts: the lost state of its driver, before there is a driver."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Final

from controller.errors import TouchError
from controller.touch import event_codes as ev
from controller.touch.event_reader import AxisInfo, DeviceDescription, Event, EventReader

RETRY_S: Final = 0.5
LOST: Final = "the touch panel is lost; it is looked for twice a second"
UNSEEN: Final = DeviceDescription("not there yet", axes=dict.fromkeys(ev.POSITIONS_SINGLE, AxisInfo(0, 1)))  # gives no event


class AwaitedReader:
    """An `EventReader` by another one, made as soon as that can be done.

    Parameters
    ----------
    open_reader : callable
        Makes it, without blocking, or raises TouchError.

    Attributes
    ----------
    warnings : Counter of str
        Of the driver.
    """

    def __init__(self, open_reader: Callable[[], EventReader]) -> None:
        self._open = open_reader
        self._reader: EventReader | None = None
        self.warnings: Counter[str] = Counter()
        self._why_not = ""
        self._retry_s = 0.0

    @property
    def description(self) -> DeviceDescription:
        """Of the device as it was opened last; `UNSEEN` before."""
        return UNSEEN if self._reader is None else self._reader.description

    @property
    def present(self) -> bool:
        """Whether the device is there."""
        return self._reader is not None and self._reader.present

    @property
    def cause(self) -> str:
        """Why it is not there, in words; empty while it is, and before it was looked for."""
        if self._reader is None:
            return self._why_not
        return "" if self._reader.present else LOST

    def fileno(self) -> int | None:
        """The driver's file."""
        return None if self._reader is None else self._reader.fileno()

    def next_time_s(self) -> float | None:
        """When to call `read` though no file is readable."""
        return self._retry_s if self._reader is None else self._reader.next_time_s()

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report; see `EventReader.read`."""
        if self._reader is not None:
            return self._reader.read(now_s)
        if now_s >= self._retry_s:
            self._retry_s = now_s + RETRY_S
            try:
                self._reader = self._open()
            except TouchError as error:
                self._why_not = str(error)
            else:
                self.warnings = self._reader.warnings
        return ()

    def close(self) -> None:
        """Give the device back."""
        if self._reader is not None:
            self._reader.close()
