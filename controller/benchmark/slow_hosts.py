"""Trains of beats on hosts of known slowness: how many come late, by how much, and what else the schedule costs.

`python -m controller.benchmark.slow_hosts` plays 50 Hz trains under moving fingers, and a recording, on the model of the gateware,
in virtual time. The host's own time is drawn from a log-normal distribution whose 99th percentile is four times its median; each
frame takes 40 µs in the kernel besides its bits, in which the wire is idle. Seeded: every run gives the same figures.
"""

from __future__ import annotations

import argparse
import json
import math
import random
import sys
import tempfile
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from controller.bank.reader import Bank
from controller.bank_builder.build import build_bank
from controller.board.board import Board, load_board
from controller.board.devices import LinkSettings
from controller.board.lookup import find_board
from controller.clocks import VirtualClock
from controller.fpga.build_parameters import BuildParameters
from controller.fpga.frames import UPLOAD_BYTES
from controller.gateware_model.gateware import Gateware
from controller.gateware_model.model import GatewareModel
from controller.gateware_model.simulated_link import SimulatedLink
from controller.loop.host_timing import HostTiming
from controller.loop.records import Played
from controller.loop.wiring import Assembly, assemble
from controller.metrics import Counters
from controller.scene.scene import Scene, load_scene
from controller.service.drivers import gateware_hash, open_session, tracked
from controller.touch.prediction import Motion
from controller.touch.recording import Recording
from controller.touch.replay import RecordingSource
from controller.touch.source import TouchSample

HOSTS_US = (140.0, 220.0, 400.0, 550.0, 1300.0)  # median host time of an upload
P99_OF_P50 = 4.0
SIGMA = math.log(P99_OF_P50) / 2.3263  # of the logarithm
KERNEL_S = 40e-6  # a frame, besides its bits
SHORT_SHARE = 0.35  # host time of a message without an upload, of that of an upload
REPORT_SHARE = 0.33  # host time of a touch report
REPORT_S, SPEED_M_S = 8e-3, 0.2  # of moving fingers
FAST_REPORT_S, FAST_M_S = 2e-3, 1.0
SETTLE_S = 50e-3  # from the end of the ramp to the first report
LATE_S = 1e-6  # a beat that starts later than this after its time is late
PITCH_M = 10e-3
TRAIN = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "train", rate_hz = 50.0, duration_ms = 3.6e6 }]\n'
FINE = '[[regions]]\nname = "all"\nshape = "plate"\neffects = [{ effect = "texture", spacing_mm = 0.5 }]\n'
LEADS_MS, SPEEDS_M_S = (2.1, 3.0, 4.7, 8.5), (0.1, 0.2, 0.5, 1.0)
REACH_M, NOISE_M, T_S = 30e-3, 0.05e-3, 2e-3
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
            self.ends_s.append(self.time_s(self._free_tick))
            return
        self.clock.spend(self.host.draw_s() * (1.0 if sum(lengths) >= UPLOAD_BYTES else SHORT_SHARE))
        self._pause_ticks = round(KERNEL_S / 2 * self.clock_hz)  # before and after each frame's bits
        super().exchange(sent, lengths, received)
        self.ends_s.append(self.time_s(self._free_tick))
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
class Beats:
    """What became of the beats of a run.

    Attributes
    ----------
    late : list of bool
        For each beat: whether it started later than due; for the first one of a train, whether it reached the FPGA later than
        promised.
    off_s : list of float
        For each beat but the first of its train, how much later than due it started.
    spacing_error_s : list of float
        Difference of each two following beats' distance from the train's period.
    held_s : list of float
        For each beat that was late and started by the host: from the arrival of its command to its start.
    counters, timing
        Of the loop.
    emissions_hz : float
        Emissions a second, from the first to the last.
    """

    late: list[bool]
    off_s: list[float]
    spacing_error_s: list[float]
    held_s: list[float]
    counters: Counters
    timing: HostTiming
    emissions_hz: float


