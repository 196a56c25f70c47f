import math
import sys
from itertools import pairwise
from pathlib import Path

import msgspec
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.board.touch_panels import TouchPanel
from controller.device.touch.event_codes import Protocol
from controller.device.touch.ghost_guard import MAX_QUIET_SHARE, GhostGuard, QuietBudget
from controller.device.touch.live_source import LiveSource
from controller.device.touch.tracker import Tracker
from controller.workshop.simulation.ghostly_panel import PERIOD_S, GhostlyPanel, Ghosts

sys.path.insert(0, str(Path(__file__).parent))

from scripted_source import ScriptedSource, played, touch
from tables import each_row

T_S, GHOST_S = 2e-3, 30e-3
HELD_S = T_S + GHOST_S
UNDER_WAY_S = 1e-3 + T_S  # `perform` has given an emission that begins so much later
LIVES_REPORTS = 3  # from the scan that heard the emission on: gone 28 ms after it at the latest
TOUCH = TouchPanel(x_mm_from_axes=(210.0, 0.0, 0.0), y_mm_from_axes=(0.0, 148.0, 0.0), ghost_ms=GHOST_S * 1e3)


BOARD = load_board(data_folder("boards") / "simulated")


class Haunted(GhostlyPanel):
    """A panel that hears what `perform` plays."""

    def __init__(self, fingers, *, lives_reports, probability, seed=0, **panel):
        self.sounds = []
        super().__init__(BOARD, fingers, self._hears, Ghosts(probability, (lives_reports, lives_reports), seed=seed), **panel)
        self.real = [place for _, _, place in fingers]

    def heard(self, start_s, end_s):
        self.sounds.append((start_s, end_s))

    def _hears(self, at_s):
        heard = any(start_s < at_s for start_s, _ in self.sounds)
        self.sounds = [(start_s, end_s) for start_s, end_s in self.sounds if end_s > at_s]
        return heard

    def is_real(self, x_m, y_m):
        """Whether a real finger is there: ghosts keep 12 mm away from them."""
        return any(abs(x_m * 1e3 - x_mm) < 1 and abs(y_m * 1e3 - y_mm) < 1 for x_mm, y_mm in self.real)


def perform(panel, *, ghost_ms=GHOST_S * 1e3, train_s=0.0, spot_period_s=None, until_s=10.0):
    """A loop that plays an emission for each press, a train of 50 Hz while it stays, and a spot if asked.

    Gives the tracker, and (press time, place, emissions) of every finger played.
    """
    tracker = Tracker(LiveSource(panel, BOARD), msgspec.structs.replace(TOUCH, ghost_ms=ghost_ms), 0.210, 0.148)
    fingers, down = [], {}
    spot_s = 0.0 if spot_period_s else float("inf")
    free_s = 0.0
    due_s = quiet_until_s = float("inf")

    def play(at_s):
        nonlocal due_s
        due_s = min(due_s, at_s)

    while True:
        train_next_s = min((finger[3] for finger in down.values()), default=float("inf"))
        at_s = min(train_next_s, spot_s, max(due_s, quiet_until_s), tracker.next_time_s() or float("inf"))
        if at_s > until_s:
            return tracker, [finger[:3] for finger in fingers]
        for sample in tracker.read(at_s):
            if not sample.contact:
                del down[sample.finger]
            elif sample.finger not in down:
                down[sample.finger] = finger = [sample.time_s, (sample.x_m, sample.y_m), 1, sample.time_s + 20e-3]
                fingers.append(finger)
                play(at_s)
        for number, finger in down.items():
            if finger[3] <= at_s:
                finger[3] = finger[3] + 20e-3 if finger[3] - finger[0] < train_s else float("inf")
                if finger[3] < float("inf") and tracker.confirmed(number):
                    finger[2] += 1
                    play(at_s)
        if spot_s <= at_s:
            spot_s += spot_period_s
            play(at_s)
        quiet_until_s = tracker.quiet_until_s(at_s, at_s) if due_s <= at_s else at_s
        if due_s <= at_s >= quiet_until_s:  # all that is due is one emission
            due_s, start_s = float("inf"), max(at_s + 1e-3, free_s)
            free_s = start_s + T_S
            panel.heard(start_s, free_s)
            tracker.emitted(start_s, free_s)


