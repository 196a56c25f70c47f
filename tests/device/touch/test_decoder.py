import math

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.touch.associate import assignment
from controller.device.touch.axes import AxisRange, PanelAxes
from controller.device.touch.decoder import MAX_SLOTS, MAX_UNNAMED, Decoder
from controller.device.touch.event_codes import Protocol, protocol_of, protocol_of_device
from controller.device.touch.plausibility import MAX_PLAYED

BOARD = load_board(data_folder("boards") / "simulated")
AXES = PanelAxes(BOARD, AxisRange(0, 2100), AxisRange(0, 1480))  # a tenth of a millimetre each

SYN, KEY, ABS = 0, 1, 3
SLOT, MAJOR, X, Y, TOOL, ID, DISTANCE, TOUCH = 0x2F, 0x30, 0x35, 0x36, 0x37, 0x39, 0x3B, 0x14A
REPORT, MT_REPORT, DROPPED = (SYN, 0, 0), (SYN, 2, 0), (SYN, 3, 0)


def decoder(protocol=Protocol.B, **settings):
    return Decoder(AXES, protocol, **settings)


def play(decoder, *events):
    """Feeds (code, value) of EV_ABS or (type, code, value); gives (finger, x in mm, y in mm, contact) of all reports."""
    samples = []
    for event in events:
        kind, code, value = event if len(event) == 3 else (ABS, *event)
        samples += decoder.feed(kind, code, value, 1.5) or ()
    assert all(sample.time_s == 1.5 for sample in samples)
    return [(s.finger, round(s.x_m * 1e3, 6), round(s.y_m * 1e3, 6), s.contact) for s in samples]


def counts(decoder):
    return decoder.counts.reports, decoder.counts.contacts, decoder.counts.max_fingers


def test_protocol_b_begins_moves_and_releases():
    d = decoder()
    assert play(d, (ID, 7), (X, 100), (Y, 200), REPORT) == [(0, 10, 20, True)]
    assert play(d, (X, 110), REPORT) == [(0, 11, 20, True)]
    assert play(d, (ID, -1), REPORT) == [(0, 11, 20, False)]
    assert counts(d) == (2, 1, 1)


def test_a_finger_at_rest_gives_no_samples_but_counts():
    d = decoder()
    play(d, (ID, 7), (X, 100), (Y, 200), REPORT)
    assert play(d, (4, 5, 1234), REPORT, (X, 100), (Y, 200), REPORT) == []
    assert counts(d) == (3, 1, 1)


def test_a_report_with_a_contact_down_is_reported_be_that_at_rest():
    d = decoder()
    for events, touched in (
        ([(ID, 7), (X, 100), (Y, 200), REPORT], True),
        ([(X, 110)], False),  # the rest of the report has yet to come
        ([REPORT], True),
        ([REPORT], True),
        ([(DISTANCE, 3), REPORT], False),
        ([(DISTANCE, 0), REPORT], True),
        ([(ID, -1), REPORT], False),
    ):
        play(d, *events)
        assert d.touched == touched
    play(d, (ID, 8), (X, 100), (Y, 200), REPORT)
    assert play(d, DROPPED, REPORT) == [(2, 10, 20, False)]
    assert not d.touched


def test_a_place_reported_twice_in_one_report_has_moved_all_the_same():
    d = decoder()
    play(d, (ID, 7), (X, 100), (Y, 200), REPORT)
    assert play(d, (X, 110), (X, 110), REPORT) == [(0, 11, 20, True)]
    assert play(d, (Y, 210), (Y, 210), REPORT) == [(0, 11, 21, True)]


@each_row("away", [-1, -2, -3, -(1 << 31)])
def test_any_negative_tracking_id_ends_the_contact(away):
    d = decoder()
    play(d, (ID, 7), (X, 100), (Y, 200), REPORT)
    assert play(d, (ID, away), REPORT, (X, 110), REPORT) == [(0, 10, 20, False)]


