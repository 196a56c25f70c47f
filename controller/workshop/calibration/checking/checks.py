"""What is wrong with a measurement, named by channel and point: dead, swapped, inverted channels; clipped, noisy records."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from controller.arrays import Bools, Floats
from controller.errors import CalibrationError
from controller.workshop.calibration.checking.wiring import Wiring
from controller.workshop.calibration.transfer_functions.direct_wave import DirectWaves

FatalKind = Literal["dead", "swapped", "inverted", "clipped", "strength", "unit", "mass"]
Kind = FatalKind | Literal["missing", "noisy", "delay", "clock", "board", "short", "band", "frame", "undecided", "load"]
FATAL: tuple[Kind, ...] = get_args(FatalKind)  # what makes a bank wrong, unless it is accepted

DEAD_POWER = 1e-2  # of the median channel
DEAD_COHERENCE = 0.2
NOISY_COHERENCE = 0.5
STRENGTHS = (0.1, 10.0)  # of all channels, on what board.toml foresees: beyond, a unit is wrong
SHOWN = 12  # names in a message


@dataclass(frozen=True)
class Objection:
    """One thing that is wrong or worth knowing."""

    kind: Kind
    message: str  # says what, where, and what to do
    channels: tuple[int, ...] = ()  # channels, points: which; empty: all of them, or none in particular
    points: tuple[str, ...] = ()


def raise_fatal(where: str, findings: Iterable[Objection], accepted: Iterable[str]) -> None:
    """Refuse a measurement that would make a wrong bank.

    Raises CalibrationError with all findings that are `FATAL` and not `accepted`, in one line.
    """
    fatal = [finding for finding in findings if finding.kind in FATAL and finding.kind not in set(accepted)]
    if fatal:
        kinds = " ".join(f"--accept {kind}" for kind in dict.fromkeys(finding.kind for finding in fatal))
        raise CalibrationError(f"{where}: {'; '.join(finding.message for finding in fatal)} (to go on all the same: {kinds})")


def listed(names: Sequence[object]) -> str:
    """Names in words, the first of many."""
    shown = [str(name) for name in names[:SHOWN]]
    if len(names) > SHOWN:
        return f"{', '.join(shown)} and {len(names) - SHOWN} more"
    return " and ".join([", ".join(shown[:-1]), shown[-1]]) if len(shown) > 1 else "".join(shown)


def dead_channels(power: Floats, coherence: Floats, channels: Sequence[int], driven: Bools) -> list[Objection]:
    """Channels of which nothing arrives anywhere.

    `power` (point, 32) is that of the responses, noise taken off, NaN where not resolved; `coherence` is as large. `channels` are
    those with an actuator, `driven` (32,) those that were ever driven.
    """
    never = [channel for channel in channels if np.isnan(power[:, channel]).all()]
    others = [channel for channel in channels if channel not in never]
    found = []
    if undriven := [channel for channel in never if not driven[channel]]:
        found.append(Objection("dead", f"{_channels(undriven)} never driven, and with an actuator in board.toml", tuple(undriven)))
    if lost := [channel for channel in never if driven[channel]]:
        found.append(Objection("dead", f"no sound record tells of {_channels(lost, '')}", tuple(lost)))
    if not others:
        return found
    level = np.nanmedian(power[:, others], axis=0)
    quiet = [channel for channel, own in zip(others, level, strict=True) if own <= DEAD_POWER * np.median(level)]
    incoherent = [channel for channel in others if np.nanmedian(_or(coherence[:, channel], 1.0)) < DEAD_COHERENCE]
    if dead := sorted({*quiet, *incoherent}):
        shares = [f"{np.sqrt(max(np.nanmedian(power[:, channel]) / (np.median(level) or 1.0), 0)):.1%}" for channel in dead]
        text = f"{_channels(dead)} dead: {listed(shares)} of the others' response; check wire, patch and driver stage"
        found.append(Objection("dead", text, tuple(dead)))
    return found


def wrong_wires(wiring: Wiring, alive: Sequence[int]) -> list[Objection]:
    """Channels that drive the patch of another one, or the other way round; and those that are undecided."""
    found = []
    for names in wiring.swapped:
        way = "swapped" if len(names) == 2 else "in the wrong order"
        text = f"channels {listed(names)} look {way}: each drives another's patch; mend the wiring, or actuators in board.toml"
        found.append(Objection("swapped", text, names))
    if wiring.all_inverted:
        text = "all channels look inverted: the sensor's sign, or moment_n_per_v; foci would dip"
        found.append(Objection("inverted", text, tuple(alive)))
    if off := wiring.inverted:
        text = f"{_channels(off, 'look')} inverted against the others: turn the patch's wires round"
        found.append(Objection("inverted", text, off))
    if unknown := wiring.undecided:
        which = f"all {len(unknown)} channels" if len(unknown) == len(alive) else _channels(unknown, "")
        more = wiring.points_needed - wiring.points
        text = (
            f"undecided: {which}: measured points ({wiring.points}) do not tell which patch such a channel drives, nor its sign;"
            f" measure about {more} more, 30 mm and more from the edges; places that are off by more than 12 mm hide it too"
        )
        found.append(Objection("undecided", text, unknown))
    return found


def wrong_strength(waves: DirectWaves, alive: Sequence[int]) -> list[Objection]:
    """All responses far from what board.toml foresees: a unit."""
    scale = float(np.nanmedian(abs(np.diag(waves.strength)[list(alive)]))) if alive else np.nan
    if STRENGTHS[0] <= scale <= STRENGTHS[1] or np.isnan(scale):
        return []
    text = f"responses are {scale:.3g} times what board.toml foresees: a wrong unit, sensitivity, full_scale or supply_v?"
    return [Objection("strength", text)]


def clipped_records(counts: dict[str, int]) -> list[Objection]:
    """Points whose records stand at the end of the converter's range; those are left out.

    `counts` is the number of such records by the name of a point.
    """
    if not counts:
        return []
    text = f"clipped, and left out: {sum(counts.values())} records of point {listed(list(counts))}; turn the recorder's gain down"
    return [Objection("clipped", text, points=tuple(counts))]


def noisy_records(coherence: Floats, known: Bools, names: Sequence[str]) -> list[Objection]:
    """Points where some channel's record is mostly noise."""
    bad = known & (_or(coherence, 1.0) < NOISY_COHERENCE)
    points = np.flatnonzero(bad.any(axis=1)).tolist()
    if not points:
        return []
    reported = [f"{names[point]} (channel {listed(np.flatnonzero(bad[point]).tolist())})" for point in points]
    return [
        Objection(
            "noisy",
            f"mostly noise, left unknown: point {listed(reported)}",
            tuple(np.flatnonzero(bad.any(axis=0)).tolist()),
            tuple(names[point] for point in points),
        )
    ]


def _or(values: Floats, otherwise: float) -> Floats:
    return np.where(np.isnan(values), otherwise, values)


def _channels(numbers: Sequence[int], verb: str = "be") -> str:
    one = len(numbers) == 1
    word = {"be": (" is", " are"), "look": (" looks", " look"), "": ("", "")}[verb][not one]
    return f"channel{'' if one else 's'} {listed(numbers)}{word}"
