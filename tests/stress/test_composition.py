"""Adversarial points and banks through every way from responses to bits: compiled kernel, NumPy twin, `drive_words`, `focus`, bank.

Seeds are stated by range: the short form is the beginning of the long one.
"""

import itertools
import math

import numpy as np
import pytest
from compiled_kernels import COMPILED, needs_compiled
from device.kernel.test_compose import PITCH_M, buffers, outcome
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS, channel_bits, drive_words, quantise
from controller.device.bank.reader import Bank
from controller.device.kernel import words_twin
from controller.device.waveforms.composition import MAX_FOCI, Composer
from controller.device.waveforms.selection import Selection
from controller.workshop.physics.focusing import balanced_weights, focus

SHORT, LONG = 60, 6000
IDLE_WORD = 0x69969669
X0_M, Y0_M = 5e-3, 6e-3
NX, NY = 4, 3
LONG_FORM = pytest.mark.parametrize(
    "seeds", [range(SHORT), pytest.param(range(SHORT, LONG), marks=pytest.mark.stress)], ids=["short", "long"]
)
DENORMAL = 5e-324


def random_point(random):
    """Anywhere, on a cell, on a border, at the grid's rim and beyond, next to any of these by nanometres or by a bit."""
    kind = random.integers(8)
    column, row = random.integers(-1, NX + 1), random.integers(-1, NY + 1)
    x_m, y_m = X0_M + column * PITCH_M, Y0_M + row * PITCH_M
    if kind == 0:
        x_m, y_m = random.uniform(-5e-3, 25e-3, 2)
    elif kind == 1:
        x_m += PITCH_M / 2
    elif kind == 2:
        x_m, y_m = np.nextafter(x_m, random.choice([-1, 1])), np.nextafter(y_m, random.choice([-1, 1]))
    elif kind == 3:
        x_m += random.choice([-1e-9, 1e-9, 1e-12, 2.4e-9, 2.6e-9])
    elif kind == 4:
        x_m, y_m = random.choice([0.0, -0.0, DENORMAL, -DENORMAL, 1e300, -1e300, 1.7e308, 1e-300], 2)
    amplitude = random.choice([1.0, 1.0, 0.25, np.nextafter(1.0, 0), DENORMAL, random.uniform(0.25, 1), 1e-300])
    return float(x_m), float(y_m), float(amplitude)


def random_points(random):
    """Fingers that coincide to nanometres, ten on one point, unlike amplitudes at one place, or all different."""
    count = int(random.integers(1, MAX_FOCI + 1))
    kind, first = random.integers(4), random_point(random)
    if kind == 0:
        return [first] * count
    if kind == 1:
        return [(first[0] + 1e-9 * int(random.integers(-3, 4)), first[1], first[2]) for _ in range(count)]
    if kind == 2:
        return [(*first[:2], random_point(random)[2]) for _ in range(count)]
    return [random_point(random) for _ in range(count)]


def random_bank(random):
    """Random levels; or of one value, all zeros, at the ends of their range, each cell the opposite of the one before it."""
    made = buffers(random, int(random.choice([1, 7, 8, 9, 40, 97])), NX, NY, int(random.choice([0, IDLE_WORD, 0xFFFFFFFF])), 48)
    levels = np.frombuffer(made[6], np.int8).reshape(NX * NY, -1).copy()
    kind = random.integers(6)
    if kind == 0:
        levels[:] = random.choice([-128, -1, 0, 1, 127])
    elif kind == 1:
        levels[1::2] = -np.maximum(levels[::2], -127)
    elif kind == 2:
        levels[random.random(levels.shape) < 0.9] = 0
    elif kind == 3:
        levels[:] = random.choice([-128, 127], levels.shape)
    scales = np.frombuffer(made[4], np.float32).copy()
    if random.random() < 0.3:
        scales[:] = random.choice([0.0, -0.0, 1e-45, 1.2e-38, 3.4e38], scales.shape)
    made[4], made[6] = scales.tobytes(), levels.tobytes()
    return made


@LONG_FORM
def test_kernel_and_twin_agree_on_what_nobody_would_play(seeds):
    refused = 0
    for seed in seeds:
        random = np.random.default_rng([1, seed])
        made, points = random_bank(random), random_points(random)
        answer = outcome(words_twin, made, points)
        refused += answer is ValueError
        for compiled in COMPILED:
            assert outcome(compiled, made, points) == answer, f"seed {seed}"
        made[1] = bytearray(random.bytes(len(made[1])))
        assert outcome(words_twin, made, points) == answer, f"seed {seed}: what was in the room matters"
    assert refused < 0.05 * len(seeds)


@LONG_FORM
def test_four_on_one_point_play_what_one_plays_there_or_its_opposite(seeds):
    for seed in seeds[:600]:
        random = np.random.default_rng([2, seed])
        made = buffers(random, 40, NX, NY, IDLE_WORD, 48, equaliser=0.0)  # one at full amplitude is not equalised
        x_m, y_m, _ = random_point(random)
        if not abs(x_m) < 1:
            continue
        one, four = (outcome(words_twin, made, [(x_m, y_m, 1.0)] * count)[1] for count in (1, 4))
        assert one == four, f"seed {seed}"


def bits_of(words):
    return channel_bits(np.frombuffer(words, "<u4"))


