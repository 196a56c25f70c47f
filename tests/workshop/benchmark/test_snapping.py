"""The snap distance of the boards: an entry that is played where the lattice would round the place no less loses nothing."""

import numpy as np
import pytest
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.waveforms.selection import LATTICE_M
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.benchmark.device import snapping


@each_row("name", ["simulated", "ulx3s", "ulx3s_pi5", "ice40_hx8k"])
def test_a_board_snaps_no_farther_than_places_are_rounded(name):
    assert load_board(find_board(name)).bank.snap_mm * 1e-3 <= LATTICE_M


def test_a_cell_that_is_played_for_a_finger_within_the_lattice_loses_nothing_and_one_at_1_mm_does(board, tmp_path):
    pitch_m = board.bank.pitch_mm * 1e-3
    grid = Grid.of(board.plate, pitch_m)
    centre_m = np.array(grid.place(grid.nearest(0.1, 0.07)[0]))
    angles = np.arange(6)
    around = np.column_stack([np.cos(angles), np.sin(angles)])
    places_m = np.concatenate([centre_m + 0.24e-3 * around, centre_m + 0.98e-3 * around])
    cells = np.zeros(grid.cells, bool)
    for x_m, y_m in places_m.tolist():
        cells[list(grid.corners(x_m, y_m)[0])] = True
    build_bank(BankRequest(board, tmp_path / "bank", pitch_m, cells))
    with Bank.open(tmp_path / "bank", board) as bank:
        lost = snapping.amplitude_lost(board, bank, places_m)
    near, far = slice(0, 6), slice(6, 12)
    assert np.abs(lost[0.25][near]).max() < 0.012
    assert lost[0.25][far] == pytest.approx(lost[0.0][far], abs=1e-12)
    assert np.abs(lost[0.0]).max() < 0.012
    assert lost[1.0][far].min() > 0.03
    assert lost[1.0][near] == pytest.approx(lost[0.25][near], abs=1e-12)
