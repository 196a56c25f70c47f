"""What the process that reads a touch panel says to the loop: a letter, and what belongs to it."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from typing import Final

import msgspec

from controller.touch.event_reader import DeviceDescription, Event

EVENTS: Final = ord("E")  # of one report
DESCRIPTION: Final = ord("D")  # of the device as it was opened now
PRESENT: Final = ord("P")
ABSENT: Final = ord("A")  # and why
WARNINGS: Final = ord("W")  # all so far, by kind
EVENT: Final = struct.Struct("=HHid")

_descriptions = msgspec.json.Decoder(DeviceDescription)
_warnings = msgspec.json.Decoder(dict[str, int])


def events_message(events: Sequence[Event]) -> bytes:
    """One report."""
    return bytes([EVENTS]) + b"".join([EVENT.pack(*event) for event in events])


def events_of(body: memoryview) -> list[Event]:
    """Events of a report."""
    return list(EVENT.iter_unpack(body))


def description_message(description: DeviceDescription) -> bytes:
    """A device's description."""
    return bytes([DESCRIPTION]) + msgspec.json.encode(description)


def description_of(body: memoryview) -> DeviceDescription:
    """Another object each time."""
    return _descriptions.decode(body)


def warnings_message(warnings: Mapping[str, int]) -> bytes:
    """What was got over so far."""
    return bytes([WARNINGS]) + msgspec.json.encode(dict(warnings))


def warnings_of(body: memoryview) -> dict[str, int]:
    """What was got over so far."""
    return _warnings.decode(body)


def presence_message(cause: str | None) -> bytes:
    """That the panel is there (None), or why it is not."""
    return bytes([PRESENT]) if cause is None else bytes([ABSENT]) + cause.encode(errors="replace")[:1024]
