"""Which waveform serves which points, and what is left out on the way."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.packing import edges
from controller.device.bank.reader import Bank
from controller.device.fpga.frames import ReadyFrames
from controller.device.waveforms.amplitude import AMPLITUDES, amplitude_step
from controller.device.waveforms.composition import Composer
from controller.device.waveforms.selection import FINER, LATTICE_M, Selection

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
    assert selection.waveform(key) == ReadyFrames(*bank.drive.frames(50))
    assert not selection.composes
    assert "response" not in bank.counters.mapped_bytes


def test_a_finger_between_cells_is_interpolated(bank, selection, board):
    x_m, y_m = bank.grid.points()[50]
    key = selection.key([(x_m + 1.5e-3, y_m, 1.0)])
    assert not isinstance(key, int)
    words = bytes(selection.waveform(key))
    assert words == bytes(Composer(bank, board.idle_word).compose([(x_m + 1.5e-3, y_m, 1.0)]))
    assert words != bytes(bank.drive.words(50))
    assert selection.composes


def test_a_finger_at_rest_asks_for_the_same_waveform_whatever_its_noise(selection):
    middle = 0.1 + 0.1 * LATTICE_M  # 0.1 m is a point of the lattice
    keys = {selection.key([(middle + noise, 0.07 + noise, 1.0)]) for noise in np.linspace(-0.2, 0.2, 5) * LATTICE_M}
    assert len(keys) == 1


@each_row("steps", [200.5, 201.5, 202.49999999999997, 203.5000000000001, 0.5, -0.5, -1.5])
def test_a_place_is_rounded_to_the_lattice_and_of_two_to_the_even_one(selection, steps):
    x_m = steps * LATTICE_M
    expected = round(x_m / LATTICE_M)
    ((x, _, _),) = selection.key([(x_m, 0.0, 0.5)])
    assert x == expected
    finer_m = LATTICE_M / FINER
    key = selection.key([(steps * finer_m, 0.0, 1.0), (0.15, 0.1, 1.0)])
    assert sorted(x for x, _, _ in key) == sorted([expected, round(0.15 / finer_m)])


def test_the_order_of_the_fingers_does_not_matter_but_their_amplitudes_do(selection):
    a, b = (0.05, 0.05, 1.0), (0.15, 0.1, 0.5)
    assert selection.key([a, b]) == selection.key([b, a])
    assert selection.key([a, b]) != selection.key([(0.05, 0.05, 0.5), (0.15, 0.1, 1.0)])


def test_two_fingers_on_cells_are_composed_all_the_same(bank, selection):
    (ax, ay), (bx, by) = bank.grid.points()[[50, 120]]
    words = bytes(selection.waveform(selection.key([(ax, ay, 1.0), (bx, by, 1.0)])))
    assert words not in {bytes(bank.drive.words(50)), bytes(bank.drive.words(120))}


def test_less_than_full_amplitude_is_composed_on_a_cell_too(bank, selection):
    x_m, y_m = bank.grid.points()[50]
    key = selection.key([(x_m, y_m, 0.5)])
    assert not isinstance(key, int)
    held, full = (np.frombuffer(words, "<u4") for words in (selection.waveform(key), bank.drive.words(50)))
    assert edges(held).sum() < 0.7 * edges(full).sum()


@given(st.floats(0.25, 1))
def test_an_amplitude_is_rounded_by_less_than_it_may_be_off(amplitude):
    step = amplitude_step(amplitude)
    assert AMPLITUDES[step] == pytest.approx(amplitude, rel=0.0028)
    assert amplitude_step(AMPLITUDES[step]) == step


def test_a_quarter_is_the_least_amplitude():
    assert AMPLITUDES[0] == 1
    assert AMPLITUDES[amplitude_step(0.25)] == 0.25
    assert AMPLITUDES[amplitude_step(0.1)] == AMPLITUDES[amplitude_step(1e-9)] == 0.1


@each_row("amplitude", [0.0, -1.0, 1.001, float("nan"), float("inf")])
def test_refuses_an_amplitude_that_cannot_be(selection, amplitude):
    with pytest.raises(ValueError, match="amplitude"):
        selection.key([(0.05, 0.05, amplitude)])


def test_a_resident_waveform_of_one_point_near_by_and_of_the_same_amplitude_serves(bank, selection, board):
    x_m, y_m = bank.grid.points()[50]
    cell = selection.key([(x_m, y_m, 1.0)])
    x_m += 1.5e-3  # off the cell
    here = selection.key([(x_m, y_m, 1.0)])
    near, far = (selection.key([(x_m + off_m, y_m, 1.0)]) for off_m in (0.25e-3, 0.75e-3))
    assert selection.reusable(near, here)
    assert not selection.reusable(far, here)
    selection.reuse_m = LATTICE_M  # one step, exactly
    assert selection.reusable(((1, 0, 32),), ((0, 0, 32),))
    assert not selection.reusable(here, cell)
    assert selection.reusable(cell, cell)
    fine = Selection(bank, 0.2e-3, board.idle_word)  # so that a place beside a cell does not play the cell itself
    beside, farther = (fine.key([(x_m - 1.5e-3 + off_m, y_m, 1.0)]) for off_m in (0.3e-3, 0.7e-3))
    assert fine.reusable(beside, cell)
    assert not fine.reusable(farther, cell)
    weaker = selection.key([(x_m, y_m, 0.5)])
    assert not selection.reusable(weaker, here)
    assert selection.reusable(weaker, weaker)
    two = selection.key([(x_m, y_m, 1.0), (0.15, 0.1, 1.0)])
    assert not selection.reusable(two, here)
    assert not selection.reusable(here, two)
