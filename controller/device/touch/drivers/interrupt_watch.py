"""Whether the interrupt line of a touch controller announces its reports, evaluated by what reads of the chip find.

A wire may be broken, a line held, of the other polarity or open to noise, and a chip may not signal every report. A line is trusted
once it has announced some reports in a row; without that the chip is polled, at the rate of its scans.
"""

from __future__ import annotations

from collections import Counter
from enum import Enum
from typing import Final

TRUSTED_AFTER: Final = 3  # reports in a row that an edge announced
SILENT_AFTER: Final = 2  # reports in a row that polls found; one may have an edge while the chip is being read
MOST_EDGES_PER_S: Final = 1000  # no panel scans as often


class _Line(Enum):
    UNPROVEN = "no report was announced so far"
    TRUSTED = "reports are announced"
    SILENT = "reports came without an edge"
    NOISY = "edges came without end"


class InterruptWatch:
    """Checks the interrupt line of one chip; counts `interrupt_silent` and `interrupt_noisy`.

    If it is not `wired` the chip is polled, and nothing is counted.
    """

    def __init__(self, warnings: Counter[str], *, wired: bool) -> None:
        self._warnings = warnings
        self._wired = wired
        self.started()

    @property
    def polled(self) -> bool:
        """Whether the chip must be read at the rate of its scans, as nothing announces its reports for certain."""
        return self._line is not _Line.TRUSTED

    @property
    def ignored(self) -> bool:
        """Whether the line is not to be listened to."""
        return not self._wired or self._line is _Line.NOISY

    def started(self) -> None:
        """Forget everything: the chip was started, and another one may be at the line."""
        self._line = _Line.UNPROVEN
        self._announced = self._missed = 0
        self._edges, self._second_s = 0, -1.0

    def report(self, *, announced: bool, edge_meanwhile: bool = False) -> None:
        """Take in a new report; it was `announced` if an edge came before the chip was read.

        An `edge_meanwhile` came while it was being read: that of the report, which was made in just this moment, or, of a line with
        the other polarity, that of having read it. Where such reports are all that a trusted line gives, it is the latter.
        """
        if self.ignored:
            return
        if announced:
            self._missed = 0
            self._announced += 1
            if self._announced >= TRUSTED_AFTER:
                self._line = _Line.TRUSTED
        elif not (edge_meanwhile and self.polled):
            self._announced = 0
            self._missed += 1
            if self._missed >= SILENT_AFTER and self._line is not _Line.SILENT:
                self._line = _Line.SILENT
                self._warnings["interrupt_silent"] += 1

    def edges(self, count: int, now_s: float) -> None:
        """Take in that the line had `count` edges by `now_s`, on the loop's clock."""
        if now_s - self._second_s >= 1.0:
            self._edges, self._second_s = 0, now_s
        self._edges += count
        if self._edges > MOST_EDGES_PER_S and not self.ignored:
            self._line = _Line.NOISY
            self._warnings["interrupt_noisy"] += 1
