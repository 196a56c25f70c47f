"""Every number that the host and the FPGA have to agree on, and what each register and code means.

This is the source: `python -m controller.generate` writes from it `fpga_rtl/registers.vh`, the registers in
`register_file.v` and `haptic_core.v` and the table in `fpga_rtl/README.md`; the gateware model takes its defaults from it.
"""

from __future__ import annotations

from enum import Enum, IntEnum, IntFlag, auto, unique
from typing import Final, Self

PROTOCOL_VERSION: Final = 2
IDENTITY_MAGIC: Final = int.from_bytes(b"HPNL", "little")

FRAME_SYNC: Final = 0xA55A
STATUS_SYNC: Final = 0x5AA5
CRC_RESIDUE: Final = 0xDEBB20E3

SHORT_PAYLOAD_BYTES: Final = 24
LOAD_PAYLOAD_MIN_BYTES: Final = 20
LOAD_PAYLOAD_MAX_BYTES: Final = 500
CHUNKS: Final = 8
CHUNK_WORDS: Final = 125
WAVEFORM_WORDS: Final = 1000
CHANNELS: Final = 32
QUEUE_PLAYS: Final = 8

BIT_TICKS_MIN: Final = 4
BIT_CLOCK_HZ_MAX: Final = 2_000_000
BIT_CLOCK_HZ_MIN: Final = 100_000
RAMP_SAMPLES_MAX: Final = 262143
DUTY_FULL: Final = 65536

FILTER_TICKS: Final = 3
TRIGGER_LATENCY_TICKS: Final = 8
TIME_LEAD_TICKS: Final = 30

PLAY_LANDING: Final = 0xFFFF
READ_SLOT_CRC: Final = 0x0100
READ_QUEUE: Final = 0x0200
READ_MEMORY: Final = 0x8000


class FrameType(IntEnum):
    """What a frame asks for."""

    NOP = 0
    READ = 1
    WRITE = 2
    LOAD = 3
    STORE = 4
    PLAY = 5
    TEST = 6


class Start(IntEnum):
    """What a play waits for, once it is at the head of the queue."""

    TRIGGER = 0
    NOW = 1
    TIME = 2


class Kind(Enum):
    """Where the value of a register comes from; a name is that of the register in lower case unless set otherwise."""

    CONSTANT = auto()  # a constant of this file
    BUILT_IN = auto()  # a parameter of the Verilog, or a localparam of register_file.v, with the register's name
    COMMAND = auto()  # nowhere: it is written only
    SETTING = auto()  # a number that the host writes; an output of register_file.v
    MASK = auto()  # likewise, but a bit may be set only where `high` has it set
    LIVE = auto()  # the state of now; a wire in haptic_core.v
    COUNTER = auto()  # counted since reset; a wire in haptic_core.v, an entry of the model's `Telemetry.counts`
    LINK_COUNTER = auto()  # counted for each link on its own; a wire in register_file.v, an entry of `LinkState.counts`
    TIME_LOW = auto()  # low half of a tick of 64 bits, a wire in haptic_core.v without _low; reading it keeps the high half
    TIME_HIGH = auto()  # the high half that was kept when this link last read a TIME_LOW


_ACCESS = {Kind.COMMAND: "WO", Kind.SETTING: "RW", Kind.MASK: "RW"}


