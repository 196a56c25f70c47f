"""Emissions, and what one finger or command has under way: its region, its trains, how far it has gone."""

from __future__ import annotations

import math
from typing import NamedTuple

from controller.scene.scene import OUTSIDE, Scene, Spot
from controller.scene.spacings import Lines, Way
from controller.scene.trains import NO_BEAT, Running

NOWHERE = (math.inf, 0.0)
COMMAND = -1  # whose effect a train is: of no region


class Emission(NamedTuple):
    """One focus to be played: where and when it is due, for whom, how strong.

    Attributes
    ----------
    region : str
        Whose effect it is; of a command the effect's name.
    amplitude : float
        0.25 to 1.
    owner : int or str
        A newer emission of the same owner replaces one that waits: finger, region of the spot, or command.
    ticket : int
        Of a command, on its first emission only; else 0.
    beat, period_s : int, float
        The beat-th emission, from 0, of a train with this period; period 0: on its own.
    alternate : bool
        To be played alone, in turn with others, not composed with them.
    """

    time_s: float
    x_m: float
    y_m: float
    finger: int | None
    region: str
    amplitude: float = 1.0
    owner: int | str = ""
    ticket: int = 0
    beat: int = 0
    period_s: float = 0.0
    alternate: bool = False


def spot_emission(spot: Spot, start_s: float, beat: int) -> Emission:
    """The beat-th emission of a spot that plays since `start_s`."""
    period_s = 1 / spot.rate_hz
    return Emission(
        start_s + (beat + spot.phase) * period_s,
        spot.x_m,
        spot.y_m,
        None,
        spot.region,
        spot.amplitude,
        spot.region,
        0,
        beat,
        period_s,
        spot.alternate,
    )


class FingerState:
    """What the scene knows of one finger between samples, or of a command at a point; for the scene that made it.

    Attributes
    ----------
    region : int
        Index in the scene, or OUTSIDE.
    next_s : float
        When the next beat of a train is due; inf: none is under way.
    """

    __slots__ = ("_progress", "_running", "finger", "next_s", "owner", "region", "x_m", "y_m")

    def __init__(self, finger: int | None, x_m: float, y_m: float, region: int = OUTSIDE, owner: int | str = "") -> None:
        self.finger = finger
        self.x_m = x_m
        self.y_m = y_m
        self.region = region
        self.owner = owner if finger is None else finger
        self.next_s = math.inf
        self._running: list[Running] = []
        self._progress: tuple[Way | Lines, ...] = ()

    def add(self, running: Running) -> None:
        """One more train is under way."""
        self._running.append(running)
        self.next_s = min(self.next_s, running.next_s)

    def come_into(self, scene: Scene, region: int) -> None:
        """The finger is in another region: what was bound to the one before ends, ways and lines begin anew."""
        self.region = region
        spacings = scene.areas[region].spacings if region != OUTSIDE else ()
        self._progress = tuple([spacing.begin(self.x_m, self.y_m) for spacing in spacings])
        if self._running:
            self._keep([running for running in self._running if not running.bound])

    def anchor(self, first_s: float, start_s: float) -> None:
        """Trains whose first beat was due at a time go on from when it really began."""
        for running in self._running:
            if running.first_s == first_s:
                running.first_s = start_s
        self._keep(self._running)

    @property
    def unfelt(self) -> tuple[tuple[int, float], ...]:
        """Commands of which nothing was felt yet: ticket, and when it was given."""
        return tuple([(running.ticket, running.first_s - running.train.first_s) for running in self._running if running.ticket])

    def end_all(self) -> None:
        """All trains end; ways and lines stay as they are."""
        self._keep([])

    def keep_commands(self) -> None:
        """Trains of regions end."""
        self._keep([running for running in self._running if running.area == COMMAND])

    def moved(self) -> float:
        """Largest amplitude of the ways and lines that the finger's new place completes; 0: none."""
        amplitude = 0.0
        for progress in self._progress:
            if progress.crossed(self.x_m, self.y_m) and progress.amplitude > amplitude:
                amplitude = progress.amplitude
        return amplitude

    def next_crossing(self, x: float, y: float) -> tuple[float, float]:
        """Way in m to the next emission of a way or a line, and its amplitude, for a finger that moves along a unit vector."""
        return min(
            [(progress.to_go_m(self.x_m, self.y_m, x, y), progress.amplitude) for progress in self._progress], default=NOWHERE
        )

    def take(self, scene: Scene, until_s: float) -> tuple[Emission, ...]:
        """Emissions due up to a time, of each train the last, in order of time."""
        emissions: list[Emission] = []
        for running in self._running:
            emission = self.beat(scene, running, until_s)
            if emission is not None:
                emissions.append(emission)
        self._keep([running for running in self._running if not running.over])
        if len(emissions) > 1:
            emissions.sort(key=_time_s)
        return tuple(emissions)

    def beat(self, scene: Scene, running: Running, until_s: float) -> Emission | None:
        """Last beat of one train that is due up to a time and not silent."""
        beat, amplitude = running.take(until_s)
        if beat == NO_BEAT:
            return None
        name, alternate = running.effect, False
        if running.area != COMMAND:
            area = scene.areas[running.area]
            name, alternate = area.name, area.alternate
        period_s, ticket = running.train.period_s, running.ticket
        running.ticket = 0
        time_s = running.first_s + beat * period_s
        return Emission(time_s, self.x_m, self.y_m, self.finger, name, amplitude, self.owner, ticket, beat, period_s, alternate)

    def _keep(self, running: list[Running]) -> None:
        self._running = running
        self.next_s = min([train.next_s for train in running], default=math.inf)


def _time_s(emission: Emission) -> float:
    return emission.time_s
