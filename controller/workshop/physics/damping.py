"""Damping: the rate of decay of each mode, as the sum of what takes energy from it.

- `plate.decay_time_ms`, or in its place `plate.damping.decay_times` over frequency: 1 / tau;
- `plate.damping.loss_factor` eta: eta w / 2;
- `plate.foam.dashpot_pa_s_m` z: z W / (2 m), with the mass per area m and the share W of a mode's mean square that lies on foam.

The last is first order: on the paper's plate right to 5 % in the median; modes that overlap exchange energy on the foam, which
spreads their rates more widely.
"""

import numpy as np

from controller.arrays import Floats, blocks
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.retuned import retuned
from controller.workshop.physics.modes.ritz_modes import RitzModes

Rectangle = tuple[float, float, float, float]  # x from, to, y from, to, in m

SPARE_NODES = 12  # of Gauss, beyond half the phase of what is integrated: error below 1e-9
VALUES_AT_ONCE = 4_000_000  # of shapes, 32 MB


def damped(modes: Modes, plate: Plate) -> Modes:
    """`modes` with the rates of decay that `plate` gives them."""
    rate = decay_rates(modes, plate)
    return modes if np.array_equal(rate, modes.decay_rate) else retuned(modes, decay_rate=rate)


def decay_rates(modes: Modes, plate: Plate) -> Floats:
    """Rate of decay of each mode in 1/s: (mode,)."""
    omega = modes.angular_frequency
    rate = np.full(modes.count, 1 / plate.decay_time_s)
    if plate.damping is not None:
        if plate.damping.decay_times:
            known = np.log([(at.frequency_hz, at.decay_time_ms * 1e-3) for at in plate.damping.decay_times])
            with np.errstate(divide="ignore"):  # a rigid motion has the first of them
                rate = np.exp(-np.interp(np.log(omega / (2 * np.pi)), known[:, 0], known[:, 1]))
        rate = rate + plate.damping.loss_factor * omega / 2
    strips = foam_strips(plate)
    if strips and plate.foam is not None and plate.foam.dashpot_pa_s_m:
        per_area = plate.density_kg_m3 * plate.thickness_m
        share = modes.foam_share if isinstance(modes, RitzModes) else strip_share(modes, strips, _shortest_m(modes, plate))
        rate = rate + plate.foam.dashpot_pa_s_m / (2 * per_area) * share
    return rate


def foam_strips(plate: Plate) -> list[Rectangle]:
    """The area on foam as rectangles that do not overlap: the whole strips along y, and those along x between them."""
    if plate.foam is None:
        return []
    sides, wide_m = plate.sides, plate.foam.width_mm * 1e-3
    from_m = wide_m if sides.x0 == "foam" else 0.0
    to_m = plate.length_m - (wide_m if sides.x1 == "foam" else 0.0)
    found = [
        ("x0", (0.0, from_m, 0.0, plate.width_m)),
        ("x1", (to_m, plate.length_m, 0.0, plate.width_m)),
        ("y0", (from_m, to_m, 0.0, wide_m)),
        ("y1", (from_m, to_m, plate.width_m - wide_m, plate.width_m)),
    ]
    return [rectangle for side, rectangle in found if getattr(sides, side) == "foam"]


def strip_share(modes: Modes, strips: list[Rectangle], shortest_m: float) -> Floats:
    """Share of each mode's mean square that lies in rectangles: (mode,), 1 for the whole plate.

    Strips are x from, x to, y from, y to in m, without overlap; Gauss's nodes follow `shortest_m`, the wavelength of the highest
    mode.
    """
    total = np.zeros(modes.count)
    for x_from, x_to, y_from, y_to in strips:
        x, x_weights = gauss(x_from, x_to, shortest_m)
        y, y_weights = gauss(y_from, y_to, shortest_m)
        factors = modes.factors
        if factors is not None:
            along_x = (x_weights @ factors.along_x(x) ** 2)[factors.x_index]
            total += along_x * (y_weights @ factors.along_y(y) ** 2)[factors.y_index]
            continue
        points = np.column_stack([np.repeat(x, len(y)), np.tile(y, len(x))])
        weights = np.outer(x_weights, y_weights).ravel()
        for some in blocks(len(points), max(VALUES_AT_ONCE // modes.count, 1)):
            total += weights[some] @ modes.shapes(points[some]) ** 2
    return total / (modes.mean_square * modes.length_m * modes.width_m)


def gauss(from_m: float, to_m: float, shortest_m: float) -> tuple[Floats, Floats]:
    """Places and weights of a quadrature over an interval, for products of two waves not shorter than `shortest_m`."""
    count = int(np.ceil(np.pi * (to_m - from_m) / shortest_m)) + SPARE_NODES
    nodes, weights = np.polynomial.legendre.leggauss(count)
    half = (to_m - from_m) / 2
    return from_m + half * (1 + nodes), half * weights


def _shortest_m(modes: Modes, plate: Plate) -> float:
    return bending_wavelength_m(plate, float(modes.angular_frequency.max()) / (2 * np.pi))
