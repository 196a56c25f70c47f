"""The version of this project's wheel: that of the release which it becomes a part of, wherever a version is reported."""

import base64
import hashlib
import re
import zipfile
from pathlib import Path
from typing import Final

from packaging.utils import parse_wheel_filename
from packaging.version import InvalidVersion, Version

from controller.errors import UpdateError, UsageError

TELLS_VERSION: Final = "controller/__init__.py"
LINE: Final = re.compile(rb'^__version__ = "[^"\n]*"$', re.MULTILINE)
MANUAL: Final = re.compile(rb'^(\.TH [^\n]*"version )[^"\n]+("[^\n]*panel )[^"\n]+(")')
METADATA: Final = re.compile(rb"^Version: \S+$", re.MULTILINE)


def check_version(version: str) -> None:
    """Check that a release's version is one of Python's, in the form that wheels have; raises UsageError if not."""
    try:
        canonical = str(Version(version))
    except InvalidVersion:
        raise UsageError(f"--version {version}: is no version of a Python package, such as 1.2.0 or 1.2.0rc1") from None
    if canonical != version:
        raise UsageError(f"--version {version}: is written {canonical}, as in the names of wheels")


def with_version(wheel: Path, version: str, folder: Path) -> Path:
    """A wheel of this project with another version: in its name, its metadata, its manual and `controller.__version__`.

    It goes into `folder`; the same wheel makes the same bytes. Raises UpdateError if it is no wheel of this project.
    """
    name, old, *tags = wheel.name.split("-")
    parse_wheel_filename(wheel.name)
    before, after = f"{name}-{old}.", f"{name}-{version}."
    change = {TELLS_VERSION: (LINE, f'__version__ = "{version}"'), f"{before}dist-info/METADATA": (METADATA, f"Version: {version}")}
    record, lines = f"{after}dist-info/RECORD", []
    made = folder / "-".join((name, version, *tags))
    try:
        with zipfile.ZipFile(wheel) as source, zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as target:
            for entry in source.infolist():
                path = after + entry.filename.removeprefix(before) if entry.filename.startswith(before) else entry.filename
                if path == record:
                    continue
                data = source.read(entry)
                if entry.filename in change:
                    pattern, text = change.pop(entry.filename)
                    data = pattern.sub(text.encode(), data, count=1)
                    if text.encode() not in data:
                        raise UpdateError(f"{wheel}: {entry.filename} tells no version: is it a wheel of haptic-panel?")
                if path.endswith("/haptic-panel.1"):
                    data = MANUAL.sub(rf"\g<1>{version}\g<2>{version}\g<3>".encode(), data)
                digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                lines.append(f"{path},sha256={digest},{len(data)}\n")
                _write(target, path, entry, data)
            _write(target, record, source.getinfo(f"{before}dist-info/RECORD"), "".join([*lines, f"{record},,\n"]).encode())
    except (zipfile.BadZipFile, KeyError) as error:
        raise UpdateError(f"{wheel}: cannot be read ({error})") from error
    if change:
        raise UpdateError(f"{wheel}: has no {next(iter(change))}: is it a wheel of haptic-panel?")
    return made


def _write(target: zipfile.ZipFile, path: str, like: zipfile.ZipInfo, data: bytes) -> None:
    """A file with the time and mode of another."""
    entry = zipfile.ZipInfo(path, like.date_time)
    entry.external_attr = like.external_attr
    target.writestr(entry, data, zipfile.ZIP_DEFLATED)
