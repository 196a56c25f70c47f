"""Registers of the gateware model that hold a setting or say what the FPGA is: `register_file.v`."""

from __future__ import annotations

from controller.fpga.build_parameters import Parameters
from controller.fpga.registers import (
    BIT_CLOCK_HZ_MAX,
    BIT_CLOCK_HZ_MIN,
    BIT_TICKS_MIN,
    CHANNELS,
    FILTER_TICKS,
    IDENTITY_MAGIC,
    PROTOCOL_VERSION,
    QUEUE_PLAYS,
    RAMP_SAMPLES_MAX,
    REGISTERS,
    TRIGGER_LATENCY_TICKS,
    WAVEFORM_WORDS,
    Register,
    Result,
)
from controller.gateware_model.limit_settings import LimitSettings

_ALL_ONES = 0xFFFFFFFF
HARD_LIMITS = (
    "HV_SETTLE_TICKS",
    "CHANNEL_MASK_MAX",
    "HEARTBEAT_TICKS_MAX",
    "PULSE_TICKS_MIN",
    "CHANNEL_EDGES_MAX",
    "TOTAL_EDGES_MAX",
    "EMISSION_TICKS_MAX",
    "DUTY_SHARE_MAX",
    "DUTY_TICKS_MAX",
)


class RegisterFile:
    """Settings by name; everything else by address."""

    def __init__(self, parameters: Parameters) -> None:
        self.parameters = p = parameters
        fewest = max(p.clock_hz // BIT_CLOCK_HZ_MAX, BIT_TICKS_MIN)
        most = max(p.clock_hz // BIT_CLOCK_HZ_MIN, fewest)
        self._values: dict[Register, int] = {
            Register.IDENTITY: IDENTITY_MAGIC,
            Register.PROTOCOL: PROTOCOL_VERSION,
            Register.BUILD_HASH: p.build_hash,
            Register.BOARD: p.board,
            Register.CLOCK_HZ: p.clock_hz,
            Register.GEOMETRY: p.slots | WAVEFORM_WORDS << 8 | CHANNELS << 24,
            Register.PARAMETERS: QUEUE_PLAYS | TRIGGER_LATENCY_TICKS << 8 | FILTER_TICKS << 16,
            Register.EDGE_WINDOW_TICKS: p.edge_window_ticks,
            Register.IDLE_WORD: 0,
            Register.CHANNEL_MASK: p.channel_mask_max,
            Register.BIT_PERIOD: p.bit_period_reset,
            Register.RAMP_SAMPLES: p.ramp_samples_reset,
            Register.HEARTBEAT_TICKS: p.heartbeat_ticks_max,
            Register.PULSE_TICKS: p.pulse_ticks_min,
            Register.CHANNEL_EDGES: p.channel_edges_max,
            Register.TOTAL_EDGES: p.total_edges_max,
            Register.EMISSION_TICKS: p.emission_ticks_max,
            Register.DUTY_SHARE: p.duty_share_max,
            Register.DUTY_TICKS: p.duty_ticks_max,
        } | {Register[name]: getattr(p, name.lower()) for name in HARD_LIMITS}
        self._ranges = {
            Register.IDLE_WORD: (0, _ALL_ONES),
            Register.CHANNEL_MASK: (0, _ALL_ONES),
            Register.BIT_PERIOD: (fewest << 16, most << 16),
            Register.RAMP_SAMPLES: (1, RAMP_SAMPLES_MAX),
            Register.HEARTBEAT_TICKS: (1, p.heartbeat_ticks_max),
            Register.PULSE_TICKS: (p.pulse_ticks_min, _ALL_ONES),
            Register.CHANNEL_EDGES: (0, p.channel_edges_max),
            Register.TOTAL_EDGES: (0, p.total_edges_max),
            Register.EMISSION_TICKS: (0, p.emission_ticks_max),
            Register.DUTY_SHARE: (0, p.duty_share_max),
            Register.DUTY_TICKS: (0, p.duty_ticks_max),
        }
        self.limits = LimitSettings()
        self._set_limits()

    @property
    def idle_word(self) -> int:
        """Level of each channel while armed and not playing, masked."""
        return self._values[Register.IDLE_WORD] & self.channel_mask

    @property
    def channel_mask(self) -> int:
        """Channels that may move."""
        return self._values[Register.CHANNEL_MASK]

    @property
    def bit_period(self) -> int:
        """Time one drive word is held, in 65536ths of a tick."""
        return self._values[Register.BIT_PERIOD]

    @property
    def bit_ticks(self) -> int:
        """Its whole ticks."""
        return self.bit_period >> 16

    @property
    def ramp_samples(self) -> int:
        """Drive words in a ramp."""
        return self._values[Register.RAMP_SAMPLES]

    @property
    def heartbeat_ticks(self) -> int:
        """Clocks without a good frame until the host counts as silent."""
        return self._values[Register.HEARTBEAT_TICKS]

    def read(self, register: Register) -> int | None:
        """Value of a register that is kept here; None if it is kept elsewhere."""
        return self._values.get(register)

    def write(self, address: int, value: int, *, disarmed: bool, quiet: bool) -> Result:
        """Change a setting, or say why not."""
        if address not in set(Register):
            return Result.UNKNOWN_REGISTER
        register = Register(address)
        if REGISTERS[register].access == "RO":
            return Result.READ_ONLY
        if register == Register.BIT_PERIOD:
            if not quiet:
                return Result.BUSY
        elif not disarmed:
            return Result.ARMED
        low, high = self._ranges[register]
        if register == Register.BIT_PERIOD:
            low = max(low, self._values[Register.PULSE_TICKS] << 16)
        elif register == Register.PULSE_TICKS:
            high = self.bit_ticks
        if not low <= value <= high or (register == Register.CHANNEL_MASK and value & ~self.parameters.channel_mask_max):
            return Result.BAD_VALUE
        self._values[register] = value
        self._set_limits()
        return Result.OK

    def _set_limits(self) -> None:
        self.limits.pulse_ticks = self._values[Register.PULSE_TICKS]
        self.limits.channel_edges = self._values[Register.CHANNEL_EDGES]
        self.limits.total_edges = self._values[Register.TOTAL_EDGES]
        self.limits.emission_ticks = self._values[Register.EMISSION_TICKS]
        self.limits.duty_share = self._values[Register.DUTY_SHARE]
        self.limits.duty_ticks = self._values[Register.DUTY_TICKS]
