"""A drawn plate by another way: modes by Ritz's method, and Runge-Kutta steps in time through each channel's own R, L and C."""

import msgspec
import numpy as np

from controller.workshop.physics.modes.ritz_modes import RitzModes
from controller.workshop.physics.plate import mode_cut_hz
from controller.workshop.physics.word_capture import volts_above_idle

STEPS = 12  # in a bit period of 2 us: 0.1 rad of the highest mode


def amplitudes(drawn, words, places_m):
    """Displacement at T in m of each place, (place,), by the words of each: (place, sample)."""
    board = drawn.board
    modes = RitzModes.of(board.plate, mode_cut_hz(board))
    assert set(msgspec.structs.astuple(board.plate.sides)) == {"simply_supported"}  # the product has a closed form for these
    forces = np.zeros((modes.count, 32))
    for actuator in board.actuators:
        moment = board.driver.moment_n_per_v * drawn.gain[actuator.channel]
        forces[:, actuator.channel] = -moment * modes.coupling(actuator) / modes.mass_kg
    driver = board.driver
    capacitance = driver.capacitance_f * drawn.capacitance[:, None]
    stiffness, damping = modes.angular_frequency[:, None] ** 2, 2 * modes.decay_rate[:, None]

    def rate(state, volts):
        current, piezo, place, speed = state
        return (
            (volts - driver.resistance_ohm * current - piezo) / driver.inductance_h,
            current / capacitance,
            speed,
            forces @ piezo - damping * speed - stiffness * place,
        )

    def moved(state, by, share):
        return tuple(part + share * change for part, change in zip(state, by, strict=True))

    volts = np.array([volts_above_idle(board, one) for one in words]).transpose(1, 2, 0)  # (sample, channel, place)
    state = (np.zeros(volts.shape[1:]),) * 2 + (np.zeros((modes.count, len(words))),) * 2
    step_s = board.waveform.bit_period_s / STEPS
    for held in volts:
        for _ in range(STEPS):
            first = rate(state, held)
            second = rate(moved(state, first, step_s / 2), held)
            third = rate(moved(state, second, step_s / 2), held)
            fourth = rate(moved(state, third, step_s), held)
            for by, share in ((first, 1), (second, 2), (third, 2), (fourth, 1)):
                state = moved(state, by, share * step_s / 6)
    return np.einsum("pm,mp->p", modes.shapes(places_m), state[2])
