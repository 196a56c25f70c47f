"""Plates with any edges against Levy's exact solution, the closed form, published figures and finer bases."""

import itertools

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from small_plate import small_board
from tables import each_row
from workshop.physics.levy import levy_wavenumbers

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.panel import Actuator
from controller.device.board.plate.plate import Edges, Foam
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.errors import ConfigError
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.modes import ritz, ritz_modes
from controller.workshop.physics.modes.closed_form import SimplySupported
from controller.workshop.physics.modes.mode_count import edge_term, mode_count
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.modes.ritz import PlateShape
from controller.workshop.physics.modes.ritz_modes import RitzModes, plate_shape
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.step_response import StepResponse, channel_forces
from controller.workshop.physics.word_capture import capture_of_words

BOARD = load_board(find_board("simulated"))
PAPER = BOARD.plate
LETTERS = {"S": "simply_supported", "C": "clamped", "F": "free", "E": "foam"}
FOAM = Foam(stiffness_n_m3=1e9, width_mm=9.0)
SMALL_HZ = 5e3  # 90 to 110 modes of the paper's plate; wavelengths over length and width as on a tenth of it at 50 kHz


def plate_of(sides, plate=PAPER, foam=FOAM, **other):
    """The paper's plate with four letters as its edges: x0, x1, y0, y1."""
    edges = Edges(**dict(zip(("x0", "x1", "y0", "y1"), (LETTERS[side] for side in sides), strict=True)))
    return msgspec.structs.replace(plate, edges=edges, foam=foam if "E" in sides else None, **other)


def shape_of(sides, lengths_m=(0.21, 0.148), poisson_ratio=0.208, foam=0.0, foam_width_m=0.0):
    a, b, c, d = (LETTERS[side] for side in sides)
    return PlateShape(lengths_m, ((a, b), (c, d)), poisson_ratio, foam, foam_width_m)


def wavenumber(hz, plate=PAPER):
    return (2 * np.pi * hz * (plate.density_kg_m3 * plate.thickness_m / bending_stiffness(plate)) ** 0.5) ** 0.5


def wavenumbers2(shape, highest_k):
    """k^2 of all modes, which is as their frequency, lowest first."""
    return np.sort(np.sqrt(np.concatenate([found.wavenumber4 for found in ritz.solve(shape, highest_k).classes])))


def largest_error(found, expected, above):
    assert found.size == expected.size, "a mode too many or too few"
    return float(np.abs(found / expected - 1)[expected > above].max())


def against_levy(sides, highest_hz, error):
    """Compare all modes; `sides` are x0 and x1."""
    exact = levy_wavenumbers(0.21, 0.148, [LETTERS[side] for side in sides], 0.208, wavenumber(highest_hz))
    found = wavenumbers2(shape_of(sides + "SS"), wavenumber(highest_hz))
    worst = largest_error(found, exact**2, 0)
    print(f"{sides}SS to {highest_hz:g} Hz: {found.size} modes, frequencies wrong by {worst:.1e} at most (bound {error:g})")
    assert worst < error
    return exact


@each_row(("sides", "error"), [("SS", 1e-6), ("CC", 1e-6), ("FF", 1e-6), ("SC", 3e-4), ("SF", 3e-4), ("CF", 3e-4)])
def test_frequencies_are_levys(sides, error):
    """All modes up to the cut; issue 13 demands 1e-5 of alike edges and 3e-4 of others."""
    exact = against_levy(sides, SMALL_HZ, error)
    if "F" in sides:  # the only edge that knows Poisson's ratio
        other = wavenumbers2(shape_of(sides + "SS", poisson_ratio=0.208 * 1.01), wavenumber(SMALL_HZ))
        assert np.abs(other[: exact.size] / exact[: other.size] ** 2 - 1).max() > 3e-4, "1 % of Poisson's ratio would be seen"


# Leissa, The free vibration of rectangular plates (J. Sound Vib. 31, 1973), nu = 0.3: omega a^2 sqrt(rho h / D), square
@each_row(
    ("sides", "published"),
    [
        ("FFFF", [13.489, 19.789, 24.432, 35.024, 35.024, 61.526]),
        ("CCCC", [35.992, 73.413, 73.413, 108.27, 131.64, 132.24]),
        ("CFFF", [3.4917, 8.5246, 21.429, 27.331, 31.111, 54.443]),
        ("CSSF", [16.865, 31.138, 51.631, 64.043, 67.646, 101.21]),
    ],
)
def test_the_lowest_frequencies_are_those_published_for_square_plates(sides, published):
    """Leissa's are upper bounds from 36 beam functions, by up to 1 % above the true ones."""
    found = wavenumbers2(shape_of(sides, (1.0, 1.0), 0.3), 14.0)[:6]
    assert found == pytest.approx(published, rel=0.011)
    assert np.all(found < np.multiply(published, 1 + 2e-5))


