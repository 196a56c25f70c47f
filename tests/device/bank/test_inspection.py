import os

import msgspec
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from controller.device.bank.grid import Grid
from controller.device.bank.inspection import bank_info, verify_bank
from controller.device.bank.reader import Bank
from controller.errors import BankError
from controller.workshop.bank_builder.bank_fit import fit

CELLS = [True, False, True, True, False, False]


@pytest.fixture(scope="module")
def bank_path(tmp_path_factory, make_bank):
    path = tmp_path_factory.mktemp("bank") / "bank"
    make_bank(path, cells=CELLS, compositions={((3, 4, 0), (9, 9, 0)): np.arange(9, dtype=np.uint32)})
    return path


def refusal(path, bit):
    """What verify says with one bit of the file flipped; the bit is flipped back."""
    offset, mask = bit >> 3, 1 << (bit & 7)
    with path.open("r+b") as file:
        byte = os.pread(file.fileno(), 1, offset)[0]
        os.pwrite(file.fileno(), bytes([byte ^ mask]), offset)
        try:
            verify_bank(path)
        except BankError as error:
            return str(error)
        finally:
            os.pwrite(file.fileno(), bytes([byte]), offset)
    return "accepted"


def test_verify_accepts_what_was_written(bank_path):
    seen = []
    report = verify_bank(bank_path, lambda done, of: seen.append((done, of)))
    assert report == {"path": str(bank_path), "bytes": bank_path.stat().st_size, "cells": 3, "good": True}
    assert seen == sorted(seen)
    assert seen[-1] == (report["bytes"], report["bytes"])


def test_verify_refuses_a_flip_of_every_bit_that_carries_something(bank_path):
    with Bank.open(bank_path) as bank:
        rows = [
            (section.offset + number * section.stride, section.row_bytes, 11 if section.name in {"points", "composed"} else 1)
            for section in bank.sections.values()
            for number in range(section.rows)
        ]
    for start, size, step in rows:  # test_file_format.py flips every bit of the header
        assert all(refusal(bank_path, bit) != "accepted" for bit in range(8 * start, 8 * (start + size), step))


def test_verify_refuses_flips_all_over_the_padding(bank_path):
    for offset in range(0, bank_path.stat().st_size, 13):  # coprime to the bits of a byte and to every stride
        assert refusal(bank_path, 8 * offset + offset % 8) != "accepted"


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow], deadline=None)
@given(data=st.data())
def test_verify_refuses_a_flip_of_any_bit(bank_path, data):
    assert refusal(bank_path, data.draw(st.integers(0, 8 * bank_path.stat().st_size - 1))) != "accepted"


def test_verify_names_the_place_of_the_first_damage(bank_path):
    with Bank.open(bank_path) as bank:
        drive, response = bank.sections["drive"], bank.sections["response"]
    in_entry_1 = response.offset + response.stride + 5
    assert f"bytes {response.offset + 448} to {response.offset + 895}: response of entry 1 (cell 2)" in refusal(
        bank_path, 8 * in_entry_1
    )
    gap = drive.offset + drive.stride - 1
    assert f"bytes {drive.offset + 48} to {gap}: padding" in refusal(bank_path, 8 * gap)
    assert "haptic-panel bank build --board simulated" in refusal(bank_path, 8 * gap)
    in_frame = drive.offset + drive.stride + 10
    assert "drive of entry 1 (cell 2): frame 0 is damaged; rebuild it" in refusal(bank_path, 8 * in_frame)


def test_info_tells_what_a_bank_is_without_reading_its_entries(bank_path, board):
    info = bank_info(bank_path)
    assert (info["cells"], info["cells_of_grid"], info["samples"], info["board"]) == (3, 6, 9, "simulated")
    assert info["board_digest"] == board.digest().hex()
    assert info["grid"] == {"pitch_mm": 5.0, "nx": 3, "ny": 2, "x0_mm": 5.0, "y0_mm": 6.0}
    assert info["format"] == 9
    assert info["compositions"] == 1
    assert info["bytes"] == bank_path.stat().st_size


def with_pitch(board, pitch_mm):
    return msgspec.structs.replace(board, bank=msgspec.structs.replace(board.bank, pitch_mm=pitch_mm))


def test_a_bank_serves_only_its_board_pitch_and_cells(tmp_path, make_bank, board):
    path, board = tmp_path / "bank", with_pitch(board, 40.0)
    grid = Grid.of(board.plate, 40e-3)
    some = np.arange(grid.cells) % 3 == 0

    def reason(board=board, cells=some):
        return fit(path, board, cells).reason

    assert reason() == "there is none yet"
    make_bank(path, grid, some)
    assert reason() == ""
    assert reason(cells=some & (np.arange(grid.cells) > 0)) == "", "more than needed"
    assert "35" in reason(with_pitch(board, 35.0), np.zeros(Grid.of(board.plate, 35e-3).cells, bool))
    with path.open("r+b") as file:
        file.seek(-1, os.SEEK_END)
        file.write(b"\x01")
    assert "padding" in reason(), "damaged, if only there"
    make_bank(path, grid, some, channel_edges=None)
    assert reason() == "it was built by another version", "before banks said how many edges an emission has"
    make_bank(path, grid, some, digest=bytes(32))
    assert "was built for another board" in reason()


def test_a_bank_that_lacks_cells_is_built_with_those_it_has(tmp_path, make_bank, board):
    path, board = tmp_path / "bank", with_pitch(board, 40.0)
    grid = Grid.of(board.plate, 40e-3)
    number = np.arange(grid.cells)
    make_bank(path, grid, number % 3 == 0)
    found = fit(path, board, number % 2 == 0)
    assert found.reason == f"it lacks {((number % 2 == 0) & (number % 3 != 0)).sum()} cells"
    assert (found.cells == ((number % 2 == 0) | (number % 3 == 0))).all()
    found = fit(path, with_pitch(board, 35.0), some := np.zeros(Grid.of(board.plate, 35e-3).cells, bool))
    assert (found.cells == some).all(), "of another grid nothing is kept"
