"""The repository of signed releases, where its owner keeps it: what is published, and a draft that waits for signatures.

| folder | holds |
|---|---|
| `metadata/`, `targets/` | what devices read |
| `draft/` | metadata of the next publication, `<role>.json`, with the signatures that it has so far |

A draft is written whole by `begin` and is published whole once each of its roles has its signatures; `timestamp.json`, which
makes devices see it, comes last. Private keys are never in this folder, and are never needed by it.
"""

import os
import shutil
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from datetime import datetime
from pathlib import Path
from typing import Any, Final, Self

from securesystemslib.signer import CryptoSigner
from tuf.api.exceptions import RepositoryError
from tuf.api.metadata import Key, Metadata, Root, Targets

from controller.device.update.lock import alone
from controller.device.update.trust.clock import TIMESTAMP_LIFE, as_text, issued
from controller.durable import sync_folder, tell_disk, write_durably
from controller.errors import UpdateError
from controller.workshop.publish.keys import owner
from controller.workshop.publish.metadata import LIFE, ROLES, check_signatures, issue, read_metadata, to_bytes

ORDER: Final = ("targets", "snapshot", "root", "timestamp")  # of publication: nobody reads the first two before the last says so
DRAFT: Final = "draft"
LOCK: Final = ".lock"  # a file of the owner's: the folder itself may be locked by everybody who may read it


