"""Functions of one coordinate, of whose products the shapes of a plate's modes are made (Ritz).

They are orthonormal over the plate's extent and keep the essential conditions of its two ends exactly: at a simply supported end
they vanish, at a clamped one their slope does too. What a free or an elastic end demands follows from the energy by itself.

Legendre polynomials converge exponentially, but not where stiff foam begins, and need the more functions the smaller the error;
splines of degree 9 need fewer for an error of 1e-4, which counts where a pair of opposite edges is not alike, so that the modes
do not fall into four classes.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol, Self

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, NDArray

from controller.arrays import Floats
from controller.device.board.plate.plate import Support

Parity = Literal["even", "odd"]

SPLINE_DEGREE = 9


class Functions(Protocol):
    """Functions on [0, length] before conditions and orthonormalisation."""

    @property
    def length_m(self) -> float:
        """Their extent."""

    @property
    def count(self) -> int:
        """Their number."""

    def values(self, coefficients: Floats, x_m: Floats, derivative: int) -> Floats:
        """Sums with `coefficients`, (raw function, sum), or a derivative, or with -1 their integral from 0: (point, sum)."""

    def nodes(self, from_m: float, to_m: float) -> tuple[Floats, Floats]:
        """Places and weights of a quadrature that is exact for products of two functions between two places."""

    def of_parity(self, parity: Parity) -> Floats:
        """Sums that are even or odd about the middle: (raw function, sum)."""


@dataclass(frozen=True)
class LegendrePolynomials:
    """Legendre polynomials of degrees 0 to count - 1."""

    length_m: float
    count: int

    def values(self, coefficients: Floats, x_m: Floats, derivative: int) -> Floats:
        """As in `Functions`."""
        summed: NDArray[Any] = coefficients
        if derivative > 0:
            summed = legendre.legder(coefficients, derivative, scl=2 / self.length_m, axis=0)
        elif derivative < 0:
            summed = legendre.legint(coefficients, 1, lbnd=-1, scl=self.length_m / 2, axis=0)
        found: Floats = legendre.legvander(2 * x_m / self.length_m - 1, len(summed) - 1) @ summed
        return found

    def nodes(self, from_m: float, to_m: float) -> tuple[Floats, Floats]:
        """As in `Functions`."""
        return _gauss(np.array([from_m, to_m]), self.count)

    def of_parity(self, parity: Parity) -> Floats:
        """As in `Functions`."""
        return np.eye(self.count)[:, 0 if parity == "even" else 1 :: 2]


@dataclass(frozen=True, eq=False)
class Splines:
    """B-splines of degree 9 on intervals between `breaks_m`, (break,), from 0 to the length.

    At `creases_m`, which are breaks, the fourth derivative may jump: where a stiff foundation begins.
    """

    breaks_m: Floats
    creases_m: tuple[float, ...] = ()

    @property
    def length_m(self) -> float:
        """As in `Functions`."""
        return float(self.breaks_m[-1])

    @property
    def count(self) -> int:
        """As in `Functions`."""
        return len(self._knots) - SPLINE_DEGREE - 1

    @property
    def _knots(self) -> Floats:
        more = np.repeat(self.creases_m, SPLINE_DEGREE - 4)
        return np.sort(np.concatenate([np.pad(self.breaks_m, SPLINE_DEGREE, mode="edge"), more]))

    def values(self, coefficients: Floats, x_m: Floats, derivative: int) -> Floats:
        """As in `Functions`."""
        from scipy.interpolate import BSpline

        splines = BSpline(self._knots, coefficients, SPLINE_DEGREE)
        return (splines.antiderivative() if derivative < 0 else splines)(x_m, max(derivative, 0))

    def nodes(self, from_m: float, to_m: float) -> tuple[Floats, Floats]:
        """As in `Functions`."""
        inner = self.breaks_m[(self.breaks_m > from_m) & (self.breaks_m < to_m)]
        return _gauss(np.concatenate([[from_m], inner, [to_m]]), SPLINE_DEGREE + 1)

    def of_parity(self, parity: Parity) -> Floats:
        """As in `Functions`: the breaks are symmetric."""
        each = np.eye(self.count)
        return (each + each[::-1] if parity == "even" else each - each[::-1])[:, : (self.count + (parity == "even")) // 2]


def spline_breaks(fixed_m: Sequence[float], elements: int) -> Floats:
    """Breaks at `fixed_m`, from 0 to the length, and between them, `elements` or a few more nearly equal intervals in all."""
    counts = np.ceil(np.diff(fixed_m) / fixed_m[-1] * elements).astype(int).tolist()
    parts = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(fixed_m[:-1], fixed_m[1:], counts, strict=True)]
    return np.concatenate([*parts, [fixed_m[-1]]])


@dataclass(frozen=True, eq=False)
class OneDimensionalBasis:
    """Orthonormal functions over [0, length] that keep the essential conditions at both ends."""

    functions: Functions
    coefficients: Floats  # (raw function, function): what each is the sum of

    @classmethod
    def of(cls, functions: Functions, ends: tuple[Support, Support], parity: Parity | None = None) -> Self:
        """Functions for an axis with these `ends`; with a parity only those, of ends that are alike."""
        chosen = np.eye(functions.count) if parity is None else functions.of_parity(parity)
        length = functions.length_m
        x, weights = functions.nodes(0.0, length)
        factor = _triangular(np.sqrt(weights)[:, None] * functions.values(chosen, x, 0))
        orthonormal: Floats = np.linalg.solve(factor.T, chosen.T).T.astype(np.float64, copy=False)
        conditions = [
            functions.values(orthonormal, np.array([place]), derivative)[0] * length**derivative
            for place, end in ((0.0, ends[0]), (length, ends[1]))[: 1 if parity else 2]
            for derivative in range({"simply_supported": 1, "clamped": 2}.get(end, 0))
        ]
        if conditions:
            complete, _ = np.linalg.qr(np.transpose(conditions), mode="complete")
            orthonormal = orthonormal @ complete[:, len(conditions) :]
        return cls(functions, orthonormal)

    @property
    def count(self) -> int:
        """Number of functions."""
        return int(self.coefficients.shape[1])

    def values(self, x_m: ArrayLike, derivative: int = 0) -> Floats:
        """Values at `x_m`, (point,), or a derivative, or with -1 the integral from 0: (point, function), m^(-1/2 - derivative)."""
        return self.functions.values(self.coefficients, np.asarray(x_m, np.float64), derivative)

    def gram(self, first: int, second: int, from_m: float = 0.0, to_m: float | None = None) -> Floats:
        """Integrals of products of two derivatives, over all or between two places: (function, function)."""
        x, weights = self.functions.nodes(from_m, self.functions.length_m if to_m is None else to_m)
        return (self.values(x, first) * weights[:, None]).T @ self.values(x, second)

    def factor(self, derivative: int) -> Floats:
        """Triangular factor of `gram(derivative, derivative)`, which is its transpose times it: (function, function)."""
        x, weights = self.functions.nodes(0.0, self.functions.length_m)
        return _triangular(np.sqrt(weights)[:, None] * self.values(x, derivative))


def _triangular(matrix: Floats) -> Floats:
    factor: Floats = np.linalg.qr(matrix, mode="r")  # type: ignore[assignment]
    return factor


def _gauss(breaks_m: Floats, count: int) -> tuple[Floats, Floats]:
    """Gauss-Legendre nodes and weights, `count` between each two breaks."""
    from scipy.special import roots_legendre

    nodes, weights = roots_legendre(count)
    half = np.diff(breaks_m)[:, None] / 2
    return (breaks_m[:-1, None] + half * (1 + nodes)).ravel(), (half * weights).ravel()
