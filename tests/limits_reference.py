"""The limits of the stages tick by tick, written straight from what `stage_limits.v` says they are.

Slow and plain on purpose: the bench of the Verilog and the tests of the model compare with it.
"""

from collections import Counter
from dataclasses import dataclass

SHORT_PULSE, CHANNEL_EDGES, TOTAL_EDGES, LONG_EMISSION, DUTY = 1, 2, 4, 8, 16
NO_LIMITS = {
    "pulse_ticks": 0,
    "channel_edges": 2**24 - 1,
    "total_edges": 2**29 - 1,
    "emission_ticks": 2**30 - 1,
    "duty_share": 65536,
    "duty_ticks": 2**30 - 1,
}
DECIDED_TICKS = 36  # from a change to its last cause, at most


@dataclass
class Inputs:
    """What one tick brings."""

    word: int = 0
    active: bool = False
    emission: bool = False
    start: bool = False
    clear: bool = False


@dataclass
class Outputs:
    """What is to be seen in one tick."""

    cause: int
    channels: int
    duty_level: int


def part_of(tick, window_ticks):
    """Number of the part in which a tick is: 15 parts, of whole rounds of 32 ticks, are a window at least."""
    return tick // (-(-window_ticks // 480) * 32)


def counting(edges, part):
    """Edges in a part and the 15 before it."""
    return sum(edges[part - before] for before in range(16))


def limits_reference(inputs, settings, window_ticks):
    """Outputs of tick 0, 1 ... for the `Inputs` of tick 0, 1 ..., and of the 36 ticks after the last."""
    ticks = len(inputs)
    cause = [0] * (ticks + DECIDED_TICKS)
    culprits = [0] * (ticks + DECIDED_TICKS)

    word_before, last_change, recent = 0, None, set()
    uncounted = {}  # {tick: channels that changed}, until their turns
    counted = [Counter() for _ in range(32)]  # edges of each channel, by part
    moved = Counter()  # edges of all
    for t in range(ticks + DECIDED_TICKS - 3):
        channel, new = t % 32, 0
        for tick, which in uncounted.items():
            if tick <= t - 2 and channel in which:
                which.remove(channel)
                new += 1
        part = part_of(t, window_ticks)
        counted[channel][part] += new
        if new and counting(counted[channel], part) > settings["channel_edges"]:
            cause[t + 3] |= CHANNEL_EDGES
            culprits[t + 3] |= 1 << channel
        if t >= ticks:
            continue
        changed = {channel for channel in range(32) if (inputs[t].word ^ word_before) >> channel & 1}
        word_before = inputs[t].word
        if not changed:
            continue
        rested = last_change is None or t - last_change >= settings["pulse_ticks"]
        if rested:
            recent = set()
        short = changed & recent
        recent |= changed
        last_change = t
        uncounted = {tick: which for tick, which in uncounted.items() if which} | {t: changed.copy()}
        moved[part] += len(changed)
        total = counting(moved, part)
        cause[t + 2] |= SHORT_PULSE * bool(short)
        culprits[t + 2] |= sum(1 << channel for channel in short)
        cause[t + 3] |= TOTAL_EDGES * (total > settings["total_edges"])

    age = 0
    for t, now in enumerate(inputs):
        begins = t == 0 or inputs[t - 1].start or not inputs[t - 1].emission
        age = (1 if begins else age + 1) if now.emission else 0
        cause[t + 1] |= LONG_EMISSION * (age > settings["emission_ticks"])

    levels = [0]
    for t, now in enumerate(inputs):
        cause[t + 1] |= DUTY * (now.active and levels[t] > settings["duty_ticks"] << 16)
        level = levels[t] + (65536 if now.active else 0) - settings["duty_share"]
        levels.append(max(level, 0))

    channels = [0]
    for t in range(ticks):
        kept = 0 if inputs[t].clear else channels[t]
        channels.append(kept or culprits[t + 1])
    return [Outputs(cause[t], channels[t], levels[t] >> 16) for t in range(ticks)]
