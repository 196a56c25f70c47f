"""What work the loop leaves out since its result is there already, or would be next to the same; each can be done all the same.

A device leaves everything out. The simulation switches single ones off to measure what each saves (`benchmark.skipping`).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Skips:
    """Which work is left out."""

    idle: bool = True  # after `idle_disarm_s` without a touch the outputs are off, and nothing is sent
    resident: bool = True  # a waveform that a slot of the FPGA holds is not sent again
    repeated: bool = True  # fixedEmitters of one period are repeated by the FPGA, without the host
    ahead: bool = True  # a moving finger finds its next waveform resident: it was sent while nothing else was due
    near: bool = True  # a resident waveform for a place within `REUSE_RADIUS_M` is played in place of one for the place itself
    # A lone finger within `bank.snap_mm` of a cell plays the bank's entry, and fixed emitters play what the bank has composed
    # beforehand: nothing is composed
    cells: bool = True
    together: bool = True  # what is due within one emission is played as one waveform, not as several


ALL = Skips()
EXACT = ("idle", "resident", "repeated")  # with or without these, places that do not move get the same bits
