"""What each step of a calibration promises, for any field, grid and point, held against its definition."""

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import j0
from small_plate import small_board

from controller.device.bank.file_format import REST_SAMPLES
from controller.errors import CalibrationError
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.interpolation.cosines import Cosines, Lattice, fill_places
from controller.workshop.calibration.interpolation.kriging import Waves, alike, bessel, foreseen_shares, krige
from controller.workshop.calibration.interpolation.spectra import Bins
from controller.workshop.calibration.recording.alignment import begin_of, shifted
from controller.workshop.calibration.records.points import read_points, write_points

BOARD = small_board()
LENGTH_M, WIDTH_M = EXTENTS_M = (BOARD.plate.length_m, BOARD.plate.width_m)
NOISE = 0.01
seeds = st.integers(0, 2**32 - 1)
quick = settings(max_examples=10)


def middles(columns, rows):
    """Middles of equal cells, row by row."""
    x_m, y_m = (np.arange(columns) + 0.5) * LENGTH_M / columns, (np.arange(rows) + 0.5) * WIDTH_M / rows
    return np.column_stack([np.tile(x_m, rows), np.repeat(y_m, columns)])


def waves(edge_variance=0.0):
    k = np.array([2 * np.pi / 12e-3, 2 * np.pi / 7e-3])
    return Waves(k, 3e-3, EXTENTS_M, edge_variance)


def complex_normal(random, *shape):
    return (random.normal(size=shape) + 1j * random.normal(size=shape)).astype(np.complex64)


def places(random, count):
    return random.uniform(0, 1, (count, 2)) * EXTENTS_M


@quick
@given(seeds, st.integers(3, 9), st.integers(3, 9))
def test_a_sum_of_cosines_that_its_grid_resolves_is_found_everywhere(seed, columns, rows):
    random = np.random.default_rng(seed)
    amplitudes = random.normal(size=(rows, columns, 2))

    def field(points_m):
        along_x = np.cos(np.pi * np.outer(points_m[:, 0] / LENGTH_M, np.arange(columns)))
        along_y = np.cos(np.pi * np.outer(points_m[:, 1] / WIDTH_M, np.arange(rows)))
        return np.einsum("pc,pr,rcn->pn", along_x, along_y, amplitudes)

    found = Cosines.of(field(middles(columns, rows))[None].astype(np.complex64), columns, EXTENTS_M)
    anywhere = places(random, 20)
    assert found.at(anywhere)[0] == pytest.approx(field(anywhere), abs=1e-4 * np.abs(amplitudes).sum())


@quick
@given(seeds, st.integers(4, 8), st.integers(4, 8))
def test_a_grid_is_found_whatever_is_missing_of_it_and_however_its_points_are_ordered(seed, columns, rows):
    random = np.random.default_rng(seed)
    places_m = middles(columns, rows)
    edge = np.zeros((rows, columns), bool)
    edge[[0, -1]], edge[:, [0, -1]] = True, True
    kept = random.permutation(np.flatnonzero(edge.ravel() | (random.random(edge.size) < 0.7)))
    jitter_m = random.uniform(-0.04, 0.04, (kept.size, 2)) * (LENGTH_M / columns, WIDTH_M / rows)
    found = Lattice.found_in(places_m[kept] + jitter_m)
    assert found is not None
    assert found.place.tolist() == kept.tolist()
    assert found.covers(LENGTH_M, WIDTH_M)
    assert not found.covers(1.5 * LENGTH_M, WIDTH_M)
    assert found.points() == pytest.approx(places_m, abs=0.1 * found.pitch_m)
    assert Lattice.found_in(places(random, 25)) is None, "scattered points lie on none"


@quick
@given(seeds, st.sampled_from([0.0, 0.5]))
def test_each_point_is_foreseen_as_if_it_alone_had_not_been_measured(seed, edge_variance):
    """By leaving it out and solving again, point by point and channel by channel, some of which were not measured there."""
    random = np.random.default_rng(seed)
    prior, points_m = waves(edge_variance), places(random, 9)
    spectra, known = complex_normal(random, 2, 9, 3), random.random((9, 3)) < 0.8
    spectra[:, ~known] = 0
    field, left_out = krige(points_m, spectra, known, prior, NOISE)
    covariance = prior.between(points_m, points_m)
    for bin_ in range(2):
        for point, channel in zip(*np.nonzero(known), strict=True):
            others = np.flatnonzero(known[:, channel] & (np.arange(9) != point))
            whole = covariance(bin_)[np.ix_(others, others)] + NOISE * np.eye(others.size)
            weights = np.linalg.solve(whole, spectra[bin_, others, channel])
            assert left_out[bin_, point, channel] == pytest.approx(covariance(bin_)[point, others] @ weights, abs=2e-3)
            here = np.flatnonzero(known[:, channel])
            whole = covariance(bin_)[np.ix_(here, here)] + NOISE * np.eye(here.size)
            weights = np.linalg.solve(whole, spectra[bin_, here, channel])
            assert field.at(points_m[[point]])[bin_, 0, channel] == pytest.approx(covariance(bin_)[point, here] @ weights, abs=2e-3)


