"""The format of a bank file in `struct`, as README.md specifies it.

A header of one or more pages, then seven sections, of a compact bank eight, each starting at a page; all other bytes are
zero. Tables are covered by a CRC-32 in the header, entries by one each.
"""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from typing import Any

import msgspec

from controller import __version__
from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS
from controller.device.bank.provenance import MODEL_VERSION, Provenance, provenance_of
from controller.device.kernel import LARGEST_EQUALISER, load_frames_bytes
from controller.device.kernel.crc import sealed

MAGIC = b"HPNLBANK"
VERSION = 9
COMPACT_VERSION = 11  # of compact banks
PAGE = 4096
LINE = 64  # responses start on a cache line
REST_SAMPLES = 2  # of which the rest of a response, outside the band, is kept as the mean
LEAST_WAVE_SCALE = 1e-3  # 10 um
LARGEST_UM = 1e4
SAMPLES_MAX = 1000  # what LOAD frames can carry
MAX_HEADER = 1 << 20
MAX_COMPACT = 1 << 28  # bytes of a row, and of the tables

# magic, version, header bytes, file bytes, creator, board digest, pitch, x0, y0, bit clock,
# nx, ny, samples, channels, entries, parameters bytes, sections, compositions
FIXED = struct.Struct("<8sIIQ64s32sddddIIIIIIII")
SECTION = struct.Struct("<16sQQIIII")  # name, offset, bytes, rows, bytes of a row, stride, CRC-32
SECTIONS = 7
COMPOSITIONS_MAX = 1024
FOCI = 10  # of a composition, at most
COMPOSITION = struct.Struct(f"<II{3 * FOCI}i")  # CRC-32 of the words, foci, x, y and amplitude step of each; zeros
CRC = struct.Struct("<I")  # the last four bytes of the header: of all before them


@dataclass(frozen=True, slots=True)
class Section:
    """Rows of equal length, `stride` bytes apart; `crc` is 0 where each row has its own checksum."""

    name: str
    offset: int
    rows: int
    row_bytes: int
    stride: int
    crc: int = 0

    @property
    def size(self) -> int:
        """Bytes from the first row to the end of the last one's stride."""
        return self.rows * self.stride


