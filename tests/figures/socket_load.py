"""Figure of the application socket under load: many commands a second for a minute, each answered exactly once.

    python -m tests.figures.socket_load --seconds 60 --rate 2000 [--clients 2] [--places 24] [--json]

The simulated panel (`served_panel`) runs in another process. Each client records every command and its answer; at the end
the sums are compared with the service's counters. One command in eight is for a finger that is down, known from a
subscription; the others are for places on the plate.
"""

from __future__ import annotations

import argparse
import json
import random
import selectors
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec

from controller.console import program, say
from controller.device.application_socket.client import PanelClient
from controller.device.application_socket.protocol import client_messages, panel_messages
from controller.errors import ControllerError, LinkError
from controller.metrics import LatencyHistogram

START_S = 60.0  # for the panel to build its bank
REST_S = 5.0  # for the last answers
SETTLED = 0.2  # share of the time after which memory must be constant
FOR_FINGERS = 8  # one command in this many is for a finger
MARGIN_MM = 15.0
RECEIVE_BYTES = 1 << 16
SENT_AT_ONCE = 32  # commands between two reads: the service disconnects clients that do not read
OUTCOMES = ("played", "merged", "skipped", "refused")


@dataclass
class Account:
    """One client: its connection, the commands that wait for an answer, and the answers counted by outcome."""

    socket: socket.socket
    received: bytearray = field(default_factory=bytearray)
    waiting: dict[int, int] = field(default_factory=dict)  # id to when it was sent, ns
    sent: int = 0
    answered: Counter[str] = field(default_factory=Counter)
    reasons: Counter[str] = field(default_factory=Counter)
    wrong: int = 0  # answers to commands not sent, or answered before


@dataclass
class Observed:
    """What all clients together observe: fingers that are down, and the latencies of what was played."""

    fingers: dict[int, bool] = field(default_factory=dict)
    age: LatencyHistogram = field(default_factory=LatencyHistogram)
    round_trip: LatencyHistogram = field(default_factory=LatencyHistogram)


def drive(path: str, pid: int, *, seconds: float, rate_hz: float, clients: int, places: int) -> dict[str, Any]:
    """Send commands at a constant rate and read all answers.

    `pid` is the service's, whose memory is watched; `rate_hz` is that of all clients together. The waveforms of a few different
    `places` on the plate stay resident in the FPGA, those of many are uploaded. Raises LinkError if the panel ends a connection.
    """
    decoder, observed = panel_messages.message_decoder(), Observed()
    with PanelClient(path) as panel:
        commands = _Commands(panel.hello(), places, observed.fingers)
        before = panel.figures()
    accounts = [connect(path) for _ in range(clients)]
    accounts[0].socket.sendall(msgspec.json.encode(client_messages.Subscribe(id="touches")) + b"\n")
    memory: list[tuple[float, int]] = []
    with selectors.DefaultSelector() as selector:
        for account in accounts:
            selector.register(account.socket, selectors.EVENT_READ, account)
        started_s = time.monotonic()
        total, number, memory_s = round(seconds * rate_hz), 0, started_s
        while number < total or any(account.waiting for account in accounts):
            now_s = time.monotonic()
            if now_s > started_s + seconds + REST_S:
                break
            if now_s >= memory_s:
                memory.append((now_s - started_s, _resident_bytes(pid)))
                memory_s = now_s + 1.0
            due = min(int((now_s - started_s) * rate_hz) + 1, total, number + SENT_AT_ONCE)
            for number_sent in range(number, due):
                _send(accounts[number_sent % clients], number_sent, commands.line(number_sent))
            number = max(number, due)
            next_s = started_s + number / rate_hz if number < total else now_s + 0.1
            for key, _ in selector.select(max(next_s - time.monotonic(), 0.0)):
                for line in received(key.data, path):
                    _account_for(key.data, decoder.decode(line), observed)
        took_s = time.monotonic() - started_s
    for account in accounts:
        account.socket.close()
    with PanelClient(path) as panel:
        after = panel.figures()
    return _report(accounts, before, after, observed, memory, took_s)


class _Commands:
    """Draws commands, for places on the plate away from its edges and for the fingers that are down; the same in each run."""

    def __init__(self, size: panel_messages.Greeting, places: int, fingers: dict[int, bool]) -> None:
        self._chance, self._encoder, self._fingers = random.Random(1), msgspec.json.Encoder(), fingers
        self._spots = [
            (
                round(self._chance.uniform(MARGIN_MM, size.length_mm - MARGIN_MM), 1),
                round(self._chance.uniform(MARGIN_MM, size.width_mm - MARGIN_MM), 1),
            )
            for _ in range(places)
        ]

    def line(self, number: int) -> bytes:
        """The command of a number, as it is sent."""
        return self._encoder.encode(self._request(number)) + b"\n"

    def _request(self, number: int) -> client_messages.PlayRequest:
        if self._fingers and number % FOR_FINGERS == 0:
            return client_messages.PlayRequest(id=number, effect="click", finger=self._chance.choice(list(self._fingers)))
        x_mm, y_mm = self._chance.choice(self._spots)
        return client_messages.PlayRequest(id=number, effect="click", x_mm=x_mm, y_mm=y_mm)


def connect(path: str) -> Account:
    """A client of the panel at a path."""
    client = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    client.connect(path)
    client.setblocking(False)
    return Account(client)


