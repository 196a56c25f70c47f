"""Waveforms on their way to the FPGA: what is to be played is sent there or found in a slot; what a moving finger will ask for
next is sent ahead.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from controller.device.fpga.exchange import DAMAGED, Refused
from controller.device.fpga.frames import ALL_CHANNELS, Play, ReadyFrames, new_play
from controller.device.fpga.registers import Result, Start
from controller.device.loop.context import LoopContext
from controller.device.loop.playing.occupancy import Occupancy
from controller.device.loop.playing.prefetch import PrefetchRecord
from controller.device.loop.playing.records import Plan
from controller.device.loop.playing.slot_cache import SlotCache
from controller.device.loop.skips import Skips
from controller.device.waveforms.composition import Point
from controller.device.waveforms.selection import NULL, Key, Selection
from controller.errors import BankError

TRIGGER: Final = Start.TRIGGER
TIME: Final = Start.TIME


class Sender:
    """The slots of an armed FPGA, and what is sent into them."""

    def __init__(self, context: LoopContext, selection: Selection, occupancy: Occupancy, slots: int, skips: Skips) -> None:
        self.selection = selection  # drive words for points
        self._session = context.session
        self._counters = context.counters
        self._occupancy = occupancy
        self._skips = skips
        self.slots = self._new_slots(slots)  # what is resident
        self._prefetch = PrefetchRecord(context.counters)
        self._last_slot: int | None = None  # of the newest play

    def send(self, plan: Plan) -> None:
        """Have a plan's waveform accepted for playing, uploaded before if it is not resident.

        Raises BankError if the bank lacks what it needs; LinkError or FaultError or Refused as the session says.
        """
        if self._prefetch.predicted is not None:
            self._prefetch.compare(plan.batch.emissions, plan.key, self.selection)
        if plan.resident is None:
            self._upload(plan)
        else:
            self._play(plan, plan.resident)
            self._counters.near += plan.resident != plan.key

    def prefetch(self, finger: int, x_m: float, y_m: float, amplitude: float, *, steady: bool = True, fingers: int = 1) -> bool:
        """Upload the waveform of a predicted emission without playing it, if predictions have come true of late.

        `steady`: the finger's last report was where it had been predicted: it has not turned or stopped. `fingers` are down: what
        one asks for may be composed with what another does. Returns whether it was sent: not if it is resident already, or the bank
        or the FPGA cannot serve it. Raises LinkError or FaultError as the session says.
        """
        key = self.selection.key(((x_m, y_m, amplitude),))
        if not (self._skips.ahead and self._skips.resident):
            return False
        likely = self._prefetch.predict(finger, key, self.selection, fingers)
        if not likely or not steady or self.slots.slots == 1 or self.slots.find(key) is not None:
            return False
        try:
            waveform = self.selection.waveform(key)
            slot = self._take()
            try:
                self._session.upload(slot, waveform)
            except Refused as refusal:
                self._recheck(key, refusal)
                raise
        except (BankError, Refused):
            return False
        self.slots.keep(key, slot)
        self._prefetch.sent(slot)
        return True

    def pin(self, points: Sequence[Point]) -> None:
        """Keep the waveforms of these points (x_m, y_m, amplitude) in their slots once they are there."""
        self.slots.pin(self.selection.key((point,)) for point in points)

    def change_bank(self, selection: Selection) -> None:
        """Play from another bank: nothing that is resident serves any more."""
        self.selection = selection
        self.slots = self._new_slots(self.slots.slots)
        self._prefetch.unplayed.clear()

    def reset(self) -> None:
        """The FPGA holds nothing: after a fault."""
        self.slots.clear()
        self._prefetch.unplayed.clear()

    def _play(self, plan: Plan, resident: Key) -> None:
        """Have a resident waveform accepted for playing."""
        slot = self.slots.use(resident)
        try:
            self._session.play(self._record(plan, slot), stop=self._occupancy.repetition is not None)
        except Refused as refusal:
            if refusal.result is Result.SLOT_DAMAGED:
                self.slots.drop(slot)
            raise
        finally:
            if self._occupancy.repeating:
                self._replaced()
        self._last_slot = slot
        if slot in self._prefetch.unplayed:
            self._prefetch.played(slot)

    def _upload(self, plan: Plan) -> None:
        """Put a waveform into the slot that was played longest ago, and have it accepted for playing."""
        key = plan.key
        waveform = self.selection.waveform(key)
        if isinstance(waveform, ReadyFrames):
            self._counters.skipped.compositions += 1
            self._counters.composed_beforehand += not isinstance(key, int)
        elif not isinstance(key, int) and key[-1][2] == NULL:
            self._counters.kept_still += 1
        slot = self._take()
        try:
            self._session.upload_and_play(self._record(plan, slot), waveform, stop=self._occupancy.repetition is not None)
        except Refused as refusal:
            self._recheck(key, refusal)
            if refusal.result is Result.TOO_LATE:  # stored, not played
                self.slots.keep(key, slot)
            raise
        finally:
            if self._occupancy.repeating:
                self._replaced()
        self._last_slot = slot
        self.slots.keep(key, slot)

    def _record(self, plan: Plan, slot: int) -> Play:
        batch, ticks = plan.batch, plan.start_ticks
        period_ticks = 0 if batch.repetitions == 1 else self._session.timing.period_ticks(batch.period_s)
        start, when_ticks = (TRIGGER, 0) if ticks is None else (TIME, ticks)
        return new_play((slot, 0, 0, batch.repetitions, start, False, period_ticks, ALL_CHANNELS, when_ticks))

    def _replaced(self) -> None:
        """Take note that a play ends the repetition before it, whatever becomes of the play."""
        self._occupancy.stop_repetition(self._session.earliest_trigger_s())

    def _recheck(self, key: Key, refusal: Refused) -> None:
        """Ask the bank about an upload that the FPGA found damaged, frame by frame or as a whole: it may come from the file."""
        if refusal.result in DAMAGED or refusal.result is Result.SLOT_DAMAGED:
            self.selection.recheck(key)

    def _new_slots(self, slots: int) -> SlotCache:
        near_m = self.selection.reuse_m if self._skips.near else -1.0
        return SlotCache(slots, self.selection.single_focus, near_m, reuses=self._skips.resident)

    def _take(self) -> int:
        """A slot to upload to: not that of the newest play, which sounds, waits or is repeated, while there is another."""
        slot = self.slots.take(self._last_slot)
        self._prefetch.unplayed.discard(slot)
        return slot
