"""Where to measure a plate: `calibrate plan`."""

import json

import numpy as np
import pytest
from small_plate import WHOLE

from controller.cli import main
from controller.device.bank.grid import Grid
from controller.errors import ConfigError
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.interpolation.interpolated import LEAST_SHARE
from controller.workshop.calibration.interpolation.kriging import Waves, foreseen_shares
from controller.workshop.calibration.interpolation.spectra import Bins
from controller.workshop.calibration.interpolation.wave_fit import EDGE_VARIANCES
from controller.workshop.calibration.pictures import plot_plan
from controller.workshop.calibration.point_plan import grid_points, half_wave_m, path_m, scattered_points, short_path

# Ratio of frequency at the same wavenumber to Kirchhoff's, of 0.5 mm glass: Rayleigh and Lamb's A0 (exact elasticity)
LAMB = {20e3: 0.993617, 70e3: 0.978306, 100e3: 0.969532}


def test_wavenumbers_are_those_of_exact_elasticity():
    """k of the frequency to which shear and rotation lower a wave is Kirchhoff's k; 2e-5 is Mindlin's own distance at 100 kHz."""
    waves = Dispersion.of(WHOLE.plate)
    for kirchhoff_hz, ratio in LAMB.items():
        kirchhoff = (waves.mass_kg_m2 * (2 * np.pi * kirchhoff_hz) ** 2 / waves.stiffness_nm) ** 0.25
        found = waves.wavenumber(kirchhoff_hz * ratio)
        print(f"{kirchhoff_hz:g} Hz: off by {found / kirchhoff - 1:.1e}")
        assert found == pytest.approx(kirchhoff, rel=2e-5)


def test_a_grid_covers_the_plate_with_the_middles_of_cells_of_half_a_wavelength():
    points_m = grid_points(WHOLE)
    xs, ys = (np.unique(points_m[:, axis].round(9)) for axis in (0, 1))
    assert len(points_m) == len(xs) * len(ys)
    for places, extent in ((xs, 0.21), (ys, 0.148)):
        assert 0.95 * half_wave_m(WHOLE) < extent / len(places) <= half_wave_m(WHOLE)
        np.testing.assert_allclose(places, (np.arange(len(places)) + 0.5) * extent / len(places), atol=1e-9)
    assert path_m(points_m) < 1.05 * len(points_m) * half_wave_m(WHOLE), "to and fro: no way back"


def test_scattered_points_keep_their_distances():
    points_m = scattered_points(WHOLE, 250, 5e-3, avoid_actuators=True)
    assert (points_m >= 5e-3).all()
    assert (points_m <= np.array([0.205, 0.143])).all()
    for a in WHOLE.actuators:
        assert (abs(points_m - np.array([a.x_mm, a.y_mm]) * 1e-3).max(axis=1) > a.size_mm * 0.5e-3).all()
    apart = np.hypot(*(points_m[:, None] - points_m).T) + np.eye(250)
    even = np.sqrt(0.2 * 0.138 / 250)
    assert apart.min() > 0.5 * even, "blue noise: no two next to each other"
    assert np.ptp(apart.min(axis=0)) > 0.1 * even, "and no lattice"
    assert path_m(points_m) < 1.2 * np.sqrt(0.2 * 0.138 * 250), "the shortest is 0.9 of that root or more"
    assert sorted(short_path(points_m)) == list(range(250))


def test_what_cannot_be_planned_is_refused_and_places_are_drawn_where_they_are(monkeypatch):
    for arguments in ((0, 0.0), (10, -1e-3), (10, 74e-3), (10, np.nan), (30_000, 0.0)):
        with pytest.raises(ConfigError):
            scattered_points(WHOLE, *arguments)
    drawn, places_m = [], np.array([[0.05, 0.04], [0.15, 0.1]])
    monkeypatch.setattr(plot_plan, "save_figure", lambda figure, *_: drawn.append(figure))
    plot_plan.plot_plan(None, WHOLE, places_m, places_m, np.array([0.9, 1.0]))
    dots = drawn[0].axes[0].collections[0]
    assert dots.get_offsets().tolist() == (places_m * 1e3).tolist()
    assert dots.get_array().tolist() == pytest.approx([10, 0]), "percent that are not foreseen"


def test_the_command_writes_positions_and_says_how_long_it_takes(tmp_path, capsys):
    file = tmp_path / "points.csv"
    assert main(["calibrate", "plan", "--points", "20", "--record-ms", "50", "--settle-ms", "0", "--out", str(file), "--json"]) == 0
    reported = json.loads(capsys.readouterr().out)
    lines = file.read_text().splitlines()
    assert lines[0] == "point,x_mm,y_mm"
    assert len(lines) == 21 == reported["points"] + 1
    assert reported["records"] == 20 * 32
    assert reported["minutes"] == pytest.approx((20 * 32 * 0.05 + reported["path_m"] / 0.05) / 60, abs=0.1)
    assert reported["foreseen_share"]["median"] < 0.8, "20 points are too few"
    machine = tmp_path / "points.gcode"
    assert main(["calibrate", "plan", "--points", "20", "--out", str(machine)]) == 0
    assert machine.read_text().count("G0 X") == machine.read_text().count("G4 P3400 ") == 20
    assert "less than 0.97 of the amplitude between them: 258 are proposed" in capsys.readouterr().err
    assert main(["calibrate", "plan", "--points", "20", "--out", str(tmp_path / "absent" / "points.csv")]) == 78
    assert capsys.readouterr().err.count("\n") == 1
    assert main(["calibrate", "plan", "--grid", "--margin-mm", "3"]) == 2


def test_scattered_points_reach_every_cell_of_the_bank_also_in_the_corners():
    """A cell that is not in the bank would keep `run` from a scene that can ask for it."""
    points = scattered_points(WHOLE, 250, 2e-3)
    cells = Grid.of(WHOLE.plate, 2.5e-3).points()
    corners = [(x_m, y_m) for x_m in (0, WHOLE.plate.length_m) for y_m in (0, WHOLE.plate.width_m)]
    near = cells[np.min([np.hypot(*(cells - corner).T) for corner in corners], axis=0) < 8e-3]
    bins = Bins.of(WHOLE.waveform, 2 * WHOLE.waveform.samples)
    prior = Waves.of(Dispersion.of(WHOLE.plate), bins, WHOLE, EDGE_VARIANCES[-1])
    shares = foreseen_shares(prior, points, near, bins.in_band[:: len(bins.in_band) // 8])
    print(f"{len(near)} cells in the corners: {shares.min():.3f} at least")
    assert shares.min() > LEAST_SHARE


@pytest.mark.slow
def test_the_plan_is_drawn(tmp_path, capsys):
    assert main(["calibrate", "plan", "--plot", str(tmp_path / "plan.png"), "--json"]) == 0
    reported = json.loads(capsys.readouterr().out)
    assert reported["foreseen_share"]["worst_5_percent"] > 0.98
    assert (tmp_path / "plan.png").stat().st_size > 10_000
