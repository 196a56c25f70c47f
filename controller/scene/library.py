"""Effects by name: those that ship with the package, those of a scene, and effects that build on another."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta

from controller.board.board import Board
from controller.board.records import Record, as_record, load_toml
from controller.errors import ConfigError
from controller.scene.effects import ROUNDING, EffectTable
from controller.scene.primitives import conflict, primitive_of

LIBRARY = Path(__file__).with_name("effects.toml")

Effects = dict[str, EffectTable]
Tables = dict[Annotated[str, Meta(min_length=1, max_length=64)], dict[str, Any]]  # by name, as they stand in a file


class LibraryTable(Record, frozen=True):
    """The whole library file."""

    effects: Tables


@cache
def library() -> Effects:
    """The effects that ship with the package, by name.

    Raises
    ------
    ConfigError
        Naming file, key and value.
    """
    known = {}
    for name, table in load_toml(LIBRARY, LibraryTable).effects.items():
        key = f"{LIBRARY}: effects.{name}"
        known[name] = as_record(f"{key}.", table, EffectTable)
        if wrong := conflict(known[name]):
            raise ConfigError(f"{key}{wrong}")
    return known


def known_effects(file: Path, own: Tables, board: Board) -> tuple[Effects, Effects]:
    """Effects that a scene's regions can name, and those of them that a command can play.

    Parameters
    ----------
    file : Path
        Of the scene, for messages.
    own : dict
        The scene's own effects as they stand in the file. They may build on the library's and on those above them, and take
        their names.
    board : Board
        Whose duty limit bounds the rates.

    Returns
    -------
    known, playable : dict of str to EffectTable

    Raises
    ------
    ConfigError
        Naming file, key and value.
    """
    known = dict(library())
    for name, table in own.items():
        key = f"{file}: effects.{name}"
        known[name] = resolved(key, as_record(f"{key}.", table, EffectTable), known, board)
    playable = {}
    for name, effect in known.items():
        if "command" in primitive_of(effect).when and (effect.rate_hz or 0.0) <= highest_rate_hz(board) * (1 + ROUNDING):
            playable[name] = effect
    return known, playable


def resolved(key: str, given: str | EffectTable, known: Effects, board: Board) -> EffectTable:
    """An effect, checked, with the keys that it does not give taken from the one that it builds on.

    Parameters
    ----------
    key : str
        File and key, for messages.
    given : str or EffectTable
        A name, or a table.
    known : dict
        Effects that may be named.
    board : Board
        Whose duty limit bounds the rate.

    Raises
    ------
    ConfigError
        If it names an unknown effect, its keys do not go together, or the board does not allow its rate.
    """
    base = given if isinstance(given, str) else given.effect
    effect = EffectTable() if isinstance(given, str) else given
    if base is not None:
        if base not in known:
            where = key if isinstance(given, str) else f"{key}.effect"
            raise ConfigError(f"{where} = {base!r} is no effect; known: {', '.join(sorted(known))}")
        effect = effect.over(known[base])
    wrong = conflict(effect)
    if wrong:
        raise ConfigError(f"{key}{wrong}")
    _check_rate(key, effect, board)
    return effect


def highest_rate_hz(board: Board) -> float:
    """Highest rate of emissions that the duty limit of a board allows."""
    return board.limits.max_duty / board.waveform.duration_s


def _check_rate(key: str, effect: EffectTable, board: Board) -> None:
    """Check an effect's rate against the board's duty limit, and a spot's pause and place."""
    if effect.rate_hz is None:
        return
    most_hz = highest_rate_hz(board)
    if effect.rate_hz > most_hz * (1 + ROUNDING):
        raise ConfigError(
            f"{key}.rate_hz = {effect.rate_hz:g} is above {most_hz:g}, as often as emissions of"
            f" {board.waveform.duration_ms:g} ms fit into limits.max_duty = {board.limits.max_duty:g}"
        )
    if "always" not in effect.occasions:
        return
    rest_ticks = board.period_ticks(1 / effect.rate_hz) - board.emission_ticks
    word_ticks = board.bit_period >> 16
    if 0 < rest_ticks < word_ticks:
        clock_hz = board.link.clock_hz
        raise ConfigError(
            f"{key}.rate_hz = {effect.rate_hz:g} leaves {rest_ticks / clock_hz * 1e6:.3g} us between emissions, less than a"
            f" drive word: give {clock_hz / board.emission_ticks:.7g} (no pause)"
            f" or at most {math.floor(clock_hz / (board.emission_ticks + word_ticks) * 1e3) / 1e3:.7g}"
        )
    for name, value, most in (("x_mm", effect.x_mm, board.plate.length_mm), ("y_mm", effect.y_mm, board.plate.width_mm)):
        if value is not None and value > most:
            raise ConfigError(f"{key}.{name} = {value:g} is off the plate (0 to {most:g} mm)")
