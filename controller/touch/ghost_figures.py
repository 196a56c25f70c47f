"""What emissions do to a panel that nobody touches: how often they make ghosts, for how long, how large; and the `ghost_ms` for it.

Each contact belongs to the last emission before its first report. What cannot be a ghost of an emission (a contact that was there
before, came out of silence or stays) is a finger, water, or a panel with another fault: then nothing follows, and it is refused.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, inf
from statistics import median
from typing import NamedTuple

from controller.board.board import Board
from controller.errors import CalibrationError
from controller.touch.event_capture import EV_SND, SND_CLICK
from controller.touch.recording import Recording
from controller.touch.replay import RecordingSource

FEWEST_EMISSIONS = 200  # without a ghost among so many they are made by less than 1.5 % of emissions, at 95 %
FEWEST_GHOSTS = 60  # of fewer the longest seen says little of the longest there is
LONGEST_S = 0.15  # after the end of an emission: a contact that comes or goes later is no ghost of it
MARGIN_MS = 5.0  # beyond the longest life seen of at least FEWEST_GHOSTS ghosts
MARGIN_OF_FEW_MS = 20.0  # of fewer
RULE_OF_THREE = 3.0  # none among n: below 3 / n at 95 %


class _Contact(NamedTuple):
    begin_s: float
    end_s: float  # inf: it was still down at the end
    size_m: float


@dataclass(frozen=True, slots=True)
class GhostFigures:
    """What was found.

    Attributes
    ----------
    emissions, ghosts : int
        Played; contacts that they made.
    rate : float
        Share of emissions that made one or more.
    appears_ms : (float, float) or None
        First report after the emission's start: earliest and latest; None without any ghost.
    gone_ms : (float, float, float) or None
        The report that it is gone, after the emission's end: median, 95th percentile and longest.
    size_mm : (float, float) or None
        Median and largest; None where the panel tells no sizes.
    """

    emissions: int
    ghosts: int
    rate: float
    appears_ms: tuple[float, float] | None
    gone_ms: tuple[float, float, float] | None
    size_mm: tuple[float, float] | None

    @property
    def rate_below(self) -> float | None:
        """Where no ghost was seen: what their rate is below, at 95 %."""
        return None if self.ghosts else RULE_OF_THREE / self.emissions

    @property
    def margin_ms(self) -> float:
        """What `ghost_ms` is above the longest life seen."""
        return MARGIN_MS if self.ghosts >= FEWEST_GHOSTS else MARGIN_OF_FEW_MS

    @property
    def ghost_ms(self) -> float:
        """For board.toml; 0 where no ghosts are."""
        return 0.0 if self.gone_ms is None else float(ceil(self.gone_ms[2] + self.margin_ms))


def ghost_figures(recording: Recording, board: Board) -> GhostFigures:
    """Judge a recording in which emissions were played and nobody touched the panel.

    Parameters
    ----------
    recording : Recording
        With emissions among its events (`kept_events.emission_event`).
    board : Board
        Where the panel's axes lie.

    Raises
    ------
    CalibrationError
        If there are too few emissions, or contacts that cannot be their ghosts.
    """
    emissions = [(at_s, at_s + us * 1e-6) for kind, code, us, at_s in recording.events if (kind, code) == (EV_SND, SND_CLICK)]
    if not emissions:
        raise CalibrationError(f"{recording.name} has no emissions in it: make one with calibrate-touch --ghosts --out FILE")
    if any(later - end_s < LONGEST_S for (_, end_s), (later, _) in pairwise(emissions)):
        raise CalibrationError(f"{recording.name}: emissions less than {LONGEST_S:g} s apart: whose a ghost is cannot be told")
    contacts = [contact for contact in _contacts(recording, board) if contact.end_s > emissions[0][0]]
    of = _emissions_of(contacts, emissions)
    if len(emissions) < FEWEST_EMISSIONS:
        raise CalibrationError(f"only {len(emissions)} emissions: {FEWEST_EMISSIONS} are needed to judge")
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


def _contacts(recording: Recording, board: Board) -> list[_Contact]:
    source = RecordingSource(recording, recording.axes(board), 0.0)
    down: dict[int, _Contact] = {}
    found: list[_Contact] = []
    while (at_s := source.next_time_s()) is not None:
        samples = source.read(at_s)
        ending = source.next_time_s() is None  # then it releases what is still down
        for sample in samples:
            if sample.contact:
                before = down.get(sample.finger, _Contact(sample.time_s, inf, 0.0))
                down[sample.finger] = before._replace(size_m=max(before.size_m, sample.size_m))
            elif sample.finger in down:
                found.append(down.pop(sample.finger)._replace(end_s=inf if ending else sample.time_s))
    return sorted(found + list(down.values()))


def _emissions_of(contacts: Sequence[_Contact], emissions: Sequence[tuple[float, float]]) -> list[int]:
    """Number of the emission that each contact belongs to; refuses those that belong to none."""
    starts_s = [start_s for start_s, _ in emissions]
    of = [bisect_right(starts_s, contact.begin_s) - 1 for contact in contacts]
    strays = [number for number, contact in zip(of, contacts, strict=True) if _stray(number, contact, emissions)]
    if strays:
        raise CalibrationError(
            f"{len(strays)} of {len(contacts)} contacts are no ghosts: they came before the first emission or out of silence,"
            f" or stayed for more than {LONGEST_S * 1e3:g} ms: hands off the panel, nothing wet or metal on it, and do it again"
        )
    return of


def _stray(number: int, contact: _Contact, emissions: Sequence[tuple[float, float]]) -> bool:
    return number < 0 or max(contact.begin_s, contact.end_s) - emissions[number][1] > LONGEST_S
