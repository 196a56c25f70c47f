"""What the bridge shows and asks for beyond this machine: its certificate, and the token of whoever may connect."""

from __future__ import annotations

import ssl
from pathlib import Path
from typing import Final

from controller.device.page.settings import PageSettings
from controller.errors import ConfigError
from controller.regular_file import read_regular

TOKEN_BYTES: Final = (16, 4096)  # least and most


def read_token(file: Path) -> str:
    """The token; raises ConfigError if it cannot be read, or is none."""
    try:
        token = read_regular(file, TOKEN_BYTES[1]).decode("ascii").strip()
    except (OSError, ValueError) as error:
        raise ConfigError(f"token_file = {str(file)!r}: cannot be read ({error})") from error
    if len(token) < TOKEN_BYTES[0] or not all(c.isalnum() or c in "-_" for c in token):
        raise ConfigError(f"token_file = {str(file)!r}: needs {TOKEN_BYTES[0]} or more letters, digits, - and _")
    return token


def tls_context(settings: PageSettings) -> ssl.SSLContext | None:
    """The certificate, if there is one; raises ConfigError if it cannot be used."""
    if not settings.tls_certificate:
        return None
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    try:
        context.load_cert_chain(settings.tls_certificate, settings.tls_key)
    except OSError as error:  # SSLError among them
        raise ConfigError(f"tls_certificate = {settings.tls_certificate!r}, tls_key: cannot be used ({error})") from error
    return context
