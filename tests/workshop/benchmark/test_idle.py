"""Idle word and ramp on the plate twin: what issue 3 asks to be shown, held against `facts/waveforms.md` and against the pins."""

import msgspec
import numpy as np
import pytest

from controller.device.bank.packing import channel_bits
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.benchmark.device.idle import first_order_bits, idle_figures, plot_idle, ramp_samples, ramp_words
from controller.workshop.benchmark.focus.focus_figures import figures as focus_figures
from controller.workshop.gateware.model.pins import ramp_bits
from controller.workshop.physics.audible import surface_energy

BOARD = load_board(find_board("simulated"))
IDLE = BOARD.idle_word
POINTS = 6
FAR_BUTTON = """[[regions]]
name = "far"
shape = "circle"
x_mm = 30
y_mm = 30
radius_mm = 5
effects = [{ effect = "click" }]
"""


@pytest.fixture(scope="module")
def measured():
    return idle_figures(BOARD, seed=1, points=POINTS)


@pytest.mark.slow
def test_contrast_with_and_without_idle_word_is_that_of_the_other_figures(measured):
    others = focus_figures(BOARD, seed=1, points=POINTS)
    for name, key in (("idle_word", "single"), ("all_low", "single_all_idle_low")):
        for figure in ("contrast", "amplitude_um"):
            assert measured[figure][name] == pytest.approx(others[key][figure], rel=1e-12)
    assert measured["emission_m2_per_s"] == pytest.approx(others["single"]["audible_m2_per_s"]["median"], rel=1e-12)
    assert measured["contrast"]["all_low"]["max"] < 0.7 * measured["contrast"]["idle_word"]["min"]


@pytest.mark.slow
def test_levels_are_those_of_other_plates_and_discs(measured):
    """Facts: -7 dB at once, -9.7 dB first order in 50 ms, -20 dB second order in 5 to 10 ms; their discs lay elsewhere."""
    arming = measured["arming_db"]
    assert arming["instant"] == pytest.approx(-7, abs=1.5)
    assert arming["first_order"]["50_ms"] == pytest.approx(-9.7, abs=1.5)
    for ramp in ("5_ms", "10_ms"):
        assert arming["second_order"][ramp] == pytest.approx(-20, abs=2)
    assert arming["own_ramp"] == arming["second_order"]["10_ms"]
    assert measured["disarming_db"]["instant"] == pytest.approx(arming["instant"], abs=1e-9)  # the same step, downwards
    assert measured["disarming_db"]["own_ramp"] == pytest.approx(arming["own_ramp"], abs=0.5)


def test_another_ramp_is_another_figure(measured):
    """Every ramp of another length or of first order is at least 0.05 dB away: 1 % of energy is 0.04 dB."""
    arming = measured["arming_db"]
    own = arming["own_ramp"]
    others = [level for ms, level in arming["second_order"].items() if ms != "10_ms"] + list(arming["first_order"].values())
    assert min(abs(level - own) for level in others) > 0.05
    samples = ramp_samples(BOARD, 10.0)
    words = ramp_words(BOARD, ramp_bits(samples, up=True))
    energy = surface_energy(BOARD, words, IDLE, before_word=0)
    assert 10 * np.log10(energy / measured["emission_m2_per_s"]) == pytest.approx(own, abs=1e-9)
    late = np.append(words[:1], words[:-1])  # the whole ramp a word later, then a word short
    assert abs(10 * np.log10(surface_energy(BOARD, late, IDLE, before_word=0) / energy)) < 0.05, "steady: not a matter of chance"


@pytest.mark.slow
def test_energies_follow_the_supply(measured):
    """1 % less voltage is 0.087 dB less of everything that is heard, and the same contrast."""
    driver = msgspec.structs.replace(BOARD.driver, supply_v=0.99 * BOARD.driver.supply_v)
    less = idle_figures(msgspec.structs.replace(BOARD, driver=driver), seed=1, points=POINTS)
    assert 10 * np.log10(less["emission_m2_per_s"] / measured["emission_m2_per_s"]) == pytest.approx(20 * np.log10(0.99), abs=1e-6)
    assert less["arming_db"]["own_ramp"] == pytest.approx(measured["arming_db"]["own_ramp"], abs=1e-6)
    assert less["contrast"]["idle_word"] == pytest.approx(measured["contrast"]["idle_word"], rel=1e-9)


def test_the_ramp_is_what_the_pins_do(perform):
    """Arming and disarming in a run of the gateware's model, word for word."""
    capture = perform([(0.0, {0: (100, 70)}), (0.1, {0: None})], FAR_BUTTON).capture
    ticks, words = capture.ticks.astype(np.int64), capture.words
    rise, fall = ticks[np.flatnonzero(words)[0]], ticks[np.flatnonzero(words)[-1] + 1]
    samples, bit_ticks = ramp_samples(BOARD, BOARD.limits.ramp_ms), BOARD.bit_ticks
    for up in (True, False):
        bits = ramp_bits(samples, up=up)
        high = np.flatnonzero(bits)
        start = rise - high[0] * bit_ticks if up else fall - (high[-1] + 1) * bit_ticks
        at = np.searchsorted(ticks, start + np.arange(samples) * bit_ticks, side="right") - 1
        played = np.where(at >= 0, words[at], 0)
        assert np.array_equal(played, ramp_words(BOARD, bits)), "up" if up else "down"


def test_first_order_density_is_as_dense_as_its_level():
    bits = first_order_bits(1000)
    assert np.abs(np.cumsum(bits) - np.cumsum(np.arange(1, 1001)) / 1000).max() < 1
    assert bits[-1]
    assert not bits[0]


def test_a_ramp_moves_only_what_idles_high():
    words = ramp_words(BOARD, ramp_bits(500, up=True))
    assert channel_bits(words)[:, channel_bits(np.array([IDLE], "<u4"))[0] == 0].sum() == 0


@pytest.mark.slow
def test_the_picture_is_written(measured, tmp_path):
    plot_idle(tmp_path / "idle.png", BOARD, measured)
    assert (tmp_path / "idle.png").read_bytes().startswith(b"\x89PNG")
