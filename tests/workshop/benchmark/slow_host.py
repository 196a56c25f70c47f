"""A host of known slowness under the event loop: its own time is drawn from a log-normal distribution, seeded.

Each frame takes `KERNEL_S` in the kernel besides its bits, in which the wire is idle. Everything else is as in a simulated run:
the model of the gateware, in virtual time.
"""

from __future__ import annotations

import math
import random
import tempfile
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from controller.clocks import VirtualClock
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.board.devices import LinkSettings
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.frames import UPLOAD_BYTES
from controller.device.loop.context import LoopContext
from controller.device.loop.playing.host_timing import HostTiming
from controller.device.loop.playing.records import Played
from controller.device.loop.wiring import Assembly, assemble
from controller.device.scene.scene import Scene, load_scene
from controller.device.service.drivers import gateware_hash, open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch.source import TouchSample
from controller.metrics import Counters
from controller.workshop.gateware.gateware import Gateware
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.simulated_link import SimulatedLink

P99_OF_P50 = 4.0
SIGMA = math.log(P99_OF_P50) / 2.3263  # of the logarithm
KERNEL_S = 40e-6  # a frame, besides its bits
SHORT_SHARE = 0.35  # host time of a message without an upload, of that of an upload
REPORT_SHARE = 0.33  # host time of a touch report
REPORT_S, SPEED_M_S = 8e-3, 0.2  # of moving fingers
SETTLE_S = 50e-3  # from the end of the ramp to the first report
LATE_S = 1e-6  # a pulse that starts later than this after its time is late
TRAIN = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "train", rate_hz = 50.0, duration_ms = 3.6e6 }]\n'
AXES = "A: 2f 0 9 0 0 0\nA: 35 0 2100 0 0 0\nA: 36 0 1480 0 0 0\nA: 39 0 65535 0 0 0\n"  # tenths of a millimetre on the plate


class HostTime:
    """Random host time: log-normal, seeded."""

    def __init__(self, p50_s: float, seed: int) -> None:
        self._mu = math.log(p50_s) if p50_s else -math.inf
        self._random = random.Random(seed)

    def draw_s(self) -> float:
        """Host time of one upload, in s."""
        return math.exp(self._random.gauss(self._mu, SIGMA)) if self._mu > -math.inf else 0.0


class HostClock(VirtualClock):
    """Virtual time that passes also while the host works."""

    def spend(self, duration_s: float) -> None:
        """The host works for this long."""
        self._now_s += duration_s

    def wait_until(self, until_s: float) -> None:
        """The host is blocked until then."""
        self._now_s = max(self._now_s, until_s)


class SlowLink(SimulatedLink):
    """SPI of a slow host: its work before each message, 40 µs a frame in the kernel; a message blocks until its last bit."""

    clock: HostClock
    host: HostTime | None = None  # None: the host takes no time

    def __init__(self, settings: LinkSettings, now_s: Callable[[], float], gateware: Gateware) -> None:
        super().__init__(settings, now_s, gateware)
        self.ends_s: list[float] = []  # of the last bit of each message

    def exchange(self, sent: memoryview, lengths: Sequence[int], received: memoryview) -> None:
        """Work, then send frames and wait for them."""
        if self.host is None:
            super().exchange(sent, lengths, received)
            self.ends_s.append(self.time_s(self._bus.free_tick))
            return
        self.clock.spend(self.host.draw_s() * (1.0 if sum(lengths) >= UPLOAD_BYTES else SHORT_SHARE))
        self._pause_ticks = round(KERNEL_S / 2 * self.clock_hz)  # before and after each frame's bits
        super().exchange(sent, lengths, received)
        self.ends_s.append(self.time_s(self._bus.free_tick))
        self.clock.wait_until(self.wire_free_s())


