"""Calibration of the touch panel while its service plays: by a client of the application socket.

Axes: a finger on known targets. Touches arrive as the map in force puts them on the plate; its inverse gives the axes' own values.
Ghosts: clicks on an untouched panel, and the contacts that it reports, before the tracker rejects them. A layer of regions covers
the plate meanwhile, so that no ghost is played. Whatever a client has ends with its connection.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Sequence
from functools import partial
from itertools import groupby
from math import inf
from typing import Final, Protocol

import numpy as np

from controller.device.application_socket.client import PanelClient
from controller.device.application_socket.protocol.panel_messages import ContactNotice, Description, Emissions, Touch
from controller.device.touch.source import TouchSample
from controller.device.touch_calibration import ghost_figures
from controller.device.touch_calibration.calibration import Calibration, Point, StationaryTouches, calibrate
from controller.device.touch_calibration.ghost_figures import MIN_EMISSIONS, MIN_GHOSTS, GhostFigures, figures_of
from controller.device.touch_calibration.ghost_survey import GAP_S, MOST_EMISSIONS, SETTLED_S, STAYS_S
from controller.errors import CalibrationError

LOOK_S: Final = 0.5  # longest wait without a look around
EDGE_MM: Final = 0.01  # a touch so near to the plate's edge may have been moved there
MISSED: Final = 20  # clicks one after the other that were not played
PLAYS: Final = ("armed", "playing", "idle")
INSET: Final = 0.1  # of the plate: clicks are nearer to its middle
KNOCK: Final = "click"


class Progress(Protocol):
    """Takes note of how far a calibration is."""

    def __call__(self, step: int, of: int, words: str, at_mm: Point | None = None) -> None:
        """`step` of `of` steps are done; what is to be done now, and where."""


def running_axes(panel: PanelClient, targets: Sequence[Point], progress: Progress) -> Calibration:
    """Ask for a touch on each of the `targets` (x_mm, y_mm) in turn, and fit the map.

    Raises CalibrationError if the touches determine no map, or one lies at the plate's edge; ControllerError if the panel refuses.
    """
    about = panel.describe()
    if not panel.state().panel_present:
        raise CalibrationError("no touch panel answers: nothing can be touched")
    panel.subscribe("touches")
    held = StationaryTouches()
    touches: list[Point] = []
    for index, (x_mm, y_mm) in enumerate(targets):
        ask = f"touch {index + 1} of {len(targets)}: at x = {x_mm:.1f} mm, y = {y_mm:.1f} mm, and hold still"
        place_mm = _held_place(panel, held, partial(progress, index, len(targets), at_mm=(x_mm, y_mm)), ask)
        touches.append(axes_values(about, place_mm))
    progress(len(targets), len(targets), "all targets were touched")
    return calibrate(targets, touches, about)


def _held_place(panel: PanelClient, held: StationaryTouches, say: Callable[[str], None], ask: str) -> Point:
    """Place in mm of the next finger that is held, alone on the panel."""
    down: set[int] = set()
    say(ask)
    while True:
        touches = panel.heard(Touch, min(max(held.due_s - time.monotonic(), 0.0), LOOK_S))
        several, places = len(down) > 1, []
        for time_s, report in groupby(touches, lambda touch: touch.time_s):
            samples = [TouchSample(t.finger, t.x_mm * 1e-3, t.y_mm * 1e-3, t.time_s, t.contact) for t in report]
            for sample in samples:
                (down.add if sample.contact else down.discard)(sample.finger)
            places.append(held.take(samples, time_s))
        if not touches:
            places.append(held.take((), time.monotonic()))
        for place in filter(None, places):
            return place[0] * 1e3, place[1] * 1e3
        if several != (len(down) > 1):
            say(ask if several else f"{len(down)} fingers are on the panel: lift all of them; then {ask}")


def axes_values(about: Description, place_mm: Point) -> Point:
    """What the touch panel's axes read, 0 to 1, at a place that the map in force gives.

    Raises CalibrationError if it is at the plate's edge: where exactly it was is not known then.
    """
    x_mm, y_mm = place_mm
    if min(x_mm, about.length_mm - x_mm, y_mm, about.width_mm - y_mm) < EDGE_MM:
        raise CalibrationError(
            f"the map in force puts this touch at or beyond the plate's edge, at x = {x_mm:.1f} mm, y = {y_mm:.1f} mm:"
            " stop the service, and calibrate with `haptic-panel calibrate-touch`"
        )
    rows = np.array([about.axes.x_mm_from_axes, about.axes.y_mm_from_axes])
    found = np.linalg.solve(rows[:, :2], np.array(place_mm) - rows[:, 2])
    return float(found[0]), float(found[1])


class _Survey:
    """What was played and which contacts there were; times are the host's, CLOCK_MONOTONIC."""

    def __init__(self, panel: PanelClient) -> None:
        self.starts_s: set[float] = set()
        self.contacts: list[ghost_figures.ContactSpan] = []
        self._panel = panel
        self._down: dict[int, ghost_figures.ContactSpan] = {}

    def watch(self, until_s: float) -> None:
        """Take what the panel says until a time."""
        while (left_s := until_s - time.monotonic()) > 0:
            for emissions in self._panel.heard(Emissions, left_s):
                self.starts_s |= {focus.time_s for focus in emissions.foci}
            for touch in self._panel.heard(ContactNotice, 0.0):
                self._take(touch)

    def _take(self, touch: ContactNotice) -> None:
        if touch.contact:
            before = self._down.get(touch.finger, ghost_figures.ContactSpan(touch.time_s, inf, 0.0))
            self._down[touch.finger] = before._replace(size_m=max(before.size_m, touch.size_mm * 1e-3))
        elif touch.finger in self._down:
            self.contacts.append(self._down.pop(touch.finger)._replace(end_s=touch.time_s))

    def begin(self) -> None:
        """Count from now on; a contact that is down stays one."""
        self.starts_s.clear()
        self.contacts.clear()

    @property
    def stays(self) -> bool:
        """Whether a contact is down for longer than any ghost."""
        return time.monotonic() - min((contact.begin_s for contact in self._down.values()), default=inf) > STAYS_S

    @property
    def enough(self) -> bool:
        """Whether no more emissions are needed."""
        return len(self.starts_s) >= MIN_EMISSIONS and len(self.contacts) >= MIN_GHOSTS

    def figures(self, emission_s: float) -> GhostFigures:
        """Evaluated; see `ghost_figures.figures_of`."""
        emissions = [(start_s, start_s + emission_s) for start_s in sorted(self.starts_s)]
        return figures_of(emissions, sorted([*self.contacts, *self._down.values()]), "this measurement")


