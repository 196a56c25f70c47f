"""Waves in plates by three-dimensional elasticity, without any plate theory: what the theories are checked against."""

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq


def rayleigh_lamb_a0(plate, wavenumber):
    """Angular frequency of the lowest antisymmetric wave of a homogeneous plate: root of Rayleigh's and Lamb's equation."""
    shear = plate.young_modulus_pa / (2 * (1 + plate.poisson_ratio))
    transverse = np.sqrt(shear / plate.density_kg_m3)
    longitudinal = transverse * np.sqrt(2 * (1 - plate.poisson_ratio) / (1 - 2 * plate.poisson_ratio))
    half = plate.thickness_m / 2

    def equation(omega):
        alpha, beta = np.sqrt(wavenumber**2 - (omega / longitudinal) ** 2), np.sqrt(wavenumber**2 - (omega / transverse) ** 2)
        left = np.tanh(alpha * half) * (wavenumber**2 + beta**2) ** 2
        return left - np.tanh(beta * half) * 4 * wavenumber**2 * alpha * beta

    stiffness = plate.young_modulus_pa * plate.thickness_m**3 / (12 * (1 - plate.poisson_ratio**2))
    kirchhoff = np.sqrt(stiffness / (plate.density_kg_m3 * plate.thickness_m)) * wavenumber**2
    return brentq(equation, 0.3 * kirchhoff, min(1.02 * kirchhoff, 0.9999 * transverse * wavenumber), xtol=1e-9 * kirchhoff)


def layered_a0(layers, wavenumber, degree=6):
    """The same of layers: plane strain, polynomials through the thickness of each layer, continuous displacement (u, w)."""
    nodes, weights = np.polynomial.legendre.leggauss(degree + 2)
    places = -np.cos(np.pi * np.arange(degree + 1) / degree)
    values = np.linalg.solve(np.vander(places).T, np.vander(nodes, degree + 1).T).T  # Lagrange's polynomials at the nodes
    powers = np.arange(degree, 0, -1)
    slopes_of = np.hstack([np.vander(nodes, degree) * powers, np.zeros((len(nodes), 1))])
    slopes = np.linalg.solve(np.vander(places).T, slopes_of.T).T
    count = degree * len(layers) + 1
    stiffness, mass = np.zeros((2 * count, 2 * count)), np.zeros((2 * count, 2 * count))
    for index, layer in enumerate(layers):
        thickness = layer.thickness_mm * 1e-3
        shear = layer.young_modulus_pa / (2 * (1 + layer.poisson_ratio))
        lame = 2 * shear * layer.poisson_ratio / (1 - 2 * layer.poisson_ratio)
        here, w = slice(degree * index, degree * (index + 1) + 1), weights * thickness / 2
        own = np.arange(count)[here]
        u, v = own, count + own
        s = slopes * 2 / thickness
        zero = np.zeros_like(values)
        # strains of (i u, w) exp(i k x): -k u, w', i (u' + k w)
        along, across, sheared = np.hstack([-wavenumber * values, zero]), np.hstack([zero, s]), np.hstack([s, wavenumber * values])
        energy = (along.T * w) @ along + (across.T * w) @ across
        both = (along.T * w) @ across
        energy = (lame + 2 * shear) * energy + lame * (both + both.T) + shear * (sheared.T * w) @ sheared
        inertia = layer.density_kg_m3 * (values.T * w) @ values
        of = np.concatenate([u, v])
        stiffness[np.ix_(of, of)] += energy
        mass[np.ix_(u, u)] += inertia
        mass[np.ix_(v, v)] += inertia
    return np.sqrt(eigh(stiffness, mass, eigvals_only=True, subset_by_index=[0, 0])[0])
