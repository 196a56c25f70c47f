"""What banks state: more error never narrows, bad numbers are refused, and who says nothing says why."""

import math
from datetime import date

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_plate import WHOLE, small_board
from tables import each_row

from controller.device.bank.expectation import Z95, Expectation, Interval, anywhere, in_words, lags_s
from controller.device.bank.file_format import Header
from controller.device.bank.grid import Grid
from controller.device.bank.provenance import Provenance, as_parameter, why_unknown
from controller.device.board.devices import Temperature
from controller.device.board.identity import panel_identity, simulated_identity

BOARD = small_board()
TODAY = date(2026, 11, 27)
HERE = "0123456789abcdef"
MEASURED = Provenance("measured", "waves", date="2026-11-01T10:00:00Z", temperature_c=23.0, foreseen=(0.0, 0.02), panel=HERE)
SENSOR = Temperature(kind="hwmon", device="a sensor", coefficient_per_k=-2e-4)
WARM = msgspec.structs.replace(BOARD, temperature=SENSOR)


def header(made=MEASURED, places_um=(3.0, 4.0, 5.0), **more):
    parameters = {"amplitude_um": places_um, "responses": None if made is None else as_parameter(made)} | more
    return Header("", BOARD.digest(), Grid.of(BOARD.plate, 4e-3), 500e3, BOARD.waveform.samples, 1, parameters)


def expected(board=BOARD, panel=HERE, today=TODAY, **of_header):
    return Expectation.of(header(**of_header), board, panel, today)


def made(**changes):
    return msgspec.structs.replace(MEASURED, **changes)


def test_what_is_stated_of_a_bank_of_this_plate():
    whole = expected()
    assert whole.cause == ""
    low_um, middle_um, high_um = whole.free(None)
    assert (low_um, middle_um, high_um) == pytest.approx((2.93, 3.99, 5.07), abs=0.05)  # by hand: 25 % of places, 6 % of all else
    low_um, middle_um, high_um = whole.felt(None)
    assert middle_um == pytest.approx(4.0 * math.exp(-1.158) * 0.45, rel=0.05)  # 90 mg
    assert 2.5 < high_um / low_um < 4
    known = whole.felt(None, mass_kg=(90e-6, 90e-6))
    assert low_um < known.low_um < known.high_um < high_um
    assert whole.free(None).times(0.5) == pytest.approx(tuple(value / 2 for value in whole.free(None)))


def wider(one, other):
    """Whether the second interval reaches as far down, and is as wide by its ratio."""
    return other.low_um <= one.low_um * (1 + 1e-9) and other.high_um / other.low_um >= one.high_um / one.low_um * (1 - 1e-9)


MORE = {
    "places": lambda more: {"places_um": (3.0 / (1 + more), 4.0, 5.0 * (1 + more))},
    "leave-out error": lambda more: {"made": made(foreseen=(0.0, 0.02 + more / 10))},
    "leave-out bias": lambda more: {"made": made(foreseen=(-more / 10, 0.02))},
    "age": lambda more: {"made": made(date=f"{2026 - round(more):04}-11-01")},
    "no date": lambda _: {"made": made(date=None)},
    "a date to come": lambda _: {"made": made(date="2031-01-01")},
    "detuning": lambda more: {"made": made(temperature_c=23.0 - 10 * more)},
    "no temperature": lambda _: {"made": made(temperature_c=None)},
    "no sensor": lambda _: {"board": BOARD},
}


@given(st.sampled_from(sorted(MORE)), st.floats(0, 3), st.floats(0, 3), st.integers(1, 6), st.integers(0, 5))
def test_more_error_never_narrows(name, some, more, foci, others):
    less, greater = (expected(**({"board": WARM} | MORE[name](much))) for much in sorted((some, some + more)))
    if name in ("no date", "a date to come", "no temperature", "no sensor"):
        less = expected(board=WARM)
    assert wider(less.free(23.0, foci), greater.free(23.0, foci))
    assert wider(less.felt(23.0, foci, others), greater.felt(23.0, foci, others))
    low_kg, high_kg = 50e-6, 90e-6
    lighter, heavier = low_kg / (1 + some), min(high_kg * (1 + more), 1e-2)
    assert wider(less.felt(None, mass_kg=(low_kg, high_kg)), less.felt(None, mass_kg=(lighter, heavier + low_kg - lighter)))
    assert wider(less.felt(None, foci, others), less.felt(None, foci + 1, others + 1))


