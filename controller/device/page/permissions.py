"""Who may open a page's socket, and what its messages may ask for: decided from tables, before anything is passed on."""

from __future__ import annotations

from collections.abc import Sequence
from http import HTTPStatus
from pathlib import Path
from typing import Any, Final, NamedTuple

from controller.device.application_socket.protocol.client_messages import RIGHTS, RIGHTS_TO_FOLLOW
from controller.device.page.addresses import OPAQUE, SELF, Origin, authority, origin_of, shown
from controller.device.page.settings import PageSettings

LOOPBACK: Final = frozenset({"localhost", "127.0.0.1", "[::1]"})

# The right that a message needs; every page of an allowed origin may look, and stop the outputs.
RIGHT_OF: Final[dict[str, str]] = {str(kind.__struct_config__.tag): right for kind, right in RIGHTS.items()} | {
    "screen": "screen",  # which the bridge itself answers, and these:
    **dict.fromkeys(("traces", "read_trace", "explain_trace", "calibrate", "mouse", "cancel"), "operate"),
}
# A right that brings another: whoever may operate may do all, as at the socket.
BRINGS: Final = {"operate": ("play", "regions", "screen")}


class Refusal(NamedTuple):
    """Answer to a request that is refused."""

    status: HTTPStatus
    reason: str


class Permissions:
    """The tables of the settings; refusals name their `file`."""

    def __init__(self, settings: PageSettings, file: Path | None) -> None:
        self._file = file or "a file for `haptic-panel page --settings`"
        self._scheme = settings.scheme
        self._names = LOOPBACK | {authority(name).name for name in settings.hosts}
        self._rights = {
            SELF if origin == SELF else origin_of(origin): frozenset(
                {"look", *rights, *(r for k in rights for r in BRINGS.get(k, ()))}
            )
            for origin, rights in settings.origins.items()
        }

    def host_refusal(self, hosts: Sequence[str]) -> Refusal | None:
        """Why a request with these Host fields is refused; None if it is not.

        A name that was rebound to this address, as DNS rebinding does, is no name of this bridge.
        """
        if len(hosts) != 1:
            return Refusal(HTTPStatus.BAD_REQUEST, f"{len(hosts)} Host fields: one is needed")
        try:
            name = authority(hosts[0]).name
        except ValueError as error:
            return Refusal(HTTPStatus.BAD_REQUEST, f"Host: {error}")
        if name in self._names:
            return None
        reason = f'{shown(hosts[0])} is no name of this bridge: hosts = ["{name}"] in {self._file} allows it'
        return Refusal(HTTPStatus.MISDIRECTED_REQUEST, reason)

    def rights(self, origins: Sequence[str], host: str) -> frozenset[str] | Refusal:
        """Rights of a page by its Origin fields, or why it has none.

        `host` is the request's Host field, which `host_refusal` has accepted.
        """
        if len(origins) != 1:
            reason = f"{len(origins)} Origin fields: a browser sends one, and other programs use the Unix socket"
            return Refusal(HTTPStatus.FORBIDDEN, reason)
        origin = origin_of(origins[0])
        if origin is None:
            return Refusal(HTTPStatus.FORBIDDEN, f"{shown(origins[0])} is no origin")
        if origin in self._rights:
            return self._rights[origin]
        own = origin_of(f"{self._scheme}://{host}")
        if origin == own and SELF in self._rights:
            return self._rights[SELF]
        line = f'{_quoted(origin, own)} = ["play"] below [origins] in {self._file}'
        return Refusal(HTTPStatus.FORBIDDEN, f"pages of {shown(origins[0])} may not use this panel: the line {line} allows it")


def refused(message: dict[str, Any], rights: frozenset[str]) -> str:
    """Why a page with these rights may not send a message; empty if it may."""
    kind = message.get("kind")
    needs = RIGHT_OF.get(kind) if isinstance(kind, str) else None
    if needs is None:
        return f"kind = {shown(str(kind))}: must be one of {', '.join(map(repr, RIGHT_OF))}"
    if kind == "subscribe" and needs in rights:
        for topic, right in RIGHTS_TO_FOLLOW.items():
            if topic in _topics(message) and right not in rights:
                return f"this page's origin may not subscribe to {topic}: the bridge's settings do not give it the right {right!r}"
    return "" if needs in rights else f"this page's origin may not {kind}: the bridge's settings do not give it the right {needs!r}"


def _topics(message: dict[str, Any]) -> list[Any]:
    to = message.get("to", ["touches"])
    return to if isinstance(to, list) else []


def _quoted(origin: Origin, own: Origin | None) -> str:
    """An origin as a key of TOML."""
    if origin == own:
        return SELF
    port = "" if origin.port is None else f":{origin.port}"
    return f'"{OPAQUE}"' if not origin.name else f'"{origin.scheme}://{origin.name}{port}"'
