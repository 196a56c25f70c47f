"""A relation between keys of a board.toml: what must hold of several of them together, and what is said where it does not."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from controller.device.board.board import Board

Broken = Callable[["Board"], Iterator[str]]


class Relation(NamedTuple):
    """What must hold of some keys together."""

    keys: str  # the keys, as the reference shows them
    rule: str  # what must hold, as a sentence for the reference
    refuses: bool  # whether a board that breaks it is refused, since it would be unsafe or could not work; else it is warned of
    broken: Broken  # yields what is broken: one line each that names the keys with their values, and what to do


def relation(keys: str, broken: Broken, *, refuses: bool) -> Relation:
    """A relation of a function that finds what is broken; its rule is the function's docstring."""
    assert broken.__doc__ is not None
    return Relation(keys, broken.__doc__, refuses, broken)


def refuses(keys: str) -> Callable[[Broken], Relation]:
    """Decorate a function, whose docstring is the rule: a board that breaks it is refused."""
    return partial(relation, keys, refuses=True)


def warns(keys: str) -> Callable[[Broken], Relation]:
    """Decorate a function, whose docstring is the rule: a board that breaks it is warned of."""
    return partial(relation, keys, refuses=False)
