import math
import random
import tracemalloc

import msgspec
import numpy as np
import pytest
from alone import alone
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.bank.grid import Grid
from controller.board.board import data_folder, load_board
from controller.errors import ConfigError
from controller.scene import scene_file, shapes
from controller.scene.coverage import cells_needed
from controller.scene.edge_rate import edge_warnings
from controller.scene.emission import spot_emission
from controller.scene.fingers import ActiveEffects, UnknownEffect
from controller.scene.scene import OUTSIDE, Region, Scene, Spot, load_scene
from controller.scene.scene_file import find_scene
from controller.scene.shapes import Boxes, Circle, Polygon, Rectangle
from controller.scene.trains import Train
from controller.service.scene_message import pack_scene, unpack_scene
from controller.touch.recording import Recording
from controller.touch.replay import RecordingSource
from controller.touch.source import TouchSample
from controller.waveforms.selection import LATTICE_M

BOARD = load_board(data_folder("boards") / "simulated")


@pytest.fixture
def scene_of(tmp_path):
    """Loads a scene from the lines of its regions; `square` is a rectangle from (50, 50) to (90, 90) mm."""

    def load(*regions):
        file = tmp_path / "scene.toml"
        file.write_text("".join(f"[[regions]]\n{region}\n" for region in regions))
        return load_scene(file, BOARD)

    return load


def square(effects, name="square", x_mm=50, size_mm=40):
    place = f"x_mm = {x_mm}\ny_mm = 50\nwidth_mm = {size_mm}\nheight_mm = {size_mm}"
    return f'name = "{name}"\nshape = "rectangle"\n{place}\neffects = [{effects}]'


CLICK = '{ effect = "click" }'
TRAIN = '{ effect = "train", rate_hz = 100, duration_ms = 30 }'
TEXTURE = '{ effect = "texture", spacing_mm = 5 }'
ALWAYS = '{ effect = "always", rate_hz = 20 }'


def at(x_mm, y_mm=70.0, time_s=0.0, contact=True, finger=3):
    return TouchSample(finger, x_mm * 1e-3, y_mm * 1e-3, time_s, contact)


def on_touch(scene, active, sample):
    """Active effects of a finger after a sample (None: it is lifted), and the emissions that are due; `active` None: it is new."""
    if active is None:
        active = ActiveEffects(scene, sample.finger, sample.x_m, sample.y_m)
        return (active, active.press(sample.time_s)) if sample.contact else (None, ())
    if sample.contact:
        return active, active.move(sample.x_m, sample.y_m, sample.time_s)
    return None, active.release(sample.time_s)


def touch(scene, *samples):
    """Emissions of each sample of one finger, as (x in mm, region) or None, and its state after them."""
    state, felt = None, []
    for sample in samples:
        state, emissions = on_touch(scene, state, sample)
        assert len(emissions) <= 1
        assert all((e.time_s, e.finger, e.owner, e.y_m, e.amplitude) == (sample.time_s, 3, 3, sample.y_m, 1.0) for e in emissions)
        felt.append((round(emissions[0].x_m * 1e3, 6), emissions[0].region) if emissions else None)
    return felt, state


def test_a_click_is_felt_on_press_only(scene_of):
    scene = scene_of(square(CLICK))
    felt, state = touch(scene, at(60), at(61), at(61, contact=False), at(60))
    assert felt == [(60, "square"), None, None, (60, "square")]
    assert (state.finger, state.x_m, state.y_m, state.region) == (3, 0.060, 0.070, 0)
    assert state.ended


def test_sliding_into_a_click_or_train_is_not_felt(scene_of):
    felt, state = touch(scene_of(square(CLICK + "," + TRAIN)), at(40), at(60), at(70))
    assert felt == [None, None, None]
    assert state.ended


def test_outside_of_all_regions_nothing_is_felt(scene_of):
    assert touch(scene_of(square(f"{CLICK}, {TRAIN}, {TEXTURE}")), at(10), at(20), at(30))[0] == [None] * 3


def test_the_first_region_that_contains_the_finger_wins(scene_of):
    small, large = square(CLICK, "small", 60, 10), square(CLICK, "large")
    quiet = square("", "quiet", 80, 5)
    assert touch(scene_of(small, large), at(65, 55))[0] == [(65, "small")]
    assert touch(scene_of(large, square(CLICK, "partly", 85, 10)), at(87, 55))[0] == [(87, "large")]
    assert touch(scene_of(quiet, large), at(82, 52))[0] == [None]


def test_a_texture_is_felt_once_every_spacing_and_keeps_the_rest_of_the_way(scene_of):
    scene = scene_of(square(TEXTURE))
    way = [52, 56, 58, 61.9, 62, 67.5, 71.9, 72]
    felt, _ = touch(scene, *map(at, way))
    assert [hit[0] if hit else None for hit in felt] == [None, None, 58, None, 62, 67.5, None, 72]


def test_a_spacing_one_percent_off_is_noticed(scene_of):
    way = [52 + 0.1 * step for step in range(360)]
    right = touch(scene_of(square(TEXTURE)), *map(at, way))[0]
    wrong = touch(scene_of(square(TEXTURE.replace("5", "5.05"))), *map(at, way))[0]
    assert [round(hit[0]) for hit in right if hit] == [57, 62, 67, 72, 77, 82, 87]
    assert [hit[0] for hit in wrong if hit] != [hit[0] for hit in right if hit]


def test_the_way_of_a_texture_counts_in_any_direction(scene_of):
    scene = scene_of(square(TEXTURE))
    assert touch(scene, at(60, 52), at(60, 57), at(57, 61))[0] == [None, (60, "square"), (57, "square")]


def test_a_jump_over_several_spacings_is_one_emission_and_the_rest_is_kept(scene_of):
    assert touch(scene_of(square(TEXTURE)), at(52), at(74), at(76.9), at(77))[0] == [None, (74, "square"), None, (77, "square")]


