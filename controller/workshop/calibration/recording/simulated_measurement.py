"""Measurements of a plate that differs from the board's, through the same files as real ones; with the faults of real ones.

Everything follows from the seed and the point's number, so that a simulation that was interrupted goes on where it was.
"""

import json
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from itertools import groupby
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.bank.packing import channel_bits, framed
from controller.device.board.board import Board
from controller.device.board.identity import simulated_identity
from controller.errors import CalibrationError
from controller.workshop.calibration.frame import MeasuringFrame, middle_m
from controller.workshop.calibration.recording.excitation import Kind, drive_words
from controller.workshop.calibration.records.measurement_file import MeasurementFile, Quantity, RecordsTable, WordsDrive
from controller.workshop.calibration.records.measurement_writer import write_measurement, write_records
from controller.workshop.physics.finger import point_receptance
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.motion import PlateMotion

STAMP: Final = "simulated.json"
DATE: Final = "2026-01-01"  # of every simulation: the same options give the same files
LEVEL: Final = 5e-5  # of the drifts that are simulated
BLOCK_POINTS: Final = 256
SCALE_POINTS: Final = 16  # points by which the noise and the sensor's full scale are set
SCALE_EMISSIONS: Final = 4
BEFORE_S: Final = 0.2e-3  # of a record, before the first drive word


@dataclass(frozen=True)
class RecordingSettings:
    """How points are measured."""

    kind: Kind = "chirp"  # "chirp" or "noise": what is played
    rate_hz: float = 250e3  # of the recorder, as it states it
    record_s: float = 10e-3  # from the first drive word on
    repetitions: int = 1
    quantity: Quantity = "m/s"  # "m" or "m/s" or "m/s^2": what the sensor measures
    seed: int = 1  # of noises, of what is missing and of the sequence that is played


@dataclass(frozen=True)
class Flaws:
    """What is wrong with a measurement; by default nothing but noise."""

    snr_db: float = 40.0  # mean square of the records over that of the sensor's noise, which is white and the same at all points
    drift: float = 0.0  # relative change of all frequencies from the first point to the last
    clock_ppm: float = 0.0  # the recorder's clock is faster than it states
    delay_s: float = 0.0  # by which records begin late; the files do not say so
    clip: float = np.inf  # full scale of the sensor, relative to the largest that is found
    missing: float = 0.0  # share of the points without a record
    dead: tuple[int, ...] = ()  # dead, inverted: channels that do nothing, or are wired the other way round
    inverted: tuple[int, ...] = ()
    swapped: tuple[tuple[int, int], ...] = ()  # channels in each other's place
    offset_m: tuple[float, float] = (0.0, 0.0)  # these four: frame in which the files state places (`MeasuringFrame`)
    rotation: float = 0.0
    scale: float = 1.0
    mirror: str = ""
    position_m: float = 0.0  # standard deviation of each place from its stated one, along each axis
    gain: float = 0.0  # standard deviation of the sensitivity from point to point, relative
    sensor_mass_kg: float = 0.0  # that stands on the plate


