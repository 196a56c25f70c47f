"""The FPGA's clock on the host's, kept up by heartbeats: to some ten µs, in a few additions, with nothing allocated.

Trains of emissions live in the FPGA's time, so that their spacing is exact to its clock; the host only has to
hand each of them over early enough. What has to be known to a µs, with a bound that holds, is `clock_relation`.
"""

from __future__ import annotations

MOST_DRIFT = 300e-6  # two crystals of 100 ppm, and slewing


class TimeBase:
    """Offset between host time and FPGA time, both in s.

    The status of a frame carries the FPGA's time at that frame, which was on the wire between two readings of
    the host's clock: the offset lies in an interval. Intervals are cut with those before, which widen by
    MOST_DRIFT; one that contradicts them begins anew (the FPGA was reset, or the host stood still).

    Parameters
    ----------
    clock_hz : float
        Nominal clock of the FPGA.

    Attributes
    ----------
    known : bool
        Whether any exchange was taken in.
    offset_s : float
        FPGA time minus host time.
    """

    def __init__(self, clock_hz: float) -> None:
        self.clock_hz = clock_hz
        self.known = False
        self.offset_s = 0.0
        self._low_s = self._high_s = 0.0  # bounds of FPGA time - host time
        self._at_s = 0.0

    def add(self, before_s: float, after_s: float, ticks: int) -> None:
        """Take in one exchange that began and ended at these times of the host, and the ticks in its status."""
        fpga_s = ticks / self.clock_hz
        low_s, high_s = fpga_s - after_s, fpga_s - before_s
        wider_s = MOST_DRIFT * (after_s - self._at_s)
        self._at_s = after_s
        if self.known:
            kept_low_s, kept_high_s = max(low_s, self._low_s - wider_s), min(high_s, self._high_s + wider_s)
            if kept_low_s <= kept_high_s:
                low_s, high_s = kept_low_s, kept_high_s
        self._low_s, self._high_s = low_s, high_s
        self.offset_s = (low_s + high_s) / 2
        self.known = True

    @property
    def error_s(self) -> float:
        """Half the width of what the offset may be."""
        return (self._high_s - self._low_s) / 2

    def fpga_s(self, host_s: float) -> float:
        """FPGA time at a time of the host."""
        return host_s + self.offset_s

    def host_s(self, fpga_s: float) -> float:
        """Host time at a time of the FPGA."""
        return fpga_s - self.offset_s

    def ticks(self, fpga_s: float) -> int:
        """Clock of the FPGA nearest to a time of it."""
        return round(fpga_s * self.clock_hz)
