"""Latency histograms: percentiles within the width of a bucket, in constant memory."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tables import each_row

from controller.commands.common.tables import service_table
from controller.device.touch.source import Counts as TouchCounts
from controller.metrics import BOUNDS_US, P999_SAMPLES, STAGES, Counters, LatencyHistogram, Stages

durations = st.lists(st.integers(0, 10**12), min_size=1, max_size=300)


@given(durations, st.sampled_from([0.5, 0.9, 0.99, 1.0]))
def test_percentiles_are_those_of_the_values_within_a_bucket(values, share):
    histogram = LatencyHistogram()
    for value in values:
        histogram.record(value)
    exact = float(np.percentile(values, 100 * share, method="inverted_cdf"))
    assert histogram.percentiles_ns([share])[0] == pytest.approx(exact, rel=1 / 128, abs=0.5)
    assert histogram.worst_ns == max(values)
    assert histogram.count == len(values)


@given(durations)
@example([256])  # in the middle of its bucket it would be 257: as far off as a sum can be
def test_coarse_counts_and_sum_are_those_of_the_values_within_a_bucket(values):
    histogram = LatencyHistogram()
    for value in values:
        histogram.record(value)
    coarse = histogram.coarse()
    for bound_us, count in zip(BOUNDS_US, coarse["counts"], strict=True):
        below, above = (sum(value <= 1000 * bound_us * (1 + sign / 128) for value in values) for sign in (-1, 1))
        assert below <= count <= above
    sum_us = sum(values) * 1e-3
    assert coarse["sum_us"] == pytest.approx(sum_us, abs=sum_us / 256 + 0.6e-3)  # half a bucket, and half of the last digit
    assert coarse["count"] == len(values)


@each_row("exact", [100, 12_345, 10**9])
def test_one_percent_is_noticed(exact):
    histogram = LatencyHistogram()
    histogram.record(round(exact * 1.01))
    histogram.record(round(exact * 1.01))
    assert histogram.percentiles_ns([0.5])[0] != pytest.approx(exact, rel=1 / 256)


def test_says_nothing_of_what_it_has_too_few_records_for():
    histogram = LatencyHistogram()
    assert histogram.summary_us() == {"count": 0, "p50": None, "p99": None, "p999": None, "worst": None}
    for _ in range(P999_SAMPLES - 1):
        histogram.record(1000)
    assert histogram.summary_us()["p999"] is None
    histogram.record(1000)
    assert histogram.summary_us() == {"count": P999_SAMPLES, "p50": 1.0, "p99": 1.0, "p999": 1.0, "worst": 1.0}


def test_a_clock_stepped_back_counts_as_no_time():
    histogram = LatencyHistogram()
    histogram.record(-5)
    assert histogram.percentiles_ns([1.0])[0] == 0


def test_the_total_is_the_sum_of_its_stages():
    stages = Stages()
    stages.record(100, 20, 3_000, 50_000, 4)
    assert {name: getattr(stages, name).worst_ns for name in STAGES} == {
        "decide": 100,
        "frame": 20,
        "wire": 3_000,
        "wait": 50_000,
        "trigger": 4,
        "host": 124,
        "total": 53_124,
    }


@given(st.lists(st.integers(0, 10**10), max_size=50))
def test_an_exported_histogram_has_every_record_below_its_upper_bound(durations_ns):
    histogram = LatencyHistogram()
    for duration_ns in durations_ns:
        histogram.record(duration_ns)
    exported = histogram.export()["histogram"]
    assert sum(count for _, count in exported) == len(durations_ns)
    below = 0
    for upper_us, count in exported:
        below += count
        assert below == sum(duration_ns < round(upper_us * 1e3) for duration_ns in durations_ns)


def test_the_table_of_a_service_says_how_it_ended():
    said = {
        "board": "panel",
        "bank": "panel.bank",
        "memory": "memory: 8 GB",
        "state": "waiting for FPGA",
        "cause": "there is no serial port",
        "warnings": [],
    }
    said["touch"] = {"plausibility": TouchCounts().plausibility({})}
    table = service_table(Counters().export() | said)
    assert "bank: panel.bank\nmemory: 8 GB\nat the end: waiting for FPGA (there is no serial port)\n" in table
    assert "at the end: armed\n" in service_table(Counters().export() | said | {"state": "armed", "cause": ""})
