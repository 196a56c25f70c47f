"""Where one finger will be: an alpha-beta filter over its reports.

Chosen by measurement (`python -m controller.benchmark.prediction_error`, README): Kalman and one-euro filters are no better where
fingers move, and need more to stop in time. The filter gives the velocity only: the prediction starts at the last
report as it is, so that a moving finger is not lagged.
"""

from __future__ import annotations

from math import hypot

ALPHA, BETA = 0.7, 0.4  # share of a report's surprise that goes into place and velocity; best over the recordings, and flat there
STOP_GAIN = 1.5  # the velocity used is at most this times that of the last step: a finger that stops or turns is not overshot
REST_M = 0.35e-3  # dead band: above the noise of the panels recorded (0.16 mm), far below a focus (5 mm)
REST_REPORTS = 8  # so many in a row within the dead band, and the finger rests
LIVELY_PERIODS, SILENT_PERIODS = 1.5, 2.5  # since a report; many panels report no finger that keeps still: silence is rest
PAUSE_S = 50e-3  # since the last report: what was known of its velocity is forgotten
LONGEST_AHEAD_S = 40e-3  # beyond, the errors measured grow faster than the use
FARTHEST_AHEAD_M = 20e-3
SHORTEST_STEP_S = 2e-3  # no panel reports faster; reports read late in a heap may say so


class Motion:
    """What is known of the way of one finger; all reports of its panel are told, moved or not.

    Attributes
    ----------
    x_m, y_m, time_s : float
        Of its last report.
    """

    __slots__ = ("_anchor_x_m", "_anchor_y_m", "_rested", "_vx", "_vy", "_x_m", "_y_m", "time_s", "vx", "vy", "x_m", "y_m")

    def __init__(self, x_m: float, y_m: float, time_s: float) -> None:
        self.x_m = self._x_m = self._anchor_x_m = x_m
        self.y_m = self._y_m = self._anchor_y_m = y_m
        self.time_s = time_s
        self.vx = self.vy = 0.0  # m/s, as used for the prediction
        self._vx = self._vy = 0.0  # m/s, of the filter
        self._rested = 0

    def report(self, x_m: float, y_m: float, time_s: float) -> None:
        """Take the place that a report gives, moved or not."""
        step_s = time_s - self.time_s
        if step_s > PAUSE_S:  # it rested, or reports were lost: it may have moved in any part of the pause
            step_s = PAUSE_S
            self._vx = self._vy = 0.0
            self._x_m, self._y_m = self.x_m, self.y_m
        elif step_s < SHORTEST_STEP_S:
            step_s = SHORTEST_STEP_S
        vx, vy = self._vx, self._vy
        ahead_x_m, ahead_y_m = self._x_m + vx * step_s, self._y_m + vy * step_s
        off_x_m, off_y_m = x_m - ahead_x_m, y_m - ahead_y_m
        self._x_m, self._y_m = ahead_x_m + ALPHA * off_x_m, ahead_y_m + ALPHA * off_y_m
        self._vx = vx = vx + BETA / step_s * off_x_m
        self._vy = vy = vy + BETA / step_s * off_y_m
        step_x_m, step_y_m = x_m - self.x_m, y_m - self.y_m
        most = STOP_GAIN * hypot(step_x_m, step_y_m) / step_s
        speed = hypot(vx, vy)
        if vx * step_x_m + vy * step_y_m <= 0:
            vx = vy = 0.0
        elif speed > most:
            vx, vy = vx * most / speed, vy * most / speed
        self.vx, self.vy = vx, vy
        self.x_m, self.y_m, self.time_s = x_m, y_m, time_s
        if hypot(x_m - self._anchor_x_m, y_m - self._anchor_y_m) <= REST_M:
            self._rested += 1
            if self._rested == REST_REPORTS:
                self._anchor_x_m, self._anchor_y_m = self._x_m, self._y_m
        else:
            self._anchor_x_m, self._anchor_y_m = x_m, y_m
            self._rested = 0

    def place(self, at_s: float, known_s: float, lag_s: float, period_s: float) -> tuple[float, float]:
        """Where the finger will be, (x_m, y_m), on the plate or beside it.

        Parameters
        ----------
        at_s : float
            In the clock of the reports.
        known_s : float
            Until when all reports have been told: silence counts up to there, however far ahead `at_s` is.
        lag_s : float
            A report tells where the finger was so long before.
        period_s : float
            Between the panel's reports: a finger without a report for `SILENT_PERIODS` of them rests.
        """
        if self._rested >= REST_REPORTS:
            return self._anchor_x_m, self._anchor_y_m
        ahead_s = min(max(at_s - self.time_s, 0.0) + lag_s, LONGEST_AHEAD_S)
        silent_s = known_s - self.time_s
        if silent_s > LIVELY_PERIODS * period_s:
            ahead_s *= max(SILENT_PERIODS - silent_s / period_s, 0.0) / (SILENT_PERIODS - LIVELY_PERIODS)
        ahead_m = hypot(self.vx, self.vy) * ahead_s
        if ahead_m > FARTHEST_AHEAD_M:
            ahead_s *= FARTHEST_AHEAD_M / ahead_m
        return self.x_m + self.vx * ahead_s, self.y_m + self.vy * ahead_s
