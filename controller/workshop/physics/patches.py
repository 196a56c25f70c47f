"""Modes of a plate with patches on it, as sums of the modes of the bare plate.

A patch adds its mass to the mass matrix and its stiffness to that of the energy; both are integrals of the bare plate's shapes over
the patch. The modes with patches are the eigenvectors of both matrices over all modes of the bare plate up to `BASIS` times the
frequency that is asked for. First order, each mode by itself, overstates the shift by half: a disc is about a wave long and trebles
the stiffness.

Integrals are taken through the values of the shapes at Gauss's nodes of each patch's square, whatever the shapes are made of: they
fix polynomials of which values and second derivatives are integrated over disc or square, as a quadratic form of those values.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, DTypeLike
from scipy.linalg import eigh

from controller.arrays import Floats, Reals
from controller.device.board.panel import Actuator
from controller.device.board.plate.patches import Patch, Patches
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_stiffness, bending_wavelength_m
from controller.errors import ConfigError
from controller.workshop.physics.modes.modes import Modes, TensorFactors

BASIS = 1.25  # highest frequency of the bare plate's modes, over that of the modes asked for
MOST_MODES = 8_000  # of the bare plate: two matrices of half a gigabyte, ten minutes
SPARE_NODES = 12  # beyond half the phase across a patch: values to 1e-6
NEGLIGIBLE = 1e-12  # of a quadratic form's largest eigenvalue


@dataclass(frozen=True, eq=False)
class CombinedModes:
    """Sums of the modes of another plate (`modes.Modes`)."""

    base: Modes
    parts: Floats  # (mode of the base, mode): the shapes, in those of `base`
    angular_frequency: Floats  # angular_frequency, decay_rate, mass_kg: (mode,)
    decay_rate: Floats
    mass_kg: Floats
    expected_shift: Floats  # (mode of the base,): relative shift of each mode of the base by itself, to first order

    def shift(self, low_hz: float, high_hz: float) -> tuple[float, float]:
        """Mean relative shift of the base's modes between two frequencies by number, and that expected to first order."""
        frequency = self.base.angular_frequency[: self.count] / (2 * np.pi)
        band = np.flatnonzero((frequency >= low_hz) & (frequency <= high_hz))
        if not band.size:
            return 0.0, 0.0
        found = self.angular_frequency[band] / self.base.angular_frequency[band] - 1
        return float(found.mean()), float(self.expected_shift[band].mean())

    @property
    def length_m(self) -> float:
        """As in `Modes`."""
        return self.base.length_m

    @property
    def width_m(self) -> float:
        """As in `Modes`."""
        return self.base.width_m

    @property
    def count(self) -> int:
        """As in `Modes`."""
        return self.angular_frequency.size

    @property
    def mean_square(self) -> Floats:
        """As in `Modes`: the base's shapes are orthogonal over the plate."""
        return self.base.mean_square @ self.parts**2

    @property
    def factors(self) -> TensorFactors | None:
        """None: a shape is a sum of products."""
        return None

    def shapes(self, points_m: ArrayLike, dtype: DTypeLike = np.float64) -> Reals:
        """As in `Modes`."""
        shapes: Reals = self.base.shapes(points_m, dtype) @ self.parts.astype(dtype, copy=False)
        return shapes

    def on_grid(self, amplitudes: Floats, x_m: ArrayLike, y_m: ArrayLike) -> Floats:
        """As in `Modes`."""
        return self.base.on_grid(self.parts @ amplitudes, x_m, y_m)

    def coupling(self, actuator: Actuator) -> Floats:
        """As in `Modes`."""
        return self.base.coupling(actuator) @ self.parts


def with_patches(bare: Modes, plate: Plate, patches: Patches, places: Sequence[Patch], highest_hz: float) -> CombinedModes:
    """Modes of `plate` with patches up to `highest_hz`.

    `bare` are modes of the plate without patches, up to `BASIS` times `highest_hz`. Raises ConfigError if the bare plate has too
    many modes, or none is left.
    """
    if bare.count > MOST_MODES:
        raise ConfigError(
            f"[patches]: the plate has {bare.count} modes below {BASIS * highest_hz:g} Hz, and patches are computed for at most"
            f" {MOST_MODES}: leave [patches] out, or take a smaller or thicker plate, or a lower band"
        )
    mass, stiffness = added(bare, plate, patches, places)
    expected = first_order(bare, mass, stiffness)
    size = np.sqrt(bare.mass_kg)
    mass /= np.outer(size, size)
    stiffness /= np.outer(size, size)
    mass[np.diag_indices_from(mass)] += 1
    stiffness[np.diag_indices_from(stiffness)] += bare.angular_frequency**2
    squared, vectors = eigh(stiffness, mass, overwrite_a=True, overwrite_b=True, check_finite=False)
    kept = np.flatnonzero(squared <= (2 * np.pi * highest_hz) ** 2)
    if not kept.size:
        raise ConfigError(f"the plate with [patches] has no mode below {highest_hz:g} Hz: too small or too thick to focus on")
    common_kg = float(bare.mass_kg.mean())  # so that shapes are about as large as the bare plate's
    return CombinedModes(
        base=bare,
        parts=np.ascontiguousarray(vectors[:, kept]) * (np.sqrt(common_kg) / size)[:, None],
        angular_frequency=np.sqrt(np.maximum(squared[kept], 0)),
        decay_rate=np.full(kept.size, 1 / plate.decay_time_s),
        mass_kg=np.full(kept.size, common_kg),
        expected_shift=expected,
    )


