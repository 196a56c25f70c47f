"""A recorder of the simulated plate: what a sensor on it and a second track hear of the pins of the simulated FPGA."""

from collections.abc import Callable
from typing import Protocol

import numpy as np

from controller.arrays import Floats
from controller.device.bank.packing import channel_bits
from controller.device.board.board import Board
from controller.device.fpga.capture import Capture, merged
from controller.workshop.physics.even_motion import EvenMotion
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.motion import PlateMotion


class CapturedPins(Protocol):
    """Of a simulated FPGA, or of several."""

    clock_hz: int

    def tick(self, time_s: float) -> int:
        """Tick at a time."""

    def take_captures(self) -> list[Capture]:
        """Changes of the pins of each FPGA since the last call."""


class SimulatedRecorder:
    """`Recorder` of a plate behind simulated pins."""

    triggered = False

    def __init__(
        self,
        real: Board,  # with the plate, patches and driver that are measured
        pins: CapturedPins,
        now_s: Callable[[], float],
        rate_hz: float,
        quantity: str,  # "m" or "m/s" or "m/s^2"
        sync_channel: int,  # that the second track hears
        noise: float = 0.0,  # standard deviation of the sensor's noise, in `quantity`
        seed: int = 1,
    ) -> None:
        self.rate_hz = rate_hz
        self.place_m = np.zeros(2)  # (2,): of the sensor
        self._motion = PlateMotion(real, modes_of(real))
        self._supply_v = real.driver.supply_v
        self._pins, self._now_s, self._quantity, self._sync = pins, now_s, quantity, sync_channel
        self._noise, self._random = noise, np.random.default_rng(seed)
        self._begun_tick = self._samples = 0
        self._heard: tuple[bytes, EvenMotion] | None = None  # of the record before, by what was played: most points play the same

    def begin(self, samples: int, _alive: Callable[[], None]) -> None:
        """Begin to record."""
        self._begun_tick, self._samples = self._pins.tick(self._now_s()), samples

    def read(self, _alive: Callable[[], None]) -> Floats:
        """(sample, 2): the sensor, and the level of the channel."""
        capture, clock_hz = merged(self._pins.take_captures()), self._pins.clock_hz
        step_s = (capture.ticks.astype(np.int64) - self._begun_tick) / clock_hz
        levels = channel_bits(np.where(capture.hv != 0, capture.words, np.uint32(0))).astype(np.float64)
        steps_v = np.diff(levels, axis=0, prepend=0 * levels[:1]) * self._supply_v
        times_s = np.arange(self._samples) / self.rate_hz
        played = step_s.tobytes() + steps_v.tobytes() + self._samples.to_bytes(8)
        if self._heard is None or self._heard[0] != played:
            even = EvenMotion(self._motion, step_s, steps_v, 1 / self.rate_hz, self._samples, self._quantity)
            self._heard = played, even
        heard = self._heard[1].of_point(self.place_m)
        sync = _averaged(step_s, levels[:, self._sync], times_s, 1 / self.rate_hz)
        return np.column_stack([heard + self._noise * self._random.standard_normal(len(heard)), sync])

    def close(self) -> None:
        """Nothing is open."""


def _averaged(step_s: Floats, levels: Floats, times_s: Floats, length_s: float) -> Floats:
    """Mean of levels, each held from its `step_s` to the next, over `length_s` round each time: what a converter leaves."""
    ends_s = np.append(step_s, max(step_s[-1], times_s[-1]) + length_s)
    summed = np.concatenate([[0.0], np.cumsum(levels * np.diff(ends_s))])
    after, before = (np.interp(times_s + side * length_s / 2, ends_s, summed) for side in (1, -1))
    averaged: Floats = (after - before) / length_s
    return averaged
