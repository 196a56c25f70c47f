import msgspec
import numpy as np
import pytest
from scipy.linalg import expm
from tables import each_row
from workshop.physics.steps import step_displacement

from controller.device.bank.packing import channel_bits
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.capture import Capture
from controller.workshop.benchmark.device.idle import ramp_words
from controller.workshop.gateware.model.pins import ramp_bits
from controller.workshop.physics.audible import surface_energy, surface_spectrum
from controller.workshop.physics.field import AROUND_S, LINE_M, half_width
from controller.workshop.physics.focusing import balanced_weights, focus
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.step_response import StepResponse
from controller.workshop.physics.word_capture import capture_of_words

BOARD = load_board(find_board("simulated"))
IDLE = BOARD.idle_word
CLOCK_HZ = BOARD.link.clock_hz
BIT = BOARD.bit_ticks
LONG_AGO = CLOCK_HZ // 2  # ticks after which the step to the idle word is forgotten
HIGHEST_HZ = 12e3  # some 220 modes: arithmetic is the same for all
POINTS = [(0.08, 0.06), (0.14, 0.10), (0.03, 0.12)]


@pytest.fixture(scope="module")
def model():
    return ResponseModel(BOARD, HIGHEST_HZ)


@pytest.fixture
def twin():
    return PlateTwin(BOARD, HIGHEST_HZ)


def random_words(seed, samples=1000):
    return np.random.default_rng(seed).integers(0, 1 << 32, samples, np.uint64).astype(np.uint32)


def pins(ticks, words, focus_ticks, hv=1):
    return Capture(
        ticks=np.asarray(ticks, np.uint64),
        words=np.asarray(words, np.uint32),
        hv=np.full(len(ticks), hv, np.uint8),
        focus_ticks=np.asarray(focus_ticks, np.uint64),
    )


def relative_error(got, expected):
    return np.abs(got - expected).max() / np.abs(expected).max()


def superposed(model, words, idle=IDLE):
    """u at T from the pulse responses of the bank's way: voltages above idle times responses."""
    volts = (channel_bits(words) - channel_bits(np.array([idle], "<u4")).astype(float)) * BOARD.driver.supply_v
    return np.tensordot(model.responses(POINTS)[:, ::-1], volts, 2)


def test_steps_at_the_edges_and_responses_of_whole_bits_give_the_same_field(model, twin):
    words = random_words(1)
    field = next(twin.fields(capture_of_words(words, BIT, IDLE, LONG_AGO), CLOCK_HZ))
    assert relative_error(field.at(POINTS), superposed(model, words)) < 1e-9


def test_a_sample_of_slip_or_one_wrong_bit_is_far_outside_that_tolerance(model, twin):
    words = random_words(1)
    field = next(twin.fields(capture_of_words(np.roll(words, 1), BIT, IDLE, LONG_AGO), CLOCK_HZ))
    assert relative_error(field.at(POINTS), superposed(model, words)) > 1e-2
    words[500] ^= 1
    wrong = next(twin.fields(capture_of_words(words, BIT, IDLE, LONG_AGO), CLOCK_HZ))
    words[500] ^= 1
    assert relative_error(wrong.at(POINTS), superposed(model, words)) > 1e-6


def test_changes_off_the_grid_of_bits_are_met_by_the_matrix_exponential(twin):
    ticks = np.cumsum(np.random.default_rng(2).integers(1, 900, 60))
    words = random_words(3, 60)
    end = int(ticks[-1]) + 333
    field = next(twin.fields(pins(ticks, words, [end]), CLOCK_HZ))
    driver = BOARD.driver
    volts = channel_bits(words) * driver.supply_v
    rest = channel_bits(np.array([IDLE], "<u4"))[0] * driver.supply_v
    for mode in (0, 1, 50, 200):
        matrix = np.zeros((5, 5))
        matrix[0, 1] = 1
        matrix[1, :3] = -(twin.modes.angular_frequency[mode] ** 2), -2 * twin.modes.decay_rate[mode], 1 / twin.modes.mass_kg[mode]
        matrix[2, 3] = 1 / driver.capacitance_f
        matrix[3, 2:] = np.array([-1.0, -driver.resistance_ohm, 1.0]) / driver.inductance_h
        state = np.zeros(5)
        for level, held in zip(volts, np.diff(np.append(ticks, end)), strict=True):
            state[4] = twin.forces[mode] @ level  # all drivers are alike: their sum is one driver
            state = expm(matrix * held / CLOCK_HZ) @ state
        expected = state[0] - twin.step.static[mode] * (twin.forces[mode] @ rest)
        assert field.modal[mode] == pytest.approx(expected, rel=1e-9)


