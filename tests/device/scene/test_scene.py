"""A scene that is ready to play: regions found, fixed emitters, the way to another process."""

import msgspec
import pytest
from device.scene.scenes import ALWAYS, BOARD, LIBRARY_SCENE, TEXTURE, TRAIN, at, press_scene, square, touch
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.scene.coverage import cells_needed
from controller.device.scene.emission import emitter_emission
from controller.device.scene.region_lookup import OUTSIDE
from controller.device.scene.scene import FixedEmitter, Scene, load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.scene.shapes import Circle, Polygon, Rectangle
from controller.device.service.scenes.scene_message import pack_scene, unpack_scene
from controller.errors import ConfigError


def test_fixed_emitters_are_at_the_centre_or_where_placed(scene_of):
    reported = '{ effect = "always", rate_hz = 30, x_mm = 20, y_mm = 30 }'
    circle = f'name = "c"\nshape = "circle"\nx_mm = 150\ny_mm = 70\nradius_mm = 9\neffects = [{ALWAYS}]'
    corners = "[[10, 10], [40, 10], [40, 40]]"
    triangle = f'name = "t"\nshape = "polygon"\ncorners_mm = {corners}\neffects = [{ALWAYS}]'
    plate = f'name = "p"\nshape = "plate"\neffects = [{reported}]'
    emitters = scene_of(square(ALWAYS), circle, triangle, plate).emitters
    assert [FixedEmitter(round(s.x_m, 9), round(s.y_m, 9), s.rate_hz, s.region) for s in emitters] == [
        FixedEmitter(0.070, 0.070, 20, "square"),
        FixedEmitter(0.150, 0.070, 20, "c"),
        FixedEmitter(0.030, 0.020, 20, "t"),
        FixedEmitter(0.020, 0.030, 30, "p"),
    ]


def test_a_spots_pulses_are_its_period_apart_from_its_phase_on(scene_of):
    (emitter,) = scene_of(square(ALWAYS.replace("20", "20, phase = 0.5"))).emitters
    first, fourth = (emitter_emission(emitter, 2.0, pulse) for pulse in (0, 3))
    assert (first.time_s, fourth.time_s) == (pytest.approx(2.025), pytest.approx(2.175))
    assert (fourth.pulse, fourth.period_s, fourth.owner, fourth.finger) == (3, 0.05, "square", None)


def test_a_scene_is_not_changed_and_can_be_handed_to_another_process(scene_of):
    scene = scene_of(square(f"{TRAIN}, {TEXTURE}"), square(ALWAYS, "spot", 100))
    copy = unpack_scene(pack_scene(scene))
    assert copy == scene
    assert touch(copy, at(60), at(66))[0] == touch(scene, at(60), at(66))[0]
    assert copy == scene
    with pytest.raises(AttributeError):
        scene.regions[0].name = "other"


def test_the_longest_rhythm_can_be_handed_to_another_process_and_a_longer_one_is_refused(scene_of):
    for count in (4000, 4001):
        rhythm = f'{{ when = "press", pulses = {[[10.0 * k, 1.0] for k in range(count)]} }}'
        if count == 4000:
            scene = scene_of(square(rhythm))
            assert unpack_scene(pack_scene(scene)) == scene
        else:
            with pytest.raises(ConfigError, match="pulses"):
                scene_of(square(rhythm))


@each_row(("length_mm", "width_mm"), [(20.0, 20.0), (20.0, 4000.0), (4000.0, 20.0), (4000.0, 4000.0)])
def test_a_scene_up_to_the_edge_of_the_largest_and_smallest_plate_can_be_handed_to_another_process(scene_of, length_mm, width_mm):
    plate = msgspec.structs.replace(BOARD.plate, length_mm=length_mm, width_mm=width_mm)
    board = msgspec.structs.replace(BOARD, plate=plate)
    x_mm, y_mm, radius_mm = length_mm / 3, width_mm / 3, min(length_mm, width_mm) / 2
    for shape in (
        'shape = "plate"',
        f'shape = "rectangle"\nx_mm = 0\ny_mm = 0\nwidth_mm = {length_mm}\nheight_mm = {width_mm}',
        f'shape = "rectangle"\nx_mm = {x_mm}\ny_mm = {y_mm}\nwidth_mm = {length_mm - x_mm}\nheight_mm = {width_mm - y_mm}',
        f'shape = "circle"\nx_mm = {length_mm / 2}\ny_mm = {width_mm / 2}\nradius_mm = {radius_mm}',
        f'shape = "polygon"\ncorners_mm = [[0, 0], [{length_mm}, 0], [{length_mm}, {width_mm}]]',
    ):
        grid = '{ effect = "texture", spacing_mm = 5, along = "x" }'
        scene = scene_of(f'name = "region"\n{shape}\neffects = ["click", {grid}]', board=board)
        assert unpack_scene(pack_scene(scene)) == scene


@given(st.floats(-0.01, 0.22), st.floats(-0.01, 0.16))
def test_a_region_is_found_as_by_asking_one_after_the_other(x_m, y_m):
    for scene in (LIBRARY_SCENE, Scene(LIBRARY_SCENE.regions[:-1]), Scene(())):
        asked = [index for index, region in enumerate(scene.regions) if region.shape.contains(x_m, y_m)]
        assert scene.lookup.at(x_m, y_m) == (asked[0] if asked else OUTSIDE)


@pytest.mark.parametrize("side", [1e-20, 1e-300])
def test_a_region_without_width_in_floating_point_is_a_scene_nevertheless(scene_of, side):
    scene = scene_of(
        f'name = "thin"\nshape = "rectangle"\nx_mm = 50\ny_mm = 50\nwidth_mm = {side}\nheight_mm = {side}\neffects = ["click"]'
    )
    assert (scene.lookup.at(0.05, 0.05), scene.lookup.at(0.06, 0.05)) == (0, OUTSIDE)
    assert unpack_scene(pack_scene(scene)) == scene


def test_the_far_rim_belongs_to_a_scene():
    shape = Rectangle(0.1, 0.05, 0.21, 0.148)
    assert [press_scene(shape).lookup.at(x, y) for x, y in ((0.21, 0.148), (0.1, 0.05), (0.21, 0.05), (0.0999, 0.05))] == [
        0,
        0,
        0,
        OUTSIDE,
    ]


def test_the_demo_shows_every_kind_of_region():
    scene = load_scene(find_scene(BOARD, BOARD.scene), BOARD)
    assert {type(region.shape) for region in scene.regions} == {Rectangle, Circle, Polygon}
    assert scene.regions[-1].shape == Rectangle(0, 0, BOARD.plate.length_m, BOARD.plate.width_m)
    assert [emitter.region for emitter in scene.emitters] == ["beacon"]
    grid = Grid.of(BOARD.plate, 5e-3)
    assert cells_needed(scene, grid.points(), grid.pitch_m).all()
