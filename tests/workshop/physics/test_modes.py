"""Everything above the modes through their interface only: shapes that are no products, each with a mass and a size of its own."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.workshop.bank_builder.methods.audible_form import AudibleForm
from controller.workshop.bank_builder.methods.field_form import FieldForm
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.physics.audible import surface_energy
from controller.workshop.physics.field import Field, FocusScale
from controller.workshop.physics.memory import entries_bytes
from controller.workshop.physics.modes.closed_form import SimplySupported
from controller.workshop.physics.modes.modes import at_points
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import POINTS_PER_GEMM, ResponseModel
from controller.workshop.physics.word_capture import capture_of_words

BOARD = load_board(find_board("simulated"))
IDLE = BOARD.idle_word
HIGHEST_HZ = 10e3  # 184 modes: arithmetic is the same for all
POINTS = np.array([(0.06, 0.05), (0.14, 0.09), (0.003, 0.145)])
ROWS = np.array([(x_m, y_m) for y_m in (0.03, 0.12) for x_m in np.linspace(0.01, 0.2, 12)])
WORDS = np.random.default_rng(3).integers(0, 1 << 32, 1000, np.uint32)


@dataclass(frozen=True)
class Dense:
    """The closed form's modes as any others: no factors, and shapes of other sizes, which changes nothing that is seen."""

    modes: SimplySupported
    size: np.ndarray
    factors: None = None

    def __getattr__(self, name):
        return getattr(self.modes, name)

    @property
    def mass_kg(self):
        return self.modes.mass_kg * self.size**2

    @property
    def mean_square(self):
        return self.modes.mean_square * self.size**2

    def shapes(self, points_m, dtype=np.float64):
        return (self.modes.shapes(points_m) * self.size).astype(dtype)

    def on_grid(self, amplitudes, x_m, y_m):
        return self.modes.on_grid(amplitudes * self.size, x_m, y_m)

    def coupling(self, actuator):
        return self.modes.coupling(actuator) * self.size


def dense(closed):
    return Dense(closed, 2.0 ** np.random.default_rng(5).integers(-2, 3, closed.count))


def heavier(closed):
    """One mode 1 % heavier, of those that move most."""
    return dense(replace(closed, mass_kg=closed.mass_kg * np.where(np.arange(closed.count) < 20, 1.01, 1)))


def differs(found, expected):
    """Largest difference, over the largest value."""
    return float(np.abs(np.asarray(found) - expected).max() / np.abs(expected).max())


@pytest.fixture(scope="module")
def closed():
    return modes_of(BOARD, HIGHEST_HZ)


def test_modes_are_built_once_for_a_plate_and_a_frequency(closed):
    assert modes_of(BOARD, HIGHEST_HZ) is closed
    assert ResponseModel(BOARD, HIGHEST_HZ).plate_modes is closed
    assert PlateTwin(BOARD, HIGHEST_HZ).modes is closed


def test_responses_of_any_modes_are_those_of_the_closed_form(closed):
    expected = ResponseModel(BOARD, modes=closed)
    found, off = ResponseModel(BOARD, modes=dense(closed)), ResponseModel(BOARD, modes=heavier(closed))
    for points_m in (POINTS, ROWS):
        for band_limited in (False, True):
            values = expected.responses(points_m, band_limited=band_limited)
            # sums of 184 terms in another order: 2e-16 each; the band's responses have 1e-3 of the whole's size
            assert differs(found.responses(points_m, band_limited=band_limited), values) < 1e-12
        assert differs(off.responses(points_m), expected.responses(points_m)) > 1e-4
    near = Prediction(BOARD, expected).near_responses(POINTS[0])
    assert differs(Prediction(BOARD, found).near_responses(POINTS[0]), near) < 1e-12


