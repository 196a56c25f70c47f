"""Steps of a page's mouse, on their way to what measures the touch panel's lag."""

from __future__ import annotations

from typing import Annotated, Final

import msgspec
from msgspec import Meta

MAX_STEPS: Final = 1000  # in a message


class Steps(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a page sends some times a second: when, by its clock, and the steps (time in ms, x, y) since the last such message."""

    sent_ms: float
    steps: Annotated[tuple[tuple[float, float, float], ...], Meta(max_length=MAX_STEPS)]
    answered: tuple[float, float] | None = None  # the last answer: when it was sent in s by ours, when it came in ms by the page's


class MouseSteps(Steps, frozen=True, kw_only=True, forbid_unknown_fields=True, tag_field="kind", tag="mouse"):
    """The page's message; answered with the time, by the panel's clock."""

    id: int | str | None = None


class ArrivedSteps(Steps, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The same, as the bridge hands it on: when it came, by the panel's clock."""

    arrived_s: float
