"""The calculator against the paper's numbers, an independent count and exact solutions; each tolerance refuses 1 % more."""

import math

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import trapezoid
from scipy.special import jv
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.plate.layers import PlateLayer
from controller.device.board.plate.parts import Parts
from controller.device.board.plate.plate import Damping, Foam, Plate
from controller.device.board.relations.bending_waves import (
    bending_stiffness,
    kirchhoff_wavelength_m,
    mindlin_shift,
    mindlin_wavelength_m,
)
from controller.errors import ConfigError
from controller.workshop.benchmark.stage.power import resistor_loss_j
from controller.workshop.physics.design import design
from controller.workshop.physics.design.design_figures import design_figures
from controller.workshop.physics.design.design_inputs import MOST_STEPS, NUMBERS, sweep
from controller.workshop.physics.design.find_design import GLASS_MM, find_designs
from controller.workshop.physics.felt import DETECTION_UM, LIGHT_TOUCH, SKIN_S, FeltLoad, felt_in_words
from controller.workshop.physics.focal_spectrum import FocalSpectrum

BOARD = load_board(find_board("simulated"))
GLASS = BOARD.plate
PHONE = {"length_mm": 150, "width_mm": 70, "thickness_mm": 0.3}
FLOOR = {
    "length_mm": 4000,
    "width_mm": 3000,
    "thickness_mm": 20,
    "band_low_hz": 1e3,
    "band_high_hz": 5e3,
    "size_mm": 40,
    "decay_time_ms": 20,
    "duration_ms": 30,
}


def same(found, wanted, tolerance, what):
    """Equal within a share of `wanted`, and no longer if found were 1 % larger or smaller."""
    print(f"{what}: {found:.6g}, reference {wanted:.6g} ({found / wanted - 1:+.2g}, tolerance {tolerance:g})")
    assert found == pytest.approx(wanted, rel=tolerance)
    assert found * 1.01 != pytest.approx(wanted, rel=tolerance)
    assert found / 1.01 != pytest.approx(wanted, rel=tolerance)


PAPERS = {  # digits that the paper prints, or that its own numbers give (shared facts): (value, half of its last digit)
    "eq. (2), Tc in ms": (lambda: design.characteristic_time_s(GLASS) * 1e3, 19.5, 0.05),
    "bound of eq. (1)": (lambda: design.contrast_bound(50e3, 19.54e-3), 31.3, 0.05),
    "eq. (1)": (lambda: design.contrast(50e3, 19.54e-3, 32, 2e-3, 1e-3), 24.3, 0.05),
    "eq. (4) in us": (lambda: design.gate_duration_s(70e3) * 1e6, 7.14, 0.005),
    "eq. (5) at 70 kHz in mm": (lambda: kirchhoff_wavelength_m(GLASS, 70e3) * 1e3, 8.45, 0.005),
    "eq. (6) of 7.68 um and 5.2 mm in uJ": (lambda: design.energy_j(GLASS, 7.68e-6, 5.2e-3) * 1e6, 35.8, 0.05),
    "eq. (6) of 7.68 um and 4.05 mm in uJ": (lambda: design.energy_j(GLASS, 7.68e-6, 4.05e-3) * 1e6, 59, 0.4),
    "repetition at Tr = tau": (lambda: design.repetition_factor(1e-3, 1e-3), 0.93, 0.005),
    "4 S / lambda^2 at 8.45 mm": (lambda: design.learning_points(GLASS, 8.45e-3), 1741, 1),
    "point impedance in kg/s": (lambda: design.point_impedance_kg_s(GLASS), 8.0, 0.05),
}


@each_row("what", PAPERS)
def test_equations_give_the_papers_numbers(what):
    formula, printed, half_digit = PAPERS[what]
    same(formula(), printed, half_digit / printed, what)


def test_a_finger_of_140_mg_leaves_70_percent_where_the_paper_says_so():
    """Section V-B: R^2 rho e = 66 mg."""
    plate = msgspec.structs.replace(GLASS, thickness_mm=66e-6 / (5e-3**2 * GLASS.density_kg_m3) * 1e3)
    same(design.gate_attenuation(plate, 140e-6, 5e-3), 0.70, 0.005, "eq. (7)")
    assert plate.thickness_mm == pytest.approx(1, rel=0.06), "about 1 mm, as the paper has it"