@unique
class Register(IntEnum):
    """Addresses of the 32-bit registers, each with its record: address, kind, bits, text, reset, low, high."""

    kind: Kind  # where its value comes from
    bits: int  # number of bits that are used, from bit 0 on
    text: str  # what it is, without a vertical bar
    reset: int | str  # value after reset; as a name: the constant, or the parameter of the Verilog, that gives it
    # low, high: smallest and largest value of a setting, or the name of a constant, a parameter, or a signal of
    # register_file.v. `high` is None where every value of that many bits is allowed
    low: int | str
    high: int | str | None

    def __new__(
        cls,
        address: int,
        kind: Kind = Kind.LIVE,
        bits: int = 32,
        text: str = "",
        reset: int | str = 0,
        low: int | str = 0,
        high: int | str | None = None,
    ) -> Self:
        """One record; the members below give its fields in this order."""
        register = int.__new__(cls, address)
        register._value_ = address
        register.kind, register.bits, register.text = kind, bits, text
        register.reset, register.low, register.high = reset, low, high
        return register

    IDENTITY = 0, Kind.CONSTANT, 32, "'HPNL': this is a haptic panel", "IDENTITY_MAGIC"
    PROTOCOL = 1, Kind.CONSTANT, 32, "version of these frames and registers", "PROTOCOL_VERSION"
    BUILD_HASH = 2, Kind.BUILT_IN, 32, "CRC-32 of the Verilog it was built from"
    BOARD = 3, Kind.BUILT_IN, 32, "four letters that name the board"
    CLOCK_HZ = 4, Kind.BUILT_IN, 32, "clocks per second: what a tick is"
    GEOMETRY = 5, Kind.BUILT_IN, 32, "slots (7:0), words per slot (23:8), channels (31:24)"
    PARAMETERS = (
        6,
        Kind.BUILT_IN,
        24,
        "plays in the queue (7:0), ticks from trigger to first word (15:8), of the glitch filter (23:16)",
    )
    EDGE_WINDOW_TICKS = 7, Kind.BUILT_IN, 32, "ticks over which edges are counted, wherever they begin"
    CONTROL = (
        8,
        Kind.COMMAND,
        32,
        "1 ARM, 2 DISARM, 3 CLEAR faults, 4 STOP, 5 UNLOCK (identity, version, build hash; directly before ARM), 6 TRIGGER",
    )
    IDLE_WORD = 9, Kind.SETTING, 32, "level of each channel while armed and not playing"
    CHANNEL_MASK = 10, Kind.MASK, 32, "channels that may move; the others are low", "CHANNEL_MASK_MAX", 0, "CHANNEL_MASK_MAX"
    BIT_PERIOD = (
        11,
        Kind.SETTING,
        32,
        "time one drive word is held, in 65536ths of a tick: 2 MHz to 100 kHz, 4 ticks and PULSE_TICKS or more;"
        " written while nothing plays",
        "BIT_PERIOD_RESET",
        "BIT_PERIOD_LOW",
        "BIT_PERIOD_HIGH",
    )
    RAMP_SAMPLES = 12, Kind.SETTING, 18, "drive words in the ramp between 0 and idle", "RAMP_SAMPLES_RESET", 1, "RAMP_SAMPLES_MAX"
    HEARTBEAT_TICKS = (
        13,
        Kind.SETTING,
        32,
        "ticks without a good frame of the link that armed until HOST_SILENT",
        "HEARTBEAT_TICKS_MAX",
        1,
        "HEARTBEAT_TICKS_MAX",
    )
    PULSE_TICKS = (
        14,
        Kind.SETTING,
        16,
        "shortest time between two changes of one channel; PULSE_TICKS_MIN to the whole ticks of BIT_PERIOD",
        "PULSE_TICKS_MIN",
        "PULSE_TICKS_MIN",
        "bit_ticks",
    )
    CHANNEL_EDGES = 15, Kind.SETTING, 24, "edges of one channel in a window", "CHANNEL_EDGES_MAX", 0, "CHANNEL_EDGES_MAX"
    TOTAL_EDGES = 16, Kind.SETTING, 29, "edges of all channels in a window", "TOTAL_EDGES_MAX", 0, "TOTAL_EDGES_MAX"
    EMISSION_TICKS = 17, Kind.SETTING, 32, "longest emission", "EMISSION_TICKS_MAX", 0, "EMISSION_TICKS_MAX"
    DUTY_SHARE = (
        18,
        Kind.SETTING,
        17,
        "65536ths of the time that may be emission or ramp in the long run",
        "DUTY_SHARE_MAX",
        0,
        "DUTY_SHARE_MAX",
    )
    DUTY_TICKS = 19, Kind.SETTING, 32, "ticks of emission that may run ahead of DUTY_SHARE", "DUTY_TICKS_MAX", 0, "DUTY_TICKS_MAX"
    FAULT = 20, Kind.LIVE, 16, "causes of the fault, kept until CLEAR, and EDGE_WINDOW_TICKS if of a limit"
    FAULT_CHANNELS = 21, Kind.LIVE, 32, "channels of a SHORT_PULSE or CHANNEL_EDGES, kept until CLEAR"
    FAULT_COUNT = 22, Kind.COUNTER, 32, "times that there was a fault; causes that add to one count with it"
    FAULT_TIME_LOW = 23, Kind.TIME_LOW, 32, "tick of the last of them; keeps its HIGH"
    FAULT_TIME_HIGH = 24, Kind.TIME_HIGH, 32, "high half of the time whose LOW this link read last"
    INPUTS = 25, Kind.LIVE, 3, "levels of the pins: run permit (0), temperature good (1), trigger (2)", "the pins"
    INPUT_TIME_LOW = 26, Kind.TIME_LOW, 32, "tick of the last change of run permit or temperature; keeps its HIGH"
    INPUT_TIME_HIGH = 27, Kind.TIME_HIGH, 32, "as FAULT_TIME_HIGH"
    TRIGGERS = 28, Kind.COUNTER, 32, "trigger edges and TRIGGER commands"
    TRIGGERS_IGNORED = 29, Kind.COUNTER, 32, "those that found nothing to start"
    TRIGGER_TIME_LOW = 30, Kind.TIME_LOW, 32, "tick of the last of them, when it was decided on; keeps its HIGH"
    TRIGGER_TIME_HIGH = 31, Kind.TIME_HIGH, 32, "as FAULT_TIME_HIGH"
    EMISSIONS = 32, Kind.COUNTER, 32, "emissions that ran to their end"
    EMISSION_TIME_LOW = 33, Kind.TIME_LOW, 32, "tick of the first word of the last emission on the pins; keeps its HIGH"
    EMISSION_TIME_HIGH = 34, Kind.TIME_HIGH, 32, "as FAULT_TIME_HIGH"
    PLAYS_MISSED = 35, Kind.COUNTER, 32, "scheduled plays dropped because their time had passed or something sounded"
    UNDERRUNS = 36, Kind.COUNTER, 32, "emissions that overtook their upload"
    FRAME_ERRORS = 37, Kind.LINK_COUNTER, 32, "frames of this link refused for sync word, length or CRC"
    SEQUENCE_GAPS = 38, Kind.LINK_COUNTER, 32, "frames of this link, before this one, whose number skipped"
    SLOTS_LOADED = 39, Kind.LIVE, 16, "bit k: slot k holds a waveform whose CRC matches"
    QUEUE = 40, Kind.LIVE, 4, "plays accepted and not yet begun"
    DUTY_LEVEL = 41, Kind.LIVE, 32, "ticks of emission that have run ahead of DUTY_SHARE"
    HV_SETTLE_TICKS = 42, Kind.BUILT_IN, 32, "ticks from hv_enable to the first edge of a ramp up"
    CHANNEL_MASK_MAX = 43, Kind.BUILT_IN, 32, "channels that have a stage: no other ever moves"
    HEARTBEAT_TICKS_MAX = 44, Kind.BUILT_IN, 32, "most that HEARTBEAT_TICKS can be"
    PULSE_TICKS_MIN = 45, Kind.BUILT_IN, 32, "least that PULSE_TICKS can be"
    CHANNEL_EDGES_MAX = 46, Kind.BUILT_IN, 32, "most that CHANNEL_EDGES can be"
    TOTAL_EDGES_MAX = 47, Kind.BUILT_IN, 32, "most that TOTAL_EDGES can be"
    EMISSION_TICKS_MAX = 48, Kind.BUILT_IN, 32, "most that EMISSION_TICKS can be"
    DUTY_SHARE_MAX = 49, Kind.BUILT_IN, 32, "most that DUTY_SHARE can be"
    DUTY_TICKS_MAX = 50, Kind.BUILT_IN, 32, "most that DUTY_TICKS can be"

    @property
    def access(self) -> str:
        """RO, WO, or RW: written only while disarmed, BIT_PERIOD while nothing plays."""
        return _ACCESS.get(self.kind, "RO")

    @property
    def used_bits(self) -> int:
        """Mask of the bits that are used."""
        return (1 << self.bits) - 1


