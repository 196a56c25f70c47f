"""Which devices may take a release yet: shares with times, signed by those who sign releases, and releases that were stopped.

Shares are the field `custom.rollout` of a manifest in the targets metadata. Each device has a place in the order of each release, a
hash of its machine-id and the version, and takes the release once the share exceeds its place. A step after the first also waits
until the publisher's timestamp opens it (`x-opened`), so that nothing grows unless somebody has looked; the timestamp names the
versions that were stopped too (`x-stopped`). Its key alone can withhold a release, and can never hand it out sooner.
"""

from __future__ import annotations

import hashlib
from datetime import UTC, datetime
from itertools import pairwise
from typing import Annotated, Any, Final

from msgspec import Meta
from tuf.api.metadata import Signed

from controller.device.board.identity import machine_id
from controller.device.board.records import Record, as_record
from controller.device.update.layout import Layout
from controller.device.update.trust.clock import as_text
from controller.errors import ConfigError, UpdateError

STOPPED: Final = "x-stopped"  # field of the timestamp: versions that no further device takes
OPENED: Final = "x-opened"  # field of the timestamp: by version the share up to which its steps are open
ALL_PPM: Final = 1_000_000  # in parts per million: signed metadata has no fractions
STEPS_MAX: Final = 32
FROM, UNTIL = datetime(2020, 1, 1, tzinfo=UTC), datetime(2200, 1, 1, tzinfo=UTC)


class Step(Record, frozen=True):
    """A share of the devices, and from when on they may take the release."""

    share_ppm: Annotated[int, Meta(ge=1, le=ALL_PPM)]
    at: Annotated[datetime, Meta(tz=True)]

    def __post_init__(self) -> None:
        if not FROM <= self.at < UNTIL:
            raise ValueError(f"at = {self.at.isoformat()} is not between {FROM:%Y} and {UNTIL:%Y}")

    def __str__(self) -> str:
        return f"{percent(self.share_ppm)} from {as_text(self.at)}"


class Rollout(Record, frozen=True):
    """Steps of a release; before the first no device takes it, after the last its share stays.

    The first step comes at its time, others not before they are opened too: `opened_ppm` is the share up to which they are.
    """

    steps: Annotated[list[Step], Meta(min_length=1, max_length=STEPS_MAX)]

    def __post_init__(self) -> None:
        for one, other in pairwise(self.steps):
            if other.share_ppm <= one.share_ppm or other.at <= one.at:
                raise ValueError(f"steps: {other} does not follow {one}: shares and times both increase")

    def open_steps(self, opened_ppm: int) -> list[Step]:
        """Steps that come at their time: the first, and those that were opened."""
        return [step for step in self.steps if step is self.steps[0] or step.share_ppm <= opened_ppm]

    def share_ppm(self, now: datetime, opened_ppm: int) -> int:
        """Share of the devices that may take the release now."""
        return max((step.share_ppm for step in self.open_steps(opened_ppm) if step.at <= now), default=0)

    def why_not_yet(self, place_ppm: int, now: datetime, opened_ppm: int) -> str:
        """Why a device at this place does not take the release now; empty if it may."""
        share_ppm = self.share_ppm(now, opened_ppm)
        if place_ppm < share_ppm:
            return ""
        due = next((step for step in self.steps if place_ppm < step.share_ppm), None)
        when = "at no time that is set yet"
        if due:
            is_open = due in self.open_steps(opened_ppm)
            when = f"from {as_text(due.at)} on" + ("" if is_open else ", once its publisher has opened that step")
        return f"is for {percent(share_ppm)} of the devices at {as_text(now)}, and for this one {when}"

    def __str__(self) -> str:
        return ", ".join(map(str, self.steps))


def percent(share_ppm: int) -> str:
    """A share as text, such as 0.5 %."""
    return f"{share_ppm / 10_000:.6g} %"


def place_ppm(machine_id: str, version: str) -> int:
    """Place of a device in the order of a release, 0 to 999,999: always the same for the same release, unrelated for another.

    As machine-id(5) asks, the machine-id itself never leaves the device: it is hashed, and its place is reported to nobody.
    """
    digest = hashlib.sha256(f"haptic-panel rollout\n{machine_id}\n{version}".encode()).digest()
    return int.from_bytes(digest[:8], "big") * ALL_PPM >> 64


def place_of(layout: Layout, version: str) -> int:
    """Place of this device; the last of all if it has no machine-id."""
    found = machine_id(layout.machine_id)
    return ALL_PPM - 1 if found is None else place_ppm(found, version)


def read_rollout(custom: Any, origin: str) -> Rollout | None:
    """The steps in a target's `custom` field; None if it has none.

    `origin` is what the target is called in errors. Raises UpdateError if they are no steps.
    """
    if custom is None:
        return None
    if not isinstance(custom, dict):
        raise UpdateError(f"{origin}: custom: is not an object: refused; the repository has to be made again")
    if "rollout" not in custom:
        return None
    try:
        return as_record(f"{origin}: ", {"rollout": custom["rollout"]}, _Custom).rollout
    except ConfigError as error:
        raise UpdateError(f"{error}: refused; the repository has to be made again") from error


def stopped_by(timestamp: Signed, origin: str) -> list[str]:
    """Versions that a timestamp names as stopped; raises UpdateError if it does not list them as text."""
    versions = timestamp.unrecognized_fields.get(STOPPED, [])
    if not isinstance(versions, list) or not all(isinstance(version, str) for version in versions):
        raise UpdateError(f"{origin}: {STOPPED} of its timestamp is no list of versions: refused; it has to be signed again")
    return versions


def opened_by(timestamp: Signed, origin: str) -> dict[str, int]:
    """Shares in ppm up to which a timestamp opens the steps of versions; raises UpdateError if they are no such shares."""
    shares = timestamp.unrecognized_fields.get(OPENED, {})
    if not isinstance(shares, dict) or not all(type(share) is int and 0 < share <= ALL_PPM for share in shares.values()):
        raise UpdateError(f"{origin}: {OPENED} of its timestamp is no share by version: refused; it has to be signed again")
    return shares


class _Custom(Record, frozen=True):
    rollout: Rollout
