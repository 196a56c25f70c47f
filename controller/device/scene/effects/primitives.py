"""Which keys of an effect go together: one row of `PRIMITIVES` for each kind of effect.

A new key or kind of effect is a field of `effects.EffectTable` and a row or an entry here (README.md, "A new primitive").
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any, NamedTuple, get_args

from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.scene.effects.effects import MOST_PULSES, ROUNDING, EffectTable, When
from controller.device.scene.effects.rhythms import SILENCE, rhythm_of

COMMON = ("effect", "when", "amplitude")  # keys that every effect takes


class Primitive(NamedTuple):
    """A kind of effect."""

    name: str  # as messages call it
    when: tuple[When, ...]  # occasions on which it may be felt, alone or together
    required: tuple[tuple[str, ...], ...] = ()  # keys that it needs; of several in one tuple exactly one
    optional: tuple[str, ...] = ()  # keys that it takes as well
    # Of several primitives with the same occasion, this is the one if the key is given, with one of the values if there are
    # any; empty: if no row above is
    chosen_by: tuple[str, tuple[str, ...]] | None = None

    @property
    def keys(self) -> tuple[str, ...]:
        """All keys that it takes."""
        return (*COMMON, *[key for alternatives in self.required for key in alternatives], *self.optional)

    @property
    def described(self) -> str:
        """Its name and how to get it, for a message."""
        needed = [" or ".join(alternatives) for alternatives in self.required]
        return f"{self.name} ({'; '.join([*needed, 'when = ' + ', '.join(self.when)])})"


PRIMITIVES = (
    Primitive(
        "a train",
        when=("press", "enter", "leave", "command"),  # not release: a lifted finger feels no train
        required=(("rate_hz",), ("count", "duration_ms")),
        optional=("phase", "envelope"),
        chosen_by=("rate_hz", ()),
    ),
    Primitive(
        "a train of changing rate",
        when=("press", "enter", "leave", "command"),
        required=(("rate_envelope",), ("duration_ms",)),
        optional=("phase", "envelope"),
        chosen_by=("rate_envelope", ()),
    ),
    Primitive("a rhythm", when=("press", "enter", "leave", "command"), required=(("pulses",),), chosen_by=("pulses", ())),
    Primitive("a single emission", when=("press", "release", "enter", "leave", "command")),
    Primitive(
        "a grid of lines",
        when=("move",),
        required=(("spacing_mm",), ("along",)),
        optional=("phase",),
        chosen_by=("along", ("x", "y")),
    ),
    Primitive("a spacing along the path", when=("move",), required=(("spacing_mm",),), optional=("along",)),
    Primitive("a fixed emitter", when=("always",), required=(("rate_hz",),), optional=("phase", "x_mm", "y_mm")),
)


def primitive_of(effect: EffectTable) -> Primitive:
    """Kind of an effect that has an occasion, by the first of its occasions and the keys that it gives."""
    for primitive in PRIMITIVES:
        if effect.occasions[0] in primitive.when:
            if primitive.chosen_by is None:
                return primitive
            key, values = primitive.chosen_by
            value = getattr(effect, key)
            if value is not None and (not values or value in values):
                return primitive
    raise AssertionError(f"no primitive for when = {effect.occasions[0]!r}")


def conflict(effect: EffectTable) -> str:
    """Check the keys of an effect: the end of a message that begins with the effect's place in the file; empty: no conflict."""
    occasions = effect.occasions
    if not occasions:
        return f".when is missing: give one or several of {', '.join(get_args(When))}, or with `effect` a name to build on"
    if len(set(occasions)) < len(occasions):
        return f".when = {list(occasions)} has one of them twice"
    primitive = primitive_of(effect)
    for other in occasions[1:]:
        if other not in primitive.when:
            return (
                f".when = {list(occasions)}: {other!r} does not go with {occasions[0]!r}: {primitive.name} takes"
                f" {', '.join(primitive.when)}"
            )
    given = {key: value for key in effect.__struct_fields__ if (value := getattr(effect, key)) is not None}
    for key, value in given.items():
        if key not in primitive.keys:
            owners = ", ".join(other.described for other in PRIMITIVES if key in other.keys)
            return f'.{key}{_shown(value)} does not go with when = "{occasions[0]}", {primitive.name}; it belongs to {owners}'
    for alternatives in primitive.required:
        found = [key for key in alternatives if key in given]
        if not found and len(alternatives) == 1:
            return f".{alternatives[0]} is missing: it is needed for {primitive.described}"
        if not found:
            return f": {' or '.join(alternatives)} is missing: one of them is needed for {primitive.described}"
        if len(found) > 1:
            return f": {' and '.join(f'{key}{_shown(given[key])}' for key in found)} exclude each other: give one of them"
    if effect.emissions < 1:
        late = f".phase = {effect.phase:g} leaves no emission within duration_ms = {effect.duration_ms:g}" if effect.phase else ""
        return late or f".duration_ms = {effect.duration_ms:g} is too short for an emission"
    return (
        _order_conflict("rate_envelope", effect.rate_envelope, effect.end_ms)
        or _points_conflict("envelope", effect.envelope, effect.end_ms)
        or _points_conflict("pulses", effect.pulses, math.inf)
        or _sweep_conflict(effect)
    )


def _shown(value: Any) -> str:
    """A value behind its key; lists are not repeated."""
    return f" = {value:g}" if isinstance(value, float) else "" if isinstance(value, tuple) else f" = {value!r}"


def _points_conflict(key: str, points: tuple[tuple[float, float], ...] | None, end_ms: float) -> str:
    """What is wrong with points [ms, amplitude] of an effect that ends at `end_ms`; empty: nothing."""
    for index, (at_ms, amplitude) in enumerate(points or ()):
        if 0 < amplitude < MIN_AMPLITUDE:
            return f".{key}[{index}] = {[at_ms, amplitude]}: an amplitude is 0 (silence) or {MIN_AMPLITUDE:g} to 1"
    if points is not None and not any(amplitude for _, amplitude in points):
        return f".{key} is silent throughout"
    return _order_conflict(key, points, end_ms)


def _order_conflict(key: str, points: tuple[tuple[float, float], ...] | None, end_ms: float) -> str:
    """What is wrong with the times of points [ms, …] of an effect that ends at `end_ms`; empty: nothing."""
    if points is None:
        return ""
    for index, ((before_ms, _), (at_ms, value)) in enumerate(pairwise(points), 1):
        if at_ms <= before_ms:
            return f".{key}[{index}] = {[at_ms, value]} is not later than the point before, at {before_ms:g} ms"
    if points[-1][0] > end_ms * (1 + ROUNDING):
        return f".{key} goes on to {points[-1][0]:g} ms, but the train ends at {end_ms:g} ms"
    return ""


def _sweep_conflict(effect: EffectTable) -> str:
    """What is wrong with the number of pulses of a train of changing rate; empty: nothing."""
    if effect.rate_envelope is None or effect.duration_ms is None:
        return ""
    most = effect.duration_ms * 1e-3 * max(hz for _, hz in effect.rate_envelope)
    if most > 10 * MOST_PULSES or len(pulses := rhythm_of(effect)) > MOST_PULSES:
        return f".rate_envelope makes more than {MOST_PULSES:,} pulses in duration_ms = {effect.duration_ms:g}: shorten it"
    if not pulses:
        return f".duration_ms = {effect.duration_ms:g} is too short for an emission"
    return "" if any(amplitude >= SILENCE for _, amplitude in pulses) else ".envelope is silent at each pulse of rate_envelope"
