import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.device.board.panel import Actuator, Plate
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.errors import ConfigError
from controller.workshop.physics.modes.closed_form import SimplySupported

PAPER = Plate(
    length_mm=210.0,
    width_mm=148.0,
    thickness_mm=0.5,
    young_modulus_pa=72.9e9,
    poisson_ratio=0.208,
    density_kg_m3=2510.0,
    edges="simply_supported",
    decay_time_ms=1.0,
)


# Leissa, Vibration of Plates (NASA SP-160, 1969), table of SSSS plates: omega a^2 sqrt(rho h / D), six lowest modes
@each_row(
    ("length_over_width", "published"),
    [
        (0.4, [11.4487, 16.1862, 24.0818, 35.1358, 41.0576, 45.7950]),
        (1.0, [19.7392, 49.3480, 49.3480, 78.9568, 98.6960, 98.6960]),
        (1.5, [32.0762, 61.6850, 98.6960, 111.0330, 128.3049, 177.6529]),
    ],
)
def test_frequencies_are_those_published_for_simply_supported_plates(length_over_width, published):
    plate = msgspec.structs.replace(PAPER, width_mm=PAPER.length_mm / length_over_width)
    modes = SimplySupported.of(plate, 5e3)
    unit = np.sqrt(plate.density_kg_m3 * plate.thickness_m / bending_stiffness(plate)) * plate.length_m**2
    assert modes.angular_frequency[:6] * unit == pytest.approx(published, rel=1e-5)
    thicker = SimplySupported.of(msgspec.structs.replace(plate, thickness_mm=plate.thickness_mm * 1.01), 5e3)
    assert thicker.angular_frequency[0] * unit != pytest.approx(published[0], rel=1e-5)


def test_the_papers_plate_has_the_modes_that_weyls_law_counts():
    modes = SimplySupported.of(PAPER, 100e3)
    wavenumber = np.sqrt(2 * np.pi * 100e3 / np.sqrt(bending_stiffness(PAPER) / (2510.0 * 0.5e-3)))
    area, rim = 0.210 * 0.148, 2 * (0.210 + 0.148)
    assert modes.count == pytest.approx(area * wavenumber**2 / (4 * np.pi) - rim * wavenumber / (4 * np.pi), rel=0.005)
    assert np.all(np.diff(modes.angular_frequency) >= 0)
    assert modes.angular_frequency[-1] <= 2 * np.pi * 100e3


# Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, section 34: w = 0.01160 P a^2 / D under a central load
def test_a_load_in_the_middle_of_a_square_plate_bends_it_as_published():
    square = msgspec.structs.replace(PAPER, width_mm=PAPER.length_mm)
    modes = SimplySupported.of(square, 100e3)
    middle = modes.shapes([(0.105, 0.105)])[0]
    deflection = np.sum(middle**2 / (modes.mass_kg * modes.angular_frequency**2))
    assert deflection * bending_stiffness(square) / 0.210**2 == pytest.approx(0.01160, rel=1e-3)


def test_a_patch_drives_each_mode_with_the_integral_of_the_laplacian_of_its_shape():
    modes = SimplySupported.of(PAPER, 100e3)
    patch = Actuator(channel=0, x_mm=26.5, y_mm=130.5, size_mm=4.6, idle=0)
    x_m, y_m, size_m = 26.5e-3, 130.5e-3, 4.6e-3
    nodes, weights = np.polynomial.legendre.leggauss(12)
    x, y = np.meshgrid(x_m + nodes * size_m / 2, y_m + nodes * size_m / 2)
    step_m = 20e-6  # the second difference is wrong by (k step)^2 / 12 = 1e-5 at most, and rounds at 1e-8
    around = [(0, 0, -4.0), (step_m, 0, 1.0), (-step_m, 0, 1.0), (0, step_m, 1.0), (0, -step_m, 1.0)]
    laplacian = sum(w * modes.shapes(np.column_stack([x.ravel() + dx, y.ravel() + dy])) for dx, dy, w in around) / step_m**2
    expected = np.outer(weights, weights).ravel() * (size_m / 2) ** 2 @ laplacian
    largest = np.abs(expected).max()
    assert modes.coupling(patch) == pytest.approx(expected, abs=3e-5 * largest)
    larger = msgspec.structs.replace(patch, size_mm=patch.size_mm * 1.01)
    assert modes.coupling(larger) != pytest.approx(expected, abs=3e-5 * largest)


def test_shapes_vanish_on_the_rim_and_their_mean_square_is_a_quarter():
    modes = SimplySupported.of(PAPER, 20e3)
    rim = [(0.0, 0.05), (0.210, 0.05), (0.1, 0.0), (0.1, 0.148)]
    assert modes.shapes(rim) == pytest.approx(0.0, abs=1e-12)
    x, y = np.meshgrid((np.arange(80) + 0.5) * 0.210 / 80, (np.arange(80) + 0.5) * 0.148 / 80)
    shapes = modes.shapes(np.column_stack([x.ravel(), y.ravel()]))
    assert (shapes**2).mean(0) == pytest.approx(0.25, rel=1e-9)


def test_a_plate_without_a_mode_in_range_is_refused():
    with pytest.raises(ConfigError, match="no mode below 50"):
        SimplySupported.of(PAPER, 50.0)


def test_a_plate_with_other_edges_is_none_in_closed_form():
    with pytest.raises(ConfigError, match=r"edges = .simply_supported"):
        SimplySupported.of(msgspec.structs.replace(PAPER, edges="free"), 1e3)


def test_a_plate_with_more_modes_than_can_be_computed_with_is_refused():
    vast = msgspec.structs.replace(PAPER, length_mm=2000.0, width_mm=2000.0)
    with pytest.raises(ConfigError, match="more than 30000 modes"):
        SimplySupported.of(vast, 100e3)
