"""Whether a release on trial serves, by the statuses of its service: a pure function of what was seen, one status after the other.

| seen | then |
|---|---|
| a state that serves, without trouble, for `healthy_s` on end | good |
| trouble, `GRACE_S` or more after the evaluation began | bad; before, the time on end starts again |
| no permit, no touch panel, or what the release before waited for as well | not evaluated, for as long as it lasts |
| the same for `healthy_s` on end | it stands: its starts were good, and the evaluation starts again |
| another process | the evaluation starts again; how often a trial may start is the fall-back script's |

Trouble is: no status, or an old one; another state; the FPGA lost or switched off, or this host silent; heartbeats that stand still
while the outputs are on; work for emissions that takes too long. What the release before suffered from is not held against it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Final, Protocol

from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import LatencyStatus, PanelStatus

WAITS: Final = frozenset({PanelState.NO_PERMIT, PanelState.WAITING_FOR_PANEL})
GRACE_S: Final = 30.0  # for an FPGA that is brought up; 60 s are for all, with the way back
BEATS_S: Final = 2.0  # in which heartbeats advance: they come several times in 250 ms, the longest timeout of a board
UNSEEN_S: Final = 5.0  # between two looks; of a longer time, in which the judge itself was stopped, nothing is known
LATENCY_MAX_US: Final = 6000.0  # the schedule hands over no earlier: what takes longer misses the finger
SLOWER: Final = 2.0  # than before, where that was beyond the bound already
MEDIAN_OF, P99_OF = 20, 1000  # records, from which the figure says something of the release and not of one moment
RARE: Final = 0.1  # events in the time of the evaluation, below which none is expected


class Verdict(Enum):
    """What became of a trial."""

    GOOD = "good"
    BAD = "bad"
    NOT_YET = "not evaluated yet"


@dataclass(frozen=True, slots=True)
class Rules:
    """By what a trial is evaluated."""

    release: str
    healthy_s: float  # for how long it must serve
    boot: str = ""  # of now
    before: PanelStatus | None = None  # how the release before fared when the update was asked for

    def forgiven(self, count: int) -> int:
        """How many events of a kind the trial may have, of which the release before had this many."""
        if self.before is None:
            return 0
        evaluated_s = self.healthy_s + GRACE_S
        expected = count * evaluated_s / max(self.before.uptime_s, evaluated_s)
        return 0 if expected < RARE else math.ceil(SLOWER * expected)


@dataclass(frozen=True, slots=True)
class Evaluation:
    """What is known of a trial so far."""

    verdict: Verdict = Verdict.NOT_YET
    why: str = ""  # of a bad one; of one that is not evaluated yet, what is the matter; else empty
    stands: bool = False  # it starts well, and waits for something that is not its own
    _seen_s: float | None = None
    _evaluated_s: float = 0.0  # since the evaluation began, without what was waited for
    _waited_s: float = 0.0  # the newest stretch of it
    _clean_from_s: float | None = None  # when the first status of the newest stretch without trouble was written
    _beat_s: float = 0.0  # when the first status with the newest count of heartbeats was written
    _first: PanelStatus | None = field(default=None, repr=False)  # of the process
    _last: PanelStatus | None = field(default=None, repr=False)


def judge(before: Evaluation, now_s: float, status: PanelStatus | None, rules: Rules) -> Evaluation:
    """What is known of a trial after its status was read once more.

    `before` is what was known, at first `Evaluation()`; `status` is None if there is none, or it cannot be read.
    """
    if before.verdict is not Verdict.NOT_YET:
        return before
    trouble = _why_unknown(status, now_s, rules)
    known = None if trouble else status
    if known is not None and before._first is not None and known.started_s != before._first.started_s:
        before = Evaluation(_seen_s=now_s)
    passed_s = 0.0 if before._seen_s is None else min(now_s - before._seen_s, UNSEEN_S)
    now = replace(before, _seen_s=now_s, why=trouble, stands=False)
    if known is not None:
        now = replace(now, _first=before._first or known, _last=known, _beat_s=_beat_s(before, known))
        if _waits(known, rules):
            waited_s = before._waited_s + passed_s
            stands = waited_s >= rules.healthy_s
            evaluated_s = 0.0 if stands else before._evaluated_s
            why = _in_words(known)
            return replace(now, why=why, stands=stands, _waited_s=waited_s, _evaluated_s=evaluated_s, _clean_from_s=None)
        trouble = _trouble(before._last, now, known, rules)
    now = replace(now, why=trouble, _evaluated_s=before._evaluated_s + passed_s, _waited_s=0.0)
    if trouble or known is None:
        bad = now._evaluated_s >= GRACE_S
        return replace(now, verdict=Verdict.BAD if bad else Verdict.NOT_YET, _clean_from_s=None)
    clean_from_s = known.written_s if before._clean_from_s is None else before._clean_from_s
    good = known.written_s - clean_from_s >= rules.healthy_s
    return replace(now, verdict=Verdict.GOOD if good else Verdict.NOT_YET, _clean_from_s=clean_from_s)


def _why_unknown(status: PanelStatus | None, now_s: float, rules: Rules) -> str:
    """Why a status does not tell how the trial is now; empty if it does."""
    if status is None:
        return "the service writes no status that can be read"
    if status.release != rules.release:
        return f"the service that runs is of release {status.release}"
    return status.why_old(now_s, rules.boot)


def _waits(status: PanelStatus, rules: Rules) -> bool:
    """Whether the panel waits for something that is not the trial's: others, or what the release before waited for as well."""
    as_before = rules.before is not None and not rules.before.serves and status.state is rules.before.state
    return status.state in WAITS or as_before