class SlowSource(RecordingSource):
    """A recording whose reports take host time to be read."""

    clock: HostClock
    host: HostTime | None = None

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of the next report, after the work for it."""
        samples = super().read(now_s)
        if samples and self.host is not None:
            self.clock.spend(REPORT_SHARE * self.host.draw_s())
        return samples


@dataclass(frozen=True)
class Pulses:
    """What became of the pulses of a run."""

    # For each pulse: whether it started later than due; for the first one of a train, whether it reached the FPGA later than
    # promised
    late: list[bool]
    off_s: list[float]  # for each pulse but the first of its train, how much later than due it started
    spacing_error_s: list[float]  # difference of each two following pulses' distance from the train's period
    held_s: list[float]  # for each pulse that was late and started by the host: from the arrival of its command to its start
    counters: Counters  # counters, timing: of the loop
    timing: HostTiming
    emissions_hz: float  # emissions a second, from the first to the last


def run_slow(board: Board, scene: Scene, bank: Bank, recording: Recording, p50_s: float, seed: int = 1) -> Pulses:
    """Replay a recording through the event loop on a slow host.

    `p50_s` is the median host time of an upload, 0: the host takes no time; `seed` is that of the host times. The rest is as in
    `simulation.simulated_run.play`.
    """
    clock = HostClock()
    link = SlowLink(board.link, clock.now_s, GatewareModel(BuildParameters.of(board, gateware_hash())))
    link.clock = clock
    session = open_session(link, board, clock.now_s)
    source = SlowSource(recording, recording.axes(board), session.earliest_trigger_s() + board.limits.arming_s + SETTLE_S)
    source.clock = clock
    if p50_s:
        link.host, source.host = HostTime(p50_s, seed), HostTime(p50_s, seed + 1000)
    played: list[Played] = []
    assembly = assemble(LoopContext(board, clock, session, tracked(source, board)), scene, bank, played=played.append)
    assembly.loop.run()
    link.close()
    starts = link.take_capture().focus_ticks.astype(np.int64) - board.waveform.samples * board.bit_ticks
    return _pulses(assembly, played, (starts / board.link.clock_hz).tolist(), link.ends_s)


def _pulses(assembly: Assembly, played: Sequence[Played], starts_s: Sequence[float], ends_s: Sequence[float]) -> Pulses:
    late: list[bool] = []
    off, spacing, held = [], [], []
    before: dict[int | str, tuple[int, float]] = {}
    for one, start_s in zip(played, starts_s, strict=True):
        for emission in one.emissions:
            if not emission.period_s:
                continue
            if emission.pulse:
                off.append(start_s - float(emission.time_s))
                late.append(off[-1] > LATE_S)
                pulse, was_s = before.get(emission.owner, (0, math.nan))
                if emission.pulse == pulse + 1:
                    spacing.append(abs(start_s - was_s - emission.period_s))
                if late[-1] and one.at_ticks is None:
                    held.append(start_s - ends_s[bisect_right(ends_s, start_s) - 1])
            else:
                late.append(one.at_ticks is None)
            before[emission.owner] = emission.pulse, start_s
    emissions_hz = (len(starts_s) - 1) / (starts_s[-1] - starts_s[0]) if len(starts_s) > 1 else 0.0
    return Pulses(late, off, spacing, held, assembly.counters, assembly.timing, emissions_hz)


def moving(duration_s: float, fingers: int = 1, speed_m_s: float = SPEED_M_S, report_s: float = REPORT_S) -> Recording:
    """Recording of fingers that slide to and fro along x, put down 13 ms after each other."""
    events: list[tuple[float, int, list[str]]] = []
    for slot in range(fingers):
        from_s = slot * 13e-3
        for k in range(round(duration_s / report_s)):
            way_mm = (k * report_s * speed_m_s * 1e3) % 300
            x_mm, y_mm = 30 + (way_mm if way_mm < 150 else 300 - way_mm), 45 + 60 * slot
            began = [f"0039 {slot}"] if k == 0 else []
            events.append((from_s + k * report_s, slot, [*began, f"0035 {round(10 * x_mm)}", f"0036 {round(10 * y_mm)}"]))
        events.append((from_s + duration_s, slot, ["0039 -1"]))
    lines = [AXES]
    for time_s, slot, what in sorted(events):
        lines += [f"E: {time_s:.6f} 0003 {one}\n" for one in (f"002f {slot}", *what)] + [f"E: {time_s:.6f} 0000 0000 0000\n"]
    return Recording("".join(lines))


def scene_of(board: Board, text: str) -> Scene:
    """Scene of a text in TOML."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.toml"
        file.write_text(text)
        return load_scene(file, board)