def test_a_texture_counts_from_the_first_report_inside_and_forgets_outside(scene_of):
    felt, _ = touch(scene_of(square(TEXTURE)), at(20), at(54), at(58), at(45), at(51), at(55.9), at(56))
    assert felt == [None, None, None, None, None, None, (56, "square")]


def test_a_train_beats_from_the_press_and_follows_the_finger(scene_of):
    scene = scene_of(square(TRAIN))
    state, first = on_touch(scene, None, at(60, time_s=10.0))
    assert [e.time_s for e in first] == [10.0]
    assert state.next_s == pytest.approx(10.01)
    assert state.advance(10.0099) == ()
    state, _ = on_touch(scene, state, at(62, time_s=10.005))
    (second,) = state.advance(state.next_s)
    assert (second.time_s, second.x_m, second.region, second.finger) == (pytest.approx(10.01), 0.062, "square", 3)
    (third,) = state.advance(10.0213)
    assert third.time_s == pytest.approx(10.02)
    assert state.ended  # 30 ms at 100 Hz are three
    assert state.advance(99.0) == ()


def test_a_late_train_plays_one_and_keeps_its_beat(scene_of):
    scene = scene_of(square(TRAIN.replace("30", "1000")))
    state, _ = on_touch(scene, None, at(60, time_s=0.0))
    (late,) = state.advance(0.0455)
    assert late.time_s == pytest.approx(0.04)
    assert state.next_s == pytest.approx(0.05)
    (last,) = state.advance(77.0)
    assert last.time_s == pytest.approx(0.99)
    assert state.ended


def test_a_train_read_at_the_very_time_of_a_beat_plays_that_beat(scene_of):
    scene = scene_of(square(TRAIN.replace("100", "64").replace("30", "100")))
    state, _ = on_touch(scene, None, at(60))
    assert [state.advance(beat / 64)[0].time_s * 64 for beat in (1, 2)] == [1, 2]


@pytest.mark.parametrize("press_s", [5.0, 20.0, 33.3])
def test_rounding_gives_a_late_train_no_beat_more(scene_of, press_s):
    scene = scene_of(square(TRAIN))
    state, _ = on_touch(scene, None, at(60, time_s=press_s))
    assert state.advance(77.0)[0].time_s == pytest.approx(press_s + 0.02)


def test_a_train_of_one_beat_is_over_with_the_press(scene_of):
    state, emissions = on_touch(scene_of(square(TRAIN.replace("30", "10"))), None, at(60))
    assert len(emissions) == 1
    assert state.ended


@pytest.mark.parametrize("end", [at(60, contact=False), at(20)])
def test_a_train_ends_when_the_finger_is_lifted_or_leaves(scene_of, end):
    _, state = touch(scene_of(square(TRAIN)), at(60), end)
    assert state is None or state.ended


def test_several_effects_of_one_press_are_one_emission(scene_of):
    scene = scene_of(square(f"{CLICK}, {TRAIN}, {TEXTURE}"))
    felt, state = touch(scene, at(60), at(65))
    assert felt == [(60, "square"), (65, "square")]
    assert state.next_s == pytest.approx(0.01)


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


def test_a_scene_is_not_changed_and_can_be_handed_to_another_process(scene_of):
    scene = scene_of(square(f"{TRAIN}, {TEXTURE}"), square(ALWAYS, "spot", 100))
    copy = unpack_scene(pack_scene(scene))
    assert copy == scene
    assert touch(copy, at(60), at(66))[0] == touch(scene, at(60), at(66))[0]
    assert copy == scene
    with pytest.raises(AttributeError):
        scene.regions[0].name = "other"


# Occasions

PRESS, RELEASE, ENTER, LEAVE = (f'{{ when = "{occasion}" }}' for occasion in ("press", "release", "enter", "leave"))
FIVE = "rate_hz = 100, count = 5"
PRESSED = f'{{ when = "press", {FIVE} }}'


def test_each_occasion_is_felt_at_its_own_time_and_place(scene_of):
    way = [at(40), at(60), at(65), at(40), at(60), at(60, contact=False)]
    inside = [at(60), at(65), at(65, contact=False)]
    for effect, slid, pressed in (
        (PRESS, [None] * 6, [60, None, None]),
        (RELEASE, [None] * 5 + [60], [None, None, 65]),
        (ENTER, [None, 60, None, None, 60, None], [None] * 3),
        (LEAVE, [None, None, None, 40, None, None], [None] * 3),
    ):
        scene = scene_of(square(effect))
        for samples, places in ((way, slid), (inside, pressed)):
            assert touch(scene, *samples)[0] == [place and (place, "square") for place in places], effect


def test_an_effect_may_have_several_occasions(scene_of):
    felt, _ = touch(scene_of(square('"edge"')), at(40), at(60), at(65), at(40))
    assert felt == [None, (60, "square"), None, (40, "square")]


def test_from_one_region_to_the_next_the_stronger_of_leaving_and_entering_is_felt(scene_of):
    for out, into, region, amplitude in ((1.0, 0.5, "left", 1.0), (0.5, 0.75, "right", 0.75)):
        scene = scene_of(
            square(f'{{ when = "leave", amplitude = {out} }}', "left", 20, 30),
            square(f'{{ when = "enter", amplitude = {into} }}', "right", 50),
        )
        state, _ = on_touch(scene, None, at(40))
        _, (emission,) = on_touch(scene, state, at(60))
        assert (emission.region, emission.amplitude, emission.x_m) == (region, amplitude, 0.060)


