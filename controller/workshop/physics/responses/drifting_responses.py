"""Mean responses of plates whose frequencies are some percent higher and lower: words for a plate whose temperature is not known.

A plate whose frequencies are all higher by a share e does the same in 1 / (1 + e) of the time, and yields less: its response is the
plate's own at (1 + e) t, over 1 + e. That needs no model: measured responses are treated as modelled ones. Decay, driver, the
band's edges and a finger are scaled with it, by as little. The mean of both fades what comes early in an emission, where nobody
knows its phase, and turns it round beyond a quarter of a period.

Between samples a response is interpolated by a sinc in a window of `REACH` samples on each side; of the higher plate the last
samples, e of them all, are beyond what is known and left zero.
"""

import numpy as np
from numpy.typing import ArrayLike

from controller.arrays import Floats, Reals
from controller.workshop.physics.responses.response_source import ResponseSource
from controller.workshop.physics.responses.transformed_responses import TransformedResponses

REACH = 16
KAISER = 8.0


class DriftingResponses(TransformedResponses):
    """A `ResponseSource`: the mean of another's at frequencies `percent` higher and lower."""

    def __init__(self, source: ResponseSource, percent: float) -> None:
        super().__init__(source, f"the mean of frequencies {percent:g} % off")
        self._share = percent / 100
        self._means: dict[tuple[int, str], Reals] = {}

    def _transform(self, free: Reals, points_m: ArrayLike, period_s: float) -> None:
        del points_m, period_s  # all alike: time is counted in samples
        key = free.shape[1], free.dtype.str
        if key not in self._means:
            both = resampling(key[0], 1 + self._share) + resampling(key[0], 1 - self._share)
            self._means[key] = (both / 2).astype(free.dtype)
        for response in free:
            response[:] = self._means[key] @ response


def resampling(samples: int, higher: float) -> Floats:
    """What makes responses of a plate whose frequencies are `higher` times as high: (sample, sample).

    Sample j is of a pulse of one bit period that began j + 1 periods before, half of one before its middle.
    """
    since = np.arange(samples) + 0.5
    apart = since[:, None] * higher - since
    window = np.i0(KAISER * np.sqrt(np.maximum(1 - (apart / REACH) ** 2, 0))) / np.i0(KAISER)
    found: Floats = np.where(np.abs(apart) < REACH, np.sinc(apart) * window / higher, 0)
    found[since * higher > samples] = 0
    return found
