"""Playing a waveform while it is still arriving: the first word is on the pins a chunk and a frame after the upload began.

Every word that plays came in an accepted frame; an emission that reaches one that did not is shut off by the FPGA (underrun).
So the link has to be faster than the pins: a chunk on the wire may take no longer than its words take to play.
"""

from __future__ import annotations

import zlib

from controller.board.board import Board
from controller.errors import LinkError
from controller.fpga import frames
from controller.fpga.frames import FRAME_BYTES, LOAD_FRAME_BYTES, upload_slices
from controller.fpga.registers import CHUNK_WORDS, PLAY_LANDING, Start
from controller.fpga.session import Session


def slowest_sck_hz(board: Board) -> float:
    """SCK below which words would play faster than they arrive: 32 bits a word, and the frame around a chunk."""
    return 8 * LOAD_FRAME_BYTES / (CHUNK_WORDS * board.waveform.bit_period_s)


def play_arriving(session: Session, board: Board, words: memoryview, start: Start = Start.NOW) -> None:
    """Send drive words and have them play once the first chunk is there; nothing may wait in the queue.

    Parameters
    ----------
    words : memoryview of bytes
        As many drive words as the board's waveforms have.
    start : Start
        By itself, or by a trigger that comes before the upload ends.

    Raises
    ------
    LinkError
        If the link is too slow, or damages what it carries; the FPGA has shut the outputs off if words were missing.
    Refused
        If the FPGA cannot play it.
    """
    least_hz = slowest_sck_hz(board)
    if board.link.sck_hz < least_hz:
        raise LinkError(
            f"link.sck_hz = {board.link.sck_hz} is below {least_hz:.0f}, which playing a waveform while it arrives needs"
            f" at {board.waveform.bit_clock_hz:g} words a second: upload it first"
        )
    exchange, sequence = session.exchange, session.exchange.sequence
    pieces = upload_slices(words.nbytes // 4)
    step = 4 * CHUNK_WORDS
    lengths: list[int] = []
    end = 0
    for chunk, piece in enumerate(pieces):
        end = frames.pack_load(exchange.sent, end, sequence + len(lengths), chunk, words[chunk * step : (chunk + 1) * step])
        lengths.append(piece.stop - piece.start)
        if chunk == 0:
            length = words.nbytes // 4
            end = frames.pack_play(exchange.sent, end, sequence + 1, PLAY_LANDING, length=length, start=start)
            lengths.append(FRAME_BYTES)
    frames.pack_nop(exchange.sent, end, sequence + len(lengths))
    exchange.message([*lengths, FRAME_BYTES])


def keep(session: Session, slot: int, words: memoryview) -> None:
    """Make what has arrived and played the waveform of a slot.

    Raises
    ------
    Refused
        If it still plays (BUSY), or not all of it is there.
    """
    exchange = session.exchange
    end = frames.pack_store(exchange.sent, 0, exchange.sequence, slot, words.nbytes // 4, zlib.crc32(words))
    exchange.short(frames.pack_nop(exchange.sent, end, exchange.sequence + 1))
