"""What an FPGA has to be, and what it is told, before it may be armed."""

from __future__ import annotations

import math
from collections.abc import Callable

from controller.board import Board
from controller.errors import LinkError
from controller.fpga.registers import CHANNELS, DUTY_FULL, IDENTITY_MAGIC, PROTOCOL_VERSION, Register


class UnfitFpga(LinkError):
    """Another FPGA than this software and this board need: it says so itself, and waiting does not change it."""


def ramp_samples(board: Board) -> int:
    """Drive words in the ramp of a board."""
    return max(1, round(board.limits.ramp_ms * 1e-3 * board.waveform.bit_clock_hz))


def verify(read: Callable[[Register], int], board: Board, build_hash: int) -> None:
    """Refuse any FPGA but the one this host was made for.

    Raises
    ------
    UnfitFpga
        If it is another one, or too small for the board.
    LinkError
        If it does not answer.
    """
    expected = {
        Register.IDENTITY: IDENTITY_MAGIC,
        Register.PROTOCOL: PROTOCOL_VERSION,
        Register.BUILD_HASH: build_hash,
        Register.CLOCK_HZ: board.link.clock_hz,
    }
    for register, value in expected.items():
        found = read(register)
        if found != value:
            raise UnfitFpga(
                f"the FPGA's {register.name} is 0x{found:08X}, not 0x{value:08X}: load the gateware that belongs to this host"
            )
    geometry = read(Register.GEOMETRY)
    slots, depth, channels = geometry & 0xFF, geometry >> 8 & 0xFFFF, geometry >> 24
    if slots < board.link.slots or depth < board.waveform.samples or channels != CHANNELS:
        raise UnfitFpga(
            f"the FPGA has {slots} slots of {depth} words and {channels} channels; "
            f"the board asks for {board.link.slots}, {board.waveform.samples} and {CHANNELS}"
        )


def settings(board: Board, edge_window_ticks: int) -> dict[Register, int]:
    """Registers as the board says, in the order in which they are written.

    Parameters
    ----------
    edge_window_ticks : int
        Over which the FPGA counts edges.
    """
    limits, clock_hz = board.limits, board.link.clock_hz
    window_s = edge_window_ticks / clock_hz
    return {
        Register.IDLE_WORD: board.idle_word,
        Register.CHANNEL_MASK: board.channel_mask,
        Register.BIT_PERIOD: board.bit_period,
        Register.RAMP_SAMPLES: ramp_samples(board),
        Register.HEARTBEAT_TICKS: round(limits.heartbeat_timeout_ms * 1e-3 * clock_hz),
        Register.PULSE_TICKS: math.floor(limits.min_pulse_us * 1e-6 * clock_hz),
        Register.CHANNEL_EDGES: math.floor(limits.max_channel_edge_rate_hz * window_s),
        Register.TOTAL_EDGES: math.floor(limits.max_total_edge_rate_hz * window_s),
        Register.EMISSION_TICKS: round(limits.longest_emission_ms * 1e-3 * clock_hz),
        Register.DUTY_SHARE: round(limits.max_duty * DUTY_FULL),
        Register.DUTY_TICKS: round(limits.duty_budget_ms * 1e-3 * clock_hz),
    }
