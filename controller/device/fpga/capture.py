"""A capture of the FPGA's output pins: all that a plate, real or simulated, is driven by."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Capture:
    """Changes of the output pins, earliest first; ticks are FPGA clocks since reset."""

    ticks: NDArray[np.uint64]  # (n,): when the channel pins or the high-voltage enable changed, strictly increasing
    words: NDArray[np.uint32]  # (n,): channel pins from that tick on; bit q is channel q
    hv: NDArray[np.uint8]  # (n,): 1 where the high-voltage supply is enabled from that tick on
    focus_ticks: NDArray[np.uint64]  # (k,): rises of `focus_o`: t = T of each completed emission
    # alive_ticks, waiting_ticks, fault_ticks: (k,): each change of `hv_alive_o`, `waiting_o` and `fault_o`, which are low at
    # reset
    alive_ticks: NDArray[np.uint64] = field(default_factory=lambda: np.zeros(0, np.uint64))
    waiting_ticks: NDArray[np.uint64] = field(default_factory=lambda: np.zeros(0, np.uint64))
    fault_ticks: NDArray[np.uint64] = field(default_factory=lambda: np.zeros(0, np.uint64))
    # miso_ticks, uart_ticks: (k,): each change of `spi_miso_o`, low at reset, and of `uart_tx_o`, high at reset; the model
    # records them only if asked to
    miso_ticks: NDArray[np.uint64] = field(default_factory=lambda: np.zeros(0, np.uint64))
    uart_ticks: NDArray[np.uint64] = field(default_factory=lambda: np.zeros(0, np.uint64))