@each_row(
    ("sides", "foam", "error"),
    [("FFFF", 0, 1e-5), ("CCCC", 0, 1e-5), ("EEEE", 1e9, 1e-5), ("EEEE", 1e11, 1e-5), ("EECC", 1e9, 1e-5), ("EFSC", 1e9, 3e-4)],
)
def test_a_basis_twice_as_fine_gives_the_same_frequencies(sides, foam, error):
    """A ninth of the paper's plate up to 45 kHz, 9 mm of foam; the finer basis has 1.6 times the functions along each axis."""
    shape = shape_of(sides, (0.07, 0.05), foam=foam / bending_stiffness(PAPER), foam_width_m=9e-3)
    coarse = wavenumbers2(shape, wavenumber(45e3))
    fine = wavenumbers2(shape, wavenumber(45e3) * 1.7)[: coarse.size]
    worst = largest_error(coarse, fine, wavenumber(500.0) ** 2)
    print(f"{sides} with {foam:g} N/m3: {coarse.size} modes, frequencies wrong by {worst:.1e} at most (bound {error:g})")
    assert worst < error


def test_a_simply_supported_plate_is_that_of_the_closed_form_in_all_that_modes_say():
    closed, found = SimplySupported.of(PAPER, SMALL_HZ), RitzModes.of(PAPER, SMALL_HZ)
    assert found.angular_frequency == pytest.approx(closed.angular_frequency, rel=1e-6)
    stiffer = RitzModes.of(msgspec.structs.replace(PAPER, young_modulus_pa=PAPER.young_modulus_pa * 1.01), SMALL_HZ)
    assert stiffer.angular_frequency[:50] != pytest.approx(closed.angular_frequency[:50], rel=4e-3)
    apart = np.diff(closed.angular_frequency, prepend=0, append=np.inf) / 2 / np.pi
    alone = np.minimum(apart[1:], apart[:-1]) > 2.0  # Hz; shapes of modes that are nearer may mix
    alone &= closed.angular_frequency < 2 * np.pi * 0.7 * SMALL_HZ  # a shape's error is the root of its frequency's
    points = np.random.default_rng(1).uniform(0, 1, (40, 2)) * (0.21, 0.148)
    assert found.mass_kg / found.mean_square == pytest.approx(closed.mass_kg / closed.mean_square)
    assert np.abs(found.shapes(points))[:, alone] == pytest.approx(2 * np.abs(closed.shapes(points))[:, alone], abs=1e-4)
    for actuator in BOARD.actuators[::9]:
        expected = 2 * np.abs(closed.coupling(actuator))[alone]
        assert np.abs(found.coupling(actuator))[alone] == pytest.approx(expected, abs=2e-4 * expected.max())
    point = closed.shapes([(0.06, 0.05)])[0] ** 2 / (closed.mass_kg * closed.angular_frequency**2)
    other = found.shapes([(0.06, 0.05)])[0] ** 2 / (found.mass_kg * found.angular_frequency**2)
    assert other.sum() == pytest.approx(point.sum(), rel=1e-6), "no mode is left out of the deflection under a load"


@each_row("sides", ["FFFF", "CCSS", "CEFS", "SFFF"])
def test_shapes_keep_the_edges_conditions_and_are_orthonormal(sides):
    modes = RitzModes.of(plate_of(sides), 3e3)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    x, y = 0.105 * (1 + nodes), 0.074 * (1 + nodes)
    grid = np.column_stack([points.ravel() for points in np.meshgrid(x, y)])
    shapes = modes.shapes(grid)
    weight = np.outer(weights, weights).ravel() / 4
    assert (shapes * weight[:, None]).T @ shapes == pytest.approx(np.eye(modes.count), abs=2e-6)
    amplitudes = np.random.default_rng(2).standard_normal(modes.count)
    assert modes.on_grid(amplitudes, x, y).ravel() == pytest.approx(shapes @ amplitudes, abs=1e-9)
    assert modes.shapes(grid[::7], np.float32) == pytest.approx(shapes[::7], abs=1e-5)
    step_m = 1e-5
    for side, near in zip(sides, ((step_m, 0.06), (0.21 - step_m, 0.06), (0.08, step_m), (0.08, 0.148 - step_m)), strict=True):
        rim = np.round(near, 3)  # the nearest point of the edge
        at, slope = modes.shapes([rim])[0], (modes.shapes([near]) - modes.shapes([rim]))[0] / step_m
        assert (np.abs(at).max() < 1e-8) == (side in "SC"), side
        assert (np.abs(slope).max() < 1.0) == (side == "C"), side  # elsewhere about k, up to 154 per m