@each_row(("at_hz", "share"), [(20e3, 0.993617), (70e3, 0.978306), (100e3, 0.969532)])
def test_mindlins_waves_are_those_of_rayleigh_and_lamb(at_hz, share):
    """Frequency at the same wavenumber, against roots of the exact A0 equation for this plate."""
    same(1 - mindlin_shift(GLASS, at_hz), share, 3e-5, f"frequency over Kirchhoff's {at_hz:g} Hz")


def test_mindlins_wave_is_kirchhoffs_where_the_plate_is_thin():
    assert mindlin_wavelength_m(GLASS, 100.0) == pytest.approx(kirchhoff_wavelength_m(GLASS, 100.0), rel=1e-4)


@each_row(("changes", "high_hz"), [({}, 300e3), (PHONE, 300e3), (FLOOR, 30e3)], ids=["paper", "phone", "floor"])
def test_modes_in_the_band_are_those_that_are_counted(changes, high_hz):
    """Weyl's law; its next term, perimeter times wavenumber over 4 pi, is of simply supported edges. Thousands of modes: 0.45 %."""
    found = design_figures(BOARD, {**changes, "band_low_hz": 1e3, "band_high_hz": high_hz, "bit_clock_hz": 2e6, "size_mm": 2})
    plate = found["inputs"]
    around_m = 2e-3 * (plate["length_mm"] + plate["width_mm"])
    low, high = (2e3 * math.pi / found["wavelength_mm"][edge] for edge in ("low", "high"))
    same(found["modes_counted"], found["modes_in_band"] - around_m * (high - low) / (4 * math.pi), 0.0045, "modes")


def test_wavelengths_are_those_of_both_edges_and_the_middle_of_the_band():
    found = design_figures(BOARD, {"band_low_hz": 20e3, "band_high_hz": 80e3})
    for key, theory in (("wavelength_mm", kirchhoff_wavelength_m), ("mindlin_wavelength_mm", mindlin_wavelength_m)):
        expected = {"low": theory(BOARD.plate, 20e3), "middle": theory(BOARD.plate, 50e3), "high": theory(BOARD.plate, 80e3)}
        assert found[key] == pytest.approx({edge: 1e3 * length_m for edge, length_m in expected.items()})


def flat_focus(board):
    """A focus of a flat band: patches of no size drive k^2 = w alike, and the driver passes all."""
    driver = msgspec.structs.replace(board.driver, inductance_h=1e-9, resistance_ohm=1.0, capacitance_f=1e-12)
    return FocalSpectrum.of(board.plate, driver, 1e-6, (20e3, 70e3), 1e9)


def test_a_flat_spectrum_has_the_closed_forms_of_the_paper():
    flat = flat_focus(BOARD)
    same(flat.bandwidth_hz, 50e3, 1e-4, "bandwidth in Hz")
    same(flat.crossings_hz, 2 * math.sqrt((70e3**3 - 20e3**3) / (3 * 50e3)), 1e-4, "edges a second")
    counted = np.linspace(20e3, 70e3, 977)  # eq. (6) before its sum from 1 to N: modes of the band, all alike
    mass_kg = GLASS.density_kg_m3 * GLASS.thickness_m * GLASS.length_m * GLASS.width_m
    same(flat.energy_j(1e-6), mass_kg / 2 * float(((1e-6 / 977 * 2 * np.pi * counted) ** 2).sum()), 2e-3, "energy in J")
    assert flat.share_within(0.3) == pytest.approx(1, abs=0.02), "all of a spot is somewhere"
    assert flat.mass_attenuation(0) == pytest.approx(1, abs=1e-6)


