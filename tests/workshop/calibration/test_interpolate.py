"""Responses between measured points, against those of a plate whose true ones are known."""

from contextlib import nullcontext
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import j0
from small_plate import small_board
from workshop.calibration.true_plate import TruePlate, random_places

from controller.device.bank.file_format import REST_SAMPLES
from controller.errors import CalibrationError
from controller.workshop.calibration.interpolation import wave_fit
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.interpolation.kriging import bessel
from controller.workshop.calibration.interpolation.spectra import Bins
from controller.workshop.calibration.point_plan import grid_points, scattered_points

BOARD = small_board()
HARDER = {"young_modulus_pa": 1.02 * BOARD.plate.young_modulus_pa, "decay_time_ms": 0.7}


@pytest.fixture(scope="module")
def plate():
    """A plate 2 % stiffer than its board says, whose waves are 0.5 % longer, and recorded for 1.6 ms."""
    return TruePlate(BOARD, 1.6, **HARDER)


@pytest.fixture(scope="module")
def scattered(plate):
    return interpolate(BOARD, plate.learned(scattered_points(BOARD, 110, 2e-3)))


@pytest.fixture(scope="module")
def gridded(plate):
    """Four places of the grid have no record, three lack a channel."""
    learned = plate.learned(grid_points(BOARD), missing=0.02)
    learned.known[:3, 5] = False
    return interpolate(BOARD, learned)


def evaluated(plate, source, label):
    found = [plate.kept(source, random_places(BOARD, 12, *at)) for at in ((12e-3,), (3e-3, 12e-3))]
    print(f"{label}: kept {found[0].mean():.4f} inside, {found[1].mean():.4f} near edges; left out {source.provenance.kept}")
    return [some.mean() for some in found]


def test_a_grid_of_cells_keeps_next_to_all(plate, gridded):
    inside, near_edges = evaluated(plate, gridded[0], "grid")
    assert inside > 0.998
    assert near_edges > 0.99
    assert gridded[0].provenance.kept[0] > 0.99
    assert "cosines between 204 cells" in gridded[0].provenance.model


@pytest.mark.slow
def test_scattered_points_keep_nearly_as_much(plate, scattered):
    inside, near_edges = evaluated(plate, scattered[0], "scattered")
    assert inside > 0.9945
    assert near_edges > 0.985
    assert 0.9 < scattered[0].provenance.kept[0] < inside, "a point left out is farther from the others than a place between them"
    assert scattered[0].provenance.points == 110


def test_wavelengths_are_fitted(scattered, gridded):
    """2 % of stiffness is 0.995 in wavenumber and 1.01 in frequency; 1 % more or less of the frequency would be seen."""
    for source, waves in (scattered, gridded):
        print(f"{source.provenance.model}: {waves}")
        # the model has no shear: its waves are longer than Mindlin's by 0.7 % at 45 kHz besides
        assert waves.dispersion.factor == pytest.approx(1.02**-0.25 * 0.99285, abs=3e-3)
        assert waves.factor_error < 2e-3


def test_responses_are_those_of_the_protocol(plate, scattered):
    points = random_places(BOARD, 3, 10e-3)
    source = scattered[0]
    whole, band = source.responses(points), source.responses(points, band_limited=True)
    entries = source.entry_responses(points)
    assert whole.shape == band.shape == (3, BOARD.waveform.samples, 32)
    np.testing.assert_allclose(entries[:, : source.samples], band[:, ::-1], rtol=1e-5, atol=1e-6 * abs(band).max())
    np.testing.assert_array_equal(source.drive_order_responses(points), band[:, ::-1].astype(np.float32))
    rest = (whole - band)[:, ::-1].reshape(3, -1, REST_SAMPLES, 32).mean(axis=2)
    np.testing.assert_allclose(entries[:, source.samples :], rest, atol=1e-5 * abs(rest).max())
    true = plate.model.entry_responses(points)[:, source.samples :]
    same = np.corrcoef(true.reshape(-1), entries[:, source.samples :].reshape(-1))[0, 1]
    assert same > 0.95, "what is below the band was measured"
    assert not whole[:, :, [q for q in range(32) if q not in {a.channel for a in BOARD.actuators}]].any()