def test_the_ring_of_earlier_emissions_and_of_the_arming_is_carried_over(twin, model):
    words = random_words(4)
    period = 1300 * BIT
    short_ago = 40 * BIT
    *_, third = twin.fields(capture_of_words(words, BIT, IDLE, short_ago, period, 3), CLOCK_HZ)
    # the same by superposition of everything: idle step at 0, three emissions and their ends
    step = StepResponse.of(twin.modes, DriverResponse.of(BOARD.driver))
    shapes = twin.modes.shapes(POINTS)
    end = short_ago + 2 * period + 1000 * BIT
    once = np.concatenate([[IDLE], words, [IDLE]])
    changes = [(0, 0, IDLE)]
    for start in (short_ago, short_ago + period, short_ago + 2 * period):
        changes += [(start + n * BIT, int(once[n]), int(once[n + 1])) for n in range(1001)]
    modal = np.zeros(twin.modes.count)
    rest = channel_bits(np.array([IDLE], "<u4"))[0] * BOARD.driver.supply_v
    ages = {}
    for tick, before, after in changes:
        if before != after and tick < end:
            bits = channel_bits(np.array([before, after], "<u4")).astype(float)
            ages[tick] = ages.get(tick, 0) + (bits[1] - bits[0]) * BOARD.driver.supply_v
    for tick, volts in ages.items():
        modal += step_displacement(step, (end - tick) / CLOCK_HZ) * (twin.forces @ volts)
    expected = shapes @ (modal - step.static * (twin.forces @ rest))
    assert relative_error(third.at(POINTS), expected) < 1e-9
    assert relative_error(superposed(model, words), expected) > 1e-2  # what a single emission would give


def test_equal_bits_are_computed_once_and_other_bits_are_not_taken_for_them(twin):
    ring_out = 300_000
    list(twin.fields(capture_of_words(random_words(5), BIT, IDLE, ring_out, 1100 * BIT, 10), CLOCK_HZ))
    # the step to idle, the emission, the step back to idle
    assert (twin.work.groups_computed, twin.work.groups_reused) == (3, 17)
    other = random_words(5)
    other[7] ^= 0x100
    list(twin.fields(capture_of_words(other, BIT, IDLE, ring_out), CLOCK_HZ))
    assert (twin.work.groups_computed, twin.work.groups_reused) == (4, 18)


def test_what_is_remembered_is_bounded():
    twin = PlateTwin(BOARD, HIGHEST_HZ, remembered=1)
    for _ in range(2):
        list(twin.fields(capture_of_words(random_words(5), BIT, IDLE, 300_000), CLOCK_HZ))
    assert (twin.work.groups_computed, twin.work.groups_reused) == (4, 0)


def test_repetitions_without_a_pause_are_exact_and_reused(twin, model):
    words = random_words(6)
    many = capture_of_words(words, BIT, IDLE, LONG_AGO, 1000 * BIT, 4)
    fields = list(twin.fields(many, CLOCK_HZ))
    assert twin.work.groups_reused == 2
    assert relative_error(fields[0].at(POINTS), superposed(model, words)) < 1e-9
    apart = list(PlateTwin(BOARD, HIGHEST_HZ).fields(pins(many.ticks, many.words, many.focus_ticks[-1:]), CLOCK_HZ))
    assert relative_error(apart[0].at(POINTS), fields[-1].at(POINTS)) < 1e-9


