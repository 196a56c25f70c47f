"""Interpolation on a grid of the middles of equal cells: a sum of cosines, the field mirrored at the edges.

A field of waves not shorter than two cells is what its samples say, but for what the mirror bends at the edges. No plate constant
is needed, and no edge condition. Places of the grid where a channel was not measured are estimated first from those around them, as
between scattered points.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.fft import dct

from controller.arrays import Bools, Floats, Indices
from controller.workshop.calibration.interpolation.kriging import NOISE, Prior, alike
from controller.workshop.calibration.interpolation.spectra import Spectra

OFF_PLACE = 0.15  # of a cell: how far a point may lie off its place in a grid
WINDOW = 7  # places along each side of the square from which one of them is estimated
EVALUATED = 60  # places


@dataclass(frozen=True, eq=False)
class Lattice:
    """A regular grid on which points lie, on a plate whose corner is the origin."""

    x_m: Floats  # x_m, y_m: (nx,), (ny,): places along the sides
    y_m: Floats
    place: Indices  # (point,): of each point: row * nx + column

    @classmethod
    def found_in(cls, points_m: Floats) -> Self | None:
        """The grid on which points, (point, 2), lie, each on a place of its own and half of all places or more taken; or none."""
        x_m, y_m = _even(points_m[:, 0]), _even(points_m[:, 1])
        if x_m is None or y_m is None or len(points_m) * 2 < x_m.size * y_m.size:
            return None
        column, row = (abs(points_m[:, [axis]] - places).argmin(axis=1) for axis, places in enumerate((x_m, y_m)))
        place = row * x_m.size + column
        return cls(x_m, y_m, place) if np.unique(place).size == place.size else None

    @property
    def pitch_m(self) -> float:
        """Distance of neighbours, the larger one of both directions."""
        return float(max(np.diff(self.x_m).mean(), np.diff(self.y_m).mean()))

    def covers(self, length_m: float, width_m: float) -> bool:
        """Whether its places are the middles of equal cells of the whole plate."""
        return all(
            np.abs(places - (np.arange(places.size) + 0.5) * (extent / places.size)).max() <= OFF_PLACE * extent / places.size
            for places, extent in ((self.x_m, length_m), (self.y_m, width_m))
        )

    def window(self, place: int) -> Indices:
        """Places of a square around one, shifted where it would reach beyond the grid."""
        sides = []
        for at, count in zip(divmod(place, self.x_m.size), (self.y_m.size, self.x_m.size), strict=True):
            first = max(min(at - WINDOW // 2, count - WINDOW), 0)
            sides.append(np.arange(first, min(first + WINDOW, count)))
        row, column = sides
        return (row[:, None] * self.x_m.size + column).reshape(-1)

    def points(self) -> Floats:
        """All places: (place, 2) in m."""
        return np.column_stack([np.tile(self.x_m, self.y_m.size), np.repeat(self.y_m, self.x_m.size)])


@dataclass(frozen=True, eq=False)
class Cosines:
    """A field known on a grid of cells, and everywhere between."""

    extents_m: tuple[float, float]  # length and width of the plate
    amplitudes: Spectra  # (bin, half wave along y, half wave along x, channel)

    @classmethod
    def of(cls, values: Spectra, columns: int, extents_m: tuple[float, float]) -> Self:
        """Of values at all places, (bin, place, channel), rows of this many columns."""
        bins, places, channels = values.shape
        plain = values.reshape(bins, places // columns, columns, channels)
        for axis in (1, 2):
            plain = dct(plain, type=2, axis=axis, norm="forward")
            plain[(slice(None),) * axis + (slice(1, None),)] *= 2
        return cls(extents_m, plain.astype(np.complex64, copy=False))

    def at(self, targets_m: Floats) -> Spectra:
        """The field at other points: (bin, target, channel). Those of one row follow each other at best."""
        bins, rows, columns, channels = self.amplitudes.shape
        found = np.empty((bins, len(targets_m), channels), np.complex64)
        of_row = self.amplitudes.view(np.float32).reshape(bins, rows, -1)
        firsts = np.flatnonzero(np.diff(targets_m[:, 1], prepend=np.nan) != 0).tolist()
        for first, end in zip(firsts, [*firsts[1:], len(targets_m)], strict=True):
            along_y = np.cos(np.arange(rows) * np.pi * targets_m[first, 1] / self.extents_m[1]).astype(np.float32)
            line = (along_y @ of_row).reshape(bins, columns, 2 * channels)
            along_x = np.cos(np.outer(targets_m[first:end, 0], np.arange(columns) * np.pi / self.extents_m[0])).astype(np.float32)
            found[:, first:end] = (along_x @ line).view(np.complex64)
        return found


def fill_places(
    lattice: Lattice,
    values: Spectra,  # (bin, place, channel): completed in place
    known: Bools,  # (place, channel)
    prior: Prior,
    noise: float = NOISE,  # variance of the noise, in that of the field
    progress: Callable[[int, int], None] = lambda _done, _total: None,  # called with the number of places done and of all
) -> Spectra:
    """Estimate places of a grid from their neighbours, as if they were missing; those that are missing get that estimate.

    Where none is missing, neighbours weigh the same all over the plate but near its edges; else `EVALUATED` places stand for all.

    Returns places (bin, place, channel) as foreseen by their neighbours, NaN where that was not estimated.
    """
    places = lattice.points()
    measured, foreseen = values.copy() if not known.all() else values, np.full_like(values, np.nan)
    weights: dict[tuple[int, bytes], Floats] = {}  # by the place within its window, and what is known there
    groups = [channels for _, channels in alike(known)]
    work = []
    for channels in groups:
        there = known[:, channels[0]]
        evaluated = np.flatnonzero(there)
        if not there.all():
            evaluated = np.random.default_rng(1).permutation(evaluated)[: EVALUATED // len(groups)]
        work += [(place, channels) for place in np.concatenate([np.flatnonzero(~there), evaluated]).tolist()]
    for done, (place, channels) in enumerate(work, 1):
        window = lattice.window(place)
        usable = known[window, channels[0]] & (window != place)
        near = window[usable]
        name = (int(np.flatnonzero(window == place)[0]), usable.tobytes())
        if name not in weights:
            weights[name] = _weights(prior, places[[place]], places[near], len(values), noise)
        foreseen[:, place, channels] = np.einsum("bp,bpc->bc", weights[name], measured[:, near][:, :, channels])
        if not known[place, channels[0]]:
            values[:, place, channels] = foreseen[:, place, channels]
        progress(done, len(work))
    return foreseen


def _weights(prior: Prior, target_m: Floats, points_m: Floats, bins: int, noise: float) -> Floats:
    """Weights of points in the estimate at one target: (bin, point)."""
    among, between = prior.between(points_m, points_m), prior.between(points_m, target_m)
    whole = np.stack([among(bin_) for bin_ in range(bins)]) + noise * np.eye(len(points_m))
    return np.linalg.solve(whole, np.stack([between(bin_) for bin_ in range(bins)]))[:, :, 0].astype(np.float64, copy=False)


def _even(places_m: Floats) -> Floats | None:
    """Evenly spaced places on which all of `places_m`, (point,), lie; none if there are not."""
    ordered = np.sort(places_m)
    gaps = np.diff(ordered)
    apart = gaps > 0.2 * gaps.max(initial=0.0)
    if not apart.any():
        return None
    means = np.array([some.mean() for some in np.split(ordered, np.flatnonzero(apart) + 1)])
    pitch_m = float(np.median(np.diff(means)))
    count = round((means[-1] - means[0]) / pitch_m) + 1
    step_m = float(means[-1] - means[0]) / (count - 1)
    found = np.array([float(means[0]) + index * step_m for index in range(count)])
    off_m = np.abs(found - places_m[:, None]).min(axis=1)
    return found if count > 2 and off_m.max() <= OFF_PLACE * pitch_m else None
