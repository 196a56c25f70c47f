"""Mindlin's dispersion and layered plates against elasticity without a plate theory (`lamb`), and the modes made with them."""

import msgspec
import numpy as np
import pytest
from small_plate import small_board
from tables import each_row
from workshop.physics.lamb import layered_a0, rayleigh_lamb_a0

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.plate.layers import MOST_SHEAR, PlateLayer, laminate, softest
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import MindlinPlate, bending_stiffness, bending_wavelength_m
from controller.errors import ConfigError
from controller.workshop.physics.field import FocusScale
from controller.workshop.physics.modes.plate_modes import modes_of

BOARD = load_board(find_board("simulated"))
KIRCHHOFF = BOARD.plate
PAPER = msgspec.structs.replace(KIRCHHOFF, theory="mindlin")
GLASS = PlateLayer(thickness_mm=0.5, young_modulus_pa=72.9e9, poisson_ratio=0.208, density_kg_m3=2510.0)


def kirchhoff_omega(plate, wavenumber):
    return np.sqrt(bending_stiffness(plate) / (plate.density_kg_m3 * plate.thickness_m)) * wavenumber**2


def of_layers(*layers, theory="mindlin"):
    return Plate(length_mm=70.0, width_mm=50.0, edges="free", decay_time_ms=1.0, theory=theory, layers=layers)


# Ratios to Kirchhoff's frequency: Mindlin with 5 / (6 - nu), and the root of Rayleigh's and Lamb's equation
@each_row(
    ("kirchhoff_hz", "mindlin", "exact"),
    [(20e3, 0.993616, 0.993617), (70e3, 0.978300, 0.978306), (100e3, 0.96952, 0.969532)],
)
def test_frequencies_are_those_of_rayleigh_and_lamb(kirchhoff_hz, mindlin, exact):
    wavenumber = 2 * np.pi / bending_wavelength_m(KIRCHHOFF, kirchhoff_hz)
    found = MindlinPlate.of(PAPER).angular_frequency(wavenumber) / (2 * np.pi * kirchhoff_hz)
    reference = rayleigh_lamb_a0(PAPER, wavenumber) / (2 * np.pi * kirchhoff_hz)
    print(f"{kirchhoff_hz / 1e3:g} kHz: Mindlin {found:.6f}, Rayleigh-Lamb {reference:.6f}, apart {found / reference - 1:.2e}")
    assert found == pytest.approx(mindlin, abs=6e-6)
    assert reference == pytest.approx(exact, abs=1e-6)
    assert found == pytest.approx(reference, rel=1.25e-5)  # what the coefficient leaves at 100 kHz
    thicker = MindlinPlate.of(msgspec.structs.replace(PAPER, thickness_mm=0.505)).angular_frequency(wavenumber)
    assert thicker != pytest.approx(rayleigh_lamb_a0(PAPER, wavenumber), rel=1.25e-5)


def test_the_wavelength_is_that_of_the_theory_and_scales_what_is_measured():
    wavelength_m = bending_wavelength_m(PAPER, 70e3)
    omega = MindlinPlate.of(PAPER).angular_frequency(2 * np.pi / wavelength_m)
    assert omega == pytest.approx(2 * np.pi * 70e3, rel=1e-12)
    assert wavelength_m / bending_wavelength_m(KIRCHHOFF, 70e3) == pytest.approx(0.989, abs=1e-3)  # 1.1 % in k
    board = msgspec.structs.replace(BOARD, plate=PAPER)
    assert FocusScale.of(board).outside_m == pytest.approx(0.993 * FocusScale.of(BOARD).outside_m, rel=1e-9)


def test_modes_get_the_frequencies_of_their_wavenumbers_and_none_below_the_cut_is_missing():
    """Simply supported, this is exact: wavenumbers are (m pi / a, n pi / b) by either theory (Mindlin and Navier)."""
    small = small_board()
    plate = msgspec.structs.replace(small.plate, theory="mindlin")
    highest_hz = 100e3
    modes = modes_of(msgspec.structs.replace(small, plate=plate), highest_hz)
    m, n = np.meshgrid(np.arange(1, 60), np.arange(1, 60))
    wavenumber = np.sort(np.hypot(m * np.pi / 0.07, n * np.pi / 0.05).ravel())
    exact = np.array([rayleigh_lamb_a0(plate, k) for k in wavenumber[wavenumber < 1.1 * 890]]) / (2 * np.pi)
    kirchhoff = modes_of(small, highest_hz)
    assert modes.count == np.count_nonzero(exact <= highest_hz) > kirchhoff.count
    assert modes.angular_frequency / (2 * np.pi) == pytest.approx(exact[: modes.count], rel=1.5e-5)
    assert kirchhoff.angular_frequency / (2 * np.pi) != pytest.approx(exact[: kirchhoff.count], rel=1e-2)
    point = [(0.02, 0.03)]
    assert np.array_equal(modes.shapes(point)[:, : kirchhoff.count], kirchhoff.shapes(point))