def run_slow(board: Board, scene: Scene, bank: Bank, recording: Recording, p50_s: float, seed: int = 1) -> Beats:
    """Replay a recording through the event loop on a slow host.

    Parameters
    ----------
    board, scene, bank, recording
        As in `simulation.simulated_run.play`.
    p50_s : float
        Median host time of an upload; 0: the host takes no time.
    seed : int
        Of the host times.

    Returns
    -------
    Beats
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
    assembly = assemble(board, scene, bank, clock, session, tracked(source, board), played=played.append)
    assembly.loop.run()
    link.close()
    starts = link.take_capture().focus_ticks.astype(np.int64) - board.waveform.samples * board.bit_ticks
    return _beats(assembly, played, (starts / board.link.clock_hz).tolist(), link.ends_s)


def _beats(assembly: Assembly, played: Sequence[Played], starts_s: Sequence[float], ends_s: Sequence[float]) -> Beats:
    late: list[bool] = []
    off, spacing, held = [], [], []
    before: dict[int | str, tuple[int, float]] = {}
    for one, start_s in zip(played, starts_s, strict=True):
        for emission in one.emissions:
            if not emission.period_s:
                continue
            if emission.beat:
                off.append(start_s - float(emission.time_s))
                late.append(off[-1] > LATE_S)
                beat, was_s = before.get(emission.owner, (0, math.nan))
                if emission.beat == beat + 1:
                    spacing.append(abs(start_s - was_s - emission.period_s))
                if late[-1] and one.at_ticks is None:
                    held.append(start_s - ends_s[bisect_right(ends_s, start_s) - 1])
            else:
                late.append(one.at_ticks is None)
            before[emission.owner] = emission.beat, start_s
    emissions_hz = (len(starts_s) - 1) / (starts_s[-1] - starts_s[0]) if len(starts_s) > 1 else 0.0
    return Beats(late, off, spacing, held, assembly.counters, assembly.timing, emissions_hz)


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


def late_beats(
    board: Board, bank: Bank, duration_s: float, hosts_us: Sequence[float] = HOSTS_US, seed: int = 1
) -> list[dict[str, Any]]:
    """Play 50 Hz trains under one moving finger, under two, and under the fingers of the board's recording.

    Parameters
    ----------
    board : Board
    bank : Bank
    duration_s : float
        For which the fingers move.
    hosts_us : sequence of float
        Median host times of an upload.
    seed : int

    Returns
    -------
    list of dict
        A row for each scene and host. `late_percent`: of the beats; `off_worst_ms`: how much later than due a beat started at
        most; `spacing_worst_ms`: how far the distance of two beats was off the period; `lead_ms`: at the end of the run.
    """
    scene = scene_of(board, TRAIN)
    recordings = {
        "one finger": moving(duration_s),
        "two fingers": moving(duration_s, 2),
        "recording": Recording.open(board.beside(board.touch.recording)),
    }
    rows = []
    for name, recording in recordings.items():
        for p50_us in hosts_us:
            done = run_slow(board, scene, bank, recording, p50_us * 1e-6, seed)
            rows.append(
                {
                    "fingers": name,
                    "host_p50_us": p50_us,
                    "beats": len(done.late),
                    "late_percent": round(100 * sum(done.late) / len(done.late), 2),
                    "off_worst_ms": round(1e3 * max(done.off_s), 3),
                    "spacing_worst_ms": round(1e3 * max(done.spacing_error_s), 3),
                    "lead_ms": done.timing.figures()["lead_ms"],
                }
            )
    return rows


def rates(board: Board, bank: Bank, duration_s: float, hosts_us: Sequence[float] = HOSTS_US, seed: int = 1) -> list[dict[str, Any]]:
    """Emissions a second of a fine texture under a fast finger, an upload each: what the host reaches, and what it says it does."""
    scene, recording = scene_of(board, FINE), moving(duration_s, speed_m_s=FAST_M_S, report_s=FAST_REPORT_S)
    rows = []
    for p50_us in hosts_us:
        done = run_slow(board, scene, bank, recording, p50_us * 1e-6, seed)
        rows.append(
            {"host_p50_us": p50_us, "reached_hz": round(done.emissions_hz, 1), "said_hz": done.timing.figures()["uploads_hz"]}
        )
    return rows


def aim_errors(
    leads_ms: Sequence[float] = LEADS_MS, speeds_m_s: Sequence[float] = SPEEDS_M_S, seed: int = 1
) -> list[dict[str, Any]]:
    """Distance of the place a beat is aimed at from where its finger is when the focus forms, by the lead it is prepared with.

    The finger moves to and fro as a sine of 30 mm, with the highest speed given; the panel reports every 8 ms, with 0.05 mm of
    noise and a resolution of 0.1 mm. A beat is aimed T and its lead ahead, at any time between two reports.

    Returns
    -------
    list of dict
        For each speed and lead the median and the 95th percentile in mm.
    """
    rows = []
    for speed_m_s in speeds_m_s:
        for lead_ms in leads_ms:
            rng, off = random.Random(seed), []
            rad_s = speed_m_s / REACH_M
            motion = Motion(0.0, 0.0, 0.0)
            for k in range(1, 4000):
                now_s = k * REPORT_S
                noisy_m = [REACH_M * math.sin(rad_s * now_s) + rng.gauss(0, NOISE_M), rng.gauss(0, NOISE_M)]
                motion.report(round(noisy_m[0], 4), round(noisy_m[1], 4), now_s)
                asked_s = now_s + rng.random() * REPORT_S
                focus_s = asked_s + lead_ms * 1e-3 + T_S
                x_m, y_m = motion.predict(focus_s, asked_s, 0.0, REPORT_S)
                off.append(1e3 * math.hypot(x_m - REACH_M * math.sin(rad_s * focus_s), y_m))
            p50_mm, p95_mm = np.percentile(off, [50, 95]).tolist()
            rows.append({"speed_m_s": speed_m_s, "lead_ms": lead_ms, "p50_mm": round(p50_mm, 2), "p95_mm": round(p95_mm, 2)})
    return rows


def table(rows: Sequence[dict[str, Any]]) -> str:
    """Format rows of equal keys as a table in Markdown."""
    heads = list(rows[0])
    lines = [
        heads,
        ["---"] * len(heads),
        *[[f"{row[head]:g}" if head != "fingers" else row[head] for head in heads] for row in rows],
    ]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line (`sys.argv` by default); the exit code."""
    parser = argparse.ArgumentParser(prog="python -m controller.benchmark.slow_hosts", description="Beats of trains on slow hosts.")
    parser.add_argument("--seconds", type=float, default=40.0, help="for which the fingers move (40)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(arguments)
    board = load_board(find_board("simulated"))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ten.bank"
        build_bank(board, path, PITCH_M, measure_sgemm=False)
        with Bank.open(path, board) as bank:
            figures = {
                "late_beats": late_beats(board, bank, options.seconds, seed=options.seed),
                "rates": rates(board, bank, options.seconds / 10, seed=options.seed),
                "aim_errors": aim_errors(seed=options.seed),
            }
    shown = json.dumps(figures) if options.json else "\n\n".join(table(rows) for rows in figures.values())
    sys.stdout.write(shown + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
