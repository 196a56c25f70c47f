"""A session with one FPGA: what `Supervision` controls, with uploads and plays.

A message with a play of which a frame or an answer was damaged may have been taken or not: the FPGA is asked which before anything
is sent again. What waits in its queue is compared with what this host had accepted after each play and in each heartbeat
(`Belief`): a trigger that it did not see leaves a play behind, which the next trigger would start in place of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from controller.device.board.board import Board
from controller.device.fpga import frames
from controller.device.fpga.belief import Belief, NeverBegan, nobody
from controller.device.fpga.exchange import ATTEMPTS, DAMAGED, OutOfStep, Refused
from controller.device.fpga.frames import Play, Waveform, crc_of
from controller.device.fpga.links.link import Link
from controller.device.fpga.play_messages import PlayMessages
from controller.device.fpga.registers import READ_SLOT_CRC, Control, Register, Result, Start, State
from controller.device.fpga.status import QUEUED_AT, TICKS, TICKS_AT, Status, parse_status
from controller.device.fpga.supervision import Supervision
from controller.errors import LinkError
from controller.metrics import LinkCounters

RESET_RESULTS: Final = frozenset({Result.NOT_ARMED, Result.EMPTY_SLOT})  # also what an FPGA answers that was reset
REPETITIONS: Final = (False, *[True] * (ATTEMPTS - 1))  # whether each attempt is one


class Session(Supervision):
    """Uploads and plays waveforms on one FPGA.

    Raises LinkError if the FPGA does not answer, or is not the one that board and gateware call for.
    """

    def __init__(self, link: Link, board: Board, build_hash: int, now_s: Callable[[], float], *, bring_up: bool = True) -> None:
        self.belief = Belief()  # what waits and plays in the FPGA
        self.counters = LinkCounters()  # counts what differs from it
        # Called when an emission that this host had started is found not to have begun
        self.never_began: NeverBegan = nobody
        super().__init__(link, board, build_hash, now_s, bring_up=bring_up)
        self._messages = PlayMessages(self._sent, board)

    def play(self, play: Play, *, stop: bool) -> None:
        """Queue the play of a resident waveform; with `stop` it ends a running repetition first.

        Raises Refused if the FPGA cannot play it. Raises FpgaReset if it was reset, and the waveform is lost. Raises LinkError if
        every attempt was damaged; nothing is left to play then.
        """
        self._send(play, None, stop=stop)

    def upload(self, slot: int, waveform: Waveform) -> None:
        """Send drive words and store them as a slot's waveform, without playing it.

        The waveform is drive words, 4 bytes for each sample, or the frames that carry them. Raises Refused if the FPGA cannot store
        it; LinkError if every attempt was damaged.
        """

        def send() -> None:
            lengths = self._messages.upload(self.exchange.sequence, slot, waveform)
            self.exchange.deliver(lengths, self._messages.loads)

        self.exchange.retry(send)

    def upload_and_play(self, play: Play, waveform: Waveform, *, stop: bool) -> None:
        """Send drive words, store them in the slot of a play and queue that play, in one message.

        The words are copied once, into the frames. If no copy of a message was taken, the next one may be too late for
        `play.when_ticks`: it is refused then, with the waveform stored.

        With `stop` a running repetition is ended first. Raises Refused if the FPGA cannot store or play it. Raises FpgaReset if it
        was reset. Raises LinkError if every attempt was damaged; nothing is left to play then.
        """
        self._send(play, waveform, stop=stop)

    def stop(self) -> None:
        """End a repetition after its current emission, and empty the queue; raises LinkError if every attempt was damaged."""
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
                pass  # it is commanded to disarm all the same
            else:
                self.belief.at(status.timestamp_ticks)
                self._compare(status)
        return super().disarm()

    def heartbeat(self) -> Status:
        """As `Supervision.heartbeat`; what the FPGA has in its queue, and has begun, is compared with what this host believes.

        Raises OutOfStep if plays wait that this host had not accepted, beside those that it had.
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
            self.never_began(repeats=False)
        return status

    def _send(self, play: Play, waveform: Waveform | None, *, stop: bool) -> None:
        """Have a play accepted, with its upload if there is a waveform; raises as `upload_and_play`."""
        failure: LinkError = OutOfStep("the FPGA's queue holds other plays than were accepted, also after a STOP")
        for again in REPETITIONS:
            stopped = stop or again
            try:
                answer = self._deliver(play, waveform, stop=stopped)
            except Refused as refusal:
                if refusal.result not in DAMAGED:
                    self._raise_if_reset(refusal)
                    if waveform is not None and refusal.result is not Result.TOO_LATE:
                        self._remove(play)  # if the STORE was refused, the PLAY after it may have been taken
                    raise
                failure = refusal
            except LinkError as error:
                failure = error
            else:
                if self._in_step(answer, play, stopped=stopped):
                    return
                continue
            stored, taken = self._first_copy(play, waveform, stopped=stopped)
            if taken:
                self.counters.first_copies_taken += 1
                return
            self.counters.messages_repeated += 1
            if stored:
                waveform = None
        self.exchange.stop()
        raise failure

    def _deliver(self, play: Play, waveform: Waveform | None, *, stop: bool) -> int:
        """Send a play once, with its upload if there is a waveform; where the answer to it begins."""
        messages, sequence = self._messages, self.exchange.sequence
        if waveform is None:
            return self.exchange.deliver(messages.play(sequence, play, stop=stop))
        return self.exchange.deliver(messages.upload_and_play(sequence, play, waveform, stop=stop), messages.loads)

    def _in_step(self, answer: int, play: Play, *, stopped: bool) -> bool:
        """Whether the queue holds what was accepted, the new play included, by the answer behind it; if not, it is emptied."""
        belief, received = self.belief, self.exchange.received
        if stopped or belief.waiting:
            (ticks,) = TICKS.unpack_from(received, answer + TICKS_AT)
            if stopped:
                self.counters.emissions_lost += belief.stopped(ticks)
            else:
                belief.at(ticks)
        belief.accepted(play)
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

    def _first_copy(self, play: Play, waveform: Waveform | None, *, stopped: bool) -> tuple[bool, bool]:
        """Ask what became of a message of which a frame or an answer was damaged.

        Returns whether the waveform is in its slot, and whether the play was accepted; nothing of it waits in the queue if not.
        Raises LinkError if the FPGA cannot be asked.
        """
        address = Register.EMISSION_TIME_LOW if waveform is None else READ_SLOT_CRC + play.slot
        try:
            status = self.exchange.retry(lambda: self.exchange.ask(frames.pack_read, address))
        except Refused as refusal:  # nothing is stored there, or it is still being checked
            self._raise_if_reset(refusal)
            self._remove(play)
            return False, False
        belief, ticks = self.belief, status.timestamp_ticks
        stored = waveform is None or status.data == crc_of(waveform)
        surplus = status.queued - (0 if stopped else belief.at(ticks))
        clear = stored and belief.saw_triggers(status) and not (stopped and State.REPEATING in status.state)
        if not clear or surplus > 1:
            self._compare(status)
            began = self._remove(play, stored=stored)
            if began and play.emissions != 1:
                raise OutOfStep("a repetition has begun of which the FPGA did not answer, and was ended")
            return stored, began and stored
        began = not surplus and play.start is Start.TIME and self._began(play)
        if surplus or began:
            if stopped:
                self.counters.emissions_lost += belief.stopped(ticks)
            belief.accepted(play)
        return stored, bool(surplus) or began

    def _began(self, play: Play) -> bool:
        """Whether a play has begun at its time: the last emission is its, or one of its repetitions."""
        last = self.exchange.read(Register.EMISSION_TIME_LOW)
        since = last - play.when_ticks & 0xFFFFFFFF
        return not since or (play.emissions != 1 and since < 1 << 31 and not since % play.period_ticks)

    def _remove(self, play: Play, *, stored: bool = False) -> bool:
        """Empty the queue, in which a play may wait that nobody accepted; whether it had begun."""
        self.stop()
        began = play.start is Start.TIME and self._began(play._replace(emissions=1))
        if began:
            self.belief.began(1)
            self.counters.misplaced += not stored
        return began

    def _compare(self, status: Status) -> None:
        lost = self.belief.compare(status, self.counters)
        if lost:
            self.counters.emissions_lost += lost
            self.never_began(repeats=State.REPEATING in status.state)

    def _raise_if_reset(self, refusal: Refused) -> None:
        """Raise FpgaReset if the FPGA refused because it was reset."""
        if self._armed and refusal.result in RESET_RESULTS:
            self.heartbeat()
