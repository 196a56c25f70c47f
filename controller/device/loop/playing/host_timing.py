"""How long this host takes for an upload and for a play command, measured as it works, and what the schedule makes of it.

Of everything that goes out the time from the decision to the arrival of its last bit is measured on the loop's clock: composing,
packing, the kernel, the bits, and the pauses between frames. What exceeds the bits alone is kept as a mean and a running
99th percentile. A pulse is handed over as early as the percentile asks for; where a focus will meet its finger follows from the
mean. Constant memory, nothing is allocated, and a host that changes is followed within some hundred emissions.
"""

from __future__ import annotations

import math
from typing import Any, Final

from controller.log import Event, log

FRACTION: Final = 0.99
STEP: Final = 0.3  # of the logarithm: a record above raises the percentile by 35 %, each one below lowers it by 0.3 %
UP: Final = math.exp(STEP * FRACTION)
DOWN: Final = math.exp(-STEP * (1 - FRACTION))
QUICK_RECORDS: Final = 16  # at first, when nothing is known of the host
QUICK_UP: Final = 4.0
BEYOND: Final = 1.5  # but not beyond this many times what was measured
MEAN_OF: Final = 32  # records that the mean is of, about

MARGIN: Final = 1.25  # of the percentile: at most one pulse of 200 is to be late
PRIOR_S: Final = 0.16e-3  # 99th percentile before anything is measured, and the lowest
MAX_S: Final = 6e-3  # the highest, and that of the lead beyond an upload's bits: what is handed over earlier misses fast fingers
HANDOVER_S: Final = MARGIN * PRIOR_S  # from the arrival expected at the earliest to the earliest time promised
ARRIVED_S: Final = 0.1e-3  # a pulse is to have arrived so long before it starts
PULSE_LEAD_S: Final = 0.7e-3  # beyond an upload's bits: a pulse is handed over this early at least

SAID_AFTER: Final = 200  # uploads until a host is known that is slower than the plate
SLOWER: Final = 0.95


class RunningPercentile:
    """The 99th percentile of the records so far, the newest counting most; in constant memory, without allocation.

    In the long run one record of a hundred exceeds it, whatever their distribution. One record, however long, raises it by a
    factor of `UP`, at first of `QUICK_UP`, at most.

    It is `prior_s` before the first record, and stays within `least_s` and `most_s`, all above 0.
    """

    def __init__(self, prior_s: float = PRIOR_S, least_s: float = PRIOR_S, most_s: float = MAX_S) -> None:
        self.value_s = prior_s
        self._least_s = least_s
        self._most_s = most_s
        self._quick = QUICK_RECORDS

    def record(self, duration_s: float) -> None:
        """Take one duration."""
        value_s, quick = self.value_s, self._quick > 0
        if quick:
            self._quick -= 1
        if duration_s > value_s:
            value_s = min(QUICK_UP * value_s, BEYOND * duration_s) if quick else UP * value_s
            self.value_s = self._most_s if value_s > self._most_s else value_s
        elif value_s > self._least_s:
            value_s *= DOWN
            self.value_s = self._least_s if value_s < self._least_s else value_s


class DeliveryTime:
    """Time from the decision to play something to the arrival of its last bit; for uploads, or for play commands alone.

    Its bits take `bits_s` on the wire: the least that it takes.
    """

    def __init__(self, bits_s: float) -> None:
        self._bits_s = bits_s
        self._mean_s = 0.0
        self._percentile = RunningPercentile()
        self.expected_s = bits_s  # its mean
        # It will take no longer, but for one in some hundred times: what is asked for after this time is not too late
        self.promised_s = bits_s + HANDOVER_S

    def record(self, duration_s: float) -> None:
        """Take the duration of one, from the decision to the last bit."""
        percentile, mean_s, bits_s = self._percentile, self._mean_s, self._bits_s
        more_s = duration_s - bits_s
        more_s = more_s if more_s > 0.0 else 0.0
        percentile.record(more_s)
        most_s = percentile.value_s
        self._mean_s = mean_s = mean_s + ((more_s if more_s < most_s else most_s) - mean_s) / MEAN_OF
        self.expected_s = bits_s + mean_s
        self.promised_s = bits_s + MARGIN * most_s


class HostTiming:
    """What the schedule knows of its host.

    `upload_s` and `command_s` are the bits of an upload with its play command, and of a play command alone, on the wire; `plate_s`
    is the least time from emission to emission that the plate allows.
    """

    def __init__(self, upload_s: float, command_s: float, plate_s: float) -> None:
        self.upload = DeliveryTime(upload_s)
        self.command = DeliveryTime(command_s)
        self.upload_bits_s = upload_s
        self._plate_s = plate_s
        self._woken = RunningPercentile()
        # To be set: from the beginning of the turn to the newest decision for an emission
        self.decided_s = self._decide_s = 0.0  # the newest, and their mean
        self._uploads = 0
        self.lead_s = upload_s + PULSE_LEAD_S  # a pulse is handed over this long before it is due

    @property
    def uploads_hz(self) -> float:
        """Emissions a second that this host reaches with a finger that moves, each of which needs an upload."""
        return 1 / max(self._plate_s, self.upload.expected_s + self._decide_s)

    def woken(self, late_s: float) -> None:
        """Take how long after it could have been handed over a pulse was decided on."""
        self._woken.record(late_s)
        self._lead()

    def arrived(self, duration_s: float, *, uploaded: bool) -> None:
        """Take the duration of an upload, or of a play command alone, from the decision on."""
        if uploaded:
            self.uploaded(duration_s)
        else:
            self.command.record(duration_s)

    def uploaded(self, duration_s: float) -> None:
        """Take the duration of an upload, from the decision on."""
        self.upload.record(duration_s)
        self._decide_s += (min(self.decided_s, MAX_S) - self._decide_s) / MEAN_OF
        self._lead()
        self._uploads += 1
        if self._uploads == SAID_AFTER and self.uploads_hz < SLOWER / self._plate_s:
            reached_hz, plate_hz = self.uploads_hz, 1 / self._plate_s
            reached = f"this host reaches {reached_hz:.0f} emissions/s with a moving finger"
            log(f"{reached}; the plate allows {plate_hz:.0f}", Event.SLOW_HOST)

    def figures(self) -> dict[str, Any]:
        """What was measured, and what follows from it; for JSON."""
        return {
            "lead_ms": round(self.lead_s * 1e3, 3),
            "upload_ms": round(self.upload.expected_s * 1e3, 3),
            "upload_promised_ms": round(self.upload.promised_s * 1e3, 3),
            "play_ms": round(self.command.expected_s * 1e3, 3),
            "play_promised_ms": round(self.command.promised_s * 1e3, 3),
            "uploads_hz": round(self.uploads_hz, 1),
        }

    def _lead(self) -> None:
        lead_s = self.upload.promised_s + self._woken.value_s + ARRIVED_S
        self.lead_s = min(max(lead_s, self.upload_bits_s + PULSE_LEAD_S), self.upload_bits_s + MAX_S)
