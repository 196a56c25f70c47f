"""Every number of board.toml at the ends of its range, and just beyond: a board, a refusal by a relation, or one line."""

import math

from device.board.numbers_of import BEYOND_ALL, beyond, ends, numbers_of
from tables import each_row

from controller.device.board.board import as_board, board_file
from controller.device.board.descriptions import described, type_info, unit_of
from controller.device.board.lookup import find_board
from controller.device.board.plate.plate import OF_LAYERS
from controller.device.board.records import Record, read_tables
from controller.device.board.relations.checked import RELATIONS, judge
from controller.device.board.touch_panels import touch_records
from controller.device.board.validation import dotted
from controller.errors import ConfigError

TABLES = read_tables(find_board("ulx3s") / "board.toml")
LAYER = {"thickness_mm": 0.4, "young_modulus_pa": 70e9, "poisson_ratio": 0.23, "density_kg_m3": 2500}
LAYERED = TABLES | {
    "plate": {key: value for key, value in TABLES["plate"].items() if key not in OF_LAYERS}
    | {"layers": [LAYER, {**LAYER, "thickness_mm": 0.1}], "theory": "mindlin"}
}
NUMBERS = {
    f"{dotted(path)} of {at}": (path, kind, made)
    for at, (path, kind, made) in enumerate(
        [
            *numbers_of(type_info(board_file(touch_records())), TABLES),
            *(
                found
                for found in numbers_of(type_info(board_file(touch_records())), LAYERED)
                if found[0][:2] == ("plate", "layers")
            ),
        ]
    )
}


def board_or_refusal(tables):
    """A board of tables, or the line that says why there is none."""
    try:
        return as_board("", tables)
    except ConfigError as error:
        said = str(error)
    assert "\n" not in said
    return said


def properties(record):
    """What a record derives from its keys; raises where it cannot."""
    for name in dir(type(record)):
        if isinstance(getattr(type(record), name), property):
            value = getattr(record, name)
            assert not isinstance(value, float) or not math.isnan(value), name
    for name in record.__struct_fields__:
        value = getattr(record, name)
        for one in value if isinstance(value, tuple) else (value,):
            if isinstance(one, Record):
                properties(one)


def key_unit(path):
    return unit_of(next(part for part in reversed(path) if isinstance(part, str)))


@each_row("called", NUMBERS)
def test_the_ends_of_a_range_make_a_board_or_break_a_relation(called):
    path, kind, made = NUMBERS[called]
    for number in ends(kind):
        board = board_or_refusal(made(number))
        if isinstance(board, str):  # what other keys of the same table do not allow
            assert f"must be {described(kind, key_unit(path))}" not in board, number
            continue
        said = judge(board)
        assert not any("\n" in line or "nan" in line.lower().split() for line in (*said.refused, *said.odd)), said
        if not said.refused:
            properties(board)
            board.digest()


@each_row("called", NUMBERS)
def test_beyond_its_range_a_number_is_refused_in_a_line_with_key_value_and_range(called):
    path, kind, made = NUMBERS[called]
    for number in beyond(kind):
        said = board_or_refusal(made(number))
        assert f"{dotted(path)} = {number!r}: must be " in said
        assert described(kind, key_unit(path)) in said
    for number in BEYOND_ALL:
        assert f"{dotted(path)} = {number}: must be a finite number" in board_or_refusal(made(number))
    for number in (10**30, -(10**30), 10**400):
        board_or_refusal(made(number))


def test_there_are_as_many_numbers_as_relations_to_break():
    assert len(NUMBERS) > 150
    assert len(RELATIONS) > 30
