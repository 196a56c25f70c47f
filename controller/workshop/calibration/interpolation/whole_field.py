"""The whole field of a measured plate, by which drive words are optimised: interpolated to a grid, taken apart into cosines."""

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dct

from controller.arrays import Floats, blocks
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.errors import CalibrationError
from controller.workshop.bank_builder.methods.audible_form import bins_hz
from controller.workshop.bank_builder.methods.measured_plate import CosineShapes, MeasuredPlate
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.interpolation.interpolated import POINTS_AT_ONCE, InterpolatedResponses
from controller.workshop.calibration.interpolation.spectra import Spectra
from controller.workshop.calibration.point_plan import scattered_count
from controller.workshop.physics.field import map_axis
from controller.workshop.physics.responses.impulse_response import ResponseModel

PITCH = 0.4  # of the grid, in the shortest waves
KEPT = 1.15  # wavenumbers of cosines that are kept, over that of the shortest waves: what fades at edges has more
# Of the field's energy, as where points left out are so few that there is no bank: contrast then gains 1.6 in place of 2
MOST_UNFORESEEN = 0.15
MORE_LINES = 24  # than the band has: the ends of an emission cut responses off


def whole_field(board: Board, source: InterpolatedResponses) -> MeasuredPlate:
    """The field that a source estimates on the whole plate; raises CalibrationError if its points foresee too little of it."""
    bins, samples = source.bins, source.samples
    wave_m = Dispersion.of(board.plate).wavelength_m(board.waveform.band_high_hz)
    length_m, width_m = source.plate_m
    x_m, y_m = map_axis(length_m, PITCH * wave_m), map_axis(width_m, PITCH * wave_m)
    points_m = np.column_stack([np.tile(x_m, y_m.size), np.repeat(y_m, x_m.size)])
    unforeseen = _unforeseen(board, source, points_m)
    lines = min(samples, int(np.ceil(2 * bins.frequency_hz[-1] * samples / source.bit_clock_hz)) + MORE_LINES)
    values = np.empty((len(points_m), lines, CHANNELS), np.float32)
    below = _BelowBand(board, source)
    fine_hz = bins_hz(board.waveform)
    low = bins.frequency_hz <= fine_hz.max() + bins.frequency_hz[1]
    energy = np.zeros((int(low.sum()), CHANNELS, CHANNELS))
    for some in blocks(len(points_m), POINTS_AT_ONCE):
        spectra = below.completed(source.field.at(points_m[some]), points_m[some])
        values[some] = dct(bins.whole(spectra)[:, ::-1], type=2, axis=1, norm="forward")[:, :lines]
        heard = spectra[low].astype(np.complex128)
        energy += (heard.conj().swapaxes(1, 2) @ heard).real
    values[:, 1:] *= 2
    shapes, kept = _cosines(x_m.size, y_m.size, (length_m, width_m), KEPT * 2 / wave_m)
    amplitudes = _by_cosine(values.reshape(y_m.size, x_m.size, lines * CHANNELS))[kept]
    moved = np.ascontiguousarray(amplitudes.reshape(shapes.count, lines, CHANNELS).swapaxes(0, 1))
    form = np.empty((len(fine_hz), CHANNELS, CHANNELS))
    for one, other in np.ndindex(CHANNELS, CHANNELS):
        of_velocity = fine_hz**2 * np.interp(fine_hz, bins.frequency_hz[low], energy[:, one, other])
        form[:, one, other] = of_velocity.mean(axis=1)
    first_line = int(np.ceil(2 * below.until_hz * samples / source.bit_clock_hz))
    return MeasuredPlate(shapes, samples, moved, form, unforeseen, first_line)


class _BelowBand:
    """The board's model in the place of what is noise below the band, as no drive excited it: else it would cost nothing."""

    def __init__(self, board: Board, source: InterpolatedResponses) -> None:
        trusted = np.where(source.bins.gain > 0, 1.0, source.leave_out.trusted)
        self._bins, self._frequency_hz = np.flatnonzero(trusted < 1), source.bins.frequency_hz
        self._trusted = trusted[self._bins].astype(np.float32)
        self._model = ResponseModel(board, 2 * board.waveform.band_low_hz)
        self._model.samples = source.bins.length
        self._modal = np.fft.rfft(self._model.modal)[:, self._bins].astype(np.complex64)

    @property
    def until_hz(self) -> float:
        """Frequency below which less than half is measured."""
        less = self._bins[self._trusted < 0.5]
        return float(self._frequency_hz[less.max() + 1]) if less.size else 0.0

    def completed(self, spectra: Spectra, points_m: Floats) -> Spectra:
        """Spectra at points, (bin, point, channel), completed in place."""
        shapes, forces = self._model.plate_modes.shapes(points_m, np.float32), self._model.forces.astype(np.float32)
        for index, (bin_, trusted) in enumerate(zip(self._bins.tolist(), self._trusted.tolist(), strict=True)):
            spectra[bin_] *= trusted
            spectra[bin_] += (1 - trusted) * (shapes @ (self._modal[:, index, None] * forces))
        return spectra


def _unforeseen(board: Board, source: InterpolatedResponses, points_m: Floats) -> float:
    """Share of the field's energy that is not foreseen: of points left out, or by the places of the points, where that is more."""
    by_places = 1 - source.foreseen(points_m) ** 2
    found = round(float(np.maximum(by_places, source.leave_out.unforeseen()).mean()), 4)
    if not found <= MOST_UNFORESEEN:
        raise CalibrationError(
            f"{found:.2f} of the field's energy is not foreseen by the {source.provenance.points} points, above"
            f" {MOST_UNFORESEEN:g}: entries cannot be optimised by it: measure more points, on the whole plate (calibrate plan"
            f" proposes {scattered_count(board)})"
        )
    return found


def _cosines(
    columns: int, rows: int, extents_m: tuple[float, float], highest: float
) -> tuple[CosineShapes, tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Cosines up to a number of half waves a metre, and where they are among all of a grid: row, column."""
    y_index, x_index = np.nonzero(np.hypot(np.arange(columns) / extents_m[0], np.arange(rows)[:, None] / extents_m[1]) <= highest)
    return CosineShapes(*extents_m, x_index, y_index), (y_index, x_index)


def _by_cosine(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """Values at the middles of equal cells, (row, column, any), as amplitudes of cosines of given half waves."""
    for axis in (0, 1):
        values = dct(values, type=2, axis=axis, norm="forward", overwrite_x=True)
        values[(slice(None),) * axis + (slice(1, None),)] *= 2
    return values
