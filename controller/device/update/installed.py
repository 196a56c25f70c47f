"""Which releases a device has, which of them is in use or on trial, and what is asked for: for people, doctor and figures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec

from controller.device.update.failed_install import failed_install
from controller.device.update.layout import COMPLETE, MANIFEST, RELEASE_NAME, WORDS_BYTES_MAX, Layout
from controller.device.update.manifest import MANIFEST_BYTES_MAX, Manifest, read_manifest
from controller.errors import UpdateError
from controller.regular_file import read_regular


class InstalledRelease(msgspec.Struct, frozen=True, kw_only=True):
    """A folder of `releases/`."""

    version: str
    counter: int | None  # None: its manifest cannot be read, or it was installed by hand and has none
    complete: bool  # whether it may be started
    failed: bool  # whether it was tried and did not serve
    size_bytes: int | None  # of its files before they were installed; what it shares with other releases counts for each


class UpdateState(msgspec.Struct, frozen=True, kw_only=True):
    """Releases of a device."""

    in_use: str = ""  # release that `current` leads to: the trial's while there is one; empty: none
    stays: str = ""  # release that is used if there is no trial
    previous: str = ""  # release before it, for a rollback; empty: none
    trial: str = ""  # release on trial; empty: none
    tries: int = 0  # starts of the trial so far
    failed: tuple[str, ...] = ()  # releases that are not tried again
    requested: tuple[str, ...] = ()  # what the fall-back script was asked for and has not done yet
    releases: tuple[InstalledRelease, ...] = ()  # the newest first
    not_installed: str = ""  # release whose installation failed, how often and why; empty: none
    problems: tuple[str, ...] = ()  # what is damaged or cannot be read

    def figures(self) -> dict[str, Any]:
        """Ready for JSON."""
        return dict(msgspec.to_builtins(self))


def update_state(layout: Layout) -> UpdateState:
    """The releases of a device; what is damaged is named, and never an error."""
    problems: list[str] = []
    words = {name: _word(layout.state / name, problems) for name in ("current", "previous", "trial", "tries")}
    failed = tuple(line for line in _text(layout.state / "failed", problems).splitlines() if RELEASE_NAME.fullmatch(line))
    folders = _names(layout.releases, problems)
    releases = tuple(_release(layout, name, problems, failed=name in failed) for name in folders if RELEASE_NAME.fullmatch(name))
    in_use, failed_before = "", failed_install(layout)
    if layout.current.is_symlink():
        in_use = layout.current.readlink().name
        if not layout.is_complete(in_use):
            problems.append(f"{layout.current}: leads to no complete release")
    elif layout.root.exists():
        problems.append(f"{layout.current}: no release is in use")
    return UpdateState(
        in_use=in_use,
        stays=words["current"],
        previous=words["previous"],
        trial=words["trial"],
        tries=int(words["tries"]) if words["tries"].isdecimal() else 0,
        failed=failed,
        requested=tuple(name for name in _names(layout.requests, problems) if not name.startswith(".")),
        releases=tuple(sorted(releases, key=lambda release: (release.counter or -1, release.version), reverse=True)),
        not_installed=failed_before.in_words if failed_before else "",
        problems=tuple(problems),
    )


def manifest_of(folder: Path) -> Manifest | None:
    """Manifest of an installed release; None if it has none that can be read."""
    try:
        return read_manifest(read_regular(folder / MANIFEST, MANIFEST_BYTES_MAX), str(folder / MANIFEST))
    except (OSError, UpdateError):
        return None


def _release(layout: Layout, version: str, problems: list[str], *, failed: bool) -> InstalledRelease:
    folder = layout.release(version)
    complete, manifest = (folder / COMPLETE).is_file(), manifest_of(folder)
    if complete and manifest is None and (folder / MANIFEST).exists():  # without one it was installed by hand, from a checkout
        problems.append(f"{folder / MANIFEST}: cannot be read")
    counter, size_bytes = (manifest.counter, manifest.total_bytes) if manifest else (None, None)
    return InstalledRelease(version=version, counter=counter, complete=complete, failed=failed, size_bytes=size_bytes)


def _text(file: Path, problems: list[str]) -> str:
    try:
        return read_regular(file, WORDS_BYTES_MAX).decode("ascii", "replace")
    except FileNotFoundError:
        return ""
    except OSError as error:
        problems.append(f"{file}: {error.strerror}")
        return ""


def _word(file: Path, problems: list[str]) -> str:
    text = _text(file, problems).strip()
    if text and not RELEASE_NAME.fullmatch(text):
        problems.append(f"{file}: is damaged")
        return ""
    return text


def _names(folder: Path, problems: list[str]) -> list[str]:
    try:
        return sorted(path.name for path in folder.iterdir())
    except FileNotFoundError:
        return []
    except OSError as error:
        problems.append(f"{folder}: {error.strerror}")
        return []