@each_row("load", [LIGHT_TOUCH, FeltLoad(1.4e-4, 2.0, 5e3, 6.0)])
def test_what_a_finger_feels_is_that_of_a_pad_on_an_infinite_plate(load):
    """By the pad's transform, 8 J2(x) / x^2 of the paraboloid, the plate's receptance in wavenumbers, and sums in time."""
    flat, radius_m, amplitude_m = flat_focus(BOARD), load.pad_mm / 2e3, 7e-6
    stiffness, per_m2 = bending_stiffness(GLASS), GLASS.density_kg_m3 * GLASS.thickness_m
    frequency = np.linspace(20e3, 70e3, 1001)
    omega = 2 * np.pi * frequency
    own = np.sqrt(omega) * (per_m2 / stiffness) ** 0.25
    over_pad = lambda k: 8 * jv(2, k * radius_m) / (k * radius_m) ** 2  # noqa: E731
    k = np.linspace(0.1, 10e3, 40_001) + 0.05  # the rest's pole is taken out, with what it leaves beyond the last
    receptance = [
        (trapezoid(k * (over_pad(k) ** 2 - over_pad(at) ** 2) / (k**4 - at**4), k) - 0.25j * np.pi * over_pad(at) ** 2 / at**2)
        / (2 * np.pi * stiffness)
        for at in own[::50]
    ]
    loop = np.interp(omega, omega[::50], np.array(receptance)) * load.dynamic_stiffness(1j * omega)
    time_s = np.arange(-8e-4, 2e-4, 1e-6)
    pulse = np.array([trapezoid((over_pad(own) / (1 + loop) * np.exp(1j * omega * t)).real, frequency) for t in time_s]) / 50e3
    ago_s = time_s[:, None] - time_s
    squared = (np.exp(-np.maximum(ago_s, 0) / SKIN_S) * (ago_s >= 0)) @ (amplitude_m * pulse) ** 2 * 1e-6 / SKIN_S
    same(flat.felt_amplitude_m(amplitude_m, load), float(np.sqrt(2 * squared.max())), 0.005, "felt amplitude in m")


@each_row("stage", [{}, {"capacitance_f": 21e-9}, {"capacitance_f": 21e-9, "inductance_h": 0.65e-3, "resistance_ohm": 190.0}])
def test_resistors_burn_what_is_computed_for_random_bits_of_that_spectrum(stage):
    """Step by step, over 16 channels of 20 ms; never more than a square wave at resonance would, V^2 / 4 R."""
    driver = msgspec.structs.replace(BOARD.driver, **stage)
    spectrum = FocalSpectrum.of(GLASS, driver, 4.6e-3, (20e3, 70e3), 500e3)
    samples = 20_000
    bins = np.fft.rfftfreq(samples, 2e-6)
    spread = np.sqrt(np.interp(bins, spectrum.frequency_hz, spectrum.weight_s, 0, 0))
    random = np.random.default_rng(1)
    bits = np.fft.irfft(spread * (random.normal(size=(16, bins.size)) + 1j * random.normal(size=(16, bins.size)))).T > 0
    burnt_w = float(resistor_loss_j(driver, bits.astype(np.int8), 2e-6).mean()) / (samples * 2e-6)
    estimate_w = spectrum.resistor_w(driver, 500e3)
    same(estimate_w, burnt_w, 0.008, "resistor in W")
    assert estimate_w < driver.supply_v**2 / (4 * driver.resistance_ohm)


@each_row("changes", [{}, {"decay_time_ms": 0.3}, {"duration_ms": 0.8, "channels": 12}])
def test_contrast_background_energy_and_power_are_of_one_field(changes):
    found = design_figures(BOARD, changes)
    kinetic = found["kinetic_share"]
    background = 2 * kinetic / (1 - 2 * kinetic)  # over the spot's own part
    same(found["contrast"] ** 2 * (1 + background), found["modes_in_band"], 1e-9, "modes in the band")
    same(found["energy_of_band_uj"] * (1 + background), found["energy_with_background_uj"], 1e-9, "energy in uJ")
    duration_ms = changes.get("duration_ms", BOARD.waveform.duration_ms)
    same(found["energy_with_background_uj"] / duration_ms, found["mechanical_power_mw"], 1e-9, "power in mW")


def test_the_glass_that_a_finger_feels_most_is_neither_thin_nor_thick():
    """The moment grows with the glass, the deflection falls, and thin glass is stopped by the finger."""
    felt = {mm: design_figures(BOARD, {"thickness_mm": mm})["felt_um"] for mm in (0.3, 0.5, 0.8, 1.1, 2.0)}
    assert max(felt, key=felt.get) == 0.8
    assert felt[2.0] < felt[0.3] < felt[1.1]
    assert felt[2.0] < DETECTION_UM[1] < felt[1.1]
    assert design_figures(BOARD, {"thickness_mm": 2.0})["felt"] == felt_in_words(felt[2.0]) == "may be felt"


