"""One focus to be played: where and when it is due, for whom, and how strong."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Final, NamedTuple

from controller.clocks import FpgaTime
from controller.device.scene.scene import FixedEmitter


class Emission(NamedTuple):
    """One focus to be played."""

    time_s: FpgaTime  # when it is due, in FPGA time
    x_m: float  # x_m, y_m: place on the plate
    y_m: float
    finger: int | None  # None: for no finger
    region: str  # name of the region whose effect it is; for a command, name of the effect
    amplitude: float = 1.0  # `MIN_AMPLITUDE` to 1
    # finger, region of the fixed emitter, or command. A newer emission of the same owner replaces one that waits
    owner: int | str = ""
    ticket: int = 0  # of a command, on its first emission only; else 0
    # pulse, period_s: the emission is number `pulse`, from 0, of a train with this period; period 0: it is a single emission
    pulse: int = 0
    period_s: float = 0.0
    alternate: bool = False  # it is to be played alone, in turn with others, not composed with them
    nulled: bool = False  # other fingers are to be kept still meanwhile
    channel: int = -1  # no focus, but the test of this channel, alone; below 0: a focus


_Fields = tuple[FpgaTime, float, float, int | None, str, float, int | str, int, int, float, bool, bool, int]
new_emission: Final[Callable[[_Fields], Emission]] = partial(tuple.__new__, Emission)
"""An `Emission` of a tuple of all its fields, at a third of the instructions: without the function that its class has for it."""


def stronger(one: Emission, other: Emission) -> Emission:
    """The stronger of two emissions for one finger at one time, with the pulse of the train that has one."""
    strong, weak = (one, other) if one.amplitude >= other.amplitude else (other, one)
    if strong.period_s == 0.0 and weak.period_s:
        strong = strong._replace(pulse=weak.pulse, period_s=weak.period_s)
    if weak.alternate or weak.nulled:
        strong = strong._replace(alternate=strong.alternate or weak.alternate, nulled=strong.nulled or weak.nulled)
    return strong


def emitter_emission(emitter: FixedEmitter, start_s: FpgaTime, pulse: int) -> Emission:
    """Emission number `pulse` of a fixed emitter that plays since `start_s`."""
    period_s = 1 / emitter.rate_hz
    return Emission(
        start_s + (pulse + emitter.phase) * period_s,
        emitter.x_m,
        emitter.y_m,
        None,
        emitter.region,
        emitter.amplitude,
        emitter.region,
        0,
        pulse,
        period_s,
        emitter.alternate,
    )