def added(bare: Modes, plate: Plate, patches: Patches, places: Sequence[Patch]) -> tuple[Floats, Floats]:
    """What patches add to mass and stiffness of the modes of the bare plate: (mode, mode) in kg and in N/m."""
    shortest_m = bending_wavelength_m(plate, float(bare.angular_frequency.max()) / (2 * np.pi))
    mass, stiffness = np.zeros((bare.count, bare.count)), np.zeros((bare.count, bare.count))
    for size_mm in sorted({place.size_mm for place in places}):
        size_m = size_mm * 1e-3
        count = int(np.ceil(1.1 * np.pi * size_m / shortest_m)) + SPARE_NODES
        nodes = np.polynomial.legendre.leggauss(count)[0] * size_m / 2
        of_mass, of_stiffness = _forms(count, size_m, patches.shape, plate.poisson_ratio)
        roots = _root(of_mass * patches.mass_kg_m2), _root(of_stiffness * bending_stiffness(plate))
        for place in places:
            if place.size_mm == size_mm:
                x, y = np.meshgrid(place.x_mm * 1e-3 + nodes, place.y_mm * 1e-3 + nodes, indexing="ij")
                values = np.asarray(bare.shapes(np.column_stack([x.ravel(), y.ravel()])), np.float64)
                heavy, stiff = (root @ values for root in roots)
                mass += heavy.T @ heavy
                stiffness += stiff.T @ stiff
    stiffness *= patches.stiffness_ratio - 1
    return mass, stiffness


def first_order(bare: Modes, mass: Floats, stiffness: Floats) -> Floats:
    """Relative shift of each mode by itself: (mode,); half of what stiffness adds to its energy, less half of what mass adds."""
    own = np.diag(stiffness) / bare.angular_frequency**2 - np.diag(mass)
    return own / (2 * bare.mass_kg)


def _forms(count: int, size_m: float, shape: Literal["disc", "square"], poisson: float) -> tuple[Floats, Floats]:
    """Integrals over a patch of the square and of the bending energy of a function, as quadratic forms of its values.

    Values are those at `count` by `count` Gauss's nodes of the square round the patch, x first; the bending stiffness is 1.
    """
    if shape == "square":
        nodes, weights = legendre.leggauss(count)
        x, y = (u.ravel() for u in np.meshgrid(nodes, nodes, indexing="ij"))
        area = np.outer(weights, weights).ravel()
    else:  # rings: Gauss along the radius, evenly spaced angles; exact for polynomials
        nodes, weights = legendre.leggauss(2 * count)
        radius, turn = (1 + nodes) / 2, 2 * np.pi * np.arange(4 * count) / (4 * count)
        x, y = np.outer(radius, np.cos(turn)).ravel(), np.outer(radius, np.sin(turn)).ravel()
        area = np.repeat(weights / 2 * radius * 2 * np.pi / (4 * count), 4 * count)
    at_x, at_y = (_interpolation(count, at) for at in (x, y))
    half = size_m / 2

    def of(x_order: int, y_order: int) -> Floats:
        scale: float = half ** -(x_order + y_order)
        return (at_x[x_order][:, :, None] * at_y[y_order][:, None, :]).reshape(len(x), -1) * scale

    def form(a: Floats, b: Floats) -> Floats:
        return (a.T * area) @ b * half**2

    bent_x, bent_y = of(2, 0), of(0, 2)
    across = form(bent_x, bent_y)
    energy = (
        form(bent_x, bent_x) + form(bent_y, bent_y) + poisson * (across + across.T) + 2 * (1 - poisson) * form(of(1, 1), of(1, 1))
    )
    return form(of(0, 0), of(0, 0)), energy


def _interpolation(count: int, at: Floats) -> list[Floats]:
    """Polynomials that are 1 at one of Gauss's nodes, at `at`, (point,): values, first and second derivatives, (point, node)."""
    nodes, weights = legendre.leggauss(count)
    to_series = (legendre.legvander(nodes, count - 1) * weights[:, None]).T * (np.arange(count) + 0.5)[:, None]
    return [
        legendre.legvander(at, count - 1 - order) @ (legendre.legder(to_series, order, axis=0) if order else to_series)
        for order in (0, 1, 2)
    ]


def _root(form: Floats) -> Floats:
    """Matrix R with R' R the positive form, without what is negligible of it: (rank, value)."""
    eigenvalues, vectors = np.linalg.eigh(form)
    kept = eigenvalues > NEGLIGIBLE * max(float(eigenvalues[-1]), 0.0)
    root: Floats = np.sqrt(eigenvalues[kept])[:, None] * vectors[:, kept].T
    return root
