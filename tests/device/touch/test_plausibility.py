"""The stage between the decoder and the tracker: which contacts are fingers, and where."""

import math
from random import Random

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.touch.axes import AxisRange, PanelAxes
from controller.device.touch.decoder import Decoder
from controller.device.touch.event_codes import Protocol
from controller.device.touch.panel_places import EDGE_M
from controller.device.touch.reports import SHORTEST_PAUSE_S, describe_warnings

BOARD = load_board(data_folder("boards") / "simulated")
SYN, KEY, ABS = 0, 1, 3
SLOT, MAJOR, X, Y, TOOL, ID, TOUCH = 0x2F, 0x30, 0x35, 0x36, 0x37, 0x39, 0x14A
FINGER, PALM = (TOOL, 0), (TOOL, 2)
REPORT, MT_REPORT, DROPPED, MSC = (SYN, 0, 0), (SYN, 2, 0), (SYN, 3, 0), (4, 5, 1)
PERIOD_S = 10e-3
EDGE = round(EDGE_M * 1e4)  # units of a tenth of a millimetre


class Panel:
    """A decoder that is fed reports in its own time, and asked for decisions when they are due."""

    def __init__(self, protocol=Protocol.B, *, after=None, **settings):
        board = msgspec.structs.replace(BOARD, touch=msgspec.structs.replace(BOARD.touch, **settings))
        self.decoder = Decoder(PanelAxes(board, AxisRange(0, 2100), AxisRange(0, 1480)), protocol, after=after)
        self.now_s = 1.0
        self.protocol = protocol

    def wait(self, until_s):
        """What is decided up to a time without a report."""
        samples = []
        while self.decoder.due_s <= until_s:
            samples += self.decoder.overdue(self.decoder.due_s)
        self.now_s = until_s
        return in_short(samples)

    def report(self, *events, after_s=PERIOD_S):
        """What a report says, and what was decided since the one before."""
        before = self.wait(self.now_s + after_s)
        full = [(event if len(event) == 3 else (ABS, *event)) for event in (*events, REPORT)]
        return before + in_short(self.decoder.feed_report([(*event, self.now_s) for event in full], self.now_s))

    def at(self, *places_mm, after_s=PERIOD_S):
        """A report of one contact for each place, the first with tracking id 0 (protocol B), or without any id (A)."""
        events = []
        for number, (x_mm, y_mm) in enumerate(places_mm):
            place = [(X, round(10 * x_mm)), (Y, round(10 * y_mm))]
            events += [*place, MT_REPORT] if self.protocol is Protocol.A else [(SLOT, number), (ID, number), *place]
        return self.report(*(events or [MT_REPORT]), after_s=after_s)

    @property
    def figures(self):
        return self.decoder.counts.plausibility(self.decoder.warnings)

    def counted(self, **expected):
        found = self.figures
        assert found == dict.fromkeys(found, 0) | expected
        assert self.decoder.counts.refused == found["points"] - found["believed"] - found["confirmed"]
        return True


def in_short(samples):
    return [(s.finger, round(s.x_m * 1e3, 6), round(s.y_m * 1e3, 6), s.contact) for s in samples]


# Places


@each_row(
    ("raw", "place_mm"),
    [((-EDGE, 200), (0, 20)), ((2100 + EDGE, 200), (210, 20)), ((200, -EDGE), (20, 0)), ((200, 1480 + EDGE), (20, 148))],
)
def test_a_finger_a_little_outside_the_axes_is_at_their_edge(raw, place_mm):
    p = Panel()
    assert p.report((ID, 1), (X, raw[0]), (Y, raw[1])) == [(0, *place_mm, True)]
    assert p.decoder.warnings == {"outside_axes": 1}
    assert p.counted(points=1, believed=1)


@each_row(
    "raw", [(-EDGE - 1, 200), (2100 + EDGE + 1, 200), (200, -EDGE - 1), (200, 1480 + EDGE + 1), (499, -3616), (0x7FFFFFFF, 0)]
)
def test_a_contact_far_outside_the_axes_is_no_finger_until_it_is_reported_inside(raw):
    p = Panel()
    assert p.report((ID, 1), (X, raw[0]), (Y, raw[1])) == []
    assert p.report(MSC) == []
    assert p.report((X, 300), (Y, 200)) == [(0, 30, 20, True)]
    assert describe_warnings(p.decoder.warnings) == ["2 × positions far outside the axes were taken for no finger"]
    assert p.counted(points=3, believed=1, far_outside=2)


