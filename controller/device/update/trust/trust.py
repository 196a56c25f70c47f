"""Which bytes are the owner's: The Update Framework's client, begun each time from the root.json that the Debian package brings.

What the client alone leaves open is closed here: a device without a clock (`clock`), metadata that is not synced, two processes
at once. That an old repository is offered after all metadata was lost is refused by `offer`, which counts releases.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import Final

from tuf.api.exceptions import (
    BadVersionNumberError,
    DownloadError,
    DownloadLengthMismatchError,
    ExpiredMetadataError,
    LengthOrHashMismatchError,
    RepositoryError,
    UnsignedMetadataError,
)
from tuf.api.metadata import TargetFile
from tuf.api.serialization import DeserializationError
from tuf.ngclient import Updater, UpdaterConfig

from controller.device.update.download.source import Source
from controller.device.update.layout import Layout
from controller.device.update.lock import alone
from controller.device.update.trust import clock
from controller.device.update.trust.rollout import opened_by, stopped_by
from controller.device.update.trust.validity import ROOT_BYTES_MAX
from controller.durable import sync_folder
from controller.errors import UpdateError

LIMITS: Final = UpdaterConfig(
    max_root_rotations=64,
    max_delegations=4,
    root_max_length=ROOT_BYTES_MAX,
    timestamp_max_length=16_384,
    snapshot_max_length=64_000,
    targets_max_length=2_000_000,
)


class DeviceUpdater(Updater):
    """Python-tuf's client, which takes for the time the later one of the clock's and what is known for sure."""

    def __init__(
        self,
        metadata: Path,  # folder for what was verified; it exists
        source: Source,
        root: bytes,  # the trusted root.json
        earliest: datetime,  # time that it is at least
        now: datetime | None = None,  # what the clock says; for tests
        config: UpdaterConfig = LIMITS,
        kept: clock.Kept | None = None,  # time that it is at least too, unless a newer root is taken
    ) -> None:
        address = source.address
        super().__init__(str(metadata), f"{address}/metadata", None, f"{address}/targets", source, config, bootstrap=root)
        self._source = source
        reported: object = self._trusted_set.reference_time  # private: hence tuf is held at 7.0, and a test expires a repository
        if not isinstance(reported, datetime):
            raise TypeError("python-tuf keeps its time elsewhere: trust.py must follow")
        self._trusted_set.reference_time = self.now = max(now or reported, earliest)
        self._kept = kept

    def _load_root(self) -> None:
        """The newest root, and what time it is at least under it: no date counts before (private, as above)."""
        super()._load_root()
        if self._kept and self._kept.counts_under(self._trusted_set.root):
            self._trusted_set.reference_time = self.now = max(self.now, self._kept.moment)

    def keep_time(self, file: Path) -> None:
        """Keep the time of the verified timestamp; from now on it is not earlier than that."""
        verified = self._trusted_set
        clock.keep(file, verified.root, verified.targets, verified.timestamp, self.now)
        if (kept := clock.Kept.read(file)) and kept.counts_under(verified.root):
            self.now = max(self.now, kept.moment)

    @property
    def stopped(self) -> list[str]:
        """Versions that the publisher has stopped; raises UpdateError if the timestamp has no list of them."""
        return stopped_by(self._trusted_set.timestamp, self._source.name)

    @property
    def opened(self) -> dict[str, int]:
        """By version the share in ppm up to which its steps are open; raises UpdateError as `opened_by`."""
        return opened_by(self._trusted_set.timestamp, self._source.name)

    def target(self, path: str) -> TargetFile:
        """What is signed about a file of the repository; raises UpdateError if it has none of that name."""
        target = self.get_targetinfo(path)
        if target is None:
            raise UpdateError(f"{self._source.name}: has no {path}: was the release added to it whole?")
        return target

    def read(self, path: str, max_bytes: int) -> bytes:
        """A small file of the repository, checked; raises UpdateError or DownloadError or RepositoryError."""
        target = self.target(path)
        if target.length > max_bytes:
            raise UpdateError(
                f"{self._source.name}: {path} has {target.length:,} bytes, more than the {max_bytes:,} of any such file"
            )
        data = b"".join(self.chunks(target, 0, target.length))
        target.verify_length_and_hashes(data)
        return data

    def chunks(self, target: TargetFile, start: int, length: int) -> Iterator[bytes]:
        """Bytes of a file of the repository, as they come; not checked; raises DownloadError."""
        folder, slash, name = target.path.rpartition("/")
        if self._trusted_set.root.consistent_snapshot:
            name = f"{next(iter(target.hashes.values()))}.{name}"
        return self._source.open(f"{self._source.address}/targets/{folder}{slash}{name}", start, length)


@contextmanager
def trusted(layout: Layout, source: Source, built_s: int, now: datetime | None = None) -> Iterator[DeviceUpdater]:
    """A repository whose metadata was verified just now; no other process works on updates meanwhile.

    The running release was made at `built_s`, in s since 1970; `now` is what the clock says, for tests. Raises UpdateError for
    whatever is wrong with it, also within the block.
    """
    try:
        root = layout.trusted_root.read_bytes()
    except OSError as error:
        raise UpdateError(
            f"{layout.trusted_root}: cannot be read ({error.strerror}): the Debian package or the owner brings it"
        ) from error
    updater: DeviceUpdater | None = None
    try:
        metadata = layout.download / "metadata"
        metadata.mkdir(parents=True, exist_ok=True)
        with alone(layout.download / "lock"):
            for left in metadata.glob("tmp*"):  # python-tuf writes beside and renames; one that was killed leaves its file
                left.unlink()
            kept = clock.Kept.read(layout.download / "clock")
            try:
                updater = DeviceUpdater(metadata, source, root, clock.built(built_s), now, kept=kept)
            except RepositoryError as error:
                raise UpdateError(f"{layout.trusted_root}: is no root.json of a repository: install it again") from error
            updater.refresh()
            sync_tree(metadata)
            updater.keep_time(layout.download / "clock")
            yield updater
    except (RepositoryError, DownloadError, OSError) as error:
        raise refusal(error, source.name, updater.now if updater else None) from error


def sync_tree(folder: Path) -> None:
    """Make small files and their names last, below a folder too: python-tuf only renames."""
    for place, _, names in os.walk(folder):
        for name in names:
            with (Path(place) / name).open("rb") as file:
                os.fsync(file.fileno())
        sync_folder(Path(place))


def refusal(error: Exception, where: str, now: datetime | None = None) -> UpdateError:
    """What went wrong, as one line: what, where, what to do."""
    said = " ".join(str(error).split())[:400]
    match error:
        case UnsignedMetadataError():
            text = f"{where}: is not signed by this device's owner ({said}): refused"
        case ExpiredMetadataError():
            date = f" (it is {clock.as_text(now)} here)" if now else ""
            text = f"{where}: {said}{date}: its owner has to sign it again, or this device's clock is wrong"
        case BadVersionNumberError():
            text = f"{where}: is older than what this device has seen, or of mixed ages ({said}): refused; take a newer copy"
        case DeserializationError():
            text = f"{where}: has no signed metadata ({said}): is the address right, or does this network ask for a login?"
        case LengthOrHashMismatchError():
            text = f"{where}: has a file that is not the signed one ({said}): refused; try again, or take another copy"
        case DownloadLengthMismatchError():
            text = f"{where}: sends more, or less, than was signed ({said}): refused"
        case DownloadError():
            text = said if where in said else f"{where}: {said}"
        case RepositoryError():
            text = f"{where}: contradicts itself ({said}): refused"
        case OSError():
            full = error.errno in {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
            advice = "see to it that the user haptic-update may write there"
            if full:
                advice = "make room on the disk"
            elif error.errno == errno.EACCES:
                advice = f"run this as root; {advice}"
            text = f"{error.filename or where}: cannot be read or written ({error.strerror or said}): {advice}"
        case _:
            text = f"{where}: {said}"
    return UpdateError(text)