def test_one_layer_is_the_plate_itself():
    for layers in ((GLASS,), (msgspec.structs.replace(GLASS, thickness_mm=0.2), msgspec.structs.replace(GLASS, thickness_mm=0.3))):
        plate = of_layers(*layers)
        for key in ("thickness_mm", "young_modulus_pa", "poisson_ratio", "density_kg_m3"):
            assert getattr(plate, key) == pytest.approx(getattr(PAPER, key), rel=1e-14)
        layered, single = MindlinPlate.of(plate), MindlinPlate.of(PAPER)
        assert [layered.rotation_kg, layered.shear_n_m] == pytest.approx([single.rotation_kg, single.shear_n_m], rel=1e-13)


LAMINATED = (GLASS, PlateLayer(thickness_mm=0.05, young_modulus_pa=3e9, poisson_ratio=0.35, density_kg_m3=1200.0), GLASS)
ON_ACRYLIC = (GLASS, PlateLayer(thickness_mm=1.0, young_modulus_pa=3e9, poisson_ratio=0.37, density_kg_m3=1190.0))
ON_STEEL = (GLASS, PlateLayer(thickness_mm=0.3, young_modulus_pa=200e9, poisson_ratio=0.3, density_kg_m3=7800.0))


@each_row("layers", [(GLASS,), LAMINATED, ON_ACRYLIC, ON_STEEL], ids=["glass", "laminated", "acrylic", "steel"])
def test_waves_in_layers_are_those_of_elasticity(layers):
    """At kh = 0.1 shear is 0.1 to 0.5 % of the frequency, so the bending stiffness is proved to 1e-4; at 0.4 the rest is too."""
    plate = of_layers(*layers)
    apart = []
    for kh in (0.1, 0.4):
        wavenumber = kh / plate.thickness_m
        exact = layered_a0(layers, wavenumber)
        apart.append(float(MindlinPlate.of(plate).angular_frequency(wavenumber) / exact - 1))
        softer = plate.with_stiffness(0.98)  # 1 % in frequency
        assert abs(MindlinPlate.of(softer).angular_frequency(wavenumber) / exact - 1) > 5e-3
    print(
        f"shear {laminate(layers).shear_flexibility:.3g} of a solid plate; apart at kh = 0.1, 0.4: {apart[0]:.1e}, {apart[1]:.1e}"
    )
    assert abs(apart[0]) < 1e-4
    assert abs(apart[1]) < 1.2e-3


def test_layers_up_to_the_bound_of_shear_are_right_to_half_a_percent_with_mindlin():
    for modulus_pa, thickness_mm in ((3.8e9, 0.2), (1.1e9, 0.05)):
        glue = PlateLayer(thickness_mm=thickness_mm, young_modulus_pa=modulus_pa, poisson_ratio=0.4, density_kg_m3=1100.0)
        layers = (GLASS, glue, GLASS)
        assert 7 < laminate(layers).shear_flexibility < MOST_SHEAR
        wavenumber = 0.4 / sum(layer.thickness_mm * 1e-3 for layer in layers)
        assert MindlinPlate.of(of_layers(*layers)).angular_frequency(wavenumber) == pytest.approx(
            layered_a0(layers, wavenumber), rel=5e-3
        )


def test_a_stiffer_plate_of_layers_keeps_its_layers():
    plate = of_layers(*LAMINATED).with_stiffness(1.02)
    assert plate.young_modulus_pa == pytest.approx(1.02 * of_layers(*LAMINATED).young_modulus_pa)
    assert plate.layers[1].young_modulus_pa == pytest.approx(1.02 * 3e9)
    rubbery = msgspec.structs.replace(GLASS, young_modulus_pa=1.1 * GLASS.young_modulus_pa, poisson_ratio=0.49)
    assert softest((GLASS, rubbery)) == 1, "30.2 GPa in shear of 27.0"


def test_a_refusal_tells_both_frequencies():
    floor = msgspec.structs.replace(PAPER, length_mm=4000.0, width_mm=3000.0, thickness_mm=20.0)
    with pytest.raises(
        ConfigError, match=r"more than 30000 modes .* \(247612 Hz by Kirchhoff's theory are 100000 Hz by Mindlin's\)"
    ):
        modes_of(msgspec.structs.replace(BOARD, plate=floor), 100e3)
