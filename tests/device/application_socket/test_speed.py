"""What a command costs the loop: `pytest -o addopts=--import-mode=importlib --benchmark-only tests/device/application_socket`."""

import json

import pytest

from controller.device.application_socket.protocol.client_messages import LINE_BYTES
from controller.device.loop.commands import Outcome
from controller.device.scene.effects.clips import MOST_PULSES, read_clip
from controller.device.touch.source import TouchSample

POINT = {"kind": "play", "effect": "click", "x_mm": 100, "y_mm": 70, "id": 123_456, "amplitude": 0.5}


@pytest.mark.parametrize("lines", [1, 8])
def test_commands_from_the_socket_to_their_answers(panel_with, benchmark, lines):
    panel = panel_with(commands_per_s=10_000, burst=10_000)
    client = panel.connect()
    panel.settle()
    text = (json.dumps(POINT).encode() + b"\n") * lines

    def send():
        client.send(text)
        panel.now_s += 0.1

    def handle():
        panel.socket.serve(panel.now_s, panel.control)
        for ticket, *_ in panel.control.plays:
            panel.socket.outcome(ticket, Outcome.PLAYED, 1e-3)
        panel.control.plays.clear()
        client.recv(4096)

    benchmark.pedantic(handle, setup=send, rounds=2000)
    assert panel.socket.counters.played == 2000 * lines


def test_a_turn_without_commands(panel_with, benchmark):
    panel = panel_with()
    panel.connect()
    panel.settle()
    benchmark(panel.socket.serve, panel.now_s, panel.control)


def test_a_touch_for_one_subscriber(panel, benchmark):
    client = panel.connect()
    panel.ask(client, {"kind": "subscribe"})
    samples = [TouchSample(3, 0.1, 0.07, 12.5, True, 9e-3)]

    def tell():
        panel.socket.touches(samples)
        client.recv(4096)

    benchmark(tell)


LARGEST = {
    "pulses": {"pulses": [[index * 10, 0.5] for index in range(620)]},
    "sweep": {"rate_envelope": [[index * 9, 100] for index in range(620)], "duration_ms": 10 * MOST_PULSES},
    "envelope": {"rate_hz": 100, "duration_ms": 9990, "envelope": [[index * 9, 0.5] for index in range(620)]},
}


@pytest.mark.parametrize("kind", LARGEST)
def test_the_largest_clips(board, benchmark, kind):
    line = json.dumps(LARGEST[kind]).encode()
    assert 0.8 * LINE_BYTES < len(line) < LINE_BYTES
    benchmark(read_clip, "largest", line, board)
