"""Every number of scene.toml at the ends of its range, and just beyond, on the least and the largest plate.

Once in a file, once in a client's layer; what is accepted comes through the message to the loop.
"""

import msgspec
import pytest
from device.board.changed_board import changed
from device.board.numbers_of import BEYOND_ALL, beyond, ends, numbers_of
from tables import each_row

from controller.device.bank.reader import Bank
from controller.device.board.descriptions import described, type_info, unit_of
from controller.device.board.records import LONGEST_PLATE_MM, as_record
from controller.device.board.validation import dotted
from controller.device.loop.preparation import AcceptedLayer
from controller.device.scene.effects.effects import EffectTable
from controller.device.scene.layers import Placement
from controller.device.scene.scene import Scene, load_scene
from controller.device.scene.scene_tables import SceneTable
from controller.device.service.scenes.layer_helper import LayerChecker
from controller.device.service.scenes.layer_message import pack_refusal, unpack_layer
from controller.device.service.scenes.scene_message import pack_scene, unpack_scene
from controller.errors import ConfigError, ControllerError

CLICK = {"when": "press"}
TABLES = {
    "regions": [{"shape": "rectangle", "name": "a", "x_mm": 5, "y_mm": 5, "width_mm": 20, "height_mm": 20, "effects": ["own"]}]
}


def effects_with(name):
    """A table for an effect in which a number of this key can stand."""
    of = {
        "spacing_mm": {"when": "move"},
        "x_mm": {"when": "always", "rate_hz": 5, "y_mm": 10},
        "y_mm": {"when": "always", "rate_hz": 5, "x_mm": 10},
        "envelope": {"when": "press", "rate_hz": 50, "duration_ms": 100},
        "rate_envelope": {"when": "press", "duration_ms": 100},
        "count": {"when": "press", "rate_hz": 50},
        "duration_ms": {"when": "press", "rate_hz": 50},
        "phase": {"when": "press", "rate_hz": 50, "count": 3},
    }
    return of.get(name, CLICK)


def all_numbers():
    for path, kind, made in numbers_of(type_info(SceneTable), TABLES):
        yield path, kind, lambda number, made=made: made(number) | {"effects": {"own": CLICK}}
    for field in type_info(EffectTable).fields:
        name = field.encode_name
        for path, kind, made in numbers_of(field.type, None):
            yield (
                ("effects", "own", name, *path),
                kind,
                lambda number, name=name, made=made: TABLES | {"effects": {"own": effects_with(name) | {name: made(number)}}},
            )


NUMBERS = {f"{dotted(path)} of {at}": (path, kind, made) for at, (path, kind, made) in enumerate(all_numbers())}


def toml(value):
    """A value as TOML, whose tables here are all inline."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(toml, value)) + "]"
    return msgspec.json.encode(value).decode() if isinstance(value, str | bool) else repr(value)


@pytest.fixture(params=[None, LONGEST_PLATE_MM, 20])
def plate_of(request, board):
    sides = {} if request.param is None else {"plate__length_mm": request.param, "plate__width_mm": request.param}
    return changed(board, **sides)


@each_row("called", NUMBERS)
def test_the_ends_of_a_range_make_a_scene_that_can_be_loaded_again_or_name_another_key(called, plate_of, tmp_path):
    path, kind, made = NUMBERS[called]
    for number in ends(kind):
        file = tmp_path / "scene.toml"
        file.write_text("\n".join(f"{key} = {toml(value)}" for key, value in made(number).items()))
        try:
            scene = load_scene(file, plate_of)
        except ConfigError as error:
            assert f"must be {described(kind, unit_of(path[-1]))}" not in str(error), number  # noqa: PT017
            continue
        again = unpack_scene(pack_scene(scene))
        assert isinstance(again, Scene), again
        assert again.regions == scene.regions


@each_row("called", NUMBERS)
def test_beyond_its_range_a_number_is_refused_in_a_line_with_key_value_and_range(called):
    path, kind, made = NUMBERS[called]
    record, path = (EffectTable, path[2:]) if path[0] == "effects" else (SceneTable, path)
    valid = described(kind, unit_of(path[-1]))
    for number, must_be in [(number, valid) for number in beyond(kind)] + [(number, "a finite number") for number in BEYOND_ALL]:
        tables = made(number)
        with pytest.raises(ConfigError) as refusal:
            as_record("", tables["effects"]["own"] if record is EffectTable else tables, record)
        said = str(refusal.value)
        assert f"{dotted(path)} = {number!r}: must be " in said
        assert must_be in said
        assert "\n" not in said


@pytest.fixture(scope="module")
def checker(board, bank_file):
    with Bank.open(bank_file, board) as bank:
        yield LayerChecker(board, bank_file, bytes([1]) * bank.grid.cells)


@each_row("called", NUMBERS)
def test_a_layer_with_a_number_at_the_end_of_its_range_comes_through_or_is_a_refusal(called, checker):
    _, kind, made = NUMBERS[called]
    for number in (*ends(kind), *beyond(kind)):
        for placement in (Placement(), Placement(-10.0, 10.0, 20.0), Placement(10.0, -10.0, 0.05)):
            try:
                message = checker.answer(msgspec.json.encode({"kind": "regions", **made(number)}), placement)
            except ControllerError as error:
                message = pack_refusal(str(error))
            assert isinstance(unpack_layer(message), AcceptedLayer | str)