def test_outputs_without_high_voltage_move_nothing(twin):
    rest = next(twin.fields(pins([100], [IDLE], [CLOCK_HZ]), CLOCK_HZ)).at(POINTS)
    off = next(twin.fields(pins([100], [IDLE], [CLOCK_HZ], hv=0), CLOCK_HZ)).at(POINTS)
    never = next(twin.fields(pins([], [], [CLOCK_HZ]), CLOCK_HZ)).at(POINTS)
    assert np.abs(rest).max() < 1e-6 * np.abs(off).max()  # at rest at the idle word is where zero is
    assert off.tolist() == never.tolist()


def test_the_time_around_the_focus_is_what_the_plate_does_then(twin):
    emission = capture_of_words(random_words(7), BIT, IDLE, LONG_AGO)
    end = int(emission.focus_ticks[0])
    u = next(twin.fields(emission, CLOCK_HZ)).around(POINTS[0])
    for offset_s in (-5e-6, -3.7e-6, -1e-6, 0.0, 1e-6, 4.4e-6):
        shifted = pins(emission.ticks, emission.words, [end + round(offset_s * CLOCK_HZ)])
        then = next(twin.fields(shifted, CLOCK_HZ)).at(POINTS[:1])[0]
        assert u[np.argmin(abs(AROUND_S - offset_s))] == pytest.approx(then, abs=1e-9 * np.abs(u).max())


def test_a_focus_is_where_it_was_aimed_at_and_evaluated_as_defined():
    twin = PlateTwin(BOARD)
    point = (0.08, 0.06)
    response = ResponseModel(BOARD).drive_order_responses([point], dtype=np.float64)
    words = focus(response, [1.0], IDLE)
    field = next(twin.fields(capture_of_words(words, BIT, IDLE, LONG_AGO), CLOCK_HZ))
    evaluated = field.focus_metrics(*point)
    assert evaluated.amplitude_m == pytest.approx(twin.reference_amplitude(*point), rel=1e-9)
    assert field.crest(0.0815, 0.0595) == pytest.approx(point, abs=0.2e-3)
    x, y, u = field.map()
    xs, ys = np.meshgrid(x, y)
    assert max(np.diff(x).max(), np.diff(y).max()) <= 2e-3 + 1e-12
    assert u.ravel() == pytest.approx(field.at(np.column_stack([xs.ravel(), ys.ravel()])), abs=1e-18)
    far = np.hypot(xs - point[0], ys - point[1]) > 10e-3
    assert evaluated.contrast == pytest.approx(evaluated.amplitude_m / np.sqrt(np.mean(u[far] ** 2)), rel=1e-12)
    # Parseval: the mean of u^2 over the plate is a quarter of the sum over modes
    assert evaluated.contrast_all == pytest.approx(evaluated.amplitude_m / np.sqrt(np.sum(field.modal**2) / 4), rel=1e-9)
    other = (0.16, 0.10)
    assert field.focus_metrics(*point, [point, other]).contrast != pytest.approx(evaluated.contrast, rel=1e-4)
    pushed = next(twin.fields(capture_of_words(focus(response, [-1.0], IDLE), BIT, IDLE, LONG_AGO), CLOCK_HZ)).focus_metrics(*point)
    assert pushed.amplitude_m == pytest.approx(-evaluated.amplitude_m, rel=0.1)  # the other way, with another start and end
    assert (pushed.spot_m, pushed.contrast) == pytest.approx((evaluated.spot_m, evaluated.contrast), rel=0.1)


