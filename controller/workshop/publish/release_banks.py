"""Banks of a release: the boards that each is for, what of it changes as one, and how it was built."""

from collections.abc import Iterator, Mapping
from pathlib import Path

from controller.device.bank.file_format import Section
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.lookup import fpga_files
from controller.errors import BankError

PIECE_BYTES_MIN = 256  # rows of a bank shorter than this are one piece: an index has 8 bytes for each


def banks_for(file: Path, boards: Mapping[str, Board]) -> Iterator[tuple[str, Path]]:
    """Of a bank's file, and those of a board's further FPGAs beside it, the names in the release; for each board that it is for."""
    with Bank.open(file) as bank:
        digest = bank.header.board_digest
    fitting = {name: board for name, board in boards.items() if board.fpga_boards[0].digest() == digest}
    if not fitting:
        raise BankError(f"{file}: was built for another board than {', '.join(boards) or 'none, as no --board is given'}")
    for name, board in fitting.items():
        Bank.open(file, board).close()
        fpgas = len(board.link.fpga)
        yield from zip(map(str, fpga_files(Path("banks") / f"{name}.bank", fpgas)), fpga_files(file, fpgas), strict=True)


def bank_pieces(file: Path) -> list[tuple[int, int]]:
    """What changes of a bank as one."""
    with Bank.open(file) as bank:
        sections = sorted(bank.sections.values(), key=lambda section: section.offset)
    return [piece for section in sections for piece in _pieces(section)]


def _pieces(section: Section) -> Iterator[tuple[int, int]]:
    """Rows of a section; short ones together."""
    if section.stride < PIECE_BYTES_MIN:
        yield section.offset, section.size
    else:
        yield from ((section.offset + row * section.stride, section.stride) for row in range(section.rows))


def bank_made_by(file: Path) -> dict[str, str]:
    """What a bank tells of how it was built."""
    with Bank.open(file) as bank:
        provenance = bank.header.provenance
        return {"creator": bank.header.creator, "responses": provenance.in_words() if provenance else "unknown"}
