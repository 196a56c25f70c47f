"""The device's composition as a `DesignMethod`: for benchmarks and banks, not for the loop, which uses `Composer` as it is."""

from collections.abc import Sequence

import numpy as np

from controller.arrays import Reals
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.bank.packing import CHANNELS, WORD, channel_bits
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.kernel import Point
from controller.device.waveforms.composition import Composer
from controller.workshop.bank_builder.methods.design import Place, WaveformDesign
from controller.workshop.physics.word_capture import idle_levels

NEAR_S = 25e-6  # a null is evaluated this long before and after T


class DeviceComposition:
    """Any points at any amplitude, and nulls; what it expects is what the bank knows."""

    name = "device composition"

    def __init__(self, board: Board, bank: Bank) -> None:
        self._composer = Composer(bank, board.idle_word)
        self._bank = bank
        self._idle_bits, self._supply_v = idle_levels(board), board.driver.supply_v
        self._near_samples = round(NEAR_S / board.waveform.bit_period_s)

    def design(self, points: Sequence[Point], nulls: Sequence[Place] = ()) -> WaveformDesign:
        """As `DesignMethod.design`; raises BankError if a cell that a point needs is not in the bank, or damaged."""
        words = np.frombuffer(self._composer.compose(points), WORD)
        if nulls:
            self._composer.keep_still(points, [(x_m, y_m, 1.0) for x_m, y_m in nulls])
        words = words.copy()
        volts = (channel_bits(words) - self._idle_bits) * self._supply_v
        reached_m = np.array([np.sum(self._response(x_m, y_m) * volts) for x_m, y_m, _ in points])
        return WaveformDesign(words, reached_m, np.array([self._most_near(self._response(*place), volts) for place in nulls]))

    def _response(self, x_m: float, y_m: float) -> Reals:
        """All that a bit does at a place, in the band and outside it, (sample, 32): interpolated as the composer does.

        Between cells waves of the corners cancel in part; the size of the response is interpolated by itself.
        """
        entries, scales, _ = self._bank.responses.tables()
        samples, stride = self._bank.samples, self._bank.sections["response"].stride
        rows = samples + self._bank.header.rest_rows
        in_band, outside, size = np.zeros((samples, CHANNELS)), np.zeros((samples, CHANNELS)), 0.0
        for cell, share in zip(*self._bank.grid.corners(x_m, y_m), strict=True):
            if share:
                self._bank.responses.check(cell)
                entry = entries[cell]
                levels = np.frombuffer(self._bank.responses.section, np.int8, rows * CHANNELS, entry * stride).reshape(
                    rows, CHANNELS
                )
                response = scales[entry] * levels[:samples].astype(np.float64)
                in_band += share * response
                outside += share * scales[entry] * np.repeat(levels[samples:], REST_SAMPLES, axis=0)[:samples]
                size += share * float(np.abs(response).sum())
        return in_band * (size / (float(np.abs(in_band).sum()) or 1.0)) + outside

    def _most_near(self, response: Reals, volts: Reals) -> float:
        """Largest absolute displacement within `NEAR_S` of T."""
        near, end = self._near_samples, len(volts)
        found = []
        for by in range(-near, near + 1):  # so much later a sample does what one played so much later does at T
            met = response[max(-by, 0) : end - max(by, 0)] * volts[max(by, 0) : end - max(-by, 0)]
            found.append(abs(float(met.sum())))
        return max(found)
