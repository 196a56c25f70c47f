"""Lines of Verilog, of the kernel and of the README's table that follow from the fields of frames; `register_table` writes them."""

from collections.abc import Iterable

from controller.device.fpga.frame_table import CRC_FIELD, HEADER_FIELDS, PAYLOADS, STATUS_FIELDS, FrameField, offset_of, packing
from controller.device.fpga.registers import (
    CHUNK_WORDS,
    CHUNKS,
    CRC_RESIDUE,
    FRAME_SYNC,
    LOAD_PAYLOAD_MIN_BYTES,
    SHORT_PAYLOAD_BYTES,
    FrameType,
)

HEADER_BYTES = packing(HEADER_FIELDS).size
KERNEL: dict[str, tuple[int, str]] = {
    "FRAME_SYNC": (FRAME_SYNC, ""),
    "LOAD": (int(FrameType.LOAD), "type of frame"),
    "CHUNK_BYTES": (4 * CHUNK_WORDS, "words of a LOAD frame that is not the last"),
    "PADDED_BYTES": (LOAD_PAYLOAD_MIN_BYTES, "shortest payload of a LOAD"),
    "CHUNKS": (CHUNKS, ""),
    "SHORT_FRAME_BYTES": (HEADER_BYTES + SHORT_PAYLOAD_BYTES + CRC_FIELD.size, "of a status, too"),
    "NUMBER_AT": (offset_of("sequence", HEADER_FIELDS), "byte of the header"),
    "FAULTS_AT": (offset_of("faults", STATUS_FIELDS), "byte of a status"),
    "CRC_OF_INTACT": (CRC_RESIDUE ^ 0xFFFFFFFF, "of any message with its own CRC behind it"),
}
BY_STRUCT: dict[str, tuple[int, str]] = {  # in Python
    "HEADER_BYTES": (HEADER_BYTES, ""),
    "TYPE_AT": (offset_of("type", HEADER_FIELDS), "byte of the header"),
    "LENGTH_AT": (offset_of("length", HEADER_FIELDS), ""),
    "ARGUMENT_AT": (offset_of("argument", HEADER_FIELDS), ""),
    "CRC_BYTES": (CRC_FIELD.size, ""),
}


def kernel_c() -> list[str]:
    """Enumerators of kernel.c."""
    return [
        f"{name} = {_number(value)}," + (f" /* {text} */" if text else "") for name, (value, text) in (KERNEL | BY_STRUCT).items()
    ]


def kernel_twin() -> list[str]:
    """Constants of the kernel's twin."""
    lines = [f"{name}: Final = {_number(value)}" + (f"  # {text}" if text else "") for name, (value, text) in KERNEL.items()]
    names = ", ".join(field.name for field in HEADER_FIELDS)
    lines.append(f'HEADER: Final = struct.Struct("{packing(HEADER_FIELDS).format}")  # {names}')
    return [*lines, f'CRC: Final = struct.Struct("{packing([CRC_FIELD]).format}")']


def places() -> list[str]:
    """Lines of registers.vh: bytes of the header, bits of payloads and of the status."""
    lines = ["// Bytes at which the fields of a frame's header begin, and all that is not payload"]
    lines += [f"`define FRAME_{field.name.upper()}_AT 10'd{offset_of(field.name, HEADER_FIELDS)}" for field in HEADER_FIELDS]
    lines.append(f"`define FRAME_OVERHEAD_BYTES 17'd{HEADER_BYTES + CRC_FIELD.size}")
    for kind, payload in PAYLOADS.items():
        if payload.fields:
            lines += [f"// Bits of the payload of a {kind.name}", *_bits(kind.name, payload.fields)]
    return [
        *lines,
        "// Bits of a status, and its bytes",
        *_bits("STATUS", STATUS_FIELDS),
        f"`define STATUS_COVERED_BYTES 6'd{packing(STATUS_FIELDS).size}  // before the CRC",
    ]


def table() -> list[str]:
    """Lines of the README's table, in Markdown."""
    covered = HEADER_BYTES + SHORT_PAYLOAD_BYTES
    rows = [("frame", "bytes", "field", "what"), ("---",) * 4]
    rows += [("all", *row) for row in _rows(HEADER_FIELDS, 0)]
    rows.append(("all", f"last {CRC_FIELD.size}", CRC_FIELD.name, CRC_FIELD.text))
    for kind, payload in PAYLOADS.items():
        if payload.argument:
            at = offset_of("argument", HEADER_FIELDS)
            rows.append((kind.name, f"{at}–{at + 1}", "argument", payload.argument))
        rows += [(kind.name, *row) for row in _rows(payload.fields, HEADER_BYTES)]
    rows += [("status", *row) for row in (*_rows(STATUS_FIELDS, 0), *_rows([CRC_FIELD], covered))]
    return ["|" + "|".join(cell if cell == "---" else f" {cell} " for cell in cells) + "|" for cells in rows]


def _rows(fields: Iterable[FrameField], start: int) -> list[tuple[str, str, str]]:
    rows = []
    for field in fields:
        rows.append((f"{start}–{start + field.size - 1}" if field.size > 1 else f"{start}", field.name, field.text))
        start += field.size
    return rows


def _bits(frame: str, fields: tuple[FrameField, ...]) -> list[str]:
    lines = []
    for field in fields:
        low = 8 * offset_of(field.name, fields)
        lines.append(f"`define {frame}_{field.name.upper()}_BITS {low + 8 * field.size - 1}:{low}")
    return lines


def _number(value: int) -> str:
    return f"0x{value:X}" if value > 0xFFF else str(value)