class Control(IntEnum):
    """Words that the CONTROL register understands."""

    ARM = 1
    DISARM = 2
    CLEAR = 3
    STOP = 4
    UNLOCK = 5
    TRIGGER = 6


class State(IntFlag):
    """State bits of a status frame."""

    ARMED = 1 << 0
    RAMPING = 1 << 1
    PLAYING = 1 << 2
    REPEATING = 1 << 3
    PENDING = 1 << 4
    LANDING_BUSY = 1 << 5
    RUN_PERMIT = 1 << 6
    HEARTBEAT = 1 << 7
    HV_ENABLE = 1 << 8
    TEMPERATURE_GOOD = 1 << 9
    CHECKING = 1 << 10
    DELAYED = 1 << 11
    WAITING = 1 << 12


@unique
class Fault(IntFlag):
    """Causes for which the FPGA has shut its outputs off: number of the bit, sentence for the user."""

    _sentence: str

    def __new__(cls, bit: int, sentence: str = "") -> Self:
        """One cause."""
        cause = int.__new__(cls, 1 << bit)
        cause._value_ = 1 << bit
        cause._sentence = sentence
        return cause

    NO_PERMIT = 0, "The run permit was lost while the outputs were on."
    HOST_SILENT = 1, "The host that armed sent no valid frame within the heartbeat timeout."
    OVER_TEMPERATURE = 2, "The temperature input went low while the outputs were on."
    UNDERRUN = 3, "An emission reached words that had not been uploaded yet."
    SHORT_PULSE = 4, "A channel changed twice within limits.min_pulse_us."
    CHANNEL_EDGES = 5, "Edge rate of a channel exceeded limits.max_channel_edge_rate_hz (stage protection)."
    TOTAL_EDGES = 6, "Total edge rate exceeded limits.max_total_edge_rate_hz (supply protection)."
    LONG_EMISSION = 7, "An emission lasted longer than limits.longest_emission_ms."
    DUTY = 8, "Emissions exceeded the duty limit: limits.max_duty with limits.duty_budget_ms."

    @property
    def sentence(self) -> str:
        """All causes for the user, one plain sentence each."""
        return " ".join(cause._sentence for cause in Fault if cause in self) or "No fault."


