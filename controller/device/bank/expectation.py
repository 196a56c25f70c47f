"""What amplitude a bank will have on this panel, with an interval that holds the truth 95 times in 100.

The bank says what amplitudes it foresees at its places (build parameter `amplitude_um`). What changes them is a product of
components, each with a shift and half-widths to both sides, in the logarithm; independent half-widths add by their squares. Each
is measured or stated (`workshop/tolerance/README.md`), on plates other than those by which the whole is checked. Where nobody
knows whether the bank is of this plate, only the upper end means anything, and `cause` says why.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from typing import Any, Final, NamedTuple

from controller.device.bank.file_format import Header
from controller.device.bank.provenance import Provenance, why_unknown
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_stiffness, bending_wavelength_m

Z95: Final = 1.96  # standard deviations of 95 %
SENSITIVITY: Final = 0.02  # assumed: standard deviation of what a calibrated sensor says of the same motion
AGED: Final = 0.02  # a supplier's: of all moments, in a tenfold of days
GLUED: Final = 0.03  # assumed: of one channel's moment, by its glue
OLDEST_D: Final = 3650.0  # also of a bank whose date is none, or after today's
PER_K: Final = -2e-4  # of the frequencies of glass, where the board has no [temperature]
COEFFICIENT: Final = 0.1  # assumed: standard deviation of a coefficient, over itself
READING_K: Final = 0.5  # stated by makers: of a sensor's readings
ROOM_K: Final = 10 / math.sqrt(3)  # assumed: of a plate without a reading, within 10 K of what it was measured at
# Measured on plates drawn from production tolerances, simply supported, Kirchhoff (`tests/workshop/tolerance/expectation_fit.py`)
DETUNED: Final = 0.70  # of the loss that a lag of all waves alike foresees, at T
FELT_DETUNED: Final = 0.18  # of that, in what is felt
FOCI: Final = -0.405  # power of the number of foci with which the amplitude of each goes
BARE: Final = -1.158  # logarithm of what a pad without mass feels, over the amplitude at T
RESISTS: Final = 0.515  # RESISTS, INERT: a mass m takes sqrt(1 + RESISTS x + (INERT x)^2), x = m w / (8 sqrt(D rho h))
INERT: Final = 0.46
ABSORBS: Final = 0.07  # cross-section of a finger for waves that pass it, in their length
PREDICTED_M: Final = 0.3e-3  # of a finger's predicted place, each axis (touch/README.md, "Prediction": p95 0.42 mm at +10 ms)
BESIDE: Final = 6.3  # loss of what is felt, times the square of the distance in wavelengths
# Half-widths of what differs from place to place, over that of the amplitudes over the bank's places
FELT_PLACES: Final = 1.2  # what a pad feels
FREE_FOCI: Final = 0.48  # FREE_FOCI, FELT_FOCI: with several foci
FELT_FOCI: Final = 1.2
OTHERS: Final = 0.49  # times the root of the number of other fingers
SLANTED: Final = 6.7  # times the error of the predicted place in wavelengths
MASS_KG: Final = (30e-6, 150e-6)  # of a finger of which nothing is known (physics/felt.py)
MOST_KG: Final = 1e-2
FELT_SCALES: Final = (0.8, 1.25)  # of `wave_scale`: with waves much longer or shorter a pad feels another share
UNKNOWN: Final = 0.3  # half-width upwards of a bank that may be of another plate


class Interval(NamedTuple):
    """Amplitude in um: what is expected, and what it is within 95 times in 100; no middle where it may be anything below `high`."""

    low_um: float
    middle_um: float | None
    high_um: float

    def times(self, amplitude: float) -> Interval:
        """The same at a share of full amplitude."""
        middle_um = None if self.middle_um is None else self.middle_um * amplitude
        return Interval(self.low_um * amplitude, middle_um, self.high_um * amplitude)

    def in_words(self) -> str:
        """For people."""
        if self.middle_um is None:
            return f"{self.high_um:.2g} µm at most"
        return f"{self.middle_um:.2g} µm ({self.low_um:.2g} to {self.high_um:.2g} with 95 %)"


Part = tuple[float, float, float]  # of the logarithm: shift, half-width downwards, half-width upwards


@dataclass(frozen=True, slots=True)
class Expectation:
    """What does not change while a bank is played on a panel."""

    places_um: tuple[float, float, float]  # low, middle, high over the bank's places
    calibration: float  # half-width: leave-out error, sensor, age, glue
    bank_c: float | None  # temperature of the plate when it was measured
    reference_c: float | None  # of the bit clock; None: it does not follow the plate's temperature
    per_k: float
    stretch: float  # loss at T in the logarithm, over the square of the detuning
    wavelength_m: float
    resonant_kg: float  # mass whose x (`RESISTS`) is 1
    absorbed: float  # loss by each other finger
    sides_m: tuple[float, float]
    feels: bool  # whether what a finger feels can be said
    cause: str  # why the bank may be of another plate; empty: it is of this one

    @classmethod
    def of(cls, header: Header, board: Board, panel: str | None, today: date) -> Expectation | None:
        """Of a bank's header on the panel with an identity (`panel_identity`); None if the bank does not say any amplitude."""
        places_um = header.amplitude_um
        if places_um is None:
            return None
        plate, waveform, temperature, provenance = board.plate, board.waveform, board.temperature, header.provenance
        speed = 2 * math.pi * waveform.middle_hz
        wavelength_m = bending_wavelength_m(plate, waveform.middle_hz)
        lag_s, lag_s2 = lags_s(waveform.duration_s, plate.decay_time_ms * 1e-3)
        area_m2 = plate.length_m * plate.width_m
        stiffness = math.sqrt(bending_stiffness(plate) * plate.density_kg_m3 * plate.thickness_m)
        low, high = FELT_SCALES
        return cls(
            places_um=places_um,
            calibration=_calibration(provenance, len(board.actuators), today),
            bank_c=None if provenance is None else provenance.temperature_c,
            reference_c=None if temperature is None else temperature.reference_c,
            per_k=PER_K if temperature is None else temperature.coefficient_per_k,
            stretch=DETUNED * speed**2 * lag_s2 / 2,
            wavelength_m=wavelength_m,
            resonant_kg=8 * stiffness / speed,
            absorbed=ABSORBS * 2 * waveform.middle_hz * wavelength_m**2 * lag_s / area_m2,
            sides_m=(plate.length_m, plate.width_m),
            feels=low <= header.wave_scale <= high,
            cause=why_unknown(provenance, panel),
        )

    def says(self, x_m: float, y_m: float) -> bool:
        """Whether anything is said of a place: not within half a wavelength of an edge, which is held in one way or another."""
        rim_m = self.wavelength_m / 2
        return rim_m <= x_m <= self.sides_m[0] - rim_m and rim_m <= y_m <= self.sides_m[1] - rim_m

    def free(self, reading_c: float | None, foci: int = 1) -> Interval:
        """At T at a focus, without a finger on the plate, at full amplitude; `reading_c` None: no temperature is known.

        Raises ValueError if there is no focus.
        """
        return self._interval(self._common(reading_c, foci, 1.0, FREE_FOCI), (0.0, 0.0))

    def felt(self, reading_c: float | None, foci: int = 1, others: int = 0, mass_kg: tuple[float, float] = MASS_KG) -> Interval:
        """By a finger at a focus (`physics/felt.py`), whose mass is within bounds, with other fingers on the plate.

        Raises ValueError if there is no focus, fewer than no other fingers, or masses are not in order.
        """
        light_kg, heavy_kg = mass_kg
        if others < 0 or not 0 <= light_kg <= heavy_kg <= MOST_KG:  # NaN too
            raise ValueError(f"{others} other fingers, masses {light_kg:g} to {heavy_kg:g} kg: must be 0 or more, in order")
        if not self.feels:
            return Interval(0.0, None, self.free(reading_c, foci).high_um)
        places, off = self._places, PREDICTED_M / self.wavelength_m
        light, middle, heavy = (self._loaded(mass_kg) for mass_kg in (light_kg, (light_kg + heavy_kg) / 2, heavy_kg))
        parts = self._common(reading_c, foci, FELT_DETUNED, FELT_FOCI)
        parts += [
            _symmetric(BARE + middle, FELT_PLACES * places),
            _of_square(BESIDE, 0.0, off, axes=2),
            _symmetric(0.0, SLANTED * off * places),
            _symmetric(-self.absorbed * others, OTHERS * math.sqrt(others) * places),
        ]
        return self._interval(parts, (middle - heavy, light - middle))

    def figures(self, reading_c: float | None = None) -> dict[str, Any]:
        """For JSON: what one finger of unknown mass feels at full amplitude, and how the plate moves at T without it."""
        return {"finger_um": list(self.felt(reading_c)), "bare_um": list(self.free(reading_c)), "cause": self.cause}

    @property
    def _places(self) -> float:
        low_um, _, high_um = self.places_um
        return math.log(high_um / low_um) / 2

    def _loaded(self, mass_kg: float) -> float:
        """Logarithm of what a mass leaves."""
        x = mass_kg / self.resonant_kg
        return -0.5 * math.log(1 + RESISTS * x + (INERT * x) ** 2)

    def _common(self, reading_c: float | None, foci: int, detuned: float, of_foci: float) -> list[Part]:
        if foci < 1:
            raise ValueError(f"{foci} foci: must be 1 or more")
        low_um, middle_um, high_um = self.places_um
        detuning, deviation = self._detuning(reading_c)
        return [
            (0.0, math.log(middle_um / low_um), math.log(high_um / middle_um)),
            _symmetric(0.0, self.calibration),
            _of_square(detuned * self.stretch, detuning, deviation, axes=1),
            _symmetric(FOCI * math.log(foci), of_foci * self._places if foci > 1 else 0.0),
        ]

    def _detuning(self, reading_c: float | None) -> tuple[float, float]:
        """What is known of how far the plate's frequencies are off the bit clock: mean and standard deviation, relative."""
        at_c, unknown_k = (self.reference_c, ROOM_K) if self.bank_c is None else (self.bank_c, 0.0)
        if reading_c is None or self.reference_c is None or at_c is None or not math.isfinite(reading_c):
            return 0.0, abs(self.per_k) * math.hypot(ROOM_K, unknown_k)
        warmer_k = reading_c - at_c
        deviation = math.hypot(READING_K, COEFFICIENT * warmer_k, unknown_k)
        return self.per_k * (at_c - self.reference_c), abs(self.per_k) * deviation

    def _interval(self, parts: Sequence[Part], between: tuple[float, float]) -> Interval:
        """Of parts, and of what is anywhere `between` so much below and above."""
        shift = math.log(self.places_um[1]) + math.fsum(part[0] for part in parts)
        sums = [math.fsum(part[side] ** 2 for part in parts) for side in (1, 2)]
        down, up = (math.sqrt(square + anywhere(far, square)) for square, far in zip(sums, between, strict=True))
        if self.cause:
            return Interval(0.0, None, math.exp(shift + math.hypot(up, UNKNOWN)))
        return Interval(math.exp(shift - down), math.exp(shift), math.exp(shift + up))


