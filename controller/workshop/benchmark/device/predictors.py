"""Predictors that are compared in `prediction_error`: none, Kalman filter, one-euro filter, and the product's alpha-beta."""

from __future__ import annotations

import math

from controller.device.touch.prediction import MAX_INTERVAL_S, MIN_INTERVAL_S, Motion


class LastReport(Motion):
    """No prediction: the place last reported."""

    def report(self, x_m: float, y_m: float, time_s: float) -> None:
        """Take a reported place; see `Motion.report`."""
        self.x_m, self.y_m, self.time_s = x_m, y_m, time_s


class Kalman(Motion):
    """Constant-velocity Kalman filter; the prediction starts at the last report."""

    NOISE_M = 0.2e-3  # of a report
    ACCELERATION = 0.1  # spectral density, m²/s³; this pair was the best of 12 tried
    STARTING_SPEED = 0.3  # m/s, before anything is known

    def __init__(self, x_m: float, y_m: float, time_s: float) -> None:
        super().__init__(x_m, y_m, time_s)
        self._place, self._both, self._velocity = self.NOISE_M**2, 0.0, self.STARTING_SPEED**2  # covariance, the same along x and y

    def report(self, x_m: float, y_m: float, time_s: float) -> None:
        """Take a reported place; see `Motion.report`."""
        step_s = _step_s(self, time_s)
        self._place += step_s * (2 * self._both + step_s * self._velocity) + self.ACCELERATION * step_s**3 / 3
        self._both += step_s * self._velocity + self.ACCELERATION * step_s**2 / 2
        self._velocity += self.ACCELERATION * step_s
        to_place, to_velocity = self._place / (self._place + self.NOISE_M**2), self._both / (self._place + self.NOISE_M**2)
        off_x_m, off_y_m = x_m - self._x_m - step_s * self.vx, y_m - self._y_m - step_s * self.vy
        self._x_m += step_s * self.vx + to_place * off_x_m
        self._y_m += step_s * self.vy + to_place * off_y_m
        self.vx += to_velocity * off_x_m
        self.vy += to_velocity * off_y_m
        self._velocity -= to_velocity * self._both
        self._both -= to_place * self._both
        self._place -= to_place * self._place
        self.x_m, self.y_m, self.time_s = x_m, y_m, time_s


class OneEuro(Motion):
    """One-euro filter (Casiez, Roussel, Vogel, CHI 2012); its place is extrapolated with its filtered derivative."""

    MIN_CUTOFF_HZ = 50.0
    BETA = 1000.0  # Hz per m/s
    DERIVATIVE_CUTOFF_HZ = 50.0  # this set was the best of 36 tried

    def report(self, x_m: float, y_m: float, time_s: float) -> None:
        """Take a reported place; see `Motion.report`."""
        step_s = _step_s(self, time_s)
        share = _share(self.DERIVATIVE_CUTOFF_HZ, step_s)
        self.vx += share * ((x_m - self._x_m) / step_s - self.vx)
        self.vy += share * ((y_m - self._y_m) / step_s - self.vy)
        share = _share(self.MIN_CUTOFF_HZ + self.BETA * math.hypot(self.vx, self.vy), step_s)
        self._x_m += share * (x_m - self._x_m)
        self._y_m += share * (y_m - self._y_m)
        self.x_m, self.y_m, self.time_s = x_m, y_m, time_s

    def predict(self, at_s: float, known_s: float, lag_s: float, period_s: float) -> tuple[float, float]:
        """Predict, starting at the filtered place; see `Motion.predict`."""
        x_m, y_m = super().predict(at_s, known_s, lag_s, period_s)
        return x_m - self.x_m + self._x_m, y_m - self.y_m + self._y_m


METHODS: dict[str, type[Motion]] = {
    "last report": LastReport,
    "Kalman": Kalman,
    "one-euro": OneEuro,
    "alpha-beta (the product)": Motion,
}


def _step_s(motion: Motion, time_s: float) -> float:
    return min(max(time_s - motion.time_s, MIN_INTERVAL_S), MAX_INTERVAL_S)


def _share(cutoff_hz: float, step_s: float) -> float:
    """Weight of a new value in a first-order low-pass filter."""
    return 1 / (1 + 1 / (2 * math.pi * cutoff_hz * step_s))