def test_the_edge_is_as_wide_along_axes_that_are_swapped_and_mirrored():
    p = Panel(x_mm_from_axes=(0.0, -210.0, 210.0), y_mm_from_axes=(148.0, 0.0, 0.0))  # units of 0.0705 and 0.142 mm
    assert p.report((ID, 1), (X, 2100 + 70), (Y, 700)) != []
    assert p.report((ID, 2), (X, 2100 + 72), (Y, 700)) == [(0, pytest.approx(110.676, abs=1e-3), 148, False)]
    assert p.report((ID, 3), (X, 700), (Y, -35)) != []
    assert p.report((ID, 4), (X, 700), (Y, -36))[1:] == []


def test_a_finger_reported_far_outside_for_one_report_keeps_its_place_and_for_two_is_released():
    p = Panel()
    assert p.at((50, 50)) == [(0, 50, 50, True)]
    assert p.at((50, -360)) == []
    assert p.at((51, 50)) == [(0, 51, 50, True)]
    assert p.at((51, -360)) == []
    assert p.at((51, -361)) == [(0, 51, 50, False)]
    assert p.at((51, 50)) == [(1, 51, 50, True)]
    assert p.counted(points=6, believed=3, far_outside=3)


def test_a_finger_reported_far_outside_last_is_released_by_the_silence_after_it():
    p = Panel()
    p.at((50, 50))
    assert p.at((50, -360)) == []
    assert p.wait(p.now_s + 0.1) == [(0, 50, 50, False)]
    assert p.counted(points=2, believed=1, far_outside=1)


CORNERS = ((200.0, 138.0, 10.0, 10.0), (0.0, 0.0, 5.0, 5.0))


@each_row(("inside", "outside"), [((210, 148), (199.9, 148)), ((200, 138), (200, 137.9)), ((0, 0), (5.1, 0))])
def test_nothing_is_a_finger_where_the_board_says_so(inside, outside):
    p = Panel(no_finger_mm=CORNERS)
    assert p.at(inside) == []
    assert p.at(outside) == [(0, *outside, True)], "it has left the place"
    assert p.at(inside) == []
    assert p.at(inside) == [(0, *outside, False)]
    assert p.report((ID, -1)) == []
    assert describe_warnings(p.decoder.warnings) == ["3 × positions where the board says that there is no finger were left out"]
    assert p.counted(points=4, believed=1, no_finger=3)


def test_without_such_a_place_the_corner_is_one_like_any_other():
    assert Panel().at((210, 148)) == [(0, 210, 148, True)]


# Steps


def drag(panel, *places_mm):
    """Each report's samples of one finger along y = 50 mm."""
    return [panel.at((x_mm, 50)) for x_mm in places_mm]


def believed(found):
    return [[x_mm for _, x_mm, _, _ in report] for report in found]


def test_an_outlier_is_left_out_and_the_drag_goes_on():
    p = Panel()
    assert believed(drag(p, 50, 51, 52, 97, 54, 55)) == [[50], [51], [52], [], [54], [55]]
    assert p.decoder.warnings == {"too_fast": 1}
    assert p.counted(points=6, believed=5, held=1, too_fast=1)


@each_row(("lost", "places"), [(0, [50, 65, 80, 20, 110, 131]), (2, [50, 65, 80, 20, 125, 146])])
def test_behind_an_outlier_the_speed_is_that_of_the_time_in_which_the_finger_may_have_moved(lost, places):
    """1.5 m/s, and 0.6 m/s more in the last step; reports are lost before the outlier, and for two of the four it rested."""
    p = Panel()
    found = drag(p, *places[:3])
    found.append(p.at((places[3], 50), after_s=(1 + lost) * PERIOD_S))
    assert believed(found + drag(p, *places[4:])) == [[x_mm] if x_mm != 20 else [] for x_mm in places]


def test_outliers_one_after_the_other_are_left_out():
    p = Panel()
    assert believed(drag(p, 50, 51, 52, 97, 20, 150, 56, 57)) == [[50], [51], [52], [], [], [], [56], [57]]
    assert p.counted(points=8, believed=5, held=3, too_fast=3)


def test_a_step_that_the_next_report_confirms_is_believed():
    p = Panel()
    assert believed(drag(p, 50, 51, 52, 97, 98, 99)) == [[50], [51], [52], [], [98], [99]]
    assert {finger for report in drag(p, 100, 101) for finger, *_ in report} == {0}
    assert p.counted(points=8, believed=7, held=1, confirmed=1)


