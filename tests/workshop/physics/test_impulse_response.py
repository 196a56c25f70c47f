import msgspec
import numpy as np
import pytest
from scipy.linalg import expm
from tables import each_row
from workshop.physics.steps import step_displacement

from controller.device.bank.file_format import REST_SAMPLES
from controller.device.bank.packing import channel_bits, drive_words
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.modal_response import band_gain, pulse_response
from controller.workshop.physics.responses.row_responses import in_rows

BOARD = load_board(find_board("simulated"))
POINTS = np.random.default_rng(3).uniform([0.01, 0.01], [0.2, 0.138], (20, 2))


@pytest.fixture(scope="module")
def model():
    return ResponseModel(BOARD)


def stepped_by_matrix_exponential(model, mode, board=BOARD):
    """Displacement of one mode after a pulse of one bit period: states (q, dq/dt, voltage, current), zero-order hold."""
    omega, rate = model.plate_modes.angular_frequency[mode], model.plate_modes.decay_rate[mode]
    driver = board.driver
    matrix = np.zeros((5, 5))
    matrix[0, 1] = 1
    matrix[1, :3] = -(omega**2), -2 * rate, 1 / model.plate_modes.mass_kg[mode]
    matrix[2, 3] = 1 / driver.capacitance_f
    matrix[3, 2:] = np.array([-1.0, -driver.resistance_ohm, 1.0]) / driver.inductance_h
    held = expm(matrix * board.waveform.bit_period_s)
    state = held[:4, 4]
    response = np.empty(board.waveform.samples)
    for sample in range(len(response)):
        response[sample] = state[0]
        state = held[:4, :4] @ state
    return response


@each_row("mode", [0, 1, 7, 100, 500, 1200, 1899])  # mode 0 is overdamped
def test_modes_are_stepped_as_by_the_matrix_exponential(model, mode):
    expected = stepped_by_matrix_exponential(model, mode)
    assert np.abs(model.modal[mode] - expected).max() <= 1e-9 * np.abs(expected).max()


@each_row("part", ["inductance_h", "resistance_ohm", "capacitance_f"])
def test_a_driver_one_per_cent_off_is_far_outside_that_tolerance(model, part):
    driver = msgspec.structs.replace(BOARD.driver, **{part: getattr(BOARD.driver, part) * 1.01})
    wrong = stepped_by_matrix_exponential(model, 500, msgspec.structs.replace(BOARD, driver=driver))
    assert np.abs(model.modal[500] - wrong).max() > 1e-4 * np.abs(wrong).max()


def test_pulses_are_differences_of_steps_at_the_edges_of_the_bit(model):
    period = BOARD.waveform.bit_period_s
    for sample in (0, 1, 10, 999):
        later, sooner = (step_displacement(model.step, (sample + after) * period) for after in (1, 0))
        expected = later - sooner
        # the difference of two steps is rounded to 1e-16 of a step, the pulse is not
        assert np.abs(model.modal[:, sample] - expected).max() <= 1e-9 * np.abs(model.modal).max()


def test_the_band_limited_response_is_the_long_response_through_a_zero_phase_filter():
    thick = msgspec.structs.replace(BOARD.plate, thickness_mm=5.0)  # a tenth of the modes
    model = ResponseModel(msgspec.structs.replace(BOARD, plate=thick))
    period, long, length = BOARD.waveform.bit_period_s, 16_000, 32_768
    spectrum = np.fft.rfft(pulse_response(model.step, period, long), length, axis=1)
    gain = band_gain(np.fft.rfftfreq(length, period), (20e3, 70e3))
    filtered = np.fft.irfft(spectrum * gain, length, axis=1)[:, :1000]
    assert np.abs(model.modal_band - filtered).max() < 1e-4 * np.abs(filtered).max()  # exp(-16): circles round after 16 ms
    assert np.abs(np.roll(model.modal_band, 1, axis=1) - filtered).max() > 0.1 * np.abs(filtered).max()  # a sample of phase


