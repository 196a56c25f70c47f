"""Errors of drive words: against the plate twin, which has its own way from pins to displacement."""

import numpy as np
import pytest

from controller.device.bank.packing import channel_bits, drive_words
from controller.workshop.bank_builder.methods.plain import SignOfSum
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.benchmark.fingers_scenes import DRIFT, INNER_M, MARGIN_M, scenes, still
from controller.workshop.benchmark.focus.focus_figures import emit
from controller.workshop.benchmark.judge import Judge
from controller.workshop.benchmark.plate_under_test import bound
from controller.workshop.physics.audible import surface_energy
from controller.workshop.physics.felt import felt_amplitudes_um
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.sound import PlateSound

PLACES = ((0.04, 0.03), (0.065, 0.045))
NULL = (0.05, 0.05)


@pytest.fixture(scope="module")
def judge(small_board):
    return Judge(small_board, (1 + DRIFT,))


def test_errors_are_those_of_the_plate_twin(small_board, judge, small_model):
    words = SignOfSum(small_board, small_model).design([(*place, 1.0) for place in PLACES]).words
    (found,) = judge.errors(still("two", PLACES, NULL), [words], [False])
    twin = PlateTwin(small_board)
    field = emit(twin, words)
    metrics = [field.focus_metrics(*place, PLACES) for place in PLACES]
    share = [metric.amplitude_m / twin.reference_amplitude(*place) for metric, place in zip(metrics, PLACES, strict=True)]
    assert found["loss"] == pytest.approx(1 - np.mean(share), rel=1e-6)
    assert found["worst_loss"] == pytest.approx(1 - min(share), rel=1e-6)
    assert found["contrast"] == pytest.approx(min(metric.contrast for metric in metrics), rel=1e-6)
    assert found["audible_m2_per_s"] == pytest.approx(surface_energy(small_board, words, small_board.idle_word), rel=1e-6)
    heard = PlateSound(small_board, twin.modes).exposure_pa2_s(words, small_board.idle_word)
    assert found["sound_pa2_s"] == pytest.approx(heard, rel=1e-6)
    near = np.abs(Prediction(small_board, small_model).near_focus(words, [NULL])).max()
    mean = np.mean([metric.amplitude_m for metric in metrics])
    assert found["quiet"] == pytest.approx(near / mean, rel=1e-6)
    crest = [np.hypot(*(np.array(field.crest(*place)) - place)) for place in PLACES]
    assert found["crest_m"] == pytest.approx(max(crest), abs=1e-9)


def test_a_point_alone_loses_nothing_by_its_own_sign_and_much_on_another_plate(small_board, judge, small_model):
    words = SignOfSum(small_board, small_model).design([(*PLACES[0], 1.0)]).words
    here, drifted = (judge.errors(still("one", PLACES[:1], NULL, by), [words], [False])[0] for by in (1.0, 1 + DRIFT))
    assert abs(here["loss"]) < 1e-9
    assert abs(here["bound_loss"]) < 1e-9
    assert 0.02 < drifted["loss"] < 0.5
    assert 0.6 < here["amplitude_over_unfiltered"] < 0.9


def test_what_fingers_feel_is_the_figure_of_merit_with_all_of_them_on_the_plate(small_board, judge, small_model):
    designed = [
        SignOfSum(small_board, small_model).design([(*place, 1.0) for place in some]).words for some in (PLACES, PLACES[:1])
    ]
    both, one = judge.errors(still("two", PLACES, NULL), [designed[0], designed[1][100:]], [False, False])
    for found, words in ((both, designed[0]), (one, designed[1][100:])):
        *meant, other = felt_amplitudes_um(small_board, small_model.plate_modes, words, [*PLACES, NULL])
        assert found["felt_um"] == pytest.approx(min(meant), rel=1e-4)
        assert found["felt_crosstalk"] == pytest.approx(other / min(meant), rel=1e-4)
    assert (both["felt_loss"], one["felt_loss"]) == pytest.approx((0, 1 - one["felt_um"] / both["felt_um"]))
    assert one["felt_loss"] > 0.3, "the second finger has nothing but what spills"


def test_polarity_counts_unless_a_method_may_choose_it(small_board, judge, small_model):
    words = SignOfSum(small_board, small_model).design([(*PLACES[0], 1.0)]).words
    upside_down = drive_words(1.0 - 2.0 * channel_bits(words))
    up, free = judge.errors(still("one", PLACES[:1], NULL), [upside_down, upside_down], [False, True])
    assert up["loss"] > 1.9
    assert free["bound_loss"] == pytest.approx(0, abs=1e-9)


def test_an_emission_that_is_shorter_starts_later(small_board, judge, small_model):
    words = SignOfSum(small_board, small_model).design([(*PLACES[0], 1.0)]).words
    losses = [judge.errors(still("one", PLACES[:1], NULL), [words[start:]], [False])[0]["loss"] for start in (187, 125, 0)]
    assert losses[0] > losses[1] > losses[2]
    late, whole = judge.errors(still("one", PLACES[:1], NULL), [words[125:], words], [False, False])
    assert whole["best_loss"] == pytest.approx(0, abs=1e-12)  # the best of those compared
    assert late["best_loss"] == pytest.approx(losses[1], abs=1e-9)


@pytest.mark.parametrize("count", [2, 3])
def test_no_words_get_beyond_the_bound_and_some_get_near_it(count):
    random = np.random.default_rng(count)
    unit = random.normal(size=(count, 400))
    unit /= np.abs(unit).sum(axis=1, keepdims=True)
    most = bound(unit)
    reached = 0.0
    for _ in range(300):
        weights = random.uniform(0.2, 1, count) * random.choice([-1, 1], count)
        reached = max(reached, np.abs(unit @ np.sign(weights @ unit)).min())
    assert 0.95 * most < reached <= most + 1e-12


def test_scenes_are_where_their_families_say_and_the_same_for_a_seed(board):
    drawn = scenes(board, 3, each=2, random_scenes=3)
    assert drawn == scenes(board, 3, each=2, random_scenes=3)
    assert drawn != scenes(board, 4, each=2, random_scenes=3)
    size = np.array([board.plate.length_m, board.plate.width_m])
    for scene in drawn:
        places = np.array(scene.points).reshape(-1, 2)
        edge = np.minimum(places, size - places).min(axis=1, initial=np.inf)
        assert (edge >= MARGIN_M - 1e-12).all()
        if scene.family == "1 near an edge":
            assert edge.max() <= INNER_M
        if scene.family in ("10 off grid", "4 on grid"):
            assert edge.min() >= INNER_M - 2e-3
    families = {scene.family for scene in drawn}
    assert {"1 off grid", "10 off grid", "four foci of the paper", "1 at -0.5 % drift", "random", "idle"} <= families
    for speed in ("50", "200"):
        ahead, behind = (
            np.mean([np.hypot(*np.subtract(scene.points, scene.expected).T) for scene in drawn if scene.family == family])
            for family in (f"1 sliding at {speed} mm/s", f"1 sliding at {speed} mm/s, unpredicted")
        )
        assert ahead < behind
