"""Entries optimised by the interpolated field of a measured plate, evaluated by the modes of that plate, not the board's."""

import dataclasses
import json

import msgspec
import numpy as np
import pytest
from small_plate import WHOLE, small_board
from tables import each_row
from threadpoolctl import threadpool_limits
from workshop.calibration.true_plate import TruePlate, random_places

from controller.cli import main
from controller.device.bank.inspection import bank_info, verify_bank
from controller.device.bank.packing import channel_bits, drive_words
from controller.device.bank.reader import Bank
from controller.errors import CalibrationError, ConfigError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.methods.audible_form import AudibleForm
from controller.workshop.bank_builder.methods.descent import Descent
from controller.workshop.bank_builder.methods.field_form import FieldForm
from controller.workshop.bank_builder.optimised import Optimise, contrast_of_plain
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.benchmark.focus.focus_figures import emit
from controller.workshop.calibration.banks.plate_bank import PlateBank, build, fit
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.interpolation.whole_field import whole_field
from controller.workshop.calibration.point_plan import grid_points, scattered_points
from controller.workshop.calibration.recording.simulated_measurement import Flaws, RecordingSettings, simulate_measurement
from controller.workshop.physics.felt import felt_amplitudes_um
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.sound import PlateSound, decibels

BOARD = small_board()
PLATE = {"edges": "free", "theory": "mindlin"}
NOISE = 10**-1.5  # 30 dB
CHIRP_HZ = 12e3  # from which `calibrate measure` excites the simulated board's plate
AIM = dataclasses.replace(AIMS["contrast"], steps=8)


@pytest.fixture(scope="module", autouse=True)
def _one_thread():
    """As commands compute."""
    with threadpool_limits(1, "blas"):
        yield


class Trial:
    """A plate that was measured, and what drive words do on it."""

    def __init__(self, board, points_m, noise=NOISE, excited_from_hz=0.0):
        self.board, self.true = board, TruePlate(board, 3 * board.waveform.duration_ms, **stiffer(board))
        learned = self.true.learned(points_m, noise)
        low = np.fft.rfftfreq(learned.responses.shape[1], 1 / learned.bit_clock_hz) < excited_from_hz
        for response, rms in zip(learned.responses, learned.noise, strict=True):  # below, there is nothing but noise
            spectrum = np.fft.rfft(response, axis=0)
            spectrum[low] = np.fft.rfft(np.random.default_rng(9).standard_normal(response.shape), axis=0)[low] * rms
            response[:] = np.fft.irfft(spectrum, len(response), axis=0)
        self.source, _ = interpolate(board, learned, exact=True)
        self.plate = whole_field(board, self.source)
        self.there = msgspec.structs.replace(board, plate=msgspec.structs.replace(board.plate, **stiffer(board)))
        self.modes = self.true.model.plate_modes
        self.twin = PlateTwin(self.there, modes=self.modes)

    def plain(self, places_m):
        return plain_words(self.board, self.source, places_m)

    def contrast(self, words, place_m):
        return emit(self.twin, words).focus_metrics(*place_m.tolist()).contrast


def stiffer(board):
    return PLATE | {"young_modulus_pa": 1.01 * board.plate.young_modulus_pa}


def plain_words(board, source, places_m):
    return np.stack([drive_words(h, board.idle_word) for h in source.drive_order_responses(places_m, dtype=np.float64)])


def levels_of(waveforms):
    return np.stack([channel_bits(words) for words in waveforms], axis=1).astype(float)


@pytest.fixture(scope="module")
def trial():
    return Trial(BOARD, scattered_points(BOARD, 90, 0.0))


def test_the_interpolated_field_and_its_sound_are_those_of_the_plate(trial):
    """Of plain words at two places, and at a random place of random ones: what the true modes say, but for a unit."""
    places_m = random_places(BOARD, 3, 8e-3)
    random = np.random.default_rng(2).integers(0, 1 << 32, BOARD.waveform.samples).astype(np.uint32)
    levels = levels_of([*trial.plain(places_m[:2]), random])
    idle = channel_bits(np.array([BOARD.idle_word], np.uint32))[0]
    found = []
    for plate in (trial.plate, trial.true.model):
        form = FieldForm(BOARD, plate)
        modal = form.modal(levels)
        energy = AudibleForm(BOARD, plate, 20).energy(levels - idle)
        surroundings = [form.surroundings(place_m) for place_m in places_m]
        squares = form.mean_square(modal, surroundings)
        wanted = np.rint(np.random.default_rng(3).standard_normal(modal.shape) * 100)
        brought_back = np.sum(form.gradient(wanted) * (levels - idle), axis=(0, 2))
        assert brought_back == pytest.approx(np.sum(wanted * modal, axis=1), rel=1e-4, abs=1e-4 * np.abs(wanted * modal).sum())
        moves = form.moves(37)
        assert np.array_equal(moves, np.rint(moves))
        found.append([np.sum(form.shapes(places_m) * modal, axis=1) / np.sqrt(squares), squares / squares[0], energy / energy[0]])
    measured, true = np.array(found)
    print(np.round(measured, 3), np.round(true, 3), sep="\n")
    unforeseen = 1 / np.sqrt(1 - trial.plate.unforeseen)
    assert measured[0, :2] / true[0, :2] / unforeseen == pytest.approx(1.06, abs=0.03)  # contrast; above the band nothing is known
    assert measured[1] == pytest.approx(true[1], rel=0.03)
    assert measured[2] == pytest.approx(true[2], rel=0.03)


