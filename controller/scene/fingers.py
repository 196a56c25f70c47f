"""What the panel feels like: touch samples, time and commands in, emissions with their times out.

A finger belongs to the first region of the file that contains it. On each occasion its effects begin:

- `press`, `release`: the finger is put down, or lifted, in the region. A finger that slides in was not pressed there.
- `enter`, `leave`: a finger that is down slides over the region's border.
- `move`: it goes `spacing_mm` of way inside, or crosses a fixed line. Both count from the first report inside. A
  report that completes several gives one emission (the time between has passed).
- `always`: a `Spot`, without any finger; the loop plays it.
- `command`: `start_effect`, for a finger or at a point.

A train begins at its occasion and goes where its finger goes. It ends after its last beat, when the finger is
lifted and, unless it began by `leave` or by a command, when the finger leaves the region. What one finger is to
feel at one report is one emission, of the largest amplitude.

All is pure but for `FingerState`, which belongs to its caller and is changed in place: a new one for each report
would cost as much as all the rest.
"""

from __future__ import annotations

import math

from controller.errors import ConfigError
from controller.scene.finger_state import COMMAND, Emission, FingerState
from controller.scene.scene import OUTSIDE, Scene
from controller.scene.trains import Running, Train
from controller.touch.source import TouchSample

ROUNDING_S = 1e-9


class UnknownEffect(ConfigError):
    """A command names an effect that it cannot play."""


def on_touch(scene: Scene, state: FingerState | None, sample: TouchSample) -> tuple[FingerState | None, tuple[Emission, ...]]:
    """A finger began (`state` None), moved or was released.

    Returns
    -------
    state : FingerState or None
        The same one, changed, for this finger's next sample; None once it is released.
    emissions : tuple of Emission
        Due now, at the finger's place: at most one.
    """
    finger, x_m, y_m, time_s, contact, _ = sample
    if not contact:
        if state is None or state.region == OUTSIDE:
            return None, ()
        area = scene.areas[state.region]
        return None, _one(_begin(scene, state, area.release, state.region, time_s, bound=True, best=None)) if area.release else ()
    index = scene.region_at(x_m, y_m)
    if state is None:
        state = FingerState(finger, x_m, y_m)
        if index == OUTSIDE:
            return state, ()
        state.come_into(scene, index)
        press = scene.areas[index].press
        return state, _one(_begin(scene, state, press, index, time_s, bound=True, best=None)) if press else ()
    state.x_m, state.y_m = x_m, y_m
    if index == state.region:
        amplitude = state.moved()
        if not amplitude:
            return state, ()
        area = scene.areas[index]
        return state, (Emission(time_s, x_m, y_m, finger, area.name, amplitude, finger, alternate=area.alternate),)
    left, emission = state.region, None
    state.come_into(scene, index)
    if left != OUTSIDE:
        emission = _begin(scene, state, scene.areas[left].leave, left, time_s, bound=False, best=None)
    if index != OUTSIDE:
        emission = _begin(scene, state, scene.areas[index].enter, index, time_s, bound=True, best=emission)
    return state, _one(emission)


def next_time_s(state: FingerState) -> float | None:
    """When `on_time` has something to do for a finger or command; None: not before its next sample."""
    return None if state.next_s == math.inf else state.next_s


def on_time(scene: Scene, state: FingerState, until_s: float) -> tuple[FingerState, tuple[Emission, ...]]:
    """Time comes to `until_s`: the beats of trains that are due up to then, in order of time.

    Of several missed beats of one train the last is given, with its own time: the others cannot be played any
    more, and the train keeps its beat.
    """
    if state.next_s > until_s:
        return state, ()
    return state, state.take(scene, until_s)


def start_effect(
    scene: Scene,
    state: FingerState | None,
    name: str,
    *,
    x_m: float,
    y_m: float,
    finger: int | None,
    amplitude: float,
    time_s: float,
    ticket: int,
) -> tuple[FingerState, tuple[Emission, ...]]:
    """A command plays an effect: for a finger, whose state is given, or at a point, which gets a state of its own.

    Parameters
    ----------
    amplitude : float
        0.25 to 1, times the effect's own; what comes below 0.25 is played at 0.25.
    ticket : int
        Given back on the first emission.

    Raises
    ------
    UnknownEffect
        If there is no effect of this name, or it is one that only a moving finger or a spot has.
    """
    train = scene.effects.get(name)
    if train is None:
        raise UnknownEffect(f"no effect {name!r} that a command can play; there are: {', '.join(sorted(scene.effects))}")
    if state is None:
        state = FingerState(finger, x_m, y_m, owner=f"command {ticket}")
    state.add(Running(train, time_s, COMMAND, bound=False, share=amplitude, effect=name, ticket=ticket))
    return on_time(scene, state, time_s)


def ended(state: FingerState) -> bool:
    """Whether no train is under way any more: a command's state may go then."""
    return state.next_s == math.inf


def anchored(state: FingerState, first: Emission, start_s: float) -> FingerState:
    """The trains that began with an emission keep their spacing from when it began to play, not from when it was due.

    Parameters
    ----------
    first : Emission
        With beat 0 of a train.
    """
    state.anchor(first.time_s, start_s)
    return state


def stopped(state: FingerState) -> FingerState:
    """The outputs went off: all trains are over. The finger is where it was, and feels its next move."""
    state.end_all()
    return state


def taken_over(scene: Scene, state: FingerState) -> FingerState:
    """State of a finger that is down while another scene takes over: trains of regions end, those of commands go on."""
    state.keep_commands()
    state.come_into(scene, scene.region_at(state.x_m, state.y_m) if state.finger is not None else OUTSIDE)
    return state


def _begin(
    scene: Scene, state: FingerState, trains: tuple[Train, ...], area: int, time_s: float, *, bound: bool, best: Emission | None
) -> Emission | None:
    """Trains of a region begin; the strongest of what is due at once, and of what was found before."""
    for train in trains:
        running = Running(train, time_s, area, bound=bound)
        first = state.beat(scene, running, time_s)
        if not running.over:
            state.add(running)
        if first is not None:
            best = first if best is None else _together(best, first)
    return best


def _together(one: Emission, other: Emission) -> Emission:
    """What two effects want of one finger at once: the stronger, in the beat of the train that has one."""
    strong, weak = (one, other) if one.amplitude >= other.amplitude else (other, one)
    if strong.period_s == 0.0 and weak.period_s:
        strong = strong._replace(beat=weak.beat, period_s=weak.period_s)
    return strong._replace(alternate=True) if weak.alternate else strong


def _one(emission: Emission | None) -> tuple[Emission, ...]:
    return () if emission is None else (emission,)
