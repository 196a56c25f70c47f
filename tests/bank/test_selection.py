"""Which waveform serves which points, and what is left out on the way."""

import numpy as np
import pytest

from controller.bank.composition import Composer
from controller.bank.reader import Bank
from controller.bank.selection import LATTICE_M, Selection

SNAP_M = 1e-3


@pytest.fixture
def bank(bank_file, board):
    with Bank.open(bank_file, board) as opened:
        yield opened


@pytest.fixture
def selection(bank, board):
    return Selection(bank, SNAP_M, board.idle_word)


def test_a_lone_finger_near_a_cell_plays_the_banks_entry_and_maps_no_responses(bank, selection):
    x_m, y_m = bank.grid.points()[50]
    key = selection.key([(x_m + 0.6e-3, y_m - 0.6e-3, 1.0)])
    assert key == 50
    assert selection.words(key) == bank.words(50)
    assert not selection.composes
    assert "response" not in bank.counters.mapped_bytes


def test_a_finger_between_cells_is_interpolated(bank, selection, board):
    x_m, y_m = bank.grid.points()[50]
    key = selection.key([(x_m + 1.5e-3, y_m, 1.0)])
    assert not isinstance(key, int)
    words = bytes(selection.words(key))
    assert words == bytes(Composer(bank, board.idle_word).compose([(x_m + 1.5e-3, y_m, 1.0)]))
    assert words != bytes(bank.words(50))
    assert selection.composes


def test_a_finger_at_rest_asks_for_the_same_waveform_whatever_its_noise(selection):
    middle = 0.1 + 0.1 * LATTICE_M  # 0.1 m is a point of the lattice
    keys = {selection.key([(middle + noise, 0.07 + noise, 1.0)]) for noise in np.linspace(-0.2, 0.2, 5) * LATTICE_M}
    assert len(keys) == 1


def test_the_order_of_the_fingers_does_not_matter_but_their_weights_do(selection):
    a, b = (0.05, 0.05, 1.0), (0.15, 0.1, 0.5)
    assert selection.key([a, b]) == selection.key([b, a])
    assert selection.key([a, b]) != selection.key([(0.05, 0.05, 0.5), (0.15, 0.1, 1.0)])


def test_two_fingers_on_cells_are_composed_all_the_same(bank, selection):
    (ax, ay), (bx, by) = bank.grid.points()[[50, 120]]
    words = bytes(selection.words(selection.key([(ax, ay, 1.0), (bx, by, 1.0)])))
    assert words not in {bytes(bank.words(50)), bytes(bank.words(120))}
