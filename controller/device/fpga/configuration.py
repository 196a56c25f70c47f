"""Identity and limits that an FPGA must have, and the settings it is given, before it may be armed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from controller.device.board.board import Board
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.exchange import ATTEMPTS, DAMAGED, Exchange, Refused
from controller.device.fpga.registers import CHANNELS, IDENTITY_MAGIC, PROTOCOL_VERSION, Register, Result
from controller.errors import LinkError

LIMITS: Final = {  # built into the gateware, with the key of board.toml that each comes from
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
PERMANENT: Final = frozenset({Result.BAD_VALUE, Result.UNKNOWN_REGISTER, Result.READ_ONLY})  # refusals that a retry cannot change
PIPELINE_SAMPLES: Final = 5  # margin of a ramp: current word, idle word, pipeline delay


class IncompatibleFpga(LinkError):
    """The FPGA is not the one that this software and this board need; waiting does not change it."""

    exit_code = 78


class OtherGateware(IncompatibleFpga):
    """It has another gateware, or one that was built for another board: another bitstream changes that."""


def verify(read: Callable[[Register], int], board: Board, build_hash: int) -> None:
    """Check that the FPGA has the gateware this host was made for, built with the limits of this board.

    Raises OtherGateware if its identity, protocol, gateware, clock, size or a limit is another; LinkError if it does not answer.
    """
    expected = {
        Register.IDENTITY: IDENTITY_MAGIC,
        Register.PROTOCOL: PROTOCOL_VERSION,
        Register.BUILD_HASH: build_hash,
        Register.CLOCK_HZ: board.link.clock_hz,
    }
    for register, value in expected.items():
        found = read(register)
        if found != value and (found := read(register)) != value:  # nothing is refused for one reading
            raise OtherGateware(
                f"the FPGA's {register.name} is 0x{found:08X}, not 0x{value:08X}: load the gateware that belongs to this host"
            )
    for _ in range(2):
        geometry = read(Register.GEOMETRY)
        slots, depth, channels = geometry & 0xFF, geometry >> 8 & 0xFFFF, geometry >> 24
        if slots >= board.link.slots and depth >= board.waveform.samples and channels == CHANNELS:
            break
    else:
        raise OtherGateware(
            f"the FPGA has {slots} slots of {depth} words and {channels} channels; "
            f"the board asks for {board.link.slots}, {board.waveform.samples} and {CHANNELS}"
        )
    wanted = limits(board)
    built = {register: read(register) for register in wanted}
    built |= {register: read(register) for register in wanted if built[register] != wanted[register]}
    other = [f"{of.name} is {built[of]}, not {wanted[of]} ({LIMITS[of]})" for of in wanted if built[of] != wanted[of]]
    if other:
        raise OtherGateware(
            f"the FPGA was built with the limits of another board: {'; '.join(other)};"
            f" build its gateware with the limits of this one: haptic-panel gateware build --board {board.folder}"
        )


def limits(board: Board) -> dict[Register, int]:
    """Limits that the board's gateware must be built with, by register."""
    parameters = BuildParameters.of(board, 0)
    return {register: getattr(parameters, register.name.lower()) for register in LIMITS}


def settings(board: Board) -> dict[Register, int]:
    """Settings of a board, by register, in the order in which they are written; limits are set to those built in."""
    built = BuildParameters.of(board, 0).verilog()
    after_reset = {register: register.reset for register in Register if register.access == "RW"}
    values = {register: reset if isinstance(reset, int) else built[reset] for register, reset in after_reset.items()}
    return values | {Register.IDLE_WORD: board.idle_word}


def write_settings(exchange: Exchange, board: Board, bit_period: int) -> None:
    """Write the board's settings, and read each back.

    `bit_period`, in 65536ths of an FPGA clock, takes the place of the board's. Raises IncompatibleFpga if the FPGA refuses a value
    for good; LinkError if it refuses one for now, or reads back another each time that it is written.
    """
    for register, value in (settings(board) | {Register.BIT_PERIOD: bit_period}).items():
        if not any(_kept(exchange, register, value) for _ in range(ATTEMPTS)):
            raise LinkError(f"the FPGA did not keep the value of {register.name}, written {ATTEMPTS} times")


def _kept(exchange: Exchange, register: Register, value: int) -> bool:
    """Write a register; whether it is read back so, at the second reading at the latest."""
    try:
        exchange.write(register, value)
    except Refused as refusal:
        if refusal.result in DAMAGED:
            raise
        kind = IncompatibleFpga if refusal.result in PERMANENT else LinkError
        raise kind(f"the FPGA does not take {value} for {register.name}: {refusal.result.sentence}") from refusal
    return any(exchange.read(register) == value for _ in range(2))


def ramp_ticks(board: Board, bit_period: int) -> int:
    """FPGA clocks from DISARM to the end of the ramp of `board`, with `bit_period` in 65536ths of a clock."""
    return (BuildParameters.of(board, 0).ramp_samples_reset + PIPELINE_SAMPLES) * bit_period >> 16


def arming_ticks(board: Board, bit_period: int) -> int:
    """FPGA clocks from ARM to the end of the ramp of `board`, with settling of the high voltage; as in `ramp_ticks`."""
    return BuildParameters.of(board, 0).hv_settle_ticks + ramp_ticks(board, bit_period)
