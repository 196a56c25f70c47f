import itertools
import math

import numpy as np
import pytest
from tables import each_row

from controller.device.bank.grid import Grid
from controller.device.bank.packing import CHANNELS, channel_bits, drive_words
from controller.device.bank.reader import Bank
from controller.device.waveforms.composition import MAX_FOCI, Composer
from controller.errors import BankError

IDLE_WORD = 0x69969669
SAMPLES = 200  # of the waves
GRID = Grid(2.5e-3, 7, 6, 5e-3, 6e-3)
MISSING = 41  # the last cell


@pytest.fixture(scope="module")
def bank(tmp_path_factory, make_bank, waves):
    path = tmp_path_factory.mktemp("bank") / "bank"
    cells = np.arange(GRID.cells) != MISSING
    make_bank(path, GRID, cells, SAMPLES, responses={c: waves.at(*GRID.points()[c]) for c in np.flatnonzero(cells).tolist()})
    with Bank.open(path) as opened:
        yield opened


def interpolated(bank, x_m, y_m, *, many):
    """Bilinear, with weights in 256ths: whole numbers. Among many points from cells spread as far along x as along y."""
    cells, shares = bank.grid.corners(x_m, y_m)
    if many:
        cells, shares = spread_alike(bank, x_m, y_m) or (cells, shares)
    used = [(cell, share * bank.responses.response(cell)[1]) for cell, share in zip(cells, shares, strict=True) if share]
    total = sum(share for _, share in used) / (256 if len(used) < 6 else 255)
    return sum(round(share / total) * bank.responses.response(cell)[0].astype(np.int64) for cell, share in used)


def spread_alike(bank, x_m, y_m):
    """Two cells along one axis, the nearest three along the other, with shares of equal variance; None where they hardly differ."""
    grid = bank.grid
    at = (x_m - grid.x0_m) / grid.pitch_m, (y_m - grid.y0_m) / grid.pitch_m
    if not (0 <= at[0] <= grid.nx - 1 and 0 <= at[1] <= grid.ny - 1):
        return None
    spreads = [place % 1 * (1 - place % 1) for place in at]
    if abs(spreads[0] - spreads[1]) / 2 <= 1 / 48:
        return None
    along = []
    for place, spread in zip(at, spreads, strict=True):
        wide = spread < max(spreads)
        here = np.arange(3) + math.floor(place + 0.5) - 1 if wide else np.arange(2) + math.floor(place)
        powers = np.arange(len(here))[:, None]
        moments = [1.0, place, place**2 + max(spreads)]
        along.append((here, np.linalg.solve((here**powers).astype(float), moments[: len(here)])))
    (xs, of_x), (ys, of_y) = along
    if min(xs) < 0 or min(ys) < 0 or max(xs) >= grid.nx or max(ys) >= grid.ny:
        return None
    cells = (ys[:, None] * grid.nx + xs).ravel().tolist()
    return None if MISSING in cells else (cells, np.outer(of_y, of_x).ravel().tolist())


def weighed(bank, points):
    """Responses, and for each its weight of either sign, straight from the definition.

    The polarities with which the sum of every third sample has most energy, as few of them negative as positive; then rounds in
    which weights are divided by what their points get: in every third sample, then in all, of more than four points twice. Nothing
    is outside the band here, and the bank has no equaliser: responses of several are only halved.
    """
    turned = 1 - 2 * channel_bits(np.uint32([IDLE_WORD])).astype(np.int64)
    responses = [interpolated(bank, x_m, y_m, many=len(points) > 4) for x_m, y_m, _ in points]
    if len(points) > 1:
        responses = [(here * turned >> 1) * turned for here in responses]
    norms = np.array([float(np.abs(here).sum()) for here in responses])
    deviating = [here * turned for here in responses]
    third, each = np.array([here[::3] >> 4 for here in deviating]), np.array(deviating)
    third, each = third.reshape(len(points), -1), each.reshape(len(points), -1)
    choices = np.array([(1, *rest) for rest in itertools.product((1, -1), repeat=len(points) - 1)])
    signs = choices[np.argmax([np.sum((choice / norms @ third) ** 2) for choice in choices])]
    signs = -signs if (signs < 0).sum() > len(points) / 2 else signs
    weights = np.ones(len(points))
    for looked_at in (third, each, *([each] if len(points) > 4 else [])) if len(points) > 1 else ():
        got = (whole(signs * weights / norms) @ looked_at > 0) @ looked_at.T * signs / norms
        weights *= np.clip(got.mean() / got, 0.5, 2)
    return np.array(responses), signs * weights / norms


