"""What a finger feels: touch samples, time and commands in, emissions out."""

import math
import random
import tracemalloc

import pytest
from alone import alone
from device.scene.scenes import (
    ALWAYS,
    BOARD,
    CLICK,
    ENTER,
    LEAVE,
    LIBRARY_SCENE,
    PRESS,
    PRESSED,
    RELEASE,
    TEXTURE,
    TRAIN,
    at,
    on_touch,
    square,
    touch,
)
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.devices import MIN_AMPLITUDE
from controller.device.scene.fingers import ActiveEffects
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch.source import TouchSample
from controller.errors import ConfigError


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


def test_a_train_pulses_from_the_press_and_follows_the_finger(scene_of):
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


def test_a_late_train_plays_one_and_keeps_its_pulse(scene_of):
    scene = scene_of(square(TRAIN.replace("30", "1000")))
    state, _ = on_touch(scene, None, at(60, time_s=0.0))
    (late,) = state.advance(0.0455)
    assert late.time_s == pytest.approx(0.04)
    assert state.next_s == pytest.approx(0.05)
    (last,) = state.advance(77.0)
    assert last.time_s == pytest.approx(0.99)
    assert state.ended


def test_a_train_read_at_the_very_time_of_a_pulse_plays_that_pulse(scene_of):
    scene = scene_of(square(TRAIN.replace("100", "64").replace("30", "100")))
    state, _ = on_touch(scene, None, at(60))
    assert [state.advance(pulse / 64)[0].time_s * 64 for pulse in (1, 2)] == [1, 2]


@each_row("press_s", [5.0, 20.0, 33.3])
def test_rounding_gives_a_late_train_no_pulse_more(scene_of, press_s):
    scene = scene_of(square(TRAIN))
    state, _ = on_touch(scene, None, at(60, time_s=press_s))
    assert state.advance(77.0)[0].time_s == pytest.approx(press_s + 0.02)


def test_a_train_of_one_pulse_is_over_with_the_press(scene_of):
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
    assert (first.pulse, first.period_s, state.next_s) == (0, 0.01, pytest.approx(1.01))
    state, _ = on_touch(entered, state, at(40, time_s=1.005))
    assert state.ended
    left = scene_of(square(PRESSED.replace("press", "leave")), square(CLICK, "other", 10, 25))
    state, _ = on_touch(left, None, at(60))
    state, (first,) = on_touch(left, state, at(40, time_s=1.0))
    state, _ = on_touch(left, state, at(30, time_s=1.005))
    (second,) = state.advance(1.01)
    assert (second.x_m, second.pulse, second.region) == (0.030, 1, "square")
    assert on_touch(left, state, at(30, time_s=1.015, contact=False)) == (None, ())


def test_a_phase_delays_a_train_by_a_part_of_its_period(scene_of):
    scene = scene_of(square('{ when = "press", rate_hz = 100, count = 2, phase = 0.25 }'))
    state, none = on_touch(scene, None, at(60, time_s=1.0))
    assert none == ()
    (first,) = state.advance(state.next_s)
    (second,) = state.advance(state.next_s)
    assert (first.time_s, second.time_s) == (pytest.approx(1.0025), pytest.approx(1.0125))
    assert (first.pulse, second.pulse) == (0, 1)
    assert state.ended


def test_trains_of_one_finger_keep_their_own_pulses(scene_of):
    scene = scene_of(square(f'{PRESSED}, {{ when = "press", rate_hz = 30, count = 3, amplitude = 0.5 }}'))
    state, felt = on_touch(scene, None, at(60))
    assert [(e.amplitude, e.period_s) for e in felt] == [(1.0, 0.01)]
    while not state.ended:
        emissions = state.advance(state.next_s)
        felt += emissions
    fast, slow = ([round(e.time_s, 9) for e in felt if e.period_s == period_s] for period_s in (0.01, 1 / 30))
    assert fast == [0.0, 0.01, 0.02, 0.03, 0.04]
    assert slow == [round(1 / 30, 9), round(2 / 30, 9)], "its first is one with the other's"