def test_of_what_two_regions_want_at_once_one_that_is_to_be_played_alone_is(scene_of):
    for policies in (("alternate", "compose"), ("compose", "alternate")):
        scene = scene_of(
            square(f"{LEAVE}, {ENTER}", "left", 20, 30) + f'\npolicy = "{policies[0]}"',
            square(f"{LEAVE}, {ENTER}", "right", 50) + f'\namplitude = 0.5\npolicy = "{policies[1]}"',
        )
        state, _ = on_touch(scene, None, at(40))
        _, (emission,) = on_touch(scene, state, at(60))
        assert emission.alternate


def test_the_strongest_of_the_lines_crossed_at_once_is_felt(scene_of):
    lines = [
        f'{{ when = "move", along = "x", spacing_mm = {spacing}, amplitude = {a} }}'
        for spacing, a in ((5, 0.3), (10, 0.9), (4, 0.5))
    ]
    state, _ = on_touch(scene_of(square(", ".join(lines))), None, at(51))
    _, (emission,) = on_touch(scene_of(square(", ".join(lines))), state, at(61))
    assert emission.amplitude == 0.9


def test_a_train_that_begins_by_entering_ends_by_leaving_and_one_of_leaving_goes_on_until_the_finger_is_lifted(scene_of):
    entered = scene_of(square(PRESSED.replace("press", "enter")))
    state, _ = on_touch(entered, None, at(40))
    state, (first,) = on_touch(entered, state, at(60, time_s=1.0))
    assert (first.beat, first.period_s, state.next_s) == (0, 0.01, pytest.approx(1.01))
    state, _ = on_touch(entered, state, at(40, time_s=1.005))
    assert state.ended
    left = scene_of(square(PRESSED.replace("press", "leave")), square(CLICK, "other", 10, 25))
    state, _ = on_touch(left, None, at(60))
    state, (first,) = on_touch(left, state, at(40, time_s=1.0))
    state, _ = on_touch(left, state, at(30, time_s=1.005))
    (second,) = state.advance(1.01)
    assert (second.x_m, second.beat, second.region) == (0.030, 1, "square")
    assert on_touch(left, state, at(30, time_s=1.015, contact=False)) == (None, ())


def test_a_phase_delays_a_train_by_a_part_of_its_period(scene_of):
    scene = scene_of(square('{ when = "press", rate_hz = 100, count = 2, phase = 0.25 }'))
    state, none = on_touch(scene, None, at(60, time_s=1.0))
    assert none == ()
    (first,) = state.advance(state.next_s)
    (second,) = state.advance(state.next_s)
    assert (first.time_s, second.time_s) == (pytest.approx(1.0025), pytest.approx(1.0125))
    assert (first.beat, second.beat) == (0, 1)
    assert state.ended


def test_trains_of_one_finger_keep_their_own_beats(scene_of):
    scene = scene_of(square(f'{PRESSED}, {{ when = "press", rate_hz = 30, count = 3, amplitude = 0.5 }}'))
    state, felt = on_touch(scene, None, at(60))
    assert [(e.amplitude, e.period_s) for e in felt] == [(1.0, 0.01)]
    while not state.ended:
        emissions = state.advance(state.next_s)
        felt += emissions
    fast, slow = ([round(e.time_s, 9) for e in felt if e.period_s == period_s] for period_s in (0.01, 1 / 30))
    assert fast == [0.0, 0.01, 0.02, 0.03, 0.04]
    assert slow == [round(1 / 30, 9), round(2 / 30, 9)], "its first is one with the other's"


def test_a_press_that_is_felt_at_once_with_a_train_has_the_trains_beat(scene_of):
    scene = scene_of(square('"click", { when = "press", rate_hz = 30, count = 3, amplitude = 0.5 }'))
    _, (first,) = on_touch(scene, None, at(60))
    assert (first.amplitude, first.beat, first.period_s) == (1.0, 0, 1 / 30)


def test_what_was_missed_of_several_trains_comes_in_order_of_time(scene_of):
    scene = scene_of(square(f'{{ when = "press", rate_hz = 30, count = 9 }}, {PRESSED}'))
    state, _ = on_touch(scene, None, at(60))
    emissions = state.advance(0.0685)
    assert [(round(e.time_s, 4), e.beat) for e in emissions] == [(0.04, 4), (0.0667, 2)]


def test_fingers_have_trains_of_their_own(scene_of):
    scene = scene_of(square(PRESSED))
    states = [on_touch(scene, None, at(55 + finger, time_s=0.003 * finger, finger=finger))[0] for finger in range(4)]
    for finger, state in enumerate(states):
        (emission,) = state.advance(0.02)
        assert (emission.finger, emission.owner) == (finger, finger)
        assert emission.time_s == pytest.approx(0.02 if finger == 0 else 0.01 + 0.003 * finger)


def test_amplitudes_of_region_and_effect_multiply_and_a_region_may_ask_to_be_played_alone(scene_of):
    region = square(f'"click", {{ effect = "texture", spacing_mm = 5, amplitude = 0.5 }}, {ALWAYS}') + "\namplitude = 0.6"
    for policy in ("compose", "alternate"):
        scene = scene_of(f'{region}\npolicy = "{policy}"')
        state, (click,) = on_touch(scene, None, at(60))
        _, (ridge,) = on_touch(scene, state, at(66))
        (spot,) = scene.spots
        assert (click.amplitude, ridge.amplitude, spot.amplitude) == pytest.approx((0.6, 0.3, 0.6))
        assert {click.alternate, ridge.alternate, spot.alternate} == {policy == "alternate"}


def test_lines_are_fixed_to_the_region_and_felt_both_ways(scene_of):
    scene = scene_of(square('{ when = "move", along = "x", spacing_mm = 10 }'))  # at 60, 70 and 80 mm
    felt, _ = touch(scene, *map(at, [52, 58, 61, 59.2, 55, 75, 74, 71, 69, 40, 62, 58]))
    assert [hit[0] if hit else None for hit in felt] == [None, None, 61, 59.2, None, 75, None, None, 69, None, None, 58]


