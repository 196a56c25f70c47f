"""Messages that upload and play waveforms: which frames, in which order, in the send buffer of an `Exchange`."""

from __future__ import annotations

from typing import Final

from controller.board.board import Board
from controller.fpga import frames
from controller.fpga.exchange import COMMANDS
from controller.fpga.frames import ALL_CHANNELS, FRAME_BYTES
from controller.fpga.registers import Control, Start
from controller.fpga.upload_image import UploadImage

CHECK_TICKS: Final = 8  # beyond one for each word, until the FPGA has checked what it stored


class PlayMessages:
    """Packs the messages of uploads and plays.

    Parameters
    ----------
    sent : memoryview of bytes
        The send buffer, in which every message begins at 0.
    board : Board

    Attributes
    ----------
    loads : int
        LOAD frames at the beginning of a message with an upload.
    """

    def __init__(self, sent: memoryview, board: Board) -> None:
        self._sent = sent
        self._image = UploadImage(sent, board.waveform.samples)
        self.loads = self._image.frames
        self._lengths = [(*self._image.lengths, *[FRAME_BYTES] * commands) for commands in range(COMMANDS + 1)]
        frame_ticks = 8 * FRAME_BYTES * board.link.clock_hz // board.link.sck_hz
        self._check_frames = (board.waveform.samples + CHECK_TICKS) // frame_ticks  # whole frames on the wire during the check

    def play(
        self,
        sequence: int,
        slot: int,
        *,
        count: int,
        period_ticks: int,
        start: Start,
        when_ticks: int,
        mask: int = ALL_CHANNELS,
        stop: bool,
    ) -> int:
        """Pack the play of a resident waveform; returns the offset of its end.

        Parameters
        ----------
        sequence : int
            Of the first frame.
        slot, count, period_ticks, start, when_ticks, mask
            As in `frames.pack_play`.
        stop : bool
            Put a STOP first.
        """
        end = 0
        if stop:
            end = frames.pack_control(self._sent, 0, sequence, Control.STOP)
        end = frames.pack_play(
            self._sent,
            end,
            sequence + stop,
            slot,
            count=count,
            period_ticks=period_ticks,
            start=start,
            when_ticks=when_ticks,
            mask=mask,
        )
        return frames.pack_nop(self._sent, end, sequence + stop + 1)

    def upload(self, sequence: int, slot: int, words: memoryview, crc: int) -> tuple[int, ...]:
        """Pack an upload into a slot, with NOPs until its check is done; returns the length of each frame in bytes.

        Parameters
        ----------
        sequence : int
            Of the first frame.
        slot : int
        words : memoryview of bytes
            Drive words, 4 bytes for each sample.
        crc : int
            CRC-32 that the stored words must have.
        """
        end, sequence = self._loads_and_store(sequence, slot, words, crc)
        nops = self._check_frames + 1
        for number in range(nops):
            end = frames.pack_nop(self._sent, end, sequence + number)
        return self._lengths[1 + nops]

    def upload_and_play(
        self,
        sequence: int,
        slot: int,
        words: memoryview,
        crc: int,
        *,
        count: int,
        period_ticks: int,
        start: Start,
        when_ticks: int,
        stop: bool,
    ) -> tuple[int, ...]:
        """Pack an upload and the play of what it stores; returns the length of each frame in bytes.

        Parameters
        ----------
        sequence : int
            Of the first frame.
        slot, words, crc
            As in `upload`.
        count, period_ticks, start, when_ticks
            As in `frames.pack_play`.
        stop : bool
            Put a STOP before the PLAY.
        """
        end, sequence = self._loads_and_store(sequence, slot, words, crc)
        commands = 1
        if stop:
            end = frames.pack_control(self._sent, end, sequence, Control.STOP)
            sequence, commands = sequence + 1, commands + 1
        for _ in range(self._check_frames - stop):  # the FPGA checks the CRC of what it stored meanwhile
            end = frames.pack_nop(self._sent, end, sequence)
            sequence, commands = sequence + 1, commands + 1
        end = frames.pack_play(
            self._sent, end, sequence, slot, count=count, period_ticks=period_ticks, start=start, when_ticks=when_ticks
        )
        frames.pack_nop(self._sent, end, sequence + 1)
        return self._lengths[commands + 2]

    def _loads_and_store(self, sequence: int, slot: int, words: memoryview, crc: int) -> tuple[int, int]:
        """Pack LOADs and STORE; the offset of their end and the next sequence number."""
        end = self._image.pack(sequence, words)
        sequence += self.loads
        return frames.pack_store(self._sent, end, sequence, slot, words.nbytes // 4, crc), sequence + 1
