"""How the panel is: the words that status, log, socket and exit share."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class PanelState(Enum):
    """One word for all of it; of several that hold, the first of these."""

    WAITING_FOR_FPGA = "waiting for FPGA"  # its device is not there, or it does not answer
    NO_PERMIT = "no permit"  # the run permit is missing: outputs stay off until it is given
    FAULTED = "faulted"  # the FPGA has switched off, or may not be armed, for another reason
    DISARMED = "disarmed"  # a client has switched the panel off
    WAITING_FOR_PANEL = "waiting for panel"  # no touch panel; commands and spots are played
    PLAYING = "playing"  # something was felt within the last second
    ARMED = "armed"  # outputs are on; what is touched is felt


@dataclass(frozen=True, slots=True)
class Condition:
    """The state with what explains it.

    Attributes
    ----------
    state : PanelState
    cause : str
        Why not everything works, in words; empty while it does, or while it is being switched on.
    outputs_on : bool
        Whether plays are taken.
    panel_present : bool
        Whether the touch panel is there.
    temperature_c : float or None
        Of the plate; None where it is not known.
    """

    state: PanelState = PanelState.WAITING_FOR_FPGA
    cause: str = ""
    outputs_on: bool = False
    panel_present: bool = True
    temperature_c: float | None = None
