"""A capture of the FPGA's output pins, or of those of several: all that a plate, real or simulated, is driven by."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Capture:
    """Changes of the output pins, earliest first; ticks are FPGA clocks since reset."""

    ticks: NDArray[np.uint64]  # (n,): when the channel pins or the high-voltage enable changed, strictly increasing
    words: NDArray[np.uint32]  # (n,): channel pins from that tick on; bit q is channel q; of several FPGAs (n, FPGA)
    hv: NDArray[np.uint8]  # (n,), as `words`: 1 where the high-voltage supply is enabled from that tick on
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


def merged(captures: Sequence[Capture]) -> Capture:
    """Captures of the FPGAs of one panel, by the same ticks, as one: their channels beside each other, the foci of the first."""
    if len(captures) == 1:
        return captures[0]
    ticks = np.unique(np.concatenate([capture.ticks for capture in captures]))
    rows_of_each = [np.searchsorted(capture.ticks, ticks, "right") for capture in captures]  # 0: low before its first change
    words = [np.append(np.uint32(0), capture.words)[rows] for capture, rows in zip(captures, rows_of_each, strict=True)]
    hv = [np.append(np.uint8(0), capture.hv)[rows] for capture, rows in zip(captures, rows_of_each, strict=True)]
    return replace(captures[0], ticks=ticks, words=np.stack(words, axis=1), hv=np.stack(hv, axis=1))
