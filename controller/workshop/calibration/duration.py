"""How long a bank of measured points takes on this machine: what is done most often is done a few times, and timed.

Most of the time goes into three things: points are learned, all points are solved for at one frequency, cells are computed from
them. How often each is done follows from the numbers of points, frequencies and cells; the rest is in proportion.
"""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from controller.arrays import Bools, Floats
from controller.device.bank.grid import Grid
from controller.device.board.board import Board
from controller.workshop.calibration.cores import cores, on_all_cores
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.interpolation import point_fit, wave_fit
from controller.workshop.calibration.interpolation.cosines import Cosines, Lattice
from controller.workshop.calibration.interpolation.interpolate import errors_looked_for
from controller.workshop.calibration.interpolation.kriging import SpectralField, Waves, krige
from controller.workshop.calibration.interpolation.spectra import Bins, Spectra
from controller.workshop.calibration.records.measurements import read_measurement
from controller.workshop.calibration.transfer_functions.deconvolution import Deconvolution

PER_POINT: Final = 2.0  # times that learning one takes: with clock, frame, mass and delay
PER_ERROR: Final = 2.0  # with what is wrong with it
PER_CELL: Final = 1.4  # with what is written and compared
CELLS: Final = 64  # that are timed


class Foreseen(NamedTuple):
    """What there is to do, and how long it takes here."""

    points: int
    solves: int  # frequencies at which all points are solved for, over all fits
    cells: int
    seconds: float

    def in_words(self) -> str:
        """One line."""
        return (
            f"about {self.seconds:.0f} s (cores used: {cores()}), if {self.points:,} points, {self.solves:,} solutions between them"
            f" and {self.cells:,} cells take as long here as some just did"
        )


def foreseen(board: Board, folder: Path, pitch_m: float, clock: Callable[[], float] = time.perf_counter) -> Foreseen | None:
    """What a bank of a measurement folder takes; None without any record. Raises CalibrationError if it cannot be read."""
    measurement = read_measurement(folder, board)
    there = measurement.there
    if not there:
        return None
    points_m, cells_m = measurement.points_m[there], Grid.of(board.plate, pitch_m).points()
    bins = Bins.of(board.waveform, 2 * board.waveform.samples)
    few = bins.part(np.linspace(0, len(bins.frequency_hz) - 1, 4 * cores()).astype(int))
    plate_m = board.plate.length_m, board.plate.width_m
    fitted_m = points_m[: wave_fit.POINTS]
    deconvolution = Deconvolution(measurement, board, measurement.records(there[0]).values.shape[2])
    some = [there[index % len(there)] for index in range(2 * cores())]

    def timed(work: Callable[[], object], count: int) -> float:
        work()  # the first time takes tables and factors besides
        begun = clock()
        work()
        return (clock() - begun) / count

    point_s = timed(lambda: list(on_all_cores(lambda one: deconvolution.learn(measurement.records(one), 0.0), some)), len(some))
    solve_s = timed(lambda: krige(fitted_m, *_ones(board, few, fitted_m), _waves(board, few)), len(few.frequency_hz))
    lattice, errors = Lattice.found_in(points_m), False
    if lattice is not None and lattice.covers(*plate_m):
        field: SpectralField = Cosines.of(_ones(board, bins, lattice.points())[0], lattice.x_m.size, plate_m)
        solves = wave_fit.SOLVES
    else:
        errors = errors_looked_for(board, len(there))
        field = _waves(board, bins).field(points_m, _ones(board, bins, points_m)[0])
        solves = wave_fit.SOLVES * (1 + errors) + point_fit.SOLVES * errors + len(bins.frequency_hz)
    spread_m = cells_m[np.linspace(0, len(cells_m) - 1, CELLS).astype(int)]
    cell_s = timed(lambda: (bins.rest(spectra := field.at(spread_m)), bins.band_limited(spectra)), CELLS)
    seconds = (PER_POINT + PER_ERROR * errors) * len(there) * point_s + solves * solve_s + PER_CELL * len(cells_m) * cell_s
    return Foreseen(len(there), solves, len(cells_m), seconds)


def _waves(board: Board, bins: Bins) -> Waves:
    return Waves.of(Dispersion.of(board.plate), bins, board, wave_fit.EDGE_VARIANCES[-1])


def _ones(board: Board, bins: Bins, points_m: Floats) -> tuple[Spectra, Bools]:
    """Spectra (bin, point, channel), all known."""
    spectra = np.ones((len(bins.frequency_hz), len(points_m), board.channels), np.complex64)
    return spectra, np.ones(spectra.shape[1:], bool)
