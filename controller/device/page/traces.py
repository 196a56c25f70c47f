"""Traces of the loop that lie beside the panel's socket, where the service writes them: which there are, and a part of one."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any, Final

import msgspec
from msgspec import Meta

from controller.errors import ConfigError
from controller.regular_file import open_regular

PART_BYTES: Final = 1 << 15
NAMES: Final = ("trace-1.json", "trace-2.json", "trace-3.json")  # as the service calls them


class ReadTrace(msgspec.Struct, forbid_unknown_fields=True, tag_field="kind", tag="read_trace"):
    """Request for a part of a trace that was `written` when `TraceFolder.listed` says: what has replaced it is another."""

    name: str
    written: str
    offset: Annotated[int, Meta(ge=0, le=1 << 40)] = 0
    id: int | str | None = None


class TraceFolder:
    """The traces in a folder, that of the panel's socket."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def listed(self, _: dict[str, Any]) -> dict[str, Any]:
        """Answer to `traces`: all there are, the newest first."""
        found = []
        for name in NAMES:
            try:
                status = (self._folder / name).lstat()
            except OSError:
                continue
            found.append({"name": name, "bytes": status.st_size, "written": str(status.st_mtime_ns)})
        return {"kind": "traces", "files": sorted(found, key=lambda file: -int(str(file["written"])))}

    def path(self, name: object) -> Path:
        """A trace by its name; raises ConfigError if none is called so."""
        if name not in NAMES:
            raise ConfigError(f"name = {str(name)[:40]!r}: must be one of {', '.join(map(repr, NAMES))}")
        return self._folder / str(name)

    def part(self, message: dict[str, Any]) -> dict[str, Any]:
        """Answer to `read_trace`; raises ConfigError if there is no such trace (any more), or the message is none."""
        try:
            asked = msgspec.convert(message, ReadTrace)
        except msgspec.ValidationError as error:
            raise ConfigError(str(error)) from error
        file = self.path(asked.name)
        try:
            with os.fdopen(open_regular(file), "rb") as opened:
                status = os.fstat(opened.fileno())
                if str(status.st_mtime_ns) != asked.written:
                    raise ConfigError(f"{asked.name} was replaced by a newer trace: ask for `traces` again")
                text = os.pread(opened.fileno(), PART_BYTES, asked.offset).decode("ascii", "replace")
        except OSError as error:
            raise ConfigError(f"{asked.name}: cannot be read ({error.strerror})") from error
        return {"kind": "trace_part", "name": asked.name, "offset": asked.offset, "bytes": status.st_size, "text": text}
