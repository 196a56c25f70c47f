"""What each method of finding drive words buys on a board's plate: `haptic-panel bank choices --methods`.

Foci at random places, played on the plate twin, beside the board's own words at the same places. "Off": all frequencies of the
plate are 0.5 % higher, or lower, whichever is worse.
"""

from collections.abc import Callable, Sequence
from typing import Any, Final

import msgspec
import numpy as np

from controller.arrays import Floats, Words
from controller.device.bank.packing import channel_bits, framed
from controller.device.board.board import Board
from controller.device.board.panel import AssumedFinger
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.methods.descent import Descent
from controller.workshop.benchmark.focus.focus_figures import emit, random_points
from controller.workshop.benchmark.stage.power import resistor_loss_j
from controller.workshop.physics.audible import surface_energy
from controller.workshop.physics.felt import LIGHT_TOUCH, ONE_NEWTON, felt_by_motion_um, pads
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.modes.retuned import drifted
from controller.workshop.physics.pad_motion import PadMotion
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.sound import PlateSound, decibels
from controller.workshop.physics.word_capture import volts_above_idle

OFF: Final = 0.005
OWN: Final = "as board.toml"
FINGER: Final = {"finger": AssumedFinger()}
BARE: Final = {"slope": 0.0, "drift_percent": 0.0}
BOARDS: Final[dict[str, tuple[dict[str, Any], dict[str, Any]]]] = {  # keys of the board, and of [waveform]; all else is the paper's
    "the paper's": ({}, {}),
    "[finger]": (FINGER, {}),
    "slope = -1": ({}, {"slope": -1.0}),
    "slope = 1": ({}, {"slope": 1.0}),
    "drift_percent = 0.3": ({}, {"drift_percent": 0.3}),
    "drift_percent = 0.4": ({}, {"drift_percent": 0.4}),
    "slope = -1, drift_percent = 0.3": ({}, {"slope": -1.0, "drift_percent": 0.3}),
    "[finger], drift_percent = 0.3": (FINGER, {"drift_percent": 0.3}),
}
OPTIMISED: Final = {f"--optimise {name}": aim for name, aim in AIMS.items()}
METHODS: Final = (OWN, *BOARDS, *OPTIMISED)
COLUMNS: Final = {  # what is relative to the board's own words, as a quotient or in dB, is said so
    "amplitude": "over",
    "off by 0.5 %": "over",
    "light touch": "over",
    "1 N": "over",
    "contrast": "",
    "spot mm": "",
    "edges": "over",
    "heat": "over",
    "below 16 kHz dB": "dB",
    "dB(A)": "dB",
}


class MethodTrial:
    """Words of any method at some places of a board's plate, and what they do there."""

    def __init__(self, board: Board, seed: int, count: int) -> None:
        self.board, self.places_m = board, random_points(board, seed, count)
        self._twin = PlateTwin(board)
        modes = self._twin.modes
        self._off = [PlateTwin(board, modes=drifted(modes, off)) for off in (OFF, -OFF)]
        self._sound = PlateSound(board, modes)
        samples = board.waveform.samples
        self._pads = [[pads(board, modes, place, load, samples) for load in (LIGHT_TOUCH, ONE_NEWTON)] for place in self.places_m]
        self._bare: ResponseModel | None = None  # whose words are optimised
        self._descent: Descent | None = None  # one of them, whose forms the others share

    def figures(self, method: str) -> Floats:
        """Of each place: um, um off, um felt, um felt, contrast, mm, edges, J, dB, dB; in the order of `COLUMNS`."""
        places = zip(self._words(method), self.places_m, self._pads, strict=True)
        return np.array([self._figures(words, place_m, fingers) for words, place_m, fingers in places])

    def _words(self, method: str) -> Sequence[Words]:
        keys, of_waveform = ({}, {}) if method == OWN else BOARDS.get(method, ({}, {}))
        board, modes = self.board, self._twin.modes
        if method != OWN:
            waveform = msgspec.structs.replace(board.waveform, **{**BARE, **of_waveform})
            board = msgspec.structs.replace(board, waveform=waveform, **{"finger": None, **keys})
        if method in OPTIMISED:  # all of the same board
            self._bare = self._bare or ResponseModel(board, modes=modes)
            self._descent = Descent(board, self._bare, OPTIMISED[method], self._descent)
            return list(self._descent.entries(self.places_m))
        twin = PlateTwin(board, modes=modes)
        responses = (twin.words_source.drive_order_responses([place], dtype=np.float64) for place in self.places_m)
        return [focus(one, [1.0], board.idle_word) for one in responses]

    def _figures(self, words: Words, place_m: Floats, fingers: Sequence[PadMotion]) -> list[float]:
        board = self.board
        found = emit(self._twin, words).focus_metrics(*place_m.tolist())
        off_m = min(float(emit(twin, words).at(place_m)[0]) for twin in self._off)
        volts = volts_above_idle(board, words)[None]
        levels = channel_bits(framed(board.idle_word, words, board.idle_word)).astype(np.int8)
        felt = (float(felt_by_motion_um(one, volts, board.waveform.bit_period_s)[0, 0]) for one in fingers)
        return [
            *(found.amplitude_m * 1e6, off_m * 1e6, *felt, found.contrast, found.spot_m * 1e3),
            float(np.abs(np.diff(levels, axis=0)).sum()),
            float(resistor_loss_j(board.driver, levels, board.waveform.bit_period_s).sum()),
            decibels(surface_energy(board, words, board.idle_word, modes=self._twin.modes)),
            decibels(self._sound.exposure_pa2_s(words, board.idle_word)),
        ]


def method_figures(
    board: Board,
    count: int,  # places
    seed: int = 1,
    methods: Sequence[str] = METHODS,
    progress: Callable[[int, int], None] = lambda _done, _total: None,  # called with the methods done and all of them
) -> dict[str, dict[str, float]]:
    """Medians of each method by `COLUMNS`; but contrast and spot they are relative to the board's own words at the same place."""
    trial = MethodTrial(board, seed, count)
    own = trial.figures(OWN)
    own_over = own.copy()
    own_over[:, 1] = own[:, 0]  # what is left on a plate that is off is a share of what is there on the right one
    rows = {}
    for done, method in enumerate(methods, 1):
        found = own if method == OWN else trial.figures(method)
        rows[method] = {
            name: float(np.median(_relative(found[:, index], own_over[:, index], how)))
            for index, (name, how) in enumerate(COLUMNS.items())
        }
        progress(done, len(methods))
    return rows


def _relative(found: Floats, own: Floats, how: str) -> Floats:
    return found / own if how == "over" else found - own if how == "dB" else found