@pytest.mark.parametrize("protocol", [Protocol.A, Protocol.B])
def test_without_the_guard_one_tap_would_play_for_ever(protocol):
    panel = Haunted([(0.5, 0.6, (50, 50))], probability=1.0, lives_reports=LIVES_REPORTS, protocol=protocol)
    _, fingers = perform(panel, ghost_ms=0.0, train_s=0.05, until_s=3.0)
    assert len(fingers) > 50
    assert fingers[-1][0] > 2.9


@given(st.floats(0, 1), st.integers(1, LIVES_REPORTS), st.sampled_from([Protocol.A, Protocol.B]), st.integers(0, 1 << 30))
@settings(max_examples=60, deadline=None)
def test_the_ghost_loop_dies_out_at_once_only_real_fingers_are_played(probability, lives_reports, protocol, seed):
    """The bound: no emission beyond those of the real fingers."""
    taps = [(0.2 + 0.3 * k, 0.3 + 0.3 * k, (20 + 15 * k, 30 + 8 * k)) for k in range(10)]
    panel = Haunted(taps, probability=probability, lives_reports=lives_reports, protocol=protocol, seed=seed, until_s=4.0)
    tracker, fingers = perform(panel, until_s=4.0)
    assert [panel.is_real(*place) for _, place, _ in fingers] == [True] * len(taps)
    assert sum(emissions for _, _, emissions in fingers) == len(taps)
    assert tracker.tracking.ghosts == panel.ghosts
    assert tracker.tracking.longest_ghost_s <= GHOST_S


@given(st.integers(0, 1 << 30), st.sampled_from([Protocol.A, Protocol.B]))
@settings(max_examples=30, deadline=None)
def test_trains_of_several_fingers_make_ghosts_but_no_ghost_makes_an_emission(seed, protocol):
    taps = [(0.2 + 0.07 * k, 1.5, (30 + 40 * k, 40 + 20 * k)) for k in range(4)]
    panel = Haunted(taps, probability=1.0, lives_reports=LIVES_REPORTS, protocol=protocol, seed=seed, until_s=3.0)
    _, fingers = perform(panel, train_s=1.0, until_s=3.0)
    assert [panel.is_real(*place) for _, place, _ in fingers] == [True] * 4
    assert panel.ghosts > 50


@given(st.floats(0.001, 0.3), st.sampled_from([None, 10e-3, 2.5e-3]), st.sampled_from([Protocol.A, Protocol.B]))
@settings(max_examples=40, deadline=None)
def test_a_finger_that_lands_in_emissions_is_played_within_the_stated_time(after_s, spot_period_s, protocol):
    """Also where emissions are back to back for seconds: at most T + G after its first report, and what is under way then."""
    lands_s = 2.0 + after_s
    first = (1.9, 2.05, (30, 30))
    panel = Haunted([first, (lands_s, 4.0, (150, 100))], probability=0.0, lives_reports=1, protocol=protocol, until_s=4.5)
    _, fingers = perform(panel, spot_period_s=spot_period_s, until_s=4.5)
    second = [begun_s for begun_s, (x_m, _), _ in fingers if x_m == pytest.approx(0.150)]
    assert len(second) == 1
    assert second[0] <= lands_s + PERIOD_S + HELD_S + UNDER_WAY_S


@each_row("protocol", [Protocol.A, Protocol.B])
@each_row("spot_period_s", [10e-3, 20e-3])
def test_under_an_endless_spot_full_of_ghosts_real_fingers_are_played_and_ghosts_never(protocol, spot_period_s):
    """Whether the panel numbers its contacts or they are distinguished by distance alone."""
    taps = [(0.5 + 0.4 * k, 0.75 + 0.4 * k, (30 + 10 * k, 40 + 5 * k)) for k in range(10)]
    panel = Haunted(taps, probability=1.0, lives_reports=LIVES_REPORTS, protocol=protocol, until_s=5.0)
    _, fingers = perform(panel, spot_period_s=spot_period_s, until_s=5.0)
    assert panel.ghosts > 50
    assert [panel.is_real(*place) for _, place, _ in fingers] == [True] * len(taps)
    longest_s = PERIOD_S + HELD_S / MAX_QUIET_SHARE + UNDER_WAY_S  # in a storm there is not always silence to be had
    assert max(begun_s - tap[0] for (begun_s, _, _), tap in zip(fingers, taps, strict=True)) <= longest_s


