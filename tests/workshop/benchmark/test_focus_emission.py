"""Figures of an emission against other ways to them: sums over modes against maps, closed forms against what is played."""

import numpy as np
import pytest

from controller.device.bank.packing import channel_bits
from controller.workshop.benchmark.focus.focus_emission import (
    emission_at,
    emission_figures,
    evaluated_foci,
    field_of_pulse,
    pulse_s,
    repeated_field,
)
from controller.workshop.benchmark.focus.focus_figures import SETTLED
from controller.workshop.physics.design.design_figures import design_figures
from controller.workshop.physics.felt import LIGHT_TOUCH, ONE_NEWTON, felt_amplitudes_um
from controller.workshop.physics.finger import Finger, point_motion
from controller.workshop.physics.pictures import plot
from controller.workshop.physics.pictures.focus_series import focus_series
from controller.workshop.physics.responses.modal_history import modal_energy, modal_history
from controller.workshop.physics.word_capture import capture_of_words

POINT = (0.052, 0.031)


@pytest.fixture(scope="module")
def emission(small_board):
    return emission_at(small_board, [POINT])


def volts(emission, times=1, after=0):
    board = emission.twin.board
    words = np.append(np.repeat(emission.words, times), np.full(after, board.idle_word, np.uint32))
    levels = channel_bits(words.astype("<u4")).astype(float) - channel_bits(np.array([board.idle_word], "<u4"))
    return levels * board.driver.supply_v


def test_energy_of_the_modes_is_that_of_the_map(emission):
    """Two ways that share the modes' amplitudes and shapes only: frequencies and masses, or derivatives in space."""
    found = emission_figures(emission, 0.5e-3)
    for name, other in (("energy_uj", "energy_integrated_uj"), ("kinetic_share", "kinetic_share_integrated")):
        print(f"{name}: modes {found[name]:.6g}, map {found[other]:.6g} ({found[other] / found[name] - 1:+.1e}, within 1e-4)")
        assert found[other] == pytest.approx(found[name], rel=1e-4)
        assert found[other] * 1.01 != pytest.approx(found[name], rel=1e-4)
    assert 0.05 < found["kinetic_share"] < 0.3


def test_what_is_felt_stands_beside_what_a_bare_plate_does(emission):
    twin = emission.twin
    (row,) = evaluated_foci(emission, 1e-3)
    for name, load in (("felt_light_touch_um", LIGHT_TOUCH), ("felt_1_n_um", ONE_NEWTON)):
        assert row[name] == pytest.approx(felt_amplitudes_um(twin.board, twin.modes, emission.words, [POINT], load)[0])
    assert row["amplitude_um"] > row["felt_light_touch_um"] > row["felt_1_n_um"] > 0
    assert row["felt"] == "may be felt"


def test_state_at_t_is_what_stepping_bit_by_bit_gives(emission):
    twin, field = emission.twin, emission.field
    *_, last = modal_history(twin.step, twin.forces, volts(emission), twin.board.waveform.bit_period_s)
    scale = abs(field.modal).max(), abs(field.modal_velocity).max()
    assert last.displacement[-1] == pytest.approx(field.modal, abs=1e-9 * scale[0])
    assert last.velocity[-1] == pytest.approx(field.modal_velocity, abs=1e-9 * scale[1])
    energy = modal_energy(twin.modes, last)
    total_uj = (energy.kinetic_j[-1] + energy.potential_j[-1]) * 1e6
    assert emission_figures(emission, 1e-3)["energy_uj"] == pytest.approx(total_uj, rel=1e-9)


def test_endless_repetition_is_the_limit_of_many(emission):
    """Twenty emissions in a row, played on the twin; what is left of the first has decayed by e^-40, but for slow modes' 1e-5."""
    twin, board = emission.twin, emission.twin.board
    period_s = 1e-3
    settled = round(SETTLED / float(np.min(-twin.step.poles.real)) * board.link.clock_hz)
    clock_hz = board.bit_ticks * board.waveform.bit_clock_hz
    capture = capture_of_words(emission.words, board.bit_ticks, board.idle_word, settled, round(period_s * clock_hz), 20)
    *_, last = twin.fields(capture, clock_hz)
    endless = repeated_field(emission, period_s)
    largest = abs(last.modal).max()
    print(f"largest difference of a mode {abs(endless.modal - last.modal).max() / largest:.1e} of the largest")
    assert endless.modal == pytest.approx(last.modal, abs=1e-4 * largest)
    assert emission.field.modal != pytest.approx(last.modal, abs=1e-3 * largest), "repetition does something"
    once, again = (field.focus_metrics(*POINT).contrast for field in (emission.field, endless))
    print(f"contrast {again / once:.4f} of a single emission's; formula {np.sqrt(-np.expm1(-2 * period_s / 0.25e-3)):.4f}")


def test_pulse_is_as_long_as_a_series_of_eighths_of_bits_shows(emission):
    twin = emission.twin
    period_s = twin.board.waveform.bit_period_s / 8
    played = np.concatenate([np.repeat(volts(emission), 8, axis=0), np.zeros((80, 32))])
    shape = twin.modes.shapes(POINT)[0]
    u = np.concatenate([m.displacement @ shape for m in modal_history(twin.step, twin.forces, played, period_s)])
    around = u[8 * len(emission.words) - 81 :]
    top = int(np.argmax(around))
    low = np.flatnonzero(around <= around[top] / 2)
    lasted = (low[low > top][0] - low[low < top][-1] - 1) * period_s
    found = pulse_s(field_of_pulse(emission), *POINT)
    print(f"pulse {found * 1e6:.3f} µs; of the series {lasted * 1e6:.3f} µs, to {period_s * 1e6:.2f} µs")
    assert found == pytest.approx(lasted, abs=period_s)


