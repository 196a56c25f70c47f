import re
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from tables import each_row

import controller.device.bank
from controller.device.bank.file_format import Header
from controller.device.bank.grid import Grid
from controller.device.bank.header_reading import header_length, parse
from controller.errors import BankError

README = (Path(controller.device.bank.__file__).parent / "README.md").read_text(encoding="utf-8")
GRID = Grid(5e-3, 3, 2, 5e-3, 6e-3)
CELLS = [True, False, True, True, False, True]
KINDS = {"u32": "I", "u64": "Q", "f64": "d"}


def table_of(heading: str) -> list[tuple[str, int, str]]:
    """Fields of one of the README's tables that lie at a number: what it says of them, offset, struct letter."""
    lines = README.partition(heading)[2].split("\n\n")[1].splitlines()
    cells = [re.split(r"\s*\|\s*", line.strip("| ")) for line in lines]
    return [
        (text, int(offset), KINDS.get(kind) or kind.replace(" bytes", "s"))
        for offset, kind, text in cells
        if offset.isdigit() and "×" not in kind
    ]


def read(data: bytes, table: list[tuple[str, int, str]], name: str, start: int = 0):
    """Value of the one field whose description begins so."""
    ((_, offset, kind),) = (field for field in table if field[0].startswith(name))
    return struct.unpack_from("<" + kind, data, start + offset)[0]


def test_a_bank_is_read_with_nothing_but_the_readme(tmp_path, make_bank, board):
    """Plain struct, offsets out of the README's tables: what another language would do."""
    rests = {cell: np.random.default_rng(cell).normal(0, 1e-9, (5, 32)) for cell in range(6)}
    words_of = {((3, -4, 0), (3, 7, 16)): np.arange(9, dtype=np.uint32), ((40, 40, 32),): np.full(9, 0xF0F0F0F0, np.uint32)}
    responses = make_bank(tmp_path / "bank", GRID, CELLS, rests=rests, compositions=words_of)
    data = (tmp_path / "bank").read_bytes()
    fields, columns = table_of("Header:"), table_of("One line of the section table:")

    def header(name):
        return read(data, fields, name)

    assert header("`HPNLBANK`") == b"HPNLBANK"
    assert header("format version") == 9
    assert header("bytes of the file") == len(data)
    assert header("SHA-256") == board.digest()
    assert (header("pitch"), header("x"), header("y")) == (5e-3, 5e-3, 6e-3)
    assert (header("nx"), header("ny"), header("samples"), header("bit clock")) == (3, 2, 9, 500e3)
    length, count = header("bytes of the header"), header("sections")
    assert struct.unpack_from("<I", data, length - 4)[0] == zlib.crc32(data[: length - 4])

    sections = {}
    for line in range(count):
        row = {key: read(data, columns, key, 184 + 48 * line) for key in ("name", "offset", "bytes:", "bytes of", "stride", "CRC")}
        sections[row["name"].rstrip(b"\0").decode()] = row
    for name in ("index", "checksums", "scale", "points"):
        section = sections[name]
        assert zlib.crc32(data[section["offset"] :][: section["bytes:"]]) == section["CRC"]

    def row_of(name, number):
        section = sections[name]
        assert section["offset"] % 4096 == 0
        return data[section["offset"] + number * section["stride"] :][: section["bytes of"]]

    for cell in range(6):
        (entry,) = struct.unpack("<i", row_of("index", cell))
        assert (entry >= 0) == CELLS[cell]
        if entry < 0:
            continue
        frames, levels = row_of("drive", entry), row_of("response", entry)
        assert len(frames) == 8 + 36 + 4
        assert struct.unpack("<HBBHH", frames[:8]) == (0xA55A, 3, 0, 36, 0)
        assert struct.unpack("<I", frames[-4:])[0] == zlib.crc32(frames[:-4])
        words = frames[8:-4]
        assert struct.unpack("<II", row_of("checksums", entry)) == (zlib.crc32(words), zlib.crc32(levels))
        (scale,) = struct.unpack("<f", row_of("scale", entry))
        for n, word in enumerate(struct.unpack("<9I", words)):
            for q in range(32):
                exact = responses[cell][n, q]
                assert word >> q & 1 == (exact > 0)
                assert abs(struct.unpack_from("<b", levels, 32 * n + q)[0] * scale - exact) <= 0.501 * scale
        assert len(levels) == 32 * (9 + 5)
        for row, rest in enumerate(rests[cell]):
            for q in range(32):
                assert abs(struct.unpack_from("<b", levels, 32 * (9 + row) + q)[0] * scale - rest[q]) <= 0.501 * scale
    assert header("compositions") == 2
    for number, (points, words) in enumerate(words_of.items()):
        crc, count, *steps = struct.unpack("<II30i", row_of("points", number))
        assert list(zip(*[iter(steps[: 3 * count])] * 3, strict=True)) == list(points)
        assert not any(steps[3 * count :])
        frames = row_of("composed", number)
        assert struct.unpack("<HBBHH9I", frames[:44]) == (0xA55A, 3, 0, 36, 0, *words.tolist())
        assert crc == zlib.crc32(words.tobytes())


