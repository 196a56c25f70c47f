"""Effects and regions as they stand in a file: what they mean, and what is refused with file, key and value."""

import re
import tomllib
from typing import get_args

import msgspec
import pytest
from device.scene.scenes import BOARD, CLICK, square
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.scene.effects.effects import EffectTable, When
from controller.device.scene.effects.library import LIBRARY, library
from controller.device.scene.effects.primitives import PRIMITIVES, conflict, primitive_of
from controller.device.scene.effects.trains import Train
from controller.device.scene.fingers import ActiveEffects
from controller.errors import ConfigError


@each_row(
    ("region", "words"),
    [
        ('name = "a"\nshape = "star"\neffects = []', "regions[0].shape = 'star'"),
        (square('{ effect = "boom" }'), "regions[0].effects[0].effect = 'boom'"),
        (square('{ effect = "click", loud = 1 }'), "regions[0].effects[0].loud = 1: unknown key"),
        (square(CLICK) + "\ncolour = 3", "regions[0].colour = 3: unknown key"),
        (square('{ effect = "train", rate_hz = "fast", duration_ms = 1 }'), "regions[0].effects[0].rate_hz = 'fast'"),
        (square('{ effect = "train", rate_hz = 0, duration_ms = 1 }'), "regions[0].effects[0].rate_hz = 0"),
        (square('{ effect = "train", rate_hz = nan, duration_ms = 1 }'), "regions[0].effects[0].rate_hz = nan"),
        (square('{ effect = "train", rate_hz = 505, duration_ms = 1 }'), "regions[0].effects[0].rate_hz = 505 is above 500"),
        (square('{ effect = "always", rate_hz = 505 }'), "regions[0].effects[0].rate_hz = 505 is above 500"),
        (square('{ effect = "always", rate_hz = 5, x_mm = 210.5 }'), "effects[0].x_mm = 210.5 is off the plate"),
        (square('{ effect = "always", rate_hz = 5, y_mm = 148.5 }'), "effects[0].y_mm = 148.5 is off the plate"),
        (square('{ effect = "always", rate_hz = 5, y_mm = -1 }'), "regions[0].effects[0].y_mm = -1"),
        (square('{ effect = "texture", spacing_mm = 0 }'), "regions[0].effects[0].spacing_mm = 0"),
        (square(f"{CLICK}, {CLICK}"), "this effect more than once: effects[0]"),
        (square(CLICK, "wide", 171), "regions[0] ('wide') reaches 1 mm beyond the plate of 210 × 148 mm"),
        (square(CLICK, "wide", -1), "regions[0] ('wide') reaches 1 mm beyond the plate"),
        (square(CLICK, "none", 50, -4), "regions[0].width_mm = -4"),
        (square(CLICK, ""), "regions[0].name = ''"),
        (square(CLICK) + "\n[[regions]]\n" + square(CLICK), "regions[1].name = 'square' is taken by regions[0]"),
        ('name = "a"\nshape = "circle"\nx_mm = 5\ny_mm = 9\nradius_mm = 6\neffects = []', "('a') reaches 1 mm beyond"),
        ('name = "a"\nshape = "circle"\nx_mm = 9\ny_mm = 5\nradius_mm = 6\neffects = []', "('a') reaches 1 mm beyond"),
        ('name = "a"\nshape = "circle"\nx_mm = 9\ny_mm = 143\nradius_mm = 6\neffects = []', "('a') reaches 1 mm beyond"),
        (f'name = "a"\nshape = "polygon"\ncorners_mm = [[1, 1], [9, 9], [9, 1]]\neffects = [{CLICK}, {CLICK}]', "more than once"),
        (f'name = "a"\nshape = "polygon"\ncorners_mm = {[[1, 1]] * 1001}\neffects = []', "regions[0].corners_mm"),
        ('name = "a"\nshape = "polygon"\ncorners_mm = [[1, 1], [2, 2]]\neffects = []', "regions[0].corners_mm"),
        ('name = "a"\nshape = "polygon"\ncorners_mm = [[1, 1], [2, 2], [3]]\neffects = []', "regions[0].corners_mm[2]"),
        (
            'name = "a"\nshape = "polygon"\ncorners_mm = [[1, 1], [9, 9], [9, 1], [1, 9]]\neffects = []',
            "regions[0]: corners_mm: the edges from [1.0, 1.0] and from [9.0, 1.0] cross or touch",
        ),
        ('name = "a"\nshape = "plate"', "effects"),
        ("", "shape"),
    ],
)
def test_a_scene_that_cannot_be_meant_is_refused_with_file_key_and_value(scene_of, region, words):
    with pytest.raises(ConfigError) as caught:
        scene_of(region)
    assert words in str(caught.value)
    assert str(caught.value).startswith(str(scene_of.file))


