"""What is done about a panel that was lost: the rule.

| lost by | then |
|---|---|
| HOST_SILENT: this process stalled | again at once |
| link error, reset, brown-out | again, after a pause in which the FPGA has surely switched off |
| NO_PERMIT, OVER_TEMPERATURE, also while arming | wait until the permit is back, then again |
| edges, duty, short pulse, long emission, underrun | the end: a fault of the host or the board, which the same again would repeat |

Again is: disarm as well as it can be done, then `Session.bring_up` (identity, faults cleared, settings) and `arm`. What
does not hear the first switches off by its heartbeat timeout, so outputs are off all the way.
"""

from __future__ import annotations

from enum import Enum
from typing import Final

from controller.errors import ControllerError, FaultError, LinkError
from controller.fpga.exchange import Refused
from controller.fpga.registers import Fault, Result

WAITED_FOR: Final = Fault.NO_PERMIT | Fault.OVER_TEMPERATURE


class Recovery(Enum):
    """What to do about an error."""

    AGAIN = "again"
    WAIT = "wait"
    END = "end"


def recovery_from(error: ControllerError) -> Recovery:
    """What the rule says about an error of the link or the FPGA."""
    if isinstance(error, FaultError):
        faults = Fault(error.faults)
        if not faults or faults & ~(WAITED_FOR | Fault.HOST_SILENT):
            return Recovery.END
        return Recovery.WAIT if faults & WAITED_FOR else Recovery.AGAIN
    if isinstance(error, Refused) and error.result is Result.NO_PERMIT:
        return Recovery.WAIT
    return Recovery.AGAIN if isinstance(error, LinkError) else Recovery.END