def test_a_step_that_the_panel_does_not_take_back_is_believed_after_a_period_and_a_half():
    p = Panel()
    drag(p, 50, 51, 52, 97)
    assert p.decoder.due_s == pytest.approx(p.now_s + 1.5 * PERIOD_S)
    assert p.wait(p.decoder.due_s) == [(0, 97, 50, True)]
    assert p.decoder.due_s == math.inf
    assert believed([p.at((98, 50), after_s=0.5)]) == [[98]]
    assert p.counted(points=5, believed=4, held=1, confirmed=1)


def test_an_unmoved_report_confirms_a_step():
    p = Panel()
    drag(p, 50, 51, 52, 97)
    assert p.report(MSC) == [(0, 97, 50, True)]


@each_row("metres_per_s", [0.5, 1.0, 1.9])
def test_a_swipe_that_begins_at_full_speed_is_taken_whole(metres_per_s):
    p = Panel()
    places = [10 + 10 * metres_per_s * k for k in range(10)]
    assert believed(drag(p, *places)) == [[x_mm] for x_mm in places]
    assert p.counted(points=10, believed=10)


@pytest.mark.parametrize("metres_per_s", [1.0, 3.0])
def test_a_swipe_that_starts_from_rest_faster_than_a_hand_waits_once(metres_per_s):
    p = Panel()
    places = [10, 10, 10, *[10 + 10 * metres_per_s * k for k in range(1, 7)]]
    found = [report for report in believed(drag(p, *places)) if report]
    assert found == [[10], *[[x_mm] for x_mm in places[4:]]]
    assert p.figures["held"] == p.figures["confirmed"] == 1


def test_a_finger_that_stops_or_turns_at_once_is_taken_at_its_word():
    p = Panel()
    places = [50 + 5 * k for k in range(8)]  # 0.5 m/s
    assert believed(drag(p, *places, 85, 85.1, 85)) == [*[[x_mm] for x_mm in places], [], [85.1], [85]]
    assert p.counted(points=10, believed=10)


def test_a_second_tap_elsewhere_is_no_step():
    p = Panel()
    p.at((50, 50))
    assert p.report((ID, -1)) == [(0, 50, 50, False)]
    assert p.report((ID, 8), (X, 1500)) == [(1, 150, 50, True)]
    assert p.report((ID, 9), (X, 500)) == [(1, 150, 50, False), (2, 50, 50, True)]
    assert p.counted(points=3, believed=3)


def test_the_reach_follows_the_period_of_the_panel():
    """20 mm in 30 ms are a swift hand, in 8 ms an outlier."""
    for period_s, expected in ((30e-3, [20]), (8e-3, [])):
        p = Panel()
        for _ in range(3):
            p.at((0, 50), after_s=period_s)
            p.at((0.1, 50), after_s=period_s)
        assert believed([p.at((20, 50), after_s=period_s)]) == [expected]


def test_a_finger_lifted_while_its_step_waits_ends_where_it_was():
    p = Panel()
    drag(p, 50, 51, 52, 97)
    assert p.report((ID, -1)) == [(0, 52, 50, False)]
    assert p.decoder.due_s == math.inf
    assert p.counted(points=4, believed=3, held=1, too_fast=1)


@each_row("end", ["dropped", "another id", "end"])
def test_what_waits_is_counted_once_however_it_ends(end):
    p = Panel()
    drag(p, 50, 51, 52, 97)
    if end == "dropped":
        assert p.report(DROPPED) == [(0, 52, 50, False)]
    elif end == "another id":
        assert p.report((ID, 7)) == [(0, 52, 50, False), (1, 97, 50, True)]
    else:
        assert in_short(p.decoder.release(p.now_s)) == [(0, 52, 50, False)]
    assert p.decoder.due_s == math.inf
    assert (p.figures["held"], p.figures["too_fast"]) == (1, 1)


def test_the_place_of_a_finger_whose_step_waits_is_not_taken_for_a_report_of_rest():
    p = Panel()
    drag(p, 50, 51, 52)
    assert p.decoder.touched
    drag(p, 97)
    assert not p.decoder.touched
    drag(p, 54)
    assert p.decoder.touched