PRESS = 'when = "press"'
BUZZ = f"{PRESS}, rate_hz = 100"


@each_row(
    ("effect", "words"),
    [
        ("{}", ".when is missing"),
        ("{ spacing_mm = 3 }", ".when is missing"),
        ('{ when = "now" }', ".when = 'now'"),
        ('{ when = ["press", "press"] }', ".when = ['press', 'press'] has one of them twice"),
        (
            '{ when = ["press", "move"], spacing_mm = 3 }',
            ".when = ['press', 'move']: 'move' does not go with 'press': a single emission takes press, release, enter, ",
        ),
        ('{ when = "command" }', 'when = "command": an application plays it'),
        ('"boom"', f" = 'boom' is no effect; known: {', '.join(sorted(library()))}"),
        (f"{{ {PRESS}, amplitude = 0.09 }}", ".amplitude = 0.09"),
        (f"{{ {PRESS}, amplitude = 1.1 }}", ".amplitude = 1.1"),
        (
            f"{{ {BUZZ} }}",
            ": count or duration_ms is missing: one of them is needed for a train (rate_hz; count or duration_ms; when = ",
        ),
        (f"{{ {BUZZ}, count = 3, duration_ms = 30 }}", ": count = 3 and duration_ms = 30 exclude each other: give one of them"),
        (f"{{ {BUZZ}, count = 0 }}", ".count = 0"),
        (
            f"{{ {PRESS}, count = 3 }}",
            '.count = 3 does not go with when = "press", a single emission; it belongs to a train (rate_hz; ',
        ),
        (
            f"{{ {PRESS}, envelope = [[0, 1]] }}",
            '.envelope does not go with when = "press", a single emission; it belongs to a train',
        ),
        (f"{{ {PRESS}, phase = 0.5 }}", '.phase = 0.5 does not go with when = "press", a single emission; it belongs to a train ('),
        (f"{{ {BUZZ}, count = 3, phase = 1 }}", ".phase = 1"),
        (f"{{ {BUZZ}, duration_ms = 4, phase = 0.5 }}", ".phase = 0.5 leaves no emission within duration_ms = 4"),
        (f"{{ {BUZZ}, duration_ms = 1e-9 }}", ".duration_ms = 1e-09 is too short for an emission"),
        (
            '{ when = "release", rate_hz = 100, count = 3 }',
            '.rate_hz = 100 does not go with when = "release", a single emission',
        ),
        ('{ when = "release", phase = 0.5 }', '.phase = 0.5 does not go with when = "release", a single emission'),
        ('{ when = ["release", "leave"], rate_hz = 100, count = 3 }', '.rate_hz = 100 does not go with when = "release"'),
        (
            '{ when = ["leave", "release"], rate_hz = 100, count = 3 }',
            "'release' does not go with 'leave': a train takes press, enter, lea",
        ),
        (
            f"{{ {PRESS}, spacing_mm = 3 }}",
            '.spacing_mm = 3 does not go with when = "press", a single emission; it belongs to a grid of lines (',
        ),
        (
            f'{{ {PRESS}, along = "x" }}',
            ".along = 'x' does not go with when = \"press\", a single emission; it belongs to a grid of lines (spacing_mm",
        ),
        (f'{{ {PRESS}, along = "path" }}', ".along = 'path' does not go with"),
        ('{ when = "move" }', ".spacing_mm is missing: it is needed for a spacing along the path (spacing_mm; when = move)"),
        (
            '{ when = "move", along = "x" }',
            ".spacing_mm is missing: it is needed for a grid of lines (spacing_mm; along; when = move)",
        ),
        ('{ when = "move", spacing_mm = 0.05 }', ".spacing_mm = 0.05"),
        ('{ when = "move", spacing_mm = 3, along = "z" }', ".along = 'z'"),
        (
            '{ when = "move", spacing_mm = 3, phase = 0.5 }',
            '.phase = 0.5 does not go with when = "move", a spacing along the path; it',
        ),
        ('{ when = "move", spacing_mm = 3, rate_hz = 3, count = 2 }', '.rate_hz = 3 does not go with when = "move", a'),
        (
            '{ when = "move", spacing_mm = 3, count = 2 }',
            '.count = 2 does not go with when = "move", a spacing along the path; it belongs',
        ),
        ('{ when = "always" }', ".rate_hz is missing: it is needed for a fixed emitter (rate_hz; when = always)"),
        (
            '{ when = "always", rate_hz = 20, count = 3 }',
            '.count = 3 does not go with when = "always", a fixed emitter; it belongs to a train (',
        ),
        (
            '{ when = "always", rate_hz = 20, envelope = [[0, 1]] }',
            '.envelope does not go with when = "always", a fixed emitter; it belongs to',
        ),
        (
            f"{{ {PRESS}, x_mm = 3 }}",
            '.x_mm = 3 does not go with when = "press", a single emission; it belongs to a fixed emitter (rate_hz; when = always)',
        ),
        (f"{{ {BUZZ}, count = 3, envelope = [] }}", ".envelope"),
        (f"{{ {BUZZ}, count = 3, envelope = [[0, 1], [0, 0.5]] }}", ".envelope[1] = [0.0, 0.5] is not later than the point before"),
        (f"{{ {BUZZ}, count = 3, envelope = [[0, 1], [9, 0.5], [8, 1]] }}", ".envelope[2] = [8.0, 1.0] is not later"),
        (f"{{ {BUZZ}, count = 3, envelope = [[-1, 1]] }}", ".envelope[0][0] = -1"),
        (f"{{ {BUZZ}, count = 3, envelope = [[0, 1], [3.7e6, 1]] }}", ".envelope[1][0] = 3700000"),
        (f"{{ {BUZZ}, count = 3, envelope = [[0, 1.5]] }}", ".envelope[0][1] = 1.5"),
        (f"{{ {BUZZ}, count = 3, envelope = [[0, 0.05]] }}", ".envelope[0] = [0.0, 0.05]: an amplitude is 0 (silence) or 0.1 to 1"),
        (f"{{ {BUZZ}, count = 3, envelope = [[0, 0], [20, 0]] }}", ".envelope is silent throughout"),
        (f"{{ {BUZZ}, count = 3, envelope = [[0, 1], [31, 1]] }}", ".envelope goes on to 31 ms, but the train ends at 30 ms"),
        (f"{{ {PRESS}, pulses = [] }}", ".pulses"),
        (f"{{ {PRESS}, pulses = [[0, 0], [5, 0]] }}", ".pulses is silent throughout"),
        (f"{{ {PRESS}, pulses = [[5, 1], [5, 1]] }}", ".pulses[1] = [5.0, 1.0] is not later than the point before, at 5 ms"),
        (f"{{ {PRESS}, pulses = [[0, 0.05]] }}", ".pulses[0] = [0.0, 0.05]: an amplitude is 0 (silence) or 0.1 to 1"),
        (f"{{ {PRESS}, pulses = [[0, 1], [nan, 1]] }}", ".pulses[1][0] = nan"),
        (f"{{ {BUZZ}, count = 3, pulses = [[0, 1]] }}", '.pulses does not go with when = "press", a train; it belongs to a rhythm'),
        ('{ when = "release", pulses = [[0, 1]] }', '.pulses does not go with when = "release", a single emission'),
        (f"{{ {BUZZ}, count = 3, envelope = [[2, 0], [3, 1], [4, 0]] }}", ".envelope is silent at every emission"),
    ],
)
def test_an_effect_whose_values_do_not_go_together_is_refused_in_a_region_and_by_name(scene_of, effect, words):
    with pytest.raises(ConfigError) as caught:
        scene_of(square(effect))
    assert words in str(caught.value)
    assert str(caught.value).startswith(f"{scene_of.file}: regions[0].effects[0]")
    if effect.startswith("{") and "command" not in effect:
        with pytest.raises(ConfigError) as caught:
            scene_of(square(CLICK), effects=f"effects.mine = {effect}\n")
        assert words in str(caught.value)
        assert str(caught.value).startswith(f"{scene_of.file}: effects.mine")


