"""Writes measurement folders: what `measurements` reads."""

import contextlib
from collections.abc import Iterable, Iterator
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.io import wavfile

from controller.arrays import Floats
from controller.errors import CalibrationError
from controller.workshop.calibration.records.measurement_file import (
    NAME,
    MeasurementFile,
    WordsDrive,
    read_settings,
    write_settings,
)
from controller.workshop.calibration.records.points import write_points

UFF_TYPES = {"m": 8, "m/s": 11, "m/s^2": 12, "V": 0}


def claim(folder: Path, settings: MeasurementFile) -> None:
    """Refuse a folder that holds another measurement; raises CalibrationError, naming what differs."""
    if not (folder / NAME).exists():
        if folder.exists() and any(folder.iterdir()):
            raise CalibrationError(f"{folder}: is not empty, and holds no measurement: give another folder")
        return
    before = msgspec.structs.replace(read_settings(folder), date=settings.date)
    for key in settings.__struct_fields__:
        if getattr(before, key) != getattr(settings, key):
            raise CalibrationError(f"{folder / NAME}: {key} differs from this measurement: give another folder")


def write_measurement(
    folder: Path,  # made if it is absent
    # Names of files and their format; with a `{point}` in `records.files`, or as a .npy, .npz or .uff file with everything
    settings: MeasurementFile,
    names: tuple[str, ...],
    points_m: ArrayLike,  # (point, 2)
    drive: NDArray[np.generic] | None = None,  # (emission, word) uint32 array, or (emission, sample): for a drive that has a file
    # In the order of the points, taken one by one. Records that run through are (sample,). Left out: they are written later,
    # point by point, by `write_records`
    records: Iterable[ArrayLike | None] = (),
) -> None:
    """Write a measurement folder; what is there already is replaced; raises CalibrationError if a file cannot be written."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if drive is not None and (name := getattr(settings.drive, "file", None)):
            np.save(folder / name, drive.astype(np.uint32) if isinstance(settings.drive, WordsDrive) else drive)
    except OSError as error:
        raise CalibrationError(f"{error.filename}: cannot be written ({error.strerror})") from error
    write_settings(folder, settings)
    if settings.points is not None:
        write_points(folder / settings.points, names, points_m)
    if "point" in settings.records.fields:
        for name, values in zip(names, records, strict=False):
            if values is not None:
                write_records(folder, settings, name, values)
        return
    found = [None if values is None else np.asarray(values) for values in records]
    if not found:
        return
    file, places_m = folder / settings.records.files, np.asarray(points_m, np.float64)
    if file.suffix in (".uff", ".unv"):
        nodes = [int(name) for name in names]
        _write_uff(file, settings, {node: values for node, values in zip(nodes, found, strict=True) if values is not None})
        if settings.points is None:
            _add_nodes(file, nodes, places_m)
        return
    there = next(values for values in found if values is not None)
    whole = np.stack([np.full_like(there, np.nan) if values is None else values for values in found])
    if file.suffix == ".npz":
        _saved(file, records=whole, points_mm=places_m * 1e3)
    else:
        _saved(file, whole)


def write_records(folder: Path, settings: MeasurementFile, name: str, values: ArrayLike) -> None:
    """Write the records of the point `name`, in as many files as `settings.records.files` has fields.

    `values` are (emission, repetition, sample), or (sample,) if records run through, in `settings.records.unit`; as numbers of
    another type than float, in parts of `full_scale`. Raises CalibrationError if a file cannot be written.
    """
    array = np.asarray(values)
    emissions, repetitions = array.shape[:2] if array.ndim > 1 else (1, 1)
    for emission, repetition, file_name in settings.files(name, emissions, repetitions):
        chosen = array if emission is None else array[emission][None]
        chosen = chosen if repetition is None else chosen[:, repetition][:, None]
        file = folder / file_name
        match file.suffix:
            case ".wav":
                _saved_wav(file, settings.sample_rate_hz, chosen.reshape(-1, chosen.shape[-1]), settings.records.full_scale)
            case ".uff" | ".unv":
                _write_uff(file, settings, {int(name): chosen})
            case ".npz":
                _saved(file, records=chosen)
            case _:
                _saved(file, chosen)


@contextlib.contextmanager
def _whole(file: Path) -> Iterator[Path]:
    """Another name to write `file` under, which takes its place once it is whole: what is interrupted is measured again.

    Raises CalibrationError if it cannot be written.
    """
    written = file.with_name(f".{file.name}{file.suffix}")
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        yield written
        written.replace(file)
    except OSError as error:
        raise CalibrationError(f"{file}: cannot be written ({error.strerror})") from error
    finally:
        with contextlib.suppress(OSError):
            written.unlink(missing_ok=True)


def _saved(file: Path, array: NDArray[np.generic] | None = None, **arrays: NDArray[np.generic]) -> None:
    with _whole(file) as written:
        if array is None:
            np.savez_compressed(written, **arrays)  # type: ignore[arg-type]
        else:
            np.save(written, array)


def _saved_wav(file: Path, rate_hz: float, rows: NDArray[np.generic], full_scale: float | None) -> None:
    if len(rows) != 1:
        raise CalibrationError(f"{file}: a WAV file holds one record, not {len(rows)}: name files by emission and repetition")
    samples = rows[0] if rows.dtype.kind != "f" else (rows[0] / (full_scale or 1.0)).astype(np.float32)
    with _whole(file) as written:
        wavfile.write(written, round(rate_hz), samples)


def _write_uff(file: Path, settings: MeasurementFile, records: dict[int, NDArray[np.generic]]) -> None:
    """Each record a set of type 58: response node, emission + 1 as reference node, repetition + 1 as version."""
    import pyuff  # noqa: PLC0415 - of the extra `offline`; only for this format

    sets = []
    for node, values in records.items():
        samples = np.asarray(values, np.float64).reshape((1, 1, -1) if values.ndim == 1 else values.shape)
        for emission, repetition in np.ndindex(samples.shape[:2]):
            record = samples[emission, repetition]
            sets.append(
                pyuff.prepare_58(
                    binary=0, func_type=1, rsp_node=node, rsp_dir=3, ref_node=emission + 1, ref_dir=0, ver_num=repetition + 1,
                    load_case_id=0, rsp_ent_name="plate", ref_ent_name="drive", id1="haptic-panel", id2="NONE", id3=settings.date,
                    id4="NONE", id5="NONE", x=np.arange(len(record)) / settings.sample_rate_hz,
                    data=record, ord_data_type=4, num_pts=len(record), abscissa_spacing=1, abscissa_min=0.0,
                    abscissa_inc=1 / settings.sample_rate_hz, abscissa_spec_data_type=17,
                    ordinate_spec_data_type=UFF_TYPES[settings.records.unit],
                    orddenom_spec_data_type=0, z_axis_spec_data_type=0, z_axis_value=0.0,
                )
            )  # fmt: skip
    with _whole(file) as written:
        writer = pyuff.UFF(str(written))
        writer.refresh = lambda: True  # it would read the whole file again after each set
        writer.write_sets(sets, "overwrite")


def _add_nodes(file: Path, nodes: list[int], points_m: Floats) -> None:
    import pyuff  # noqa: PLC0415

    none = np.zeros(len(nodes), int)
    places = {"x": points_m[:, 0], "y": points_m[:, 1], "z": np.zeros(len(nodes))}
    pyuff.UFF(str(file)).write_sets(
        {"type": 2411, "node_nums": nodes, "def_cs": none, "disp_cs": none, "color": none, **places}, "add"
    )
