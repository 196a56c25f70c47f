"""Heat in the series resistor of a stage for each edge of its output, and how much of a frequency the stage passes to the piezo.

The resistor, the inductance and the piezo's capacitance are a low-pass of second order (paper, fig. 4). An isolated edge burns
C V^2 / 2; one that comes while the piezo still rings against it burns more.
"""

from __future__ import annotations

import math

from controller.device.board.panel import Driver


def half_charge_j(driver: Driver) -> float:
    """Loss of an isolated edge: C V^2 / 2, in J."""
    return driver.capacitance_f * driver.supply_v**2 / 2


def worst_edge_j(driver: Driver) -> float:
    """Return an upper bound of the average loss per edge, over all waveforms, in J.

    The piezo's deviation from a step is largest at multiples of half its damped period, with alternating sign: a
    square wave with that half period maximises the sum. An overdamped driver does not ring: `C V^2 / 2`.
    """
    decay_per_s = driver.resistance_ohm / (2 * driver.inductance_h)
    ringing_square = 1 / (driver.inductance_h * driver.capacitance_f) - decay_per_s**2
    if ringing_square <= 1e-18 * decay_per_s**2:
        return half_charge_j(driver)
    ringing = math.exp(-math.pi * decay_per_s / math.sqrt(ringing_square))
    return half_charge_j(driver) * (1 + ringing) / (1 - ringing)


def passed(driver: Driver, frequency_hz: float) -> float:
    """Voltage of the piezo over that of the stage, at one frequency."""
    angular = 2 * math.pi * frequency_hz
    real = 1 - angular**2 * driver.inductance_h * driver.capacitance_f
    return 1 / math.hypot(real, angular * driver.resistance_ohm * driver.capacitance_f)
