"""Every number that a file or message may hold, with the values at the ends of its range and just beyond them."""

import math
import re
import sys

from msgspec.inspect import (
    BoolType,
    DictType,
    FloatType,
    IntType,
    ListType,
    LiteralType,
    NoneType,
    RawType,
    StrType,
    StructType,
    TupleType,
    UnionType,
    VarTupleType,
)

from controller.device.board.descriptions import fields_of

WORDS = ("a", "/dev/a1", "press", "click", "demo.evemu", "GPIO17", "0" * 64, "600")
BEYOND_ALL = (math.inf, -math.inf, math.nan)


def least(kind):
    """A value of a type with nothing that may be left out: numbers amid their range."""
    match kind:
        case FloatType() | IntType():
            lowest, highest = ends(kind)
            middle = min(max((lowest + highest) / 2 if highest - lowest < 1e9 else 1, lowest), highest)
            return int(middle) if isinstance(kind, IntType) else float(middle)
        case StrType():
            return next(word for word in WORDS if re.search(kind.pattern or "", word))
        case BoolType():
            return False
        case LiteralType():
            return kind.values[0]
        case TupleType():
            return [least(item) for item in kind.item_types]
        case VarTupleType() | ListType():
            return [least(kind.item_type)] * (kind.min_length or 0)
        case StructType():
            tag = {kind.tag_field: kind.tag} if kind.tag_field else {}
            return tag | {field.encode_name: least(field.type) for field in fields_of(kind) if field.required}
        case UnionType():
            return least(next(other for other in kind.types if not isinstance(other, NoneType)))
        case DictType() | RawType():
            return {}
    raise AssertionError(kind)


def ends(kind):
    """Least and greatest number of a type."""
    if isinstance(kind, IntType):
        low = kind.ge if kind.ge is not None else -(2**63) if kind.gt is None else kind.gt + 1
        return low, kind.le if kind.le is not None else 2**63 - 1 if kind.lt is None else kind.lt - 1
    low = kind.ge if kind.ge is not None else -sys.float_info.max if kind.gt is None else math.nextafter(kind.gt, math.inf)
    return float(low), float(
        kind.le if kind.le is not None else sys.float_info.max if kind.lt is None else math.nextafter(kind.lt, -math.inf)
    )


def beyond(kind):
    """Numbers just beyond the range of a type, where it has an end."""
    low, high = ends(kind)
    if isinstance(kind, IntType):
        return [low - 1, high + 1]
    outside = [math.nextafter(low, -math.inf), math.nextafter(high, math.inf)]
    return [number for number in outside if math.isfinite(number)]


def numbers_of(kind, value):
    """Every number in a table of this type: its path, its type, and a function that gives the table with another number there.

    Parameters
    ----------
    value : object
        A valid table, as read; None: there is none, and one with what is required is made up.
    """
    match kind:
        case FloatType() | IntType():
            yield (), kind, lambda number: number
        case UnionType():
            others = [other for other in kind.types if not isinstance(other, NoneType)]
            for other in others:
                tagged = isinstance(other, StructType) and other.tag_field
                mine = not tagged or (isinstance(value, dict) and value.get(other.tag_field) == other.tag)
                yield from numbers_of(other, value if mine else None)
        case StructType():
            table = value if isinstance(value, dict) else least(kind)
            for field in fields_of(kind):
                name = field.encode_name
                for path, number, made in numbers_of(field.type, table.get(name)):
                    yield (name, *path), number, lambda n, table=table, name=name, made=made: table | {name: made(n)}
        case VarTupleType() | ListType():
            items = value if isinstance(value, list) and value else [least(kind.item_type)] * max(kind.min_length or 0, 1)
            for path, number, made in numbers_of(kind.item_type, items[0]):
                yield (0, *path), number, lambda n, items=items, made=made: [made(n), *items[1:]]
        case TupleType():
            items = value if isinstance(value, list) else least(kind)
            for at, item in enumerate(kind.item_types):
                for path, number, made in numbers_of(item, items[at]):
                    yield (at, *path), number, lambda n, items=items, at=at, made=made: [*items[:at], made(n), *items[at + 1 :]]
        case DictType():
            for path, number, made in numbers_of(kind.value_type, None):
                yield ("own", *path), number, lambda n, made=made: {**(value or {}), "own": made(n)}
