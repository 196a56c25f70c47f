"""The motion at all times against the plate twin, which knows one time, and against eq. (8) integrated over the plate."""

import numpy as np
import pytest
from small_plate import small_board

from controller.workshop.benchmark.paper.paper_energy import energy_over_time, scanned_energy_j
from controller.workshop.benchmark.paper.paper_panel import PaperPanel
from controller.workshop.physics.responses.modal_history import modal_energy, modal_history


@pytest.fixture(scope="module")
def panel():
    return PaperPanel(small_board(), seed=3, count=1)


def history(panel, parts=1, after=40):
    volts = panel.volts(panel.words[0], after=after, parts=parts)
    blocks = list(modal_history(panel.twin.step, panel.twin.forces, volts, panel.board.waveform.bit_period_s / parts))
    return np.concatenate([block.displacement for block in blocks]), np.concatenate([block.velocity for block in blocks])


def test_displacement_at_t_is_that_of_the_twin(panel):
    """The twin starts at 0 V, 40 time constants before: what is left of that step is 1e-17 of it."""
    displacement, _ = history(panel)
    at_end = displacement[panel.board.waveform.samples - 1]
    error = abs(at_end - panel.fields[0].modal).max() / abs(at_end).max()
    print(f"displacement at T: {error:.1e} off the twin")
    assert error < 1e-9


def test_bits_cut_into_parts_move_alike_and_velocity_is_the_slope(panel):
    whole, velocity = history(panel)
    fine, _ = history(panel, parts=20)
    assert fine[19::20] == pytest.approx(whole, abs=1e-9 * abs(whole).max())
    at = 20 * 300 + 9  # in the middle of a bit: no step beside it
    _, fine_velocity = history(panel, parts=20)
    slope = (fine[at + 1] - fine[at - 1]) / (2 * panel.board.waveform.bit_period_s / 20)
    error = abs(slope - fine_velocity[at]).max() / abs(velocity).max()
    print(f"velocity: {error:.1e} off the slope")
    assert error < 3e-4  # the slope's own, (w dt)^2 / 6 at 100 kHz: 7e-4 of the fastest modes, of which there is little


def test_potential_energy_at_t_is_that_of_equation_8_over_the_plate(panel):
    """Differences over h lose (k h)^2 / 6 of the curvature, twice: 2.4e-3 at 70 kHz and 0.1 mm; their limit by two steps."""
    energy = energy_over_time(panel, 0, after_s=1e-4)
    exact = energy.potential_j[panel.board.waveform.samples - 1]
    coarse, fine = (scanned_energy_j(panel, panel.fields[0], step_m) for step_m in (0.4e-3, 0.2e-3))
    found = fine + (fine - coarse) / 3
    print(f"potential energy: modes {exact * 1e6:.4f} µJ, eq. (8) integrated {found * 1e6:.4f} µJ")
    assert found == pytest.approx(exact, rel=4e-3)
    assert scanned_energy_j(panel, panel.fields[0], 2e-3) < 0.9 * exact


def test_energy_decays_with_half_of_tau_and_is_shared_between_both_kinds(panel):
    energy = energy_over_time(panel, 0, after_s=2e-3)
    total = energy.kinetic_j + energy.potential_j
    last = panel.board.waveform.samples - 1
    some = slice(last + 100, last + 1000)
    slope = np.polyfit(np.arange(900) * panel.board.waveform.bit_period_s, np.log(total[some]), 1)[0]
    assert -1 / slope == pytest.approx(panel.board.plate.decay_time_s / 2, rel=0.02)
    assert energy.kinetic_j[some].sum() == pytest.approx(energy.potential_j[some].sum(), rel=0.1)


def test_rest_has_no_energy(panel):
    motion = next(modal_history(panel.twin.step, panel.twin.forces, np.zeros((3, 32)), 2e-6))
    energy = modal_energy(panel.modes, motion)
    assert not energy.kinetic_j.any()
    assert not energy.potential_j.any()
