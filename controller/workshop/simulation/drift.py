"""A simulated plate whose frequencies drift with its temperature, and what its temperature sensor says of it.

    time_s,drift_percent,sensor_c
    0,0.0,23.0
    10,0.4,
    20,0.5,20.5

Warm glass is softer: all frequencies are lower by the same share. Between rows the drift goes in a straight line; the sensor keeps
what its row says, and fails where the row says nothing. Without the third column it says the temperature that the drift means.
"""

from __future__ import annotations

import csv
import errno
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from controller.arrays import Floats
from controller.device.board.devices import Temperature
from controller.device.fpga.capture import Capture
from controller.errors import ConfigError
from controller.text_file import read_text

LEVEL: Final = 2e-4  # of the drifts that are simulated: half of it costs 2e-4 of the amplitude
FORGOTTEN: Final = 16.0  # decay times after which the plate has forgotten
MOST: Final = 0.05
ASSUMED: Final = Temperature(kind="hwmon", device="the simulated sensor", coefficient_per_k=-2e-4, period_s=0.5)
COLUMNS: Final = ("time_s", "drift_percent", "sensor_c")


@dataclass(frozen=True, eq=False)
class Drift:
    """Relative change of all frequencies of a plate over the time of a recording."""

    time_s: Floats  # (row,): rising; before the first row and after the last the drift stays
    drift: Floats  # (row,): relative: 0.005 is 0.5 % higher
    # (row,): what the sensor says from `time_s` on, in °C, NaN where it fails; None: the temperature that the drift means
    sensor_c: Floats | None = None

    @classmethod
    def constant(cls, percent: float) -> Drift:
        """The same drift all the time; raises ConfigError if it is more than a plate can have."""
        return cls(np.zeros(1), np.array([_checked(percent, "--drift-percent") / 100]))

    @classmethod
    def read(cls, file: Path) -> Drift:
        """Drift from a CSV file; raises ConfigError, naming file and line."""
        try:
            rows = list(csv.reader(read_text(file).splitlines()))
        except (OSError, ValueError, csv.Error) as error:
            raise ConfigError(f"{file}: cannot be read as CSV: {error}") from None
        head = [cell.strip() for cell in rows[0]] if rows else []
        if tuple(head) not in (COLUMNS, COLUMNS[:2]):
            raise ConfigError(f"{file}: line 1: the columns are time_s,drift_percent and, if the sensor differs, sensor_c")
        values: list[list[float]] = []
        for number, row in enumerate(rows[1:], 2):
            if not any(cell.strip() for cell in row):
                continue
            where = f"{file}: line {number}"
            if len(row) != len(head):
                raise ConfigError(f"{where}: {len(row)} values, not {len(head)}")
            cells = [_number(cell, where, name) for cell, name in zip(row, head, strict=True)]
            if not math.isfinite(cells[0]) or (values and cells[0] <= values[-1][0]):
                raise ConfigError(f"{where}: time_s = {cells[0]:g} is not after the line before")
            _checked(cells[1], f"{where}: drift_percent")
            values.append(cells)
        if not values:
            raise ConfigError(f"{file}: has no values")
        table = np.array(values)
        return cls(table[:, 0], table[:, 1] / 100, table[:, 2] if len(head) > 2 else None)

    def at(self, time_s: float) -> float:
        """Drift at a time of the recording."""
        return float(np.interp(time_s, self.time_s, self.drift))

    def level(self, time_s: float) -> float:
        """The same, rounded to the drifts that are simulated; exact if the drift never changes."""
        return float(self.drift[0]) if np.ptp(self.drift) == 0 else round(self.at(time_s) / LEVEL) * LEVEL

    def sensor(self, settings: Temperature, recording_s: Callable[[], float]) -> DriftingSensor:
        """The plate's temperature sensor; `recording_s` says the recording's time."""
        return DriftingSensor(self, settings, recording_s)


class DriftingSensor:
    """`Sensor` of a simulated plate."""

    def __init__(self, drift: Drift, settings: Temperature, recording_s: Callable[[], float]) -> None:
        self._drift = drift
        self._settings = settings
        self._recording_s = recording_s

    def read_c(self) -> float:
        """Temperature in °C now; raises OSError where the drift's file says that the sensor fails."""
        drift, settings, now_s = self._drift, self._settings, self._recording_s()
        if drift.sensor_c is None:
            coefficient = settings.coefficient_per_k
            return settings.reference_c + (drift.at(now_s) / coefficient if coefficient else 0.0)
        row = max(int(np.searchsorted(drift.time_s, now_s, side="right")) - 1, 0)
        said_c = float(drift.sensor_c[row])
        if math.isnan(said_c):
            raise OSError(errno.EIO, "it fails")
        return said_c

    def close(self) -> None:
        """Nothing is open."""


def since(capture: Capture, tick: int) -> Capture:
    """The pin changes from `tick` on, which begin with the levels of that moment, and the foci after it."""
    first = int(np.searchsorted(capture.ticks, tick, side="right"))
    begin = max(first - 1, 0)
    ticks = capture.ticks[begin:].copy()
    if first:
        ticks[0] = tick
    return Capture(ticks, capture.words[begin:], capture.hv[begin:], capture.focus_ticks[capture.focus_ticks > tick])


def _number(cell: str, where: str, name: str) -> float:
    if name == "sensor_c" and not cell.strip():
        return math.nan
    try:
        return float(cell)
    except ValueError:
        raise ConfigError(f"{where}: {name} = {cell.strip()!r} is not a number") from None


def _checked(percent: float, where: str) -> float:
    if not abs(percent) <= 100 * MOST:  # NaN too
        raise ConfigError(f"{where} = {percent:g}: must be a number from {-100 * MOST:g} to {100 * MOST:g}")
    return percent
