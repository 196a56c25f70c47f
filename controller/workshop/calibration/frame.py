"""Where the measuring frame lies on the plate: offset, rotation, scale, mirror, by the waves that come straight from the patches.

Places of points are stated in the frame of a scanner or a ruler, patches lie where board.toml says. In the right frame the records
agree best with the direct waves G of `direct_wave`, frequency by frequency,

    coherence = mean over bins of |sum of H conj(G)|^2 / (sum of |H|^2 sum of |G|^2),    sums over points and patches,

whatever all records have in common: delay, unit, sensitivity, sign, a sensor's mass. A lattice of frames in the lower part of the
band finds the neighbourhood, Gauss and Newton's method with more and more of the band the frame.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from controller.device.board.board import Board
from controller.workshop.calibration.direct_wave import NEAR_WAVELENGTHS, Complex, Floats, direct_wave
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.transfers import RawBins

MANY = 256, 32, 40  # points, patches and bins, at most
FEW = 32, 8, 16  # by which the lattice is searched
EDGE_WAVES = 0.5  # nearer to an edge than so many of the longest waves, what it sends back comes with the direct wave
LOWER = 0.4  # of the band, in which the lattice is searched
OFFSETS_M = (-8e-3, -4e-3, 0.0, 4e-3, 8e-3)
ROTATIONS = (0.0, -0.03, 0.03)  # in rad
SCALES = (1.0, 0.97, 1.03)
FACTORS = (1.0, 0.98, 1.02, 0.96, 1.04)  # of the wavenumber
PROMISING = 8  # frames of the lattice with which other factors than 1 are tried
STEPS = 4  # of Gauss and Newton's method, for each part of the band
PARTS = (LOWER, 0.7, 1.0)
MOVED_M = 0.4e-3  # a frame that moves no point by more is left as stated: patches and edges leave so much open
SURE = 4.0  # standard deviations
WORTH = 1.025  # times the coherence without it, at least, of what is not as stated
GROUPS = 8  # of points, whose scatter says how sure the frame is
LEAST_POINTS, LEAST_RECORDS = 6, 128  # records: points times patches
KEPT = 0.8  # of the lattice's coherence: what strays from it is no frame
ENOUGH = 100  # points away from the edges: of fewer, all are used
WIDEST = np.array([0.012, 0.012, 0.06, 0.06])  # offset in m, rotation, scale: beyond, it is no frame of this plate
ABOVE_CHANCE = 4.0  # times the coherence of records that have nothing to do with G
MIRRORS = {  # from stated coordinates to those of the plate, about its middle
    "": ((1, 0), (0, 1)),
    "x runs the other way": ((-1, 0), (0, 1)),
    "y runs the other way": ((1, 0), (0, -1)),
    "x and y run the other way": ((-1, 0), (0, -1)),
    "x and y are exchanged": ((0, 1), (1, 0)),
    "x and y are exchanged, x runs the other way": ((0, -1), (1, 0)),
    "x and y are exchanged, y runs the other way": ((0, 1), (-1, 0)),
    "x and y are exchanged, both run the other way": ((0, -1), (-1, 0)),
}


@dataclass(frozen=True)
class MeasuringFrame:
    """How stated places become those on the plate: mirrored, turned and stretched about the plate's middle, then moved."""

    mirror: str = ""  # a key of `MIRRORS`
    offset_m: tuple[float, float] = (0.0, 0.0)
    rotation: float = 0.0  # in rad, from x to y
    scale: float = 1.0
    factor: float = 1.0  # of the wavenumber, with which the direct waves fit best
    offset_error_m: tuple[float, float] = (0.0, 0.0)  # these three: standard deviations
    rotation_error: float = 0.0
    scale_error: float = 0.0

    def places(self, points_m: Floats, middle_m: Floats) -> Floats:
        """Where stated points, (point, 2), lie on the plate."""
        cos, sin = self.scale * np.cos(self.rotation), self.scale * np.sin(self.rotation)
        turned = np.array([[cos, -sin], [sin, cos]]) @ np.array(MIRRORS[self.mirror])
        found: Floats = (points_m - middle_m) @ turned.T + middle_m + self.offset_m
        return found

    @property
    def sure(self) -> tuple[bool, ...]:
        """Whether offset along x, offset along y, rotation and scale are surely not nil."""
        off = (*self.offset_m, self.rotation, self.scale - 1)
        errors = (*self.offset_error_m, self.rotation_error, self.scale_error)
        return tuple(abs(value) > SURE * error for value, error in zip(off, errors, strict=True))

    def differs(self, board: Board, points_m: Floats) -> bool:
        """Whether it is surely another frame than the stated one, and not by so little that patches and edges leave it open."""
        moved_m = self.places(points_m, middle_m(board)) - points_m
        return (bool(self.mirror) or any(self.sure)) and float(np.hypot(moved_m[:, 0], moved_m[:, 1]).max()) > MOVED_M

    def in_words(self) -> str:
        """Figures with their standard deviations."""
        x, y = (
            f"{1e3 * value:+.2f} ± {1e3 * error:.2f} mm" for value, error in zip(self.offset_m, self.offset_error_m, strict=True)
        )
        turned = f"{np.degrees(self.rotation):+.2f} ± {np.degrees(self.rotation_error):.2f}°"
        stretched = f"{100 * (self.scale - 1):+.2f} ± {100 * self.scale_error:.2f} %"
        return f"{self.mirror + ', ' if self.mirror else ''}x {x}, y {y}, turned by {turned}, larger by {stretched}"