def test_a_spots_beats_are_its_period_apart_from_its_phase_on(scene_of):
    (spot,) = scene_of(square(ALWAYS.replace("20", "20, phase = 0.5"))).spots
    first, fourth = (spot_emission(spot, 2.0, beat) for beat in (0, 3))
    assert (first.time_s, fourth.time_s) == (pytest.approx(2.025), pytest.approx(2.175))
    assert (fourth.beat, fourth.period_s, fourth.owner, fourth.finger) == (3, 0.05, "square", None)


def test_a_train_keeps_its_beat_from_when_its_first_emission_began_to_play(scene_of):
    scene = scene_of(square(f'{PRESSED}, {{ when = "press", rate_hz = 30, count = 3 }}'))
    state, (first,) = on_touch(scene, None, at(60, time_s=1.0))
    state.shift(first.time_s, 1.004)
    (second,) = state.advance(1.0140001)
    assert second.time_s == pytest.approx(1.014, abs=1e-12)
    state.shift(second.time_s, 1.02)
    assert state.next_s == pytest.approx(1.024, abs=1e-12), "later beats move nothing"
    (third, *_) = state.advance(1.004 + 1 / 30)
    assert (third.beat, state.next_s) == (3, pytest.approx(1.044))
    assert state.advance(1.004 + 1 / 30 + 1e-9) == (), "the slower one began with it"


def test_when_the_outputs_go_off_trains_are_over_and_the_way_goes_on(scene_of):
    scene = scene_of(square(f'{PRESSED}, {{ effect = "texture", spacing_mm = 5 }}'))
    state, _ = on_touch(scene, None, at(60))
    state, _ = on_touch(scene, state, at(64, time_s=0.005))
    state.end_trains()
    assert state.ended
    assert on_touch(scene, state, at(65, time_s=0.5))[1][0].region == "square"


# Commands


def command(scene, state=None, name="buzz", *, amplitude=1.0, time_s=5.0, ticket=17):
    active = ActiveEffects(scene, f"command {ticket}", 0.1, 0.05) if state is None else state
    return active, active.start(name, amplitude, time_s, ticket)


def test_a_command_plays_an_effect_at_a_point_and_its_ticket_comes_back_once(scene_of):
    scene = scene_of(square(CLICK))
    state, emissions = command(scene, name="double_click")
    assert state.next_s == pytest.approx(5.125)
    more = state.advance(6.0)
    assert state.ended
    first, second = emissions + more
    assert (first.ticket, second.ticket) == (17, 0)
    assert first.owner == second.owner == "command 17"
    assert {(e.x_m, e.y_m, e.finger, e.region) for e in (first, second)} == {(0.1, 0.05, None, "double_click")}
    state, (click,) = command(scene, name="click")
    assert state.ended
    assert click.ticket == 17


def test_a_commands_amplitude_multiplies_down_to_the_weakest(scene_of):
    scene = scene_of(square(CLICK))
    for amplitude, played in ((0.5, 0.5), (0.25, 0.25)):
        assert command(scene, name="click", amplitude=amplitude)[1][0].amplitude == played
    _, (first,) = command(scene, name="notification", amplitude=0.25)
    assert first.amplitude == 0.25


def test_a_command_for_a_finger_follows_it_over_borders_until_it_is_lifted(scene_of):
    scene = scene_of(square(TRAIN))
    state, _ = on_touch(scene, None, at(60, time_s=4.995))
    _, (first,) = command(scene, state)
    assert (first.x_m, first.owner, first.finger, first.ticket) == (0.060, 3, 3, 17)
    state, _ = on_touch(scene, state, at(20, time_s=5.001))
    (second,) = state.advance(state.next_s)
    assert (second.x_m, second.time_s, second.region) == (0.020, pytest.approx(5 + 1 / 120), "buzz")
    assert on_touch(scene, state, at(20, contact=False)) == (None, ())


def test_the_ticket_waits_for_the_first_emission_that_is_not_silent(tmp_path):
    file = tmp_path / "s.toml"
    swell = "[effects.late]\nwhen = 'command'\nrate_hz = 100\ncount = 4\nenvelope = [[0, 0], [10, 0], [20, 1]]"
    file.write_text(f"{swell}\n[[regions]]\n{square(CLICK)}\n")
    scene = load_scene(file, BOARD)
    state, none = command(scene, name="late")
    assert none == ()
    assert state.unplayed_commands == ((17, 5.0),)
    assert not state.ended
    emissions = state.advance(5.021)
    assert [(e.ticket, e.beat) for e in emissions] == [(17, 2)]
    assert state.unplayed_commands == ()


@pytest.mark.parametrize("name", ["boom", "texture", "detent", "always"])
def test_an_effect_that_no_command_can_play_is_refused_and_the_others_are_listed(scene_of, name):
    with pytest.raises(UnknownEffect, match=rf"no effect '{name}' that a command can play; there are: buzz, click, double_click"):
        command(scene_of(square(CLICK)), name=name)
    assert issubclass(UnknownEffect, ConfigError)


def test_under_another_scene_a_finger_keeps_its_commands_and_nothing_else(scene_of):
    old, new = scene_of(square(f"{TRAIN}, {TEXTURE}")), scene_of(square('"edge"', "new", 40), square(TEXTURE, "other", 95))
    state, _ = on_touch(old, None, at(60, time_s=5.0))
    state, _ = command(old, state)
    state.change_scene(new)
    assert new.regions[state.region].name == "new"
    emissions = state.advance(5.02)
    assert [e.region for e in emissions] == ["buzz"]
    state, (edge,) = on_touch(new, state, at(85, time_s=5.03))
    assert edge.region == "new"
    leaving = scene_of(square(PRESSED.replace("press", "leave")))
    state, _ = on_touch(leaving, None, at(60))
    state, _ = on_touch(leaving, state, at(20))
    state.change_scene(new)
    assert state.ended
    point, _ = command(old)
    point.change_scene(new)
    assert point.advance(5.0084)[0].region == "buzz"


