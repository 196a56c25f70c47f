"""The figures of issue 2, at random points of which none is left out: 5, and 20 in the slow form."""

import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.benchmark.focus.focus_figures import MARGIN_M, figures, random_points, spread
from controller.workshop.physics.design.design_figures import design_figures

BOARD = load_board(find_board("simulated"))


@pytest.fixture(scope="module", params=[5, pytest.param(20, marks=pytest.mark.slow)])
def measured(request):
    return figures(BOARD, seed=1, points=request.param)


@pytest.mark.slow
@each_row(
    ("figure", "least", "most"),
    [("contrast", 25, 43), ("contrast_all", 18, 27), ("spot_mm", 4.8, 6.3), ("peak_offset_us", -1, 1), ("amplitude_um", 7, 9)],
)
def test_every_single_focus_is_within_range(measured, figure, least, most):
    assert least <= measured["single"][figure]["min"]
    assert measured["single"][figure]["max"] <= most


def test_each_of_four_foci_has_its_share(measured):
    share = measured["four_foci"]["share"]
    assert 0.36 <= share["min"] <= share["max"] <= 0.54
    assert measured["four_foci_near_edges"]["share"]["min"] >= 0.36


def test_two_methods_agree_on_the_amplitude(measured):
    for idling in ("single", "single_all_idle_low"):
        assert measured[idling]["relative_amplitude"]["min"] == pytest.approx(1, abs=1e-9)
        assert measured[idling]["relative_amplitude"]["max"] == pytest.approx(1, abs=1e-9)


def test_the_balanced_idle_word_is_worth_its_contrast_and_its_silence(measured):
    balanced, low = measured["single"], measured["single_all_idle_low"]
    assert low["contrast"]["median"] < 0.65 * balanced["contrast"]["median"]
    assert low["audible_m2_per_s"]["median"] > 1.2 * balanced["audible_m2_per_s"]["median"]


def test_float32_is_enough_for_the_bank(measured):
    assert measured["float32"]["bits_differing"]["max"] <= 1e-3
    assert measured["float32"]["amplitude_ratio"]["min"] >= 0.9999


@each_row(
    ("estimate", "figure", "within"),
    [
        ("possible_amplitude_um", "amplitude_um", 0.12),
        ("contrast_all", "contrast_all", 0.08),
        ("contrast_outside", "contrast", 0.15),
        ("spot_mm", "spot_mm", 0.02),
    ],
)
def test_the_calculator_foresees_what_is_simulated(measured, estimate, figure, within):
    """Its statistics of modes against all modes of the plate: bits ring on into words, and patches stand near edges."""
    estimated, simulated = design_figures(BOARD)[estimate], measured["single"][figure]["median"]
    print(f"{figure}: design {estimated:.4g}, simulated {simulated:.4g} ({estimated / simulated - 1:+.1%}, within {within:.0%})")
    assert estimated == pytest.approx(simulated, rel=within)


def test_points_are_ten_millimetres_from_every_edge():
    points = random_points(BOARD, 1, 1000)
    assert points.min() >= MARGIN_M
    assert points.max(0) == pytest.approx([0.200, 0.138], abs=1e-3)
    assert spread([3.0, 1.0, 2.0]) == {"min": 1.0, "median": 2.0, "max": 3.0}
