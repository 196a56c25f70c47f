"""What became of a reload, told to who asked for it: `systemctl reload` fails where the scene was refused.

The service writes it into its runtime folder ($RUNTIME_DIRECTORY, systemd.exec(5)), in memory, whole or not at all;
`ExecReload=` waits for the next one.
"""

from __future__ import annotations

import os
import select
import signal
from collections.abc import Mapping
from pathlib import Path
from typing import Self

import msgspec

from controller.errors import ConfigError, ControllerError

NAME = "reload"
LOOK_MS = 50


class Reloaded(msgspec.Struct, frozen=True):
    """How many reloads were decided since the service started, and why the last one was refused; empty if it was not."""

    count: int
    refused: str


class ReloadFile:
    """The service's end.

    Parameters
    ----------
    folder : Path or None
        None: nobody waits.
    """

    def __init__(self, folder: Path | None) -> None:
        self._file = folder / NAME if folder is not None else None
        self.write(0, "")

    @classmethod
    def from_environment(cls, environment: Mapping[str, str] = os.environ) -> Self:
        """In the folder that this service was given."""
        return cls(_folder(environment))

    def write(self, count: int, refused: str) -> None:
        """Take note of a reload; a full disk is no reason to stop."""
        if self._file is None:
            return
        new = self._file.with_suffix(".new")
        try:
            new.write_bytes(msgspec.json.encode(Reloaded(count, refused)))
            new.replace(self._file)
        except OSError:
            return


def reload(pid: int, environment: Mapping[str, str] = os.environ) -> None:
    """Have the service read its scene again, and wait until that is decided.

    Raises
    ------
    ConfigError
        If the scene was refused, with the reason; the old one goes on playing.
    ControllerError
        If there is no such service, or it ended meanwhile.
    """
    folder = _folder(environment)
    if folder is None:
        raise ConfigError("$RUNTIME_DIRECTORY is not set: this is what ExecReload= of the unit runs; use systemctl reload")
    before = _read(folder / NAME)
    try:
        process = os.pidfd_open(pid)
        signal.pidfd_send_signal(process, signal.SIGHUP)
    except OSError as error:
        raise ControllerError(f"process {pid} cannot be told to reload: {error.strerror}") from error
    poll = select.poll()
    poll.register(process, select.POLLIN)
    try:
        while (now := _read(folder / NAME)).count == before.count:
            if poll.poll(LOOK_MS):
                raise ControllerError("the service ended before it had decided")
    finally:
        os.close(process)
    if now.refused:
        raise ConfigError(f"the scene stays as it was: {now.refused}")


def _folder(environment: Mapping[str, str]) -> Path | None:
    named = environment.get("RUNTIME_DIRECTORY", "").partition(":")[0]
    return Path(named) if named else None


def _read(file: Path) -> Reloaded:
    try:
        return msgspec.json.decode(file.read_bytes(), type=Reloaded)
    except (OSError, msgspec.DecodeError) as error:
        raise ControllerError(f"{file}: {error}: does the service run?") from error
