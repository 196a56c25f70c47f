"""Every refusal of a file or message names the key, the value found, what is valid there, and the nearest valid name."""

import copy
import re
import tomllib

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.application_socket.protocol.client_messages import AnyRequest
from controller.device.board.board import board_file
from controller.device.board.lookup import find_board
from controller.device.board.records import as_record
from controller.device.board.touch_panels import touch_records
from controller.device.board.validation import explain
from controller.device.scene.scene_tables import SceneTable
from controller.errors import ConfigError

BOARD_FILE = board_file(touch_records())
BOARD = tomllib.loads((find_board("ulx3s") / "board.toml").read_text())
SCENE = tomllib.loads((find_board("simulated") / "scene.toml").read_text())
ANYTHING = st.one_of(
    st.none(), st.booleans(), st.integers(-5, 5), st.floats(), st.text(max_size=5), st.lists(st.integers(), max_size=3), st.just({})
)


def refused(tables, kind=BOARD_FILE):
    with pytest.raises(msgspec.ValidationError) as caught:
        msgspec.convert(tables, kind)
    return explain(str(caught.value), tables, kind)


def changed(tables, *path, to):
    """A copy with one value changed; None as `to` removes it."""
    found = copy.deepcopy(tables)
    *way, last = path
    place = found
    for part in way:
        place = place[part]
    if to is None:
        del place[last]
    else:
        place[last] = to
    return found


SUPPORTS = "'clamped', 'foam', 'free', 'simply_supported'"
SIDES = {"x0": "free", "x1": "clamped", "y0": "free", "y1": "simply_supported"}
PANELS = ", ".join(repr(panel.__struct_config__.tag) for panel in touch_records())


@each_row(
    ("path", "to", "said"),
    [
        (("touch", "lag_ms"), 300.0, "touch.lag_ms = 300.0: must be a number from 0 to 200 ms"),
        (("touch", "lagms"), 1.0, "touch.lagms = 1.0: unknown key; did you mean lag_ms?"),
        (("touch", "kind"), "gt912", f"touch.kind = 'gt912': must be one of {PANELS}; did you mean gt911?"),
        (("touch", "kind"), "cst999", f"touch.kind = 'cst999': must be one of {PANELS}"),
        (("touch", "kind"), 3, f"touch.kind = 3: must be one of {PANELS}"),
        (("touch", "kind"), None, f"touch.kind is missing: one of {PANELS}"),
        (("link", "kind"), "spy", "link.kind = 'spy': must be one of 'serial', 'simulated', 'spi'; did you mean spi?"),
        (("link", "slots"), 17, "link.slots = 17: must be a whole number from 1 to 16"),
        (("link", "slots"), 1.5, "link.slots = 1.5: must be a whole number from 1 to 16"),
        (("link", "baud"), 1, "link.baud = 1: must be a whole number from 9600 to 12000000"),
        (("link", "clock_hz"), 1, "link.clock_hz = 1: must be a whole number from 1000000 to 400000000 Hz"),
        (("plate", "edge"), "simply_supported", "plate.edge = 'simply_supported': unknown key; did you mean edges?"),
        (("plate", "edges"), "fre", f"plate.edges = 'fre': must be one of {SUPPORTS} or a table; did you mean free?"),
        (("plate", "edges"), {"x0": "free"}, f"plate.edges.x1 is missing: one of {SUPPORTS}"),
        (("plate", "edges"), SIDES | {"y1": "f"}, f"plate.edges.y1 = 'f': must be one of {SUPPORTS}"),
        (("plate", "edges"), SIDES | {"y2": "free"}, "plate.edges.y2 = 'free': unknown key; there are: x0, x1, y0, y1"),
        (
            ("plate", "edges"),
            SIDES | {"y1": "foam"},
            'plate: foam is missing: an edge is "foam", so give [plate.foam] with stiffness',
        ),
        (("plate", "foam"), {"width_mm": 9.0}, "plate.foam.stiffness_n_m3 is missing: a number from 100000 to 100000000000 N/m³"),
        (("plate", "foam"), {"stiffness_n_m3": 1e9, "width_mm": 0}, "plate.foam.width_mm = 0: must be a number from 0.5 to 500 mm"),
        (("plate", "xyz"), 1, "plate.xyz = 1: unknown key; there are: length_mm, width_mm, thickness_mm, "),
        (("plate", "thickness_mm"), None, "plate.thickness_mm is missing: a number from 0.05 to 20 mm"),
        (("plate", "poisson_ratio"), 0.5, "plate.poisson_ratio = 0.5: must be a number at least 0, below 0.5"),
        (("plate", "density_kg_m3"), 1, "plate.density_kg_m3 = 1: must be a number from 100 to 25000 kg/m³"),
        (("driver", "moment_n_per_v"), 2, "driver.moment_n_per_v = 2: must be a number from 1e-06 to 1 N/V"),
        (("driver", "supply_v"), 61, "driver.supply_v = 61: must be a number above 0, at most 60 V"),
        (("actuators", 3, "channel"), 128, "actuators[3].channel = 128: must be a whole number from 0 to 127"),
        (("actuators", 3, "x_mm"), "left", "actuators[3].x_mm = 'left': must be a number from -1000 to 5000 mm"),
        (
            ("touch", "x_mm_from_axes"),
            [1.0],
            "touch.x_mm_from_axes: must be a list of 3 values, each a number from -100000 to 100000 mm",
        ),
        (("touch", "x_mm_from_axes", 1), "a", "touch.x_mm_from_axes[1] = 'a': must be a number from -100000 to 100000 mm"),
        (("plate",), [], "plate: must be a table"),
        (("plate",), None, "plate is missing: a table"),
        (("realtime",), {"lock_memory": 1}, "realtime.lock_memory = 1: must be true or false"),
        (("application_socket",), {"path": ""}, "application_socket.path = '': must be a text of at least 1 character"),
        (("folder",), "elsewhere", "folder = 'elsewhere': unknown key"),
        (("name",), "x" * 200, f"name = '{'x' * 59}…: must be a text that matches "),
    ],
)
def test_a_board_is_refused_in_words(path, to, said):
    found = refused(changed(BOARD, *path, to=to))
    assert found.startswith(said)
    assert "`" not in found, "nothing of the library's own words"


