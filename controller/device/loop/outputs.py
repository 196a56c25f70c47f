"""Whether the FPGA's outputs are on: arming, heartbeats, and recovery after a fault or an outage.

The FPGA decides; what the host does about it is in `fpga.recovery`. Outputs are off when a status of the FPGA says so, or when it
has certainly switched off by its heartbeat timeout: not when a DISARM was accepted, which begins a ramp.

A host that missed heartbeats arms again at once. If it stalls again and again without an emission in between, fingers would feel
nothing but ramps: it arms later each time, and never gives up.
"""

from __future__ import annotations

import selectors

from controller.clocks import NEVER
from controller.device.board.panel_state import PanelState
from controller.device.fpga.exchange import HostSilent
from controller.device.fpga.recovery import Recovery
from controller.device.fpga.registers import Fault
from controller.device.fpga.supervision import StillOn
from controller.device.loop.context import LoopContext
from controller.errors import ControllerError, FaultError, LinkError

STALL_PAUSE_S = 0.5  # before arming after the second stall in a row; doubled with each further one
STALL_PAUSE_MAX_S = 8.0
STEADY_S = 10.0  # with outputs on, after which a stall is not in a row with those before
OFF_LATE_S = 0.01  # after the end of a ramp down, for a status that says so
OFF_POLL_S = 1e-3
WAKE_S = 0.2  # what was due this long before the outputs are on again is not played any more
IDLE_TURN_S = 0.5  # between turns of the loop while nothing happens: watchdogs look at it


