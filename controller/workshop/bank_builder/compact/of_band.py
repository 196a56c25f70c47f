"""What a slope leaves out within the band, made of the band: by two taps for all places. Cells say nothing of it."""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from controller.arrays import Floats, Reals
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.board.panel import Waveform
from controller.device.kernel import compact_twin
from controller.device.kernel.compact_twin import OfBand

WHOLE: Final = 1 << compact_twin.TAP_BITS


def of_band(waveform: Waveform, in_band: Floats, rest: Floats) -> OfBand:
    """Taps that leave the least of the rest (response, row, 32) between the band's ends; zeros without a slope."""
    if not waveform.slope:
        return OfBand()
    # A quarter of the middle wave from the row's own middle: what is added falls through the band, and is zero in the middle of it
    apart = max(round(waveform.bit_clock_hz / waveform.middle_hz / 4 - 0.5), 1)
    hz = np.fft.rfftfreq(rest.shape[1], waveform.bit_period_s * REST_SAMPLES)
    inside = (hz > waveform.band_low_hz) & (hz < waveform.band_high_hz)
    own, outer, wanted = (np.fft.rfft(one, axis=1)[:, inside].ravel() for one in (*OfBand(apart).pairs(in_band), rest))
    met = np.stack([own, outer])
    taps = WHOLE * np.linalg.lstsq((met.conj() @ met.T).real, (met.conj() @ wanted).real)[0]
    largest, together = np.abs(taps).max(), np.abs(taps).sum()
    taps *= min(1.0, (WHOLE / 2 - 1) / max(largest, 1.0), (compact_twin.LARGEST_OF_BAND - 1) / max(together, 1.0))
    return OfBand(apart, *np.rint(taps).astype(int).tolist())


def without(made: OfBand, responses: Reals, samples: int) -> NDArray[Any]:
    """Rests (response, row, 32) of entries (response, sample and row, 32), less what is made of the band."""
    rest = responses[:, samples:]
    if not made.there:
        return rest
    own, outer = made.pairs(responses[:, :samples])
    left: Reals = rest - (own * made.own + outer * made.outer) / WHOLE
    return left
