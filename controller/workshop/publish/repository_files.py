"""Files of a repository, each at a path that names its content."""

import os
import shutil
from pathlib import Path

from tuf.api.exceptions import RepositoryError
from tuf.api.metadata import TargetFile

from controller.durable import sync_folder, tell_disk
from controller.errors import UpdateError
from controller.workshop.publish.publisher import Repository
from controller.workshop.publish.release_folder import digest_of


def content_of(repository: Repository, target: TargetFile) -> bytes:
    """A small file of the repository, checked."""
    file = repository.targets / target.get_prefixed_paths()[0]
    try:
        data = file.read_bytes()
        target.verify_length_and_hashes(data)
    except (OSError, RepositoryError) as error:
        raise UpdateError(f"{file}: is missing or altered: take it from a backup") from error
    return data


def put(repository: Repository, known: dict[str, TargetFile], content: Path | bytes, target: TargetFile) -> None:
    """A file into the repository, at a path that names its content."""
    copy(content, repository.targets / target.get_prefixed_paths()[0], target)
    known[target.path] = target


def copy(content: Path | bytes, to: Path, target: TargetFile) -> None:
    """Copy a file unless it is there; it is there whole or not at all."""
    with tell_disk(to):
        if to.exists() and digest_of(to) == (target.hashes["sha256"], target.length):
            return
        to.parent.mkdir(parents=True, exist_ok=True)
        new = to.with_name(f".{to.name}.new")
        try:
            with new.open("wb") as file:
                if isinstance(content, bytes):
                    file.write(content)
                else:
                    with content.open("rb") as source:
                        shutil.copyfileobj(source, file)
                file.flush()
                os.fsync(file.fileno())
            if digest_of(new) != (target.hashes["sha256"], target.length):
                raise UpdateError(
                    f"{content if isinstance(content, Path) else to}: changed while it was copied, or is damaged: repeat"
                )
            new.replace(to)
        finally:
            new.unlink(missing_ok=True)
        sync_folder(to.parent)