def whole(weights):
    """Weights of 15 bits."""
    return np.rint(weights * (32767 / np.abs(weights).sum())).astype(np.int64)


def amplitude(words, response):
    """What bits do at a point, over the most any bits can do there."""
    return float(np.sum((channel_bits(np.frombuffer(words, "<u4")) * 2.0 - 1) * response) / np.abs(response).sum())


@each_row("count", [1, 2, 5, MAX_FOCI])
def test_composes_what_its_definition_gives(bank, count):
    random = np.random.default_rng(count)
    composer = Composer(bank, IDLE_WORD)
    differing = 0
    for _ in range(5):
        points = [(*random.uniform([0, 0], [19e-3, 17e-3]).tolist(), 1.0) for _ in range(count)]
        words = np.frombuffer(composer.compose(points), "<u4")
        responses, weights = weighed(bank, points)
        assert words.tolist() == drive_words(np.tensordot(whole(weights), responses, 1), IDLE_WORD).tolist()
        exact = np.tensordot(weights, responses, 1)
        where = channel_bits(words) != channel_bits(drive_words(exact, IDLE_WORD))
        assert (np.abs(exact[where]) < 1e-3 * np.abs(exact).max()).all(), "only sums next to zero change their sign"
        differing += where.sum()
    assert differing == 0 or count > 1
    assert differing < 5


def test_on_a_cell_it_plays_the_entry_but_for_bits_too_small_for_8_bits(bank, waves):
    composer = Composer(bank, IDLE_WORD)
    for cell in range(0, MISSING - 8, 5):
        x_m, y_m = GRID.points()[cell]
        words, entry = composer.compose([(x_m, y_m, 1.0)]), bank.drive.words(cell)
        differing = np.mean(channel_bits(np.frombuffer(words, "<u4")) != channel_bits(np.frombuffer(entry, "<u4")))
        assert differing < 0.02  # those below half a level, half of which idle on the right side
        assert amplitude(entry, waves.at(x_m, y_m)) == 1
        assert amplitude(words, waves.at(x_m, y_m)) > 0.9995  # those bits matter least


def test_between_cells_interpolating_reaches_more_than_the_nearest_entry(bank, waves):
    composer = Composer(bank, IDLE_WORD)
    for x_m, y_m in ((7.5e-3 - 1.25e-3, 8.5e-3 + 1.25e-3), (11.2e-3, 9.4e-3), (6.1e-3, 13.3e-3)):
        exact = waves.at(x_m, y_m)
        nearest = amplitude(bank.drive.words(bank.grid.nearest(x_m, y_m)[0]), exact)
        composed = amplitude(composer.compose([(x_m, y_m, 1.0)]), exact)
        assert composed > max(nearest, 0.97)


def test_equal_weights_give_equal_shares_however_unequal_the_responses(tmp_path, make_bank, waves):
    """A plate that answers ten times stronger at one cell than at the other."""
    grid = Grid(5e-3, 3, 2, 5e-3, 6e-3)
    responses = {0: waves.at(*grid.place(0)), 5: 0.1 * waves.at(*grid.place(5))}
    make_bank(tmp_path / "bank", grid, np.isin(np.arange(6), [0, 5]), SAMPLES, responses=responses)
    with Bank.open(tmp_path / "bank") as bank:
        ends = bank.grid.points()[[0, 5]]
        points = [(x_m, y_m, 1.0) for x_m, y_m in ends]
        words = Composer(bank, IDLE_WORD).compose(points)
        strong, weak = abs(amplitude(words, responses[0])), abs(amplitude(words, responses[5]))
        assert strong == pytest.approx(weak, abs=0.03)
        assert min(strong, weak) > 0.65  # two independent fingers: 1 / sqrt(2)
        scales = {cell: bank.responses.response(cell)[1] for cell in (0, 5)}
        as_they_are = drive_words(sum(scales[c] * bank.responses.response(c)[0].astype(float) for c in scales), IDLE_WORD)
        assert amplitude(as_they_are, responses[5]) < 0.2


