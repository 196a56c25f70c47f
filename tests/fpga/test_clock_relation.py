"""Host time to FPGA ticks: the stated bound holds for every drift, delay and seed, and is near what the delays allow."""

from math import pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.errors import LinkError
from controller.fpga.clock_relation import FEWEST_PAIRS, KEPT, MOST_DRIFT, WANDER_PER_S, ClockRelation

CLOCK_HZ = 80e6
UPTIME_S = 3.7e6  # of the host, six weeks: floats of seconds are 0.5 ns apart
STARTED_TICKS = 1 << 40
SETTLED_S = 40.0
WIRE_S = 36 * 8 / 13e6


class Panel:
    """A host and an FPGA whose clock runs `1 + drift(t)` times as fast as it should; `ticks` is the truth."""

    def __init__(self, drift=0.0, warming_per_s=0.0, swing=0.0, swing_s=60.0, seed=0):
        self.drift, self.warming_per_s, self.swing, self.swing_s = drift, warming_per_s, swing, swing_s
        self.random = np.random.default_rng(seed)

    def ticks(self, t_s):
        """Not rounded; `t_s` from the start."""
        w = 2 * pi / self.swing_s
        phase = self.drift * t_s + self.warming_per_s / 2 * t_s**2 + self.swing * (1 - np.cos(w * t_s)) / w
        return STARTED_TICKS + (t_s + phase) * CLOCK_HZ

    def drift_at(self, t_s):
        return self.drift + self.warming_per_s * t_s + self.swing * sin(2 * pi / self.swing_s * t_s)

    def exchange(self, relation, t_s, delays_s, wire_s=WIRE_S):
        before_s, after_s = (UPTIME_S + t_s - delays_s[0], UPTIME_S + t_s + wire_s + delays_s[1])
        relation.add(before_s, after_s, int(self.ticks(t_s)), wire_s)


DELAYS = {
    "none": lambda _: (1e-9, 1e-9),
    "constant and lopsided": lambda _: (5e-6, 60e-6),
    "exponential": lambda random: tuple(10e-6 + random.exponential(20e-6, 2)),
    "uniform": lambda random: tuple(random.uniform(5e-6, 80e-6, 2)),
    "two in a hundred late by milliseconds": lambda random: tuple(
        10e-6 + random.exponential(15e-6, 2) + (random.random(2) < 0.02) * random.uniform(1e-3, 20e-3, 2)
    ),
    "every tenth late by 5 ms, always after": lambda random: (10e-6, 20e-6 + (random.random() < 0.1) * 5e-3),
}


def run(panel, delays, seconds=SETTLED_S, every_s=0.06, ahead_s=(0.0, 0.01, 0.1, 1.0)):
    """Exchange heartbeats; at every twentieth, the error over its bound, of ticks and of host time, ahead and behind."""
    relation = ClockRelation(CLOCK_HZ)
    shares, bounds = [], []
    t_s = 0.0
    for count in range(int(seconds / every_s)):
        t_s += every_s * panel.random.uniform(0.2, 1.8)
        panel.exchange(relation, t_s, delays(panel.random))
        if relation.ready and count % 20 == 0:
            for ahead in (*ahead_s, *(-a for a in ahead_s)):
                at_s = t_s + ahead
                host_s = UPTIME_S + at_s
                bound_s = relation.error_s(host_s)
                tick = relation.ticks_at(host_s)
                shares.append(abs(tick - panel.ticks(at_s)) / CLOCK_HZ / bound_s)
                known_s = relation.host_s_at(round(panel.ticks(at_s)))
                shares.append(abs(known_s - host_s) / bound_s)
                bounds.append(bound_s)
    return relation, t_s, np.array(shares), bounds[-2 * len(ahead_s) :]


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("drift", [-100e-6, 0.0, 100e-6])
@pytest.mark.parametrize("delays", DELAYS)
def test_the_bound_holds_for_every_delay(delays, drift, seed):
    panel = Panel(drift, seed=seed)
    relation, t_s, shares, _ = run(panel, DELAYS[delays], seconds=20)
    assert relation.restarts == 0
    assert shares.max() <= 1
    drift_ppm, error_ppm = relation.drift_ppm()
    assert abs(drift_ppm - panel.drift_at(t_s) * 1e6) <= error_ppm


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    "temperature",
    [
        {"warming_per_s": WANDER_PER_S},  # as fast as is allowed, all the time
        {"warming_per_s": -WANDER_PER_S},
        {"swing": WANDER_PER_S * 60 / (2 * pi), "swing_s": 60.0},  # up and down, as fast as is allowed at its steepest
        {"swing": WANDER_PER_S * 12 / (2 * pi), "swing_s": 12.0},
    ],
)
def test_the_bound_holds_while_the_crystal_warms_and_cools(temperature, seed):
    panel = Panel(80e-6, **temperature, seed=seed)
    relation, t_s, shares, _ = run(panel, DELAYS["exponential"], seconds=60)
    assert relation.restarts == 0
    assert shares.max() <= 1
    drift_ppm, error_ppm = relation.drift_ppm()
    assert abs(drift_ppm - panel.drift_at(t_s) * 1e6) <= error_ppm


