import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from tables import each_row

from controller.device.bank.packing import edges
from controller.device.bank.reader import Bank
from controller.device.board.panel import Driver
from controller.device.board.relations.stage_heat import half_charge_j, worst_edge_j
from controller.workshop.benchmark.stage.power import (
    Resistor,
    bank_losses,
    power_report,
    resistor_loss_j,
    stage_limits,
)
from controller.workshop.gateware.model.pins import ramp_bits

PAPER = Driver(supply_v=60.0, resistance_ohm=2000.0, inductance_h=6.8e-3, capacitance_f=2e-9, moment_n_per_v=1e-3)
PERIOD_S = 2e-6
REST = 200  # samples in which all ringing ends


def circuit(driver):
    """States voltage on the piezo, current; input the stage's voltage."""
    return np.array(
        [
            [0.0, 1 / driver.capacitance_f, 0.0],
            [-1 / driver.inductance_h, -driver.resistance_ohm / driver.inductance_h, 1 / driver.inductance_h],
            [0.0, 0.0, 0.0],
        ]
    )


def from_supply_less_stored_j(driver, levels):
    """Energy balance of the circuit, period by period: what the supply gives is stored or lost."""
    step = expm(circuit(driver) * PERIOD_S)
    state = np.array([driver.supply_v * levels[0], 0.0])

    def stored(state):
        return driver.capacitance_f * state[0] ** 2 / 2 + driver.inductance_h * state[1] ** 2 / 2

    supplied, at_first = 0.0, stored(state)
    for level in levels[1:]:
        stage_v = driver.supply_v * level
        following = (step @ [*state, stage_v])[:2]
        supplied += stage_v * driver.capacitance_f * (following[0] - state[0])  # the charge that came out of the stage
        state = following
    return supplied - (stored(state) - at_first)


def integral_of_r_i_squared_j(driver, levels):
    """By Gauss's rule within each period."""
    nodes, weights = np.polynomial.legendre.leggauss(6)
    steps = [expm(circuit(driver) * PERIOD_S * (1 + node) / 2) for node in nodes]
    whole = expm(circuit(driver) * PERIOD_S)
    state = np.array([driver.supply_v * levels[0], 0.0])
    heat = 0.0
    for level in levels[1:]:
        now = [*state, driver.supply_v * level]
        heat += sum(weight * (step @ now)[1] ** 2 for weight, step in zip(weights, steps, strict=True))
        state = (whole @ now)[:2]
    return heat * driver.resistance_ohm * PERIOD_S / 2


def waveform(seed, samples=300):
    """Random levels, some for long and some for one sample, and a rest."""
    random = np.random.default_rng(seed)
    levels = np.repeat(random.integers(0, 2, samples), random.integers(1, 12, samples))[:samples]
    return np.concatenate([levels, np.full(REST, levels[-1])])


@settings(max_examples=25, deadline=None)
@given(st.floats(500.0, 10e3), st.booleans())
def test_a_single_edge_costs_half_the_charge_whatever_the_damping(resistance_ohm, up):
    driver = msgspec.structs.replace(PAPER, resistance_ohm=resistance_ohm)
    levels = np.array([not up] + [up] * 5)
    assert resistor_loss_j(driver, levels, PERIOD_S) == pytest.approx(2e-9 * 60**2 / 2, rel=1e-9)


@each_row("seed", range(3))
def test_what_the_supply_gives_is_lost_or_stored(seed):
    levels = waveform(seed)
    loss_j = resistor_loss_j(PAPER, levels, PERIOD_S)
    assert loss_j == pytest.approx(from_supply_less_stored_j(PAPER, levels), rel=1e-9)
    assert loss_j == pytest.approx(integral_of_r_i_squared_j(PAPER, levels), rel=1e-6)


@each_row("part", ["resistance_ohm", "inductance_h", "capacitance_f", "supply_v"])
def test_a_part_one_per_cent_off_is_noticed(part):
    levels = waveform(1)
    off = msgspec.structs.replace(PAPER, **{part: getattr(PAPER, part) * (0.99 if part == "supply_v" else 1.01)})
    assert resistor_loss_j(off, levels, PERIOD_S) != pytest.approx(from_supply_less_stored_j(PAPER, levels), rel=1e-6)


