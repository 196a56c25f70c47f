"""What three banks play on drawn plates: the model's, the model's at the best bit clock, and one calibrated on each plate.

An item is a plate's number, and the tolerance that varies alone or none; its result is an array (bank, place, figure) of float64.
"""

import hashlib
import inspect
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Final, NamedTuple

import msgspec
import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats
from controller.device.bank.file_format import creator
from controller.device.board.board import Board
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.workshop.physics.design.design import characteristic_time_s
from controller.workshop.physics.field import Field, FocusScale
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.plate import wave_scale
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.word_capture import volts_above_idle
from controller.workshop.tolerance import played, tolerances
from controller.workshop.tolerance.played import PlayedPlate
from controller.workshop.tolerance.tolerances import DrawnPlate, Tolerances, draw

Words = list[NDArray[np.uint32]]
Item = tuple[int, str | None]

BANKS: Final = ("model", "clock", "calibrated")
FIGURES: Final = ("amplitude_m", "contrast", "spot_m")
MARGIN_M: Final = 20e-3  # of places from the edges, on the paper's plate; on others it goes with the wavelength
STRETCHES: Final = np.linspace(-2e-3, 2e-3, 5)  # of the bit clock, about what size, thickness and material would ask for
SEARCHED: Final = 3  # places by which it is found: all want the same
# Amplitude that the real calibration (`calibrate simulate`, `calibrate bank`) keeps, by points in a wavelength squared: mean of 30
# places on two plates that differ from the board, 150, 250 and 400 scattered points at 40 dB. Noise adds NOISE of its energy
KEPT: Final = {0.536: 0.974, 0.894: 0.992, 1.43: 0.994}
NOISE: Final = 0.08


@dataclass(frozen=True)
class Study:
    """All that determines what comes of a plate: hashable, and the function that workers compute."""

    board: Board
    tolerances: Tolerances
    seed: int = 1
    places: int = 9  # at which a plate is evaluated, drawn from the seed
    points: int = 250  # that a calibration measures
    snr_db: float = 40.0  # of its records

    def __call__(self, items: Sequence[Item]) -> list[bytes]:
        """Figures of plates, each (bank, place, figure) of float64."""
        return [self.play(draw(self.board, self.tolerances, self.seed, *item), item[0]).tobytes() for item in items]

    def name(self) -> str:
        """Hash of all that determines the results, and of the code that computes them."""
        board = self.board
        of_board = (board.plate, board.actuators, board.driver, board.waveform, board.patches, board.temperature)
        given = [*of_board, self.tolerances, self.seed, self.places, self.points, self.snr_db, creator()]
        digest = hashlib.sha256(msgspec.json.encode(given))
        for module in (played, tolerances, inspect.getmodule(Study)):
            digest.update(Path(str(getattr(module, "__file__", ""))).read_bytes())
        return digest.hexdigest()[:16]

    def play(self, drawn: DrawnPlate, number: int) -> Floats:
        """Figures of one plate: (bank, place, figure)."""
        nominal = nominal_of(self)
        on = _OnPlate(self, drawn)
        period_s = self.board.waveform.bit_period_s
        calibrated = on.calibrated_words(np.random.default_rng([self.seed, number, len(Tolerances.__struct_fields__)]))
        return np.array([
            on.figures(nominal.words, period_s),
            on.figures(nominal.words, on.best_period_s(nominal)),
            on.figures(calibrated, period_s),
        ])  # fmt: skip

    @property
    def error(self) -> float:
        """Rms error of the responses that a calibration foresees, over that of these: what would keep `KEPT` of the amplitude."""
        per_wave = self.points * _wavelength_m(self.board) ** 2 / (self.board.plate.length_m * self.board.plate.width_m)
        energies = [1 / kept**2 - 1 for kept in KEPT.values()]
        within = np.exp(np.interp(np.log(per_wave), np.log(list(KEPT)), np.log(energies)))
        return float(np.sqrt(within + NOISE * 10 ** (-self.snr_db / 10)))


class Nominal(NamedTuple):
    """What a study compares with: the board as it is designed."""

    places_m: Floats  # (place, 2)
    words: Words  # of the model's bank, for each place
    figures: Floats  # (place, figure)


@lru_cache(maxsize=2)
def nominal_of(study: Study) -> Nominal:
    """Places of a study, the words of the model's bank there, and what they do on the board's own plate."""
    board = study.board
    sides = np.array([board.plate.length_m, board.plate.width_m])
    margin = np.minimum(MARGIN_M * wave_scale(board), 0.4 * sides)
    places_m = np.random.default_rng(study.seed).uniform(margin, sides - margin, (study.places, 2))
    responses = ResponseModel(board).drive_order_responses(places_m)
    words = [focus(response[None], [1.0], board.idle_word) for response in responses]
    plain = DrawnPlate(board, np.ones(32), np.ones(32))
    return Nominal(places_m, words, _OnPlate(study, plain, places_m).figures(words, board.waveform.bit_period_s))


