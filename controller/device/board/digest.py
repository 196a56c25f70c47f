"""SHA-256 for a service that has little memory."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module

SHA256 = "_sha2", "_sha256", "hashlib"  # the last loads all of OpenSSL, 4 MB; as random.py does, of Python 3.12, 3.11, any


def sha256(data: bytes) -> bytes:
    """Digest of `data`, without loading OpenSSL where Python has its own."""
    for name in SHA256:
        with suppress(ImportError):
            return bytes(import_module(name).sha256(data).digest())
    raise AssertionError("every Python has hashlib")
