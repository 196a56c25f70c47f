import msgspec
import numpy as np
import pytest
from device.board.changed_board import changed, rewritten
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.cli import main
from controller.device.bank.packing import channel_bits
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.panel import Actuator
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.device.board.relations.checked import RELATIONS
from controller.errors import ConfigError
from controller.workshop.physics.modes.closed_form import SimplySupported
from controller.workshop.physics.modes.ritz import longest_matrix
from controller.workshop.physics.modes.ritz_modes import LONGEST_MATRIX, plate_shape
from controller.workshop.physics.plate import mode_cut_hz
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.modal_response import transform_length

BOARD = load_board(find_board("simulated"))
FLOOR = {"plate__length_mm": 4000.0, "plate__width_mm": 3000.0, "plate__thickness_mm": 20.0}
LOW = {"waveform__band_low_hz": 1e3, "waveform__band_high_hz": 8e3, "waveform__bit_clock_hz": 100e3, "waveform__duration_ms": 10.0}
MIXED = {"x0": "clamped", "x1": "free", "y0": "simply_supported", "y1": "free"}

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


def test_modes_reach_100_khz_on_small_plates_and_on_a_floor_as_far_as_its_band_needs():
    assert mode_cut_hz(BOARD) == 100e3
    assert mode_cut_hz(changed(BOARD, waveform__band_high_hz=200e3)) == pytest.approx(200e3 * 10 / 7)
    assert mode_cut_hz(changed(BOARD, **LOW)) == 100e3
    floor = changed(BOARD, **FLOOR, **LOW)
    assert 8e3 * 10 / 7 < mode_cut_hz(floor) < 13e3
    assert SimplySupported.of(floor.plate, mode_cut_hz(floor)).count == pytest.approx(2200, rel=0.05)
    thinner = changed(floor, plate__thickness_mm=10.0)
    assert mode_cut_hz(thinner) == pytest.approx(8e3 * 10 / 7), "its band asks for more modes than are few"
    wavenumber2 = 2 * np.pi * mode_cut_hz(floor) * np.sqrt(2510.0 * 20e-3 / bending_stiffness(floor.plate))
    mixed = plate_shape(msgspec.convert(msgspec.to_builtins(floor.plate) | {"edges": MIXED}, Plate))
    assert longest_matrix(mixed, wavenumber2**0.5) < LONGEST_MATRIX, "edges of which none is like the opposite one"


@each_row(("inductance_h", "resistance_ohm", "most"), [(6.8e-3, 2e3, 0.014), (0.6254, 19.22e3, 0.004)])
def test_modes_beyond_the_cut_of_a_floor_add_little(inductance_h, resistance_ohm, most):
    """A driver that passes the harmonics of the bits, and one of the band; patches of 0.44 of a wave, as on the paper's plate."""
    patches = tuple(
        msgspec.structs.replace(a, x_mm=46 + (a.x_mm / 210) * 1908, y_mm=46 + (a.y_mm / 148) * 1408, size_mm=92.0)
        for a in BOARD.actuators
    )
    driver = {"driver__inductance_h": inductance_h, "driver__resistance_ohm": resistance_ohm}
    floor = changed(BOARD, **FLOOR | {"plate__length_mm": 2000.0, "plate__width_mm": 1500.0}, **LOW, **driver, actuators=patches)
    points = np.random.default_rng(1).uniform(0.15, 0.85, (6, 2)) * (2.0, 1.5)
    model = ResponseModel(floor, modes=SimplySupported.of(floor.plate, 60e3))
    bits = (model.drive_order_responses(points) > 0) - channel_bits(np.array([floor.idle_word], "<u4")).astype(float)
    cut = model.plate_modes.angular_frequency <= 2 * np.pi * 8e3 * 10 / 7
    shapes = model.plate_modes.shapes(points)
    of_modes = np.einsum("pnq,mq,mn,pm->pm", bits, model.forces, model.modal[:, ::-1], shapes, optimize=True)
    beyond = of_modes[:, ~cut].sum(axis=1) / of_modes.sum(axis=1)
    print(f"beyond the cut of a floor, of the amplitude: {np.round(100 * beyond, 2)} %")
    assert 1e-4 < np.abs(beyond).max() < most


@given(st.floats(100e3, 2e6), st.floats(1e-3, 0.49), st.floats(4e-4, 0.49), st.integers(1, 1000), st.floats(1e-5, np.inf))
def test_the_filter_of_every_band_that_a_board_may_have_fits_a_transform_of_131072_samples(
    clock_hz, low, width, samples, slowest_s
):
    """Edges of the band over the bit clock: from just what a board is held to."""
    band_hz = low * clock_hz, (low + width) * clock_hz
    assert transform_length(1 / clock_hz, samples, band_hz, slowest_s)[0] <= 1 << 17
    assert transform_length(1 / clock_hz, samples, (0.5 * band_hz[0], band_hz[1]), slowest_s)[0] <= 1 << 18
    if low + width < 0.49:
        keys = {"band_low_hz": band_hz[0] * 1.0001, "band_high_hz": band_hz[1] * 1.0002, "bit_clock_hz": clock_hz}
        keys["duration_ms"] = 1e3 * samples / clock_hz
        resolved = next(relation for relation in RELATIONS if relation.broken.__name__ == "_resolved")
        assert not list(resolved.broken(changed(BOARD, **{f"waveform__{key}": value for key, value in keys.items()})))


@each_row(
    "command",
    [
        ["focus", "--at", "100", "80"],
        ["focus", "--figures"],
        ["bank", "build"],
        ["bank", "choices"],
        ["design"],
        ["benchmark"],
        ["run"],
    ],
)
def test_every_command_refuses_a_band_of_gigabytes_in_one_line(capsys, tmp_path, command):
    text = (find_board("simulated") / "board.toml").read_text()
    (tmp_path / "board.toml").write_text(rewritten(text, band_low_hz=0.001))
    assert main([*command, "--board", str(tmp_path)]) == 78
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "tell no less than 500 Hz from rest" in said
