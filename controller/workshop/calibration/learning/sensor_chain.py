"""What all records have in common, beside the direct waves G that board.toml foresees: unit, sensitivity, delay, the sensor's mass.

At each frequency the records' common factor on G is S = sum of H conj(G) / sum of |G|^2 over points and patches. A wrong unit makes
it a power of i w, a late record turns it, and a sensor of mass M moves less than a plate of mobility 1 / Z, Z = 8 sqrt(D m), would:

    S = g (i w)^n exp(-i w d) / (1 + i w M / Z)

The plate's mobility where the sensor stands is not quite that of an endless plate; what this leaves of 10 mg costs 1 % of the
amplitude. Drivers whose R, L and C are not those of board.toml turn S too, as some mg would.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Complex, Floats
from controller.device.board.board import Board
from controller.workshop.calibration.checking.checks import Objection
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.learning.locating import away_from_edges
from controller.workshop.calibration.transfer_functions.direct_wave import direct_transfer
from controller.workshop.calibration.transfer_functions.transfers import RawBins

ORDERS = (-2, -1, 0, 1, 2)  # by which the records are derivatives of what their unit says
STEP_KG = 0.5e-6
MASSES_KG: Floats = np.concatenate([np.arange(-20, 20) * STEP_KG, np.geomspace(1e-5, 1e-3, 81)])  # below 0: what chance gives
SHORT_S = 3e-6  # delays up to this are taken to be none: an unknown edge, or the mass, turns the waves as much
DELAYS_S: Floats = np.array([step * 0.5e-6 for step in range(-120, 121) if step == 0 or abs(step * 0.5e-6) > SHORT_S])
PARTS = 10  # of the band, whose scatter says how sure the mass is
SURE = 3.0  # standard deviations
MOST_DIVIDED_KG = 15e-6  # a mass that divides out: of more, too much of the plate's own mobility is in the records
KNOWN_BETTER = 20.0  # how much more the residual counts than a gain that is off by a factor e


@dataclass(frozen=True)
class SensorChain:
    """What all records have in common."""

    order: int  # n: 0 if the unit is right
    gain: float  # g: sensitivity over that which the file states, where board.toml's moment is right
    mass_kg: float
    mass_error_kg: float  # standard deviation

    @property
    def loads(self) -> bool:
        """Whether the sensor's mass is surely not nil."""
        return self.mass_kg > SURE * self.mass_error_kg

    def in_words(self) -> str:
        """The mass with its standard deviation."""
        return f"{1e6 * self.mass_kg:.1f} ± {1e6 * self.mass_error_kg:.1f} mg"

    def findings(self, stated_mg: float | None) -> list[Objection]:
        """What is wrong with unit and mass, of which the file says `stated_mg`."""
        if self.order:
            way, times = "derivatives" if self.order > 0 else "integrals", "once" if abs(self.order) == 1 else "twice"
            return [Objection("unit", f"records are {way} of what records.unit says ({times}): is it m, m/s or m/s^2?")]
        mass_kg = self.mass_kg if stated_mg is None else stated_mg * 1e-6
        if mass_kg > MOST_DIVIDED_KG and (self.loads or stated_mg is not None):
            said = self.in_words() if stated_mg is None else f"{stated_mg:g} mg"
            most = f"up to {1e6 * MOST_DIVIDED_KG:.0f} mg can be corrected"
            lighter = "take a lighter one; a contactless one: sensor_mass_mg = 0"
            text = f"the sensor's mass, {said}, holds the plate back: {most}; {lighter}"
            return [Objection("mass", text)]
        if self.loads and stated_mg is None:
            text = f"a sensor of {self.in_words()} seems to stand on the plate: corrected; records.sensor_mass_mg states it"
            return [Objection("load", text)]
        return []

    def divided_kg(self, stated_mg: float | None) -> float:
        """The mass to divide out."""
        found_kg = (self.mass_kg if self.loads else 0.0) if stated_mg is None else stated_mg * 1e-6
        return found_kg if found_kg <= MOST_DIVIDED_KG and not self.order else 0.0


def impedance_n_s_m(board: Board) -> float:
    """Of a point of an endless plate."""
    plate = Dispersion.of(board.plate)
    return float(8 * np.sqrt(plate.stiffness_nm * plate.mass_kg_m2))


def loaded(board: Board, frequency_hz: Floats, mass_kg: float) -> Complex:
    """What a plate moves under a mass, over what it moves without."""
    return 1 / (1 + np.asarray(2j * np.pi * mass_kg / impedance_n_s_m(board) * frequency_hz, np.complex128))


def sensor_chain(
    board: Board,
    bins: RawBins,
    points_m: Floats,  # (point, 2): where they lie on the plate
    transfers: NDArray[np.complexfloating],  # (point, 32, bin)
    resolved: Bools,  # (point, 32)
    factor: float,  # of the wavenumber
    around_s: float,  # what the delay is nearly
) -> SensorChain:
    """Fit it; the sign of all records together is left to the findings of `direct_wave`."""
    some = away_from_edges(board, points_m)
    channels = np.array([a.channel for a in board.actuators])
    inside = np.flatnonzero((bins.frequency_hz > board.waveform.band_low_hz) & (bins.frequency_hz < board.waveform.band_high_hz))
    wave = direct_transfer(board, bins, points_m[some], factor)[..., inside] * resolved[np.ix_(some, channels)][..., None]
    common = (transfers[np.ix_(some, channels, inside)] * wave.conj()).sum(axis=(0, 1)) / (np.abs(wave) ** 2).sum(axis=(0, 1))
    frequency_hz = bins.frequency_hz[inside]
    common = common * np.exp(2j * np.pi * frequency_hz * around_s)
    turns = np.exp(2j * np.pi * frequency_hz * DELAYS_S[:, None])
    best = (np.inf, 0, 0, 1.0)
    for order in ORDERS:
        for mass_kg in MASSES_KG.tolist():
            scaled = common / ((2j * np.pi * frequency_hz) ** order * loaded(board, frequency_hz, mass_kg)) * turns
            gain = scaled.real.mean(axis=1)
            left = (np.abs(scaled) ** 2).mean(axis=1) / gain**2 - 1
            cost = KNOWN_BETTER * np.log(left) + np.log(np.abs(gain)) ** 2
            at = int(cost.argmin())
            best = min(best, (float(cost[at]), order, at, float(gain[at])))
    _, order, at, gain = best
    scaled = common * turns[at] / (2j * np.pi * frequency_hz) ** order
    parts = np.arange(len(inside)) * PARTS // len(inside)
    masses = np.array([_mass_kg(board, frequency_hz[parts != part], scaled[parts != part]) for part in range(PARTS)])
    error_kg = float(np.hypot(np.sqrt((PARTS - 1) * masses.var()), STEP_KG / 2))  # the jackknife, and the step of the search
    return SensorChain(order, abs(gain), _mass_kg(board, frequency_hz, scaled), error_kg)


def _mass_kg(board: Board, frequency_hz: Floats, common: Complex) -> float:
    """The mass under which a common factor is most nearly a constant."""
    scaled = common / np.stack([loaded(board, frequency_hz, mass_kg) for mass_kg in MASSES_KG.tolist()])
    left = (np.abs(scaled) ** 2).mean(axis=1) / scaled.real.mean(axis=1) ** 2
    return float(MASSES_KG[left.argmin()])
