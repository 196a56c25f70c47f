"""What regions of a client cost the loop: latency of commands with and without 20 replacements a second of 200 rectangles.

    python -m tests.figures.layer_load [--seconds 120] [--rectangles 200] [--replacements 20] [--realtime]

Paired in one run: spans of two seconds without and with replacements take turns, so that what else the machine does falls on both.
In all of them one client plays clicks at places on the plate. Its round trip contains all that the loop does before it reads the
command; `age` begins there. The simulated panel (`served_panel`) runs in another process. Before that, the time from sending
regions until they are in force: five rectangles, and as many as are replaced.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import selectors
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import msgspec

from controller.console import program, say
from controller.device.application_socket.client import PanelClient
from controller.device.application_socket.protocol import client_messages, panel_messages
from controller.metrics import LatencyHistogram
from tests.figures.socket_load import Account, connect, received, wait_for_panel

SPAN_S: Final = 2.0
SETTLE_S: Final = 0.1  # at the start of a span, which counts to neither kind
PLAYS_HZ: Final = 200
COLUMNS: Final = 20
IN_FORCE: Final = 40  # times that the time until regions are in force is measured
REST_S: Final = 10.0
PLACES: Final = 24
REALTIME_PRIORITY: Final = 10


@dataclass
class Spans:
    """Latencies of commands in one kind of span: of all of them, and the p99 of each single one."""

    round_trip: LatencyHistogram = field(default_factory=LatencyHistogram)
    age: LatencyHistogram = field(default_factory=LatencyHistogram)
    p99_us: list[float] = field(default_factory=list)


def rectangles(count: int, shift_mm: float = 0.0) -> list[dict[str, Any]]:
    """Rectangles of 9 mm in rows, as a page with as many buttons has them."""
    return [
        {
            "name": f"r{number}",
            "shape": "rectangle",
            "x_mm": 1 + number % COLUMNS * 10 + shift_mm,
            "y_mm": 1 + number // COLUMNS * 10,
            "width_mm": 9,
            "height_mm": 9,
            "effects": ["click"],
        }
        for number in range(count)
    ]


def in_force_ms(path: str, count: int) -> dict[str, float]:
    """Time in ms from sending rectangles until the answer that they are in force: median, p95 and worst."""
    took = []
    with PanelClient(path) as panel:
        for number in range(IN_FORCE):
            started_s = time.perf_counter()
            panel.put_regions(rectangles(count, 0.01 * number))
            took.append((time.perf_counter() - started_s) * 1e3)
            time.sleep(0.05)
    return _figures(took)


def moved_ms(path: str) -> dict[str, float]:
    """Time in ms from sending a transform until the answer that it is in force, of a layer of 200 rectangles."""
    took = []
    with PanelClient(path) as panel:
        panel.put_regions(rectangles(200))
        for number in range(IN_FORCE):
            started_s = time.perf_counter()
            panel.move_regions(x_mm=0.01 * number)
            took.append((time.perf_counter() - started_s) * 1e3)
            time.sleep(1 / 60)
    return _figures(took)


def _figures(took_ms: list[float]) -> dict[str, float]:
    took_ms.sort()
    p95 = took_ms[round(0.95 * (len(took_ms) - 1))]
    return {name: round(took, 2) for name, took in (("median", statistics.median(took_ms)), ("p95", p95), ("worst", took_ms[-1]))}


class Load:
    """Clicks all the time, and replacements in every second span. `lines` are regions, as they are sent one after the other."""

    def __init__(self, path: str, lines: list[bytes], replacements_hz: float) -> None:
        self._path = path
        self._lines = lines
        self._replacements_hz = replacements_hz
        self._player, self._page = connect(path), connect(path)
        self._chance = random.Random(1)
        self._decoder, self._encoder = panel_messages.message_decoder(), msgspec.json.Encoder()
        self._places = [(self._chance.uniform(15, 195), self._chance.uniform(15, 133)) for _ in range(PLACES)]
        self._one_span = LatencyHistogram()
        self._counted = False  # commands that are answered now
        self.spans = {False: Spans(), True: Spans()}
        self.replaced = 0
        self.overtaken = 0  # by the next one, before they were checked
        self.refused = 0

    def run(self, seconds: float) -> None:
        """Span after span, those without replacements first."""
        with selectors.DefaultSelector() as selector:
            for account in (self._player, self._page):
                selector.register(account.socket, selectors.EVENT_READ, account)
            for number in range(2 * max(round(seconds / SPAN_S / 2), 1)):
                self._span(selector, replacing=number % 2 == 1)

    def close(self) -> None:
        """Disconnect."""
        self._player.socket.close()
        self._page.socket.close()

    def _span(self, selector: selectors.BaseSelector, *, replacing: bool) -> None:
        self._one_span = LatencyHistogram()
        started_s = time.monotonic()
        plays, pages = 0, 0
        while (at_s := time.monotonic() - started_s) < SPAN_S:
            self._counted = at_s > SETTLE_S
            if plays <= at_s * PLAYS_HZ:
                plays += 1
                self._play()
            if replacing and pages <= at_s * self._replacements_hz:
                pages += 1
                self._replace()
            next_s = min(plays / PLAYS_HZ, pages / self._replacements_hz if replacing else SPAN_S)
            for key, _ in selector.select(max(started_s + next_s - time.monotonic(), 0.0)):
                for line in received(key.data, self._path):
                    self._take(key.data, self._decoder.decode(line), self.spans[replacing])
        self.spans[replacing].p99_us.append(self._one_span.percentiles_ns([0.99])[0] * 1e-3)

    def _play(self) -> None:
        x_mm, y_mm = self._chance.choice(self._places)
        self._send(self._player, client_messages.PlayRequest(id=self._player.sent + 1, effect="click", x_mm=x_mm, y_mm=y_mm))

    def _send(self, account: Account, request: client_messages.PlayRequest) -> None:
        account.sent += 1
        account.waiting[account.sent] = time.monotonic_ns()
        account.socket.send(self._encoder.encode(request) + b"\n")

    def _replace(self) -> None:
        line = self._lines[self._page.sent % len(self._lines)]
        self._page.sent += 1
        self._page.socket.setblocking(True)
        self._page.socket.sendall(line)
        self._page.socket.setblocking(False)

    def _take(self, account: Account, message: panel_messages.AnyMessage, spans: Spans) -> None:
        if account is self._page:
            whole = isinstance(message, panel_messages.LayerAnswer) and not message.refused_count
            overtaken = isinstance(message, panel_messages.Answer) and message.outcome == "merged"
            self.replaced += whole
            self.overtaken += overtaken
            self.refused += not (whole or overtaken)
        elif isinstance(message, panel_messages.Answer) and isinstance(message.id, int):
            sent_ns = account.waiting.pop(message.id)
            if self._counted and message.outcome == "played" and message.age_ms is not None:
                took_ns = time.monotonic_ns() - sent_ns
                spans.round_trip.record(took_ns)
                self._one_span.record(took_ns)
                spans.age.record(round(message.age_ms * 1e6))


def measure(path: str, seconds: float, count: int, replacements_hz: float) -> dict[str, Any]:
    """Figures of the panel at a path, ready for JSON."""
    force = {str(number): in_force_ms(path, number) for number in (5, count)}
    moved = moved_ms(path)
    lines = [
        msgspec.json.encode({"kind": "regions", "id": number, "regions": rectangles(count, 0.01 * number)}) + b"\n"
        for number in range(100)
    ]
    load = Load(path, lines, replacements_hz)
    try:
        load.run(seconds)
    finally:
        load.close()
    without, with_regions = load.spans[False], load.spans[True]
    ratios = [loaded / quiet for quiet, loaded in zip(without.p99_us, with_regions.p99_us, strict=True)]
    return {
        "line_bytes": len(lines[0]),
        "in_force_ms": force,
        "moved_ms": moved,
        "replaced": load.replaced,
        "overtaken": load.overtaken,
        "refused": load.refused,
        "round_trip_us": {"without": without.round_trip.summary_us(), "with": with_regions.round_trip.summary_us()},
        "age_us": {"without": without.age.summary_us(), "with": with_regions.age.summary_us()},
        "p99_with_over_without": {"all": _ratio(with_regions, without), "median_of_pairs": round(statistics.median(ratios), 3)},
    }


def _ratio(with_regions: Spans, without: Spans) -> float:
    loaded, quiet = (spans.round_trip.percentiles_ns([0.99])[0] for spans in (with_regions, without))
    return round(loaded / quiet, 3)


def run(options: argparse.Namespace) -> dict[str, Any]:
    """Start the simulated panel, measure with the options of the command line, and stop it.

    Raises ControllerError if the panel does not start, or ends a connection.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "panel.sock")
        command = [sys.executable, "-m", "controller", "serve", path, "--touched-s", str(options.seconds + REST_S)]
        with subprocess.Popen(command) as panel:
            try:
                wait_for_panel(path, panel)
                if options.realtime:  # the panel's helper processes are started, and keep theirs
                    for pid in (panel.pid, 0):
                        os.sched_setscheduler(pid, os.SCHED_FIFO, os.sched_param(REALTIME_PRIORITY))
                return measure(path, options.seconds, options.rectangles, options.replacements)
            finally:
                panel.send_signal(signal.SIGTERM)


@program
def main(arguments: list[str] | None = None) -> int:
    """Run from the command line (`sys.argv` by default); exit code 1 if regions were refused."""
    parser = argparse.ArgumentParser(prog="python -m tests.figures.layer_load", description="What clients' regions cost the loop.")
    parser.add_argument("--seconds", type=float, default=120.0)
    parser.add_argument("--rectangles", type=int, default=200, metavar="N")
    parser.add_argument("--replacements", type=float, default=20.0, metavar="N", help="a second (20)")
    parser.add_argument(
        "--realtime", action="store_true", help="loop and client with real-time priority, as a device's loop has; needs root"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(arguments)
    figures = run(options)
    say(json.dumps(figures) if options.json else "\n".join(f"{name:22} {value}" for name, value in figures.items()))
    return 0 if not figures["refused"] else 1


if __name__ == "__main__":
    raise SystemExit(main())