def test_the_field_of_any_modes_and_its_figures_are_those_of_the_closed_form(closed):
    capture = capture_of_words(WORDS, BOARD.bit_ticks, IDLE, 0)
    (expected,), (found,), (off,) = (
        list(PlateTwin(BOARD, modes=modes).fields(capture, BOARD.link.clock_hz))
        for modes in (closed, dense(closed), heavier(closed))
    )
    assert differs(found.at(POINTS), expected.at(POINTS)) < 1e-12
    assert differs(found.map()[2], expected.map()[2]) < 1e-12
    assert differs(found.around((0.06, 0.05)), expected.around((0.06, 0.05))) < 1e-12
    assert differs(off.at(POINTS), expected.at(POINTS)) > 1e-4
    many = np.column_stack([np.linspace(0, 0.21, 600), np.full(600, 0.07)])  # more than are computed at once
    assert differs(at_points(found.modes, found.modal, many), expected.at(many)) < 1e-12
    metrics, those = found.focus_metrics(0.06, 0.05), expected.focus_metrics(0.06, 0.05)
    assert vars(metrics) == pytest.approx(vars(those), rel=1e-9, abs=0)
    # A spot of 1.5 by 1 mm (standard deviations), whole, and half a millimetre from the edge, beyond which nothing moves
    sigma_m, half = np.array([1.5e-3, 1e-3]), np.sqrt(2 * np.log(2))
    along_x, along_y, askew = half * 1.5e-3, half * 1e-3, half / np.sqrt((sigma_m**-2.0).mean())
    for x_m, cut_x, cut_askew in ((60e-3, along_x, askew), (0.5e-3, 0.5e-3, 0.5e-3 * 2**0.5)):
        crest = np.array([x_m, 50e-3])

        def at(places_m, crest=crest):
            return np.exp(-(((places_m - crest) / sigma_m) ** 2).sum(axis=1) / 2)

        expected_m = (along_x + cut_x + 2 * along_y + 2 * (askew + cut_askew)) / 4
        for sign in (1, -1):
            spot = SimpleNamespace(scale=FocusScale(), modes=closed, at=lambda places_m, sign=sign, at=at: sign * at(places_m))
            assert Field._spot(spot, tuple(crest), sign) == pytest.approx(expected_m, abs=0.03e-3)


def test_what_is_heard_of_any_modes_is_that_of_the_closed_form(closed):
    expected, found, off = (
        surface_energy(BOARD, WORDS[:40], IDLE, modes=modes) for modes in (closed, dense(closed), heavier(closed))
    )
    assert found == pytest.approx(expected, rel=1e-12, abs=0)
    assert off != pytest.approx(expected, rel=1e-5, abs=0)


def test_forms_of_the_field_and_of_sound_take_any_modes(closed):
    """What the descent optimises. Factors of shapes are rounded to 12 bits there, and shapes that are none as a whole: 1e-3."""
    levels = np.random.default_rng(4).integers(0, 2, (1000, 2, 32)).astype(np.float64)
    models = [ResponseModel(BOARD, modes=modes) for modes in (closed, dense(closed), heavier(closed))]
    fields = [FieldForm(BOARD, model) for model in models]
    modal, shapes, squares, near = [], [], [], []
    for form in fields:
        places = [form.surroundings(point) for point in POINTS[:2]]
        modal.append(form.modal(levels))
        shapes.append(form.shapes(POINTS[:2]))
        squares.append(form.mean_square(modal[-1], places))
        near.append(form.near(modal[-1], places))
    assert np.array_equal(shapes[1], shapes[0])
    assert np.array_equal(modal[1], modal[0])
    assert squares[1] == pytest.approx(squares[0], rel=1e-3, abs=0)
    assert squares[2] != pytest.approx(squares[0], rel=1e-3, abs=0)
    assert near[1][1] == pytest.approx(near[0][1], rel=1e-3, abs=0)
    assert differs(near[1][0], near[0][0]) < 1e-3
    heard = [AudibleForm(BOARD, model, 20).energy(levels) for model in models[:2]]
    assert heard[1] == pytest.approx(heard[0], rel=1e-9, abs=0)


def test_a_bank_of_all_modes_without_factors_has_the_entries_of_one_with_them():
    """1,900 modes at the rows of a coarse grid in float32, by the GEMM over all modes: what sums of this many round, 1e-5."""
    closed = modes_of(BOARD)
    assert closed.count > 1800
    expected, found = ResponseModel(BOARD), ResponseModel(BOARD, modes=dense(closed))
    difference = differs(found.entry_responses(ROWS), expected.entry_responses(ROWS))
    print(f"{closed.count} modes at {len(ROWS)} points: {difference:.1e} of the largest response")
    assert difference < 1e-5
    assert entries_bytes(found.plate_modes, 1000, 24) - entries_bytes(closed, 1000, 24) == pytest.approx(
        4 * POINTS_PER_GEMM * (1500 * 32 + 35 * closed.count) - 4 * 1500 * 32 * (closed.factors.x_index.max() + 1)
    )


def test_each_mode_may_ring_for_a_time_of_its_own(closed):
    rates = 1e3 * np.linspace(1, 3, closed.count)
    model = ResponseModel(BOARD, modes=replace(closed, decay_rate=rates))
    free = model.modal[:, 500:]
    lasting = model.plate_modes.angular_frequency > 4 * rates  # none of those that return slowly
    fallen = [np.abs(part).max(axis=1) for part in (free[:, :200], free[:, 300:])]
    assert np.log(fallen[0] / fallen[1])[lasting] == pytest.approx(rates[lasting] * 300 * BOARD.waveform.bit_period_s, abs=0.3)
    slowest = ResponseModel(BOARD, modes=replace(closed, decay_rate=np.full(closed.count, rates[0])))
    assert differs(model.modal_band[0], slowest.modal_band[0]) < 1e-9
