"""The status frame, by which the FPGA answers every frame of the host.

It reports the result of the frame before, and the FPGA's state when chip select fell. Same layout as a frame: sync word first,
CRC-32 last, 36 bytes; its fields are those of `frame_table`.
"""

from __future__ import annotations

import struct
import zlib
from typing import Final, NamedTuple

from controller.device.fpga.frame_table import CRC_FIELD, STATUS_FIELDS, offset_of, packing
from controller.device.fpga.frames import CRC, FRAME_BYTES, ReadableBuffer, WritableBuffer
from controller.device.fpga.registers import STATUS_SYNC, Fault, Result, State
from controller.device.kernel.crc import seal
from controller.errors import LinkError

STATUS: Final = packing((*STATUS_FIELDS, CRC_FIELD))
TICKS: Final = struct.Struct("<Q")
TICKS_AT: Final = offset_of("timestamp_ticks", STATUS_FIELDS)
QUEUED_AT: Final = offset_of("queued", STATUS_FIELDS)  # one byte
DONE: Final = STATUS_SYNC | Result.OK << 16  # how the status about a frame that was done begins


class DamagedStatus(LinkError):
    """The answer is no valid status: the state of the FPGA is unknown, and whether it received the frame."""


class Status(NamedTuple):
    """State of the FPGA, and the result of the frame before."""

    result: Result
    sequence: int  # of the last accepted frame
    state: State
    faults: Fault
    data: int  # value of the last READ
    trigger_count: int  # rising edges of the trigger, modulo 2**32
    timestamp_ticks: int  # FPGA clocks since reset
    emissions: int  # completed, modulo 2**32
    queued: int = 0  # plays accepted and not yet begun
    chunks: int = 0  # bit k: chunk k of the current upload was accepted
    ignored: int = 0  # triggers that found no play to start, modulo 2**16


def pack_status(buffer: WritableBuffer, offset: int, status: Status) -> int:
    """Pack a status into `buffer` at `offset`, as the FPGA does; returns the offset of its end."""
    STATUS.pack_into(buffer, offset, STATUS_SYNC, *status, 0)
    return seal(buffer, offset, offset + FRAME_BYTES - CRC.size)


def parse_status(buffer: ReadableBuffer, offset: int = 0) -> Status:
    """Read the status at `offset`.

    `buffer` is what came back with frames; the answer to this one begins at `offset`. Raises DamagedStatus if the sync word or the
    CRC is wrong; LinkError if its result code is unknown to this version.
    """
    result, sequence, state, faults, *counters = _checked(buffer, offset)
    code = _RESULTS.get(result)
    if code is None:
        raise LinkError(f"status has result code {result}, which this version does not know")
    if state not in _STATES:
        _STATES[state] = State(state)
    return Status(code, sequence, _STATES[state], Fault(faults) if faults else _NO_FAULT, *counters)


def _checked(buffer: ReadableBuffer, offset: int) -> tuple[int, ...]:
    """Fields between sync word and CRC of a status, after both were compared."""
    sync, *fields, crc = STATUS.unpack_from(buffer, offset)
    if sync != STATUS_SYNC:
        raise DamagedStatus(f"status begins with 0x{sync:04X} and not 0x{STATUS_SYNC:04X}: is the FPGA configured, is MISO wired?")
    expected = zlib.crc32(memoryview(buffer)[offset : offset + FRAME_BYTES - CRC.size])
    if crc != expected:
        raise DamagedStatus(f"status has CRC 0x{crc:08X} and not 0x{expected:08X}: damaged in transfer; try a lower SPI clock")
    return tuple(fields)


_RESULTS = {int(result): result for result in Result}
_STATES: dict[int, State] = {}  # seen so far: making a flag takes longer than all the rest of a status
_NO_FAULT = Fault(0)
