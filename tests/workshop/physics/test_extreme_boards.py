"""Boards at the edges of the range: each moves its focus by what the sign of its response promises, or is refused in one line."""

import copy

import numpy as np
import pytest
from tables import each_row

from controller.device.bank.packing import drive_words
from controller.device.board.board import as_board
from controller.device.board.lookup import data_folder
from controller.device.board.records import read_tables
from controller.device.board.relations.checked import judge
from controller.errors import ConfigError
from controller.workshop.physics.plate import mode_cut_hz
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.loaded_responses import words_source
from controller.workshop.physics.word_capture import volts_above_idle

TABLES = read_tables(data_folder("boards") / "simulated" / "board.toml")
SLOW_HZ = {"bit_clock_hz": 100e3, "duration_ms": 10.0}
FLOOR = {"length_mm": 4000.0, "width_mm": 3000.0, "thickness_mm": 20.0}
FLOOR_BAND = {**SLOW_HZ, "band_low_hz": 1e3, "band_high_hz": 8e3}
SMALL = {"length_mm": 60.0, "width_mm": 42.0}
MIXED = {"edges": {"x0": "clamped", "x1": "free", "y0": "simply_supported", "y1": "free"}}


def board_of(plate, waveform, **more):
    """The simulated board, its patches at their places relative to the plate."""
    tables = copy.deepcopy(TABLES) | more
    sides = [(plate | {})[name] / tables["plate"][name] if name in plate else 1 for name in ("length_mm", "width_mm")]
    for actuator in tables["actuators"]:
        actuator["x_mm"], actuator["y_mm"] = (actuator[name] * side for name, side in zip(("x_mm", "y_mm"), sides, strict=True))
        actuator["size_mm"] *= min(sides)
    tables["plate"] |= plate
    tables["waveform"] |= waveform
    tables["limits"]["max_edge_rate_hz"] = tables["waveform"]["bit_clock_hz"]
    tables["limits"]["longest_emission_ms"] = 10.0
    tables["bank"]["coarse"] = True
    board = as_board("", tables)
    refused = [one for one in judge(board).refused if one.startswith(("plate.", "waveform."))]
    if refused:
        raise ConfigError("; ".join(refused))
    return board


def weyl(plate, highest_hz):
    """Modes up to a frequency of a supported Kirchhoff plate, by area and perimeter."""
    stiffness = plate.young_modulus_pa * plate.thickness_m**3 / (12 * (1 - plate.poisson_ratio**2))
    k = np.sqrt(2 * np.pi * highest_hz) * (plate.density_kg_m3 * plate.thickness_m / stiffness) ** 0.25
    length, width = plate.length_m, plate.width_m
    return length * width * k**2 / (4 * np.pi) - 2 * (length + width) * k / (4 * np.pi) + 0.25


@pytest.mark.slow
@each_row(
    ("called", "plate", "waveform", "more"),
    [
        ("a plate of 0.2 mm, a stamp wide", {"length_mm": 30.0, "width_mm": 20.0, "thickness_mm": 0.2}, {}, {}),
        ("a floor", FLOOR, FLOOR_BAND, {}),
        ("one mm at 400 kHz", {**SMALL, "thickness_mm": 1.0}, {"bit_clock_hz": 1e6, "duration_ms": 0.2, "band_high_hz": 4e5}, {}),
        (
            "a thousandth of the bit clock",
            {**SMALL, "thickness_mm": 2.0},
            {"band_low_hz": 500.0, "band_high_hz": 5e3, "duration_ms": 2.0},
            {},
        ),
        ("as narrow as may be", {**SMALL, "thickness_mm": 2.0}, {"band_low_hz": 4e4, "band_high_hz": 40.2e3}, {}),
        ("incompressible", {**SMALL, "poisson_ratio": 0.49}, {}, {}),
        ("incompressible, mixed edges", {**SMALL, "thickness_mm": 2.0, "poisson_ratio": 0.49, **MIXED}, {}, {}),
        ("rings for 10 s", {**SMALL, "decay_time_ms": 1e4}, {}, {}),
        ("rings for a tenth of a millisecond", {**SMALL, "decay_time_ms": 0.1}, {}, {}),
        ("steepest, drifting most, under a finger", SMALL, {"slope": -2, "drift_percent": 2}, {"finger": {"mass_mg": 1000.0}}),
        ("one word", SMALL, {"duration_ms": 0.002}, {}),
    ],
)
def test_a_board_at_the_edge_of_the_range_focuses(called, plate, waveform, more):
    board = board_of(plate, waveform, **more)
    model = ResponseModel(board)
    if "edges" not in plate:
        assert model.modes == pytest.approx(weyl(board.plate, mode_cut_hz(board)), rel=0.1, abs=4), called
    point_m = [(0.37 * board.plate.length_m, 0.43 * board.plate.width_m)]
    source = words_source(board, model, model.plate_modes)
    words = drive_words(source.drive_order_responses(point_m, dtype=np.float64)[0], board.idle_word)
    whole = model.responses(point_m)[0, ::-1]
    reached_m = float(np.vdot(whole, volts_above_idle(board, words)))
    assert np.isfinite(reached_m), called
    assert abs(reached_m) > 1e-12, called
    bare = not more and not waveform.get("slope")
    if bare:
        assert PlateTwin(board, modes=model.plate_modes).reference_amplitude(*point_m[0]) == pytest.approx(abs(reached_m), rel=1e-6)


@each_row(
    ("plate", "waveform", "said"),
    [
        (SMALL, {"band_low_hz": 0.001}, "waveform.band_low_hz = 0.001 and band_high_hz = 70000: 1000 words"),
        (SMALL, {"band_low_hz": 40e3, "band_high_hz": 40001.0}, "make no band narrower than 200 Hz"),
        (SMALL, {"band_low_hz": float("nan")}, "waveform.band_low_hz = nan"),
        (SMALL, {"band_high_hz": 250e3}, "is not below half of bit_clock_hz"),
        (SMALL, {"bit_clock_hz": 2e6}, "is not 1 to 1000 samples"),
        (SMALL, {"slope": -2.1}, "slope = -2.1"),
        (SMALL, {"drift_percent": float("inf")}, "drift_percent = inf"),
        ({**SMALL, "thickness_mm": 20.0}, {}, "plate.thickness_mm = 20"),
        ({**SMALL, "poisson_ratio": 0.5}, {}, "plate.poisson_ratio = 0.5"),
        ({**SMALL, "decay_time_ms": 0.0}, {}, "plate.decay_time_ms = 0"),
        ({**FLOOR, "length_mm": 4001.0}, FLOOR_BAND, "plate.length_mm = 4001"),
        ({**FLOOR, "thickness_mm": 0.2}, {}, "modes"),
    ],
)
def test_a_board_beyond_the_range_is_refused_in_one_line(plate, waveform, said):
    with pytest.raises(ConfigError) as refused:
        ResponseModel(board_of(plate, waveform))
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)