def held_until(first_s, *emissions):
    guard = GhostGuard(GHOST_S)
    for emission in emissions:
        guard.emitted(*emission)
    return guard.cleared_s(first_s) if guard.suspects(first_s) else None


def test_a_contact_before_an_emission_or_after_its_shadow_is_no_suspect():
    assert held_until(0.999, (1.0, 1.002)) is None
    assert held_until(1.033, (1.0, 1.002)) is None
    assert held_until(1.0, (1.0, 1.002)) == pytest.approx(1.032)
    assert held_until(1.031, (1.0, 1.002)) == pytest.approx(1.032)


def test_shadows_that_touch_are_one():
    train = [(1 + k * 20e-3, 1.002 + k * 20e-3) for k in range(100)]
    assert held_until(1.001, *train[:3]) == pytest.approx(1.072)
    assert held_until(1.001, *train) == pytest.approx(train[-1][1] + GHOST_S)


def test_a_report_read_late_is_evaluated_by_the_shadow_it_was_made_in():
    two = [(1.0, 1.002), (1.1, 1.102)]
    assert held_until(1.01, *two) == pytest.approx(1.032)
    assert held_until(1.05, *two) is None
    assert held_until(1.11, *two) == pytest.approx(1.132)


def test_each_repetition_casts_its_shadow_until_something_else_is_played():
    spot = (1.0, 1.002, 0.1)
    for k in (0, 1, 50):
        assert held_until(1.0 + 0.1 * k + 1e-6, spot) == pytest.approx(1.032 + 0.1 * k)
        assert held_until(1.031 + 0.1 * k, spot) == pytest.approx(1.032 + 0.1 * k)
        assert held_until(1.033 + 0.1 * k, spot) is None
        assert held_until(1.099 + 0.1 * k, spot) is None
    assert held_until(1.505, spot, (1.55, 1.552)) == pytest.approx(1.532)  # read late
    assert held_until(1.56, spot, (1.55, 1.552)) == pytest.approx(1.582)
    assert held_until(1.605, spot, (1.55, 1.552)) is None
    assert held_until(1.505, spot, (1.52, 1.522)) == pytest.approx(1.552)  # shadows that touch
    assert held_until(0.9, spot) is None


def test_repetitions_whose_shadows_touch_have_one_that_ends_with_what_follows():
    spot = (1.0, 1.002, 0.03)
    assert held_until(5.0, spot) == math.inf
    assert held_until(5.0, spot, (5.001, 5.001)) == pytest.approx(5.031)
    assert held_until(5.04, spot, (5.001, 5.001)) is None


def test_a_shadow_ends_when_nothing_more_is_played():
    """As seen at a time: after the emission, or the repetition, that began last by then."""
    guard = GhostGuard(GHOST_S)
    guard.emitted(1.0, 1.002)
    assert guard.cleared_if_quiet_s(1.001, 1.02) == guard.cleared_s(1.001) == pytest.approx(1.032)
    guard.emitted(1.1, 1.102, 0.02)
    for now_s, last_s in ((1.09, 1.1), (1.105, 1.1), (1.125, 1.12), (3.019, 3.0)):
        assert guard.cleared_if_quiet_s(1.101, now_s) == pytest.approx(last_s + HELD_S)


def test_a_panel_without_ghosts_holds_nobody_back():
    t = Tracker(ScriptedSource((1.001, [touch(0, 100)])), msgspec.structs.replace(TOUCH, ghost_ms=0.0), 0.210, 0.148)
    t.emitted(1.0, 1.002, 0.01)
    assert len(t.read(1.001)) == 1
    assert t.quiet_until_s(1.001, 1.001) <= 1.001