@each_row(
    ("path", "to", "said"),
    [
        (("regions",), [], "regions: must be a list of at least 1"),
        (("regions",), None, "regions is missing: a list of at least 1"),
        (
            ("regions", 0, "shape"),
            "rectangel",
            "regions[0].shape = 'rectangel': must be one of 'rectangle', 'circle', 'polygon', 'plate'; did you mean rectangle?",
        ),
        (("regions", 0, "polcy"), "compose", "regions[0].polcy = 'compose': unknown key; did you mean policy?"),
        (("regions", 0, "policy"), "alone", "regions[0].policy = 'alone': must be one of 'alternate', 'compose'"),
        (("regions", 0, "amplitude"), 2, "regions[0].amplitude = 2: must be a number from 0.1 to 1"),
        (("regions", 0, "effects"), [{"when": "pres"}], "regions[0].effects[0].when = 'pres': must be one of 'always', 'command',"),
        (("regions", 0, "effects"), [{"when": ["pres"]}], "regions[0].effects[0].when[0] = 'pres': must be one of 'always', "),
        (("regions", 0, "effects"), [3], "regions[0].effects[0] = 3: must be a text or a table"),
        (("regions", 0, "effects"), [{"rate_hz": 0}], "regions[0].effects[0].rate_hz = 0: must be a number from 0.1 to 1000 Hz"),
        (("regions", 0, "effects"), [{"envelope": [[1]]}], "regions[0].effects[0].envelope[0]: must be a list of 2 values"),
        (("effects",), {"": {}}, "effects: a name in it must be a text of 1 to 64 characters"),
    ],
)
def test_a_scene_is_refused_in_words(path, to, said):
    found = refused(changed(SCENE, *path, to=to), SceneTable)
    assert found.startswith(said)
    assert "`" not in found


def test_of_a_misspelt_value_among_several_kinds_the_nearest_is_named():
    found = refused(changed(SCENE, "regions", 0, "effects", to=[{"when": "pres"}]), SceneTable)
    assert found.endswith("; did you mean press?")


