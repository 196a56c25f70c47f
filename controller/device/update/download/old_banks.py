"""Banks that a device has, of which a new one takes what it shares with them."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Final

from tuf.api.exceptions import DownloadHTTPError, DownloadLengthMismatchError, LengthOrHashMismatchError, RepositoryError
from tuf.api.metadata import TargetFile

from controller.device.update.download.bank_index import INDEX_BYTES_MAX, BankIndex, read_index
from controller.device.update.download.rebuild import rebuild
from controller.device.update.download.source import NoRanges
from controller.device.update.installed import manifest_of
from controller.device.update.layout import Layout
from controller.device.update.manifest import ReleaseFile
from controller.device.update.trust.trust import DeviceUpdater
from controller.durable import write_durably
from controller.errors import UpdateError
from controller.regular_file import read_regular

SEARCHED: Final = 3  # banks that are searched for pieces of a new one


class OldBanks:
    """Banks of the releases that are installed or fetched, with their indexes.

    From `repository` come indexes that were not kept, and what no old bank has.
    """

    def __init__(self, layout: Layout, repository: DeviceUpdater) -> None:
        self._layout, self._repository = layout, repository
        self._indexes = layout.download / "indexes"
        folders = [*layout.releases.glob("*/"), layout.download]  # installed, or fetched
        self._manifests = [found for folder in folders if (found := manifest_of(folder))]

    def rebuilt(self, file: ReleaseFile, target: TargetFile, whole: Path) -> int | None:
        """Make a bank of old ones where that is worth it.

        `whole` is where the bank is then, checked and synced; what was begun has the same name with `.rebuilt`. Returns how many
        bytes were not fetched; None if the whole bank has to be. Raises DownloadError if something did not come; what came is kept
        for the next time. Raises OSError if it cannot be written; nothing is left of it.
        """
        index, part = self._index(file, keep=True), whole.with_name(f"{whole.name}.rebuilt")
        if index is None or index.size_bytes != file.size_bytes:
            return None
        olds = [(path, self._index(old, keep=False) or index) for path, old in self._at_hand(file)]
        if not olds and not part.exists():
            return None
        try:
            reused = rebuild(part, index, olds, lambda start, length: self._repository.chunks(target, start, length))
            if reused is not None:
                with part.open("rb") as made:
                    target.verify_length_and_hashes(made)
                part.replace(whole)
                return reused
        except (NoRanges, DownloadLengthMismatchError, LengthOrHashMismatchError):
            pass
        except OSError:
            with suppress(OSError):
                part.unlink()
            raise
        part.unlink()
        return None

    def prune(self, digests: set[str]) -> None:
        """Remove indexes of banks that are neither here nor among those given."""
        known = digests | {file.sha256 for manifest in self._manifests for file in manifest.files}
        self._indexes.mkdir(parents=True, exist_ok=True)
        for index in self._indexes.iterdir():
            if index.name not in known:
                index.unlink()

    def _index(self, file: ReleaseFile, *, keep: bool) -> BankIndex | None:
        """Index of a bank: the one that was kept, else that of the repository; None if there is none that can be read."""
        kept = self._indexes / file.sha256
        with suppress(OSError, UpdateError):
            return read_index(read_regular(kept, INDEX_BYTES_MAX), str(kept))
        with suppress(UpdateError, RepositoryError, DownloadHTTPError, DownloadLengthMismatchError):
            data = self._repository.read(file.index_target, INDEX_BYTES_MAX)
            index = read_index(data, file.index_target)
            if keep:
                write_durably(kept, data)
            return index
        return None

    def _at_hand(self, file: ReleaseFile) -> list[tuple[Path, ReleaseFile]]:
        """Other banks that are here: those of the same board first, the newest of them first."""
        found = {
            old.sha256: (old.path != file.path, -manifest.counter, path, old)
            for manifest in self._manifests
            for old in manifest.files
            for path in (self._layout.store / old.sha256, self._layout.release(manifest.version) / old.path)
            if old.path.startswith("banks/") and old.sha256 != file.sha256 and path.is_file()
        }
        ranked = sorted(found.values(), key=lambda one: one[:2])
        return [(path, old) for _, _, path, old in ranked[:SEARCHED]]
