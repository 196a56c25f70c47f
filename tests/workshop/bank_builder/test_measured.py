"""Banks of responses that are no model's: measured arrays, checked, built, and reported by header, `bank info` and `doctor`."""

import json
import shutil
from dataclasses import dataclass, replace

import msgspec
import numpy as np
import pytest
from small_plate import WHOLE, small_board
from tables import each_row

from controller.cli import main
from controller.device.bank.grid import Grid
from controller.device.bank.inspection import bank_info, measured_at, verify_bank, wrong_pitch
from controller.device.bank.packing import channel_bits, drive_words
from controller.device.bank.provenance import Provenance, SourceFile, provenance_of
from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.paths import bank_path
from controller.device.scene.scene import FixedEmitter, load_scene
from controller.device.scene.scene_file import find_scene
from controller.errors import ConfigError
from controller.workshop.bank_builder.bank_fit import fit
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.choice import choose, settings
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.responses.impulse_response import ResponseModel

BOARD = small_board()
PITCH_M, CELL = 10e-3, 14  # of 6 x 4 cells, that at (30, 30) mm
UNDRIVEN = next(channel for channel in range(32) if channel not in {a.channel for a in BOARD.actuators})
REPORTED = Provenance(
    kind="completed",
    model="J0 kriging",
    files=(SourceFile("plate.npz", "ab" * 32),),
    date="2026-11-20",
    temperature_c=23.5,
    points=250,
    kept=(0.991, 0.962),
)


@dataclass
class Measured:
    """Responses of a plate 2 % stiffer than the board's, as arrays at any points."""

    board: object = BOARD
    provenance: Provenance = REPORTED
    bit_clock_hz: float = BOARD.waveform.bit_clock_hz
    samples: int = BOARD.waveform.samples
    plate_m: tuple[float, float] = (BOARD.plate.length_m, BOARD.plate.width_m)
    spoil: object = None
    highest_hz: float = 70e3

    def __post_init__(self):
        plate = self.board.plate
        stiffer = msgspec.structs.replace(plate, young_modulus_pa=1.02 * plate.young_modulus_pa)
        self.plate = ResponseModel(msgspec.structs.replace(self.board, plate=stiffer), self.highest_hz)

    def _reported(self, found):
        if self.spoil:
            self.spoil(found)
        return found

    def responses(self, points_m, band_limited=False, dtype=np.float64, out=None):
        return self._reported(self.plate.responses(points_m, band_limited=band_limited, dtype=dtype, out=out))

    def drive_order_responses(self, points_m, out=None, dtype=np.float32):
        return self._reported(self.plate.drive_order_responses(points_m, out, dtype))

    def entry_responses(self, points_m, out=None, dtype=np.float32):
        return self._reported(self.plate.entry_responses(points_m, out, dtype))


def build(path, source, **others):
    return build_bank(BankRequest(BOARD, path, PITCH_M, source=source, **others))


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    path = tmp_path_factory.mktemp("banks") / "measured.bank"
    emitters = [FixedEmitter(0.02, 0.02, 10.0, "a"), FixedEmitter(0.05, 0.03, 10.0, "b")]
    return path, build(path, Measured(), emitters=emitters)


def test_a_bank_holds_what_was_measured_and_tells_it(built):
    path, report = built
    source = Measured()
    assert verify_bank(path)["good"]
    with Bank.open(path, BOARD) as bank:
        assert bank.header.provenance == REPORTED
        assert bank.header.compositions == 1
        words = bytes(bank.drive.words(CELL))
        response = source.drive_order_responses(bank.grid.points()[CELL : CELL + 1])[0]
        assert np.array_equal(np.frombuffer(words, "<u4"), drive_words(response, BOARD.idle_word))
    modelled = ResponseModel(BOARD).drive_order_responses([(0.03, 0.03)])[0]
    assert np.mean(channel_bits(np.frombuffer(words, "<u4")) != channel_bits(drive_words(modelled, BOARD.idle_word))) > 0.02
    assert (report.modes, report.cells) == (None, 24)
    assert report.responses == REPORTED.in_words() == bank_info(path)["responses"]
    assert report.interpolation_error["places"] == 48
    assert bank_info(path)["parameters"]["responses"] == json.loads(msgspec.json.encode(REPORTED))


