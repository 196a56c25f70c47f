"""Steps of a mouse as a web page has them, with times of its clock, which messages there and back compare with ours."""

from __future__ import annotations

import os
from typing import Final

import msgspec
import numpy as np

from controller.device.page.mouse_steps import ArrivedSteps
from controller.device.touch_calibration.clock_offset import ClockOffset
from controller.device.touch_calibration.lag_figures import TimedPlaces
from controller.errors import CalibrationError

STDIN: Final = 0
READ_BYTES: Final = 1 << 16
MAX_CLOCK_ERROR_S: Final = 2e-3
MAX_AGE_S: Final = 1.0  # of a step that arrives: more is no time of the page's clock


class PageMouse:
    """Takes such messages."""

    def __init__(self) -> None:
        self._clock = ClockOffset()
        self._steps: list[tuple[float, float, float]] = []
        self._youngest_ms, self._oldest_ms = np.inf, -np.inf

    @property
    def moved(self) -> bool:
        """Whether there were steps."""
        return bool(self._steps)

    def take(self, message: ArrivedSteps) -> None:
        """Take a message."""
        self._clock.heard(message.sent_ms * 1e-3, message.arrived_s)
        if message.answered is not None:
            self._clock.answered(message.answered[0], message.answered[1] * 1e-3)
        self._steps += message.steps
        for at_ms, _, _ in message.steps:
            age_ms = message.sent_ms - at_ms
            self._youngest_ms, self._oldest_ms = min(self._youngest_ms, age_ms), max(self._oldest_ms, age_ms)

    def track(self) -> tuple[TimedPlaces, float]:
        """When the mouse was where, by our clock, and how far off these times may be.

        Raises CalibrationError if the clocks cannot be compared well enough, or the steps' times are of no such clock.
        """
        error_s = self._clock.error_s
        if not -1e-6 <= error_s <= MAX_CLOCK_ERROR_S:
            raise CalibrationError(
                f"the page's clock is known within {error_s * 1e3:.1f} ms only, {MAX_CLOCK_ERROR_S * 1e3:g} ms are needed:"
                " close what keeps the browser busy, and do it again"
            )
        if self._youngest_ms < 0 or self._oldest_ms > MAX_AGE_S * 1e3:
            raise CalibrationError("the browser's times of the mouse are not of the clock of its page: take another browser")
        steps = np.array(sorted(self._steps)).reshape(-1, 3)
        at_s, index = np.unique(steps[:, 0] * 1e-3 + self._clock.offset_s, return_index=True)
        counts = np.cumsum(steps[:, 1:], axis=0)
        last = np.append(index[1:], len(steps)) - 1  # of the steps of one time
        return TimedPlaces(at_s, counts[last]), max(error_s, 0.0)


class StandardInput:
    """Lines of JSON with such messages, read without waiting."""

    def __init__(self) -> None:
        self._rest = b""
        self._decoder = msgspec.json.Decoder(ArrivedSteps)
        os.set_blocking(STDIN, False)

    def read(self) -> list[ArrivedSteps]:
        """What has come; raises CalibrationError if nothing will come any more, or it is no such message."""
        try:
            more = os.read(STDIN, READ_BYTES)
        except BlockingIOError:
            return []
        if not more:
            raise CalibrationError("nothing is said of the mouse any more: the page is gone")
        *lines, self._rest = (self._rest + more).split(b"\n")
        try:
            return [self._decoder.decode(line) for line in lines]
        except msgspec.DecodeError as error:
            raise CalibrationError(f"standard input: {error}; it takes what the page's bridge writes") from error
