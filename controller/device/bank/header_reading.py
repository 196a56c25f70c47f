"""Reading the header of a bank file: whether a file is a bank, whole and of a version that this program reads."""

from __future__ import annotations

import json
import math
import struct
from typing import Any

from controller.device.bank.file_format import (
    COMPACT_VERSION,
    COMPOSITIONS_MAX,
    CRC,
    FIXED,
    MAGIC,
    MAX_HEADER,
    PAGE,
    SAMPLES_MAX,
    SECTION,
    SECTIONS,
    VERSION,
    Header,
    Section,
    round_up,
)
from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS
from controller.device.kernel.crc import intact
from controller.errors import BankError


def begins_as_bank(start: bytes) -> bool:
    """Whether a file that starts with the bytes `start` may be replaced by a bank: it is one, damaged or not, or a part of one."""
    return MAGIC.startswith(start[: len(MAGIC)])


def header_length(start: bytes, file_bytes: int) -> int:
    """Length of the header in bytes, by the first 16 bytes of the file, or as many as it has.

    Raises BankError for what is empty, no bank, of another version, or cut off within the header.
    """
    if file_bytes == 0:
        raise BankError("is empty")
    if start[:8] != MAGIC[: len(start)]:
        raise BankError(f"is not a bank: it begins with {start[:8]!r}")
    if len(start) < 16:
        raise BankError(f"is truncated: {file_bytes} bytes, less than a header")
    _, version, length, *_ = struct.unpack("<8sII", start[:16])
    if version not in (VERSION, COMPACT_VERSION):
        raise BankError(
            f"has format version {version}; this program reads version {VERSION}, and {COMPACT_VERSION} of compact banks"
        )
    if not PAGE <= length <= MAX_HEADER or length % PAGE:
        raise BankError(f"is damaged: header of {length} bytes")
    if file_bytes < length:
        raise BankError(f"is truncated: {file_bytes} bytes, less than its header of {length}")
    return int(length)


def parse(data: bytes, file_bytes: int) -> tuple[Header, dict[str, Section]]:
    """Read a header of `header_length` bytes; the reverse of `Header.pack`.

    Raises BankError if the checksum is wrong, the file is cut short or has grown, or a table or section is not where this version
    of the format puts it.
    """
    body = data[: -CRC.size]
    if not intact(data):
        raise BankError("is damaged: CRC-32 of the header is wrong")
    fixed = FIXED.unpack_from(body)
    reported_bytes, maker, digest, pitch_m, x0_m, y0_m, bit_clock_hz, nx, ny, samples, channels, entries = fixed[3:15]
    parameters_bytes, section_count, compositions = fixed[15:]
    if file_bytes != reported_bytes:
        raise BankError(
            f"{'is truncated' if file_bytes < reported_bytes else 'has grown'}: {file_bytes} bytes instead of {reported_bytes}"
        )
    at = FIXED.size + section_count * SECTION.size
    compact = fixed[1] == COMPACT_VERSION
    counts_fit = section_count == SECTIONS + compact and compositions <= COMPOSITIONS_MAX and 1 <= samples <= SAMPLES_MAX
    if channels != CHANNELS or not counts_fit or at + parameters_bytes > len(body):
        raise BankError("has a header that this version of the format does not allow")
    if not all(map(math.isfinite, (pitch_m, x0_m, y0_m, bit_clock_hz))) or pitch_m <= 0 or bit_clock_hz <= 0 or entries > nx * ny:
        raise BankError("has a grid or bit clock that cannot be")
    try:
        parameters = json.loads(body[at : at + parameters_bytes])
        grid = Grid(pitch_m, nx, ny, x0_m, y0_m)
        header = Header(maker.rstrip(b"\0").decode(), digest, grid, bit_clock_hz, samples, entries, parameters, compositions)
    except ValueError as error:
        raise BankError(f"has unreadable build parameters or creator ({error})") from None
    if not isinstance(parameters, dict):
        raise BankError("has build parameters that are no table")
    if header.version != fixed[1] or (compact and not header.composes):
        raise BankError("has build parameters that do not fit its version of the format")
    if body[at + parameters_bytes :].strip(b"\0"):
        raise BankError("has padding in its header that is not zero")
    rows = [SECTION.unpack_from(body, FIXED.size + i * SECTION.size) for i in range(section_count)]
    return header, _sections(header, rows, len(data), reported_bytes)


def _sections(header: Header, rows: list[tuple[Any, ...]], header_bytes: int, file_bytes: int) -> dict[str, Section]:
    """Check the section table: known names, in order, each on the page after the last one's end."""
    found = {}
    end = header_bytes
    for reported, should in zip(rows, header.sections(), strict=True):
        name, offset, size, count, row_bytes, stride, crc = reported
        name = name.rstrip(b"\0").decode(errors="replace")
        if name != should.name:
            raise BankError(f"has section {name!r} where {should.name!r} belongs")
        if offset != round_up(end, PAGE):
            raise BankError(
                f"has section {name!r} at byte {offset}, not at {round_up(end, PAGE)}: out of order, apart or overlapping"
            )
        if (size, count, row_bytes, stride) != (should.size, should.rows, should.row_bytes, should.stride):
            raise BankError(f"has a section {name!r} that does not fit its samples, cells and entries")
        end = offset + size
        found[name] = Section(name, offset, count, row_bytes, stride, crc)
    if round_up(end, PAGE) != file_bytes:
        raise BankError(f"has sections that end at byte {end} of {file_bytes}")
    return found