def test_an_outlier_of_a_contact_without_any_identity_is_left_out_as_far_as_it_can_be_assigned():
    p = Panel(Protocol.A)
    found = drag(p, 50, 51, 52, 77, 54, 55)
    assert believed(found) == [[50], [51], [52], [], [54], [55]]
    assert {finger for report in found for finger, *_ in report} == {0}
    assert p.counted(points=6, believed=5, held=1, too_fast=1)
    assert [contact for *_, contact in p.at((150, 50))] == [False, True], "farther on it is a new contact"


# Palms


@each_row("wide", [PALM, (MAJOR, 301)])
@each_row("narrow", [FINGER, (MAJOR, 50)])
def test_a_palm_stays_one_until_it_is_lifted_by_tool_as_by_size(wide, narrow):
    p = Panel(max_size_mm=30.0)
    assert p.report((ID, 1), FINGER, (MAJOR, 50), (X, 500), (Y, 500)) == [(0, 50, 50, True)]
    assert p.report(wide, (X, 501)) == [(0, 50, 50, False)]
    assert p.report(FINGER, (MAJOR, 50), (X, 502)) == []
    assert p.report(wide, (X, 503)) == p.report(narrow, (X, 504)) == []
    assert p.report((ID, -1)) == []
    assert p.report((ID, 2), FINGER, (MAJOR, 50)) == [(1, 50.4, 50, True)]
    assert p.counted(points=2, believed=2)
    assert p.decoder.counts.palms == 1


def test_a_tool_outlives_its_contact_as_every_value_of_a_slot_does():
    p = Panel()
    assert p.report((ID, 1), PALM, (X, 500), (Y, 500)) == []
    assert p.report((ID, -1)) == []
    assert p.report((ID, 2)) == [], "the kernel sends the tool only where it differs"
    assert p.report((ID, 3), FINGER) == [(0, 50, 50, True)]
    assert p.decoder.counts.palms == 2


def test_a_finger_that_becomes_a_palm_says_so_with_its_release():
    p = Panel()
    p.report((ID, 1), (X, 500), (Y, 500))
    (released,) = p.decoder.feed_report([(ABS, *PALM, 2.0), (*REPORT, 2.0)], 2.0)
    assert (released.contact, released.size_m) == (False, math.inf)


def test_a_contact_as_wide_as_a_finger_or_of_unknown_size_is_one():
    assert Panel(max_size_mm=30.0).report((ID, 1), (MAJOR, 299), (X, 500), (Y, 500)) == [(0, 50, 50, True)]
    assert Panel(max_size_mm=0.1).report((ID, 1), (X, 500), (Y, 500)) == [(0, 50, 50, True)]


def test_a_palm_in_protocol_a_stays_one_until_it_is_lifted():
    p = Panel(Protocol.A)
    place = [(X, 500), (Y, 500), MT_REPORT]
    assert p.report(*place) == [(0, 50, 50, True)]
    assert p.report(PALM, *place) == [(0, 50, 50, False)]
    assert p.report(FINGER, *place) == []
    assert p.report(MT_REPORT) == []
    assert p.report(FINGER, *place) == [(1, 50, 50, True)]


# Silence


def tap(panel, x_mm, *, reports=5, after_s=0.15):
    found = panel.at((x_mm, 50), after_s=after_s)
    for _ in range(reports - 1):
        found += panel.at((x_mm, 50))
    return found


@each_row("period_s", [5e-3, 10e-3, 17e-3])
@each_row("places_mm", [(50, 50, 50), (50, 55, 52), (50, 100, 20)])
def test_three_taps_of_protocol_a_without_an_empty_report_are_three_fingers(period_s, places_mm):
    p = Panel(Protocol.A)
    found = []
    for x_mm in places_mm:
        found += p.at((x_mm, 50), after_s=0.15)
        for _ in range(3):
            found += p.at((x_mm, 50), after_s=period_s)
    found += p.wait(p.now_s + 1)
    assert found == [sample for k, x_mm in enumerate(places_mm) for sample in ((k, x_mm, 50, True), (k, x_mm, 50, False))]
    assert p.decoder.fingers() == []
    assert p.counted(points=3, believed=3, fallen_silent=3)
    assert p.decoder.counts.contacts == 3


def test_it_has_fallen_silent_after_two_periods_and_a_half_and_never_sooner_than_a_finger_comes_back():
    for period_s, silent_s in ((10e-3, SHORTEST_PAUSE_S), (30e-3, 75e-3)):
        p = Panel(Protocol.A)
        for _ in range(4):
            p.at((50, 50), after_s=period_s)
        assert p.decoder.due_s - p.now_s == pytest.approx(silent_s)


