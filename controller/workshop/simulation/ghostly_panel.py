"""A simulated capacitive panel into which emissions couple, as an event driver for `LiveSource`.

It scans at a fixed rate. A scan during which a channel pin changed produces a ghost with a given probability: at a random place
away from real fingers, from that scan's report on, for a few reports.
"""

import random
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import count

from controller.device.board.board import Board
from controller.device.touch import event_codes as ev
from controller.device.touch.event_codes import Protocol
from controller.device.touch.event_reader import AxisInfo, DeviceDescription, Event
from controller.workshop.gateware.simulated_link import SimulatedLink
from controller.workshop.gateware.wired_fpgas import SimulatedFpgas

Place = tuple[float, float]  # mm on the plate
Finger = tuple[float, float, Place | Callable[[float], Place]]  # begin and end in s; place, or place at a time

PERIOD_S = 7e-3
UNITS_PER_MM = 10
SEPARATION_MM = 12.0  # of ghosts from fingers: nearer, a panel reports no contact of its own
SLOTS = 64


@dataclass(frozen=True)
class Ghosts:
    """How ghosts come and go."""

    probability: float  # probability of a ghost in a disturbed scan
    lives: tuple[int, int]  # fewest and most reports of a ghost, uniformly distributed
    size_mm: float = 0.0  # contact size of ghosts; 0: the panel reports no sizes
    seed: int = 0  # seed of the random ghosts


