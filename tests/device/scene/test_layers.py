"""Layers over a scene: which region counts, and what goes on under a finger whose layer is replaced or moved."""

import json
import math

import pytest
from device.scene.scenes import BOARD
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.scene.effects.trains import Train
from controller.device.scene.fingers import ActiveEffects
from controller.device.scene.layer_tables import REASON_CHARACTERS, off_plate, read_layer
from controller.device.scene.layers import UNMOVED, Layer, Placement
from controller.device.scene.region_lookup import OUTSIDE
from controller.device.scene.scene import Region, Scene, SpatialIndex
from controller.device.scene.shapes import Rectangle
from controller.errors import ConfigError


def rectangle(name="r", x_mm=50, size_mm=40, effects=("click",), **more):
    place = {"x_mm": x_mm, "y_mm": 50, "width_mm": size_mm, "height_mm": size_mm}
    return {"name": name, "shape": "rectangle", **place, "effects": list(effects), **more}


SINGLE, DOUBLE = Train(), Train(1.0, 2, 0.125)


def scene_of(name="scene", x_mm=0, size_mm=1, train=SINGLE):
    """A scene of one square."""
    sides = x_mm * 1e-3, 50e-3, (x_mm + size_mm) * 1e-3, (50 + size_mm) * 1e-3
    return Scene((Region(name, Rectangle(*sides), press=(train,)),), {"double": DOUBLE})


def read(*regions, effects=None):
    return read_layer(json.dumps({"regions": regions, "effects": effects or {}}).encode(), BOARD)


def layer(*regions, owner=1, placement=UNMOVED, effects=None):
    checked = read(*regions, effects=effects)
    assert not checked.refused
    return Layer(owner, checked.regions, SpatialIndex.of(checked.regions).lookup(checked.regions), placement)


def named(scene, x_mm, y_mm=60):
    index = scene.lookup.at(x_mm * 1e-3, y_mm * 1e-3)
    return None if index == OUTSIDE else scene.regions[index].name


def test_the_topmost_layer_counts_then_the_next_and_the_scene_last():
    scene = scene_of("scene", 0, 90)
    whole = scene.under((layer(rectangle("new", 60, 10), owner=2), layer(rectangle("first", 50, 30), rectangle("second", 40, 60))))
    assert [named(whole, x_mm) for x_mm in (65, 55, 75, 95, 45, 10, 150)] == [
        "new",
        "first",
        "first",
        "second",
        "second",
        "scene",
        None,
    ]
    assert scene.under(()) is scene
    assert whole.emitters == scene.emitters
    assert whole.effects is scene.effects


@given(st.floats(-50, 50), st.floats(-50, 50), st.sampled_from([0.05, 0.5, 1.0, 3.0, 20.0]), st.floats(0, 210), st.floats(0, 148))
def test_a_place_of_the_layer_lies_where_its_transform_says(x_mm, y_mm, scale, at_x_mm, at_y_mm):
    moved = scene_of().under((layer(rectangle("r", 20, 60), placement=Placement(x_mm * 1e-3, y_mm * 1e-3, scale)),))
    left, low = x_mm + 20 * scale, y_mm + 50 * scale
    edge = min(abs(at_x_mm - left), abs(at_x_mm - left - 60 * scale), abs(at_y_mm - low), abs(at_y_mm - low - 60 * scale))
    if edge > 1e-6:
        inside = left < at_x_mm < left + 60 * scale and low < at_y_mm < low + 60 * scale
        assert (named(moved, at_x_mm, at_y_mm) == "r") is inside


TRAIN = {"effect": "train", "rate_hz": 100, "duration_ms": 300}
GRID = {"effect": "detent", "spacing_mm": 10, "phase": 0.0}


def finger(scene, x_mm=60):
    return ActiveEffects(scene, 3, x_mm * 1e-3, 60e-3)


@pytest.fixture
def empty():
    return scene_of()


def test_a_train_goes_on_while_its_finger_stays_in_the_region_of_the_same_name(empty):
    active = finger(empty.under((layer(rectangle(effects=[TRAIN])),)))
    assert len(active.press(0.0)) == 1
    active.change_layers(empty.under((layer(rectangle("other", 0, 5), rectangle(effects=[TRAIN])),)))
    (pulse,) = active.advance(0.011)
    assert (pulse.region, pulse.pulse) == ("r", 1)
    active.change_layers(empty.under((layer(rectangle("another", effects=[TRAIN])),)))
    assert active.ended
    assert active.advance(1.0) == ()


