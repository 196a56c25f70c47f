"""`haptic-panel design`: what a panel of given numbers will be, by the paper's equations, and where these do not hold.

Amplitude, spot, pulse and both contrasts that can be measured are estimates by the statistics of the modes (`focal_spectrum`).
"""

import math
from collections.abc import Callable, Mapping
from typing import Any

import msgspec
import numpy as np

from controller.device.board.board import Board
from controller.device.board.plate.parts import Parts
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import kirchhoff_wavelength_m, mindlin_shift, mindlin_wavelength_m
from controller.errors import ConfigError
from controller.workshop.physics.design import design
from controller.workshop.physics.design.design_inputs import inputs_of
from controller.workshop.physics.design.design_warnings import design_warnings
from controller.workshop.physics.design.panel_estimate import PanelEstimate, gains_percent
from controller.workshop.physics.felt import felt_in_words
from controller.workshop.physics.field import OUTSIDE_M
from controller.workshop.physics.focal_spectrum import FocalSpectrum
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.plate import WAVELENGTH_M

Figures = dict[str, Any]


def design_figures(board: Board, changes: Mapping[str, float] | None = None, parts: Parts | None = None) -> Figures:
    """Figures of a design, ready for JSON: its numbers under `inputs`, warnings, one line each, under `warnings`.

    `changes` are values of `NUMBERS`, `parts` others than the board's; the board gives all others, and the effect of its damping,
    foam with a dashpot or layers, if it has them, on the band as a whole. Raises ConfigError if a number is not possible.
    """
    changes = {**_decay_of(board), **(changes or {})}
    estimate = PanelEstimate(board, inputs_of(board, changes, parts), parts)
    figures: Figures = {
        "inputs": msgspec.to_builtins(estimate.given),
        **_felt(estimate),
        "gains_percent": gains_percent(board, changes, parts, estimate),
        **_modes(board, estimate),
        **_waves(estimate),
        **_amplitude_and_energy(estimate),
        "stress": estimate.stress,
        "sound": estimate.sound,
        **_stages(estimate),
        **_learning(estimate),
    }
    return {**figures, "warnings": design_warnings(figures, estimate.plate)}


def _felt(panel: PanelEstimate) -> Figures:
    return {
        "felt_um": panel.felt_um,
        "felt": felt_in_words(panel.felt_um),
        "possible_amplitude_um": panel.possible_m * 1e6,
        "amplitude_um": panel.amplitude_m * 1e6,
        "finger_left": design.gate_attenuation(panel.plate, panel.given.finger_mg * 1e-6, _resolution_m(panel)),
        "finger_left_of_band": panel.left,
    }


def _modes(board: Board, panel: PanelEstimate) -> Figures:
    given, spectrum, tc_s = panel.given, panel.spectrum, design.characteristic_time_s(panel.plate)
    width_hz, decay_s, duration_s = given.band_high_hz - given.band_low_hz, given.decay_time_ms * 1e-3, given.duration_ms * 1e-3
    contrast = design.contrast(width_hz, tc_s, given.channels, duration_s, decay_s)
    background, outside_m = _background(panel), OUTSIDE_M * _wavelengths_m(panel, kirchhoff_wavelength_m)[1] / WAVELENGTH_M
    repeated = design.repetition_factor(given.period_ms * 1e-3, decay_s)
    return {
        "tc_ms": tc_s * 1e3,
        "modes_in_band": tc_s * width_hz,
        "modes_counted": _counted(board, panel.plate, given.band_low_hz, given.band_high_hz),
        "modal_overlap": tc_s / (math.pi * decay_s),
        "contrast": contrast,
        "contrast_bound": design.contrast_bound(width_hz, tc_s),
        "contrast_all": math.sqrt(spectrum.bandwidth_hz * tc_s / (1 + background)),
        "contrast_outside": _outside(spectrum, tc_s, background, outside_m),
        "outside_mm": outside_m * 1e3,
        "contrast_repeated": contrast * repeated,
        "repetition_factor": repeated,
    }


def _waves(panel: PanelEstimate) -> Figures:
    kirchhoff_m, mindlin_m = (_wavelengths_m(panel, theory) for theory in (kirchhoff_wavelength_m, mindlin_wavelength_m))
    plate, spectrum, spot_m = panel.plate, panel.spectrum, panel.spectrum.width_m()
    return {
        "wavelength_mm": {"low": kirchhoff_m[0] * 1e3, "middle": kirchhoff_m[1] * 1e3, "high": kirchhoff_m[2] * 1e3},
        "mindlin_wavelength_mm": {"low": mindlin_m[0] * 1e3, "middle": mindlin_m[1] * 1e3, "high": mindlin_m[2] * 1e3},
        "mindlin_shift": -mindlin_shift(plate, panel.given.band_high_hz),
        "resolution_mm": _resolution_m(panel) * 1e3,
        "spot_mm": spot_m * 1e3,
        "spot_3db_mm": spectrum.width_m(math.sqrt(0.5)) * 1e3,
        "gate_us": design.gate_duration_s(panel.given.band_high_hz) * 1e6,
        "pulse_us": spectrum.pulse_s() * 1e6,
        "in_wavelengths": {
            "length": plate.length_m / kirchhoff_m[1],
            "width": plate.width_m / kirchhoff_m[1],
            "spot": spot_m / kirchhoff_m[1],
            "thickness_of_shortest": plate.thickness_m / mindlin_m[2],
            "patch_of_shortest": panel.given.size_mm * 1e-3 / kirchhoff_m[2],
        },
    }


