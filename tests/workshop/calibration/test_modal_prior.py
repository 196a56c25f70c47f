"""Responses completed by the board's model, where its edges are those of the plate; nothing of it where they are not."""

import msgspec
import numpy as np
import pytest
from small_plate import small_board
from workshop.calibration.true_plate import TruePlate, random_places

from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.interpolation.plate_size import GlassSize, fit_size
from controller.workshop.calibration.point_plan import scattered_points
from controller.workshop.physics.modes.plate_modes import modes_of

BOARD = small_board()
FREE = msgspec.structs.replace(BOARD, plate=msgspec.structs.replace(BOARD.plate, edges="free", theory="mindlin"))
POINTS_M = scattered_points(BOARD, 52, 2e-3)


@pytest.mark.parametrize("edges", ["simply_supported", pytest.param("clamped", marks=pytest.mark.slow)])
def test_a_model_with_the_right_edges_completes_few_points_and_another_is_not_used(edges):
    """0.5 % of frequency off; clamped edges are not the board's. Waves alone keep 0.978 of these 52 points."""
    plate = TruePlate(BOARD, 1.6, edges=edges, young_modulus_pa=1.01 * BOARD.plate.young_modulus_pa)
    source, _ = interpolate(BOARD, plate.learned(POINTS_M), model=modes_of)
    shares = plate.kept(source, random_places(BOARD, 20, 3e-3)).mean()
    print(f"{edges}: kept {shares:.4f}; {source.provenance.in_words()}")
    if edges == "simply_supported":
        assert source.provenance.kind == "completed"
        assert "simply supported, decay 1 ms" in source.provenance.model
        assert shares > 0.985
    else:
        assert source.provenance.kind == "measured"
        assert source.size is None, "smaller glass is like clamped edges, not much better than waves"
        assert 0.97 < shares < 0.985


OTHERS = [(2.0, -1.0, 2), (2.0, -1.0, 3), (-1.5, 0.0, 4), (0.0, 0.0, 5)]
SIZES = [(2.0, -1.0, 1), *(pytest.param(*one, marks=pytest.mark.slow) for one in OTHERS)]


@pytest.mark.slow
@pytest.mark.parametrize(("longer_mm", "wider_mm", "seed"), SIZES)
def test_glass_of_another_size_is_found_within_two_stated_errors(longer_mm, wider_mm, seed):
    """On a plate with free edges; nothing is said of glass that is as stated."""
    plate = TruePlate(FREE, 1.6, length_mm=70 + longer_mm, width_mm=50 + wider_mm)
    source, _ = interpolate(FREE, plate.learned(scattered_points(FREE, 60, 3e-3, seed=seed), seed=seed), model=modes_of)
    if not longer_mm:
        assert source.size is None
        return
    print(source.size.in_words())
    off_mm = np.subtract(source.size[:2], (longer_mm, wider_mm))
    assert (np.abs(off_mm) < 2 * np.array(source.size[2:])).all()
    assert max(source.size[2:]) < 0.05


def test_a_skew_valley_has_its_lowest_place_where_it_is():
    """A parabola through its half millimetres puts it 0.05 mm beside, in all bins alike."""

    def left(there):
        off_mm = np.array([there.plate.length_mm - 71.3, there.plate.width_mm - 49.2])
        skew = 0.04 + (off_mm**2 * (0.05 + 0.03 * np.clip(off_mm, -1, 1))).sum()
        return skew * np.ones(8)

    size = fit_size(BOARD, left)
    assert size[:2] == pytest.approx((1.3, -0.8), abs=0.01)
    assert size[2:] == pytest.approx((0, 0), abs=1e-12)


def test_what_the_frame_leaves_open_the_size_does_too():
    """On this plate points 0.07 mm beside made it 0.09 mm longer, at six standard deviations."""
    size = GlassSize(2.0, -1.0, 0.03, 0.04).in_frame((0.02e-3, 0.0))
    assert size == pytest.approx((2.0, -1.0, np.hypot(0.03, 0.03), 0.04))
