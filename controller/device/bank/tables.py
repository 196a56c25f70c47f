"""The small sections of a bank, read whole: which entry a cell has, CRC-32s, scales, what was composed beforehand."""

from __future__ import annotations

import os
import zlib
from dataclasses import dataclass

import numpy as np

from controller.device.bank.file_format import COMPOSITION, FOCI, Header, Section
from controller.errors import BankError

LatticePoints = tuple[tuple[int, int, int], ...]  # x, y and amplitude of each point in steps (device/waveforms/selection.py)
Composed = dict[LatticePoints, tuple[int, int]]  # row and CRC-32 of the words of each composition


@dataclass(frozen=True, slots=True)
class Tables:
    """As lists, whose elements are read five times faster than an array's."""

    entries: list[int]  # entry of each cell, -1 for none
    crcs: list[list[int]]  # CRC-32 of the drive words and of the response of each entry
    scales: list[float]  # m per V of one level of each entry's response
    compositions: Composed  # row and CRC-32 of the words of each waveform that was composed beforehand, by its points


def read_tables(fd: int, header: Header, sections: dict[str, Section]) -> Tables:
    """Read and check the small sections; raises BankError if they are damaged."""
    data = {}
    for name in ("index", "checksums", "scale", "points"):
        data[name] = os.pread(fd, sections[name].size, sections[name].offset)
        if zlib.crc32(data[name]) != sections[name].crc:
            raise BankError(f"is damaged: CRC-32 of section {name!r} is wrong")
    index = np.frombuffer(data["index"], "<i4")
    if not np.array_equal(index[index != -1], np.arange(header.entries)):
        raise BankError("has an index that does not name every entry once, in the order of the cells")
    checksums = np.frombuffer(data["checksums"], "<u4").reshape(-1, 2)
    scales = np.frombuffer(data["scale"], "<f4").tolist()
    return Tables(index.tolist(), checksums.tolist(), scales, _compositions(data["points"]))


def _compositions(data: bytes) -> Composed:
    """Rows and CRC-32s of the compositions, by their points."""
    found: Composed = {}
    for row, (crc, count, *steps) in enumerate(COMPOSITION.iter_unpack(data)):
        if not 1 <= count <= FOCI or any(steps[3 * count :]):
            raise BankError(f"has a composition of {count} points")
        found[tuple((steps[at], steps[at + 1], steps[at + 2]) for at in range(0, 3 * count, 3))] = row, crc
    if COMPOSITION.size * len(found) != len(data):
        raise BankError("has two compositions of the same points")
    return found