def places(value, path=()):
    """Every key and index below."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from places(inner, (*path, key))


@given(st.sampled_from([(BOARD, BOARD_FILE), (SCENE, SceneTable)]), st.data())
def test_whatever_stands_somewhere_is_taken_or_refused_in_one_line_with_its_key(tables_and_kind, data):
    tables, kind = tables_and_kind
    path = data.draw(st.sampled_from(list(places(tables))))
    if data.draw(st.booleans()):  # another key in its place
        path = (*path[:-1], data.draw(st.text(st.characters(codec="utf-8"), min_size=1))) if isinstance(path[-1], str) else path
    wrong = changed(tables, *path, to=data.draw(ANYTHING.filter(lambda value: value is not None)))
    refusal = "file: one line"
    try:
        as_record("file: ", wrong, kind)
    except ConfigError as error:
        refusal = str(error)
    assert refusal.startswith("file: ")
    assert "\n" not in refusal


POLYGON = next(index for index, region in enumerate(SCENE["regions"]) if region["shape"] == "polygon")
LENGTHS = [
    *((SCENE, SceneTable, ("regions", POLYGON, "corners_mm", 1, axis)) for axis in (0, 1)),
    *((SCENE, SceneTable, ("regions", 0, key)) for key in ("x_mm", "y_mm", "width_mm", "height_mm")),
    *((BOARD, BOARD_FILE, ("actuators", 0, key)) for key in ("x_mm", "y_mm", "size_mm")),
    (BOARD, BOARD_FILE, ("waveform", "duration_ms")),
    *((BOARD, BOARD_FILE, ("touch", f"{axis}_mm_from_axes", 2)) for axis in "xy"),
]


@each_row("value", [1.8e308, 1e300, -1e300, 1e154, 10**400, float("nan"), float("inf"), -float("inf")])
@each_row(("tables", "kind", "path"), LENGTHS, ids=lambda value: ".".join(map(str, value)) if type(value) is tuple else "")
def test_a_length_that_no_plate_has_is_refused_with_its_key(tables, kind, path, value):
    with pytest.raises(ConfigError) as caught:
        as_record("file: ", changed(tables, *path, to=value), kind)
    shown = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)[1:]
    assert str(caught.value).startswith(f"file: {shown} = ")
    assert "\n" not in str(caught.value)


MESSAGES = [
    {"kind": "play", "effect": "click", "x_mm": 1.0, "y_mm": 2.0, "amplitude": 0.5, "id": 1},
    {"kind": "subscribe", "to": ["touches", "state"], "id": "a"},
    {"kind": "load_scene", "name": "drums", "id": None},
    {"kind": "save_scene", "name": "mine", "toml": "a = 1", "id": 2},
]


@given(st.sampled_from(MESSAGES), st.data())
def test_whatever_a_message_holds_is_taken_or_refused_in_one_line_without_the_librarys_words(message, data):
    path = data.draw(st.sampled_from(list(places(message))))
    if isinstance(path[-1], str) and data.draw(st.booleans()):
        path = (*path[:-1], data.draw(st.text(st.characters(codec="utf-8"), min_size=1)))
    wrong = changed(message, *path, to=data.draw(ANYTHING.filter(lambda value: value is not None)))
    try:
        msgspec.convert(wrong, AnyRequest)
    except msgspec.ValidationError as error:
        said = explain(str(error), wrong, AnyRequest)
        assert "\n" not in said
        assert re.search(r": (must be|unknown key)| is missing", said)
        assert "`" not in said or "`" in str(wrong)


@given(st.text(max_size=10_000))
def test_any_message_at_all_is_translated_to_one(message):
    assert isinstance(explain(message, {"kind": "play"}, AnyRequest), str)


def test_strips_of_foam_leave_plate_between_them():
    foam = {"stiffness_n_m3": 1e9, "width_mm": 74.0}
    one = changed(changed(BOARD, "plate", "edges", to=SIDES | {"y1": "foam"}), "plate", "foam", to=foam)
    assert msgspec.convert(one, BOARD_FILE).plate.sides.y1 == "foam"
    assert refused(changed(one, "plate", "edges", to="foam")) == "plate: foam.width_mm = 74 leaves nothing of width_mm = 148 free"
