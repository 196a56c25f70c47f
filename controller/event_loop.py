"""The device loop: touch reports in, triggers out; one thread, and nothing but the selector blocks.

Each turn reads at most one touch report, asks the scene what is due, and hands it to the playback.
What becomes due while the plate is busy waits, and all that waits is composed into one emission.
"""

from __future__ import annotations

import contextlib
import gc
import math
import selectors
import signal
import socket
import time
from collections.abc import Callable, Iterator
from typing import Protocol

from controller.errors import FaultError
from controller.fpga.exchange import HostSilent
from controller.fpga.session import Session
from controller.latency import Counters
from controller.playback import ENDLESS, NEVER, Playback
from controller.scene import OUTSIDE, ROUNDING_S, Emission, FingerState, Scene, Spot, next_time_s, on_time, on_touch
from controller.touch.source import TouchSource

SPOT_LEAD_S = 0.5e-3  # a spot's play command goes out this early, so that its beat does not wait for the wire
STALLS_IN_A_ROW = 3  # arming again after the host's own silence is tried this often without an emission in between


class Clock(Protocol):
    """Where the loop's time comes from, and how it waits."""

    def now_s(self) -> float:
        """Time in s, never going back."""

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Return at `until_s`, or earlier when a file of the selector is ready."""


class MonotonicClock:
    """Real time: the kernel's CLOCK_MONOTONIC."""

    def now_s(self) -> float:
        """Time in s since some fixed point."""
        return time.monotonic()

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Sleep in the selector."""
        selector.select(None if until_s == NEVER else max(until_s - time.monotonic(), 0.0))


class VirtualClock:
    """Time that jumps to whatever comes next: a replay as fast as the machine goes, the same every time."""

    def __init__(self) -> None:
        self._now_s = 0.0

    def now_s(self) -> float:
        """Time in s since the start."""
        return self._now_s

    def wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Jump; signals still come through the selector."""
        selector.select(0)
        if until_s != NEVER:
            self._now_s = max(self._now_s, until_s)


