"""From responses to drive words, in floating point and for any number of points.

The sign of a response reversed in time is the waveform of two levels with the largest displacement
at T (paper, section III-A). For several points the weighted responses are summed before the sign is
taken: summing waveforms of signs would lose amplitude.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from controller.bank.packing import drive_words


def focus(responses: NDArray[np.floating[Any]], weights: Sequence[float], idle_word: int) -> NDArray[np.uint32]:
    """Drive words that focus on one or several points at the end of the emission.

    Parameters
    ----------
    responses : (point, sample, 32) array
        Band-limited, in drive order (`ResponseModel.drive_order_responses`), m per V.
    weights : sequence of float
        One for each point; a negative one pushes the other way.
    idle_word : int
        Bits played where the sum is exactly zero.

    Returns
    -------
    (sample,) uint32 array

    Raises
    ------
    ValueError
        If there is no point, or not one finite weight for each.
    """
    if responses.ndim != 3 or len(responses) == 0 or len(weights) != len(responses):
        raise ValueError(f"{len(weights)} weights do not fit responses of shape {responses.shape}")
    return drive_words(np.tensordot(np.asarray(weights, responses.dtype), responses, 1), idle_word)
