"""From a measurement folder to learned responses: read, deconvolve, find what is wrong, correct what can be corrected."""

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Floats
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.checking.checks import FATAL, NOISY_COHERENCE, Objection, raise_fatal
from controller.workshop.calibration.checking.findings import findings_of, remarks_on
from controller.workshop.calibration.checking.wiring import Wiring
from controller.workshop.calibration.cores import on_all_cores
from controller.workshop.calibration.frame import MeasuringFrame, middle_m
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.calibration.learning.locating import enough, locate
from controller.workshop.calibration.learning.sensor_chain import SensorChain, loaded, sensor_chain
from controller.workshop.calibration.learning.time_responses import responses_in_time
from controller.workshop.calibration.records.measurements import Measurement, read_measurement, sha256_of
from controller.workshop.calibration.transfer_functions.clock import RecorderClock, clock_of
from controller.workshop.calibration.transfer_functions.deconvolution import Deconvolution
from controller.workshop.calibration.transfer_functions.direct_wave import DirectWaves, direct_waves
from controller.workshop.calibration.transfer_functions.point_cache import PointCache
from controller.workshop.calibration.transfer_functions.transfers import Transfers

CLOCK_POINTS = 4  # that the clock is found from
CHAIN_POINTS = 24  # that a sensor's mass is found from
WAVE_POINTS = 64  # that the direct wave is found from
STATED_DELAY_S = 60e-6  # how far from its stated delay a record is searched
DELAY_TOLERANCE_S = 3e-6  # what geometry and an unknown edge leave open


@dataclass(frozen=True, eq=False)
class Learned:
    """What a measurement gives."""

    measurement: Measurement
    responses: LearnedResponses
    findings: tuple[Objection, ...]
    clock: RecorderClock
    delay_s: float  # by which what happened is later in the records than they say; corrected
    waves: DirectWaves | None
    frame: MeasuringFrame | None  # of the points' stated places; corrected if it is another one than they say. None: not found
    wiring: Wiring
    chain: SensorChain | None  # what all records have in common; its mass is divided out. None: without a frame
    excited_hz: tuple[float, float]  # what was played excites this band
    residual: Floats  # (point,): share of the records' power that no drive explains
    learned_anew: int  # points that were not in the cache

    def require(self, accepted: Collection[str] = ()) -> LearnedResponses:
        """The responses, if nothing is wrong that would make a wrong bank.

        Raises CalibrationError, naming all that is wrong and not `accepted`.
        """
        raise_fatal(str(self.measurement.folder), self.findings, accepted)
        return self.responses


def learn(
    folder: Path,
    board: Board,
    *,
    samples: int | None = None,  # of a response; twice an emission by default, or what the records hold
    cache: Path | None = None,  # folder for results of points, by the hash of their files: an interrupted run goes on where it was
    progress: Callable[[int, int], None] = lambda _done, _total: None,  # called with the points done and their number
) -> Learned:
    """Learn the responses of a board's plate from a measurement folder.

    Raises CalibrationError if the folder cannot be read or determines nothing. What else is wrong is in `findings`.
    """
    measurement = read_measurement(folder, board)
    there = measurement.there
    if not there:
        raise CalibrationError(f"{folder}: no record of any point: {measurement.settings.records.files} names no file")
    first = measurement.records(there[0])
    length = first.values.shape[2]
    end_s = length / measurement.settings.sample_rate_hz + (measurement.settings.records.first_sample_us or 0) * 1e-6
    deconvolution = Deconvolution(measurement, board, length)
    excited_hz = deconvolution.excited_hz
    stated = measurement.settings.records.first_sample_us is not None
    widest_s = STATED_DELAY_S if stated else end_s / 2
    clock, delay_s = _clock_and_delay(measurement, board, deconvolution, there, widest_s)
    results, files, again = _transfers(measurement, board, deconvolution, there, clock, cache, progress)
    frame, measurement, moved = _located(measurement, board, deconvolution, results)
    chain, in_common = None, list[Objection]()
    if frame is not None and len(results) >= CHAIN_POINTS:
        chain, results = _unloaded(measurement, board, deconvolution, results, frame, 0.0 if stated else delay_s)
        in_common = chain.findings(measurement.settings.records.sensor_mass_mg)
    waves = _waves(measurement, board, deconvolution, results, widest_s)
    if waves is not None:
        delay_s = waves.delay_s
    elif not stated:
        raise CalibrationError(
            f"{folder}: when the records begin cannot be found from {len(there)} points: give records.first_sample_us, the time of"
            " their first sample after the start of the drive"
        )
    if stated and abs(delay_s) <= DELAY_TOLERANCE_S:
        delay_s = 0.0
    count = 2 * board.waveform.samples if samples is None else samples
    responses, ringing = responses_in_time(measurement, board, deconvolution, results, count, delay_s, files)
    nowhere = frame is None and enough(board, len(results))  # then nobody is accused: places are not what they are said to be
    findings, wiring = findings_of(measurement, board, deconvolution, results, responses, None if nowhere else waves)
    if any(finding.kind in FATAL for finding in in_common):  # by it all channels look misplaced
        findings = [finding for finding in findings if finding.kind not in ("swapped", "inverted", "undecided", "strength")]
    findings += [*in_common, *moved, *remarks_on(measurement, board, clock, delay_s, ringing, excited_hz)]
    residual = np.full(len(measurement.names), np.nan)
    for point, found in results.items():
        residual[point] = found.residual
    return Learned(
        measurement, responses, tuple(findings), clock, delay_s, waves, frame, wiring, chain, excited_hz, residual, again
    )


