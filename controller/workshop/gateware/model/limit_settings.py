"""Settings of the stage limits in the gateware model, and the bits of their causes: ports of `stage_limits.v`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

SHORT_PULSE, CHANNEL_EDGES, TOTAL_EDGES, LONG_EMISSION, DUTY = (1 << bit for bit in range(5))  # of `cause_o`
DUTY_FULL_FLOW: Final = 1 << 16  # into the duty bucket in an active tick


@dataclass
class LimitSettings:
    """Values of the limit registers, written while nothing plays. After writing `duty_share`, call `StageLimits.activity`."""

    pulse_ticks: int = 0
    channel_edges: int = 2**32 - 1
    total_edges: int = 2**32 - 1
    emission_ticks: int = 2**32 - 1
    duty_share: int = DUTY_FULL_FLOW
    duty_ticks: int = 2**32 - 1
