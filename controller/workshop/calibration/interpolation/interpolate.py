"""From responses at measured points to those of every place: which method, with which wavenumbers, how good it is."""

from collections.abc import Callable, Collection
from typing import Literal, NamedTuple

import msgspec
import numpy as np

from controller.arrays import Bools, Floats, Indices, blocks
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.interpolation.cosines import Cosines, Lattice, fill_places
from controller.workshop.calibration.interpolation.interpolated import InterpolatedResponses, LeaveOut
from controller.workshop.calibration.interpolation.kriging import Prior, SpectralField, Waves, krige
from controller.workshop.calibration.interpolation.modal_prior import ModalPrior, unforeseen
from controller.workshop.calibration.interpolation.plate_size import GlassSize, fit_size
from controller.workshop.calibration.interpolation.point_fit import fit_points
from controller.workshop.calibration.interpolation.spectra import Bins, Spectra
from controller.workshop.calibration.interpolation.wave_fit import WaveFit, fit_waves
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.calibration.point_plan import half_wave_m, scattered_count
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.plate_modes import in_words

LEAST_KEPT = 0.93  # of points left out, their median: worse responses are refused
STILL = 0.2  # of the median point's movement: those that move less are not evaluated
LEAST_POINTS = 12  # of any plate
PITCH_SLACK = 1.02  # a grid may be as much coarser than half a wavelength: the board's constants are known no better
MOST_SCATTERED = 4000  # one matrix of them takes 128 MB
AROUND_HZ = 1e3  # over which it is found how far spectra are foreseen
FITTED_SHARE = 0.5  # of the points that a plate needs: fewer do not foresee each other
OTHER_SIZE = 0.6  # of the energy that is not foreseen: glass of a size that explains less is not another's
MOST_MODES = 800  # of glass whose size is looked for: each size takes 0.2 s of 400, 8 s of 2,100
MOST_FITTED = 1000  # points whose errors are looked for, some minutes

Progress = Callable[[str, int, int], None]
Measured = tuple[Floats, Spectra, Bools, Bins]  # points in m, spectra, which are known, their bins


def interpolate(
    board: Board,
    learned: LearnedResponses,
    progress: Progress = lambda _what, _done, _total: None,  # called with what is done, how much of it, and all of it
    dead: Collection[int] = (),  # channels that are known to do nothing: their responses are zero
    # Of a board's plate, which says what lies between scattered points if it foresees those left out better than waves do
    model: Callable[[Board], Modes] | None = None,
    *,
    exact: bool = False,  # points are where they are said to be: no errors of theirs are looked for
) -> tuple[InterpolatedResponses, WaveFit]:
    """Interpolate between measured points: by cosines on a grid of cells, by wavenumber otherwise.

    Raises CalibrationError if records, points or channels are too few, points lie on a grid too coarse, or points left out are not
    foreseen well.
    """
    waveform = board.waveform
    known, used = _checked(board, learned, dead)
    points_m = learned.points_m[used]
    bins = Bins.of(waveform, learned.responses.shape[1])
    spectra = bins.of_records(learned.responses, used)
    spectra *= known[None].astype(np.float32)
    lattice = Lattice.found_in(points_m)
    if lattice is not None:
        _refuse_coarse(board, lattice)
    waves = fit_waves(board, points_m, spectra, known, bins, lambda done, total: progress("wavelengths", done, total))
    errors = None
    if lattice is not None and lattice.covers(board.plate.length_m, board.plate.width_m):
        prior = Waves.of(waves.dispersion, bins, board, waves.edge_variance)
        found = _between_cells(board, lattice, (points_m, spectra, known, bins), prior, progress)
    else:
        if not exact and errors_looked_for(board, len(points_m)):
            responses = learned.responses[used]
            errors = fit_points(board, points_m, responses, known, bins, waves, lambda *done: progress("errors of points", *done))
        if errors is not None and errors.corrected:
            points_m = np.clip(points_m + errors.errors[:, :2], 0, (board.plate.length_m, board.plate.width_m))
            spectra = bins.of_records(responses, np.arange(len(responses)), errors.errors[:, 3])
            spectra *= (known * np.exp(-errors.errors[:, 2:3])).astype(np.float32)
            waves = fit_waves(board, points_m, spectra, known, bins, lambda *done: progress("wavelengths again", *done))
        found = _between_points(board, (points_m, spectra, known, bins), waves, model, progress)
    median, least = found.leave_out.summary()
    if not median >= LEAST_KEPT:
        raise CalibrationError(
            f"points left out keep {median:.2f} of their amplitude at the median, below {LEAST_KEPT:g}: {len(points_m)} points are"
            f" too few (calibrate plan proposes {scattered_count(board)} scattered ones), their places are off by 1 mm and more, or"
            " their records are noise"
        )
    provenance = msgspec.structs.replace(
        learned.provenance,
        kind=found.kind,
        model=found.words,
        points=len(points_m),
        kept=(median, least),
        foreseen=found.leave_out.foreseen(),
    )
    reach = None if found.reach is None else (found.reach, points_m)
    source = InterpolatedResponses(board, bins, found.field, provenance, found.leave_out, reach, errors, found.size)
    return source, waves


