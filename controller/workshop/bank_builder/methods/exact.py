"""Numbers rounded so that products and sums of them are exact: results do not depend on the order in which a machine adds.

A matrix product in float64 whose factors have few enough bits makes no rounding error, whichever linear algebra computes it and
however it blocks, so the same waveforms come out on every machine, and whichever others are computed in the same product.
"""

import numpy as np

from controller.arrays import Floats


def rounded(values: Floats, bits: int, axis: int | tuple[int, ...] | None = None) -> Floats:
    """Values rounded to a common unit, of which the largest has below 2^`bits`.

    Values along `axis` share a unit; all by default.
    """
    top = np.maximum(values.max(axis=axis, keepdims=True), -values.min(axis=axis, keepdims=True))
    unit = np.ldexp(1.0, np.frexp(top)[1] - bits)
    result: Floats = np.rint(values / unit)
    result *= unit
    return result
