"""How long the waves of a board are beside those of the paper's plate, and the frequency up to which its modes are taken."""

from __future__ import annotations

from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.physics.design.design import characteristic_time_s

# On the paper's plate, in whose band's middle waves are 10.54 mm long; `wave_scale` says what they are on others
MIDDLE_HZ, WAVELENGTH_M = 45e3, 10.54e-3
ENOUGH_HZ = 100e3  # bits of a low band still excite what lies far above it: their corners pass the driver up to here
FEW_MODES = 2_200  # as many as can be computed whatever the edges


def mode_cut_hz(board: Board) -> float:
    """Frequency up to which modes are taken, for banks, foci and the twin alike.

    The upper edge of the band and three sevenths more, and up to 100 kHz as far as modes are few: modes beyond change the amplitude
    of a focus by less than 0.4 % (24 foci in bands from 1 to 400 kHz, modes up to 2.5 times this). On a floor, whose modes are not
    few, harmonics of a low band's bits are left out: 0.3 % with a driver of the band, 1.4 % with one that passes them.
    """
    few_hz = FEW_MODES / characteristic_time_s(board.plate)
    return max(board.waveform.band_high_hz * 10 / 7, min(ENOUGH_HZ, few_hz))


def wave_scale(board: Board) -> float:
    """How much longer the waves of a board are than those of the paper's plate, each in the middle of its band.

    Lengths that were found on the paper's plate go with it. Rounded to three digits: exactly one for the shipped boards.
    """
    return float(f"{bending_wavelength_m(board.plate, board.waveform.middle_hz) / WAVELENGTH_M:.3g}")
