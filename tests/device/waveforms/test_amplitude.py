"""Less than full amplitude: by weights and held bits, as far as the bank knows what bits do."""

import numpy as np
import pytest
from tables import each_row

from controller.device.bank.file_format import REST_SAMPLES
from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS, channel_bits, edges
from controller.device.bank.reader import Bank
from controller.device.kernel.amplitude_twin import SHARES, THRESHOLDS, masking_threshold
from controller.device.waveforms.composition import Composer
from controller.workshop.physics.focusing import balanced_weights, focus

IDLE_WORD = 0x69969669
IDLE = np.array([IDLE_WORD >> q & 1 for q in range(CHANNELS)])
SAMPLES = 200
GRID = Grid(2.5e-3, 41, 31, 5e-3, 6e-3)
NUMBERS = (45, 80, 1200, 1230)  # far apart
CELLS = [GRID.place(cell) for cell in NUMBERS]


@pytest.fixture(scope="module")
def responses(waves):
    """Of this many waves that points are nearly independent, as on a plate."""
    many = type(waves)(3, modes=600)
    return {cell: many.at(*GRID.place(cell)) for cell in NUMBERS}


@pytest.fixture(scope="module")
def rests():
    """Outside the band there is more than within."""
    random = np.random.default_rng(8)
    return {cell: 3e-9 * random.standard_normal((SAMPLES // REST_SAMPLES, CHANNELS)) for cell in NUMBERS}


def write(make_bank, path, responses, **more):
    make_bank(path, GRID, np.isin(np.arange(GRID.cells), NUMBERS), SAMPLES, responses=responses, **more)


@pytest.fixture(scope="module")
def bank(tmp_path_factory, make_bank, responses, rests):
    path = tmp_path_factory.mktemp("bank") / "bank"
    write(make_bank, path, responses, rests=rests)
    with Bank.open(path) as opened:
        yield opened


@pytest.fixture
def reached(responses, rests):
    """What words do at cells: all of it, from rest at the idle word."""

    def displacements(words, cells_m):
        deviation = channel_bits(np.frombuffer(words, "<u4")) - IDLE.astype(float)
        sums = deviation.reshape(SAMPLES // REST_SAMPLES, REST_SAMPLES, CHANNELS).sum(axis=1)
        found = []
        for x_m, y_m in cells_m:
            cell, _ = GRID.nearest(x_m, y_m)
            found.append(np.sum(deviation * responses[cell]) + np.sum(sums * rests[cell]))
        return np.array(found)

    return displacements


def test_the_table_is_its_own_inverse_and_falls():
    assert [masking_threshold(share) for share in SHARES] == pytest.approx(THRESHOLDS)
    assert masking_threshold(1.2) == 0
    assert masking_threshold(0.001) == THRESHOLDS[-1]
    between = [masking_threshold(share) for share in np.linspace(1, 0.06, 50)]
    assert (np.diff(between) > 0).all()


@pytest.fixture
def exactly(responses, reached):
    """What amplitude 1 means: for one cell all that it gets alone, for several the share that all can have."""

    def displacements(cells_m):
        here = np.array([responses[GRID.nearest(x_m, y_m)[0]] for x_m, y_m in cells_m])
        weights, sizes = balanced_weights(here), np.abs(here).sum(axis=(1, 2))
        together = np.abs(reached(focus(here, weights.tolist(), IDLE_WORD), cells_m))
        return sizes * (np.abs(weights) @ together) / (np.abs(weights) @ sizes)

    return displacements


@each_row("amplitude", [0.25, 0.5, 0.75, 0.95])
@each_row("count", [1, 2, 4])
def test_all_points_at_one_amplitude(bank, reached, exactly, count, amplitude):
    cells_m = CELLS[:count]
    less = reached(Composer(bank, IDLE_WORD).compose([(*place, amplitude) for place in cells_m]), cells_m)
    assert np.abs(less) / exactly(cells_m) == pytest.approx(amplitude, rel=0.03)


def test_each_point_at_its_own_amplitude_whatever_the_others_ask_for(bank, reached, exactly):
    composer = Composer(bank, IDLE_WORD)
    random = np.random.default_rng(2)
    full = exactly(CELLS)
    for _ in range(8):
        amplitudes = random.uniform(0.3, 1, len(CELLS))
        words = composer.compose([(*place, amplitude) for place, amplitude in zip(CELLS, amplitudes.tolist(), strict=True)])
        assert np.abs(reached(words, CELLS)) / full == pytest.approx(amplitudes, rel=0.04)


def test_what_lies_outside_the_band_counts(tmp_path, make_bank, responses, reached):
    """A bank that does not know it is off by more than the tolerance of the tests above."""
    write(make_bank, tmp_path / "bank", responses)
    with Bank.open(tmp_path / "bank") as bank:
        composer = Composer(bank, IDLE_WORD)
        full, half = (reached(composer.compose([(*place, amplitude) for place in CELLS]), CELLS) for amplitude in (1.0, 0.5))
    assert np.abs(half / full / 0.5 - 1).max() > 0.05


def test_weaker_is_never_busier(bank):
    composer = Composer(bank, IDLE_WORD)
    for count in (1, 2, 4):
        busiest, together = [], []
        for amplitude in (1.0, 0.75, 0.5, 0.25):
            words = np.frombuffer(composer.compose([(*place, amplitude) for place in CELLS[:count]]), "<u4")
            counts = edges(np.concatenate([[np.uint32(IDLE_WORD)], words, [np.uint32(IDLE_WORD)]]))
            busiest.append(counts.max())
            together.append(counts.sum())
        assert busiest == sorted(busiest, reverse=True)
        assert together == sorted(together, reverse=True)
        assert together[-1] < 0.5 * together[0]
