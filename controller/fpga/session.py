"""A session with one FPGA: what `Supervision` controls, with uploads and plays.

A message with a play of which a frame or an answer was damaged may have been taken or not: the FPGA is asked which before anything
is sent again. What waits in its queue is compared with what this host had accepted after each play and in each heartbeat
(`Belief`): a trigger that it did not see leaves a play behind, which the next trigger would start in place of its own.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable
from typing import Final

from controller.board.board import Board
from controller.errors import LinkError
from controller.fpga import frames
from controller.fpga.belief import Belief
from controller.fpga.exchange import ATTEMPTS, DAMAGED, OutOfStep, Refused
from controller.fpga.frames import ALL_CHANNELS, ReadyFrames, Waveform
from controller.fpga.link import Link
from controller.fpga.play_messages import PlayMessages
from controller.fpga.registers import READ_SLOT_CRC, Control, Register, Result, Start, State
from controller.fpga.status import QUEUED_AT, TICKS, TICKS_AT, Status, parse_status
from controller.fpga.supervision import Supervision
from controller.metrics import LinkCounters

RESET_RESULTS: Final = frozenset({Result.NOT_ARMED, Result.EMPTY_SLOT})  # also what an FPGA answers that was reset
REPETITIONS: Final = (False, *[True] * (ATTEMPTS - 1))  # whether each attempt is one


def _nobody(repeats: bool) -> None:
    """In place of whoever wants to know that an emission never began."""


class Session(Supervision):
    """Uploads and plays waveforms on one FPGA.

    Parameters
    ----------
    link, board, build_hash, now_s, bring_up
        As in `Supervision`.

    Attributes
    ----------
    belief : Belief
        What waits and plays in the FPGA.
    counters : LinkCounters
        Counts what differs from it.
    never_began : callable
        Called when an emission that this host had started is found not to have begun; its argument says whether the FPGA repeats
        one by itself.

    Raises
    ------
    LinkError
        If the FPGA does not answer, or is not the one that board and gateware call for.
    """

    def __init__(self, link: Link, board: Board, build_hash: int, now_s: Callable[[], float], *, bring_up: bool = True) -> None:
        self.belief = Belief()
        self.counters = LinkCounters()
        self.never_began: Callable[[bool], None] = _nobody
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
        self._play(slot, None, count, period_s, stop, start, when_ticks, mask)

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

        The words are copied once, into the frames. If no copy of a message was taken, the next one may be too late for
        `when_ticks`: it is refused then, with the waveform stored.

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
        self._play(slot, waveform, count, period_s, stop, start, when_ticks, ALL_CHANNELS)

    def stop(self) -> None:
        """End a repetition after its current emission, and empty the queue.

        Raises
        ------
        LinkError
            If every attempt was damaged.
        """
        status = self.exchange.control(Control.STOP)
        self.counters.emissions_lost += self.belief.stopped(status.timestamp_ticks)

    def trigger(self) -> float:
        """Start the play at the head of the queue; returns the time of the trigger's edge, on the loop's clock."""
        at_s = self.link.trigger()
        self.belief.triggered()
        return at_s

    def arm(self) -> float:
        """As `Supervision.arm`."""
        self.belief.forget()
        return super().arm()

    def disarm(self) -> float:
        """As `Supervision.disarm`; what was started since the last heartbeat is compared with what the FPGA has begun before."""
        if self._armed:
            try:
                status = super().heartbeat()
            except LinkError:
                pass  # it is told to disarm all the same
            else:
                self.belief.at(status.timestamp_ticks)
                self._compare(status)
        return super().disarm()

    def heartbeat(self) -> Status:
        """As `Supervision.heartbeat`; what the FPGA has in its queue, and has begun, is compared with what this host believes.

        Raises
        ------
        OutOfStep
            If plays wait that this host had not accepted, beside those that it had.
        """
        status = super().heartbeat()
        belief, ticks = self.belief, status.timestamp_ticks
        if not self._armed or belief.unsure(ticks):
            return status
        early = belief.just_triggered and not belief.saw_triggers(status)
        belief.just_triggered = False
        if early:  # the next heartbeat, or the next play, decides
            return status
        surplus = status.queued - belief.at(ticks)
        if surplus > 0 and belief.waiting:
            raise OutOfStep(f"the FPGA holds {status.queued} plays where {len(belief.waiting)} were accepted")
        if surplus > 0 or belief.repeats_unasked(status.state):
            self.counters.plays_stale += max(surplus, 1)
            self.exchange.control(Control.STOP)
        for _ in range(-surplus):
            belief.begin_first()  # by an edge that is not of this host
        ended = belief.repetition_ended(status.state)
        self._compare(status)
        if ended:
            self.counters.emissions_lost += belief.stopped(ticks)
            self.never_began(False)
        return status

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

    def _play(
        self,
        slot: int,
        waveform: Waveform | None,
        count: int,
        period_s: float,
        stop: bool,
        start: Start,
        when_ticks: int,
        mask: int,
    ) -> None:
        """Have a play accepted, with its upload if there is a waveform; raises as `upload_and_play`."""
        messages = self._messages
        period_ticks = 0 if count == 1 else self.timing.period_ticks(period_s)
        failure: LinkError = OutOfStep("the FPGA's queue holds other plays than were accepted, also after a STOP")
        for again in REPETITIONS:
            sequence, stopped = self.exchange.sequence, stop or again
            try:
                if waveform is None:
                    lengths = messages.play(
                        sequence,
                        slot,
                        count=count,
                        period_ticks=period_ticks,
                        start=start,
                        when_ticks=when_ticks,
                        mask=mask,
                        stop=stopped,
                    )
                    answer = self.exchange.deliver(lengths)
                else:
                    lengths = messages.upload_and_play(
                        sequence,
                        slot,
                        waveform,
                        count=count,
                        period_ticks=period_ticks,
                        start=start,
                        when_ticks=when_ticks,
                        stop=stopped,
                    )
                    answer = self.exchange.deliver(lengths, messages.loads)
            except Refused as refusal:
                if refusal.result not in DAMAGED:
                    self._raise_if_reset(refusal)
                    if waveform is not None and refusal.result is not Result.TOO_LATE:
                        self._remove(start, when_ticks)  # if the STORE was refused, the PLAY after it may have been taken
                    raise
                failure = refusal
            except LinkError as error:
                failure = error
            else:
                if self._in_step(answer, start, when_ticks, count, stopped):
                    return
                continue
            stored, taken = self._first_copy(slot, waveform, start, when_ticks, count, period_ticks, stopped)
            if taken:
                self.counters.first_copies_taken += 1
                return
            self.counters.messages_repeated += 1
            if stored:
                waveform = None
        self.exchange.stop()
        raise failure

    def _in_step(self, answer: int, start: Start, when_ticks: int, count: int, stopped: bool) -> bool:
        """Whether the queue holds what was accepted, the new play included, by the answer behind it; if not, it is emptied."""
        belief, received = self.belief, self.exchange.received
        if stopped or belief.waiting:
            (ticks,) = TICKS.unpack_from(received, answer + TICKS_AT)
            if stopped:
                self.counters.emissions_lost += belief.stopped(ticks)
            else:
                belief.at(ticks)
        belief.accepted(start, when_ticks, count)
        if received[answer + QUEUED_AT] == len(belief.waiting):
            return True
        status = parse_status(received, answer)
        surplus = status.queued - belief.at(status.timestamp_ticks)
        if belief.unsure(status.timestamp_ticks):
            return True
        if surplus > 0:
            belief.withdrawn()
            self.counters.plays_stale += surplus
            self._compare(status)
            self.stop()
            return False
        for _ in range(-surplus):
            belief.begin_first()  # by an edge that is not of this host
        return True

    def _first_copy(
        self,
        slot: int,
        waveform: Waveform | None,
        start: Start,
        when_ticks: int,
        count: int,
        period_ticks: int,
        stopped: bool,
    ) -> tuple[bool, bool]:
        """Ask what became of a message of which a frame or an answer was damaged.

        Returns
        -------
        stored, taken : bool
            Whether the waveform is in its slot, and whether the play was accepted; nothing of it waits in the queue if not.

        Raises
        ------
        LinkError
            If the FPGA cannot be asked.
        """
        address = Register.EMISSION_TIME_LOW if waveform is None else READ_SLOT_CRC + slot
        try:
            status = self.exchange.retry(lambda _: self._asked(address))
        except Refused as refusal:  # nothing is stored there, or it is still being checked
            self._raise_if_reset(refusal)
            self._remove(start, when_ticks)
            return False, False
        belief, ticks = self.belief, status.timestamp_ticks
        stored = waveform is None or status.data == _crc_of(waveform)
        surplus = status.queued - (0 if stopped else belief.at(ticks))
        clear = stored and belief.saw_triggers(status) and not (stopped and State.REPEATING in status.state)
        if not clear or surplus > 1:
            self._compare(status)
            began = self._remove(start, when_ticks, stored=stored)
            if began and count != 1:
                raise OutOfStep("a repetition has begun of which the FPGA did not answer, and was ended")
            return stored, began and stored
        began = not surplus and start is Start.TIME and self._began(when_ticks, count, period_ticks)
        if surplus or began:
            if stopped:
                self.counters.emissions_lost += belief.stopped(ticks)
            belief.accepted(start, when_ticks, count)
        return stored, bool(surplus) or began

    def _asked(self, address: int) -> Status:
        """Status after a READ, with its value and the queue of the same moment."""
        end = frames.pack_read(self._sent, 0, self.exchange.sequence, address)
        return self.exchange.send_short(frames.pack_nop(self._sent, end, self.exchange.sequence + 1))

    def _began(self, when_ticks: int, count: int = 1, period_ticks: int = 0) -> bool:
        """Whether a play has begun at a tick: the last emission is its, or one of its repetitions."""
        last = self.exchange.read(Register.EMISSION_TIME_LOW)
        since = last - when_ticks & 0xFFFFFFFF
        return not since or (count != 1 and since < 1 << 31 and not since % period_ticks)

    def _remove(self, start: Start, when_ticks: int, *, stored: bool = False) -> bool:
        """Empty the queue, in which a play may wait that nobody accepted; whether it had begun."""
        self.stop()
        began = start is Start.TIME and self._began(when_ticks)
        if began:
            self.belief.began(1)
            self.counters.misplaced += not stored
        return began

    def _compare(self, status: Status) -> None:
        lost = self.belief.compare(status, self.counters)
        if lost:
            self.counters.emissions_lost += lost
            self.never_began(State.REPEATING in status.state)

    def _raise_if_reset(self, refusal: Refused) -> None:
        """Raise FpgaReset if the FPGA refused because it was reset."""
        if self._armed and refusal.result in RESET_RESULTS:
            self.heartbeat()


def _crc_of(waveform: Waveform) -> int:
    """CRC-32 of the drive words of a waveform."""
    return waveform.crc if isinstance(waveform, ReadyFrames) else zlib.crc32(waveform)
