"""What is played, and what was due and is not, collected and sent to subscribers 30 times a second."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

from controller.device.application_socket.connections.clients import Clients
from controller.device.application_socket.connections.connection import MessageTooLong
from controller.device.application_socket.protocol.panel_messages import Emissions, PlayedFocus
from controller.device.bank.expectation import Expectation
from controller.device.loop.control import PanelControl
from controller.device.loop.playing.records import ENDLESS, Plan
from controller.device.loop.rings.emission_ring import EmissionRing
from controller.device.waveforms.composition import Point
from controller.metrics import NOT_PLAYED

PERIOD_S: Final = 1 / 30
NEVER: Final = math.inf


class EmissionNotices:
    """Sends what the loop has noted, while anybody has subscribed to it.

    Nothing wakes the loop while nothing is touched, commanded or played.
    """

    def __init__(self, clients: Clients) -> None:
        self._clients = clients
        self._ring = EmissionRing()  # that of the loop, once somebody subscribes
        self._sent = 0  # starts
        self._sent_s = -NEVER
        self._skipped: tuple[int, ...] = ()
        self._stirred = False

    def stirred(self) -> None:
        """Something was touched, or a command has its outcome: what was skipped may have changed."""
        self._stirred = self._ring.wanted

    def next_s(self) -> float:
        """Host time at which to call `serve`; inf: there is nothing to send."""
        return self._sent_s + PERIOD_S if self._stirred or self._ring.count != self._sent else NEVER

    def begin(self, control: PanelControl) -> None:
        """Somebody has subscribed: what is played from now on is noted."""
        ring = control.emissions
        if not ring.wanted:
            ring.wanted, self._ring = True, ring
            self._sent, self._skipped = ring.count, self._causes(control)

    def serve(self, now_s: float, control: PanelControl, plate_c: float | None) -> None:
        """Send what has happened since, if it is time; `plate_c` is the plate's temperature, None if it is not known."""
        if now_s < self.next_s() or not self._ring.wanted:
            return
        subscribers = self._clients.subscribers("emissions")
        starts, skipped = self._ring.since(self._sent), self._causes(control)
        lost = self._ring.count - self._sent - len(starts)
        more = {cause: now - before for cause, now, before in zip(NOT_PLAYED, skipped, self._skipped, strict=True) if now != before}
        self._sent, self._sent_s, self._skipped, self._stirred = self._ring.count, now_s, skipped, False
        if not subscribers:
            self._ring.wanted = False
        elif starts or more:
            saying = _Saying(self._ring.expected, plate_c, control.fingers_down())
            foci = tuple([focus for start in starts for focus in _foci(*start, saying)])
            notice = Emissions(foci=foci, skipped=more, lost=lost)
            for client in subscribers:
                try:
                    client.put(notice)
                except MessageTooLong:  # of many foci in regions with long names, after a stall
                    client.put(Emissions(foci=(), skipped=more, lost=lost + len(starts)))
                self._clients.send(client)

    def _causes(self, control: PanelControl) -> tuple[int, ...]:
        skipped = control.skipped
        return tuple([getattr(skipped, cause) for cause in NOT_PLAYED])


class _Saying:
    """What amplitudes are to be expected now."""

    def __init__(self, expected: Expectation | None, plate_c: float | None, fingers: int) -> None:
        self._expected, self._plate_c, self._fingers = expected, plate_c, fingers

    def of(self, point: Point, foci: int, *, finger: bool) -> tuple[float, float | None, float] | None:
        """Least, expected and most in um of one of several foci, under a finger or not."""
        x_m, y_m, amplitude = point
        if self._expected is None or not self._expected.says(x_m, y_m):
            return None
        if finger:
            whole = self._expected.felt(self._plate_c, foci, max(self._fingers, foci) - 1)
        else:
            whole = self._expected.free(self._plate_c, foci)
        low_um, middle_um, high_um = whole.times(amplitude)
        return round(low_um, 3), None if middle_um is None else round(middle_um, 3), round(high_um, 3)


def _foci(start_s: float, plan: Plan, saying: _Saying) -> Iterator[PlayedFocus]:
    batch = plan.batch
    period_ms = round(batch.period_s * 1e3, 3) if batch.repetitions == ENDLESS else None
    for emission, (x_m, y_m, amplitude) in zip(batch.emissions, plan.points, strict=True):
        yield PlayedFocus(
            time_s=start_s,
            x_mm=round(x_m * 1e3, 3),
            y_mm=round(y_m * 1e3, 3),
            amplitude=round(amplitude, 3),
            of=emission.region,
            finger=emission.finger,
            period_ms=period_ms,
            expected_um=saying.of((x_m, y_m, amplitude), len(plan.points), finger=emission.finger is not None),
        )
