"""Banks of one cell and of a million, hashes of what went in and what came out, drift of nothing between builds."""

import hashlib

import numpy as np
import pytest
from stress.boards import changed

from controller.device.bank.grid import Grid
from controller.device.bank.inspection import bank_info, verify_bank
from controller.device.bank.reader import Bank
from controller.device.waveforms.composition import Composer
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.workers.workers import Workers

THICK = {"thickness_mm": 5.0}


def test_a_bank_of_one_cell_plays_and_composes_everywhere(board, tmp_path):
    thick = changed(board, plate=THICK)
    build_bank(BankRequest(thick, tmp_path / "bank", 74e-3))
    with Bank.open(tmp_path / "bank", thick) as bank:
        assert (bank.grid.nx, bank.grid.ny, bank.cells.tolist()) == (1, 1, [True])
        entry = bytes(bank.drive.words(0))
        composer = Composer(bank, thick.idle_word)
        for place in (bank.grid.place(0), (0.0, 0.0), (0.21, 0.148), (-1e9, 1e9)):
            composed = np.frombuffer(composer.compose([(*place, 1.0)]).tobytes(), np.uint8)
            differing = np.unpackbits(composed ^ np.frombuffer(entry, np.uint8)).mean()
            assert differing < 0.03, "but for bits too small for 8 bits; those of another place would be half of them"


MILLION = 4000.0 * 3000.0 / 1e6  # mm2 of a floor for each of a million cells


def test_a_grid_of_a_million_cells_of_which_few_are_built(board, tmp_path):
    """A floor of 4 x 3 m at 3.46 mm; built are a handful at its corners and in the middle."""
    floor = changed(
        board,
        plate={"length_mm": 4000.0, "width_mm": 3000.0, "thickness_mm": 20.0},
        waveform={"band_low_hz": 1e3, "band_high_hz": 8e3, "bit_clock_hz": 100e3, "duration_ms": 1.0},
        limits={"max_edge_rate_hz": 100e3},
    )
    pitch_m = (MILLION * 1e-6) ** 0.5
    grid = Grid.of(floor.plate, pitch_m)
    assert 0.99e6 < grid.cells < 1.01e6
    chosen = np.zeros(grid.cells, bool)
    built = [0, grid.nx - 1, grid.cells // 2, grid.cells - grid.nx, grid.cells - 1]
    chosen[built] = True
    report = build_bank(BankRequest(floor, tmp_path / "bank", pitch_m, chosen, highest_hz=12e3))
    assert report.cells == len(built)
    assert (tmp_path / "bank").stat().st_size < 6e6, "an index of 4 bytes a cell, and the entries"
    verify_bank(tmp_path / "bank")
    with Bank.open(tmp_path / "bank", floor) as bank:
        assert np.flatnonzero(bank.cells).tolist() == built
        for cell in built:
            x_m, y_m = bank.grid.place(cell)
            assert bank.grid.nearest(x_m, y_m)[0] == cell
            assert len(bank.drive.words(cell)) == 4 * floor.waveform.samples
            Composer(bank, floor.idle_word).compose([(x_m, y_m, 1.0)])


@pytest.mark.stress
def test_a_grid_of_a_million_cells_has_every_cell_nearest_to_its_own_place():
    grid = Grid(3.46e-3, 1154, 866, 5e-3, 6e-3)
    random = np.random.default_rng(6)
    for cell in random.integers(0, grid.cells, 200_000).tolist():
        x_m, y_m = grid.place(cell)
        assert grid.nearest(x_m, y_m)[0] == cell
        corners, weights = grid.corners(x_m, y_m)
        assert [c for c, w in zip(corners, weights, strict=True) if w] == [cell]


def of_inputs(path):
    parameters = bank_info(path)["parameters"]
    return parameters["inputs_sha256"], parameters["content_sha256"]


def test_the_header_tells_inputs_and_content_and_both_change_with_what_they_are_of(board, tmp_path):
    thick = changed(board, plate=THICK)
    for name, some, pitch_m in (
        ("one", thick, 70e-3),
        ("again", thick, 70e-3),
        ("pitch", thick, 69e-3),
        ("plate", changed(thick, plate={"young_modulus_pa": thick.plate.young_modulus_pa * 1.0001}), 70e-3),
    ):
        build_bank(BankRequest(some, tmp_path / name, pitch_m))
    assert (tmp_path / "one").read_bytes() == (tmp_path / "again").read_bytes()
    reported = {name: of_inputs(tmp_path / name) for name in ("one", "again", "pitch", "plate")}
    assert reported["one"] == reported["again"]
    assert all(len(hashed) == 64 and int(hashed, 16) for pair in reported.values() for hashed in pair)
    assert len({inputs for inputs, _ in reported.values()}) == len({content for _, content in reported.values()}) == 3


@pytest.mark.stress
def test_optimised_banks_have_the_same_bytes_for_one_worker_and_for_two(board, tmp_path):
    thick = changed(board, plate={"thickness_mm": 3.0})
    cells = np.zeros(Grid.of(thick.plate, 35e-3).cells, bool)
    cells[[0, 3, 7, 8, 11]] = True
    for processes in (1, 2):
        build_bank(BankRequest(thick, tmp_path / str(processes), 35e-3, cells, aim=AIMS["contrast"], workers=Workers(processes)))
    one, two = ((tmp_path / name).read_bytes() for name in ("1", "2"))
    assert hashlib.sha256(one).digest() == hashlib.sha256(two).digest()
    build_bank(BankRequest(thick, tmp_path / "plain", 35e-3, cells))
    assert (tmp_path / "plain").read_bytes() != one
