"""Constants of `device/bank/expectation.py`, from plates drawn from production tolerances, whose responses are known exactly.

These plates are simply supported, by Kirchhoff's theory; no bank is measured on them. Those by which intervals are checked are
others (`controller/workshop/tolerance/unseen.py`).
"""

from collections import defaultdict
from typing import Final

import numpy as np
from scipy.optimize import least_squares

from controller.arrays import Floats
from controller.device.bank.expectation import lags_s
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_stiffness, bending_wavelength_m
from controller.workshop.bank_builder.said_amplitude import foreseen_um
from controller.workshop.physics.felt import AROUND_S, FeltLoad, felt_by_motion_um
from controller.workshop.physics.focusing import balanced_weights, focus
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.pad_motion import PadMotion
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.word_capture import volts_above_idle
from controller.workshop.tolerance.tolerances import Tolerances, draw

Found = defaultdict[str, list[float]]

MASSES_KG: Final = (0.0, 30e-6, 50e-6, 70e-6, 90e-6, 120e-6, 150e-6)
MIDDLE_KG: Final = 70e-6
OFF_M: Final = 1e-3
DETUNING: Final = 2e-3
AWAY_M: Final = 12e-3
FOCI: Final = (2, 3, 4)
RIM_M: Final = 5e-3


class _Plate:
    """A drawn plate, and what is played at some places of it."""

    def __init__(self, board: Board, tolerances: Tolerances, seed: int, number: int, places: int) -> None:
        drawn = draw(board, tolerances, seed, number)
        self.board, self.gain = drawn.board, drawn.gain
        self.modes = modes_of(self.board)
        sides = np.array([board.plate.length_m, board.plate.width_m])
        self.places_m = np.random.default_rng([seed, number]).uniform(RIM_M, sides - RIM_M, (places, 2))
        model = ResponseModel(self.board, modes=self.modes)
        self.responses = np.asarray(model.drive_order_responses(self.places_m), np.float64) * self.gain
        self.foreseen_um = foreseen_um(self.responses, self.board.driver.supply_v)
        self.whole = np.asarray(model.responses(self.places_m))[:, ::-1]
        self.volts = [self.volts_of([place]) for place in range(places)]

    def volts_of(self, places: list[int]) -> Floats:
        some = self.responses[places]
        return volts_above_idle(self.board, focus(some, balanced_weights(some).tolist(), self.board.idle_word)) * self.gain

    def felt_um(self, volts: Floats, fingers_m: Floats, mass_kg: float = MIDDLE_KG, detuned: float = 0.0) -> float:
        """By the first of some fingers."""
        load = FeltLoad(mass_kg, 1.0, 1e3)
        samples = self.board.waveform.samples
        pads = PadMotion(self.board, drifted(self.modes, detuned), fingers_m, load, load.pad_mm * 1e-3, samples, AROUND_S)
        return float(felt_by_motion_um(pads, volts[None], self.board.waveform.bit_period_s)[0, 0])

    def free_um(self, volts: Floats, place: int, detuned: float = 0.0) -> float:
        whole = self.whole[place]
        if detuned:
            model = ResponseModel(self.board, modes=drifted(self.modes, detuned))
            whole = np.asarray(model.responses(self.places_m[[place]]))[0, ::-1]
        return 1e6 * abs(float(np.vdot(volts, whole)))

    def others(self, place: int, count: int) -> list[int]:
        """Places that are away from a place and from each other, itself first; fewer if there are not as many."""
        found = [place]
        for other in range(len(self.places_m)):
            if all(np.hypot(*(self.places_m[other] - self.places_m[one])) > AWAY_M for one in found):
                found.append(other)
        return found[: count + 1]


