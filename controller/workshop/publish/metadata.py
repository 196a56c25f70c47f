"""Metadata of a repository: its roles, how long each lives, when it was made, and its files."""

from collections.abc import Mapping
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any, Final

from tuf.api.exceptions import RepositoryError
from tuf.api.metadata import Key, Metadata, Signed
from tuf.api.serialization.json import JSONSerializer

from controller.device.update.trust.clock import ISSUED, TIMESTAMP_LIFE, as_text
from controller.errors import UpdateError
from controller.workshop.publish.keys import owner

ROLES: Final = ("root", "targets", "snapshot", "timestamp")
LIFE: Final = dict(zip(ROLES, [*(timedelta(days=days) for days in (1825, 730, 730)), TIMESTAMP_LIFE], strict=True))
STICK_LIFE: Final = timedelta(days=365)  # of the timestamp on a stick


def now() -> datetime:
    """The time, in whole seconds as metadata has it."""
    return datetime.now(UTC).replace(microsecond=0)


def issue(signed: Signed, now: datetime) -> None:
    """Say in metadata when it was made: devices without a clock take it for the least that the time can be."""
    signed.unrecognized_fields[ISSUED] = as_text(now)


def read_metadata(file: Path) -> Metadata[Any]:
    """Metadata from a file; raises UpdateError if it is none."""
    try:
        return Metadata.from_bytes(file.read_bytes())
    except (RepositoryError, OSError) as error:
        raise UpdateError(f"{file}: is no metadata of a repository: take it from a backup") from error


def check_signatures(file: Path, metadata: Metadata[Any], keys: Mapping[str, Key]) -> None:
    """Check that the signatures by these keys hold; raises UpdateError, which names the file, if one does not."""
    for key_id, key in keys.items():
        if key_id in metadata.signatures:
            try:
                key.verify_signature(metadata.signatures[key_id], metadata.signed_bytes)
            except Exception as error:
                raise UpdateError(f"{file}: the signature of {owner(key)} does not hold: have it signed again") from error


def to_bytes(metadata: Metadata[Any]) -> bytes:
    """Metadata as a file."""
    return metadata.to_bytes(JSONSerializer(compact=False))
