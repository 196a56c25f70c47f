"""When the plate is free for the next emission: after the newest one, after a repetition by the FPGA, after the duty limit's pause.

Pure arithmetic. The plate plays one emission at a time; each is followed by as much silence as the duty limit asks for. An
endless repetition is kept in the FPGA's time, in which its period stays exact for hours.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from controller.clocks import NEVER, FpgaTime
from controller.device.fpga.clock_estimate import ClockEstimate

MARGIN_S: Final = 10e-6  # between the end of one emission and the start of the next: pin, synchroniser, rounding


class Repetition(NamedTuple):
    """An endless repetition by the FPGA; the period is of the FPGA's clock."""

    first_s: FpgaTime
    period_s: float

    def last_s(self, at_s: FpgaTime) -> FpgaTime:
        """Start of the emission that sounds, or sounded last, at a time after the first."""
        return self.first_s + math.floor((at_s - self.first_s) / self.period_s) * self.period_s


class Occupancy:
    """Until when the plate is occupied by what was started.

    `max_duty` is the share of the time that may be emission, above 0 and at most 1.
    """

    def __init__(self, clock_estimate: ClockEstimate, duration_s: float, max_duty: float) -> None:
        self._clock_estimate = clock_estimate
        self._nominal_s = duration_s
        self._max_duty = max_duty
        self.set_time_scale(1.0)
        self.reset()

    def set_time_scale(self, factor: float) -> None:
        """Emissions last this much longer than the board says: the bit clock follows the plate's temperature."""
        self.duration_s = self._nominal_s * factor
        self._busy_s = self.duration_s / self._max_duty

    def reset(self) -> None:
        """Nothing plays, and nothing has played: after a fault, which may have set the FPGA's clock to 0."""
        self.repetition: Repetition | None = None
        self.repeating = False
        self.free_s = self.last_start_s = -NEVER
        self._free_fpga_s = FpgaTime(-NEVER)  # `free_s` in FPGA time: what the FPGA started by itself is known there to the clock

    def started(self, start_s: float, fpga_s: FpgaTime, *, by_clock: bool) -> None:
        """An emission starts at the host time `start_s`, which is `fpga_s`.

        `by_clock`: the FPGA starts it at `fpga_s`; else the trigger pin rises at `start_s`. The other one is known to within the
        error of the clock estimate.
        """
        error_s = self._clock_estimate.error_s
        self.last_start_s = start_s
        self.free_s = start_s + self._busy_s + (error_s if by_clock else 0.0)
        self._free_fpga_s = fpga_s + self._busy_s + (0.0 if by_clock else error_s)

    def stop_repetition(self, at_s: float) -> None:
        """The FPGA has to stop repeating, from a time of the host on: the emission that sounds then ends, and no other follows."""
        self.repeating = False
        if self.repetition is None:
            return
        clock_estimate = self._clock_estimate
        last_s = self.repetition.last_s(clock_estimate.fpga_s(at_s))
        self._free_fpga_s = max(self._free_fpga_s, last_s + self._busy_s)
        self.free_s = max(self.free_s, clock_estimate.host_s(last_s) + clock_estimate.error_s + self._busy_s)
        self.repetition = None

    @property
    def apart_s(self) -> float:
        """Least time from the start of an emission to the start of the next."""
        return self._busy_s + MARGIN_S

    def free_from_s(self, arrived_s: FpgaTime) -> FpgaTime:
        """Earliest start that the plate allows to a play command that has arrived at a time.

        It stops a repetition, whose last emission then sounds to its end.
        """
        free_s = self._free_fpga_s
        if self.repetition is not None:
            free_s = max(free_s, self.repetition.last_s(arrived_s) + self._busy_s)
        return free_s + MARGIN_S

    def earliest_start_s(self, arrived_s: FpgaTime, at_s: FpgaTime | None = None) -> FpgaTime:
        """Earliest start of an emission, whose play command has arrived at a time; not before `at_s`."""
        start_s = max(arrived_s, self.free_from_s(arrived_s))
        return start_s if at_s is None else max(start_s, at_s)

    def free_after_next_s(self, now_s: float, upload_s: float, promised_s: float) -> float:
        """Host time from which a start can be promised, if another emission is uploaded now and played first.

        `upload_s` and `promised_s` are the time from now to the arrival of an upload, as expected and as promised.
        """
        start_s = max(now_s + upload_s, self.free_s + MARGIN_S)
        return start_s + max(self._busy_s, promised_s) + 2 * MARGIN_S

    def next_repetition_s(self, at_s: float) -> float:
        """Host time at which the repetition next starts an emission after a time; inf without a repetition."""
        if self.repetition is None:
            return NEVER
        clock_estimate = self._clock_estimate
        next_s = clock_estimate.host_s(self.repetition.last_s(clock_estimate.fpga_s(at_s)) + self.repetition.period_s)
        return max(next_s, self.last_start_s)  # the first one is due then, whatever was rounded on the way
