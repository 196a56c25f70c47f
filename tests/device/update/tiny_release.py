"""Small releases in a repository signed by two people, made by the product's own code, for tests of what devices do with them."""

import base64
import hashlib
import io
import platform
import sys
import zipfile
from datetime import UTC, datetime

from controller.device.update.manifest import Manifest
from controller.workshop.publish.keys import new_key, open_key, read_public
from controller.workshop.publish.publications import draft_first, draft_releases
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.release_folder import write_release

NOW = datetime(2026, 11, 22, 12, tzinfo=UTC)
PASSPHRASE = "correct horse battery"
BUILT_S = 1_700_000_000


def wheel(name="tiny", version="1.0", code="WHO = 'tiny'\n", module=None, about=""):
    """File name and bytes of a wheel of one module (a path), always the same for the same arguments; `about`: more metadata."""
    info = f"{name}-{version}.dist-info"
    files = {
        module or f"{name}.py": code.encode(),
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n{about}".encode(),
        f"{info}/WHEEL": b"Wheel-Version: 1.0\nGenerator: tests\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    rows = []
    for path, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{path},sha256={digest},{len(data)}\n")
    files[f"{info}/RECORD"] = "".join([*rows, f"{info}/RECORD,,\n"]).encode()
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        for path, data in files.items():
            archive.writestr(zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0)), data)
    return f"{name}-{version}-py3-none-any.whl", made.getvalue()


def release_folder(out, version="1.0.0", counter=1, files=None, pieces=None, **fields):
    """A release's folder; `files` (path: bytes or Path) join a wheel, a board, its bank and gateware; None: without."""
    name, data = wheel()
    contents = {
        f"wheels/{name}": data,
        "boards/tiny/board.toml": b"# board\n",
        "banks/tiny.bank": bytes(range(256)) * 64,
        "gateware/tiny.bit": b"gateware\n",
        "sbom.cdx.json": b"{}\n",
    }
    contents |= files or {}
    about = {
        "version": version, "counter": counter, "python": f"3.{sys.version_info[1]}", "architecture": platform.machine(),
        "protocol": 1, "gateware_hash": "0123abcd", "bank_format": 4, "settings_format": 1, "built_s": BUILT_S, "files": [],
    }  # fmt: skip
    pieces = {"banks/tiny.bank": [(at, 256) for at in range(0, 16_384, 256)]} if pieces is None else pieces
    return write_release(
        out, Manifest(**(about | fields)), {path: data for path, data in contents.items() if data is not None}, pieces
    )


class TinyRepository:
    """A repository in `folder`, whose root and targets are signed by alice and bob, and snapshot and timestamp by the publisher."""

    def __init__(self, folder, keys, now=NOW):
        self.folder, self.now = folder, now
        keys.mkdir(exist_ok=True)
        self.public = {who: read_public(new_key(keys / f"{who}.pem", PASSPHRASE)) for who in ("alice", "bob", "publisher")}
        self.signers = {who: open_key(keys / f"{who}.pem", PASSPHRASE) for who in self.public}
        people, publisher = [self.public["alice"], self.public["bob"]], [self.public["publisher"]]
        with Repository.opened(folder, new=True) as repository:
            draft_first(repository, {"root": people, "targets": people, "snapshot": publisher, "timestamp": publisher}, 2, now)
        self.sign()
        self.root_json = folder / "metadata" / "1.root.json"

    def sign(self, *who):
        """Sign what is drafted by all (or those named), and publish it; whether it was published."""
        with Repository.opened(self.folder) as repository:
            for name in who or self.signers:
                repository.sign(self.signers[name])
            return repository.publish()

    def publish(self, *folders, channel="stable", rollout=None):
        """Put releases, as folders, into a channel."""
        with Repository.opened(self.folder) as repository:
            manifests = draft_releases(repository, folders, channel, self.now, rollout)
        assert self.sign()
        return manifests[-1]
