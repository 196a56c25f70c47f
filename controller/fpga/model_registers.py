"""Registers of the gateware model that hold a setting or say what the FPGA is: `register_file.v`."""

from __future__ import annotations

from controller.fpga.registers import (
    BIT_CLOCK_HZ_RESET,
    BIT_TICKS_MAX,
    BIT_TICKS_MIN,
    CHANNELS,
    IDENTITY_MAGIC,
    PROTOCOL_VERSION,
    RAMP_SAMPLES_MAX,
    RAMP_SAMPLES_RESET,
    REGISTERS,
    WAVEFORM_WORDS,
    Register,
    Result,
)

_ALL_ONES = 0xFFFFFFFF


class RegisterFile:
    """Settings by name; everything else by address."""

    def __init__(self, clock_hz: int, slots: int, build_hash: int, heartbeat_ticks_max: int) -> None:
        self._values = {
            Register.IDENTITY: IDENTITY_MAGIC,
            Register.PROTOCOL: PROTOCOL_VERSION,
            Register.BUILD_HASH: build_hash,
            Register.CLOCK_HZ: clock_hz,
            Register.GEOMETRY: slots | WAVEFORM_WORDS << 8 | CHANNELS << 24,
            Register.IDLE_WORD: 0,
            Register.BIT_TICKS: max(BIT_TICKS_MIN, clock_hz // BIT_CLOCK_HZ_RESET),
            Register.RAMP_SAMPLES: RAMP_SAMPLES_RESET,
            Register.HEARTBEAT_TICKS: heartbeat_ticks_max,
            Register.CHANNEL_MASK: _ALL_ONES,
        }
        self._limits = {
            Register.IDLE_WORD: (0, _ALL_ONES),
            Register.BIT_TICKS: (BIT_TICKS_MIN, BIT_TICKS_MAX),
            Register.RAMP_SAMPLES: (1, RAMP_SAMPLES_MAX),
            Register.HEARTBEAT_TICKS: (1, heartbeat_ticks_max),
            Register.CHANNEL_MASK: (0, _ALL_ONES),
        }

    @property
    def build_hash(self) -> int:
        """Hash of the Verilog that ARM has to name."""
        return self._values[Register.BUILD_HASH]

    @property
    def idle_word(self) -> int:
        """Level of each channel while armed and not playing, masked."""
        return self._values[Register.IDLE_WORD] & self.channel_mask

    @property
    def bit_ticks(self) -> int:
        """Clocks one drive word is held."""
        return self._values[Register.BIT_TICKS]

    @property
    def ramp_samples(self) -> int:
        """Drive words in a ramp."""
        return self._values[Register.RAMP_SAMPLES]

    @property
    def heartbeat_ticks(self) -> int:
        """Clocks without a good frame until the host counts as silent."""
        return self._values[Register.HEARTBEAT_TICKS]

    @property
    def channel_mask(self) -> int:
        """Channels that may move."""
        return self._values[Register.CHANNEL_MASK]

    def read(self, address: int) -> int | None:
        """Value of a register that is kept here; None if it is kept elsewhere."""
        return self._values.get(Register(address))

    def write(self, address: int, value: int, *, disarmed: bool) -> Result:
        """Change a setting, or say why not."""
        if address not in set(Register):
            return Result.UNKNOWN_REGISTER
        register = Register(address)
        if REGISTERS[register].access == "RO":
            return Result.READ_ONLY
        if not disarmed:
            return Result.ARMED
        low, high = self._limits[register]
        if not low <= value <= high:
            return Result.BAD_VALUE
        self._values[register] = value
        return Result.OK
