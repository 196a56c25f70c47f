"""A session with one FPGA: what `Supervision` controls, with uploads and plays.

A message with a play that was damaged is sent again behind a STOP, so that nothing plays twice.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from controller.board.board import Board
from controller.fpga import frames
from controller.fpga.exchange import Refused
from controller.fpga.frames import ALL_CHANNELS, Waveform
from controller.fpga.link import Link
from controller.fpga.play_messages import PlayMessages
from controller.fpga.registers import Control, Register, Result, Start
from controller.fpga.status import Status
from controller.fpga.supervision import Supervision

RESET_RESULTS: Final = frozenset({Result.NOT_ARMED, Result.EMPTY_SLOT})  # also what an FPGA answers that was reset


class Session(Supervision):
    """Uploads and plays waveforms on one FPGA.

    Parameters
    ----------
    link, board, build_hash, now_s, bring_up
        As in `Supervision`.

    Raises
    ------
    LinkError
        If the FPGA does not answer, or is not the one that board and gateware call for.
    """

    def __init__(self, link: Link, board: Board, build_hash: int, now_s: Callable[[], float], *, bring_up: bool = True) -> None:
        super().__init__(link, board, build_hash, now_s, bring_up=bring_up)
        self._messages = PlayMessages(self._sent, board)

    def play(
        self,
        slot: int,
        count: int,
        period_s: float,
        *,
        stop: bool,
        start: Start = Start.TRIGGER,
        when_ticks: int = 0,
        mask: int = ALL_CHANNELS,
    ) -> None:
        """Queue the play of a resident waveform: at the next trigger, at once, or at a time.

        Parameters
        ----------
        slot : int
        count : int
            Emissions; 0: endless.
        period_s : float
            From the start of an emission to the start of the next.
        stop : bool
            End a running repetition first.
        start, when_ticks, mask
            As in `frames.pack_play`.

        Raises
        ------
        Refused
            If the FPGA cannot play it.
        FpgaReset
            If it was reset, and the waveform is lost.
        LinkError
            If every attempt was damaged; nothing is left to play then.
        """

        def send(again: bool) -> None:
            lengths = self._messages.play(
                self.exchange.sequence,
                slot,
                count=count,
                period_ticks=self.timing.period_ticks(period_s),
                start=start,
                when_ticks=when_ticks,
                mask=mask,
                stop=stop or again,
            )
            self.exchange.deliver(lengths)

        try:
            self.exchange.retry(send)
        except Refused as refusal:
            self._raise_if_reset(refusal)
            raise

    def upload(self, slot: int, waveform: Waveform) -> None:
        """Send drive words and store them as a slot's waveform, without playing it.

        Parameters
        ----------
        slot : int
        waveform : memoryview of bytes, or ReadyFrames
            Drive words, 4 bytes for each sample; or the frames that carry them.

        Raises
        ------
        Refused
            If the FPGA cannot store it.
        LinkError
            If every attempt was damaged.
        """

        def send(_: bool) -> None:
            lengths = self._messages.upload(self.exchange.sequence, slot, waveform)
            self.exchange.deliver(lengths, self._messages.loads)

        self.exchange.retry(send)

    def upload_and_play(
        self,
        slot: int,
        waveform: Waveform,
        count: int,
        period_s: float,
        *,
        stop: bool,
        start: Start = Start.TRIGGER,
        when_ticks: int = 0,
    ) -> None:
        """Send drive words, store them as a slot's waveform and queue its play, in one message.

        The words are copied once, into the frames. A message sent again may be too late for `when_ticks`: it is refused then,
        with the waveform stored.

        Parameters
        ----------
        slot, waveform
            As in `upload`.
        count, period_s, stop, start, when_ticks
            As in `play`.

        Raises
        ------
        Refused
            If the FPGA cannot store or play it.
        FpgaReset
            If it was reset.
        LinkError
            If every attempt was damaged; nothing is left to play then.
        """

        def send(again: bool) -> None:
            lengths = self._messages.upload_and_play(
                self.exchange.sequence,
                slot,
                waveform,
                count=count,
                period_ticks=self.timing.period_ticks(period_s),
                start=start,
                when_ticks=when_ticks,
                stop=stop or again,
            )
            self.exchange.deliver(lengths, self._messages.loads)

        try:
            self.exchange.retry(send)
        except Refused as refusal:
            self._raise_if_reset(refusal)
            if refusal.result is not Result.TOO_LATE:
                self.exchange.stop()  # if the STORE was refused, the PLAY after it may have queued the slot's old waveform
            raise

    def stop(self) -> None:
        """End a repetition after its current emission, and empty the queue.

        Raises
        ------
        LinkError
            If every attempt was damaged.
        """
        self.exchange.control(Control.STOP)

    def trigger(self) -> float:
        """Start the play at the head of the queue; returns the time of the trigger's edge, on the loop's clock."""
        return self.link.trigger()

    def set_bit_period(self, scale: float) -> bool:
        """Scale the bit clock, for example for the plate's temperature; kept over `bring_up`.

        Parameters
        ----------
        scale : float
            Factor of the board's bit clock; above 1 plays faster.

        Returns
        -------
        bool
            False if something plays or is queued: try again later.

        Raises
        ------
        Refused
            If the FPGA does not allow this rate.
        """
        period = self.timing.scaled_bit_period(scale)
        if period == self.bit_period:
            return True

        def send(_: bool) -> Status:
            end = frames.pack_write(self._sent, 0, self.exchange.sequence, Register.BIT_PERIOD, period)
            return self.exchange.send_short(frames.pack_nop(self._sent, end, self.exchange.sequence + 1))

        try:
            self.exchange.retry(send)
        except Refused as refusal:
            if refusal.result is Result.BUSY:
                return False
            raise
        self.timing.bit_period = period
        return True

    def _raise_if_reset(self, refusal: Refused) -> None:
        """Raise FpgaReset if the FPGA refused because it was reset."""
        if self._armed and refusal.result in RESET_RESULTS:
            self.heartbeat()
