"""Energy of the plate from maps of displacement and velocity, by integration in space as the paper does (appendix B, eq. (8)).

It takes no mode's frequency or mass, so it checks the sum over modes. Bending energy is Kirchhoff's, of the bare plate: with
another theory, with layers or with patches, modes hold some percent more or less.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from controller.device.board.panel import Plate
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.workshop.physics.field import Field, map_axis
from controller.workshop.physics.responses.modal_history import Energy

Floats = NDArray[np.float64]

DEGREE = 5  # of the splines through the map, which are differentiated
CELLS_A_WAVE = 12


def mapped_energy(plate: Plate, field: Field, shortest_m: float) -> Energy:
    """Kinetic and bending energy at T, (1,) arrays in J.

    A map has `CELLS_A_WAVE` points in the shortest wave there is (`shortest_m`), within 1e-4 of the whole energy.
    """
    step_m = min(shortest_m / CELLS_A_WAVE, plate.length_m / 16, plate.width_m / 16)
    x_m, y_m = map_axis(plate.length_m, step_m), map_axis(plate.width_m, step_m)
    cell_m2 = (x_m[1] - x_m[0]) * (y_m[1] - y_m[0])
    u = field.modes.on_grid(field.modal, x_m, y_m)
    velocity = field.modes.on_grid(field.modal_velocity, x_m, y_m)
    along_x = make_interp_spline(x_m, u, DEGREE, axis=1)
    xx = along_x(x_m, 2)
    yy = make_interp_spline(y_m, u, DEGREE, axis=0)(y_m, 2)
    xy = make_interp_spline(y_m, along_x(x_m, 1), DEGREE, axis=0)(y_m, 1)
    bent = xx**2 + yy**2 + 2 * plate.poisson_ratio * xx * yy + 2 * (1 - plate.poisson_ratio) * xy**2
    kinetic_j = plate.density_kg_m3 * plate.thickness_m / 2 * float((velocity**2).sum()) * cell_m2
    potential_j = bending_stiffness(plate) / 2 * float(bent.sum()) * cell_m2
    return Energy(np.array([kinetic_j]), np.array([potential_j]))
