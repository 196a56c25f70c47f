"""What is measured around a focus, on drivers and plates of every size."""

import numpy as np
import pytest
from stress.boards import changed, focus_on, scaled
from tables import each_row

from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.fpga.capture import Capture
from controller.workshop.physics.field import AROUND_S, CREST_M, LINE_M, MAP_STEP_M, OUTSIDE_M, FocusScale
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.word_capture import capture_of_words

POINT = (0.08, 0.06)
FEW_HZ = 12e3  # some 220 modes: arithmetic is the same for all


@each_row("inductance_h", [1e-9, 1e-7, 1e-5, 6.8e-3, 1.0])
@each_row("resistance_ohm", [1.0, 2000.0])
def test_the_time_around_a_focus_is_that_of_foci_then_whatever_the_coil(board, inductance_h, resistance_ohm):
    """A driver that forgets within nanoseconds was stepped back through the 5 us before T: 1e103 m for 10 uH."""
    panel = changed(board, driver={"inductance_h": inductance_h, "resistance_ohm": resistance_ohm})
    twin, clock_hz = PlateTwin(panel, FEW_HZ), panel.link.clock_hz
    words = np.random.default_rng(7).integers(0, 1 << 32, 1000, np.uint64).astype(np.uint32)
    emission = capture_of_words(words, panel.bit_ticks, panel.idle_word, clock_hz // 50)
    end = int(emission.focus_ticks[0])
    u = next(twin.fields(emission, clock_hz)).around(POINT)
    for offset_s in (-5e-6, -3.7e-6, -1e-6, 0.0, 1e-6, 4.4e-6):
        at = np.array([end + round(offset_s * clock_hz)], np.uint64)
        shifted = Capture(ticks=emission.ticks, words=emission.words, hv=emission.hv, focus_ticks=at)
        then = next(twin.fields(shifted, clock_hz)).at(POINT)[0]
        assert u[np.argmin(abs(AROUND_S - offset_s))] == pytest.approx(then, abs=1e-9 * np.abs(u).max())


def test_the_scale_of_the_shipped_boards_is_exactly_that_of_the_paper(board):
    scale = FocusScale.of(board)
    assert (scale.outside_m, scale.map_step_m) == (OUTSIDE_M, MAP_STEP_M) == (10e-3, 2e-3)
    assert np.array_equal(scale.line_m, LINE_M)
    assert np.array_equal(scale.crest_m, CREST_M)
    assert np.array_equal(scale.around_s, AROUND_S)
    assert LINE_M[-1] - LINE_M[0] == pytest.approx(12e-3)


@pytest.mark.stress
@pytest.mark.parametrize("thickness_mm", [0.1, 5.0, 20.0])
def test_a_spot_is_as_wide_as_its_waves_and_measured_as_wide(board, thickness_mm):
    """A spot was never wider than 12 mm, and contrast began at 10 mm, on whatever plate."""
    larger = (thickness_mm / 0.5) ** 0.5  # the same modes at the same frequencies, only larger: k^2 goes with 1 / thickness
    panel = scaled(board, larger, thickness_mm)
    (row,), (small,) = (focus_on(some, [(POINT[0] * by, POINT[1] * by)])[1] for some, by in ((panel, larger), (board, 1.0)))
    waves = bending_wavelength_m(panel.plate, 45e3) / bending_wavelength_m(board.plate, 45e3)
    assert waves == pytest.approx(larger, rel=1e-9)
    assert row["spot_mm"] == pytest.approx(small["spot_mm"] * larger, rel=1e-3)
    assert row["spot_wavelengths"] == pytest.approx(small["spot_wavelengths"], rel=2e-3)
    assert row["spot_mm"] != pytest.approx(small["spot_mm"] * larger * 1.01, rel=1e-3)
    assert row["contrast"] == pytest.approx(small["contrast"], rel=5e-3), "the scale is rounded to three digits"
    assert row["peak_offset_us"] == pytest.approx(small["peak_offset_us"], abs=0.02)


def test_the_window_of_time_goes_with_the_period_of_the_band(board):
    """Within 5 us of T a wave of 3 kHz has no peak."""
    low = changed(
        board,
        plate={"thickness_mm": 2.0},
        waveform={"band_low_hz": 1e3, "band_high_hz": 5e3, "bit_clock_hz": 100e3, "duration_ms": 5.0},
    )
    assert FocusScale.of(low).around_s[-1] == pytest.approx(5e-6 * 15, rel=1e-3)
    _, (row,) = focus_on(low, [POINT])
    assert abs(row["peak_offset_us"]) < 75


@pytest.mark.parametrize("emissions", [20, pytest.param(1000, marks=pytest.mark.stress)])
def test_the_state_of_the_twin_after_a_million_samples_is_the_sum_of_a_geometric_series(board, emissions):
    """Emissions of 1,000 samples without a pause on a plate that rings for 10 s: each adds the same, and what was there decays.

    The twin steps its state from emission to emission; a thousand steps round to 1e-13 of it, so 1e-9 is ample.
    """
    ringing = changed(board, plate={"decay_time_ms": 10e3})
    twin, clock_hz = PlateTwin(ringing, FEW_HZ), ringing.link.clock_hz
    words = np.random.default_rng(8).integers(0, 1 << 32, 1000, np.uint64).astype(np.uint32)
    capture = capture_of_words(words, ringing.bit_ticks, ringing.idle_word, clock_hz // 50, ringing.emission_ticks, emissions)
    states = [field.pole_amplitudes for field in twin.fields(capture, clock_hz)]
    kept = np.exp(twin.step.poles * ringing.waveform.duration_s)
    added, more = states[6] - kept * states[5], emissions - 7
    expected = kept**more * states[6] + added * (1 - kept**more) / (1 - kept)
    largest = np.abs(expected).max()
    assert np.abs(states[-1] - expected).max() <= 1e-9 * largest
    off = np.exp(twin.step.poles * (ringing.waveform.duration_s + 1e-9))
    assert np.abs(off**more * states[6] + added * (1 - off**more) / (1 - off) - expected).max() > 1e-6 * largest
