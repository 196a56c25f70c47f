"""The socket's file: made with its owner, group and mode before anybody can see it, and never taken from a live service."""

from __future__ import annotations

import contextlib
import fcntl
import grp
import os
import pwd
import socket
import stat
from collections.abc import Iterator
from pathlib import Path

from controller.board.devices import ApplicationSocket
from controller.errors import ConfigError, ControllerError

BACKLOG = 16  # clients that the kernel keeps waiting between two turns of the loop
UNCHANGED = -1  # owner or group, for chown


class SocketFile:
    """A listening Unix socket with its file, until `close`.

    The socket is bound under a name of its own that only its owner may connect to, gets owner, group and
    mode, listens, and is only then renamed to where clients look. Two services that start at once are kept
    apart by a lock on a file that only their user can open: a folder can be locked by whoever can read it.
    A file of a service that has died (nobody listens) is replaced.

    Raises
    ------
    ConfigError
        If the settings cannot be met: no such folder, user or group, or not permitted.
    ControllerError
        If another service listens there.
    """

    def __init__(self, settings: ApplicationSocket) -> None:
        self._path = Path(settings.path)
        owner, group = _number_of_user(settings.owner), _number_of_group(settings.group)
        own = self._path.with_name(f".{self._path.name}.{os.getpid()}")
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
            raise ConfigError(
                f"application_socket.path = {settings.path!r} cannot be made ({error.strerror or error});"
                " its folder has to exist and be this user's, and this user be owner and in the group asked for"
            ) from error

    def close(self) -> None:
        """Close, and remove the file if it is still this service's."""
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
    """Hold a lock that no other user can take; nothing is left behind, whatever happens."""
    number = _locked(lock)
    try:
        yield
    finally:
        lock.unlink(missing_ok=True)
        os.close(number)


def _locked(lock: Path) -> int:
    """The lock's file, open and locked, of this user and for this user alone."""
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
        os.close(number)  # who held it has removed it meanwhile: there may be another one by now


def _same(path: Path, opened: os.stat_result) -> bool:
    try:
        there = path.lstat()
    except FileNotFoundError:
        return False
    return (there.st_dev, there.st_ino) == (opened.st_dev, opened.st_ino)


@contextlib.contextmanager
def _hidden() -> Iterator[None]:
    """What is made in here is for its owner alone."""
    old = os.umask(0o177)
    try:
        yield
    finally:
        os.umask(old)


def _require_free(path: Path) -> None:
    """Refuse to take a path from a service that listens there, or from a file of another kind."""
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
