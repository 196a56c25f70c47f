"""Frames of a page, and what waits for it."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.device.application_socket.protocol.client_messages import LINE_BYTES
from controller.device.application_socket.token_bucket import TokenBucket
from controller.device.page.outbox import Outbox, TooSlow
from controller.device.page.requests import FRAME_BYTES, evaluated

ALL = frozenset({"look", "play", "regions", "operate"})
PLAYS = frozenset({"look", "play"})


def full(per_s, burst):
    bucket = TokenBucket(per_s, burst)
    bucket.fill(0.0)
    return bucket


def judge(frame, rights=ALL):
    line, answer = evaluated(frame, rights, full(1000, 1000), 0.0)
    assert bool(line) != bool(answer)
    return line or json.loads(answer)


def test_a_frame_becomes_one_line():
    line = judge('{"kind":\n "play", "effect": "a\\nb", "id": 1}')
    assert json.loads(line) == {"kind": "play", "effect": "a\nb", "id": 1}
    assert line.count(b"\n") == 1


def test_the_panel_reads_what_was_evaluated():
    """Two values of one key, of which either may count: what is passed on has one."""
    assert judge('{"kind": "arm", "kind": "stop"}', PLAYS) == b'{"kind":"stop"}\n'
    assert judge('{"kind": "stop", "kind": "arm", "id": 5}', PLAYS)["outcome"] == "refused"


@each_row(
    "frame",
    [
        "",
        "7",
        "[]",
        "null",
        '"stop"',
        "{",
        '{"kind": NaN}',
        '{"kind": "play", "x_mm": Infinity}',
        '{"kind": ["stop"]}',
        '{"kind": "hack"}',
        "{}",
        "[" * 60000,
        '{"kind": "play", "a": ' + "[" * 50000,
        '{"kind": "play", "id": "\\ud800"}',
        "\x00",
    ],
)
def test_what_is_no_request_is_refused(frame):
    assert judge(frame)["outcome"] == "refused"


def test_lines_have_the_lengths_that_the_panel_takes():
    assert judge(json.dumps({"kind": "play", "effect": "x" * LINE_BYTES}))["reason"] == f"longer than {LINE_BYTES} bytes"
    assert isinstance(judge(json.dumps({"kind": "regions", "regions": ["x" * LINE_BYTES]})), bytes)
    assert judge(json.dumps({"kind": "regions", "regions": ["x" * FRAME_BYTES]}))["outcome"] == "refused"


@given(st.text(max_size=200))
def test_any_text_gets_one_line_or_one_answer(frame):
    judge(frame)


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
        lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
        max_leaves=20,
    )
)
def test_any_json_gets_one_line_or_one_answer(value):
    for frame in (json.dumps(value), json.dumps({"kind": "play", "id": value}), json.dumps({"kind": "play", "x_mm": value})):
        judge(frame)


def test_ids_come_back_where_they_are_valid():
    for number in (7, "a"):
        assert judge(json.dumps({"kind": "arm", "id": number}), PLAYS)["id"] == number
    for number in ([], "x" * 65, 1.5):
        assert judge(json.dumps({"kind": "arm", "id": number}), PLAYS)["id"] is None


def test_the_rate_is_refused_beyond_its_burst_and_never_for_a_stop():
    rate = full(10, 3)
    outcomes = [bool(evaluated('{"kind": "state"}', ALL, rate, 0.0)[0]) for _ in range(5)]
    assert outcomes == [True, True, True, False, False]
    assert evaluated('{"kind": "stop"}', ALL, rate, 0.0)[0]
    assert evaluated('{"kind": "state"}', ALL, rate, 0.1)[0]
    assert not evaluated('{"kind": "state"}', ALL, rate, 0.1)[0]
    assert evaluated('{"kind": "state"}', ALL, rate, math.inf)[0]


def test_a_long_line_counts_as_several():
    long = json.dumps({"kind": "regions", "regions": ["x" * (3 * LINE_BYTES)]})
    for burst in (3, 4, 5):  # of a smaller one it takes all
        rate = full(1, burst)
        assert evaluated(long, ALL, rate, 0.0)[0]
        assert bool(evaluated('{"kind": "state"}', ALL, rate, 0.0)[0]) == (burst == 5)


def touch(finger, x_mm, contact=True):
    return json.dumps({"kind": "touch", "finger": finger, "x_mm": x_mm, "contact": contact}).encode() + b"\n"


def test_a_page_that_slept_gets_the_newest_touch_of_each_finger():
    box = Outbox()
    for line in (touch(1, 1), touch(2, 5), b'{"kind": "answer", "id": 3}\n', touch(1, 2), touch(2, 6, contact=False)):
        box.put(line)
    assert [json.loads(box.take()).get("x_mm") for _ in range(len(box))] == [None, 2, 6]


def test_the_last_state_waits_and_every_answer():
    box = Outbox()
    for line in (
        b'{"kind":"state","id":null,"state":"armed"}',
        b'{"kind":"state","id":1,"state":"armed"}',
        b'{"kind":"state","id":null,"state":"idle"}',
    ):
        box.put(line)
    assert [json.loads(box.take())["state"] for _ in range(len(box))] == ["armed", "idle"]


def test_what_waits_is_bounded_and_counted_as_it_goes():
    box = Outbox(bytes_max=100)
    for _ in range(1000):
        box.put(b"x" * 60)
        box.take()
    for i in range(1000):
        box.put(touch(1, i)[:90])
        box.take()
    box.put(b"x" * 60)
    with pytest.raises(TooSlow):
        box.put(b"x" * 60)