def test_a_patch_drives_each_mode_with_the_integral_of_the_laplacian_of_its_shape():
    actuator = Actuator(channel=0, x_mm=26.5, y_mm=130.5, size_mm=4.6, idle=0)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    x, y = np.meshgrid(26.5e-3 + nodes * 2.3e-3, 130.5e-3 + nodes * 2.3e-3)
    step_m = 20e-6
    around = [(0, 0, -4.0), (step_m, 0, 1.0), (-step_m, 0, 1.0), (0, step_m, 1.0), (0, -step_m, 1.0)]
    for sides in ("FFCC", "CEFS"):
        modes = RitzModes.of(plate_of(sides), SMALL_HZ)
        laplacian = sum(w * modes.shapes(np.column_stack([x.ravel() + dx, y.ravel() + dy])) for dx, dy, w in around) / step_m**2
        expected = np.outer(weights, weights).ravel() * 2.3e-3**2 @ laplacian
        assert modes.coupling(actuator) == pytest.approx(expected, abs=3e-5 * np.abs(expected).max())


def test_the_strips_share_of_each_shape_is_its_integral_over_the_strips():
    modes = RitzModes.of(plate_of("EEFE"), SMALL_HZ)
    nodes, weights = np.polynomial.legendre.leggauss(64)
    x, y = 0.105 + (0.105 - 9e-3) * nodes, (0.148 - 9e-3) / 2 * (1 + nodes)  # strips along both ends of x and the far end of y
    grid = np.column_stack([points.ravel() for points in np.meshgrid(x, y)])
    free = (2 * 0.105 - 18e-3) * (0.148 - 9e-3) / (0.21 * 0.148)
    inner = np.outer(weights, weights).ravel() / 4 * free @ modes.shapes(grid) ** 2
    assert modes.foam_share == pytest.approx(1 - inner, abs=1e-7)


@each_row(("sides", "rigid"), [("FFFF", 3), ("SFFF", 1), ("FFFS", 1), ("SSFF", 0), ("SFSF", 0), ("FFEF", 0), ("CFFF", 0)])
def test_rigid_motions_are_left_out_and_nothing_else(sides, rigid):
    """A plate whose free edges are held by the softest of springs has those motions far below its lowest vibration."""
    shape = shape_of(sides, foam=1e-3 * 100.0**4 if "E" in sides else 0.0, foam_width_m=9e-3)
    assert shape.rigid == rigid
    found = wavenumbers2(shape, wavenumber(2e3))
    springs = shape_of(sides.replace("F", "E"), foam=1.0, foam_width_m=9e-3)
    held = wavenumbers2(springs, wavenumber(2e3))
    if "E" not in sides:
        assert held.size == found.size + rigid
        assert held[:rigid] < 0.05 * found[0] if rigid == 1 else np.all(held[:rigid] < 0.05 * found[0])
        assert found == pytest.approx(held[rigid:], rel=1e-4)


def test_weyls_law_with_the_edges_terms_counts_the_modes():
    """The mean over ten cuts is within two modes of 100 to 180; a term of the edge is worth 8 to 14."""
    assert edge_term("clamped", 0.208) == pytest.approx(-1.7628, abs=1e-4)  # 1 + Gamma(3/4) / (sqrt(pi) Gamma(5/4))
    # With nu = 1 a free edge asks of the Laplacian of w, which is w times k^2 of these waves, what a clamped one asks of w
    assert edge_term("free", 1.0) == pytest.approx(edge_term("clamped", 1.0) + 4)
    for sides in ("FFFF", "CCCC", "SSSS", "CFSF"):
        shape = shape_of(sides)
        found = wavenumbers2(shape, wavenumber(8e3))
        cuts = np.linspace(5e3, 8e3, 10)
        counts = [np.searchsorted(found, wavenumber(hz) ** 2) + shape.rigid for hz in cuts]
        expected = [mode_count(shape.lengths_m, shape.ends, 0.208, wavenumber(hz)) for hz in cuts]
        assert np.mean(counts) == pytest.approx(np.mean(expected), abs=2.0), sides


def test_modes_of_a_board_are_in_closed_form_only_where_all_edges_are_simply_supported():
    assert isinstance(modes_of(BOARD, 2e3), SimplySupported)
    spelt = msgspec.structs.replace(BOARD, plate=plate_of("SSSS"))
    assert isinstance(modes_of(spelt, 2e3), SimplySupported)
    free = modes_of(msgspec.structs.replace(BOARD, plate=plate_of("FFFF")), 2e3)
    assert isinstance(free, RitzModes)
    assert free.condition > 1e3


def test_more_than_a_basis_can_give_is_refused_with_the_limit():
    floor = msgspec.structs.replace(PAPER, length_mm=4000.0, width_mm=3000.0, thickness_mm=20.0, edges="free")
    with pytest.raises(ConfigError, match=r"are computed up to 3.31e[+]04 Hz on this plate, not to 100000 Hz: take edges"):
        RitzModes.of(floor, 100e3)
    with pytest.raises(ConfigError, match="more than 30000 modes below 100000 Hz: too large or too thin"):
        RitzModes.of(msgspec.structs.replace(floor, thickness_mm=1.0), 100e3)
    with pytest.raises(ConfigError, match="no mode below 50 Hz"):
        RitzModes.of(plate_of("CCCC"), 50.0)


