"""Where and when a batch of emissions can be played, and by which waveform."""

from __future__ import annotations

from collections.abc import Sequence

from controller.clocks import FpgaTime
from controller.device.loop.context import LoopContext
from controller.device.loop.playing.host_timing import DeliveryTime, HostTiming
from controller.device.loop.playing.occupancy import Occupancy
from controller.device.loop.playing.records import Batch, Plan
from controller.device.loop.playing.sending import Sender
from controller.device.scene.emission import Emission
from controller.device.waveforms.composition import Point
from controller.device.waveforms.selection import Key


class Planner:
    """Plans for the panel of a context; an emission is focused where its finger will be when the focus forms."""

    def __init__(self, context: LoopContext, sender: Sender, occupancy: Occupancy, timing: HostTiming) -> None:
        self._clock_estimate = context.clock_estimate
        self._counters = context.counters
        self._locate = context.source.predict
        self._down = context.source.down
        self._sender = sender
        self._occupancy = occupancy
        self._timing = timing

    def plan(self, batch: Batch, begun_s: float, *, predicted: bool, points: list[Point] | None) -> Plan:
        """Plan a batch: as a play command alone if that is enough, else with an upload before it.

        An upload starts later, and so meets a moving finger elsewhere: there another waveform may be resident.

        It goes out from the host time `begun_s` on. Fingers are met where they will be if `predicted`, otherwise where they were,
        or at `points`, if these have been decided.
        """
        sender, emissions = self._sender, batch.emissions
        start_s, missed = self._start(batch, begun_s, self._timing.command)
        aimed = self._aim(emissions, start_s, predicted=predicted) if points is None else points
        if emissions[0].channel >= 0:
            return self._test(batch, aimed, start_s, begun_s)
        nulled = False
        for emission in emissions:
            nulled = nulled or emission.nulled
        key = self._null_key(aimed, emissions, start_s) if nulled else sender.selection.key(aimed)
        resident = sender.slots.find(key)
        if resident is None:
            start_s, missed = self._start(batch, begun_s, self._timing.upload)
            later = self._aim(emissions, start_s, predicted=predicted) if points is None else points
            if later != aimed or nulled:
                aimed = later
                key = self._null_key(aimed, emissions, start_s) if nulled else sender.selection.key(aimed)
                resident = sender.slots.find(key)
        start_ticks = None
        if missed:
            self._counters.late += 1
        elif batch.at_s is not None:
            start_ticks = self._clock_estimate.ticks(start_s)
        return Plan(batch, aimed, key, resident, start_s, start_ticks)

    def _test(self, batch: Batch, points: list[Point], start_s: FpgaTime, begun_s: float) -> Plan:
        """Plan the test of a channel."""
        key = self._sender.selection.channel_key(batch.emissions[0].channel)
        resident = self._sender.slots.find(key)
        if resident is None:
            start_s, _ = self._start(batch, begun_s, self._timing.upload)
        return Plan(batch, points, key, resident, start_s, None)

    def _start(self, batch: Batch, begun_s: float, delivery: DeliveryTime) -> tuple[FpgaTime, bool]:
        """Earliest start of what begins to go out now; whether that misses a pulse, which is played on arrival then."""
        at_s = batch.at_s
        if at_s is None or not batch.has_begun:
            arrived_s = begun_s + (delivery.expected_s if at_s is None else delivery.promised_s) + self._clock_estimate.offset_s
            return self._occupancy.earliest_start_s(arrived_s, at_s), False
        arrived_s = begun_s + delivery.expected_s + self._clock_estimate.offset_s
        start_s = max(self._occupancy.free_from_s(arrived_s), at_s)
        return (arrived_s, True) if arrived_s > start_s else (start_s, False)

    def _aim(self, emissions: Sequence[Emission], start_s: FpgaTime, *, predicted: bool) -> list[Point]:
        """Where the focus of each emission is to be, and its amplitude."""
        focus_s = start_s - self._clock_estimate.offset_s + self._occupancy.duration_s
        points = []
        for emission in emissions:
            place = self._locate(emission.finger, focus_s) if emission.finger is not None and predicted else None
            x_m, y_m = (emission.x_m, emission.y_m) if place is None else place
            points.append((x_m, y_m, emission.amplitude))
        return points

    def _null_key(self, points: list[Point], emissions: Sequence[Emission], start_s: FpgaTime) -> Key:
        """Key of a waveform that keeps all other fingers still where they will be."""
        focus_s = start_s - self._clock_estimate.offset_s + self._occupancy.duration_s
        felt_by = [emission.finger for emission in emissions]
        places = [self._locate(finger, focus_s) for finger in self._down() if finger not in felt_by]
        return self._sender.selection.null_key(points, [place for place in places if place is not None])
