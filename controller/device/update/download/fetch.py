"""From a repository into the store: what of a release is not there yet, each file checked and synced before it gets its name."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Final

from tuf.api.exceptions import RepositoryError

from controller.device.update.download.http_source import HttpSource
from controller.device.update.download.old_banks import OldBanks
from controller.device.update.download.part_file import complete
from controller.device.update.download.source import FolderSource, Source
from controller.device.update.installed import manifest_of
from controller.device.update.layout import MANIFEST, Layout
from controller.device.update.manifest import Manifest, ReleaseFile
from controller.device.update.settings import UpdateSettings
from controller.device.update.trust.offer import COUNTER, NotYetError, Offer, largest_counter, offered
from controller.device.update.trust.trust import DeviceUpdater, trusted
from controller.durable import sync_folder, write_durably
from controller.errors import UpdateError

UNPACKED: Final = 5  # times the bytes of its wheels that an environment takes, compiled
RESERVE_BYTES: Final = 32_000_000  # left free for what else the device writes


@dataclass(slots=True)
class TransferStatistics:
    """What a fetch cost."""

    release_bytes: int = 0  # of all files of the release
    kept_bytes: int = 0  # of those that were there already
    reused_bytes: int = 0  # copied from older banks
    fetched_bytes: int = 0  # read from the repository, metadata and indexes included


def check(layout: Layout, settings: UpdateSettings, source: str = "", now: datetime | None = None) -> tuple[Offer, int]:
    """What a repository offers this device, and how many bytes of it are not there yet.

    `source` is an http(s) address or a folder, empty: that of the settings; `now` is what the clock says, for tests. Raises
    UpdateError.
    """
    origin = source_of(source or settings.source, settings.total_s, settings.bytes_per_s)
    with trusted(layout, origin, _built_s(layout), now) as repository:
        offer = offered(repository, layout, settings.channel, origin.name)
        if offer.manifest is None or not offer.is_new:
            return offer, 0
        return offer, sum(file.size_bytes for file in _distinct(offer.manifest) if not _is_stored(layout, file))


def fetch(
    layout: Layout,
    settings: UpdateSettings,
    source: str,  # http(s) address or folder; empty: that of the settings
    progress: Callable[[int, int], None],  # called with bytes done and all bytes of the release
    now: datetime | None = None,  # what the clock says; for tests
    figures: TransferStatistics | None = None,  # what it cost is written here
) -> Manifest:
    """Fetch the release that is offered: all its files into the store, then its manifest to `download/release.json`.

    If the release in use is offered, nothing is fetched.

    Raises UpdateError if the release is refused, or cannot be fetched; NotYetError if it is not for this device yet. What came of
    it is kept for the next time; the store has whole files only.
    """
    origin = source_of(source or settings.source, settings.total_s, settings.bytes_per_s)
    with trusted(layout, origin, _built_s(layout), now) as repository:
        offer = offered(repository, layout, settings.channel, origin.name)
        if offer.manifest is None or offer.refused:
            raise UpdateError(offer.refused)
        if offer.waits:
            raise NotYetError(offer.waits)
        if not offer.is_new:
            return offer.manifest
        fetching = _Fetching(layout, repository, offer.manifest, progress, figures or TransferStatistics())
        try:
            fetching.fetch()
        finally:
            fetching.figures.fetched_bytes = origin.fetched_bytes
        counter = max(largest_counter(layout, offer.installed), offer.manifest.counter)
        write_durably(layout.download / COUNTER, f"{counter}\n".encode())
        write_durably(layout.download / MANIFEST, offer.data)
        return offer.manifest


class _Fetching:
    """A release on its way into the store."""

    def __init__(
        self,
        layout: Layout,
        repository: DeviceUpdater,
        manifest: Manifest,
        progress: Callable[[int, int], None],
        figures: TransferStatistics,
    ) -> None:
        self._layout, self._repository, self._manifest, self._progress = layout, repository, manifest, progress
        self.figures = figures
        self._parts = layout.download / "parts"
        self._old_banks = OldBanks(layout, repository)
        self._files = _distinct(manifest)
        self._done_bytes, self._all_bytes = 0, sum(file.size_bytes for file in self._files)

    def fetch(self) -> None:
        """Fetch what is missing."""
        for folder in (self._layout.store, self._parts):
            folder.mkdir(parents=True, exist_ok=True)
        missing = [file for file in self._files if not _is_stored(self._layout, file)]
        self._prune()
        self._require_room(missing)
        self.figures.release_bytes = self._all_bytes
        self.figures.kept_bytes = self._all_bytes - sum(file.size_bytes for file in missing)
        self._tell(self.figures.kept_bytes)
        for file in missing:
            self._fetch_file(file)
        sync_folder(self._layout.store)

    def _fetch_file(self, file: ReleaseFile) -> None:
        target = self._repository.target(file.target)
        if target.length != file.size_bytes or target.hashes.get("sha256") != file.sha256:
            raise RepositoryError(f"{file.path} is signed with two different lengths or hashes")
        part = self._parts / file.sha256
        done_bytes = self._done_bytes
        reused_bytes = self._old_banks.rebuilt(file, target, part) if file.path.startswith("banks/") else None
        if reused_bytes is None:
            complete(part, self._repository, target, self._tell)
        else:
            self.figures.reused_bytes += reused_bytes
        part.chmod(0o444)
        part.replace(self._layout.store / file.sha256)
        self._tell(done_bytes + file.size_bytes - self._done_bytes)

    def _require_room(self, missing: list[ReleaseFile]) -> None:
        """Refuse what will not fit: what is to be fetched, and what installing it takes."""
        begun = sum(min(file.size_bytes, _size(self._parts / file.sha256)) for file in missing)
        wheels = sum(file.size_bytes for file in self._manifest.files if file.path.startswith("wheels/"))
        copied = sum(file.size_bytes for file in self._manifest.files if not file.path.startswith(("wheels/", "banks/")))
        needed = sum(file.size_bytes for file in missing) - begun + UNPACKED * wheels + copied + RESERVE_BYTES
        disk = os.statvfs(self._layout.root)
        free = disk.f_bavail * disk.f_frsize
        if needed > free:
            raise UpdateError(
                f"{self._layout.root}: release {self._manifest.version} needs {needed:,} bytes, {free:,} are free: make room"
            )

    def _prune(self) -> None:
        """Remove what was begun of other releases."""
        digests = {file.sha256 for file in self._manifest.files}
        for part in self._parts.iterdir():
            if part.name.partition(".")[0] not in digests:
                part.unlink()
        self._old_banks.prune(digests)

    def _tell(self, more_bytes: int) -> None:
        self._done_bytes += more_bytes
        self._progress(self._done_bytes, self._all_bytes)


def source_of(text: str, total_s: float, bytes_per_s: float) -> Source:
    """The source that a user names: an http(s) address or a folder.

    Raises UpdateError if nothing is named, or nothing can be there.
    """
    if not text:
        raise UpdateError("no repository is set: set `source` in /etc/haptic-panel/update.toml, or give --from URL or FOLDER")
    source = HttpSource(text, total_s, bytes_per_s) if "://" in text else FolderSource(text)
    source.look()
    return source


def _distinct(manifest: Manifest) -> list[ReleaseFile]:
    """Files of a release, each content once."""
    return list({file.sha256: file for file in manifest.files}.values())


def _is_stored(layout: Layout, file: ReleaseFile) -> bool:
    """Whether a file is in the store, whole; one that is damaged is removed, so that it is fetched again."""
    stored = layout.store / file.sha256
    try:
        if file.is_whole(stored):
            return True
        stored.unlink()
    except FileNotFoundError:
        pass
    return False


def _built_s(layout: Layout) -> int:
    installed = manifest_of(layout.current)
    return installed.built_s if installed else 0


def _size(file: Path) -> int:
    try:
        return file.stat().st_size
    except OSError:
        return 0
