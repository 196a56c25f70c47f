"""A release from the store, built beside those that are there: at its final path, whole before it may be started."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Final

from controller.device.update import failed_install
from controller.device.update.installed import manifest_of
from controller.device.update.layout import COMPLETE, MANIFEST, Layout, running_release
from controller.device.update.lock import alone
from controller.device.update.manifest import FALL_BACK_INTERFACE, MANIFEST_BYTES_MAX, Manifest, ReleaseFile, this_platform
from controller.durable import write_durably
from controller.errors import UpdateError
from controller.programs import ProgramError, last_line, run_program
from controller.regular_file import read_regular

WHEELS: Final = "wheels/"
LIMIT_S: Final = 1800.0  # of one program; the unit ends the whole installation after 45 minutes
STEPS: Final = 5  # that `install` tells of
Progress = Callable[[int, int], None]


def install(layout: Layout, manifest: Manifest, progress: Progress = lambda _done, _all: None) -> None:
    """Build a release; where it is complete already, nothing is done.

    Its environment is built where it stays: its files have paths of it. `.complete` is written last, after all else is on the disk.
    What an interrupted installation left is removed first.

    The manifest's files are in the store; `progress` is called with steps done, and all. Raises UpdateError if the release is for
    another Python, computer or package, a file in the store is damaged or absent, it does not start, or the disk is full. Nothing
    of it is left then, but that it failed (`failed_install`).
    """
    folder, name = layout.release(manifest.version), f"release {manifest.version}"
    if manifest.platform != this_platform():
        raise UpdateError(f"{name} is for {manifest.platform}, and this is {this_platform()}: fetch the one for this platform")
    if manifest.fall_back > FALL_BACK_INTERFACE:
        raise UpdateError(f"{name} needs a newer Debian package haptic-panel (fall-back {manifest.fall_back}): install that first")
    with alone(layout.download / "install.lock"):
        if layout.is_complete(manifest.version):
            if read_regular(folder / MANIFEST, MANIFEST_BYTES_MAX) != manifest.to_json():
                raise UpdateError(f"{folder}: another {name} is installed: what differs needs another version")
            return
        try:
            remove(folder)
            _build(layout, manifest, folder, progress)
        except BaseException as error:
            remove(folder)
            if isinstance(error, OSError):
                why = f"{folder}: cannot be built ({error.strerror or error}); nothing of it is left"
                failed_install.remember(layout, manifest, why)
                raise UpdateError(why) from error
            if isinstance(error, UpdateError):
                failed_install.remember(layout, manifest, str(error))
            raise
        failed_install.forget(layout)


def prune(layout: Layout, coming: Manifest) -> list[str]:
    """Remove own releases that nothing leads to any more, and files of the store that no release has; versions of those removed.

    Files of the release that is about to be installed (`coming`) are kept.
    """
    wanted = {layout.word("current"), layout.word("previous"), layout.word("trial"), coming.version}
    if layout.current.is_symlink():
        wanted.add(layout.current.readlink().name)
    if running := running_release():
        wanted.add(running.name)  # it works on, whatever has become of the link
    own = [folder for folder in layout.releases.iterdir() if folder.lstat().st_uid == os.geteuid()]  # root's are from a checkout
    removed = [folder for folder in own if folder.name not in wanted]
    with alone(layout.download / "install.lock"):
        for folder in removed:
            remove(folder)
        manifests = [coming, *(found for folder in layout.releases.iterdir() if (found := manifest_of(folder)))]
        kept = {file.sha256 for manifest in manifests for file in manifest.files}
        for file in layout.store.iterdir():
            if file.name not in kept:
                file.unlink()
    return sorted(folder.name for folder in removed)


def remove(folder: Path) -> None:
    """Remove a release, its mark first: at no time is there one that is called complete and is not."""
    (folder / COMPLETE).unlink(missing_ok=True)
    if folder.exists():
        _sync(folder.parent)
        shutil.rmtree(folder)


def _build(layout: Layout, manifest: Manifest, folder: Path, progress: Progress) -> None:
    wheels = folder / "wheels"
    wheels.mkdir(parents=True)
    for file in manifest.files:
        _link(layout, file, folder / file.path)
    progress(1, STEPS)
    base = Path(sys.base_prefix) / "bin" / f"python{manifest.python}"
    _run([base, "-I", "-m", "venv", "--without-pip", folder / "venv"], folder)
    python = folder / "venv/bin/python"
    progress(2, STEPS)
    pips = sorted(wheels.glob("pip-*.whl"))
    if len(pips) != 1:
        raise UpdateError(f"release {manifest.version} has {len(pips)} wheels of pip, and needs one to be installed with")
    requirements = wheels / "requirements.txt"
    listed = {Path(file.path).name: file.sha256 for file in manifest.files if file.path.startswith(WHEELS)}
    lines = [f"./{name} --hash=sha256:{digest}\n" for name, digest in sorted(listed.items()) if name != pips[0].name]
    requirements.write_text("".join(lines), encoding="utf-8")
    options = ["--quiet", "--no-index", "--no-deps", "--no-compile", "--no-cache-dir", "--disable-pip-version-check", "--no-input"]
    if lines:
        _run([python, "-I", pips[0] / "pip", "install", *options, "--require-hashes", "-r", requirements.name], wheels)
    shutil.rmtree(wheels)
    progress(3, STEPS)
    # without times of files: they are not those of the wheels, and nobody may write into a release
    _run([python, "-I", "-m", "compileall", "-q", "--invalidation-mode", "unchecked-hash", folder / "venv/lib"], folder)
    (folder / MANIFEST).write_bytes(manifest.to_json())
    _run([python, "-I", "-m", "controller", "--version"], folder)
    progress(4, STEPS)
    _sync(folder)
    write_durably(folder / COMPLETE, b"")
    _sync(folder)
    progress(STEPS, STEPS)


def _link(layout: Layout, file: ReleaseFile, path: Path) -> None:
    """A file of a release: the one in the store, found to be whole."""
    stored = layout.store / file.sha256
    try:
        whole = file.is_whole(stored)
    except FileNotFoundError:
        raise UpdateError(f"{stored}: {file.path} is not there: haptic-panel update download") from None
    if not whole:
        raise UpdateError(f"{stored}: {file.path} is damaged: haptic-panel update download fetches it again")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.hardlink_to(stored)


def _run(command: list[str | Path], folder: Path) -> None:
    # settings of pip on this device, such as another index or target, are for others
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    try:
        run_program(command, LIMIT_S, cwd=folder, environment=environment | {"PIP_CONFIG_FILE": os.devnull})
    except ProgramError as error:
        what = next((str(word) for word in command[2:] if str(word) in ("venv", "install", "compileall", "controller")), "")
        raise UpdateError(f"{folder}: {what} failed: {last_line(error.said) or error}; nothing of it is left") from error


def _sync(folder: Path) -> None:
    """Have everything that was written to this file system on the disk (syncfs): one call, not one a file."""
    try:
        run_program(["sync", "-f", folder], LIMIT_S)
    except ProgramError as error:
        raise UpdateError(f"{folder}: cannot be written: {last_line(error.said) or error}") from error
