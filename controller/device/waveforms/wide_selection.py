"""Selects waveforms for a panel of several FPGAs, each of which drives patches of its own on one plate.

What a patch adds to a focus depends on its own response alone. So the words of each FPGA are those of its own bank: entries as they
are, or composed from the responses of its own patches for the same share of what all its patches can do. Whether a point jumps up
or down is the same for all: as suits the first one best.
"""

from __future__ import annotations

import numpy as np

from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS
from controller.device.fpga.frames import Waveform, joined
from controller.device.kernel import MAX_FOCI
from controller.device.waveforms.selection import CHANNEL, Key, Selection


def selection_of(bank: Bank, board: Board, snap_m: float, *, ready: bool = True) -> Selection:
    """Selection of a board's bank, for one FPGA or several; `snap_m` and `ready` as of `Selection`."""
    if bank.others:
        return WideSelection(bank, board, snap_m)
    return Selection(bank, snap_m, board.idle_word, board.waveform.band_hz, ready=ready)


class WideSelection(Selection):
    """Keys as of the first FPGA's bank; waveforms are those of all FPGAs, one behind the other (`frames.joined`)."""

    def __init__(self, bank: Bank, board: Board, snap_m: float) -> None:
        of_each = [
            Selection(one, snap_m, part.idle_word, board.waveform.band_hz, ready=False)  # composed beforehand: for one FPGA alone
            for one, part in zip((bank, *bank.others), board.fpga_boards, strict=True)
        ]
        super().__init__(bank, snap_m, board.fpga_boards[0].idle_word, board.waveform.band_hz, ready=False)
        self._of_each = of_each
        self._idle_words = [part.idle_word for part in board.fpga_boards]
        self._polarities = bytearray(MAX_FOCI)

    @property
    def composes(self) -> bool:
        """As in `Selection`."""
        return self._of_each[0].composes

    def prepare(self) -> None:
        """As in `Selection`."""
        for one in self._of_each:
            one.prepare()

    def waveform(self, key: Key, polarities: bytearray | None = None) -> Waveform:
        """As in `Selection`, of all FPGAs."""
        if not isinstance(key, int) and key[0][2] == CHANNEL:
            return self._chirp(key[0][0])
        if polarities is None:
            polarities = self._polarities
            polarities[:] = bytes(MAX_FOCI)
        return joined([one.waveform(key, polarities) for one in self._of_each])

    def _chirp(self, channel: int) -> Waveform:
        """The test of a channel: the other FPGAs stay at their idle levels."""
        number, own = divmod(channel, CHANNELS)
        still = [memoryview(np.full(self._bank.samples, idle, "<u4").tobytes()) for idle in self._idle_words]
        return joined([*still[:number], self._of_each[number].waveform(((own, 0, CHANNEL),)), *still[number + 1 :]])

    def recheck(self, key: Key) -> None:
        """As in `Selection`."""
        for one in self._of_each:
            one.recheck(key)
