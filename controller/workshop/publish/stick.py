"""A repository on a stick: what the channels offer, for devices without a network."""

from datetime import datetime
from pathlib import Path
from typing import Final

import msgspec
from securesystemslib.signer import CryptoSigner
from tuf.api.metadata import TargetFile

from controller.device.update.manifest import Channel, read_manifest
from controller.durable import tell_disk, write_durably
from controller.errors import UpdateError
from controller.workshop.publish.keys import owner
from controller.workshop.publish.metadata import STICK_LIFE, to_bytes
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.release_folder import banks
from controller.workshop.publish.repository_files import content_of, copy

CHANNELS: Final = Channel.target("").removesuffix(".json")


def export(repository: Repository, stick: Path, signer: CryptoSigner, now: datetime) -> int:
    """Copy what the channels offer into a folder, such as on a stick, with a timestamp that lives for `STICK_LIFE`.

    The repository's own timestamp becomes newer than that of the stick, first: a device that has seen the stick goes on with it.

    The signer's key counts for the timestamp. Returns the bytes of all files. Raises UpdateError if a draft waits, the key does not
    count, a file is altered or cannot be copied, or the stick holds something else.
    """
    repository.must_have_no_draft()
    if stick.resolve().is_relative_to(repository.folder.resolve()):
        raise UpdateError(f"{stick}: is the repository itself, or in it: name another folder")
    first = Path("metadata/1.root.json")
    if (stick / first).exists() and (stick / first).read_bytes() != (repository.folder / first).read_bytes():
        raise UpdateError(f"{stick}: holds the repository of another owner: empty it, or name another folder")
    timestamp, newer = repository.changed("timestamp", now), repository.changed("timestamp", now)
    timestamp.signed.expires = now + STICK_LIFE
    newer.signed.version += 1
    keys = [repository.root.get_key(key_id) for key_id in repository.root.roles["timestamp"].keyids]
    if signer.public_key.keyid not in {key.keyid for key in keys}:
        raise UpdateError(f"{repository.folder}: a stick is signed by a key for timestamp: that of {', '.join(map(owner, keys))}")
    known: dict[str, TargetFile] = repository.changed("targets", now).signed.targets
    wanted = set()
    for path, channel in known.items():
        if not path.startswith(CHANNELS):
            continue
        wanted.add(path)
        for release in msgspec.json.decode(content_of(repository, channel), type=Channel).releases.values():
            manifest = read_manifest(content_of(repository, known[release]), release)
            wanted |= {release, *(file.target for file in manifest.files), *(bank.index_target for bank in banks(manifest))}
    with tell_disk(stick):
        for target in (known[path] for path in sorted(wanted)):
            name = target.get_prefixed_paths()[0]
            copy(repository.targets / name, stick / "targets" / name, target)
        for metadata in (timestamp, newer):
            metadata.sign(signer)
        write_durably(repository.metadata / "timestamp.json", to_bytes(newer))
        (stick / "metadata").mkdir(exist_ok=True)
        for file in sorted(repository.metadata.glob("*.*.json")):
            write_durably(stick / "metadata" / file.name, file.read_bytes())
        write_durably(stick / "metadata" / "timestamp.json", to_bytes(timestamp))
    return sum(known[path].length for path in wanted)