def _amplitude_and_energy(panel: PanelEstimate) -> Figures:
    decay_s, duration_s = panel.given.decay_time_ms * 1e-3, panel.given.duration_ms * 1e-3
    background, spots_j = _background(panel), panel.spectrum.energy_j(panel.amplitude_m)
    energy_j = spots_j * (1 + background)  # half of the background moves at T
    return {
        "one_bit_share": design.one_bit_share(duration_s, decay_s),
        "linear_share": design.linear_share(duration_s, decay_s),
        "energy_uj": design.energy_j(panel.plate, panel.amplitude_m, _resolution_m(panel)) * 1e6,
        "energy_of_band_uj": spots_j * 1e6,
        "energy_with_background_uj": energy_j * 1e6,
        "kinetic_share": background / 2 / (1 + background),
        "energy_decay_ms": decay_s / 2 * 1e3,
        "mechanical_power_mw": energy_j / duration_s * 1e3,
    }


def _stages(panel: PanelEstimate) -> Figures:
    given, resistors_w = panel.given, panel.given.channels * panel.resistor_w
    repeated_w = resistors_w * given.duration_ms / given.period_ms
    return {
        "resistors_w": resistors_w,
        "resistors_repeated_w": repeated_w,
        "supply_ma": repeated_w / given.supply_v * 1e3,
        "edges_khz": panel.spectrum.crossings_hz * 1e-3,
        "edge_limit_khz": panel.edge_limit_hz * 1e-3,
    }


def _learning(panel: PanelEstimate) -> Figures:
    kirchhoff_m, mindlin_m = (_wavelengths_m(panel, theory)[2] for theory in (kirchhoff_wavelength_m, mindlin_wavelength_m))
    cells = design.learning_grid(panel.plate, mindlin_m)
    return {
        "points_to_learn": design.learning_points(panel.plate, kirchhoff_m),
        "learning_grid": f"{cells[0]} x {cells[1]}",
        "learning_pitch_mm": design.half_wave_m(mindlin_m) * 1e3,
    }


def _wavelengths_m(panel: PanelEstimate, theory: Callable[[Plate, float], float]) -> tuple[float, float, float]:
    """At the band's lower edge, middle and upper edge."""
    low_hz, high_hz = panel.given.band_low_hz, panel.given.band_high_hz
    return theory(panel.plate, low_hz), theory(panel.plate, (low_hz + high_hz) / 2), theory(panel.plate, high_hz)


def _resolution_m(panel: PanelEstimate) -> float:
    return design.half_wave_m(_wavelengths_m(panel, kirchhoff_wavelength_m)[2])


def _background(panel: PanelEstimate) -> float:
    """Mean square of eq. (1) over that of the spot's own part, less the latter."""
    given, tc_s = panel.given, design.characteristic_time_s(panel.plate)
    width_hz = given.band_high_hz - given.band_low_hz
    contrast = design.contrast(width_hz, tc_s, given.channels, given.duration_ms * 1e-3, given.decay_time_ms * 1e-3)
    return (tc_s * width_hz / contrast**2) - 1


def _decay_of(board: Board) -> dict[str, float]:
    """Decay time of a board whose modes do not all decay alike: the median of those in its band."""
    plate, waveform = board.plate, board.waveform
    if plate.damping is None and (plate.foam is None or not plate.foam.dashpot_pa_s_m):
        return {}
    modes = modes_of(board, waveform.band_high_hz)
    in_band = modes.angular_frequency >= 2 * math.pi * waveform.band_low_hz
    return {"decay_time_ms": 1e3 / float(np.median(modes.decay_rate[in_band if in_band.any() else slice(None)]))}


def _outside(spectrum: FocalSpectrum, tc_s: float, background: float, radius_m: float) -> float | None:
    """Contrast as the paper measured it: what of the spot lies within the radius does not count."""
    area_m2 = spectrum.plate.length_m * spectrum.plate.width_m
    share = area_m2 / (area_m2 - math.pi * radius_m**2)
    if not 0 < share < 10:
        return None  # hardly anything is outside
    beyond = max(0.0, 1 - spectrum.share_within(radius_m)) * share
    return math.sqrt(spectrum.bandwidth_hz * tc_s / (beyond + background))


def _counted(board: Board, plate: Plate, low_hz: float, high_hz: float) -> int | None:
    """Modes in the band, one by one, if the board is such a plate or there is a closed form; None if they are too many."""
    if plate != board.plate:
        if set(msgspec.structs.astuple(plate.sides)) != {"simply_supported"}:
            return None  # other edges take seconds to minutes for each plate
        board = msgspec.structs.replace(board, plate=plate, patches=None)  # the board's own may lie off this plate
    try:
        omega = modes_of(board, high_hz).angular_frequency
    except ConfigError:
        return None
    return int((omega >= 2 * math.pi * low_hz).sum())
