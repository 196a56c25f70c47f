"""What the host believes of the FPGA's queue, triggers and emissions, compared with what each status says.

The rules are those of `play_queue.v` and `waveform_player.v` for a plate that is free when a play is to begin, as the schedule sees
to: then both say the same. Where they differ, a frame, an answer or an edge was lost, or another drives the same lines.
"""

from __future__ import annotations

from typing import Final, Protocol

from controller.device.fpga.frames import Play
from controller.device.fpga.registers import Start, State
from controller.device.fpga.status import Status
from controller.metrics import LinkCounters

NOW: Final = Start.NOW
TIME: Final = Start.TIME
TRIGGERED: Final = -1  # in place of a time: at the next trigger
BUSY: Final = State.PLAYING | State.REPEATING | State.PENDING | State.DELAYED
UNSURE_TICKS: Final = 64  # around the time of a play: whether a status shows it begun


class NeverBegan(Protocol):
    """Whoever wants to know that an emission never began."""

    def __call__(self, *, repeats: bool) -> None:
        """Take note; `repeats`: the FPGA repeats an emission by itself."""


def nobody(*, repeats: bool) -> None:
    """In place of whoever wants to know that an emission never began."""


class Belief:
    """Plays that wait in the FPGA, triggers that it has seen, and emissions that it has begun."""

    def __init__(self) -> None:
        # For each play that was accepted and has not begun, first in, first out, the tick at which it is to begin, or
        # TRIGGERED
        self.waiting: list[int] = []
        self.just_triggered = False  # no heartbeat was compared since the last trigger, whose edge may be on its way still
        self._counts: list[int] = []  # emissions of each, 0: endless
        self._last_count = 1  # of the play that began last
        self._unscheduled = False  # a play was to begin as soon as the plate is free: when that is, only the FPGA knows
        self._known = self._emissions_known = False  # the counters below
        self._triggers = self._ignored = self._emissions = 0

    def forget(self) -> None:
        """The outputs are about to be armed: nothing waits, and what the FPGA has counted so far is of no interest."""
        self._clear()
        self._known = self._emissions_known = False

    def accepted(self, play: Play) -> None:
        """A play was accepted."""
        if play.start is NOW:
            self._unscheduled = True
            self.began(play.emissions)
        else:
            self.waiting.append(play.when_ticks if play.start is TIME else TRIGGERED)
            self._counts.append(play.emissions)

    def withdrawn(self) -> None:
        """The play that was accepted last is to be sent again."""
        self.waiting.pop()
        self._counts.pop()

    def stopped(self, ticks: int) -> int:
        """The queue was emptied, by a STOP answered at a tick; how many plays had waited for their time, which will not begin."""
        self.at(ticks)
        dropped = sum(when != TRIGGERED for when in self.waiting)
        self._clear()
        return dropped

    def triggered(self) -> None:
        """The trigger was pulsed."""
        self._triggers += 1
        self.just_triggered = True
        if self.waiting and self.waiting[0] == TRIGGERED:
            self.begin_first()
        else:
            self._ignored += 1

    def at(self, ticks: int) -> int:
        """How many plays wait at a tick: those whose time has come have begun."""
        waiting = self.waiting
        while waiting and TRIGGERED != waiting[0] <= ticks:
            self.begin_first()
        return len(waiting)

    def begin_first(self) -> None:
        """The first play that waits has begun."""
        self.waiting.pop(0)
        self.began(self._counts.pop(0))

    def unsure(self, ticks: int) -> bool:
        """Whether what a status of this tick says of the queue cannot be evaluated."""
        return self._unscheduled or (bool(self.waiting) and abs(self.waiting[0] - ticks) < UNSURE_TICKS)

    def saw_triggers(self, status: Status) -> bool:
        """Whether the FPGA has seen all triggers that were pulsed and no other, and has ignored none that was to start a play."""
        return not self._known or (status.trigger_count, status.ignored) == (self._triggers & 0xFFFFFFFF, self._ignored & 0xFFFF)

    def repeats_unasked(self, state: State) -> bool:
        """Whether the FPGA repeats what was to play once."""
        return State.REPEATING in state and self._last_count == 1

    def repetition_ended(self, state: State) -> bool:
        """Whether the FPGA does not repeat what was to play endlessly."""
        return State.REPEATING not in state and self._last_count == 0

    def compare(self, status: Status, counters: LinkCounters) -> int:
        """Compare triggers and emissions with a status, count what differs by its cause, and believe the status from now on.

        Returns how many emissions were believed to have begun, and never began.
        """
        if not self._known:
            self._triggers, self._ignored, self._known = status.trigger_count, status.ignored, True
        strange = _signed(status.trigger_count - self._triggers, 32)
        ignored = max(_signed(status.ignored - self._ignored, 16) - max(strange, 0), 0)
        lost = max(-strange, 0)
        counters.triggers_lost += lost
        counters.triggers_ignored += ignored
        counters.triggers_stray += max(strange, 0)
        self._triggers, self._ignored = status.trigger_count, status.ignored
        self._emissions -= lost + ignored
        missed = 0
        if not status.state & BUSY and not self.waiting:
            if self._emissions_known:
                unexplained = _signed(status.emissions - self._emissions, 32)
                missed = max(-unexplained, 0)
                counters.plays_missed += missed
                counters.emissions_unexpected += max(unexplained, 0)
            self._emissions, self._emissions_known = status.emissions, True
        return lost + ignored + missed

    def _clear(self) -> None:
        self.waiting.clear()
        self._counts.clear()
        self._last_count = 1
        self._unscheduled = self.just_triggered = False

    def began(self, count: int) -> None:
        """A play of `count` emissions, 0 for endless, has begun."""
        self._emissions += count
        self._last_count = count
        if not count:
            self._emissions_known = False  # how many an endless play has had, the next status without one says


def _signed(difference: int, bits: int) -> int:
    """Difference of two counters of this many bits, between plus and minus half their range."""
    half = 1 << bits - 1
    return (difference + half & (1 << bits) - 1) - half
