"""A release as a folder where it is made: `release.json`, each of its files, and the index of each bank.

The same inputs make the same bytes, modes and times of files.
"""

import hashlib
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from pathlib import Path
from typing import Final

import msgspec

from controller.device.update.download.bank_index import found_pieces, read_index, write_index
from controller.device.update.layout import MANIFEST
from controller.device.update.manifest import Manifest, ReleaseFile, read_manifest
from controller.durable import tell_disk
from controller.errors import UpdateError

BANKS: Final = "banks/"


def write_release(
    out: Path, about: Manifest, contents: Mapping[str, Path | bytes], pieces: Mapping[str, Iterable[tuple[int, int]]]
) -> Manifest:
    """Write the folder of a release; it is there whole, or not at all.

    `about` is all but the files, which the result includes. `contents` has, by each file's path in the release, where it is now, or
    its bytes; `pieces`, by each bank's path, offset and length in bytes of what changes as one. `out` must not exist. Raises
    UpdateError if the folder exists, the manifest is not valid, or it cannot be written: nothing is left of it.
    """
    if out.exists():
        raise UpdateError(f"{out}: exists: a release is never overwritten, remove it or name another folder")
    with tell_disk(out):
        making = out.with_name(f".{out.name}.making")
        shutil.rmtree(making, ignore_errors=True)  # of an interrupted run
        making.mkdir(parents=True)
        try:
            files = [_put(making, path, contents[path]) for path in sorted(contents)]
            manifest = msgspec.structs.replace(about, files=files)
            read_manifest(manifest.to_json(), str(out / MANIFEST))
            (making / MANIFEST).write_bytes(manifest.to_json())
            for file in files:
                if file.path.startswith(BANKS):
                    _put(making, file.index_target, write_index(making / file.path, pieces.get(file.path, ())))
            _same_for_everyone(making, manifest.built_s)
            making.rename(out)
        except BaseException:
            shutil.rmtree(making, ignore_errors=True)
            raise
    return manifest


def read_release(folder: Path) -> Manifest:
    """The manifest of a release, all its files looked at.

    Raises UpdateError if a file is missing, another one, or not listed: the release was altered after it was made.
    """
    try:
        data = (folder / MANIFEST).read_bytes()
    except OSError as error:
        raise UpdateError(f"{folder}: is no folder that `haptic-panel update make-release` made ({error.strerror})") from error
    manifest = read_manifest(data, str(folder / MANIFEST))
    again = "was altered after the release was made: make the release again"
    if data != manifest.to_json():
        raise UpdateError(f"{folder / MANIFEST}: {again}")
    wanted = {file.path for file in manifest.files} | {MANIFEST} | {file.index_target for file in banks(manifest)}
    found = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_symlink() or not path.is_dir()}
    for path in sorted(wanted ^ found):
        raise UpdateError(f"{folder / path}: {'is missing' if path in wanted else 'is not in its manifest'}: the folder {again}")
    for file in manifest.files:
        if (folder / file.path).is_symlink() or (file.sha256, file.size_bytes) != digest_of(folder / file.path):
            raise UpdateError(f"{folder / file.path}: {again}")
    for file in banks(manifest):
        at = folder / file.index_target
        index = read_index(at.read_bytes(), str(at))
        with (folder / file.path).open("rb") as bank:
            if index.size_bytes != file.size_bytes or any(a != b for a, b in zip(found_pieces(bank, index), index, strict=True)):
                raise UpdateError(f"{at}: {again}")
    return manifest


def banks(manifest: Manifest) -> Iterator[ReleaseFile]:
    """The banks of a release, each of which has an index."""
    return (file for file in manifest.files if file.path.startswith(BANKS))


def digest_of(file: Path) -> tuple[str, int]:
    """SHA-256 and size in bytes of a file."""
    with file.open("rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest(), opened.tell()


def _put(folder: Path, path: str, content: Path | bytes) -> ReleaseFile:
    """Write a file of the release."""
    file = folder / path
    file.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(content, bytes):
        file.write_bytes(content)
    else:
        shutil.copyfile(content, file)
    digest, size = digest_of(file)
    return ReleaseFile(path=path, sha256=digest, size_bytes=size)


def _same_for_everyone(folder: Path, time_s: int) -> None:
    """Modes and times that depend on nobody's umask and clock."""
    for path in chain(folder.rglob("*"), [folder]):
        path.chmod(0o755 if path.is_dir() else 0o644)
        os.utime(path, (time_s, time_s))
