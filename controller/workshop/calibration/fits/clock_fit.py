"""The bit clock at which the model's words suit a plate best: from a few measured points, far fewer than a bank takes.

Tolerances of thickness, modulus and density stretch the time of all responses by one factor, and do little else. A model whose
frequencies are all scaled has the same words at another bit clock.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from controller.device.board.board import Board
from controller.errors import CalibrationError
from controller.workshop.calibration.fits.drift_fit import GROUPS, stretch
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.physics.responses.impulse_response import ResponseModel

WIDEST: Final = 0.05  # frequencies off by more: what is built is not what is described
LEAST_ALIKE: Final = 0.5  # correlation at the best clock: below, another clock does not make the model's words good
RECORDS: Final = 512  # at most


@dataclass(frozen=True)
class FittedClock:
    """How fast a plate is, over its board's model."""

    ratio: float  # of frequencies, and of the bit clock
    error: float  # standard deviation
    alike: float  # correlation of measured and modelled responses at that bit clock
    alike_before: float  # at the board's own
    points: int
    bit_clock_hz: float
    young_modulus_pa: float  # that gives the model these frequencies

    def figures(self) -> dict[str, Any]:
        """Ready for JSON."""
        return {
            "points": self.points,
            "frequency_ratio": [round(self.ratio, 6), round(self.error, 6)],
            "alike": round(self.alike, 4),
            "alike_before": round(self.alike_before, 4),
            "bit_clock_hz": round(self.bit_clock_hz, 1),
            "young_modulus_pa": round(self.young_modulus_pa, -6),
        }


def fit_clock(board: Board, learned: LearnedResponses) -> FittedClock:
    """Compare measured responses with those of the board's model at the same points.

    Raises CalibrationError if there are too few, or no bit clock within 5 % makes them alike: edges, theory or channels are others.
    """
    pairs = np.argwhere(learned.known)
    if len(pairs) < GROUPS:
        raise CalibrationError(f"{len(pairs)} responses are known of {len(learned.points_m)} points: {GROUPS} or more are needed")
    chosen = np.random.default_rng(1).permutation(pairs)[:RECORDS]
    modelled = ResponseModel(board).responses(learned.points_m)
    samples = min(modelled.shape[1], learned.responses.shape[1])
    before, after = (responses[chosen[:, 0], :samples, chosen[:, 1]] for responses in (modelled, learned.responses))
    found = stretch(board, before, after, WIDEST)
    if found.alike < LEAST_ALIKE:
        raise CalibrationError(
            f"no bit clock within {WIDEST:.0%} makes the board's model alike to the plate ({found.alike:.2f} at best,"
            f" {LEAST_ALIKE:g} are needed): its edges, theory, patches or channels are others; measure it for a bank"
        )
    return FittedClock(
        found.ratio,
        found.error,
        found.alike,
        found.alike_before,
        len(learned.points_m),
        board.waveform.bit_clock_hz * found.ratio,
        board.plate.young_modulus_pa * found.ratio**2,
    )
