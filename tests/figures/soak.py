"""Soak figure: hours of recordings through the whole loop in virtual time; does memory grow, does it get slower?

`python -m tests.figures.soak --hours 10 RECORDING...` plays the recordings in turn, over and over, through
tracker, scene, playback, session and the gateware's model, in one uninterrupted run of the loop. After each hour of recorded time
it reports memory and the latencies of that hour.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from controller.clocks import VirtualClock
from controller.console import program, say, tell
from controller.device.bank.reader import Bank
from controller.device.board.board import Board, load_board
from controller.device.board.lookup import find_board
from controller.device.board.paths import bank_path
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.wiring import assemble
from controller.device.scene.scene import Scene, load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.device.touch.source import Counts, TouchSample
from controller.metrics import Counters, Stages
from controller.workshop.gateware.simulated_link import open_simulated

PAUSE_S = 0.5  # between recordings
HOUR_S = 3600.0
CAPTURE_S = 10.0  # interval at which the captured pins are discarded


@dataclass(frozen=True, slots=True)
class Hour:
    """Emissions, latencies, memory and computing time of one hour of recordings."""

    emissions: int
    uploads_host_p50_us: float | None
    uploads_host_p99_us: float | None
    resident_host_p50_us: float | None
    rss_bytes: int
    wall_s: float


class Playlist:
    """Recordings in turn, over and over; a `TouchSource` that never uses a finger number twice.

    After `end_s` no recording begins.
    """

    def __init__(self, recordings: Sequence[Recording], board: Board, start_s: float, end_s: float) -> None:
        self.counts = Counts()
        self._recordings = recordings
        self._axes = [recording.axes(board) for recording in recordings]
        self._end_s = end_s
        self._number = 0
        self._fingers = 0  # of the recordings before
        self._seen = 0
        self.touched = False
        self._source: RecordingSource | None = self._opened(start_s)

    @property
    def warnings(self) -> Counter[str]:
        """Always empty: the anomalies of recordings would be counted again in each round."""
        return Counter()

    def fileno(self) -> None:
        """None: there is no file to wait on, only `next_time_s`."""
        return

    def next_time_s(self) -> float | None:
        """Time of the next report; None after the last."""
        return None if self._source is None else self._source.next_time_s()

    def read(self, now_s: float) -> tuple[TouchSample, ...]:
        """Samples of the next report if it is due at `now_s`; see `TouchSource.read`."""
        source = self._source
        if source is None:
            self.touched = False
            return ()
        samples = source.read(now_s)
        self.touched = source.touched
        self.counts.reports += self.touched
        if samples:
            self._seen = max(self._seen, *[sample.finger + 1 for sample in samples])
            samples = tuple([sample._replace(finger=sample.finger + self._fingers) for sample in samples])
        if source.next_time_s() is None:
            self._fingers += self._seen
            self._seen = 0
            self._source = self._opened(now_s + PAUSE_S) if now_s < self._end_s else None
        return samples

    def close(self) -> None:
        """Do nothing: no file is open."""

    def _opened(self, start_s: float) -> RecordingSource:
        number = self._number % len(self._recordings)
        self._number += 1
        return RecordingSource(self._recordings[number], self._axes[number], start_s)


def soak(board: Board, scene: Scene, bank: Bank, recordings: Sequence[Recording], hours: float, note: Any) -> list[Hour]:
    """Play the recordings for a number of hours of recorded time; `note` is called with each `Hour` as it ends.

    Raises FaultError or LinkError from the event loop.
    """
    clock = VirtualClock()
    link = open_simulated(board, clock.now_s)
    session = open_session(link, board, clock.now_s)
    start_s = session.earliest_trigger_s() + board.limits.arming_s + PAUSE_S
    source = tracked(Playlist(recordings, board, start_s, start_s + hours * HOUR_S), board)
    reported: list[Hour] = []
    state = {"hour_s": start_s + HOUR_S, "capture_s": start_s, "emissions": 0, "wall_s": time.perf_counter()}

    def progress(now_s: float) -> None:
        if now_s >= state["capture_s"]:
            state["capture_s"] = now_s + CAPTURE_S
            link.take_capture()
        if now_s >= state["hour_s"]:
            state["hour_s"] += HOUR_S
            _note(now_s)

    def _note(_: float) -> None:
        counters, wall_s = assembly.counters, time.perf_counter()
        link.take_capture()  # captured pins are not the loop's memory
        hour = _hour(counters, counters.emissions - int(state["emissions"]), wall_s - state["wall_s"])
        state["emissions"], state["wall_s"] = counters.emissions, wall_s
        counters.upload_latency, counters.resident_latency = Stages(), Stages()
        reported.append(hour)
        note(hour)

    assembly = assemble(LoopContext(board, clock, session, source), scene, bank, watch=Watch(progress))
    assembly.loop.run()
    link.close()
    if assembly.counters.emissions > state["emissions"]:
        _note(clock.now_s())
    return reported


def _hour(counters: Counters, emissions: int, wall_s: float) -> Hour:
    uploads, resident = counters.upload_latency.host.summary_us(), counters.resident_latency.host.summary_us()
    return Hour(emissions, uploads["p50"], uploads["p99"], resident["p50"], _rss_bytes(), round(wall_s, 1))


def _rss_bytes() -> int:
    """Anonymous memory of this process: without the pages of the bank, which are file-backed (proc(5), status)."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("RssAnon:"):
            return int(line.split()[1]) * 1024
    return 0


@program
def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line (`sys.argv` by default); exit code 1 if memory has grown by more than 1 MB."""
    name = "python -m tests.figures.soak"
    parser = argparse.ArgumentParser(prog=name, description=(__doc__ or "").splitlines()[0])
    parser.add_argument("recordings", nargs="+", metavar="RECORDING", help="evemu files")
    parser.add_argument("--board", default="simulated", metavar="B")
    parser.add_argument("--scene", metavar="S", help="default: the board's own")
    parser.add_argument("--hours", type=float, default=10.0, metavar="H", help="of recorded time (default: 10)")
    parser.add_argument("--json", action="store_true", help="one JSON object on stdout")
    options = parser.parse_args(arguments)
    board = load_board(find_board(options.board))
    scene_file = find_scene(board, options.scene)
    scene = load_scene(scene_file, board)
    recordings = [Recording.open(Path(name)) for name in options.recordings]
    path = bank_path(board)
    with Bank.open(path, board) as bank:
        reported = soak(board, scene, bank, recordings, options.hours, _tell)
    grown = _grown_bytes([hour.rss_bytes for hour in reported])
    figures = {"hours": [asdict(hour) for hour in reported], "grown_bytes": grown}
    sentence = f"memory grew by {grown} bytes from the first half to the second"
    say(json.dumps(figures) if options.json else sentence)
    return 1 if grown > 1 << 20 else 0


def _grown_bytes(sizes: list[int]) -> int:
    """Growth from the first to the second half, by the minimum of each: memory that is returned does not count."""
    half = len(sizes) // 2
    return min(sizes[half:]) - min(sizes[:half]) if half else 0


def _tell(hour: Hour) -> None:
    tell(
        f"{hour.emissions} emissions, host time of an upload p50 {hour.uploads_host_p50_us} us, p99 {hour.uploads_host_p99_us} us,"
        f" resident p50 {hour.resident_host_p50_us} us, memory {hour.rss_bytes / 1e6:.1f} MB, {hour.wall_s} s"
    )


if __name__ == "__main__":
    sys.exit(main())