def test_a_slot_keeps_its_position_from_one_contact_to_the_next():
    d = decoder()
    play(d, (ID, 7), (X, 100), (Y, 200), REPORT, (ID, -1), REPORT)
    assert play(d, (ID, 8), (Y, 300), REPORT) == [(1, 10, 30, True)]


def test_slots_are_different_fingers_and_the_slot_stays_current_across_reports():
    d = decoder()
    assert play(d, (ID, 1), (X, 10), (Y, 10), (SLOT, 1), (ID, 2), (X, 20), (Y, 20), REPORT) == [(0, 1, 1, True), (1, 2, 2, True)]
    assert play(d, (X, 30), REPORT) == [(1, 3, 2, True)]
    assert play(d, (SLOT, 0), (ID, -1), REPORT) == [(0, 1, 1, False)]
    assert counts(d) == (3, 2, 2)


def test_another_tracking_id_in_the_same_slot_is_another_finger():
    d = decoder()
    play(d, (ID, 7), (X, 100), (Y, 200), REPORT)
    assert play(d, (ID, 8), REPORT) == [(0, 10, 20, False), (1, 10, 20, True)]
    assert play(d, (ID, -1), (ID, 9), (X, 0), REPORT) == [(1, 10, 20, False), (2, 0, 20, True)]
    assert counts(d) == (3, 3, 1)


def test_a_contact_that_comes_and_goes_within_one_report_is_counted_only():
    d = decoder()
    assert play(d, (ID, 7), (X, 100), (Y, 200), (ID, -1), REPORT) == []
    assert counts(d) == (0, 1, 0)


def test_protocol_b_that_starts_in_mid_contact_has_a_finger_once_its_place_is_known():
    d = decoder()
    assert play(d, (X, 100), REPORT) == []
    assert play(d, (Y, 200), REPORT) == [(0, 10, 20, True)]
    assert play(d, (ID, -1), REPORT) == [(0, 10, 20, False)]
    assert play(d, (X, 300), REPORT) == []  # nobody is there any more
    assert counts(d) == (2, 0, 1)


def test_a_contact_that_was_there_before_the_stream_can_hover_and_touch_again():
    d = decoder()
    assert play(d, (X, 100), (Y, 200), REPORT) == [(0, 10, 20, True)]
    assert play(d, (KEY, TOUCH, 0), REPORT) == [(0, 10, 20, False)]
    assert play(d, (KEY, TOUCH, 1), REPORT) == [(1, 10, 20, True)]


def test_the_slot_current_at_the_start_can_be_given():
    d = decoder(slot=2)
    assert play(d, (ID, 7), (X, 1), (Y, 1), REPORT, (SLOT, 2), (X, 2), REPORT) == [(0, 0.1, 0.1, True), (0, 0.2, 0.1, True)]


@pytest.mark.parametrize("known", [X, Y])
def test_a_contact_without_position_waits_for_it(known):
    d = decoder()
    assert play(d, (ID, 7), REPORT, (known, 5), REPORT) == []
    assert play(d, (X, 5), (Y, 5), REPORT) == [(0, 0.5, 0.5, True)]
    assert counts(d) == (3, 1, 1)


@pytest.mark.parametrize("hover", [(DISTANCE, 1), (KEY, TOUCH, 0)])
def test_hovering_is_no_contact(hover):
    touch = (DISTANCE, 0) if hover[0] == DISTANCE else (KEY, TOUCH, 1)
    d = decoder()
    assert play(d, hover, (ID, 6), (X, 100), (Y, 200), (ID, -1), REPORT) == []
    assert play(d, (ID, 7), REPORT, (X, 120), REPORT) == []
    assert counts(d) == (0, 0, 0)
    assert play(d, touch, REPORT) == [(0, 12, 20, True)]
    assert play(d, hover, REPORT) == [(0, 12, 20, False)]
    assert play(d, touch, REPORT) == [(1, 12, 20, True)]  # felt as a new press, counted as the same contact
    assert counts(d) == (2, 1, 1)