def anywhere(far: float, square: float) -> float:
    """What a uniform error of at most `far` adds to the square of a normal one's half-width: the sum's is within 1 %."""
    return 0.0 if far == 0 else far**2 * (0.9025 + 0.378 * square / (square + (0.725 * far) ** 2))


def _symmetric(shift: float, half_width: float) -> Part:
    return shift, half_width, half_width


def _of_square(loss: float, mean: float, deviation: float, *, axes: int) -> Part:
    """Of a loss that goes with the square of a normal error, on each of some axes."""
    half_width = Z95 * loss * math.sqrt(axes * (2 * deviation**4 + 4 * mean**2 * deviation**2))
    return _symmetric(-loss * axes * (mean**2 + deviation**2), half_width)


def lags_s(duration_s: float, decay_s: float) -> tuple[float, float]:
    """Mean and mean square of the time before T at which bits are played, by what is left of each at T."""
    x = duration_s / decay_s
    left = math.exp(-x)
    all_ = -math.expm1(-x)
    return decay_s * (1 - left * (1 + x)) / all_, decay_s**2 * (2 - left * (2 + 2 * x + x * x)) / all_


def _calibration(provenance: Provenance | None, channels: int, today: date) -> float:
    if provenance is None or not provenance.foresees:
        return 0.0  # `UNKNOWN` is for all of it
    assert provenance.foreseen is not None
    decades = math.log10(max(_age_d(provenance.date, today), 1.0))
    deviations = (*provenance.foreseen, SENSITIVITY, AGED * decades, GLUED / math.sqrt(channels))
    return Z95 * math.hypot(*deviations)


def _age_d(measured: str | None, today: date) -> float:
    try:
        age_d = (today - date.fromisoformat((measured or "")[:10])).days
    except ValueError:
        return OLDEST_D
    return OLDEST_D if age_d < 0 else min(float(age_d), OLDEST_D)


def in_words(figures: dict[str, Any] | None) -> str:
    """`Expectation.figures` in a line; None: of a bank that says no amplitude."""
    if figures is None:
        return "no amplitude is stated: build the bank again (none is with a [finger] in board.toml)"
    finger, bare = (Interval(*figures[name]).in_words() for name in ("finger_um", "bare_um"))
    felt = f"a finger of 30 to 150 mg feels {finger} of a pulse"
    if figures["cause"]:
        return f"{felt}; no lower bound: {figures['cause']}"
    return f"{felt}, the bare plate moves {bare}"
