"""Stress against tables of loaded plates, single modes, an inclusion solved by its rim, and the design's estimate."""

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.plate.parts import Parts
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.workshop.benchmark.focus.focus_emission import emission_at
from controller.workshop.physics.design.design_figures import design_figures
from controller.workshop.physics.modes.closed_form import SimplySupported
from controller.workshop.physics.stress import ceramic_stress_pa, curvatures, focal_stress, plate_stress_pa, stress_warnings

BOARD = load_board(find_board("simulated"))
STEEL = msgspec.structs.replace(
    BOARD.plate, length_mm=200.0, width_mm=200.0, thickness_mm=2.0, young_modulus_pa=2e11, poisson_ratio=0.3
)


# Timoshenko and Woinowsky-Krieger, table 8: bending moments in the middle, over load and shorter side squared, nu = 0.3
@each_row(("longer", "across", "along"), [(1.0, 0.0479, 0.0479), (1.5, 0.0812, 0.0498), (2.0, 0.1017, 0.0464)])
def test_a_plate_under_a_uniform_load_has_the_stress_of_the_table(longer, across, along):
    plate, load_pa = msgspec.structs.replace(STEEL, length_mm=200.0 * longer), 500.0
    modes = SimplySupported.of(plate, 400e3)
    m, n = modes.factors.x_index + 1, modes.factors.y_index + 1
    pushed = load_pa * plate.length_m * plate.width_m * (1 - np.cos(m * np.pi)) * (1 - np.cos(n * np.pi)) / (m * n * np.pi**2)
    bent = pushed / (modes.mass_kg * modes.angular_frequency**2)
    x_m, y_m = (np.linspace(0.4 * side, 0.6 * side, 61) for side in (plate.length_m, plate.width_m))
    xx, yy, xy = (part[30, 30] for part in curvatures(modes, bent, x_m, y_m))
    stiffness, scale = bending_stiffness(plate), load_pa * plate.width_m**2
    assert stiffness * abs(yy + 0.3 * xx) / scale == pytest.approx(across, abs=1e-4)
    assert stiffness * abs(xx + 0.3 * yy) / scale == pytest.approx(along, abs=1e-4)
    found = float(plate_stress_pa(plate, xx, yy, xy))
    assert found == pytest.approx(6 * across * scale / plate.thickness_m**2, rel=2e-3)
    assert found * 1.01 != pytest.approx(6 * across * scale / plate.thickness_m**2, rel=2e-3)


def test_a_modes_corner_is_in_shear_and_its_middle_in_tension():
    modes = SimplySupported.of(STEEL, 2e3)
    amplitudes = np.zeros(modes.count)
    amplitudes[0] = 1e-6
    x_m = y_m = np.linspace(0, 0.2, 81)
    stress = plate_stress_pa(STEEL, *curvatures(modes, amplitudes, x_m, y_m))
    bent = 1e-6 * (np.pi / 0.2) ** 2
    assert stress[40, 40] == pytest.approx(2e11 * 1e-3 * bent / (1 - 0.3), rel=1e-4)
    assert stress[0, 0] == pytest.approx(2e11 * 1e-3 * bent / (1 + 0.3), rel=1e-3)


def test_layers_alike_are_one_plate_and_a_soft_one_between_bears_little():
    layer = {"young_modulus_pa": 7e10, "poisson_ratio": 0.22, "density_kg_m3": 2500.0}
    whole = msgspec.structs.replace(BOARD.plate, thickness_mm=1.0, young_modulus_pa=7e10, poisson_ratio=0.22)
    as_layers = dict.fromkeys(("thickness_mm", "young_modulus_pa", "poisson_ratio", "density_kg_m3"))
    keys = {name: value for name, value in msgspec.to_builtins(BOARD.plate).items() if name not in as_layers and value is not None}
    halves = msgspec.convert(keys | {"layers": [layer | {"thickness_mm": 0.4}, layer | {"thickness_mm": 0.6}]}, Plate)
    assert float(plate_stress_pa(halves, 1.0, 0.5, 0.2)) == pytest.approx(float(plate_stress_pa(whole, 1.0, 0.5, 0.2)), rel=1e-9)


def test_a_patch_bends_as_an_inclusion_whose_rim_keeps_slope_and_moment():
    """w = k r^2 / 2 inside, K r^2 / 2 + B ln r outside: slopes and radial moments are the same at the rim (r = 1)."""
    plate, parts = BOARD.plate, Parts(disc="7BB-12-9")
    on, nu = parts.on(plate), plate.poisson_ratio
    slope, moment = [1.0, -1.0], [on.stiffness_ratio * (1 + nu), 1 - nu]
    inside, _ = np.linalg.solve([slope, moment], [1.0, 1 + nu])
    disc = parts.data
    face = inside * 1.3 * on.face_m * disc.ceramic_modulus_pa / (1 - disc.ceramic_poisson_ratio)
    own = disc.ceramic_modulus_pa / (1 - disc.ceramic_poisson_ratio) * disc.piezo_constant_m_per_v * 60.0 / 0.12e-3
    assert ceramic_stress_pa(parts, plate, 1.3, 60.0) == pytest.approx(face + own, rel=1e-6)
    assert 0.12e-3 < on.face_m < 0.75e-3


def test_a_focus_has_the_stress_that_the_design_foresees():
    emission = emission_at(BOARD, [(0.1, 0.07)])
    played = focal_stress(BOARD, emission.twin.modes, emission.field.modal, emission.points_m)
    found = design_figures(BOARD, {"amplitude_um": 7.67})["stress"]
    print({name: (round(value, 2), round(played[name], 2)) for name, value in found.items()})
    assert found["plate_mpa"] == pytest.approx(played["plate_mpa"], rel=0.15)
    assert found["ceramic_mpa"] == pytest.approx(played["ceramic_mpa"], rel=0.15)
    assert found["field_mv_m"] == played["field_mv_m"] == pytest.approx(0.5)
    x_m, y_m = np.linspace(0, 0.21, 400), np.linspace(0, 0.148, 282)  # the whole plate: nothing is worse elsewhere
    everywhere = plate_stress_pa(BOARD.plate, *curvatures(emission.twin.modes, emission.field.modal, x_m, y_m))
    assert float(everywhere.max()) * 1e-6 == pytest.approx(played["plate_mpa"], rel=0.02)
    bare = msgspec.structs.replace(BOARD, parts=None)
    assert set(focal_stress(bare, emission.twin.modes, emission.field.modal, [(0.1, 0.07)])) == {"plate_mpa"}


@each_row(
    ("plate_mpa", "ceramic_mpa", "field_mv_m", "said"),
    [
        (44.9, 27.5, 0.59, ""),
        (45.1, None, None, "the plate bears"),
        (1.0, 27.7, 0.5, "the ceramic of a patch bears"),
        (1.0, 1.0, 0.61, "the field in the ceramic"),
    ],
)
def test_what_bears_too_much_is_said(plate_mpa, ceramic_mpa, field_mv_m, said):
    found = stress_warnings(plate_mpa, ceramic_mpa, field_mv_m)
    assert len(found) == bool(said)
    assert "".join(found).startswith(said)


def test_the_design_warns_of_stress():
    assert not any("MPa" in line for line in design_figures(BOARD)["warnings"])
    loud = " ".join(design_figures(BOARD, {"amplitude_um": 30})["warnings"])
    assert "the plate bears" in loud
    assert "the ceramic of a patch bears" in loud
