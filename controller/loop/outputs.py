"""Whether the FPGA's outputs are on: arming, heartbeats, and recovery after a fault or an outage.

The FPGA decides; what the host does about it is in `fpga.recovery`. If the host itself missed heartbeats, it arms again only
a few times: on a machine that is too slow, fingers would feel nothing but ramps.
"""

from __future__ import annotations

from controller.board.board import Board
from controller.board.panel_state import PanelState
from controller.clocks import NEVER, Clock
from controller.errors import ControllerError, FaultError
from controller.fpga.clock_estimate import ClockEstimate
from controller.fpga.exchange import HostSilent
from controller.fpga.recovery import Recovery
from controller.fpga.registers import Fault
from controller.fpga.session import Session
from controller.metrics import Counters

STALLS_IN_A_ROW = 3  # times the host arms again after it missed heartbeats, without an emission in between
WAKE_S = 0.2  # what was due this long before the outputs are on again is not played any more
IDLE_TURN_S = 0.5  # between turns of the loop while nothing happens: watchdogs look at it


class Outputs:
    """The outputs of one FPGA, off at first; the FPGA may still be absent.

    Parameters
    ----------
    session : Session
    board : Board
    clock : Clock
        The loop's clock.
    clock_estimate : ClockEstimate
        Updated with each heartbeat.
    counters : Counters
        Counts heartbeats and outages.

    Attributes
    ----------
    on : bool
        Armed, and the ramp has ended: the FPGA accepts plays.
    idle : bool
        Ramped down since nothing is touched; nothing is sent until `wake`.
    waking : bool
        The outputs are being armed for a touch or command, which waits for them.
    """

    def __init__(self, session: Session, board: Board, clock: Clock, clock_estimate: ClockEstimate, counters: Counters) -> None:
        self.on = False
        self.idle = self.waking = False
        self._idle_from_s = 0.0  # end of the ramp
        self._woken_s = -NEVER
        self._session = session
        self._clock = clock
        self._clock_estimate = clock_estimate
        self._counters = counters
        self._recovery = Recovery(session, board)
        self._off_since_s = clock.now_s()
        self._stalls = 0  # without an emission in between

    @property
    def state(self) -> PanelState:
        """ARMED, or why the outputs are off; while they are being armed, the state before."""
        if self.idle or self.waking:
            return PanelState.IDLE
        return PanelState.ARMED if self.on else self._recovery.state

    @property
    def cause(self) -> str:
        """Why the outputs are off; empty while they are on, or armed for the first time."""
        if self.idle or self.waking:
            return "nothing is touched"
        return "" if self.on else self._recovery.cause

    @property
    def wanted(self) -> bool:
        """Whether the outputs are to be on. If they are on and not wanted, call `disarm`."""
        return self._recovery.wanted

    @wanted.setter
    def wanted(self, wanted: bool) -> None:
        self._recovery.wanted = wanted

    def next_s(self) -> float:
        """Host time at which `advance` is due."""
        if self.idle and self._session.exchange.heartbeat_due_s >= self._idle_from_s:
            return self._clock.now_s() + IDLE_TURN_S
        return self._session.exchange.heartbeat_due_s if self.on or self.idle else self._recovery.next_s

    def advance(self, now_s: float) -> bool:
        """Do what is due: bring up, arm, end the ramp, or send a heartbeat; True when the outputs have just come on.

        Raises
        ------
        ControllerError
            A fault of the FPGA or an error of the link: to be given to `failed`.
        """
        if self.on or self.idle:
            due_s = self._session.exchange.heartbeat_due_s
            if due_s <= now_s and (self.on or due_s < self._idle_from_s):
                self._beat()
            return False
        if self.waking and now_s >= self._woken_s + WAKE_S:
            self.waking = False
        if now_s < self._recovery.next_s or not self._recovery.step(now_s):
            return False
        self.on, self.waking = True, False
        self._counters.outputs_off_s += now_s - self._off_since_s
        self._beat()
        return True

    def failed(self, error: ControllerError, now_s: float) -> None:
        """Begin the recovery after an error: the outputs are off.

        Raises
        ------
        ControllerError
            The same, if there is no recovery from it; or the cause, if the host missed heartbeats too often.
        """
        if self.on:
            self._off_since_s = now_s
        self.on = self.idle = self.waking = False
        if isinstance(error, HostSilent):
            self._counters.host_silent += 1
            self._stalls += 1
            if self._stalls > STALLS_IN_A_ROW:
                raise FaultError(f"{error} ({self._stalls} times in a row: the machine is too slow or too busy)") from error
        else:
            self._counters.outages += 1
            self._counters.outage = str(error)
            for cause in _causes(error):
                self._counters.outage_causes[cause] = self._counters.outage_causes.get(cause, 0) + 1
        self._recovery.begin(error, now_s)

    def emission_started(self) -> None:
        """Take note that an emission was played: a later stall is not in a row with an earlier one."""
        self._stalls = 0

    def begin_idle(self) -> None:
        """Have the outputs ramp to 0 V, and send nothing afterwards: an FPGA whose outputs are off needs no heartbeats.

        Raises
        ------
        LinkError, FaultError
            As `disarm`.
        """
        self._idle_from_s = self.disarm()
        self.idle = True
        self._counters.idled += 1

    def wake(self) -> None:
        """End an idle time: the FPGA is verified and armed in the next turns.

        Raises
        ------
        ControllerError
            A fault of the FPGA or an error of the link: to be given to `failed`.
        """
        self.idle, self.waking = False, True
        self._woken_s = self._clock.now_s()
        self._recovery.resume(max(self._woken_s, self._idle_from_s))
        self._beat()  # what is due from now on is told in the FPGA's time

    def disarm(self) -> float:
        """Have the outputs ramp to 0 V; host time at which they are off.

        Raises
        ------
        LinkError, FaultError
            If the FPGA does not acknowledge it; it switches off by its heartbeat timeout then.
        """
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


def _causes(error: ControllerError) -> list[str]:
    """Names of the faults of an outage; LINK where the FPGA named none."""
    return [cause.name or "" for cause in Fault if isinstance(error, FaultError) and error.faults & cause] or ["LINK"]
