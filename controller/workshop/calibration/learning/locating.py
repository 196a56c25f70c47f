"""Where the measuring frame lies on the plate: offset, rotation, scale, mirror, by the waves that come straight from the patches.

Places of points are stated in the frame of a scanner or a ruler, patches lie where board.toml says. In the right frame the records
agree best with the direct waves G of `direct_wave`, frequency by frequency,

    coherence = mean over bins of |sum of H conj(G)|^2 / (sum of |H|^2 sum of |G|^2),    sums over points and patches,

whatever all records have in common: delay, unit, sensitivity, sign, a sensor's mass. A lattice of frames in the lower part of the
band finds the neighbourhood, Gauss and Newton's method with more and more of the band the frame. Echoes are no noise: on regular
points, between the same edges, they can feign a frame at any number of standard deviations. In a frame that is right they fit too.
"""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Complex, Floats, Indices
from controller.device.board.board import Board
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.frame import MIRRORS, MeasuringFrame, middle_m
from controller.workshop.calibration.transfer_functions.direct_wave import NEAR_WAVELENGTHS, direct_wave
from controller.workshop.calibration.transfer_functions.transfers import RawBins

MANY = 256, 32, 40  # points, patches and bins, at most
FEW = 32, 8, 16  # by which the lattice is searched
EDGE_WAVES = 0.5  # nearer to an edge than this share of the longest wave, what it sends back comes with the direct wave
LOWER = 0.4  # of the band, in which the lattice is searched
OFFSETS_M = (-8e-3, -4e-3, 0.0, 4e-3, 8e-3)
ROTATIONS = (0.0, -0.03, 0.03)  # in rad
SCALES = (1.0, 0.97, 1.03)
FACTORS = (1.0, 0.98, 1.02, 0.96, 1.04)  # of the wavenumber
PROMISING = 8  # frames of the lattice with which other factors than 1 are tried
STEPS = 4  # of Gauss and Newton's method, for each part of the band
PARTS = (LOWER, 0.7, 1.0)
WORTH = 1.01  # times the share that is explained without it, at least, by what is not as stated
GROUPS = 8  # of points, whose scatter says how sure the frame is
LEAST_POINTS, LEAST_RECORDS = 6, 128  # records: points times patches
KEPT = 0.8  # of the lattice's coherence: what strays from it is no frame
ENOUGH = 100  # points away from the edges: of fewer, all are used
WIDEST = np.array([0.012, 0.012, 0.06, 0.06])  # offset in m, rotation, scale: beyond, it is no frame of this plate
ABOVE_CHANCE = 4.0  # times the coherence of records that have nothing to do with G


@dataclass(frozen=True, eq=False)
class _Records:
    """Transfer functions of some points and patches in some bins, each record of power one."""

    board: Board
    bins: RawBins
    points_m: Floats  # (point, 2)
    patches: Indices
    places_m: Floats  # (patch, 2): of these
    frequency_hz: Floats
    values: Complex  # (point, patch, bin)


def locate(
    board: Board,
    bins: RawBins,
    points_m: Floats,  # (point, 2): as stated
    transfers: NDArray[np.complexfloating],  # (point, 32, bin)
    resolved: Bools,  # (point, 32)
) -> MeasuringFrame | None:
    """Find the frame; None from too few points, or if the direct waves do not stand out in any."""
    if not enough(board, len(points_m)):
        return None
    few = _records(board, bins, points_m, transfers, resolved, FEW, LOWER)
    frame, factor, coherence = _search(few)
    if coherence < ABOVE_CHANCE / max(int(few.values.any(axis=2).sum()), 1):
        return None
    for part in PARTS:
        many = _records(board, bins, points_m, transfers, resolved, MANY, part)
        for _ in range(STEPS):
            frame, factor = _step(many, frame, factor)
    free = np.array(frame.sure)
    if not free.all():  # what the waves leave open is as stated, and the rest is found once more
        frame, factor = _as_stated(many, frame, factor, free)
    while free.any():  # so is what explains next to nothing, and edges can feign: the least first
        ways = {one: _as_stated(many, frame, factor, free & (np.arange(4) != one)) for one in np.flatnonzero(free).tolist()}
        explained = {one: _explained(many, *way) for one, way in ways.items()}
        least = max(explained, key=lambda one: explained[one])
        if explained[least] * WORTH <= _explained(many, frame, factor):
            break
        (frame, factor), free[least] = ways[least], False
    inside = np.abs(frame.changes) < WIDEST
    frame = replace(frame, factor=factor)
    return frame if inside.all() and _coherence(few, frame, factor) > KEPT * coherence else None


