"""Modes of a rectangular Kirchhoff plate with any edges, by Ritz's method in products of one-dimensional functions.

The energy of bending, and of a strip of foam where there is one, is a matrix over products of functions that are orthonormal along
x and along y (`one_dimensional_basis`), so its eigenvalues are k^4 of the modes and its eigenvectors their shapes: a standard
symmetric problem. Where opposite edges are alike, modes are even or odd about the middle, and each class is a problem of its own.

Rounding: eigenvalues of a matrix whose largest is C times the lowest are wrong by C times the rounding of a number, 1e-4 of the
lowest ones. The lowest are found again among themselves from factors of the energy, whose rounding counts only by its square.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from controller.arrays import Floats
from controller.device.board.plate.plate import Support
from controller.errors import ConfigError
from controller.workshop.physics.modes.mode_count import mode_count
from controller.workshop.physics.modes.one_dimensional_basis import (
    Functions,
    LegendrePolynomials,
    OneDimensionalBasis,
    Parity,
    Splines,
    spline_breaks,
)

Pair = tuple[float, float]
Ends = tuple[tuple[Support, Support], tuple[Support, Support]]

WATCHED = 1.5e10  # functions cubed that take more than about two seconds
STIFF_FOAM = 0.01  # stiffness, over what accelerates the plate at the highest frequency, above which its rim is a crease
ROUNDING = float(np.finfo(np.float64).eps)
FOUND_AGAIN = 1e-7  # modes whose k^4 rounding would change by more than this share


@dataclass(frozen=True)
class PlateShape:
    """What the shapes and wavenumbers of a plate's modes depend on."""

    lengths_m: Pair  # (along x, along y)
    ends: Ends  # ((at x = 0, at the far end), the same along y)
    poisson_ratio: float
    foam: float = 0.0  # stiffness of the foam over the plate's bending stiffness, 1/m^4
    foam_width_m: float = 0.0  # of the strip along each side that is "foam"

    @property
    def rigid(self) -> int:
        """How many motions need no energy."""
        held = [end for pair in self.ends for end in pair if end != "free"]
        return 3 if not held else int(held == ["simply_supported"])

    def with_foam_as(self, instead: Support) -> Ends:
        """The edges with another support in place of foam."""
        (a, b), (c, d) = (tuple(instead if end == "foam" else end for end in pair) for pair in self.ends)
        return (a, b), (c, d)

    def between_strips(self, axis: int) -> Pair:
        """Interval of an axis that no strip along its two ends covers."""
        near, far = (self.foam_width_m if end == "foam" else 0.0 for end in self.ends[axis])
        return near, self.lengths_m[axis] - far


@dataclass(frozen=True, eq=False)
class ModeClass:
    """Modes of the same symmetry, lowest first."""

    x: OneDimensionalBasis
    y: OneDimensionalBasis
    wavenumber4: Floats  # (mode,): k^4 in 1/m^4
    coefficients: Floats  # (y function, mode, x function): of the shapes, whose mean square over the plate is 1, in m
    foam_share: Floats  # (mode,): share of a shape's square on the strips of foam

    def above(self, lowest: float) -> ModeClass:
        """The modes from the k^4 `lowest` on."""
        some = slice(int(np.searchsorted(self.wavenumber4, lowest)), None)
        coefficients = np.ascontiguousarray(self.coefficients[:, some])
        return ModeClass(self.x, self.y, self.wavenumber4[some], coefficients, self.foam_share[some])


@dataclass(frozen=True, eq=False)
class PlateSolution:
    """All modes up to a wavenumber, by class."""

    classes: tuple[ModeClass, ...]
    condition: float  # largest eigenvalue of the energy's matrices over the lowest that is not a rigid motion's


