"""Methods behind `DesignMethod`, from the plate model: each is one line of `DESIGNS`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

from controller.benchmark.methods.candidate import Candidate, Place, Words, wire_bytes
from controller.benchmark.methods.laboratory import Laboratory
from controller.board.board import Board
from controller.kernel import Point
from controller.physics.impulse_response import ResponseModel
from controller.waveform_design.descent import AIMS, Descent
from controller.waveform_design.exact_composition import ExactComposition
from controller.waveform_design.nulls import ExactNulls
from controller.waveform_design.plain import SignOfSum
from controller.waveforms.design import DesignMethod


@dataclass(frozen=True)
class Design:
    """How a method is made, and how it is judged."""

    make: Callable[[Board, ResponseModel], DesignMethod]
    free_polarity: bool = False
    keeps_quiet: bool = False
    slow: bool = False
    most_fingers: int = 10


DESIGNS = {
    "full field, float64": Design(SignOfSum),
    "exact composition": Design(ExactComposition, free_polarity=True),
    "exact composition, nulls": Design(ExactNulls, free_polarity=True, keeps_quiet=True, slow=True),
    **{f"descent, {aim.name}": Design(partial(Descent, aim=aim), slow=True, most_fingers=1) for aim in AIMS.values()},
}


def candidates(laboratory: Laboratory) -> Iterator[Candidate]:
    """All of them."""
    model, board = laboratory.model, laboratory.board
    memory = model.modal_band.nbytes + model.forces.nbytes
    for name, design in DESIGNS.items():
        yield Candidate(
            name,
            f"{model.modes} modes",
            Designed(partial(design.make, board, model)),
            memory,
            wire_bytes(board.waveform.samples),
            free_polarity=design.free_polarity,
            most_fingers=design.most_fingers,
            keeps_quiet=design.keeps_quiet,
            slow=design.slow,
        )


class Designed:
    """The drive words of a design method, which is made when it is first needed."""

    def __init__(self, make: Callable[[], DesignMethod]) -> None:
        self._make = make

    @cached_property
    def _method(self) -> DesignMethod:
        return self._make()

    def __call__(self, points: Sequence[Point], quiet: Sequence[Place] = ()) -> Words:
        """Drive words."""
        return self._method.design(points, quiet).words