@quick
@given(seeds)
def test_more_points_never_foresee_less_and_at_a_point_nearly_all_is_known(seed):
    random = np.random.default_rng(seed)
    points_m, targets_m, bins = places(random, 12), places(random, 10), np.arange(2)
    few, many = (foreseen_shares(waves(), points_m[:count], targets_m, bins, NOISE) for count in (6, 12))
    assert (few <= many + 1e-9).all()
    assert (many <= 1).all()
    assert (foreseen_shares(waves(), points_m, points_m, bins, NOISE) > 0.99).all()


@quick
@given(seeds)
def test_a_missing_place_of_a_grid_is_estimated_from_its_neighbours_and_what_was_measured_stays(seed):
    random = np.random.default_rng(seed)
    lattice = Lattice.found_in(middles(10, 8))
    prior = Waves(2 * np.pi / (np.array([4.0, 3.0]) * lattice.pitch_m), lattice.pitch_m / 10, EXTENTS_M, 0.0)
    directions = random.uniform(0, 2 * np.pi, 30)
    phase = lattice.points() @ np.stack([np.cos(directions), np.sin(directions)])
    true = np.stack([np.exp(1j * k * phase) @ complex_normal(random, 30, 2) for k in prior.wavenumber]).astype(np.complex64)
    known = random.random((80, 2)) < 0.95
    values = np.where(known, true, 0)
    foreseen = fill_places(lattice, values, known, prior, 1e-4)
    assert (values[:, known] == true[:, known]).all()
    assert np.isfinite(foreseen[:, ~known]).all()
    error = np.abs(values - true)[0][~known]
    assert error.size == 0 or np.sqrt((error**2).mean()) < 0.2 * np.abs(true[0]).std()


@given(st.lists(st.lists(st.booleans(), min_size=4, max_size=4), min_size=1, max_size=6))
def test_groups_of_channels_share_their_points_and_leave_none_out(known):
    known = np.array(known)
    counted = np.zeros_like(known, int)
    for points, channels in alike(known):
        counted[np.ix_(points, channels)] += 1
        assert all((np.flatnonzero(known[:, channel]) == points).all() for channel in channels)
    assert (counted == known).all()


def test_bessels_function_is_that_of_scipy():
    far = np.concatenate([np.linspace(0, 300, 100_001), np.random.default_rng(1).uniform(0, 3000, 100_000)])
    assert np.abs(bessel(far) - j0(far)).max() < 6e-7


@quick
@given(seeds, st.floats(-0.5, 0.5), st.sampled_from([-3.0, -0.2, 1.0]), st.sampled_from([96e3, 192e3, 500e3]))
def test_an_emission_is_found_to_a_hundredth_of_a_sample_by_a_track_of_either_sign(seed, fraction, unit, rate_hz):
    random = np.random.default_rng(seed)
    bit_clock_hz, begin = 500e3, 300 + fraction
    levels = np.repeat(random.random(250) < 0.5, 8)  # the patch is driven at tens of kHz
    fine = 64
    count = round(len(levels) / bit_clock_hz * rate_hz) + 600
    time = (np.arange(count * fine) / fine - begin) / rate_hz * bit_clock_hz
    index = np.floor(time).astype(int)
    held = np.where((index >= 0) & (index < len(levels)), levels[np.clip(index, 0, len(levels) - 1)] - levels.mean(), 0.0)
    spectrum = np.fft.rfft(held)
    spectrum[np.fft.rfftfreq(held.size, 1 / fine) >= 0.45] = 0  # the recorder's own filter
    sync = unit * np.fft.irfft(spectrum, held.size)[::fine] + 0.01 * random.normal(size=count)
    assert begin_of(sync, rate_hz, levels, bit_clock_hz, 310, 100) == pytest.approx(begin, abs=0.02)
    with pytest.raises(CalibrationError, match="does not hear"):
        begin_of(random.normal(size=count), rate_hz, levels, bit_clock_hz, 310, 100)
    with pytest.raises(CalibrationError, match="ends before"):
        begin_of(sync[:400], rate_hz, levels, bit_clock_hz, 310, 100)


@quick
@given(st.floats(200, 300), st.integers(0, 50), st.floats(0.01, 0.3), st.floats(0, 6))
def test_a_record_is_cut_where_it_begins_between_samples_too(begin, before, frequency, phase):
    def tone(at):
        return np.sin(2 * np.pi * frequency * at + phase) * np.exp(-(((at - 275) / 60) ** 2))

    cut = shifted(tone(np.arange(1000.0)), begin, before, 200)
    assert cut == pytest.approx(tone(begin - before + np.arange(200.0)), abs=1e-3)


