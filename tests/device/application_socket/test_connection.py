"""Lines in and answers out through buffers of fixed size, over a real pair of sockets."""

import json
import socket

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.device.application_socket.connections.connection import QUEUE_BYTES, Connection, LineTooLong
from controller.device.application_socket.protocol.client_messages import LINE_BYTES
from controller.device.application_socket.protocol.panel_messages import Answer


@pytest.fixture
def ends():
    ours, theirs = socket.socketpair()
    ours.setblocking(False)
    theirs.setblocking(False)
    connection = Connection(100.0, 10)
    connection.begin(ours, 1, 0.0)
    yield connection, theirs
    connection.close()
    theirs.close()


def lines_of(connection):
    lines = []
    while True:
        try:
            line = connection.next_line()
        except LineTooLong:
            lines.append("too long")
            continue
        if line is None:
            return lines
        lines.append(bytes(line))


long_pieces = st.sampled_from([b"\n", b"{}\n", b"x" * (LINE_BYTES - 1), b"y" * LINE_BYTES, b"z" * 20_000])
pieces = st.lists(st.binary(max_size=40) | long_pieces, max_size=12)


@settings(max_examples=60)
@given(pieces)
def test_any_bytes_in_any_pieces_are_the_lines_that_they_are(chunks):
    ours, theirs = socket.socketpair()
    ours.setblocking(False)
    connection = Connection(100.0, 10)
    connection.begin(ours, 1, 0.0)
    got = []
    for chunk in chunks:
        if not chunk:
            continue
        theirs.sendall(chunk)
        for _ in range(len(chunk) // LINE_BYTES + 2):
            connection.receive()
            got += lines_of(connection)
    assert not connection.ended
    connection.close()
    theirs.close()
    whole, _, rest = b"".join(chunks).rpartition(b"\n")
    sent = whole.split(b"\n") if whole or b"\n" in b"".join(chunks) else []
    expected = [line if len(line) < LINE_BYTES else "too long" for line in sent]
    if len(rest) >= LINE_BYTES:
        expected.append("too long")  # said before its end has come
    assert got == expected


def test_a_line_of_the_longest_length_is_whole(ends):
    connection, theirs = ends
    theirs.sendall(b"x" * (LINE_BYTES - 1) + b"\n")
    connection.receive()
    assert lines_of(connection) == [b"x" * (LINE_BYTES - 1)]


def test_it_says_whether_there_is_a_line_before_it_gives_one(ends):
    connection, theirs = ends
    assert not connection.has_line
    theirs.sendall(b"one\ntw")
    connection.receive()
    assert connection.has_line
    assert connection.next_line() == b"one"
    assert not connection.has_line
    theirs.sendall(b"o" * LINE_BYTES)
    connection.receive()
    assert connection.has_line  # which is too long
    assert lines_of(connection) == ["too long"]
    assert not connection.has_line


def test_an_end_is_noticed_and_what_came_before_is_kept(ends):
    connection, theirs = ends
    theirs.sendall(b"last\n")
    theirs.shutdown(socket.SHUT_WR)
    connection.receive()
    assert not connection.ended
    connection.receive()
    assert connection.ended
    assert lines_of(connection) == [b"last"]


def test_tokens_come_back_at_their_rate_and_no_more_than_the_burst(ends):
    connection, _ = ends
    assert [connection.rate.take(0.0) for _ in range(11)] == [True] * 10 + [False]
    assert not connection.rate.take(0.0099)
    assert connection.rate.take(0.0101)
    assert not connection.rate.take(0.0102)
    assert [connection.rate.take(1000.0) for _ in range(11)] == [True] * 10 + [False]


def test_answers_come_out_whole_and_in_order_however_little_the_kernel_takes(ends):
    connection, theirs = ends
    text = bytearray()
    for number in range(20_000):
        connection.put(Answer(id=number, outcome="played", age_ms=1.5))
        connection.flush()
        if number % 500 == 499:
            try:
                text += theirs.recv(50_000)
            except BlockingIOError:
                connection.flush()
    while connection.unsent:
        connection.flush()
        text += theirs.recv(1 << 20)
    assert [json.loads(line)["id"] for line in text.splitlines()] == list(range(20_000))
    assert not connection.leaving_reason


def test_one_that_does_not_read_is_asked_to_leave_behind_what_it_can_still_read(ends):
    connection, theirs = ends
    number = 0
    while not connection.leaving_reason:
        connection.put(Answer(id=number, outcome="played"))
        connection.flush()
        number += 1
        assert number < 100_000
    connection.put(Answer(id=-1, outcome="played"))
    text = bytearray()
    while connection.unsent:
        text += theirs.recv(1 << 20)
        connection.flush()
    text += theirs.recv(1 << 20)
    messages = [json.loads(line) for line in text.splitlines()]
    assert [message["id"] for message in messages[:-1]] == list(range(number - 1))
    assert messages[-1] == {"kind": "farewell", "reason": "it does not read what it is sent"}
    assert sum(map(len, text.splitlines(keepends=True))) > QUEUE_BYTES


def test_one_that_has_closed_takes_no_more_answers(ends):
    connection, theirs = ends
    theirs.close()
    connection.put(Answer(id=1, outcome="played"))
    connection.flush()
    assert connection.deaf
    assert not connection.unsent


def test_the_next_client_finds_nothing_of_the_one_before(ends):
    connection, theirs = ends
    theirs.sendall(b"secret\nmore" + b"x" * LINE_BYTES)
    connection.receive()
    lines_of(connection)
    connection.receive()
    connection.put(Answer(id="secret", outcome="played"))
    connection.topics.add("touches")
    connection.deaf = True
    connection.waiting = 3
    while connection.rate.take(0.0):
        pass
    connection.close()
    ours, other = socket.socketpair()
    ours.setblocking(False)
    connection.begin(ours, 2, 0.0)
    kept = (connection.topics, connection.ended, connection.deaf, connection.unsent, connection.has_line)
    assert not any(kept)
    assert connection.waiting == 0
    other.sendall(b"own\n")
    connection.receive()
    assert lines_of(connection) == [b"own"]
    assert connection.rate.take(0.0)
    other.close()
