"""Sound against pistons, a monopole, Wallace's radiation of single modes, IEC's table, and a sum over retarded accelerations."""

from types import SimpleNamespace

import numpy as np
import pytest
from device.board.changed_board import changed
from small_plate import small_board
from tables import each_row

from controller.device.bank.packing import channel_bits
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.physics.design.design_figures import design_figures
from controller.workshop.physics.design.sound_estimate import radiation_efficiency
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.modes.closed_form import SimplySupported
from controller.workshop.physics.motion import PlateMotion
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.sound import (
    AIR_KG_M3,
    AT_ONCE,
    SOUND_M_S,
    PlateSound,
    Radiation,
    a_weighting,
    around,
    decibels,
    radiation_bytes,
)

SMALL = small_board()
BOARD = load_board(find_board("simulated"))
PAPER = BOARD.plate
WORDS = np.random.default_rng(3).integers(0, 1 << 32, 400, np.uint64).astype(np.uint32)
IMPEDANCE = AIR_KG_M3 * SOUND_M_S

# IEC 61672-1, table of weightings: exact frequency 10^(n/10) kHz, A in dB to a tenth
A_DB = {20: -50.5, 31.5: -39.4, 63: -26.2, 125: -16.1, 250: -8.6, 500: -3.2, 1000: 0.0, 2000: 1.2, 2500: 1.3, 4000: 1.0, 8000: -1.1}
A_DB |= {10000: -2.5, 12500: -4.3, 16000: -6.6, 20000: -9.3}


def piston(length_m, width_m):
    """A rectangle that moves as a whole, as the only mode."""
    shapes = lambda points, dtype=np.float64: np.ones((len(points), 1), dtype)  # noqa: E731
    return SimpleNamespace(length_m=length_m, width_m=width_m, count=1, shapes=shapes)


@each_row(("nominal_hz", "expected_db"), A_DB.items())
def test_weighting_a_is_that_of_the_standard(nominal_hz, expected_db):
    exact_hz = 1e3 * 10 ** (round(10 * np.log10(nominal_hz / 1e3)) / 10)
    found_db = 20 * np.log10(a_weighting(np.array([exact_hz])))[0]
    assert found_db == pytest.approx(expected_db, abs=0.051)
    assert nominal_hz != 1000 or found_db + 20 * np.log10(1.01) != pytest.approx(expected_db, abs=0.051), "1 % would be seen"


@each_row("height_m", [0.05, 0.3, 2.0])
def test_a_rectangular_piston_has_the_pressure_of_the_integral_along_its_rim(height_m):
    """On the axis: rho c v (exp(-j k z) - mean over all directions of exp(-j k R at the rim)); of a disc two terms are left."""
    length, width, frequency = 0.21, 0.148, np.linspace(50, 20e3, 40)
    k = 2 * np.pi * frequency / SOUND_M_S
    turned = (np.arange(20_000) + 0.5) * np.pi / 2 / 20_000  # a quarter of all directions
    rim = np.minimum(length / 2 / np.cos(turned), width / 2 / np.sin(turned))
    of_rim = np.exp(-1j * np.outer(k, np.hypot(rim, height_m))).mean(axis=1)
    expected = IMPEDANCE * (np.exp(-1j * k * height_m) - of_rim)
    found = Radiation(piston(length, width), np.array([[length / 2, width / 2, height_m]])).pressure(frequency)[0, :, 0]
    assert np.abs(found - expected).max() < 1e-5 * IMPEDANCE
    off = Radiation(piston(length * 1.01, width), np.array([[length * 0.505, width / 2, height_m]])).pressure(frequency)[0, :, 0]
    assert np.abs(off - expected).max() > 2e-3 * IMPEDANCE


def test_a_small_piston_far_away_is_a_monopole_on_a_wall():
    frequency, far = np.array([100.0, 400.0]), np.array([[3.0, 2.0, 6.0]])
    found = Radiation(piston(0.02, 0.015), far).pressure(frequency)[0, :, 0]
    apart = np.linalg.norm(far[0] - [0.01, 0.0075, 0])
    expected = (
        2j
        * np.pi
        * frequency
        * AIR_KG_M3
        * 0.02
        * 0.015
        / (2 * np.pi * apart)
        * np.exp(-2j * np.pi * frequency * apart / SOUND_M_S)
    )
    assert found == pytest.approx(expected, rel=1e-3)


