"""Effects as data: when something is to be felt, how strong, how often in time or how densely in space.

An effect is a TOML table of a few primitives (controller/README.md has one example of each). One that builds
on another names it with `effect` and gives only what differs. Those in effects.toml beside this module ship
with the package; a scene adds its own.
"""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta

from controller.board.board import Board
from controller.board.records import NotNegative, Record, as_record, load_toml
from controller.errors import ConfigError

LIBRARY = Path(__file__).with_name("effects.toml")
MIN_AMPLITUDE = 0.25  # amplitude: below it the plate's response is not in proportion any more
ROUNDING = 1e-9

When = Literal["press", "release", "enter", "leave", "move", "always", "command"]
Amplitude = Annotated[float, Meta(ge=MIN_AMPLITUDE, le=1)]
Rate = Annotated[float, Meta(ge=0.1, le=1000)]  # the FPGA counts periods in 32 bits of its clock
EnvelopePoint = tuple[NotNegative, Annotated[float, Meta(ge=0, le=1)]]


class EffectTable(Record, frozen=True):
    """An effect as it stands in a file; None: not given.

    `when` is one occasion or several; `rate_hz` with `count` or `duration_ms` makes a train that begins `phase`
    of a period late; `spacing_mm` is a way along the finger's `path`, or of lines across `x` or `y` that begin at
    the region's lower end, moved by `phase` of a spacing; `envelope` is amplitude over ms of the train.
    """

    effect: str | None = None
    when: When | tuple[When, ...] | None = None
    amplitude: Amplitude | None = None
    rate_hz: Rate | None = None
    count: Annotated[int, Meta(ge=1, le=1_000_000)] | None = None
    duration_ms: Annotated[float, Meta(gt=0, le=3.6e6)] | None = None
    phase: Annotated[float, Meta(ge=0, lt=1)] | None = None
    spacing_mm: Annotated[float, Meta(ge=0.1, le=1000)] | None = None
    along: Literal["path", "x", "y"] | None = None
    envelope: Annotated[tuple[EnvelopePoint, ...], Meta(min_length=1, max_length=1000)] | None = None
    x_mm: NotNegative | None = None
    y_mm: NotNegative | None = None

    @property
    def occasions(self) -> tuple[When, ...]:
        """When it is felt."""
        return (self.when,) if isinstance(self.when, str) else self.when or ()

    @property
    def strength(self) -> float:
        """Its amplitude, 1 where none is given."""
        return 1.0 if self.amplitude is None else self.amplitude

    @property
    def first_s(self) -> float:
        """From the start of a train to its first emission."""
        return 0.0 if self.rate_hz is None else (self.phase or 0.0) / self.rate_hz

    @property
    def emissions(self) -> int:
        """How many a train has; 1 without a rate."""
        if self.rate_hz is None or self.duration_ms is None:
            return self.count or 1
        return math.ceil((self.duration_ms * 1e-3 - self.first_s - ROUNDING) * self.rate_hz)

    @property
    def end_ms(self) -> float:
        """From the start of a train to where its next emission would be, or to its given duration."""
        if self.duration_ms is not None:
            return self.duration_ms
        return 0.0 if self.rate_hz is None else (self.first_s + self.emissions / self.rate_hz) * 1e3

    def over(self, base: EffectTable) -> EffectTable:
        """Another effect with what this one gives in its place."""
        given = {name: value for name in self.__struct_fields__ if (value := getattr(self, name)) is not None}
        given.pop("effect", None)
        if "count" in given or "duration_ms" in given:  # one of them says how long
            base = msgspec.structs.replace(base, count=None, duration_ms=None)
        return msgspec.structs.replace(base, **given)


Effects = dict[str, EffectTable]
Tables = dict[Annotated[str, Meta(min_length=1, max_length=64)], dict[str, Any]]  # by name, as they stand in a file


class LibraryTable(Record, frozen=True):
    """The whole library file."""

    effects: Tables


@cache
def library() -> Effects:
    """The effects that ship with the package, by name."""
    tables = load_toml(LIBRARY, LibraryTable).effects
    return {name: as_record(f"{LIBRARY}: effects.{name}.", table, EffectTable) for name, table in tables.items()}


