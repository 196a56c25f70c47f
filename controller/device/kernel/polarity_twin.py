"""Polarities of several points that are composed together, and their weights at full amplitude; a part of `words_twin`.

Polarities are found from a sketch of the responses, a sample of each 6 us, and so are the first weights. That is often enough for
waves of up to 83 kHz: polarities of less than 1 % more energy than others are still found.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[Any]
Signs = NDArray[np.int8]

POINT_WEIGHT_SUM: Final = 32767  # of the points
SKETCH_SHIFT: Final = 4  # bits that responses lose there, so that 256 products add up to less than 2^31
LARGEST_SKETCHED: Final = (1 << 11) - 1  # for the same reason, of a compact bank's responses, which are too faint to lose bits
PRODUCT_BITS: Final = 30  # of the largest inner product of two responses
MAX_CORRECTION: Final = 2.0  # of a weight in a round
ONE_PLACE: Final = 0.5  # correlation of responses: 2.8 mm on the simulated board
RATIO_SLOPE: Final = 100.0  # by which ratio amplitudes may differ, for each correlation below: any at 0.41, 3.1 mm


class Sketch:
    """One of each `step` samples of the points' responses, and their inner products."""

    def __init__(self, in_band: Numbers, step: int, *, faint: bool) -> None:
        count, some = len(in_band), in_band[:, ::step]
        rows = np.clip(some, -LARGEST_SKETCHED, LARGEST_SKETCHED) if faint else some >> SKETCH_SHIFT
        self._rows = rows.reshape(count, -1)
        self._gram: Numbers = np.array([[(one * other).sum() for other in self._rows] for one in self._rows])

    def polarised(self, asked: list[float], norms: list[float], polarities: Signs) -> tuple[list[float], list[float]]:
        """What can be asked for, and the norms, with the signs of the points.

        `polarities` are given, or 0 and then filled: with those for which the energy of the sum is largest.
        """
        count, products = len(norms), []
        for i in range(count):
            for j in range(i):
                products.append((i, j, float(self._gram[i, j]) / norms[i] / norms[j]))
        largest = max(abs(product) for _, _, product in products)
        if not polarities[0]:
            polarities[:count] = _signs(count, products, (1 << PRODUCT_BITS) / largest) if largest else [1] * count
        signs = [int(sign) for sign in polarities[:count]]
        if largest and min(asked) != max(asked):
            asked = _reconciled(asked, signs, self._correlations())
        return asked, [norm * sign for norm, sign in zip(norms, signs, strict=True)]

    def balanced(self, norms: list[float]) -> list[float]:
        """Weights with which all points get about the same share of their maximum; 0 where there is nothing to be had."""
        weights = [1.0 if math.isfinite(norm) else 0.0 for norm in norms]
        bits = sum(weight * row for weight, row in zip(whole_weights(weights, norms)[0], self._rows, strict=True)) > 0
        shares = [int(np.sum(row, where=bits)) / norm for row, norm in zip(self._rows, norms, strict=True)]
        return corrected(weights, shares, norms)

    def _correlations(self) -> list[tuple[int, int, float]]:
        """Of the responses of each two points."""
        found, sizes = [], [float(size) for size in self._gram.diagonal()]
        for i in range(len(sizes)):
            for j in range(i):
                if sizes[i] > 0 and sizes[j] > 0:
                    found.append((i, j, float(self._gram[i, j]) / math.sqrt(sizes[i] * sizes[j])))
        return found


def corrected(weights: list[float], shares: list[float], norms: list[float]) -> list[float]:
    """Weights divided by what the points got with them."""
    mean = product(shares, [1.0] * len(shares)) / (sum(map(math.isfinite, norms)) or 1)
    found = []
    for weight, share in zip(weights, shares, strict=True):
        correction = mean / share if share > 0 else MAX_CORRECTION
        found.append(weight * min(max(correction, 1 / MAX_CORRECTION), MAX_CORRECTION))
    return found


def _signs(count: int, products: list[tuple[int, int, float]], unit: float) -> list[int]:
    """Polarities for which the energy of the sum is largest, by the inner products of the responses."""
    gram = np.zeros((count, count), np.int64)
    for i, j, product in products:
        gram[i, j] = gram[j, i] = round(product * unit)
    choices = np.arange(1 << (count - 1))  # the first point is positive
    signs = 1 - 2 * (choices[:, None] << 1 >> np.arange(count) & 1)
    best = int(np.argmax(((signs @ gram) * signs).sum(axis=1)))
    turned = 1 if 2 * best.bit_count() > count else 0
    return [1 - 2 * (best << 1 >> i & 1 ^ turned) for i in range(count)]


def _reconciled(asked: list[float], signs: list[int], alike: list[tuple[int, int, float]]) -> list[float]:
    """Amplitudes that points can have beside each other: those that move together get the least that one of them asks for."""
    asked = list(asked)
    for _ in range(len(asked)):
        before = list(asked)
        for i, j, correlation in alike:
            together = correlation * signs[i] * signs[j]
            if together > 0:
                room = 1 + (ONE_PLACE - together) * RATIO_SLOPE if together < ONE_PLACE else 1.0
                asked[i] = min(asked[i], asked[j] * room)
                asked[j] = min(asked[j], asked[i] * room)
        if asked == before:
            break
    return asked


def whole_weights(weights: list[float], divisors: list[float]) -> tuple[list[int], float]:
    """Whole numbers next to the weights over the divisors, times the unit that is returned with them."""
    shares, total = [], 0.0
    for weight, divisor in zip(weights, divisors, strict=True):
        shares.append(weight / divisor)
        total += abs(weight / divisor)
    unit = POINT_WEIGHT_SUM / total if 0 < total < math.inf else 0.0
    return [round(share * unit) if unit else 0 for share in shares], unit


def product(left: list[float], right: list[float]) -> float:
    """Inner product, term by term: `sum` of floats is compensated from Python 3.12 on."""
    total = 0.0
    for one, other in zip(left, right, strict=True):
        total += one * other
    return total