@each_row(
    "after", [(), (layer(rectangle(x_mm=100, effects=[TRAIN])),), (layer(rectangle(effects=[TRAIN]), owner=2),)], afresh=[empty]
)
def test_a_train_ends_with_its_layer_or_where_its_region_has_moved_away_or_belongs_to_another(empty, after):
    active = finger(empty.under((layer(rectangle(effects=[TRAIN])),)))
    active.press(0.0)
    active.change_layers(empty.under(after))
    assert active.ended


def test_a_train_of_the_scene_goes_on_under_layers_and_is_covered_by_one(empty):
    scene = scene_of("below", 50, 40, Train(1.0, 30, 0.01))
    active = finger(scene)
    active.press(0.0)
    beside = scene.under((layer(rectangle("beside", 0, 10)),))
    active.change_layers(beside)
    assert [emission.region for emission in active.advance(0.011)] == ["below"]
    active.change_layers(scene.under((layer(rectangle("above")),)))
    assert active.ended


def test_a_change_of_layers_is_not_felt_but_the_next_move_is(empty):
    active = finger(empty)
    assert active.press(0.0) == ()
    active.change_layers(empty.under((layer(rectangle(effects=["edge"])),)))
    assert active.move(61e-3, 60e-3, 0.01) == ()
    (left,) = active.move(45e-3, 60e-3, 0.02)
    assert left.region == "r"


def crossings(active, places_mm):
    return [x_mm for x_mm in places_mm if active.move(x_mm * 1e-3, 60e-3, 0.0)]


def test_grid_lines_move_and_scale_with_their_layer(empty):
    lines = rectangle(effects=[GRID], size_mm=100)
    active = finger(empty.under((layer(lines),)), 52)
    active.press(0.0)
    assert crossings(active, [59, 61, 69]) == [61]
    active.change_layers(empty.under((layer(lines, placement=Placement(5e-3)),)))  # the line at 70 is at 75 now, that at 60 at 65
    assert crossings(active, [73, 74.5]) == []
    assert crossings(active, [76]) == [76]
    active.change_layers(empty.under((layer(lines, placement=Placement(-50e-3, -50e-3, 2.0)),)))  # every 20 mm, from 50 on
    assert crossings(active, [80, 89, 91, 109, 111]) == [91, 111]


def test_a_texture_is_felt_by_the_way_on_its_layer(empty):
    texture = rectangle(effects=[{"effect": "texture", "spacing_mm": 5}], size_mm=100)
    active = finger(empty.under((layer(texture),)), 60)
    active.press(0.0)
    assert crossings(active, [63]) == []
    active.change_layers(empty.under((layer(texture, placement=Placement(3e-3)),)))  # goes with the finger: 3 mm less to go
    active.move(66e-3, 60e-3, 0.0)
    assert crossings(active, [67.9]) == []
    assert crossings(active, [68.1]) == [68.1]
    active.move(72e-3, 60e-3, 0.0)
    active.change_layers(empty.under((layer(rectangle("other", 0, 5), texture),)))
    assert crossings(active, [73.2]) == [73.2], "of the layer by its number, which is another one now"


def test_a_command_at_a_point_goes_on_whatever_lies_on_top(empty):
    active = ActiveEffects(empty, "command 1", 60e-3, 60e-3)
    active.start("double", 1.0, 0.0, 1)
    active.change_layers(empty.under((layer(rectangle()),)))
    assert len(active.advance(0.2)) == 1
    assert active.region == OUTSIDE


