"""Effects by name: those that ship with the package, those of a scene, and effects that build on another."""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta

from controller.device.board.board import Board
from controller.device.board.records import Record, as_record, load_toml
from controller.device.scene.effects.effects import ROUNDING, EffectTable
from controller.device.scene.effects.primitives import conflict, primitive_of
from controller.device.scene.effects.rhythms import rhythm_of
from controller.device.scene.effects.trains import silent, train_of
from controller.errors import ConfigError

LIBRARY = Path(__file__).with_name("effects.toml")

Effects = dict[str, EffectTable]
Tables = dict[Annotated[str, Meta(min_length=1, max_length=64)], dict[str, Any]]  # by name, as they stand in a file


class LibraryTable(Record, frozen=True):
    """The whole library file."""

    effects: Tables


@cache
def library() -> Effects:
    """The effects that ship with the package, by name; raises ConfigError: naming file, key and value."""
    known = {}
    for name, table in load_toml(LIBRARY, LibraryTable).effects.items():
        key = f"{LIBRARY}: effects.{name}"
        known[name] = as_record(f"{key}.", table, EffectTable)
        if wrong := conflict(known[name]):
            raise ConfigError(f"{key}{wrong}")
    return known


def known_effects(before: str, own: Tables, board: Board) -> tuple[Effects, Effects]:
    """Effects that a scene's regions can name, and those of them that a command can play.

    `before` is the beginning of messages, before the key: the scene's file. The scene's `own` effects, as they stand in the file,
    may build on the library's and on those above them, and take their names. The board's duty limit bounds the rates. Raises
    ConfigError: naming file, key and value.
    """
    known = dict(library())
    for name, table in own.items():
        key = f"{before}effects.{name}"
        known[name] = resolved(key, as_record(f"{key}.", table, EffectTable), known, board)
        if silent(train_of(known[name])):
            raise ConfigError(f"{key}.envelope is silent at every emission of the train")
    playable = {}
    for name, effect in known.items():
        too_fast = (effect.rate_hz or 0.0) > highest_rate_hz(board) * (1 + ROUNDING) or _too_close(effect, board)
        if "command" in primitive_of(effect).when and not too_fast:
            playable[name] = effect
    return known, playable


def resolved(key: str, given: str | EffectTable, known: Effects, board: Board) -> EffectTable:
    """An effect, checked, with the keys that it does not give taken from the one that it builds on.

    `key` is file and key, for messages; the board's duty limit bounds the rate. Raises ConfigError if it names an unknown effect,
    its keys do not go together, or the board does not allow its rate.
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


def _too_close(effect: EffectTable, board: Board) -> str:
    """Which pulses of a rhythm follow each other faster than a board allows; empty: none."""
    least_ms = 1e3 / highest_rate_hz(board)
    sounding = [(index, at_ms) for index, (at_ms, amplitude) in enumerate(rhythm_of(effect)) if amplitude]
    for (_, before_ms), (index, at_ms) in pairwise(sounding):
        if at_ms - before_ms < least_ms * (1 - ROUNDING):
            pulse = f".pulses[{index}]" if effect.pulses else f".rate_envelope: pulse {index}"
            return (
                f"{pulse}, at {at_ms:g} ms, is {at_ms - before_ms:.4g} ms after the one before: emissions of"
                f" {board.waveform.duration_ms:g} ms are at least {least_ms:.4g} ms apart, to fit into"
                f" limits.max_duty = {board.limits.max_duty:g}"
            )
    return ""


def _check_rate(key: str, effect: EffectTable, board: Board) -> None:
    """Check an effect's rate or rhythm against the board's duty limit, and a fixed emitter's pause and place."""
    if close := _too_close(effect, board):
        raise ConfigError(f"{key}{close}")
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
