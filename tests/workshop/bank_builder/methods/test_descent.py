import dataclasses
import os
import platform
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest
from small_plate import small_board
from tables import each_row

from controller.device.bank.packing import channel_bits, drive_words, edges
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.methods.audible_form import AudibleForm
from controller.workshop.bank_builder.methods.descent import Descent
from controller.workshop.bank_builder.methods.exact import rounded
from controller.workshop.bank_builder.methods.felt_form import FeltForm
from controller.workshop.bank_builder.methods.field_form import FieldForm
from controller.workshop.physics.audible import surface_spectrum
from controller.workshop.physics.felt import felt_amplitudes_um
from controller.workshop.physics.field import FocusScale
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.sound import PlateSound, a_weighting
from controller.workshop.physics.word_capture import capture_of_words

BOARD = small_board()
POINTS_M = np.array([(0.034, 0.031), (0.047, 0.024)])
SOUND = PlateSound(BOARD)
SETTLED_TICKS = round(0.25 * BOARD.link.clock_hz)


@pytest.fixture(scope="module")
def model():
    return ResponseModel(BOARD)


@pytest.fixture(scope="module")
def plain(model):
    return [drive_words(h, BOARD.idle_word) for h in model.drive_order_responses(POINTS_M, dtype=np.float64)]


@pytest.fixture(scope="module")
def optimised(model):
    return {name: Descent(BOARD, model, aim).entries(POINTS_M) for name, aim in AIMS.items()}


@pytest.fixture(scope="module")
def short(model):
    """A method that is not given the time for much."""
    return Descent(BOARD, model, dataclasses.replace(AIMS["balanced"], steps=6))


def heard(words):
    """A-weighted energy at the surface up to 20 kHz."""
    frequency_hz, density, step_hz = surface_spectrum(BOARD, words, BOARD.idle_word, high_hz=20e3)
    return float(density @ a_weighting(frequency_hz) ** 2) * step_hz


def evaluated(words, point_m):
    """Amplitude, contrast and sound exposure on the plate twin."""
    capture = capture_of_words(words, BOARD.bit_ticks, BOARD.idle_word, SETTLED_TICKS)
    field = next(PlateTwin(BOARD).fields(capture, BOARD.bit_ticks * BOARD.waveform.bit_clock_hz))
    figures = field.focus_metrics(*point_m.tolist())
    return figures.amplitude_m, figures.contrast, SOUND.exposure_pa2_s(words, BOARD.idle_word)


def levels_of(waveforms):
    return np.stack([channel_bits(words) for words in waveforms], axis=1).astype(float)


@each_row(
    ("aim", "amplitude", "contrast", "quieter_db", "busier"),
    [
        ("contrast", 1.05, 1.6, 3, 1.3),
        ("quiet", 1.0, 1, 14, 1.6),
        ("balanced", 1.05, 1.3, 9, 1.5),
        ("loud", 1.2, 1, -1, 1.4),
        ("cool", 1.05, 0.9, 1, 0.85),
    ],
)
def test_an_aim_is_reached_on_the_plate_twin_at_its_amplitude(plain, optimised, aim, amplitude, contrast, quieter_db, busier):
    for before, after, point_m in zip(plain, optimised[aim], POINTS_M, strict=True):
        old, new = evaluated(before, point_m), evaluated(after, point_m)
        assert abs(new[0] / old[0] - amplitude) <= 0.08
        assert new[1] >= contrast * old[1]
        assert new[2] <= old[2] * 10 ** (-quieter_db / 10)
        assert edges(after).sum() <= busier * edges(before).sum()


