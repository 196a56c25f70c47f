"""What a draft of a repository would publish: what its signers read before they sign."""

from collections.abc import Sequence
from datetime import datetime, timedelta
from pathlib import Path
from typing import Final

from tuf.api.metadata import Root, TargetFile

from controller.device.update.layout import MANIFEST
from controller.device.update.trust.clock import TIMESTAMP_LIFE, as_text, issued
from controller.device.update.trust.rollout import opened_by, percent, read_rollout, stopped_by
from controller.errors import UpdateError
from controller.workshop.publish.keys import owner
from controller.workshop.publish.metadata import ROLES
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.release_folder import banks, digest_of, read_release

CLOCKS_APART: Final = timedelta(hours=1)  # of two computers of the owner


def describe(repository: Repository) -> list[str]:
    """A draft in lines: keys, releases with the SHA-256 of their manifests, channels, and until when."""
    lines = []
    root, before = repository.drafted("root"), repository.published("root")
    if root:
        for role in ROLES:
            lines += _keys(role, root.signed, before.signed if before else None)
    new, old = _targets(repository)
    for path in sorted(new):
        if path.startswith(("releases/", "channels/")):
            lines.append(f"{path}: sha256 {new[path].hashes['sha256']}, {new[path].length:,} bytes")
            if rollout := read_rollout(new[path].custom, f"{repository.draft}: {path}"):
                lines.append(f"{path}: {rollout}")
    if new:
        lines.append(f"{len(new)} new files, {sum(target.length for target in new.values()):,} bytes; {old} as before")
    if timestamp := repository.drafted("timestamp"):
        opened = opened_by(timestamp.signed, str(repository.draft))
        lines += [f"opened: steps of {version} up to {percent(share_ppm)}" for version, share_ppm in sorted(opened.items())]
        if stopped := stopped_by(timestamp.signed, str(repository.draft)):
            lines.append(f"stopped: {', '.join(stopped)}")
    for role in ROLES:
        if found := repository.drafted(role):
            made = issued(found.signed)
            of = f" of {made:%Y-%m-%d}" if made else ""
            lines.append(f"{role} version {found.signed.version}{of}, until {found.signed.expires:%Y-%m-%d}")
    return lines


def must_be_of_today(repository: Repository, now: datetime) -> None:
    """Check the dates of a draft by the clock of another computer than that it was made on: its signer's.

    Raises UpdateError if it was made later than now, or its timestamp has no life left.
    """
    for role in ROLES:
        made = issued(found.signed) if (found := repository.drafted(role)) else None
        if made and not made - CLOCKS_APART <= now <= made + TIMESTAMP_LIFE:
            raise UpdateError(
                f"{repository.draft / role}.json: was made at {as_text(made)}, and it is {as_text(now)} here: one of both clocks "
                "is wrong, or the draft has lain for too long: make it again"
            )


def must_be(repository: Repository, folders: Sequence[Path]) -> None:
    """Check that a draft has just the releases of these folders, which its signer has made; without folders nothing is checked.

    Raises UpdateError if it has another release, or other files.
    """
    if not folders:
        return
    new, _ = _targets(repository)
    drafted = repository.drafted("targets")
    known: dict[str, TargetFile] = drafted.signed.targets if drafted else {}
    left = {path for path in new if path.startswith("releases/")}
    for folder in folders:
        manifest = read_release(folder)
        wanted = {manifest.target: digest_of(folder / MANIFEST)[0]} | {file.target: file.sha256 for file in manifest.files}
        wanted |= {bank.index_target: digest_of(folder / bank.index_target)[0] for bank in banks(manifest)}
        for path, digest in wanted.items():
            if path not in known or known[path].hashes["sha256"] != digest:
                raise UpdateError(f"{repository.draft}: {path} is not that of {folder}: do not sign, find out who has changed what")
        left.discard(manifest.target)
    for path in sorted(left):
        raise UpdateError(f"{repository.draft}: has {path} too, which is none of the folders given: make that release as well")


def _targets(repository: Repository) -> tuple[dict[str, TargetFile], int]:
    """Targets of a draft that are not published yet, and how many are."""
    drafted, before = repository.drafted("targets"), repository.published("targets")
    known: dict[str, TargetFile] = before.signed.targets if before else {}
    all_of_it: dict[str, TargetFile] = drafted.signed.targets if drafted else {}
    new = {path: target for path, target in all_of_it.items() if known.get(path) != target}
    return new, len(all_of_it) - len(new)


def _keys(role: str, root: Root, before: Root | None) -> list[str]:
    """Keys of a role, and what of them is new or gone."""
    now = set(root.roles[role].keyids)
    was = set(before.roles[role].keyids) if before else set()
    names = [f"{owner(root.get_key(key_id))} {key_id[:16]}{' (new)' if key_id not in was else ''}" for key_id in sorted(now)]
    gone = [f"; {owner(before.get_key(key_id))} {key_id[:16]} is dropped" for key_id in sorted(was - now)] if before else []
    return [f"{role}: {root.roles[role].threshold} of {', '.join(names)}{''.join(gone)}"]
