"""What the owner of a repository publishes, each as a draft that waits for signatures: first root, releases, keys, longer life."""

import re
from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, Final

import msgspec
from tuf.api.metadata import Key, Metadata, MetaFile, Root, Snapshot, TargetFile, Targets, Timestamp

from controller.device.update.layout import MANIFEST
from controller.device.update.manifest import Channel, Manifest, read_manifest
from controller.device.update.trust.rollout import OPENED, STOPPED, Rollout, opened_by, read_rollout, stopped_by
from controller.errors import UpdateError
from controller.workshop.publish.keys import owner
from controller.workshop.publish.metadata import LIFE, ROLES, issue
from controller.workshop.publish.publisher import LOCK, Repository
from controller.workshop.publish.release_folder import banks, digest_of, read_release
from controller.workshop.publish.repository_files import content_of, put

THRESHOLD_ROLES: Final = ("root", "targets")  # a threshold of several people; the others say only what is the newest
CHANNEL: Final = re.compile("[0-9a-z-]{1,32}")  # as in the settings of devices
STOPPED_MAX: Final = 100  # versions: a timestamp has 16 kB at most
LEFT_OVERS: Final = frozenset({"targets", ".draft.new", LOCK})  # of an `init` that was interrupted


def draft_first(repository: Repository, keys: Mapping[str, Sequence[Key]], threshold: int, now: datetime) -> None:
    """Draft a repository without releases.

    `keys` are those of each role; `threshold` people must sign what is root and targets. Raises UpdateError if there is a
    repository already, or fewer keys than the threshold.
    """
    if others := {path.name for path in repository.folder.iterdir()} - LEFT_OVERS:
        raise UpdateError(f"{repository.folder}: holds {min(others)} already: name a new folder, or an empty one")
    root = Root(version=1, expires=now + LIFE["root"], consistent_snapshot=True)
    for role in ROLES:
        root.roles[role].threshold = threshold if role in THRESHOLD_ROLES else 1
        for key in keys[role]:
            root.add_key(key, role)
    check_thresholds(root)
    first = {
        "root": root,
        "targets": Targets(version=1, expires=now + LIFE["targets"]),
        "snapshot": Snapshot(version=1, expires=now + LIFE["snapshot"]),
        "timestamp": Timestamp(version=1, expires=now + LIFE["timestamp"]),
    }
    for signed in first.values():
        issue(signed, now)
    repository.targets.mkdir(exist_ok=True)
    repository.begin({role: Metadata(signed) for role, signed in first.items()})


def draft_releases(
    repository: Repository, folders: Sequence[Path], channel: str, now: datetime, rollout: Rollout | None = None
) -> list[Manifest]:
    """Put releases into a channel.

    Folders are releases as `make-release` made them, such as one for each platform. Without a rollout they keep the one that they
    have in another channel, or all devices may take them. Raises UpdateError if a release was altered or stopped, its counter is
    not larger than that of the release it follows, or its version is taken.
    """
    repository.must_have_no_draft()
    if not CHANNEL.fullmatch(channel):
        raise UpdateError(f"channel {channel!r}: is no name of a channel: lower-case letters, digits and -, at most 32")
    targets = _changed(repository, now)
    known: dict[str, TargetFile] = targets["targets"].signed.targets
    offered = dict(channel_of(repository, known, channel).releases)
    manifests = []
    for folder in folders:
        manifest = read_release(folder)
        _must_not_be_stopped(repository, manifest.version)
        _check_follows(repository, known, offered, manifest, folder)
        for file in manifest.files:
            put(repository, known, folder / file.path, TargetFile(file.size_bytes, {"sha256": file.sha256}, file.target))
        for bank in banks(manifest):
            index = folder / bank.index_target
            put(repository, known, index, TargetFile.from_file(bank.index_target, str(index), ["sha256"]))
        signed = known.get(manifest.target) or TargetFile.from_file(manifest.target, str(folder / MANIFEST), ["sha256"])
        put(repository, known, folder / MANIFEST, _in_steps(signed, rollout) if rollout else signed)
        offered[manifest.platform] = manifest.target
        manifests.append(manifest)
    data = msgspec.json.format(msgspec.json.encode(Channel(releases=offered), order="sorted"), indent=1) + b"\n"
    put(repository, known, data, TargetFile.from_data(Channel.target(channel), data, ["sha256"]))
    repository.begin(targets)
    return manifests