def fit(board: Board, tolerances: Tolerances, seed: int = 1, plates: int = 25, places: int = 12) -> dict[str, float]:
    """The constants, by their names there."""
    found: Found = defaultdict(list)
    for number in range(plates):
        _measure(_Plate(board, tolerances, seed, number, places), found)
    plate, waveform = board.plate, board.waveform
    speed, wavelength_m = 2 * np.pi * waveform.middle_hz, bending_wavelength_m(plate, waveform.middle_hz)
    lag_s, lag_s2 = lags_s(waveform.duration_s, plate.decay_time_ms * 1e-3)
    means = {name: float(np.mean(values)) for name, values in found.items()}
    spread = float(np.std(found["places"]))
    resonant_kg = 8 * np.sqrt(bending_stiffness(plate) * plate.density_kg_m3 * plate.thickness_m) / speed
    x = np.array(MASSES_KG) / resonant_kg
    felt = np.array([means[f"felt {mass_kg:g}"] for mass_kg in MASSES_KG])
    bare, resists, inert = least_squares(_unlike, [-1.0, 0.5, 0.5], args=(x, felt)).x
    area_m2 = plate.length_m * plate.width_m
    deviation = np.mean([np.std(found[f"felt {mass_kg:g}"]) for mass_kg in MASSES_KG[1:]])
    off = OFF_M / wavelength_m
    found_constants = {
        "detuned": -2 * means["detuned"] / (speed**2 * lag_s2 * DETUNING**2),
        "felt_detuned": means["felt detuned"] / means["detuned"],
        "foci": float(np.mean([means[f"free foci {count}"] / np.log(count) for count in FOCI])),
        "bare": float(bare),
        "resists": float(resists),
        "inert": float(inert),
        "absorbs": -means["others 2"] / 2 * area_m2 / (2 * waveform.middle_hz * wavelength_m**2 * lag_s),
        "beside": -means["beside"] / off**2,
        "felt_places": _more(float(deviation), spread),
        "free_foci": _mean_deviation(found, "free foci") / spread,
        "felt_foci": _mean_deviation(found, "felt foci") / spread,
        "others": float(np.std(found["others 2"])) / np.sqrt(2) / spread,
        "slanted": float(np.std(found["beside"])) / off / spread,
    }
    return {name: float(value) for name, value in found_constants.items()}


def _measure(plate: _Plate, found: Found) -> None:
    middle_um = float(np.median(plate.foreseen_um))
    found["places"] += np.log(plate.foreseen_um / middle_um).tolist()
    for place, volts in enumerate(plate.volts):
        here = plate.places_m[[place]]
        free_um = plate.free_um(volts, place)
        felt_um = plate.felt_um(volts, here)
        for mass_kg in MASSES_KG:
            found[f"felt {mass_kg:g}"].append(np.log(plate.felt_um(volts, here, mass_kg) / middle_um))
        for detuned in (-DETUNING, DETUNING):
            found["detuned"].append(np.log(plate.free_um(volts, place, detuned) / free_um))
            found["felt detuned"].append(np.log(plate.felt_um(volts, here, detuned=detuned) / felt_um))
        found["beside"].append(np.log(plate.felt_um(volts, here + OFF_M * np.array([0.8, 0.6])) / felt_um))
        found["others 2"].append(np.log(plate.felt_um(volts, plate.places_m[plate.others(place, 2)]) / felt_um))
        for count in FOCI:
            several = plate.others(place, count - 1)
            if len(several) == count:
                together = plate.volts_of(several)
                found[f"free foci {count}"].append(np.log(plate.free_um(together, place) / free_um))
                found[f"felt foci {count}"].append(np.log(plate.felt_um(together, here) / felt_um))


def _unlike(constants: Floats, x: Floats, felt: Floats) -> Floats:
    bare, resists, inert = constants
    found: Floats = bare - 0.5 * np.log(1 + resists * x + (inert * x) ** 2) - felt
    return found


def _more(whole: float, part: float) -> float:
    """What has to be added to a part of a deviation, by squares, for the whole of it; over the part."""
    return float(np.sqrt(max((whole / part) ** 2 - 1, 0.0)))


def _mean_deviation(found: Found, name: str) -> float:
    return float(np.mean([np.std(found[f"{name} {count}"]) for count in FOCI]))
