"""The plate on which drive words are evaluated: what they move, what its points can have, and what they cost."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from controller.arrays import Floats, Reals, Words
from controller.device.bank.packing import channel_bits
from controller.device.board.board import Board
from controller.workshop.bank_builder.methods.dual import farthest
from controller.workshop.bank_builder.methods.prediction import Prediction
from controller.workshop.benchmark.stage.power import resistor_loss_j
from controller.workshop.physics.audible import AUDIBLE_HZ, REST_TAUS
from controller.workshop.physics.field import Field, FocusScale
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.sound import PlateSound
from controller.workshop.physics.word_capture import idle_levels, volts_above_idle

POLARITIES = 8  # sets of polarities of which the bound is computed, the most promising first
ROUGHLY = (1.0, 0.3)  # how exactly these are compared, before the best one's bound is
LARGEST_BOUND = 12  # fingers: polarities are counted out
AT_ONCE = 16  # emissions in one matrix product
CLOSE = 0.4  # frequencies that make up all others, over the inverse of an emission
BEYOND = 1.15  # how far they go, over the highest


@dataclass(frozen=True)
class Reference:
    """What the plate of a scene can give at its points."""

    alone_m: Floats  # (point,): A_ref of each point in m
    whole: Floats  # (point, sample, 32): responses of all frequencies in drive order, m per V
    unfiltered_share: Floats  # (point,): A_ref over half the supply times the sum of |h| of the unfiltered response
    # (point, sample, 32): band-limited responses, each over the sum of its absolute values: the sum of one times bits of -1 and
    # 1 is a share of what the point could get alone, in the band
    unit: Floats
    # Largest share that all points can get at once, in the band: max over polarities s of min over weights w of |sum w s
    # unit|_1
    bound: float


class PlateUnderTest:
    """A board's plate and drivers as they play: from drive words to displacements, by inner products."""

    def __init__(self, board: Board) -> None:
        self.board = board
        self.model = ResponseModel(board)
        self._scale = FocusScale.of(board)
        self._sound = PlateSound(board, self.model.plate_modes)
        self._prediction = Prediction(board, self.model)
        self._in_drive_order = np.ascontiguousarray(self.model.modal[:, ::-1], np.float32)
        self._idle_bits = idle_levels(board)

    def volts(self, words: Words) -> Floats:
        """Voltage of each channel above that at rest over the board's whole emission, (sample, 32); shorter ones start later."""
        volts = np.zeros((self.model.samples, len(self._idle_bits)))
        volts[len(volts) - len(words) :] = volts_above_idle(self.board, words)
        return volts

    def signs(self, words: Words) -> Floats:
        """Levels of the channels as -1 and 1 over the board's whole emission, (sample, 32)."""
        signs = np.tile(2 * self._idle_bits - 1, (self.model.samples, 1))
        signs[len(signs) - len(words) :] = 2.0 * channel_bits(words) - 1
        return signs

    def fields(self, volts: Floats) -> list[Field]:
        """Displacement of the whole plate at T by emissions of some voltages, (emission, sample, 32), to seven digits."""
        modal = np.empty((self.model.modes, len(volts)))
        forces = self.model.forces[:, None].astype(np.float32)
        for first in range(0, len(volts), AT_ONCE):
            some = volts[first : first + AT_ONCE].transpose(1, 2, 0).astype(np.float32)
            driven = self._in_drive_order @ some.reshape(len(some), -1)
            modal[:, first : first + AT_ONCE] = np.matmul(forces, driven.reshape(len(driven), *some.shape[1:]))[:, 0]
        plate = self.model.plate_modes, self.model.step
        return [Field.of_modal(*plate, one, self._scale) for one in np.ascontiguousarray(modal.T)]

    def reference(self, points: Sequence[tuple[float, float]]) -> Reference:
        """What this plate can give at points."""
        in_band = self.model.drive_order_responses(points, dtype=np.float64)
        whole = np.asarray(self.model.responses(points)[:, ::-1], np.float64)
        alone = np.empty(len(points))
        for index, response in enumerate(in_band):
            volts = self.volts(focus(response[None], [1.0], self.board.idle_word))
            alone[index] = np.vdot(whole[index], volts)
        most = 0.5 * self.board.driver.supply_v * np.abs(whole).sum(axis=(1, 2))
        sizes = np.abs(in_band).sum(axis=(1, 2), keepdims=True)
        unit = np.divide(in_band, sizes, out=np.zeros_like(in_band), where=sizes > 0)
        return Reference(alone, whole, alone / most, unit, bound(unit.reshape(len(points), -1)))

    def near_responses(self, place: tuple[float, float]) -> Reals:
        """As `Prediction.near_responses`."""
        return self._prediction.near_responses(place)

    def stage_heat_j(self, words: Sequence[Words]) -> Floats:
        """Heat of each emission in the series resistors of all driven channels, from the idle word and back to it, in J."""
        idle = np.array([self.board.idle_word], np.uint32)
        longest = max((len(given) for given in words), default=0)
        levels = [channel_bits(np.concatenate([np.repeat(idle, longest - len(one) + 1), one, idle])) for one in words]
        driven = np.zeros(len(self._idle_bits), bool)
        driven[[actuator.channel for actuator in self.board.actuators]] = True
        if not levels:
            return np.zeros(0)
        loss = resistor_loss_j(self.board.driver, np.stack(levels, axis=2), self.board.waveform.bit_period_s)
        heat: Floats = loss[driven].sum(axis=0)
        return heat

    def audible(self, volts: Floats) -> Floats:
        """Energy below 16 kHz, (emission,), of voltages (emission, sample, 32): `surface_energy` of `physics.audible`."""
        waves, basis, gram = self._audible_gram
        steps = np.diff(volts, axis=1, prepend=0, append=0).transpose(1, 2, 0)
        slopes = (waves @ (basis @ steps.reshape(len(steps), -1))).reshape(2, len(gram), *steps.shape[1:])
        energy: Floats = (slopes * np.matmul(gram, slopes)).sum(axis=(0, 1, 2))
        return energy

    def sound_pa2_s(self, words: Words) -> float:
        """A-weighted sound exposure at 0.3 m: `physics.sound.PlateSound.exposure_pa2_s`."""
        resting = np.full(
            self.model.samples - len(words), self.board.idle_word, np.uint32
        )  # one period for emissions of any length
        return self._sound.exposure_pa2_s(np.concatenate([resting, words]), self.board.idle_word)

    @cached_property
    def _audible_gram(self) -> tuple[Floats, Floats, Floats]:
        """What gives the channels' slopes of voltage at each frequency, and energy as a quadratic form of them.

        Cosines and sines as a product, (2 frequency, few) and (few, step): within an emission those of a few frequencies make up
        all others.
        """
        modes = self.model.plate_modes
        driver = DriverResponse.of(self.board.driver)
        slowest_s = 1 / float(np.min(-self.model.step.poles.real, initial=modes.decay_rate.min()))
        seconds = self.model.samples * self.board.waveform.bit_period_s + REST_TAUS * slowest_s
        count = int(np.ceil(AUDIBLE_HZ * seconds))
        step_hz = AUDIBLE_HZ / count
        frequency: Floats = step_hz * (np.arange(count, dtype=np.float64) + 0.5)
        s = 2j * np.pi * frequency
        passed = np.abs(driver.transfer(s)) ** 2
        gram = np.empty((count, self.model.forces.shape[1], self.model.forces.shape[1]))
        for index, at in enumerate(s):
            stiffness = modes.mass_kg * (modes.angular_frequency**2 + 2 * modes.decay_rate * at + at**2)
            weight = modes.mean_square * 2 * passed[index] / np.abs(stiffness) ** 2  # both signs of frequency
            gram[index] = self.model.forces.T @ (weight[:, None] * self.model.forces)
        few = np.arange(0, BEYOND * AUDIBLE_HZ, CLOSE / self.board.waveform.duration_s)
        times_s = np.arange(self.model.samples + 1) * self.board.waveform.bit_period_s
        waves, basis = (
            np.concatenate([np.cos(phase), np.sin(phase)]) for phase in (np.outer(f, 2 * np.pi * times_s) for f in (frequency, few))
        )
        basis = np.linalg.qr(basis.T)[0].T
        return waves @ basis.T, basis, step_hz * gram


def bound(unit: Floats) -> float:
    """Share of its own maximum that every point can get at once: max over polarities of min over weights of |sum w s h|_1.

    Its value for any weights is an upper bound for the words of these polarities.

    `unit` (point, value) are responses in the band, each over the sum of its absolute values.
    """
    count = len(unit)
    if count == 1:
        return 1.0
    alike = unit @ unit.T
    if count > LARGEST_BOUND:
        candidates = np.ones((1, count))
    else:
        signs = np.array([(1, *rest) for rest in product((1, -1), repeat=count - 1)], np.float64)
        candidates = signs[np.argsort(-np.einsum("ki,ij,kj->k", signs, alike, signs))[:POLARITIES]]
    both = np.concatenate([unit, -unit], axis=1)  # `farthest` adds up what is above zero: of both, all
    best = max(candidates, key=lambda signs: farthest(both, signs, ROUGHLY)[1])
    return farthest(both, best)[1]