def simulate_measurement(
    folder: Path,
    board: Board,  # that of the panel
    real: Board,  # with the plate, patches and driver that are measured
    names: tuple[str, ...],
    points_m: Floats,  # (point, 2)
    recording: RecordingSettings,
    faults: Flaws,
    progress: Callable[[int, int], None] = lambda *_: None,  # called with the number of points done and of all
) -> dict[str, Any]:
    """Write the measurement folder of a simulated plate; points that are there from an interrupted call are kept.

    Returns figures, ready for JSON. Raises CalibrationError if the folder holds something else, or cannot be written.
    """
    words = drive_words(board, recording.kind, recording.seed)
    settings = _settings(board, real, recording, faults)
    _claim(folder, {"board": board.digest().hex(), "plate": real.digest().hex(), **asdict(recording), **asdict(faults)}, points_m)
    write_measurement(folder, settings, names, points_m, words)
    places_m = _places(board, points_m, faults, recording.seed)
    on_plate = np.all((places_m >= 0) & (places_m <= (board.plate.length_m, board.plate.width_m)), axis=1)
    todo = [point for point in _present(len(names), faults.missing, recording.seed) if on_plate[point]]
    plate = _Plate(board, real, words, recording, faults)
    rms, peak = plate.scale(places_m[todo[:SCALE_POINTS]])
    sensor = _Sensor(rms * 10 ** (-faults.snr_db / 20), faults.clip * peak, faults.gain, recording.repetitions, recording.seed)
    done = 0
    for drift, some in _blocks(todo, lambda point: faults.drift * point / max(len(names) - 1, 1)):
        wanted = [point for point in some if not (folder / settings.records.files.format(point=names[point])).exists()]
        records = plate.records(places_m[wanted], drift) if wanted else ()
        for point, record in zip(wanted, records, strict=True):
            write_records(folder, settings, names[point], sensor.heard(record, point))
            progress(done := done + 1, len(todo))
        done += len(some) - len(wanted)
        progress(done, len(todo))
    return {
        "points": len(names),
        "missing": len(names) - len(todo),
        "emissions": len(words),
        "record_ms": recording.record_s * 1e3,
        "modes": plate.modes.count,
        "rms": rms,
        "noise": sensor.noise,
        "unit": recording.quantity,
    }


def _present(count: int, missing: float, seed: int) -> list[int]:
    """Numbers of the points that have a record."""
    random = np.random.default_rng([seed, count])
    absent = set(random.permutation(count)[: round(missing * count)].tolist())
    return [point for point in range(count) if point not in absent]


def _places(board: Board, points_m: Floats, faults: Flaws, seed: int) -> Floats:
    """Where stated points lie: in the frame that they are stated in, each off by an error of its own."""
    frame = MeasuringFrame(faults.mirror, faults.offset_m, faults.rotation, faults.scale)
    own = np.random.default_rng([seed, len(points_m), 2]).standard_normal(points_m.shape)
    return frame.places(points_m, middle_m(board)) + faults.position_m * own


class _Sensor(NamedTuple):
    """White noise of a standard deviation, the largest value that it gives, and how its sensitivity scatters."""

    noise: float
    full_scale: float
    gain: float
    repetitions: int
    seed: int

    def heard(self, record: NDArray[np.float32], point: int) -> NDArray[np.float32]:
        """Repeated records of a point, (emission, repetition, sample), from one without noise, (emission, sample)."""
        own = np.random.default_rng([self.seed, point])
        factor = float(np.exp(self.gain * np.random.default_rng([self.seed, point, 2]).standard_normal()))
        heard = factor * record[:, None] + self.noise * own.standard_normal((len(record), self.repetitions, record.shape[1]))
        return np.asarray(np.clip(heard, -self.full_scale, self.full_scale), np.float32)


def _settings(board: Board, real: Board, recording: RecordingSettings, faults: Flaws) -> MeasurementFile:
    """What the folder's file says of the records."""
    records = RecordsTable(
        files="records/{point}.npy",
        unit=recording.quantity,
        repetitions=recording.repetitions,
        first_sample_us=-BEFORE_S * 1e6 if faults.delay_s == 0 else None,
    )
    return MeasurementFile(
        date=DATE,
        sample_rate_hz=recording.rate_hz,
        board_sha256=board.digest().hex(),
        panel=simulated_identity(real),
        points="points.csv",
        records=records,
        drive=WordsDrive.of(board),
    )


def _blocks(points: list[int], drift_at: Callable[[int], float]) -> Iterator[tuple[float, list[int]]]:
    """Points that are computed at once, with the drift in common."""
    for drift, level in groupby(points, lambda point: round(drift_at(point) / LEVEL) * LEVEL):
        same = list(level)
        for first in range(0, len(same), BLOCK_POINTS):
            yield drift, same[first : first + BLOCK_POINTS]


