"""Whether the FPGA's outputs are on: arming, heartbeats, and the way back after a fault or an outage.

The FPGA decides; this says what the host does about it. A fault that has passed by itself (this host was silent,
the link failed, the FPGA was reset) is cleared and the outputs are armed again; one that lasts (run permit,
temperature) is waited for; one that says that something is wrong with what is played ends the service.
"""

from __future__ import annotations

from controller.clocks import NEVER, Clock
from controller.errors import ControllerError, FaultError
from controller.fpga.exchange import HostSilent
from controller.fpga.recovery import Recovery, recovery_from
from controller.fpga.session import Session
from controller.fpga.time_base import TimeBase
from controller.latency import Counters

RETRY_S = 0.5  # between attempts to get a lost FPGA back
STALLS_IN_A_ROW = 3  # arming again after the host's own silence is tried this often without an emission in between


class Outputs:
    """The outputs of one FPGA.

    Parameters
    ----------
    session : Session
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

    def __init__(self, session: Session, clock: Clock, time_base: TimeBase, counters: Counters) -> None:
        self.on = False
        self.cause = ""
        self._session = session
        self._clock = clock
        self._time_base = time_base
        self._counters = counters
        self._ramp_end_s = NEVER
        self._retry_s = clock.now_s()
        self._fresh = True  # the session has just been brought up
        self._off_since_s = clock.now_s()
        self._stalls = 0
        self._emissions_at_stall = 0

    def next_s(self) -> float:
        """When `advance` has something to do."""
        if self._retry_s != NEVER:
            return self._retry_s
        return min(self._session.heartbeat_due_s, self._ramp_end_s)

    def advance(self, now_s: float) -> bool:
        """Do what is due: arm, end the ramp, give a heartbeat; True when the outputs have just come on.

        Raises
        ------
        ControllerError
            What the FPGA or the link says; give it to `failed`.
        """
        if self._retry_s <= now_s:
            if not self._fresh:
                self._session.bring_up()
            self._fresh = False
            self._ramp_end_s = self._session.arm()
            self._retry_s = NEVER
        elif self._retry_s != NEVER:
            return False
        if self._ramp_end_s <= now_s:
            self._session.require_armed()
            self._ramp_end_s = NEVER
            self.on, self.cause = True, ""
            self._counters.outputs_off_s += now_s - self._off_since_s
            self._beat()
            return True
        if self._session.heartbeat_due_s <= now_s:
            self._beat()
        return False

    def failed(self, error: ControllerError, now_s: float) -> None:
        """Take the outputs for off; have them come back when they may.

        Raises
        ------
        FaultError
            If they may not: the service ends with the cause.
        """
        self._session.off()
        if self.on:
            self._off_since_s = now_s
        self.on, self._ramp_end_s = False, NEVER
        silent = isinstance(error, HostSilent)
        self._counters.host_silent += silent
        if not silent and str(error) != self.cause:
            self._counters.outages += 1
            self._counters.outage = str(error)
        self.cause = str(error)
        recovery = recovery_from(error)
        if recovery is Recovery.END:
            raise error
        if silent:
            self._stalls = self._stalls + 1 if self._counters.emissions == self._emissions_at_stall else 1
            self._emissions_at_stall = self._counters.emissions
            if self._stalls > STALLS_IN_A_ROW:
                raise FaultError(f"{error} ({self._stalls} times in a row: the machine is too slow or too busy)") from error
        self._retry_s = now_s if silent else now_s + RETRY_S

    def disarm(self) -> float:
        """Have the outputs glide to 0 V; the time at which they are off."""
        if not self.on:
            return self._clock.now_s()
        self.on = False
        return self._session.disarm()

    def _beat(self) -> None:
        before_s = self._clock.now_s()
        status = self._session.heartbeat()
        self._time_base.add(before_s, self._session.ready_s(), status.timestamp_ticks)
        self._counters.heartbeats += 1