def test_a_palm_is_counted_but_not_played():
    d = decoder()
    assert play(d, (ID, 7), (TOOL, 2), (X, 100), (Y, 200), REPORT) == []
    assert play(d, (SLOT, 1), (ID, 8), (TOOL, 0), (X, 1), (Y, 1), REPORT) == [(0, 0.1, 0.1, True)]
    assert play(d, (TOOL, 2), REPORT) == [(0, 0.1, 0.1, False)]
    assert counts(d) == (3, 2, 2)


def test_ten_fingers_are_played_and_all_are_counted():
    d = decoder(last_slot=11)
    begin = [event for slot in range(12) for event in ((SLOT, slot), (ID, slot), (X, slot), (Y, 0))]
    assert [finger for finger, *_ in play(d, *begin, REPORT)] == list(range(MAX_PLAYED))
    assert counts(d) == (1, 12, 12)
    assert d.warnings == {"more_than_played": 2}
    assert play(d, (SLOT, 0), (ID, -1), (SLOT, 11), (X, 50), REPORT) == [(0, 0, 0, False)]  # no press in mid-touch
    assert play(d, (SLOT, 0), (ID, 20), REPORT) == [(10, 0, 0, True)]


@pytest.mark.parametrize("again", [[(ID, -1), (ID, 20), REPORT], [(DISTANCE, 1), REPORT, (DISTANCE, 0), REPORT]])
def test_a_finger_left_out_is_played_when_it_comes_anew(again):
    d = decoder()
    play(d, *[event for slot in range(11) for event in ((SLOT, slot), (ID, slot), (X, slot), (Y, 0))], REPORT)
    assert play(d, (SLOT, 0), (ID, -1), REPORT) == [(0, 0, 0, False)]
    assert play(d, (SLOT, 10), *again) == [(10, 1, 0, True)]


def test_slots_beyond_the_declared_range_are_decoded_with_a_warning_and_impossible_ones_skipped():
    d = decoder(last_slot=4)
    assert play(d, (SLOT, 7), (ID, 1), (X, 10), (Y, 10), REPORT, (X, 20), REPORT) == [(0, 1, 1, True), (0, 2, 1, True)]
    assert play(d, (SLOT, -1), (ID, 2), (X, 10), (Y, 10), REPORT, (SLOT, MAX_SLOTS), (ID, 3), (X, 10), REPORT) == []
    assert d.warnings == {"slot_beyond_range": 1, "slot_absurd": 2}


def test_without_a_declared_range_every_possible_slot_is_taken():
    d = decoder()
    assert play(d, (SLOT, MAX_SLOTS - 1), (ID, 1), (X, 10), (Y, 10), REPORT) == [(0, 1, 1, True)]
    assert not d.warnings


def test_positions_outside_the_axes_are_clamped_and_counted():
    d = decoder()
    assert play(d, (ID, 1), (X, -5), (Y, 1530), REPORT, (ID, 2), (X, 2150), REPORT) == [
        (0, 0, 148, True),
        (0, 0, 148, False),
        (1, 210, 148, True),
    ]
    assert play(d, (X, 2149), REPORT, (ID, 3), (X, 10), (Y, -1), REPORT) == [
        (1, 210, 148, True),
        (1, 210, 148, False),
        (2, 1, 0, True),
    ]
    assert d.warnings == {"outside_axes": 4}


def test_extra_axes_change_nothing():
    extra = [(MAJOR, 0), (0x34, 3), (0x3A, 200), (0x18, 40), (0, 77), (1, 78), (4, 5, 999), (KEY, 0x145, 1), (2, 0, 5)]
    extra += [(4, TOUCH, 0), MT_REPORT]
    d = decoder()
    assert play(d, *extra, REPORT) == []
    assert counts(d) == (0, 0, 0)
    assert play(d, (ID, 1), *extra, (X, 10), (Y, 10), *extra, REPORT, *extra, REPORT) == [(0, 1, 1, True)]


