"""Synthetic recording of a finger and a mouse that move together, from a panel of known latency and a mouse."""

from dataclasses import dataclass

import numpy as np

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.touch import event_codes as ev
from controller.device.touch.event_reader import AxisInfo, DeviceDescription, Event
from controller.device.touch_calibration.event_capture import EV_REL, REL_X, REL_Y, recording_text

UNITS_PER_MM = 20
FINE_S = 0.25e-3  # steps of the finger's path


@dataclass(frozen=True)
class SimulatedStrokes:
    """Strokes with which the measurement of latency is tested."""

    lag_s: float  # total latency of the panel's places
    smoothed_s: float = 0.0  # part of it that comes from smoothing: time constant of a first-order low-pass
    period_s: float = 8e-3  # period_s, noise_mm: report period of the panel; standard deviation of its noise
    noise_mm: float = 0.05
    mouse_period_s: float = 1e-3  # mouse_period_s, mouse_age_s: report period of the mouse; age of the place that it reports
    mouse_age_s: float = 0.5e-3
    turned_deg: float = 20.0  # angle of the mouse to the plate; it also turns by 3 degrees and slips by 1 %
    # strokes_hz, reach_mm, duration_s: rate of the strokes, their amplitude, and the length of the recording
    strokes_hz: float = 2.0
    reach_mm: float = 30.0
    duration_s: float = 20.0
    seed: int = 0  # seed of noise and phases

    def recording(self, board: Board) -> str:
        """Make a recording, as text in evemu's format, on a panel that covers the board's plate exactly."""
        random = np.random.default_rng(self.seed)
        times_s = np.arange(0.0, self.duration_s + 0.4, FINE_S)
        path_mm = self._path_mm(board, times_s, random)
        events = self._finger(times_s, self._smoothed(path_mm), random)
        lifted = events[-2:]
        events = [*events[:-2], *self._mouse(times_s, path_mm, random), *lifted]
        sides = zip(ev.POSITIONS, (board.plate.length_mm, board.plate.width_mm), strict=True)
        axes = {code: AxisInfo(0, round(UNITS_PER_MM * side_mm)) for code, side_mm in sides}
        axes |= {ev.ABS_MT_SLOT: AxisInfo(0, 9), ev.ABS_MT_TRACKING_ID: AxisInfo(0, 65535)}
        return recording_text(DeviceDescription("simulated strokes", axes=axes), events)

    def _path_mm(self, board: Board, times_s: Floats, random: np.random.Generator) -> Floats:
        """Where the finger is: (time, 2)."""
        rates_hz = self.strokes_hz * (1 + 0.3 * np.sin(2 * np.pi * 0.23 * times_s + random.uniform(0, 6)))
        phase = 2 * np.pi * np.cumsum(rates_hz) * FINE_S
        x_mm = board.plate.length_mm / 2 + self.reach_mm * np.sin(phase) * (1 + 0.2 * np.sin(0.7 * times_s))
        y_mm = board.plate.width_mm / 2 + 0.2 * self.reach_mm * np.sin(0.61 * phase + 1.0)
        return np.stack([x_mm, y_mm], axis=1)

    def _smoothed(self, path_mm: Floats) -> Floats:
        """What the panel's low-pass makes of the path."""
        found = path_mm.copy()
        if self.smoothed_s > 0:
            share = 1 - np.exp(-FINE_S / self.smoothed_s)
            for axis in (0, 1):
                now = found[0, axis]
                for k, value in enumerate(path_mm[:, axis].tolist()):
                    now += share * (value - now)
                    found[k, axis] = now
        return found

    def _finger(self, times_s: Floats, seen_mm: Floats, random: np.random.Generator) -> list[Event]:
        """Reports of the panel; the last two events lift the finger."""
        reports_s = np.arange(0.2, self.duration_s, self.period_s) + random.uniform(0, self.period_s)
        delay_s = self.lag_s - self.smoothed_s
        seen = np.stack([np.interp(reports_s - delay_s, times_s, seen_mm[:, axis]) for axis in (0, 1)], axis=1)
        seen += random.normal(0, self.noise_mm, seen.shape)
        first_s = float(reports_s[0])
        events: list[Event] = [(ev.EV_ABS, ev.ABS_MT_SLOT, 0, first_s), (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, 1, first_s)]
        for at_s, place in zip(reports_s.tolist(), np.rint(UNITS_PER_MM * seen).astype(int).tolist(), strict=True):
            events += [(ev.EV_ABS, code, value, at_s) for code, value in zip(ev.POSITIONS, place, strict=True)]
            events.append((ev.EV_SYN, ev.SYN_REPORT, 0, at_s))
        end_s = float(reports_s[-1]) + self.period_s
        return [*events, (ev.EV_ABS, ev.ABS_MT_TRACKING_ID, -1, end_s), (ev.EV_SYN, ev.SYN_REPORT, 0, end_s)]

    def _mouse(self, times_s: Floats, path_mm: Floats, random: np.random.Generator) -> list[Event]:
        """Counts of the mouse, which moves with the finger."""
        mouse_s = np.arange(0.1, self.duration_s + 0.1, self.mouse_period_s)
        angle = np.deg2rad(self.turned_deg + 3 * np.sin(0.5 * mouse_s))[1:]
        where = np.stack([np.interp(mouse_s - self.mouse_age_s, times_s, path_mm[:, axis]) for axis in (0, 1)], axis=1)
        step = np.diff(where, axis=0) * (1 + random.normal(0, 0.01, (len(where) - 1, 1)))
        along, across = (
            np.cos(angle) * step[:, 0] + np.sin(angle) * step[:, 1],
            np.cos(angle) * step[:, 1] - np.sin(angle) * step[:, 0],
        )
        counts = np.cumsum(40 * np.stack([along, across], axis=1), axis=0)
        moved = np.diff(np.rint(counts), axis=0, prepend=0.0).astype(int)
        return [
            (EV_REL, code, value, at_s)
            for at_s, (dx, dy) in zip(mouse_s[1:].tolist(), moved.tolist(), strict=True)
            for code, value in ((REL_X, dx), (REL_Y, dy))
            if value
        ]
