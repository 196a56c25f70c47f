"""Hosts and origins as browsers send them, in one form: lower case, addresses in their shortest form, no default ports."""

from __future__ import annotations

import ipaddress
import re
from typing import Final, NamedTuple

SELF: Final = "self"  # in settings: the origin of the bridge's own pages
OPAQUE: Final = "null"  # sent by pages of files and sandboxed frames
DEFAULT_PORTS: Final = {"http": 80, "https": 443}

_AUTHORITY: Final = re.compile(r"(?P<name>\[[0-9a-f:.]+\]|[a-z0-9_.-]{1,253})(?::(?P<port>\d{1,5}))?", re.ASCII)
_ORIGIN: Final = re.compile(r"(?P<scheme>[a-z][a-z0-9+.-]{0,31})://(?P<authority>.+)", re.ASCII)


class Authority(NamedTuple):
    """Name or address of a host, and the port if one is named."""

    name: str
    port: int | None


class Origin(NamedTuple):
    """Where a page came from; the port is None for the scheme's own."""

    scheme: str
    name: str
    port: int | None


def authority(text: str) -> Authority:
    """Host and port of a Host field or an origin.

    Raises ValueError if it is neither a name nor an address, with at most one port.
    """
    found = _AUTHORITY.fullmatch(text.strip().lower())
    if found is None:
        raise ValueError(f"{shown(text)} is no name or address of a host")
    name = found["name"]
    name = f"[{ipaddress.IPv6Address(name[1:-1]).compressed}]" if name.startswith("[") else name.removesuffix(".")
    port = int(found["port"]) if found["port"] else None
    if not name or name.endswith(".") or (port is not None and port > 65535):
        raise ValueError(f"{shown(text)} is no name or address of a host")
    return Authority(name, port)


def origin_of(text: str) -> Origin | None:
    """Origin of an Origin field; None if it is not one. The opaque origin has an empty name."""
    text = text.strip().lower()
    if text == OPAQUE:
        return Origin(OPAQUE, "", None)
    found = _ORIGIN.fullmatch(text)
    if found is None:
        return None
    try:
        name, port = authority(found["authority"])
    except ValueError:
        return None
    return Origin(found["scheme"], name, None if port == DEFAULT_PORTS.get(found["scheme"]) else port)


def shown(text: str) -> str:
    """What somebody sent, quoted for a message: short, printable ASCII."""
    return ascii(text if len(text) <= 100 else f"{text[:100]}...")
