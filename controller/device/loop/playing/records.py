"""The data of one turn, in the order in which it arises; each record is frozen.

Touch samples and time give emissions (`scene`), emissions that are due give a `Batch`, a batch a `Plan`; the FPGA accepts it
(`Accepted`) or not (`Outcome`), and once it starts it is `Played`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from controller.clocks import FpgaTime
from controller.device.scene.emission import Emission
from controller.device.waveforms.composition import Point
from controller.device.waveforms.selection import Key

ENDLESS: Final = 0  # repetitions: until they are replaced


class Turn:
    """One turn of the loop."""

    __slots__ = ("finger", "fpga_s", "now_s", "report_ns", "started_ns")

    def __init__(self, started_ns: int, now_s: float, fpga_s: FpgaTime, report_ns: int, finger: int | None) -> None:
        self.started_ns: Final = started_ns  # when it began (perf_counter_ns)
        self.now_s: Final = now_s  # host time
        self.fpga_s: Final = fpga_s  # the same moment
        # From the kernel's timestamp of the touch report read in this turn to its read; -1 without a report
        self.report_ns: Final = report_ns
        self.finger: Final = finger  # which finger moved, in that report


class Batch:
    """Emissions that are played as one waveform."""

    __slots__ = ("at_s", "emissions", "has_begun", "period_s", "repetitions")

    def __init__(
        self,
        emissions: Sequence[Emission],
        repetitions: int = 1,
        period_s: float = 0.0,
        at_s: FpgaTime | None = None,
        *,
        has_begun: bool = False,
    ) -> None:
        self.emissions: Final = emissions  # one for each focus
        self.repetitions: Final = repetitions  # repetitions, period_s: by the FPGA, from start to start; repetitions may be ENDLESS
        self.period_s: Final = period_s
        # When the FPGA shall start it by itself, or as soon after as it can; None: the trigger pin starts it as soon as the
        # plate is free
        self.at_s: Final = at_s
        # `at_s` is a pulse of a train that has begun: it is kept, or missed and the pulse played on arrival. Otherwise it
        # is put off until what is sent now has arrived for certain
        self.has_begun: Final = has_begun

    def on_arrival(self) -> Batch:
        """The same, played as soon as the plate is free: its time has passed."""
        return Batch(self.emissions, self.repetitions, self.period_s, has_begun=self.has_begun)


class Plan:
    """How a batch is played."""

    __slots__ = ("batch", "key", "points", "resident", "start_s", "start_ticks")

    def __init__(
        self, batch: Batch, points: list[Point], key: Key, resident: Key | None, start_s: FpgaTime, start_ticks: int | None
    ) -> None:
        self.batch: Final = batch
        self.points: Final = points  # where each emission meets its finger, and its amplitude
        self.key: Final = key  # waveform for these points
        self.resident: Final = resident  # waveform in a slot of the FPGA that serves for it; None: it has to be uploaded
        self.start_s: Final = start_s  # earliest start
        # Tick of the FPGA's clock at which it starts the batch by itself; None: the trigger pin does, also for a pulse that
        # cannot arrive in time any more
        self.start_ticks: Final = start_ticks


class Accepted:
    """A plan whose play command the FPGA has accepted, and what that took."""

    __slots__ = ("decide_ns", "fpga_s", "frame_ns", "plan", "ready_s", "start_s", "wire_ns")

    def __init__(
        self, plan: Plan, ready_s: float, start_s: float, fpga_s: FpgaTime, decide_ns: int, frame_ns: int, wire_ns: int
    ) -> None:
        self.plan: Final = plan
        self.ready_s: Final = ready_s  # host time at which the command had arrived
        self.start_s: Final = start_s  # host time at which it starts, as expected
        self.fpga_s: Final = fpga_s  # the same moment, to the clock if the FPGA starts it
        self.decide_ns: Final = decide_ns
        self.frame_ns: Final = frame_ns
        self.wire_ns: Final = wire_ns


@dataclass(frozen=True, slots=True)
class Played:
    """One start, for those who watch."""

    trigger_s: float  # host time at which it starts
    emissions: tuple[Emission, ...]  # with the places at which they meet their fingers
    count: int  # count, period_s: repetition by the FPGA; count 0: until replaced
    period_s: float
    resident: bool  # whether the waveform was in a slot already
    at_ticks: int | None = None  # tick of the FPGA's clock at which it was commanded to start; None: the trigger pin rose
