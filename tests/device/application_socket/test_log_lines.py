"""The service's log for operators: the last lines, then each one once, in order; for nobody else."""

import grp
import math

import pytest

from controller.device.application_socket.connections.peers import Peer
from controller.device.application_socket.protocol.client_messages import LINE_BYTES
from controller.log import LAST_LINES, LOG, MAX_LINE_BYTES, Priority, log

SUBSCRIBE = {"kind": "subscribe", "to": ["log"], "id": 1}
OPERATORS = next(group for group in grp.getgrall() if group.gr_gid not in (0, 65534))
OPERATOR = Peer(50_001, 11, frozenset({OPERATORS.gr_gid}))
ORDINARY = Peer(50_002, 12, frozenset())


@pytest.fixture
def panel(panel_with):
    return panel_with(operate_group=OPERATORS.gr_name)


def test_operators_get_the_last_lines_and_then_each_one(panel):
    for number in range(LAST_LINES + 5):
        log(f"before {number}")
    client = panel.connect(OPERATOR)
    answer, *lines = panel.ask(client, SUBSCRIBE)
    assert answer["outcome"] == "done"
    assert [line["text"] for line in lines] == [f"before {number}" for number in range(5, LAST_LINES + 5)]
    assert panel.ask(client) == []
    log("two\nlines", Priority.WARNING)
    (line,) = panel.ask(client)
    assert (line["kind"], line["priority"], line["text"]) == ("log", 4, "two lines")
    assert panel.ask(client, SUBSCRIBE) == [{"kind": "answer", "id": 1, "outcome": "done"}], "not once more"
    panel.ask(client, {"kind": "unsubscribe"})
    log("after")
    assert panel.ask(client) == []


def test_nobody_is_woken_for_lines_that_nobody_reads(panel):
    client = panel.connect(OPERATOR)
    panel.ask(client)
    log("read by nobody")
    assert panel.socket.next_time_s() == math.inf
    panel.ask(client, SUBSCRIBE)
    log("read")
    assert panel.socket.next_time_s() == -math.inf
    client.close()
    panel.settle()
    log("read by nobody")
    panel.settle()
    log("read by nobody again")
    assert panel.socket.next_time_s() == math.inf


def test_more_lines_at_once_than_are_kept_are_the_last_ones(panel):
    client = panel.connect(OPERATOR)
    panel.ask(client, SUBSCRIBE)
    for number in range(LAST_LINES * 3):
        log(f"line {number}")
    assert [line["text"] for line in panel.ask(client)] == [f"line {number}" for number in range(LAST_LINES * 2, LAST_LINES * 3)]


def test_a_line_is_no_longer_than_a_message(panel):
    client = panel.connect(OPERATOR)
    panel.ask(client, SUBSCRIBE)
    log("é" * LINE_BYTES)
    (line,) = panel.ask(client)
    assert len(line["text"]) == MAX_LINE_BYTES


def test_it_is_for_operators_alone(panel):
    client = panel.connect(ORDINARY)
    (answer,) = panel.ask(client, SUBSCRIBE | {"to": ["touches", "log"]})
    assert "does not have the right to operate" in answer["reason"]
    log("secret")
    assert panel.ask(client) == []
    assert LOG.count >= len(LOG.last)