def test_the_filter_passes_the_band_and_nothing_one_can_hear():
    gain = band_gain(np.array([0.0, 16e3, 20e3, 24e3, 45e3, 66e3, 70e3, 74e3, 250e3]), (20e3, 70e3))
    assert gain == pytest.approx([0, 0, 0.5, 1, 1, 1, 0.5, 0, 0], abs=1e-12)


def sloped(slope, board=BOARD):
    return msgspec.structs.replace(board, waveform=msgspec.structs.replace(board.waveform, slope=slope))


def own_gain(hz, slope):
    """20 to 70 kHz with edges of 8 kHz, times a power of the frequency over 45 kHz."""
    risen, fallen = (np.clip(part, 0, 1) for part in ((hz - 16e3) / 8e3, (74e3 - hz) / 8e3))
    return (1 - np.cos(np.pi * risen)) / 2 * (1 - np.cos(np.pi * fallen)) / 2 * (np.maximum(hz, 1) / 45e3) ** slope


@each_row("slope", [-1.0, 1.0])
@each_row("decay_ms", [1.0, 100.0])  # the second rings for longer than a transform: its poles have the gain in closed form
def test_the_filter_has_a_slope(slope, decay_ms):
    plate = msgspec.structs.replace(BOARD.plate, thickness_mm=5.0, decay_time_ms=decay_ms)
    model = ResponseModel(sloped(slope, msgspec.structs.replace(BOARD, plate=plate)), 70e3)
    some, period, length = slice(30, 150, 40), BOARD.waveform.bit_period_s, 1 << (16 if decay_ms == 1 else 20)
    assert (model.plate_modes.angular_frequency[some] / 2 / np.pi > 20e3).any()
    spectrum = np.fft.rfft(pulse_response(model.step.part(some), period, length // 2 + 1000), length, axis=1)
    for wrong, caught in ((0.0, False), (0.01, True)):
        gain = own_gain(np.fft.rfftfreq(length, period), slope + wrong)
        filtered = np.fft.irfft(spectrum * gain, length, axis=1)[:, :1000]
        assert (np.abs(model.modal_band[some] - filtered).max() > 1e-3 * np.abs(filtered).max()) == caught


def left_after(rest, moved, slope):
    """Power of what bits in the band do by a rest, (place, row, channel), other than what they should, over that of the latter."""
    hz = np.fft.rfftfreq(1000, BOARD.waveform.bit_period_s)
    spectrum = np.where((hz > 20e3) & (hz < 70e3), np.maximum(hz, 1.0) ** slope, 0.0)
    sent = np.fft.irfft(np.fft.rfft(np.random.default_rng(1).normal(size=(1000, 40)), axis=0) * spectrum[:, None], axis=0)
    wrong, wanted = (np.einsum("sn,psc->npc", sent, some) for some in (np.repeat(rest, REST_SAMPLES, axis=1) - moved, moved))
    return (wrong**2).sum() / (wanted**2).sum()


def test_what_a_slope_of_minus_one_leaves_out_is_kept_better_than_by_means():
    flat, board = (ResponseModel(sloped(slope), 75e3).entry_responses(POINTS[:2], dtype=np.float64) for slope in (0.0, -1.0))
    moved = flat[:, :1000] - board[:, :1000]
    of_means = moved.reshape(2, -1, REST_SAMPLES, 32).mean(axis=2)
    kept, means = (left_after(rest, moved, -1.0) for rest in (board[:, 1000:] - flat[:, 1000:], of_means))
    print(f"{kept:.1e}, {means:.1e} by means")
    assert kept < 0.3 * means < 0.3 * 0.002


def test_a_slope_changes_what_is_in_the_band():
    flat, board = (ResponseModel(sloped(slope), 75e3) for slope in (0.0, 1.0))
    entry, plain = (model.entry_responses(POINTS[:2], dtype=np.float64) for model in (board, flat))
    assert entry[:, :1000] == pytest.approx(board.drive_order_responses(POINTS[:2], dtype=np.float64), abs=1e-15)
    moved = plain[:, :1000] - entry[:, :1000]
    assert abs(moved).max() > 1e-11
    in_band, of_flat = (np.abs(np.fft.rfft(found[:, :1000], axis=1)) for found in (entry, plain))
    hz = np.fft.rfftfreq(1000, BOARD.waveform.bit_period_s)
    for low, high in ((25e3, 35e3), (55e3, 65e3)):
        some = (hz > low) & (hz < high)
        assert in_band[:, some].sum() / of_flat[:, some].sum() == pytest.approx((low + high) / 90e3, rel=0.05)


def test_a_slope_is_part_of_the_digest_unless_it_is_zero():
    assert sloped(0.0).digest() == BOARD.digest() != sloped(1.0).digest() != sloped(0.9).digest()


def test_responses_are_sums_over_modes_in_either_order_of_time(model):
    shapes = model.plate_modes.shapes(POINTS[:2])
    expected = np.einsum("pk,kj,kq->pjq", shapes, model.modal_band, model.forces, optimize=True)
    scale = np.abs(expected).max()
    assert model.responses(POINTS[:2], band_limited=True) == pytest.approx(expected, abs=1e-12 * scale)
    assert model.drive_order_responses(POINTS[:2], dtype=np.float64)[:, ::-1] == pytest.approx(expected, abs=1e-12 * scale)


def test_channels_without_an_actuator_do_nothing():
    board = msgspec.structs.replace(BOARD, actuators=tuple(a for a in BOARD.actuators if a.channel not in (0, 31)))
    response = ResponseModel(board, 10e3).responses(POINTS[:1])[0]
    assert np.flatnonzero(np.any(response != 0, axis=0)).tolist() == list(range(1, 31))


def test_float32_plays_the_bits_of_float64(model):
    exact = model.drive_order_responses(POINTS, dtype=np.float64)
    into = np.empty((30, 1000, 32), np.float32)[5:25]
    rounded = model.drive_order_responses(POINTS, into)
    assert rounded is into
    for in_double, in_single in zip(exact, rounded, strict=True):
        wanted, got = channel_bits(drive_words(in_double)), channel_bits(drive_words(in_single))
        assert (wanted != got).mean() <= 1e-3
        assert np.vdot(2.0 * got - 1, in_double) >= 0.9999 * np.abs(in_double).sum()


def test_one_bit_in_a_hundred_wrong_is_outside_those_limits(model):
    exact = model.drive_order_responses(POINTS[:1], dtype=np.float64)[0]
    bits = channel_bits(drive_words(exact))
    wrong = bits ^ (np.random.default_rng(1).random(bits.shape) < 0.01)
    assert (wrong != bits).mean() > 1e-3
    assert np.vdot(2.0 * wrong - 1, exact) < 0.9999 * np.abs(exact).sum()


@pytest.mark.parametrize("out", [np.empty((1, 999, 32), np.float32), np.empty((1, 1000, 32))])
def test_refuses_an_array_that_does_not_fit(model, out):
    with pytest.raises(ValueError, match="out is"):
        model.drive_order_responses(POINTS[:1], out)


GRID = np.array([(x, y) for y in np.linspace(0.02, 0.13, 5) for x in np.linspace(0.01, 0.2, 11)])


@pytest.mark.slow
@each_row("dtype", [np.float32, np.float64])
@each_row("order", ["rows", "shuffled", "ragged"])
def test_points_in_rows_have_the_responses_they_have_anywhere(model, dtype, order):
    """The sum over orders along y first: another order of summation, so equal to rounding (measured 3e-7 and 1e-15)."""
    points = {"rows": GRID, "shuffled": np.random.default_rng(1).permutation(GRID), "ragged": GRID[np.arange(len(GRID)) % 7 != 3]}[
        order
    ]
    assert in_rows(points)
    found = model.drive_order_responses(points, dtype=dtype)
    exact = np.concatenate([model.drive_order_responses(point, dtype=np.float64) for point in points])
    largest = np.abs(exact).max()
    tolerance = 2e-6 if dtype is np.float32 else 1e-13
    assert np.abs(found - exact).max() <= tolerance * largest
    moved = model.drive_order_responses(points + np.array([1e-5, 0]), dtype=dtype)
    assert np.abs(moved - exact).max() > 100 * tolerance * largest, "ten micrometres off would be noticed"


def test_scattered_points_do_not_go_by_rows():
    assert not in_rows(POINTS)
