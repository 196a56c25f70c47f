"""Levy's exact solution: wavenumbers of a plate that is simply supported at y = 0 and y = b, and anything at x = 0 and x = a.

The deflection is sin(n pi y / b) X(x) with X'''' - 2 s^2 X'' + (s^4 - k^4) X = 0, s = n pi / b: four exponentials, whose conditions
at both ends have a solution where a determinant of fourth order vanishes. Nothing is shared with the Ritz method but the conditions
themselves: w = 0, w' = 0, M = w'' - nu s^2 w = 0, V = w''' - (2 - nu) s^2 w' = 0.
"""

import numpy as np

CONDITIONS = {"simply_supported": "wM", "clamped": "wd", "free": "MV"}
PER_HALF_WAVE = 24


def levy_wavenumbers(length_m, width_m, ends, poisson_ratio, highest_k):
    """All wavenumbers up to `highest_k` in 1/m, lowest first; rigid motions are left out."""
    found = []
    for n in range(1, int(1.01 * highest_k * width_m / np.pi) + 2):
        s = n * np.pi / width_m
        free = "free" in ends  # waves along a free edge are slower than bending waves, by less than a percent
        most = highest_k**2 - s**2
        least = -0.05 * s**2 if free else 0.0
        if most <= least:
            continue
        turns = np.arange(0.013, np.sqrt(max(most, 0.0)) * length_m / np.pi, 1 / PER_HALF_WAVE)
        mu = np.concatenate([np.linspace(least, 0, 600)[:-1] if free else [], (turns * np.pi / length_m) ** 2, [most]])
        mu = mu[mu <= most]
        signs = np.sign(_determinant(mu, s, length_m, ends, poisson_ratio))
        at = np.flatnonzero(signs[1:] * signs[:-1] < 0)
        low, high, sign = mu[at], mu[at + 1], signs[at]
        for _ in range(55):
            middle = (low + high) / 2
            same = np.sign(_determinant(middle, s, length_m, ends, poisson_ratio)) == sign
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        found.append(np.sqrt(s**2 + (low + high) / 2))
    return np.sort(np.concatenate(found)) if found else np.empty(0)


def _determinant(mu, s, length_m, ends, nu):
    """Of the conditions, for k^2 = s^2 + mu: (point,)."""
    q2 = np.asarray(mu, dtype=np.complex128)
    q = np.sqrt(q2)
    gamma = np.sqrt(2 * s**2 + q2.real)
    rows = []
    for x, end in zip((0.0, length_m), ends, strict=True):
        cos = np.cos(q * x).real
        sin = np.where(abs(q) * length_m > 1e-9, np.sin(q * x) / np.where(q == 0, 1, q), x).real  # of x where q vanishes
        near, far = np.exp(-gamma * x), np.exp(-gamma * (length_m - x))
        m = q2.real
        # value and three derivatives of each of the four functions, in units of gamma
        w = [cos, sin * gamma, near, far]
        d = [-m * sin / gamma, cos, -near, far]
        dd = [-m * cos / gamma**2, -m * sin / gamma, near, far]
        ddd = [m**2 * sin / gamma**3, -m * cos / gamma**2, -near, far]
        r = (s / gamma) ** 2
        for condition in CONDITIONS[end]:
            rows.append(
                {
                    "w": w,
                    "d": d,
                    "M": [b - nu * r * a for a, b in zip(w, dd, strict=True)],
                    "V": [b - (2 - nu) * r * a for a, b in zip(d, ddd, strict=True)],
                }[condition]
            )
    return np.linalg.det(np.transpose(np.array(rows), (2, 0, 1)))
