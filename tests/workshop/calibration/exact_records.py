"""Records of a small plate as a recorder with any clock would take them: exact in time, without the code under test."""

from functools import cache

import numpy as np
from scipy.signal import lfilter
from small_plate import small_board

from controller.workshop.physics.responses.impulse_response import ResponseModel

POINTS_M = np.random.default_rng(5).uniform([0.008, 0.008], [0.062, 0.042], (12, 2))
NAMES = tuple(str(index + 1) for index in range(len(POINTS_M)))
CHANNELS = np.arange(8)
BIT_CLOCK_HZ = 500e3


@cache
def board():
    return small_board()


@cache
def model():
    return ResponseModel(board())


def displacement(volts, rate_hz, times_s, order=0):
    """(point, emission, time) after drives of (emission, 32, sample) V, held for 1 / rate_hz from time 0 on.

    `order` 1 gives velocity, 2 acceleration. Every mode's poles are stepped exactly from sample to sample of the drive, and
    from there to each of `times_s`.
    """
    step, forces = model().step, model().forces
    steps = np.diff(volts, axis=2, prepend=0, append=0)
    of_mode = np.einsum("mc,ecn->men", forces, steps)  # N per mode at each step
    at = np.clip((times_s * rate_hz + 1e-9).astype(int), 0, steps.shape[2] - 1)
    since = np.maximum(times_s - at / rate_hz, 0)
    found = np.zeros((len(of_mode), len(volts), len(times_s)))
    for pole, residue, mode in zip(step.poles, step.residues, step.mode_of_pole, strict=True):
        state = lfilter([1], [1, -np.exp(pole / rate_hz)], of_mode[mode].astype(complex), axis=-1)[:, at]
        found[mode] += (state * (residue * pole**order * np.exp(pole * since))).real
    shapes = model().plate_modes.shapes(POINTS_M)
    total = np.einsum("pm,met->pet", shapes, found)
    for number, pole in enumerate(step.driver_poles):  # the same of all modes
        driven = np.einsum("pm,men->pen", shapes * step.driver_residues[:, number], of_mode)
        state = lfilter([1], [1, -np.exp(pole / rate_hz)], driven, axis=-1)[..., at]
        total += (state * (pole**order * np.exp(pole * since))).real
    if order == 0:
        total += np.cumsum(np.einsum("pm,men->pen", shapes * step.static, of_mode), axis=2)[..., at]
    return total * (times_s >= 0)


@cache
def pulse_spectra(length=5000):
    """Spectra of the responses to a pulse of 1 V of one bit period, sampled as `LearnedResponses`: (point, 8, bin)."""
    volts = np.zeros((8, 32, 1))
    volts[CHANNELS, CHANNELS, 0] = 1
    return np.fft.rfft(displacement(volts, BIT_CLOCK_HZ, (np.arange(length) + 1) / BIT_CLOCK_HZ))


def true_responses(gain_of, samples, length=5000):
    """What deconvolution should find: responses through `gain_of(frequency)`, (point, sample, 8)."""
    whole = np.fft.irfft(pulse_spectra(length) * gain_of(np.fft.rfftfreq(length, 1 / BIT_CLOCK_HZ)), length)
    return whole[..., :samples].swapaxes(1, 2)


def noisy(records, snr_db=40, seed=9):
    """The same with white noise that much below their rms."""
    return records + np.random.default_rng(seed).normal(size=records.shape) * records.std() * 10 ** (-snr_db / 20)
