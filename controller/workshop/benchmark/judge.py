"""Errors of drive words on a plate: the full field of all modes in float64, whatever responses the words were made from.

The displacement of each mode at T is an inner product of the bits with the mode's own response, so words are evaluated without a
bank and without the responses that made them. The reference of a point, A_ref, is what the sign of its own band-limited
response gives there.
"""

from collections.abc import Iterable, Sequence

import msgspec
import numpy as np

from controller.arrays import Floats, Words
from controller.device.board.board import Board
from controller.workshop.benchmark.fingers_scenes import FingerScene
from controller.workshop.benchmark.plate_under_test import PlateUnderTest
from controller.workshop.physics.felt import felt_by_all_um
from controller.workshop.physics.field import Field

Errors = dict[str, float]

STILL_M = 1e-12  # far below what a focus gives


class Judge:
    """Errors of drive words. `detunings` are ratios of modal frequencies for which scenes ask."""

    def __init__(self, board: Board, detunings: Iterable[float] = (1.0,)) -> None:
        self.board = board
        self._plates = {ratio: PlateUnderTest(detuned(board, ratio)) for ratio in {1.0, *detunings}}

    @property
    def modes_in_band(self) -> int:
        """Modes within the waveform's band."""
        frequency_hz = self._plates[1.0].model.plate_modes.angular_frequency / (2 * np.pi)
        waveform = self.board.waveform
        return int(((frequency_hz >= waveform.band_low_hz) & (frequency_hz <= waveform.band_high_hz)).sum())

    @property
    def modes(self) -> int:
        """Modes in the full field."""
        return self._plates[1.0].model.modes

    def errors(self, scene: FingerScene, words: Sequence[Words], free_polarity: Sequence[bool]) -> list[Errors]:
        """Evaluate drive words (sample,) of one scene by several methods; an emission shorter than the board's starts later.

        `free_polarity`: whether a method may kick downwards. Figures: `loss`: 1 - A / A_ref, mean over the points.
        `worst_loss`: that of the worst one. `bound_loss`: 1 - share of the worst one in the band over the bound of all words.
        `best_loss`: 1 - A / A_ref of the worst one over the best that any of `words` reaches. `felt_um`, with a light touch
        on each point and on the finger that shall feel nothing: felt amplitude (`physics.felt`) of the one that feels least;
        `felt_loss`: 1 - this over the most by any of `words`; `felt_crosstalk`: what the finger feels that shall feel
        nothing, over it. `amplitude_over_unfiltered`: A over half the supply times sum |h|, mean. `quiet`: largest
        displacement of the finger that shall feel nothing within 25 us of T, over the mean |A|. `contrast`: of the worst
        point, over the rms outside 10 mm of all. `audible_m2_per_s`: energy below 16 kHz (`physics.audible`), `sound_pa2_s`:
        what is heard (`physics.sound`). `crest_m`: distance of the crest, largest of the points. `stage_j`: heat in the
        drivers' series resistors.
        """
        plate = self._plates[scene.detuning]
        reference = plate.reference(scene.points)
        volts = np.stack([plate.volts(given) for given in words])
        signs = np.stack([plate.signs(given) for given in words])
        amplitudes, shares, quiet = (
            np.tensordot(played, rows, ((1, 2), (1, 2)))
            for played, rows in ((volts, reference.whole), (signs, reference.unit), (volts, plate.near_responses(scene.null)))
        )
        one_way = ~np.array(free_polarity)[:, None]  # what is kicked downwards then counts below zero
        kicked, in_band = (np.where(one_way, kicks, np.abs(kicks)) for kicks in (amplitudes, shares))
        share = kicked / reference.alone_m
        *meant_um, null_um = felt_by_all_um(plate.board, plate.model.plate_modes, volts, [*scene.points, scene.null]).T
        felt_um = np.min(meant_um, axis=0)
        mean_m = np.maximum(np.abs(amplitudes).mean(axis=1), STILL_M)
        fields = plate.fields(volts)
        figures = {
            "loss": 1 - share.mean(axis=1),
            "worst_loss": 1 - share.min(axis=1),
            "bound_loss": 1 - in_band.min(axis=1) / reference.bound,
            "best_loss": _lost(share.min(axis=1)),
            "felt_um": felt_um,
            "felt_loss": _lost(felt_um),
            "felt_crosstalk": null_um / np.maximum(felt_um, STILL_M * 1e6),
            "amplitude_over_unfiltered": (share * reference.unfiltered_share).mean(axis=1),
            "quiet": np.abs(quiet).max(axis=1) / mean_m,
            "contrast": _contrasts(fields, scene, amplitudes),
            "audible_m2_per_s": plate.audible(volts),
            "sound_pa2_s": [plate.sound_pa2_s(given) for given in words],
            "crest_m": [max(_crest_m(field, point) for point in scene.points) for field in fields],
            "stage_j": plate.stage_heat_j(words),
        }
        return [{name: float(values[index]) for name, values in figures.items()} for index in range(len(words))]


def _lost(reached: Floats) -> Floats:
    """1 - what each reaches over what the best does."""
    most = float(reached.max(initial=0.0))
    return 1 - reached / most if most > 0 else np.ones_like(reached)


def detuned(board: Board, ratio: float) -> Board:
    """The same board with all modal frequencies multiplied by `ratio`."""
    if ratio == 1:
        return board
    stiffer = board.plate.with_stiffness(ratio**2)
    return msgspec.structs.replace(board, plate=stiffer)


def _contrasts(fields: Sequence[Field], scene: FingerScene, amplitudes: Floats) -> list[float]:
    """Of the weakest point, over the rms outside 10 mm of all."""
    maps = [field.map() for field in fields]
    outside = np.ones(maps[0][2].shape, np.bool_)
    for x_m, y_m in scene.points:
        outside &= np.hypot(maps[0][0] - x_m, (maps[0][1] - y_m)[:, None]) > fields[0].scale.outside_m
    rms = [float(np.sqrt((u[outside] ** 2).mean())) if outside.any() else 0.0 for *_, u in maps]
    return [float(weakest) / one if one else 0.0 for weakest, one in zip(np.abs(amplitudes).min(axis=1), rms, strict=True)]


def _crest_m(field: Field, point: tuple[float, float]) -> float:
    x_m, y_m = field.crest(*point)
    return float(np.hypot(x_m - point[0], y_m - point[1]))
