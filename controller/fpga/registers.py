"""Every number the host and the FPGA have to agree on, with a plain sentence for each code.

`fpga_rtl/registers.vh` says the same; tests/fpga/test_registers.py compares the two.
"""

from __future__ import annotations

from enum import IntEnum, IntFlag
from typing import Final, NamedTuple

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


class Description(NamedTuple):
    """One register: `access` is RO, WO or RW (written only while disarmed, but for BIT_PERIOD)."""

    access: str
    bits: str
    reset: str
    text: str


class Register(IntEnum):
    """Addresses of the 32-bit registers; `REGISTERS` describes them."""

    IDENTITY = 0
    PROTOCOL = 1
    BUILD_HASH = 2
    BOARD = 3
    CLOCK_HZ = 4
    GEOMETRY = 5
    PARAMETERS = 6
    EDGE_WINDOW_TICKS = 7
    CONTROL = 8
    IDLE_WORD = 9
    CHANNEL_MASK = 10
    BIT_PERIOD = 11
    RAMP_SAMPLES = 12
    HEARTBEAT_TICKS = 13
    PULSE_TICKS = 14
    CHANNEL_EDGES = 15
    TOTAL_EDGES = 16
    EMISSION_TICKS = 17
    DUTY_SHARE = 18
    DUTY_TICKS = 19
    FAULT = 20
    FAULT_CHANNELS = 21
    FAULT_COUNT = 22
    FAULT_TIME_LOW = 23
    FAULT_TIME_HIGH = 24
    INPUTS = 25
    INPUT_TIME_LOW = 26
    INPUT_TIME_HIGH = 27
    TRIGGERS = 28
    TRIGGERS_IGNORED = 29
    TRIGGER_TIME_LOW = 30
    TRIGGER_TIME_HIGH = 31
    EMISSIONS = 32
    EMISSION_TIME_LOW = 33
    EMISSION_TIME_HIGH = 34
    PLAYS_MISSED = 35
    UNDERRUNS = 36
    FRAME_ERRORS = 37
    SEQUENCE_GAPS = 38
    SLOTS_LOADED = 39
    QUEUE = 40
    DUTY_LEVEL = 41
    HV_SETTLE_TICKS = 42
    CHANNEL_MASK_MAX = 43
    HEARTBEAT_TICKS_MAX = 44
    PULSE_TICKS_MIN = 45
    CHANNEL_EDGES_MAX = 46
    TOTAL_EDGES_MAX = 47
    EMISSION_TICKS_MAX = 48
    DUTY_SHARE_MAX = 49
    DUTY_TICKS_MAX = 50


