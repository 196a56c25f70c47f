"""The limits of the boards: endless 500 Hz at full duty, as in the paper, on the simulated panel but not on hardware."""

import selectors

import numpy as np
import pytest

from controller.clocks import VirtualClock
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import Control, Fault, Register
from controller.device.service.drivers import open_session
from controller.errors import FaultError
from controller.workshop.gateware.model.edge_counts import PARTS, part_ticks
from controller.workshop.gateware.model.pins import ramp_bits
from controller.workshop.gateware.simulated_link import open_simulated

PERIOD_S = 2e-3  # of 500 Hz, and of an emission
BUSIEST_EDGES_PER_S = 104e3  # of a channel at full duty, by `bank info --power`


def play_endlessly(name, seconds):
    """Play random words back to back for a time; returns the fault, session, pins and start."""
    board = load_board(find_board(name))
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    # like a real waveform in its edges: 154 of a channel in 1000 words
    drive = np.random.default_rng(1).random((1000, 32)) < 0.154
    bits = np.bitwise_xor.accumulate(drive, axis=0)
    words = np.packbits(bits, axis=1, bitorder="little").view("<u4")[:, 0]
    with selectors.DefaultSelector() as selector:

        def rest(until_s):
            while clock.now_s() < until_s:
                session.heartbeat()
                clock.wait(selector, min(until_s, clock.now_s() + 0.02))

        session.upload(0, memoryview(words.tobytes()))
        rest(session.arm())
        session.require_armed()
        session.play(Play(0, emissions=0, period_ticks=session.timing.period_ticks(PERIOD_S)), stop=False)
        began_s = session.trigger()
        try:
            rest(began_s + seconds)
        except FaultError as fault:
            return fault, session, link.take_capture(), began_s
        return None, session, link.take_capture(), began_s


def test_the_simulated_panel_plays_500_hz_for_as_long_as_asked():
    fault, session, capture, _ = play_endlessly("simulated", 1.0)
    assert fault is None
    assert session.exchange.read(Register.DUTY_LEVEL) == 0
    assert capture.focus_ticks.size > 495


def test_hardware_shuts_it_off_when_the_duty_budget_is_spent():
    fault, session, capture, began_s = play_endlessly("ulx3s", 1.0)
    assert "Emissions exceeded the duty limit" in str(fault)
    session.exchange.control(Control.CLEAR, raise_faults=False)
    board = load_board(find_board("ulx3s"))
    ramp_s, budget_s, share = board.limits.ramp_ms * 1e-3, board.limits.duty_budget_ms * 1e-3, board.limits.max_duty
    spent_s = (budget_s - ramp_s * (1 - share)) / (1 - share)  # the ramp before has taken its part; 0.02 ms leaked since
    assert capture.ticks[-1] / board.link.clock_hz - began_s == pytest.approx(spent_s, rel=5e-3)
    assert capture.hv[-1] == capture.words[-1] == 0
    assert Fault.DUTY.sentence in str(fault)


def test_hardware_runs_out_of_duty_before_the_busiest_channel_runs_out_of_edges():
    """As long as edges count at most, with a disarming and an arming among them."""
    board = load_board(find_board("ulx3s"))
    parameters = BuildParameters.of(board, 0)
    window_s = PARTS * part_ticks(parameters.edge_window_ticks) / board.link.clock_hz
    limits = board.limits
    active_s = limits.duty_budget_ms * 1e-3 + limits.max_duty * window_s
    ramp_edges = int(np.abs(np.diff(ramp_bits(parameters.ramp_samples_reset, up=True).astype(int), prepend=0)).sum())
    edges = (active_s - 2 * limits.ramp_ms * 1e-3) * BUSIEST_EDGES_PER_S + 2 * ramp_edges
    assert 0.9 * parameters.channel_edges_max < edges < parameters.channel_edges_max