@unique
class Result(IntEnum):
    """What became of the frame before: code, sentence for the user."""

    sentence: str

    def __new__(cls, code: int, sentence: str = "") -> Self:
        """One result."""
        result = int.__new__(cls, code)
        result._value_ = code
        result.sentence = sentence
        return result

    OK = 0, "Done."
    BAD_SYNC = 1, "The frame did not begin with the sync word."
    BAD_LENGTH = 2, "The frame was longer or shorter than it should be."
    BAD_CRC = 3, "The frame was damaged on its way: its CRC does not match."
    UNKNOWN_TYPE = 4, "The FPGA does not know this type of frame."
    UNKNOWN_REGISTER = 5, "The FPGA has no register of this number."
    READ_ONLY = 6, "This register cannot be written."
    BAD_VALUE = 7, "The value is outside what the FPGA allows."
    BAD_SLOT = 8, "The FPGA has no slot of this number."
    BAD_CHUNK = 9, "A waveform has no chunk of this number."
    INCOMPLETE = 10, "Not all chunks of the waveform have arrived."
    EMPTY_SLOT = 11, "Nothing has been stored in this slot."
    BUSY = 12, "What is needed is still in use: try again a little later."
    NOT_ARMED = 13, "The outputs are not armed."
    ARMED = 14, "This can be done only while disarmed."
    FAULTED = 15, "A fault is latched: read its cause and clear it first."
    NO_PERMIT = 16, "The run permit is not given."
    BAD_KEY = 17, "Identity, protocol version or build hash are not those of this FPGA."
    LOCKED = 18, "Arming was not unlocked by the frame directly before."
    QUEUE_FULL = 19, "The queue of plays is full."
    BAD_RANGE = 20, "The words asked for reach beyond the waveform."
    BAD_PERIOD = 21, "The period is neither the emission's length nor leaves the idle word room behind it."
    TOO_LONG = 22, "The emission is longer than allowed."
    TOO_LATE = 23, "The time of the play has passed, or is too near."
    OVERLAP = 24, "The play would begin before the one scheduled before it has ended."
    SLOT_DAMAGED = 25, "The slot's waveform in the FPGA's memory does not match its CRC: upload it again."
    LINK_SLOW = 26, "The link is too slow to play a waveform that is still arriving."


CONSTANTS: Final[dict[str, int]] = {name: value for name, value in globals().items() if name.isupper() and isinstance(value, int)}
