"""A board without a touch panel, whose recording is replayed."""

from __future__ import annotations

from typing import Annotated, ClassVar

from msgspec import Meta

from controller.device.board.touch_panels import TouchPanel
from controller.device.touch.event_reader import EventReader
from controller.errors import TouchError


class RecordingTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="recording"):
    """No touch panel: a recording is replayed."""

    has_device: ClassVar[bool] = False

    ghost_ms: Annotated[float, Meta(ge=0, le=500)] = 0.0  # emissions cannot cause contacts in a recording


def open_panel(_: RecordingTouch) -> EventReader:
    """Refuse, as there is no device."""
    raise TouchError("the board has no touch panel: give its [touch] the kind of a panel, or replay a recording")
