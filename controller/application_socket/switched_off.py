"""The file beside the socket that remembers, over a restart of the service, that a client has disarmed the panel."""

from __future__ import annotations

from pathlib import Path

from controller.log import Priority, log


class SwitchedOff:
    """Whether a client has disarmed the panel and no client has armed it since.

    Parameters
    ----------
    socket_path : str
        Path of the socket; the file is `<socket_path>.disarmed`.
    """

    def __init__(self, socket_path: str) -> None:
        self._file = Path(f"{socket_path}.disarmed")

    def __bool__(self) -> bool:
        return self._file.exists()

    def remember(self, disarmed: bool) -> None:
        """Create or remove the file; a failure is logged, and only costs the memory of it."""
        try:
            if disarmed:
                self._file.touch(mode=0o600)
            else:
                self._file.unlink(missing_ok=True)
        except OSError as error:
            log(
                f"{self._file}: {error.strerror}: after a restart the service would not know that the panel was switched",
                Priority.WARNING,
            )
