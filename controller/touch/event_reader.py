"""What every driver of a touch panel gives: input events, a report at a time, and a description of the device.

A driver of a panel without kernel driver speaks the kernel's language too (protocol A or B), so that one
decoder, one recorder and one replay serve all.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

Event = tuple[int, int, int, float]  # type, code, value, time in s on the loop's clock


class AxisInfo(NamedTuple):
    """struct input_absinfo without its value."""

    minimum: int
    maximum: int
    fuzz: int = 0
    flat: int = 0
    resolution: int = 0  # units per mm, 0 unknown


@dataclass(frozen=True, slots=True)
class DeviceDescription:
    """What a device says of itself, as an evemu recording keeps it."""

    name: str
    bus: int = 0
    vendor: int = 0
    product: int = 0
    version: int = 0
    properties: tuple[int, ...] = ()
    codes: Mapping[int, tuple[int, ...]] = field(default_factory=dict)  # by event type; of EV_SYN: the types
    axes: Mapping[int, AxisInfo] = field(default_factory=dict)  # by code of EV_ABS


class EventReader(Protocol):
    """One touch panel on a real interface.

    What it gives is a stream that any decoder understands from its first event on, and that a recording can hold:
    it begins with the state of the panel as a report; after lost events, and when the panel was plugged in again, the
    state comes as another report; when the panel goes, a report lifts every contact.

    Attributes
    ----------
    warnings : Counter of str
        What went wrong so far and was got over, by kind (`warnings.KINDS`).
    """

    warnings: Counter[str]

    @property
    def description(self) -> DeviceDescription:
        """Of the device as it was opened last; another object after it was opened again."""

    @property
    def present(self) -> bool:
        """Whether the device is there; while it is not, `read` tries to open it again at `next_time_s`."""

    def fileno(self) -> int | None:
        """File to wait on for reading; None while there is none. Another one after the device was opened again."""

    def next_time_s(self) -> float | None:
        """When to call `read` though no file is readable, on the loop's clock; None: never."""

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of at most one report, SYN_REPORT last; empty if there is none. A long report comes in parts.

        Never blocks longer than a transfer lasts, and never raises for what a device may do: it is got over, or the
        device is taken for lost.
        """

    def close(self) -> None:
        """Give the device back."""
