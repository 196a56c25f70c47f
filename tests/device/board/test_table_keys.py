"""All keys of a file that are missing or unknown are named at once."""

import copy
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.board import board_file, load_board
from controller.device.board.lookup import find_board
from controller.device.board.records import DEPTH_MAX, as_record, load_toml
from controller.device.board.relations.checked import judge
from controller.device.board.table_keys import MOST, wrong_keys
from controller.device.board.touch_panels import touch_records
from controller.device.scene.scene_tables import SceneTable
from controller.errors import ConfigError

BOARD_FILE = board_file(touch_records())
BOARD = tomllib.loads((find_board("ulx3s") / "board.toml").read_text())
SCENE = tomllib.loads((find_board("simulated") / "scene.toml").read_text())


def without(tables, *names):
    """Copies of the tables without these keys, of their own or, `table.key`, of a table in them."""
    return {
        name: {key: inner for key, inner in value.items() if f"{name}.{key}" not in names} if isinstance(value, dict) else value
        for name, value in tables.items()
        if name not in names
    }


def test_a_valid_file_has_no_wrong_keys():
    assert wrong_keys(BOARD, BOARD_FILE) == []
    assert wrong_keys(SCENE, SceneTable) == []


def test_all_missing_keys_of_a_board_are_named_at_once():
    left_out = ["driver", "plate.thickness_mm", "plate.density_kg_m3", "limits.ramp_ms", "link.trigger_line", "touch.kind", "name"]
    with pytest.raises(ConfigError) as caught:
        as_record("board.toml: ", without(BOARD, *left_out), BOARD_FILE)
    said = str(caught.value)
    assert said.startswith("board.toml: ")
    assert "\n" not in said
    parts = said.removeprefix("board.toml: ").split("; ")
    assert sorted(part.partition(" is missing")[0] for part in parts) == sorted(left_out)
    assert "plate.thickness_mm is missing: a number from 0.05 to 20 mm" in parts
    assert "link.trigger_line is missing: a link of kind 'spi' needs it, such as 'GPIO25'" in parts


def test_an_empty_file_names_every_table(tmp_path):
    (tmp_path / "board.toml").write_text("")
    with pytest.raises(ConfigError) as caught:
        load_board(tmp_path)
    for name in ("name", "scene", "plate", "actuators", "driver", "waveform", "bank", "touch", "link", "limits"):
        assert f"{name} is missing" in str(caught.value)


def test_unknown_keys_are_named_beside_missing_ones():
    tables = without(BOARD, "waveform.duration_ms")
    tables["waveform"] |= {"duraton_ms": 2.0}
    tables["actuators"] = [{"chanel": 0, "x_mm": 1.0, "y_mm": 1.0, "size_mm": 1.0, "idle": 0}]
    with pytest.raises(ConfigError) as caught:
        as_record("", tables, BOARD_FILE)
    assert str(caught.value) == (
        "actuators[0].chanel = 0: unknown key; did you mean channel?; actuators[0].channel is missing: a whole number from 0 to"
        " 127; waveform.duraton_ms = 2.0: unknown key; did you mean duration_ms?;"
        " waveform.duration_ms is missing: a number above 0, at most 10 ms"
    )


def test_a_wrong_value_is_named_beside_missing_keys():
    tables = without(BOARD, "link.slots")
    tables["driver"] |= {"supply_v": 61.0}
    with pytest.raises(ConfigError) as caught:
        as_record("", tables, BOARD_FILE)
    assert str(caught.value) == (
        "driver.supply_v = 61.0: must be a number above 0, at most 60 V; link.slots is missing: a whole number from 1 to 16"
    )


def test_foam_and_layers_change_what_is_required():
    plate = BOARD["plate"]
    foam = BOARD | {"plate": plate | {"edges": {"x0": "foam", "x1": "free", "y0": "free", "y1": "free"}}}
    (said,) = wrong_keys(foam, BOARD_FILE)
    assert said == 'plate.foam is missing: an edge is "foam", so give [plate.foam] with stiffness_n_m3 and width_mm'
    material = {key: plate[key] for key in ("thickness_mm", "young_modulus_pa", "poisson_ratio", "density_kg_m3")}
    layered = BOARD | {"plate": {key: value for key, value in plate.items() if key not in material} | {"layers": [material]}}
    assert wrong_keys(layered, BOARD_FILE) == []


def test_regions_and_effects_of_a_scene_are_looked_into():
    scene = {"regions": [{"shape": "circle", "name": "a", "x_mm": 1.0}, {"name": "b", "effects": []}], "sounds": {}}
    assert wrong_keys(scene, SceneTable) == [
        "sounds: unknown key; there are: regions, effects",
        "regions[0].effects is missing: a list",
        "regions[0].y_mm is missing: a number from -1000 to 5000 mm",
        "regions[0].radius_mm is missing: a number above 0, at most 5000 mm",
        "regions[1].shape is missing: one of 'rectangle', 'circle', 'polygon', 'plate'",
    ]


def test_a_file_of_another_kind_names_some():
    many = BOARD | {f"key{number}": number for number in range(MOST + 5)}
    found = wrong_keys(many, BOARD_FILE)
    assert len(found) == MOST + 1
    assert found[-1] == "and 5 more"


@each_row("start", ["a", "touch.a", "actuators"])
def test_a_file_that_is_nested_without_end_is_refused_in_one_line(tmp_path, start):
    """Keys with points nest deeper than brackets: the parser does not recurse for them."""
    file = tmp_path / "board.toml"
    for deep in (DEPTH_MAX, 3000):
        file.write_text(".".join([start, *["a"] * deep]) + " = 1\n")
        with pytest.raises(ConfigError) as refused:
            load_toml(file, BOARD_FILE)
        known = f"{file}: {start.partition('.')[0]}: tables and lists are nested more than {DEPTH_MAX} deep"
        by_the_parser = f"{file}: not valid TOML: TOML key has more than the allowed 1000 parts"  # of newer versions of Python
        assert str(refused.value) in ((known,) if deep == DEPTH_MAX else (known, by_the_parser))


def places(value, path=()):
    """Every key and index below."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from places(inner, (*path, key))


PLACES = [path for path in places(BOARD) if path[0] != "actuators" or path[1:2] in ((), (0,))]
ANYTHING = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-5, 5),
    st.floats(),
    st.text(max_size=5),
    st.sampled_from([[], {}, [1.0], "spi", 1e9, 1e-9]),
)


@given(st.dictionaries(st.sampled_from(PLACES), ANYTHING, max_size=4))
def test_any_file_is_a_board_that_is_evaluated_or_refused_in_one_line(changes):
    """None takes a key away."""
    tables = without(BOARD)
    tables["actuators"] = [dict(table) for table in BOARD["actuators"]]
    for path, value in changes.items():
        place = tables
        for part in path[:-1]:
            place = (
                place[part]
                if isinstance(place, dict) and part in place
                else place[part]
                if isinstance(place, list) and place
                else {}
            )
        if isinstance(place, dict) and value is None:
            place.pop(path[-1], None)
        elif isinstance(place, dict):
            place[path[-1]] = copy.copy(value)  # of its own: one list or table in itself is no file
    try:
        board = as_record("file: ", tables, BOARD_FILE)
    except ConfigError as error:
        said = [str(error)]
        assert said[0].startswith("file: ")
    else:
        said = [line for lines in judge(board) for line in lines]
    assert all(line and "\n" not in line for line in said)
