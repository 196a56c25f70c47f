"""Shares of a rollout as a publisher writes them: 1%@2026-12-01T08:00Z, once for each step."""

import re
from collections.abc import Sequence
from datetime import UTC, datetime
from decimal import Decimal
from typing import Any

from controller.device.board.records import as_record
from controller.device.update.trust.rollout import ALL_PPM, Rollout
from controller.errors import ConfigError, UsageError

_STEP = re.compile(r"(?P<share>[0-9]{1,6}(\.[0-9]{1,4})?)%@(?P<time>.+)")
FORM = "give a share and a time, such as --share 1%@2026-12-01T08:00Z"


def rollout_of(texts: Sequence[str]) -> Rollout | None:
    """The steps that these texts name; None without any; raises UsageError if they are no steps, or go backwards."""
    if not texts:
        return None
    try:
        return as_record("--share: ", {"steps": [_step(text) for text in texts]}, Rollout)
    except ConfigError as error:
        raise UsageError(f"{error}; {FORM}") from error


def _step(text: str) -> dict[str, Any]:
    found = _STEP.fullmatch(text)
    try:
        at = datetime.fromisoformat(found["time"]) if found else None
        if found is None or at is None or at.tzinfo is None:
            raise ValueError("no share, or no time with its zone")
        at = at.astimezone(UTC)
    except (ValueError, OverflowError) as error:
        raise UsageError(f"--share {text}: is no share from a time on, in UTC (Z) or with its zone: {FORM}") from error
    share_ppm = int(Decimal(found["share"]) * ALL_PPM / 100)
    if not 0 < share_ppm <= ALL_PPM:
        raise UsageError(f"--share {text}: the share must be above 0 and at most 100 %")
    return {"share_ppm": share_ppm, "at": at}
