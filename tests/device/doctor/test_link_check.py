"""The recommended SCK is one that the wires carry, and the error rate has a bound."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.special import chdtri
from tables import each_row

from controller.clocks import VirtualClock
from controller.device.doctor.bit_errors import BitErrors, bit_errors
from controller.device.doctor.link_check import (
    MARGIN,
    SWEEP_STEPS,
    SpeedResult,
    bit_error_count,
    error_rate_bound,
    measured_sck_hz,
    proposed_sck_hz,
    sweep,
)
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import FRAME_BYTES
from controller.device.fpga.registers import Register
from controller.device.fpga.session import Session
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import SimulatedLink

BUILD = 7


class LongWires(SimulatedLink):
    """A link that damages one bit of every frame above `carried_hz`, and every bit above twice that."""

    carried_hz = math.inf

    def exchange(self, sent, lengths, received):
        super().exchange(sent, lengths, received)
        start = 0
        for length in lengths:
            if self.sck_hz > 2 * self.carried_hz:
                received[start : start + length] = b"\xff" * length
            elif self.sck_hz > self.carried_hz and length > 100:
                received[start + 100] ^= 1
            start += length


@pytest.fixture
def wired(board):
    clock = VirtualClock()
    link = LongWires(board.link, clock.now_s, GatewareModel(BuildParameters.of(board, BUILD)))
    return link, Session(link, board, BUILD, clock.now_s)


@given(st.integers(0, 200), st.integers(1000, 10**9))
def test_the_bound_is_that_of_the_chi_squared_distribution(errors, bits):
    exact = chdtri(2 * (errors + 1), 0.05) / 2 / bits
    assert error_rate_bound(errors, bits) == pytest.approx(min(exact, 1.0), rel=1e-6)


def test_no_error_in_n_bits_is_the_rule_of_three():
    assert error_rate_bound(0, 10**6) == pytest.approx(3e-6, rel=0.002)
    assert error_rate_bound(0, 0) == 1


def test_one_damaged_bit_counts_once():
    assert bit_error_count(BitErrors(frames=8, frames_refused=1, answers_damaged=0, bits=30_000, wrong_bits=1)) == (30_000, 1)
    assert bit_error_count(BitErrors(frames=8, frames_refused=0, answers_damaged=0, bits=0, wrong_bits=0)) == (8 * 512 * 8, 0)


def test_a_frame_refused_there_and_an_answer_damaged_on_its_way_back_are_two_errors():
    assert bit_error_count(BitErrors(frames=8, frames_refused=2, answers_damaged=3, bits=0, wrong_bits=0)) == (8 * 512 * 8, 5)
    assert bit_error_count(BitErrors(frames=8, frames_refused=2, answers_damaged=3, bits=30_000, wrong_bits=9)) == (30_000, 9)


def test_earlier_errors_are_not_counted_again(board, wired):
    link, session = wired
    link.carried_hz = 0.9 * board.link.sck_hz
    rng = np.random.default_rng(1)
    assert bit_errors(session, 1e4, rng).wrong_bits > 0
    session.exchange.sent[:FRAME_BYTES] = bytes(FRAME_BYTES)  # no frame at all
    session.exchange.send_unchecked([FRAME_BYTES])
    assert session.exchange.read(Register.FRAME_ERRORS) > 0
    link.carried_hz = math.inf
    found = bit_errors(session, 1e4, rng)
    assert (found.frames_refused, found.answers_damaged, found.wrong_bits) == (0, 0, 0)


@each_row("carried", [1.0, 0.8, 0.55, 0.3], afresh=[wired])
def test_a_sweep_finds_the_fastest_clock_without_errors(board, wired, carried):
    link, session = wired
    link.carried_hz = carried * board.link.sck_hz
    reported = []
    speeds = sweep(session, link, board.link.sck_hz, 1e4, np.random.default_rng(1), lambda *done: reported.append(done))
    assert reported == [(number, len(SWEEP_STEPS)) for number in range(1, len(SWEEP_STEPS) + 1)]
    assert [speed.asked_hz for speed in speeds] == [round(step * board.link.sck_hz) for step in SWEEP_STEPS]
    assert [speed.good for speed in speeds] == [step <= carried for step in SWEEP_STEPS]
    assert all("only ones came back" in speed.trouble for speed in speeds if speed.sck_hz > 2 * link.carried_hz)
    assert link.sck_hz == speeds[0].asked_hz
    proposal_hz = proposed_sck_hz(speeds)
    assert proposal_hz <= link.carried_hz
    assert session.heartbeat().faults == 0


def test_a_link_without_any_good_speed_gets_no_proposal(board, wired):
    link, session = wired
    link.carried_hz = 1e5
    assert proposed_sck_hz(sweep(session, link, board.link.sck_hz, 1e4, np.random.default_rng(1))) is None


@given(st.lists(st.booleans(), min_size=1, max_size=12))
@example([True] * 5 + [False])
@example([True] * 4 + [False])
def test_the_proposed_speed_keeps_its_margin(goods):
    speeds = [SpeedResult((n + 1) * 1_000_000, (n + 1) * 1e6, 1000, 0 if good else 1, "") for n, good in enumerate(goods)]
    proposal_hz = proposed_sck_hz(speeds)
    failed_hz = [speed.asked_hz for speed in speeds if not speed.good]
    if proposal_hz is None:
        assert not [speed for speed in speeds if speed.good and speed.asked_hz <= MARGIN * min(failed_hz)]
        return
    assert all(speed.good for speed in speeds if speed.asked_hz <= proposal_hz)
    assert proposal_hz <= MARGIN * min(failed_hz, default=math.inf)
    if not failed_hz:
        assert proposal_hz == speeds[-1].asked_hz


def test_sck_is_measured_by_the_time_that_frames_take(wired):
    link, session = wired
    for sck_hz in (25_000_000, 10_000_000):
        link.set_sck_hz(sck_hz)
        assert measured_sck_hz(session, link) == pytest.approx(sck_hz, rel=2e-3)
        assert measured_sck_hz(session, link) != pytest.approx(sck_hz * 1.01, rel=2e-3)