def test_while_a_contact_is_a_suspect_silence_is_asked_for_until_it_has_shown_what_it_is():
    t = Tracker(ScriptedSource((1.01, [touch(0, 100)]), (1.02, [])), TOUCH, 0.210, 0.148)
    assert t.quiet_until_s(0.9, 0.9) <= 0.9
    t.emitted(1.0, 1.002, 0.02)
    assert t.quiet_until_s(1.005, 1.005) <= 1.005
    t.read(1.01)
    assert t.quiet_until_s(1.01, 1.01) == pytest.approx(1.032)
    assert t.quiet_until_s(1.01, 1.04) <= 1.01, "what begins later than that need not wait"
    t.emitted(1.0, 1.002)  # the repetition is stopped
    t.read(1.02)
    assert t.quiet_until_s(1.02, 1.02) <= 1.02, "it was a ghost, and is gone"


@given(st.lists(st.tuples(st.floats(0, 0.05), st.floats(1e-3, 0.04)), max_size=200), st.floats(1e-3, 0.5))
@example([(0.0, 0.04)] * 3, 0.375)  # the third one lacks 1e-17 s
def test_listening_takes_its_share_of_the_time_and_no_more(wishes, ghost_s):
    """Whoever asks, and whenever: of any time at most MAX_QUIET_SHARE, and what may be had at once."""
    listening, now_s, listened_s = QuietBudget(ghost_s), 0.0, 0.0
    for gap_s, wish in wishes:
        now_s += gap_s
        wish_s = wish * ghost_s / 0.03
        if listening.begin(now_s, now_s + wish_s):
            now_s += wish_s
            listened_s += wish_s
            listening.end(now_s)
        elif listening.retry_s < math.inf:
            assert listening.retry_s > now_s
        assert listened_s <= MAX_QUIET_SHARE * now_s + max(0.1, 4 * ghost_s) + wish_s
    assert listening.total_s == pytest.approx(listened_s)


@given(st.floats(1e-4, 0.5), st.integers(0, 20))
def test_who_is_refused_silence_gets_it_at_the_time_that_is_reported(ghost_s, spent):
    listening, now_s, wish_s = QuietBudget(ghost_s), 1.0, ghost_s + 2e-3
    for _ in range(spent):
        if listening.begin(now_s, now_s + wish_s):
            now_s += wish_s
            listening.end(now_s)
        now_s += 1e-3
    if not listening.begin(now_s, now_s + wish_s):
        assert listening.retry_s - now_s <= wish_s * (1 - MAX_QUIET_SHARE) / MAX_QUIET_SHARE + 1e-9
        retry_s = listening.retry_s + 1e-9
        assert listening.begin(retry_s, retry_s + wish_s)


def test_a_suspect_that_stays_is_played_when_the_shadow_ends_and_one_that_goes_never():
    def tracker(*reports):
        t = Tracker(ScriptedSource(*reports), TOUCH, 0.210, 0.148)
        t.emitted(1.0, 1.002)
        return t

    stays = tracker((1.01, [touch(0, 100)]), (1.02, [touch(0, 101)]), (2.0, []))
    assert played(stays, 1.0319) == []
    (sample,) = played(stays, 1.1)
    assert (sample.x_m, sample.contact) == (0.101, True)
    assert sample.time_s == pytest.approx(1.032)
    assert stays.confirmed(0)
    assert (stays.tracking.held_back, stays.tracking.ghosts) == (1, 0)
    assert stays.tracking.longest_hold_s == pytest.approx(0.022)
    goes = tracker((1.01, [touch(0, 100)]), (1.032, []))
    assert played(goes) == []
    assert (goes.tracking.held_back, goes.tracking.ghosts) == (1, 1)
    assert goes.tracking.longest_ghost_s == pytest.approx(0.022)


def test_a_suspect_is_not_played_while_a_report_that_may_end_it_waits_to_be_read():
    """The loop was late: all three reports are there, and the shadow is over."""
    t = Tracker(ScriptedSource((1.01, [touch(0, 100)]), (1.02, [touch(0, 101)]), (1.03, [])), TOUCH, 0.210, 0.148)
    t.emitted(1.0, 1.002)
    assert [t.read(1.05) for _ in range(4)] == [()] * 4
    assert t.tracking.ghosts == 1