@given(st.floats(1e3, 200e3), st.floats(1.01, 2.0))
def test_waves_obey_mindlins_equation_and_are_slower_than_kirchhoffs(frequency_hz, more):
    plate = Dispersion.of(BOARD.plate)
    k, w = float(plate.wavenumber(frequency_hz)), 2 * np.pi * frequency_hz
    bending = plate.stiffness_nm * k**2 - plate.rotation_kg * w**2
    shear = plate.shear_n_m * k**2 - plate.mass_kg_m2 * w**2
    coupling = plate.shear_n_m * plate.mass_kg_m2 * w**2
    assert bending * shear == pytest.approx(coupling, rel=1e-6)
    assert plate.wavelength_m(more * frequency_hz) < plate.wavelength_m(frequency_hz)
    assert plate.slowed_by_shear(more * frequency_hz) < plate.slowed_by_shear(frequency_hz) < 1


@quick
@given(seeds, st.integers(BOARD.waveform.samples, 2 * BOARD.waveform.samples))
def test_what_the_band_passes_and_what_it_leaves_out_are_the_whole(seed, samples):
    bins = Bins.of(BOARD.waveform, samples)
    spectra = complex_normal(np.random.default_rng(seed), bins.frequency_hz.size, 2, 3)
    outside = bins.whole(spectra * (1 - bins.gain[:, None, None]).astype(np.float32))
    assert bins.band_limited(spectra) + outside == pytest.approx(bins.whole(spectra), abs=1e-5)
    rest = bins.rest(spectra)
    assert rest.shape == (2, bins.rest_rows, 3)
    assert rest[:, 0] == pytest.approx(outside[:, : -1 - REST_SAMPLES : -1].mean(axis=1), abs=1e-5), "the last samples, reversed"


def test_measured_responses_have_the_slope_and_keep_what_it_leaves_out():
    flat, sloped = (Bins.of(msgspec.structs.replace(BOARD.waveform, slope=slope), 500) for slope in (0.0, -1.0))
    spectra = complex_normal(np.random.default_rng(1), flat.frequency_hz.size, 2, 3)
    times_f = spectra * np.maximum(flat.frequency_hz, 1).astype(np.float32)[:, None, None] / np.float32(45e3)
    assert sloped.band_limited(times_f) == pytest.approx(flat.band_limited(spectra), abs=1e-5)
    falling = 45e3 / np.maximum(flat.frequency_hz, 1).astype(np.float32)[:, None, None]  # as a plate's responses do
    spectra = complex_normal(np.random.default_rng(2), flat.frequency_hz.size, 40, 3) * falling
    of_bits = sloped.band_limited(spectra)[:, ::-1]
    left_out = flat.band_limited(spectra)[:, ::-1] - of_bits
    kept = sloped.rest(spectra) - flat.rest(spectra)
    means = left_out.reshape(40, flat.rest_rows, REST_SAMPLES, 3).mean(axis=2)
    counts = (of_bits > 0).reshape(40, flat.rest_rows, REST_SAMPLES, 3).sum(axis=2)
    moved = np.sum(left_out, where=of_bits > 0, axis=(1, 2))
    of_kept, of_means = (np.sum(counts * some, axis=(1, 2)) - moved for some in (kept, means))
    in_band = np.sum(of_bits, where=of_bits > 0, axis=(1, 2))
    error, by_means = (float(np.sqrt(np.mean((some / in_band) ** 2))) for some in (of_kept, of_means))
    print(f"of what a place's own bits move in the band, {error:.4f} is not known; {by_means:.4f} by means")
    assert error < 0.004 < by_means


@quick
@given(seeds, st.integers(1, 30))
def test_points_that_are_written_are_read_again(tmp_path_factory, seed, count):
    random = np.random.default_rng(seed)
    file, points_m = tmp_path_factory.mktemp("points") / "points.csv", places(random, count)
    names = tuple(f"p{number}.{random.integers(10)}" for number in range(count))
    write_points(file, names, points_m)
    read, found_m = read_points(file, BOARD)
    assert read == names
    assert found_m == pytest.approx(points_m, abs=1e-10)
    write_points(file, (*names, "again"), np.vstack([points_m, points_m[:1]]))
    with pytest.raises(CalibrationError, match=r"points p0\.. and again are the same place"):
        read_points(file, BOARD)
    write_points(file, (*names, names[0]), np.vstack([points_m, places(random, 1)]))
    with pytest.raises(CalibrationError, match="is there twice"):
        read_points(file, BOARD)