@each_row("wrong", [
    {"foci": 0}, {"foci": -1}, {"others": -1}, {"mass_kg": (2e-4, 1e-4)}, {"mass_kg": (-1e-6, 1e-4)}, {"mass_kg": (math.nan, 1e-4)},
    {"mass_kg": (0.0, math.inf)},
])  # fmt: skip
def test_bad_numbers_are_refused(wrong):
    with pytest.raises(ValueError, match="must be"):
        expected().felt(None, **wrong)


@each_row("places_um", [
    None, [], "4", [3, 4], [3, 4, 5, 6], [5, 4, 3], [0, 4, 5], [-1, 4, 5], [3, 4, 1e9], [3, math.nan, 5],
    [3, 4, math.inf], [3, 4, None],
])  # fmt: skip
def test_a_bank_that_says_no_amplitude_states_nothing(places_um):
    assert expected(places_um=places_um) is None
    assert "no amplitude is stated" in in_words(None)


@each_row("unknown, panel, said", [
    (None, HERE, "does not say where"),
    (Provenance("modelled", "a plate"), HERE, "from a model"),
    (made(foreseen=None), HERE, "how well"),
    (made(panel=None), HERE, "which panel"),
    (MEASURED, None, "machine-id"),
    (MEASURED, "fedcba9876543210", "another panel (0123456789abcdef, not fedcba9876543210)"),
])  # fmt: skip
def test_a_bank_that_may_be_of_another_plate_states_only_a_most_and_why(unknown, panel, said):
    assert said in why_unknown(unknown, panel)
    whole, known = expected(made=unknown, panel=panel), expected()
    assert said in whole.cause
    for mine, theirs in ((whole.free(None), known.free(None)), (whole.felt(None), known.felt(None))):
        assert mine.low_um == 0
        assert mine.middle_um is None
        assert mine.high_um > theirs.high_um
    figures = whole.figures()
    assert figures["cause"] == whole.cause
    assert f"µm at most of a pulse; no lower bound: {whole.cause}" in in_words(figures)


def test_a_reading_that_is_none_counts_as_none():
    whole = expected(board=WARM)
    assert whole.free(math.nan) == whole.free(None) != whole.free(23.0)


def test_a_pad_on_other_waves_is_not_spoken_of():
    assert expected(wave_scale=1.1).felt(None).middle_um is not None
    assert expected(wave_scale=1.5).felt(None) == Interval(0.0, None, expected().free(None).high_um)


@each_row("x_m, y_m, says", [(35e-3, 25e-3, True), (4e-3, 25e-3, False), (35e-3, 46e-3, False), (67e-3, 25e-3, False)])
def test_nothing_is_said_of_the_rim(x_m, y_m, says):
    assert expected().says(x_m, y_m) is says


@each_row("far, deviation", [(1.0, 0.0), (1.0, 0.1), (1.0, 0.3), (1.0, 1.0), (0.1, 1.0)])
def test_a_uniform_error_adds_to_a_normal_one(far, deviation):
    random = np.random.default_rng(1)
    true = np.quantile(abs(far * random.uniform(-1, 1, 400_000) + deviation * random.standard_normal(400_000)), 0.95)
    square = (Z95 * deviation) ** 2
    assert math.sqrt(square + anywhere(far, square)) == pytest.approx(true, rel=0.01)


@each_row("duration, decay", [(0.8e-3, 1e-3), (2e-3, 1e-3), (2e-3, 0.2e-3), (1e-3, 1.0)])
def test_lags_are_means_over_what_is_left(duration, decay):
    times = (np.arange(100_000) + 0.5) * duration / 100_000
    left = np.exp(-times / decay)
    assert lags_s(duration, decay) == pytest.approx(
        ((times * left).sum() / left.sum(), (times**2 * left).sum() / left.sum()), rel=1e-3
    )


def test_identities_tell_panels_apart(tmp_path):
    file = tmp_path / "machine-id"
    assert panel_identity(file) is None
    file.write_text("uninitialized\n")
    assert panel_identity(file) is None
    file.write_text("0123456789abcdef0123456789abcdef\n")
    one = panel_identity(file)
    assert len(one) == 16
    assert one not in file.read_text()  # machine-id(5): it does not leave the computer
    file.write_text("1123456789abcdef0123456789abcdef\n")
    assert panel_identity(file) != one
    assert simulated_identity(BOARD) == simulated_identity(small_board()) != simulated_identity(WHOLE)
