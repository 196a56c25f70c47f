"""What the pins of the FPGA did: the only thing a plate, real or simulated, ever sees."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Capture:
    """Changes on the output pins, earliest first; ticks are clocks of the FPGA since its reset.

    Attributes
    ----------
    ticks : (n,) uint64 array
        When the channel pins or the high-voltage enable changed, strictly rising.
    words : (n,) uint32 array
        Channel pins from that tick on; bit q is channel q.
    hv : (n,) uint8 array
        1 where the high-voltage supply is enabled from that tick on.
    focus_ticks : (k,) uint64 array
        Rises of `focus_o`: t = T of each emission that ran to its end.
    """

    ticks: NDArray[np.uint64]
    words: NDArray[np.uint32]
    hv: NDArray[np.uint8]
    focus_ticks: NDArray[np.uint64]
