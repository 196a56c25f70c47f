"""The keys of a TOML file from its records: as a reference for people (Markdown) and as a JSON schema for editors.

Kinds, ranges and defaults come from the records' types, units from the keys' endings, and the sentence about each key from the
section Attributes of the records' docstrings.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import msgspec
from msgspec.inspect import DictType, Field, ListType, NoneType, StructType, TupleType, Type, UnionType, VarTupleType

from controller.device.board.descriptions import END, described, fields_of, structs_of, type_info, unit_of
from controller.device.board.relations.relation import Relation

SCHEMA_DIALECT = "https://json-schema.org/draft/2020-12/schema"


@dataclass(frozen=True, slots=True)
class _Section:
    """A table of the file: its heading, its summary, and its keys with the record that declares them."""

    heading: str
    summary: str
    keys: list[tuple[Field, type]]


def reference(title: str, kind: type, named: Mapping[str, type] | None = None) -> str:
    """Describe every key that a file may give, in Markdown: one table of keys for each table of the file.

    `kind` is the record of the whole file; `named` has the records of tables by names of the user's choice, by the key that holds
    them. Raises ValueError if a record's docstring does not describe one of its keys.
    """
    root = type_info(kind)
    assert isinstance(root, StructType)
    lines = [f"# {title}", "", _summary(kind), ""]
    for section in _sections(root, "", named or {}):
        if section.heading:
            lines += [f"## {section.heading}", "", section.summary, ""]
        if not section.keys:
            continue
        lines += ["| key | value | default | meaning |", "|---|---|---|---|"]
        for field, cls in section.keys:
            name = field.encode_name
            cells = (f"`{name}`", described(field.type, unit_of(name)), _default(field), attributes(cls)[name])
            lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
        lines.append("")
    return "\n".join(lines)


def relations_reference(relations: Iterable[Relation]) -> str:
    """Describe what must hold of several keys of board.toml together, as a table in Markdown."""
    lines = [
        "## Keys that belong together",
        "",
        "Checked whenever a board is read. A board that is unsafe or cannot work is refused by every command, with exit code 78"
        " (wrong axes not by `calibrate-touch`, which finds them); what is odd is a warning of `board check`, `bank build`, `run`,"
        " `gateware build` and `doctor`. What the values of one table alone decide, such as a band upside down, is refused as an"
        " invalid value is.",
        "",
        "| keys | what holds | else |",
        "|---|---|---|",
        *(f"| {one.keys} | {one.rule} | {'refused' if one.refuses else 'a warning'} |" for one in relations),
        "",
    ]
    return "\n".join(lines)


def schema(kind: type, named: Mapping[str, type] | None = None) -> dict[str, Any]:
    """JSON schema of a file, for editors that check TOML by one; arguments as for `reference`."""
    found = msgspec.json.schema(kind, schema_hook=lambda _: {"type": "string"})
    definitions = found["$defs"]
    for cls in _records(type_info(kind)):
        definition, docs = definitions[cls.__name__], attributes(cls)
        definition["description"] = _summary(cls)
        wanted = {field.encode_name for field in fields_of(_struct(cls))}
        properties = definition["properties"]
        for name in list(properties):
            if name in docs and name in wanted:
                properties[name]["description"] = docs[name]
            elif name in docs:
                del properties[name]  # a field that the program sets
        for name, item in (named or {}).items():
            if cls is kind and name in properties:
                properties[name]["additionalProperties"] = {"$ref": f"#/$defs/{item.__name__}"}
    as_in_a_file: dict[str, Any] = msgspec.json.decode(  # no tuples
        msgspec.json.encode({"$schema": SCHEMA_DIALECT} | found).replace(msgspec.json.encode(END)[1:], b'$"')
    )
    return as_in_a_file


def attributes(cls: type) -> dict[str, str]:
    """The sentence about each field of a record, its own and those it inherits, from the docstrings' sections Attributes."""
    found: dict[str, str] = {}
    for base in reversed(cls.__mro__):
        _, _, section = inspect.cleandoc(base.__dict__.get("__doc__") or "").partition("\nAttributes:\n")
        for names, text in re.findall(r"^(\w[\w, ]*): (.*(?:\n .*)*)", section, re.MULTILINE):
            found |= dict.fromkeys(names.split(", "), " ".join(text.split()))
    return found


