"""Every number the host and the FPGA have to agree on, with a plain sentence for each code.

`fpga_rtl/registers.vh` says the same; tests/fpga/test_registers.py compares the two.
"""

from __future__ import annotations

from enum import IntEnum, IntFlag
from typing import Final, NamedTuple

PROTOCOL_VERSION: Final = 1
IDENTITY_MAGIC: Final = int.from_bytes(b"HPNL", "little")

FRAME_SYNC: Final = 0xA55A
STATUS_SYNC: Final = 0x5AA5
CRC_RESIDUE: Final = 0xDEBB20E3

SHORT_PAYLOAD_BYTES: Final = 20
LOAD_PAYLOAD_MIN_BYTES: Final = 20
LOAD_PAYLOAD_MAX_BYTES: Final = 500
CHUNKS: Final = 8
CHUNK_WORDS: Final = 125
WAVEFORM_WORDS: Final = 1000
CHANNELS: Final = 32

BIT_TICKS_MIN: Final = 4
BIT_TICKS_MAX: Final = 65535
RAMP_SAMPLES_MAX: Final = 262143
RAMP_SAMPLES_RESET: Final = 5000
BIT_CLOCK_HZ_RESET: Final = 500_000

TRIGGER_LATENCY_TICKS: Final = 5


class FrameType(IntEnum):
    """What a frame asks for."""

    NOP = 0
    READ = 1
    WRITE = 2
    LOAD = 3
    STORE = 4
    PLAY = 5


class Register(IntEnum):
    """Addresses of the 32-bit registers; `REGISTERS` describes them."""

    IDENTITY = 0
    PROTOCOL = 1
    BUILD_HASH = 2
    CLOCK_HZ = 3
    GEOMETRY = 4
    CONTROL = 5
    IDLE_WORD = 6
    BIT_TICKS = 7
    RAMP_SAMPLES = 8
    HEARTBEAT_TICKS = 9
    CHANNEL_MASK = 10
    FAULT = 11
    TRIGGERS_IGNORED = 12
    EMISSIONS = 13
    FRAME_ERRORS = 14
    SLOTS_LOADED = 15


class Description(NamedTuple):
    """How a register is used: `access` is RO, RW (written only while disarmed) or WO."""

    access: str
    text: str


REGISTERS: Final[dict[Register, Description]] = {
    Register.IDENTITY: Description("RO", "'HPNL': this is a haptic panel"),
    Register.PROTOCOL: Description("RO", "version of these frames and registers"),
    Register.BUILD_HASH: Description("RO", "CRC-32 of the Verilog it was built from"),
    Register.CLOCK_HZ: Description("RO", "clocks per second: what a tick is"),
    Register.GEOMETRY: Description("RO", "slots, words per slot (from bit 8), channels (from bit 24)"),
    Register.CONTROL: Description("WO", "1 ARM (version, build hash), 2 DISARM, 3 CLEAR faults, 4 STOP"),
    Register.IDLE_WORD: Description("RW", "level of each channel while armed and not playing; 0 after reset"),
    Register.BIT_TICKS: Description("RW", "clocks one drive word is held, 4 to 65535; 500 kHz after reset"),
    Register.RAMP_SAMPLES: Description("RW", "drive words in the glide between 0 and idle, 1 to 262143; 5000 after reset"),
    Register.HEARTBEAT_TICKS: Description(
        "RW", "clocks without a good frame until HOST_SILENT; at most, and after reset, the limit built in"
    ),
    Register.CHANNEL_MASK: Description("RW", "channels that may move; all after reset"),
    Register.FAULT: Description("RO", "causes of the fault, kept until CLEAR"),
    Register.TRIGGERS_IGNORED: Description("RO", "trigger edges that found nothing to start"),
    Register.EMISSIONS: Description("RO", "emissions that ran to their end"),
    Register.FRAME_ERRORS: Description("RO", "frames refused for sync word, length or CRC"),
    Register.SLOTS_LOADED: Description("RO", "bit k: slot k holds a waveform"),
}


class Control(IntEnum):
    """Words that the CONTROL register understands."""

    ARM = 1
    DISARM = 2
    CLEAR = 3
    STOP = 4


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


class Fault(IntFlag):
    """Causes for which the FPGA has shut its outputs off."""

    NO_PERMIT = 1 << 0
    HOST_SILENT = 1 << 1

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

    @property
    def sentence(self) -> str:
        """One plain sentence for the user."""
        return _RESULT_SENTENCES[self]


_FAULT_SENTENCES: Final = {
    Fault.NO_PERMIT: "The run permit went away while the outputs were on.",
    Fault.HOST_SILENT: "No good frame came from the host within the heartbeat time.",
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
    Result.BUSY: "What is needed is still in use: try again after the current emission.",
    Result.NOT_ARMED: "The outputs are not armed.",
    Result.ARMED: "This can be done only while disarmed.",
    Result.FAULTED: "A fault is latched: read its cause and clear it first.",
    Result.NO_PERMIT: "The run permit is not given.",
    Result.BAD_KEY: "Protocol version or build hash are not those of this FPGA.",
}