def solve(plate: PlateShape, highest_k: float) -> PlateSolution:
    """All modes up to the wavenumber `highest_k` in 1/m; rigid motions are left out.

    Raises ConfigError if the functions do not give the number of modes that there are.
    """
    from threadpoolctl import threadpool_limits
    from tqdm import tqdm

    pairs = bases(plate, highest_k)
    long = sum(float(x.count * y.count) ** 3 for x, y in pairs) > WATCHED
    largest, classes = 0.0, []
    with (
        threadpool_limits(1, "blas"),  # two threads against other work spin: ten times as slow
        tqdm(total=len(pairs), desc="modes of the plate", unit="class", disable=None if long else True) as bar,
    ):
        for x, y in pairs:
            energy = _Energy(plate, x, y)
            largest = max(largest, energy.largest)
            classes.append(energy.mode_class(*energy.modes(highest_k**4)))
            bar.update()
    every = np.sort(np.concatenate([found.wavenumber4 for found in classes]))
    inner = plate.between_strips(0), plate.between_strips(1)
    most = mode_count(plate.lengths_m, plate.with_foam_as("free"), plate.poisson_ratio, highest_k)
    least = mode_count(
        (inner[0][1] - inner[0][0], inner[1][1] - inner[1][0]), plate.with_foam_as("clamped"), plate.poisson_ratio, highest_k
    )
    leeway = 4 + 0.4 * highest_k / np.pi * max(plate.lengths_m) / np.sqrt(1 + highest_k / np.pi * min(plate.lengths_m))
    if not least - leeway <= every.size <= most + leeway:  # a sum over half waves differs from its integral by so much
        raise ConfigError(f"plate.edges: {every.size} modes were found where {least:.0f} to {most:.0f} are expected")
    first = float(every[plate.rigid]) if every.size > plate.rigid else np.inf
    return PlateSolution(tuple(found.above(first) for found in classes), largest / first)


def bases(
    plate: PlateShape, highest_k: float, coefficients: list[tuple[Floats, Floats]] | None = None
) -> list[tuple[OneDimensionalBasis, OneDimensionalBasis]]:
    """Functions along x and along y of each class; with `coefficients` of an earlier call those, bit for bit."""
    along_x, along_y = plate_functions(plate, highest_k)
    if coefficients is not None:
        return [(OneDimensionalBasis(along_x, x), OneDimensionalBasis(along_y, y)) for x, y in coefficients]
    every_x, every_y = (
        [OneDimensionalBasis.of(functions, ends, parity) for parity in _parities(ends)]
        for functions, ends in zip((along_x, along_y), plate.ends, strict=True)
    )
    return list(product(every_x, every_y))


def _parities(ends: tuple[Support, Support]) -> list[Parity | None]:
    return ["even", "odd"] if ends[0] == ends[1] else [None]


