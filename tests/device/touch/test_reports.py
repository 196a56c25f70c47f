from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.device.touch.reports import BIN_S, MAX_AHEAD_S, ReportClock, ReportRate


def test_a_report_is_never_later_than_now_and_never_before_the_last():
    warnings = Counter()
    times = ReportClock(warnings)
    assert times.corrected_s(1.0, 1.5) == 1.0
    assert times.corrected_s(1.0 + MAX_AHEAD_S / 2 + 0.5, 1.5) == 1.5  # came after the loop had looked at its clock
    assert not warnings
    assert times.corrected_s(1.75e9, 1.6) == 1.6  # the clock of another panel
    assert times.corrected_s(0.2, 1.7) == 1.6
    assert warnings == {"time_ahead": 1, "time_backwards": 1}
    rate = ReportRate()
    for time_s in (1.0, 1.008, 1.016):
        assert (rate.median_s, rate.jitter_s) == (None, None) or time_s > 1.008
        rate.report(time_s)
    assert rate.median_s == pytest.approx(8e-3, abs=BIN_S)
    assert rate.jitter_s < 2 * BIN_S


@given(st.lists(st.tuples(st.floats(0, 1e10), st.floats(0, 10)), max_size=30))
def test_any_times_are_put_in_order(found):
    times = ReportClock(Counter())
    now_s = last_s = 0.0
    for time_s, passed_s in found:
        now_s += passed_s
        settled_s = times.corrected_s(time_s, now_s)
        assert last_s <= settled_s <= now_s
        last_s = settled_s