REFUSED = [
    (rectangle(effects=["clik"]), "regions[1].effects[0] = 'clik' is no effect; known: "),
    (rectangle(effects=["always"]), 'regions[1].effects[0] has when = "always", which is for scenes'),
    (rectangle(effects=["notification"]), 'regions[1].effects[0] has when = "command"'),
    (rectangle(effects=[{"effect": "click", "amplitude": 0.05}]), "regions[1].effects[0]"),
    (rectangle(effects=[{"effect": "train", "rate_hz": 900}]), "regions[1].effects[0].rate_hz = 900 is above"),
    (rectangle("first"), "regions[1].name = 'first' is taken by regions[0] already"),
    (rectangle("within", 0, 5), "regions[1] ('within') is never felt: regions[0] ('first') covers it"),
    (rectangle(keep_armed=True), "regions[1].keep_armed = true is for scenes"),
    (rectangle(size_mm=-1), "regions[1].width_mm = -1: must be"),
    (rectangle(x_mm=1e6), "regions[1].x_mm = 1000000.0: must be"),
    ({"name": "r"}, "regions[1].shape is missing"),
    (rectangle(radius_mm=3), "regions[1].radius_mm = 3: unknown key"),
    (rectangle(shape="oval"), "regions[1].shape = 'oval': must be one of"),
    (
        {"name": "r", "shape": "polygon", "effects": [], "corners_mm": [[0, 0], [9, 9], [9, 0], [0, 9]]},
        "regions[1]: corners_mm: the edges",
    ),
    ({}, "regions[1]"),
]


@each_row(("region", "reason"), REFUSED)
def test_a_bad_region_is_refused_with_its_key_and_takes_no_other_along(region, reason):
    checked = read(rectangle("first", 0, 10), region, rectangle("last", 100, 10))
    assert [kept.name for kept in checked.regions] == ["first", "last"]
    assert checked.indices == (0, 2)
    (refused,) = checked.refused
    assert (refused.index, refused.name) == (1, region.get("name", ""))
    assert refused.reason.startswith(reason)
    assert len(refused.reason) <= REASON_CHARACTERS


@each_row(
    ("line", "reason"),
    [
        ({"regions": {}}, "Expected `array`"),
        ({"regions": [], "effects": {"a": {"when": "presss"}}}, "effects.a.when = 'presss': must be"),
        ({"regions": [], "effects": {"a": {"rate_hz": 5}}}, "effects.a.when is missing"),
        ({"regions": [3]}, "Expected `object`"),
    ],
)
def test_what_is_no_layer_is_refused_as_a_whole(line, reason):
    with pytest.raises(ConfigError) as refused:
        read_layer(json.dumps(line).encode(), BOARD)
    assert str(refused.value).startswith(reason)


def test_effects_of_the_message_build_on_those_of_the_library():
    checked = read(
        rectangle(effects=["soft", "softer"]),
        effects={"soft": {"effect": "click", "amplitude": 0.8}, "softer": {"effect": "soft", "amplitude": 0.5}},
    )
    assert [train.amplitude for train in checked.regions[0].press] == [0.8, 0.5]


def test_regions_that_have_their_effects_in_common_get_lines_of_their_own():
    checked = read(*(rectangle(f"r{at}", at, 10, effects=["detent"]) for at in (0, 20, 45)))
    assert [region.spacings[0].origin_m for region in checked.regions] == pytest.approx([5e-3, 25e-3, 50e-3])


def test_what_reaches_beyond_the_plate_is_taken_and_what_lies_off_it_is_counted():
    checked = read(rectangle("half", -20, 40), rectangle("off", -200, 40), rectangle("beyond", 300, 40))
    assert len(checked.regions) == 3
    assert off_plate(checked.regions, UNMOVED, BOARD) == 2
    assert off_plate(checked.regions, Placement(0.2), BOARD) == 1
    assert off_plate(checked.regions, Placement(0.0, 0.0, 0.05), BOARD) == 1


json_values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(10**6), 10**6)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=12,
)
keys = st.sampled_from(["name", "shape", "x_mm", "width_mm", "effects", "corners_mm", "policy", "nulled", "amplitude"])
spoilt = st.builds(lambda key, value: rectangle() | {key: value}, keys, json_values)


@settings(max_examples=300, deadline=None)
@given(st.lists(spoilt | st.dictionaries(st.text(max_size=8), json_values, max_size=4), max_size=4))
def test_whatever_is_sent_each_region_is_taken_or_refused(regions):
    checked = read(*regions)
    assert len(checked.regions) + len(checked.refused) == len(regions)
    assert sorted([*checked.indices, *(refused.index for refused in checked.refused)]) == list(range(len(regions)))
    assert all(math.isfinite(side) for region in checked.regions for side in region.shape.bounds)
