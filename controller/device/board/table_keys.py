"""All keys of a table that are missing or unknown, at once: msgspec stops at the first."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msgspec.inspect import DictType, ListType, LiteralType, StructType, TupleType, Type, UnionType, VarTupleType

from controller.device.board.descriptions import described, fields_of, keys_of, structs_of, type_info, unit_of
from controller.device.board.validation import Path, chosen, dotted, nearest, shown_at

MOST = 60  # that a message names: a file of another kind has any number
WANTED = "also_required"  # method of a record: keys that others of the table make required, each with what it is to be


def wrong_keys(tables: Any, kind: Any) -> list[str]:
    """What is said of every key that is missing or unknown."""
    found = list(_of(tables, type_info(kind), (), tables))
    return [*found[:MOST], f"and {len(found) - MOST} more"] if len(found) > MOST else found


def _of(value: Any, kind: Type | None, path: Path, whole: Any) -> Iterator[str]:
    """Missing and unknown keys of a value, and of what is in it."""
    kind = chosen(kind, value)
    match kind:
        case StructType() if isinstance(value, dict):
            yield from _of_table(value, kind, path, whole)
        case UnionType() if isinstance(value, dict):
            tags = {struct.tag_field for struct in structs_of(kind)} - {None}
            for tag in tags - value.keys():  # else the tag has an invalid value
                valid = LiteralType(tuple(struct.tag for struct in structs_of(kind)))
                yield f"{dotted((*path, str(tag)))} is missing: {described(valid)}"
        case DictType() if isinstance(value, dict):
            for key, inner in value.items():
                yield from _of(inner, kind.value_type, (*path, key), whole)
        case VarTupleType() | ListType() if isinstance(value, list):
            for index, inner in enumerate(value):
                yield from _of(inner, kind.item_type, (*path, index), whole)
        case TupleType() if isinstance(value, list):
            for index, (inner, item) in enumerate(zip(value, kind.item_types, strict=False)):
                yield from _of(inner, item, (*path, index), whole)
        case UnionType() if isinstance(value, list):
            items = [other for other in kind.types if isinstance(other, VarTupleType | ListType)]
            if len(items) == 1:
                yield from _of(value, items[0], path, whole)
        case _:
            return


def _of_table(table: dict[str, Any], kind: StructType, path: Path, whole: Any) -> Iterator[str]:
    fields = {field.encode_name: field for field in fields_of(kind)}
    for key in table:
        if key not in fields and key != kind.tag_field and kind.forbid_unknown_fields:
            yield f"{shown_at((*path, key), whole)}: unknown key{nearest(key, keys_of(kind))}"
    wanted = {name: described(field.type, unit_of(name)) for name, field in fields.items() if field.required}
    also: dict[str, str] = getattr(kind.cls, WANTED, lambda _: {})(table)
    wanted |= {name: said or described(fields[name].type, unit_of(name)) for name, said in also.items()}
    for name in [name for name in fields if name in wanted and name not in table]:
        yield f"{dotted((*path, name))} is missing" + (f": {wanted[name]}" if wanted[name] else "")
    for key, inner in table.items():
        if key in fields:
            yield from _of(inner, fields[key].type, (*path, key), whole)