REGISTERS: Final[dict[Register, Description]] = {
    Register.IDENTITY: Description("RO", "31:0", "0x4C4E5048", "'HPNL': this is a haptic panel"),
    Register.PROTOCOL: Description("RO", "31:0", "2", "version of these frames and registers"),
    Register.BUILD_HASH: Description("RO", "31:0", "built in", "CRC-32 of the Verilog it was built from"),
    Register.BOARD: Description("RO", "31:0", "built in", "four letters that name the board"),
    Register.CLOCK_HZ: Description("RO", "31:0", "built in", "clocks per second: what a tick is"),
    Register.GEOMETRY: Description("RO", "31:0", "built in", "slots (7:0), words per slot (23:8), channels (31:24)"),
    Register.PARAMETERS: Description(
        "RO", "23:0", "built in", "plays in the queue (7:0), ticks from trigger to first word (15:8), of the glitch filter (23:16)"
    ),
    Register.EDGE_WINDOW_TICKS: Description("RO", "31:0", "built in", "ticks over which edges are counted, wherever they begin"),
    Register.CONTROL: Description(
        "WO",
        "31:0",
        "nothing",
        "1 ARM, 2 DISARM, 3 CLEAR faults, 4 STOP, 5 UNLOCK (identity, version, build hash; directly before ARM), 6 TRIGGER",
    ),
    Register.IDLE_WORD: Description("RW", "31:0", "0", "level of each channel while armed and not playing"),
    Register.CHANNEL_MASK: Description("RW", "31:0", "largest", "channels that may move; the others are low"),
    Register.BIT_PERIOD: Description(
        "RW",
        "31:0",
        "the board's",
        "time one drive word is held, in 65536ths of a tick: 2 MHz to 100 kHz, 4 ticks or more; written while nothing plays",
    ),
    Register.RAMP_SAMPLES: Description("RW", "17:0", "the board's", "drive words in the glide between 0 and idle"),
    Register.HEARTBEAT_TICKS: Description(
        "RW", "31:0", "largest", "ticks without a good frame of the link that armed until HOST_SILENT; at most what is built in"
    ),
    Register.PULSE_TICKS: Description(
        "RW", "15:0", "smallest", "shortest time between two changes of one channel; at least what is built in, at most BIT_PERIOD"
    ),
    Register.CHANNEL_EDGES: Description("RW", "23:0", "largest", "edges of one channel in a window; at most what is built in"),
    Register.TOTAL_EDGES: Description("RW", "28:0", "largest", "edges of all channels in a window; at most what is built in"),
    Register.EMISSION_TICKS: Description("RW", "31:0", "largest", "longest emission; at most what is built in"),
    Register.DUTY_SHARE: Description(
        "RW", "16:0", "largest", "65536ths of the time that may be emission or ramp in the long run; at most what is built in"
    ),
    Register.DUTY_TICKS: Description(
        "RW", "31:0", "largest", "ticks of emission that may run ahead of DUTY_SHARE; at most what is built in"
    ),
    Register.FAULT: Description("RO", "15:0", "0", "causes of the fault, kept until CLEAR, and EDGE_WINDOW_TICKS if of a limit"),
    Register.FAULT_CHANNELS: Description("RO", "31:0", "0", "channels of a SHORT_PULSE or CHANNEL_EDGES, kept until CLEAR"),
    Register.FAULT_COUNT: Description("RO", "31:0", "0", "times that a fault shut the outputs"),
    Register.FAULT_TIME_LOW: Description("RO", "31:0", "0", "tick of the last of them; holds its HIGH"),
    Register.FAULT_TIME_HIGH: Description("RO", "31:0", "0", "high half of the time whose LOW this link read last"),
    Register.INPUTS: Description("RO", "2:0", "the pins", "levels of the pins: run permit (0), temperature good (1), trigger (2)"),
    Register.INPUT_TIME_LOW: Description("RO", "31:0", "0", "tick of the last change of run permit or temperature; holds its HIGH"),
    Register.INPUT_TIME_HIGH: Description("RO", "31:0", "0", "as FAULT_TIME_HIGH"),
    Register.TRIGGERS: Description("RO", "31:0", "0", "trigger edges and TRIGGER commands"),
    Register.TRIGGERS_IGNORED: Description("RO", "31:0", "0", "those that found nothing to start"),
    Register.TRIGGER_TIME_LOW: Description("RO", "31:0", "0", "tick of the last of them, when it was decided on; holds its HIGH"),
    Register.TRIGGER_TIME_HIGH: Description("RO", "31:0", "0", "as FAULT_TIME_HIGH"),
    Register.EMISSIONS: Description("RO", "31:0", "0", "emissions that ran to their end"),
    Register.EMISSION_TIME_LOW: Description(
        "RO", "31:0", "0", "tick of the first word of the last emission on the pins; holds its HIGH"
    ),
    Register.EMISSION_TIME_HIGH: Description("RO", "31:0", "0", "as FAULT_TIME_HIGH"),
    Register.PLAYS_MISSED: Description(
        "RO", "31:0", "0", "scheduled plays dropped because their time had passed or something sounded"
    ),
    Register.UNDERRUNS: Description("RO", "31:0", "0", "emissions that overtook their upload"),
    Register.FRAME_ERRORS: Description("RO", "31:0", "0", "frames of this link refused for sync word, length or CRC"),
    Register.SEQUENCE_GAPS: Description("RO", "31:0", "0", "frames of this link, before this one, whose number skipped"),
    Register.SLOTS_LOADED: Description("RO", "15:0", "0", "bit k: slot k holds a waveform whose CRC matches"),
    Register.QUEUE: Description("RO", "7:0", "0", "plays accepted and not yet begun"),
    Register.DUTY_LEVEL: Description("RO", "31:0", "0", "ticks of emission that have run ahead of DUTY_SHARE"),
    Register.HV_SETTLE_TICKS: Description("RO", "31:0", "built in", "ticks from hv_enable to the first edge of a ramp up"),
    Register.CHANNEL_MASK_MAX: Description("RO", "31:0", "built in", "channels that have a stage: no other ever moves"),
    Register.HEARTBEAT_TICKS_MAX: Description("RO", "31:0", "built in", "most that HEARTBEAT_TICKS can be"),
    Register.PULSE_TICKS_MIN: Description("RO", "31:0", "built in", "least that PULSE_TICKS can be"),
    Register.CHANNEL_EDGES_MAX: Description("RO", "31:0", "built in", "most that CHANNEL_EDGES can be"),
    Register.TOTAL_EDGES_MAX: Description("RO", "31:0", "built in", "most that TOTAL_EDGES can be"),
    Register.EMISSION_TICKS_MAX: Description("RO", "31:0", "built in", "most that EMISSION_TICKS can be"),
    Register.DUTY_SHARE_MAX: Description("RO", "31:0", "built in", "most that DUTY_SHARE can be"),
    Register.DUTY_TICKS_MAX: Description("RO", "31:0", "built in", "most that DUTY_TICKS can be"),
}


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


