"""Whether the FPGA's outputs are on: arming, heartbeats, and the way back after a fault or an outage.

The FPGA decides; what the host does about it is `fpga.recovery`. A host whose own silence is the cause tries
again a few times only: on a machine that is too slow, fingers would feel nothing but ramps.
"""

from __future__ import annotations

from controller.board.board import Board
from controller.board.panel_state import PanelState
from controller.clocks import Clock
from controller.errors import ControllerError, FaultError
from controller.fpga.clock_estimate import ClockEstimate
from controller.fpga.exchange import HostSilent
from controller.fpga.recovery import Recovery
from controller.fpga.session import Session
from controller.metrics import Counters

STALLS_IN_A_ROW = 3  # arming again after the host's own silence is tried this often without an emission in between


class Outputs:
    """The outputs of one FPGA, off at first; it need not be there yet.

    Parameters
    ----------
    session : Session
    board : Board
    clock : Clock
        The loop's clock.
    clock_estimate : ClockEstimate
        Told of the FPGA's time with each heartbeat.
    counters : Counters
        Where outages are counted.

    Attributes
    ----------
    on : bool
        Armed, and the ramp is over: plays are taken.
    """

    def __init__(self, session: Session, board: Board, clock: Clock, clock_estimate: ClockEstimate, counters: Counters) -> None:
        self.on = False
        self._session = session
        self._clock = clock
        self._clock_estimate = clock_estimate
        self._counters = counters
        self._recovery = Recovery(session, board)
        self._off_since_s = clock.now_s()
        self._stalls = 0  # without an emission in between

    @property
    def state(self) -> PanelState:
        """ARMED, or why not; while they are on their way what was before."""
        return PanelState.ARMED if self.on else self._recovery.state

    @property
    def cause(self) -> str:
        """Why they are off; empty while they are on, or on their way for the first time."""
        return "" if self.on else self._recovery.cause

    @property
    def wanted(self) -> bool:
        """Whether they are to be on; where they are and should not be, call `disarm`."""
        return self._recovery.wanted

    @wanted.setter
    def wanted(self, wanted: bool) -> None:
        self._recovery.wanted = wanted

    def next_s(self) -> float:
        """When `advance` has something to do."""
        return self._session.heartbeat_due_s if self.on else self._recovery.next_s

    def advance(self, now_s: float) -> bool:
        """Do what is due: bring up, arm, end the ramp, give a heartbeat; True when the outputs have just come on.

        Raises
        ------
        ControllerError
            What the FPGA or the link says: give it to `failed`.
        """
        if self.on:
            if self._session.heartbeat_due_s <= now_s:
                self._beat()
            return False
        if now_s < self._recovery.next_s or not self._recovery.step(now_s):
            return False
        self.on = True
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
        if isinstance(error, HostSilent):
            self._counters.host_silent += 1
            self._stalls += 1
            if self._stalls > STALLS_IN_A_ROW:
                raise FaultError(f"{error} ({self._stalls} times in a row: the machine is too slow or too busy)") from error
        else:
            self._counters.outages += 1
            self._counters.outage = str(error)
        self._recovery.begin(error, now_s)

    def emission_started(self) -> None:
        """Take note that something was played: the host is fast enough for that."""
        self._stalls = 0

    def disarm(self) -> float:
        """Have the outputs glide to 0 V; the time at which they are off."""
        now_s = self._clock.now_s()
        if not self.on:
            return now_s
        self.on = False
        self._off_since_s = now_s
        off_s = self._session.disarm()
        self._recovery.disarmed(off_s)
        return off_s

    def _beat(self) -> None:
        before_s = self._clock.now_s()
        status = self._session.heartbeat()
        sent_s = max(before_s, self._session.wire_free_s())  # not later: what came back may have been read late
        self._clock_estimate.add(before_s, sent_s, status.timestamp_ticks)
        self._counters.heartbeats += 1