@each_row(
    ("regions", "words"),
    [
        (
            [square(f"{{ {BUZZ.replace('100', '300')}, count = 2 }}, {{ {BUZZ.replace('100', '205')}, count = 2 }}")],
            "regions[0].effects: the trains that begin with when = 'press' are 505 emissions a second together, above 500",
        ),
        ([square('"always", { effect = "always", x_mm = 5 }')], "effects[1]: region 'square' has a fixed emitter already"),
        (
            [square('{ effect = "click", amplitude = 0.2 }') + "\namplitude = 0.4"],
            "effects[0]: amplitude 0.2 in a region of amplitude 0.4 is 0.08, below 0.1",
        ),
        ([square(CLICK) + "\namplitude = 0.09"], "regions[0].amplitude = 0.09"),
        ([square(CLICK) + '\npolicy = "loud"'], "regions[0].policy = 'loud'"),
        (
            [square(CLICK), square(CLICK, "small", 60, 10)],
            "regions[1] ('small') is never felt: regions[0] ('square') covers it and comes first",
        ),
        (['name = "p"\nshape = "plate"\neffects = []', square(CLICK)], "regions[1] ('square') is never felt: regions[0] ('p')"),
        (
            [
                f'name = "{n}"\nshape = "circle"\nx_mm = 60\ny_mm = 60\nradius_mm = {r}\neffects = ["click"]'
                for n, r in (("a", 9), ("b", 8))
            ],
            "regions[1] ('b') is never felt",
        ),
        (
            [square(CLICK), 'name = "t"\nshape = "polygon"\ncorners_mm = [[60, 60], [70, 60], [60, 90]]\neffects = ["click"]'],
            "regions[1] ('t') is never felt",
        ),
    ],
)
def test_what_regions_and_effects_say_together_is_refused_where_it_cannot_be_meant(scene_of, regions, words):
    with pytest.raises(ConfigError) as caught:
        scene_of(*regions)
    assert words in str(caught.value)


