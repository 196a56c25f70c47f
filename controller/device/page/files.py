"""The files that the bridge serves: its own, and those of one folder."""

from __future__ import annotations

import os
from http import HTTPStatus
from pathlib import Path
from typing import Final, NamedTuple
from urllib.parse import quote, unquote_to_bytes

from controller.regular_file import read_regular

OWN: Final = Path(__file__).parent / "www"
OWN_NAMES: Final = ("haptic.js", "live")  # a folder of an application does not hide them
FIELD: Final = ("live", "plate.field")  # a file of its own place: `haptic-panel focus --field-out`
BYTES_MAX: Final = 16 << 20
TYPES: Final = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".mjs": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".txt": "text/plain; charset=utf-8",
    ".json": "application/json",
    ".webmanifest": "application/manifest+json",
    ".wasm": "application/wasm",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".webp": "image/webp",
    ".gif": "image/gif",
    ".ico": "image/x-icon",
    ".woff2": "font/woff2",
    ".mp3": "audio/mpeg",
    ".mp4": "video/mp4",
}


class Served(NamedTuple):
    """Answer to a GET."""

    status: HTTPStatus
    body: bytes
    content_type: str = "text/plain; charset=utf-8"
    location: str = ""


def served(www: Path | None, target: str, field: Path | None = None) -> Served:
    """Answer to a request for a path.

    Nothing outside the folder is served, whatever its links say, nor a name that begins with a dot.

    `www` is the folder of the application's files, `target` the path of the request, percent-encoded, with its query, `field` what
    is served as `FIELD`.
    """
    path = os.fsdecode(unquote_to_bytes(target.partition("?")[0]))
    parts = [part for part in path.split("/") if part]
    if any(part.startswith(".") or "\\" in part or "\0" in part for part in parts) or not path.startswith("/"):
        return _missing()
    if not parts and www is None:
        return Served(HTTPStatus.FOUND, b"", location="/live/")
    root = OWN if parts and parts[0] in OWN_NAMES else www
    if tuple(parts) == FIELD and field is not None:
        root, parts = field.parent, [field.name]
    if root is None:
        return _missing()
    try:
        root = root.resolve(strict=True)
        file = root.joinpath(*parts).resolve(strict=True)
        if not file.is_relative_to(root):
            return _missing()
        if file.is_dir():
            if not path.endswith("/"):
                return Served(HTTPStatus.FOUND, b"", location="/" + "".join(f"{quote(os.fsencode(part))}/" for part in parts))
            file = file / "index.html"
        data = read_regular(file, BYTES_MAX)
    except (OSError, RuntimeError, ValueError):  # a circle of links is the second
        return _missing()
    return Served(HTTPStatus.OK, data, TYPES.get(file.suffix.lower(), "application/octet-stream"))


def _missing() -> Served:
    return Served(HTTPStatus.NOT_FOUND, b"there is no such file\n")
