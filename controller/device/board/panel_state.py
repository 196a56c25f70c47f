"""State of the panel, in the words that `systemctl status`, log, socket and exit share."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class PanelState(Enum):
    """State of the panel; if several apply, the first."""

    WAITING_FOR_FPGA = "waiting for FPGA"  # its device is missing, or it does not answer
    NO_PERMIT = "no permit"  # the run permit is missing; outputs stay off until it is given
    FAULTED = "faulted"  # the FPGA has switched off, or cannot be armed, for another reason
    RAMPING = "ramping"  # outputs are on their way from 0 V, or back there: there is voltage at the actuators
    DISARMED = "disarmed"  # a client has switched the panel off
    WAITING_FOR_PANEL = "waiting for panel"  # no touch panel; commands and fixed emitters are still played
    IDLE = "idle"  # nothing was touched for `idle_disarm_s`: outputs are off until the next touch
    PLAYING = "playing"  # something was played within the last second
    ARMED = "armed"  # outputs are on


PLAYS = frozenset({PanelState.WAITING_FOR_PANEL, PanelState.PLAYING, PanelState.ARMED})  # where outputs are on


@dataclass(frozen=True, slots=True)
class Condition:
    """State of the panel, with its cause and what clients show beside it."""

    state: PanelState = PanelState.WAITING_FOR_FPGA
    cause: str = ""  # why not everything works; empty if everything does
    # Whether there may be voltage at the actuators. False only once a status of the FPGA has said that its outputs are off, or
    # it has certainly switched them off by its heartbeat timeout. Plays are accepted in the states ARMED, PLAYING and IDLE, and
    # in WAITING_FOR_PANEL where this is true
    outputs_on: bool = False
    panel_present: bool = True  # whether the touch panel is connected
    temperature_c: float | None = None  # temperature of the plate; None if unknown
