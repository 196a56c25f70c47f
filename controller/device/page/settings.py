"""Settings of the bridge: page.toml as a checked record."""

from __future__ import annotations

import ipaddress
from pathlib import Path
from typing import Annotated, Any, Final

import msgspec
from msgspec import Meta

from controller.device.application_socket.client import DEFAULT_PATH
from controller.device.board.records import Record, load_toml
from controller.device.page.addresses import SELF, authority, origin_of

DEFAULT_PORT: Final = 8750
RIGHTS: Final = ("play", "regions", "screen", "operate")
Row = tuple[float, float, float]

# Everything comes from the bridge itself, and no other site shows its pages in a frame.
STRICT: Final = "default-src 'self'; base-uri 'none'; form-action 'none'; object-src 'none'; frame-ancestors 'self'"


class PageSettings(Record, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The whole file; README.md beside this module explains the keys."""

    listen: Annotated[tuple[str, ...], Meta(min_length=1, max_length=16)] = ("127.0.0.1", "::1")
    port: Annotated[int, Meta(ge=0, le=65535)] = DEFAULT_PORT
    socket: Annotated[str, Meta(min_length=1, max_length=107)] = DEFAULT_PATH
    www: str = ""
    field: str = ""
    hosts: tuple[str, ...] = ()
    origins: dict[str, Any] = msgspec.field(default_factory=lambda: {SELF: ("play", "regions")})  # rights of each
    max_pages: Annotated[int, Meta(ge=1, le=64)] = 8
    messages_per_s: Annotated[float, Meta(gt=0, le=10_000)] = 200.0
    burst: Annotated[int, Meta(ge=1, le=1000)] = 50
    tls_certificate: str = ""
    tls_key: str = ""
    token_file: str = ""
    x_mm_from_pixels: Row | None = None
    y_mm_from_pixels: Row | None = None
    content_security_policy: Annotated[str, Meta(pattern=r"^[ -~]*\Z")] = STRICT

    def __post_init__(self) -> None:
        beyond = [address for address in self.listen if not ipaddress.ip_address(address).is_loopback]
        if bool(self.tls_certificate) != bool(self.tls_key):
            raise ValueError("tls_certificate and tls_key: give both, or neither")
        if beyond and not (self.tls_certificate and self.token_file):
            raise ValueError(f"listen = {beyond[0]!r} is beyond this machine: that needs tls_certificate, tls_key and token_file")
        if (self.x_mm_from_pixels is None) != (self.y_mm_from_pixels is None):
            raise ValueError("x_mm_from_pixels and y_mm_from_pixels: give both, or neither")
        for name in self.hosts:
            if authority(name).port is not None:
                raise ValueError(f"hosts: {name!r} has a port: give the name alone, all ports are meant")
        for origin, rights in self.origins.items():
            if not isinstance(rights, list | tuple) or any(right not in RIGHTS for right in rights):
                raise ValueError(f"origins: {origin!r} = {rights!r}: must be a list, each one of {', '.join(map(repr, RIGHTS))}")
            if origin != SELF and origin_of(origin) is None:
                raise ValueError(f"origins: {origin!r} is none: give scheme, name and port as browsers send them, 'null' or 'self'")

    @property
    def scheme(self) -> str:
        """Of the bridge's own addresses."""
        return "https" if self.tls_certificate else "http"


def load_settings(file: Path | None) -> PageSettings:
    """Settings of a file; without one, the defaults; raises ConfigError if the file is absent or invalid."""
    return PageSettings() if file is None else load_toml(file, PageSettings)
