"""Methods under test: packing of few bits, interpolation, baseband, and that each gives words for its points."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.grid import Grid
from controller.workshop.benchmark.methods.baseband import pulse_matrix
from controller.workshop.benchmark.methods.interpolation import BandInterpolation, bilinear, block, cubic, nearest
from controller.workshop.benchmark.methods.response_table import decay, pack, unpack


@given(st.integers(0, 2**32 - 1), st.sampled_from([(8, 0.02), (4, 0.15), (2, 0.40), (1, 0.65)]))
def test_packed_values_are_near_those_given(seed, expected):
    bits, error = expected
    values = np.random.default_rng(seed).normal(size=(3, 4000)) * np.array([[1e-9], [1.0], [1e6]])
    packed, scale = pack(values, bits)
    assert packed.shape == (3, 4000 * bits // 8)
    found = unpack(packed, bits) * scale[:, None]
    off = np.sqrt(((found - values) ** 2).mean(axis=1) / (values**2).mean(axis=1))
    assert (off < error).all()
    assert (np.sign(found) == np.sign(values)).mean() > 0.95


def test_silence_is_packed_as_next_to_nothing():
    for bits in (8, 4, 2, 1):
        packed, scale = pack(np.zeros((2, 16)), bits)
        assert np.abs(unpack(packed, bits) * scale[:, None]).max() < 1e-20


@given(st.integers(1, 40), st.floats(-5, 50), st.sampled_from([1, 4, 8]))
def test_a_block_of_cells_is_within_the_grid_and_around_the_position(count, position, size):
    indices, offset = block(count, position, size)
    assert len(indices) == min(size, count)
    assert indices[0] >= 0
    assert indices[-1] < count
    assert indices[0] + offset == pytest.approx(min(max(position, 0), count - 1))


@each_row("interpolation", [nearest, bilinear, cubic, "band 4"])
def test_on_a_cell_its_own_response_is_taken(small_board, small_model, interpolation):
    grid = Grid.of(small_board.plate, 3.5e-3)
    if isinstance(interpolation, str):
        interpolation = BandInterpolation(small_board, small_model.plate_modes, int(interpolation[-1]))
    for cell in (0, grid.nx - 1, 5 * grid.nx + 7, grid.cells - 1):
        stencil = interpolation(grid, *grid.place(cell))
        assert stencil.weights[stencil.cells == cell].sum() == pytest.approx(1, abs=2e-2)
        assert np.abs(stencil.weights[stencil.cells != cell]).sum() < 5e-2


def test_higher_order_interpolates_the_model_better(small_board, small_model):
    """Between cells of 3.5 mm: 0.4 of the longest wavelength that the product's bilinear interpolation would take."""
    grid = Grid.of(small_board.plate, 3.5e-3)
    place = (0.0417, 0.0332)
    exact = small_model.drive_order_responses([place])[0]
    errors = []
    four, eight = (BandInterpolation(small_board, small_model.plate_modes, size) for size in (4, 8))
    for interpolation in (nearest, bilinear, cubic, four, eight):
        stencil = interpolation(grid, *place)
        found = np.tensordot(stencil.weights, small_model.drive_order_responses(grid.points()[stencil.cells]), 1)
        errors.append(np.abs(found - exact).mean() / np.abs(exact).mean())
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 0.15 * errors[1]


def test_baseband_keeps_a_response_at_a_seventh_of_the_rate(small_board, small_model):
    pulses = pulse_matrix(small_board.waveform, 7)
    flat = small_model.drive_order_responses([(0.0417, 0.0332)], dtype=np.float64)[0] / decay(small_board)[::-1, None]
    again = pulses @ (np.linalg.pinv(pulses) @ flat)
    assert np.abs(again - flat).max() < 0.03 * np.abs(flat).max()
    assert pulses.shape[1] < 0.33 * len(pulses)
