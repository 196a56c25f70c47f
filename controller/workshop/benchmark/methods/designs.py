"""Methods behind `DesignMethod`, from the plate model: each is one line of `DESIGNS`."""

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property, partial
from typing import Any

from controller.arrays import Words
from controller.device.board.board import Board
from controller.device.kernel import Point
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.methods.descent import Descent
from controller.workshop.bank_builder.methods.design import DesignMethod
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition
from controller.workshop.bank_builder.methods.nulls import ExactNulls
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.benchmark.methods.candidate import Candidate, Place, wire_bytes
from controller.workshop.benchmark.methods.laboratory import Laboratory
from controller.workshop.physics.responses.impulse_response import ResponseModel

DESIGNS: dict[str, tuple[Callable[[Board, ResponseModel], DesignMethod], dict[str, Any]]] = {  # and fields of `Candidate`
    "full field, float64": (SignOfSum, {}),
    "exact composition": (ExactComposition, {"free_polarity": True}),
    "exact composition, nulls": (ExactNulls, {"free_polarity": True, "keeps_nulls": True, "slow": True}),
    **{f"descent, {aim.name}": (partial(Descent, aim=aim), {"slow": True, "most_fingers": 1}) for aim in AIMS.values()},
}


def candidates(laboratory: Laboratory) -> Iterator[Candidate]:
    """All of them."""
    model, board = laboratory.model, laboratory.board
    memory = model.modal_band.nbytes + model.forces.nbytes
    for name, (make, how) in DESIGNS.items():
        designed = Designed(partial(make, board, model))
        yield Candidate(name, f"{model.modes} modes", designed, memory, wire_bytes(board.waveform.samples), **how)


class Designed:
    """The drive words of a design method, which is made when it is first needed."""

    def __init__(self, make: Callable[[], DesignMethod]) -> None:
        self._make = make

    @cached_property
    def _method(self) -> DesignMethod:
        return self._make()

    def __call__(self, points: Sequence[Point], nulls: Sequence[Place] = ()) -> Words:
        """Drive words."""
        return self._method.design(points, nulls).words