def test_a_basis_without_some_of_the_modes_is_noticed(monkeypatch):
    small = ritz.plate_functions
    monkeypatch.setattr(ritz, "plate_functions", lambda plate, k: small(plate, k * 0.25))
    with pytest.raises(ConfigError, match=r"plate.edges: \d+ modes were found where 1\d\d to 1\d\d are expected"):
        ritz.solve(shape_of("FFFF"), wavenumber(SMALL_HZ))


EVERY = st.sampled_from("SCFE")
STIFFER = {"F": "FESC", "E": "E", "S": "SC", "C": "C"}  # what holds at least as much; a strip also holds the plate beside the edge


@settings(max_examples=6, derandomize=True)
@given(
    st.lists(EVERY, min_size=4, max_size=4),
    st.lists(st.integers(0, 3), min_size=4, max_size=4),
    st.floats(0.05, 0.3),
    st.floats(0.05, 0.3),
    st.floats(0.0, 0.49),
    st.floats(1.0, 11.0),
)
def test_any_plate_has_sorted_orthonormal_modes_that_rise_with_what_holds_it(sides, choice, length, width, poisson_ratio, log_foam):
    highest_k = 18.0 / (length * width) ** 0.5
    lengths, foam = (length, width), 10.0**log_foam
    shape = shape_of("".join(sides), lengths, poisson_ratio, foam if "E" in sides else 0.0, 0.1 * min(lengths))
    held = [STIFFER[side][number % len(STIFFER[side])] for side, number in zip(sides, choice, strict=True)]
    stiffer = shape_of("".join(held), lengths, poisson_ratio, 3 * foam if "E" in held else 0.0, 0.1 * min(lengths))
    solution = ritz.solve(shape, highest_k)
    for found in solution.classes:
        assert np.all(np.diff(found.wavenumber4) >= 0)
        assert np.all(found.wavenumber4 > 0)
        flat = found.coefficients.transpose(1, 0, 2).reshape(found.wavenumber4.size, -1) / (length * width) ** 0.5
        assert flat @ flat.T == pytest.approx(np.eye(len(flat)), abs=1e-9)
        assert np.all((found.foam_share >= 0) & (found.foam_share <= 1))
    low = np.concatenate([np.zeros(shape.rigid), wavenumbers2(shape, highest_k)])
    high = np.concatenate([np.zeros(stiffer.rigid), wavenumbers2(stiffer, highest_k)])
    assert high.size <= low.size
    assert np.all(low[: high.size] <= high * (1 + 4e-4)), "what holds an edge raises every frequency"


def test_poles_and_forces_of_every_pair_of_edges_are_finite():
    for a, b in itertools.combinations("SCFE", 2):
        board = msgspec.structs.replace(BOARD, plate=plate_of(a + b + b + a))
        modes = modes_of(board, 2e3)
        step = StepResponse.of(modes, DriverResponse.of(board.driver))
        assert np.isfinite(step.static).all()
        assert np.isfinite(step.residues).all()
        assert np.isfinite(channel_forces(board, modes)).all()
        assert ritz.longest_matrix(plate_shape(board.plate), wavenumber(100e3)) < ritz_modes.LONGEST_MATRIX


def test_a_focus_of_a_plates_own_model_is_whole_on_its_twin_and_lost_on_one_with_other_edges():
    """A ninth of the paper's plate on foam: words by impulse responses, evaluated by the twin's steps at ticks."""
    board = small_board()
    board = msgspec.structs.replace(board, plate=plate_of("ECEF", board.plate))
    point = (0.031, 0.022)
    model, twin = ResponseModel(board), PlateTwin(board)
    assert model.plate_modes is twin.modes
    words = focus(model.drive_order_responses([point]), [1.0], board.idle_word)
    capture = capture_of_words(words, board.bit_ticks, board.idle_word, board.link.clock_hz // 10)  # at rest by then
    (field,) = twin.fields(capture, board.link.clock_hz)
    assert field.at([point])[0] == pytest.approx(twin.reference_amplitude(*point), rel=1e-6)
    clamped = PlateTwin(msgspec.structs.replace(board, plate=plate_of("CCCC", board.plate)))
    (other,) = clamped.fields(capture, board.link.clock_hz)
    lost = other.at([point])[0] / field.at([point])[0]
    print(f"focus on its own plate {1e6 * field.at([point])[0]:.2f} um, on the clamped one {lost:.2f} of it")
    assert abs(lost) < 0.5
