import hashlib
import json
import subprocess
import sys
from dataclasses import replace

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.bank.inspection import bank_info, verify_bank
from controller.device.bank.packing import channel_bits, drive_words
from controller.device.bank.provenance import MODEL_VERSION
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.errors import BankError, ConfigError
from controller.workshop.bank_builder.bank_fit import fit
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.interpolation_error import InterpolationError
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.responses.impulse_response import ResponseModel

PITCH_M = 35e-3  # 5 x 3 cells


@pytest.fixture(scope="module")
def board():
    return load_board(find_board("simulated"))


@pytest.fixture(scope="module")
def built(board, tmp_path_factory):
    path = tmp_path_factory.mktemp("banks") / "new folder" / "bank"
    return build_bank(BankRequest(board, path, PITCH_M)), path


def test_the_report_and_the_bank_say_what_was_built(built, board):
    report, path = built
    grid = Grid.of(board.plate, PITCH_M)
    info = bank_info(path)
    assert report.cells == grid.cells == info["cells"] == 15
    assert report.bytes == path.stat().st_size == verify_bank(path)["bytes"]
    assert report.modes == 1900  # all below 100 kHz
    assert info["board_digest"] == board.digest().hex()
    assert info["parameters"]["highest_hz"] == 100e3
    of_that_pitch = msgspec.structs.replace(board, bank=msgspec.structs.replace(board.bank, pitch_mm=PITCH_M * 1e3))
    assert fit(path, of_that_pitch, np.ones(grid.cells, bool)).reason == ""


def test_float32_differs_from_float64_in_at_most_a_bit_of_a_thousand_and_nothing_in_amplitude(built, board):
    _, path = built
    cells = [0, 6, 11]
    with Bank.open(path, board) as bank:
        exact = ResponseModel(board).drive_order_responses(bank.grid.points()[cells], dtype=np.float64)
        for cell, response in zip(cells, exact, strict=True):
            bits = channel_bits(np.frombuffer(bank.drive.words(cell), "<u4"))
            expected = channel_bits(drive_words(response, board.idle_word))
            assert np.mean(bits != expected) <= 0.001
            assert np.sum((2.0 * bits - 1) * response) / np.abs(response).sum() >= 0.9999
            levels, scale_m_per_v = bank.responses.response(cell)
            assert np.abs(levels * np.float64(scale_m_per_v) - response).max() <= 0.51 * scale_m_per_v
            assert 90 < np.abs(levels).max() <= 127  # what lies outside the band may be larger
            wrong = bits ^ (np.arange(bits.size).reshape(bits.shape) % 150 == 0)  # under 1 % of the bits
            assert np.mean(wrong != expected) > 0.001
            assert np.sum((2.0 * wrong - 1) * response) / np.abs(response).sum() < 0.9999


def test_a_channel_that_can_gain_nothing_stays_at_its_idle_level(board, tmp_path, monkeypatch):
    def only_channel_0(model, points_m, out):
        out[:] = 0
        out[:, :, 0] = 1e-9
        return out

    monkeypatch.setattr(ResponseModel, "entry_responses", only_channel_0)
    build_bank(BankRequest(board, tmp_path / "idle", PITCH_M))
    with Bank.open(tmp_path / "idle", board) as bank:
        assert set(np.frombuffer(bank.drive.words(3), "<u4").tolist()) == {board.idle_word | 1}


def test_a_cell_has_the_same_entry_whichever_others_are_built(built, board, tmp_path):
    _, path = built
    some = np.isin(np.arange(15), [3, 11])
    report = build_bank(BankRequest(board, tmp_path / "some", PITCH_M, some, scene="two spots"))
    assert report.cells == 2
    with Bank.open(path) as every, Bank.open(tmp_path / "some", board) as few:
        assert few.cells.tolist() == some.tolist()
        assert few.header.parameters["scene"] == "two spots"
        for cell in (3, 11):
            a, b = (channel_bits(np.frombuffer(bank.drive.words(cell), "<u4")) for bank in (every, few))
            assert np.mean(a != b) <= 0.001  # float32 sums in another order


def test_refuses_a_pitch_or_a_scene_that_leaves_no_cell(board, tmp_path):
    with pytest.raises(ConfigError, match="pitch_mm = 80"):
        build_bank(BankRequest(board, tmp_path / "bank", 80e-3))
    with pytest.raises(ConfigError, match=r"corner\.toml: no region reaches a cell"):
        build_bank(BankRequest(board, tmp_path / "bank", PITCH_M, np.zeros(15, bool), scene="corner.toml"))
    with pytest.raises(ValueError, match="cells are"):
        build_bank(BankRequest(board, tmp_path / "bank", PITCH_M, np.ones(14, bool)))
    assert not list(tmp_path.iterdir())


def test_a_bank_of_another_version_of_the_model_is_built_again(built, board, monkeypatch):
    of_that_pitch = msgspec.structs.replace(board, bank=msgspec.structs.replace(board.bank, pitch_mm=PITCH_M * 1e3))
    monkeypatch.setattr("controller.workshop.bank_builder.bank_fit.MODEL_VERSION", MODEL_VERSION + 1)
    assert fit(built[1], of_that_pitch, np.ones(15, bool)).reason == "it was built by another version of the model"


