"""What emissions do to a panel, from a recording: against panels whose ghosts are known."""

import random

import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.touch.event_codes import Protocol
from controller.device.touch.recordings.recording import Recording
from controller.device.touch_calibration.event_capture import EventCapture, emission_event, recording_text
from controller.device.touch_calibration.ghost_figures import MARGIN_FEW_MS, MARGIN_MS, MIN_EMISSIONS, ghost_figures
from controller.errors import CalibrationError
from controller.workshop.simulation.ghostly_panel import GhostlyPanel, Ghosts

BOARD = load_board(data_folder("boards") / "simulated")
T_S = 2e-3


def measured(*, emissions=300, fingers=(), gap_s=(0.18, 0.23), probability=0.3, lives=(1, 3), size_mm=0.0, seed=0, **panel):
    """A recording of emissions at random times, and what the panel said."""
    r, at_s, sounds = random.Random(seed), 1.0, []
    for _ in range(emissions):
        sounds.append(at_s)
        at_s += T_S + r.uniform(*gap_s)
    waiting = iter([*sounds, 1e9])
    state = [next(waiting), -1.0]  # the next to begin, and until when the last one sounds

    def disturbed(scan_s):
        heard = state[1] > 0
        while state[0] < scan_s:
            heard, state[1], state[0] = True, state[0] + T_S, next(waiting)
        if state[1] <= scan_s:
            state[1] = -1.0
        return heard

    ghosts = Ghosts(probability, lives, size_mm, seed)
    kept = EventCapture(GhostlyPanel(BOARD, fingers, disturbed, ghosts, until_s=at_s, **panel))
    while (next_s := kept.next_time_s()) is not None:
        kept.read(next_s)
    return Recording(recording_text(kept.description, [*kept.events, *(emission_event(start_s, T_S) for start_s in sounds)]))


PANELS = [(5e-3, 1), (7e-3, 3), (10e-3, 2), (16e-3, 3)]


def check(period_s, longest, protocol, seed):
    """A ghost is first reported up to a period after the emission's end, and gone this many reports later."""
    life_ms = (longest + 1) * period_s * 1e3
    found = ghost_figures(measured(period_s=period_s, lives=(1, longest), protocol=protocol, seed=seed), BOARD)
    assert found.margin_ms == MARGIN_MS
    assert life_ms <= found.ghost_ms <= life_ms + MARGIN_MS + 1
    assert found.appears_ms[1] <= (T_S + period_s) * 1e3 + 1e-3
    assert found.rate == pytest.approx(0.3 * (1 + T_S / period_s), abs=0.12)  # an emission may fall into two scans


@each_row("protocol", [Protocol.A, Protocol.B])
@each_row(("period_s", "longest"), PANELS)
def test_what_is_written_covers_the_longest_life_there_is_and_the_margin_is_what_it_costs(period_s, longest, protocol):
    check(period_s, longest, protocol, seed=1)


@pytest.mark.slow
@pytest.mark.parametrize("protocol", [Protocol.A, Protocol.B])
@pytest.mark.parametrize(("period_s", "longest"), PANELS)
def test_what_is_written_covers_the_longest_life_of_many_panels(period_s, longest, protocol):
    for seed in range(100):
        check(period_s, longest, protocol, seed)


def test_a_panel_without_ghosts_needs_no_ghost_ms():
    found = ghost_figures(measured(probability=0.0), BOARD)
    assert (found.ghosts, found.rate, found.ghost_ms) == (0, 0.0, 0.0)
    assert found.rate_below == pytest.approx(0.01)
    assert found.appears_ms is found.gone_ms is found.size_mm is None


def test_of_few_ghosts_the_margin_is_larger():
    for seed in range(4):
        found = ghost_figures(measured(probability=0.03, seed=seed), BOARD)
        assert 1 <= found.ghosts < 30
        assert found.margin_ms == MARGIN_FEW_MS
        assert 28 <= found.ghost_ms <= 28 + MARGIN_FEW_MS + 1


def test_sizes_are_known_where_the_panel_tells_them():
    assert ghost_figures(measured(size_mm=7.0), BOARD).size_mm == pytest.approx((7.0, 7.0), abs=0.1)
    assert ghost_figures(measured(), BOARD).size_mm is None


@each_row(
    "finger",
    [
        (0.5, 1e9, (50, 50)),  # before the first emission, and stays
        (20.0, 1e9, (50, 50)),
        (20.0, 20.3, (50, 50)),
        (20.0, 20.16, (50, 50)),
    ],
)
def test_with_a_finger_on_the_panel_nothing_is_found(finger):
    with pytest.raises(CalibrationError, match="off the panel and do it again"):
        ghost_figures(measured(probability=0.0, fingers=[finger]), BOARD)


def test_a_panel_that_makes_contacts_out_of_silence_is_refused():
    recording = measured(probability=0.0)
    silence_s = recording.events[40][3] + 0.17
    with pytest.raises(CalibrationError, match="began or ended more than 150 ms after"):
        ghost_figures(measured(probability=0.0, fingers=[(silence_s + 1.0, silence_s + 1.007, (50, 50))], gap_s=(0.4, 0.5)), BOARD)


@each_row(
    ("how", "what"),
    [
        ({"emissions": MIN_EMISSIONS - 1}, f"only {MIN_EMISSIONS - 1} emissions"),
        ({"emissions": 0}, "has no emissions in it"),
        ({"gap_s": (0.02, 0.05)}, "less than 0.15 s apart"),
    ],
)
def test_what_does_not_suffice_is_refused(how, what):
    with pytest.raises(CalibrationError, match=what):
        ghost_figures(measured(**how), BOARD)
