"""Keys of those who sign releases: the private part in a file that a passphrase opens, the public part in a file beside it."""

from pathlib import Path
from typing import Any, Final

import msgspec
from cryptography.exceptions import UnsupportedAlgorithm
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey
from cryptography.hazmat.primitives.serialization import BestAvailableEncryption, Encoding, PrivateFormat, load_pem_private_key
from securesystemslib.signer import CryptoSigner, Key, SSlibKey
from tuf.api.metadata import Root

from controller.device.board.validation import NO_JSON
from controller.durable import write_durably
from controller.errors import UpdateError

PUBLIC: Final = ".pub"
OWNER: Final = "x-owner"  # field of a public key: whose it is
PASSPHRASE_LENGTH_MIN: Final = 12


def new_key(file: Path, passphrase: str) -> Path:
    """Make an ed25519 key: `file` with the private part, encrypted, mode 0600; beside it `*.pub` with the public part.

    The name of `file` without the ending is the name of its owner. Returns the public part. Raises UpdateError if one of the files
    exists, or the passphrase is too short.
    """
    public = file.with_suffix(PUBLIC)
    if file == public:
        raise UpdateError(f"{file}: *{PUBLIC} is the name of the public part: name the key {file.stem}.pem")
    for path in (file, public):
        if path.exists():
            raise UpdateError(f"{path}: exists: a key is never overwritten, name another file")
    if len(passphrase) < PASSPHRASE_LENGTH_MIN:
        raise UpdateError(
            f"{file}: a passphrase of {len(passphrase)} characters is too short: give at least {PASSPHRASE_LENGTH_MIN}"
        )
    private = Ed25519PrivateKey.generate()
    key = CryptoSigner(private).public_key
    shown = {"keyid": key.keyid, OWNER: file.stem, **key.to_dict()}
    pem = private.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, BestAvailableEncryption(passphrase.encode()))
    write_durably(file, pem, mode=0o600)
    write_durably(public, msgspec.json.format(msgspec.json.encode(shown, order="sorted"), indent=1) + b"\n")
    return public


def open_key(file: Path, passphrase: str) -> CryptoSigner:
    """The private part of a key.

    Raises UpdateError if the file is no such key, is not encrypted, or the passphrase does not open it.
    """
    try:
        pem = file.read_bytes()
    except OSError as error:
        raise UpdateError(f"{file}: the key cannot be read ({error.strerror}): is its stick plugged in?") from error
    if b"ENCRYPTED" not in pem:
        raise UpdateError(f"{file}: is no key that a passphrase protects: make one with `haptic-panel update repository key`")
    try:
        private = load_pem_private_key(pem, passphrase.encode())
    except (ValueError, TypeError, UnsupportedAlgorithm) as error:
        raise UpdateError(f"{file}: the passphrase does not open it, or the file is damaged") from error
    if not isinstance(private, Ed25519PrivateKey):
        raise UpdateError(f"{file}: is no ed25519 key: make one with `haptic-panel update repository key`")
    return CryptoSigner(private)


def read_public(file: Path) -> Key:
    """The public part of a key.

    Raises UpdateError if the file is none, or its identifier is not that of its value: one key must not count as two.
    """
    try:
        said: dict[str, Any] = msgspec.json.decode(file.read_bytes())
        key_id, owner = said.pop("keyid"), str(said.pop(OWNER))
        value = said["keyval"]["public"]
        key = SSlibKey.from_crypto(Ed25519PublicKey.from_public_bytes(bytes.fromhex(value)))
        if key.keyid != key_id or key.to_dict() != said:
            raise ValueError
    except OSError as error:
        raise UpdateError(
            f"{file}: cannot be read ({error.strerror}): it is the public part that belongs to a key (*{PUBLIC})"
        ) from error
    except (*NO_JSON, KeyError, TypeError, ValueError, AttributeError) as error:
        raise UpdateError(f"{file}: is no public part of a key, as `haptic-panel update repository key` makes it") from error
    key.unrecognized_fields[OWNER] = owner
    return key


def owner(key: Key) -> str:
    """Whose key it is."""
    return str(key.unrecognized_fields.get(OWNER, key.keyid[:8]))


def check_outside(key: Path, *folders: Path) -> None:
    """Check that a key lies in no repository; raises UpdateError."""
    for folder in folders:
        inside = key.resolve().is_relative_to(folder.resolve())
        if inside and ((folder / "metadata").is_dir() or (folder / "draft").is_dir()):
            raise UpdateError(
                f"{key}: a key must not lie in the repository {folder}, which others read: move it to a stick of its own"
            )


def known(root: Root, name: str, repository: Path) -> Key:
    """A key that counts for something in `repository`, by its public part or its owner's name.

    Raises UpdateError if none or several keys are the owner's.
    """
    if Path(name).exists():
        return read_public(Path(name))
    found = [key for key in root.keys.values() if owner(key) == name]
    if len(found) != 1:
        raise UpdateError(f"{repository}: {len(found)} keys are of {name!r}: give the public part of the one that is meant")
    return found[0]