def _as_stated(many: _Records, frame: MeasuringFrame, factor: float, free: Bools) -> tuple[MeasuringFrame, float]:
    """The frame, and its factor, of which only some is free; the rest is as stated, and known no better than it was off."""
    errors = np.where(free, frame.errors, np.maximum(np.abs(frame.changes), frame.errors))
    frame = frame.with_changes(frame.changes * free, errors)
    for _ in range(STEPS):
        frame, factor = _step(many, frame, factor, free)
    return frame, factor


def enough(board: Board, points: int) -> bool:
    """Whether this number of points can tell the frame."""
    return points >= LEAST_POINTS and points * len(board.actuators) >= LEAST_RECORDS


def away_from_edges(board: Board, points_m: Floats) -> Indices:
    """Points whose direct waves come alone; all if these are few."""
    from_edge_m = np.minimum(points_m, 2 * middle_m(board) - points_m).min(axis=1)
    inside = np.flatnonzero(from_edge_m > EDGE_WAVES * Dispersion.of(board.plate).wavelength_m(board.waveform.band_low_hz))
    return inside if len(inside) >= ENOUGH else np.arange(len(points_m))


def _records(
    board: Board,
    bins: RawBins,
    points_m: Floats,
    transfers: NDArray[np.complexfloating],
    resolved: Bools,
    most: tuple[int, int, int],  # points, patches, bins
    part: float,
) -> _Records:
    inside = away_from_edges(board, points_m)
    points = inside[_some(len(inside), most[0])]
    patches = _some(len(board.actuators), most[1])
    low_hz, high_hz = board.waveform.band_low_hz, board.waveform.band_high_hz
    in_part = np.flatnonzero((bins.frequency_hz >= low_hz) & (bins.frequency_hz <= low_hz + part * (high_hz - low_hz)))
    chosen = in_part[_some(len(in_part), most[2])]
    channels = np.array([a.channel for a in board.actuators])[patches]
    values = transfers[np.ix_(points, channels, chosen)] * resolved[np.ix_(points, channels)][..., None]
    power = np.sqrt((np.abs(values) ** 2).sum(axis=2, keepdims=True))
    values = np.divide(values, power, out=np.zeros(values.shape, np.complex128), where=power > 0)
    places_m = np.array([(a.x_mm, a.y_mm) for a in board.actuators])[patches] * 1e-3
    return _Records(board, bins, points_m[points], patches, places_m, bins.frequency_hz[chosen], values)


def _some(count: int, most: int) -> Indices:
    return np.linspace(0, count - 1, min(count, most)).round().astype(np.intp)


def _search(few: _Records) -> tuple[MeasuringFrame, float, float]:
    """The best frame of the lattice, its factor on the wavenumber, and its coherence."""
    frames = [
        MeasuringFrame(mirror, (x_m, y_m), rotation, scale)
        for mirror, rotation, scale, x_m, y_m in product(MIRRORS, ROTATIONS, SCALES, OFFSETS_M, OFFSETS_M)
    ]
    found = sorted(((_coherence(few, frame, 1.0), -number) for number, frame in enumerate(frames)), reverse=True)
    best = [
        (_coherence(few, frames[-at], factor), -number, at) for _, at in found[:PROMISING] for number, factor in enumerate(FACTORS)
    ]
    coherence, less, at = max(best)
    return frames[-at], FACTORS[-less], coherence


def _coherence(few: _Records, frame: MeasuringFrame, factor: float) -> float:
    """Of records and waves without directivity, whose phase alone says where they come from."""
    k = factor * Dispersion.of(few.board.plate).wavenumber(few.frequency_hz)
    away_m = frame.places(few.points_m, middle_m(few.board))[:, None] - few.places_m
    r: Floats = np.hypot(away_m[..., 0], away_m[..., 1])[..., None]
    weight: Floats = np.where(k * r > 2 * np.pi * NEAR_WAVELENGTHS, 1 / np.sqrt(r), 0.0)
    sums = np.abs(np.einsum("pqf,pqf->f", few.values * weight, np.exp(1j * k * r))) ** 2
    power = (np.abs(few.values) ** 2).sum(axis=(0, 1)) * (weight**2).sum(axis=(0, 1))
    return float(np.divide(sums, power, out=np.zeros(k.size), where=power > 0).mean())


