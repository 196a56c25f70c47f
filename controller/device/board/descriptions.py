"""What a file or message may hold at one place, in words: kind, range with unit, valid values. Taken from the records' types."""

from __future__ import annotations

import functools
import re

from msgspec import inspect
from msgspec.inspect import (
    BoolType,
    CustomType,
    DictType,
    Field,
    FloatType,
    IntType,
    ListType,
    LiteralType,
    NoneType,
    StrType,
    StructType,
    TupleType,
    Type,
    UnionType,
    VarTupleType,
)

UNITS = {  # by what a key ends with; the longest ending counts
    "per_k": "1/K",
    "n_per_v": "N/V",
    "per_s": "1/s",
    "kg_m3": "kg/m³",
    "kg_m2": "kg/m²",
    "n_m3": "N/m³",
    "pa_s_m": "Pa s/m",
    "mm": "mm",
    "um": "µm",
    "mg": "mg",
    "us": "µs",
    "ms": "ms",
    "s": "s",
    "hz": "Hz",
    "v": "V",
    "w": "W",
    "c": "°C",
    "pa": "Pa",
    "h": "H",
    "f": "F",
    "ohm": "Ω",
}
_UNIT = re.compile(rf"_({'|'.join(sorted(UNITS, key=len, reverse=True))})(?:_from_axes)?$")

END = r"\Z"  # how a pattern ends: Python's `$` takes a line break too, that of other languages, and of JSON's schemas, does not

type_info = functools.cache(inspect.type_info)  # the socket translates errors between two turns of the loop


def unit_of(key: str | int) -> str:
    """Unit of a key by its ending, such as mm of `spacing_mm`; empty where it has none."""
    found = _UNIT.search(str(key))
    return UNITS[found[1]] if found else ""


def described(kind: Type | None, unit: str = "") -> str:
    """What a value may be, such as "a number from 0 to 200 ms"; empty for a type that allows anything.

    `unit` is that of its numbers; `kind` None: unknown.
    """
    match kind:
        case FloatType():
            return f"a number{_range(kind, unit)}"
        case IntType():
            return f"a whole number{_range(kind, unit)}"
        case BoolType():
            return "true or false"
        case StrType():
            return _described_text(kind)
        case LiteralType():
            return ("one of " if len(kind.values) > 1 else "") + ", ".join(repr(value) for value in kind.values)
        case TupleType():
            items = list(dict.fromkeys(described(item, unit) for item in kind.item_types))
            return f"a list of {len(kind.item_types)} values" + (f", each {items[0]}" if len(items) == 1 else "")
        case VarTupleType() | ListType():
            item = "" if isinstance(kind.item_type, StructType | UnionType | DictType) else described(kind.item_type, unit)
            return f"a list{_length(kind.min_length, kind.max_length, '')}" + (f", each {item}" if item else "")
        case StructType() | DictType():
            return "a table"
        case UnionType():
            parts = [described(other, unit) for other in kind.types if not isinstance(other, NoneType)]
            parts = ["a list of these" if part in {f"a list, each {other}" for other in parts} else part for part in parts]
            return " or ".join(dict.fromkeys(parts)) if all(parts) else ""
        case _:
            return ""


def choices(kind: Type | None) -> list[str]:
    """Valid values where there is a fixed set of texts, alone or beside other kinds; else none."""
    match kind:
        case LiteralType():
            return [str(value) for value in kind.values]
        case UnionType():
            return [choice for other in kind.types if isinstance(other, LiteralType) for choice in choices(other)]
        case _:
            return []


def structs_of(kind: Type | None) -> list[StructType]:
    """Tables among the kinds that a value may be."""
    others = kind.types if isinstance(kind, UnionType) else (kind,)
    return [other for other in others if isinstance(other, StructType)]


def fields_of(struct: StructType) -> list[Field]:
    """Keys that a file may give; the other fields of a record, such as its folder, are set by the program."""
    return [field for field in struct.fields if not isinstance(field.type, CustomType)]


def keys_of(kind: Type | None) -> list[str]:
    """Keys of a table, that of its kind first."""
    structs = structs_of(kind)
    tags = [struct.tag_field for struct in structs if struct.tag_field]
    return list(dict.fromkeys([*tags, *(field.encode_name for struct in structs for field in fields_of(struct))]))


def _described_text(kind: StrType) -> str:
    if kind.pattern:
        return f"a text that matches {kind.pattern.replace(END, '$')}"
    return f"a text{_length(kind.min_length, kind.max_length, ' characters')}"


def _length(lowest: int | None, highest: int | None, of: str) -> str:
    if lowest and highest:
        return f" of {lowest} to {highest}{of}" if lowest != highest else f" of {lowest}{of}"
    if lowest:
        return f" of at least {lowest}{of if lowest > 1 else of.removesuffix('s')}"
    return f" of at most {highest}{of}" if highest else ""


def _range(kind: FloatType | IntType, unit: str) -> str:
    lowest, highest = kind.ge, kind.le
    if isinstance(kind, IntType):
        lowest = kind.gt + 1 if kind.gt is not None else lowest
        highest = kind.lt - 1 if kind.lt is not None else highest
    after = f" {unit}" if unit else ""
    if lowest is not None and highest is not None:
        return f" from {_shown(lowest)} to {_shown(highest)}{after}"
    bounds = (("above", kind.gt), ("at least", kind.ge), ("below", kind.lt), ("at most", kind.le))
    said = [f"{word} {_shown(value)}" for word, value in bounds if value is not None]
    return f" {', '.join(said)}{after}" if said else (f" in {unit}" if unit else "")


def _shown(value: float) -> str:
    return str(value) if isinstance(value, int) else f"{value:.12g}"
