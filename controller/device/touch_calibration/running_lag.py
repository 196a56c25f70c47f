"""Lag of a touch panel while its service plays: contacts from the application socket, the mouse beside them from a web page."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Final

from controller.device.application_socket.client import PanelClient
from controller.device.application_socket.protocol.panel_messages import ContactNotice
from controller.device.touch_calibration.lag_figures import SEVERAL, LagFigures, finger_track, lag_of
from controller.device.touch_calibration.page_mouse import PageMouse, StandardInput
from controller.device.touch_calibration.running import Progress
from controller.errors import CalibrationError

SECONDS: Final = 20.0
WAIT_S: Final = 60.0  # for finger and mouse to move
LOOK_S: Final = 0.05
ASK: Final = "hold the mouse to the finger, and slide both 5 cm to and fro over the panel, twice a second"


@dataclass(frozen=True, slots=True)
class RunningLag:
    """A lag, and how far the mouse's times may be off, besides what its figures say."""

    figures: LagFigures
    clock_error_ms: float


def running_lag(panel: PanelClient, said: StandardInput, progress: Progress, seconds: float) -> RunningLag:
    """Follow finger and mouse for some seconds, from when both have moved.

    Raises CalibrationError if they say nothing, or the page's clock is not known well enough; ControllerError if the panel refuses.
    """
    if not panel.state().panel_present:
        raise CalibrationError("no touch panel answers: nothing can be touched")
    panel.subscribe("contacts")
    mouse = PageMouse()
    reports: list[tuple[float, float, float]] = []
    down: set[int] = set()
    begun_s, given_up_s, shown = None, time.monotonic() + WAIT_S, 0
    progress(0, round(seconds), ASK)
    while begun_s is None or time.monotonic() < begun_s + seconds:
        for touch in panel.heard(ContactNotice, LOOK_S):
            (down.add if touch.contact else down.discard)(touch.finger)
            if len(down) > 1:
                raise CalibrationError(SEVERAL)
            if touch.contact:
                reports.append((touch.time_s, touch.x_mm * 1e-3, touch.y_mm * 1e-3))
        for message in said.read():
            mouse.take(message)
        now_s = time.monotonic()
        if begun_s is not None and now_s - begun_s > shown + 1:
            shown += 1
            progress(shown, round(seconds), ASK)
        elif begun_s is None and reports and mouse.moved:
            begun_s = now_s
        elif begun_s is None and now_s > given_up_s:
            missing = "no mouse moved over the page" if reports else "no finger touched the panel"
            raise CalibrationError(f"{missing} within {WAIT_S:g} s")
    track, error_s = mouse.track()
    both = [report for report in reports if track.at_s[0] <= report[0] <= track.at_s[-1]]
    return RunningLag(lag_of(finger_track(both), track), error_s * 1e3)
