"""A measurement folder: `measurement.toml`, points, and records, read point by point. The format is described in README.md."""

import hashlib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from controller.arrays import Bools, Floats
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.records.drives import Drive, read_drive
from controller.workshop.calibration.records.measurement_file import NAME, MeasurementFile, read_settings
from controller.workshop.calibration.records.points import points_of
from controller.workshop.calibration.records.record_formats import (
    UFF,
    Numbers,
    UffSets,
    in_unit,
    is_clipped,
    load_records,
    load_uff,
    load_wav,
    unreadable,
)

LARGEST = 1e9  # m, m/s or m/s^2: no sensor gives that

Place = tuple[int, int]  # emission, repetition


@dataclass(frozen=True, eq=False)
class PointRecords:
    """Records of one point."""

    values: Floats  # (emission, repetition, sample): in m, m/s or m/s². NaN where `there` is not
    there: Bools  # (emission, repetition): whose file was found
    # (emission, repetition): time of the first sample after the recorder's start of the emission, in s of the recorder;
    # `starts_s` and the delay not counted
    first_s: Floats
    clipped: Bools  # (emission, repetition): whether samples in a row stand at the record's extreme
    files: tuple[Path, ...]  # what was read

    @property
    def sound(self) -> Bools:
        """Records that are there and not clipped: (emission, repetition)."""
        return self.there & ~self.clipped


@dataclass(frozen=True, eq=False)
class Measurement:
    """What a measurement folder holds; records are read when asked for."""

    folder: Path
    settings: MeasurementFile
    names: tuple[str, ...]  # of the points
    points_m: Floats  # (point, 2)
    drive: Drive  # what was played

    @property
    def repetitions(self) -> int:
        """How often each emission was played."""
        return self.settings.records.repetitions

    def files(self, point: int) -> tuple[Path, ...]:
        """Files with records of a point that exist, in the order of emissions and repetitions."""
        return tuple(dict.fromkeys(file for _, file in self._files(point) if file.exists()))

    @cached_property
    def there(self) -> list[int]:
        """Points with some record."""
        return [point for point in range(len(self.names)) if any(self._has(point))]

    @property
    def missing(self) -> tuple[int, ...]:
        """Points without any record."""
        return tuple(sorted({*range(len(self.names))} - {*self.there}))

    @cached_property
    def common_files(self) -> tuple[Path, ...]:
        """Files that every point depends on: settings, points, drive."""
        named = (NAME, self.settings.points, getattr(self.settings.drive, "file", None))
        return tuple(self.folder / name for name in named if name)

    def records(self, point: int) -> PointRecords:
        """Read the records of a point; of one that is `missing` none is there.

        Raises CalibrationError, naming file and point: damaged, of another length, rate or unit, or with samples that are no
        numbers.
        """
        return self._cut(point, dict(self._read(point)))

    def _has(self, point: int) -> Iterator[bool]:
        """Of each file that a point may be in, whether it is."""
        whole = self._uff_as_a_whole
        for _, file in self._files(point):
            if not file.exists():
                yield False
            elif whole is not None:
                yield any(str(node) == self.names[point] for node, _, _ in whole.records)
            elif not self.settings.records.fields:
                values = self._array_as_a_whole
                yield values.dtype.kind != "f" or len(values) != len(self.names) or not np.isnan(values[point]).all()
            else:
                yield True

    def _axes(self) -> tuple[int, int]:
        """Emissions and repetitions in separate records: (1, 1) if records run through."""
        if self.settings.records.period_ms is not None:
            return 1, 1
        return self.drive.emissions, self.repetitions

    def _files(self, point: int) -> Iterator[tuple[tuple[int | None, int | None], Path]]:
        """Emission and repetition, None where the file holds all of them, and the file."""
        for emission, repetition, name in self.settings.files(self.names[point], *self._axes()):
            yield (emission, repetition), self.folder / name

    @cached_property
    def _uff_as_a_whole(self) -> UffSets | None:
        """Of a UFF file with all points."""
        records = self.settings.records
        if Path(records.files).suffix.lower() not in UFF or "point" in records.fields:
            return None
        return load_uff(self.folder / records.files, self.settings.sample_rate_hz, records.quantity[0])

    @cached_property
    def _array_as_a_whole(self) -> Numbers:
        """Of a .npy or .npz file with all points."""
        return load_records(self.folder / self.settings.records.files)

    def _read(self, point: int) -> Iterator[tuple[Place, Numbers]]:
        """Records (sample,) of a point that are there, as the files hold them."""
        settings, axes = self.settings.records, self._axes()
        for (emission, repetition), file in self._files(point):
            if not file.exists():
                continue
            suffix = file.suffix.lower()
            if suffix in UFF:
                yield from self._from_uff(point, file, emission, repetition)
                continue
            if suffix == ".wav":
                values = load_wav(file, settings.track, self.settings.sample_rate_hz)
            elif settings.fields:
                values = load_records(file)
            else:
                values = self._array_as_a_whole
            shape = [] if "point" in settings.fields else [len(self.names)]
            shape += [size for size, chosen in zip(axes, (emission, repetition), strict=True) if chosen is None]
            if [size for size in values.shape[:-1] if size != 1] != [size for size in shape if size != 1]:
                said = " x ".join(map(str, shape)) or "1"
                raise CalibrationError(
                    f"{file}: an array {values.shape}; by {NAME} it should hold {said} records of one length, the samples last"
                )
            values = values.reshape(*shape, values.shape[-1])
            if "point" not in settings.fields:
                values = values[point]
            block = values.reshape(axes[0] if emission is None else 1, axes[1] if repetition is None else 1, -1)
            for e, r in np.ndindex(block.shape[:2]):
                yield (e if emission is None else emission, r if repetition is None else repetition), block[e, r]

    def _from_uff(self, point: int, file: Path, emission: int | None, repetition: int | None) -> Iterator[tuple[Place, Numbers]]:
        settings = self.settings.records
        found = self._uff_as_a_whole or load_uff(file, self.settings.sample_rate_hz, settings.quantity[0])
        emissions, repetitions = self._axes()
        for (node, e, r), values in found.records.items():
            if str(node) != self.names[point]:
                if "point" in settings.fields and node:
                    raise CalibrationError(f"{file}: a record of point {node}, in the file of point {self.names[point]}")
                if "point" not in settings.fields:
                    continue
            place = emission if emission is not None else e, repetition if repetition is not None else r
            if place[0] >= emissions or place[1] >= repetitions:
                raise CalibrationError(
                    f"{file}: point {self.names[point]}: a record of emission {place[0]}, repetition {place[1]},"
                    f" and {NAME} has {emissions} and {repetitions}"
                )
            yield place, values

    def _cut(self, point: int, read: dict[Place, Numbers]) -> PointRecords:
        """Records as one array in SI units; those that run through are cut into emissions."""
        settings, where = self.settings.records, f"{self.folder}: point {self.names[point]}"
        shape = self.drive.emissions, self.repetitions
        first = np.zeros(shape, np.int64)
        if settings.period_ms is not None and read:
            period = settings.period_ms * 1e-3 * self.settings.sample_rate_hz
            first[:] = np.round(np.arange(first.size) * period).reshape(shape)
            whole, length = read[0, 0], int(period)
            read = {place: whole[start : start + length] for place, start in np.ndenumerate(first)}
            if min(map(len, read.values())) < 0.5 * length:
                raise CalibrationError(
                    f"{where}: {len(whole):,} samples, too few for {first.size} emissions of {settings.period_ms:g} ms"
                )
            shortest = min(map(len, read.values()))
            read = {place: values[:shortest] for place, values in read.items()}
        lengths = sorted({len(values) for values in read.values()})
        if len(lengths) > 1:
            raise CalibrationError(f"{where}: records of {lengths[0]:,} and of {lengths[-1]:,} samples: they must be equally long")
        values = np.full((*shape, lengths[0] if lengths else 0), np.nan)
        there, clipped = np.zeros(shape, bool), np.zeros(shape, bool)
        for place, record in read.items():
            if record.dtype.kind == "f" and np.isnan(record).all():
                continue  # how an array with all points leaves one out
            values[place] = in_unit(record, settings.full_scale, where)
            there[place], clipped[place] = True, is_clipped(record)
        if not np.isfinite(values[there]).all():
            e, r = np.argwhere(there & ~np.isfinite(values).all(axis=2))[0]
            raise CalibrationError(f"{where}: emission {e}, repetition {r}: samples that are no numbers")
        values *= settings.quantity[1]
        if there.any() and not abs(values[there]).max() < LARGEST:
            largest = abs(values[there]).max()
            raise CalibrationError(f"{where}: samples up to {largest:.3g} {settings.quantity[0]}: wrong unit, or no record")
        return PointRecords(values, there, first / self.settings.sample_rate_hz, clipped, self.files(point))