def test_contrast_is_gained_on_the_plate_that_was_measured_as_far_as_the_bank_states(trial, tmp_path):
    trial.plate.write(tmp_path / "plate")
    places_m = random_places(BOARD, 3, 8e-3)
    plain = trial.plain(places_m)
    optimise = Optimise(BOARD, 0.0, AIMS["contrast"], tmp_path / "plate")
    cells = [(*place_m.tolist(), words.tobytes()) for place_m, words in zip(places_m, plain, strict=True)]
    words = np.stack([np.frombuffer(one, np.uint32) for one in optimise(cells)])
    assert optimise(cells[1:2]) == [words[1].tobytes()]
    old, new = (np.array([trial.contrast(*one) for one in zip(some, places_m, strict=True)]) for some in (plain, words))
    said = contrast_of_plain(optimise.method.field, trial.plate, places_m, plain, words)
    print(new / old, said)
    assert (new > 1.6 * old).all()
    assert 1.6 < said["with_error"] < said["by_responses"]
    assert said["with_error"] < 1.05 * np.median(new / old)


def test_a_bank_of_it_differs_in_its_drive_words_alone_and_goes_on_where_it_was(trial, tmp_path, monkeypatch):
    cells = np.isin(np.arange(6 * 4), [8, 14, 15])
    request = BankRequest(BOARD, tmp_path / "bank", 10e-3, cells, source=trial.source, aim=AIM, plate=trial.plate)
    plain = dataclasses.replace(request, path=tmp_path / "plain", aim=None, plate=None)
    build_bank(plain)
    compute, computed = Optimise.__call__, []

    def interrupted(optimise, some):
        if computed:
            raise KeyboardInterrupt
        computed.extend(some)
        return compute(optimise, some)

    monkeypatch.setattr(Optimise, "__call__", interrupted)
    with pytest.raises(KeyboardInterrupt):
        build_bank(request)
    assert sorted(file.suffix for file in tmp_path.glob(".bank.*")) == [".plate", ".words"]
    monkeypatch.setattr(Optimise, "__call__", lambda optimise, some: (computed.extend(some), compute(optimise, some))[1])
    report = build_bank(request)
    assert len(computed) == 3
    assert not list(tmp_path.glob(".*"))
    build_bank(dataclasses.replace(request, path=tmp_path / "at-once"))
    assert (tmp_path / "at-once").read_bytes() == (tmp_path / "bank").read_bytes()
    with Bank.open(tmp_path / "plain", BOARD) as before, Bank.open(tmp_path / "bank", BOARD) as after:
        for cell in np.flatnonzero(cells).tolist():
            assert bytes(before.drive.words(cell)) != bytes(after.drive.words(cell))
            assert np.array_equal(before.responses.response(cell)[0], after.responses.response(cell)[0])
    assert verify_bank(tmp_path / "bank")["cells"] == 3
    reported = bank_info(tmp_path / "bank")["parameters"]
    assert reported["optimised"]["unforeseen"] == trial.plate.unforeseen
    assert reported["contrast_of_plain"] == report.optimised["contrast_of_plain"]
    assert reported["contrast_of_plain"]["with_error"] > 1.3
    assert 0.9 < reported["amplitude_of_plain"]["median"] < 1.15
    assert "contrast_of_plain" not in bank_info(tmp_path / "plain")["parameters"]


def test_points_of_a_part_of_the_plate_do_not_foresee_its_field():
    points_m = scattered_points(BOARD, 120, 0.0)
    source, _ = interpolate(BOARD, TruePlate(BOARD, 1.6).learned(points_m[points_m[:, 0] < 0.035]), exact=True)
    with pytest.raises(CalibrationError, match=r"0\.\d\d of the field's energy is not foreseen by the 59 points, above 0\.15"):
        whole_field(BOARD, source)


@pytest.mark.slow
def test_a_grid_of_cells_foresees_the_field_of_all_of_them():
    assert Trial(BOARD, grid_points(BOARD), 0.01).plate.unforeseen < 0.01


@each_row(
    ("options", "code", "said"),
    [
        (["bank", "{}", "--workers", "2"], 78, "measurement.toml"),
        (["bank", "{}", "--optimise", "quiet", "--workers", "0"], 2, "--workers 0: not from 1 to 256"),
        (["bank", "{}", "--optimise", "quiet", "--compact"], 78, "a compact bank holds no waveforms"),
        (["fleet", "{}", "--out", "{}/banks", "--optimise", "quiet", "--compact"], 78, "a compact bank holds no waveforms"),
    ],
)
def test_what_cannot_be_optimised_is_said_in_one_line(tmp_path, capsys, options, code, said):
    assert main(["calibrate", *(option.format(tmp_path) for option in options)]) == code
    assert said in capsys.readouterr().err


