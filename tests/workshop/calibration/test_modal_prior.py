"""Responses completed by the board's model, where its edges are those of the plate; nothing of it where they are not."""

import msgspec
import pytest
from small_plate import small_board
from workshop.calibration.true_plate import TruePlate, random_places

from controller.workshop.calibration.interpolate import interpolate
from controller.workshop.calibration.point_plan import scattered_points
from controller.workshop.physics.modes.plate_modes import modes_of

BOARD = small_board()
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


@pytest.mark.parametrize(("longer_mm", "wider_mm"), [(2.0, -1.0), pytest.param(0.0, 0.0, marks=pytest.mark.slow)])
def test_glass_of_another_size_is_found(longer_mm, wider_mm):
    """On a plate with free edges; nothing is said of glass that is as stated."""
    board = msgspec.structs.replace(BOARD, plate=msgspec.structs.replace(BOARD.plate, edges="free", theory="mindlin"))
    plate = TruePlate(board, 1.6, length_mm=70 + longer_mm, width_mm=50 + wider_mm)
    source, _ = interpolate(board, plate.learned(scattered_points(board, 60, 3e-3)), model=modes_of)
    if not longer_mm:
        assert source.size is None
        return
    assert source.size[:2] == pytest.approx((longer_mm, wider_mm), abs=0.15)
    assert 0 < max(source.size[2:]) < 0.15