class Outputs:
    """The outputs of one FPGA, off at first; the FPGA may still be absent."""

    def __init__(self, context: LoopContext) -> None:
        self.on = False  # armed, and the ramp has ended: the FPGA accepts plays
        self.idle = False  # ramped down since nothing is touched; nothing is sent until `wake`
        self.waking = False  # being armed for a touch or command, which waits for them
        self.ramping_down = False  # disarmed, and no status has said yet that they are off
        self._down_s = 0.0  # end of the last ramp down
        self._woken_s = -NEVER
        self._session = context.session
        self._exchanges = context.session.exchanges
        self._clock = context.clock
        self._clock_estimate = context.clock_estimate  # updated with each heartbeat
        self._counters = context.counters
        self._recovery = Recovery(context.session, context.board)
        self._off_since_s = self._clock.now_s()
        self._stalls = 0  # without an emission in between
        self._on_since_s = 0.0

    @property
    def may_be_on(self) -> bool:
        """Whether there may be voltage at the actuators: no status has said that the outputs are off since they were armed."""
        return self.on or (self._session.on_anywhere and self._clock.now_s() < self.off_by_s)

    @property
    def off_by_s(self) -> float:
        """Host time at which the FPGA has switched off by itself after an error, at the latest."""
        return self._recovery.off_by_s

    @property
    def ramping(self) -> bool:
        """Whether the outputs are on their way to their idle levels, or back to 0 V."""
        return self.ramping_down or self._recovery.arming

    @property
    def unwanted(self) -> bool:
        """Whether the outputs are on, or coming on, and not to be: call `disarm`."""
        return not self._recovery.wanted and (self.on or self._recovery.arming)

    @property
    def state(self) -> PanelState:
        """ARMED, RAMPING, or why the outputs are off."""
        if self.on:
            return PanelState.ARMED
        if self.ramping:
            return PanelState.RAMPING
        return PanelState.IDLE if self.idle or self.waking else self._recovery.state

    @property
    def cause(self) -> str:
        """Why the outputs are off, or ramp; empty while they are on, or before the first step."""
        if self.on:
            return ""
        if self._recovery.arming:
            return "the outputs are being switched on"
        if self.idle or self.waking:
            return "nothing is touched"
        return "the outputs are being switched off" if self.ramping_down else self._recovery.cause

    @property
    def wanted(self) -> bool:
        """Whether the outputs are to be on."""
        return self._recovery.wanted

    def switch(self, *, on: bool, by: str = "a client") -> None:
        """Have the outputs on as soon as the FPGA allows it, or off; `CommandSource.changed` reports when they are.

        Off they stay, through faults and reconnections, until somebody switches them on; who switched them off first is the cause.
        """
        if not on and self._recovery.wanted:
            self._recovery.unwanted_cause = f"switched off by {by}"
        self._recovery.wanted = on

    def next_s(self) -> float:
        """Host time at which `advance` is due."""
        if self.on:
            return min([one.heartbeat_due_s for one in self._exchanges])
        if self.ramping_down:
            now_s = self._clock.now_s()
            return min(self._session.heartbeat_due_s, self._down_s if now_s < self._down_s else now_s + OFF_POLL_S)
        if self.idle:
            return self._clock.now_s() + IDLE_TURN_S
        return min(self._recovery.next_s, self.off_by_s) if self.may_be_on else self._recovery.next_s

    def advance(self, now_s: float) -> bool:
        """Do what is due: bring up, arm, end a ramp, or send a heartbeat; True when the outputs have just come on.

        Raises ControllerError: a fault of the FPGA or an error of the link: to be given to `failed`.
        """
        if not self.ramped_down(now_s):
            return False
        if self.on or self.idle:
            if self.on and min([one.heartbeat_due_s for one in self._exchanges]) <= now_s:
                self._heartbeat()
            return False
        if self.waking and now_s >= self._woken_s + WAKE_S:
            self.waking = False
        if now_s < self._recovery.next_s or not self._recovery.step(now_s):
            return False
        self.on, self.waking = True, False
        self._counters.outputs_off_s += now_s - self._off_since_s
        self._on_since_s = now_s
        self._heartbeat()
        return True

    def failed(self, error: ControllerError, now_s: float) -> None:
        """Begin the recovery after an error: the outputs are off, or switch off by their heartbeat timeout.

        Raises ControllerError: the same, if there is no recovery from it.
        """
        error = self._session.cause_of(error)
        steady = self.on and now_s - self._on_since_s >= STEADY_S
        if self.on:
            self._off_since_s = now_s
        self.on = self.idle = self.waking = self.ramping_down = False
        if isinstance(error, HostSilent):
            self._counters.host_silent += 1
            self._stalls = 1 if steady else self._stalls + 1
        else:
            self._counters.outages += 1
            self._counters.outage = str(error)
            for cause in _causes(error):
                self._counters.outage_causes[cause] = self._counters.outage_causes.get(cause, 0) + 1
        self._recovery.begin(error, now_s)
        if isinstance(error, HostSilent) and self._stalls > 1:
            pause_s = min(STALL_PAUSE_S * 2.0 ** min(self._stalls - 2, 16), STALL_PAUSE_MAX_S)
            self._counters.stall_pauses += 1
            self._recovery.hold(
                now_s + pause_s,
                f"{error} ({self._stalls} times in a row: the machine is too slow or too busy; armed again after {pause_s:g} s)",
            )

    def emission_started(self) -> None:
        """Take note that an emission was played: a later stall is not in a row with an earlier one."""
        self._stalls = 0

    def begin_idle(self) -> None:
        """Have the outputs ramp to 0 V, and send nothing once they are off: an FPGA whose outputs are off needs no heartbeats.

        Raises LinkError or FaultError as `disarm`.
        """
        self.disarm()
        self.idle = True
        self._counters.idled += 1

    def wake(self) -> None:
        """End an idle time: the FPGA is verified and armed in the next turns.

        Raises ControllerError: a fault of the FPGA or an error of the link: to be given to `failed`.
        """
        self.idle, self.waking = False, True
        self._woken_s = self._clock.now_s()
        self._recovery.resume(max(self._woken_s, self._down_s))
        self._heartbeat()  # what is due from now on is in the FPGA's time

    def disarm(self) -> None:
        """Have the outputs ramp to 0 V, also if they are only coming on; `ramping_down` until a status says that they are off.

        Raises LinkError or FaultError if the FPGA does not acknowledge it; it switches off by its heartbeat timeout then.
        """
        if self.ramping_down or not self.may_be_on:
            return
        if self.on:
            self._off_since_s = self._clock.now_s()
        self.on, self.ramping_down = False, True
        self._down_s = self._session.disarm()
        self._recovery.disarmed(self._down_s)

    def ramped_down(self, now_s: float) -> bool:
        """Whether no ramp down is left to wait for, as a status has said; heartbeats are sent until then.

        Raises StillOn if none has said so in time; LinkError or FaultError as the session says.
        """
        if not self.ramping_down:
            return True
        if now_s < min(self._down_s, self._session.heartbeat_due_s):
            return False
        self._heartbeat()
        if self._session.on_anywhere and now_s >= self._down_s + OFF_LATE_S:
            raise StillOn(f"the FPGA still has its outputs on {OFF_LATE_S * 1e3:g} ms after the end of their ramp to 0 V")
        self.ramping_down = self._session.on_anywhere
        return not self.ramping_down

    def switch_off(self) -> None:
        """Disarm, and wait until the outputs are off: with heartbeats while the FPGA answers, without any if it does not.

        Raises ControllerError if the FPGA reports a fault that the host must not clear; the outputs are off then, too.
        """
        clock = self._clock
        with selectors.DefaultSelector() as nothing:  # neither touches nor signals end this
            try:
                self.disarm()
                while not self.ramped_down(clock.now_s()):
                    clock.wait(nothing, self.next_s())
            except (LinkError, FaultError) as error:
                try:
                    self.failed(error, clock.now_s())
                finally:
                    while self.may_be_on:
                        clock.wait(nothing, self.off_by_s)

    def _heartbeat(self) -> None:
        before_s = self._clock.now_s()
        status = self._session.heartbeat()
        sent_s = max(before_s, self._session.wire_free_s())  # not later: what came back may have been read late
        self._clock_estimate.add(before_s, sent_s, status.timestamp_ticks)
        self._counters.heartbeats += 1


def _causes(error: ControllerError) -> list[str]:
    """Names of the faults of an outage; LINK where the FPGA named none."""
    return [cause.name or "" for cause in Fault if isinstance(error, FaultError) and error.faults & cause] or ["LINK"]