class _OnPlate:
    """A drawn plate, and what plays on it."""

    def __init__(self, study: Study, drawn: DrawnPlate, places_m: Floats | None = None) -> None:
        self._study, self._drawn = study, drawn
        self._modes = modes_of(drawn.board)
        self._places_m = nominal_of(study).places_m if places_m is None else places_m
        self._shapes = self._modes.shapes(self._places_m)
        self._plate = PlayedPlate.of(drawn.board, self._modes, drawn.gain, drawn.capacitance)

    def _modal(self, words: Words, period_s: float) -> Floats:
        return self._plate.modal(np.array([volts_above_idle(self._drawn.board, one) for one in words]), period_s)

    def figures(self, words: Words, period_s: float) -> Floats:
        """Amplitude in m, contrast and spot in m of each place: (place, figure)."""
        scale, found = FocusScale.of(self._study.board), []
        for place, modal in zip(self._places_m.tolist(), self._modal(words, period_s), strict=True):
            metrics = Field.of_modal(self._modes, self._plate.step, modal, scale).focus_metrics(*place)
            contrast = metrics.contrast if np.isfinite(metrics.contrast) else 0.0  # of a plate that nothing moves
            found.append((metrics.amplitude_m, contrast, metrics.spot_m))
        return np.array(found)

    def best_period_s(self, nominal: Nominal) -> float:
        """Bit period at which the model's words move some places most, over what they move on the board's own plate.

        Looked for about that at which the modes of both plates come in the same order: their number per hertz.
        """
        expected = characteristic_time_s(self._drawn.board.plate) / characteristic_time_s(self._study.board.plate)
        periods_s = self._study.board.waveform.bit_period_s * expected * (1 + STRETCHES)
        words, shapes, design_m = nominal.words[:SEARCHED], self._shapes[:SEARCHED], nominal.figures[:SEARCHED, 0]
        moved_m = np.array([np.einsum("pm,pm->p", shapes, self._modal(words, period_s)) for period_s in periods_s])
        shares = (moved_m / design_m).mean(axis=1)
        top = min(max(int(np.argmax(shares)), 1), len(shares) - 2)
        before, at, after = shares[top - 1 : top + 2]
        curvature = before - 2 * at + after
        offset = float(np.clip(0.5 * (before - after) / curvature, -1, 1)) if curvature < 0 else 0.0
        return float(periods_s[top] + offset * (periods_s[1] - periods_s[0]))

    def calibrated_words(self, random: np.random.Generator) -> Words:
        """Words of a bank from measurements of this plate: by its responses, with an error of the study's size.

        Most of the error is of interpolation, which is as long and has the spectrum of a response at another place.
        """
        board, drawn = self._study.board, self._drawn
        model = ResponseModel(drawn.board, modes=self._modes)
        responses = self._through_own_stages(np.asarray(model.drive_order_responses(self._places_m), np.float64))
        elsewhere = np.roll(responses, 1, axis=0) * random.choice((-1.0, 1.0), (len(responses), 1, 1))
        sizes = np.sqrt((responses**2).mean(axis=(1, 2), keepdims=True))
        foreseen = responses + self._study.error * sizes * elsewhere / np.roll(sizes, 1, axis=0)
        foreseen[:, :, drawn.gain == 0] = 0
        return [focus(response[None], [1.0], board.idle_word) for response in foreseen]

    def _through_own_stages(self, in_drive_order: Floats) -> Floats:
        """Responses by the board's stage, (place, sample, 32), as the stage of each channel makes them."""
        drawn, samples = self._drawn, in_drive_order.shape[1]
        s = 2j * np.pi * np.fft.rfftfreq(2 * samples, drawn.board.waveform.bit_period_s)
        driver = drawn.board.driver
        own = DriverResponse.of(driver).transfer(s)
        ratio = np.ones((len(s), 32), np.complex128)
        for channel, share in enumerate(drawn.capacitance.tolist()):
            if share != 1:
                changed = msgspec.structs.replace(driver, capacitance_f=driver.capacitance_f * share)
                ratio[:, channel] = DriverResponse.of(changed).transfer(s) / own
        spectra = np.fft.rfft(in_drive_order[:, ::-1], 2 * samples, axis=1) * ratio
        return np.fft.irfft(spectra, 2 * samples, axis=1)[:, samples - 1 :: -1]


def _wavelength_m(board: Board) -> float:
    return bending_wavelength_m(board.plate, board.waveform.middle_hz)