def test_refuses_a_folder_that_cannot_be(board, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(BankError, match=r"file: cannot be made \(Not a directory|file: cannot be made \(File exists"):
        build_bank(BankRequest(board, tmp_path / "file" / "bank", PITCH_M))


BUILD = """
import dataclasses, json, sys
from pathlib import Path
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
print(json.dumps(dataclasses.asdict(build_bank(BankRequest(load_board(find_board("simulated")), Path(sys.argv[1]), 5e-3)))))
"""


@pytest.mark.slow
def test_the_whole_plate_at_5_mm_is_built_in_600_mb(tmp_path):
    done = subprocess.run([sys.executable, "-c", BUILD, tmp_path / "bank"], capture_output=True, check=True)
    assert done.stderr == b""  # no progress bar unless asked for
    report = json.loads(done.stdout)
    assert report["cells"] == 1148
    assert 30 < report["peak_memory_mb"] <= 600


def test_the_header_has_a_hash_of_what_a_bank_was_built_from_and_of_what_it_holds(board, built, tmp_path):
    reported = bank_info(built[1])["parameters"]
    content = hashlib.sha256()
    with Bank.open(built[1], board) as bank:
        for cell in np.flatnonzero(bank.cells).tolist():
            levels, scale_m_per_v = bank.responses.response(cell)
            content.update(bytes(bank.drive.words(cell)))
            start = bank.sections["response"].offset + cell * bank.sections["response"].stride
            content.update(bank.file.read(start, bank.sections["response"].row_bytes))
            assert np.frombuffer(bank.file.read(start, levels.nbytes), np.int8).tobytes() == levels.tobytes()
            content.update(np.float32(scale_m_per_v).tobytes())
    assert reported["content_sha256"] == content.hexdigest()
    again = tmp_path / "again"
    build_bank(BankRequest(board, again, PITCH_M))
    assert again.read_bytes() == built[1].read_bytes()
    build_bank(BankRequest(board, again, PITCH_M, np.arange(15) == 3))
    other = bank_info(again)["parameters"]
    assert other["inputs_sha256"] != reported["inputs_sha256"]
    assert other["content_sha256"] != reported["content_sha256"]


def test_a_waveform_that_switches_more_often_than_the_board_allows_is_refused(board, tmp_path):
    report = build_bank(BankRequest(board, tmp_path / "bank", 20e-3))
    assert 70e3 < report.worst_edge_rate_hz < 110e3, "twice the mean frequency of what passes the driver, 40 kHz or so"
    limits = msgspec.structs.replace(board.limits, max_edge_rate_hz=report.worst_edge_rate_hz * 0.99)
    before = (tmp_path / "bank").read_bytes()
    with pytest.raises(ConfigError, match="max_edge_rate_hz"):
        build_bank(BankRequest(msgspec.structs.replace(board, limits=limits), tmp_path / "bank", 20e-3))
    assert (tmp_path / "bank").read_bytes() == before


def test_a_bank_says_the_worst_edges_of_its_entries_with_those_of_the_idle_word(board, built):
    with Bank.open(built[1], board) as bank:
        counts = []
        for cell in np.flatnonzero(bank.cells).tolist():
            levels = np.concatenate([[board.idle_word], np.frombuffer(bank.drive.words(cell), "<u4"), [board.idle_word]]).astype(
                "<u4"
            )
            bits = np.unpackbits(levels.view(np.uint8).reshape(-1, 4), axis=1, bitorder="little")
            counts.append(np.abs(np.diff(bits.astype(int), axis=0)).sum(axis=0))
        assert bank.worst_edges == (max(count.max() for count in counts), max(count.sum() for count in counts))
        channel, together = bank.worst_edges
        rate_hz = 1 / board.waveform.duration_s
        assert channel * rate_hz < board.limits.max_channel_edge_rate_hz, "the paper's endless 500 Hz is within the board's limits"
        assert together * rate_hz < board.limits.max_total_edge_rate_hz


@each_row("reported", [{}, {"channel_edges": "9", "all_edges": None}, {"channel_edges": True, "all_edges": -1}])
def test_a_bank_that_does_not_say_its_edges_may_have_as_many_as_samples_allow(board, built, reported):
    with Bank.open(built[1], board) as bank:
        bank.header = replace(bank.header, parameters=reported)
        assert bank.worst_edges == (1001, 32 * 1001)


def test_responses_are_computed_in_blocks_of_whole_rows(board, tmp_path, monkeypatch):
    """A row in two blocks would be summed over the modes twice."""
    blocks = []
    responses = ResponseModel.entry_responses

    def noted(model, points_m, out):
        blocks.append(points_m)
        return responses(model, points_m, out)

    monkeypatch.setattr(ResponseModel, "entry_responses", noted)
    monkeypatch.setattr("controller.workshop.bank_builder.plan.CELLS_PER_BLOCK", 12)
    nothing = InterpolationError(np.zeros(0), np.zeros(0), np.zeros(0))
    monkeypatch.setattr("controller.workshop.bank_builder.build.interpolation_error", lambda *_: nothing)
    grid = Grid.of(board.plate, PITCH_M)
    wanted = np.arange(15) % 7 != 3
    for cells in (np.ones(15, bool), wanted, np.arange(15) == 14):
        blocks.clear()
        build_bank(BankRequest(board, tmp_path / "blocks", PITCH_M, cells))
        assert np.array_equal(np.concatenate(blocks), grid.points()[cells])
        rows = [set(block[:, 1].tolist()) for block in blocks]
        assert all(len(row) <= 2 for row in rows)
        assert sum(map(len, rows)) == len(set().union(*rows)), "no row is in two blocks"