class Repository:
    """A repository, for as long as nobody else works on it.

    With `dated`, a date such as 2027-03-28 that people have looked up, a timestamp of that date is signed however long after the
    last one, or before it.
    """

    def __init__(self, folder: Path, dated: str | None = None) -> None:
        self.folder = folder
        self.dated = dated
        self.metadata = folder / "metadata"
        self.targets = folder / "targets"
        self.draft = folder / DRAFT

    @classmethod
    @contextmanager
    def opened(cls, folder: Path, *, new: bool = False, dated: str | None = None) -> Iterator[Self]:
        """Lock a repository, or a new one; raises UpdateError if it is none (or there is one), or another process works on it."""
        repository = cls(folder, dated)
        if new:
            folder.mkdir(parents=True, exist_ok=True)
        elif not (repository.metadata.is_dir() or repository.draft.is_dir()):
            raise UpdateError(f"{folder}: is no repository: `haptic-panel update repository init` makes one")
        with ExitStack() as stack:
            try:
                stack.enter_context(alone(folder / LOCK, "another process works on this repository: repeat when it is done"))
            except OSError as error:
                if os.access(folder, os.W_OK):  # else nothing of it can be changed by this user
                    raise UpdateError(
                        f"{folder / LOCK}: cannot be opened ({error.strerror}): let the user who owns it do this, or remove it"
                    ) from error
            yield repository

    def published(self, role: str) -> Metadata[Any] | None:
        """What devices read of a role; None before the first publication."""
        if role == "timestamp":
            newest = self.metadata / "timestamp.json"
        else:
            versions = [int(name.name.split(".")[0]) for name in self.metadata.glob(f"*.{role}.json") if name.name[0].isdigit()]
            newest = self.metadata / f"{max(versions, default=0)}.{role}.json"
        return read_metadata(newest) if newest.exists() else None

    def drafted(self, role: str) -> Metadata[Any] | None:
        """What the draft has of a role."""
        file = self.draft / f"{role}.json"
        return read_metadata(file) if file.exists() else None

    @property
    def root(self) -> Root:
        """Whose keys count for what is drafted or published."""
        found = self.drafted("root") or self.published("root")
        if found is None or not isinstance(found.signed, Root):
            raise UpdateError(f"{self.folder}: has no root.json: `haptic-panel update repository init` makes a repository")
        return found.signed

    def changed(self, role: str, now: datetime, edit: Callable[[Any], None] = lambda _: None) -> Metadata[Any]:
        """The next version of what is published of a role, without signatures.

        Its life begins `now`; `edit` changes its content. Raises UpdateError if nothing of it is published yet; for the timestamp,
        if now is no time that it can be made at.
        """
        found = self.published(role)
        if found is None:
            raise UpdateError(f"{self.folder}: nothing is published yet: have its first draft signed by all")
        found.signatures.clear()
        found.signed.version += 1
        found.signed.expires = now + LIFE[role]
        if role == "timestamp":
            self._check_issued(now)
        issue(found.signed, now)
        edit(found.signed)
        return found

    def must_have_no_draft(self) -> None:
        """Check that nothing waits for signatures; raises UpdateError if a draft does."""
        if self.draft.exists():
            raise UpdateError(
                f"{self.draft}: waits for signatures: {self.lacking() or 'sign once more'}; or give it up: remove this folder"
            )

    def begin(self, roles: Mapping[str, Metadata[Any]]) -> None:
        """Write a draft; it is there whole or not at all."""
        making = self.folder / f".{DRAFT}.new"
        with tell_disk(self.folder):
            shutil.rmtree(making, ignore_errors=True)
            making.mkdir()
            for role, metadata in roles.items():
                write_durably(making / f"{role}.json", to_bytes(metadata))
            making.rename(self.draft)
            sync_folder(self.folder)

    def signers(self, role: str) -> dict[str, Key]:
        """Keys that count for a role of the draft, by their identifiers; for a new root those of the old one too."""
        return {key_id: root.get_key(key_id) for root in self._roots(role) for key_id in root.roles[role].keyids}

    def sign(self, signer: CryptoSigner) -> list[str]:
        """Sign every role of the draft that this key counts for; returns the roles.

        Raises UpdateError if there is no draft, the key counts for nothing of it, or it is dated as no timestamp may be that
        follows the last.
        """
        drafted = self._all_drafted()
        roles = [role for role in drafted if signer.public_key.keyid in self.signers(role)]
        if not roles:
            who = sorted({owner(key) for role in drafted for key in self.signers(role).values()})
            raise UpdateError(f"{self.draft}: this key counts for nothing of it; what counts are the keys of {', '.join(who)}")
        if (timestamp := drafted.get("timestamp")) and (made := issued(timestamp.signed)):
            self._check_issued(made)
        for role in roles:
            drafted[role].sign(signer, append=True)
            write_durably(self.draft / f"{role}.json", to_bytes(drafted[role]))
        return roles

    def take(self, folder: Path) -> list[str]:
        """Take over signatures from a copy of the draft, which was signed elsewhere; returns whose they are.

        Raises UpdateError if it is the copy of another draft, or has a signature that does not hold.
        """
        other, taken = Repository(folder), set()
        if not other.draft.is_dir():
            raise UpdateError(f"{other.draft}: is not there: name the folder that the copy of `draft` lies in")
        for role, mine in self._all_drafted().items():
            copy = other.drafted(role)
            if copy is None or copy.signed_bytes != mine.signed_bytes:
                raise UpdateError(
                    f"{other.draft / role}.json: is not a copy of {self.draft / role}.json: copy the draft again, and sign that"
                )
            keys = self.signers(role)
            for key_id, signature in copy.signatures.items():
                if key_id in keys and key_id not in mine.signatures:
                    mine.signatures[key_id] = signature
                    taken.add(owner(keys[key_id]))
            check_signatures(other.draft / f"{role}.json", mine, keys)
            write_durably(self.draft / f"{role}.json", to_bytes(mine))
        return sorted(taken)

    def lacking(self) -> str:
        """Whose signatures the draft lacks, as text; empty if none."""
        reported = []
        for role, metadata in self._all_drafted().items():
            for root in self._roots(role):
                result = root.get_verification_result(role, metadata.signed_bytes, metadata.signatures)
                if not result:
                    reported.append(f"{role} lacks {result.missing} of {', '.join(sorted(map(owner, result.unsigned.values())))}")
        return "; ".join(dict.fromkeys(reported))

    def publish(self) -> bool:
        """Publish the draft if it has its signatures; a publication that was interrupted goes on.

        A copy without `targets/`, in which somebody has signed elsewhere, publishes nothing.

        Returns whether it was published. Raises UpdateError if the draft contradicts what is published, or files of it are missing
        or altered.
        """
        if self.lacking() or not self.targets.is_dir():
            return False
        drafted = self._all_drafted()
        for role, metadata in drafted.items():
            published = self.published(role)
            if published and published.signed.version != metadata.signed.version - 1 and published.signed != metadata.signed:
                raise UpdateError(
                    f"{self.draft / role}.json: does not follow version {published.signed.version}, which is published"
                )
        self._check_files()
        with tell_disk(self.folder):
            self.metadata.mkdir(exist_ok=True)
            for role, metadata in sorted(drafted.items(), key=lambda item: ORDER.index(item[0])):
                name = "timestamp.json" if role == "timestamp" else f"{metadata.signed.version}.{role}.json"
                write_durably(self.metadata / name, to_bytes(metadata))
            done = self.folder / f".{DRAFT}.done"
            shutil.rmtree(done, ignore_errors=True)
            self.draft.rename(done)
            sync_folder(self.folder)
            shutil.rmtree(done, ignore_errors=True)
        return True

    def _roots(self, role: str) -> list[Root]:
        """Those whose keys sign a role of the draft: a new root is signed by the keys of the old one too."""
        old = self.published("root") if role == "root" else None
        return [self.root, old.signed] if old else [self.root]

    def _all_drafted(self) -> dict[str, Metadata[Any]]:
        """What the draft has, by role."""
        if drafted := {role: found for role in ROLES if (found := self.drafted(role))}:
            return drafted
        raise UpdateError(f"{self.folder}: nothing waits for signatures: `add`, `rotate` or `renew` make a draft")

    def _check_issued(self, now: datetime) -> None:
        """Check that a timestamp made now may follow the one that is published: devices would believe a clock that is wrong."""
        last = self.published("timestamp")
        before = issued(last.signed) if last else None
        if before is None or before <= now <= before + TIMESTAMP_LIFE or f"{now:%Y-%m-%d}" == self.dated:
            return
        how = "earlier than" if now < before else f"more than {TIMESTAMP_LIFE.days} days after"
        raise UpdateError(
            f"{self.folder}: a timestamp of {as_text(now)} is {how} the last one, of {as_text(before)}: set this computer's clock "
            f"right, and give up a draft made by it; if it is right, add --date {now:%Y-%m-%d}"
        )

    def _check_files(self) -> None:
        """Each file of the draft is there, whole."""
        metadata, before = self.drafted("targets"), self.published("targets")
        if metadata is None:
            return
        known = before.signed.targets if before else {}
        assert isinstance(metadata.signed, Targets)
        for path, target in metadata.signed.targets.items():
            if path in known and known[path] == target:
                continue
            file = self.targets / target.get_prefixed_paths()[0]
            try:
                with file.open("rb") as opened:
                    target.verify_length_and_hashes(opened)
            except (OSError, RepositoryError) as error:
                raise UpdateError(f"{file}: is missing or altered: add the release again") from error