class _Plate:
    """The plate that is measured, as its sensor and recorder see it."""

    def __init__(self, board: Board, real: Board, words: NDArray[np.uint32], recording: RecordingSettings, faults: Flaws) -> None:
        self.modes = modes_of(real)
        self._real, self._quantity = real, recording.quantity
        played = [framed(board.idle_word, emission, board.idle_word) for emission in words]
        levels = np.stack([channel_bits(emission) for emission in played], axis=2).astype(np.float64)  # (word, channel, emission)
        self._steps_v = np.diff(levels, axis=0)[:, _wiring(board.channels, faults)] * real.driver.supply_v
        self._steps_v[:, list(faults.dead)] = 0
        self._steps_v[:, list(faults.inverted)] *= -1
        self._step_s = np.arange(words.shape[1] + 1) * board.waveform.bit_period_s
        count = round((BEFORE_S + recording.record_s) * recording.rate_hz)
        self._mass_kg, self._rate_hz = faults.sensor_mass_kg, recording.rate_hz
        self._times_s = faults.delay_s - BEFORE_S + np.arange(count) / (recording.rate_hz * (1 + faults.clock_ppm * 1e-6))

    def scale(self, points_m: Floats) -> tuple[float, float]:
        """Root mean square and largest value of records of a few emissions."""
        some = np.unique(np.linspace(0, self._steps_v.shape[2], SCALE_EMISSIONS, endpoint=False, dtype=np.int64))
        records = PlateMotion(self._real, self.modes).of_points(
            points_m, self._step_s, self._steps_v[:, :, some], self._times_s, self._quantity
        )
        return float(np.sqrt(np.mean(records.astype(np.float64) ** 2))), float(np.abs(records).max())

    def records(self, points_m: Floats, drift: float) -> NDArray[np.float32]:
        """Records without noise: (point, emission, sample)."""
        motion = PlateMotion(self._real, drifted(self.modes, drift) if drift else self.modes)
        records = motion.of_points(points_m, self._step_s, self._steps_v, self._times_s, self._quantity)
        return self._loaded(points_m, records, motion.modes) if self._mass_kg else records

    def _loaded(self, points_m: Floats, records: NDArray[np.float32], modes: Modes) -> NDArray[np.float32]:
        """Records of points under the sensor's mass, which begin and end at rest."""
        length = 2 * records.shape[2]
        s = np.asarray(2j * np.pi * np.fft.rfftfreq(length, 1 / self._rate_hz), np.complex128)
        s[0] = 1.0
        held = 1 + self._mass_kg * s[:, None] ** 2 * point_receptance(self._real, modes, points_m, s)
        spectra = np.fft.rfft(records, length, axis=2) / held.T[:, None]
        return np.fft.irfft(spectra, length, axis=2)[..., : records.shape[2]].astype(np.float32)


def _wiring(channels: int, faults: Flaws) -> list[int]:
    """Of each patch the channel that is wired to it."""
    wired = list(range(channels))
    for a, b in faults.swapped:
        wired[a], wired[b] = wired[b], wired[a]
    return wired


def _claim(folder: Path, how: dict[str, Any], points_m: Floats) -> None:
    """Mark a folder as that of this simulation; raises CalibrationError if it holds another one, or something else."""
    text = json.dumps(how | {"points_mm": np.round(points_m * 1e3, 6).tolist()}, sort_keys=True) + "\n"
    stamp = folder / STAMP
    try:
        if stamp.exists():
            if stamp.read_text(encoding="utf-8") != text:
                raise CalibrationError(f"{folder}: holds a simulation with other options: remove it, or give another folder")
            return
        if folder.exists() and any(folder.iterdir()):
            raise CalibrationError(f"{folder}: is not empty, and holds no simulation: give another folder")
        folder.mkdir(parents=True, exist_ok=True)
        stamp.write_text(text, encoding="utf-8")
    except OSError as error:
        raise CalibrationError(f"{folder}: cannot be written ({error.strerror})") from error
