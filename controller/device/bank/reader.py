"""Reads a bank: each section is mapped when it is first needed, each entry is checked when it is first used."""

from __future__ import annotations

import math
import os
from dataclasses import replace
from pathlib import Path
from types import TracebackType

import numpy as np

from controller.arrays import Bools
from controller.device.bank.bank_file import BankFile
from controller.device.bank.drive_entries import DriveEntries
from controller.device.bank.header_reading import begins_as_bank, header_length, parse
from controller.device.bank.packing import CHANNELS
from controller.device.bank.provenance import MEASURE_AGAIN
from controller.device.bank.response_entries import ResponseEntries
from controller.device.bank.tables import read_tables
from controller.device.board.board import Board
from controller.device.board.lookup import fpga_files
from controller.device.board.paths import build_line
from controller.errors import BankError
from controller.regular_file import open_regular


class Bank:
    """An open bank; the file may be replaced by a new one while it is open.

    Use `Bank.open`. Memoryviews and arrays handed out stay valid as long as they are held.
    """

    def __init__(self, file: BankFile) -> None:
        self.file = file
        self.path = file.path
        self.header = file.header
        self.sections = file.sections
        self.grid = file.header.grid
        self.samples = file.header.samples
        self.composes = file.header.composes
        self.counters = file.counters
        self.rebuild = file.rebuild
        self.others: tuple[Bank, ...] = ()  # of the further FPGAs of a board that has several
        self.drive = DriveEntries(file)  # its waveforms
        self.responses = ResponseEntries(file)  # what others are composed from

    @classmethod
    def open(cls, path: Path, board: Board | None = None) -> Bank:
        """Open a bank and check its header and tables; of a board of several FPGAs those of all of them, one file each.

        A bank that was not built for `board` is refused. Raises BankError with the reason and how to rebuild.
        """
        if board and board.link.fpga:
            return cls._of_several(path, board)
        rebuild = build_line(path, board)
        try:
            fd = open_regular(path, links=True)
        except OSError as error:
            hint = f"; build it: {rebuild}" if isinstance(error, FileNotFoundError) else ""
            raise BankError(f"{path}: cannot be read ({error.strerror}){hint}") from error
        start: bytes | None = None  # None: unreadable, so no advice to rebuild it
        try:
            size = os.fstat(fd).st_size
            start = os.pread(fd, 16, 0)
            header, sections = parse(os.pread(fd, header_length(start, size), 0), size)
            name = header.parameters.get("board")
            if not board and isinstance(name, str) and name.isprintable():
                rebuild = build_line(path, name)
            if header.provenance and header.provenance.from_measurements:
                rebuild = MEASURE_AGAIN
            if board and header.board_digest != board.digest():
                raise BankError(
                    f"was built for another board: digest {header.board_digest.hex()[:16]}, "
                    f"board {board.name!r} has {board.digest().hex()[:16]}"
                )
            tables = read_tables(fd, header, sections)
        except (OSError, BankError) as error:
            os.close(fd)
            reason = error if isinstance(error, BankError) else f"cannot be read ({error.strerror})"
            advised = start is not None and begins_as_bank(start)
            raise BankError(f"{path}: {reason}" + (f"; rebuild it: {rebuild}" if advised else "")) from error
        return cls(BankFile(path, fd, header, sections, tables, rebuild))

    @classmethod
    def _of_several(cls, path: Path, board: Board) -> Bank:
        """The banks of several FPGAs, as the first one's, with the others behind it; all have the same cells."""
        opened: list[Bank] = []
        try:
            for one, file in zip(board.fpga_boards, fpga_files(path, len(board.link.fpga)), strict=True):
                opened.append(cls.open(file, one))
                if (opened[-1].grid, opened[-1].samples) != (opened[0].grid, opened[0].samples) or (
                    opened[-1].file.tables.entries != opened[0].file.tables.entries
                ):
                    raise BankError(f"{file}: its cells are not those of {path}; rebuild both: {build_line(path, board)}")
        except BankError:
            for bank in opened:
                bank.close()
            raise
        whole, said_um = opened[0], [bank.header.amplitude_um or () for bank in opened]
        whole.others = tuple(opened[1:])
        together = [
            float(f"{math.fsum(of_each):.4g}") for of_each in zip(*said_um, strict=False)
        ]  # what each moves adds up; or nothing is said
        whole.header = replace(whole.header, parameters=whole.header.parameters | {"amplitude_um": together})
        return whole

    def close(self) -> None:
        """Close the file, or those of all FPGAs."""
        for bank in self.others:
            bank.close()
        self.file.close()

    def __enter__(self) -> Bank:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    @property
    def cells(self) -> Bools:
        """Which cells have an entry, (grid.cells,)."""
        return np.array(self.file.tables.entries) >= 0

    @property
    def wave_scale(self) -> float:
        """As `Header.wave_scale`."""
        return self.header.wave_scale

    def snap_m(self, board: Board) -> float:
        """How far from a cell a lone finger plays it: as was chosen with this bank, or as the board says.

        A bank without responses has nothing else to play: its cells are played as far as was chosen with it in any case. A compact
        bank has none to play: below 0.
        """
        if self.header.compact:
            return -1.0
        choice = self.header.choice if board.compose.method != "bank" or not self.composes else None
        if choice is None and not self.composes:
            return math.inf
        return float(choice["snap_mm"] if choice else board.bank.snap_mm) * 1e-3

    @property
    def worst_edges(self) -> tuple[int, int]:
        """Most edges in an entry, with those from and to the idle word: of one channel, and of all channels of an FPGA together.

        For a bank whose parameters do not say, the most that an emission can have.
        """
        reported = self.header.parameters.get("channel_edges"), self.header.parameters.get("all_edges")
        most = self.samples + 1
        channel, together = (edges if type(edges) is int and edges >= 0 else None for edges in reported)
        own = most if channel is None else channel, CHANNELS * most if together is None else together
        of_each = [own, *(bank.worst_edges for bank in self.others)]
        return max(channel for channel, _ in of_each), max(together for _, together in of_each)
