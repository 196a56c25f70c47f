"""Who is at the other end of a connection, as the kernel tells it, and what that user may do.

The groups are those of the process that connected (SO_PEERCRED, SO_PEERGROUPS: unix(7), socket(7)); no user database is
asked for them, which could keep the loop waiting.
"""

from __future__ import annotations

import ctypes
import errno
import grp
import os
import pwd
import socket
import struct
from dataclasses import dataclass
from typing import Literal

from controller.board.devices import ApplicationSocket
from controller.errors import ConfigError

Right = Literal["play", "operate"]
SO_PEERGROUPS = 59  # asm-generic/socket.h: of every machine but alpha, mips, parisc and sparc
CREDENTIALS = struct.Struct("iII")
GROUP_BYTES = 4
GROUPS = 64  # asked for at first; the kernel says if there are more
ROOT = 0
EVERYBODY = -1
LIBC = ctypes.CDLL(None, use_errno=True)  # Python's own getsockopt takes at most 1,024 bytes: 256 groups


@dataclass(frozen=True, slots=True)
class Peer:
    """A process that has connected."""

    uid: int
    pid: int
    groups: frozenset[int]


def peer_of(client: socket.socket) -> Peer:
    """Who has connected, when it did."""
    pid, uid, gid = CREDENTIALS.unpack(client.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, CREDENTIALS.size))
    return Peer(uid, pid, frozenset({gid, *_groups(client)}))


def _groups(client: socket.socket) -> list[int]:
    """Supplementary groups, however many there are; none from a kernel before 4.13."""
    size = ctypes.c_uint32(GROUPS * GROUP_BYTES)
    for _ in range(2):
        groups = (ctypes.c_uint32 * (size.value // GROUP_BYTES))()
        if LIBC.getsockopt(client.fileno(), socket.SOL_SOCKET, SO_PEERGROUPS, groups, ctypes.byref(size)) == 0:
            return groups[: size.value // GROUP_BYTES]
        if ctypes.get_errno() != errno.ERANGE:  # else the kernel has said how many there are
            break
    return []


class Rights:
    """What users may do: play (and read what the panel tells), operate (and play).

    Root and the service's own user may do everything. Names of users are those known at the start.

    Parameters
    ----------
    settings : ApplicationSocket
        With the groups; without `play_group` whoever may connect may play, without `operate_group` nobody else operates.

    Raises
    ------
    ConfigError
        If there is no such group.
    """

    def __init__(self, settings: ApplicationSocket) -> None:
        self._groups = {"play": settings.play_group, "operate": settings.operate_group}
        self._play = _number("play_group", settings.play_group) if settings.play_group else EVERYBODY
        self._operate = _number("operate_group", settings.operate_group) if settings.operate_group else None
        self._masters = {ROOT, os.geteuid()}
        self._names = {user.pw_uid: user.pw_name for user in pwd.getpwall()}

    def of(self, peer: Peer) -> tuple[Right, ...]:
        """What a peer may do."""
        if peer.uid in self._masters or self._operate in peer.groups:
            return ("play", "operate")
        return ("play",) if self._play == EVERYBODY or self._play in peer.groups else ()

    def called(self, peer: Peer) -> str:
        """A peer, for people."""
        name = self._names.get(peer.uid)
        return f"user {name!r} (uid {peer.uid}, pid {peer.pid})" if name else f"uid {peer.uid} (pid {peer.pid})"

    def why_not(self, peer: Peer, right: Right) -> str:
        """What to tell a peer that lacks a right."""
        group = self._groups[right]
        gives = f"group {group!r} gives it" if group else "the board's application_socket names no operate_group that could give it"
        return f"{self.called(peer)} does not have the right to {right}: {gives}"


def _number(key: str, group: str) -> int:
    try:
        return grp.getgrnam(group).gr_gid
    except KeyError:
        raise ConfigError(f"application_socket.{key} = {group!r}: no such group") from None