def errors_looked_for(board: Board, points: int) -> bool:
    """Whether errors of single points are looked for: among enough points, and no grid."""
    return FITTED_SHARE * scattered_count(board) <= points <= MOST_FITTED


class _Interpolation(NamedTuple):
    """Responses of every place, and how well they foresee points left out."""

    field: SpectralField
    leave_out: LeaveOut
    kind: Literal["measured", "completed"]
    words: str
    reach: Prior | None  # says how far from the measured points the field is known; None where it is known on the whole plate
    size: GlassSize | None = None  # of the glass, where the model is of another size than board.toml says


def _between_cells(board: Board, lattice: Lattice, measured: Measured, prior: Waves, progress: Progress) -> _Interpolation:
    """By cosines; cells that were not measured are filled from their neighbours."""
    _, spectra, known, bins = measured
    places = lattice.points()
    values = np.zeros((len(bins.frequency_hz), len(places), known.shape[1]), np.complex64)
    there = np.zeros((len(places), known.shape[1]), bool)
    values[:, lattice.place], there[lattice.place] = spectra, known
    foreseen = fill_places(lattice, values, there, prior, progress=lambda done, total: progress("neighbours", done, total))
    leave_out = _evaluated(board, bins, places, values, foreseen, there)
    field = Cosines.of(values, lattice.x_m.size, (board.plate.length_m, board.plate.width_m))
    words = f"cosines between {len(places)} cells of {lattice.pitch_m * 1e3:.2f} mm"
    return _Interpolation(field, leave_out, "measured", words, None)


def _between_points(
    board: Board, measured: Measured, waves: WaveFit, model: Callable[[Board], Modes] | None, progress: Progress
) -> _Interpolation:
    """By waves, or by the model if it foresees points left out better.

    Raises CalibrationError if there are more than `MOST_SCATTERED` points.
    """
    points_m, spectra, known, bins = measured
    if len(points_m) > MOST_SCATTERED:
        raise CalibrationError(
            f"{len(points_m):,} points are neither a grid of cells of the whole plate nor {MOST_SCATTERED:,} or less"
        )
    prior = Waves.of(waves.dispersion, bins, board, waves.edge_variance)
    chosen: Prior = prior
    kind: Literal["measured", "completed"] = "measured"
    words = f"waves between {len(points_m)} points"
    modes, size = _model_of(model, board, waves, measured, progress) if model else (None, None)
    if modes is not None:
        chosen = ModalPrior.of(board, modes, waves, bins)
        words, kind = f"{in_words(board, modes)}, between {len(points_m)} points", "completed"
    field, foreseen = krige(points_m, spectra, known, chosen, waves.noise, lambda done, total: progress("points", done, total))
    return _Interpolation(field, _evaluated(board, bins, points_m, spectra, foreseen, known), kind, words, prior, size)


def _model_of(
    model: Callable[[Board], Modes], board: Board, waves: WaveFit, measured: Measured, progress: Progress
) -> tuple[Modes | None, GlassSize | None]:
    """The model if it foresees points left out better than waves do; and the size of the glass if that of another does much better.

    A bank is not made by that one: glass of another size is like other edges, and less right than waves if these are.
    """
    modes = model(board)

    def left(there: Board) -> Floats:
        of_there = model(there)
        return unforeseen(*measured, lambda some: ModalPrior.of(board, of_there, waves, some))

    by_waves = float(unforeseen(*measured, lambda some: Waves.of(waves.dispersion, some, board, waves.edge_variance)).mean())
    stated = float(left(board).mean())
    chosen = modes if stated < by_waves else None
    if modes.count > MOST_MODES:
        return chosen, None
    size = fit_size(board, left, lambda done, total: progress("size of the glass", done, total))
    return chosen, size if left(size.of(board)).mean() < OTHER_SIZE * min(stated, by_waves) else None