def test_protocol_a_with_tracking_ids():
    d = decoder(Protocol.A)
    both = [(ID, 4), (X, 100), (Y, 100), MT_REPORT, (ID, 9), (X, 200), (Y, 200), MT_REPORT, REPORT]
    assert play(d, *both) == [(0, 10, 10, True), (1, 20, 20, True)]
    assert play(d, *both) == []
    assert play(d, (ID, 9), (X, 210), (Y, 200), MT_REPORT, REPORT) == [(0, 10, 10, False), (1, 21, 20, True)]
    assert play(d, MT_REPORT, REPORT) == [(1, 21, 20, False)]
    assert counts(d) == (3, 2, 2)


def test_protocol_a_tells_contacts_with_a_tracking_id_from_those_without():
    d = decoder(Protocol.A)
    other = [(X, 1000), (Y, 1000), MT_REPORT]
    assert play(d, (ID, 0), (X, 100), (Y, 100), MT_REPORT, *other, REPORT) == [(0, 10, 10, True), (1, 100, 100, True)]
    assert play(d, (ID, 0), (X, 150), (Y, 100), MT_REPORT, *other, REPORT) == [(0, 15, 10, True)]
    assert play(d, (X, 150), (Y, 110), MT_REPORT, *other, REPORT) == [(0, 15, 10, False), (2, 15, 11, True)]


def test_protocol_a_takes_the_first_of_two_contacts_with_the_same_tracking_id():
    both = [(ID, 4), (X, 100), (Y, 100), MT_REPORT, (ID, 4), (X, 200), (Y, 200), MT_REPORT]
    assert play(decoder(Protocol.A), *both, REPORT) == [(0, 10, 10, True)]


def test_protocol_a_begins_a_report_with_nothing_known():
    d = decoder(Protocol.A)
    assert play(d, (X, 5), MT_REPORT, REPORT, (Y, 5), MT_REPORT, REPORT) == []  # no place, no contact
    assert counts(d) == (0, 0, 0)
    assert play(d, (MAJOR, 0), REPORT) == []
    assert play(d, (X, 5), (Y, 5), REPORT) == [(0, 0.5, 0.5, True)]  # SYN_REPORT closes the last contact as well


def test_protocol_a_takes_so_many_contacts_in_one_report_and_counts_the_rest():
    d = decoder(Protocol.A)
    play(d, *[event for k in range(MAX_SLOTS + 2) for event in ((ID, k), (X, k), (Y, 0), MT_REPORT)], REPORT)
    assert counts(d) == (1, MAX_SLOTS, MAX_SLOTS)
    assert d.warnings["contacts_absurd"] == 2


def test_protocol_a_pairs_each_contact_once_and_none_over_more_than_a_step():
    d = decoder(Protocol.A)

    def x_mm(*places):
        return [event for x in places for event in ((X, 10 * x), (Y, 100), MT_REPORT)]

    assert play(d, *x_mm(30), REPORT) == [(0, 30, 10, True)]
    assert sorted(play(d, *x_mm(10, 31), REPORT)) == [(0, 31, 10, True), (1, 10, 10, True)]
    assert sorted(play(d, *x_mm(25, 12), REPORT)) == [(0, 25, 10, True), (1, 12, 10, True)]
    assert play(d, *x_mm(24), REPORT) == [(1, 12, 10, False), (0, 24, 10, True)]
    assert play(d, *x_mm(53), REPORT, *x_mm(53), REPORT) == [(0, 53, 10, True)]  # 29 mm on: the same, once it is confirmed
    assert play(d, *x_mm(84), REPORT) == [(0, 53, 10, False), (2, 84, 10, True)]  # 31 mm on
    assert play(d, *x_mm(84, 150), REPORT, *x_mm(84, 150, 200), REPORT) == [(3, 150, 10, True), (4, 200, 10, True)]
    assert [finger for finger, _, _ in d.fingers()] == [2, 3, 4]


