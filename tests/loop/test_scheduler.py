"""What is under way between two moments: what waits, what replaces what, and what commands are told."""

import pytest

from controller.errors import ConfigError
from controller.loop.commands import Outcome
from controller.loop.scheduler import MOST_WAITING, Performance
from controller.metrics import Counters
from controller.scene.scene import load_scene
from controller.touch.source import TouchSample

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
def told():
    return []


@pytest.fixture
def performance(scene, told):
    return performing(scene, told)


def performing(scene, told, confirmed=lambda _: True, most=1):
    return Performance(scene, Counters(), confirmed, most, lambda ticket, outcome, age_s: told.append((ticket, outcome, age_s)))


def command(performance, ticket, x_m=0.1, y_m=0.07, effect="tap", finger=None, now_s=0.0):
    performance.play(ticket, effect, x_m, y_m, finger, 1.0, now_s)


def played(performance, now_s):
    emissions = performance.take(T_S, 0.0)
    performance.started(emissions, now_s)
    return emissions


def test_a_command_that_is_started_was_played_and_its_age_is_told(performance, told):
    command(performance, 1, now_s=1.0)
    (emission,) = played(performance, 1.004)
    assert (emission.x_m, emission.y_m, emission.finger) == (0.1, 0.07, None)
    assert told == [(1, Outcome.PLAYED, pytest.approx(0.004))]
    assert not performance.due


def test_a_newer_command_for_the_same_place_takes_the_olders(performance, told):
    command(performance, 1)
    command(performance, 2, x_m=0.1004, now_s=0.001)
    assert told == [(1, Outcome.MERGED, pytest.approx(0.001))]
    assert performance._counters.skipped.merged == 1
    assert len(played(performance, 0.002)) == 1
    assert told[1][:2] == (2, Outcome.PLAYED)


def test_commands_for_places_that_are_apart_are_played_together(performance, told):
    for ticket in (1, 2, 3):
        command(performance, ticket, x_m=0.03 * ticket)
    assert len(played(performance, 0.001)) == 3
    assert [(ticket, outcome) for ticket, outcome, _ in told] == [(ticket, Outcome.PLAYED) for ticket in (1, 2, 3)]