def small_header(**changed):
    values = {"creator": "test", "board_digest": bytes(range(32)), "grid": GRID, "bit_clock_hz": 5e5, "samples": 9, "entries": 4}
    return Header(**values | changed)


def test_a_header_comes_back_as_it_was():
    header = small_header(parameters={"board": "ünïcode", "pitch_mm": 5.0})
    found, sections = parse(header.pack(header.sections()), header.file_bytes)
    assert found == header
    assert tuple(sections.values()) == header.sections()
    shortest = small_header(samples=1)
    assert parse(shortest.pack(shortest.sections()), shortest.file_bytes)[0] == shortest


def test_a_flip_of_any_bit_of_the_header_is_noticed():
    header = small_header()
    data = bytearray(header.pack(header.sections()))
    for bit in range(8 * len(data)):
        data[bit >> 3] ^= 1 << (bit & 7)
        with pytest.raises(BankError):
            parse(bytes(data[: header_length(bytes(data[:16]), header.file_bytes)]), header.file_bytes)
        data[bit >> 3] ^= 1 << (bit & 7)


def resealed(header, offset, replacement):
    data = bytearray(header.pack(header.sections()))
    data[offset : offset + len(replacement)] = replacement
    return bytes(data[:-4]) + struct.pack("<I", zlib.crc32(data[:-4]))


TABLE = 184


@each_row(
    ("offset", "replacement", "reason"),
    [
        (TABLE + 16, struct.pack("<Q", 0), "out of order, apart or overlapping"),  # the first section over the header
        (TABLE + 48 + 16, struct.pack("<Q", 4096), "out of order, apart or overlapping"),  # the second over the first
        (TABLE + 48 + 16, struct.pack("<Q", 3 * 4096), "out of order, apart or overlapping"),  # a hole before the second
        (TABLE, b"checksums".ljust(16, b"\0"), "where 'index' belongs"),  # not in the known order
        (TABLE + 24, struct.pack("<Q", 1 << 40), "does not fit"),
        (TABLE + 40, struct.pack("<I", 2), "does not fit"),  # stride
        (120, struct.pack("<d", np.nan), "cannot be"),  # pitch
        (120, struct.pack("<d", 0.0), "has a grid or bit clock"),
        (164, struct.pack("<I", 16), "does not allow"),  # channels
        (160, struct.pack("<I", 0), "does not allow"),  # samples
        (160, struct.pack("<I", 1001), "does not allow"),
        (172, struct.pack("<I", 1 << 30), "does not allow"),  # bytes of parameters
        (176, struct.pack("<I", 6), "does not allow"),  # sections
        (180, struct.pack("<I", 1025), "does not allow"),  # compositions
        (180, struct.pack("<I", 1), "does not fit"),
        (TABLE + 336, b"xx", "unreadable"),  # parameters that are not JSON
        (TABLE + 336, b"[]", "no table"),
        (TABLE + 436, b"x", "padding"),
        (16, struct.pack("<Q", 1 << 40), "is truncated"),
        (16, struct.pack("<Q", 4096), "has grown"),
    ],
)
def test_a_header_with_a_good_checksum_but_impossible_contents_is_refused(offset, replacement, reason):
    header = small_header()
    with pytest.raises(BankError, match=reason):
        parse(resealed(header, offset, replacement), header.file_bytes)


def test_a_page_that_no_section_owns_is_refused():
    header = small_header()
    data = bytearray(header.pack(header.sections()))
    for line in range(1, 7):  # every section but the first one page on
        at = TABLE + 48 * line + 16
        data[at : at + 8] = struct.pack("<Q", struct.unpack_from("<Q", data, at)[0] + 4096)
    data[16:24] = struct.pack("<Q", header.file_bytes + 4096)
    sealed = bytes(data[:-4]) + struct.pack("<I", zlib.crc32(data[:-4]))
    with pytest.raises(BankError, match="out of order, apart or overlapping"):
        parse(sealed, header.file_bytes + 4096)


def test_refuses_to_write_what_the_header_cannot_hold():
    for header in (small_header(creator="x" * 65), small_header(parameters={"x": "y" * (1 << 20)})):
        with pytest.raises(ValueError, match=r"creator|parameters"):
            header.pack(header.sections())


CHOICE = {"asked": {"max_error": 0.1}, "pitch_mm": 4, "snap_mm": 1.5, "composes": False}


@each_row(
    "choice",
    [None, 1, [], {}, CHOICE | {"asked": 1}, CHOICE | {"pitch_mm": "4"}, CHOICE | {"snap_mm": None}, CHOICE | {"composes": True}],
)
def test_what_was_chosen_is_whole_or_nothing(choice):
    assert small_header(parameters={"composes": False, "choice": CHOICE}).choice == CHOICE
    assert small_header(parameters={"composes": False, "choice": choice}).choice is None
    assert small_header(parameters={"composes": False}).sections()[4].rows == 0
