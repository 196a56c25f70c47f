"""Corners of clamped and free edges at large Poisson's ratios, where curvature has no bound, by an own Ritz solution.

Two modes whose frequencies nearly coincide may be any two mixtures of each other, so that shapes one by one may differ by a tenth;
what anything is computed from is the response, the sum over all modes.
"""

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh
from tables import each_row

from controller.workshop.physics.modes import ritz
from controller.workshop.physics.modes.ritz import PlateShape

LETTERS = {"S": "simply_supported", "C": "clamped", "F": "free"}
LENGTHS = (0.21, 0.148)
SPEED = 2 * np.pi * 70e3 / 743**2  # angular frequency over wavenumber squared, of the paper's plate


def product_modes(sides, poisson_ratio, highest_k):
    """k^4 (mode,) and shapes at points, by the product."""
    a, b, c, d = (LETTERS[side] for side in sides)
    classes = ritz.solve(PlateShape(LENGTHS, ((a, b), (c, d)), poisson_ratio), highest_k).classes

    def shapes(points):
        along = [(found.x.values(points[:, 0]), found.y.values(points[:, 1]), found.coefficients) for found in classes]
        return np.concatenate([np.einsum("pj,jmi,pi->pm", y, parts, x) for x, y, parts in along], axis=1)

    return np.concatenate([found.wavenumber4 for found in classes]), shapes


def one_axis(count, length, ends):
    """Legendre polynomials times what vanishes at the ends, orthonormal: values of a derivative at points, nodes, weights."""
    orders = ["FSC".index(end) for end in ends]
    factor = legendre.poly2leg(
        (np.polynomial.Polynomial([1, 1]) ** orders[0] * np.polynomial.Polynomial([1, -1]) ** orders[1]).coef
    )
    raw = [legendre.legmul(factor, row) for row in np.eye(count)]

    def values(at, derivative):
        of = [legendre.legval(2 * at / length - 1, legendre.legder(one, derivative) if derivative else one) for one in raw]
        return np.stack(of, axis=1) * (2 / length) ** derivative

    nodes, weights = legendre.leggauss(count + 8)
    at, weights = (nodes + 1) * length / 2, weights * length / 2
    turn = np.linalg.inv(np.linalg.qr(np.sqrt(weights)[:, None] * values(at, 0), mode="r"))
    return (lambda points, derivative=0: values(points, derivative) @ turn), at, weights


def own_modes(sides, poisson_ratio, highest_k, counts):
    """The same by the whole energy as one matrix over products of those."""
    axes = [one_axis(count, length, ends) for count, length, ends in zip(counts, LENGTHS, (sides[:2], sides[2:]), strict=True)]

    def gram(axis, first, second):
        values, at, weights = axes[axis]
        return (values(at, first) * weights[:, None]).T @ values(at, second)

    mixed = poisson_ratio * np.kron(gram(0, 0, 2), gram(1, 2, 0))
    energy = np.kron(gram(0, 2, 2), gram(1, 0, 0)) + np.kron(gram(0, 0, 0), gram(1, 2, 2)) + mixed + mixed.T
    energy += 2 * (1 - poisson_ratio) * np.kron(gram(0, 1, 1), gram(1, 1, 1))
    k4, vectors = eigh(energy, subset_by_value=(-np.inf, highest_k**4))

    def shapes(points):
        products = np.einsum("pi,pj->pij", axes[0][0](points[:, 0]), axes[1][0](points[:, 1])).reshape(len(points), -1)
        return products @ vectors * np.sqrt(LENGTHS[0] * LENGTHS[1])

    return k4, shapes


def responses(modes, highest_k):
    """From six places to thirty, at forty frequencies, of modes that decay in 1 ms."""
    (k4, shapes), random = modes, np.random.default_rng(0)
    to, out_of = (shapes(random.uniform(0.05, 0.95, (count, 2)) * LENGTHS) for count in (30, 6))
    at_k2 = np.linspace(0.4 * highest_k, highest_k, 40)[:, None] ** 2
    return np.einsum("pm,sm,fm->psf", to, out_of, 1 / (k4 - at_k2**2 + 2e3j * at_k2 / SPEED))


@each_row("sides", ["CFFF", "CCFF", "CFSF"])
def test_responses_of_a_plate_with_free_and_clamped_edges_are_those_of_other_functions(sides):
    for poisson_ratio, most in ((0.208, 3e-4), (0.49, 1e-3)):
        found, own, off = (
            product_modes(sides, poisson_ratio, 115.0),
            own_modes(sides, poisson_ratio, 115.0, (22, 20)),
            own_modes(sides, poisson_ratio - 0.002, 115.0, (22, 20)),
        )
        assert found[0].size == own[0].size
        frequency_error = float(np.abs(np.sqrt(np.sort(found[0]) / own[0]) - 1).max())
        expected = responses(own, 100.0)
        error, other = (float(np.linalg.norm(responses(one, 100.0) - expected) / np.linalg.norm(expected)) for one in (found, off))
        print(f"{sides}, {poisson_ratio}: {own[0].size} modes, frequencies {frequency_error:.1e}, responses {error:.1e}")
        assert frequency_error < 3e-4
        assert error < most < other, "0.4 % of Poisson's ratio at 0.49 would be seen"
