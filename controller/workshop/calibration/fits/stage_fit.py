"""R C of the driver stages: what all measured responses have in common that those of the board's model have not.

Until the direct wave and the nearest edges have passed, a measured response is that of the model times one function of frequency,

    g exp(-i w (t0 + k r d / w)) H(R, C) / H(R of board.toml, C of board.toml),

with a gain, a delay and an error d of the wavenumber that are of no interest here. It does not tell R and C apart, only their
product. Magnitudes are those of the powers, which waves that the model lacks do not lower; phases those of the cross spectrum.
"""

from typing import Final, NamedTuple

import msgspec
import numpy as np

from controller.arrays import Bools, Complex, Floats, Indices
from controller.device.board.board import Board
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.impulse_response import ResponseModel

AFTER_S: Final = 60e-6  # the pulse of the band, and of the stage
WAVENUMBERS: Final = np.linspace(-0.02, 0.02, 41)
GROUPS: Final = 6  # of points, whose scatter says how sure it is
LEAST_POINTS: Final = 24
MODELS: Final = 0.08  # error of R C that the model's edges and places leave: on twins of free plates
ALIKE: Final = 0.6  # correlation of early responses with the model's, below which its edges are others
SURE: Final = 3.0  # standard deviations


class StageFit(NamedTuple):
    """Factor on board.toml's R C, with its standard deviation."""

    time_constant: float
    error: float

    @property
    def differs(self) -> bool:
        """Whether it is surely not that of board.toml."""
        return abs(self.time_constant - 1) > SURE * self.error


def fit_stages(board: Board, learned: LearnedResponses) -> StageFit | None:
    """R C of the stages; None of too few points, or where the model's edges are too far from the plate's."""
    points = np.flatnonzero(learned.known.any(axis=1))
    if len(points) < LEAST_POINTS:
        return None
    spectra = _early(board, learned, points)
    if _alike(*spectra[1:]) < ALIKE:
        return None
    parts = [_time_constant(board, *spectra, np.arange(len(points)) % GROUPS != part) for part in range(GROUPS)]
    error = np.sqrt((GROUPS - 1) * np.var(parts) + MODELS**2)  # leaving out a group, as a jackknife
    return StageFit(_time_constant(board, *spectra, np.ones(len(points), bool)), float(error))


def stage_notes(board: Board, learned: LearnedResponses) -> list[str]:
    """What of the stages does not fit board.toml, in words."""
    fit = fit_stages(board, learned)
    if fit is None or not fit.differs:
        return []
    off = f"{100 * (fit.time_constant - 1):+.0f} ± {100 * fit.error:.0f} %"
    return [
        f"the stages' R C is {off} off board.toml's: a bank of measurements has what is there, heat and edge limits have not:"
        " measure both, and set resistance_ohm and capacitance_f in [driver]"
    ]


def _early(board: Board, learned: LearnedResponses, points: Indices) -> tuple[Floats, Floats, Complex, Complex]:
    """Frequencies, distances k r (point, channel, bin), and early spectra (point, channel, bin): measured, and of the model."""
    channels = [one.channel for one in board.actuators]
    places_m = np.array([(one.x_mm, one.y_mm) for one in board.actuators]) * 1e-3
    away_m = np.hypot(*np.moveaxis(learned.points_m[points][:, None] - places_m, 2, 0))
    modelled = ResponseModel(board).responses(learned.points_m[points])[:, :, channels]
    measured = learned.responses[points][:, : modelled.shape[1], channels] * learned.known[points][:, None, channels]
    waveform, dispersion = board.waveform, Dispersion.of(board.plate)
    low_hz = waveform.band_low_hz
    k = dispersion.wavenumber(np.array([low_hz, 1.01 * low_hz]))
    slowest_m_s = 2 * np.pi * 0.01 * low_hz / (k[1] - k[0])
    times_s = np.arange(modelled.shape[1]) / waveform.bit_clock_hz
    late = (times_s[:, None] - away_m[:, None] / slowest_m_s) / AFTER_S  # (point, sample, channel)
    window = np.where(late < 1, 1.0, np.cos(np.clip(late - 1, 0, 1) * np.pi / 2) ** 2)
    frequency_hz = np.fft.rfftfreq(len(times_s), 1 / waveform.bit_clock_hz)
    some = (frequency_hz >= low_hz) & (frequency_hz <= waveform.band_high_hz)
    modelled = modelled * learned.known[points][:, None, channels]
    both = [np.fft.rfft(response * window, axis=1)[:, some].swapaxes(1, 2) for response in (measured, modelled)]
    turns: Floats = away_m[..., None] * dispersion.wavenumber(frequency_hz[some])
    return np.asarray(frequency_hz[some], np.float64), turns, both[0], both[1]


def _turned(cross: Complex, turns: Floats) -> Complex:
    """Sum of cross spectra over points and channels, with the wavenumber by which they agree best: (bin,)."""
    sums = [(cross * np.exp(1j * factor * turns)).sum(axis=(0, 1)) for factor in WAVENUMBERS.tolist()]
    return max(sums, key=lambda total: float(abs(total).sum()))


def _alike(turns: Floats, measured: Complex, modelled: Complex) -> float:
    """Correlation of early responses with those of the model, whatever they have in common."""
    total = abs(_turned(measured * modelled.conj(), turns)).sum()
    powers = [np.sqrt((abs(one) ** 2).sum(axis=(0, 1))) for one in (measured, modelled)]
    return float(total / (powers[0] * powers[1]).sum())


def _time_constant(board: Board, frequency_hz: Floats, turns: Floats, measured: Complex, modelled: Complex, used: Bools) -> float:
    """Factor on R C by some points."""
    from scipy.optimize import least_squares  # noqa: PLC0415 - takes 0.3 s

    total = _turned((measured * modelled.conj())[used], turns[used])
    power = (abs(measured[used]) ** 2).sum(axis=(0, 1)) / (abs(modelled[used]) ** 2).sum(axis=(0, 1))
    ratio = np.sqrt(power) * np.exp(1j * np.angle(total))
    s = 2j * np.pi * frequency_hz
    driver = board.driver
    of_board = DriverResponse.of(driver).transfer(s)

    def left(by: Floats) -> Floats:  # logarithms of the factors on R, C and gain, and the delay in µs
        there = msgspec.structs.replace(
            driver, resistance_ohm=driver.resistance_ohm * np.exp(by[0]), capacitance_f=driver.capacitance_f * np.exp(by[1])
        )
        off = np.log(ratio * of_board / (np.exp(by[2] - s * by[3] * 1e-6) * DriverResponse.of(there).transfer(s)))
        return np.concatenate([off.real, np.angle(np.exp(1j * off.imag))])

    found = least_squares(left, np.zeros(4), bounds=([-0.7, -0.7, -3, -5], [0.7, 0.7, 3, 5]))
    return float(np.exp(found.x[0] + found.x[1]))
