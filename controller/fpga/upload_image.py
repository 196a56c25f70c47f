"""A waveform of the board's length as LOAD frames, at the beginning of the buffer that every message is sent from.

What `frames.pack_upload` does for any length and place; here the frames are cut once, and an upload makes no views
of them.
"""

from __future__ import annotations

import zlib
from typing import Final

from controller.fpga.frames import CRC, HEADER, upload_slices
from controller.fpga.registers import CHUNK_WORDS, FRAME_SYNC, LOAD_PAYLOAD_MIN_BYTES, FrameType

LOAD: Final = int(FrameType.LOAD)
STEP_BYTES: Final = 4 * CHUNK_WORDS


class UploadImage:
    """The LOAD frames of an upload.

    Parameters
    ----------
    sent : memoryview of bytes
        Where the frames are packed, from 0 on. Whatever else is packed there in between does no harm.
    samples : int
        Words of a waveform.

    Attributes
    ----------
    lengths : tuple of int
        Bytes of each frame.
    frames : int
    """

    def __init__(self, sent: memoryview, samples: int) -> None:
        pieces = upload_slices(samples)
        self.lengths = tuple(piece.stop - piece.start for piece in pieces)
        self.frames = len(pieces)
        self._sent = sent
        self._end: int = pieces[-1].stop
        # each frame: its header by sequence number, where that goes, where its CRC lies, what that is of, its payload, and
        # which part of the words that is
        self._pieces = []
        for chunk, piece in enumerate(pieces):
            crc, payload = piece.stop - CRC.size, piece.start + HEADER.size
            first, last = chunk * STEP_BYTES, min((chunk + 1) * STEP_BYTES, 4 * samples)
            under_crc, filled = sent[piece.start : crc], sent[payload : payload + last - first]
            heads = tuple(HEADER.pack(FRAME_SYNC, LOAD, sequence, crc - payload, chunk) for sequence in range(256))
            self._pieces.append((heads, sent[piece.start : payload], crc, under_crc, filled, slice(first, last)))
        rest = 4 * samples % STEP_BYTES
        self._filler = sent[self._pieces[-1][2] - LOAD_PAYLOAD_MIN_BYTES + rest : self._pieces[-1][2]]
        if not 0 < rest < LOAD_PAYLOAD_MIN_BYTES:
            self._filler = sent[:0]
        self._zeros = bytes(len(self._filler))

    def pack(self, sequence: int, words: memoryview) -> int:
        """Pack the frames; the offset of their end.

        Parameters
        ----------
        sequence : int
            Of the first.
        words : memoryview of bytes
            4 for each sample; copied once.
        """
        sent, seal = self._sent, CRC.pack_into
        self._filler[:] = self._zeros
        for heads, head, crc, under_crc, payload, part in self._pieces:
            payload[:] = words[part]
            head[:] = heads[sequence & 0xFF]
            seal(sent, crc, zlib.crc32(under_crc))
            sequence += 1
        return self._end
