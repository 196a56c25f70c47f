"""The release that the Debian package brings: installed from its folder, and what becomes of it on this device.

`python -m controller.device.update.brought FOLDER` is run by /usr/lib/haptic-panel/install-first-release as the user
haptic-update, in an environment that has the wheels of this package, msgspec and platformdirs, and nothing else.
"""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path
from typing import Literal

from controller.console import program, say, tell
from controller.device.update.install import install
from controller.device.update.installed import manifest_of, update_state
from controller.device.update.layout import MANIFEST, Layout
from controller.device.update.manifest import Manifest, ReleaseFile, read_manifest
from controller.device.update.requests import ask
from controller.device.update.trial import keep_before
from controller.durable import sync_folder
from controller.errors import UpdateError

Outcome = Literal["adopt", "trial", "stays"]


def install_brought(layout: Layout, folder: Path) -> tuple[Outcome, str]:
    """Install the release in a folder, unless this device has no use for it.

    `folder` is as `haptic-panel update make-release` makes it. Returns adopt: it is installed, and the device has no other to use;
    trial: it is installed and its trial is asked for; or stays: the release in use stays; and a line for who installs the package.
    Raises UpdateError if a file is not what its manifest says, the release does not fit this device, or it cannot be written.
    """
    path = folder / MANIFEST
    coming = read_manifest(path.read_bytes(), str(path))
    state, used = update_state(layout), _in_use(layout)
    if used is not None and (why := _why_not(coming, used, state.failed, state.trial, state.requested)):
        return "stays", f"release {used.version} stays in use: {why}"
    for file in coming.files:
        _store(layout, folder, file)
    install(layout, coming)
    if used is None:
        return "adopt", f"release {coming.version} is installed"
    keep_before(layout)
    ask(layout, "trial", coming.version)
    return "trial", f"release {coming.version} is tried, and stays if it serves; else {used.version} is used again"


def _in_use(layout: Layout) -> Manifest | None:
    if not layout.current.is_symlink():
        return None
    version = layout.current.readlink().name
    return manifest_of(layout.release(version)) if layout.is_complete(version) else None


def _why_not(coming: Manifest, used: Manifest, failed: tuple[str, ...], trial: str, requested: tuple[str, ...]) -> str:
    brings = f"{coming.version}, which the package brings"
    if coming.counter <= used.counter:
        return f"it is not older than {brings}"
    if coming.version in failed:
        return f"{brings}, has failed on this device"
    if trial or "trial" in requested:
        return f"a release is on trial, and {brings}, is not tried"
    return ""


def _store(layout: Layout, folder: Path, file: ReleaseFile) -> None:
    """Copy a file of the release into the store, unless it is there."""
    stored, source = layout.store / file.sha256, folder / file.path
    if stored.exists() and file.is_whole(stored):
        return
    new = stored.with_name(f".{file.sha256}.new")
    try:
        shutil.copyfile(source, new)
        if not file.is_whole(new):
            raise UpdateError(f"{source}: is not what {MANIFEST} lists: install the package again")
        new.chmod(0o444)
        with new.open("rb") as copied:
            os.fsync(copied.fileno())
        new.replace(stored)
        sync_folder(layout.store)
    except OSError as error:
        raise UpdateError(f"{stored}: cannot be written ({error.strerror})") from error
    finally:
        new.unlink(missing_ok=True)


@program
def _main() -> int:
    outcome, why = install_brought(Layout.from_environment(), Path(sys.argv[1]))
    tell(why)
    say(outcome)
    return 0


if __name__ == "__main__":
    sys.exit(_main())
