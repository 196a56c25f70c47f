"""What plays together: by hand, and over many turns of the plate."""

import math

from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.loop.playing.batching import CROWD_M, MAX_FOCI, MAX_NEIGHBOURS, MERGE_RADIUS_M, SEPARATION_M, select_batch
from controller.device.scene.emission import Emission

T_S = 2e-3


def emission(owner, x_mm, time_ms=0.0, *, y_mm=70.0, alternate=False, amplitude=1.0):
    return Emission(time_ms * 1e-3, x_mm * 1e-3, y_mm * 1e-3, None, "r", amplitude, owner, alternate=alternate)


def owners(emissions):
    return [e.owner for e in emissions]


def chosen_of(*due, max_foci=MAX_FOCI):
    chosen, rest = select_batch(due, T_S, max_foci)
    assert sorted(owners(chosen) + owners(rest)) == sorted(owners(due))
    return owners(chosen)


def test_what_is_due_within_t_of_the_first_is_one_waveform():
    assert chosen_of(emission("a", 20), emission("b", 60, 1.9), emission("c", 100, 2.1), emission("d", 140, -5)) == ["a", "b", "d"]


def test_alternating_emissions_go_alone_and_the_others_do_not_take_them_along():
    alone = emission("alone", 20, alternate=True)
    assert chosen_of(alone, emission("b", 60), emission("c", 100)) == ["alone"]
    assert chosen_of(emission("b", 60), alone, emission("c", 100)) == ["b", "c"]


@each_row(("apart_m", "unlike"), [(0.0, False), (0.99 * SEPARATION_M, False), (1.01 * SEPARATION_M, True), (9e-3, True)])
@each_row("angle", [0.0, 1.0, 2.5])
def test_two_near_foci_are_played_together_if_they_can_have_what_they_ask_for(apart_m, unlike, angle):
    x_mm, y_mm = 60 + apart_m * 1e3 * math.cos(angle), 70 + apart_m * 1e3 * math.sin(angle)
    assert chosen_of(emission("a", 60), emission("b", x_mm, y_mm=y_mm)) == ["a", "b"]
    assert chosen_of(emission("a", 60), emission("b", x_mm, y_mm=y_mm, amplitude=0.5)) == (["a", "b"] if unlike else ["a"])


def test_one_place_cannot_have_two_amplitudes_at_once():
    assert chosen_of(emission("a", 60), emission("b", 61, amplitude=0.5)) == ["a"]
    assert chosen_of(emission("a", 60, amplitude=0.5), emission("b", 61, amplitude=0.5)) == ["a", "b"]


def test_an_emission_too_near_a_chosen_one_waits_and_the_next_is_chosen():
    due = emission("a", 60), emission("b", 63, amplitude=0.5), emission("c", 100), emission("d", 103, amplitude=0.5)
    assert chosen_of(*due) == ["a", "c"]
    here, exactly = (Emission(0.0, x_m, 0.0, None, "r", 0.5 + bool(x_m) / 2, x_m) for x_m in (0.0, SEPARATION_M))
    assert chosen_of(here, exactly) == [0.0, SEPARATION_M]


def test_of_a_crowd_each_has_three_others_near_and_the_rest_waits():
    square = [emission("a", 60), emission("b", 64), emission("c", 60, y_mm=74), emission("d", 64, y_mm=74)]
    assert chosen_of(*square, emission("e", 62, y_mm=77), emission("f", 100)) == ["a", "b", "c", "d", "f"]
    star = [emission(f"star {k}", 60 + 5 * math.cos(k * 2.1), y_mm=70 + 5 * math.sin(k * 2.1)) for k in range(3)]
    assert chosen_of(emission("middle", 60), *star, emission("late", 60.1, y_mm=64)) == ["middle", "star 0", "star 1", "star 2"]


def test_ten_foci_on_one_place_are_no_crowd():
    assert len(chosen_of(*[emission(k, 60 + 0.1 * k) for k in range(10)])) == 10


def test_ten_foci_are_one_waveform_and_the_eleventh_waits():
    due = [emission(k, 10 * k) for k in range(12)]
    assert chosen_of(*due) == list(range(10))
    assert chosen_of(*due, max_foci=3) == [0, 1, 2]


places = st.tuples(st.floats(0, 200), st.floats(0, 140))
trains = st.lists(st.tuples(st.floats(0.5, 30), st.floats(0, 10), places, st.booleans()), min_size=1, max_size=8)


@given(trains, st.floats(2, 8))
def test_no_owner_starves_whatever_the_others_do(trains, turn_ms):
    """Each owner's newest emission replaces the one that waits, in its place: then none waits more turns than there are owners."""
    due, waited, next_ms = {}, {}, [phase_ms for _, phase_ms, _, _ in trains]
    for turn in range(60):
        now_ms = turn * turn_ms
        for owner, (period_ms, _, (x_mm, y_mm), alternate) in enumerate(trains):
            while next_ms[owner] <= now_ms:
                due[owner] = emission(owner, x_mm, next_ms[owner], y_mm=y_mm, alternate=alternate)
                next_ms[owner] += period_ms
        if not due:
            continue
        chosen, rest = select_batch(list(due.values()), T_S)
        assert chosen
        assert len(chosen) == 1 or not any(e.alternate for e in chosen)
        for e in chosen:
            del due[e.owner]
            waited.pop(e.owner, None)
        assert owners(rest) == list(due)
        for e in rest:
            waited[e.owner] = waited.get(e.owner, 0) + 1
            assert waited[e.owner] < len(trains)


near_places = st.tuples(st.floats(60, 75), st.floats(60, 75))


@given(
    st.lists(
        st.tuples(st.one_of(places, near_places), st.floats(0, 5), st.booleans(), st.sampled_from([1.0, 1.0, 0.5])),
        min_size=1,
        max_size=14,
    ),
    st.integers(1, 10),
)
def test_every_batch_keeps_the_rules_and_no_emission_is_lost(wanted, max_foci):
    due = [emission(k, x, at, y_mm=y, alternate=alone, amplitude=a) for k, ((x, y), at, alone, a) in enumerate(wanted)]
    chosen, rest = select_batch(due, T_S, max_foci)
    assert sorted((*chosen, *rest), key=lambda e: e.owner) == due
    assert chosen[0] is due[0]
    assert len(chosen) <= max_foci
    assert all(e.time_s <= chosen[0].time_s + T_S for e in chosen)
    for one in chosen:
        apart_m = [math.dist((one.x_m, one.y_m), (other.x_m, other.y_m)) for other in chosen]
        assert sum(MERGE_RADIUS_M * 1.0001 < apart < CROWD_M * 0.9999 for apart in apart_m) <= MAX_NEIGHBOURS
        for other, apart in zip(chosen, apart_m, strict=True):
            assert one.amplitude == other.amplitude or apart >= SEPARATION_M * 0.9999
