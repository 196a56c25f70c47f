"""Stress by bending: in the faces of a plate, and in the ceramic of a patch that lies where the plate is bent.

A face at height z above the neutral axis has E z / (1 - nu^2) times (one curvature + nu times the other) (Timoshenko and
Woinowsky-Krieger, Theory of Plates and Shells, eq. 37 f.). A patch bends less than the plate round it, by the share that passes its
moment on to the plate (`parts`).

What both bear. Glass: 45 MPa, which 95 % of annealed panes bear (EN 572-1, ring on ring by EN 1288-2; at stresses that rise over
seconds: those of microseconds break less). PZT: 27.6 MPa, the peak that manufacturers rate soft ceramic for when it
vibrates (Morgan's TP-226, 4000 psi; cited from memory); polarity holds up to about half of the coercive field against it, which is
1.2 MV/m in PZT-5A (CTS 3195HD, below 1 Hz), 0.8 in PZT-5H.
"""

from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.board.plate.layers import laminate
from controller.device.board.plate.parts import Parts
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.physics.modes.modes import Modes

GLASS_PA: Final = 45e6
CERAMIC_PA: Final = 27.6e6
FIELD_V_M: Final = 0.6e6
DEGREE = 5  # of the splines through a map, which are differentiated
CELLS_A_WAVE = 12
NEAR = 0.3  # waves of the band's middle beside a focus


def focal_stress(board: Board, modes: Modes, amplitudes: Floats, points_m: Iterable[tuple[float, float]]) -> dict[str, float]:
    """Largest stress near foci of a plate whose modes have `amplitudes` (mode,) in m: `plate_mpa`, and where parts are known
    `ceramic_mpa` of a patch that lay there, and `field_mv_m` in it.
    """
    plate, parts, supply_v = board.plate, board.parts, board.driver.supply_v
    shortest_m = bending_wavelength_m(plate, float(modes.angular_frequency[-1]) / (2 * np.pi))
    beside_m = NEAR * bending_wavelength_m(plate, board.waveform.middle_hz)
    most_pa = most_per_m = 0.0
    for x_m, y_m in points_m:
        axes = []
        for at_m, side_m in ((x_m, plate.length_m), (y_m, plate.width_m)):
            low_m, high_m = max(at_m - beside_m, 0.0), min(at_m + beside_m, side_m)
            axes.append(np.linspace(low_m, high_m, max(int(CELLS_A_WAVE * (high_m - low_m) / shortest_m), 16)))
        xx, yy, xy = curvatures(modes, amplitudes, axes[0], axes[1])
        most_pa = max(most_pa, float(plate_stress_pa(plate, xx, yy, xy).max()))
        most_per_m = max(most_per_m, float(np.abs(xx + yy).max()) / 2)
    found = {"plate_mpa": most_pa * 1e-6}
    if parts is not None:
        found["ceramic_mpa"] = ceramic_stress_pa(parts, plate, most_per_m, supply_v) * 1e-6
        found["field_mv_m"] = field_v_m(parts, supply_v) * 1e-6
    return found


def curvatures(modes: Modes, amplitudes: Floats, x_m: Floats, y_m: Floats) -> tuple[Floats, Floats, Floats]:
    """Second derivatives along x, along y and along both, (ny, nx) each in 1/m, of the sum of shapes on an even grid.

    With `CELLS_A_WAVE` points in the shortest wave within 1e-4.
    """
    from scipy.interpolate import make_interp_spline  # noqa: PLC0415 - half a second of imports

    u = modes.on_grid(amplitudes, x_m, y_m)
    along_x = make_interp_spline(x_m, u, DEGREE, axis=1)
    xx: Floats = along_x(x_m, 2)
    yy: Floats = make_interp_spline(y_m, u, DEGREE, axis=0)(y_m, 2)
    xy: Floats = make_interp_spline(y_m, along_x(x_m, 1), DEGREE, axis=0)(y_m, 1)
    return xx, yy, xy


def plate_stress_pa(plate: Plate, xx: ArrayLike, yy: ArrayLike, xy: ArrayLike) -> Floats:
    """Largest principal stress in a face of the plate, or of one of its layers, by its curvatures in 1/m, of any shape."""
    mean, differing = (np.add(xx, yy)) / 2, np.hypot(np.subtract(xx, yy) / 2, xy)
    stress: Floats = np.zeros(np.shape(mean))
    for height_m, young_pa, poisson in _faces(plate):
        of_layer = young_pa * height_m / (1 - poisson**2) * ((1 + poisson) * np.abs(mean) + (1 - poisson) * differing)
        stress = np.maximum(stress, of_layer)
    return stress


def ceramic_stress_pa(parts: Parts, plate: Plate, curvature_per_m: float, supply_v: float) -> float:
    """Largest stress in a patch by the plate's curvature round it, alike along x and y, and by its supply."""
    disc, on = parts.data, parts.on(plate)
    of_strain = disc.ceramic_modulus_pa / (1 - disc.ceramic_poisson_ratio)
    own = disc.piezo_constant_m_per_v * field_v_m(parts, supply_v)
    return of_strain * (on.face_m * on.passed * abs(curvature_per_m) + own)


def field_v_m(parts: Parts, supply_v: float) -> float:
    """Field in the ceramic at the supply."""
    return supply_v / (parts.data.ceramic_thickness_mm * 1e-3)


def stress_warnings(plate_mpa: float, ceramic_mpa: float | None = None, field_mv_m: float | None = None) -> list[str]:
    """What bears more than it should, one line each; arguments as in the result of `focal_stress`."""
    found = []
    if plate_mpa > GLASS_PA * 1e-6:
        found.append(
            f"the plate bears {plate_mpa:.3g} MPa at a focus; of panes of annealed glass one in twenty breaks below"
            f" {GLASS_PA * 1e-6:g}: take a lower supply, other glass or less amplitude"
        )
    if ceramic_mpa is not None and ceramic_mpa > CERAMIC_PA * 1e-6:
        found.append(
            f"the ceramic of a patch bears {ceramic_mpa:.3g} MPa where a focus lies on it; makers rate vibrating PZT for"
            f" {CERAMIC_PA * 1e-6:g}: keep foci off the patches (scene.toml's regions), or take a lower supply"
        )
    if field_mv_m is not None and field_mv_m > FIELD_V_M * 1e-6:
        found.append(
            f"the field in the ceramic is {field_mv_m:.2g} MV/m, over {FIELD_V_M * 1e-6:g}: a patch that is wired the wrong way"
            " round loses its polarisation; mark the poles, or take a lower supply"
        )
    return found


def _faces(plate: Plate) -> list[tuple[float, float, float]]:
    """Distance from the neutral axis in m, Young's modulus in Pa and Poisson's ratio of the outer face of each layer."""
    if not plate.layers:
        return [(plate.thickness_m / 2, plate.young_modulus_pa, plate.poisson_ratio)]
    axis_m, bottom_m, found = laminate(plate.layers).axis_m, 0.0, []
    for layer in plate.layers:
        top_m = bottom_m + layer.thickness_mm * 1e-3
        found.append((max(abs(bottom_m - axis_m), abs(top_m - axis_m)), layer.young_modulus_pa, layer.poisson_ratio))
        bottom_m = top_m
    return found
