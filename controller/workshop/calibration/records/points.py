"""Where a plate was measured: a CSV file of points, or those that the file of the records has itself."""

import csv
import io
import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.text_file import read_text
from controller.workshop.calibration.records.measurement_file import NAME, MeasurementFile
from controller.workshop.calibration.records.record_formats import UFF, load_array, load_uff, unreadable

POINT_NAME = re.compile(r"[A-Za-z0-9_+-][A-Za-z0-9_.+-]{0,63}")  # part of a file's name
MOST_POINTS = 20_000
EDGE_MM = 1e-6  # a place on the edge is on the plate


def points_of(folder: Path, settings: MeasurementFile, board: Board) -> tuple[tuple[str, ...], Floats]:
    """Names of the points of a measurement, and their places (point, 2) in m.

    Raises CalibrationError, naming file and point: absent, off the plate, twice, or none.
    """
    if settings.points is not None:
        return read_points(folder / settings.points, board)
    return _checked(folder / settings.records.files, _points_of_records(folder, settings), board)


def read_points(file: Path, board: Board) -> tuple[tuple[str, ...], Floats]:
    """Names and places in m of points, (point, 2), from a CSV file with point,x_mm,y_mm.

    Raises CalibrationError, naming file and point: unreadable, off the plate, twice, or none.
    """
    return _checked(file, _points_of_csv(file), board)


def _checked(where: Path, found: list[tuple[str, float, float]], board: Board) -> tuple[tuple[str, ...], Floats]:
    """Names and places in m of points that may be measured."""
    if not found:
        raise CalibrationError(f"{where}: no points")
    if len(found) > MOST_POINTS:
        raise CalibrationError(f"{where}: {len(found):,} points, more than {MOST_POINTS:,}")
    places: dict[tuple[float, float], str] = {}
    for name, x_mm, y_mm in found:
        if not POINT_NAME.fullmatch(name):
            raise CalibrationError(f"{where}: point {name[:70]!r}: its name may have letters, digits and _ + - . only")
        for axis, value, extent in (("x_mm", x_mm, board.plate.length_mm), ("y_mm", y_mm, board.plate.width_mm)):
            if not -EDGE_MM <= value <= extent + EDGE_MM:  # NaN too
                raise CalibrationError(f"{where}: point {name}: {axis} = {value:g} is off the plate (0 to {extent:g} mm)")
        if (other := places.setdefault((x_mm, y_mm), name)) is not name:
            raise CalibrationError(f"{where}: points {other} and {name} are the same place, {x_mm:g}, {y_mm:g} mm")
    names = [name for name, _, _ in found]
    if len(set(names)) != len(names):
        twice = next(name for index, name in enumerate(names) if name in names[:index])
        raise CalibrationError(f"{where}: point {twice} is there twice")
    return tuple(names), np.array([point[1:] for point in found]) * 1e-3


def write_points(file: Path, names: tuple[str, ...], points_m: ArrayLike) -> None:
    """Write points as a CSV file: point, x_mm, y_mm; raises CalibrationError if it cannot be written."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(("point", "x_mm", "y_mm"))
    for name, (x_m, y_m) in zip(names, np.asarray(points_m, np.float64), strict=True):
        rows.writerow((name, f"{x_m * 1e3:.9g}", f"{y_m * 1e3:.9g}"))
    try:
        file.write_text(text.getvalue(), encoding="utf-8")
    except OSError as error:
        raise CalibrationError(f"{file}: cannot be written ({error.strerror})") from error


def _points_of_csv(file: Path) -> list[tuple[str, float, float]]:
    try:
        if file.stat().st_size > 100 * MOST_POINTS:
            raise CalibrationError(f"{file}: too large for a list of points")
        rows = list(csv.reader(read_text(file, 100 * MOST_POINTS).splitlines()))
    except OSError as error:
        raise unreadable(file, error) from error
    except (ValueError, csv.Error) as error:
        raise CalibrationError(f"{file}: no CSV file ({error})") from error
    if not rows or [cell.strip() for cell in rows[0]] != ["point", "x_mm", "y_mm"]:
        raise CalibrationError(f"{file}: its first line is not point,x_mm,y_mm")
    found = []
    for number, row in enumerate(rows[1:], 2):
        if not row:
            continue
        try:
            name, x_mm, y_mm = (cell.strip() for cell in row)
            found.append((name, float(x_mm), float(y_mm)))
        except ValueError:
            raise CalibrationError(f"{file}: line {number}: {','.join(row)[:80]!r} is not a name and two numbers") from None
    return found


def _points_of_records(folder: Path, settings: MeasurementFile) -> list[tuple[str, float, float]]:
    """The file's own points: `points_mm` of a .npz file, nodes of a UFF file."""
    file = folder / settings.records.files
    suffix = file.suffix.lower()
    if settings.records.fields or suffix not in (".npz", *UFF):
        raise CalibrationError(f"{folder / NAME}: points is missing: the name of a CSV file with point,x_mm,y_mm")
    if suffix == ".npz":
        points: Any = load_array(file, "points_mm")
        if points.dtype.kind not in "fiu" or points.ndim != 2 or points.shape[1] != 2:
            raise CalibrationError(f"{file}: points_mm is {points.dtype} {points.shape}, not (point, 2) numbers")
        return [(str(index), float(x), float(y)) for index, (x, y) in enumerate(points)]
    sets = load_uff(file, settings.sample_rate_hz, settings.records.quantity[0])
    nodes = sorted({key[0] for key in sets.records})
    if without := [node for node in nodes if node not in sets.nodes_m]:
        raise CalibrationError(f"{file}: point {without[0]} has no node of type 15 or 2411; give points in a CSV file")
    return [(str(node), x_m * 1e3, y_m * 1e3) for node, (x_m, y_m) in sorted(sets.nodes_m.items())]
