"""What of a connected touch panel does not work as it should, logged once a kind: the service goes on, and somebody should look."""

from __future__ import annotations

import math
from typing import Final

from controller.device.touch.drivers.awaited_reader import AwaitedReader
from controller.device.touch.drivers.panel_process import PanelProcess
from controller.device.touch.reports import FAULTS, describe_warnings
from controller.log import Event, log

PERIOD_S: Final = 1.0


class TouchFaults:
    """Logs the faults of a panel; their counts are in the status file."""

    def __init__(self, panel: AwaitedReader | PanelProcess) -> None:
        self._panel = panel
        self._logged: set[str] = set()
        self._next_s = -math.inf

    def look(self, now_s: float) -> None:
        """Log what is new, at most once every `PERIOD_S` of host time."""
        if now_s < self._next_s:
            return
        self._next_s = now_s + PERIOD_S
        remark = self._panel.description.remark
        if remark and remark not in self._logged:
            self._logged.add(remark)
            log(remark, Event.TOUCH_FAULT)
        for kind, count in self._panel.warnings.items():
            if kind in FAULTS and count and kind not in self._logged:
                self._logged.add(kind)
                log("; ".join(describe_warnings({kind: count})), Event.TOUCH_FAULT)
