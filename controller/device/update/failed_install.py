"""An installation that failed: remembered, shown, and tried again by the timer ever more rarely, as its cause may have gone.

Its times are counted in looks of the timer: a device may have no clock.
"""

from __future__ import annotations

import hashlib
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Final

import msgspec
from msgspec import Meta

from controller.device.board.validation import NO_JSON
from controller.device.update.layout import Layout
from controller.device.update.manifest import Manifest
from controller.durable import write_durably

FILE: Final = "install_failed.json"  # in `Layout.download`
LOOKS_MAX: Final = 32  # of the timer, from one try to the next
WHY_MAX: Final = 300


class FailedInstall(msgspec.Struct, frozen=True, kw_only=True):
    """What is known of it."""

    version: Annotated[str, Meta(max_length=64)]
    manifest: str  # SHA-256 of its manifest: another release of that name is another one
    why: Annotated[str, Meta(max_length=WHY_MAX)]  # of the last try
    failures: Annotated[int, Meta(ge=1)]  # tries, all of which failed
    looks: Annotated[int, Meta(ge=0)] = 0  # of the timer since the last try

    @property
    def in_words(self) -> str:
        """One line for people."""
        times = "once" if self.failures == 1 else f"{self.failures} times"
        return f"release {self.version} could not be installed, {times}: {self.why}"


def failed_install(layout: Layout) -> FailedInstall | None:
    """The installation that failed; None if none did, or it is not known."""
    try:
        return msgspec.json.decode(_file(layout).read_bytes(), type=FailedInstall)
    except (OSError, *NO_JSON):
        return None


def remember(layout: Layout, manifest: Manifest, why: str) -> None:
    """Remember a failure, as far as the disk takes it."""
    known = _of(layout, manifest)
    failed = FailedInstall(
        version=manifest.version,
        manifest=_digest(manifest),
        why=" ".join(why.split())[:WHY_MAX],
        failures=known.failures + 1 if known else 1,
    )
    with suppress(OSError):
        write_durably(_file(layout), msgspec.json.encode(failed))


def forget(layout: Layout) -> None:
    """A release was installed."""
    with suppress(OSError):
        _file(layout).unlink(missing_ok=True)


def is_due(layout: Layout, manifest: Manifest) -> bool:
    """Whether the timer tries now: after the first failure at its next look, then at the second, the fourth, and so on."""
    known = _of(layout, manifest)
    if known is None or known.looks + 1 >= min(2 ** (known.failures - 1), LOOKS_MAX):
        return True
    with suppress(OSError):
        write_durably(_file(layout), msgspec.json.encode(msgspec.structs.replace(known, looks=known.looks + 1)))
    return False


def _of(layout: Layout, manifest: Manifest) -> FailedInstall | None:
    known = failed_install(layout)
    return known if known and known.manifest == _digest(manifest) else None


def _digest(manifest: Manifest) -> str:
    return hashlib.sha256(manifest.to_json()).hexdigest()


def _file(layout: Layout) -> Path:
    return layout.download / FILE