def _sections(struct: StructType, heading: str, named: Mapping[str, type]) -> Iterator[_Section]:
    """A table and, behind it, the tables within it."""
    plain = [field for field in fields_of(struct) if not _tables(field) and field.encode_name not in named]
    yield _checked(_Section(heading, _summary(struct.cls), [(field, struct.cls) for field in plain]))
    for field in fields_of(struct):
        name = field.encode_name
        if name in named:
            yield from _sections(_struct(named[name]), f"[{name}.NAME]", {})
        elif len(tables := _tables(field)) == 1 and not tables[0].tag_field:
            many = isinstance(field.type, VarTupleType | ListType)
            key = f"{heading.strip('[]')}.{name}".removeprefix(".")
            section, *within = _sections(tables[0], f"[[{key}]]" if many else f"[{key}]", {})
            left_out = "" if field.required else f" {attributes(struct.cls)[name]}"
            yield replace(section, summary=section.summary + left_out)
            yield from within
        elif tables:
            yield from _kinds(name, tables, many=isinstance(field.type, VarTupleType | ListType))


def _kinds(name: str, tables: list[StructType], *, many: bool) -> Iterator[_Section]:
    """A table of several kinds: what all have, then what each has beside."""
    heading = f"[[{name}]]" if many else f"[{name}]"
    tag_field = tables[0].tag_field
    shared = [field for field in fields_of(tables[0]) if all(_same(field, table) for table in tables)]
    base = next(cls for cls in tables[0].cls.__mro__ if all(issubclass(table.cls, cls) for table in tables))
    kinds = ", ".join(f'"{table.tag}"' for table in tables)
    yield _checked(_Section(heading, f"{_summary(base)} `{tag_field}` is one of {kinds}.", [(field, base) for field in shared]))
    for table in tables:
        names = {field.encode_name for field in shared}
        own = [(field, table.cls) for field in fields_of(table) if field.encode_name not in names]
        if own:
            yield _checked(_Section(f'{heading} with {tag_field} = "{table.tag}"', _summary(table.cls), own))


def _same(field: Field, table: StructType) -> bool:
    return any(
        (other.encode_name, other.type, other.default) == (field.encode_name, field.type, field.default)
        for other in fields_of(table)
    )


def _checked(section: _Section) -> _Section:
    for field, cls in section.keys:
        if field.encode_name not in attributes(cls):
            raise ValueError(f"the docstring of {cls.__name__} does not describe {field.encode_name}")
    return section


def _tables(field: Field) -> list[StructType]:
    """Tables that a field holds, itself or as the items of a list; none where a text may stand in their place."""
    kind: Type = field.type
    if isinstance(kind, VarTupleType | ListType):
        kind = kind.item_type
    others = [other for other in (kind.types if isinstance(kind, UnionType) else (kind,)) if not isinstance(other, NoneType)]
    return structs_of(kind) if all(isinstance(other, StructType) for other in others) else []


def _records(kind: Type) -> set[type]:
    """Every record in a type."""
    match kind:
        case StructType():
            return {kind.cls}.union(*(_records(field.type) for field in kind.fields))
        case UnionType():
            return set().union(*map(_records, kind.types))
        case VarTupleType() | ListType():
            return _records(kind.item_type)
        case TupleType():
            return set().union(*map(_records, kind.item_types))
        case DictType():
            return _records(kind.value_type)
        case _:
            return set()


def _struct(cls: type) -> StructType:
    found = type_info(cls)
    assert isinstance(found, StructType)
    return found


def _summary(cls: type) -> str:
    """What a record's docstring says before its sections, on one line."""
    text = inspect.cleandoc(cls.__doc__ or "").partition("\nAttributes:\n")[0]
    return " ".join(text.split())


def _default(field: Field) -> str:
    if field.default_factory is not msgspec.NODEFAULT:
        return "none"
    if field.default is msgspec.NODEFAULT:
        return "required" if field.required else "none"
    match field.default:
        case None:
            return "none"
        case bool():
            return str(field.default).lower()
        case str():
            return f'`"{field.default}"`'
        case _:
            return f"{field.default:g}" if isinstance(field.default, float) else str(field.default)
