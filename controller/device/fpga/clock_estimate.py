"""Offset between the host's clock and the FPGA's, estimated from heartbeats: within some ten µs, without allocation.

Pulse trains are scheduled in FPGA time, which keeps their spacing exact to one FPGA clock. The host only needs to know
early enough when a pulse is due, so tens of µs suffice here.
"""

from __future__ import annotations

from typing import Final

from controller.clocks import ClockOffset, FpgaTime

DRIFT_MAX: Final = 300e-6  # relative: two crystals of 100 ppm each, and NTP slewing the host's clock


class ClockEstimate:
    """Offset between host time and FPGA time, both in s, as an interval that each exchange narrows.

    The status of a frame carries the FPGA's time at that frame, and the frame was on the wire between two readings of the
    host's clock, so each exchange bounds the offset from both sides. The bound kept is the intersection with the earlier one,
    which is widened by `DRIFT_MAX` over the time since. If the two do not intersect (the FPGA was reset, or the host was
    suspended), the estimate starts again from the newest exchange.
    """

    def __init__(self, clock_hz: float) -> None:
        self.clock_hz = clock_hz
        self.known = False  # False until the first exchange; `offset_s` is 0 until then
        # FPGA time minus host time: the middle of the interval. Hot code adds it to host time, or subtracts it from FPGA
        # time, itself
        self.offset_s = ClockOffset(0.0)
        self.error_s = 0.0  # largest possible error of `offset_s` at the newest exchange: half the width of the interval
        self._low_s = self._high_s = 0.0  # bounds of the offset
        self._updated_s = 0.0

    def add(self, before_s: float, after_s: float, ticks: int) -> None:
        """Update the estimate with one exchange, whose status carries `ticks`, in clocks since reset.

        `before_s` and `after_s` are host time before it began and after its last bit.
        """
        fpga_s = ticks / self.clock_hz
        low_s, high_s = fpga_s - after_s, fpga_s - before_s
        drift_s = DRIFT_MAX * (after_s - self._updated_s)
        self._updated_s = after_s
        if self.known:
            both_low_s, both_high_s = max(low_s, self._low_s - drift_s), min(high_s, self._high_s + drift_s)
            if both_low_s <= both_high_s:
                low_s, high_s = both_low_s, both_high_s
        self._low_s, self._high_s = low_s, high_s
        self.offset_s = ClockOffset((low_s + high_s) / 2)
        self.error_s = (high_s - low_s) / 2
        self.known = True

    def fpga_s(self, host_s: float) -> FpgaTime:
        """FPGA time in s at the host time `host_s`."""
        return host_s + self.offset_s

    def host_s(self, fpga_s: FpgaTime) -> float:
        """Host time in s at the FPGA time `fpga_s`."""
        return fpga_s - self.offset_s

    def ticks(self, fpga_s: FpgaTime) -> int:
        """FPGA clock nearest to the FPGA time `fpga_s`."""
        return round(float(fpga_s) * self.clock_hz)

    def fpga_s_of(self, ticks: int) -> FpgaTime:
        """FPGA time in s at an FPGA clock."""
        return FpgaTime(ticks / self.clock_hz)
