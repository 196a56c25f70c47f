"""Reference for loads on a plate: they stand in the plate's own matrices, and its motion is stepped in time."""

import numpy as np
from scipy.linalg import expm

from controller.device.bank.packing import channel_bits
from controller.workshop.physics.responses.step_response import channel_forces


def stepped(board, modes, words, shapes, fingers, after):
    """Displacement, (bit period, place) in m, at the starts of all words and of `after` bit periods from T on.

    `shapes` (place, mode) are those at points, or means over pads; `fingers` go by the number of the place. Their mass, damping and
    stiffness are in the plate's own matrices (the mass matrix is then no longer diagonal), drivers are circuits, steps exact.
    """
    shapes = np.asarray(shapes)
    mass, damping, stiffness = (
        np.diag(d) for d in (modes.mass_kg, 2 * modes.mass_kg * modes.decay_rate, modes.mass_kg * modes.angular_frequency**2)
    )
    for at, finger in fingers.items():
        dyad = np.outer(shapes[at], shapes[at])
        mass = mass + finger.mass_kg * dyad
        damping = damping + finger.damping_n_s_m * dyad
        stiffness = stiffness + finger.stiffness_n_m * dyad
    driver, n, q = board.driver, modes.count, 32
    forces = np.linalg.solve(mass, channel_forces(board, modes))
    gain = 1 / (driver.inductance_h * driver.capacitance_f)
    zero, one = np.zeros, np.eye
    state = np.block(
        [
            [zero((n, n)), one(n), zero((n, 2 * q))],
            [-np.linalg.solve(mass, stiffness), -np.linalg.solve(mass, damping), forces, zero((n, q))],
            [zero((q, 2 * n + q)), one(q)],
            [zero((q, 2 * n)), -gain * one(q), -driver.resistance_ohm / driver.inductance_h * one(q)],
        ]
    )
    given = np.vstack([zero((2 * n + q, q)), gain * one(q)])
    both = expm(np.block([[state, given], [zero((q, len(state) + q))]]) * board.waveform.bit_period_s)
    over, drive = both[: len(state), : len(state)], both[: len(state), len(state) :]
    idle = channel_bits(np.array([board.idle_word], "<u4")).astype(float)
    volts = (channel_bits(words.astype("<u4")) - idle) * driver.supply_v
    now, found = zero(len(state)), []
    for played in [*volts, *zero((after, q))]:
        found.append(shapes @ now[:n])
        now = over @ now + drive @ played
    return np.array(found)
