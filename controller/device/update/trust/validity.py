"""What of updates ends or begins on a date: the trusted root, and the device's clock, for people and doctor."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from typing import Final

from controller.device.update.installed import manifest_of
from controller.device.update.layout import Layout
from controller.errors import UpdateError
from controller.regular_file import read_regular

SOON_DAYS: Final = 90
ROOT_BYTES_MAX: Final = 64_000


def root_expiry(layout: Layout) -> tuple[str, bool]:
    """Until when the newest root that this device has is valid: the package's, or one that followed it.

    Returns that in words, and whether it ends soon, or there is none. Raises UpdateError if it has expired, or is damaged.
    """
    if not layout.trusted_root.exists():
        return f"there is no {layout.trusted_root}: this device takes no updates", True
    newest = layout.download / "metadata" / "root.json"
    if newest.is_symlink():  # python-tuf's, to the newest of root_history
        newest = newest.parent / "root_history" / newest.readlink().name
    file = newest if newest.exists() else layout.trusted_root
    try:
        data = read_regular(file, ROOT_BYTES_MAX, links=file == layout.trusted_root)
    except OSError as error:
        raise UpdateError(f"{file}: cannot be read ({error.strerror})") from error
    try:
        expires = datetime.fromisoformat(json.loads(data)["signed"]["expires"])
        left_days = (expires - datetime.now(UTC)).days
    except (ValueError, KeyError, TypeError) as error:
        raise UpdateError(f"{file}: is no root.json of a repository: install the package again") from error
    said = f"{file} expires on {expires:%Y-%m-%d}"
    if left_days < 0:
        raise UpdateError(f"{said}: no update is taken until its owner publishes a newer one, or the clock is right")
    return said, left_days < SOON_DAYS


def clock_reported(layout: Layout) -> tuple[str, bool]:
    """What the device's clock says, and what it is at least; whether it is before that.

    Raises ModuleNotFoundError without the extra `update`.
    """
    from controller.device.update.trust.clock import as_text, earliest  # noqa: PLC0415 - needs tuf

    manifest = manifest_of(layout.current)
    known, says = earliest(layout.download / "clock", manifest.built_s if manifest else 0), datetime.now(UTC)
    if says < known:
        return f"it says {as_text(says)}, and it is {as_text(known)} at least, which is used for updates", True
    return f"{as_text(says)}, not before {as_text(known)}", False
