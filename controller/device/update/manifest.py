"""The manifest of a release: what it is for, what it needs, and every file of it."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import re
import sys
from pathlib import Path, PurePosixPath
from typing import Annotated, Any, Final

import msgspec
from msgspec import Meta

from controller.device.board.records import Record, as_record
from controller.device.update.layout import RELEASE_NAME
from controller.errors import ConfigError, UpdateError
from controller.regular_file import open_regular

FORMAT: Final = 1
MANIFEST_BYTES_MAX: Final = 1_000_000
SETTINGS_FORMAT: Final = 1  # of /etc/haptic-panel, boards and the state folder; service.migration takes over what is older
FALL_BACK_INTERFACE: Final = 1  # of the fall-back script and units, which only the Debian package changes

Digest = Annotated[str, Meta(pattern=r"^[0-9a-f]{64}\Z")]
Count = Annotated[int, Meta(ge=0, le=2**53)]
ROOMS: Final = ("wheels", "boards", "banks", "gateware")  # folders of a release that its files may be in
BILL: Final = "sbom.cdx.json"
PATH: Final = re.compile(r"[0-9A-Za-z_][0-9A-Za-z._+-]*(/[0-9A-Za-z_][0-9A-Za-z._+-]*){0,7}")


class ReleaseFile(Record, frozen=True):
    """A file of a release."""

    # In the folder of the release: `wheels/…`, `boards/<name>/…`, `banks/<board>.bank`, `gateware/<board>.bit`, `sbom.cdx.json`
    path: Annotated[str, Meta(max_length=240)]
    sha256: Digest
    size_bytes: Count

    def is_whole(self, path: Path) -> bool:
        """Whether a path leads to this file, unchanged; raises OSError if it is absent, or cannot be read."""
        with os.fdopen(open_regular(path), "rb") as file:
            if os.fstat(file.fileno()).st_size != self.size_bytes:
                return False
            return hashlib.file_digest(file, "sha256").hexdigest() == self.sha256

    @property
    def target(self) -> str:
        """Its path in the repository: by its content, so that releases share what did not change."""
        return f"files/{self.sha256}"

    @property
    def index_target(self) -> str:
        """Path in the repository of the index of a bank, by which only what has changed of it is fetched."""
        return f"indexes/{self.sha256}"


class Manifest(Record, frozen=True):
    """What a release is."""

    version: Annotated[str, Meta(pattern=rf"^{RELEASE_NAME.pattern}\Z")]
    counter: Count  # larger in each later release; a device refuses a smaller one than it had, whatever the repository says
    # python, architecture: such as 3.11 and x86_64 (`platform.machine`): its wheels are for these only
    python: Annotated[str, Meta(pattern=r"^3\.[0-9]+\Z")]
    architecture: Annotated[str, Meta(pattern=r"^[0-9a-z_]+\Z")]
    protocol: Count  # version of the frames to the FPGA
    gateware_hash: Annotated[str, Meta(pattern=r"^[0-9a-f]{8}\Z")]  # build hash of the gateware, 8 hexadecimal digits
    bank_format: Count  # bank_format, settings_format: formats of files that it reads
    settings_format: Count
    files: list[ReleaseFile]
    boards: dict[str, Digest] = msgspec.field(default_factory=dict)  # digest of each board it brings, by its name
    minimum_counter: Count = 0  # counter of the oldest release from which it may be installed
    # When its sources were committed (SOURCE_DATE_EPOCH), in s since 1970: a device's clock that says less is wrong
    built_s: Count = 0
    fall_back: Count = FALL_BACK_INTERFACE  # interface of fall-back script and units that it needs (`FALL_BACK_INTERFACE`)
    format: Annotated[int, Meta(ge=FORMAT, le=FORMAT)] = FORMAT

    @property
    def platform(self) -> str:
        """Such as `x86_64-cp311`."""
        return f"{self.architecture}-cp{self.python.replace('.', '')}"

    @property
    def target(self) -> str:
        """Its path in the repository."""
        return f"releases/{self.version}/{self.platform}.json"

    @property
    def total_bytes(self) -> int:
        """Size of all its files."""
        return sum(file.size_bytes for file in self.files)

    def to_json(self) -> bytes:
        """The file `release.json`: the same bytes for the same release."""
        return msgspec.json.format(msgspec.json.encode(self, order="sorted"), indent=1) + b"\n"


class Channel(Record, frozen=True):
    """What a channel (`channels/<name>.json` in the repository) offers now."""

    releases: dict[str, str]  # path of a manifest in the repository, by platform

    @staticmethod
    def target(name: str) -> str:
        """Path of a channel in the repository."""
        return f"channels/{name}.json"


def read_object(data: bytes, origin: str) -> dict[str, Any]:
    """An object of JSON that means the same to every reader: in UTF-8, each key once, numbers that are finite.

    Raises ConfigError if it is none.
    """

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found = dict(pairs)
        if len(found) < len(pairs):
            names = [name for name, _ in pairs]
            raise ValueError(f"key {next(name for name in names if names.count(name) > 1)!r} comes twice")
        return found

    def refuse(number: str) -> None:
        raise ValueError(f"{number} is no number")

    try:
        tables: Any = json.loads(data.decode("utf-8"), object_pairs_hook=once, parse_constant=refuse)
    except (ValueError, RecursionError) as error:
        raise ConfigError(f"{origin}: is not JSON: {error}") from error
    if not isinstance(tables, dict):
        raise ConfigError(f"{origin}: is not an object")
    return tables


def this_platform() -> str:
    """Platform of this computer, as `Manifest.platform` has it."""
    return f"{platform.machine()}-cp{sys.version_info[0]}{sys.version_info[1]}"


def read_manifest(data: bytes, origin: str) -> Manifest:
    """A manifest from its JSON.

    `origin` is what it is called in errors. Raises UpdateError if it is not valid, or a path of it leaves its folder or comes
    twice.
    """
    if len(data) > MANIFEST_BYTES_MAX:
        raise UpdateError(f"{origin}: {len(data):,} bytes are more than the {MANIFEST_BYTES_MAX:,} of any manifest")
    try:
        manifest = as_record(f"{origin}: ", read_object(data, origin), Manifest)
    except ConfigError as error:
        raise UpdateError(str(error)) from error
    seen: set[str] = set()
    for file in manifest.files:
        if not PATH.fullmatch(file.path) or ".." in PurePosixPath(file.path).parts:
            raise UpdateError(f"{origin}: files: {file.path!r} is no path inside of a release")
        if file.path != BILL and file.path.partition("/")[0] not in ROOMS:  # not the environment, for one, nor `.complete`
            raise UpdateError(f"{origin}: files: {file.path!r} is not in {', '.join(f'{room}/' for room in ROOMS)} nor {BILL}")
        if file.path in seen:
            raise UpdateError(f"{origin}: files: {file.path!r} comes twice")
        seen.add(file.path)
    return manifest
