"""Files of records as arrays: .npy, .npz, WAV and UFF type 58."""

import threading
import warnings
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.io import wavfile

from controller.arrays import Floats, Reals
from controller.errors import CalibrationError

LARGEST_BYTES = 4 << 30  # of a file that is read as a whole
UFF = (".uff", ".unv")
UFF_QUANTITIES = {8: "m", 11: "m/s", 12: "m/s^2"}  # specific data type of the ordinate
UFF_UNREPORTED = (0, 1)  # unknown, general
UFF_TIME_RESPONSE = 1
UFF_UNEVEN = 0  # abscissa_spacing: each sample has its time
UFF_LINE = 6  # values of a line, of single precision
UFF_JITTER = 0.01  # of a step, by which a time may differ
UFF_DIGITS = 1e-6  # of the largest time: times have six digits
RATE_TOLERANCE = 1e-4  # the abscissa of a set has six digits

# Python 3.11 and 3.12 parse the header of an array in one state for all threads: two at once may fail (python/cpython#106905).
ONE_HEADER = threading.Lock()

Numbers = Reals | NDArray[np.integer[Any]]


@dataclass(frozen=True, eq=False)
class UffSets:
    """Time responses of a UFF file."""

    # (point, emission, repetition), the first a node number, the others counted from 0, to samples (n,)
    records: dict[tuple[int, int, int], Floats]
    nodes_m: dict[int, tuple[float, float]]  # node number to (x_m, y_m), of sets 15 or 2411


def load_array(file: Path, name: str = "records") -> Numbers:
    """Array of a .npy file, mapped, or that called `name` in a .npz file.

    Raises CalibrationError, naming the file: absent, damaged, too large, or no array of real numbers.
    """
    array: Numbers
    try:
        if file.suffix.lower() == ".npy":
            with ONE_HEADER:
                array = np.load(file, mmap_mode="r", allow_pickle=False)
        else:
            with zipfile.ZipFile(file) as members:
                size = sum(member.file_size for member in members.infolist())
            if size > LARGEST_BYTES:
                raise CalibrationError(f"{file}: {size / 1e9:.1f} GB of arrays: divide it, into a .npy file for each point")
            with ONE_HEADER, np.load(file, allow_pickle=False) as arrays:
                if name not in arrays:
                    raise CalibrationError(f"{file}: no array {name!r}; there are: {', '.join(arrays.files)[:200] or 'none'}")
                array = arrays[name]
    except CalibrationError:
        raise
    except Exception as error:  # zipfile, zlib and numpy.lib.format raise anything on damaged files
        raise unreadable(file, error) from error
    return array


def load_records(file: Path) -> Numbers:
    """`load_array`, checked to hold real numbers with at least one sample."""
    array = load_array(file)
    if array.dtype.kind not in "fiu" or not array.ndim or not array.size:
        raise CalibrationError(f"{file}: {array.dtype} {array.shape} is no array of real samples")
    return array


def load_wav(file: Path, track: int, rate_hz: float) -> Numbers:
    """Samples (n,) of one track of a WAV file: 8, 16, 24, 32 bit or float; 24 bits are the upper ones of 32.

    Raises CalibrationError, naming the file: absent, damaged, cut short, of another rate, or without that track.
    """
    try:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            rate, samples = wavfile.read(file)
    except Exception as error:  # scipy raises anything on damaged files
        raise unreadable(file, error) from error
    for warning in said:
        if "EOF" in str(warning.message):
            raise CalibrationError(f"{file}: the file is cut short ({warning.message}): copy it again")
    check_rate(file, float(rate), rate_hz)
    tracks = samples.reshape(len(samples), -1)
    if not 1 <= track <= tracks.shape[1]:
        raise CalibrationError(f"{file}: records.track = {track}, and the file has {tracks.shape[1]}")
    if not len(tracks):
        raise CalibrationError(f"{file}: no samples")
    chosen: Numbers = tracks[:, track - 1]
    if chosen.dtype == np.uint8:
        return chosen.astype(np.int8) ^ np.int8(-128)
    return chosen


def load_uff(file: Path, rate_hz: float, unit: str) -> UffSets:
    """Time responses (type 58, function type 1) and nodes (15, 2411) of a UFF file, in SI units (164).

    The response node is the point, the reference node the emission counted from 1, the version number the repetition counted from
    1; 0 stands for the first.

    Raises CalibrationError, naming file and node: absent, damaged, of another rate or quantity, not evenly spaced, or two records
    of one place.
    """
    try:
        return _records_of(_uff_sets(file), file, rate_hz, unit)
    except CalibrationError:
        raise
    except Exception as error:  # what pyuff reads of a damaged set lacks keys, or has others' types
        raise unreadable(file, error) from error