def wallace(m, n, k, length, width):
    """Radiation efficiency of a mode, Wallace (J. Acoust. Soc. Am. 51, 1972, p. 946), eq. (5): an integral over directions."""
    nodes, weights = np.polynomial.legendre.leggauss(80)
    tilt, turned = np.meshgrid((nodes + 1) * np.pi / 4, (nodes + 1) * np.pi / 4, indexing="ij")
    area = np.outer(weights, weights) * (np.pi / 4) ** 2 * np.sin(tilt)
    a, b = k * length * np.sin(tilt) * np.cos(turned), k * width * np.sin(tilt) * np.sin(turned)
    sides = [(np.cos if order % 2 else np.sin)(phase / 2) / ((phase / order / np.pi) ** 2 - 1) for order, phase in ((m, a), (n, b))]
    return 64 * k**2 * length * width / (np.pi**6 * m**2 * n**2) * float((area * (sides[0] * sides[1]) ** 2).sum())


@each_row(("m", "n"), [(1, 1), (2, 1), (3, 1), (2, 2), (5, 4)])
def test_single_modes_radiate_as_wallace_says(m, n):
    """Power through a large half sphere over rho c times the plate's mean square velocity and area."""
    length, width = PAPER.length_m, PAPER.width_m
    modes = SimplySupported.of(PAPER, 6e3)
    number = np.flatnonzero((modes.factors.x_index == m - 1) & (modes.factors.y_index == n - 1))[0]
    nodes, weights = np.polynomial.legendre.leggauss(12)
    tilt, turned = np.meshgrid(np.arccos((nodes + 1) / 2), (np.arange(20) + 0.5) * np.pi / 10, indexing="ij")
    far_m, share = 60.0, np.outer(weights / 2, np.full(20, np.pi / 10)).ravel()  # of the solid angle
    directions = np.column_stack(
        [np.sin(tilt).ravel() * np.cos(turned).ravel(), np.sin(tilt).ravel() * np.sin(turned).ravel(), np.cos(tilt).ravel()]
    )
    frequency = np.array([200.0, 1e3, 3e3])
    one = SimpleNamespace(
        length_m=length, width_m=width, count=modes.count, shapes=lambda points: modes.shapes(points)[:, [number]]
    )
    one = SimpleNamespace(**{**vars(one), "count": 1, "shapes": lambda points: modes.shapes(points)[:, [number]]})
    pressure = Radiation(one, far_m * directions + [length / 2, width / 2, 0], highest_hz=4e3).pressure(frequency)[..., 0]
    efficiency = share @ np.abs(pressure) ** 2 * far_m**2 / (IMPEDANCE**2 * length * width / 4)
    k = 2 * np.pi * frequency / SOUND_M_S
    expected = [wallace(m, n, at, length, width) for at in k]
    assert efficiency == pytest.approx(expected, rel=2e-3)
    assert efficiency * 1.01 != pytest.approx(expected, rel=2e-3)
    if m % 2 and n % 2:  # his limit of low frequencies
        slow = (1 - 8 / (m * np.pi) ** 2) * length / width + (1 - 8 / (n * np.pi) ** 2) * width / length
        low = 32 * k[0] ** 2 * length * width / (m**2 * n**2 * np.pi**5) * (1 - k[0] ** 2 * length * width / 12 * slow)
        assert efficiency[0] == pytest.approx(low, rel=5e-3)


def test_an_emission_is_heard_as_accelerations_of_the_plate_summed_with_their_delays():
    """The motion of points of the plate in time, without a spectrum of modes or of bits."""
    period_s, rate_hz, words = 12e-3, 250e3, WORDS[:200]
    sound = PlateSound(SMALL, places_m=np.array([[0.05, 0.0, 0.2]]))
    modes, idle = sound._modes, SMALL.idle_word
    levels = channel_bits(np.concatenate([[idle], words, [idle]]).astype("<u4")).astype(float)
    steps_v = np.diff(levels, axis=0)[:, :, None] * SMALL.driver.supply_v
    (x, wx), (y, wy) = (np.polynomial.legendre.leggauss(count) for count in (26, 20))
    points = np.stack(np.meshgrid((x + 1) * 0.035, (y + 1) * 0.025), axis=-1).reshape(-1, 2)
    area = np.outer(wy, wx).ravel() * 0.035 * 0.025
    times = np.arange(round(period_s * rate_hz)) / rate_hz
    accelerated = PlateMotion(SMALL, modes).of_points(points, np.arange(len(steps_v)) * 2e-6, steps_v, times, "m/s^2")[:, 0]
    frequency, pressure2 = sound.lines(words, idle, period_s)
    spectrum = np.fft.rfft(accelerated)[:, 1 : len(frequency) + 1] / rate_hz
    apart = np.linalg.norm(np.column_stack([points - [0.05, 0.0], np.full(len(points), 0.2)]), axis=1)[:, None]
    waves = np.exp(-2j * np.pi * frequency * apart / SOUND_M_S) / apart
    expected = np.abs(AIR_KG_M3 / (2 * np.pi) * (area[:, None] * waves * spectrum).sum(axis=0)) ** 2
    assert pressure2.sum() == pytest.approx(expected.sum(), rel=2e-3)
    assert np.abs(pressure2 - expected).max() < 5e-3 * expected.max()


