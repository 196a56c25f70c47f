"""Takes what an older program kept in the state folder over to how this one keeps it, at the start of the service.

Files are copied forward: what the older program reads stays as it is, for a return to it, and as a backup. Each step is one link or
rename, so that a power cut leaves a file or none, and the next start goes on.
"""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

from controller.device.bank.inspection import measured_at
from controller.device.bank.lookup import of_this_format
from controller.device.board.paths import BANK_FORMAT
from controller.durable import sync_folder

TELLS_FORMAT = re.compile(r"\.v\d+(\.before-\d+)?\.bank\Z")


def migrate(state: Path) -> list[str]:
    """Give banks whose names tell no format (settings format 0) the names they have now.

    One that is newer than what has its new name, since an older program has calibrated the panel again, takes its place; what was
    there is kept as `NAME.before-…`. A measured one is never replaced by one that is not.

    Returns what was done, and what could not be: the banks are found where they are, too.
    """
    said = []
    for old in sorted((state / "banks").glob("*.bank")):
        if TELLS_FORMAT.search(old.name) or not of_this_format(old):
            continue
        new = old.with_name(f"{old.stem}.v{BANK_FORMAT}.bank")
        try:
            if not new.exists():
                _take(old, new)
                said.append(f"{new}: taken over from {old}, which stays for a return to an older release")
            elif _replaces(old, new):
                kept = new.with_name(f"{new.stem}.before-{old.stat().st_mtime_ns}.bank")
                if not kept.exists():
                    _take(new, kept)
                _take(old, new)
                said.append(f"{new}: taken over from {old}, which is newer; what it was is {kept}")
        except OSError as error:
            said.append(f"{new}: cannot be taken over from {old} ({error.strerror})")
    return said


def _replaces(old: Path, new: Path) -> bool:
    """Whether the bank of the old name was renewed since; a measured one is not replaced by a computed one."""
    newer = not new.samefile(old) and old.stat().st_mtime_ns > new.stat().st_mtime_ns
    return newer and (measured_at(old) or not measured_at(new))


def _take(source: Path, target: Path) -> None:
    """Let a path have the contents of another file, in one step; by a link, or where that may not be by a copy."""
    made = target.with_name(f".{target.name}.new")
    made.unlink(missing_ok=True)
    try:
        os.link(source, made)
    except OSError:
        shutil.copy2(source, made)
        with made.open("rb") as file:
            os.fsync(file.fileno())
    made.replace(target)
    sync_folder(target.parent)
