"""msgspec's validation errors as our messages: the key, what was found there, what is valid there, the nearest valid name.

Used for board.toml, scene.toml and the messages of the application socket.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from typing import Any, Final

import msgspec
from msgspec.inspect import (
    CustomType,
    DictType,
    ListType,
    LiteralType,
    NoneType,
    StructType,
    TupleType,
    Type,
    UnionType,
    VarTupleType,
)

from controller.device.board.descriptions import choices, described, keys_of, structs_of, type_info, unit_of

# What msgspec raises for bytes that are not JSON, or not of the type that was asked for
NO_JSON: Final = (msgspec.DecodeError, UnicodeDecodeError, RecursionError)
MAX_SHOWN = 60  # characters of a refused value
MAX_MATCHED = 64  # characters of a name for which a near one is searched: no valid name is longer, and a client may send 8 KiB

Path = tuple[str | int, ...]
_PARTS = re.compile(r"(.*?)(?: - at (`key` in )?`\$(.*)`)?", re.DOTALL)  # of a message of msgspec: text, whether of a key, path


def explain(message: str, value: Any, kind: Any) -> str:
    """Translate a message of msgspec into a line such as "link.slots = 17: must be a whole number from 1 to 16".

    `value` is what was refused, as decoded without a type, and `kind` what it was to be.
    """
    parts = _PARTS.fullmatch(message)
    assert parts is not None  # it matches anything
    text, in_keys, where = parts.groups()
    path: Path = tuple(int(index) if index else key for key, index in re.findall(r"\.([^.\[\]`]+)|\[(\d+)\]", where or ""))
    root = type_info(kind)
    if unknown := re.fullmatch(r"Object contains unknown field `(.*)`", text, re.DOTALL):
        path = (*path, unknown[1])
        return f"{shown_at(path, value)}: unknown key{nearest(unknown[1], keys_of(_type_at(root, path[:-1], value)))}"
    if missing := re.fullmatch(r"Object missing required field `(.*)`", text, re.DOTALL):
        path = (*path, missing[1])
        valid = described(_type_at(root, path, value), unit_of(missing[1]))
        return f"{dotted(path)} is missing" + (f": {valid}" if valid else "")
    found, at = shown_at(path, value), _type_at(root, path, value)
    if isinstance(at, CustomType):  # a field that the program sets, such as a board's folder
        return f"{found}: unknown key"
    if in_keys and isinstance(at, DictType):
        return f"{dotted(path)}: a name in it must be {described(at.key_type)}"
    valid = described(at, _unit_at(path)) if re.match(r"Expected|Invalid", text) else ""
    said = f"must be {valid}" if valid else text
    refused, names = _found(value, path), choices(at)
    if names and isinstance(refused, str):
        said += nearest(refused, names, listed=True)
    return f"{found}: {said}" if found else said


def dotted(path: Iterable[str | int]) -> str:
    """A place in a file or message as its keys are written, such as `regions[0].effects[1].when`."""
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


def shown_at(path: Path, value: Any) -> str:
    """Key and value at a path; tables and lists are not repeated."""
    found = _found(value, path)
    if isinstance(found, dict | list):
        return dotted(path)
    text = repr(found)
    return f"{dotted(path)} = {text if len(text) <= MAX_SHOWN else f'{text[:MAX_SHOWN]}…'}" if path else ""


def _unit_at(path: Path) -> str:
    """Unit of the last key of a path; items of a list have that of their list."""
    return unit_of(next((part for part in reversed(path) if isinstance(part, str)), ""))


def _type_at(kind: Type | None, path: Path, value: Any) -> Type | None:
    """Type of what is at a path; None where it is not known."""
    for part in path:
        kind = chosen(kind, value)
        match kind:
            case StructType() if part == kind.tag_field:
                kind = LiteralType((kind.tag,))
            case StructType():
                kind = next((field.type for field in kind.fields if field.encode_name == part), None)
            case VarTupleType() | ListType():
                kind = kind.item_type
            case TupleType() if isinstance(part, int) and part < len(kind.item_types):
                kind = kind.item_types[part]
            case DictType():
                kind = kind.value_type
            case UnionType() if part in {struct.tag_field for struct in structs_of(kind)}:
                kind = LiteralType(tuple(struct.tag for struct in structs_of(kind)))
            case UnionType() if isinstance(part, int):
                kind = next((other.item_type for other in kind.types if isinstance(other, VarTupleType | ListType)), None)
            case _:
                return None
        value = _found(value, (part,))
    return chosen(kind, value)


def chosen(kind: Type | None, value: Any) -> Type | None:
    """The member of a union that a value is meant to be: the table with its tag, or the only one beside None; else the union."""
    if not isinstance(kind, UnionType):
        return kind
    structs = structs_of(kind)
    if isinstance(value, dict) and structs:
        tagged = [other for other in structs if other.tag_field and value.get(other.tag_field) == other.tag]
        if tagged or len(structs) == 1:
            return (tagged or structs)[0]
    others = [other for other in kind.types if not isinstance(other, NoneType)]
    return others[0] if len(others) == 1 else kind


def nearest(name: str, known: list[str], *, listed: bool = False) -> str:
    """The nearest known name as the end of a message; where none is near, all of them, unless they are `listed` already."""
    near = difflib.get_close_matches(name, known, 1) if len(name) <= MAX_MATCHED else []
    if near:
        return f"; did you mean {near[0]}?"
    return f"; there are: {', '.join(known)}" if known and not listed else ""