def test_what_is_optimised_to_be_felt_is_felt_and_quieter_than_what_is_loud(model, plain, optimised):
    """Judged by `felt_amplitudes_um`, whose own reference is a plate with the finger in its matrices (`test_felt`)."""
    form = FeltForm(BOARD, model, POINTS_M)
    idle = channel_bits(np.array([BOARD.idle_word], np.uint32))[0].astype(float)
    pull, felt_m = form.derivative(levels_of(optimised["felt"]) - idle)
    assert (pull * (levels_of(optimised["felt"]) - idle)).sum(axis=(0, 2)) == pytest.approx(felt_m, rel=1e-3)
    for index, point_m in enumerate(POINTS_M):
        before, loud, felt = (words[index] for words in (plain, optimised["loud"], optimised["felt"]))
        um = [felt_amplitudes_um(BOARD, model.plate_modes, words, [point_m])[0] for words in (before, loud, felt)]
        assert felt_m[index] * 1e6 == pytest.approx(um[2], rel=1e-3)
        assert um[2] == pytest.approx(1.4 * um[0], rel=0.08)
        assert SOUND.exposure_pa2_s(felt, BOARD.idle_word) < 0.5 * SOUND.exposure_pa2_s(loud, BOARD.idle_word)


def test_the_forms_measure_what_plate_twin_and_surface_spectrum_measure(model, plain):
    generator = np.random.default_rng(2)
    waveforms = [*plain, *(generator.integers(0, 1 << 32, BOARD.waveform.samples).astype(np.uint32) for _ in range(2))]
    points_m = POINTS_M[[0, 1, 0, 1]]
    form, audible = FieldForm(BOARD, model), AudibleForm(BOARD, model, 20)
    levels = levels_of(waveforms)
    idle = channel_bits(np.array([BOARD.idle_word], np.uint32))[0]
    places = [form.surroundings(point) for point in points_m]
    modal = form.modal(levels)
    amplitude = (form.shapes(points_m) * modal).sum(axis=1)
    contrast = amplitude / np.sqrt(form.mean_square(modal, places))
    energy = audible.energy(levels - idle)
    measured = np.array([evaluated(words, point_m) for words, point_m in zip(waveforms, points_m, strict=True)])
    assert amplitude / amplitude[0] == pytest.approx(measured[:, 0] / measured[0, 0], abs=2e-3)
    assert np.abs(contrast) == pytest.approx(measured[:, 1], rel=5e-3, abs=0.01)
    assert energy / energy[0] == pytest.approx([heard(words) / heard(waveforms[0]) for words in waveforms], rel=0.01)


def test_what_counts_as_the_focus_is_the_boards_own_definition(model):
    """On a plate with waves of half the length it is half as wide."""
    assert FieldForm(BOARD, model)._outside_m == FocusScale.of(BOARD).outside_m
    assert FieldForm(BOARD, model).surroundings(np.array([0.035, 0.025])).share == pytest.approx(
        70 * 50 / (70 * 50 - 314), rel=0.01
    )


def test_a_points_words_are_the_same_alone_and_among_others(short):
    among = short.entries(POINTS_M[[1, 0, 1]])
    assert np.array_equal(among[0], among[2])
    for words, point_m in zip(among[1:], POINTS_M, strict=True):
        assert np.array_equal(short.design([(*point_m.tolist(), 1.0)]).words, words)


def test_products_of_rounded_numbers_do_not_depend_on_the_order_of_the_sum():
    generator = np.random.default_rng(3)
    a, b = rounded(generator.standard_normal((40, 3000)), 20), rounded(generator.standard_normal((3000, 50)), 20)
    order = generator.permutation(3000)
    assert np.array_equal(a @ b, a[:, order] @ b[order])
    assert np.array_equal(a @ b, np.stack([row @ b for row in a]))
    assert np.abs(a).max() < 8
    assert not np.array_equal(a / 3 @ b, a[:, order] / 3 @ b[order]), "the machine's order does show in others"


def test_an_entry_keeps_about_the_amplitude_of_the_plain_one_or_is_that_one():
    """In a band of few modes plain bits hardly move a point near the edge, and others move it ten times as much."""
    board = msgspec.structs.replace(BOARD, waveform=msgspec.structs.replace(BOARD.waveform, band_low_hz=1e3, band_high_hz=5e3))
    model = ResponseModel(board)
    near_edge_m = np.array([(0.002, 0.002)])
    plain = drive_words(model.drive_order_responses(near_edge_m, dtype=np.float64)[0], board.idle_word)
    assert np.array_equal(Descent(board, model, AIMS["contrast"]).entries(near_edge_m)[0], plain)


