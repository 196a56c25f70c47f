"""Points too near to be distinguished, asked for unlike amplitudes: nobody gets more than asked for, or the other way."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS, channel_bits
from controller.device.bank.reader import Bank
from controller.device.waveforms.composition import Composer

IDLE_WORD = 0x69969669
IDLE = np.array([IDLE_WORD >> q & 1 for q in range(CHANNELS)])
SAMPLES = 200
GRID = Grid(2.5e-3, 7, 6, 5e-3, 6e-3)
PLACE = (10e-3, 11e-3)


@pytest.fixture(scope="module")
def bank(tmp_path_factory, make_bank, waves):
    path = tmp_path_factory.mktemp("bank") / "bank"
    many = type(waves)(3, modes=200)
    make_bank(path, GRID, None, SAMPLES, responses={cell: many.at(*GRID.place(cell)) for cell in range(GRID.cells)})
    with Bank.open(path) as opened:
        yield opened


def displacements(bank, words, points):
    """In the band, from rest at the idle word, over the sum of the absolute values of each point's response."""
    deviation = channel_bits(np.frombuffer(words, "<u4")) - IDLE.astype(float)
    found = []
    for x_m, y_m, _ in points:
        cells, shares = bank.grid.corners(x_m, y_m)
        response = sum(
            share * bank.responses.response(cell)[1] * bank.responses.response(cell)[0].astype(float)
            for cell, share in zip(cells, shares, strict=True)
        )
        found.append(np.sum(deviation * response) / np.abs(response).sum())
    return np.array(found)


near = st.floats(-3e-3, 3e-3)
amplitudes = st.floats(0.25, 1)


@settings(max_examples=60, deadline=None)
@given(points=st.lists(st.tuples(near, near, amplitudes), min_size=2, max_size=6))
@example(points=[(0.0, 0.0, 1.0), (0.0, 0.0, 0.25)])
@example(points=[(0.0, 0.0, 1.0), (1e-3, 0.0, 0.25)])
@example(points=[(0.0, 0.0, 1.0), (1e-9, 0.0, 0.25), (0.0, 1e-3, 0.6)])
@example(points=[(0.0, 0.0, 0.25 + 0.075 * n) for n in range(10)])
def test_of_near_points_nobody_gets_more_than_asked_for_or_the_other_way(bank, points):
    """Of what each gets when all are at full amplitude; tolerance: 6,400 bits."""
    composer = Composer(bank, IDLE_WORD)
    placed = [(PLACE[0] + x_m, PLACE[1] + y_m, amplitude) for x_m, y_m, amplitude in points]
    full = displacements(bank, composer.compose([(x_m, y_m, 1.0) for x_m, y_m, _ in placed]).tobytes(), placed)
    got = displacements(bank, composer.compose(placed).tobytes(), placed)
    share = got / full / [amplitude for *_, amplitude in placed]
    assert (share > 0).all()
    assert (share < 1.12).all()


def test_of_two_points_at_one_place_both_get_the_smaller_amplitude(bank):
    composer = Composer(bank, IDLE_WORD)
    points = [(*PLACE, 1.0), (*PLACE, 0.25)]
    full, got = (
        displacements(bank, composer.compose([(*PLACE, a) for a in asked]).tobytes(), points) for asked in ((1, 1), (1, 0.25))
    )
    assert got / full == pytest.approx(0.25, rel=0.05)


def test_far_from_each_other_each_has_its_own(bank):
    composer = Composer(bank, IDLE_WORD)
    points = [(*GRID.place(0), 1.0), (*GRID.place(GRID.cells - 1), 0.25)]
    full, got = (
        displacements(
            bank, composer.compose([(x_m, y_m, a) for (x_m, y_m, _), a in zip(points, asked, strict=True)]).tobytes(), points
        )
        for asked in ((1, 1), (1, 0.25))
    )
    assert got / full == pytest.approx([1, 0.25], rel=0.06)


@each_row("place", [(math.inf, 0.0), (0.0, -math.inf), (math.nan, 0.0), (0.0, math.nan)])
@each_row("amplitude", [1.0, 0.5])
def test_a_place_that_is_not_finite_is_refused(bank, place, amplitude):
    with pytest.raises(ValueError, match="not finite"):
        Composer(bank, IDLE_WORD).compose([(*PLACE, 1.0), (*place, amplitude)])


def test_a_place_beyond_all_numbers_is_that_of_the_nearest_cell(bank):
    composer = Composer(bank, IDLE_WORD)
    far = composer.compose([(1.7e308, -1.7e308, 0.5)]).tobytes()
    assert composer.compose([(*GRID.place(GRID.nx - 1), 0.5)]).tobytes() == far
