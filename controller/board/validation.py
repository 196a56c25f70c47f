"""What msgspec refuses, in words for whoever wrote the file: the key, what was found there, what may stand there."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from typing import Any

from msgspec import inspect
from msgspec.inspect import (
    BoolType,
    CustomType,
    DictType,
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

LONGEST_SHOWN = 60  # characters of a value that was refused

Path = tuple[str | int, ...]


def in_words(message: str, value: Any, kind: type[Any]) -> str:
    """A message of msgspec as a key, what was found there, and what may stand there.

    Parameters
    ----------
    message : str
        Of a `msgspec.ValidationError`.
    value : object
        What was refused: tables and lists.
    kind : type
        What it was to be.
    """
    text, _, where = message.partition(" - at `$")
    path: Path = tuple(int(index) if index else key for key, index in re.findall(r"\.([^.\[\]`]+)|\[(\d+)\]", where))
    if unknown := re.fullmatch(r"Object contains unknown field `(.*)`", text, re.DOTALL):
        known = _keys(_at(inspect.type_info(kind), path, value))
        found = f"{dotted((*path, unknown[1]))}{_shown(_found(value, (*path, unknown[1])))}"
        return f"{found}: unknown key{_meant(unknown[1], known)}"
    if missing := re.fullmatch(r"Object missing required field `(.*)`", text, re.DOTALL):
        path = (*path, missing[1])
        expected = _described(_at(inspect.type_info(kind), path, value))
        return f"{dotted(path)} is missing" + (f": {expected}" if expected else "")
    found = f"{dotted(path)}{_shown(_found(value, path))}"
    at = _at(inspect.type_info(kind), path, value)
    if isinstance(at, CustomType):  # a field that no file gives
        return f"{found}: unknown key"
    expected = _described(at) if re.match(r"Expected|Invalid", text) else ""
    said = f"must be {expected}" if expected else text
    choices = _choices(at)
    meant = _found(value, path)
    hint = _meant(meant, choices, told=True) if choices and isinstance(meant, str) else ""
    return f"{found}: {said}{hint}" if found else said


def dotted(path: Iterable[str | int]) -> str:
    """A place in a file as its keys are written."""
    shown = (f"[{part}]" if isinstance(part, int) else f".{part if part.isprintable() else ascii(part)}" for part in path)
    return "".join(shown).removeprefix(".")


def _found(value: Any, path: Path) -> Any:
    """What is at a path; None where there is nothing."""
    for part in path:
        try:
            value = value[part]
        except (LookupError, TypeError):
            return None
    return value


def _shown(value: Any) -> str:
    """A value behind its key; tables and lists are not repeated."""
    if isinstance(value, dict | list):
        return ""
    text = repr(value)
    return f" = {text}" if len(text) <= LONGEST_SHOWN else f" = {text[:LONGEST_SHOWN]}…"


def _at(kind: Type | None, path: Path, value: Any) -> Type | None:
    """Type of what is at a path; None where that cannot be told."""
    for part in path:
        kind = _chosen(kind, value)
        match kind:
            case StructType():
                tag_field = str(kind.tag_field)
                if part == tag_field:
                    return LiteralType((kind.tag,))
                kind = next((field.type for field in kind.fields if field.encode_name == part), None)
            case VarTupleType() | ListType():
                kind = kind.item_type
            case TupleType() if isinstance(part, int) and part < len(kind.item_types):
                kind = kind.item_types[part]
            case DictType():
                kind = kind.value_type
            case UnionType() if part in {other.tag_field for other in _structs(kind)}:
                return LiteralType(tuple(other.tag for other in _structs(kind)))
            case _:
                return None
        value = _found(value, (part,))
    return _chosen(kind, value)


def _chosen(kind: Type | None, value: Any) -> Type | None:
    """Of several tables the one whose tag is there; of something that may be left out, itself."""
    if not isinstance(kind, UnionType):
        return kind
    structs = _structs(kind)
    if isinstance(value, dict) and structs:
        tagged = [other for other in structs if other.tag_field and value.get(other.tag_field) == other.tag]
        if tagged or len(structs) == 1:
            return (tagged or structs)[0]
    others = [other for other in kind.types if not isinstance(other, NoneType)]
    return others[0] if len(others) == 1 else kind


def _structs(kind: UnionType) -> list[StructType]:
    return [other for other in kind.types if isinstance(other, StructType)]


def _keys(kind: Type | None) -> list[str]:
    """Keys of a table that a file may give."""
    structs = [kind] if isinstance(kind, StructType) else _structs(kind) if isinstance(kind, UnionType) else []
    tags = [struct.tag_field for struct in structs if struct.tag_field]
    fields = [field.encode_name for struct in structs for field in struct.fields if not isinstance(field.type, CustomType)]
    return list(dict.fromkeys([*tags, *fields]))


def _choices(kind: Type | None) -> list[str]:
    return [str(value) for value in kind.values] if isinstance(kind, LiteralType) else []


def _meant(word: str, known: list[str], *, told: bool = False) -> str:
    """The nearest of what is known; all of it where none is near and they were not told yet."""
    near = difflib.get_close_matches(word, known, 1)
    if near:
        return f"; did you mean {near[0]}?"
    return f"; there are: {', '.join(known)}" if known and not told else ""


def _described(kind: Type | None) -> str:
    """What may stand somewhere; empty where that is not for a sentence."""
    match kind:
        case FloatType():
            return f"a number{_range(kind)}"
        case IntType():
            return f"a whole number{_range(kind)}"
        case BoolType():
            return "true or false"
        case StrType():
            if kind.pattern:
                return f"a text that matches {kind.pattern}"
            return "a text" + (f" of at least {kind.min_length} characters" if (kind.min_length or 0) > 1 else "")
        case LiteralType():
            return ("one of " if len(kind.values) > 1 else "") + ", ".join(repr(value) for value in kind.values)
        case TupleType():
            same = len(set(map(_described, kind.item_types))) == 1
            return f"a list of {len(kind.item_types)} values" + (f", each {_described(kind.item_types[0])}" if same else "")
        case VarTupleType() | ListType():
            return "a list" + (f" of at least {kind.min_length}" if kind.min_length else "")
        case StructType() | DictType():
            return "a table"
        case UnionType():
            parts = [_described(other) for other in kind.types if not isinstance(other, NoneType)]
            return " or ".join(dict.fromkeys(parts)) if all(parts) else ""
        case _:
            return ""


def _range(kind: FloatType | IntType) -> str:
    lowest, highest = kind.ge, kind.le
    if isinstance(kind, IntType):
        lowest = kind.gt + 1 if kind.gt is not None else lowest
        highest = kind.lt - 1 if kind.lt is not None else highest
    if lowest is not None and highest is not None:
        return f" from {lowest:.12g} to {highest:.12g}"
    bounds = (("above", kind.gt), ("at least", kind.ge), ("below", kind.lt), ("at most", kind.le))
    told = [f"{word} {value:.12g}" for word, value in bounds if value is not None]
    return f" {', '.join(told)}" if told else ""