def test_a_panel_of_protocol_a_that_reports_releases_may_be_silent_while_a_finger_rests():
    p = Panel(Protocol.A)
    tap(p, 50, reports=3)
    assert p.at() == [(0, 50, 50, False)]
    tap(p, 50, reports=3)
    assert p.decoder.due_s == math.inf
    assert p.at((50.1, 50), after_s=3.0) == [(1, 50.1, 50, True)]


def test_a_release_after_a_silence_shows_that_the_finger_was_there_all_the_time():
    p = Panel(Protocol.A)
    assert tap(p, 50, reports=3) == [(0, 50, 50, True)]
    assert p.wait(p.now_s + 1) == [(0, 50, 50, False)]
    p.at()
    tap(p, 50, reports=3)
    assert p.decoder.due_s == math.inf


@pytest.mark.parametrize("protocol", [Protocol.A, Protocol.B])
def test_a_panel_that_repeats_what_has_not_moved_is_believed_to_be_alive_while_it_does(protocol):
    p = Panel(protocol)
    tap(p, 50)
    p.report(MT_REPORT) if protocol is Protocol.A else p.report((ID, -1))
    found = p.at((50, 50))
    for _ in range(30):
        found += p.at((50, 50)) if protocol is Protocol.A else p.report(MSC)
    assert found == [(1, 50, 50, True)]
    assert p.wait(p.now_s + 1) == [(1, 50, 50, False)]
    assert p.counted(points=2, believed=2, fallen_silent=1)


def test_a_contact_of_protocol_b_that_fell_silent_is_a_finger_again_once_it_moves_and_silence_counts_no_more():
    p = Panel()
    p.at((50, 50))
    for _ in range(20):
        p.report(MSC)
    assert p.wait(p.now_s + 1) == [(0, 50, 50, False)]
    assert p.report((SLOT, 1), (ID, 7), (X, 1000), (Y, 1000)) == [(1, 100, 100, True)], "the stuck one is none"
    assert p.report((SLOT, 0), (X, 501)) == [(2, 50.1, 50, True)]
    for _ in range(20):
        p.report(MSC)
    assert p.decoder.due_s == math.inf


def test_a_finger_that_rests_on_a_panel_that_reports_changes_only_stays():
    p = Panel()
    drag(p, *range(50, 70))
    assert p.decoder.due_s == math.inf
    assert p.wait(p.now_s + 100) == []


# All together


def test_after_a_reconnection_figures_go_on_and_what_was_learnt_is_forgotten():
    first = Panel(Protocol.A)
    tap(first, 50, reports=30)
    first.at()
    drag(first, 50, 51, 75)
    first.decoder.release(first.now_s)
    second = Panel(Protocol.A, after=first.decoder)
    assert second.at((50, 50)) == [(2, 50, 50, True)]
    assert second.wait(second.now_s + 1) == [(2, 50, 50, False)], "nothing says that this panel reports releases"
    assert second.counted(points=5, believed=4, held=1, too_fast=1, fallen_silent=1)
    assert second.decoder.counts.devices == 2


OUTSIDE = (499, -3616)
places = st.one_of(
    st.tuples(st.integers(0, 2100), st.integers(0, 1480)),
    st.tuples(st.integers(-3000, 5000), st.integers(-3000, 5000)),
    st.tuples(st.integers(990, 1010), st.integers(700, 740)),  # near each other
    st.sampled_from([OUTSIDE, (2100, 1480), (0, 0)]),
)
actions = st.one_of(
    st.tuples(st.just("move"), st.integers(0, 3), places),
    st.tuples(st.just("lift"), st.integers(0, 3), st.none()),
    st.tuples(st.just("tool"), st.integers(0, 3), st.sampled_from([0, 2])),
    st.tuples(st.just("nothing"), st.just(0), st.none()),
    st.tuples(st.just("dropped"), st.just(0), st.none()),
)
scripts = st.lists(st.tuples(st.sampled_from([1e-3, 10e-3, 10e-3, 30e-3, 0.2]), st.lists(actions, max_size=4)), max_size=25)


def believable(x, y):
    return -EDGE <= x <= 2100 + EDGE and -EDGE <= y <= 1480 + EDGE and not (x >= 2000 and y >= 1380)