def test_a_sum_of_zero_plays_the_idle_bit_on_every_path(tmp_path, make_bank):
    """One tie rule: the kernel, its twin, `drive_words`, `focus` and the words of the bank."""
    random = np.random.default_rng(3)
    response = 1e-9 * random.standard_normal((40, CHANNELS))
    response[random.random(response.shape) < 0.5] = 0.0
    response[random.random(response.shape) < 0.1] = -0.0
    levels = quantise(response)[0]
    idle = channel_bits(np.full(40, IDLE_WORD, np.uint32))
    expected = np.where(levels == 0, idle, levels > 0)
    coarse = levels.astype(float)
    assert np.array_equal(bits_of(drive_words(coarse, IDLE_WORD).tobytes()), expected)
    assert np.array_equal(bits_of(drive_words(levels, IDLE_WORD).tobytes()), expected)
    assert np.array_equal(bits_of(focus(coarse[None], [1.0], IDLE_WORD).tobytes()), expected)
    assert np.array_equal(bits_of(focus(np.stack([coarse, -coarse]), [1.0, 1.0], IDLE_WORD).tobytes()), idle), "they cancel"
    make_bank(tmp_path / "bank", Grid(5e-3, 1, 1, X0_M, Y0_M), [True], 40, responses={0: levels * 1e-9})
    with Bank.open(tmp_path / "bank") as bank:
        assert np.array_equal(bits_of(bank.drive.words(0)), expected)
        composer = Composer(bank, IDLE_WORD)
        for points in ([(X0_M, Y0_M, 1.0)], [(X0_M, Y0_M, 1.0)] * 2, [(X0_M, Y0_M, 1.0)] * 10):
            assert np.array_equal(bits_of(composer.compose(points)), expected)


@pytest.mark.parametrize("kind", ["cancel", "zero and one"])
def test_responses_that_cancel_leave_both_points_what_they_can_have(kind):
    """Of opposite polarity opposite responses add up; a point that cannot move takes nothing from the other."""
    random = np.random.default_rng(4)
    here = random.standard_normal((200, CHANNELS))
    there = -here if kind == "cancel" else 0 * here
    weights = balanced_weights(np.stack([here, there]))
    assert np.isfinite(weights).all()
    bits = bits_of(focus(np.stack([here, there]), weights.tolist(), 0).tobytes())
    assert abs(np.vdot(2.0 * bits - 1, here)) == pytest.approx(np.abs(here).sum(), rel=1e-12)


NO_NUMBERS = (math.nan, math.inf, -math.inf)


@each_row(("which", "value"), list(itertools.product(range(3), NO_NUMBERS)))
def test_what_is_no_number_is_refused_as_documented(tmp_path, make_bank, which, value):
    make_bank(tmp_path / "bank")
    point = [6e-3, 7e-3, 1.0]
    point[which] = value
    with Bank.open(tmp_path / "bank") as bank:
        composer, selection = Composer(bank, IDLE_WORD), Selection(bank, 1e-3, IDLE_WORD)
        for points in ([tuple(point)], [(6e-3, 7e-3, 1.0), tuple(point)]):
            with pytest.raises(ValueError, match=r".+"):
                composer.compose(points)
            infinite_place = which < 2 and math.isinf(value)
            with pytest.raises(OverflowError if infinite_place else ValueError, match=r".+"):
                selection.key(points)


@pytest.mark.parametrize("value", NO_NUMBERS)
def test_a_response_that_is_no_number_reaches_no_bank(value):
    response = np.zeros((9, CHANNELS))
    response[4, 4] = value
    for take in (drive_words, quantise):
        with pytest.raises(ValueError, match="not finite"):
            take(response)


@each_row("size", [5e-324, 1e-310, 1e-45, 1.17e-38, 1e-30, 1e-9, 1e30])
def test_a_response_of_any_size_is_quantised_to_half_a_level_or_to_nothing(size):
    response = size * np.random.default_rng(5).uniform(-1, 1, (9, CHANNELS))
    levels, scale = quantise(response)
    assert np.isfinite(scale)
    if scale:
        assert np.abs(levels * scale - response).max() <= 0.51 * scale
        assert np.abs(levels).max() == 127
    else:
        assert size < 3e-36
        assert not levels.any()


@needs_compiled
@pytest.mark.parametrize("step_m", [1e-9, *(pytest.param(step_m, marks=pytest.mark.stress) for step_m in (1e-6, 0.1e-3))])
def test_across_the_borders_of_cells_the_displacement_does_not_jump(tmp_path, make_bank, waves, step_m):
    """Just left of a border and just right of it a finger gets the same, within what moving by so much does (a wave of 10 mm)."""
    grid = Grid(2.5e-3, 7, 6, X0_M, Y0_M)
    make_bank(tmp_path / "bank", grid, None, 200, responses={c: waves.at(*grid.place(c)) for c in range(grid.cells)})
    with Bank.open(tmp_path / "bank") as bank:
        composer = Composer(bank, IDLE_WORD)
        for column, row in itertools.product(range(1, 6), range(1, 5)):
            x_m, y_m = grid.place(row * grid.nx + column)
            for dx, dy in ((step_m, 0), (0, step_m), (step_m, step_m)):
                shares = []
                for sign in (-1, 1):
                    exact = waves.at(x_m + sign * dx, y_m + sign * dy)
                    bits = bits_of(composer.compose([(x_m + sign * dx, y_m + sign * dy, 1.0)]).tobytes())
                    shares.append(np.vdot(2.0 * bits - 1, exact) / np.abs(exact).sum())
                assert min(shares) > 0.98
                assert abs(shares[0] - shares[1]) < 0.01