def _send(account: Account, number: int, line: bytes) -> None:
    """Send a command, however long the panel takes to read it."""
    account.waiting[number] = time.monotonic_ns()
    account.sent += 1
    account.socket.setblocking(True)
    account.socket.sendall(line)
    account.socket.setblocking(False)


def received(account: Account, path: str) -> list[bytearray]:
    """Lines that have come whole; the rest of the last one is kept; raises LinkError if the panel has ended the connection."""
    try:
        more = account.socket.recv(RECEIVE_BYTES)
    except BlockingIOError:
        return []
    if not more:
        raise LinkError(f"{path}: the panel has ended a connection")
    account.received += more
    *lines, account.received = account.received.split(b"\n")
    return lines


def _account_for(account: Account, message: panel_messages.AnyMessage, observed: Observed) -> None:
    if isinstance(message, panel_messages.Touch):
        if message.contact:
            observed.fingers[message.finger] = True
        else:
            observed.fingers.pop(message.finger, None)
    elif isinstance(message, panel_messages.Farewell):
        raise LinkError(f"the panel has ended a connection: {message.reason}")
    elif isinstance(message, panel_messages.Answer) and message.id != "touches":
        sent_ns = account.waiting.pop(message.id, None) if isinstance(message.id, int) else None
        if sent_ns is None:
            account.wrong += 1
            return
        account.answered[message.outcome] += 1
        if message.outcome == "refused":
            account.reasons[message.reason] += 1
        if message.outcome == "played" and message.age_ms is not None:
            observed.age.record(round(message.age_ms * 1e6))
            observed.round_trip.record(time.monotonic_ns() - sent_ns)


def _report(
    accounts: list[Account],
    before: dict[str, Any],
    after: dict[str, Any],
    observed: Observed,
    memory: list[tuple[float, int]],
    took_s: float,
) -> dict[str, Any]:
    answered = sum((account.answered for account in accounts), Counter[str]())
    counted = {name: count - before["application_socket"][name] for name, count in after["application_socket"].items()}
    settled = [resident for at_s, resident in memory if at_s >= SETTLED * took_s]
    sent = sum(account.sent for account in accounts)
    return {
        "sent": sent,
        "rate_hz": round(sent / took_s, 1),
        "answered": dict(sorted(answered.items())),
        "answered_once": answered.total() == sent and not any(account.wrong or account.waiting for account in accounts),
        "sums_exact": all(answered[name] == counted[name] for name in OUTCOMES),
        "unanswered": sum(len(account.waiting) for account in accounts),
        "answered_twice": sum(account.wrong for account in accounts),
        "refused_because": dict(sum((account.reasons for account in accounts), Counter[str]())),
        "emissions": after["emissions"] - before["emissions"],
        "uploads": after["uploads"] - before["uploads"],
        "resident": after["resident"] - before["resident"],
        "age_us": observed.age.summary_us(),
        "round_trip_us": observed.round_trip.summary_us(),
        "memory_bytes": {"settled": settled[0], "end": settled[-1], "most": max(settled)} if settled else None,
        "service": {name: after[name] - before[name] for name in ("host_silent", "outages")},
    }


def _resident_bytes(pid: int) -> int:
    status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    return int(status.partition("RssAnon:")[2].split()[0]) * 1024  # the bank's pages are the file's


def run(options: argparse.Namespace) -> dict[str, Any]:
    """Start the simulated panel, drive it with the options of the command line, and stop it; figures of `drive`.

    Raises ControllerError if the panel does not start; LinkError if it ends a connection.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "panel.sock")
        command = [sys.executable, "-m", "controller", "serve", path, "--commands-per-s", "10000"]
        with subprocess.Popen([*command, "--touched-s", str(options.seconds + REST_S)]) as panel:
            try:
                wait_for_panel(path, panel)
                return drive(
                    path, panel.pid, seconds=options.seconds, rate_hz=options.rate, clients=options.clients, places=options.places
                )
            except LinkError:
                panel.wait(REST_S)  # it ends by itself, and says why
                raise
            finally:
                panel.send_signal(signal.SIGTERM)


def wait_for_panel(path: str, panel: subprocess.Popen[bytes]) -> None:
    """Wait until the outputs are on; raises ControllerError if it does not start."""
    give_up_s = time.monotonic() + START_S
    while time.monotonic() < give_up_s and panel.poll() is None:
        time.sleep(0.1)
        try:
            with PanelClient(path) as client:
                if client.figures()["outputs"] == "on":
                    return
        except LinkError:
            continue
    raise ControllerError("the simulated panel did not start")


@program
def main(arguments: list[str] | None = None) -> int:
    """Run from the command line (`sys.argv` by default); exit code 1 unless every command was answered exactly once."""
    parser = argparse.ArgumentParser(prog="python -m tests.figures.socket_load", description="Load on the application socket.")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--rate", type=float, default=2000.0, metavar="N", help="commands a second, all clients together (2000)")
    parser.add_argument("--clients", type=int, default=2, metavar="N")
    parser.add_argument("--places", type=int, default=24, metavar="N", help="different points (24); few of them stay resident")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(arguments)
    figures = run(options)
    say(json.dumps(figures) if options.json else "\n".join(f"{name:16} {value}" for name, value in figures.items()))
    return 0 if figures["answered_once"] and figures["sums_exact"] else 1


if __name__ == "__main__":
    raise SystemExit(main())