def test_bank_info_says_files_date_temperature_and_what_is_expected(built, capsys):
    path, _ = built
    assert main(["bank", "info", str(path)]) == 0
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("responses")]
    for reported in ("completed: 250 points", "plate.npz", "2026-11-20", "23.5 °C", "J0 kriging", "keeps 0.991", "0.962 at least"):
        assert reported in line
    main(["bank", "info", str(path), "--json"])
    assert json.loads(capsys.readouterr().out)["parameters"]["responses"]["files"] == [{"name": "plate.npz", "sha256": "ab" * 32}]


def test_the_hash_of_the_inputs_depends_on_the_measured_files(built, tmp_path):
    path, _ = built
    others = (
        REPORTED,
        msgspec.structs.replace(REPORTED, files=(SourceFile("plate.npz", "ac" * 32),)),
        msgspec.structs.replace(REPORTED, model="cosines"),
    )
    hashes = [bank_info(path)["parameters"]["inputs_sha256"]]
    cells = np.arange(24) == CELL
    for number, reported in enumerate(others):
        build(tmp_path / str(number), replace(Measured(), provenance=reported), cells=cells)
        hashes.append(bank_info(tmp_path / str(number))["parameters"]["inputs_sha256"])
    assert len(set(hashes)) == 4
    build(tmp_path / "again", Measured(), cells=cells)
    assert bank_info(tmp_path / "again")["parameters"]["inputs_sha256"] == hashes[1]


@each_row(
    ("changes", "said"),
    [
        ({"bit_clock_hz": 501e3}, "for a bit clock of 501000 Hz, the board has 500000 Hz"),
        ({"samples": 500}, "for an emission of 500 samples, the board has 400 samples"),
        ({"plate_m": (0.07, 0.06)}, "for a plate whose width is 0.06 m, the board has 0.05 m"),
    ],
)
def test_responses_of_another_board_are_refused(tmp_path, changes, said):
    with pytest.raises(ConfigError, match=said):
        build(tmp_path / "bank", replace(Measured(), **changes))
    assert not (tmp_path / "bank").exists()


def put(index, value):
    def spoil(found):
        found[index] = value

    return spoil


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (put((0, 3, 5), np.nan), r"that of \(10, 10\) mm has values that are not finite"),
        (put((..., UNDRIVEN), 1e-9), f"channel {UNDRIVEN} moves the plate, but has no actuator on this board"),
        (put((...,), 0.0), "no channel moves any of the 24 cells"),
    ],
)
def test_responses_that_cannot_be_are_refused_and_an_old_bank_stays(built, tmp_path, spoil, said):
    old = built[0].read_bytes()
    path = tmp_path / "bank"
    path.write_bytes(old)
    with pytest.raises(ConfigError, match=said):
        build(path, replace(Measured(), spoil=spoil))
    assert path.read_bytes() == old


def test_entries_of_measured_responses_are_not_optimised(tmp_path):
    with pytest.raises(ConfigError, match="responses that are completed cannot be optimised: that takes the field"):
        build(tmp_path / "bank", Measured(), aim=AIMS["quiet"])


def test_a_measured_bank_fits_whichever_version_of_the_model_is_installed(built, monkeypatch):
    board = msgspec.structs.replace(BOARD, bank=msgspec.structs.replace(BOARD.bank, pitch_mm=10.0))
    monkeypatch.setattr("controller.workshop.bank_builder.bank_fit.MODEL_VERSION", 0)
    assert fit(built[0], board, np.ones(24, bool)).reason == ""