def test_the_table_of_the_bessel_function_is_right():
    places = np.random.default_rng(1).uniform(0, 300, 10_000)
    assert np.abs(bessel(places) - j0(places)).max() < 5e-7


def test_what_cannot_be_interpolated_is_refused(plate, monkeypatch):
    def refused(points_m, match, board=BOARD, **changes):
        fields = {
            **vars(measured),
            "points_m": points_m,
            "responses": measured.responses[: len(points_m)],
            "known": measured.known[: len(points_m)],
        }
        learned = type(measured)(**fields | {name: value(fields[name]) for name, value in changes.items()})
        with pytest.raises(CalibrationError, match=match) as raised:
            interpolate(board, learned)
        assert "\n" not in str(raised.value)
        assert raised.value.exit_code == 78

    coarse = np.stack(np.meshgrid(np.arange(4e-3, 0.07, 6e-3), np.arange(4e-3, 0.05, 6e-3)), axis=-1).reshape(-1, 2)
    some = scattered_points(BOARD, 96, 2e-3)
    measured = plate.learned(some)
    refused(coarse[:80], r"regular grid of 6.00 mm, above half a wavelength \(4.18 mm\)")
    with pytest.raises(CalibrationError, match="34 points are too few"):
        interpolate(BOARD, plate.learned(scattered_points(BOARD, 34, 2e-3)))
    refused(some[:10], "10 points were measured: 12 is the least")
    refused(some, "of 0.20 ms are shorter than an emission of 0.8 ms", responses=lambda h: h[:, :100])
    refused(some, "do not fit the board's bit_clock_hz", bit_clock_hz=lambda f: f * 1.001)
    refused(some, "fewer than 12 points: 4, 5", known=lambda k: k & ~np.isin(np.arange(32), (4, 5)))
    refused(some, "waves within 7 %", responses=lambda h: np.random.default_rng(1).permutation(h))
    few = np.full((6, 2), 25e-3)
    few[1:, 0] = 1e-3
    assert wave_fit._inside(BOARD, few).tolist() == [True] * 6, "one of six would judge"
    assert wave_fit._inside(BOARD, few[:5]).tolist() == [True, *[False] * 4]
    bins = Bins.of(BOARD.waveform, 600)
    spectra, known = np.zeros((len(bins.frequency_hz), 5, 1), np.complex64), np.ones((5, 1), bool)
    monkeypatch.setattr(wave_fit, "Waves", SimpleNamespace(of=lambda dispersion, *_: dispersion.factor))
    for number, refused_there in ((0, True), (1, False), (-2, False), (-1, True)):
        best = wave_fit.COARSE[number]
        monkeypatch.setattr(wave_fit, "_unforeseen", lambda *given, best=best: abs(given[3] - best))
        with pytest.raises(CalibrationError, match="within 7 %") if refused_there else nullcontext():
            assert wave_fit.fit_waves(BOARD, few[:5], spectra, known, bins).dispersion.factor == pytest.approx(best)


def test_no_place_far_from_all_points_is_estimated(plate):
    points = scattered_points(BOARD, 110, 2e-3)
    source, _ = interpolate(BOARD, plate.learned(points[points[:, 0] < 0.045]))
    source.responses([[0.04, 0.02]])
    near, far = source.foreseen([[0.04, 0.02], [0.065, 0.02]])
    assert near > 0.98
    assert far < 0.8
    with pytest.raises(CalibrationError, match=r"x = 65.0 mm, y = 20.0 mm is too far from the measured points"):
        source.responses([[0.04, 0.02], [0.065, 0.02]])
