"""The way to armed, a step at a time, at the start and after a loss, and the rule of what is done about an error.

| lost by | then |
|---|---|
| HOST_SILENT: this process stalled | again at once |
| link error, reset, brown-out | again when the FPGA has surely switched off, then after ever longer pauses up to 2 s |
| NO_PERMIT, OVER_TEMPERATURE | wait until the permit is back, then again |
| another FPGA, or one that does not take the board's settings | the end: waiting does not cure it |
| edges, duty, short pulse, long emission, underrun | the end: a fault of the host or the board, which the same again would repeat |

Again is: identity, settings, arming. Outputs are off all the way: the first thing is to disarm as well as it can be
done, and what does not hear that switches off by its heartbeat timeout.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import Final

from controller.board.board import Board
from controller.board.panel_state import PanelState
from controller.errors import ControllerError, FaultError, LinkError
from controller.fpga.configuration import IncompatibleFpga
from controller.fpga.exchange import Refused
from controller.fpga.registers import Fault, Result, State
from controller.fpga.session import Session

WAITED_FOR: Final = Fault.NO_PERMIT | Fault.OVER_TEMPERATURE
PERMITS: Final = State.RUN_PERMIT | State.TEMPERATURE_GOOD
PERMIT_POLL_S: Final = 0.1
LONGEST_PAUSE_S: Final = 2.0


class Action(Enum):
    """What to do about an error."""

    RETRY = "retry"
    WAIT_FOR_PERMIT = "wait for permit"
    FAIL = "fail"


def action_for(error: ControllerError) -> Action:
    """What the rule says about an error of the link or the FPGA."""
    if isinstance(error, FaultError):
        faults = Fault(error.faults)
        if not faults or faults & ~(WAITED_FOR | Fault.HOST_SILENT):
            return Action.FAIL
        return Action.WAIT_FOR_PERMIT if faults & WAITED_FOR else Action.RETRY
    if isinstance(error, Refused) and error.result is Result.NO_PERMIT:
        return Action.WAIT_FOR_PERMIT
    if isinstance(error, IncompatibleFpga):
        return Action.FAIL
    return Action.RETRY if isinstance(error, LinkError) else Action.FAIL


def arming_permitted(state: State) -> bool:
    """Whether run permit and temperature allow arming."""
    return state & PERMITS == PERMITS


def panel_state_after(error: ControllerError) -> PanelState:
    """How the panel is called while an error is being got over."""
    if isinstance(error, FaultError):
        return PanelState.NO_PERMIT if Fault.NO_PERMIT in Fault(error.faults) else PanelState.FAULTED
    if isinstance(error, Refused) and error.result is Result.NO_PERMIT:
        return PanelState.NO_PERMIT
    return PanelState.WAITING_FOR_FPGA


class Recovery:
    """The way to armed: call `step` whenever the time `next_s` has come, until it returns True; after a loss `begin` again.

    Parameters
    ----------
    session : Session
        It need not be brought up.
    board : Board

    Attributes
    ----------
    next_s : float
        When to call `step`, on the loop's clock.
    wanted : bool
        Whether to arm at all: otherwise it ends where arming would be possible, and keeps the FPGA fed.
    state : PanelState
        The newest; while outputs are being armed the one before.
    cause : str
        Why outputs are off, in words for the user: the newest; empty before anything was tried.
    """

    def __init__(self, session: Session, board: Board) -> None:
        self.next_s = -math.inf
        self.wanted = True
        self.state = PanelState.WAITING_FOR_FPGA
        self.cause = ""
        self._session = session
        self._safe_s = (board.limits.heartbeat_timeout_ms + board.limits.ramp_ms) * 1e-3
        self._pause_s = self._safe_s
        self._known = True  # no error since identity and settings were found right, if ever they were
        self._armed_s: float | None = None  # when the ramp that runs ends

    def begin(self, error: ControllerError, now_s: float) -> None:
        """Switch outputs off and plan the first attempt.

        Raises
        ------
        ControllerError
            The same one, if the rule says that it is the end.
        """
        self._session.off()
        self._pause_s = self._safe_s
        self._fail(error, now_s)
        if isinstance(error, FaultError):  # it is off already
            self.next_s = now_s

    def disarmed(self, off_s: float) -> None:
        """Outputs are gliding to 0 V, at which they are at `off_s`: the next step is then."""
        self.next_s = off_s
        self._pause_s = self._safe_s

    def step(self, now_s: float) -> bool:
        """Do what is next; True once the outputs have arrived at their idle levels. All slots are to be taken as empty.

        Raises
        ------
        ControllerError
            If something turns up that is the end.
        """
        try:
            return self._next(now_s)
        except (LinkError, FaultError) as error:
            self._session.off()
            self._fail(error, now_s)
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
                self.state, self.cause = (
                    PanelState.FAULTED,
                    "the temperature input is low: the stages are too hot, or it is not wired",
                )
            else:
                self.state, self.cause = PanelState.NO_PERMIT, "the run permit is not given: look at its switch or line"
            self.next_s = now_s + PERMIT_POLL_S
            return False
        if not self.wanted:
            self.state, self.cause = PanelState.DISARMED, "a client has switched the panel off"
            self.next_s = session.heartbeat_due_s
            return False
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
        self.next_s = now_s + (self._pause_s if action is Action.RETRY else PERMIT_POLL_S)
        if action is Action.RETRY:
            self._pause_s = min(2 * self._pause_s, LONGEST_PAUSE_S)
