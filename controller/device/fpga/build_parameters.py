"""Parameters built into the gateware, from the limits and the link of a board."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Self

from controller.device.board.board import Board
from controller.device.board.panel import EDGE_WINDOW_S
from controller.device.fpga.registers import DUTY_FULL


@dataclass(frozen=True)
class BuildParameters:
    """Parameters built into the gateware, named as in `haptic_core.v`, in lower case.

    The limits are hard: the FPGA does not exceed them, whatever the host writes.
    """

    clock_hz: int
    slots: int
    build_hash: int
    board: int
    bit_period_reset: int
    ramp_samples_reset: int
    channel_mask_max: int
    hv_settle_ticks: int
    heartbeat_ticks_max: int
    edge_window_ticks: int
    pulse_ticks_min: int
    channel_edges_max: int
    total_edges_max: int
    emission_ticks_max: int
    duty_share_max: int
    duty_ticks_max: int

    @classmethod
    def of(cls, board: Board, build_hash: int) -> Self:
        """Parameters of a board: its bitstream and its simulation are built with them, and bring-up requires them."""
        limits, clock_hz = board.limits, board.link.clock_hz
        return cls(
            clock_hz=clock_hz,
            slots=board.link.slots,
            build_hash=build_hash,
            board=int.from_bytes(b"SIM ", "little"),  # a bitstream has the letters of its own top.v
            bit_period_reset=board.bit_period,
            ramp_samples_reset=max(1, round(limits.ramp_ms * 1e-3 * board.waveform.bit_clock_hz)),
            channel_mask_max=board.channel_mask,
            hv_settle_ticks=math.ceil(limits.hv_settle_us * 1e-6 * clock_hz),
            heartbeat_ticks_max=round(limits.heartbeat_timeout_ms * 1e-3 * clock_hz),
            edge_window_ticks=round(clock_hz * EDGE_WINDOW_S),
            pulse_ticks_min=math.floor(limits.min_pulse_us * 1e-6 * clock_hz),
            channel_edges_max=math.floor(limits.max_channel_edge_rate_hz * EDGE_WINDOW_S),
            total_edges_max=math.floor(limits.max_total_edge_rate_hz * EDGE_WINDOW_S),
            emission_ticks_max=round(limits.longest_emission_ms * 1e-3 * clock_hz),
            duty_share_max=round(limits.max_duty * DUTY_FULL),
            duty_ticks_max=round(limits.duty_budget_ms * 1e-3 * clock_hz),
        )

    def verilog(self) -> dict[str, int]:
        """Parameters by their names in the Verilog."""
        return {name.upper(): value for name, value in asdict(self).items()}


def top_parameters(board: Board, build_hash: int) -> dict[str, int]:
    """Parameters of a board's top.v, which has the letters of its board itself, by their names."""
    parameters = BuildParameters.of(board, build_hash).verilog()
    del parameters["BOARD"]
    return parameters
