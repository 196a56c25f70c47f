"""When an interrupt line is believed; the chips at it: test_i2c_drivers.py."""

from collections import Counter

from hypothesis import given
from hypothesis import strategies as st

from controller.device.touch.drivers.interrupt_watch import MOST_EDGES_PER_S, SILENT_AFTER, TRUSTED_AFTER, InterruptWatch


def watch(reports=(), *, wired=True):
    warnings = Counter()
    made = InterruptWatch(warnings, wired=wired)
    for announced in reports:
        made.report(announced=announced)
    return made, warnings


def test_a_line_is_polled_until_three_reports_in_a_row_were_announced():
    assert watch()[0].polled
    assert watch([True] * (TRUSTED_AFTER - 1))[0].polled
    trusted, warnings = watch([True] * TRUSTED_AFTER)
    assert not trusted.polled
    assert not warnings
    assert watch([True, True, False, True, True])[0].polled


def test_one_missed_report_is_none_and_two_in_a_row_are_a_silent_line():
    trusted, warnings = watch([True] * TRUSTED_AFTER + [False, True, False])
    assert not trusted.polled
    assert not warnings
    for _ in range(SILENT_AFTER):
        trusted.report(announced=False)
    assert trusted.polled
    assert warnings == {"interrupt_silent": 1}


def test_an_edge_while_the_chip_is_read_says_nothing_of_an_unproven_line_and_against_a_trusted_one():
    made, warnings = watch()
    for _ in range(20):
        made.report(announced=False, edge_meanwhile=True)
    assert not warnings
    made, warnings = watch([True] * TRUSTED_AFTER)
    for _ in range(SILENT_AFTER):
        made.report(announced=False, edge_meanwhile=True)
    assert made.polled
    assert warnings == {"interrupt_silent": 1}


def test_a_line_with_more_edges_than_a_panel_can_have_is_ignored_until_the_next_start():
    made, warnings = watch()
    for second in range(10):
        made.edges(MOST_EDGES_PER_S, float(second))
    assert not made.ignored
    made.edges(1, 9.5)
    assert made.ignored
    assert made.polled
    assert warnings == {"interrupt_noisy": 1}
    for _ in range(20):
        made.report(announced=True)
    assert made.ignored
    made.started()
    assert not made.ignored


def test_without_a_line_nothing_is_counted():
    made, warnings = watch([False] * 50, wired=False)
    assert made.polled
    assert made.ignored
    assert not warnings


@given(st.lists(st.booleans(), max_size=60))
def test_after_any_reports_a_line_is_trusted_if_the_last_were_announced_and_silent_ones_are_counted_at_most_once_each(reports):
    made, warnings = watch(reports)
    if reports[-TRUSTED_AFTER:] == [True] * TRUSTED_AFTER:
        assert not made.polled
    if reports[-SILENT_AFTER:] == [False] * SILENT_AFTER:
        assert made.polled
        assert warnings["interrupt_silent"]
    assert warnings["interrupt_silent"] <= 1 + len(reports) // (SILENT_AFTER + TRUSTED_AFTER)
