"""Messages that upload and play waveforms: which frames, in which order, in the send buffer of an `Exchange`.

The short frames of a message are the same each time but for a few fields: they are copied as they are, the fields filled in, and
all of them numbered and sealed by one call.
"""

from __future__ import annotations

from typing import Final

from controller.device.board.board import Board
from controller.device.fpga import frames
from controller.device.fpga.exchange import COMMANDS
from controller.device.fpga.frames import FRAME_BYTES, PLAY_FIELDS, SHORT_FIELDS_AT, STORE_FIELDS, Play, ReadyFrames, Waveform
from controller.device.fpga.registers import Control
from controller.device.kernel import pack_loads, renumber_loads, seal_short_frames

CHECK_TICKS: Final = 8  # beyond one for each word, until the FPGA has checked what it stored


class Pattern:
    """Short frames of a message, the LOADs before them, and where what differs from message to message belongs."""

    __slots__ = ("blank", "lengths", "number", "part", "play_at")

    def __init__(self, part: slice, blank: bytes, number: int, play_at: int, lengths: tuple[int, ...]) -> None:
        self.part: Final = part  # where they lie in the send buffer
        self.blank: Final = blank  # the frames, without those fields, numbers and CRCs
        self.number: Final = number  # how many they are
        self.play_at: Final = play_at  # where the fields of the PLAY begin in the send buffer; 0: there is none
        self.lengths: Final = lengths  # bytes of each frame of the message


class PlayMessages:
    """Packs the messages of uploads and plays into the send buffer, in which every message begins at 0."""

    def __init__(self, sent: memoryview, board: Board) -> None:
        self._sent = sent
        self._samples = samples = board.waveform.samples
        pieces = frames.upload_slices(samples)
        self.loads = len(pieces)  # LOAD frames at the beginning of a message with an upload
        self._loads_bytes: int = pieces[-1].stop
        loads = tuple(piece.stop - piece.start for piece in pieces)
        frame_ticks = 8 * FRAME_BYTES * board.link.clock_hz // board.link.sck_hz
        check_frames = (samples + CHECK_TICKS) // frame_ticks  # whole frames on the wire while the FPGA checks what it stored
        store, nop, stop, play = (bytearray(FRAME_BYTES) for _ in range(4))
        frames.pack_store(store, 0, 0, 0, samples, 0)
        frames.pack_nop(nop, 0, 0)
        frames.pack_control(stop, 0, 0, Control.STOP)
        frames.pack_play(play, 0, 0, Play(0))
        # without a STOP before the PLAY, and with one
        self._plays = [_pattern((), [play, nop], 0), _pattern((), [stop, play, nop], 1)]
        self._uploads_and_plays = []
        for stops in ([], [stop]):
            waits = [*stops, *[nop] * (check_frames - len(stops))]
            self._uploads_and_plays.append(_pattern(loads, [store, *waits, play, nop], 1 + len(waits)))
        self._upload = _pattern(loads, [store, *[nop] * (check_frames + 1)], None)

    def sizes_bytes(self) -> tuple[int, int]:
        """Bytes on the wire of an upload with its play, and of a play of what is resident."""
        return sum(self._uploads_and_plays[0].lengths), sum(self._plays[0].lengths)

    def play(self, sequence: int, play: Play, *, stop: bool) -> tuple[int, ...]:
        """Pack the play of a resident waveform; returns the length of each frame in bytes.

        `sequence` is that of the first frame; with `stop` a STOP comes first.
        """
        sent, pattern = self._sent, self._plays[stop]
        sent[pattern.part] = pattern.blank
        PLAY_FIELDS.pack_into(sent, pattern.play_at, *play)
        seal_short_frames(sent, 0, pattern.number, sequence)
        return pattern.lengths

    def upload(self, sequence: int, slot: int, waveform: Waveform) -> tuple[int, ...]:
        """Pack an upload into a slot, with NOPs until its check is done; returns the length of each frame in bytes.

        `sequence` is that of the first frame; the waveform is drive words, 4 bytes for each sample, or the frames that carry them.
        Raises ValueError if the waveform is not as long as the board's.
        """
        sent, pattern = self._sent, self._upload
        crc = self._pack_loads(sequence, waveform)
        sent[pattern.part] = pattern.blank
        STORE_FIELDS.pack_into(sent, self._loads_bytes + SHORT_FIELDS_AT, slot, self._samples, crc)
        seal_short_frames(sent, self._loads_bytes, pattern.number, sequence + self.loads)
        return pattern.lengths

    def upload_and_play(self, sequence: int, play: Play, waveform: Waveform, *, stop: bool) -> tuple[int, ...]:
        """Pack an upload into the slot of a play, and that play; returns the length of each frame in bytes.

        With `stop` a STOP comes before the PLAY. Raises ValueError as `upload`.
        """
        sent, pattern = self._sent, self._uploads_and_plays[stop]
        crc = self._pack_loads(sequence, waveform)
        sent[pattern.part] = pattern.blank
        STORE_FIELDS.pack_into(sent, self._loads_bytes + SHORT_FIELDS_AT, play.slot, self._samples, crc)
        PLAY_FIELDS.pack_into(sent, pattern.play_at, *play)
        seal_short_frames(sent, self._loads_bytes, pattern.number, sequence + self.loads)
        return pattern.lengths

    def _pack_loads(self, sequence: int, waveform: Waveform) -> int:
        """Pack the LOADs of a waveform; returns the CRC-32 that its STORE demands."""
        if isinstance(waveform, ReadyFrames):
            ready, crc = waveform
            if ready.nbytes != self._loads_bytes:
                raise ValueError(f"{ready.nbytes} bytes of ready frames, not {self._loads_bytes} as the board's waveforms have")
            renumber_loads(self._sent, sequence, ready)
            return crc
        if waveform.nbytes != 4 * self._samples:
            raise ValueError(f"{waveform.nbytes} bytes of drive words, not {4 * self._samples} as the board's waveforms have")
        return pack_loads(self._sent, sequence, waveform)


def _pattern(loads: tuple[int, ...], shorts: list[bytearray], play: int | None) -> Pattern:
    """Pattern of a message: lengths of its LOADs, its short frames, and which of those is the PLAY, if any."""
    assert len(shorts) <= COMMANDS  # for which the send buffer has room
    at = sum(loads)
    blank = b"".join(shorts)
    play_at = 0 if play is None else at + play * FRAME_BYTES + SHORT_FIELDS_AT
    return Pattern(slice(at, at + len(blank)), blank, len(shorts), play_at, (*loads, *[FRAME_BYTES] * len(shorts)))
