"""Which contacts of a panel are fingers, and where: the one stage between the decoder and the tracker that believes less.

A position that a panel reports is a claim. Each is counted (`Counts.points`), and is exactly one of these:

- No place of a finger (`panel_places.py`). A contact that begins there waits until it is reported elsewhere. A finger that is
  reported there keeps its last place for one report, and is released by the next.
- A step that no hand makes from one report to the next (`hand_steps.py`): held back until the next report. If that lies within
  reach of the last place, the position was an outlier; if it lies near the new one, or goes on at that speed, it is believed. A
  contact that begins is no step: a second tap elsewhere is played at once. A panel that reports nothing more means what it said.
- A contact beyond the ten that are played.
- Believed: it becomes a touch sample.

A palm, by tool or by size, stays one until it is lifted, and its positions are no claims. A panel that repeats its reports while
it is touched, and falls silent, has no finger (`Plausibility.overdue`). Times are measured in the panel's own report period.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from math import inf, nan
from typing import Final

from controller.device.touch.associate import ASK, DOWN, NO_CONTACT, UNKNOWN, UP, Contact
from controller.device.touch.axes import PanelAxes
from controller.device.touch.hand_steps import goes_on, moving_s, reaches
from controller.device.touch.panel_places import PanelPlaces
from controller.device.touch.reports import PanelHabits, ReportRate
from controller.device.touch.source import Counts, TouchSample, touch_sample

MAX_PLAYED: Final = 10  # fingers that are played at once; a further one is refused until it is lifted
CONFIRMING_PERIODS: Final = 1.5  # without a report in this time, a position held back is where the finger rests


class Plausibility:
    """Contacts of one device to touch samples."""

    def __init__(
        self,
        axes: PanelAxes,  # of the device; they give the board's [touch], too
        *,
        tells_all: bool,  # whether each report lists all contacts (protocol A): then it repeats itself while the panel is touched
        counts: Counts,
        warnings: Counter[str],  # of the decoder
        after: Plausibility | None = None,  # that of the device before a reconnection, whose finger numbers are continued
    ) -> None:
        self.due_s = inf  # when to call `overdue` unless there is a report before; inf: never
        self.touched = False  # whether the last report had a contact down, and all fingers have their places
        self._next_finger: int = after._next_finger if after else 0
        self._counts = counts
        self._warnings = warnings
        self._places = PanelPlaces(axes, counts, warnings)
        self._from_axes = axes.from_axes
        self._plain = axes.plain()
        self._max_size_m = axes.settings.max_size_m
        self._played = 0
        self._habits: PanelHabits = PanelHabits(after._habits.rate if after else ReportRate(), tells_all=tells_all)
        self._number = 0  # of the last report
        self._confirm_s = inf  # when a position held back is confirmed by silence

    def report(
        self, contacts: Iterable[Contact], replaced: list[Contact], time_s: float, *, hovering: bool
    ) -> tuple[TouchSample, ...]:
        """Take a report.

        `contacts` are all that the device has, down or not; `replaced`, those that another one has replaced, is emptied. If
        `hovering`, no contact touches the panel. Returns fingers released, then fingers moved or begun.
        """
        samples: list[TouchSample] = []
        changed: list[Contact] = []
        if replaced:
            samples += [self.released(contact, time_s) for contact in replaced]
            replaced.clear()
        counts = self._counts
        down, moved = 0, False
        for contact in contacts:
            settled = contact.settled
            if (settled != DOWN or hovering) and (settled == UP or not self._touches(contact, time_s, samples, hovering=hovering)):
                continue
            down += 1
            if not contact.palm and (contact.moved or contact.finger is None or contact.held):
                moved = moved or contact.moved
                changed.append(contact)
        self._number += 1
        self._confirm_s = inf
        if down:
            counts.reports += 1
            counts.max_fingers = down if down > counts.max_fingers else counts.max_fingers
        habits = self._habits
        habits.arrived(down, time_s, moved=moved)
        for contact in changed:  # after all releases, which make room for new fingers
            self._place(contact, time_s, samples)
        confirm_s, silent_s = self._confirm_s, habits.silent_s
        self.touched = down > 0 and confirm_s == inf
        self.due_s = silent_s if silent_s < confirm_s else confirm_s
        return tuple(samples)

    def _touches(self, contact: Contact, time_s: float, samples: list[TouchSample], *, hovering: bool) -> bool:
        """Whether a contact is down; one that is not, or is a palm, has no finger any more."""
        identity = contact.identity
        known = identity >= 0 or (identity == UNKNOWN and not (contact.x is None and contact.y is None))
        if not known or hovering or contact.hovers:
            if contact.finger is not None:
                samples.append(self.released(contact, time_s))
            contact.refused = contact.palm = contact.silent = False
            contact.settled = UP if identity == NO_CONTACT or contact.hovers else ASK
            return False
        if contact.silent:
            if not contact.moved:
                return False
            contact.silent = False
            self._habits.rests = True
        if not contact.counted and identity >= 0:
            contact.counted = True
            self._counts.contacts += 1
        if not contact.palm and (contact.tool_palm or contact.width_m > self._max_size_m):
            contact.palm = True
            self._counts.palms += 1
        contact.settled = DOWN if contact.counted and not contact.palm else ASK
        if contact.palm and contact.finger is not None:
            contact.size_m = inf
            samples.append(self.released(contact, time_s))
        return True

    def overdue(self, contacts: Iterable[Contact], time_s: float) -> tuple[TouchSample, ...]:
        """Decide, as there was no report by `due_s`: a panel that repeats its reports has no finger, any other has fingers at rest.

        Returns fingers released, or confirmed where they were held back.
        """
        samples: list[TouchSample] = []
        habits = self._habits
        silent = time_s >= habits.silent_s
        for contact in contacts:
            if contact.finger is None:
                continue
            if silent:
                samples.append(self.released(contact, time_s))
                contact.silent, contact.settled = True, ASK
            elif contact.held and contact.held_x_m == contact.held_x_m:
                self._counts.confirmed += 1
                self._believe(contact, contact.held_x_m, contact.held_y_m, time_s, samples)
            elif contact.held:
                samples.append(self.released(contact, time_s))
        if silent:
            self._warnings["fallen_silent"] += len(samples)
            habits.fell_silent = True
            habits.forget()
        self._confirm_s = inf
        self.due_s = habits.silent_s
        return tuple(samples)

    def released(self, contact: Contact, time_s: float) -> TouchSample:
        """Release the finger of a `contact` at its last place; a position held back is left out."""
        finger = contact.finger
        assert finger is not None
        contact.finger = None
        contact.moved = False
        self._played -= 1
        if contact.held:
            self._leave_out(contact)
        return TouchSample(finger, contact.x_m, contact.y_m, time_s, False, contact.size_m)

    def forget(self) -> None:
        """Wait for nothing: every finger has been released."""
        self._habits.forget()
        self._confirm_s = self.due_s = inf

    def _place(self, contact: Contact, time_s: float, samples: list[TouchSample]) -> None:
        """Append the sample of a contact that has moved, begun or been held back, if it is believed."""
        x, y = contact.x, contact.y
        if x is None or y is None or contact.refused:
            return
        counts = self._counts
        counts.points += 1
        contact.moved = False
        x_low, x_high, y_low, y_high = self._plain
        if x_low <= x <= x_high and y_low <= y <= y_high:
            x_by_x, x_by_y, x_at_0, y_by_x, y_by_y, y_at_0 = self._from_axes
            x_m = x_by_x * x + x_by_y * y + x_at_0
            y_m = y_by_x * x + y_by_y * y + y_at_0
        else:
            place = self._places.place_m(x, y)
            if place is None:
                if contact.held:
                    samples.append(self.released(contact, time_s))
                elif contact.finger is not None:
                    self._hold(contact, nan, nan, time_s)
                return
            x_m, y_m = place
        if contact.finger is None:
            self._begin(contact, x_m, y_m, time_s, samples)
            return
        off_x_m, off_y_m = x_m - contact.x_m, y_m - contact.y_m
        habits, held = self._habits, contact.held
        before_s, period_s = habits.before_s, habits.rate.period_s
        step_s = moving_s(time_s - contact.held_s, period_s, lost=2) if held else moving_s(time_s - before_s, period_s)
        if reaches(contact, off_x_m, off_y_m, step_s, rested=contact.stepped != (held or self._number) - 1):
            if held:
                self._leave_out(contact)
        elif held and goes_on(contact, x_m, y_m, time_s, before_s, period_s):
            counts.confirmed += 1
            step_s = moving_s(time_s - before_s, period_s)
            off_x_m, off_y_m = x_m - contact.held_x_m, y_m - contact.held_y_m
        else:
            if held:
                self._leave_out(contact, more=True)
            counts.held += 1
            self._hold(contact, x_m, y_m, time_s)
            return
        counts.believed += 1
        contact.step_vx, contact.step_vy = off_x_m / step_s, off_y_m / step_s
        self._believe(contact, x_m, y_m, time_s, samples)

    def _begin(self, contact: Contact, x_m: float, y_m: float, time_s: float, samples: list[TouchSample]) -> None:
        """Begin a finger where a contact is, unless as many as are played are down."""
        if self._played == MAX_PLAYED:
            self._warnings["more_than_played"] += 1
            contact.refused = True
            return
        contact.finger = self._next_finger
        self._next_finger += 1
        self._played += 1
        self._counts.believed += 1
        contact.step_vx = contact.step_vy = nan
        self._believe(contact, x_m, y_m, time_s, samples)

    def _believe(self, contact: Contact, x_m: float, y_m: float, time_s: float, samples: list[TouchSample]) -> None:
        """Append a sample of a finger at this place."""
        contact.held = 0
        contact.stepped = self._number
        contact.x_m, contact.y_m = x_m, y_m
        contact.size_m = size_m = contact.width_m
        finger = contact.finger
        assert finger is not None
        samples.append(touch_sample((finger, x_m, y_m, time_s, True, size_m)))

    def _hold(self, contact: Contact, x_m: float, y_m: float, time_s: float) -> None:
        """Hold a position back until the next report; NaN: it is no place of a finger."""
        if not contact.held:
            contact.held = self._number
            contact.held_s = self._habits.before_s
        contact.held_x_m, contact.held_y_m = x_m, y_m
        self._confirm_s = time_s + CONFIRMING_PERIODS * self._habits.rate.period_s

    def _leave_out(self, contact: Contact, *, more: bool = False) -> None:
        """Leave out the position of a contact that was held back; `more`: another one is held back in its place."""
        if contact.held_x_m == contact.held_x_m:
            self._warnings["too_fast"] += 1
        if not more:
            contact.held = 0