LIBRARY_SCENE = load_scene(BOARD.folder / "library.toml", BOARD)
steps = st.lists(
    st.tuples(st.floats(0, 0.05), st.sampled_from(["touch", "touch", "lift", "command"]), st.floats(0, 0.21), st.floats(0, 0.148)),
    max_size=60,
)


@given(steps, st.sampled_from(sorted(LIBRARY_SCENE.effects)))
def test_whatever_a_finger_does_time_moves_on_and_every_emission_can_be_played(todo, name):
    scene, state, now_s = LIBRARY_SCENE, None, 100.0
    for wait_s, what, x_m, y_m in todo:
        now_s += wait_s
        felt = ()
        if state is not None:
            felt = state.advance(now_s)
            assert state.next_s > now_s
        if what == "command" and state is not None:
            state, more = command(scene, state, name, time_s=now_s)
        elif what == "command":
            continue
        else:
            state, more = on_touch(scene, state, TouchSample(3, x_m, y_m, now_s, what == "touch"))
            assert len(more) <= 1
            assert (state is None) == (what == "lift")
        for e in (*felt, *more):
            assert 0.25 <= e.amplitude <= 1
            assert now_s - wait_s - 1e-9 <= e.time_s <= now_s
            assert e.owner == e.finger == 3
        assert [e.time_s for e in felt] == sorted(e.time_s for e in felt)


def test_a_long_day_of_four_fingers_leaves_no_memory_behind():
    walk, places, samples = random.Random(1), [(0.1, 0.07)] * 4, []
    for k in range(3000):
        x_m, y_m = (
            min(max(at_m + walk.uniform(-3e-3, 3e-3), 0), far) for at_m, far in zip(places[k % 4], (0.21, 0.148), strict=True)
        )
        places[k % 4] = x_m, y_m
        samples.append(TouchSample(k % 4, x_m, y_m, k * 1e-3, walk.random() > 0.01))

    def play():
        states, emissions = {}, 0
        for sample in samples:
            for state in states.values():
                emissions += len(state.advance(sample.time_s))
            state, more = on_touch(LIBRARY_SCENE, states.pop(sample.finger, None), sample)
            emissions += len(more)
            if state is not None:
                states[sample.finger] = state
        return emissions

    def traced():
        tracemalloc.start()
        before, _ = tracemalloc.get_traced_memory()
        play()
        after, peak = tracemalloc.get_traced_memory()
        return after - before, peak - before

    assert play() > 500
    kept_bytes, most_bytes = alone(traced)
    assert kept_bytes < 512
    assert most_bytes < 8192


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
    assert [_scene(shape).region_at(x, y) for x, y in ((0.21, 0.148), (0.1, 0.05), (0.21, 0.05), (0.0999, 0.05))] == [
        0,
        0,
        0,
        OUTSIDE,
    ]


def on_board(tmp_path, text, **limits):
    """The scene on the simulated board with other limits."""
    file = tmp_path / "scene.toml"
    file.write_text(text)
    board = msgspec.structs.replace(BOARD, limits=msgspec.structs.replace(BOARD.limits, **limits))
    return load_scene(file, board), board


@pytest.mark.parametrize(("rate_hz", "good"), [(500, True), (499.9, False), (499.51, False), (499.5, True), (25, True)])
def test_a_spot_whose_pause_is_shorter_than_a_drive_word_is_refused_before_the_fpga_does(scene_of, rate_hz, good):
    """The FPGA takes T = 160,000 ticks or T + 160 and more, and calls what lies between BAD_PERIOD: above 499.5005 Hz."""
    effect = f'{{ effect = "always", rate_hz = {rate_hz} }}'
    if good:
        scene_of(square(effect))
        return
    said = r"effects\[0\]\.rate_hz = 499\.\d+ leaves [\d.]+ us between emissions, .*: give 500 \(no pause\) or at most 499\.5$"
    with pytest.raises(ConfigError, match=said):
        scene_of(square(effect))


def test_a_period_that_rounding_puts_a_tick_off_the_emission_is_the_emissions():
    waveform = msgspec.structs.replace(BOARD.waveform, bit_clock_hz=333_333.0, duration_ms=3.0)
    board = msgspec.structs.replace(BOARD, waveform=waveform)
    assert board.emission_ticks == 1000 * board.bit_period >> 16 == 240_000
    assert board.period_ticks(1 / 333.333) == 240_000
    assert board.period_ticks(1 / 333.33) == 240_002
    assert BOARD.period_ticks(1 / 500) == BOARD.emission_ticks == 160_000
    assert BOARD.period_ticks(1 / 25) == 3_200_000


def test_repetitions_that_the_fpgas_edge_limits_would_end_are_warned_of(tmp_path):
    spots = [
        square(f'{{ effect = "always", rate_hz = {rate_hz} }}', name, x_mm) for name, rate_hz, x_mm in (("a", 20, 0), ("b", 30, 50))
    ]
    train = square(TRAIN, "c", 100)
    text = "".join(f"[[regions]]\n{region}\n" for region in (*spots, train))  # 20 + 30 + 100 emissions a second
    scene, board = on_board(tmp_path, text, max_channel_edge_rate_hz=15_000.0, max_total_edge_rate_hz=400_000.0)
    assert edge_warnings(scene, board, 100, 2666) == []
    (channel,) = edge_warnings(scene, board, 101, 2666)
    assert "up to 150 emissions a second make 1.515e+04 edges a second on one channel" in channel
    assert "limits.max_channel_edge_rate_hz = 15000 of board 'simulated': the FPGA will switch off" in channel
    (together,) = edge_warnings(scene, board, 100, 2667)
    assert "on all channels, above limits.max_total_edge_rate_hz = 400000" in together
    assert len(edge_warnings(scene, board, 101, 2667)) == 2