def test_the_allowance_for_temperature_is_needed(monkeypatch):
    """Without it, the same warming breaks the bound, or leaves no line at all."""
    monkeypatch.setattr("controller.fpga.clock_relation.WANDER_PER_S", 0.0)
    relation, _, shares, _ = run(Panel(80e-6, warming_per_s=WANDER_PER_S), DELAYS["none"])
    assert relation.restarts or shares.max() > 1


def test_the_bound_is_near_what_the_delays_allow():
    """Delays of 10 us and more each way: no estimate can be surer than half their sum; outliers change little."""
    _, _, _, (now, _, _, second, *_) = run(Panel(100e-6), DELAYS["exponential"])
    assert 10e-6 < now < 15e-6
    assert now < second < 25e-6  # a second from now the drift's own error counts
    _, _, _, (late, *_) = run(Panel(100e-6), DELAYS["two in a hundred late by milliseconds"])
    assert 10e-6 < late < 15e-6


def test_there_and_back_is_the_same_tick():
    relation, t_s, *_ = run(Panel(100e-6), DELAYS["exponential"], seconds=10)
    for ahead_s in (-5.0, 0.0, 0.1, 30.0):
        tick = relation.ticks_at(UPTIME_S + t_s + ahead_s)
        assert relation.ticks_at(relation.host_s_at(tick)) == pytest.approx(tick, abs=1)


def test_known_time_on_the_wire_narrows_the_bound():
    relation, ignorant = ClockRelation(CLOCK_HZ), ClockRelation(CLOCK_HZ)
    panel = Panel()
    for step in range(100):
        delays = DELAYS["constant and lopsided"](panel.random)
        panel.exchange(relation, step * 0.1, delays)
        panel.exchange(ignorant, step * 0.1, (delays[0], delays[1] + WIRE_S), wire_s=0.0)
    gain = ignorant.error_s(UPTIME_S + step * 0.1) - relation.error_s(UPTIME_S + step * 0.1)
    assert gain == pytest.approx(WIRE_S / 2, rel=0.01)


@pytest.mark.parametrize("drift", [-100e-6, 100e-6])
def test_a_drift_one_percent_wrong_is_noticed(drift):
    """It comes out within half of 1 %: one that were 1 % wrong would not pass."""
    for seed in range(3):
        relation, *_ = run(Panel(drift, seed=seed), DELAYS["exponential"], ahead_s=(0.0,))
        drift_ppm, error_ppm = relation.drift_ppm()
        assert error_ppm < 1.5  # at most, were the crystal warming as fast as is allowed
        assert drift_ppm == pytest.approx(drift * 1e6, rel=0.005)
        for wrong in (0.99, 1.01):
            assert drift_ppm * wrong != pytest.approx(drift * 1e6, rel=0.005)


@pytest.mark.parametrize("rate", [0.99, 1.01, 1.25])
def test_a_clock_that_is_not_the_boards_is_an_error(rate):
    panel = Panel(rate - 1)
    relation = ClockRelation(CLOCK_HZ)
    for step in range(2):
        panel.exchange(relation, step * 0.1, DELAYS["uniform"](panel.random))
    with pytest.raises(LinkError, match=rf"runs at {rate:.2f}\d* times the 80 MHz it should: check link\.clock_hz"):
        panel.exchange(relation, 0.2, DELAYS["uniform"](panel.random))
    assert not relation.ready


def test_does_not_answer_before_enough_pairs():
    relation, panel = ClockRelation(CLOCK_HZ), Panel()
    for pairs in range(FEWEST_PAIRS):
        assert not relation.ready
        for ask in (
            lambda: relation.ticks_at(UPTIME_S),
            lambda: relation.host_s_at(0),
            lambda: relation.error_s(UPTIME_S),
            relation.drift_ppm,
        ):
            with pytest.raises(LinkError, match=rf"not known yet: it takes {FEWEST_PAIRS - pairs} more frames"):
                ask()
        panel.exchange(relation, 0.1 * pairs, (1e-5, 1e-5))
    assert relation.ready
    assert abs(relation.ticks_at(UPTIME_S + 1) - panel.ticks(1)) / CLOCK_HZ <= relation.error_s(UPTIME_S + 1)