def test_run_does_not_replace_a_measured_bank_and_a_build_says_that_it_does(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    folder = tmp_path / "panel"
    folder.mkdir()
    text = (find_board("simulated") / "board.toml").read_text()
    (folder / "board.toml").write_text(text.replace("pitch_mm = 2.5", "pitch_mm = 40\ncoarse = true"))
    for name in ("scene.toml", "demo.evemu"):
        shutil.copy(find_board("simulated") / name, folder)
    board = load_board(folder)
    source = ResponseModel(board, 30e3)
    source.provenance = REPORTED
    one = np.arange(Grid.of(board.plate, 40e-3).cells) == 0
    build_bank(BankRequest(board, bank_path(board), cells=one, source=source))
    measured = bank_path(board).read_bytes()
    assert main(["run", "--board", str(folder)]) == 78
    reported = capsys.readouterr().err
    assert "its responses were measured, so it is not replaced" in reported
    assert "haptic-panel calibrate bank FOLDER" in reported
    assert bank_path(board).read_bytes() == measured
    assert main(["bank", "build", "--board", str(folder), "--optimise", "quiet", "--workers", "0"]) == 2
    assert "by what was measured: haptic-panel calibrate bank FOLDER --optimise quiet\n" in capsys.readouterr().err
    assert main(["bank", "build", "--board", str(folder)]) == 0
    assert "its responses were measured, and become modelled" in capsys.readouterr().err
    assert not measured_at(bank_path(board))


def test_a_choice_is_made_by_the_measured_responses():
    """What cells lose is known from the plate itself: a plate that does not move between cells has no error to choose by."""
    scene = load_scene(find_scene(WHOLE, "keyboard"), WHOLE)

    def still(found):
        found[:] = 0

    source = Measured(
        WHOLE, samples=WHOLE.waveform.samples, plate_m=(WHOLE.plate.length_m, WHOLE.plate.width_m), spoil=still, highest_hz=5e3
    )
    assert {setting.error for setting in settings(WHOLE, scene, 5e-3, source)} == {0.0}


def test_thousands_of_files_are_reported_as_one_and_still_count(tmp_path):
    """One record a point: 20,000 of them would be twice what a header may have."""
    records = tuple(SourceFile(f"records/{number}.npy", f"{number:064x}") for number in range(20_000))
    reported = msgspec.structs.replace(REPORTED, files=(SourceFile("measurement.toml", "ab" * 32), *records))
    cells = np.arange(24) == CELL
    build(tmp_path / "one", replace(Measured(), provenance=reported), cells=cells)
    with Bank.open(tmp_path / "one") as bank:
        files = bank.header.provenance.files
    assert [file.name for file in files] == ["measurement.toml", "records/*.npy (20000 files)"]
    assert "measurement.toml, records/*.npy (20000 files); 2026-11-20" in bank_info(tmp_path / "one")["responses"]
    other = msgspec.structs.replace(reported, files=(*reported.files[:-1], SourceFile("records/19999.npy", "cd" * 32)))
    build(tmp_path / "other", replace(Measured(), provenance=other), cells=cells)
    one, other = (bank_info(tmp_path / name)["parameters"]["inputs_sha256"] for name in ("one", "other"))
    assert one != other


def test_where_responses_come_from_is_read_from_older_banks_too():
    assert provenance_of("modelled").kind == "modelled"
    for unknown in (None, "guessed", {"kind": "guessed", "model": ""}, {"kind": "measured"}, 3):
        assert provenance_of(unknown) is None


def test_whether_a_bank_was_measured_is_seen_even_if_it_is_damaged(built, tmp_path):
    damaged = tmp_path / "bank"
    whole = bytearray(built[0].read_bytes())
    whole[bank_info(built[0])["sections"]["checksums"]["offset"]] ^= 1
    damaged.write_bytes(whole)
    assert measured_at(damaged)
    assert measured_at(built[0])
    damaged.write_bytes(whole[:4096])
    assert not measured_at(damaged)
    assert not measured_at(tmp_path / "none")
    build_bank(BankRequest(BOARD, tmp_path / "modelled", PITCH_M, np.arange(24) == CELL))
    assert not measured_at(tmp_path / "modelled")
    assert bank_info(tmp_path / "modelled")["responses"].startswith("modelled: Kirchhoff plate, edges simply supported, decay 1 ms")


def test_a_bank_that_is_chosen_by_measured_responses_is_the_one_that_auto_plays(tmp_path):
    board = msgspec.structs.replace(WHOLE, compose=msgspec.structs.replace(WHOLE.compose, method="auto"))
    source = Measured(WHOLE, samples=WHOLE.waveform.samples, plate_m=(WHOLE.plate.length_m, WHOLE.plate.width_m))
    file = find_scene(WHOLE, "keyboard")
    choice = choose(board, load_scene(file, WHOLE), file, 5e-3, source)
    cells = np.arange(Grid.of(board.plate, choice["pitch_mm"] * 1e-3).cells) < 3
    path = tmp_path / "bank"
    build_bank(BankRequest(board, path, choice["pitch_mm"] * 1e-3, cells, choice=choice, source=source))
    with Bank.open(path, board) as bank:
        assert wrong_pitch(bank, board) == ""
        assert bank.header.provenance == REPORTED
