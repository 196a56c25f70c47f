"""The list of relations between the keys of a board.toml, and the verdict on a board.

`load_board` refuses what breaks a relation that refuses, and so does every command; `board check`, `bank build`, `run`,
`gateware build` and `doctor` also say what is odd. What makes a single table meaningless, such as a band upside down, is refused
by its record.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, NamedTuple

from controller.device.board.relations import bank as bank_relations
from controller.device.board.relations import devices as device_relations
from controller.device.board.relations import limits as limit_relations
from controller.device.board.relations import panel as panel_relations
from controller.device.board.relations import plate as plate_relations
from controller.device.board.relations import stage as stage_relations
from controller.device.board.relations import touch as touch_relations
from controller.device.board.relations.relation import Relation

if TYPE_CHECKING:
    from controller.device.board.board import Board

PARTS = (panel_relations, bank_relations, plate_relations, limit_relations, stage_relations, touch_relations, device_relations)
RELATIONS = tuple(found for part in PARTS for found in vars(part).values() if isinstance(found, Relation))

OF_ONE_FPGA = frozenset(found for found in vars(stage_relations).values() if isinstance(found, Relation))  # each limits its own


class BoardProblems(NamedTuple):
    """What is wrong with a board as a whole, one line each."""

    refused: tuple[str, ...]  # unsafe or impossible
    odd: tuple[str, ...]  # works, but hardly as it is meant


def judge(board: Board, without: Collection[Relation] = ()) -> BoardProblems:
    """Check all relations of a board, but for those `without` which it is to be mended."""
    found: dict[bool, list[str]] = {True: [], False: []}
    for relation in RELATIONS:
        if relation not in without:
            boards = board.fpga_boards if relation in OF_ONE_FPGA else (board,)
            found[relation.refuses] += dict.fromkeys(said for one in boards for said in relation.broken(one))
    return BoardProblems(tuple(found[True]), tuple(found[False]))
