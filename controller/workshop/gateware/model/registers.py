"""Registers of the gateware model that hold a setting or say what the FPGA is: `register_file.v`."""

from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.registers import (
    BIT_CLOCK_HZ_MAX,
    BIT_CLOCK_HZ_MIN,
    BIT_TICKS_MIN,
    CHANNELS,
    CONSTANTS,
    FILTER_TICKS,
    QUEUE_PLAYS,
    TRIGGER_LATENCY_TICKS,
    WAVEFORM_WORDS,
    Kind,
    Register,
    Result,
)
from controller.workshop.gateware.model.activity_limits import LimitSettings

_SETTINGS = (Kind.SETTING, Kind.MASK)


class RegisterFile:
    """Settings by name; constants, what is built in and settings by address, as their records in `Register` say."""

    def __init__(self, parameters: BuildParameters) -> None:
        self.parameters = p = parameters
        fewest = max(p.clock_hz // BIT_CLOCK_HZ_MAX, BIT_TICKS_MIN)
        self.bit_period_low = fewest << 16  # bit_period_low, bit_period_high: range of BIT_PERIOD, in 65536ths of a tick
        self.bit_period_high = max(p.clock_hz // BIT_CLOCK_HZ_MIN, fewest) << 16
        self.geometry = p.slots | WAVEFORM_WORDS << 8 | CHANNELS << 24
        self._values: dict[Register, int] = {
            register: self._number(register.name if register.kind is Kind.BUILT_IN else register.reset)
            for register in Register
            if register.kind in (Kind.CONSTANT, Kind.BUILT_IN, *_SETTINGS) and register is not Register.PARAMETERS
        }
        self._values[Register.PARAMETERS] = QUEUE_PLAYS | TRIGGER_LATENCY_TICKS << 8 | FILTER_TICKS << 16
        self.limits = LimitSettings()  # settings of the stages' limits
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
        """Whole ticks of the bit period."""
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
        """Value of a register of 32 bits, or None if it is not kept here."""
        return self._values.get(register)

    def write(self, address: int, value: int, *, disarmed: bool, quiet: bool) -> Result:
        """Change a setting, or say why not; `address` may be no register's.

        `disarmed`: outputs are off; `quiet`: they are off or armed, and nothing plays or waits.
        """
        if address not in set(Register):
            return Result.UNKNOWN_REGISTER
        register = Register(address)
        if register.kind not in _SETTINGS:
            return Result.READ_ONLY
        if register == Register.BIT_PERIOD:
            if not quiet:
                return Result.BUSY
        elif not disarmed:
            return Result.ARMED
        if not self._allowed(register, value):
            return Result.BAD_VALUE
        self._values[register] = value
        self._set_limits()
        return Result.OK

    def _allowed(self, register: Register, value: int) -> bool:
        high = register.used_bits if register.high is None else self._number(register.high)
        if register.kind is Kind.MASK:
            return not value & ~high
        if register == Register.BIT_PERIOD and value >> 16 < self._values[Register.PULSE_TICKS]:
            return False
        return self._number(register.low) <= value <= high

    def _number(self, name: int | str) -> int:
        """The number that a record names: a constant, a property of this object, or a parameter."""
        if isinstance(name, int):
            return name
        if name in CONSTANTS:
            return CONSTANTS[name]
        return int(getattr(self if hasattr(self, name.lower()) else self.parameters, name.lower()))

    def _set_limits(self) -> None:
        self.limits.pulse_ticks = self._values[Register.PULSE_TICKS]
        self.limits.channel_edges = self._values[Register.CHANNEL_EDGES]
        self.limits.total_edges = self._values[Register.TOTAL_EDGES]
        self.limits.emission_ticks = self._values[Register.EMISSION_TICKS]
        self.limits.duty_share = self._values[Register.DUTY_SHARE]
        self.limits.duty_ticks = self._values[Register.DUTY_TICKS]