def middle_m(board: Board) -> Floats:
    """Of the plate: (2,)."""
    return np.array([board.plate.length_m, board.plate.width_m]) / 2


@dataclass(frozen=True, eq=False)
class _Records:
    """Transfer functions of some points and patches in some bins, each record of power one."""

    board: Board
    bins: RawBins
    points_m: Floats  # (point, 2)
    patches: NDArray[np.intp]
    places_m: Floats  # (patch, 2): of these
    frequency_hz: Floats
    values: Complex  # (point, patch, bin)


def locate(
    board: Board,
    bins: RawBins,
    points_m: Floats,  # (point, 2): as stated
    transfers: NDArray[np.complexfloating],  # (point, 32, bin)
    resolved: NDArray[np.bool_],  # (point, 32)
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
    for number in np.flatnonzero(free).tolist():  # so is what explains next to nothing: edges can feign it
        without = _as_stated(many, frame, factor, free & (np.arange(4) != number))
        if _coherence(many, *without) * WORTH > _coherence(many, frame, factor):
            (frame, factor), free[number] = without, False
    inside = np.abs([*frame.offset_m, frame.rotation, frame.scale - 1]) < WIDEST
    frame = replace(frame, factor=factor)
    return frame if inside.all() and _coherence(few, frame, factor) > KEPT * coherence else None


def _as_stated(many: _Records, frame: MeasuringFrame, factor: float, free: NDArray[np.bool_]) -> tuple[MeasuringFrame, float]:
    """The frame, and its factor, of which only some is free; the rest is as stated."""
    x, y, turned, stretched = free.tolist()
    offset_m = (frame.offset_m[0] * x, frame.offset_m[1] * y)
    frame = replace(frame, offset_m=offset_m, rotation=frame.rotation * turned, scale=frame.scale if stretched else 1.0)
    for _ in range(STEPS):
        frame, factor = _step(many, frame, factor, (x, y, turned, stretched))
    return frame, factor


def enough(board: Board, points: int) -> bool:
    """Whether so many points can tell the frame."""
    return points >= LEAST_POINTS and points * len(board.actuators) >= LEAST_RECORDS


def away_from_edges(board: Board, points_m: Floats) -> NDArray[np.intp]:
    """Points whose direct waves come alone; all if these are few."""
    from_edge_m = np.minimum(points_m, 2 * middle_m(board) - points_m).min(axis=1)
    inside = np.flatnonzero(from_edge_m > EDGE_WAVES * Dispersion.of(board.plate).wavelength_m(board.waveform.band_low_hz))
    return inside if len(inside) >= ENOUGH else np.arange(len(points_m))


def _records(
    board: Board,
    bins: RawBins,
    points_m: Floats,
    transfers: NDArray[np.complexfloating],
    resolved: NDArray[np.bool_],
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


def _some(count: int, most: int) -> NDArray[np.intp]:
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


def _step(
    many: _Records, frame: MeasuringFrame, factor: float, free: tuple[bool, ...] = (True,) * 4
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
    change, error = np.zeros(5), np.array([*frame.offset_error_m, frame.rotation_error, frame.scale_error, 0.0])
    change[fitted] = np.linalg.solve(normal.sum(axis=0), right.sum(axis=0))
    groups = min(GROUPS, len(normal))
    parts = [np.arange(len(normal)) % groups != group for group in range(groups)]
    without = np.array([np.linalg.solve(normal[some].sum(axis=0), right[some].sum(axis=0)) for some in parts])
    error[fitted] = np.sqrt((groups - 1) * without.var(axis=0))  # the jackknife
    limit = np.clip(change, *(np.array([-1, 1])[:, None] * [2e-3, 2e-3, 0.02, 0.02, 0.02]))
    x_m, y_m, rotation, scale, wavenumber = limit.tolist()
    return replace(
        frame,
        offset_m=(frame.offset_m[0] + x_m, frame.offset_m[1] + y_m),
        rotation=frame.rotation + rotation,
        scale=frame.scale + scale,
        offset_error_m=(float(error[0]), float(error[1])),
        rotation_error=float(error[2]),
        scale_error=float(error[3]),
    ), factor + wavenumber
