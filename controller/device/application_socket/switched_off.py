"""The file beside the socket that remembers, over a restart of the service, that a client has switched the panel off, and who."""

from __future__ import annotations

import os
from pathlib import Path

from controller.log import Priority, log
from controller.regular_file import open_private, read_regular
from controller.text_file import decoded

UNKNOWN = "a client"  # of a file without a name that can be read
BYTES_MAX = 1024
CHARACTERS = 200


class SwitchedOff:
    """Who has switched the panel off, if no client has armed it since.

    The file is `<socket_path>.disarmed`; it is read once, here.
    """

    def __init__(self, socket_path: str) -> None:
        self._file = Path(f"{socket_path}.disarmed")
        self.by = self._read()  # who it was; empty: nobody

    def remember(self, by: str) -> bool:
        """Keep who has switched the panel off, or that it was armed (empty).

        The first who did stays. A failure is logged; then only a restart of the service forgets it.

        Returns whether that changes anything: of a client that asks again and again only the first request touches the file.
        """
        if by and self.by:
            return False
        self.by = by
        try:
            if by:
                fd = open_private(self._file)
                try:
                    os.ftruncate(fd, 0)
                    os.write(fd, f"{by}\n".encode())
                finally:
                    os.close(fd)
            else:
                self._file.unlink(missing_ok=True)
        except OSError as error:
            log(
                f"{self._file}: {error.strerror}: after a restart the service would not know that the panel was switched",
                Priority.WARNING,
            )
        return True

    def _read(self) -> str:
        """Who it was, by the file; one that cannot be read counts: in doubt the panel is off."""
        try:
            text = decoded(read_regular(self._file, BYTES_MAX))
        except FileNotFoundError:
            return ""
        except (OSError, ValueError):
            return UNKNOWN
        return "".join(filter(str.isprintable, text))[:CHARACTERS].strip() or UNKNOWN