def test_spots_of_one_rate_are_one_emission_and_no_scene_plays_more_than_the_duty_allows(tmp_path):
    spots = [square('{ effect = "always", rate_hz = 50 }', name, x_mm) for name, x_mm in (("a", 0), ("b", 50))]
    text = "".join(f"[[regions]]\n{region}\n" for region in spots)
    assert edge_warnings(*on_board(tmp_path, text, max_channel_edge_rate_hz=5000.0), 100, 100) == []
    text += f"[[regions]]\n{square(TRAIN, 'c', 100)}\n"
    assert edge_warnings(*on_board(tmp_path, text, max_duty=0.2, max_channel_edge_rate_hz=10_000.0), 100, 100) == []
    assert edge_warnings(*on_board(tmp_path, text, max_duty=0.202, max_channel_edge_rate_hz=10_000.0), 100, 100)


def test_a_scene_without_repetitions_is_warned_of_nothing(tmp_path):
    scene, board = on_board(tmp_path, f"[[regions]]\n{square(CLICK + ',' + TEXTURE)}\n", max_channel_edge_rate_hz=1.0)
    assert edge_warnings(scene, board, 1000, 32_000) == []


@pytest.mark.parametrize("text", ["", "regions = []", "regions = 3", "not toml", "speed = 3"])
def test_a_file_without_regions_is_refused(tmp_path, text):
    file = tmp_path / "scene.toml"
    file.write_text(text)
    with pytest.raises(ConfigError, match=r"scene\.toml"):
        load_scene(file, BOARD)


def test_the_highest_rate_that_emissions_fit_into_is_accepted(scene_of):
    assert scene_of(square('{ effect = "train", rate_hz = 500, duration_ms = 4 }')).regions[0].press == (Train(1.0, 2, 1 / 500),)


def test_what_reaches_just_to_the_limits_is_accepted_rounding_included(scene_of, tmp_path):
    corner = '{ effect = "always", rate_hz = 5, x_mm = 210, y_mm = 148 }'
    fine = '{ effect = "texture", spacing_mm = 0.1 }'
    assert scene_of(square(corner + "," + fine, "wide", 100.1).replace("width_mm = 40", "width_mm = 109.9")).spots
    board = msgspec.structs.replace(BOARD, limits=msgspec.structs.replace(BOARD.limits, max_duty=0.7))
    scene_of(square('{ effect = "train", rate_hz = 350, duration_ms = 4 }'))
    assert load_scene(tmp_path / "scene.toml", board).regions[0].press  # 350 Hz × 2 ms is above 0.7 in binary


def test_a_scene_is_found_by_path_or_name_and_an_unknown_one_lists_those_that_exist(tmp_path):
    board = msgspec.structs.replace(BOARD, folder=tmp_path)
    for name in ("board", "scene", "piano"):
        (tmp_path / f"{name}.toml").write_text("")
    assert find_scene(board, "piano") == find_scene(board, "piano.toml") == tmp_path / "piano.toml"
    assert find_scene(BOARD, str(tmp_path / "piano.toml")) == tmp_path / "piano.toml"
    for unknown in ("organ", "board", str(tmp_path)):
        with pytest.raises(ConfigError, match=r"'simulated' has: piano, scene \(or a path\)"):
            find_scene(board, unknown)


# Shapes

SHAPES = [
    Rectangle(0.02, 0.03, 0.09, 0.04),
    Rectangle(0.0, 0.0, 0.210, 0.148),
    Circle(0.05, 0.06, 0.0501),
    Circle(0.2052, 0.0811, 0.0012),
    Polygon(((0.01, 0.01), (0.2, 0.02), (0.1, 0.04), (0.15, 0.14), (0.02, 0.1), (0.06, 0.05))),
    Polygon(((0.0, 0.0), (0.0, 0.0011), (0.2, 0.148))),
]
fractions = st.floats(0, 1)


def point_in(shape, u, v):
    """A point of the shape, near the given place of its bounds; None if that place is not in it."""
    low_x, low_y, high_x, high_y = shape.bounds
    x, y = low_x + u * (high_x - low_x), low_y + v * (high_y - low_y)
    return (x, y) if shape.contains(x, y) else None


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("pitch_mm", [2.5, 5.0, 13.0])
@settings(max_examples=60)
@given(u=fractions, v=fractions)
def test_every_point_of_a_shape_has_its_four_cells_reached(shape, pitch_mm, u, v):
    grid = Grid.of(BOARD.plate, pitch_mm * 1e-3)
    reached = cells_needed(_scene(shape), grid.points(), grid.pitch_m)
    point = point_in(shape, u, v)
    if point:
        cells, _ = grid.corners(*point)
        assert all(reached[cell] for cell in cells)


def _scene(shape):
    return Scene((Region("a", shape, press=(Train(),)),))


@pytest.mark.parametrize("shape", SHAPES)
def test_cells_that_no_point_of_a_shape_needs_are_not_reached(shape):
    grid = Grid.of(BOARD.plate, 5e-3)
    reached = cells_needed(_scene(shape), grid.points(), grid.pitch_m)
    needed = np.zeros(len(reached), bool)
    for u in np.linspace(0, 1, 150):
        for v in np.linspace(0, 1, 150):
            point = point_in(shape, u, v)
            if point:
                needed[list(grid.corners(*point)[0])] = True
    assert not (needed & ~reached).any()
    # Cells that only the slack or the second row of the rim reaches are at most two pitches off.
    points = grid.points()
    for cell in np.flatnonzero(reached & ~needed):
        apart = np.abs(points[needed] - points[cell]).max(axis=1) if needed.any() else np.array([0.0])
        assert apart.min() < 2.1 * grid.pitch_m


