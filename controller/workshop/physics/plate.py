"""How long the waves of a board are, up to which frequency its modes are taken, and what interpolation between cells loses."""

import math

from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.kernel import LARGEST_EQUALISER
from controller.device.waveforms.composition import EQUALISER_S
from controller.workshop.physics.design.design import characteristic_time_s

# On the paper's plate, in whose band's middle waves are 10.54 mm long; `wave_scale` says what they are on others
MIDDLE_HZ, WAVELENGTH_M = 45e3, 10.54e-3
ENOUGH_HZ = 100e3  # bits of a low band still excite what lies far above it: their corners pass the driver up to here
FEW_MODES = 2_200  # as many as can be computed whatever the edges
LEAST_TILT = 1.0  # of an equaliser


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


def equaliser(board: Board, pitch_m: float) -> float:
    """What a bank's `equaliser` is: the share of a response's neighbours, 8 us away, that gives back what interpolation takes.

    Interpolated between cells, a wave of number k keeps 1 - (k pitch)^2 a / 4 on average over its directions, `a` as
    `bank_twin` has it: the less, the higher its frequency f, since k^2 goes with f. Three taps, 1 - 2 share a cos(2 pi f 8 us), go
    the other way in the middle of a band between 15 and 58 kHz; elsewhere there is none.
    """
    turned = 2 * math.pi * board.waveform.middle_hz * EQUALISER_S
    tilt = 2 * turned * math.sin(turned)
    return float(f"{min(_taken(board, pitch_m) / tilt, LARGEST_EQUALISER):.3g}") if tilt > LEAST_TILT else 0.0


def band_lost(board: Board, pitch_m: float) -> float:
    """What a bank's `band_lost` is: `lost_between`, by which the rest is weighed less.

    With a slope, what a response leaves out lies in the band too and loses there as well: half of it is right for slopes of -1,
    -0.5 and 1, to 1 % of the displacement.
    """
    return float(f"{lost_between(board, pitch_m) / (2 if board.waveform.slope else 1):.3g}")


def lost_between(board: Board, pitch_m: float) -> float:
    """What interpolation takes from the middle of the band in spite of the equaliser, over `a`.

    As it is in the middle of a cell; elsewhere it goes with `a` to 0.5 % (50 places).
    """
    turned, a = 2 * math.pi * board.waveform.middle_hz * EQUALISER_S, 0.5
    taken = _taken(board, pitch_m) * a
    kept = (1 - taken + taken**2 / 4) * (1 - 2 * equaliser(board, pitch_m) * a * math.cos(turned))
    return min(max((1 - kept) / a, 0.0), 1.0)


def _taken(board: Board, pitch_m: float) -> float:
    return (2 * math.pi * pitch_m / bending_wavelength_m(board.plate, board.waveform.middle_hz)) ** 2 / 4