def read_measurement(folder: Path, board: Board) -> Measurement:
    """Read and check all of a measurement folder but the records.

    Raises CalibrationError, naming file and point: absent or invalid settings, points off the plate, twice, or none; a drive that
    cannot be read.
    """
    settings = read_settings(folder)
    drive = read_drive(folder, settings.drive, board)
    names, points_m = points_of(folder, settings, board)
    measurement = Measurement(folder, settings, names, points_m, drive)
    _refuse_foreign_files(measurement)
    return measurement


def sha256_of(file: Path) -> str:
    """SHA-256 of a file's bytes, in hex; raises CalibrationError if it cannot be read."""
    try:
        with file.open("rb") as data:
            return hashlib.file_digest(data, "sha256").hexdigest()
    except OSError as error:
        raise unreadable(file, error) from error


def _refuse_foreign_files(measurement: Measurement) -> None:
    """Refuse a file that has the form of a record's name, and belongs to no point."""
    records = measurement.settings.records
    if "point" not in records.fields:
        return
    expected = set(measurement.common_files)
    expected |= {file for point in range(len(measurement.names)) for _, file in measurement._files(point)}
    for file in sorted(measurement.folder.glob(re.sub(r"\{\w+\}", "*", records.files))):
        if file not in expected:
            raise CalibrationError(f"{file}: of no point, emission or repetition that {NAME} and its points have")