def _beat_s(before: Evaluation, status: PanelStatus) -> float:
    """When the newest heartbeat was first reported; while the outputs are off, none is due."""
    last = before._last
    return status.written_s if last is None or not last.outputs_on or status.heartbeats != last.heartbeats else before._beat_s


def _trouble(last: PanelStatus | None, now: Evaluation, status: PanelStatus, rules: Rules) -> str:
    """What is wrong; empty if nothing is."""
    if not status.serves:
        return _in_words(status)
    first, old = now._first, rules.before
    if first is not None and last is not None:
        for what, count in (("the FPGA was lost, or has switched off", _lost), ("this host was silent for too long", _silent)):
            more = count(status) - count(first)
            if count(status) > count(last) and more > rules.forgiven(count(old) if old else 0):
                return f"{what}, {more} times"
    if status.outputs_on and status.written_s - now._beat_s >= BEATS_S:
        return "heartbeats stand still"
    return too_slow(status, old)


class HasLatencies(Protocol):
    """The host's own work for emissions, such as a status has."""

    @property
    def upload(self) -> LatencyStatus:
        """With an upload."""

    @property
    def resident(self) -> LatencyStatus:
        """Whose waveform was resident."""


def too_slow(status: HasLatencies, old: HasLatencies | None = None) -> str:
    """Which work of the host takes longer than it may, by the state of the release before too; empty if none does."""
    for what, latency, as_before in (
        ("an upload", status.upload, old.upload if old else LatencyStatus()),
        ("a resident play", status.resident, old.resident if old else LatencyStatus()),
    ):
        took_us, share = _figure(latency)
        most_us = max(LATENCY_MAX_US, SLOWER * _figure(as_before)[0])
        if took_us > most_us:
            return f"the host's work for {what} takes {took_us * 1e-3:.1f} ms ({share}), which may be {most_us * 1e-3:.1f}"
    return ""


def _lost(status: PanelStatus) -> int:
    """Times the FPGA was lost or has switched off, but for those when the permit was taken."""
    return max(status.outages - status.outage_causes.get("NO_PERMIT", 0), 0)


def _silent(status: PanelStatus) -> int:
    """Times the FPGA switched off since this host was silent."""
    return status.host_silent


def _figure(latency: LatencyStatus) -> tuple[float, str]:
    """The figure in us that this many records allow, and its name; 0 where there are too few."""
    if latency.count >= P99_OF:
        return latency.p99_us, "99 %"
    return (latency.p50_us, "median") if latency.count >= MEDIAN_OF else (0.0, "")


def _in_words(status: PanelStatus) -> str:
    return f"{status.state.value}: {status.cause}" if status.cause else status.state.value
