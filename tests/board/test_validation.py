"""What is refused in a file is told with its key, what may stand there, and the nearest of what was meant."""

import copy
import tomllib

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.board.board import Board, find_board
from controller.board.records import as_record
from controller.board.validation import in_words
from controller.errors import ConfigError
from controller.scene.scene_file import SceneTable

BOARD = tomllib.loads((find_board("ulx3s") / "board.toml").read_text())
SCENE = tomllib.loads((find_board("simulated") / "scene.toml").read_text())
ANYTHING = st.one_of(
    st.none(), st.booleans(), st.integers(-5, 5), st.floats(), st.text(max_size=5), st.lists(st.integers(), max_size=3), st.just({})
)


def refused(tables, kind=Board):
    with pytest.raises(msgspec.ValidationError) as caught:
        msgspec.convert(tables, kind)
    return in_words(str(caught.value), tables, kind)


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


@pytest.mark.parametrize(
    ("path", "to", "said"),
    [
        (("touch", "lag_ms"), 300.0, "touch.lag_ms = 300.0: must be a number from 0 to 200"),
        (("touch", "lagms"), 1.0, "touch.lagms = 1.0: unknown key; did you mean lag_ms?"),
        (
            ("touch", "kind"),
            "gt912",
            "touch.kind = 'gt912': must be one of 'recording', 'linux_input', 'ft5x06', 'gt911', 'serial_panel'; did you mean",
        ),
        (("link", "slots"), 17, "link.slots = 17: must be a whole number from 1 to 16"),
        (("plate", "edge"), "free", "plate.edge = 'free': must be 'simply_supported'"),
        (("plate", "xyz"), 1, "plate.xyz = 1: unknown key; there are: length_mm, width_mm, thickness_mm, "),
        (("plate", "thickness_mm"), None, "plate.thickness_mm is missing: a number from 0.05 to 20"),
        (("actuators", 3, "channel"), 32, "actuators[3].channel = 32: must be a whole number from 0 to 31"),
        (("touch", "x_mm_from_axes"), [1.0], "touch.x_mm_from_axes: must be a list of 3 values, each a number"),
        (("plate",), [], "plate: must be a table"),
        (("folder",), "elsewhere", "folder = 'elsewhere': unknown key"),
        (("name",), "x" * 200, f"name = '{'x' * 59}…: must be a text that matches "),
    ],
)
def test_a_board_is_refused_in_words(path, to, said):
    found = refused(changed(BOARD, *path, to=to))
    assert found.startswith(said)
    assert "`" not in found, "nothing of the library's own words"


def test_a_scene_is_refused_in_words():
    found = refused(changed(SCENE, "regions", 0, "shape", to="rectangel"), SceneTable)
    assert found.startswith("regions[0].shape = 'rectangel': must be one of 'rectangle', 'circle', 'polygon', 'plate'")
    assert found.endswith("; did you mean rectangle?")
    assert refused(changed(SCENE, "regions", to=[]), SceneTable) == "regions: must be a list of at least 1"


def places(value, path=()):
    """Every key and index below."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from places(inner, (*path, key))


@given(st.sampled_from([(BOARD, Board), (SCENE, SceneTable)]), st.data())
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
    *((BOARD, Board, ("actuators", 0, key)) for key in ("x_mm", "y_mm", "size_mm")),
    (BOARD, Board, ("waveform", "duration_ms")),
    *((BOARD, Board, ("touch", f"{axis}_mm_from_axes", 2)) for axis in "xy"),
]


@pytest.mark.parametrize("value", [1.8e308, 1e300, -1e300, 1e154, 10**400, float("nan"), float("inf"), -float("inf")])
@pytest.mark.parametrize(
    ("tables", "kind", "path"), LENGTHS, ids=lambda value: ".".join(map(str, value)) if type(value) is tuple else ""
)
def test_a_length_that_no_plate_has_is_refused_with_its_key(tables, kind, path, value):
    with pytest.raises(ConfigError) as caught:
        as_record("file: ", changed(tables, *path, to=value), kind)
    shown = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)[1:]
    assert str(caught.value).startswith(f"file: {shown} = ")
    assert "\n" not in str(caught.value)