def test_what_follows_from_parts_follows_and_what_is_given_stands():
    own = msgspec.structs.asdict(BOARD.driver)
    assert design_figures(BOARD)["inputs"] == pytest.approx(design_figures(BOARD)["inputs"] | own)
    large = design_figures(BOARD, {"size_mm": 15})["inputs"]
    same(large["capacitance_f"], 2e-9 * (15 / 4.6) ** 2, 1e-9, "C of a larger patch")
    assert large["inductance_h"] * large["capacitance_f"] == pytest.approx(own["inductance_h"] * own["capacitance_f"])
    stands = design_figures(BOARD, {"size_mm": 15, "capacitance_f": 2e-9, "thickness_mm": 1, "moment_n_per_v": 1e-3})["inputs"]
    assert (stands["capacitance_f"], stands["moment_n_per_v"]) == (2e-9, 1e-3)
    assert stands["resistance_ohm"] == pytest.approx(own["resistance_ohm"])
    low = design_figures(BOARD, {"band_low_hz": 10e3, "band_high_hz": 35e3})["inputs"]
    assert low["inductance_h"] == pytest.approx(4 * own["inductance_h"])
    disc = design_figures(BOARD, parts=Parts(disc="7BB-20-6"))["inputs"]
    assert disc["capacitance_f"] == pytest.approx(2.5e-9)
    assert disc["size_mm"] / 4.6 == pytest.approx(14 / 9)


def test_a_tenth_more_supply_adds_a_tenth():
    gained = design_figures(BOARD)["gains_percent"]
    assert gained["supply_v"] == pytest.approx(10)
    assert gained["channels"] == pytest.approx(100 * 3 / 32)
    assert list(gained.values()) == sorted(gained.values(), reverse=True)


@each_row(("searched", "felt_um"), [(("thickness", "channels", "disc"), 0.88), (("channels",), 1.0), (("disc", "thickness"), 2.0)])
def test_a_search_finds_the_fewest_channels_that_reach_it(searched, felt_um):
    rows = find_designs(BOARD, {}, None, searched, felt_um)
    assert [row["channels"] for row in rows] == sorted(row["channels"] for row in rows)
    assert all(row["felt_um"] >= felt_um for row in rows)
    if "channels" in searched:
        for row in rows:
            fewer = {"thickness_mm": row["thickness_mm"], "channels": row["channels"] - 4}
            found = design_figures(BOARD, fewer, Parts(disc=row["disc"]))
            assert found["felt_um"] < felt_um


@pytest.mark.slow
def test_with_prices_the_cheapest_come_first_and_a_disc_without_a_price_is_left_out():
    """Five of the smaller discs are dearer than four of the larger; at three times their price they are not."""
    prices = {"channel": 4.0, "7BB-20-6": 0.8, "7BB-27-4": 1.1}
    rows = find_designs(BOARD, {}, None, ("thickness", "channels", "disc"), 0.88, prices)
    assert {row["disc"] for row in rows} == {"7BB-20-6", "7BB-27-4"}
    assert [row["cost"] for row in rows] == sorted(4.0 * row["channels"] + prices[row["disc"]] * row["discs"] for row in rows)
    assert rows[0]["disc"] == "7BB-27-4"
    dear = find_designs(BOARD, {}, None, ("thickness", "channels", "disc"), 0.88, prices | {"7BB-27-4": 10.0})
    assert dear[0]["disc"] == "7BB-20-6"
    anything = find_designs(BOARD, {}, None, ("channels", "disc"), 0.5, {"channel": 1.0})
    assert len({row["disc"] for row in anything}) > 2, "discs cost nothing"


def test_a_search_that_finds_nothing_gives_the_strongest():
    (row,) = find_designs(BOARD, {"supply_v": 5.0}, None, ("thickness", "disc"), DETECTION_UM[1])
    assert row["felt_um"] < DETECTION_UM[1]
    others = [design_figures(BOARD, {"supply_v": 5.0, "thickness_mm": mm}, Parts(disc=row["disc"])) for mm in GLASS_MM]
    assert row["felt_um"] == max(one["felt_um"] for one in others)


def test_what_the_paper_simplifies_is_warned_of_in_one_line_each():
    warnings = design_figures(BOARD)["warnings"]
    for said in (
        "1 - exp(-T/tau) = 0.865",
        "lower its frequency by 2.2 %",
        "8.45 mm",
        "59 µJ",
        "give 36 µJ",
        "tau / 2, 0.5 ms",
        "eq. (7)",
    ):
        assert sum(said in warning for warning in warnings) == 1, said
    assert all("\n" not in warning for warning in warnings)
    assert not any(warning.startswith("channels") for warning in warnings)
    assert "drives 32" in design_figures(BOARD, {"channels": 40})["warnings"][0]
    phone = " ".join(design_figures(BOARD, PHONE)["warnings"])
    assert "59 µJ" not in phone, "what the paper prints otherwise is of its own plate only"
    tiny = " ".join(design_figures(BOARD, {"length_mm": 12, "width_mm": 10})["warnings"])
    assert "modes in the band: equations of averages" in tiny
    assert "wavelengths wide" in tiny
    assert "not even Mindlin's" in " ".join(design_figures(BOARD, {"thickness_mm": 10})["warnings"])


