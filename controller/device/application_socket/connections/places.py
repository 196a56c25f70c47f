"""Who gets a place when there are more clients than places: a free one, or that of a client that gives way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from controller.device.application_socket.connections.connection import Connection
from controller.device.application_socket.connections.peers import Peer, Rights
from controller.device.application_socket.protocol.client_messages import Right
from controller.device.board.devices import ApplicationSocket


class PlaceOffer(NamedTuple):
    """A place, if there is one; if it is taken, its client has to give way. Else the reason why there is none."""

    place: Connection | None
    reason: str = ""


def offered(
    places: Sequence[Connection], peer: Peer, rights: tuple[Right, ...], names: Rights, settings: ApplicationSocket, now_s: float
) -> PlaceOffer:
    """The place for a new client.

    A user without the right to operate has at most `clients_per_user` places. If no place is free, the client that has been silent
    for longest gives way, provided that it was silent for `idle_s`. A client that may operate, and so disarm the panel, always gets
    a place: if nobody was silent for that long, that of the client without the right to operate that was heard longest ago.
    """
    operator = "operate" in rights
    there = [client for client in places if client.open]
    own = [client for client in there if client.peer.uid == peer.uid]
    if not operator and len(own) >= settings.clients_per_user:
        there, reason = own, f"{len(own)} clients of {names.called(peer)} are connected already"
    elif len(there) == len(places):
        reason = f"{len(there)} clients are connected already"
    else:
        return PlaceOffer(next(client for client in places if not client.open))
    idle = [client for client in there if client.silent and now_s - client.heard_s >= settings.idle_s]
    if operator and not idle:
        idle = [client for client in there if "operate" not in client.rights]
    if not idle:
        return PlaceOffer(None, reason)
    return PlaceOffer(min(idle, key=lambda client: (not client.silent, client.heard_s)))