def known_effects(file: Path, own: Tables, board: Board) -> tuple[Effects, Effects]:
    """Effects that a scene's regions can name, and those of them that a command can play.

    A scene's own effects may build on the library's and on those above them, and take their names.

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
        if not {"move", "always"} & set(effect.occasions) and (effect.rate_hz or 0.0) <= highest_rate_hz(board) * (1 + ROUNDING):
            playable[name] = effect
    return known, playable


def resolved(key: str, given: str | EffectTable, known: Effects, board: Board) -> EffectTable:
    """An effect with what it builds on filled in, and checked.

    Parameters
    ----------
    key : str
        File and key for messages.
    known : dict
        Effects that may be named.

    Raises
    ------
    ConfigError
        If it names an unknown effect, or its values do not go together.
    """
    base = given if isinstance(given, str) else given.effect
    effect = EffectTable() if isinstance(given, str) else given
    if base is not None:
        if base not in known:
            where = key if isinstance(given, str) else f"{key}.effect"
            raise ConfigError(f"{where} = {base!r} is no effect; known: {', '.join(sorted(known))}")
        effect = effect.over(known[base])
    wrong = _wrong(effect)
    if wrong:
        raise ConfigError(f"{key}{wrong}")
    _check_rate(key, effect, board)
    return effect


def highest_rate_hz(board: Board) -> float:
    """As often as emissions fit into the duty limit."""
    return board.limits.max_duty / board.waveform.duration_s


def _wrong(effect: EffectTable) -> str:
    """What does not go together, as the end of a message; empty if all is well."""
    occasions = effect.occasions
    if not occasions:
        return ".when is missing (press, release, enter, leave, move, always or command; or name an effect to build on)"
    if len(set(occasions)) < len(occasions):
        return f".when = {list(occasions)} has one of them twice"
    if len(occasions) > 1 and {"move", "always"} & set(occasions):
        return f".when = {list(occasions)}: 'move' and 'always' stand alone"
    only = occasions[0]
    spatial, train = only == "move", effect.rate_hz is not None
    if spatial and effect.spacing_mm is None:
        return ".spacing_mm is missing: what is felt as a finger moves needs a spacing"
    if only == "always" and not train:
        return ".rate_hz is missing: what is always on needs a rate"
    for name in ("spacing_mm", "along"):
        if getattr(effect, name) is not None and not spatial:
            return f'.{name} = {getattr(effect, name)!r} needs when = "move"'
    for name in ("x_mm", "y_mm"):
        if getattr(effect, name) is not None and only != "always":
            return f'.{name} = {getattr(effect, name):g} needs when = "always": all else is felt where the finger is'
    if effect.phase is not None and not train and effect.along not in {"x", "y"}:
        return f".phase = {effect.phase:g} needs a rate_hz, or lines along x or y"
    if spatial and train:
        return f'.rate_hz = {effect.rate_hz:g} does not go with when = "move", which has its spacing_mm'
    if "release" in occasions and train:
        return f'.rate_hz = {effect.rate_hz:g} does not go with when = "release": a lifted finger feels no train'
    lengths = [name for name in ("count", "duration_ms") if getattr(effect, name) is not None]
    if len(lengths) == 2:
        return f": count = {effect.count} and duration_ms = {effect.duration_ms:g} both say how long: give one of them"
    for name in (*lengths, *(["envelope"] if effect.envelope else [])):
        if not train or only == "always":
            return f'.{name} needs a train with an end: a rate_hz, and not when = "always"'
    if train and only != "always" and not lengths:
        return ": a train needs its end: count or duration_ms"
    if effect.emissions < 1:
        return f".phase = {effect.phase:g} leaves no emission within duration_ms = {effect.duration_ms:g}"
    return _wrong_envelope(effect)


def _wrong_envelope(effect: EffectTable) -> str:
    points = effect.envelope
    if points is None:
        return ""
    for index, (at_ms, amplitude) in enumerate(points):
        if index and at_ms <= points[index - 1][0]:
            return f".envelope[{index}] = {[at_ms, amplitude]} is not later than the point before, at {points[index - 1][0]:g} ms"
        if 0 < amplitude < MIN_AMPLITUDE:
            return f".envelope[{index}] = {[at_ms, amplitude]}: an amplitude is 0 (silence) or {MIN_AMPLITUDE:g} to 1"
    if points[-1][0] > effect.end_ms * (1 + ROUNDING):
        return f".envelope goes on to {points[-1][0]:g} ms, but the train ends at {effect.end_ms:g} ms"
    if not any(amplitude for _, amplitude in points):
        return ".envelope is silent throughout"
    return ""


def _check_rate(key: str, effect: EffectTable, board: Board) -> None:
    """What the board's limits say to a rate."""
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