def test_regions_that_overlap_in_part_or_only_hold_a_spot_are_accepted(scene_of):
    emitter = square('"always"', "spot", 60, 10)
    partly = square(CLICK, "partly", 85, 10)
    corner = 'name = "c"\nshape = "circle"\nx_mm = 70\ny_mm = 70\nradius_mm = 21\neffects = ["click"]'
    assert len(scene_of(square(CLICK), emitter, partly, corner).regions) == 4


def test_trains_of_different_occasions_do_not_add_up(scene_of):
    fast = "rate_hz = 400, count = 2"
    assert scene_of(square(f'{{ when = "press", {fast} }}, {{ when = "enter", {fast} }}')).regions[0].train_rate_hz == 400


def test_a_name_a_table_that_builds_on_it_and_the_primitives_mean_the_same(scene_of):
    for effect in ('"double_click"', '{ effect = "double_click" }', f"{{ {PRESS}, rate_hz = 8, count = 2 }}"):
        assert scene_of(square(effect)).regions[0].press == (Train(1.0, 2, 0.125),)


def test_what_an_effect_builds_on_gives_way_to_what_is_given(scene_of):
    quick = scene_of(square('{ effect = "buzz", count = 3, when = "enter", amplitude = 0.5 }')).regions[0]
    assert quick.press == ()
    assert quick.enter == (Train(0.5, 3, 1 / 120),)
    longer = scene_of(square('{ effect = "double_click", duration_ms = 1000 }')).regions[0]
    assert longer.press == (Train(1.0, 8, 0.125),)


def test_a_scenes_own_effects_build_on_those_above_them_and_may_take_a_library_name(scene_of):
    effects = "[effects.click]\neffect = 'click'\namplitude = 0.5\n[effects.soft]\neffect = 'click'\nwhen = 'release'\n"
    scene = scene_of(square('"click", "soft"'), effects=effects)
    assert scene.regions[0].press == scene.regions[0].release == (Train(0.5),)
    assert scene.effects["click"] == scene.effects["soft"] == Train(0.5)
    with pytest.raises(ConfigError, match=r"effects\.early\.effect = 'late' is no effect"):
        scene_of(square(CLICK), effects="[effects.early]\neffect = 'late'\n[effects.late]\nwhen = 'press'\n")


def test_commands_can_play_all_but_spots_what_a_moving_finger_feels_and_what_the_board_cannot(scene_of):
    spatial = {name for name, effect in library().items() if set(effect.occasions) & {"move", "always"}}
    assert spatial >= {"texture", "detent", "grating", "always"}
    assert set(scene_of(square(CLICK)).effects) == set(library()) - spatial
    slow = msgspec.structs.replace(BOARD, limits=msgspec.structs.replace(BOARD.limits, max_duty=0.21))
    fast = {name for name, effect in library().items() if (effect.rate_hz or 0) > 0.21 / BOARD.waveform.duration_s}
    assert "buzz" in fast
    assert set(library()) - set(scene_of(square(CLICK), board=slow).effects) == spatial | fast


