"""The socket's file: created with owner, group and mode before it is visible, never taken from a running service."""

from __future__ import annotations

import contextlib
import errno
import fcntl
import grp
import os
import pwd
import socket
import stat
from collections.abc import Iterator
from pathlib import Path

from controller.device.board.devices import ApplicationSocket
from controller.errors import ConfigError, ControllerError

BACKLOG = 16  # connections that the kernel queues between two turns of the loop
UNCHANGED = -1  # owner or group, for chown
PASSING = frozenset({errno.ENOSPC, errno.EDQUOT, errno.ENOMEM, errno.ENOBUFS, errno.EMFILE, errno.ENFILE, errno.EIO})


class SocketFile:
    """A listening Unix socket with its file, until `close`.

    The socket is bound under a temporary name to which only its owner may connect, gets owner, group and mode, listens, and is
    then renamed to its path. A lock keeps two services apart that start at the same time; it is on a file that only their user
    can open, because a folder can be locked by whoever can read it. The file of a service that died (nobody listens) is
    replaced.

    Raises ConfigError if there is no such folder, user or group, or this user may not create the file; ControllerError if another
    service listens there, or the system lacks space, memory or files at the moment.
    """

    def __init__(self, settings: ApplicationSocket) -> None:
        self._path = Path(settings.path)
        owner, group = _number_of_user(settings.owner), _number_of_group(settings.group)
        own = self._path.with_name(f".{self._path.name}.{os.getpid()}")
        # Listening and non-blocking
        self.listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM | socket.SOCK_NONBLOCK | socket.SOCK_CLOEXEC)
        try:
            with _only_one(self._path.with_name(f".{self._path.name}.lock")):
                _require_free(self._path)
                own.unlink(missing_ok=True)
                with _hidden():
                    self.listener.bind(str(own))
                try:
                    if (owner, group) != (UNCHANGED, UNCHANGED):
                        os.chown(own, owner, group)
                    own.chmod(int(settings.mode, 8))
                    self.listener.listen(BACKLOG)
                    own.rename(self._path)
                except OSError:
                    own.unlink(missing_ok=True)
                    raise
            self._made = self._path.lstat()
        except ControllerError:
            self.listener.close()
            raise
        except OSError as error:
            self.listener.close()
            if error.errno in PASSING:  # the settings are not to blame: the next start may succeed
                raise ControllerError(f"application_socket.path = {settings.path!r} cannot be made ({error.strerror})") from error
            raise ConfigError(
                f"application_socket.path = {settings.path!r} cannot be made ({error.strerror or error});"
                " its folder has to exist and be this user's, and this user be owner and in the group asked for"
            ) from error

    def close(self) -> None:
        """Close the listener, and remove the file if it is still this service's."""
        self.listener.close()
        with contextlib.suppress(OSError):
            there = self._path.lstat()
            if (there.st_dev, there.st_ino) == (self._made.st_dev, self._made.st_ino):
                self._path.unlink()


def _number_of_user(name: str) -> int:
    try:
        return pwd.getpwnam(name).pw_uid if name else UNCHANGED
    except KeyError:
        raise ConfigError(f"application_socket.owner = {name!r}: no such user") from None


def _number_of_group(name: str) -> int:
    try:
        return grp.getgrnam(name).gr_gid if name else UNCHANGED
    except KeyError:
        raise ConfigError(f"application_socket.group = {name!r}: no such group") from None


@contextlib.contextmanager
def _only_one(lock: Path) -> Iterator[None]:
    """Hold a lock that no other user can take; its file is removed in any case."""
    number = _locked(lock)
    try:
        yield
    finally:
        lock.unlink(missing_ok=True)
        os.close(number)


def _locked(lock: Path) -> int:
    """Open and lock the lock's file, which only this user can open."""
    while True:
        number = os.open(lock, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
        try:
            opened = os.fstat(number)
            if not stat.S_ISREG(opened.st_mode) or opened.st_uid != os.geteuid() or stat.S_IMODE(opened.st_mode) & 0o077:
                raise ConfigError(f"{lock} is not a file that only this user can open; remove it, or choose another folder")
            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if _same(lock, opened):
                return number
        except BlockingIOError:
            os.close(number)
            raise ControllerError(f"{lock.parent}: another service makes its socket there at this moment; start again") from None
        except BaseException:
            os.close(number)
            raise
        os.close(number)  # its holder has removed it meanwhile, and there may be a new file of that name: try again


def _same(path: Path, opened: os.stat_result) -> bool:
    try:
        there = path.lstat()
    except FileNotFoundError:
        return False
    return (there.st_dev, there.st_ino) == (opened.st_dev, opened.st_ino)


@contextlib.contextmanager
def _hidden() -> Iterator[None]:
    """Files created within are accessible to their owner only."""
    old = os.umask(0o177)
    try:
        yield
    finally:
        os.umask(old)


def _require_free(path: Path) -> None:
    """Raise if a service listens at the path, or if it is no socket."""
    try:
        if not stat.S_ISSOCK(path.lstat().st_mode):
            raise ConfigError(
                f"application_socket.path = {str(path)!r} is a file of another kind; remove it or choose another path"
            )
    except FileNotFoundError:
        return
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM | socket.SOCK_NONBLOCK) as probe:
        try:
            probe.connect(str(path))
        except ConnectionRefusedError:
            return  # nobody listens any more
        except BlockingIOError:
            pass  # somebody listens, and is busy
    raise ControllerError(f"{path}: another service is running there; stop it, or give this one another application_socket.path")
