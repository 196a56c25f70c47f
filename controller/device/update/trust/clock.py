"""The date on a device that may have no clock: never earlier than what is known for sure.

Known for sure are the time at which the running release was made, and the times that verified timestamps of the repository carry
(`x-issued`, signed); the larger of both is kept in a file. A clock that runs free is never kept: one wrong reading, and nothing
would be accepted any more.

A timestamp is signed by one key. Alone it moves the kept time by at most the life of a timestamp from what two people have signed
(`x-issued` of root and targets) or what was kept before, so that the owner's next timestamp is still valid by it, and never to
where root or targets end. A newer root, which two people sign, makes the device forget what was kept under the older one: whoever
has stolen the key has no say after it was changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Final, Self

from tuf.api.metadata import Root, Signed, Targets, Timestamp

from controller.durable import write_durably
from controller.regular_file import read_regular

ISSUED: Final = "x-issued"  # field of a timestamp, and of root and targets: when it was made
TIMESTAMP_LIFE: Final = timedelta(days=90)
SYNCHRONIZED: Final = Path("/run/systemd/timesync/synchronized")  # there once the clock was set from the network
BYTES_MAX: Final = 1024
_FORMAT: Final = "%Y-%m-%dT%H:%M:%SZ"


@dataclass(frozen=True, slots=True)
class Kept:
    """A time that was kept, and what of the repository it was kept under."""

    moment: datetime
    # root_version, timestamp_version: 0 in a file of an earlier release, which has the time alone: any root is newer
    root_version: int = 0
    timestamp_version: int = 0

    @classmethod
    def read(cls, clock: Path) -> Self | None:
        """What a file has; None if it is absent, or holds no time."""
        try:
            time, *versions = read_regular(clock, BYTES_MAX).decode("ascii").split()
            root_version, timestamp_version = map(int, versions) if versions else (0, 0)
        except (OSError, ValueError):
            return None
        moment = _moment(time)
        return cls(moment, root_version, timestamp_version) if moment else None

    def counts_under(self, root: Root) -> bool:
        """Whether no newer root was taken since."""
        return self.root_version >= root.version


def as_text(moment: datetime) -> str:
    """A moment as `x-issued` and the file have it, such as 2026-11-22T12:00:00Z."""
    return moment.astimezone(UTC).strftime(_FORMAT)


def issued(signed: Signed) -> datetime | None:
    """When metadata was made, as it says itself; None if it does not."""
    return _moment(signed.unrecognized_fields.get(ISSUED))


def built(built_s: int) -> datetime:
    """When a release was made, in s since 1970: it is later than that on each device that runs it."""
    return datetime.fromtimestamp(min(built_s, 4102444800), UTC)  # 2100: a manifest that says more is wrong


def earliest(clock: Path, built_s: int) -> datetime:
    """Time that it is at least, by a file with the time that was kept; one that holds none counts as absent.

    The running release was made at `built_s`, in s since 1970.
    """
    kept = Kept.read(clock)
    return max(built(built_s), kept.moment) if kept else built(built_s)


def keep(clock: Path, root: Root, targets: Targets, timestamp: Timestamp, now: datetime, synchronized: Path = SYNCHRONIZED) -> None:
    """Keep the time that verified metadata proves, and the clock's own if that was set from the network.

    Raises OSError if it cannot be written.
    """
    kept = Kept.read(clock)
    if kept and not kept.counts_under(root):
        kept = None
    elif kept and kept.root_version > root.version:
        return  # an old repository, since what was verified has been lost
    says = issued(timestamp)
    known = [now] if synchronized.exists() else []
    if says and (kept is None or timestamp.version > kept.timestamp_version):  # one that is read again moves nothing
        proven = [moment for moment in (issued(root), issued(targets)) if moment]
        if proven:
            says = min(says, max([*proven, *([kept.moment] if kept else [])]) + TIMESTAMP_LIFE)
        known.append(says)
    if known:
        latest = min(max(known), timestamp.expires, targets.expires, root.expires)
        version = timestamp.version
        if kept:
            latest, version = max(latest, kept.moment), max(version, kept.timestamp_version)
        new = Kept(latest, root.version, version)
        if new != kept:
            write_durably(clock, f"{as_text(latest)} {new.root_version} {new.timestamp_version}\n".encode())


def _moment(text: object) -> datetime | None:
    try:
        return datetime.strptime(text, _FORMAT).replace(tzinfo=UTC) if isinstance(text, str) else None
    except ValueError:
        return None
