"""How many modes a plate has, before they are computed: Weyl's law with the term of the edges.

Below wavenumber k a plate has about A k^2 / (4 pi) + k / (4 pi) sum_i c_i L_i modes, sides of length L_i. What a side adds
follows from the phase d at which it reflects a bending wave: c = 4 times the mean of 1/4 + d / (2 pi) over the sine of the angle of
incidence. For a simply supported side d = -pi. For a free one d = 2 arctan t and for a clamped one 2 arctan t - 2 pi, where both
conditions at the edge give t (the waves that run along a free edge add less than 0.01).
"""

from functools import cache

import numpy as np

from controller.device.board.plate.plate import Support


@cache
def edge_term(end: Support, poisson_ratio: float) -> float:
    """What a side adds, c; "foam" is counted as free."""
    if end == "simply_supported":
        return -1.0
    nodes, weights = np.polynomial.legendre.leggauss(64)
    angle, weights = np.pi / 4 * (1 + nodes), np.pi / 4 * weights
    along = np.sin(angle)  # wavenumber along the edge, over k
    t = np.sqrt(1 + along**2) / np.cos(angle)
    if end != "clamped":
        t *= ((1 - (1 - poisson_ratio) * along**2) / (1 + (1 - poisson_ratio) * along**2)) ** 2
    return float(weights * np.cos(angle) @ (1 + 4 / np.pi * np.arctan(t))) - (4.0 if end == "clamped" else 0.0)


def mode_count(
    lengths_m: tuple[float, float], ends: tuple[tuple[Support, Support], tuple[Support, Support]], poisson_ratio: float, k: float
) -> float:
    """About how many modes there are below the wavenumber `k` in 1/m; rigid motions are counted.

    Lengths and ends are along x, then along y; each end at 0 first.
    """
    rim = sum(edge_term(end, poisson_ratio) * lengths_m[1 - axis] for axis in (0, 1) for end in ends[axis])
    return (lengths_m[0] * lengths_m[1] * k**2 + rim * k) / (4 * np.pi)
