"""A scene that is ready to play: regions found, spots, the way to another process."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scene.scenes import ALWAYS, BOARD, LIBRARY_SCENE, TEXTURE, TRAIN, at, press_scene, square, touch

from controller.bank.grid import Grid
from controller.scene.coverage import cells_needed
from controller.scene.emission import spot_emission
from controller.scene.region_lookup import OUTSIDE
from controller.scene.scene import Scene, Spot, load_scene
from controller.scene.scene_file import find_scene
from controller.scene.shapes import Circle, Polygon, Rectangle
from controller.service.scene_message import pack_scene, unpack_scene


def test_spots_are_at_the_centre_or_where_told(scene_of):
    told = '{ effect = "always", rate_hz = 30, x_mm = 20, y_mm = 30 }'
    circle = f'name = "c"\nshape = "circle"\nx_mm = 150\ny_mm = 70\nradius_mm = 9\neffects = [{ALWAYS}]'
    corners = "[[10, 10], [40, 10], [40, 40]]"
    triangle = f'name = "t"\nshape = "polygon"\ncorners_mm = {corners}\neffects = [{ALWAYS}]'
    plate = f'name = "p"\nshape = "plate"\neffects = [{told}]'
    spots = scene_of(square(ALWAYS), circle, triangle, plate).spots
    assert [Spot(round(s.x_m, 9), round(s.y_m, 9), s.rate_hz, s.region) for s in spots] == [
        Spot(0.070, 0.070, 20, "square"),
        Spot(0.150, 0.070, 20, "c"),
        Spot(0.030, 0.020, 20, "t"),
        Spot(0.020, 0.030, 30, "p"),
    ]


def test_a_spots_beats_are_its_period_apart_from_its_phase_on(scene_of):
    (spot,) = scene_of(square(ALWAYS.replace("20", "20, phase = 0.5"))).spots
    first, fourth = (spot_emission(spot, 2.0, beat) for beat in (0, 3))
    assert (first.time_s, fourth.time_s) == (pytest.approx(2.025), pytest.approx(2.175))
    assert (fourth.beat, fourth.period_s, fourth.owner, fourth.finger) == (3, 0.05, "square", None)


def test_a_scene_is_not_changed_and_can_be_handed_to_another_process(scene_of):
    scene = scene_of(square(f"{TRAIN}, {TEXTURE}"), square(ALWAYS, "spot", 100))
    copy = unpack_scene(pack_scene(scene))
    assert copy == scene
    assert touch(copy, at(60), at(66))[0] == touch(scene, at(60), at(66))[0]
    assert copy == scene
    with pytest.raises(AttributeError):
        scene.regions[0].name = "other"


@given(st.floats(-0.01, 0.22), st.floats(-0.01, 0.16))
def test_a_region_is_found_as_by_asking_one_after_the_other(x_m, y_m):
    for scene in (LIBRARY_SCENE, Scene(LIBRARY_SCENE.regions[:-1]), Scene(())):
        asked = [index for index, region in enumerate(scene.regions) if region.shape.contains(x_m, y_m)]
        assert scene.region_at(x_m, y_m) == (asked[0] if asked else OUTSIDE)


@pytest.mark.parametrize("side", [1e-20, 1e-300])
def test_a_region_without_width_in_floating_point_is_a_scene_nevertheless(scene_of, side):
    scene = scene_of(
        f'name = "thin"\nshape = "rectangle"\nx_mm = 50\ny_mm = 50\nwidth_mm = {side}\nheight_mm = {side}\neffects = ["click"]'
    )
    assert (scene.region_at(0.05, 0.05), scene.region_at(0.06, 0.05)) == (0, OUTSIDE)
    assert unpack_scene(pack_scene(scene)) == scene


def test_the_far_rim_belongs_to_a_scene():
    shape = Rectangle(0.1, 0.05, 0.21, 0.148)
    assert [press_scene(shape).region_at(x, y) for x, y in ((0.21, 0.148), (0.1, 0.05), (0.21, 0.05), (0.0999, 0.05))] == [
        0,
        0,
        0,
        OUTSIDE,
    ]


def test_the_demo_shows_every_kind_of_region():
    scene = load_scene(find_scene(BOARD, BOARD.scene), BOARD)
    assert {type(region.shape) for region in scene.regions} == {Rectangle, Circle, Polygon}
    assert scene.regions[-1].shape == Rectangle(0, 0, BOARD.plate.length_m, BOARD.plate.width_m)
    assert [spot.region for spot in scene.spots] == ["beacon"]
    grid = Grid.of(BOARD.plate, 5e-3)
    assert cells_needed(scene, grid.points(), grid.pitch_m).all()
