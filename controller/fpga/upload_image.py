"""The LOAD frames of an upload, kept in the send buffer so that an upload only fills in what changes.

Headers for every sequence number, and views of each frame's header, payload and CRC, are made once for the board's waveform
length. An upload then copies each payload, copies each header and writes each CRC, without creating objects.
"""

from __future__ import annotations

import zlib
from typing import Final

from controller.fpga.frames import CRC, HEADER
from controller.fpga.registers import CHUNK_WORDS, FRAME_SYNC, LOAD_PAYLOAD_MIN_BYTES, WAVEFORM_WORDS, FrameType

LOAD: Final = int(FrameType.LOAD)
CHUNK_BYTES: Final = 4 * CHUNK_WORDS


def upload_slices(length_words: int) -> tuple[slice, ...]:
    """Byte ranges of the LOAD frames of a waveform that lie back to back from 0 on; each is one chip-select assertion.

    Parameters
    ----------
    length_words : int
        Drive words of the waveform, 1 to 1000.

    Raises
    ------
    ValueError
        If no waveform has this length.
    """
    if not 1 <= length_words <= WAVEFORM_WORDS:
        raise ValueError(f"a waveform has 1 to {WAVEFORM_WORDS} words, not {length_words}")
    slices = []
    start = 0
    for first in range(0, length_words, CHUNK_WORDS):
        payload = max(4 * min(CHUNK_WORDS, length_words - first), LOAD_PAYLOAD_MIN_BYTES)
        slices.append(slice(start, start + HEADER.size + payload + CRC.size))
        start = slices[-1].stop
    return tuple(slices)


class UploadImage:
    """The LOAD frames of an upload, at the beginning of the send buffer.

    Parameters
    ----------
    sent : memoryview of bytes
        The send buffer. Other messages may overwrite the frames between uploads.
    samples : int
        Drive words of a waveform.

    Attributes
    ----------
    lengths : tuple of int
        Bytes of each frame.
    frames : int
        Number of frames.
    """

    def __init__(self, sent: memoryview, samples: int) -> None:
        pieces = upload_slices(samples)
        self.lengths = tuple(piece.stop - piece.start for piece in pieces)
        self.frames = len(pieces)
        self._sent = sent
        self._end: int = pieces[-1].stop
        # for each frame: headers by sequence number, view of the header, offset of the CRC, view of what the CRC covers,
        # view of the payload, and the range of the waveform's bytes that goes there
        self._pieces = []
        for chunk, piece in enumerate(pieces):
            crc, payload = piece.stop - CRC.size, piece.start + HEADER.size
            first, last = chunk * CHUNK_BYTES, min((chunk + 1) * CHUNK_BYTES, 4 * samples)
            covered, filled = sent[piece.start : crc], sent[payload : payload + last - first]
            heads = tuple(HEADER.pack(FRAME_SYNC, LOAD, sequence, crc - payload, chunk) for sequence in range(256))
            self._pieces.append((heads, sent[piece.start : payload], crc, covered, filled, slice(first, last)))
        rest = 4 * samples % CHUNK_BYTES  # bytes in the last chunk, which may be shorter than a payload must be
        last_crc = self._pieces[-1][2]
        padded = 0 < rest < LOAD_PAYLOAD_MIN_BYTES
        self._padding = sent[last_crc - LOAD_PAYLOAD_MIN_BYTES + rest : last_crc] if padded else sent[:0]
        self._zeros = bytes(len(self._padding))

    def pack(self, sequence: int, words: memoryview) -> int:
        """Pack the frames; returns the offset of their end.

        Parameters
        ----------
        sequence : int
            Of the first frame.
        words : memoryview of bytes
            4 bytes for each sample; copied once.
        """
        sent, pack_crc = self._sent, CRC.pack_into
        self._padding[:] = self._zeros
        for heads, head, crc, covered, payload, part in self._pieces:
            payload[:] = words[part]
            head[:] = heads[sequence & 0xFF]
            pack_crc(sent, crc, zlib.crc32(covered))
            sequence += 1
        return self._end