@pytest.mark.slow
def test_the_papers_plate_has_the_energy_pulse_and_heat_that_other_simulations_gave(board):
    """Of its energy 16 % kinetic, some 8 W in the resistors (shared facts); the pulse is longer than eq. (4), a gate's."""
    emission = emission_at(board, [(0.1, 0.07)])
    found = emission_figures(emission, 2e-3)
    (row,) = evaluated_foci(emission, 2e-3)
    print({name: round(found[name], 4) for name in ("energy_uj", "kinetic_share", "stages_w")}, row["pulse_us"])
    assert found["kinetic_share"] == pytest.approx(0.16, abs=0.015)
    assert found["stages_w"] == pytest.approx(8, abs=0.5)
    assert found["stages_uj"] == pytest.approx(sum(channel["energy_uj"] for channel in found["channels"]))
    assert 7.1 < row["pulse_us"] < 11
    sound = found["sound"]
    assert sound["train_50_hz_db"] == pytest.approx(sound["exposure_db"] + 10 * np.log10(50), abs=0.1)
    assert sound["arming_exposure_db"] < sound["exposure_db"] - 10
    assert row["spot_wavelengths"] == pytest.approx(row["spot_mm"] / 10.54, rel=1e-3)
    for finger_mg, felt_um in ((70, row["felt_light_touch_um"]), (140, row["felt_1_n_um"])):
        foreseen = design_figures(board, {"finger_mg": finger_mg})["felt_um"]
        print(f"felt by a pad of {finger_mg} mg: design {foreseen:.3f} um, played {felt_um:.3f} um ({foreseen / felt_um - 1:+.1%})")
        assert foreseen == pytest.approx(felt_um, rel=0.1), "the amplitude of a focus is 11 % high too"
    motion, around_s = point_motion(board, emission.twin.modes, emission.words, [(0.1, 0.07)]), np.linspace(-10e-6, 10e-6, 101)
    for finger_mg in (20.0, 100.0):
        kept = motion.displacement({0: Finger(finger_mg * 1e-6)}, around_s).max() / motion.displacement({}, around_s).max()
        foreseen = design_figures(board, {"finger_mg": finger_mg})["finger_left_of_band"]
        print(f"{finger_mg:g} mg leave {kept:.3f} of the peak, on an endless plate {foreseen:.3f}")
        assert foreseen == pytest.approx(kept, rel=0.2), "waves that pass the finger more than once lose more"
    assert 0.97 < row["contrast_repeated"] / row["contrast"] < 1


def test_a_series_passes_through_the_focus_and_ends_at_rest(emission):
    board = emission.twin.board
    series = focus_series(emission.twin, emission.words, POINT)
    at_t = int(np.argmin(abs(series.time_s)))
    assert series.displacement_m[at_t] == pytest.approx(emission.field.at(POINT)[0], rel=1e-9)
    assert list(series.channels) == [0, 8, 16, 24]
    bits = channel_bits(emission.words[-1:].astype("<u4"))[0, series.channels]
    assert np.array_equal(series.stage_v[at_t], bits * board.driver.supply_v), "the last bit ends at T"
    idle = [board.idle_word >> int(channel) & 1 for channel in series.channels]
    assert series.piezo_v[-1] == pytest.approx(np.array(idle) * board.driver.supply_v, abs=1e-3)
    assert series.piezo_v.min() > -20, "a driver overshoots, but not so far"


def test_the_spectrum_of_a_focus_is_in_its_band(emission, monkeypatch):
    series = focus_series(emission.twin, emission.words, POINT)
    drawn = []
    monkeypatch.setattr(plot, "save_figure", lambda figure, *_: drawn.append(figure))
    plot.plot_focus(None, emission.twin.board, emission.field, [POINT], "focus", series)
    (figure,) = drawn
    above, below = figure.subfigs[0].axes[:2]
    left_mm, right_mm = np.array(above.collections[0].get_coordinates())[..., 0].ravel()[[0, -1]]
    assert (left_mm, right_mm) == pytest.approx((0, emission.twin.board.plate.length_mm), abs=1)
    assert [line.get_ydata()[0] for line in below.lines[1:]] == [0]
    _, whole, *_ = figure.subfigs[1].axes
    assert whole.get_xlim() == pytest.approx((series.time_s[0] * 1e3, series.time_s[-1] * 1e3))
    assert "time from T" in whole.get_xlabel()
    frequency_hz, size = series.spectrum()
    band = (frequency_hz >= 20e3) & (frequency_hz <= 70e3)
    assert (size[band] ** 2).sum() > 0.9 * (size**2).sum()
    step_s, step_hz = series.time_s[1] - series.time_s[0], frequency_hz[1]
    assert 2 * (size**2).sum() * step_hz == pytest.approx((series.displacement_m**2).sum() * step_s, rel=1e-3), "Parseval"


@pytest.mark.slow  # a command of the README draws one in the normal run
def test_a_picture_has_the_plate_and_the_series(emission, tmp_path):
    series = focus_series(emission.twin, emission.words, POINT)
    alone, both = tmp_path / "focus.png", tmp_path / "both.png"
    plot.plot_focus(alone, emission.twin.board, emission.field, [POINT], "focus")
    plot.plot_focus(both, emission.twin.board, emission.field, [POINT], "focus", series)
    assert both.stat().st_size > 1.3 * alone.stat().st_size
