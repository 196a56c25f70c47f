"""From responses to drive words, in floating point and for any number of points.

The sign of a response reversed in time is the waveform of two levels with the largest displacement
at T (paper, section III-A). For several points the weighted responses are summed before the sign is
taken: summing waveforms of signs would lose amplitude. A kick is felt either way, so the polarities of
points that are composed together are free.
"""

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats, Reals
from controller.device.bank.packing import drive_words

BALANCING_ROUNDS = 20
BALANCED = 1e-3  # spread of the shares, over their mean, at which weights are taken as they are


def balanced_weights(responses: Reals) -> Floats:
    """Weights of free sign with which all points get the same share of what each would get alone.

    Of all polarities those with the largest energy of the sum are taken (`s' G s`, G: inner products of the responses), with
    more positive points than negative ones. Balanced weights are then the smallest `sum |sum w h|`, which is the largest share
    that the worst point can have with these polarities.

    `responses` (point, sample, channel) are band-limited, in drive order, of 1 to about 12 points. Weights (point,) are relative to
    the sum of the absolute values of the point's response; 0 for one that is zero throughout.
    """
    flat = responses.reshape(len(responses), -1)
    sizes = np.abs(flat).sum(axis=1)
    each = np.divide(1, sizes, out=np.zeros_like(sizes), where=sizes > 0)  # at the plate's edge nothing can move
    signs = np.array([(1, *rest) for rest in itertools.product((1, -1), repeat=len(flat) - 1)], float)
    gram = (flat @ flat.T) * np.outer(each, each)
    best = signs[np.argmax(np.einsum("ki,ij,kj->k", signs, gram, signs))]
    each *= best if 2 * np.count_nonzero(best < 0) <= len(best) else -best
    weights = np.ones(len(flat))
    moving = each != 0
    for _ in range(BALANCING_ROUNDS if len(flat) > 1 else 0):
        shares = (flat @ np.sign((weights * each) @ flat) * each)[moving]
        if not shares.size or np.ptp(shares) <= BALANCED * abs(shares.mean()):
            break
        weights[moving] *= np.clip(shares.mean() / np.where(shares > 0, shares, np.inf), 0.5, 2)
    balanced: Floats = weights * each
    return balanced


def focus(responses: Reals, weights: Sequence[float], idle_word: int) -> NDArray[np.uint32]:
    """Drive words that focus on one or several points at the end of the emission.

    `responses` (point, sample, channel) are band-limited, in drive order (`ResponseModel.drive_order_responses`), m per V. Each
    point has a weight; a negative one pushes the other way. Bits of `idle_word` are played where the sum is exactly zero. Returns
    (sample,), or (sample, FPGA). Raises ValueError if there is no point, or not one finite weight for each.
    """
    if responses.ndim != 3 or len(responses) == 0 or len(weights) != len(responses):
        raise ValueError(f"{len(weights)} weights do not fit responses of shape {responses.shape}")
    return drive_words(np.tensordot(np.asarray(weights, responses.dtype), responses, 1), idle_word)
