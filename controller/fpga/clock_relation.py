"""The FPGA's clock against the host's: offset and drift from exchanges of frames, with a bound that holds.

The status of a frame carries the FPGA's time of that frame, and the frame was on the wire at some time between two
readings of the host's clock. So every pair says: at this tick the host's clock was between `before_s` and `after_s`.
Seen from the newest pair, at which d = 0 and d counts seconds of the FPGA's nominal clock, the host's clock was

    h(d) = a + (1 + b) d + e(d),   |b| <= MOST_DRIFT,   |e(d)| <= WANDER_PER_S d^2 / 2

and all pairs together leave a convex polygon of possible (a, b): nothing is assumed about how delays are distributed.
What is stated is the middle of what the polygon allows, and half its width is the error's bound. A pair late by
milliseconds cuts nothing off and does no harm; dropping a pair only widens the bound.

The bound is as good as the two assumptions: crystals that age or warm up obey them, a host clock that NTP slews by
more does not (on Linux give CLOCK_MONOTONIC_RAW). A pair that contradicts those before starts the relation anew.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.errors import LinkError

MOST_DRIFT = 500e-6  # two crystals of 100 ppm, and slewing
WANDER_PER_S = 0.03e-6  # change of the drift: an AT cut's 0.3 ppm/K, warming by 0.1 K/s
FEWEST_PAIRS = 8
KEPT = 64  # pairs: 32 s of them; wander makes older ones uncertain by more than 15 us, a delay's spread
KEPT_EVERY_S = 0.5  # of the pairs within this time, the one with the least delay


class Pair(NamedTuple):
    """The FPGA's clock was at `ticks` when the host's was between two times."""

    before_s: float
    after_s: float
    ticks: int


class ClockRelation:
    """Host time to ticks and back; `add` a pair for each exchange, in its order.

    Parameters
    ----------
    clock_hz : float
        Nominal clock of the FPGA.

    Attributes
    ----------
    pairs : int
        Since the relation started anew.
    restarts : int
        How often the FPGA was reset, or the clocks were found to obey no line.
    """

    def __init__(self, clock_hz: float) -> None:
        self.clock_hz = clock_hz
        self.pairs = 0
        self.restarts = 0
        self._contradictions = 0  # in a row
        self._newest = Pair(0.0, 0.0, 0)
        self._kept = np.zeros(KEPT, [("before_s", "f8"), ("after_s", "f8"), ("ticks", "i8")])  # a ring
        self._count = 0  # pairs ever written to it
        self._corners = np.zeros((0, 2))  # possible (a, b): a in s from the newest pair's before_s

    @property
    def ready(self) -> bool:
        """Whether enough pairs are known to answer."""
        return self.pairs >= FEWEST_PAIRS

    def add(self, before_s: float, after_s: float, ticks: int, wire_s: float = 0.0) -> None:
        """Take in one exchange.

        Parameters
        ----------
        before_s, after_s : float
            The host's clock before and after it.
        ticks : int
            The FPGA's time in its status.
        wire_s : float
            What surely passed between that time and `after_s`: the bits of the frame at the fastest SCK there can be.

        Raises
        ------
        ValueError
            If the exchange ends before it begins.
        LinkError
            If twice in a row the clock is off by more than MOST_DRIFT: it is not `clock_hz`.
        """
        if not before_s <= after_s - wire_s:
            raise ValueError(f"an exchange from {before_s} s to {after_s} s that took at least {wire_s} s")
        before = self._newest
        self._newest = Pair(before_s, after_s - wire_s, ticks)
        reset = self.pairs > 0 and ticks < before.ticks
        self._corners = self._possible()
        if reset or not len(self._corners):
            self._contradictions += not reset
            self.restarts += 1
            self.pairs = self._count = 0
            self._corners = self._possible()
        else:
            self._contradictions = 0
        self.pairs += 1
        self._keep()
        if self._contradictions > 1:
            self._contradictions = 0
            rate = (ticks - before.ticks) / self.clock_hz / max(before_s - before.before_s, 1e-9)
            raise LinkError(
                f"the FPGA's clock runs at {rate:.4g} times the {self.clock_hz / 1e6:g} MHz it should:"
                " check link.clock_hz and the board's oscillator"
            )

    def ticks_at(self, host_s: float) -> int:
        """The FPGA's time at a time of the host, to the nearest tick.

        Raises
        ------
        LinkError
            If not `ready`.
        """
        return self._newest.ticks + round(self._nominal_s(host_s) * self.clock_hz)

    def host_s_at(self, ticks: int) -> float:
        """The host's time in s at a time of the FPGA.

        Raises
        ------
        LinkError
            If not `ready`.
        """
        low_s, high_s = self._offsets((ticks - self._newest.ticks) / self.clock_hz)
        return self._newest.before_s + (low_s + high_s) / 2

    def error_s(self, host_s: float) -> float:
        """Bound in s of the error of `ticks_at`, and of `host_s_at` for the ticks it gives.

        Raises
        ------
        LinkError
            If not `ready`.
        """
        low_s, high_s = self._offsets(self._nominal_s(host_s))
        return (high_s - low_s) / 2 * (1 + 2 * MOST_DRIFT) + 0.5 / self.clock_hz

    def drift_ppm(self) -> tuple[float, float]:
        """How much faster than nominal the FPGA's clock runs now, by the host's, and the bound of this figure's error.

        Raises
        ------
        LinkError
            If not `ready`.
        """
        self._check_ready()
        most, least = (1 / (1 + float(b)) - 1 for b in (self._corners[:, 1].min(), self._corners[:, 1].max()))
        return (most + least) / 2 * 1e6, (most - least) / 2 * 1e6

    def _offsets(self, d: float) -> tuple[float, float]:
        """Earliest and latest possible host time, from the newest pair's `before_s`, at d nominal seconds from its tick."""
        self._check_ready()
        ends = self._corners[:, 0] + d * self._corners[:, 1]
        astray = WANDER_PER_S / 2 * d**2
        return d + float(ends.min()) - astray, d + float(ends.max()) + astray

    def _nominal_s(self, host_s: float) -> float:
        """Nominal seconds from the newest pair's tick to a time of the host: inverse of the middle of `_offsets`."""
        asked = host_s - self._newest.before_s
        d = asked
        for _ in range(6):  # the middle's slope is 1 within MOST_DRIFT: each round is at least 2000 times nearer
            low_s, high_s = self._offsets(d)
            d += asked - (low_s + high_s) / 2
        return d

    def _check_ready(self) -> None:
        if not self.ready:
            raise LinkError(f"the FPGA's clock is not known yet: it takes {FEWEST_PAIRS - self.pairs} more frames")

    def _possible(self) -> NDArray[np.float64]:
        """Corners of all (a, b) that the newest pair and those kept allow, (corner, 2); none if they contradict each other."""
        newest, kept = self._newest, self._kept[: min(self._count, KEPT)]
        tick_s = 1 / self.clock_hz  # for as long a tick lasts; host clocks are rounded to less
        last = newest.after_s - newest.before_s + tick_s
        corners = np.array([(-tick_s, -MOST_DRIFT), (last, -MOST_DRIFT), (last, MOST_DRIFT), (-tick_s, MOST_DRIFT)])
        d = (kept["ticks"] - newest.ticks) / self.clock_hz
        nominal_s = newest.before_s + d
        slack_s = tick_s + WANDER_PER_S / 2 * d**2
        # a + b d is at most after - nominal + slack, at least before - nominal - slack
        sides = np.concatenate([np.stack([np.ones_like(d), d]), np.stack([-np.ones_like(d), -d])], axis=1)
        most = np.concatenate([kept["after_s"] - nominal_s + slack_s, nominal_s - kept["before_s"] + slack_s])
        while len(corners) and most.size:
            beyond = corners @ sides - most
            worst = int(np.argmax(beyond.max(axis=0)))
            if beyond[:, worst].max() <= 0:
                break
            corners = _cut(corners, beyond[:, worst])
            most[worst] = np.inf  # rounding must not cut there again
        return corners

    def _keep(self) -> None:
        """Remember the newest pair, or what delayed less within the same time."""
        newest, last = self._newest, self._kept[(self._count - 1) % KEPT]
        if self._count and last["after_s"] // KEPT_EVERY_S == newest.after_s // KEPT_EVERY_S:
            if newest.after_s - newest.before_s > last["after_s"] - last["before_s"]:
                return
            self._count -= 1
        self._kept[self._count % KEPT] = newest
        self._count += 1


def _cut(corners: NDArray[np.float64], beyond: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of a convex polygon the part not beyond a line (Sutherland and Hodgman, CACM 17, 1974)."""
    left = []
    for i, (corner, over) in enumerate(zip(corners, beyond.tolist(), strict=True)):
        was = float(beyond[i - 1])
        if (was > 0) != (over > 0):
            left.append(corners[i - 1] + was / (was - over) * (corner - corners[i - 1]))
        if over <= 0:
            left.append(corner)
    return np.array(left).reshape(-1, 2)
