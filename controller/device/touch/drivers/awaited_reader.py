"""A touch panel that may be absent when the service starts: the driver is opened as soon as that is possible."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Final

from controller.device.touch import event_codes as ev
from controller.device.touch.event_reader import AxisInfo, DeviceDescription, Event, EventReader
from controller.errors import TouchError

RETRY_S: Final = 0.5
LOST: Final = "the touch panel is lost; the service tries to reconnect twice a second"
NO_DEVICE: Final = DeviceDescription("no device yet", axes=dict.fromkeys(ev.POSITIONS_SINGLE, AxisInfo(0, 1)))  # gives no event


class AwaitedReader:
    """An `EventReader` that opens another one, at once or later.

    `open_reader` opens the driver without blocking, or raises TouchError.
    """

    def __init__(self, open_reader: Callable[[], EventReader]) -> None:
        self._open = open_reader
        self._reader: EventReader | None = None
        self.warnings: Counter[str] = Counter()  # anomalies found by the driver, by kind
        self._open_error = ""
        self._retry_s = 0.0

    @property
    def description(self) -> DeviceDescription:
        """Of the device as it was opened last; `NO_DEVICE` before."""
        return NO_DEVICE if self._reader is None else self._reader.description

    @property
    def present(self) -> bool:
        """Whether the device is connected."""
        return self._reader is not None and self._reader.present

    @property
    def cause(self) -> str:
        """Why the device is not connected; empty while it is, and before the first attempt to open it."""
        if self._reader is None:
            return self._open_error
        return "" if self._reader.present else LOST

    def fileno(self) -> int | None:
        """File of the driver; None before it is opened."""
        return None if self._reader is None else self._reader.fileno()

    def next_time_s(self) -> float | None:
        """When to open the driver, or when it wants to be read; see `EventReader.next_time_s`."""
        return self._retry_s if self._reader is None else self._reader.next_time_s()

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report by `now_s`; see `EventReader.read`."""
        if self._reader is not None:
            return self._reader.read(now_s)
        if now_s >= self._retry_s:
            self._retry_s = now_s + RETRY_S
            try:
                self._reader = self._open()
            except TouchError as error:
                self._open_error = str(error)
            else:
                self.warnings = self._reader.warnings
        return ()

    def close(self) -> None:
        """Close the device."""
        if self._reader is not None:
            self._reader.close()