def _clock_and_delay(
    measurement: Measurement, board: Board, deconvolution: Deconvolution, there: list[int], widest_s: float
) -> tuple[RecorderClock, float]:
    """From a few points; the delay roughly."""
    some = there[:: max(len(there) // CLOCK_POINTS, 1)][:CLOCK_POINTS]
    records = {point: measurement.records(point) for point in some}
    rough = {point: deconvolution.transfers(deconvolution.spectra(one), one.sound) for point, one in records.items()}
    waves = _waves(measurement, board, deconvolution, rough, widest_s)
    delay_s = 0.0 if waves is None else waves.delay_s
    return clock_of(deconvolution, list(records.values()), delay_s), delay_s


def _located(
    measurement: Measurement, board: Board, deconvolution: Deconvolution, results: dict[int, Transfers]
) -> tuple[MeasuringFrame | None, Measurement, list[Objection]]:
    """The frame of the points, the measurement with their places on the plate, and what is said of it."""
    points, stated_m = list(results), measurement.points_m
    frame = locate(board, deconvolution.bins, stated_m[points], *_stacked(results))
    if frame is None or not frame.differs(board, stated_m[points]):
        return frame, measurement, []
    places_m = np.clip(frame.places(stated_m, middle_m(board)), 0, (board.plate.length_m, board.plate.width_m))
    return (
        frame,
        replace(measurement, points_m=places_m),
        [Objection("frame", f"points lie elsewhere than stated, corrected: {frame.in_words()}")],
    )


def _unloaded(
    measurement: Measurement,
    board: Board,
    deconvolution: Deconvolution,
    results: dict[int, Transfers],
    frame: MeasuringFrame,
    around_s: float,
) -> tuple[SensorChain, dict[int, Transfers]]:
    """What all records have in common, and transfer functions without the sensor's mass."""
    bins = deconvolution.bins
    chain = sensor_chain(board, bins, measurement.points_m[list(results)], *_stacked(results), frame.factor, around_s)
    mass_kg = chain.divided_kg(measurement.settings.records.sensor_mass_mg)
    free = (1 / loaded(board, bins.frequency_hz, mass_kg)).astype(np.complex64)
    return chain, {point: replace(found, transfer=found.transfer * free) for point, found in results.items()}


def _stacked(results: dict[int, Transfers]) -> tuple[NDArray[np.complex64], Bools]:
    """Transfer functions (point, 32, bin), and which are resolved."""
    return np.stack([found.transfer for found in results.values()]), np.stack([found.resolved for found in results.values()])


def _waves(
    measurement: Measurement, board: Board, deconvolution: Deconvolution, results: dict[int, Transfers], widest_s: float
) -> DirectWaves | None:
    points = list(results)[:: max(len(results) // WAVE_POINTS, 1)]
    transfers = np.stack([results[point].transfer for point in points])
    resolved = np.stack([results[point].resolved & ~(results[point].coherence < NOISY_COHERENCE) for point in points])
    return direct_waves(board, deconvolution.bins, measurement.points_m[points], transfers, resolved, widest_s)


def _transfers(
    measurement: Measurement,
    board: Board,
    deconvolution: Deconvolution,
    there: list[int],
    clock: RecorderClock,
    cache: Path | None,
    progress: Callable[[int, int], None],
) -> tuple[dict[int, Transfers], dict[Path, str], int]:
    """Of every point that is there, the hashes of all files, and how many points were learned again."""
    hashes = {file: sha256_of(file) for file in measurement.common_files}
    kept = PointCache(cache, [*hashes.values(), board.digest().hex(), f"{clock.ppm:.2f} {deconvolution.bins.length}"])

    def learned(point: int) -> tuple[Transfers, bool]:
        files = measurement.files(point)
        hashes.update({file: sha256_of(file) for file in files if file not in hashes})
        own = [hashes[file] for file in files]
        found = kept.find(measurement.names[point], own)
        if found is not None:
            return found, False
        records = measurement.records(point)
        if records.values.shape[2] != deconvolution.length:
            raise CalibrationError(
                f"{files[0]}: point {measurement.names[point]}: {records.values.shape[2]:,} samples, and point"
                f" {measurement.names[there[0]]} has {deconvolution.length:,}: all records are of one length"
            )
        found = deconvolution.learn(records, clock.ppm)
        kept.keep(measurement.names[point], own, found)
        return found, True

    results: dict[int, Transfers] = {}
    again = 0
    for point, (found, relearned) in zip(there, on_all_cores(learned, there), strict=True):
        results[point] = found
        again += relearned
        progress(len(results), len(there))
    kept.forget_others()
    return results, hashes, again