def passing(seed, *, period_s=8e-3, apart_m=3e-3, noise_m=0.1e-3, speeds=(0.3, 0.3)):
    """Finger numbers of two fingers, each report's in the order of the fingers, that pass each other at any angle."""
    random = np.random.default_rng(seed)
    first, between = random.uniform(0, 2 * np.pi), random.uniform(np.pi / 2, 3 * np.pi / 2)
    velocity = np.array([[speed * f(first + k * between) for f in (np.cos, np.sin)] for k, speed in enumerate(speeds)])
    along = velocity[1] - velocity[0]
    aside = apart_m / 2 * np.array([-along[1], along[0]]) / np.hypot(*along) * random.choice([-1, 1])
    d, found, phase = decoder(Protocol.A), [], random.uniform(-0.5, 0.5)
    reports = int(0.06 / max(speeds) / period_s)  # on the plate, before they meet and after
    for k in range(-reports, reports + 1):
        time_s = (k + phase + random.uniform(-0.05, 0.05)) * period_s
        places = velocity * time_s + [0.105, 0.074] + np.array([-aside, aside]) + random.normal(0, noise_m, (2, 2))
        raw = np.rint(places * 1e4).astype(int).tolist()
        for finger in random.permutation(2).tolist():
            for event in ((ABS, X, raw[finger][0]), (ABS, Y, raw[finger][1]), MT_REPORT):
                d.feed(*event, time_s)
        d.feed(*REPORT, time_s)
        by_place = {(round(x_m * 1e4), round(y_m * 1e4)): finger for finger, x_m, y_m in d.fingers()}
        found.append([by_place.get(tuple(place)) for place in raw])
    return found


@each_row("how", [{}, {"noise_m": 0.3e-3}, {"speeds": (0.5, 0.5)}, {"period_s": 16e-3}, {"apart_m": 1.5e-3}], ids=str)
def test_protocol_a_keeps_fingers_that_pass_each_other_apart(how):
    swapped = sum(found[-1] != found[0] for found in (passing(seed, **how) for seed in range(100)))
    assert swapped < 5  # nearest first: 40 in the first case, 89 in the last


def test_protocol_a_forgets_velocities_in_a_pause():
    d = decoder(Protocol.A)
    place = [(ABS, Y, 100), MT_REPORT, REPORT]
    for event in ((ABS, X, 100), *place, MT_REPORT, REPORT):  # it reports releases: silence is none
        d.feed(*event, -0.1)
    for k in range(10):
        for event in ((ABS, X, 100 + 24 * k), *place):  # 300 mm/s
            d.feed(*event, k * 8e-3)
    for event in ((ABS, X, 100 + 24 * 9 + 200), *place):  # 20 mm on after a rest: as a finger at 300 mm/s it would be 10 mm back
        d.feed(*event, 0.172)
    assert [finger for finger, _, _ in d.fingers()] == [1]
    for event in ((ABS, X, 100 + 24 * 9 + 200 - 290), *place):  # 29 mm back
        d.feed(*event, 0.180)
    assert [finger for finger, _, _ in d.fingers()] == [1]


def test_protocol_a_takes_only_so_many_contacts_without_tracking_id():
    d = decoder(Protocol.A)
    flood = [event for k in range(MAX_UNNAMED + 2) for event in ((X, 10 * k), (Y, 0), MT_REPORT)]
    play(d, *flood, REPORT, *flood, REPORT)
    assert counts(d) == (2, MAX_UNNAMED, MAX_UNNAMED)
    assert d.warnings["contacts_absurd"] == 4


costs = st.integers(1, 10).flatmap(
    lambda rows: st.lists(
        st.lists(st.one_of(st.just(math.inf), st.floats(0, 1), st.integers(0, 3)), min_size=7, max_size=7),
        min_size=rows,
        max_size=rows,
    )
)


@given(costs)
def test_the_assignment_is_the_cheapest_there_is(found):
    """Against scipy's; the last columns are for rows that get none, as `associate` has them."""
    rows = [row + [2.0] * len(found) for row in found]
    columns = assignment(rows)
    assert len(set(columns)) == len(rows)
    exact = np.array(rows)[linear_sum_assignment(rows)].sum()
    assert sum(row[column] for row, column in zip(rows, columns, strict=True)) == pytest.approx(exact, abs=1e-9)


