"""Reference and schemas of board.toml and scene.toml are made of the records; the shipped files satisfy the schemas."""

import copy
import json
import tomllib
from pathlib import Path
from typing import Annotated

import pytest
from msgspec import Meta
from tables import each_row

import controller.device.board
from controller.commands.board import NAMED
from controller.device.board.board import board_file
from controller.device.board.lookup import data_folder, find_board
from controller.device.board.records import Record
from controller.device.board.reference import attributes, reference, relations_reference, schema
from controller.device.board.relations.checked import RELATIONS
from controller.device.board.touch_panels import touch_records
from controller.device.scene.scene_tables import SceneTable

BOARD_FILE = board_file(touch_records())
BOARDS = data_folder("boards")
BOARD_FILES = sorted(BOARDS.glob("*/board.toml"))
SCENE_FILES = sorted(file for file in BOARDS.glob("simulated/*.toml") if "regions" in tomllib.loads(file.read_text()))


def test_the_committed_reference_is_that_of_the_records():
    """Else: `python -m controller.generate`."""
    committed = Path(controller.device.board.__file__).with_name("reference.md").read_text()
    parts = (reference("board.toml", BOARD_FILE), relations_reference(RELATIONS), reference("scene.toml", SceneTable, NAMED))
    assert committed == "\n".join(parts)


def test_the_reference_has_every_relation_with_what_comes_of_it():
    rows = [line for line in relations_reference(RELATIONS).splitlines() if line.startswith("| `")]
    assert len(rows) == len(RELATIONS)
    assert {row.rsplit("|", 2)[1].strip() for row in rows} == {"refused", "a warning"}
    heat = next(row for row in rows if "resistor_rating_w" in row)
    assert heat.endswith("| No resistor gets hotter than it may. | refused |")


@pytest.mark.parametrize(("name", "kind", "named"), [("board", BOARD_FILE, None), ("scene", SceneTable, NAMED)])
def test_the_committed_schemas_are_those_of_the_records(name, kind, named):
    """Else: `python -m controller.generate`."""
    assert json.loads((BOARDS / f"{name}.schema.json").read_text()) == schema(kind, named)


def validator_of(what):
    import jsonschema  # a second of each process that imports it

    return jsonschema.Draft202012Validator(what)


@each_row("file", [*BOARD_FILES, *SCENE_FILES], ids=lambda file: f"{file.parent.name}/{file.name}")
def test_shipped_files_hold_the_schema_and_a_misspelt_key_does_not(file):
    board = file.name == "board.toml"
    validator = validator_of(schema(BOARD_FILE) if board else schema(SceneTable, NAMED))
    tables = json.loads(json.dumps(tomllib.loads(file.read_text())))
    validator.validate(tables)
    wrong = copy.deepcopy(tables)
    wrong["plate" if board else "regions"] = tables["plate"] | {"lenght_mm": 1} if board else [tables["regions"][0] | {"nam": ""}]
    assert not validator.is_valid(wrong)
    assert not validator.is_valid(tables | {"folder": "elsewhere"}), "what the program sets is no key of the file"


def test_an_effect_of_a_scene_is_checked_by_the_schema():
    validator = validator_of(schema(SceneTable, NAMED))
    scene = {
        "regions": [{"shape": "plate", "name": "all", "effects": []}],
        "effects": {"soft": {"when": "press", "amplitude": 0.5}},
    }
    validator.validate(scene)
    assert not validator.is_valid(scene | {"effects": {"soft": {"when": "press", "amplitude": 5}}})


class Inner(Record, frozen=True):
    """A table within.

    Attributes:
    length_mm, width_mm: Extent, over two lines.
    """

    length_mm: Annotated[float, Meta(gt=0)]
    width_mm: float = 3.0


class Derived(Inner, frozen=True):
    """A table that says one key again.

    Attributes:
    width_mm: Across.
    """


class Outer(Record, frozen=True):
    """The file.

    Attributes:
    inner: Left out: there is none.
    """

    inner: Inner | None = None


class Undescribed(Record, frozen=True):
    """A table with a key that nobody has described."""

    key: int


def test_each_key_has_its_kind_range_unit_default_and_sentence():
    assert "| `length_mm` | a number above 0 mm | required | Extent, over two lines. |" in reference("file.toml", Outer)
    assert "| `width_mm` | a number in mm | 3 | Extent, over two lines. |" in reference("file.toml", Outer)
    assert "## [inner]\n\nA table within. Left out: there is none.\n" in reference("file.toml", Outer)
    assert attributes(Derived) == {"length_mm": "Extent, over two lines.", "width_mm": "Across."}


def test_a_key_without_a_sentence_is_an_error():
    with pytest.raises(ValueError, match="Undescribed does not describe key"):
        reference("file.toml", Undescribed)


def test_every_key_of_a_shipped_board_stands_in_the_reference():
    text = reference("board.toml", BOARD_FILE)
    for table in tomllib.loads((find_board("ulx3s") / "board.toml").read_text()).values():
        for entry in table if isinstance(table, list) else [table]:
            for key in entry if isinstance(entry, dict) else ():
                assert f"| `{key}` |" in text or key == "kind"
