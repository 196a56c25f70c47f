"""Active effects and pending emissions: what waits, what replaces what, and what is reported of commands."""

import math

import pytest
from tables import each_row

from controller.device.loop.commands import Outcome
from controller.device.loop.playing.due_emissions import MAX_WAITING_COMMANDS
from controller.device.loop.playing.next_focus import next_focus
from controller.device.loop.scheduler import Scheduler
from controller.device.scene.scene import load_scene
from controller.device.touch.source import TouchSample
from controller.errors import ConfigError
from controller.metrics import Counters

SCENE = """
[effects.tap]
when = "command"

[effects.roll]
when = "command"
rate_hz = 100.0
count = 5

[effects.late]
when = "command"
rate_hz = 100.0
count = 2
phase = 0.5

[[regions]]
name = "all"
shape = "plate"
effects = ["click"]
"""
T_S = 2e-3


@pytest.fixture
def scene(board, tmp_path):
    file = tmp_path / "performed.toml"
    file.write_text(SCENE)
    return load_scene(file, board)


@pytest.fixture
def reported():
    return []


@pytest.fixture
def scheduler(scene, reported):
    return scheduler_of(scene, reported)


def scheduler_of(scene, reported, confirmed=lambda _: True, most=1):
    return Scheduler(scene, Counters(), confirmed, most, lambda ticket, outcome, age_s: reported.append((ticket, outcome, age_s)))


def touch(scheduler, finger, x_m, y_m, time_s, contact):
    scheduler.touch(TouchSample(finger, x_m, y_m, time_s, contact), time_s)


def command(scheduler, ticket, x_m=0.1, y_m=0.07, effect="tap", finger=None, now_s=0.0):
    scheduler.play(ticket, effect, x_m, y_m, finger, 1.0, now_s)


def played(scheduler, now_s):
    emissions = scheduler.queue.next_batch(T_S, 0.0)
    scheduler.started(emissions, now_s)
    return emissions


def test_a_started_command_is_reported_as_played_with_its_age(scheduler, reported):
    command(scheduler, 1, now_s=1.0)
    (emission,) = played(scheduler, 1.004)
    assert (emission.x_m, emission.y_m, emission.finger) == (0.1, 0.07, None)
    assert reported == [(1, Outcome.PLAYED, pytest.approx(0.004))]
    assert not scheduler.due


def test_a_newer_command_for_the_same_place_replaces_the_older(scheduler, reported):
    command(scheduler, 1)
    command(scheduler, 2, x_m=0.1004, now_s=0.001)
    assert reported == [(1, Outcome.MERGED, pytest.approx(0.001))]
    assert scheduler._counters.skipped.merged == 1
    assert len(played(scheduler, 0.002)) == 1
    assert reported[1][:2] == (2, Outcome.PLAYED)


def test_commands_for_places_that_are_apart_are_played_together(scheduler, reported):
    for ticket in (1, 2, 3):
        command(scheduler, ticket, x_m=0.03 * ticket)
    assert len(played(scheduler, 0.001)) == 3
    assert [(ticket, outcome) for ticket, outcome, _ in reported] == [(ticket, Outcome.PLAYED) for ticket in (1, 2, 3)]