def test_nothing_to_assign_is_no_error():
    assert assignment([]) == []


def test_a_palm_in_protocol_a_is_counted_but_not_played():
    d = decoder(Protocol.A)
    place = [(X, 100), (Y, 100), MT_REPORT, REPORT]
    assert play(d, *place) == [(0, 10, 10, True)]
    assert play(d, (TOOL, 2), *place) == [(0, 10, 10, False)]
    assert play(d, MT_REPORT, REPORT) == []
    assert counts(d) == (2, 1, 1)


def test_protocol_a_without_tracking_ids_goes_by_distance():
    d = decoder(Protocol.A)
    one, two = [(X, 100), (Y, 100), MT_REPORT], [(X, 1000), (Y, 1000), MT_REPORT]
    assert play(d, *one, *two, REPORT) == [(0, 10, 10, True), (1, 100, 100, True)]
    swapped = [(X, 1010), (Y, 1000), MT_REPORT, (X, 110), (Y, 100), MT_REPORT]
    assert sorted(play(d, *swapped, REPORT)) == [(0, 11, 10, True), (1, 101, 100, True)]
    far = [(X, 1010), (Y, 1000), MT_REPORT, (X, 1800), (Y, 100), MT_REPORT]
    assert play(d, *far, REPORT) == [(0, 11, 10, False), (2, 180, 10, True)]
    assert counts(d) == (3, 3, 2)


@each_row("lift", [[(MAJOR, 0), (X, 100), (Y, 100), MT_REPORT], [MT_REPORT], [(KEY, TOUCH, 0)]])
def test_protocol_a_lifts(lift):
    d = decoder(Protocol.A)
    assert play(d, (KEY, TOUCH, 1), (MAJOR, 5), (X, 100), (Y, 100), MT_REPORT, REPORT) == [(0, 10, 10, True)]
    assert play(d, (KEY, 0x66, 1), REPORT) == []  # a report about something else
    assert play(d, *lift, REPORT) == [(0, 10, 10, False)]
    assert play(d, (KEY, TOUCH, 1), (X, 100), (Y, 100), MT_REPORT, REPORT) == [(1, 10, 10, True)]
    assert counts(d) == (3, 2, 1)


def test_single_touch():
    d = decoder(Protocol.SINGLE)
    assert play(d, (X, 5), (0, 100), (1, 200), REPORT) == []  # hovering
    assert play(d, (KEY, TOUCH, 1), REPORT) == [(0, 10, 20, True)]
    assert play(d, (0, 110), REPORT, (KEY, TOUCH, 2), REPORT) == [(0, 11, 20, True)]
    assert play(d, (ID, -1), (DISTANCE, 1), (TOOL, 2), REPORT) == []  # axes of the other protocols
    assert play(d, (KEY, TOUCH, 0), REPORT) == [(0, 11, 20, False)]
    assert play(d, (KEY, TOUCH, 1), (0, 0), REPORT) == [(1, 0, 20, True)]
    assert counts(d) == (5, 2, 1)


def test_after_lost_events_a_recording_releases_all_fingers_and_a_finger_that_moves_on_begins_anew():
    d = decoder()
    play(d, (ID, 7), (X, 100), (Y, 200), REPORT)
    assert play(d, (X, 110), DROPPED, (X, 500), (ID, -1), (ID, 9), DROPPED) == []
    assert play(d, REPORT) == [(0, 10, 20, False)]
    assert play(d, REPORT) == []
    assert play(d, (X, 120), (Y, 210), REPORT) == [(1, 12, 21, True)]
    assert d.warnings == {"dropped": 1}
    assert counts(d) == (2, 1, 1)


