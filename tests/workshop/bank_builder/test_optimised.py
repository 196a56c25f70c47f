import dataclasses
import hashlib
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest
from small_plate import small_board

from controller.cli import main
from controller.device.bank.inspection import bank_info, verify_bank
from controller.device.bank.lookup import FoundBank
from controller.device.bank.reader import Bank
from controller.workshop.bank_builder import optimised, own_bank
from controller.workshop.bank_builder.bank_fit import optimised_for
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.optimised import METHOD_VERSION, Optimise
from controller.workshop.bank_builder.request import BankRequest

PITCH_M = 10e-3
AIM = dataclasses.replace(AIMS["contrast"], steps=3)
BOARD = small_board()
CELLS = 6 * 4
SOME = np.isin(np.arange(CELLS), [7, 8, 14, 15, 16])


def build(path, cells=SOME, **options):
    return build_bank(BankRequest(BOARD, path, PITCH_M, cells, **options))


@pytest.fixture(scope="module")
def banks(tmp_path_factory):
    folder = tmp_path_factory.mktemp("optimised")
    build(folder / "plain")
    return folder / "plain", folder / "optimised", build(folder / "optimised", aim=AIM)


def test_only_the_drive_words_differ_and_the_bank_says_what_for(banks):
    plain, path, report = banks
    assert verify_bank(path)["cells"] == 5
    with Bank.open(plain, BOARD) as before, Bank.open(path, BOARD) as after:
        for cell in np.flatnonzero(SOME).tolist():
            assert bytes(before.drive.words(cell)) != bytes(after.drive.words(cell))
            assert np.array_equal(before.responses.response(cell)[0], after.responses.response(cell)[0])
    reported = bank_info(path)["parameters"]
    assert reported["optimised"] == optimised.reported(BOARD, AIM)
    assert reported["optimised"]["name"] == "contrast"
    assert bank_info(plain)["parameters"]["optimised"] is None
    assert reported["amplitude_of_plain"]["cells"] == 5
    assert 0.8 < reported["amplitude_of_plain"]["least"] <= reported["amplitude_of_plain"]["median"] < 1.3
    (worker,) = (share for name, share in report.workers.items() if name != "kept")
    assert worker["items"] == 5
    assert report.optimised == {"aim": "contrast", "amplitude_of_plain": reported["amplitude_of_plain"]}
    assert reported["inputs_sha256"] != bank_info(plain)["parameters"]["inputs_sha256"]
    assert not list(path.parent.glob(".*"))


def test_who_replaces_an_optimised_bank_by_a_plain_one_is_reported(banks, monkeypatch, capsys):
    path = banks[1]
    assert [optimised_for(file) for file in (*banks[:2], path / "none")] == ["", "contrast", ""]
    board = msgspec.structs.replace(BOARD, bank=msgspec.structs.replace(BOARD.bank, pitch_mm=PITCH_M * 1e3, coarse=True))
    monkeypatch.setattr(own_bank, "find_bank", lambda _board: FoundBank(path, "given"))
    monkeypatch.setattr(own_bank, "bank_path", lambda *_: path)
    monkeypatch.setattr(own_bank, "cells_needed", lambda *_, **__: np.ones(CELLS, bool))
    monkeypatch.setattr(own_bank, "build_bank", lambda *_, **__: SimpleNamespace(interpolation_error={}))
    monkeypatch.setattr(own_bank, "warn_of_pitch", lambda *_: None)
    own_bank.own_bank(board, SimpleNamespace(emitters=()), Path("scene.toml")).close()
    said = capsys.readouterr().err
    assert "lacks 19 cells" in said
    assert said.endswith("--optimise contrast\n")


def test_every_aim_can_be_asked_for(capsys):
    with pytest.raises(SystemExit):
        main(["bank", "build", "--help"])
    assert f"--optimise {{{','.join(AIMS)}}}" in capsys.readouterr().out


def test_an_interrupted_build_leaves_the_old_bank_and_goes_on_where_it_was(banks, tmp_path, monkeypatch):
    path = tmp_path / "bank"
    build(path)
    old = path.read_bytes()
    monkeypatch.setattr(optimised, "CELLS_AT_ONCE", 2)  # tasks of 2, 2 and 1 cells
    computed = []

    def interrupted(optimise, points_m):
        if computed:
            raise KeyboardInterrupt
        computed.extend(points_m)
        return compute(optimise, points_m)

    compute = Optimise.__call__
    monkeypatch.setattr(Optimise, "__call__", interrupted)
    with pytest.raises(KeyboardInterrupt):
        build(path, aim=AIM)
    assert path.read_bytes() == old
    assert len(list(tmp_path.glob(".bank.*.words"))) == 1
    assert not list(tmp_path.glob("*.building"))

    computed.clear()
    monkeypatch.setattr(
        Optimise, "__call__", lambda optimise, points_m: (computed.extend(points_m), compute(optimise, points_m))[1]
    )
    build(path, aim=AIM)
    assert len(computed) == 3
    assert path.read_bytes() == banks[1].read_bytes()
    assert [file.name for file in tmp_path.iterdir()] == ["bank"]


def test_what_is_kept_for_other_inputs_is_not_taken(tmp_path, monkeypatch):
    def interrupt(optimise, points_m):
        raise KeyboardInterrupt

    monkeypatch.setattr(Optimise, "__call__", interrupt)
    for aim in (AIM, dataclasses.replace(AIM, calm=0.5)):
        with pytest.raises(KeyboardInterrupt):
            build(tmp_path / "bank", aim=aim)
    assert len(list(tmp_path.glob(".bank.*.words"))) == 2


def test_the_words_of_a_cell_are_those_of_this_version_of_the_method():
    (words,) = Optimise(BOARD, 100e3, AIM)([(0.03, 0.03)])
    recorded = {2: "23e90d6d03625e31"}
    assert hashlib.sha256(words).hexdigest()[:16] == recorded[METHOD_VERSION]