def test_pairs_all_at_once_leave_the_drift_open():
    """Enough pairs, but no time between them: the answer is only as sure as crystals are."""
    relation, panel = ClockRelation(CLOCK_HZ), Panel(100e-6)
    for _ in range(FEWEST_PAIRS):
        panel.exchange(relation, 1.0, (1e-6, 1e-6))
    assert relation.drift_ppm() == (pytest.approx(0, abs=1), pytest.approx(MOST_DRIFT * 1e6, rel=1e-3))
    assert relation.error_s(UPTIME_S + 2) == pytest.approx(MOST_DRIFT, rel=0.01)
    assert abs(relation.ticks_at(UPTIME_S + 2) - panel.ticks(2)) / CLOCK_HZ <= relation.error_s(UPTIME_S + 2)


def test_starts_anew_when_the_fpga_was_reset():
    panel = Panel(50e-6)
    relation, t_s, _, _ = run(panel, DELAYS["exponential"], seconds=5)
    offset = int(panel.ticks(t_s + 1))
    for step in range(FEWEST_PAIRS):
        assert relation.ready == (step == 0)
        at_s = t_s + 1 + 0.1 * step
        relation.add(UPTIME_S + at_s, UPTIME_S + at_s + 1e-4, int(panel.ticks(at_s)) - offset)
    assert (relation.restarts, relation.pairs) == (1, FEWEST_PAIRS)
    assert abs(relation.ticks_at(UPTIME_S + at_s) - (panel.ticks(at_s) - offset)) / CLOCK_HZ <= relation.error_s(UPTIME_S + at_s)


def test_resets_in_a_row_are_not_a_wrong_clock():
    relation = ClockRelation(CLOCK_HZ)
    for at_s, ticks in ((1.0, 9000), (2.0, 5000), (3.0, 4000), (4.0, 3000)):
        relation.add(UPTIME_S + at_s, UPTIME_S + at_s + 1e-4, ticks)
    assert relation.restarts == 3


@pytest.mark.parametrize("jump_s", [-2e-3, 2e-3, 3600.0])
def test_starts_anew_when_a_clock_jumps(jump_s):
    """A suspended host, or a reset soon after power-up: ticks go on, but not from where they were."""
    panel = Panel(50e-6)
    relation, t_s, _, _ = run(panel, DELAYS["exponential"], seconds=5)
    shifted = round(jump_s * CLOCK_HZ)
    for step in range(FEWEST_PAIRS):
        at_s = t_s + 0.1 * (step + 1)
        relation.add(UPTIME_S + at_s - 1e-5, UPTIME_S + at_s + 1e-5, int(panel.ticks(at_s)) + shifted)
    assert (relation.restarts, relation.ready) == (1, True)
    assert abs(relation.ticks_at(UPTIME_S + at_s) - panel.ticks(at_s) - shifted) / CLOCK_HZ <= relation.error_s(UPTIME_S + at_s)


def test_memory_is_bounded():
    panel = Panel(20e-6)
    relation, *_ = run(panel, DELAYS["uniform"], seconds=100, every_s=0.1, ahead_s=(0.0,))
    assert relation._count > KEPT == len(relation._kept)
    assert len(relation._corners) < 20


@pytest.mark.parametrize(("before_s", "after_s", "wire_s"), [(1.0, 0.9, 0.0), (1.0, 1.001, 0.002), (float("nan"), 1.0, 0.0)])
def test_refuses_an_exchange_that_ends_before_it_began(before_s, after_s, wire_s):
    with pytest.raises(ValueError, match="an exchange from"):
        ClockRelation(CLOCK_HZ).add(before_s, after_s, 0, wire_s)


@settings(max_examples=40, deadline=None)
@given(
    drift=st.floats(-100e-6, 100e-6),
    warming=st.floats(-WANDER_PER_S, WANDER_PER_S),
    gaps_s=st.lists(st.floats(1e-4, 5.0), min_size=FEWEST_PAIRS, max_size=40),
    data=st.data(),
)
def test_the_bound_holds_whatever_the_delays(drift, warming, gaps_s, data):
    panel = Panel(drift, warming_per_s=warming)
    relation = ClockRelation(CLOCK_HZ)
    delay = st.one_of(st.floats(0, 50e-6), st.floats(0, 20e-3))
    for t_s in np.cumsum(gaps_s):
        panel.exchange(relation, t_s, (data.draw(delay), data.draw(delay)))
    assert relation.restarts == 0
    for at_s in (t_s, t_s + data.draw(st.floats(-1, 5))):
        host_s = UPTIME_S + at_s
        bound_s = relation.error_s(host_s)
        assert abs(relation.ticks_at(host_s) - panel.ticks(at_s)) / CLOCK_HZ <= bound_s
        assert abs(relation.host_s_at(round(panel.ticks(at_s))) - host_s) <= bound_s
