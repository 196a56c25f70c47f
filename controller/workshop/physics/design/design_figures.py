"""`haptic-panel design`: what a panel of given numbers will be, by the paper's equations, and where these do not hold.

Amplitude, spot, pulse and both contrasts that can be measured are estimates by the statistics of the modes (`focal_spectrum`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import msgspec
import numpy as np

from controller.device.board.board import Board
from controller.device.board.panel import OF_LAYERS, Driver, Plate
from controller.device.board.records import Record
from controller.device.board.relations.bending_waves import kirchhoff_wavelength_m, mindlin_shift, mindlin_wavelength_m
from controller.errors import ConfigError
from controller.workshop.physics.design import design
from controller.workshop.physics.design.design_inputs import NUMBERS, DesignInputs, inputs_of
from controller.workshop.physics.design.design_warnings import design_warnings
from controller.workshop.physics.field import OUTSIDE_M
from controller.workshop.physics.focal_spectrum import FocalSpectrum
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.plate import WAVELENGTH_M

Figures = dict[str, Any]


def design_figures(board: Board, changes: Mapping[str, float] | None = None) -> Figures:
    """Figures of a design, ready for JSON: its numbers under `inputs`, warnings, one line each, under `warnings`.

    Parameters
    ----------
    board : Board
        Gives what is not in `changes`; if it has damping, foam with a dashpot or layers, their effect on the band as a whole.
    changes : mapping of str to float, optional
        Values of `NUMBERS`.

    Raises
    ------
    ConfigError
        If a number is not possible.
    """
    given = inputs_of(board, {**_decay_of(board), **(changes or {})})
    plate = _plate(board, given)
    driver = msgspec.structs.replace(board.driver, **_fields(given, Driver))
    duration_s, decay_s, period_s = given.duration_ms * 1e-3, given.decay_time_ms * 1e-3, given.period_ms * 1e-3
    low_hz, high_hz = given.band_low_hz, given.band_high_hz
    middle_hz, width_hz = (low_hz + high_hz) / 2, high_hz - low_hz
    spectrum = FocalSpectrum.of(plate, driver, given.size_mm * 1e-3, (low_hz, high_hz), given.bit_clock_hz)
    tc_s = design.characteristic_time_s(plate)
    kirchhoff_m = [kirchhoff_wavelength_m(plate, f) for f in (low_hz, middle_hz, high_hz)]
    mindlin_m = [mindlin_wavelength_m(plate, f) for f in (low_hz, middle_hz, high_hz)]
    resolution_m = design.half_wave_m(kirchhoff_m[2])
    possible_m = spectrum.amplitude_m(driver.supply_v / 2, given.channels, duration_s, decay_s)
    amplitude_m = possible_m if given.amplitude_um is None else given.amplitude_um * 1e-6
    contrast = design.contrast(width_hz, tc_s, given.channels, duration_s, decay_s)
    repeated = design.repetition_factor(period_s, decay_s)
    outside_m = OUTSIDE_M * kirchhoff_m[1] / WAVELENGTH_M
    spots_j = spectrum.energy_j(amplitude_m)
    resistors_w = given.channels * driver.capacitance_f * driver.supply_v**2 / 2 * spectrum.crossings_hz
    finger_kg, spot_m = given.finger_mg * 1e-6, spectrum.width_m()
    left = spectrum.mass_attenuation(finger_kg)
    cells = design.learning_grid(plate, mindlin_m[2])
    background = (tc_s * width_hz / contrast**2) - 1  # of eq. (1), over the spot's own part
    energy_j = spots_j * (1 + background)  # half of which moves at T
    figures: Figures = {
        "tc_ms": tc_s * 1e3,
        "modes_in_band": tc_s * width_hz,
        "modes_counted": _counted(board, plate, low_hz, high_hz),
        "modal_overlap": tc_s / (math.pi * decay_s),
        "contrast": contrast,
        "contrast_bound": design.contrast_bound(width_hz, tc_s),
        "contrast_all": math.sqrt(spectrum.bandwidth_hz * tc_s / (1 + background)),
        "contrast_outside": _outside(spectrum, tc_s, background, outside_m),
        "outside_mm": outside_m * 1e3,
        "contrast_repeated": contrast * repeated,
        "repetition_factor": repeated,
        "wavelength_mm": {"low": kirchhoff_m[0] * 1e3, "middle": kirchhoff_m[1] * 1e3, "high": kirchhoff_m[2] * 1e3},
        "mindlin_wavelength_mm": {"low": mindlin_m[0] * 1e3, "middle": mindlin_m[1] * 1e3, "high": mindlin_m[2] * 1e3},
        "mindlin_shift": -mindlin_shift(plate, high_hz),
        "resolution_mm": resolution_m * 1e3,
        "spot_mm": spot_m * 1e3,
        "spot_3db_mm": spectrum.width_m(math.sqrt(0.5)) * 1e3,
        "gate_us": design.gate_duration_s(high_hz) * 1e6,
        "pulse_us": spectrum.pulse_s() * 1e6,
        "possible_amplitude_um": possible_m * 1e6,
        "amplitude_um": amplitude_m * 1e6,
        "one_bit_share": design.one_bit_share(duration_s, decay_s),
        "linear_share": design.linear_share(duration_s, decay_s),
        "energy_uj": design.energy_j(plate, amplitude_m, resolution_m) * 1e6,
        "energy_of_band_uj": spots_j * 1e6,
        "energy_with_background_uj": energy_j * 1e6,
        "kinetic_share": background / 2 / (1 + background),
        "energy_decay_ms": decay_s / 2 * 1e3,
        "mechanical_power_mw": energy_j / duration_s * 1e3,
        "resistors_w": resistors_w,
        "resistors_repeated_w": resistors_w * duration_s / period_s,
        "finger_left": design.gate_attenuation(plate, finger_kg, resolution_m),
        "finger_left_of_band": left,
        "amplitude_under_finger_um": amplitude_m * left * 1e6,
        "points_to_learn": design.learning_points(plate, kirchhoff_m[2]),
        "learning_grid": f"{cells[0]} x {cells[1]}",
        "learning_pitch_mm": design.half_wave_m(mindlin_m[2]) * 1e3,
        "in_wavelengths": {
            "length": plate.length_m / kirchhoff_m[1],
            "width": plate.width_m / kirchhoff_m[1],
            "spot": spot_m / kirchhoff_m[1],
            "thickness_of_shortest": plate.thickness_m / mindlin_m[2],
            "patch_of_shortest": given.size_mm * 1e-3 / kirchhoff_m[2],
        },
    }
    figures = {"inputs": msgspec.to_builtins(given), **figures}
    return {**figures, "warnings": design_warnings(figures, plate)}


def _decay_of(board: Board) -> dict[str, float]:
    """Decay time of a board whose modes do not all decay alike: the median of those in its band."""
    plate, waveform = board.plate, board.waveform
    if plate.damping is None and (plate.foam is None or not plate.foam.dashpot_pa_s_m):
        return {}
    modes = modes_of(board, waveform.band_high_hz)
    in_band = modes.angular_frequency >= 2 * math.pi * waveform.band_low_hz
    return {"decay_time_ms": 1e3 / float(np.median(modes.decay_rate[in_band if in_band.any() else slice(None)]))}


def _plate(board: Board, given: DesignInputs) -> Plate:
    """Plate of a board with other numbers; one of another material or thickness has no layers.

    Raises
    ------
    ConfigError
        If the board's edges do not go with its size.
    """
    plate, numbers = board.plate, _fields(given, Plate)
    changed = {name: value for name, value in numbers.items() if value != getattr(plate, name) and name != "decay_time_ms"}
    if changed.keys() & set(OF_LAYERS):
        changed |= {name: numbers[name] for name in OF_LAYERS} | {"layers": ()}
    try:
        return msgspec.structs.replace(plate, **changed) if changed else plate
    except ValueError as error:
        raise ConfigError(f"the board's plate.{error}") from error


def _fields(given: DesignInputs, kind: type[Record]) -> dict[str, Any]:
    return {name: getattr(given, name) for name in NUMBERS if name in kind.__struct_fields__}


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
        middle = {"x_mm": plate.length_mm / 2, "y_mm": plate.width_mm / 2, "size_mm": min(plate.length_mm, plate.width_mm) / 10}
        patch = msgspec.structs.replace(board.actuators[0], **middle)  # the board's own may lie off this plate
        board = msgspec.structs.replace(board, plate=plate, actuators=(patch,))
    try:
        omega = modes_of(board, high_hz).angular_frequency
    except ConfigError:
        return None
    return int((omega >= 2 * math.pi * low_hz).sum())
