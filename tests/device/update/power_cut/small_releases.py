"""Small releases, each in a signed repository of its time: two wheels and pip, a bank of which a part changes, gateware."""

import base64
import hashlib
import importlib.metadata
import io
import random
import shutil
import zipfile

from repository_fixture import Publisher

BANK_BYTES, ENTRY_BYTES = 320_000, 4000
WHEELS = {"haptic_panel": "controller", "companion": "companion"}  # module of each


def wheel(name, module, version):
    """A wheel whose modules tell its version."""
    information = f"{name}-{version}.dist-info"
    files = {
        f"{module}/__init__.py": f"VERSION = {version!r}\n",
        f"{module}/__main__.py": f"print({version!r})\n",
        f"{module}/table.py": f"TABLE = {[version] * 2000!r}\n",
        f"{information}/METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n",
        f"{information}/WHEEL": "Wheel-Version: 1.0\nGenerator: tests\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    record = "".join(f"{path},sha256={_digest(text)},{len(text)}\n" for path, text in files.items())
    with io.BytesIO() as data:
        with zipfile.ZipFile(data, "w") as archive:
            for path, text in (files | {f"{information}/RECORD": f"{record}{information}/RECORD,,\n"}).items():
                archive.writestr(zipfile.ZipInfo(path), text)
        return data.getvalue()


def _digest(text):
    return base64.urlsafe_b64encode(hashlib.sha256(text.encode()).digest()).rstrip(b"=").decode()


def pip_wheel():
    """Name and content of a wheel of the pip that is installed here."""
    pip = importlib.metadata.distribution("pip")
    files = [file for file in pip.files if file.parts[0].startswith("pip") and file.suffix != ".pyc"]
    with io.BytesIO() as data:
        with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
            for file in files:
                archive.writestr(zipfile.ZipInfo(str(file)), pip.locate_file(file).read_bytes(), zipfile.ZIP_DEFLATED)
        return f"pip-{pip.version}-py3-none-any.whl", data.getvalue()


def bank(version):
    """Entries, of which a tenth is of this version."""
    entries = [random.Random(entry).randbytes(ENTRY_BYTES) for entry in range(BANK_BYTES // ENTRY_BYTES)]
    for entry in range(0, len(entries), 10):
        entries[entry] = random.Random(f"{version} {entry}").randbytes(ENTRY_BYTES)
    return b"".join(entries)


def publish(folder, versions):
    """Repositories at `folder/VERSION`, each as it was when that release was offered, and `folder/root.json`.

    Parameters
    ----------
    folder : Path
    versions : sequence of str
        In the order of their release.
    """
    publisher = Publisher(folder / "newest", now=None)
    (folder / "root.json").write_bytes(publisher.root)
    pip, content = pip_wheel()
    for counter, version in enumerate(versions, 1):
        files = {f"wheels/{name}-{version}-py3-none-any.whl": wheel(name, module, version) for name, module in WHEELS.items()}
        files[f"wheels/{pip}"] = content
        files["banks/panel.bank"] = bank(version)
        files["gateware/panel.bit"] = random.Random(version).randbytes(40_000)
        files["sbom.cdx.json"] = b"{}\n"
        publisher.release(version, counter, files, cut=ENTRY_BYTES)
        shutil.copytree(folder / "newest", folder / version)