def draft_rollout(repository: Repository, version: str, rollout: Rollout, now: datetime) -> None:
    """Draft other steps of a release, on all platforms, of which none but the first is open.

    Raises UpdateError if there is no such release, or it was stopped.
    """
    repository.must_have_no_draft()
    _must_not_be_stopped(repository, version)
    targets = _changed(repository, now)
    known: dict[str, TargetFile] = targets["targets"].signed.targets
    for path in _manifests(repository, known, version):
        known[path] = _in_steps(known[path], rollout)
    opened_by(targets["timestamp"].signed, str(repository.folder)).pop(version, None)
    repository.begin(targets)


def draft_stop(repository: Repository, version: str, now: datetime) -> None:
    """Draft a timestamp by which no further device takes a release; a stop is for good.

    Raises UpdateError if there is no such release, or it is stopped already.
    """
    repository.must_have_no_draft()
    _must_not_be_stopped(repository, version)
    _manifests(repository, repository.changed("targets", now).signed.targets, version)
    timestamp = repository.changed("timestamp", now)
    stopped = [*stopped_by(timestamp.signed, str(repository.folder)), version]
    if len(stopped) > STOPPED_MAX:
        raise UpdateError(
            f"{repository.folder}: {STOPPED_MAX} releases are stopped, which is the most: publish a later release instead"
        )
    timestamp.signed.unrecognized_fields[STOPPED] = stopped
    repository.begin({"timestamp": timestamp})


def draft_open(repository: Repository, version: str, now: datetime, *, everything: bool = False) -> None:
    """Draft a timestamp that opens the next step of a release, or all of them: each comes at its time.

    Raises UpdateError if there is no such release, it was stopped, or no step is left.
    """
    repository.must_have_no_draft()
    _must_not_be_stopped(repository, version)
    timestamp = repository.changed("timestamp", now)
    known: dict[str, TargetFile] = repository.changed("targets", now).signed.targets
    rollouts = [read_rollout(known[path].custom, path) for path in _manifests(repository, known, version)]
    opened = opened_by(timestamp.signed, str(repository.folder))
    before = opened.get(version, 0)
    closed = [step.share_ppm for rollout in rollouts if rollout for step in rollout.steps[1:] if step.share_ppm > before]
    if not closed:
        raise UpdateError(f"{repository.folder}: release {version} has no step that is not open yet")
    channels = [path.split("/")[1].removesuffix(".json") for path in known if path.startswith("channels/")]
    offered = {path.split("/")[1] for name in channels for path in channel_of(repository, known, name).releases.values()}
    kept = {name: share for name, share in opened.items() if name in offered}  # a timestamp has 16 kB at most
    timestamp.signed.unrecognized_fields[OPENED] = kept | {version: max(closed) if everything else min(closed)}
    repository.begin({"timestamp": timestamp})


def draft_keys(
    repository: Repository,
    add: Mapping[str, Sequence[Key]],
    drop: Mapping[str, Sequence[Key]],
    threshold: int | None,
    now: datetime,
) -> None:
    """Change whose keys count; the new root is signed by enough of the old keys and enough of the new ones.

    Raises UpdateError if a key to drop does not count, or fewer keys than the threshold would be left.
    """
    repository.must_have_no_draft()

    def edit(root: Root) -> None:
        for role in ROLES:
            for key in drop.get(role, ()):
                if key.keyid not in root.roles[role].keyids:
                    raise UpdateError(
                        f"{repository.folder}: the key of {owner(key)} does not count for {role}: it cannot be dropped"
                    )
                root.revoke_key(key.keyid, role)
            for key in add.get(role, ()):
                root.add_key(key, role)
            if threshold is not None and role in THRESHOLD_ROLES:
                root.roles[role].threshold = threshold
        check_thresholds(root)

    roles = _changed(repository, now)  # what an old key has signed is signed again
    repository.begin({"root": repository.changed("root", now, edit), **roles})