ELSEWHERE = """
import sys, threadpoolctl
import numpy as np
sys.path.insert(0, sys.argv[1])
from small_plate import small_board
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.methods.descent import Descent
board = small_board()
product = np.sin(np.arange(4e4)).reshape(200, 200)
print({pool["architecture"] for pool in threadpoolctl.threadpool_info()}, (product @ product).tobytes().hex()[:2000])
model = ResponseModel(board)
print(*(Descent(board, model, AIMS[aim]).entries([(0.034, 0.031)]).tobytes().hex() for aim in ("balanced", "felt")))
"""


@pytest.mark.slow
@pytest.mark.skipif(platform.machine() != "x86_64", reason="kernels of other x86 processors are asked for")
def test_words_are_the_same_on_a_processor_with_other_vectors():
    found = []
    for other in ({}, {"OPENBLAS_CORETYPE": "Prescott", "OPENBLAS_NUM_THREADS": "2", "NPY_DISABLE_CPU_FEATURES": "AVX2 FMA3"}):
        command = [sys.executable, "-c", ELSEWHERE, Path(__file__).parents[3]]
        done = subprocess.run(command, env=os.environ | other, capture_output=True, text=True, check=True)
        found.append(done.stdout.splitlines())
    assert found[0][0] != found[1][0], "an ordinary product does show the processor"
    assert found[0][1] == found[1][1]


def test_it_expects_what_the_plate_twin_measures(short):
    designed = short.design([(*POINTS_M[0].tolist(), 1.0)])
    assert designed.displacement_m[0] == pytest.approx(evaluated(designed.words, POINTS_M[0])[0], rel=2e-3)
    assert designed.nulls_m.size == 0


def test_edges_stay_within_the_boards_limit(model, plain, optimised):
    busiest = max(edges(words).max() for words in optimised["quiet"])
    assert busiest > max(edges(words).max() for words in plain)
    limit_hz = (busiest - 4) / BOARD.waveform.duration_s
    board = msgspec.structs.replace(BOARD, limits=msgspec.structs.replace(BOARD.limits, max_edge_rate_hz=limit_hz))
    found = Descent(board, model, AIMS["quiet"]).entries(POINTS_M)
    assert not np.array_equal(found, plain), "optimised all the same"
    assert max(edges(words).max() for words in found) <= busiest - 4


def test_where_no_edge_is_allowed_and_where_nothing_moves_the_entry_is_the_plain_one(model, plain, short):
    board = msgspec.structs.replace(BOARD, limits=msgspec.structs.replace(BOARD.limits, max_edge_rate_hz=1.0))
    hurried = dataclasses.replace(AIMS["quiet"], steps=2)
    assert np.array_equal(Descent(board, model, hurried).entries(POINTS_M), plain)
    assert np.array_equal(short.entries([(0.0, 0.0)]), np.full((1, BOARD.waveform.samples), BOARD.idle_word))
    tiny = SimpleNamespace(_x_m=np.arange(3) * 1e-3, _y_m=np.arange(2) * 1e-3, _outside_m=10e-3)
    along_x, along_y, inside, share = FieldForm.surroundings(tiny, np.zeros(2))
    assert (len(along_x), len(along_y), inside.shape, share) == (0, 0, (0, 0), 1.0), "no point of the map lies outside of it"


@each_row(
    ("points", "nulls"),
    [
        ([], []),
        ([(0.03, 0.03, 1.0), (0.04, 0.03, 1.0)], []),
        ([(0.03, 0.03, 0.5)], []),
        ([(0.03, 0.03, 1.0)], [(0.05, 0.03)]),
        ([(np.nan, 0.03, 1.0)], []),
    ],
)
def test_refuses(short, points, nulls):
    with pytest.raises(ValueError, match=r"one point at full amplitude|not finite"):
        short.design(points, nulls)
