"""The felt amplitude of `workshop/physics/felt.py`, at a light touch, as a function of the drive bits, and its derivative.

The pad's displacement is a convolution of the bits with the pad's response to a bit of each channel; the square of the felt
amplitude is quadratic in them. The derivative at some bits is linear in further ones: what matches the pad's own motion.
"""

import numpy as np

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.workshop.bank_builder.methods.exact import rounded
from controller.workshop.physics.felt import AROUND_S, LIGHT_TOUCH, SKIN_S, felt_history, pads
from controller.workshop.physics.responses.impulse_response import ResponseModel

PULL_BITS = 18  # of the derivative, so that its products with levels add up exactly


class FeltForm:
    """The felt amplitude of emissions at some places, (place, 2), each with its own."""

    def __init__(self, board: Board, model: ResponseModel, places_m: Floats) -> None:
        self._samples, self._period_s = model.samples, board.waveform.bit_period_s
        self._around = int(AROUND_S / self._period_s)
        self._length = 1 << int(np.ceil(np.log2(2 * self._samples + self._around)))  # no wave comes round again
        pulses = np.zeros((CHANNELS, self._samples, CHANNELS))
        pulses[np.arange(CHANNELS), 0, np.arange(CHANNELS)] = board.driver.supply_v
        self._spectra = []  # of each place: of its pad's response, (bin, 32)
        for place_m in places_m:
            response = pads(board, model.plate_modes, place_m, LIGHT_TOUCH, self._samples).history(pulses)[:, 0]
            self._spectra.append(np.fft.rfft(response[: self._samples + self._around], self._length, axis=0))

    def derivative(self, deviations: Floats) -> tuple[Floats, Floats]:
        """Derivative of the felt amplitude by levels above idle, (sample, place, 32), and the amplitude itself, (place,) in m.

        The derivative times the levels is the amplitude, but for its rounding.
        """
        pull, felt_m = np.empty_like(deviations), np.empty(deviations.shape[1])
        forgotten = float(np.exp(-self._period_s / SKIN_S))
        for place, spectrum in enumerate(self._spectra):
            moved = np.fft.irfft((np.fft.rfft(deviations[:, place], self._length, axis=0) * spectrum).sum(axis=1), self._length)
            moved = moved[: self._samples + self._around + 1]
            felt = felt_history(moved[:, None], self._period_s)[:, 0]
            first = max(self._samples - self._around, 0)
            last = first + int(np.argmax(felt[first:]))
            felt_m[place] = felt[last]
            ago = last - np.arange(last + 1)
            weighed = 2 * (1 - forgotten) * forgotten**ago * moved[: last + 1] / max(felt[last], 1e-300)
            matched = np.fft.irfft(np.fft.rfft(weighed, self._length)[:, None] * spectrum.conj(), self._length, axis=0)
            pull[:, place] = matched[: self._samples]
        return rounded(pull, PULL_BITS, (0, 2)), felt_m
