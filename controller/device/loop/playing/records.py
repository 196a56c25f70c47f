"""The data of one turn, in the order in which it arises; no record is changed once it is made.

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


@dataclass(slots=True, eq=False)
class Turn:
    """One turn of the loop."""

    started_ns: int  # when it began (perf_counter_ns)
    now_s: float  # host time
    fpga_s: FpgaTime  # the same moment
    # From the kernel's timestamp of the touch report read in this turn to its read; -1 without a report
    report_ns: int
    finger: int | None  # which finger moved, in that report


@dataclass(slots=True, eq=False)
class Batch:
    """Emissions that are played as one waveform."""

    emissions: Sequence[Emission]  # one for each focus
    repetitions: int = 1  # repetitions, period_s: by the FPGA, from start to start; repetitions may be ENDLESS
    period_s: float = 0.0
    # When the FPGA shall start it by itself, or as soon after as it can; None: the trigger pin starts it as soon as the
    # plate is free
    at_s: FpgaTime | None = None
    # `at_s` is a pulse of a train that has begun: it is kept, or missed and the pulse played on arrival. Otherwise it
    # is put off until what is sent now has arrived for certain
    has_begun: bool = False

    def on_arrival(self) -> Batch:
        """The same, played as soon as the plate is free: its time has passed."""
        return Batch(self.emissions, self.repetitions, self.period_s, has_begun=self.has_begun)


@dataclass(slots=True, eq=False)
class Plan:
    """How a batch is played."""

    batch: Batch
    points: list[Point]  # where each emission meets its finger, and its amplitude
    key: Key  # waveform for these points
    resident: Key | None  # waveform in a slot of the FPGA that serves for it; None: it has to be uploaded
    start_s: FpgaTime  # earliest start
    # Tick of the FPGA's clock at which it starts the batch by itself; None: the trigger pin does, also for a pulse that
    # cannot arrive in time any more
    start_ticks: int | None


@dataclass(slots=True, eq=False)
class Accepted:
    """A plan whose play command the FPGA has accepted, and what that took."""

    plan: Plan
    ready_s: float  # host time at which the command had arrived
    start_s: float  # host time at which it starts, as expected
    fpga_s: FpgaTime  # the same moment, to the clock if the FPGA starts it
    decide_ns: int
    frame_ns: int
    wire_ns: int


@dataclass(frozen=True, slots=True)
class Played:
    """One start, for those who watch."""

    trigger_s: float  # host time at which it starts
    emissions: tuple[Emission, ...]  # with the places at which they meet their fingers
    count: int  # count, period_s: repetition by the FPGA; count 0: until replaced
    period_s: float
    resident: bool  # whether the waveform was in a slot already
    at_ticks: int | None = None  # tick of the FPGA's clock at which it was commanded to start; None: the trigger pin rose
