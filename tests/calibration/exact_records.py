"""Records of a small plate as a recorder with any clock would take them: exact in time, without the code under test."""

from functools import cache

import numpy as np
from scipy.signal import lfilter
from small_plate import small_board

from controller.physics.impulse_response import ResponseModel


@cache
def board():
    return small_board()


@cache
def model():
    return ResponseModel(board())


CHANNELS = np.array(sorted(a.channel for a in small_board().actuators))
POINTS_M = np.random.default_rng(5).uniform([0.008, 0.008], [0.062, 0.042], (12, 2))
NAMES = tuple(str(index + 1) for index in range(len(POINTS_M)))


def displacement(volts, rate_hz, times_s, points_m=POINTS_M, order=0):
    """Displacement (point, time) after drives of (32, sample) V, held for 1 / rate_hz from time 0 on.

    order 1: velocity, 2: acceleration.
    Every mode's poles are stepped exactly from sample to sample of the drive, and from there to each of `times_s`.
    """
    step, forces = model().step, model().forces
    steps = np.diff(volts, axis=1, prepend=0, append=0)
    of_mode = forces @ steps  # N per mode at each step
    at = np.minimum((times_s * rate_hz + 1e-9).astype(int), steps.shape[1] - 1)
    since = times_s - at / rate_hz
    started = times_s >= 0
    found = np.zeros((len(of_mode), len(times_s)))
    poles = zip(step.poles, step.residues, step.mode_of_pole, strict=True)
    for pole, residue, mode in poles:
        state = lfilter([1], [1, -np.exp(pole / rate_hz)], of_mode[mode].astype(complex))
        found[mode] += (residue * pole**order * state[at] * np.exp(pole * since)).real * started
    for number, pole in enumerate(step.driver_poles):
        state = lfilter([1], [1, -np.exp(pole / rate_hz)], of_mode.astype(complex), axis=1)
        found += (step.driver_residues[:, number, None] * pole**order * state[:, at] * np.exp(pole * since)).real * started
    if order == 0:
        found += step.static[:, None] * np.cumsum(of_mode, axis=1)[:, at] * started
    return model().plate_modes.shapes(points_m) @ found


def true_responses(gain_of, points_m=POINTS_M, samples=1000):
    """What deconvolution should find: the response of all times through `gain_of(frequency)`, (point, sample, 32)."""
    volts = np.zeros((len(CHANNELS), 1))
    length = 8192
    times_s = (np.arange(length) + 1) / board().waveform.bit_clock_hz
    found = np.zeros((len(points_m), samples, 32))
    for channel in CHANNELS:
        volts = np.zeros((32, 1))
        volts[channel] = 1
        whole = displacement(volts, board().waveform.bit_clock_hz, times_s, points_m)
        frequency_hz = np.fft.rfftfreq(length, 1 / board().waveform.bit_clock_hz)
        found[:, :, channel] = np.fft.irfft(np.fft.rfft(whole) * gain_of(frequency_hz), length)[:, :samples]
    return found