def test_exposure_and_level_of_a_train_belong_together():
    sound, idle = PlateSound(SMALL), SMALL.idle_word
    one_db = decibels(sound.exposure_pa2_s(WORDS, idle))
    assert sound.repeated_db(WORDS, idle, 40.0) == pytest.approx(one_db + 10 * np.log10(40.0), abs=0.1), (
        "nothing is left of one at the next"
    )
    many = np.concatenate([np.concatenate([WORDS, np.full(600, idle, np.uint32)])] * 40)  # 40 of 500 Hz: they ring into each other
    level_db = decibels(sound.exposure_pa2_s(many, idle) / (40 * 2e-3))
    assert sound.repeated_db(WORDS, idle, 500.0) == pytest.approx(level_db, abs=0.2)
    assert sound.exposure_pa2_s(np.full(50, idle, np.uint32), idle) == 0.0
    assert decibels(0.0) < -200
    louder = PlateSound(SMALL, modes=sound._modes)
    louder._forces = sound._forces * 1.01
    assert decibels(louder.exposure_pa2_s(WORDS, idle)) - one_db == pytest.approx(20 * np.log10(1.01), abs=1e-6)


def test_ten_microphones_hear_what_sixty_do():
    middle = SMALL.plate.length_m / 2, SMALL.plate.width_m / 2
    sounds = [PlateSound(SMALL, places_m=around(*middle, count=count)) for count in (10, 60)]
    ten_db, sixty_db = (decibels(sound.exposure_pa2_s(WORDS, SMALL.idle_word)) for sound in sounds)
    assert ten_db == pytest.approx(sixty_db, abs=2.0)
    assert np.linalg.norm(around(0.1, 0.05) - [0.1, 0.05, 0], axis=1) == pytest.approx([0.3] * 10)
    arrays = radiation_bytes(sounds[0]._modes) - 6 * 16 * AT_ONCE  # three as large as the coefficients, but for part of a node
    assert 2.9 < arrays / sounds[0]._radiation._coefficients.nbytes < 3.5
    for count in (10, 60):
        places = around(0.0, 0.0, 1.0, count)
        apart = np.linalg.norm(places[:, None] - places, axis=2) + 9 * np.eye(count)
        assert apart.min() > 0.8 * np.sqrt(2 * np.pi / count), "as far apart as squares of its share nearly are"


@pytest.mark.slow
@each_row("keys", [{}, {"plate__thickness_mm": 1.0}, {"waveform__band_low_hz": 10e3, "waveform__band_high_hz": 35e3}])
def test_the_design_foresees_the_sound_of_a_focus_some_decibels_too_low(keys):
    board = changed(BOARD, **keys)
    model = ResponseModel(board)
    words = focus(model.drive_order_responses([(0.1, 0.07)]), [1.0], board.idle_word)
    heard_db = decibels(PlateSound(board, model.plate_modes).exposure_pa2_s(words, board.idle_word))
    own = {"moment_n_per_v": board.driver.moment_n_per_v}  # else it follows from the glass
    foreseen = design_figures(board, own)["sound"]
    print(f"{keys}: {heard_db:.1f} dB, foreseen {foreseen['exposure_db']:.1f}")
    assert -5.5 < foreseen["exposure_db"] - heard_db < -1
    assert foreseen["repeated_db"] == pytest.approx(foreseen["exposure_db"] + 10 * np.log10(500))


def test_efficiency_of_many_modes_is_the_mean_of_wallaces():
    """Modes within a third of an octave at 8 kHz, each at its own frequency, on the paper's plate."""
    modes = SimplySupported.of(PAPER, 9e3)
    frequency = modes.angular_frequency / 2 / np.pi
    some = np.flatnonzero(frequency > 7.1e3)
    orders = zip(modes.factors.x_index[some] + 1, modes.factors.y_index[some] + 1, frequency[some], strict=True)
    each = [wallace(m, n, 2 * np.pi * hz / SOUND_M_S, PAPER.length_m, PAPER.width_m) for m, n, hz in orders]
    expected_db, found_db = 10 * np.log10(np.mean(each)), 10 * np.log10(radiation_efficiency(PAPER, np.array([8e3])))[0]
    print(f"{len(each)} modes near 8 kHz: {expected_db:.2f} dB, by the mean's formula {found_db:.2f}")
    assert found_db == pytest.approx(expected_db, abs=1.0)
