"""Where releases and the state of updates lie on a device.

Everything below one folder, on one file system, so that releases share their banks by hard links.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Self

from controller.device.board.identity import MACHINE_ID
from controller.device.board.lookup import MANIFEST as MANIFEST  # noqa: PLC0414 - part of the layout, which boards need too
from controller.device.board.lookup import running_release as running_release  # noqa: PLC0414
from controller.regular_file import read_regular

ROOT = Path("/opt/haptic-panel")
TRUSTED_ROOT = Path("/usr/share/haptic-panel/root.json")
SETTINGS = Path("/etc/haptic-panel/update.toml")
RELEASE_NAME: Final = re.compile(r"[0-9A-Za-z][0-9A-Za-z._+-]{0,63}")  # also what the fall-back script believes
COMPLETE = ".complete"
WORDS_BYTES_MAX: Final = 65_536  # of a file of the state; `failed` has 50 lines


@dataclass(frozen=True, slots=True)
class Layout:
    """Folders and files of updates.

    Owners: `state` and `current` are written by the fall-back script alone, as root; all other folders by the user `haptic-update`,
    who asks the fall-back script for what it wants by a file in `requests`. Nothing of a release ever runs as root: scripts of the
    Debian package see to it before any of it starts (systemd/README.md, Who runs what).
    """

    root: Path = ROOT
    trusted_root: Path = TRUSTED_ROOT  # first root.json of the repository's owner, by which all others are evaluated
    machine_id: Path = MACHINE_ID  # what tells this device from others

    @classmethod
    def from_environment(cls) -> Self:
        """That of $HAPTIC_PANEL_ROOT and $HAPTIC_PANEL_TRUSTED_ROOT, for tests and images prepared elsewhere; else the device's."""
        return cls(Path(os.environ.get("HAPTIC_PANEL_ROOT", ROOT)), Path(os.environ.get("HAPTIC_PANEL_TRUSTED_ROOT", TRUSTED_ROOT)))

    @property
    def current(self) -> Path:
        """Symbolic link to the release in use, `releases/<version>`."""
        return self.root / "current"

    @property
    def releases(self) -> Path:
        """Folder of installed releases, each at the path where it was built."""
        return self.root / "releases"

    @property
    def store(self) -> Path:
        """Files of releases by their SHA-256, mode 0444; banks in releases are hard links to them."""
        return self.root / "store"

    @property
    def state(self) -> Path:
        """Files of one word, of the fall-back script: `current`, `previous`, `trial`, `tries`; `failed` has a line a release."""
        return self.root / "state"

    @property
    def requests(self) -> Path:
        """Files of one word each, a version, for the fall-back script: `requests.Request` names them."""
        return self.root / "requests"

    @property
    def download(self) -> Path:
        """What trust and downloads keep: `metadata/`, `parts/`, `indexes/`, `clock`, `counter`, `lock`, `release.json`."""
        return self.root / "download"

    def release(self, version: str) -> Path:
        """Folder of a release."""
        return self.releases / version

    def is_complete(self, version: str) -> bool:
        """Whether a release may be started."""
        return RELEASE_NAME.fullmatch(version) is not None and (self.release(version) / COMPLETE).is_file()

    def word(self, name: str) -> str:
        """A word of `state`; empty if there is none, or it is no name of a release."""
        try:
            word = read_regular(self.state / name, WORDS_BYTES_MAX).decode("ascii").strip()
        except (OSError, ValueError):
            return ""
        return word if RELEASE_NAME.fullmatch(word) else ""