def test_measured_responses_are_not_optimised_to_be_felt(trial, tmp_path):
    request = BankRequest(BOARD, tmp_path / "bank", 10e-3, source=trial.source, aim=AIMS["felt"], plate=trial.plate)
    with pytest.raises(ConfigError, match="a model of the plate under a finger"):
        build_bank(request)


@pytest.mark.slow
def test_through_the_files_of_a_measurement_contrast_is_gained_on_the_plate(tmp_path):
    """With all that a calibration corrects: 90 points, 30 dB, free edges, Mindlin's theory, 1 % stiffer; 12 cells of each bank."""
    there = msgspec.structs.replace(BOARD, plate=msgspec.structs.replace(BOARD.plate, **stiffer(BOARD)))
    names, points_m = tuple(map(str, range(90))), scattered_points(BOARD, 90, 0.0)
    recording, flaws = RecordingSettings(record_s=5e-3, repetitions=1, seed=1), Flaws(snr_db=30)
    simulate_measurement(tmp_path / "measured", BOARD, there, names, points_m, recording, flaws, lambda *_: None)
    contrasts, twin = [], PlateTwin(there)
    for name, aim in (("plain", None), ("optimised", AIMS["contrast"])):
        wanted = PlateBank(BOARD, tmp_path / "measured", tmp_path / name, pitch_mm=4.0, aim=aim)
        built = build(wanted, fit(wanted), progress=False)
        with Bank.open(tmp_path / name, BOARD) as bank:
            grid = bank.header.grid
            inside = [cell for cell in np.flatnonzero(bank.cells).tolist() if abs(grid.place(cell)[1] - 0.025) < 15e-3][::8]
            words = [np.frombuffer(bank.drive.words(cell), "<u4").astype(np.uint32) for cell in inside]
            found = [emit(twin, one).focus_metrics(*grid.place(cell)) for one, cell in zip(words, inside, strict=True)]
        contrasts.append(np.array([one.contrast for one in found]))
    said = built.report.optimised["contrast_of_plain"]
    share = built.report.optimised["amplitude_of_plain"]["median"]
    assert f"optimised entries have {share:g} of the amplitude of plain ones" in "\n".join(built.notes)
    print(f"{len(inside)} cells: {contrasts[0].mean():.1f}, optimised {contrasts[1].mean():.1f}; stated {said}")
    gained = np.median(contrasts[1] / contrasts[0])
    assert gained > 1.4
    assert 0.85 * gained < said["with_error"] < 1.05 * gained


@pytest.mark.slow
@each_row("from_hz", [0.0, CHIRP_HZ])
def test_figures_on_the_whole_plate(from_hz):
    """Median over places: on the true plate, over plain entries of the same responses; and by the true modes themselves."""
    trial = Trial(WHOLE, scattered_points(WHOLE, 250, 0.0), excited_from_hz=from_hz)
    places_m = random_places(WHOLE, 12, 12e-3)
    sound = PlateSound(trial.there, trial.modes)

    def figures(words):
        found = [emit(trial.twin, one).focus_metrics(*place_m.tolist()) for one, place_m in zip(words, places_m, strict=True)]
        felt = [felt_amplitudes_um(trial.there, trial.modes, one, [at])[0] for one, at in zip(words, places_m, strict=True)]
        loud = [decibels(sound.exposure_pa2_s(one, WHOLE.idle_word)) for one in words]
        return np.array([[one.amplitude_m for one in found], [one.contrast for one in found], felt, loud])

    plain, like, like_true, gained = trial.plain(places_m), None, None, {}
    old = figures(plain)
    print(f"excited from {from_hz:g} Hz: {trial.plate.unforeseen:.3f} of the energy unforeseen, contrast {np.median(old[1]):.1f}")
    for aim in ("contrast", "quiet"):
        like = Descent(WHOLE, trial.plate, AIMS[aim], like)
        like_true = Descent(trial.there, trial.true.model, AIMS[aim], like_true)
        words = like.entries(places_m, plain)
        said = contrast_of_plain(like.field, trial.plate, places_m, plain, words)
        for name, found in (("measured", figures(words)), ("true modes", figures(like_true.entries(places_m)))):
            over = np.median(found[:3] / old[:3], axis=1)
            gained[aim, name] = over[1]
            decibel = np.median(found[3] - old[3])
            print(
                f"{aim}, {name}: amplitude {over[0]:.2f}, contrast {over[1]:.2f}, light touch {over[2]:.2f}, {decibel:+.1f} dB(A)"
            )
        print(json.dumps(said))
        assert said["with_error"] < 1.05 * gained[aim, "measured"]
    assert gained["contrast", "measured"] > 0.65 * gained["contrast", "true modes"]
