"""What an FPGA has to be, and what it is told, before it may be armed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from controller.board.board import Board
from controller.errors import LinkError
from controller.fpga.build_parameters import Parameters
from controller.fpga.registers import CHANNELS, IDENTITY_MAGIC, PROTOCOL_VERSION, Register

LIMITS: Final = {  # fixed when the gateware is built, and the key of board.toml that each comes from
    Register.CHANNEL_MASK_MAX: "actuators",
    Register.HV_SETTLE_TICKS: "limits.hv_settle_us",
    Register.HEARTBEAT_TICKS_MAX: "limits.heartbeat_timeout_ms",
    Register.EDGE_WINDOW_TICKS: "link.clock_hz",
    Register.PULSE_TICKS_MIN: "limits.min_pulse_us",
    Register.CHANNEL_EDGES_MAX: "limits.max_channel_edge_rate_hz",
    Register.TOTAL_EDGES_MAX: "limits.max_total_edge_rate_hz",
    Register.EMISSION_TICKS_MAX: "limits.longest_emission_ms",
    Register.DUTY_SHARE_MAX: "limits.max_duty",
    Register.DUTY_TICKS_MAX: "limits.duty_budget_ms",
}


class UnfitFpga(LinkError):
    """Another FPGA than this software and this board need: it says so itself, and waiting does not change it."""


def verify(read: Callable[[Register], int], board: Board, build_hash: int) -> None:
    """Refuse any FPGA but the one this host was made for, with the limits of this board.

    Raises
    ------
    UnfitFpga
        If it is another one, too small for the board, or built for another.
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
    built = {register: (read(register), value) for register, value in limits(board).items()}
    other = [
        f"{register.name} is {found}, not {value} ({LIMITS[register]})"
        for register, (found, value) in built.items()
        if found != value
    ]
    if other:
        raise UnfitFpga(
            f"the FPGA was built with the limits of another board: {'; '.join(other)};"
            f" build its gateware with {board.folder / 'board.toml'} (make BOARD_TOML=..., in the folder of its top.v)"
        )


def limits(board: Board) -> dict[Register, int]:
    """Registers with the limits that the gateware has to be built with."""
    parameters = Parameters.of(board, 0)
    return {register: getattr(parameters, register.name.lower()) for register in LIMITS}


def settings(board: Board) -> dict[Register, int]:
    """Registers as the board says, in the order in which they are written: the limits are those built in."""
    built = Parameters.of(board, 0).verilog()
    after_reset = {register: register.reset for register in Register if register.access == "RW"}
    values = {register: reset if isinstance(reset, int) else built[reset] for register, reset in after_reset.items()}
    return values | {Register.IDLE_WORD: board.idle_word}


def ramp_ticks(board: Board, bit_period: int) -> int:
    """Clocks from DISARM until the outputs have arrived, and from ARM once the high voltage has settled."""
    samples = (
        Parameters.of(board, 0).ramp_samples_reset + 5
    )  # the word that sounds, the idle word behind it, and the FPGA its own way
    return samples * bit_period >> 16


def arming_ticks(board: Board, bit_period: int) -> int:
    """Clocks from ARM until the outputs have arrived."""
    return Parameters.of(board, 0).hv_settle_ticks + ramp_ticks(board, bit_period)
