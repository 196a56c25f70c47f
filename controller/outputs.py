"""Whether the FPGA's outputs are on: arming, heartbeats, and the way back after a fault or an outage.

The FPGA decides; what the host does about it is `fpga.recovery`. A host whose own silence is the cause tries
again a few times only: on a machine that is too slow, fingers would feel nothing but ramps.
"""

from __future__ import annotations

from controller.board import Board
from controller.clocks import NEVER, Clock
from controller.errors import ControllerError, FaultError
from controller.fpga.exchange import HostSilent
from controller.fpga.recovery import Recovery
from controller.fpga.session import Session
from controller.fpga.time_base import TimeBase
from controller.latency import Counters

STALLS_IN_A_ROW = 3  # arming again after the host's own silence is tried this often without an emission in between


class Outputs:
    """The outputs of one FPGA that has been brought up.

    Parameters
    ----------
    session : Session
    board : Board
    clock : Clock
        The loop's clock.
    time_base : TimeBase
        Told of the FPGA's time with each heartbeat.
    counters : Counters
        Where outages are counted.

    Attributes
    ----------
    on : bool
        Armed, and the ramp is over: plays are taken.
    cause : str
        Why they are off; empty while they are on or on their way.
    """

    def __init__(self, session: Session, board: Board, clock: Clock, time_base: TimeBase, counters: Counters) -> None:
        self.on = False
        self.cause = ""
        self._session = session
        self._clock = clock
        self._time_base = time_base
        self._counters = counters
        self._recovery = Recovery(session, board)
        self._recovering = False
        self._ramp_end_s = -NEVER  # not armed yet
        self._off_since_s = clock.now_s()
        self._stalls = 0
        self._emissions_at_stall = 0

    def next_s(self) -> float:
        """When `advance` has something to do."""
        if self._recovering:
            return self._recovery.next_s
        return self._session.heartbeat_due_s if self.on else min(self._session.heartbeat_due_s, self._ramp_end_s)

    def advance(self, now_s: float) -> bool:
        """Do what is due: arm, end the ramp, give a heartbeat; True when the outputs have just come on.

        Raises
        ------
        ControllerError
            What the FPGA or the link says: give it to `failed`.
        """
        if self._recovering:
            if now_s < self._recovery.next_s:
                return False
            if not self._recovery.step(now_s):
                self.cause = self._recovery.cause
                return False
            self._recovering = False
        elif self._ramp_end_s == -NEVER:
            self._ramp_end_s = self._session.arm()
            return False
        elif self.on or now_s < self._ramp_end_s:
            if self._session.heartbeat_due_s <= now_s:
                self._beat()
            return False
        else:
            self._session.require_armed()
        self.on, self.cause = True, ""
        self._counters.outputs_off_s += now_s - self._off_since_s
        self._beat()
        return True

    def failed(self, error: ControllerError, now_s: float) -> None:
        """Take the outputs for off, and begin to get them back.

        Raises
        ------
        ControllerError
            If they may not come back: the service ends with the cause.
        """
        if self.on:
            self._off_since_s = now_s
        self.on = False
        self.cause = str(error)
        if isinstance(error, HostSilent):
            self._counters.host_silent += 1
            self._stalls = self._stalls + 1 if self._counters.emissions == self._emissions_at_stall else 1
            self._emissions_at_stall = self._counters.emissions
            if self._stalls > STALLS_IN_A_ROW:
                raise FaultError(f"{error} ({self._stalls} times in a row: the machine is too slow or too busy)") from error
        else:
            self._counters.outages += 1
            self._counters.outage = str(error)
        self._recovering = True
        self._recovery.begin(error, now_s)

    def disarm(self) -> float:
        """Have the outputs glide to 0 V; the time at which they are off."""
        if not self.on:
            return self._clock.now_s()
        self.on = False
        return self._session.disarm()

    def _beat(self) -> None:
        before_s = self._clock.now_s()
        status = self._session.heartbeat()
        sent_s = max(before_s, self._session.free_s())  # not later: what came back may have been read late
        self._time_base.add(before_s, sent_s, status.timestamp_ticks)
        self._counters.heartbeats += 1