class GhostlyPanel:
    """An `EventReader` of simulated fingers and ghosts."""

    def __init__(
        self,
        board: Board,  # gives the plate, which the panel covers exactly
        fingers: Sequence[Finger],  # each (begin_s, end_s, place): real fingers; the place in mm is constant or a function of time
        disturbed: Callable[[float], bool],  # called at each scan with its time; returns whether a pin changed since the last call
        ghosts: Ghosts,
        *,
        period_s: float = PERIOD_S,  # scan period; each scan is reported at once
        protocol: Protocol = Protocol.B,  # multi-touch protocol of the events
        from_s: float = 0.0,  # from_s, until_s: between which it scans
        until_s: float = 10.0,
    ) -> None:
        plate = board.plate
        self._sides_mm = plate.length_mm, plate.width_mm
        self.warnings: Counter[str] = Counter()
        self.present = True
        axes = {code: AxisInfo(0, round(UNITS_PER_MM * side)) for code, side in zip(ev.POSITIONS, self._sides_mm, strict=True)}
        if protocol is Protocol.B:
            axes |= {ev.ABS_MT_SLOT: AxisInfo(0, SLOTS - 1), ev.ABS_MT_TRACKING_ID: AxisInfo(0, 65535)}
        if ghosts.size_mm:
            axes[ev.ABS_MT_TOUCH_MAJOR] = AxisInfo(0, round(UNITS_PER_MM * max(self._sides_mm)))
        self.description = DeviceDescription("simulated panel with ghosts", axes=axes)
        self._numbers = protocol is Protocol.B
        self.ghosts = 0  # number of ghosts so far
        self._random = random.Random(ghosts.seed)
        self._fingers = fingers
        self._disturbed = disturbed
        self._settings = ghosts
        self._period_s = period_s
        self._size = round(UNITS_PER_MM * ghosts.size_mm)
        self._until_s = until_s
        self._scan = int(from_s / period_s) + 1
        self._alive: dict[str, tuple[Place, int]] = {}  # ghosts: place, and reports left
        self._slots: dict[str, int] = {}  # by contact
        self._reported: dict[str, Place] = {}
        self._ids = count()

    def fileno(self) -> None:
        """None: there is no file to wait on, only `next_time_s`."""
        return

    def close(self) -> None:
        """End the scans."""
        self._until_s = -1.0

    def next_time_s(self) -> float | None:
        """Time of the next scan; None after the last."""
        at_s = self._scan * self._period_s
        return at_s if at_s <= self._until_s else None

    def read(self, now_s: float) -> Sequence[Event]:
        """Events of the next scan if it is due at `now_s`: changes only in protocol B, all contacts in protocol A."""
        at_s = self.next_time_s()
        if at_s is None or at_s > now_s:
            return ()
        self._scan += 1
        there = finger_places(self._fingers, at_s)
        if self._disturbed(at_s) and self._random.random() < self._settings.probability:
            self._haunt(list(there.values()))
        there |= {name: place for name, (place, _) in self._alive.items()}
        self._alive = {name: (place, left - 1) for name, (place, left) in self._alive.items() if left > 1}
        return self._report(there, at_s)

    def _haunt(self, fingers: list[Place]) -> None:
        length_mm, width_mm = self._sides_mm
        while True:
            x_mm, y_mm = self._random.uniform(0, length_mm), self._random.uniform(0, width_mm)
            if all(abs(x_mm - x) > SEPARATION_MM or abs(y_mm - y) > SEPARATION_MM for x, y in fingers):
                break
        self._alive[f"ghost {self.ghosts}"] = (x_mm, y_mm), self._random.randint(*self._settings.lives)
        self.ghosts += 1

    def _report(self, there: dict[str, Place], at_s: float) -> Sequence[Event]:
        """Events as the kernel reports them; in protocol B only those of contacts that changed."""
        events: list[tuple[int, int, int]] = []
        if not self._numbers:
            for place in there.values():
                events += [*self._where(place), (ev.EV_SYN, ev.SYN_MT_REPORT, 0)]
            if self._reported and not there:
                events.append((ev.EV_SYN, ev.SYN_MT_REPORT, 0))
        else:
            for name in [name for name in self._slots if name not in there]:
                events += [(ev.EV_ABS, ev.ABS_MT_SLOT, self._slots.pop(name)), (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, -1)]
            for name, place in there.items():
                if self._reported.get(name) == place:
                    continue
                if name not in self._slots:
                    self._slots[name] = min(set(range(SLOTS)) - set(self._slots.values()))
                    events += [(ev.EV_ABS, ev.ABS_MT_SLOT, self._slots[name]), (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, next(self._ids))]
                events += [(ev.EV_ABS, ev.ABS_MT_SLOT, self._slots[name]), *self._where(place)]
        self._reported = there
        if not events:
            return ()
        return [(*event, at_s) for event in (*events, (ev.EV_SYN, ev.SYN_REPORT, 0))]

    def _where(self, place: Place) -> list[tuple[int, int, int]]:
        sized = [(ev.EV_ABS, ev.ABS_MT_TOUCH_MAJOR, self._size)] if self._size else []
        x_mm, y_mm = place
        return [
            (ev.EV_ABS, ev.ABS_MT_POSITION_X, round(UNITS_PER_MM * x_mm)),
            (ev.EV_ABS, ev.ABS_MT_POSITION_Y, round(UNITS_PER_MM * y_mm)),
            *sized,
        ]


def finger_places(fingers: Sequence[Finger], at_s: float) -> dict[str, Place]:
    """Where each finger is that is down at a time, by its name."""
    down = [(f"finger {k}", place) for k, (begin_s, end_s, place) in enumerate(fingers) if begin_s <= at_s < end_s]
    return {name: _at(place, at_s) for name, place in down}


def pins_of(link: SimulatedLink | SimulatedFpgas) -> Callable[[float], bool]:
    """Return the `disturbed` of a panel in front of this link's gateware.

    Captures of the link are consumed. It says whether a channel pin changed between the last call and a time in s.
    """
    ahead: list[int] = []  # changes later than that time: the link computes a frame's whole time on the wire at once

    def moved(at_s: float) -> bool:
        tick = link.tick(at_s)
        link.gateware.advance(max(tick, link.gateware.now))
        ticks = [*ahead, *(tick for capture in link.take_captures() for tick in capture.ticks.tolist())]
        ahead[:] = [later for later in ticks if later > tick]
        return len(ahead) < len(ticks)

    return moved


def _at(place: Place | Callable[[float], Place], at_s: float) -> Place:
    return place(at_s) if callable(place) else place