class Fault(IntFlag):
    """Causes for which the FPGA has shut its outputs off."""

    NO_PERMIT = 1 << 0
    HOST_SILENT = 1 << 1
    OVER_TEMPERATURE = 1 << 2
    UNDERRUN = 1 << 3
    SHORT_PULSE = 1 << 4
    CHANNEL_EDGES = 1 << 5
    TOTAL_EDGES = 1 << 6
    LONG_EMISSION = 1 << 7
    DUTY = 1 << 8

    @property
    def sentence(self) -> str:
        """All causes for the user, one plain sentence each."""
        return " ".join(_FAULT_SENTENCES[cause] for cause in Fault if cause in self) or "No fault."


class Result(IntEnum):
    """What became of the frame before."""

    OK = 0
    BAD_SYNC = 1
    BAD_LENGTH = 2
    BAD_CRC = 3
    UNKNOWN_TYPE = 4
    UNKNOWN_REGISTER = 5
    READ_ONLY = 6
    BAD_VALUE = 7
    BAD_SLOT = 8
    BAD_CHUNK = 9
    INCOMPLETE = 10
    EMPTY_SLOT = 11
    BUSY = 12
    NOT_ARMED = 13
    ARMED = 14
    FAULTED = 15
    NO_PERMIT = 16
    BAD_KEY = 17
    LOCKED = 18
    QUEUE_FULL = 19
    BAD_RANGE = 20
    BAD_PERIOD = 21
    TOO_LONG = 22
    TOO_LATE = 23
    OVERLAP = 24
    SLOT_DAMAGED = 25
    LINK_SLOW = 26

    @property
    def sentence(self) -> str:
        """One plain sentence for the user."""
        return _RESULT_SENTENCES[self]


_FAULT_SENTENCES: Final = {
    Fault.NO_PERMIT: "The run permit went away while the outputs were on.",
    Fault.HOST_SILENT: "No good frame came within the heartbeat time from the host that armed.",
    Fault.OVER_TEMPERATURE: "The temperature input went low while the outputs were on.",
    Fault.UNDERRUN: "An emission reached words that had not arrived yet.",
    Fault.SHORT_PULSE: "A channel changed twice within the shortest pulse allowed.",
    Fault.CHANNEL_EDGES: "A channel had more edges in a window than its stage may be given.",
    Fault.TOTAL_EDGES: "All channels together had more edges in a window than the supply may be asked for.",
    Fault.LONG_EMISSION: "An emission lasted longer than allowed.",
    Fault.DUTY: "There was more emission than the duty limit allows.",
}

_RESULT_SENTENCES: Final = {
    Result.OK: "Done.",
    Result.BAD_SYNC: "The frame did not begin with the sync word.",
    Result.BAD_LENGTH: "The frame was longer or shorter than it should be.",
    Result.BAD_CRC: "The frame was damaged on its way: its CRC does not match.",
    Result.UNKNOWN_TYPE: "The FPGA does not know this type of frame.",
    Result.UNKNOWN_REGISTER: "The FPGA has no register of this number.",
    Result.READ_ONLY: "This register cannot be written.",
    Result.BAD_VALUE: "The value is outside what the FPGA allows.",
    Result.BAD_SLOT: "The FPGA has no slot of this number.",
    Result.BAD_CHUNK: "A waveform has no chunk of this number.",
    Result.INCOMPLETE: "Not all chunks of the waveform have arrived.",
    Result.EMPTY_SLOT: "Nothing has been stored in this slot.",
    Result.BUSY: "What is needed is still in use: try again a little later.",
    Result.NOT_ARMED: "The outputs are not armed.",
    Result.ARMED: "This can be done only while disarmed.",
    Result.FAULTED: "A fault is latched: read its cause and clear it first.",
    Result.NO_PERMIT: "The run permit is not given.",
    Result.BAD_KEY: "Identity, protocol version or build hash are not those of this FPGA.",
    Result.LOCKED: "Arming was not unlocked by the frame directly before.",
    Result.QUEUE_FULL: "The queue of plays is full.",
    Result.BAD_RANGE: "The words asked for reach beyond the waveform.",
    Result.BAD_PERIOD: "The period is neither the emission's length nor leaves the idle word room behind it.",
    Result.TOO_LONG: "The emission is longer than allowed.",
    Result.TOO_LATE: "The time of the play has passed, or is too near.",
    Result.OVERLAP: "The play would begin before the one scheduled before it has ended.",
    Result.SLOT_DAMAGED: "The slot's waveform in the FPGA's memory does not match its CRC: upload it again.",
    Result.LINK_SLOW: "The link is too slow to play a waveform that is still arriving.",
}
