"""Decoding of a frame as in `frame_decoder.v`: its fields, or why it is refused."""

from typing import NamedTuple

from controller.device.fpga.frames import CRC, HEADER, SHORT
from controller.device.fpga.registers import (
    CHUNKS,
    FRAME_SYNC,
    LOAD_PAYLOAD_MAX_BYTES,
    LOAD_PAYLOAD_MIN_BYTES,
    SHORT_PAYLOAD_BYTES,
    FrameType,
    Result,
)
from controller.device.kernel.crc import intact

_SYNC_BYTES = FRAME_SYNC.to_bytes(2, "little")


class Frame(NamedTuple):
    """A decoded frame; `refusal` is OK if it was accepted."""

    refusal: Result
    kind: int = 0
    sequence: int = 0
    argument: int = 0
    words: tuple[int, ...] = (0, 0, 0, 0, 0, 0)
    loaded_words: int = 0  # written to the landing buffer, at chunk `argument`
    payload_words: int = 0  # by its header
    payload: bytes = b""  # of a LOAD


def decode(mosi: memoryview) -> Frame:
    """Decode a frame; `mosi` holds all bytes of one chip-select assertion."""
    size = len(mosi)
    sync_good = mosi[:2] == _SYNC_BYTES[:size]
    if size < HEADER.size:
        return Frame(Result.BAD_LENGTH if sync_good else Result.BAD_SYNC)
    _, kind, sequence, length, argument = HEADER.unpack_from(mosi)
    is_load = kind == FrameType.LOAD
    is_long = is_load or kind == FrameType.TEST
    if is_long:
        length_good = LOAD_PAYLOAD_MIN_BYTES <= length <= LOAD_PAYLOAD_MAX_BYTES and length % 4 == 0
    else:
        length_good = length == SHORT_PAYLOAD_BYTES
    loaded_words = 0
    payload = b""
    if is_load and sync_good and length_good and argument < CHUNKS:
        loaded_words = min(size - HEADER.size, length) // 4
        payload = bytes(mosi[HEADER.size : HEADER.size + 4 * loaded_words])
    if not sync_good:
        refusal = Result.BAD_SYNC
    elif not length_good or size != HEADER.size + length + CRC.size:
        refusal = Result.BAD_LENGTH
    elif not intact(mosi):
        refusal = Result.BAD_CRC
    else:
        refusal = Result.OK
    words = SHORT.unpack_from(mosi)[5:] if size >= SHORT.size else Frame(Result.OK).words
    return Frame(refusal, kind, sequence, argument, words, loaded_words, length // 4, payload)