@each_row("name", sorted(file.parent.name for file in data_folder("boards").glob("*/board.toml")))
@each_row("effect", sorted(library()))
def test_every_effect_of_the_library_can_be_named_by_a_region_or_a_command_of_every_board(scene_of, name, effect):
    board = load_board(data_folder("boards") / name)
    if library()[effect].occasions == ("command",):
        assert effect in scene_of(square(CLICK), board=board).effects
    else:
        (region,) = scene_of(square(f'"{effect}"'), board=board).regions
        assert region.felt or region.emitter


def test_the_library_scene_names_every_effect_that_a_region_can():
    text = (BOARD.folder / "library.toml").read_text()
    for name, effect in library().items():
        assert f'"{name}"' in text or effect.occasions == ("command",) or name == "train", name


def test_the_table_of_primitives_has_every_occasion_and_every_key():
    assert {when for primitive in PRIMITIVES for when in primitive.when} == set(get_args(When))
    assert {key for primitive in PRIMITIVES for key in primitive.keys} == set(EffectTable.__struct_fields__)
    for when in get_args(When):
        assert when in primitive_of(EffectTable(when=when)).when


KEYS = {
    "rate_hz": 50.0,
    "count": 2,
    "duration_ms": 30.0,
    "phase": 0.5,
    "spacing_mm": 3.0,
    "along": "x",
    "envelope": ((0.0, 1.0),),
    "pulses": ((0.0, 1.0),),
}


@given(st.lists(st.sampled_from(get_args(When)), min_size=1, max_size=2, unique=True), st.sets(st.sampled_from([*KEYS, "x_mm"])))
def test_keys_go_together_where_a_row_of_the_table_takes_all_of_them_and_has_all_that_it_needs(occasions, keys):
    effect = EffectTable(when=tuple(occasions), **{key: KEYS.get(key, 5.0) for key in keys})
    serving = [
        primitive
        for primitive in PRIMITIVES
        if set(occasions) <= set(primitive.when)
        and keys <= set(primitive.keys)
        and all(len(keys & set(alternatives)) == 1 for alternatives in primitive.required)
    ]
    assert (conflict(effect) == "") == bool(serving)


README = (data_folder("boards").parent / "controller" / "device" / "scene" / "README.md").read_text()
EXAMPLES = re.findall(r"^\| .* \| `([{\"].*[}\"])` \|$", README, re.MULTILINE)


def test_the_readme_has_an_example_of_every_key():
    assert EXAMPLES
    for key in EffectTable.__struct_fields__:
        assert any(re.search(rf"\b{key} =", example) for example in EXAMPLES), key


@each_row("example", EXAMPLES)
def test_every_example_of_the_readme_is_felt(scene_of, example):
    (region,) = scene_of(square(example)).regions
    assert region.felt or region.emitter


@pytest.fixture
def library_file(tmp_path, monkeypatch):
    """The library's file, to be written before the first use of `library`."""
    file = tmp_path / "effects.toml"
    monkeypatch.setattr("controller.device.scene.effects.library.LIBRARY", file)
    library.cache_clear()
    yield file
    library.cache_clear()


def test_a_new_effect_is_a_table_in_the_librarys_file_and_nothing_else(scene_of, library_file):
    (table,) = re.findall(r"^```toml\n(\[effects\..*?)^```$", README, re.MULTILINE | re.DOTALL)
    (shown,) = re.findall(r"^\[effects\.(\w+)\]", table, re.MULTILINE)
    taken = tomllib.loads(LIBRARY.read_text())["effects"]
    name = next(name for name in (shown, *(f"{shown}_{number}" for number in range(99))) if name not in taken)
    library_file.write_text(f"{LIBRARY.read_text()}\n{table.replace(f'effects.{shown}', f'effects.{name}')}")
    scene = scene_of(square(f'"{name}", {{ effect = "{name}", when = "enter", amplitude = 0.5 }}'))
    assert [train.pulses for train in (*scene.regions[0].press, *scene.regions[0].enter)] == [5, 5]
    emissions = ActiveEffects(scene, "command 1", 0.1, 0.1).start(name, 1.0, 0.0, ticket=1)
    assert [(e.region, e.amplitude, e.ticket) for e in emissions] == [(name, 0.5, 1)]


def test_a_library_whose_keys_do_not_go_together_is_refused_with_its_key(scene_of, library_file):
    library_file.write_text("[effects.wrong]\nwhen = 'release'\nrate_hz = 20.0\ncount = 2\n")
    with pytest.raises(ConfigError) as caught:
        scene_of(square(CLICK))
    assert str(caught.value).startswith(f'{library_file}: effects.wrong.rate_hz = 20 does not go with when = "release"')