def _checked(board: Board, learned: LearnedResponses, dead: Collection[int]) -> tuple[Bools, Indices]:
    """What was measured of the channels that have actuators, at the points where anything was: known, and which points."""
    waveform = board.waveform
    if not abs(learned.bit_clock_hz / waveform.bit_clock_hz - 1) < 1e-9:
        raise CalibrationError(
            f"responses at {learned.bit_clock_hz:g} Hz do not fit the board's bit_clock_hz = {waveform.bit_clock_hz:g}"
        )
    samples = learned.responses.shape[1]
    if samples < waveform.samples:
        raise CalibrationError(
            f"responses of {samples / learned.bit_clock_hz * 1e3:.2f} ms are shorter than an emission of"
            f" {waveform.duration_ms:g} ms: record for longer"
        )
    channels = np.zeros(learned.known.shape[1], bool)
    channels[[actuator.channel for actuator in board.actuators]] = True
    channels[list(dead)] = False
    known = learned.known & channels
    used = np.flatnonzero(known.any(axis=1))
    if len(used) < LEAST_POINTS:
        raise CalibrationError(
            f"{len(used)} points were measured: {LEAST_POINTS} is the least, this plate needs {scattered_count(board)}"
        )
    silent = np.flatnonzero(channels & (known.sum(axis=0) < LEAST_POINTS))
    if silent.size:
        named = ", ".join(map(str, silent.tolist()))
        raise CalibrationError(
            f"channels measured at fewer than {LEAST_POINTS} points: {named}; measure them, or take them from the board"
        )
    return known[used], used


def _refuse_coarse(board: Board, lattice: Lattice) -> None:
    """Raise for a regular grid of more than half a wavelength: waves in it are mistaken for others."""
    limit_m = half_wave_m(board)
    if lattice.pitch_m > PITCH_SLACK * limit_m:
        raise CalibrationError(
            f"the points are a regular grid of {lattice.pitch_m * 1e3:.2f} mm, above half a wavelength ({limit_m * 1e3:.2f} mm),"
            " which mistakes waves for others: measure a finer grid, or scattered points (haptic-panel calibrate plan)"
        )


def _evaluated(board: Board, bins: Bins, points_m: Floats, spectra: Spectra, foreseen: Spectra, known: Bools) -> LeaveOut:
    """Leave-out error, points in blocks; those beyond the cells of a bank are not evaluated: nobody plays there."""
    known = known & ~np.isnan(foreseen[0])
    agreed, magnitude, expected = np.zeros((3, len(points_m)))
    for some in blocks(len(points_m), 64):
        measured = bins.band_limited(spectra[:, some]) * known[some, None]
        estimate = bins.band_limited(np.where(known[some], foreseen[:, some], 0))
        agreed[some] = (np.sign(estimate) * measured).sum(axis=(1, 2))
        expected[some] = np.abs(estimate).sum(axis=(1, 2))
        magnitude[some] = np.abs(measured).sum(axis=(1, 2))
    moves = magnitude / np.maximum(known.sum(axis=1), 1)
    from_edge_m = np.minimum(points_m, (board.plate.length_m, board.plate.width_m) - points_m).min(axis=1)
    evaluated = (magnitude > 0) & (moves > STILL * np.median(moves)) & (from_edge_m >= board.bank.pitch_mm * 1e-3)
    kept, over_foreseen = (
        np.divide(agreed, of, out=np.full(len(points_m), np.nan), where=evaluated & (of > 0)) for of in (magnitude, expected)
    )
    return LeaveOut(points_m, kept, over_foreseen, _trusted(bins, spectra, foreseen, known))


def _trusted(bins: Bins, spectra: Spectra, foreseen: Spectra, known: Bools) -> Floats:
    """`LeaveOut.trusted`, of the bins around each."""
    agreed, expected = np.zeros((2, len(spectra)))
    for bin_, (measured, estimate) in enumerate(zip(spectra, foreseen, strict=True)):
        there = estimate[known]
        agreed[bin_], expected[bin_] = np.vdot(there, measured[known]).real, np.vdot(there, there).real
    around = np.ones(1 + 2 * round(AROUND_HZ / (2 * bins.frequency_hz[1])))
    over, under = (np.convolve(one, around, mode="same") for one in (agreed, expected))
    found: Floats = np.clip(np.divide(over, under, out=np.zeros(len(spectra)), where=under > 0), 0, 1)
    return found