def test_lengths_scale_with_the_wave_from_a_phone_to_a_floor():
    phone, floor = (design_figures(BOARD, changes)["in_wavelengths"] for changes in (PHONE, FLOOR))
    for found in (phone, floor):
        assert 0.4 < found["spot"] < 0.6
        assert found["width"] > 5


RANGES = {
    "length_mm": (5, 20e3),
    "thickness_mm": (0.02, 200),
    "young_modulus_pa": (1e8, 2e12),
    "density_kg_m3": (10, 30e3),
    "decay_time_ms": (0.01, 100e3),
    "band_low_hz": (1, 1e6),
    "duration_ms": (1e-3, 10e3),
    "finger_mg": (0, 1e9),
    "channels": (1, 100_000),
    "inductance_h": (1e-12, 1e3),
}


def with_plate(**changes):
    return msgspec.structs.replace(BOARD, plate=msgspec.structs.replace(GLASS, **changes))


def test_a_board_whose_modes_decay_unlike_has_the_decay_of_its_band():
    """A loss factor of 0.01 adds pi f times it to 1 / tau; Tc modes per hertz, so half of them are below the band's middle."""
    decay_ms = design_figures(with_plate(damping=Damping(loss_factor=0.01)))["inputs"]["decay_time_ms"]
    same(decay_ms, 1e3 / (1e3 + math.pi * 0.01 * 45e3), 0.005, "decay in ms")


def test_layers_count_as_one_plate_until_its_material_or_thickness_is_asked_for():
    halves = (PlateLayer(thickness_mm=0.25, young_modulus_pa=72.9e9, poisson_ratio=0.208, density_kg_m3=2510.0),) * 2
    names = ("length_mm", "width_mm", "edges", "decay_time_ms")
    layered = msgspec.structs.replace(BOARD, plate=Plate(**{name: getattr(GLASS, name) for name in names}, layers=halves))
    for changes in ({}, {"length_mm": 250}, {"thickness_mm": 0.8}):
        assert design_figures(layered, changes)["tc_ms"] == pytest.approx(design_figures(BOARD, changes)["tc_ms"], rel=1e-9)


def test_foam_that_leaves_nothing_of_a_smaller_plate_is_refused():
    foamy = with_plate(edges="foam", foam=Foam(stiffness_n_m3=1e9, width_mm=9.0))
    with pytest.raises(ConfigError, match=r"plate\.foam\.width_mm = 9 leaves nothing of length_mm = 15 free"):
        design_figures(foamy, {"length_mm": 15})


def figures_or_line(changes):
    try:
        return design_figures(BOARD, changes)
    except ConfigError as error:
        return str(error)


@settings(max_examples=12, deadline=None, derandomize=True)
@given(st.fixed_dictionaries({}, optional={name: st.floats(*ends) for name, ends in RANGES.items()}))
def test_any_number_gives_finite_figures_or_one_line(changes):
    found = figures_or_line(changes)
    if isinstance(found, str):
        assert "\n" not in found
        assert any(name in found for name in NUMBERS)
    else:
        msgspec.json.encode(found)
        assert all(math.isfinite(value) for value in found.values() if isinstance(value, float))


@each_row("text", ["thickness_mm", "thickness_mm=1:2", "thickness_mm=1:2:0", "thickness_mm=2:1:1", "thick=1:2:1",
                                  "thickness_mm=nan:2:1", "thickness_mm=0:inf:1", f"thickness_mm=0:{MOST_STEPS}:1"])  # fmt: skip
def test_a_sweep_that_is_none_is_refused(text):
    with pytest.raises(ConfigError, match="--sweep"):
        sweep(text)


def test_a_sweep_has_both_ends():
    assert sweep("thickness_mm=0.3:2:0.1")[1] == pytest.approx(np.arange(3, 21) / 10)
    assert sweep("channels=32:8:-8") == ("channels", [32.0, 24.0, 16.0, 8.0])