def _records_of(sets: list[dict[str, Any]], file: Path, rate_hz: float, unit: str) -> UffSets:
    units = [found for found in sets if found.get("type") == 164]
    per_m = float(units[0]["length"]) if units else 1.0  # units of the file in a metre
    if not np.isfinite(per_m) or per_m <= 0:
        raise CalibrationError(f"{file}: set 164 gives {per_m} as its unit of length")
    records: dict[tuple[int, int, int], Floats] = {}
    nodes_m: dict[int, tuple[float, float]] = {}
    for found in sets:
        if found.get("type") in (15, 2411):
            nodes_m |= {
                int(node): (float(x) / per_m, float(y) / per_m)
                for node, x, y in zip(found["node_nums"], found["x"], found["y"], strict=True)
            }
        if found.get("type") != 58:
            continue
        point = int(found["rsp_node"])
        where = f"{file}: point {point}"
        quantity = UFF_QUANTITIES.get(int(found["ordinate_spec_data_type"]))
        if int(found["func_type"]) != UFF_TIME_RESPONSE:
            raise CalibrationError(f"{where}: a function of type {found['func_type']}, not a time response (1)")
        if (quantity is None and int(found["ordinate_spec_data_type"]) not in UFF_UNREPORTED) or quantity not in (None, unit):
            raise CalibrationError(f"{where}: records of {quantity or 'another quantity'}, and records.unit = {unit!r}")
        count = int(found["num_pts"])
        check_rate(file, 1 / _step_s(found, count, where), rate_hz)
        key = point, max(int(found["ref_node"]) - 1, 0), max(int(found["ver_num"]) - 1, 0)
        if key in records:
            raise CalibrationError(f"{where}: two records of emission {key[1]}, repetition {key[2]}")
        samples = np.asarray(found["data"])
        beyond = samples[count:]  # the last line is filled up, by some analysers with more than zeros
        if samples.dtype.kind != "f" or not 0 < count <= samples.size or (len(beyond) >= UFF_LINE and beyond.any()):
            raise CalibrationError(f"{where}: {samples.size} real samples, not {count}: cut short or damaged")
        samples = samples[:count]
        records[key] = samples.astype(np.float64) / (per_m if quantity else 1.0)
    return UffSets(records, nodes_m)


def _step_s(found: dict[str, Any], count: int, where: str) -> float:
    """Time between the samples of a set 58: as it states it, or that of its abscissa, where that has a value for each sample."""
    step_s = float(found["abscissa_inc"])
    if int(found["abscissa_spacing"]) != UFF_UNEVEN:
        if not step_s > 0:
            raise CalibrationError(f"{where}: gives {step_s:g} s from sample to sample")
        return step_s
    times_s = np.asarray(found["x"], np.float64)[:count]
    if len(times_s) < 2:
        raise CalibrationError(f"{where}: {len(times_s)} times of {count} samples")
    mean_s = float(times_s[-1] - times_s[0]) / (len(times_s) - 1)
    even_s = times_s[0] + mean_s * np.arange(len(times_s))
    largest_s = max(float(np.abs(times_s - even_s).max()), 0.0)
    tolerance_s = UFF_JITTER * mean_s + UFF_DIGITS * float(np.abs(times_s).max())
    if not (mean_s > 0 and largest_s <= tolerance_s):
        raise CalibrationError(
            f"{where}: its samples are not evenly spaced in time (one is {largest_s:.3g} s from where {mean_s:.3g} s from sample to"
            " sample would put it): export them at a fixed rate"
        )
    return mean_s


def _uff_sets(file: Path) -> list[dict[str, Any]]:
    import pyuff  # noqa: PLC0415 - of the extra `offline`; only for this format

    try:
        if file.stat().st_size > LARGEST_BYTES:
            raise CalibrationError(f"{file}: {file.stat().st_size / 1e9:.1f} GB: divide it")
        text = file.read_bytes()
        if not text.rstrip().endswith(b"-1"):
            raise CalibrationError(f"{file}: the file is cut short, or no UFF: its last set has no end")
        sets = pyuff.UFF(str(file)).read_sets()
    except CalibrationError:
        raise
    except Exception as error:  # pyuff raises nothing more precise
        raise unreadable(file, error) from error
    return [sets] if isinstance(sets, dict) else sets


def is_clipped(record: Numbers) -> bool:
    """Whether samples pile up at the largest or smallest number of the record, as those of a full converter do.

    Three or more, and three times as many as stand at each of the next numbers.
    """
    lowest, highest = record.min(), record.max()
    if lowest == highest:
        return False  # silent: a dead channel, not a loud one
    many = min(len(record), 64)
    least = np.unique(np.partition(record, many - 1)[:many], return_counts=True)[1]
    largest = np.unique(np.partition(record, -many)[-many:], return_counts=True)[1][::-1]
    return any(counts[0] >= max(3, 3 * float(counts[1:5].mean()) if len(counts) > 1 else 0) for counts in (least, largest))


def in_unit(record: Numbers, full_scale: float | None, where: str) -> Floats:
    """Samples in the unit of the records; whole numbers are parts of `full_scale`."""
    values = np.asarray(record, np.float64)
    if record.dtype.kind != "f":
        if full_scale is None:
            raise CalibrationError(f"{where}: whole numbers; give records.full_scale, what the largest of them stands for")
        bits = 8 * record.dtype.itemsize - (record.dtype.kind == "i")
        values = values / 2.0**bits
    return values * (1.0 if full_scale is None else full_scale)


def check_rate(file: Path, rate_hz: float, expected_hz: float) -> None:
    """Refuse a file that states another rate than `measurement.toml`."""
    if not abs(rate_hz / expected_hz - 1) < RATE_TOLERANCE:
        raise CalibrationError(f"{file}: {rate_hz:g} samples a second, and sample_rate_hz = {expected_hz:g}")


def unreadable(file: Path, error: Exception) -> CalibrationError:
    """The error of a file that is absent or damaged."""
    said = error.strerror if isinstance(error, OSError) and error.strerror else " ".join(str(error).split()) or type(error).__name__
    return CalibrationError(f"{file}: cannot be read ({said[:200]})")