@pytest.mark.parametrize("far", [False, True])
def test_a_region_in_a_corner_of_the_plate_reaches_the_four_outermost_cells_only(far):
    grid = Grid.of(BOARD.plate, 5e-3)
    x_m, y_m = (BOARD.plate.length_m - 1e-3, BOARD.plate.width_m - 1e-3) if far else (0.0, 0.0)
    reached = cells_needed(_scene(Rectangle(x_m, y_m, x_m + 1e-3, y_m + 1e-3)), grid.points(), grid.pitch_m)
    assert set(np.flatnonzero(reached)) == set(grid.corners(x_m, y_m)[0])


@pytest.mark.parametrize("effect", [CLICK, TRAIN, TEXTURE])
def test_every_effect_of_a_finger_reaches_the_cells_of_its_region(scene_of, effect):
    grid = Grid.of(BOARD.plate, 5e-3)
    asked = np.array([grid.corners(x, y)[0] for x in (0.050, 0.090) for y in (0.050, 0.090)])
    assert cells_needed(scene_of(square(effect)), grid.points(), grid.pitch_m)[asked].all()


def test_a_region_within_one_grid_square_reaches_its_four_cells_only():
    grid = Grid.of(BOARD.plate, 5e-3)
    x_m, y_m = grid.x0_m + 10 * grid.pitch_m, grid.y0_m + 7 * grid.pitch_m
    reached = cells_needed(_scene(Rectangle(x_m + 0.5e-3, y_m + 0.5e-3, x_m + 4.5e-3, y_m + 4.5e-3)), grid.points(), grid.pitch_m)
    assert set(np.flatnonzero(reached)) == set(grid.corners(x_m + 1e-3, y_m + 1e-3)[0])


def test_a_region_that_nearly_touches_the_next_grid_square_reaches_it_because_points_are_rounded():
    grid = Grid.of(BOARD.plate, 5e-3)
    x_m, y_m = grid.x0_m + 10 * grid.pitch_m, grid.y0_m + 7 * grid.pitch_m
    near = Rectangle(x_m + 1e-3, y_m + 1e-3, x_m + grid.pitch_m - LATTICE_M / 3, y_m + grid.pitch_m - LATTICE_M / 3)
    over = grid.corners(near.x_high + LATTICE_M / 2, near.y_high + LATTICE_M / 2)[0]
    assert cells_needed(_scene(near), grid.points(), grid.pitch_m)[list(over)].all()


@given(u=fractions, v=fractions, dx=st.floats(-1, 1), dy=st.floats(-1, 1), shape=st.sampled_from(SHAPES))
def test_points_rounded_to_the_bank_lattice_are_reached_too(u, v, dx, dy, shape):
    grid = Grid.of(BOARD.plate, 5e-3)
    point = point_in(shape, u, v)
    if point:
        rounded = point[0] + dx * LATTICE_M / 2, point[1] + dy * LATTICE_M / 2
        assert cells_needed(_scene(shape), grid.points(), grid.pitch_m)[list(grid.corners(*rounded)[0])].all()


def test_what_begins_by_leaving_a_region_may_be_felt_anywhere(scene_of):
    points = Grid.of(BOARD.plate, 5e-3).points()
    assert cells_needed(scene_of(square(LEAVE)), points, 5e-3).all()
    assert not cells_needed(scene_of(square(ENTER)), points, 5e-3).all()


def test_a_margin_reaches_what_a_prediction_may_ask_for(scene_of):
    grid = Grid.of(BOARD.plate, 5e-3)
    scene = scene_of(square(CLICK), square(ALWAYS, "spot", 140))
    near, wide = (cells_needed(scene, grid.points(), grid.pitch_m, margin_m) for margin_m in (0.0, 12e-3))
    asked = list(grid.corners(0.050 - 11.9e-3, 0.090 + 11.9e-3)[0])
    assert wide[asked].all()
    assert not near[asked].all()
    away = np.abs(grid.points() - (0.16, 0.07)).max(axis=1) < 0.02
    assert np.array_equal(near[away], wide[away]), "a spot is where it is"


def test_spots_reach_their_four_cells_and_their_region_none(scene_of):
    scene = scene_of(square(ALWAYS.replace("20", "20, x_mm = 101, y_mm = 71")))
    grid = Grid.of(BOARD.plate, 5e-3)
    reached = cells_needed(scene, grid.points(), grid.pitch_m)
    assert set(np.flatnonzero(reached)) == set(grid.corners(0.101, 0.071)[0])


@given(st.floats(0, 0.2), st.floats(0, 0.14), st.floats(1e-4, 0.05), fractions, fractions, st.sampled_from(SHAPES))
def test_a_box_that_holds_a_point_of_a_shape_meets_it(x, y, size, u, v, shape):
    box = Boxes(*(np.array([value]) for value in (x, x + size, y, y + size)))
    inside = shape.contains(x + u * size, y + v * size)
    assert shape.meets(box)[0] or not inside


def test_the_rim_belongs_to_rectangles_and_circles():
    corners, poles = [(1, 2), (3, 2), (1, 5), (3, 5)], [(0, 2), (4, 2), (2, 0), (2, 4)]
    assert all(Rectangle(1, 2, 3, 5).contains(*corner) for corner in corners)
    assert all(Circle(2, 2, 2).contains(*pole) for pole in poles)


def test_a_polygon_contains_what_its_picture_shows():
    corner = Polygon(((0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)))
    assert [corner.contains(*p) for p in [(0.5, 3), (3, 0.5), (2, 2), (-1, 0.5), (5, 0.5), (0.5, 0.5)]] == [1, 1, 0, 0, 0, 1]
    assert corner.centre == pytest.approx((9.5 / 7, 9.5 / 7))
    assert Polygon(corner.corners[::-1]).centre == pytest.approx(corner.centre)


