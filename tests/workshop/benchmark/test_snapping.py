"""The snap distance of the boards: an entry that is played where the lattice would round the place no less loses nothing."""

import numpy as np
import pytest
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.bank.packing import WORD, drive_words
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.fpga.frames import ReadyFrames
from controller.device.kernel import unpack_loads
from controller.device.waveforms.selection import LATTICE_M, Selection
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.prediction import FocusPrediction
from controller.workshop.bank_builder.request import BankRequest, cells_around
from controller.workshop.physics.responses.impulse_response import ResponseModel


@each_row("name", ["simulated", "ulx3s", "ulx3s_pi5"])
def test_a_board_snaps_no_farther_than_places_are_rounded(name):
    assert load_board(find_board(name)).bank.snap_mm * 1e-3 <= LATTICE_M


def lost(board, bank, snap_mm, places_m):
    """Share of the amplitude that is lost at each place, against the sign of the exact response there."""
    model = ResponseModel(board)
    prediction, selection = FocusPrediction(board, model), Selection(bank, snap_mm * 1e-3, board.idle_word)
    shares = []
    for place_m in places_m:
        waveform, words = selection.waveform(selection.key([(*place_m.tolist(), 1.0)])), bytearray(4 * board.waveform.samples)
        if isinstance(waveform, ReadyFrames):
            unpack_loads(words, waveform.frames)
        else:
            words[:] = waveform
        played, exact = (
            prediction.at_focus(some, [place_m])[0]
            for some in (np.frombuffer(words, WORD), drive_words(model.drive_order_responses([place_m])[0], board.idle_word))
        )
        shares.append(1 - played / exact)
    return np.array(shares)


@pytest.mark.slow
def test_a_cell_that_is_played_for_a_finger_within_the_lattice_loses_nothing_and_one_at_1_mm_does(board, tmp_path):
    pitch_m = board.bank.pitch_mm * 1e-3
    grid = Grid.of(board.plate, pitch_m)
    centre_m = np.array(grid.place(grid.nearest(0.1, 0.07)[0]))
    angles = np.arange(6)
    around = np.column_stack([np.cos(angles), np.sin(angles)])
    places_m = np.concatenate([centre_m + 0.24e-3 * around, centre_m + 0.98e-3 * around])
    build_bank(BankRequest(board, tmp_path / "bank", pitch_m, cells_around(grid, places_m.tolist())))
    with Bank.open(tmp_path / "bank", board) as bank:
        none, quarter, one = (lost(board, bank, snap_mm, places_m) for snap_mm in (0.0, 0.25, 1.0))
    near, far = slice(0, 6), slice(6, 12)
    assert np.abs(quarter[near]).max() < 0.012
    assert quarter[far] == pytest.approx(none[far], abs=1e-12)
    assert np.abs(none).max() < 0.012
    assert one[far].min() > 0.03
    assert one[near] == pytest.approx(quarter[near], abs=1e-12)