def test_channels_are_computed_side_by_side():
    levels = np.stack([waveform(seed) for seed in range(4)], axis=1)
    apart = [resistor_loss_j(PAPER, column, PERIOD_S) for column in levels.T]
    assert resistor_loss_j(PAPER, levels, PERIOD_S) == pytest.approx(np.array(apart), rel=1e-12)


def square_wave_edge_j(driver, half_period_s):
    """Loss of one more edge of a square wave that has gone on for long, each half period of 16 samples."""
    levels = np.repeat(np.arange(202) % 2, 16)
    longer, shorter = (resistor_loss_j(driver, levels[: 16 * halves], half_period_s / 16) for halves in (202, 102))
    return (longer - shorter) / 100


def test_the_worst_edge_is_that_of_a_square_wave_and_none_costs_more():
    half_s = np.pi / np.sqrt(1 / (6.8e-3 * 2e-9) - (2000 / (2 * 6.8e-3)) ** 2)
    assert square_wave_edge_j(PAPER, half_s) == pytest.approx(worst_edge_j(PAPER), rel=1e-9)
    for factor in (0.7, 0.9, 0.99, 1.01, 1.1, 1.5):
        assert square_wave_edge_j(PAPER, half_s * factor) < worst_edge_j(PAPER)
    for seed in range(5):
        levels = waveform(seed)
        assert resistor_loss_j(PAPER, levels, PERIOD_S) < worst_edge_j(PAPER) * np.abs(np.diff(levels)).sum()
    overdamped = msgspec.structs.replace(PAPER, resistance_ohm=20e3)
    assert worst_edge_j(overdamped) == half_charge_j(overdamped) == pytest.approx(3.6e-6)


def test_a_ramp_makes_many_edges_that_cost_little():
    levels = np.concatenate([[0], ramp_bits(5000, up=True), [1]])
    count = int(np.abs(np.diff(levels.astype(int))).sum())
    assert (count, resistor_loss_j(PAPER, levels, PERIOD_S)) == (2211, pytest.approx(0.47e-3, rel=0.01))


def test_a_banks_entries_burn_what_the_paper_says(board, bank_file):
    with Bank.open(bank_file, board) as bank:
        counts, loss_j = bank_losses(board, bank)
        report = power_report(board, bank)
        hardware = power_report(
            msgspec.structs.replace(board, limits=msgspec.structs.replace(board.limits, resistor_rating_w=0.5)), bank
        )
        cells = np.flatnonzero(bank.cells)
        entries = [np.frombuffer(bank.drive.words(int(cell)), np.uint32) for cell in cells]
    idle = np.uint32(board.idle_word)
    assert (counts == [edges(np.concatenate([[idle], words, [idle]])) for words in entries]).all()
    levels = np.concatenate([[board.idle_word >> 5 & 1], entries[7] >> 5 & 1, [board.idle_word >> 5 & 1] * REST])
    assert loss_j[7, 5] == pytest.approx(from_supply_less_stored_j(board.driver, levels.astype(int)), rel=1e-9)
    assert report["full_duty_w"]["all"]["median"] == pytest.approx(8.0, rel=0.05)
    assert report["full_duty_w"]["channel"]["median"] == pytest.approx(0.25, rel=0.05)
    assert report["resistor"]["holds"]  # the simulated board allows full duty
    assert not hardware["resistor"]["holds"]


def test_limits_follow_from_what_the_resistor_may_burn():
    limits = stage_limits(PAPER, Resistor(0.5, 0.5), worst_channel_w=0.3, channels=32)
    assert (limits.permitted_w, limits.max_duty) == (0.25, pytest.approx(0.25 / 0.3))
    assert limits.max_channel_edge_rate_hz * worst_edge_j(PAPER) == pytest.approx(0.25)
    assert limits.max_total_edge_rate_hz == 32 * limits.max_channel_edge_rate_hz
    assert stage_limits(PAPER, Resistor(2.0, 0.5), worst_channel_w=0.3, channels=32).max_duty == 1.0
