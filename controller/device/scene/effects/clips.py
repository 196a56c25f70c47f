"""An effect that a client sends as data: checked as those of a scene are, and bounded, since that is done between two turns."""

from __future__ import annotations

from typing import Final, NamedTuple

import msgspec

from controller.device.board.board import Board
from controller.device.board.records import as_record
from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.effects.library import library, resolved
from controller.device.scene.effects.primitives import primitive_of
from controller.device.scene.effects.trains import Train, silent, train_of
from controller.errors import ConfigError

MOST_PULSES: Final = 1000  # of a train of changing rate: each has to be found; a line has room for as many that are listed
EXPLAINED_BYTES: Final = 1024  # of an effect that is refused: finding the words takes milliseconds for a long one


class ClientEffect(NamedTuple):
    """What a client's effect plays, and the name under which its emissions are reported."""

    name: str
    train: Train


def read_clip(name: str, line: bytes | memoryview | msgspec.Raw, board: Board) -> ClientEffect:
    """Read an effect of a client.

    `name` is that of its emissions; `line` is JSON with the keys of an [effects.NAME]; without `when`, and without an `effect` that
    has one, it is for commands. The board's duty limit bounds its pulses. Raises ConfigError if it is invalid, has more than
    `MOST_PULSES`, is silent, or only a moving finger or a fixed emitter can have it.
    """
    try:
        table = msgspec.json.decode(line, type=EffectTable)
    except msgspec.ValidationError as wrong:
        if len(line) <= EXPLAINED_BYTES and isinstance(value := msgspec.json.decode(line), dict):
            as_record("effect.", value, EffectTable)  # says what is wrong with the key's name
        raise ConfigError(f"effect: {wrong}") from wrong
    if not table.occasions and table.effect is None:
        table = msgspec.structs.replace(table, when="command")
    base = library().get(table.effect or "")
    _require_few(table if base is None else table.over(base))
    effect = resolved("effect", table, library(), board)
    if "command" not in (primitive := primitive_of(effect)).when:
        raise ConfigError(f"effect is {primitive.name}, which only a region can have: a clip begins when it is sent")
    train = train_of(effect)
    if silent(train):
        raise ConfigError("effect.envelope is silent at every emission of the train")
    return ClientEffect(name, train)


def _require_few(effect: EffectTable) -> None:
    """Refuse a train of changing rate with more pulses than the loop has time to find."""
    if effect.rate_envelope is None or effect.duration_ms is None:
        return
    pulses = effect.duration_ms * 1e-3 * max(hz for _, hz in effect.rate_envelope)
    if pulses > MOST_PULSES:
        raise ConfigError(f"effect.rate_envelope makes up to {pulses:,.0f} pulses: a clip has at most {MOST_PULSES:,}")