class EventLoop:
    """Drives one panel until its source ends or a signal comes.

    Parameters
    ----------
    clock, session, source, scene, playback
        The parts; each may be simulated.
    counters : Counters
        Shared with the playback.
    """

    def __init__(
        self, clock: Clock, session: Session, source: TouchSource, scene: Scene, playback: Playback, counters: Counters
    ) -> None:
        self._clock = clock
        self._session = session
        self._source = source
        self._scene = scene
        self._playback = playback
        self._counters = counters
        self._fingers: dict[int, FingerState] = {}
        self._due: dict[int | str, Emission] = {}  # the newest of each finger or spot
        self._spot_due_s: dict[Spot, float] = {}
        rates = {spot.rate_hz for spot in scene.spots}
        self._common_period_s = 1 / rates.pop() if len(rates) == 1 else None
        self._stopped = False
        self._stalls = 0
        self._emissions_at_stall = 0

    def stop(self) -> None:
        """End after this turn: outputs off, `run` returns."""
        self._stopped = True

    def run(self, ready: Callable[[], None] = lambda: None) -> None:
        """Arm, play until the source ends or `stop`, disarm; outputs are off when this returns or raises.

        Parameters
        ----------
        ready : callable
            Called once the panel is armed for the first time.

        Raises
        ------
        FaultError
            When the FPGA has switched off for a reason that the host may not clear by itself.
        LinkError, TouchError
            When the FPGA or the panel is lost.
        """
        with selectors.DefaultSelector() as selector, _signals(self.stop, selector), _collector_off():
            fileno = self._source.fileno()
            if fileno is not None:
                selector.register(fileno, selectors.EVENT_READ)
            try:
                self._arm(selector)
                ready()
                next_s: float | None = self._clock.now_s()
                while next_s is not None and not self._stopped:
                    try:
                        self._wait(selector, next_s)
                        next_s = self._turn()
                    except HostSilent as stall:
                        self._rearm(selector, stall)
                        next_s = self._clock.now_s()
                self._rest(selector, self._session.disarm())
            finally:
                self._session.off()

    def _arm(self, selector: selectors.BaseSelector) -> None:
        self._rest(selector, self._session.arm())
        self._session.require_armed()
        now_s = self._clock.now_s()
        self._spot_due_s = dict.fromkeys(self._scene.spots, now_s)

    def _rearm(self, selector: selectors.BaseSelector, stall: HostSilent) -> None:
        """This process stalled and the FPGA rightly switched off; work goes on, as it would have after a start."""
        self._counters.host_silent += 1
        self._stalls = self._stalls + 1 if self._counters.emissions == self._emissions_at_stall else 1
        self._emissions_at_stall = self._counters.emissions
        if self._stalls > STALLS_IN_A_ROW:
            raise FaultError(f"{stall} ({self._stalls} times in a row: the machine is too slow or too busy)") from stall
        self._playback.forget_slots()
        self._due.clear()
        self._session.clear_faults()
        self._arm(selector)

    def _rest(self, selector: selectors.BaseSelector, until_s: float) -> None:
        """Let the ramp pass, with heartbeats, whatever else wants attention."""
        while self._clock.now_s() < until_s:
            self._beat()
            self._clock.wait(selector, min(until_s, self._session.heartbeat_due_s))

    def _wait(self, selector: selectors.BaseSelector, until_s: float) -> None:
        self._beat()
        if self._clock.now_s() < until_s:
            self._clock.wait(selector, min(until_s, self._session.heartbeat_due_s))

    def _beat(self) -> None:
        if self._clock.now_s() >= self._session.heartbeat_due_s:
            self._session.heartbeat()
            self._counters.heartbeats += 1

    def _turn(self) -> float | None:
        """Do what is due now; the time of the next turn, or None when all is played."""
        started_ns = time.perf_counter_ns()
        now_s = self._clock.now_s()
        self._read(now_s)
        for finger, state in self._fingers.items():
            at_s = next_time_s(state)
            if at_s is not None and at_s <= now_s:
                self._fingers[finger], emissions = on_time(self._scene, state, now_s)
                self._add(emissions)
        self._add_spots(now_s)
        trigger_at_s = self._playback.trigger_at_s
        if trigger_at_s is not None and trigger_at_s <= now_s:
            self._playback.trigger(started_ns)
        elif trigger_at_s is None and self._due and self._session.free_s() <= now_s:
            self._play(now_s, started_ns)
        return self._next_s(now_s)

    def _read(self, now_s: float) -> None:
        for sample in self._source.read(now_s):
            before = self._fingers.get(sample.finger)
            state, emissions = on_touch(self._scene, before, sample)
            if state is None:
                self._fingers.pop(sample.finger, None)
                continue
            self._fingers[sample.finger] = state
            if emissions:
                self._add(emissions)
            elif state.region == OUTSIDE:
                self._counters.skipped.outside_region += 1
            else:
                self._counters.skipped.between_emissions += 1

    def _add(self, emissions: tuple[Emission, ...]) -> None:
        for emission in emissions:
            name = emission.region if emission.finger is None else emission.finger
            self._counters.skipped.merged += name in self._due
            self._due[name] = emission

    def _add_spots(self, now_s: float) -> None:
        if self._playback.repeating:
            return
        for spot, due_s in self._spot_due_s.items():
            if due_s <= now_s + SPOT_LEAD_S + ROUNDING_S:
                self._add((Emission(due_s, spot.x_m, spot.y_m, None, spot.region),))
                missed = max(math.floor((now_s - due_s) * spot.rate_hz), 0)
                self._spot_due_s[spot] = due_s + (missed + 1) / spot.rate_hz

    def _play(self, now_s: float, started_ns: int) -> None:
        """Prepare all that is due as one emission; spots alone are left to the FPGA to repeat."""
        emissions = list(self._due.values())
        self._due.clear()
        if all(emission.finger is None for emission in emissions):
            endless = self._common_period_s is not None
            due_s = max(emission.time_s for emission in emissions)
            count, period_s = (ENDLESS, self._common_period_s or 0.0) if endless else (1, 0.0)
            self._playback.prepare(emissions, started_ns, count=count, period_s=period_s, not_before_s=due_s)
            return
        if self._playback.repeating:  # the spots' repetition gives way, and takes part if it is due as well
            next_s = self._playback.next_repetition_s(now_s)
            if next_s < now_s + self._playback.duration_s:
                emissions += [Emission(now_s, spot.x_m, spot.y_m, None, spot.region) for spot in self._spot_due_s]
                next_s += self._common_period_s or NEVER
            self._spot_due_s = dict.fromkeys(self._spot_due_s, next_s)
        self._playback.prepare(emissions, started_ns)

    def _next_s(self, now_s: float) -> float | None:
        trigger_at_s = self._playback.trigger_at_s
        if self._due and trigger_at_s is None:
            return max(now_s, self._session.free_s())
        read_s = self._source.next_time_s()
        times = [at_s for at_s in map(next_time_s, self._fingers.values()) if at_s is not None]
        times += [at_s for at_s in (read_s, trigger_at_s) if at_s is not None]
        if not times and self._source.fileno() is None:  # a replay that has ended: let the last emission sound
            return self._playback.free_s if now_s < self._playback.free_s else None
        if not self._playback.repeating:
            times += [due_s - SPOT_LEAD_S for due_s in self._spot_due_s.values()]
        return min(times, default=NEVER)


@contextlib.contextmanager
def _signals(stop: Callable[[], None], selector: selectors.BaseSelector) -> Iterator[None]:
    """SIGINT and SIGTERM call `stop` and wake the selector."""
    woken, wakes = socket.socketpair()
    woken.setblocking(False)
    wakes.setblocking(False)
    selector.register(woken, selectors.EVENT_READ)
    old_fd = signal.set_wakeup_fd(wakes.fileno())
    old = {number: signal.signal(number, lambda *_: stop()) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in old.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(old_fd)
        selector.unregister(woken)
        woken.close()
        wakes.close()


@contextlib.contextmanager
def _collector_off() -> Iterator[None]:
    """No garbage collection while the loop runs: it makes no cycles."""
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
        gc.unfreeze()
