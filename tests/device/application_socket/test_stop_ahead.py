"""A stop takes effect at once, whatever its client has sent before it; all lines are answered all the same, in their order."""

import json
import socket

import pytest
from device.application_socket.test_command_socket import POINT, balanced

from controller.device.application_socket.command_socket import LINES_A_CLIENT
from controller.device.application_socket.connections.connection import Connection
from controller.device.application_socket.requests.stop_ahead import AHEAD_BYTES, MOST_WORDS

SENDS_ANY = {"commands_per_s": 100, "burst": 10}


def lines(*messages):
    return b"".join(json.dumps(message).encode() + b"\n" for message in messages)


def test_it_waits_for_no_line_before_it(panel_with, read_all):
    panel = panel_with(**SENDS_ANY)
    client = panel.connect()
    panel.settle()
    words = [{**POINT, "effect": "stop"}] * (MOST_WORDS - 1)
    before = [{**POINT, "id": number} for number in range(1000)]
    client.sendall(lines(*before, {"kind": "stop", "id": "stop", "by": "a page"}, *words) + b'{"kind": "arm", "id": "half')
    turns = 0
    while not panel.control.switched:
        assert panel.turn()
        turns += 1
    assert turns <= 10 // LINES_A_CLIENT + 2  # those within its rate, and one more
    assert (panel.control.switched[0], panel.socket.disarmed_by) == (False, panel.control.switched_by)
    assert panel.socket.disarmed_by.endswith(" for a page")
    panel.settle()
    answers = read_all(client)
    assert len(answers) == len(words) + len(before) + 1 - len(panel.control.plays)
    assert [answer["outcome"] for answer in answers if answer["id"] == "stop"] == ["done"]
    assert set(panel.control.switched) == {False}
    assert balanced(panel)


@pytest.mark.parametrize(
    "never",
    [
        {**POINT, "effect": "stop"},
        {"kind": "stop", "id": 1, "now": True},
        {"kind": "hello", "stop": {"kind": "stop"}},
    ],
)
def test_only_a_line_that_is_one_counts(panel_with, never):
    panel = panel_with(**SENDS_ANY)
    client = panel.connect()
    panel.settle()
    client.sendall(lines(*[never] * 300) + b'{"kind": "stop"}')  # the last is not whole
    panel.settle()
    assert panel.control.switched == []


def test_the_rest_of_a_line_that_is_too_long_is_none(panel_with):
    panel = panel_with(**SENDS_ANY)
    client = panel.connect()
    panel.settle()
    panel.send(client, lines(*[POINT] * 20) + b"x" * 9000 + b'\n{"kind": "hello"}\n' + b"x" * 8192 + lines({"kind": "stop"}))
    panel.settle()
    assert panel.control.switched == []


def test_what_was_sent_is_seen_across_both_buffers_and_taken_from_neither():
    sent = lines(*[POINT] * 400)
    ours, theirs = socket.socketpair()
    ours.setblocking(False)
    connection, ahead = Connection(1, 1), bytearray(AHEAD_BYTES)
    connection.begin(ours, 1, 0.0)
    assert connection.peek(ahead) == 0
    theirs.sendall(sent)
    connection.receive()
    assert ahead[: connection.peek(ahead)] == sent
    line = connection.next_line()
    assert ahead[: connection.peek(ahead)] == sent[len(line) + 1 :]
    theirs.close()
    connection.close()