@dataclass(frozen=True, slots=True)
class Header:
    """Header of a bank: what it was built for and by, its grid, and how many entries it has."""

    creator: str  # program, its version and that of the model; at most 64 bytes in UTF-8
    board_digest: bytes  # `Board.digest`, 32 bytes
    grid: Grid
    bit_clock_hz: float
    samples: int  # of an emission: 1 to 1000
    entries: int  # cells that were built
    parameters: dict[str, Any] = field(default_factory=dict)  # build parameters, for JSON
    compositions: int = 0  # waveforms of several points that were composed beforehand

    @property
    def header_bytes(self) -> int:
        """Bytes of the header: whole pages."""
        return round_up(FIXED.size + (SECTIONS + (self.compact is not None)) * SECTION.size + len(self._json()) + CRC.size, PAGE)

    @property
    def composes(self) -> bool:
        """Whether there are responses, from which other places, less amplitude and several points at once are composed."""
        return self.parameters.get("composes") is not False

    @property
    def compact(self) -> dict[str, int] | None:
        """Bytes of a cell's row and of the tables of a compact bank, by name; None for others, and what cannot be."""
        reported = self.parameters.get("compact")
        if not isinstance(reported, dict) or not all(type(reported.get(name)) is int for name in ("row_bytes", "tables_bytes")):
            return None
        return reported if all(0 < reported[name] <= MAX_COMPACT for name in ("row_bytes", "tables_bytes")) else None

    @property
    def version(self) -> int:
        """Of the format."""
        return VERSION if self.compact is None else COMPACT_VERSION

    @property
    def choice(self) -> dict[str, Any] | None:
        """What was chosen with the bank, and what for (`workshop/bank_builder/choice.py`); None if nothing was."""
        choice = self.parameters.get("choice")
        if not isinstance(choice, dict) or not isinstance(choice.get("asked"), dict):
            return None
        whole = (
            all(type(choice.get(name)) in {int, float} for name in ("pitch_mm", "snap_mm"))
            and choice.get("composes") is self.composes
        )
        return choice if whole else None

    @property
    def wave_scale(self) -> float:
        """How much longer the plate's waves are than the paper's plate's: distances on the device go with it. 1, if not given."""
        return self._number("wave_scale", LEAST_WAVE_SCALE, 1 / LEAST_WAVE_SCALE, otherwise=1.0)

    @property
    def equaliser(self) -> float:
        """What gives back to a response between cells what interpolation takes from it (`kernel.bank_twin`); 0, if not given."""
        return self._number("equaliser", 0, LARGEST_EQUALISER)

    @property
    def band_lost(self) -> float:
        """What interpolation takes from a response in spite of the equaliser (`kernel.bank_twin`); 0, if not given."""
        return self._number("band_lost", 0, 1)

    @property
    def amplitude_um(self) -> tuple[float, float, float] | None:
        """Amplitudes that the bank foresees over its places (`workshop/bank_builder/said_amplitude.py`); None if it says none."""
        try:
            low, middle, high = msgspec.convert(self.parameters.get("amplitude_um"), tuple[float, float, float])
        except msgspec.ValidationError:
            return None
        return (low, middle, high) if 0 < low <= middle <= high < LARGEST_UM else None

    @property
    def provenance(self) -> Provenance | None:
        """Where the responses come from; None if the header does not tell."""
        return provenance_of(self.parameters.get("responses"))

    @property
    def rest_rows(self) -> int:
        """Rows of the rest of a response: one for each `REST_SAMPLES` samples."""
        return -(-self.samples // REST_SAMPLES)

    def sections(self) -> tuple[Section, ...]:
        """Section table without CRCs: offsets follow from the numbers of cells, entries, samples and compositions."""
        drive_bytes, response_bytes = load_frames_bytes(4 * self.samples), CHANNELS * (self.samples + self.rest_rows)
        compact, tables = self.compact, []
        if compact is not None:
            response_bytes, tables = compact["row_bytes"], [("tables", 1, compact["tables_bytes"], compact["tables_bytes"])]
        offset = self.header_bytes
        placed = []
        for name, rows, row_bytes, stride in (
            ("index", self.grid.cells, 4, 4),
            ("checksums", self.entries, 8, 8),
            ("scale", self.entries, 4, 4),
            ("drive", 0 if compact else self.entries, drive_bytes, round_up(drive_bytes, PAGE)),
            ("response", self.entries if self.composes else 0, response_bytes, round_up(response_bytes, LINE)),
            ("points", self.compositions, COMPOSITION.size, COMPOSITION.size),
            ("composed", self.compositions, drive_bytes, round_up(drive_bytes, PAGE)),
            *tables,
        ):
            placed.append(Section(name, offset, rows, row_bytes, stride))
            offset = round_up(offset + placed[-1].size, PAGE)
        return tuple(placed)

    @property
    def file_bytes(self) -> int:
        """Bytes of the whole file."""
        last = self.sections()[-1]
        return round_up(last.offset + last.size, PAGE)

    def pack(self, sections: tuple[Section, ...]) -> bytes:
        """Bytes of the header, with the sections' checksums in its table.

        Raises ValueError if the creator or the build parameters are too long.
        """
        maker, parameters = self.creator.encode(), self._json()
        if len(maker) > 64:
            raise ValueError(f"creator {self.creator!r} is longer than 64 bytes")
        if self.header_bytes > MAX_HEADER:
            raise ValueError(f"parameters of {len(parameters)} bytes do not fit a header of {MAX_HEADER} bytes")
        grid = self.grid
        body = FIXED.pack(
            *(MAGIC, self.version, self.header_bytes, self.file_bytes, maker, self.board_digest),
            *(grid.pitch_m, grid.x0_m, grid.y0_m, self.bit_clock_hz, grid.nx, grid.ny),
            *(self.samples, CHANNELS, self.entries, len(parameters), len(sections), self.compositions),
        )
        for s in sections:
            body += SECTION.pack(s.name.encode(), s.offset, s.size, s.rows, s.row_bytes, s.stride, s.crc)
        body = (body + parameters).ljust(self.header_bytes - CRC.size, b"\0")
        return sealed(body)

    def _number(self, name: str, least: float, most: float, *, otherwise: float = 0.0) -> float:
        """A build parameter; `otherwise`, if it is not given or no number of that range."""
        reported: object = self.parameters.get(name)
        return float(reported) if isinstance(reported, int | float) and least <= reported <= most else otherwise

    def _json(self) -> bytes:
        return json.dumps(self.parameters, sort_keys=True, allow_nan=False).encode()


def creator() -> str:
    """This program, its version and the version of the model that it computes responses by, as the header of a bank names them."""
    return f"haptic-panel {__version__}, model {MODEL_VERSION}"


def model_version_of(creator: str) -> str:
    """Version of the model that a header's `creator` names; empty if it names none."""
    return creator.partition(", model ")[2]


def round_up(value: int, step: int) -> int:
    """Round `value` up to a multiple of `step`."""
    return -(-value // step) * step
