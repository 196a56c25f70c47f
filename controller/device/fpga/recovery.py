"""Arming at the start and after a failure, one step at a time, and the rule for what to do after each error.

| failure | then |
|---|---|
| HOST_SILENT: this process stalled | retry at once; arm later and later if it stalls again and again (`hold`) |
| link error, reset, brown-out | retry once the FPGA has certainly switched off, then after pauses that double up to 2 s |
| NO_PERMIT, OVER_TEMPERATURE | wait until the permit is back, then retry |
| another FPGA, or one that refuses the board's settings | fail: waiting does not help |
| edges, duty, short pulse, long emission, underrun | fail: a fault of the host or the board, which a retry would repeat |

A retry checks identity, writes the settings and arms. Outputs stay off until then: the first step is a DISARM, and an FPGA that
does not receive it switches off by its heartbeat timeout.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import Final

from controller.device.board.board import Board
from controller.device.board.panel_state import PanelState
from controller.device.fpga.configuration import IncompatibleFpga
from controller.device.fpga.exchange import Refused
from controller.device.fpga.registers import Fault, Result, State
from controller.device.fpga.supervision import StillOn, Supervision
from controller.errors import ControllerError, FaultError, LinkError

PERMIT_FAULTS: Final = Fault.NO_PERMIT | Fault.OVER_TEMPERATURE
PERMITS: Final = State.RUN_PERMIT | State.TEMPERATURE_GOOD
PERMIT_POLL_S: Final = 0.1
PAUSE_MAX_S: Final = 2.0


class Action(Enum):
    """What to do about an error."""

    RETRY = "retry"
    WAIT_FOR_PERMIT = "wait for permit"
    FAIL = "fail"


def action_for(error: ControllerError) -> Action:
    """What to do after an error of the link or the FPGA, by the table of this module."""
    if isinstance(error, FaultError):
        faults = Fault(error.faults)
        if not faults or faults & ~(PERMIT_FAULTS | Fault.HOST_SILENT):
            return Action.FAIL
        return Action.WAIT_FOR_PERMIT if faults & PERMIT_FAULTS else Action.RETRY
    if isinstance(error, Refused) and error.result is Result.NO_PERMIT:
        return Action.WAIT_FOR_PERMIT
    if isinstance(error, IncompatibleFpga):
        return Action.FAIL
    return Action.RETRY if isinstance(error, LinkError) else Action.FAIL


def arming_permitted(state: State) -> bool:
    """Whether run permit and temperature allow arming, by the state bits of a status."""
    return state & PERMITS == PERMITS


def panel_state_after(error: ControllerError) -> PanelState:
    """State of the panel while it recovers from an error."""
    if isinstance(error, FaultError):
        return PanelState.NO_PERMIT if Fault.NO_PERMIT in Fault(error.faults) else PanelState.FAULTED
    if isinstance(error, StillOn):
        return PanelState.FAULTED
    if isinstance(error, Refused) and error.result is Result.NO_PERMIT:
        return PanelState.NO_PERMIT
    return PanelState.WAITING_FOR_FPGA


class Recovery:
    """Brings the FPGA to armed: call `step` whenever `next_s` has come, until it returns True; after a failure call `begin`."""

    def __init__(self, session: Supervision, board: Board) -> None:
        self.next_s = -math.inf  # when to call `step`, on the loop's clock
        self.wanted = True  # whether to arm; otherwise the steps stop before ARM and only send heartbeats
        self.unwanted_cause = ""  # why not to arm
        self.state = PanelState.WAITING_FOR_FPGA  # newest state; while the outputs ramp up, the one before
        self.cause = ""  # newest reason for the outputs being off, for the user; empty before the first step
        # When the FPGA has switched off by itself at the latest, whatever became of what was sent: after an error
        self.off_by_s = math.inf
        self._session = session
        self._safe_s = (board.limits.heartbeat_timeout_ms + board.limits.ramp_ms) * 1e-3
        self._pause_s = self._safe_s
        self._known = True  # no error since identity and settings were last verified
        self._armed_s: float | None = None  # when the ramp in progress ends
        self._hold_s = -math.inf  # nothing is armed before
        self._hold_cause = ""

    @property
    def arming(self) -> bool:
        """Whether ARM was accepted, and the ramp up has not ended."""
        return self._armed_s is not None

    def begin(self, error: ControllerError, now_s: float) -> None:
        """Switch the outputs off and schedule the first retry; raises `error` itself if the rule is to fail."""
        self._session.off()
        self._pause_s = self._safe_s
        self._fail(error, now_s)
        if isinstance(error, FaultError):  # it is off already
            self.next_s = now_s

    def disarmed(self, off_s: float) -> None:
        """Note that the outputs were disarmed and their ramp ends at `off_s`, on the loop's clock; the next step is then."""
        self.next_s = off_s
        self._pause_s = self._safe_s
        self._armed_s = None

    def hold(self, until_s: float, cause: str) -> None:
        """Arm no earlier than `until_s`, on the loop's clock, for this cause; everything else is done meanwhile."""
        self._hold_s, self._hold_cause = until_s, cause

    def resume(self, now_s: float) -> None:
        """Arm after a time in which nothing was sent: the FPGA may have been reset meanwhile, and is verified first."""
        self.next_s = now_s
        self._known = False

    def step(self, now_s: float) -> bool:
        """Do the next step; True once the outputs are at their idle levels: consider all slots empty then.

        Raises ControllerError if an error occurs for which the rule is to fail.
        """
        try:
            return self._next(now_s)
        except (LinkError, FaultError) as error:
            cause = self._session.cause_of(error)
            self._session.off()
            self._fail(cause, now_s)
            return False

    def _next(self, now_s: float) -> bool:
        session = self._session
        if self._armed_s is not None:
            if now_s >= self._armed_s:
                session.require_armed()
                self._armed_s = None
                return True
            session.heartbeat()
            self.next_s = min(self._armed_s, session.heartbeat_due_s)
            return False
        if not self._known or not session.fresh:
            session.bring_up()
            self._known = True
        state = session.heartbeat().state
        if not arming_permitted(state):
            if State.RUN_PERMIT in state:
                self.state = PanelState.FAULTED
                self.cause = "the temperature input is low: the stages are too hot, or it is not wired"
            else:
                self.state = PanelState.NO_PERMIT
                self.cause = "the run permit is not given: look at its switch or line"
            self.next_s = now_s + PERMIT_POLL_S
            return False
        if not self.wanted:
            self.state, self.cause = PanelState.DISARMED, self.unwanted_cause
            self.next_s = session.heartbeat_due_s
            return False
        if now_s < self._hold_s:
            self.state, self.cause = PanelState.FAULTED, self._hold_cause
            self.next_s = min(self._hold_s, session.heartbeat_due_s)
            return False
        self.off_by_s = math.inf
        self._armed_s = session.arm()
        self.next_s = min(self._armed_s, session.heartbeat_due_s)
        return False

    def _fail(self, error: ControllerError, now_s: float) -> None:
        self.state = panel_state_after(error)
        self.cause = str(error)
        action = action_for(error)
        if action is Action.FAIL:
            raise error
        self._known = False
        self._armed_s = None
        if self.off_by_s == math.inf or isinstance(error, StillOn):
            self.off_by_s = self._session.quiet_since_s + self._safe_s
        self.next_s = now_s + (self._pause_s if action is Action.RETRY else PERMIT_POLL_S)
        if action is Action.RETRY:
            self._pause_s = min(2 * self._pause_s, PAUSE_MAX_S)
