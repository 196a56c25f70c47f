"""The process at the other end of a connection, and what its user may do.

User and groups are those of the process when it connected (SO_PEERCRED, SO_PEERGROUPS: unix(7), socket(7)). The user database
is not asked for groups: it could block the loop.
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

from controller.device.application_socket.protocol.client_messages import Right
from controller.device.board.devices import LOOK_GROUP, ApplicationSocket
from controller.errors import ConfigError

SO_PEERGROUPS = 59  # asm-generic/socket.h: of every machine but alpha, mips, parisc and sparc
CREDENTIALS = struct.Struct("iII")
GROUP_BYTES = 4
GROUPS = 64  # room for the first attempt; the kernel reports if there are more
ROOT = 0
ALL: tuple[Right, ...] = ("play", "regions", "operate")
VERBS = {"regions": "lay regions over the scene"}
LIBC = ctypes.CDLL(None, use_errno=True)  # Python's own getsockopt takes at most 1,024 bytes: 256 groups


@dataclass(frozen=True, slots=True)
class Peer:
    """A process that has connected: its user id, process id and groups."""

    uid: int
    pid: int
    groups: frozenset[int]


def peer_of(client: socket.socket) -> Peer:
    """The process at the other end of a connected Unix socket, as it was when it connected."""
    pid, uid, gid = CREDENTIALS.unpack(client.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, CREDENTIALS.size))
    return Peer(uid, pid, frozenset({gid, *_groups(client)}))


def _groups(client: socket.socket) -> list[int]:
    """Supplementary groups, any number of them; none before Linux 4.13."""
    size = ctypes.c_uint32(GROUPS * GROUP_BYTES)
    for _ in range(2):
        groups = (ctypes.c_uint32 * (size.value // GROUP_BYTES))()
        if LIBC.getsockopt(client.fileno(), socket.SOL_SOCKET, SO_PEERGROUPS, groups, ctypes.byref(size)) == 0:
            return groups[: size.value // GROUP_BYTES]
        if ctypes.get_errno() != errno.ERANGE:  # else the kernel has written the size that it needs
            break
    return []


class Rights:
    """Rights of users: to look (at states and figures), to play (and to read touches), to lay regions over the scene, to operate.

    Who may operate may all of that.

    Root and the service's own user have all. User names are read once, at the start.

    Without `play_group` whoever may connect may play, without `operate_group` no other user may operate, without `regions_group` no
    other user may lay regions. Who is in `look_group` may not play, whatever else he is in: to connect at all, he has to be in the
    group of the socket. Raises ConfigError if a group does not exist.
    """

    def __init__(self, settings: ApplicationSocket) -> None:
        self._groups = {"play": settings.play_group, "regions": settings.regions_group, "operate": settings.operate_group}
        self._look = _look(settings.look_group)
        self._numbers = {right: _number(f"{right}_group", group) for right, group in self._groups.items() if group}
        self._masters = {ROOT, os.geteuid()}
        self._names = {user.pw_uid: user.pw_name for user in pwd.getpwall()}

    def of(self, peer: Peer) -> tuple[Right, ...]:
        """Rights of a process."""
        if peer.uid in self._masters:
            return ALL
        if self._look in peer.groups:
            return ("look",)
        if self._numbers.get("operate") in peer.groups:
            return ALL
        play: tuple[Right, ...] = ("play",) if "play" not in self._numbers or self._numbers["play"] in peer.groups else ()
        return (*play, "regions") if self._numbers.get("regions") in peer.groups else play

    def called(self, peer: Peer) -> str:
        """Name of the user with uid and pid, for messages."""
        name = self._names.get(peer.uid)
        return f"user {name!r} (uid {peer.uid}, pid {peer.pid})" if name else f"uid {peer.uid} (pid {peer.pid})"

    def why_not(self, peer: Peer, right: Right) -> str:
        """Message for a process without a right: which one, and which group has it."""
        if right == "play" and self._look in peer.groups:
            return f"{self.called(peer)} does not have the right to play: it is in the group that may only look"
        group = self._groups[right]
        gives = (
            f"group {group!r} gives it" if group else f"the board's application_socket names no {right}_group that could give it"
        )
        return f"{self.called(peer)} does not have the right to {VERBS.get(right, right)}: {gives}"


def _look(group: str) -> int | None:
    """Number of the group that may only look; None: there is none."""
    if not group:
        return None
    try:
        return _number("look_group", group)
    except ConfigError:
        if group == LOOK_GROUP:
            return None
        raise


def _number(key: str, group: str) -> int:
    try:
        return grp.getgrnam(group).gr_gid
    except KeyError:
        raise ConfigError(f"application_socket.{key} = {group!r}: no such group") from None
