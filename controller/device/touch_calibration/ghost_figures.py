"""Statistics of ghost touches: how often emissions cause them on an untouched panel, how long, how large; `ghost_ms` from these.

Each contact is assigned to the last emission before its first report. A contact that cannot be a ghost (present before the
first emission, long after an emission, or staying) is a finger, water or another fault: then the measurement is refused.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, inf
from statistics import median
from typing import NamedTuple

from controller.device.board.board import Board
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch_calibration.event_capture import EV_SND, SND_CLICK
from controller.errors import CalibrationError

MIN_EMISSIONS = 200  # without a ghost among them, less than 1.5 % of emissions cause one, at 95 % confidence
MIN_GHOSTS = 60  # of fewer, the longest seen says little about the longest possible
MAX_GHOST_LIFE_S = 0.15  # after the end of an emission: a contact that begins or ends later is no ghost of it
MARGIN_MS = 5.0  # beyond the longest life seen of at least MIN_GHOSTS ghosts
MARGIN_FEW_MS = 20.0  # of fewer
RULE_OF_THREE = 3.0  # none among n: below 3 / n at 95 %


class ContactSpan(NamedTuple):
    """One contact that a panel has reported."""

    begin_s: float
    end_s: float  # inf: it was still down at the end
    size_m: float


@dataclass(frozen=True, slots=True)
class GhostFigures:
    """Statistics of a measurement."""

    emissions: int  # emissions, ghosts: emissions played; contacts that they caused
    ghosts: int
    rate: float  # share of emissions that caused at least one ghost, 0 to 1
    # From the emission's start to the ghost's first report: earliest and latest; None without any ghost
    appears_ms: tuple[float, float] | None
    # From the emission's end to the ghost's release: median, 95th percentile and longest; None without any ghost
    gone_ms: tuple[float, float, float] | None
    size_mm: tuple[float, float] | None  # median and largest; None if the panel reports no sizes

    @property
    def rate_below(self) -> float | None:
        """Upper bound of the rate, 0 to 1, at 95 % confidence, if no ghost was seen; else None."""
        return None if self.ghosts else RULE_OF_THREE / self.emissions

    @property
    def margin_ms(self) -> float:
        """Margin of `ghost_ms` above the longest life seen, in ms."""
        return MARGIN_MS if self.ghosts >= MIN_GHOSTS else MARGIN_FEW_MS

    @property
    def ghost_ms(self) -> float:
        """Value for board.toml, in ms; 0 without any ghost."""
        return 0.0 if self.gone_ms is None else float(ceil(self.gone_ms[2] + self.margin_ms))


def ghost_figures(recording: Recording, board: Board) -> GhostFigures:
    """Evaluate a recording of emissions on an untouched panel.

    The recording has emissions among its events (`event_capture.emission_event`). Raises CalibrationError if there are too few
    emissions, or contacts that cannot be ghosts.
    """
    emissions = [(at_s, at_s + us * 1e-6) for kind, code, us, at_s in recording.events if (kind, code) == (EV_SND, SND_CLICK)]
    if not emissions:
        raise CalibrationError(f"{recording.name} has no emissions in it: make one with calibrate-touch --ghosts --out FILE")
    return figures_of(emissions, _contacts(recording, board), recording.name)


def figures_of(emissions: Sequence[tuple[float, float]], contacts: Sequence[ContactSpan], name: str) -> GhostFigures:
    """Evaluate emissions, at least one, on an untouched panel: start and end of each in s, in order.

    `contacts` are all that the panel reported meanwhile, in order; messages name the measurement. Raises CalibrationError if there
    are too few emissions, or contacts that cannot be ghosts.
    """
    if any(later - end_s < MAX_GHOST_LIFE_S for (_, end_s), (later, _) in pairwise(emissions)):
        raise CalibrationError(f"{name}: emissions less than {MAX_GHOST_LIFE_S:g} s apart: ghosts have no certain cause")
    contacts = [contact for contact in contacts if contact.end_s > emissions[0][0]]
    of = _emissions_of(contacts, emissions)
    if len(emissions) < MIN_EMISSIONS:
        raise CalibrationError(f"only {len(emissions)} emissions: {MIN_EMISSIONS} are needed to judge")
    if not contacts:
        return GhostFigures(len(emissions), 0, 0.0, None, None, None)
    appears_ms = [(contact.begin_s - emissions[number][0]) * 1e3 for contact, number in zip(contacts, of, strict=True)]
    gone_ms = sorted([(contact.end_s - emissions[number][1]) * 1e3 for contact, number in zip(contacts, of, strict=True)])
    sizes_mm = [contact.size_m * 1e3 for contact in contacts if contact.size_m > 0]
    return GhostFigures(
        len(emissions),
        len(contacts),
        len(set(of)) / len(emissions),
        (min(appears_ms), max(appears_ms)),
        (median(gone_ms), gone_ms[min(int(0.95 * len(gone_ms)), len(gone_ms) - 1)], gone_ms[-1]),
        (median(sizes_mm), max(sizes_mm)) if sizes_mm else None,
    )


def _contacts(recording: Recording, board: Board) -> list[ContactSpan]:
    source = RecordingSource(recording, recording.axes(board), 0.0)
    down: dict[int, ContactSpan] = {}
    found: list[ContactSpan] = []
    while (at_s := source.next_time_s()) is not None:
        samples = source.read(at_s)
        ending = source.next_time_s() is None  # then it releases what is still down
        for sample in samples:
            if sample.contact:
                before = down.get(sample.finger, ContactSpan(sample.time_s, inf, 0.0))
                down[sample.finger] = before._replace(size_m=max(before.size_m, sample.size_m))
            elif sample.finger in down:
                found.append(down.pop(sample.finger)._replace(end_s=inf if ending else sample.time_s))
    return sorted(found + list(down.values()))


def _emissions_of(contacts: Sequence[ContactSpan], emissions: Sequence[tuple[float, float]]) -> list[int]:
    """Index of the emission that caused each contact; refuses contacts that none can have caused."""
    starts_s = [start_s for start_s, _ in emissions]
    of = [bisect_right(starts_s, contact.begin_s) - 1 for contact in contacts]
    strays = [number for number, contact in zip(of, contacts, strict=True) if _stray(number, contact, emissions)]
    if strays:
        raise CalibrationError(
            f"{len(strays)} of {len(contacts)} contacts are no ghosts: they began before the first emission, or began or"
            f" ended more than {MAX_GHOST_LIFE_S * 1e3:g} ms after one: keep hands, water and metal off the panel and do it again"
        )
    return of


def _stray(number: int, contact: ContactSpan, emissions: Sequence[tuple[float, float]]) -> bool:
    return number < 0 or max(contact.begin_s, contact.end_s) - emissions[number][1] > MAX_GHOST_LIFE_S