def longest_matrix(plate: PlateShape, highest_k: float) -> int:
    """About how many functions a class of modes has."""
    counts = [
        -(-functions.count // len(_parities(ends)))
        for functions, ends in zip(plate_functions(plate, highest_k), plate.ends, strict=True)
    ]
    return counts[0] * counts[1]


def plate_functions(plate: PlateShape, highest_k: float) -> tuple[Functions, Functions]:
    """Functions along x and along y, enough for waves up to `highest_k`.

    Errors of frequencies are below 1e-5 where both pairs of opposite edges are alike, else below 4e-4. At a corner of a clamped and
    a free edge or foam the curvature has no bound if Poisson's ratio is large: at 0.45 errors of hundreds of modes reach 3e-5.
    """
    alike = all(ends[0] == ends[1] for ends in plate.ends)
    stiff = plate.foam > STIFF_FOAM * highest_k**4
    found: list[Functions] = []
    for axis, length in enumerate(plate.lengths_m):
        half_turns = max(highest_k * length / 2, 1.0)
        if alike and not stiff:
            found.append(LegendrePolynomials(length, int(np.ceil(half_turns + 2.5 * half_turns ** (1 / 3))) + 6))
            continue
        strips = sorted({*plate.between_strips(axis)} - {0.0, length})
        breaks = spline_breaks([0.0, *strips, length], int(np.ceil((0.95 if alike else 0.8) * half_turns)) + 1)
        found.append(Splines(breaks, tuple(strips) if stiff else ()))
    return found[0], found[1]


class _Energy:
    """Energy of one class, over the plate's bending stiffness, as matrices of one-dimensional integrals."""

    def __init__(self, plate: PlateShape, x: OneDimensionalBasis, y: OneDimensionalBasis) -> None:
        self.x, self.y = x, y
        self._plate = plate
        self._second = x.factor(2), y.factor(2)
        self._first = x.factor(1), y.factor(1)
        self._mixed = x.gram(0, 2), y.gram(0, 2)
        self._inner = x.gram(0, 0, *plate.between_strips(0)), y.gram(0, 0, *plate.between_strips(1))

    @property
    def largest(self) -> float:
        """About the largest eigenvalue."""
        return sum((float(np.linalg.norm(factor, 2)) ** 2 for factor in self._second), self._plate.foam)

    def modes(self, highest: float) -> tuple[Floats, Floats]:
        """Eigenvalues up to `highest`, (mode,), and eigenvectors, (x function * y function, mode)."""
        from scipy.linalg import eigh

        values, vectors = eigh(
            self._matrix(), subset_by_value=(-np.inf, highest), driver="evr", overwrite_a=True, check_finite=False
        )
        low = int(np.searchsorted(values, self.largest * ROUNDING / FOUND_AGAIN))
        if low:
            exact, turned = eigh(self._among(vectors[:, :low]))
            values[:low], vectors[:, :low] = np.maximum(exact, 0.0), vectors[:, :low] @ turned
        return values, vectors

    def mode_class(self, values: Floats, vectors: Floats) -> ModeClass:
        """Modes of this class with their shapes scaled."""
        shapes = np.ascontiguousarray(vectors.reshape(self.x.count, self.y.count, -1).transpose(1, 2, 0))
        inner = np.einsum("jmi,jmi->m", shapes, np.tensordot(self._inner[1], shapes @ self._inner[0], (1, 0)))
        shapes *= np.sqrt(self._plate.lengths_m[0] * self._plate.lengths_m[1])
        return ModeClass(self.x, self.y, values, shapes, np.clip(1 - inner, 0.0, 1.0))

    def _matrix(self) -> Floats:
        """The whole: (x function * y function, the same)."""
        nu, (x_mixed, y_mixed) = self._plate.poisson_ratio, self._mixed
        (x_slope, y_slope), (x_bend, y_bend) = (tuple(f.T @ f for f in factors) for factors in (self._first, self._second))
        nx, ny, foam = self.x.count, self.y.count, self._plate.foam
        matrix = np.zeros((nx * ny, nx * ny))
        blocks = matrix.reshape(nx, ny, nx, ny)
        for j in range(ny):
            blocks[:, j, :, j] += x_bend
        for i in range(nx):
            terms = np.stack([nu * x_mixed[:, i], nu * x_mixed[i], 2 * (1 - nu) * x_slope[i], -foam * self._inner[0][i]])
            forms = np.stack([y_mixed, y_mixed.T, y_slope, self._inner[1]])
            blocks[i] += np.tensordot(forms, terms, (0, 0)).transpose(0, 2, 1)
            blocks[i, :, i] += y_bend
        matrix[np.diag_indices(nx * ny)] += foam
        return matrix

    def _among(self, vectors: Floats) -> Floats:
        """Energy among some vectors, (x function * y function, m), from its factors: (m, m)."""
        nu, foam = self._plate.poisson_ratio, self._plate.foam
        shapes = vectors.T.reshape(-1, self.x.count, self.y.count)
        (x_first, y_first), (x_second, y_second) = self._first, self._second

        def dot(a: Floats, b: Floats) -> Floats:
            return a.reshape(len(a), -1) @ b.reshape(len(b), -1).T

        along_x, along_y, twist = x_second @ shapes, shapes @ y_second.T, x_first @ shapes @ y_first.T
        cross = nu * dot(self._mixed[0] @ shapes, shapes @ self._mixed[1].T)
        on_foam = foam * (dot(shapes, shapes) - dot(self._inner[0] @ shapes @ self._inner[1], shapes))
        return dot(along_x, along_x) + dot(along_y, along_y) + cross + cross.T + 2 * (1 - nu) * dot(twist, twist) + on_foam
