"""Where the paper's equations, or its print of them, do not hold for a design: one line each."""

from collections.abc import Iterator
from typing import Any

from controller.device.board.panel import CHANNELS
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.plate import FEWEST_MODES, FEWEST_WAVES, LONGEST_DECAYS, THICKEST
from controller.workshop.physics.design.design import energy_j
from controller.workshop.physics.stress import stress_warnings

Figures = dict[str, Any]

PAPERS = {  # section IV-A: what its equations (5) and (6) depend on
    "thickness_mm": 0.5,
    "young_modulus_pa": 72.9e9,
    "poisson_ratio": 0.208,
    "density_kg_m3": 2510.0,
    "band_high_hz": 70e3,
}
COUPLED = 1.0  # modal overlap below which single modes ring


def design_warnings(figures: Figures, plate: Plate) -> list[str]:
    """Warnings of the figures of `design_figures` of a plate, each a line that says what to read instead."""
    found = [*_warnings(figures, figures["inputs"]), *stress_warnings(**figures["stress"])]
    if all(not _differ(figures["inputs"][name], value, 1e-3) for name, value in PAPERS.items()):
        found += _slips(figures, plate)
    return found


def _warnings(found: Figures, given: Figures) -> Iterator[str]:
    waves = found["in_wavelengths"]
    if given["channels"] > CHANNELS:
        yield f"channels = {given['channels']}: the FPGA of this controller drives {CHANNELS}; more need other gateware"
    if _differ(found["one_bit_share"], found["linear_share"], 0.01):
        yield (
            f"amplitude: 1-bit drive reaches 1 - exp(-T/tau) = {found['one_bit_share']:.3f} of an endless emission's;"
            f" the paper's 1 - exp(-2T/tau) = {found['linear_share']:.3f} is of linear time reversal"
        )
    if found["mindlin_shift"] < -0.005:
        yield (
            f"eq. (5) is Kirchhoff's: shear and inertia make the shortest wave {found['mindlin_wavelength_mm']['high']:.3g} mm and"
            f" lower its frequency by {-100 * found['mindlin_shift']:.2g} %; an error of 0.5 % costs a bank 40 %"
        )
    if waves["thickness_of_shortest"] > THICKEST:
        yield (
            f"the plate is {waves['thickness_of_shortest']:.2g} of its shortest wave thick: not even Mindlin's theory holds"
            f" above {THICKEST:g}; take a lower band"
        )
    if _differ(found["energy_uj"], found["energy_with_background_uj"], 0.1):
        yield (
            f"eq. (6) takes all modes from 0 Hz alike, at rest at T: {_uj(found['energy_uj'])}; modes of the band hold"
            f" {_uj(found['energy_of_band_uj'])} in the spot, {_uj(found['energy_with_background_uj'])} with what surrounds it"
        )
    if _differ(found["finger_left"], found["finger_left_of_band"], 0.05):
        yield (
            f"eq. (7) leaves {found['finger_left']:.2f} of a gate, which has a part at 0 Hz; of the band's pulse a mass"
            f" of {given['finger_mg']:g} mg leaves {found['finger_left_of_band']:.2f}"
        )
    if waves["patch_of_shortest"] > 0.5:
        yield (
            f"patches of {given['size_mm']:g} mm are {waves['patch_of_shortest']:.2g} of the shortest wave, over a half: they drive"
            " the upper edge of the band weakly (section IV-A)"
        )
    if found["modes_in_band"] < FEWEST_MODES:
        yield f"only {found['modes_in_band']:.3g} modes in the band: equations of averages over modes, (1) above all, do not hold"
    elif found["modal_overlap"] < COUPLED:
        yield (
            f"modes overlap {found['modal_overlap']:.2g} times: single modes ring, and the contrast differs from place to place"
            " more than eq. (1) says"
        )
    if min(waves["length"], waves["width"]) < FEWEST_WAVES:
        yield f"the plate is only {min(waves['length'], waves['width']):.2g} wavelengths wide: there is no place outside a focus"
    counted = found["modes_counted"]
    if counted and _differ(counted, found["modes_in_band"], 0.1):
        yield f"edges count: {counted} modes are in the band, not Tc B = {found['modes_in_band']:.3g}"
    if given["duration_ms"] > LONGEST_DECAYS * given["decay_time_ms"]:
        yield (
            f"T is {given['duration_ms'] / given['decay_time_ms']:.3g} tau: what is emitted more than {LONGEST_DECAYS:g} tau before"
            " T is lost"
        )


def _slips(found: Figures, plate: Plate) -> Iterator[str]:
    """What the paper prints otherwise than its own equations, for its own plate."""
    own = energy_j(plate, 7.68e-6, 5.2e-3) * 1e6
    yield f"the paper rounds the shortest wave to 10 mm; eq. (5) gives {found['wavelength_mm']['high']:.2f} mm"
    yield f"the paper prints 59 µJ for eq. (6); its 7.68 µm and 5.2 mm give {own:.0f} µJ"
    yield f"the paper's fig. 8 says that energy decays with 2 tau; it is tau / 2, {found['energy_decay_ms']:g} ms"


def _differ(one: float, other: float, share: float) -> bool:
    return abs(one - other) > share * abs(other)


def _uj(value: float) -> str:
    return f"{value:.3g} µJ"
