"""The date on a device that may have no clock: never earlier than what is known for sure.

Known for sure are the time at which the running release was made, and the times that verified timestamps of the repository carry
(`x-issued`, signed); the larger of both is kept in a file. A clock that runs free is never kept: one wrong reading, and nothing
would be accepted any more. If the kept time is wrong all the same, remove the file `download/clock`.
"""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Final

from tuf.api.metadata import Root, Timestamp

from controller.update.durable import write_durably

ISSUED: Final = "x-issued"  # field of a timestamp: when it was signed
SYNCHRONIZED: Final = Path("/run/systemd/timesync/synchronized")  # there once the clock was set from the network
_FORMAT: Final = "%Y-%m-%dT%H:%M:%SZ"


def as_text(moment: datetime) -> str:
    """A moment as `x-issued` and the file have it, such as 2026-11-22T12:00:00Z."""
    return moment.astimezone(UTC).strftime(_FORMAT)


def earliest(clock: Path, built_s: int) -> datetime:
    """Time that it is at least.

    Parameters
    ----------
    clock : Path
        File with the time that was kept; one that holds none counts as absent.
    built_s : int
        When the running release was made, in s since 1970.
    """
    built = datetime.fromtimestamp(min(built_s, 4102444800), UTC)  # 2100: a manifest that says more is wrong
    try:
        kept = _moment(clock.read_text(encoding="ascii").strip())
    except (OSError, UnicodeDecodeError):
        kept = None
    return max(built, kept) if kept else built


def keep(clock: Path, timestamp: Timestamp, root: Root, now: datetime, synchronized: Path = SYNCHRONIZED) -> None:
    """Keep the time that verified metadata proves, and the clock's own if that was set from the network.

    Not more than the end of what was verified: a stolen key could otherwise push the time to where nothing is valid any more.

    Raises
    ------
    OSError
        If it cannot be written.
    """
    issued = _moment(timestamp.unrecognized_fields.get(ISSUED))
    known = [moment for moment in (issued, now if synchronized.exists() else None) if moment]
    if known:
        latest = min(max(known), timestamp.expires, root.expires)
        if latest > earliest(clock, 0):
            write_durably(clock, f"{as_text(latest)}\n".encode())


def _moment(text: object) -> datetime | None:
    try:
        return datetime.strptime(text, _FORMAT).replace(tzinfo=UTC) if isinstance(text, str) else None
    except ValueError:
        return None