@pytest.mark.parametrize("protocol", [Protocol.A, Protocol.SINGLE])
def test_after_lost_events_no_finger_is_stuck(protocol):
    d = decoder(protocol)
    x, y = ((0, 5), (1, 5)) if protocol is Protocol.SINGLE else ((X, 5), (Y, 5))
    assert play(d, (KEY, TOUCH, 1), x, y, MT_REPORT, REPORT) == [(0, 0.5, 0.5, True)]
    assert play(d, DROPPED, (KEY, TOUCH, 0), MT_REPORT, REPORT) == [(0, 0.5, 0.5, False)]
    assert play(d, (KEY, TOUCH, 1), x, y, MT_REPORT, REPORT) == [(1, 0.5, 0.5, True)]


def test_after_lost_events_a_recording_keeps_its_slot_but_not_what_it_knew_of_btn_touch():
    d = decoder()
    play(d, (SLOT, 1), (ID, 7), (X, 100), (Y, 200), (KEY, TOUCH, 0), REPORT, DROPPED, REPORT)
    assert play(d, (X, 120), (Y, 210), REPORT) == [(0, 12, 21, True)]
    assert play(d, (SLOT, 1), (X, 130), REPORT) == [(0, 13, 21, True)]


@pytest.mark.parametrize("lost", [True, False])
def test_what_an_unfinished_report_replaced_is_released_once(lost):
    d = decoder()
    play(d, (ID, 7), (X, 100), (Y, 200), REPORT, (ID, 8))
    assert (play(d, DROPPED, REPORT) if lost else [s[0] for s in d.release(1.5)]) == ([(0, 10, 20, False)] if lost else [0])
    assert play(d, REPORT) == []


def test_after_lost_events_contacts_of_an_unfinished_report_of_protocol_a_are_forgotten():
    d = decoder(Protocol.A)
    assert play(d, (X, 100), (Y, 100), MT_REPORT, DROPPED, REPORT, MT_REPORT, REPORT) == []


def sizes_mm(d, *events):
    samples = []
    for event in events:
        kind, code, value = event if len(event) == 3 else (ABS, *event)
        samples += d.feed(kind, code, value, 0.0) or ()
    return [(s.finger, round(s.size_m * 1e3, 6), s.contact) for s in samples]


def test_the_size_of_a_contact_is_reported_in_the_units_of_its_place():
    d = decoder()
    assert sizes_mm(d, (ID, 7), (MAJOR, 85), (X, 100), (Y, 200), REPORT) == [(0, 8.5, True)]
    assert sizes_mm(d, (MAJOR, 90), REPORT) == []  # a finger at rest that presses harder has not moved
    assert sizes_mm(d, (X, 110), REPORT, (ID, -1), REPORT) == [(0, 9.0, True), (0, 9.0, False)]
    assert sizes_mm(d, (ID, 8), (MAJOR, -5), REPORT) == [(1, 0.0, True)]
    assert sizes_mm(decoder(), (ID, 7), (X, 100), (Y, 200), REPORT) == [(0, 0.0, True)]


def test_sizes_in_protocol_a_go_with_their_contact():
    d = decoder(Protocol.A)
    one, two = [(MAJOR, 80), (X, 100), (Y, 100), MT_REPORT], [(MAJOR, 120), (X, 1000), (Y, 1000), MT_REPORT]
    assert sizes_mm(d, *one, *two, REPORT) == [(0, 8.0, True), (1, 12.0, True)]
    grown = [(MAJOR, 100), (X, 110), (Y, 100), MT_REPORT]
    assert sizes_mm(d, *two, *grown, REPORT) == [(0, 10.0, True)]


def test_a_decoder_after_another_goes_on_counting_and_gives_no_number_twice():
    d = decoder()
    play(d, (ID, 7), (X, 100), (Y, 200), REPORT, (SLOT, -1), (SLOT, 0))
    d.release(1.5)
    later = decoder(after=d)
    assert play(later, (ID, 7), (X, 100), (Y, 200), REPORT) == [(1, 10, 20, True)]
    assert counts(later) == (2, 2, 1)
    assert later.warnings == {"slot_absurd": 1}


