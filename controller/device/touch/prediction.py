"""Prediction of the position of one finger: an alpha-beta filter over its reports.

Chosen by measurement (decision 0016, README): Kalman and one-euro filters are no better while fingers move, and overshoot more
when they stop. Only the velocity is taken from the filter; the prediction starts at the last reported position, so that it does
not lag behind a moving finger.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

ALPHA, BETA = 0.7, 0.4  # gains of position and velocity; best over the recordings, and flat around there
MAX_SPEED_RATIO: Final = 1.5  # of the velocity used to that of the last step: limits the overshoot when a finger stops or turns
REST_RADIUS_M: Final = 0.35e-3  # dead band: above the noise of the panels recorded (0.16 mm), far below a focus (5 mm)
REST_RADIUS_M2: Final = REST_RADIUS_M * REST_RADIUS_M
REST_REPORTS: Final = 8  # consecutive reports within the dead band of a finger at rest
MOVING_PERIODS: Final = 1.5  # since the last report; many panels do not report a finger at rest
SILENT_PERIODS: Final = 2.5
MAX_INTERVAL_S: Final = 50e-3  # since the last report, or `SILENT_PERIODS` of a slow panel: then the velocity is unknown
MAX_HORIZON_S: Final = 40e-3  # beyond it the measured errors outweigh the benefit
MAX_EXTRAPOLATION_M: Final = 20e-3
MIN_INTERVAL_S: Final = 2e-3  # no panel reports faster; reports read late may appear to


class Motion:
    """Motion of one finger. Call `report` for every report of its panel, moved or not."""

    __slots__ = (
        "_anchor_x_m",
        "_anchor_y_m",
        "_rested",
        "_vx",
        "_vy",
        "_x_m",
        "_y_m",
        "missed_m",
        "pause_s",
        "time_s",
        "vx",
        "vy",
        "x_m",
        "y_m",
    )

    def __init__(self, x_m: float, y_m: float, time_s: float) -> None:
        self.x_m = self._x_m = self._anchor_x_m = x_m  # x_m, y_m, time_s: last report
        self.y_m = self._y_m = self._anchor_y_m = y_m
        self.time_s = time_s
        # Distance of the last report from where it was predicted
        self.vx = self.vy = self.missed_m = 0.0  # velocity used for the prediction, in m/s
        self._vx = self._vy = 0.0  # m/s, of the filter
        self._rested = 0
        self.pause_s = MAX_INTERVAL_S  # after so long without a report the velocity is unknown

    def report(self, x_m: float, y_m: float, time_s: float) -> None:
        """Update with a report of position (`x_m`, `y_m`) at `time_s`."""
        step_s = time_s - self.time_s
        if step_s > self.pause_s:  # at rest, or reports were lost: when it moved is unknown
            step_s = self.pause_s
            self._vx = self._vy = 0.0
            self._x_m, self._y_m = self.x_m, self.y_m
        elif step_s < MIN_INTERVAL_S:
            step_s = MIN_INTERVAL_S
        vx, vy = self._vx, self._vy
        ahead_x_m, ahead_y_m = self._x_m + vx * step_s, self._y_m + vy * step_s
        off_x_m, off_y_m = x_m - ahead_x_m, y_m - ahead_y_m
        self._x_m, self._y_m = ahead_x_m + ALPHA * off_x_m, ahead_y_m + ALPHA * off_y_m
        self._vx = vx = vx + BETA / step_s * off_x_m
        self._vy = vy = vy + BETA / step_s * off_y_m
        step_x_m, step_y_m = x_m - self.x_m, y_m - self.y_m
        off_x_m, off_y_m = step_x_m - self.vx * step_s, step_y_m - self.vy * step_s
        self.missed_m = sqrt(off_x_m * off_x_m + off_y_m * off_y_m)
        if vx * step_x_m + vy * step_y_m <= 0:
            vx = vy = 0.0
        else:
            most = MAX_SPEED_RATIO * sqrt(step_x_m * step_x_m + step_y_m * step_y_m) / step_s
            speed = sqrt(vx * vx + vy * vy)
            if speed > most:
                vx, vy = vx * most / speed, vy * most / speed
        self.vx, self.vy = vx, vy
        self.x_m, self.y_m, self.time_s = x_m, y_m, time_s
        off_x_m, off_y_m = x_m - self._anchor_x_m, y_m - self._anchor_y_m
        if off_x_m * off_x_m + off_y_m * off_y_m <= REST_RADIUS_M2:
            self._rested += 1
            if self._rested == REST_REPORTS:
                self._anchor_x_m, self._anchor_y_m = self._x_m, self._y_m
        else:
            self._anchor_x_m, self._anchor_y_m = x_m, y_m
            self._rested = 0

    def predict(self, at_s: float, known_s: float, lag_s: float, period_s: float) -> tuple[float, float]:
        """Predict the position of the finger at a time, on the plate or beside it.

        All reports up to `known_s` have been taken: a finger without a report until then may be at rest, and is after
        `SILENT_PERIODS` of the panel's period. `lag_s` is the delay from the true position to its report.
        """
        if self._rested >= REST_REPORTS:
            return self._anchor_x_m, self._anchor_y_m
        ahead_s = at_s - self.time_s
        ahead_s = lag_s + ahead_s if ahead_s > 0.0 else lag_s
        ahead_s = ahead_s if ahead_s < MAX_HORIZON_S else MAX_HORIZON_S
        silent_s = known_s - self.time_s
        if silent_s > MOVING_PERIODS * period_s:
            ahead_s *= max(SILENT_PERIODS - silent_s / period_s, 0.0) / (SILENT_PERIODS - MOVING_PERIODS)
        ahead_m = sqrt(self.vx * self.vx + self.vy * self.vy) * ahead_s
        if ahead_m > MAX_EXTRAPOLATION_M:
            ahead_s *= MAX_EXTRAPOLATION_M / ahead_m
        return self.x_m + self.vx * ahead_s, self.y_m + self.vy * ahead_s