@pytest.mark.parametrize(
    "corners",
    [
        [(0, 0), (2, 2), (2, 0), (0, 2)],  # a bow
        [(0, 0), (2, 0), (1, 0), (1, 1)],  # folded back
        [(0, 0), (2, 0), (2, 0), (1, 1)],  # a corner twice
        [(0, 0), (1, 0), (2, 0)],  # no area
        [(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)],  # a corner on an edge
        [(0, 0), (3 * 0.1, 3 * 0.7), (-1.8, 2.4), (0.1, 0.7), (-2.1, 0.3)],  # a corner on an edge but for rounding
        [(1, 1), (1, 1), (1, 1)],  # one point
        [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)],  # two parts that meet in a point
    ],
)
def test_crossing_outlines_are_found(corners):
    for turn in range(len(corners)):
        assert Polygon((*corners[turn:], *corners[:turn])).crossing()


@given(st.integers(3, 12), st.floats(0.2, 1), st.floats(0, 6.28))
def test_stars_do_not_cross(count, depth, angle):
    corners = [
        (math.cos(angle + math.pi * k / count) * r, math.sin(angle + math.pi * k / count) * r)
        for k in range(2 * count)
        for r in [1 if k % 2 else depth]
    ]
    star = Polygon(tuple(corners))
    assert star.crossing() is None
    assert star.contains(0, 0)
    assert star.centre == pytest.approx((0, 0), abs=1e-9)


# The simulated board's own scene


@pytest.mark.parametrize("file", sorted((BOARD.folder.parents[1] / "tests/touch/recordings").glob("*.e*")), ids=lambda f: f.name)
def test_every_real_recording_is_felt_where_its_fingers_went(file):
    scene = load_scene(find_scene(BOARD, BOARD.scene), BOARD)
    recording = Recording.open(file)
    axes = recording.axes(BOARD)
    source, tracks = RecordingSource(recording, axes, 0.0), recording.tracks(axes)
    states, felt = {}, []
    while (due_s := source.next_time_s()) is not None:
        for state in states.values():
            if state.next_s <= due_s:
                felt += state.advance(state.next_s)
        for sample in source.read(due_s):
            state, emissions = on_touch(scene, states.pop(sample.finger, None), sample)
            felt += emissions
            if state:
                states[sample.finger] = state
    assert {e.finger for e in felt} == set(tracks)
    assert not states
    for e in felt:
        assert math.dist(tracks[e.finger].position(e.time_s), (e.x_m, e.y_m)) < 1.5e-3  # trains between two reports


def test_the_demo_shows_every_kind_of_region():
    scene = load_scene(find_scene(BOARD, BOARD.scene), BOARD)
    assert {type(region.shape) for region in scene.regions} == {Rectangle, Circle, Polygon}
    assert scene.regions[-1].shape == Rectangle(0, 0, BOARD.plate.length_m, BOARD.plate.width_m)
    assert [spot.region for spot in scene.spots] == ["beacon"]
    grid = Grid.of(BOARD.plate, 5e-3)
    assert cells_needed(scene, grid.points(), grid.pitch_m).all()


def test_thousands_of_regions_are_not_compared_each_with_each(tmp_path, monkeypatch):
    compared = []
    real = scene_file._covers
    monkeypatch.setattr(scene_file, "_covers", lambda *shapes: compared.append(shapes) or real(*shapes))
    file = tmp_path / "many.toml"
    keys = [
        f'[[regions]]\nname = "{x} {y}"\nshape = "rectangle"\nx_mm = {4 * x}\ny_mm = {4 * y}\nwidth_mm = 3\nheight_mm = 3\n'
        'effects = ["click"]\n'
        for x in range(50)
        for y in range(36)
    ]
    file.write_text("".join(keys))
    assert len(load_scene(file, BOARD).regions) == 1800
    assert not compared
    file.write_text("".join(keys) + keys[7].replace("0 7", "again"))
    with pytest.raises(ConfigError, match=r"regions\[1800\] \('again'\) is never felt: regions\[7\] \('0 7'\) covers it"):
        load_scene(file, BOARD)
    assert len(compared) == 1


def test_edges_of_a_polygon_that_are_far_apart_are_not_compared(monkeypatch):
    compared = []
    real = shapes._touch
    monkeypatch.setattr(shapes, "_touch", lambda *ends: compared.append(ends) or real(*ends))
    corners = [(math.cos(2 * math.pi * turn / 1000), math.sin(2 * math.pi * turn / 1000)) for turn in range(1000)]
    assert Polygon(tuple(corners)).crossing() is None
    assert len(compared) < 4000, "of half a million pairs"


CORNERS = st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=7)


@given(CORNERS, st.sampled_from([1.0, 0.1, 1 / 3]))
def test_a_crossing_is_found_as_by_comparing_each_edge_with_each(corners, scale):
    polygon = Polygon(tuple((x * scale, y * scale) for x, y in corners))
    edges, last = polygon.edges(), len(corners) - 1
    pairs = [(i, j) for i in range(len(edges)) for j in range(i + 1, len(edges))]
    touching = (
        (i, j)
        for i, j in pairs
        if (shapes._folded_back if j == i + 1 or (i, j) == (0, last) else shapes._touch)(*edges[i], *edges[j])
    )
    assert polygon.crossing() == next(touching, None)


@given(CORNERS, st.lists(st.tuples(st.integers(-1, 14), st.integers(-1, 14)), min_size=1))
def test_many_points_are_found_in_a_polygon_as_one_by_one(corners, points):
    polygon = Polygon(tuple((x / 3, y / 3) for x, y in corners))
    x, y = np.array(points, float).T / 6
    assert polygon._contain(x, y).tolist() == [polygon.contains(*point) for point in zip(x.tolist(), y.tolist(), strict=True)]