def test_a_point_that_cannot_move_takes_nothing_from_the_others(tmp_path, make_bank, waves):
    grid = Grid(5e-3, 3, 2, 5e-3, 6e-3)
    responses = {0: waves.at(*grid.place(0)), 5: np.zeros((SAMPLES, CHANNELS))}
    make_bank(tmp_path / "bank", grid, np.isin(np.arange(6), [0, 5]), SAMPLES, responses=responses)
    with Bank.open(tmp_path / "bank") as bank:
        composer = Composer(bank, IDLE_WORD)
        alone, together = (composer.compose([(*grid.place(c), 1.0) for c in cells]).tobytes() for cells in ([0], [0, 5]))
        assert together == alone
        half, together = (
            amplitude(composer.compose([(*grid.place(c), 0.5) for c in cells]), responses[0]) for cells in ([0], [5, 0])
        )
        assert together == pytest.approx(half, abs=0.01)


def test_where_nothing_is_to_be_done_channels_stay_idle(tmp_path, make_bank):
    nothing = np.zeros((9, CHANNELS))
    nothing[4, 3] = 1e-9
    make_bank(tmp_path / "bank", Grid(5e-3, 1, 1, 5e-3, 6e-3), [True], 9, responses={0: nothing})
    with Bank.open(tmp_path / "bank") as bank:
        composer = Composer(bank, IDLE_WORD)
        quiet = [IDLE_WORD] * 9
        quiet[4] |= 1 << 3
        for points in ([(0, 0, 1.0)], [(0, 0, 0.5)], [(0, 0, 1.0), (0, 0, 1.0)], [(0, 0, 0.5), (0, 0, 1.0)]):
            assert np.frombuffer(composer.compose(points), "<u4").tolist() == quiet


def test_only_cells_that_count_are_looked_up(bank):
    composer = Composer(bank, IDLE_WORD)
    x_m, y_m = GRID.points()[MISSING]
    composer.compose([(x_m - GRID.pitch_m, y_m, 1.0)])  # on the cell beside it
    with pytest.raises(BankError, match=f"no entry for cell {MISSING}"):
        composer.compose([(x_m - 0.9 * GRID.pitch_m, y_m, 1.0)])
    with pytest.raises(BankError, match=f"no entry for cell {MISSING}"):
        composer.compose([(*GRID.points()[0], 1.0), (1.0, 1.0, 1.0)])  # beyond the rim: the corner cell


POINT = (0.01, 0.01, 1.0)


@each_row(
    "points",
    [[], [POINT] * (MAX_FOCI + 1), [(np.nan, 0, 1.0)], *([POINT, (0.01, 0.01, a)] for a in (np.nan, np.inf, 0.0, -0.5, 1.01))],
)
def test_refuses_what_cannot_be_composed(bank, points):
    with pytest.raises(ValueError, match=r"points|NaN|amplitude"):
        Composer(bank, IDLE_WORD).compose(points)


def test_words_are_handed_out_without_copying_and_cannot_be_written(bank):
    composer = Composer(bank, IDLE_WORD)
    first = composer.compose([(*GRID.points()[0], 1.0)])
    before = first.tobytes()
    assert composer.compose([(*GRID.points()[20], 1.0)]).tobytes() != before
    assert first != before  # valid until the next call
    assert len(first) == 4 * SAMPLES
    assert first.readonly
