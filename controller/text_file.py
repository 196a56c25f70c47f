"""Text files as people and other systems leave them: UTF-8 with or without a byte order mark, UTF-16 with one, any line ends."""

from __future__ import annotations

import codecs
from pathlib import Path
from typing import Final

MAX_BYTES: Final = 1 << 30  # so that a device or pipe without end ends
MARKS: Final = (
    (codecs.BOM_UTF8, "UTF-8"),
    (codecs.BOM_UTF16_LE, "UTF-16-LE"),  # what Windows calls Unicode, and what its shell's > writes
    (codecs.BOM_UTF16_BE, "UTF-16-BE"),
)


class NotText(ValueError):
    """Bytes that are no text; the message says which line, and what to do."""


def decoded(data: bytes) -> str:
    """Text of bytes, without byte order mark and with its own line ends.

    Raises NotText if they are neither UTF-8 nor, with a byte order mark, UTF-16.
    """
    mark, encoding = next((found for found in MARKS if data.startswith(found[0])), (b"", "UTF-8"))
    try:
        return data[len(mark) :].decode(encoding)
    except UnicodeDecodeError as error:
        line = data[: len(mark) + error.start].decode(encoding, "ignore").count("\n") + 1
        raise NotText(f"line {line} is not {encoding}: save the file as UTF-8") from error


def read_text(file: Path, max_bytes: int = MAX_BYTES) -> str:
    r"""Text of a file, without byte order mark, its lines ended by \n.

    Raises OSError if it cannot be read. Raises ValueError if its name has a NUL; as `NotText` if it is too large or no text.
    """
    with file.open("rb") as opened:
        data = opened.read(max_bytes + 1)
    if len(data) > max_bytes:
        raise NotText(f"it is larger than the {max_bytes:,} bytes of any such file")
    return decoded(data).replace("\r\n", "\n").replace("\r", "\n")
