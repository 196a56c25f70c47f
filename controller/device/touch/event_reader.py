"""Interface of every touch panel driver: input events, one report at a time, and a description of the device.

A driver of a panel without kernel driver gives events of the kernel's protocols too, so that one decoder, one recorder and
one replay serve all panels.
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
    """Description of an input device, as it stands in the head of an evemu recording."""

    name: str  # as the device reports it
    bus: int = 0  # bus, vendor, product, version: struct input_id
    vendor: int = 0
    product: int = 0
    version: int = 0
    properties: tuple[int, ...] = ()  # INPUT_PROP codes
    # Codes that it can send, by event type; under EV_SYN: the types
    codes: Mapping[int, tuple[int, ...]] = field(default_factory=dict)
    axes: Mapping[int, AxisInfo] = field(default_factory=dict)  # by code of EV_ABS
    remark: str = field(default="", compare=False)  # what the device lacks and works without, found at this opening; empty: nothing


class EventReader(Protocol):
    """One touch panel on a real interface.

    Its events can be decoded and recorded from the first one on: the stream begins with the state of the panel as a report;
    after a loss of events, and after a reconnection, the state comes as another report; when the panel is lost, a report
    lifts every contact.
    """

    warnings: Counter[str]  # anomalies that were handled, by kind (`reports.WARNINGS`)

    @property
    def description(self) -> DeviceDescription:
        """Description of the device as it was opened last; another object after each opening."""

    @property
    def present(self) -> bool:
        """Whether the device is connected; while it is lost, `read` tries to open it again at `next_time_s`."""

    def fileno(self) -> int | None:
        """File to wait on for reading; None while there is none. It changes when the device is opened again."""

    def next_time_s(self) -> float | None:
        """When to call `read` without a readable file, on the loop's clock; None: never."""

    def read(self, now_s: float) -> Sequence[Event]:
        """Take the events of at most one report: SYN_REPORT last, a long report in several parts; empty if there is none.

        It blocks for one bus transfer at most. Errors of the device are handled here: counted, or the device counts as lost.
        """

    def close(self) -> None:
        """Close the device."""