def running_ghosts(panel: PanelClient, progress: Progress) -> GhostFigures:
    """Play clicks while nobody touches the panel, and count what it reports.

    Raises CalibrationError if contacts cannot be ghosts, something else plays, or clicks are not played; ControllerError if the
    panel refuses.
    """
    about, state = panel.describe(), panel.state()
    if state.state not in PLAYS:
        raise CalibrationError(f"nothing can be played: {state.state}{', ' * bool(state.cause)}{state.cause}")
    if not state.panel_present:
        raise CalibrationError("no touch panel answers: no ghosts can be seen")
    if fixed := [region.name for region in about.regions if "always" in region.occasions]:
        raise CalibrationError(
            f"the scene plays without a finger at {fixed[0]!r}: load another scene before, with `haptic-panel client load NAME`"
        )
    panel.subscribe("contacts", "emissions")
    layer = panel.put_regions([{"name": "untouched", "shape": "plate", "effects": []}])
    if layer.refused:
        raise CalibrationError(f"the plate could not be covered: {layer.refused[0].reason}")
    survey, draw = _Survey(panel), random.Random(0)
    _knock(panel, about, draw)  # which wakes outputs that idle: their ramp makes ghosts, too
    survey.watch(time.monotonic() + SETTLED_S)
    survey.begin()
    for played in range(MOST_EMISSIONS):
        progress(played, MOST_EMISSIONS, f"hands off the panel: {played} emissions, {len(survey.contacts)} contacts")
        if survey.enough or survey.stays:
            break
        _knock(panel, about, draw)
        survey.watch(time.monotonic() + about.emission_ms * 1e-3 + draw.uniform(*GAP_S))
    survey.watch(time.monotonic() + SETTLED_S)
    return survey.figures(about.emission_ms * 1e-3)


def _knock(panel: PanelClient, about: Description, draw: random.Random) -> None:
    """Play a click at a random place that the bank has."""
    for _ in range(MISSED):
        x_mm, y_mm = (draw.uniform(INSET, 1 - INSET) * side_mm for side_mm in (about.length_mm, about.width_mm))
        answer = panel.play(KNOCK, at_mm=(x_mm, y_mm))
        if answer.outcome == "played":
            return
        if answer.outcome == "refused":
            break
    raise CalibrationError(f"a click was {answer.outcome}: {answer.reason or 'the bank has none at such places'}")