def draft_renewal(repository: Repository, now: datetime) -> None:
    """Draft a longer life of the timestamp, and of what has lived for more than half of its own."""
    repository.must_have_no_draft()
    roles = {role: repository.changed(role, now) for role in ROLES}
    old = {role for role in ROLES if (found := repository.published(role)) and found.signed.expires - now < LIFE[role] / 2}
    renewed: dict[str, Metadata[Any]] = {role: roles[role] for role in ROLES if role == "timestamp" or role in old}
    if "targets" in renewed or "snapshot" in renewed:
        renewed |= _changed(repository, now, targets="targets" in renewed)
    repository.begin(renewed)


def channel_of(repository: Repository, known: Mapping[str, TargetFile], name: str) -> Channel:
    """What a channel offers now; nothing if there is no such channel."""
    target = known.get(Channel.target(name))
    return msgspec.json.decode(content_of(repository, target), type=Channel) if target else Channel(releases={})


def check_thresholds(root: Root) -> None:
    """Check that each role has keys enough; raises UpdateError if one has not."""
    for role, wanted in root.roles.items():
        if not 1 <= wanted.threshold <= len(wanted.keyids):
            people = f"{wanted.threshold} people are to sign, but {len(wanted.keyids)} keys are given"
            raise UpdateError(f"{role}: {people}: give more, or another --threshold")


def _changed(repository: Repository, now: datetime, *, targets: bool = True) -> dict[str, Metadata[Any]]:
    """The next version of targets (or the same), and what points to it."""
    known = repository.published("targets")
    made: dict[str, Metadata[Any]] = {"targets": repository.changed("targets", now)} if targets else {}
    version = made["targets"].signed.version if targets else known.signed.version if known else 0
    snapshot = repository.changed("snapshot", now)
    snapshot.signed.meta["targets.json"] = MetaFile(version)
    timestamp = repository.changed("timestamp", now)
    timestamp.signed.snapshot_meta = MetaFile(snapshot.signed.version)
    return made | {"snapshot": snapshot, "timestamp": timestamp}


def _in_steps(target: TargetFile, rollout: Rollout) -> TargetFile:
    """A manifest's target with these steps in place of others."""
    fields = target.unrecognized_fields | {"custom": (target.custom or {}) | {"rollout": msgspec.to_builtins(rollout)}}
    return TargetFile(target.length, target.hashes, target.path, fields)


def _manifests(repository: Repository, known: Mapping[str, TargetFile], version: str) -> list[str]:
    """Paths of a release's manifests, one for each platform."""
    if found := [path for path in known if path.rpartition("/")[0] == f"releases/{version}"]:
        return found
    raise UpdateError(f"{repository.folder}: has no release {version}: is its draft published?")


def _must_not_be_stopped(repository: Repository, version: str) -> None:
    timestamp = repository.published("timestamp")
    if timestamp and version in stopped_by(timestamp.signed, str(repository.folder)):
        raise UpdateError(f"{repository.folder}: release {version} is stopped, for good: publish a later one")


def _check_follows(
    repository: Repository, known: Mapping[str, TargetFile], offered: Mapping[str, str], manifest: Manifest, folder: Path
) -> None:
    """Check that a release may follow what a channel offers."""
    taken = known.get(manifest.target)
    if taken and taken.hashes["sha256"] != digest_of(folder / MANIFEST)[0]:
        raise UpdateError(
            f"{folder}: version {manifest.version} for {manifest.platform} is published with other files: give it another version"
        )
    if manifest.platform in offered:
        path = offered[manifest.platform]
        before = read_manifest(content_of(repository, known[path]), path)
        if manifest.counter <= before.counter:
            which = (
                f"its counter {manifest.counter} is not larger than {before.counter} of version {before.version}, which is offered"
            )
            raise UpdateError(f"{folder}: {which}: make the release with --counter {before.counter + 1} or more")