def test_a_ghost_that_goes_is_not_bridged_to_another_at_its_place():
    t = Tracker(ScriptedSource((1.01, [touch(0, 100)]), (1.02, []), (1.025, [touch(1, 100)]), (1.03, [])), TOUCH, 0.210, 0.148)
    t.emitted(1.0, 1.002)
    assert played(t) == []
    assert t.tracking.ghosts == 2


shares = st.floats(0, 1)
hauntings = st.lists(st.tuples(st.floats(0, 0.08), st.floats(1e-4, 10e-3), shares, shares), min_size=1, max_size=12)


@given(hauntings)
@settings(deadline=None)
def test_no_ghost_of_any_emissions_is_ever_played(hauntings):
    """A ghost begins anywhere from the start of its emission until G after its end, and is gone by then."""
    end_s, sounds, changes = 1.0, [], []
    for finger, (gap_s, duration_s, born, gone) in enumerate(hauntings):
        start_s, end_s = end_s + gap_s, end_s + gap_s + duration_s
        sounds.append((start_s, end_s))
        last_s = end_s + GHOST_S
        born_s = start_s + 1e-6 + born * (last_s - start_s - 2e-6)
        changes += [(born_s, finger, True), (born_s + gone * (last_s - born_s), finger, False)]
    reports, there = [], {}
    for at_s, finger, begins in sorted(changes, key=lambda change: (change[0], change[1], not change[2])):
        there = there | {finger: touch(finger, 9 * finger)} if begins else {k: v for k, v in there.items() if k != finger}
        reports.append((at_s, list(there.values())))
    t = Tracker(ScriptedSource(*reports), TOUCH, 0.210, 0.148)
    samples = []
    for start_s, end_s in sounds:
        samples += played(t, start_s)
        t.emitted(start_s, end_s)
    assert samples + played(t) == []
    assert t.tracking.ghosts == len(hauntings)


SPOT_AND_CLICK = """
[[regions]]
name = "spot"
shape = "circle"
x_mm = 60.0
y_mm = 54.0
radius_mm = 3.0
effects = [{ effect = "always", rate_hz = 20.0 }]

[[regions]]
name = "all"
shape = "plate"
effects = ["click"]
"""


def test_in_the_loop_a_tap_waits_for_the_end_of_the_shadow_of_the_spot_that_the_fpga_repeats(board, perform):
    """Every 50 ms a shadow of 32 ms: what lands in it is played when it ends, all else at once."""
    haunted = msgspec.structs.replace(board, touch=msgspec.structs.replace(board.touch, ghost_ms=GHOST_S * 1e3))
    late_s = []
    for k in range(10):
        tap_s = 1.0 + 5e-3 * k
        run = perform([(0.0, {}), (tap_s, {0: (150.0, 100.0)}), (tap_s + 0.2, {0: None})], SPOT_AND_CLICK, on=haunted)
        (click,) = [played for played in run.played if any(emission.finger is not None for emission in played.emissions)]
        late_s.append(click.trigger_s - run.start_s - tap_s)
    assert max(late_s) < T_S + GHOST_S + 5e-3
    at_once = [late for late in late_s if late < 5e-3]
    assert 3 <= len(at_once) <= 4  # 18 of 50 ms
    waits_s = sorted(late_s)[len(at_once) :]  # until the same instant, from taps 5 ms apart
    assert [after - before for before, after in pairwise(waits_s)] == pytest.approx([5e-3] * (len(waits_s) - 1), abs=1e-3)


def test_when_there_is_quiet_time_again_is_known_once_all_of_it_was_used():
    budget = QuietBudget(0.01)
    assert budget.begin(0.0, 0.1)
    budget.end(0.1)  # the reserve of a burst
    assert not budget.begin(0.1, 0.13)
    assert budget.retry_s == pytest.approx(0.115), "after half as long, two thirds of all time may be quiet"
    assert not budget.begin(0.114, 0.144)
    assert budget.begin(0.1151, 0.1451)
