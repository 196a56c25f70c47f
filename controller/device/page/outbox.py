"""What waits to be sent to one page: the newest touch of each finger, the last emissions and state; all else is bounded."""

from __future__ import annotations

from typing import Final

import msgspec

WAITING_BYTES_MAX: Final = 256 << 10


class Notified(msgspec.Struct):
    """What tells one line of the panel from another."""

    kind: str
    id: int | str | None = None
    finger: int | None = None


_decoder: Final = msgspec.json.Decoder(Notified)


class TooSlow(Exception):
    """A page does not read what it is sent."""


class Outbox:
    """Lines in the order of their arrival; a newer touch, state or emissions take the place of the one that waits.

    A page that sleeps, as a phone's does, gets no old touches when it wakes.
    """

    def __init__(self, bytes_max: int = WAITING_BYTES_MAX) -> None:
        self._lines: dict[object, str] = {}
        self._bytes = 0
        self._bytes_max = bytes_max
        self._count = 0

    def __len__(self) -> int:
        return len(self._lines)

    def put(self, line: bytes) -> None:
        """Add a line of the panel; raises TooSlow if more waits than may."""
        text = line.decode(errors="replace").rstrip("\n")
        key = self._key(line)
        self._bytes += len(text) - len(self._lines.pop(key, ""))
        self._lines[key] = text
        if self._bytes > self._bytes_max:
            raise TooSlow(f"more than {self._bytes_max:,} bytes wait to be read")

    def put_if_room(self, line: bytes) -> None:
        """Add a line, unless half of what may wait does: who floods and does not read misses answers, and keeps its connection."""
        if 2 * self._bytes <= self._bytes_max:
            self.put(line)

    def take(self) -> str:
        """The line that has waited longest."""
        key = next(iter(self._lines))
        line = self._lines.pop(key)
        self._bytes -= len(line)
        return line

    def _key(self, line: bytes) -> object:
        self._count += 1
        try:
            found = _decoder.decode(line)
        except (msgspec.DecodeError, UnicodeDecodeError):
            return self._count
        if found.kind == "touch":
            return found.kind, found.finger
        newest_only = found.kind == "emissions" or (found.kind == "state" and found.id is None)
        return found.kind if newest_only else self._count