def test_a_press_that_is_felt_at_once_with_a_train_has_the_trains_pulse(scene_of):
    scene = scene_of(square('"click", { when = "press", rate_hz = 30, count = 3, amplitude = 0.5 }'))
    _, (first,) = on_touch(scene, None, at(60))
    assert (first.amplitude, first.pulse, first.period_s) == (1.0, 0, 1 / 30)


def test_what_was_missed_of_several_trains_comes_in_order_of_time(scene_of):
    scene = scene_of(square(f'{{ when = "press", rate_hz = 30, count = 9 }}, {PRESSED}'))
    state, _ = on_touch(scene, None, at(60))
    emissions = state.advance(0.0685)
    assert [(round(e.time_s, 4), e.pulse) for e in emissions] == [(0.04, 4), (0.0667, 2)]


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
        (emitter,) = scene.emitters
        assert (click.amplitude, ridge.amplitude, emitter.amplitude) == pytest.approx((0.6, 0.3, 0.6))
        assert {click.alternate, ridge.alternate, emitter.alternate} == {policy == "alternate"}


def test_lines_are_fixed_to_the_region_and_felt_both_ways(scene_of):
    scene = scene_of(square('{ when = "move", along = "x", spacing_mm = 10 }'))  # at 60, 70 and 80 mm
    felt, _ = touch(scene, *map(at, [52, 58, 61, 59.2, 55, 75, 74, 71, 69, 40, 62, 58]))
    assert [hit[0] if hit else None for hit in felt] == [None, None, 61, 59.2, None, 75, None, None, 69, None, None, 58]


def test_a_train_keeps_its_pulse_from_when_its_first_emission_began_to_play(scene_of):
    scene = scene_of(square(f'{PRESSED}, {{ when = "press", rate_hz = 30, count = 3 }}'))
    state, (first,) = on_touch(scene, None, at(60, time_s=1.0))
    state.shift(first.time_s, 1.004)
    (second,) = state.advance(1.0140001)
    assert second.time_s == pytest.approx(1.014, abs=1e-12)
    state.shift(second.time_s, 1.02)
    assert state.next_s == pytest.approx(1.024, abs=1e-12), "later pulses move nothing"
    (third, *_) = state.advance(1.004 + 1 / 30)
    assert (third.pulse, state.next_s) == (3, pytest.approx(1.044))
    assert state.advance(1.004 + 1 / 30 + 1e-9) == (), "the slower one began with it"


def test_when_the_outputs_go_off_trains_are_over_and_the_way_goes_on(scene_of):
    scene = scene_of(square(f'{PRESSED}, {{ effect = "texture", spacing_mm = 5 }}'))
    state, _ = on_touch(scene, None, at(60))
    state, _ = on_touch(scene, state, at(64, time_s=0.005))
    state.end_trains()
    assert state.ended
    assert on_touch(scene, state, at(65, time_s=0.5))[1][0].region == "square"


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
    assert first.amplitude == MIN_AMPLITUDE


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
    assert [(e.ticket, e.pulse) for e in emissions] == [(17, 2)]
    assert state.unplayed_commands == ()


@each_row("name", ["boom", "texture", "detent", "always"])
def test_an_effect_that_no_command_can_play_is_refused_and_the_others_are_listed(scene_of, name):
    scene = scene_of(square(CLICK))
    with pytest.raises(
        ConfigError, match=f"no effect '{name}' that a command can play; there are: {', '.join(sorted(scene.effects))}"
    ):
        command(scene, name=name)
    assert "buzz" in scene.effects


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


RECORDINGS = BOARD.folder.parents[1] / "tests/device/touch/recordings"


@each_row("file", sorted(RECORDINGS.glob("*.e*")), ids=lambda f: f.name)
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
