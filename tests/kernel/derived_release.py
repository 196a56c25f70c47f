"""Later releases made of one: the same files but for the package's wheel, which has another version and other lines."""

import base64
import hashlib
import os
import re
import shutil
import zipfile

import msgspec

from controller.device.update.layout import MANIFEST
from controller.device.update.manifest import ReleaseFile, read_manifest

LONG_AGO = (1980, 1, 1, 0, 0, 0)


def derived_release(release, folder, version, counter, changes):
    """Make a release of another.

    Parameters
    ----------
    release, folder : Path
        The one, and where the other is to be; files that both have are one, by hard links.
    version : str
    counter : int
    changes : dict
        For a file in the package's wheel, what makes its new text of its old one.
    """
    shutil.copytree(release, folder, copy_function=os.link)
    (wheel,) = folder.glob("wheels/haptic_panel-*.whl")
    other = changed_wheel(wheel, version, changes)
    wheel.unlink()
    before = read_manifest((release / MANIFEST).read_bytes(), str(release))
    data = other.read_bytes()
    file = ReleaseFile(path=f"wheels/{other.name}", sha256=hashlib.sha256(data).hexdigest(), size_bytes=len(data))
    files = [file if old.path == f"wheels/{wheel.name}" else old for old in before.files]
    (folder / MANIFEST).unlink()
    (folder / MANIFEST).write_bytes(msgspec.structs.replace(before, version=version, counter=counter, files=files).to_json())


def changed_wheel(wheel, version, changes):
    """A copy of a wheel beside it, of another version and with other lines; its path."""
    name, old, *tags = wheel.name.split("-")
    before, after = f"{name}-{old}.", f"{name}-{version}."
    changes = {path.replace("{version}", old): change for path, change in changes.items()} | {
        "controller/__init__.py": lambda text: re.sub(r'(?<=^__version__ = ").*(?="$)', version, text, flags=re.MULTILINE),
        f"{before}dist-info/METADATA": lambda text: text.replace(f"\nVersion: {old}\n", f"\nVersion: {version}\n", 1),
    }
    copy = wheel.with_name("-".join((name, version, *tags)))
    record = f"{after}dist-info/RECORD"
    lines = []
    with zipfile.ZipFile(wheel) as source, zipfile.ZipFile(copy, "w", zipfile.ZIP_DEFLATED) as target:
        for entry in source.infolist():
            path = entry.filename.replace(before, after, 1) if entry.filename.startswith(before) else entry.filename
            if path == record:
                continue
            data = source.read(entry)
            if change := changes.pop(entry.filename, None):
                changed = change(data.decode()).encode()
                assert changed != data, f"{path} is as it was"
                data = changed
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            lines.append(f"{path},sha256={digest},{len(data)}\n")
            written = zipfile.ZipInfo(path, LONG_AGO)
            written.external_attr = entry.external_attr
            target.writestr(written, data, zipfile.ZIP_DEFLATED)
        target.writestr(zipfile.ZipInfo(record, LONG_AGO), "".join([*lines, f"{record},,\n"]), zipfile.ZIP_DEFLATED)
    assert not changes, f"not in the wheel: {list(changes)}"
    return copy