def run_script(panel, script):
    """Samples of a script, and checks of what holds whatever comes."""
    claims, down, samples = set(), {}, []
    ids = iter(range(10**6))
    for after_s, todo in script:
        events = []
        for action, number, value in todo:
            if panel.protocol is Protocol.B and action in {"move", "lift", "tool"}:
                events.append((SLOT, number))
            if action == "move":
                if panel.protocol is Protocol.B:
                    if number not in down:
                        down[number] = next(ids)
                        events.append((ID, down[number]))
                    events += [(X, value[0]), (Y, value[1])]
                elif panel.protocol is Protocol.A:
                    events += [(X, value[0]), (Y, value[1]), MT_REPORT]
                else:
                    events += [(0, value[0]), (1, value[1]), (KEY, TOUCH, 1)]
                claims.add(value)
            elif action == "lift":
                down.pop(number, None)
                events += {Protocol.A: [MT_REPORT], Protocol.B: [(ID, -1)], Protocol.SINGLE: [(KEY, TOUCH, 0)]}[panel.protocol]
            elif action == "tool" and panel.protocol is Protocol.B:
                events.append((TOOL, value))
            elif action == "dropped":
                events.append(DROPPED)
                down.clear()
        samples += panel.report(*events, after_s=after_s)
    return samples + panel.wait(panel.now_s + 1), claims


@given(st.sampled_from(list(Protocol)), scripts)
def test_whatever_comes_no_finger_is_where_none_was_reported_and_the_figures_add_up(protocol, script):
    p = Panel(protocol, no_finger_mm=((200.0, 138.0, 10.0, 10.0),))
    samples, claims = run_script(p, script)
    xs = {round(min(max(x, 0), 2100) / 10, 6) for x, _ in claims}
    ys = {round(min(max(y, 0), 1480) / 10, 6) for _, y in claims}
    if protocol is not Protocol.B:  # of protocol B a later event may change one axis of a position only
        assert {(x, y) for _, x, y, _ in samples} <= {
            (round(min(max(x, 0), 2100) / 10, 6), round(min(max(y, 0), 1480) / 10, 6)) for x, y in claims if believable(x, y)
        }
    begun, ended = set(), set()
    for finger, x_mm, y_mm, contact in samples:
        assert x_mm in xs
        assert y_mm in ys
        assert not (x_mm >= 200 and y_mm >= 138)
        assert finger not in ended
        assert contact or finger in begun
        (begun if contact else ended).add(finger)
    assert begun == set(range(len(begun))), "numbers are used in turn"
    f = p.figures
    assert f["points"] == f["believed"] + f["far_outside"] + f["no_finger"] + f["held"] + f["more_than_played"]
    assert f["held"] == f["confirmed"] + f["too_fast"], "after a second nothing waits"
    assert f["believed"] <= sum(contact for *_, contact in samples) <= f["believed"] + f["confirmed"]


@given(st.sampled_from([Protocol.B, Protocol.SINGLE]), scripts)
def test_it_says_the_same_the_second_time_and_after_a_reconnection(protocol, script):
    """Protocol A learns from a first release how the panel reports; the others, from 16 reports of rest, do not here."""
    first = Panel(protocol)
    once, _ = run_script(first, script)
    figures_once = first.figures
    first.decoder.release(first.now_s)
    second = Panel(protocol, after=first.decoder)
    again, _ = run_script(second, script)
    fingers = len({finger for finger, *_ in once})
    assert [(finger - fingers, *rest) for finger, *rest in again] == once
    assert second.figures == {kind: 2 * count for kind, count in figures_once.items()}


@given(st.integers(0, 2**32 - 1), st.sampled_from([6e-3, 10e-3, 16e-3]), st.floats(0.02, 0.5))
def test_of_a_drag_with_outliers_nothing_is_believed_that_lies_far_off(seed, period_s, metres_per_s):
    """One outlier in ten reports, 25 to 90 mm off; two in a row that confirm each other are let off."""
    random = Random(seed)
    p, worst_mm, last = Panel(), 0.0, False
    for k in range(60):
        true_mm = min(5 + 1e3 * metres_per_s * period_s * k, 205)
        outlier = k > 3 and not last and random.random() < 0.1
        angle, off_mm = random.uniform(0, 2 * math.pi), random.uniform(25, 90)
        x_mm, y_mm = (true_mm + off_mm * math.cos(angle), 74 + off_mm * math.sin(angle)) if outlier else (true_mm, 74)
        last = outlier
        for _, at_x_mm, at_y_mm, _ in p.at((x_mm, y_mm), after_s=period_s):
            worst_mm = max(worst_mm, math.hypot(at_x_mm - true_mm, at_y_mm - 74))
    assert worst_mm < 1e-3 + 0.06  # a unit of the panel
