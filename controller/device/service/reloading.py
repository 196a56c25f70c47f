"""Result of a reload, for `systemctl reload`, which fails if the scene was refused.

The service writes it atomically to its runtime folder ($RUNTIME_DIRECTORY, systemd.exec(5)), in memory; the command of
`ExecReload=` waits for the next result.
"""

from __future__ import annotations

import os
import select
import signal
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Self

import msgspec

from controller.device.board.validation import NO_JSON
from controller.errors import ConfigError, ControllerError
from controller.regular_file import read_regular

NAME = "reload"
LOOK_MS = 50
BYTES_MAX = 65_536


class Reloaded(msgspec.Struct, frozen=True):
    """Result of the last reload."""

    count: int  # reloads since the service started
    refused: str  # why the last one was refused; empty if it was not
    environment: str = ""  # where the service's program is installed; empty: written before this key existed


class ReloadFile:
    """File with the result of the last reload, written by the service. Without a runtime folder nothing is written."""

    def __init__(self, folder: Path | None) -> None:
        self._file = folder / NAME if folder is not None else None
        self.write(0, "")

    @classmethod
    def from_environment(cls, environment: Mapping[str, str] = os.environ) -> Self:
        """File in the folder that $RUNTIME_DIRECTORY names."""
        return cls(_folder(environment))

    def write(self, count: int, refused: str) -> None:
        """Write how many reloads there were, and why the last was refused, if it was; an error, such as a full disk, is ignored."""
        if self._file is None:
            return
        new = self._file.with_suffix(".new")
        try:
            new.write_bytes(msgspec.json.encode(Reloaded(count, refused, sys.prefix)))
            new.replace(self._file)
        except OSError:
            return


def reload(pid: int, environment: Mapping[str, str] = os.environ) -> None:
    """Have the service read its scene again, and wait for the result.

    `pid` is the main process of the service. Raises ConfigError if the scene was refused, with the reason, or the service runs from
    another release than this program: what one of them wrote, the other may not read. The scene before stays in force. Raises
    ControllerError if the process does not exist, or ended meanwhile.
    """
    folder = _folder(environment)
    if folder is None:
        raise ConfigError("$RUNTIME_DIRECTORY is not set: this is what ExecReload= of the unit runs; use systemctl reload")
    before = _read(folder / NAME)
    if before.environment not in ("", sys.prefix):
        raise ConfigError(
            f"the service runs from {before.environment}, and this is {sys.prefix}: restart the service instead (systemctl restart)"
        )
    try:
        process = os.pidfd_open(pid)
        signal.pidfd_send_signal(process, signal.SIGHUP)
    except OSError as error:
        raise ControllerError(f"process {pid} cannot be sent SIGHUP: {error.strerror}") from error
    poll = select.poll()
    poll.register(process, select.POLLIN)
    try:
        while (now := _read(folder / NAME)).count == before.count:
            if poll.poll(LOOK_MS):
                raise ControllerError("the service ended during the reload")
    finally:
        os.close(process)
    if now.refused:
        raise ConfigError(f"the scene stays as it was: {now.refused}")


def _folder(environment: Mapping[str, str]) -> Path | None:
    named = environment.get("RUNTIME_DIRECTORY", "").partition(":")[0]
    return Path(named) if named else None


def _read(file: Path) -> Reloaded:
    try:
        return msgspec.json.decode(read_regular(file, BYTES_MAX), type=Reloaded)
    except (OSError, *NO_JSON) as error:
        raise ControllerError(f"{file}: {error}: does the service run?") from error