def test_of_too_many_commands_the_oldest_is_skipped_and_each_is_answered_once(scheduler, reported):
    tickets = range(1, MAX_WAITING_COMMANDS + 6)
    for ticket in tickets:
        command(scheduler, ticket, x_m=0.01 + 0.004 * (ticket % 45), y_m=0.01 + 0.02 * (ticket // 45), now_s=ticket * 1e-6)
    assert [ticket for ticket, outcome, _ in reported if outcome is Outcome.SKIPPED] == [1, 2, 3, 4, 5]
    while scheduler.due:
        played(scheduler, 0.01)
    assert sorted(ticket for ticket, _, _ in reported) == list(tickets)


def test_only_the_first_pulse_of_a_command_is_answered(scheduler, reported):
    command(scheduler, 1, effect="roll")
    times_s = [played(scheduler, 0.0)[0].time_s]
    while scheduler.next_s() < 1.0:
        scheduler.advance(scheduler.next_s())
        times_s.append(played(scheduler, 0.0)[0].time_s)
    assert times_s == pytest.approx([0.0, 0.01, 0.02, 0.03, 0.04])
    assert [outcome for _, outcome, _ in reported] == [Outcome.PLAYED]


def test_pulses_of_a_train_are_spaced_from_the_actual_start_of_the_first(scheduler):
    command(scheduler, 1, effect="roll")
    played(scheduler, 0.0031)
    assert scheduler.next_s() == pytest.approx(0.0131)


def test_of_several_trains_the_next_pulse_is_the_earliest(scheduler):
    for ticket, now_s in ((1, 0.004), (2, 0.0), (3, 0.007)):
        command(scheduler, ticket, x_m=0.05 * ticket, effect="roll", now_s=now_s)
    assert scheduler.next_s() == pytest.approx(0.01)
    scheduler.advance(0.0105)
    assert scheduler.next_s() == pytest.approx(0.014)


def test_what_is_due_more_than_an_emission_later_goes_on_waiting(scheduler):
    command(scheduler, 1, x_m=0.05, now_s=0.0)
    command(scheduler, 2, x_m=0.15, now_s=T_S + 0.001)
    assert [emission.ticket for emission in scheduler.queue.next_batch(T_S, 0.004)] == [1]
    assert [emission.ticket for emission in scheduler.queue.next_batch(T_S, 0.004)] == [2]


def test_an_unknown_effect_or_finger_is_refused_and_nothing_waits(scheduler, reported):
    with pytest.raises(ConfigError, match="no effect 'boom'"):
        command(scheduler, 1, effect="boom")
    with pytest.raises(ConfigError, match="finger 4 is not on the panel"):
        command(scheduler, 2, finger=4)
    assert not scheduler.due
    assert reported == []


def test_a_command_for_a_finger_follows_it_and_ends_with_it(scheduler, reported):
    touch(scheduler, 3, 0.05, 0.05, 0.0, True)
    played(scheduler, 0.0)
    command(scheduler, 1, effect="roll", finger=3)
    assert played(scheduler, 0.0)[0].finger == 3
    touch(scheduler, 3, 0.09, 0.05, 0.005, True)
    scheduler.advance(0.01)
    assert scheduler.queue.next_batch(T_S, 0.0)[0].x_m == 0.09
    touch(scheduler, 3, 0.09, 0.05, 0.012, False)
    scheduler.advance(0.1)
    assert not scheduler.due


def test_what_waits_when_the_outputs_go_off_is_refused_and_not_played_later(scheduler, reported):
    touch(scheduler, 0, 0.05, 0.05, 0.0, True)
    command(scheduler, 1, effect="roll")
    scheduler.reset(0.5)
    assert reported == [(1, Outcome.REFUSED, pytest.approx(0.5))]
    scheduler.advance(1.0)
    assert not scheduler.due


def test_an_unconfirmed_contact_gets_its_allowance_of_emissions_and_no_more(scene, reported):
    sure = set()
    scheduler = scheduler_of(scene, reported, confirmed=lambda finger: finger in sure)
    touch(scheduler, 0, 0.05, 0.05, 0.0, True)
    assert len(played(scheduler, 0.0)) == 1
    for ticket in (1, 2):
        command(scheduler, ticket, finger=0)
    assert not scheduler.due
    assert [outcome for _, outcome, _ in reported] == [Outcome.SKIPPED, Outcome.SKIPPED]
    sure.add(0)
    command(scheduler, 3, finger=0)
    assert scheduler.due


def test_a_contact_that_reuses_a_fingers_number_gets_an_allowance_of_its_own(scene, reported):
    scheduler = scheduler_of(scene, reported, confirmed=lambda _: False)
    for at_s in (0.0, 1.0, 2.0):
        touch(scheduler, 0, 0.05, 0.05, at_s, True)
        assert len(played(scheduler, at_s)) == 1
        touch(scheduler, 0, 0.05, 0.05, at_s + 0.1, False)


def test_a_scene_can_change_while_fingers_are_down(scheduler, board, tmp_path, reported):
    touch(scheduler, 0, 0.05, 0.05, 0.0, True)
    command(scheduler, 1, now_s=0.25)
    file = tmp_path / "other.toml"
    file.write_text('[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 5.0 }]\n')
    scheduler.change_scene(load_scene(file, board), 1.0)
    assert reported == [(1, Outcome.SKIPPED, pytest.approx(0.75))]
    touch(scheduler, 0, 0.056, 0.05, 1.1, True)
    assert scheduler.due


@pytest.mark.parametrize("how", ["lifted", "outputs off"])
def test_a_command_that_ends_before_its_first_emission_is_answered_once(scheduler, reported, how):
    touch(scheduler, 3, 0.1, 0.05, 0.0, True)
    played(scheduler, 0.0)
    command(scheduler, 1, effect="late", finger=3, now_s=1.0)
    assert not scheduler.due
    if how == "lifted":
        touch(scheduler, 3, 0.1, 0.05, 1.003, False)
    else:
        scheduler.reset(1.003)
    scheduler.advance(2.0)
    outcome = {"lifted": Outcome.SKIPPED, "outputs off": Outcome.REFUSED}[how]
    assert reported == [(1, outcome, pytest.approx(0.003))]


def test_fixed_emitters_too_near_each_other_for_their_amplitudes_are_not_repeated_as_one_waveform(board, tmp_path, reported):
    emitters = "".join(
        f'[[regions]]\nname = "{x_mm}"\nshape = "circle"\nx_mm = {x_mm}\ny_mm = 70\nradius_mm = 1\n'
        f'effects = [{{ effect = "always", amplitude = {amplitude} }}]\n'
        for x_mm, amplitude in ((60, 1.0), (63, 0.5))
    )
    (tmp_path / "spots.toml").write_text(emitters)
    assert scheduler_of(load_scene(tmp_path / "spots.toml", board), reported).emitters.common_period_s is None
    (tmp_path / "spots.toml").write_text(emitters.replace("63", "66"))
    assert scheduler_of(load_scene(tmp_path / "spots.toml", board), reported).emitters.common_period_s == 0.04


@each_row(
    ("finger_mm", "policy", "together"),
    [(100, "compose", 2), (65, "compose", 2), (62.5, "compose", 1), (100, "alternate", 1)],
    afresh=[reported],
)
def test_a_spot_due_with_a_finger_joins_its_batch_if_the_policy_allows(board, tmp_path, reported, finger_mm, policy, together):
    emitter = '[[regions]]\nname = "spot"\nshape = "circle"\nx_mm = 60\ny_mm = 70\nradius_mm = 2\neffects = '
    (tmp_path / "fixed emitter.toml").write_text(
        f'{emitter}[{{ effect = "always", amplitude = 0.5 }}]\n'
        f'[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\npolicy = "{policy}"\n'
    )
    scheduler = scheduler_of(load_scene(tmp_path / "fixed emitter.toml", board), reported)
    touch(scheduler, 3, finger_mm * 1e-3, 0.07, 1.0, True)
    emissions = scheduler.join_emitters(scheduler.queue.next_batch(T_S, 0.0), 1.05)
    assert [e.finger for e in emissions] == [3, None][:together]
    assert scheduler.emitters.next_s() == 1.05


def test_trains_of_spots_begin_when_their_scene_does(board, tmp_path, reported):
    (tmp_path / "fixed emitter.toml").write_text(
        '[[regions]]\nname = "spot"\nshape = "circle"\nx_mm = 60\ny_mm = 70\nradius_mm = 2\neffects = ["always"]\n'
    )
    scene = load_scene(tmp_path / "fixed emitter.toml", board)
    scheduler = scheduler_of(scene, reported)
    assert scheduler.emitters.next_s() == 0.0
    scheduler.change_scene(scene, 5.0)
    assert scheduler.emitters.next_s() == 5.0


def test_fingers_that_are_down_when_the_outputs_go_off_stay_known_and_commands_do_not(scheduler):
    touch(scheduler, 3, 0.05, 0.05, 0.0, True)
    command(scheduler, 1, effect="roll")
    scheduler.reset(0.005)
    assert scheduler.next_s() > 1e6
    command(scheduler, 2, finger=3)
    assert scheduler.due


@each_row(("effect", "way_mm"), [("texture", 0.5), ("detent", 0.25)])  # from the touch, from line to line
@each_row(("step_mm", "foreseen"), [(0.09, False), (0.11, True)], afresh=[reported])
def test_a_finger_that_hardly_moves_is_at_rest_and_not_predicted(board, tmp_path, reported, step_mm, foreseen, effect, way_mm):
    (tmp_path / "fine.toml").write_text(
        f'[[regions]]\nname = "all"\nshape = "plate"\neffects = [{{ effect = "{effect}", spacing_mm = 0.5 }}]\n'
    )
    scheduler = scheduler_of(load_scene(tmp_path / "fine.toml", board), reported)

    def place(_, at_s):
        return 0.05 + step_mm * 1e-3 * at_s / 0.01, 0.05

    touch(scheduler, 0, *place(0, 0.0), 0.0, True)
    wanted = next_focus(scheduler.active_effects, scheduler.scene, 0, place, 0.0, 0.01, 2e-3)
    assert (wanted is not None) == foreseen
    if foreseen:
        assert wanted == pytest.approx((*place(0, math.ceil(way_mm / step_mm) * 0.01 + 2e-3), 1.0))
