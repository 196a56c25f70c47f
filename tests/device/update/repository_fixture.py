"""A signed repository for tests, made with python-tuf alone: every field of its metadata may be made wrong."""

import copy
import hashlib
import json
import shutil
from datetime import UTC, datetime, timedelta

from securesystemslib.signer import CryptoSigner
from tuf.api.metadata import Metadata, MetaFile, Root, Snapshot, TargetFile, Targets, Timestamp

from controller.device.update.download.bank_index import write_index
from controller.device.update.layout import COMPLETE, MANIFEST, Layout
from controller.device.update.manifest import Channel, Manifest, ReleaseFile, this_platform

NOW = datetime(2026, 11, 22, 12, tzinfo=UTC)
ROLES = ("root", "targets", "snapshot", "timestamp")
KEYS = {}


def key(name):
    """The same key for the same name: making one takes longer than anything else here."""
    return KEYS.setdefault(name, CryptoSigner.generate_ed25519())


class Publisher:
    """Signs what is in `targets` (path: bytes) into `folder`."""

    def __init__(self, folder, owner="owner", now=NOW):
        self.folder, self.owner = folder, owner
        self.versions = dict.fromkeys(ROLES, 0)
        self.targets, self.indexes = {}, {}
        self.days = {"root": 1825, "targets": 730, "snapshot": 730, "timestamp": 90}
        self.now, self.issued = now or datetime.now(UTC).replace(microsecond=0), None
        self.signers = {role: [key(f"{owner} {role}")] for role in ROLES}
        for name in ("metadata", "targets"):
            (folder / name).mkdir(parents=True)
        self.sign_root()

    def moved(self, folder):
        """The same publisher of a copy of its folder, independent from now on."""
        other = copy.copy(self)
        other.folder = folder
        for name in ("versions", "targets", "days", "signers"):
            setattr(other, name, dict(getattr(self, name)))
        return other

    def sign(self, role, signed, signers=None):
        self.versions[role] += 1
        signed.version = self.versions[role]
        signed.expires = self.now + timedelta(days=self.days[role])
        metadata = Metadata(signed)
        for signer in signers or self.signers[role]:
            metadata.sign(signer, append=True)
        data = metadata.to_bytes()
        name = "timestamp.json" if role == "timestamp" else f"{signed.version}.{role}.json"
        (self.folder / "metadata" / name).write_bytes(data)
        return data

    def sign_root(self, signers=None):
        root = Root(consistent_snapshot=True)
        for role in ROLES:
            for signer in self.signers[role]:
                root.add_key(signer.public_key, role)
        data = self.sign("root", root, signers)
        if self.versions["root"] == 1:
            self.root = data

    def publish(self):
        """All targets, and new metadata for them."""
        signed = Targets()
        for path, data in self.targets.items():
            signed.targets[path] = TargetFile.from_data(path, data, ["sha256"])
            self.file(path).parent.mkdir(parents=True, exist_ok=True)
            self.file(path).write_bytes(data)
        self.sign("targets", signed)
        self.sign("snapshot", Snapshot(meta={"targets.json": MetaFile(self.versions["targets"])}))
        self.stamp()

    def stamp(self):
        timestamp = Timestamp(snapshot_meta=MetaFile(self.versions["snapshot"]))
        issued = self.issued or self.now
        timestamp.unrecognized_fields["x-issued"] = issued if isinstance(issued, str) else issued.strftime("%Y-%m-%dT%H:%M:%SZ")
        self.sign("timestamp", timestamp)

    def file(self, path):
        """Where a target lies."""
        folder, _, name = path.rpartition("/")
        return self.folder / "targets" / folder / f"{hashlib.sha256(self.targets[path]).hexdigest()}.{name}"

    def release(self, version, counter, files, channel="stable", cut=None, **fields):
        """A release of files (path: bytes) in a channel; banks get an index, of pieces of `cut` bytes."""
        listed = []
        for path, data in files.items():
            file = ReleaseFile(path=path, sha256=hashlib.sha256(data).hexdigest(), size_bytes=len(data))
            listed.append(file)
            self.targets[file.target] = data
            if cut and path.startswith("banks/"):
                scratch = self.folder / "scratch"
                scratch.write_bytes(data)
                self.targets[file.index_target] = write_index(scratch, [(at, cut) for at in range(0, len(data) - cut + 1, cut)])
                scratch.unlink()
        architecture, _, python = this_platform().partition("-cp")
        reported = {
            "version": version, "counter": counter, "python": f"3.{python[1:]}", "architecture": architecture, "protocol": 1,
            "gateware_hash": "0123abcd", "bank_format": 4, "settings_format": 1, "files": listed,
        }  # fmt: skip
        manifest = Manifest(**(reported | fields))
        self.targets[manifest.target] = manifest.to_json()
        self.offer(channel, {manifest.platform: manifest.target})
        return manifest

    def offer(self, channel, releases):
        self.targets[Channel.target(channel)] = json.dumps({"releases": releases}).encode()
        self.publish()


class Device:
    """A device's folders; those that are there, if no root is given."""

    def __init__(self, folder, root=None):
        self.layout = Layout(folder / "haptic-panel", folder / "root.json")
        if root is not None:
            (folder / "root.json").write_bytes(root)
            for name in ("releases", "store", "state", "requests", "download"):
                (self.layout.root / name).mkdir(parents=True)

    def install(self, manifest):
        """As if the release had been installed from the store."""
        place = self.layout.release(manifest.version)
        place.mkdir()
        (place / MANIFEST).write_bytes(manifest.to_json())
        for file in manifest.files:
            if file.path.startswith("banks/"):
                (place / "banks").mkdir(exist_ok=True)
                (place / file.path).hardlink_to(self.layout.store / file.sha256)
        (place / COMPLETE).touch()
        self.layout.current.unlink(missing_ok=True)
        self.layout.current.symlink_to(f"releases/{manifest.version}")

    def kept(self):
        """Everything that a refused update must not have changed."""
        place = self.layout
        folders = (place.releases, place.store, place.state, place.requests)
        files = [file for folder in folders for file in sorted(folder.rglob("*")) if file.is_file()]
        names = [*files, place.download / MANIFEST, place.download / "counter"]
        return str(place.current.resolve()), {str(file): file.read_bytes() for file in names if file.exists()}


def copied(folder, to):
    """A copy of a repository, as on a stick, or as an attacker has kept it."""
    shutil.copytree(folder, to)
    return to