def test_what_points_can_have_together_is_what_they_have_when_composed_exactly(model, twin):
    """Against the twin's own way from pins to displacement: the mean of their shares, weighed as their responses are."""
    responses = model.drive_order_responses(POINTS, dtype=np.float64)
    weights, sizes = balanced_weights(responses), np.abs(responses).sum(axis=(1, 2))
    field = next(twin.fields(capture_of_words(focus(responses, weights.tolist(), IDLE), BIT, IDLE, LONG_AGO), CLOCK_HZ))
    together = twin.exact_amplitudes(tuple(POINTS))
    level = np.average(np.abs(field.at(POINTS)) / sizes, weights=np.abs(weights) * sizes)
    assert together == pytest.approx(level * sizes, rel=1e-9)
    alone = [float(PlateTwin(BOARD, HIGHEST_HZ).exact_amplitudes((point,))[0]) for point in POINTS]
    assert [twin.reference_amplitude(*point) for point in POINTS] == pytest.approx(alone, rel=1e-12)
    assert together != pytest.approx(alone, rel=0.1)


@pytest.mark.parametrize("width_mm", [4.0, 5.2])
def test_half_width_of_a_bell_is_its_own(width_mm):
    bell = np.exp(-4 * np.log(2) * (LINE_M / (width_mm * 1e-3)) ** 2)
    assert half_width(bell) == pytest.approx(width_mm * 1e-3, rel=1e-3)
    assert half_width(bell) != pytest.approx(width_mm * 1.01e-3, rel=1e-3)


@pytest.mark.slow
@each_row(
    ("words", "before"),
    [(random_words(8, 5), IDLE), (ramp_words(BOARD, ramp_bits(40, up=True)), 0), (random_words(8, 5)[:0], 0)],
    ids=["emission", "ramp", "step"],
)
def test_audible_energy_adds_up_to_the_energy_over_time(words, before):
    # a plate with few modes and few words, so that time can be sampled finely; 0.3 % is 0.013 dB
    plate = msgspec.structs.replace(BOARD.plate, thickness_mm=40.0)
    board = msgspec.structs.replace(BOARD, plate=plate)
    modes = modes_of(board)
    assert 10 < modes.count < 40
    step = StepResponse.of(modes, DriverResponse.of(board.driver))
    forces = PlateTwin(board).forces
    step_s = 0.25e-6
    times = np.arange(40_000) * step_s
    levels = channel_bits(np.concatenate([[before], words, [IDLE]]).astype("<u4")).astype(float)
    velocity = np.zeros((modes.count, len(times)))
    for edge, volts in enumerate(np.diff(levels, axis=0) * board.driver.supply_v):
        since = times - edge * board.waveform.bit_period_s
        ring = step.by_mode((step.residues * step.poles)[:, None] * np.exp(np.outer(step.poles, np.maximum(since, 0)))).real
        settle = ((step.driver_residues * step.driver_poles) @ np.exp(np.outer(step.driver_poles, np.maximum(since, 0)))).real
        velocity += (forces @ volts)[:, None] * (ring + settle) * (since >= 0)
    over_time = np.sum(velocity**2) * step_s / 4
    assert surface_energy(board, words, IDLE, 0.0, 1e6, before_word=before) == pytest.approx(over_time, rel=3e-3)
    low = surface_energy(board, words, IDLE, before_word=before)
    assert 0 < low < over_time
    assert low + surface_energy(board, words, IDLE, 16e3, 1e6, before_word=before) == pytest.approx(over_time, rel=3e-3)


def test_a_spectrum_lies_between_its_limits_and_two_parts_of_it_have_its_energy():
    board = msgspec.structs.replace(BOARD, plate=msgspec.structs.replace(BOARD.plate, thickness_mm=40.0))
    words = random_words(8, 5)
    frequency, density, step_hz = surface_spectrum(board, words, IDLE, 2e3, 9e3)
    assert frequency[[0, -1]] == pytest.approx([2e3 + step_hz / 2, 9e3 - step_hz / 2], rel=1e-12)
    assert density.min() > 0
    parts = surface_energy(board, words, IDLE, 2e3, 5e3) + surface_energy(board, words, IDLE, 5e3, 9e3)
    assert parts == pytest.approx(surface_energy(board, words, IDLE, 2e3, 9e3), rel=1e-3)
