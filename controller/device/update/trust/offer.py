"""What a repository offers this device, and why it is not taken."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from controller.device.board.records import as_record
from controller.device.update.installed import manifest_of
from controller.device.update.layout import WORDS_BYTES_MAX, Layout
from controller.device.update.manifest import (
    FALL_BACK_INTERFACE,
    MANIFEST_BYTES_MAX,
    Channel,
    Manifest,
    read_manifest,
    read_object,
    this_platform,
)
from controller.device.update.trust.rollout import place_of, read_rollout
from controller.device.update.trust.trust import DeviceUpdater
from controller.errors import ConfigError, UpdateError
from controller.regular_file import read_regular

CHANNEL_BYTES_MAX: Final = 64_000
COUNTER: Final = "counter"  # file below `download`: counter of the newest release that was fetched


class NotYetError(UpdateError):
    """A release that is offered, and not for this device yet, or not any more: there is nothing to do."""


@dataclass(frozen=True, slots=True)
class Offer:
    """What a channel offers."""

    channel: str
    platform: str
    manifest: Manifest | None  # None if there is nothing for this platform
    data: bytes  # the manifest as it was signed
    installed: Manifest | None  # the release in use
    refused: str  # why it is not taken; empty if it may be
    waits: str = ""  # why it is not for this device yet, or was stopped; empty if it is, or is in use, or refused

    @property
    def is_new(self) -> bool:
        """Whether there is something to fetch and install."""
        return not (self.refused or self.waits) and self.manifest is not None and self.manifest != self.installed


def offered(repository: DeviceUpdater, layout: Layout, channel: str, where: str) -> Offer:
    """What a channel of a repository offers this device now.

    `where` is what the repository is called in errors. Raises UpdateError if the repository is wrong, not merely of no use to this
    device; DownloadError or RepositoryError.
    """
    platform, installed = this_platform(), manifest_of(layout.current)
    releases = _channel(repository.read(Channel.target(channel), CHANNEL_BYTES_MAX), f"{where}: {Channel.target(channel)}").releases
    path = releases.get(platform)
    if path is None:
        others = ", ".join(sorted(releases)) or "nothing at all"
        reason = f"{where}: channel {channel} has no release for {platform}, but for {others}"
        return Offer(channel, platform, None, b"", installed, reason)
    data = repository.read(path, MANIFEST_BYTES_MAX)
    manifest = read_manifest(data, f"{where}: {path}")
    if manifest.target != path:
        raise UpdateError(f"{where}: {path} is the manifest of {manifest.target}: refused; the repository has to be made again")
    refused = _reason(manifest, installed, layout, where)
    waits = "" if refused or manifest == installed else _waits(repository, layout, manifest, where)
    return Offer(channel, platform, manifest, data, installed, refused, waits)


def _waits(repository: DeviceUpdater, layout: Layout, manifest: Manifest, where: str) -> str:
    """Why a release is not for this device yet, or was stopped; empty if it is."""
    release = f"{where}: release {manifest.version}"
    if manifest.version in repository.stopped:
        return f"{release} was stopped by its publisher: only devices that have it keep it"
    rollout = read_rollout(repository.target(manifest.target).custom, f"{where}: {manifest.target}")
    if rollout is None:
        return ""
    opened_ppm = repository.opened.get(manifest.version, 0)
    why = rollout.why_not_yet(place_of(layout, manifest.version), repository.now, opened_ppm)
    return f"{release} {why}" if why else ""


def _reason(manifest: Manifest, installed: Manifest | None, layout: Layout, where: str) -> str:
    """Why a release is not taken; empty if it may be."""
    release, seen = f"{where}: release {manifest.version}", largest_counter(layout, installed)
    if manifest == installed:
        return ""
    if manifest.counter < seen:
        return (
            f"{release} has counter {manifest.counter}, this device has had {seen}: no way back but `haptic-panel update rollback`"
        )
    if manifest.version in failed_releases(layout):
        return f"{release} has failed on this device: a later one is needed"
    if installed is not None and manifest.minimum_counter > installed.counter:
        return f"{release} needs a release of counter {manifest.minimum_counter} or more before it: install that first"
    if manifest.fall_back > FALL_BACK_INTERFACE:
        return f"{release} needs a newer Debian package haptic-panel (fall-back {manifest.fall_back}): install that first"
    return ""


def failed_releases(layout: Layout) -> frozenset[str]:
    """Versions that were tried and did not serve.

    Raises UpdateError if they cannot be read: what is not known to be untried is not fetched.
    """
    file = layout.state / "failed"
    try:
        lines = read_regular(file, WORDS_BYTES_MAX).decode("ascii", "replace").splitlines()
    except FileNotFoundError:
        return frozenset()
    except OSError as error:
        raise UpdateError(f"{file}: cannot be read ({error.strerror}), so that no release is taken: look at its owner") from error
    return frozenset(line.split()[0] for line in lines if line.strip())


def largest_counter(layout: Layout, installed: Manifest | None) -> int:
    """Counter of the newest release that this device has had, whatever became of metadata and releases."""
    try:
        text = read_regular(layout.download / COUNTER, WORDS_BYTES_MAX).decode("ascii").strip()
    except (OSError, UnicodeDecodeError):
        text = ""
    return max(int(text) if text.isdecimal() and len(text) <= 16 else 0, installed.counter if installed else 0)


def _channel(data: bytes, origin: str) -> Channel:
    try:
        return as_record(f"{origin}: ", read_object(data, origin), Channel)
    except ConfigError as error:
        raise UpdateError(f"{origin}: is no channel: {error}") from error