def test_of_too_many_commands_the_oldest_is_skipped_and_each_is_told_once(performance, told):
    tickets = range(1, MOST_WAITING + 6)
    for ticket in tickets:
        command(performance, ticket, x_m=0.01 + 0.004 * (ticket % 45), y_m=0.01 + 0.02 * (ticket // 45), now_s=ticket * 1e-6)
    assert [ticket for ticket, outcome, _ in told if outcome is Outcome.SKIPPED] == [1, 2, 3, 4, 5]
    while performance.due:
        played(performance, 0.01)
    assert sorted(ticket for ticket, _, _ in told) == list(tickets)


def test_the_other_beats_of_a_command_are_told_nobody(performance, told):
    command(performance, 1, effect="roll")
    times_s = [played(performance, 0.0)[0].time_s]
    while performance.next_s() < 1.0:
        performance.advance(performance.next_s())
        times_s.append(played(performance, 0.0)[0].time_s)
    assert times_s == pytest.approx([0.0, 0.01, 0.02, 0.03, 0.04])
    assert [outcome for _, outcome, _ in told] == [Outcome.PLAYED]


def test_a_train_keeps_its_distance_to_when_its_first_beat_really_began(performance):
    command(performance, 1, effect="roll")
    played(performance, 0.0031)
    assert performance.next_s() == pytest.approx(0.0131)


def test_of_several_trains_the_next_beat_is_the_earliest(performance):
    for ticket, now_s in ((1, 0.004), (2, 0.0), (3, 0.007)):
        command(performance, ticket, x_m=0.05 * ticket, effect="roll", now_s=now_s)
    assert performance.next_s() == pytest.approx(0.01)
    performance.advance(0.0105)
    assert performance.next_s() == pytest.approx(0.014)


def test_what_is_due_more_than_an_emission_later_goes_on_waiting(performance):
    command(performance, 1, x_m=0.05, now_s=0.0)
    command(performance, 2, x_m=0.15, now_s=T_S + 0.001)
    assert [emission.ticket for emission in performance.take(T_S, 0.004)] == [1]
    assert [emission.ticket for emission in performance.take(T_S, 0.004)] == [2]


def test_an_unknown_effect_or_finger_is_refused_and_nothing_waits(performance, told):
    with pytest.raises(ConfigError, match="no effect 'boom'"):
        command(performance, 1, effect="boom")
    with pytest.raises(ConfigError, match="finger 4 is not on the panel"):
        command(performance, 2, finger=4)
    assert not performance.due
    assert told == []


def test_a_command_for_a_finger_follows_it_and_ends_with_it(performance, told):
    performance.touch(TouchSample(3, 0.05, 0.05, 0.0, True))
    played(performance, 0.0)
    command(performance, 1, effect="roll", finger=3)
    assert played(performance, 0.0)[0].finger == 3
    performance.touch(TouchSample(3, 0.09, 0.05, 0.005, True))
    performance.advance(0.01)
    assert performance.take(T_S, 0.0)[0].x_m == 0.09
    performance.touch(TouchSample(3, 0.09, 0.05, 0.012, False))
    performance.advance(0.1)
    assert not performance.due


def test_what_waits_when_the_outputs_go_off_is_refused_and_not_played_later(performance, told):
    performance.touch(TouchSample(0, 0.05, 0.05, 0.0, True))
    command(performance, 1, effect="roll")
    performance.interrupted(0.5)
    assert told == [(1, Outcome.REFUSED, pytest.approx(0.5))]
    performance.advance(1.0)
    assert not performance.due


def test_a_contact_that_nobody_has_confirmed_gets_its_share_and_no_more(scene, told):
    sure = set()
    performance = performing(scene, told, confirmed=lambda finger: finger in sure)
    performance.touch(TouchSample(0, 0.05, 0.05, 0.0, True))
    assert len(played(performance, 0.0)) == 1
    for ticket in (1, 2):
        command(performance, ticket, finger=0)
    assert not performance.due
    assert [outcome for _, outcome, _ in told] == [Outcome.SKIPPED, Outcome.SKIPPED]
    sure.add(0)
    command(performance, 3, finger=0)
    assert performance.due


def test_another_scene_takes_over_while_fingers_are_down(performance, board, tmp_path, told):
    performance.touch(TouchSample(0, 0.05, 0.05, 0.0, True))
    command(performance, 1, now_s=0.25)
    file = tmp_path / "other.toml"
    file.write_text('[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 5.0 }]\n')
    performance.swap(load_scene(file, board), 1.0)
    assert told == [(1, Outcome.SKIPPED, pytest.approx(0.75))]
    performance.touch(TouchSample(0, 0.056, 0.05, 1.1, True))
    assert performance.due


@pytest.mark.parametrize("how", ["lifted", "outputs off"])
def test_a_command_that_ends_before_its_first_emission_is_told_so_once(performance, told, how):
    performance.touch(TouchSample(3, 0.1, 0.05, 0.0, True))
    played(performance, 0.0)
    command(performance, 1, effect="late", finger=3, now_s=1.0)
    assert not performance.due
    if how == "lifted":
        performance.touch(TouchSample(3, 0.1, 0.05, 1.003, False))
    else:
        performance.interrupted(1.003)
    performance.advance(2.0)
    outcome = {"lifted": Outcome.SKIPPED, "outputs off": Outcome.REFUSED}[how]
    assert told == [(1, outcome, pytest.approx(0.003))]


def test_spots_that_would_spoil_each_other_are_not_repeated_as_one_waveform(board, tmp_path, told):
    spots = "".join(
        f'[[regions]]\nname = "{x_mm}"\nshape = "circle"\nx_mm = {x_mm}\ny_mm = 70\nradius_mm = 2\neffects = ["always"]\n'
        for x_mm in (60, 66)
    )
    (tmp_path / "spots.toml").write_text(spots)
    assert performing(load_scene(tmp_path / "spots.toml", board), told).common_period_s is None
    (tmp_path / "spots.toml").write_text(spots.replace("66", "80"))
    assert performing(load_scene(tmp_path / "spots.toml", board), told).common_period_s == 0.04


@pytest.mark.parametrize(("finger_mm", "policy", "together"), [(100, "compose", 2), (65, "compose", 1), (100, "alternate", 1)])
def test_a_spot_that_is_due_with_a_finger_takes_part_if_the_policy_lets_it(board, tmp_path, told, finger_mm, policy, together):
    spot = '[[regions]]\nname = "spot"\nshape = "circle"\nx_mm = 60\ny_mm = 70\nradius_mm = 2\neffects = ["always"]\n'
    (tmp_path / "spot.toml").write_text(
        f'{spot}[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\npolicy = "{policy}"\n'
    )
    performance = performing(load_scene(tmp_path / "spot.toml", board), told)
    performance.touch(TouchSample(3, finger_mm * 1e-3, 0.07, 1.0, True))
    emissions = performance.with_spots(performance.take(T_S, 0.0), 1.05)
    assert [e.finger for e in emissions] == [3, None][:together]
    assert performance.next_spot_s() == 1.05


def test_spots_beat_from_when_their_scene_is_taken_over(board, tmp_path, told):
    (tmp_path / "spot.toml").write_text(
        '[[regions]]\nname = "spot"\nshape = "circle"\nx_mm = 60\ny_mm = 70\nradius_mm = 2\neffects = ["always"]\n'
    )
    scene = load_scene(tmp_path / "spot.toml", board)
    performance = performing(scene, told)
    assert performance.next_spot_s() == 0.0
    performance.swap(scene, 5.0)
    assert performance.next_spot_s() == 5.0


def test_fingers_that_are_down_when_the_outputs_go_off_stay_known_and_commands_do_not(performance):
    performance.touch(TouchSample(3, 0.05, 0.05, 0.0, True))
    command(performance, 1, effect="roll")
    performance.interrupted(0.005)
    assert performance.next_s() > 1e6
    command(performance, 2, finger=3)
    assert performance.due


@pytest.mark.parametrize(("step_mm", "foreseen"), [(0.09, False), (0.11, True)])
def test_a_finger_that_hardly_moves_is_at_rest_and_nothing_is_foreseen_for_it(board, tmp_path, told, step_mm, foreseen):
    (tmp_path / "fine.toml").write_text(
        '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 0.5 }]\n'
    )
    performance = performing(load_scene(tmp_path / "fine.toml", board), told)
    speed_m_s = step_mm * 1e-3 / 0.01
    for k in range(3):
        performance.touch(TouchSample(0, 0.05 + speed_m_s * 0.01 * k, 0.05, 0.01 * k, True))
    wanted = performance.expected(0, lambda _, at_s: (0.05 + speed_m_s * at_s, 0.05), 0.02, 0.01, 2e-3)
    assert (wanted is not None) == foreseen
