"""The wave that reaches a point straight from a patch, before any edge has sent it back: what geometry alone foresees.

    G = -i m A S(k) / (8 D) sqrt(2 / (pi k r)) exp(-i (k r - pi / 4)),

for a square patch of area A at distance r, with moment m per V, its directivity S, and k by Mindlin's dispersion: the far field of
a moment on an infinite plate, whatever holds the edges. Regression of measured transfer functions on G over many points gives each
channel's sign and strength, which patch it drives, and the delay of the records. What comes back from edges does not correlate with
G from point to point.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Bools, Complex, Floats, Indices
from controller.device.board.board import Board
from controller.workshop.calibration.dispersion import Dispersion
from controller.workshop.calibration.records.drives import held_spectrum
from controller.workshop.calibration.transfer_functions.transfers import RawBins
from controller.workshop.physics.responses.driver import DriverResponse

FACTORS = np.linspace(0.96, 1.04, 9)  # of the wavenumber, on what board.toml gives
LEAST_PEAK = 4.0  # of the pulse that all records make together, over its rms
AFTER_S = 45e-6  # length of the pulse of a band, and of the driver
RIDGE = 0.1  # of patches so near to each other that their waves are alike: less lets chance in, of few points
ELSEWHERE_S = (90e-6, 130e-6, 170e-6, 210e-6)  # later than the direct wave: what chance gives
NEAR_WAVELENGTHS = 1.0  # nearer to a patch than this, G does not hold


@dataclass(frozen=True, eq=False)
class DirectWaves:
    """What regression on the direct wave gives."""

    delay_s: float  # by which what happened is later in the records than they say
    factor: float  # of the wavenumber, on that of board.toml
    # (channel, channel): row: data of one; column: patch of one. 1 where it is as board.toml says; NaN without data or patch
    strength: Floats
    error: Floats  # (channel,): of a row's numbers, standard deviation


def direct_transfer(board: Board, bins: RawBins, points_m: Floats, factor: float = 1.0) -> Complex:
    """G of each point and patch, (point, actuator, bin) in m s per V; zero nearer than a wavelength."""
    return direct_wave(board, bins.frequency_hz, bins.bit_clock_hz, points_m, factor)


def direct_wave(
    board: Board,
    frequency_hz: Floats,
    bit_clock_hz: float,
    points_m: Floats,
    factor: float = 1.0,
    patches: slice | Indices = slice(None),
) -> Complex:
    """The same at any frequencies."""
    actuators = np.array([(a.x_mm, a.y_mm, a.size_mm) for a in board.actuators])[patches] * 1e-3
    dispersion = replace(Dispersion.of(board.plate), factor=factor)
    k = dispersion.wavenumber(frequency_hz)
    away_m = points_m[:, None] - actuators[:, :2]
    size_m = actuators[:, 2:]
    r = np.maximum(np.hypot(away_m[..., 0], away_m[..., 1]), 1e-9)[..., None]
    along, across = (size_m * away_m[..., axis, None] / r * k / (2 * np.pi) for axis in (0, 1))
    drive = DriverResponse.of(board.driver).transfer(2j * np.pi * frequency_hz) * held_spectrum(frequency_hz, 1 / bit_clock_hz)
    strength = -1j * board.driver.moment_n_per_v * size_m**2 / (8 * dispersion.stiffness_nm) * np.sinc(along) * np.sinc(across)
    wave: Complex = drive * strength * np.sqrt(2 / (np.pi * k * r)) * np.exp(-1j * (k * r - np.pi / 4))
    return np.where(k * r > 2 * np.pi * NEAR_WAVELENGTHS, wave, 0)


def direct_waves(
    board: Board,
    bins: RawBins,
    points_m: Floats,  # (point, 2)
    transfers: NDArray[np.complexfloating],  # (point, channel, bin): in m s per V
    resolved: Bools,  # (point, channel)
    widest_s: float,  # delays are looked for from minus this to this; half of the longest record at most
) -> DirectWaves | None:
    """Regression of transfer functions on the direct wave.

    None where it does not stand out: too few points, too near to the patches, or nothing like this board.
    """
    channels = [a.channel for a in board.actuators]
    measured = transfers[:, channels] * np.sqrt(bins.gain)
    shown = resolved[:, channels]
    power = (abs(measured) ** 2).sum(axis=2)
    level = np.median(power[shown & (power > 0)]) if (shown & (power > 0)).any() else 0.0
    if not level:
        return None
    measured = measured / np.sqrt(np.where(power > 100 * level, power / level, 1))[..., None]  # no single record decides
    arrival = _arrival(board, bins, points_m, measured, shown, widest_s)
    if arrival.stands_out < LEAST_PEAK:
        return None
    factor, delay_s = arrival.factor, arrival.delay_s
    wave = direct_transfer(board, bins, points_m, factor) * np.sqrt(bins.gain) * shown[..., None]
    measured = _arriving(board, bins, points_m, measured, delay_s)
    gram = np.tensordot(wave, wave.conj(), axes=((0, 2), (0, 2))).real
    scale = 1 / np.sqrt(np.maximum(np.diag(gram), 1e-300))
    whitened = gram * scale[:, None] * scale + RIDGE * np.eye(len(gram))

    def strength(late_s: float) -> Floats:
        aligned = measured * np.exp(2j * np.pi * bins.frequency_hz * late_s)
        on_each = np.tensordot(aligned, wave.conj(), axes=((0, 2), (0, 2))).real
        return np.asarray((1 + RIDGE) * np.linalg.solve(whitened, (on_each * scale).T).T * scale)  # 1 of a patch alone

    elsewhere = np.stack([strength(delay_s + away_s) for away_s in ELSEWHERE_S])
    whole = np.full((board.channels,) * 2, np.nan)
    whole[np.ix_(channels, channels)] = strength(delay_s)
    error = np.full(board.channels, np.nan)
    error[channels] = np.sqrt((elsewhere**2).mean(axis=(0, 2)))
    return DirectWaves(delay_s, factor, whole, error)


class _Arrival(NamedTuple):
    """When the direct wave arrives."""

    height: float  # of the pulse that all records make together, relative to that of the wave alone
    factor: float
    delay_s: float
    stands_out: float  # that height over the pulse's rms


def _arrival(board: Board, bins: RawBins, points_m: Floats, measured: Complex, shown: Bools, widest_s: float) -> _Arrival:
    """Factor and delay with which the records fit best; a factor further from 1 has to fit better by 3 %."""
    lags_s = np.fft.fftfreq(bins.length) * bins.length / bins.bit_clock_hz
    near = abs(lags_s) <= widest_s
    best: _Arrival | None = None
    for factor in sorted(FACTORS, key=lambda value: abs(value - 1)):
        wave = direct_transfer(board, bins, points_m, factor) * np.sqrt(bins.gain) * shown[..., None]
        spectrum = np.zeros(bins.length, np.complex128)
        spectrum[bins.first : bins.first + len(bins.gain)] = (measured * wave.conj()).sum(axis=(0, 1))
        pulse = abs(np.fft.ifft(spectrum)).astype(np.float64)  # at a lag: how well the records fit if they are so much later
        found = int(np.where(near, pulse, 0).argmax())
        height = float(pulse[found] / np.sqrt((abs(wave) ** 2).sum() or np.inf))
        if best is None or height > 1.03 * best.height:
            stands_out = float(pulse[found] / np.sqrt((pulse**2).mean()))
            best = _Arrival(height, float(factor), _peak(pulse, found) / bins.bit_clock_hz, stands_out)
    assert best is not None
    return best


def _arriving(board: Board, bins: RawBins, points_m: Floats, measured: Complex, delay_s: float) -> Complex:
    """Of each response what comes until the direct wave has passed, without most of what edges sent back."""
    low_hz = bins.frequency_hz[0]
    k = Dispersion.of(board.plate).wavenumber(np.array([low_hz, 1.01 * low_hz]))
    group_m_s = 2 * np.pi * 0.01 * low_hz / (k[1] - k[0])
    places_m = np.array([(a.x_mm, a.y_mm) for a in board.actuators]) * 1e-3
    after_s = np.hypot(*np.moveaxis(points_m[:, None] - places_m, 2, 0)) / group_m_s + AFTER_S
    lags_s = np.fft.fftfreq(bins.length) * bins.length / bins.bit_clock_hz - delay_s
    found = np.empty_like(measured)
    some = slice(bins.first, bins.first + len(bins.gain))
    for point, spectra in enumerate(measured):
        whole = np.zeros((len(spectra), bins.length // 2 + 1), np.complex128)
        whole[:, some] = spectra
        response = np.fft.irfft(whole, bins.length)
        response[(lags_s < -AFTER_S) | (lags_s > after_s[point][:, None])] = 0
        found[point] = np.fft.rfft(response)[:, some]
    return found


def _peak(pulse: Floats, at: int) -> float:
    """Place of a maximum between samples, by a parabola; beyond the half of the samples below zero."""
    before, here, after = pulse[at - 1], pulse[at], pulse[(at + 1) % len(pulse)]
    below = before - 2 * here + after
    place = at + (0.5 * float(before - after) / float(below) if below else 0.0)
    return place - len(pulse) if place > len(pulse) / 2 else place