def _explained(many: _Records, frame: MeasuringFrame, factor: float) -> float:
    """Share of the records' power that direct waves and their first echoes explain, each edge's with a factor of its own a bin.

    The echo at a point is the direct wave at the point that lies mirrored behind the edge.
    """
    (x, y), (far_x, far_y) = frame.places(many.points_m, middle_m(many.board)).T, 2 * middle_m(many.board)
    mirrored_m = np.array([(x, y), (-x, y), (2 * far_x - x, y), (x, -y), (x, 2 * far_y - y)]).swapaxes(1, 2).reshape(-1, 2)
    waves = direct_wave(many.board, many.frequency_hz, many.bins.bit_clock_hz, mirrored_m, factor, many.patches)
    bins = len(many.frequency_hz)
    of_bin = waves.reshape(5, -1, bins).transpose(2, 0, 1) * np.tile(many.values.any(axis=2).reshape(-1), (5, 1))
    values = many.values.reshape(-1, bins).T[..., None]
    basis = np.linalg.qr(of_bin.swapaxes(1, 2))[0]  # (bin, point and patch, wave)
    shares = np.abs(basis.conj().swapaxes(1, 2) @ values) ** 2
    power = np.maximum((np.abs(values) ** 2).sum(axis=(1, 2)), 1e-300)
    return float((shares.sum(axis=(1, 2)) / power).mean())


def _step(
    many: _Records, frame: MeasuringFrame, factor: float, free: Bools | tuple[bool, ...] = (True,) * 4
) -> tuple[MeasuringFrame, float]:
    """One of Gauss and Newton's steps, for the wavenumber and what of offset, rotation and scale is free, together."""
    places_m = frame.places(many.points_m, middle_m(many.board))
    wave = direct_wave(many.board, many.frequency_hz, many.bins.bit_clock_hz, places_m, factor, many.patches)
    wave = wave * np.any(many.values, axis=2, keepdims=True)
    wave = wave / np.sqrt((np.abs(wave) ** 2).sum(axis=(0, 1)) + 1e-300)
    k = factor * Dispersion.of(many.board.plate).wavenumber(many.frequency_hz)
    away_m = places_m[:, None] - many.places_m
    r = np.hypot(away_m[..., 0], away_m[..., 1])
    toward = away_m / r[..., None]
    turned_m: Floats = places_m - middle_m(many.board) - frame.offset_m
    slopes = [  # of r: by offset, rotation, scale, and of r itself by the factor
        toward[..., 0],
        toward[..., 1],
        toward[..., 1] * turned_m[:, None, 0] - toward[..., 0] * turned_m[:, None, 1],
        (toward * turned_m[:, None]).sum(axis=2) / frame.scale,
        r / factor,
    ]
    common = (many.values * wave.conj()).sum(axis=(0, 1))  # what all records have in common
    columns = np.stack([-1j * k * slope[..., None] * wave * common for slope in slopes])
    on_wave = (columns * wave.conj()).sum(axis=(1, 2))
    columns -= on_wave[:, None, None] * wave
    left = many.values - common * wave
    normal = np.einsum("apqf,bpqf->pab", columns.conj(), columns, optimize=True).real
    right = np.einsum("apqf,pqf->pa", columns.conj(), left, optimize=True).real
    fitted = np.flatnonzero((*free, True))
    normal, right = normal[:, fitted[:, None], fitted], right[:, fitted]
    change, error = np.zeros(5), np.append(frame.errors, 0.0)
    change[fitted] = np.linalg.solve(normal.sum(axis=0), right.sum(axis=0))
    groups = min(GROUPS, len(normal))
    parts = [np.arange(len(normal)) % groups != group for group in range(groups)]
    without = np.array([np.linalg.solve(normal[some].sum(axis=0), right[some].sum(axis=0)) for some in parts])
    error[fitted] = np.sqrt((groups - 1) * without.var(axis=0))  # the jackknife
    limit = np.clip(change, *(np.array([-1, 1])[:, None] * [2e-3, 2e-3, 0.02, 0.02, 0.02]))
    return frame.with_changes(frame.changes + limit[:4], error[:4]), factor + float(limit[4])
