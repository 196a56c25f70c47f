"""Modes by Mindlin's theory: each keeps its shape and its wavenumber k, and gets the frequency of a free wave with that k.

This is exact for simply supported edges; with two clamped or free ones, trial runs found it within 0.07 %.
"""

from __future__ import annotations

import numpy as np

from controller.device.board.relations.bending_waves import MindlinPlate
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.retuned import retuned


def corrected(theory: MindlinPlate, modes: Modes) -> Modes:
    """Modes by Kirchhoff's theory with the frequencies of Mindlin's; shapes and order stay."""
    wavenumber = np.sqrt(modes.angular_frequency / theory.kirchhoff)
    return retuned(modes, angular_frequency=theory.angular_frequency(wavenumber))