def test_a_live_device_without_slots_is_of_protocol_a():
    assert protocol_of_device({0, 1, SLOT, X, Y, ID}) is Protocol.B
    assert protocol_of_device({0, 1, X, Y, ID}) is Protocol.A
    assert protocol_of_device({0, 1}) is Protocol.SINGLE
    assert protocol_of_device({0, 1, X}) is Protocol.SINGLE


def test_the_protocol_shows_itself():
    assert protocol_of({0, 1, SLOT, X, Y}, ()) is Protocol.B
    assert protocol_of((), {(ABS, X), (ABS, Y), (SYN, 2)}) is Protocol.A
    assert protocol_of((), {(ABS, X), (ABS, ID)}) is Protocol.B
    assert protocol_of({0, 1}, {(ABS, 0), (KEY, TOUCH)}) is Protocol.SINGLE
    assert protocol_of((), ()) is Protocol.SINGLE
    assert protocol_of((), {(ABS, SLOT), (SYN, 2)}) is Protocol.B
    assert protocol_of((), {(KEY, X)}) is Protocol.SINGLE  # a key of the same number
    assert all(protocol_of({axis}, ()) is Protocol.B for axis in (SLOT, ID, X, Y))


codes = st.sampled_from([SLOT, ID, X, Y, 0, 1, DISTANCE, TOOL, MAJOR, 0x3A])
values = st.one_of(st.integers(-2, 12), st.integers(-(1 << 31), (1 << 31) - 1))
events = st.one_of(
    st.tuples(st.just(ABS), codes, values),
    st.tuples(st.just(KEY), st.just(TOUCH), st.integers(0, 2)),
    st.sampled_from([REPORT, REPORT, REPORT, MT_REPORT, DROPPED]),
    st.tuples(st.integers(0, 31), st.integers(0, 0x2FF), values),
)


@settings(max_examples=300)
@given(st.sampled_from(Protocol), st.lists(events, max_size=120))
def test_any_stream_gives_fingers_that_begin_move_and_end(protocol, stream):
    d = decoder(protocol, last_slot=4)
    down, ended = set(), set()
    for kind, code, value in stream:
        samples = d.feed(kind, code, value, 0.0)
        assert (samples is None) == ((kind, code) != (SYN, 0))
        for finger, x_m, y_m, _, contact, _ in samples or ():
            assert 0 <= x_m <= BOARD.plate.length_m
            assert 0 <= y_m <= BOARD.plate.width_m
            assert finger not in ended
            if contact:
                down.add(finger)
            else:
                down.remove(finger)
                ended.add(finger)
        assert len({s.finger for s in samples or ()}) == len(samples or ())
        if samples is not None:
            assert {finger for finger, _, _ in d.fingers()} == down
            assert len(down) <= min(MAX_PLAYED, d.counts.max_fingers)
    assert {s.finger for s in d.release(1.0) if not s.contact} == down
    assert d.fingers() == []


@each_row(
    ("x", "y", "off"),
    [(0, 800, 1), (79, 800, 1), (80, 800, 0), (2200, 800, 0), (2221, 800, 1), (1000, 39, 1), (1000, 40, 0), (1000, 1600, 1)],
)
def test_positions_off_the_plate_are_counted_and_those_at_its_edge_are_not(x, y, off):
    """Of a panel that reaches 10 and 6 mm beyond the glass: 2 mm beyond the edge are no more than the map is wrong."""
    touch = msgspec.structs.replace(BOARD.touch, x_mm_from_axes=(230.0, 0.0, -10.0), y_mm_from_axes=(0.0, 160.0, -6.0))
    axes = PanelAxes(msgspec.structs.replace(BOARD, touch=touch), AxisRange(0, 2300), AxisRange(0, 1600))
    source = Decoder(axes, Protocol.B)
    ((_, x_mm, y_mm, _),) = play(source, (ID, 1), (X, x), (Y, y), REPORT)
    assert source.counts.off_plate == off
    assert (x_mm, y_mm) == (pytest.approx(min(max(x / 10 - 10, 0), 210)), pytest.approx(min(max(y / 10 - 6, 0), 148)))
