"""The application socket as its clients see it: every line answered exactly once, and nobody can hold up the loop."""

import gc
import json
import resource
import socket
import sys
import tracemalloc
from collections import Counter
from pathlib import Path
from unittest.mock import ANY

import pytest
from alone import alone
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.application_socket.command_socket import LINES_A_CLIENT, LINES_A_TURN
from controller.device.application_socket.connections.clients import ACCEPTS_A_TURN, LEAVE_S, PAUSE_S
from controller.device.application_socket.connections.peers import Peer
from controller.device.application_socket.protocol.client_messages import LINE_BYTES
from controller.device.application_socket.requests.pending_commands import WAITING_PER_CLIENT
from controller.device.application_socket.requests.questions import FIGURES_S
from controller.device.loop.commands import CommandSource, Outcome
from controller.device.touch.source import TouchSample

KINDS = (
    "'play', 'clip', 'regions', 'transform', 'arm', 'disarm', 'stop', 'load_scene', 'save_scene', 'test_channel', 'trace',"
    " 'subscribe', 'unsubscribe', 'figures', 'state', 'describe', 'hello'"
)
ORDINARY = Peer(50_001, 11, frozenset())  # may play alone
POINT = {"kind": "play", "effect": "click", "x_mm": 100, "y_mm": 70}

FILES = Path("/proc/self/fd")


def open_files():
    gc.collect()  # what other tests left open
    return len(list(FILES.iterdir()))


def balanced(panel):
    """Every line that came was answered, or waits."""
    counters = panel.socket.counters
    answered = counters.played + counters.merged + counters.skipped + counters.refused + counters.done
    return counters.lines == answered + panel.socket.waiting


def test_it_is_what_the_loop_asks_for(panel):
    source: CommandSource = panel.socket  # checked by mypy in device code; here: every method is there
    for name in ("fileno", "next_time_s", "serve", "touches", "outcome", "loaded", "close"):
        assert callable(getattr(source, name))


def test_a_command_reaches_the_loop_in_si_units_and_is_answered_once_with_its_id_and_age(panel):
    client = panel.connect()
    assert panel.ask(client, {**POINT, "amplitude": 0.5, "id": "mine"}) == []
    ((ticket, *command),) = panel.control.plays
    assert command == ["click", 0.1, pytest.approx(0.07), None, 0.5]
    panel.socket.outcome(ticket, Outcome.PLAYED, 3.2104e-3)
    panel.settle()
    assert panel.ask(client) == [{"kind": "answer", "id": "mine", "outcome": "played", "age_ms": 3.21}]
    panel.socket.outcome(ticket, Outcome.PLAYED, 3.2e-3)
    assert panel.ask(client) == []
    assert panel.socket.counters.stray_outcomes == 1
    assert panel.socket.counters.played == 1


@pytest.mark.parametrize("outcome", list(Outcome))
def test_every_outcome_is_reported_and_counted(panel, outcome):
    client = panel.connect()
    panel.ask(client, {**POINT, "id": 5})
    panel.socket.outcome(panel.control.plays[0][0], outcome, 0.0)
    assert panel.ask(client) == [{"kind": "answer", "id": 5, "outcome": outcome.value, "age_ms": 0.0}]
    assert getattr(panel.socket.counters, outcome.value) == 1
    assert balanced(panel)


def test_answers_go_to_who_asked_whatever_the_order_of_outcomes(panel):
    one, other = panel.connect(), panel.connect()
    panel.ask(one, {**POINT, "id": 1}, {**POINT, "id": 2})
    panel.ask(other, {**POINT, "id": 1})
    tickets = [ticket for ticket, *_ in panel.control.plays]
    for ticket, outcome in zip(reversed(tickets), (Outcome.SKIPPED, Outcome.MERGED, Outcome.PLAYED), strict=True):
        panel.socket.outcome(ticket, outcome, 0.0)
    assert [(answer["id"], answer["outcome"]) for answer in panel.ask(one)] == [(2, "merged"), (1, "played")]
    assert [(answer["id"], answer["outcome"]) for answer in panel.ask(other)] == [(1, "skipped")]


def test_for_a_finger_no_place_is_needed(panel):
    panel.ask(panel.connect(), {"kind": "play", "effect": "buzz", "finger": 17})
    assert panel.control.plays == [(ANY, "buzz", 0.0, 0.0, 17, 1.0)]


def test_without_an_amplitude_it_is_the_most_that_the_board_allows(panel_with):
    panel = panel_with(max_amplitude=0.6)
    client = panel.connect()
    panel.ask(client, POINT)
    assert panel.control.plays[0][-1] == 0.6
    (answer,) = panel.ask(client, {**POINT, "amplitude": 0.61})
    assert answer["reason"] == "amplitude = 0.61 is not 0.1 to 0.6"


@pytest.mark.parametrize("edge", [{"x_mm": 0}, {"x_mm": 210}, {"y_mm": 0}, {"y_mm": 148}, {"amplitude": 0.1}, {"amplitude": 1}])
def test_the_very_edges_are_accepted(panel, edge):
    panel.ask(panel.connect(), POINT | edge)
    assert len(panel.control.plays) == 1


@each_row(
    ("line", "reason"),
    [
        (POINT | {"x_mm": -0.1}, "x_mm = -0.1 is off the plate (0 to 210)"),
        (POINT | {"x_mm": 210.1}, "x_mm = 210.1 is off the plate (0 to 210)"),
        (POINT | {"y_mm": 148.1}, "y_mm = 148.1 is off the plate (0 to 148)"),
        (POINT | {"y_mm": -1}, "y_mm = -1 is off the plate (0 to 148)"),
        (POINT | {"amplitude": 0.0999}, "amplitude = 0.0999 is not 0.1 to 1"),
        (POINT | {"amplitude": -1}, "amplitude = -1 is not 0.1 to 1"),
        (POINT | {"finger": 3}, "either x_mm and y_mm, or finger, or region"),
        ({"kind": "play", "effect": "click", "x_mm": 3}, "either x_mm and y_mm, or finger, or region"),
        ({"kind": "play", "effect": "click", "y_mm": 3}, "either x_mm and y_mm, or finger, or region"),
        ({"kind": "play", "effect": "click"}, "either x_mm and y_mm, or finger, or region"),
        ({"kind": "play", "effect": "click", "finger": -1}, "finger = -1: must be a whole number from 0 to 9007199254740992"),
        (POINT | {"x_mm": "100"}, "x_mm = '100': must be a number in mm"),
        (POINT | {"amplitud": 1}, "amplitud = 1: unknown key; did you mean amplitude?"),
        (POINT | {"effect": ""}, "effect = '': must be a text of 1 to 64 characters"),
        (POINT | {"effect": "no such"}, "effect 'no such' is unknown"),
        (
            {"kind": "pause"},
            f"kind = 'pause': must be one of {KINDS}",
        ),
        (
            {"kind": "subscribe", "to": ["touch"]},
            "to[0] = 'touch': must be one of 'contacts', 'description', 'emissions', 'faults', 'log', 'state', 'touches';"
            " did you mean touches?",
        ),
        (
            {"effect": "click"},
            f"kind is missing: one of {KINDS}",
        ),
        (
            {"kind": "load_scene", "name": "../../etc/passwd"},
            "name = '../../etc/passwd': must be a text that matches ^[A-Za-z0-9][A-Za-z0-9_-]{0,63}$",
        ),
        (
            {"kind": "save_scene", "name": "../mine", "toml": ""},
            "name = '../mine': must be a text that matches ^[A-Za-z0-9][A-Za-z0-9_-]{0,63}$",
        ),
        ({"kind": "load_scene", "name": "broken"}, "broken.toml: not valid TOML"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_the_reason(panel, line, reason):
    with panel.connect() as client:
        (answer,) = panel.ask(client, {**line, "id": 9})
    assert answer == {"kind": "answer", "id": 9, "outcome": "refused", "reason": reason}
    assert panel.control.plays == panel.control.scenes == []
    assert balanced(panel)


@each_row(
    ("line", "number"),
    [
        (b"\n", None),
        (b"hello\n", None),
        (b'"hello"\n', None),
        (b'{"kind": "play"\n', None),
        (b'{"id": 3, "kind": "play", "effect": "click", "x_mm": NaN, "y_mm": 1}\n', None),
        (b'{"id": 3, "kind": "play", "effect": "click", "x_mm": 1e999, "y_mm": 1}\n', 3),
        (b'{"id": 3, "kind": "play", "effect": "click\xff", "x_mm": 1, "y_mm": 1}\n', 3),
        (b'{"id": "\xff", "kind": "hello"}\n', None),
        (b'{"id": 99999999999999999999, "kind": "hello"}\n', None),
        (b'{"id": 1.5, "kind": "hello"}\n', None),
        (b'{"id": 3, "kind": "hello", "\xff": 1}\n', 3),
        (b'{"id": "' + b"x" * 65 + b'", "kind": "hello"}\n', None),
        (b'{"id": 4, "x": ' + b"[" * 4000 + b"]" * 4000 + b"}\n", 4 if sys.version_info >= (3, 12) else None),  # read that deep
        (b"\x00\xff\x7fELF\x1b[2J\n", None),
    ],
)
def test_what_is_not_a_request_is_refused_with_its_id_where_that_can_be_reported(panel, line, number):
    before = panel.socket.counters.not_valid
    with panel.connect() as client:
        (answer,) = panel.ask(client, line)
        assert (answer["outcome"], answer["id"]) == ("refused", number)
        assert 0 < len(answer["reason"]) <= 200 or answer["reason"] == f"kind is missing: one of {KINDS}"
        assert panel.ask(client, {"kind": "subscribe", "id": 1}) == [{"kind": "answer", "id": 1, "outcome": "done"}]
    assert panel.socket.counters.not_valid == before + 1


def test_hello_tells_what_an_interface_has_to_know(panel):
    (answer,) = panel.ask(panel.connect(), {"kind": "hello", "id": 1})
    assert answer["board"] == "simulated"
    assert (answer["length_mm"], answer["width_mm"], answer["effects"]) == (210, 148, ["click", "buzz"])


def test_figures_are_reported_and_not_counted_anew_for_each_who_asks(panel):
    client = panel.connect()
    answers = panel.ask(client, *[{"kind": "figures", "id": number} for number in range(20)])
    assert [answer["id"] for answer in answers] == list(range(20))
    assert answers[0]["figures"].items() >= {"emissions": 7, "nothing": None}.items()
    assert [answer["figures"]["application_socket"]["lines"] for answer in answers] == list(range(1, 21))
    assert panel.control.times_reported == 1
    panel.now_s += FIGURES_S
    panel.ask(client, {"kind": "figures"})
    assert panel.control.times_reported == 2


def test_figures_too_long_for_the_queue_are_refused_and_the_client_stays(panel):
    client = panel.connect()
    panel.control.figures = lambda: {"histogram": list(range(20_000))}
    (answer,) = panel.ask(client, {"kind": "figures", "id": 1})
    assert answer["outcome"] == "refused"
    assert answer["reason"].endswith("bytes, more than 65536")
    assert len(panel.ask(client, {"kind": "hello"})) == 1
    assert balanced(panel)


def test_a_scene_to_save_may_be_as_long_as_regions_of_whoever_operates(panel):
    toml = "#" * (2 * LINE_BYTES)
    client = panel.connect()
    assert panel.ask(client, {"kind": "save_scene", "name": "mine", "toml": toml, "id": 1}) == []
    ((ticket, _),) = panel.control.scenes
    assert panel.control.saved == [("mine", toml)]
    panel.socket.loaded(ticket, "mine.toml: no room")
    assert panel.ask(client) == [{"kind": "answer", "id": 1, "outcome": "refused", "reason": "mine.toml: no room"}]
    assert balanced(panel)


def test_a_scene_is_answered_when_it_is_in_force_or_refused(panel):
    client = panel.connect()
    assert (
        panel.ask(client, {"kind": "load_scene", "name": "drums", "id": 1}, {"kind": "load_scene", "name": "drums2", "id": 2}) == []
    )
    (first, _), (second, name) = panel.control.scenes
    assert name == "drums2"
    panel.socket.loaded(second, "drums2.toml: cannot be read")
    panel.socket.loaded(first, "")
    assert panel.ask(client) == [
        {"kind": "answer", "id": 2, "outcome": "refused", "reason": "drums2.toml: cannot be read"},
        {"kind": "answer", "id": 1, "outcome": "done"},
    ]
    assert balanced(panel)


def test_touches_come_to_those_who_subscribed_until_they_unsubscribe(panel):
    one, other = panel.connect(), panel.connect()
    panel.ask(one, {"kind": "subscribe"})
    panel.ask(other, {"kind": "hello"})
    panel.socket.touches([TouchSample(3, 0.1, 0.0701234, 12.5, True, 9e-3), TouchSample(4, 0.02, 0.03, 12.5, False)])
    assert panel.ask(one) == [
        {"kind": "touch", "finger": 3, "x_mm": 100.0, "y_mm": 70.123, "time_s": 12.5, "contact": True, "size_mm": 9.0},
        {"kind": "touch", "finger": 4, "x_mm": 20.0, "y_mm": 30.0, "time_s": 12.5, "contact": False, "size_mm": 0.0},
    ]
    panel.ask(one, {"kind": "subscribe"}, {"kind": "unsubscribe"})
    panel.socket.touches([TouchSample(3, 0.1, 0.07, 12.6, True)])
    assert panel.ask(one) == panel.ask(other) == []


def test_a_flood_is_refused_line_by_line_and_read_no_faster_than_the_loop_can_bear(panel_with):
    panel = panel_with(commands_per_s=100, burst=10)
    client = panel.connect()
    panel.settle()
    client.sendall(b"".join(json.dumps({**POINT, "id": number}).encode() + b"\n" for number in range(1000)))
    started_s, turns = panel.now_s, panel.settle()
    answers = panel.ask(client)
    refused = [answer["id"] for answer in answers if answer.get("reason") == "rate"]
    assert len(refused) + len(panel.control.plays) == 1000
    assert refused == sorted(refused)
    played = 10 + (panel.now_s - started_s) * 100
    assert len(panel.control.plays) == pytest.approx(played, abs=1)
    assert turns >= 1000 / LINES_A_CLIENT
    assert panel.now_s - started_s >= 1000 / LINES_A_CLIENT * PAUSE_S * 0.8
    assert panel.socket.counters.over_rate == len(refused)


def test_one_who_floods_takes_no_tokens_and_no_turns_of_another(panel_with):
    panel = panel_with(commands_per_s=100, burst=10)
    flooding, polite = panel.connect(), panel.connect()
    panel.settle()
    flooding.sendall(b"{}\n" * 20_000)
    polite.sendall(json.dumps({**POINT, "id": 1}).encode() + b"\n")
    panel.turn()
    panel.turn()
    assert len(panel.control.plays) == 1


def test_a_turn_handles_no_more_lines_than_it_may_whoever_sent_them(panel_with):
    panel = panel_with(max_clients=8, commands_per_s=10_000, burst=10_000)
    for client in [panel.connect() for _ in range(8)]:
        client.sendall(b'{"kind": "unsubscribe"}\n' * 100)
    before = 0
    while panel.turn():
        assert panel.socket.counters.lines - before <= LINES_A_TURN
        before = panel.socket.counters.lines
    assert before == 800
    assert balanced(panel)


def test_every_client_has_its_turn(panel_with, read_all):
    panel = panel_with(max_clients=8, commands_per_s=10_000, burst=10_000)
    clients = [panel.connect() for _ in range(8)]
    panel.settle()
    for client in clients:
        client.sendall(b'{"kind": "unsubscribe"}\n' * 100)
    for _ in range(8 * LINES_A_CLIENT // LINES_A_TURN):
        panel.turn()
    assert [len(read_all(client)) for client in clients].count(0) == 0


def test_more_commands_than_can_wait_are_refused_until_one_has_its_outcome(panel_with):
    panel = panel_with(burst=1000)
    client = panel.connect()
    answers = panel.ask(client, *[{**POINT, "id": number} for number in range(WAITING_PER_CLIENT + 1)])
    assert [answer["id"] for answer in answers] == [WAITING_PER_CLIENT]
    assert answers[0]["reason"] == f"{WAITING_PER_CLIENT} commands wait for their outcome already"
    panel.socket.outcome(panel.control.plays[0][0], Outcome.PLAYED, 0.0)
    panel.ask(client, {**POINT, "id": "again"})
    assert len(panel.control.plays) == WAITING_PER_CLIENT + 1


def test_a_client_too_many_is_informed_and_the_next_finds_the_place_of_one_that_left(panel_with):
    panel = panel_with(max_clients=2)
    first, second, third = (panel.connect() for _ in range(3))
    assert panel.ask(third) == [{"kind": "farewell", "reason": "2 clients are connected already"}]
    assert panel.socket.counters.turned_away == 1
    first.close()
    panel.settle()
    fourth = panel.connect()
    assert len(panel.ask(fourth, {"kind": "hello"})) == 1
    assert len(panel.ask(second, {"kind": "hello"})) == 1


def test_a_thousand_connections_leave_nothing_behind(panel):
    stays = panel.connect()
    panel.ask(stays, {"kind": "hello"})
    files = open_files()
    for number in range(1000):
        client = socket.socket(socket.AF_UNIX)
        client.connect(panel.settings.path)
        if number % 3 == 0:
            client.sendall(b'{"kind": "subscribe"}\n{"kind": "pl')
        if number % 3 == 1:
            client.sendall(json.dumps({**POINT, "id": number}).encode() + b"\n")
        client.close()
        accepted = panel.socket.counters.clients_accepted
        panel.turn()
        assert panel.socket.counters.clients_accepted - accepted <= ACCEPTS_A_TURN
        if number % 10 == 9:
            panel.settle()
    panel.settle()
    assert open_files() == files
    assert panel.socket.counters.clients_accepted == 1001
    (figures,) = panel.ask(panel.connect(), {"kind": "figures", "id": 1})
    reported = figures["figures"]["application_socket"]
    assert (reported["clients_connected"], reported["clients_accepted"]) == (2, 1002), "one stayed, and this one asks"
    assert len(panel.control.plays) == 333  # what was sent before hanging up still counts
    for ticket, *_ in panel.control.plays:
        panel.socket.outcome(ticket, Outcome.PLAYED, 0.0)
    assert panel.socket.counters.unanswered == 333
    assert panel.socket.waiting == 0
    assert len(panel.ask(stays, {"kind": "hello"})) == 1
    assert balanced(panel)


def test_without_files_left_clients_wait_and_nobody_suffers(panel):
    client = panel.connect()
    panel.settle()
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    late = socket.socket(socket.AF_UNIX)
    free = min(set(range(4096)) - set(map(int, (path.name for path in FILES.iterdir()))))
    resource.setrlimit(resource.RLIMIT_NOFILE, (free, limits[1]))
    try:
        late.connect(panel.settings.path)
        client.sendall(b'{"kind": "subscribe", "id": 1}\n')
        for _ in range(10):
            panel.socket.serve(panel.now_s, panel.control)
            panel.now_s += 0.01
        assert json.loads(client.recv(1000))["outcome"] == "done"
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)
    late.sendall(b'{"kind": "subscribe", "id": 2}\n')
    panel.settle()
    assert json.loads(late.recv(1000))["id"] == 2
    late.close()


def test_one_that_shuts_its_writing_end_still_gets_all_its_answers_and_then_the_end(panel):
    client = panel.connect()
    client.sendall(
        json.dumps({**POINT, "id": 1}).encode()
        + b"\n"
        + json.dumps({**POINT, "id": 2}).encode()
        + b'\n{"kind": "hello", "id": 3}\n'
    )
    client.shutdown(socket.SHUT_WR)
    assert [answer["id"] for answer in panel.ask(client)] == [3]
    panel.socket.outcome(panel.control.plays[0][0], Outcome.PLAYED, 0.0)
    panel.settle()
    with pytest.raises(BlockingIOError):
        client.recv(10_000) and client.recv(1)
    panel.socket.outcome(panel.control.plays[1][0], Outcome.MERGED, 0.0)
    panel.settle()
    assert json.loads(client.recv(1000))["id"] == 2
    assert client.recv(1) == b""


def test_a_subscriber_that_shuts_its_writing_end_hears_of_touches_until_it_closes(panel):
    client = panel.connect()
    client.sendall(b'{"kind": "subscribe"}\n')
    client.shutdown(socket.SHUT_WR)
    panel.ask(client)
    panel.socket.touches([TouchSample(3, 0.1, 0.07, 1.0, True)])
    assert panel.ask(client)[0]["finger"] == 3
    files = open_files()
    client.close()
    panel.settle()
    assert open_files() == files - 2


def test_one_that_stalls_in_the_middle_of_a_line_holds_up_nobody(panel):
    stalled, other = panel.connect(), panel.connect()
    assert panel.ask(stalled, b'{"kind": "hel') == []
    assert panel.socket.next_time_s() == float("inf")
    assert len(panel.ask(other, {"kind": "hello"})) == 1
    assert len(panel.ask(stalled, b'lo"}\n')) == 1


def test_one_that_does_not_read_is_asked_to_leave_and_then_gone_within_a_second(panel_with):
    panel = panel_with(commands_per_s=10_000, burst=10_000)
    deaf = panel.connect()
    panel.ask(deaf, {"kind": "subscribe"})
    samples = [TouchSample(finger, 0.1, 0.07, 1.0, True) for finger in range(10)]
    for _ in range(2000):
        panel.socket.touches(samples)
    assert panel.turn()
    assert panel.socket.counters.slow_readers == 1
    before_s, files = panel.now_s, open_files()
    panel.settle()
    assert panel.now_s - before_s <= LEAVE_S
    assert open_files() == files - 1
    panel.socket.touches(samples)


def test_one_that_reads_again_in_time_learns_why(panel):
    slow = panel.connect()
    panel.ask(slow, {"kind": "subscribe"})
    for _ in range(4000):
        panel.socket.touches([TouchSample(1, 0.1, 0.07, 1.0, True)])
    panel.turn()
    text = bytearray()
    while True:
        try:
            more = slow.recv(1 << 16)
        except BlockingIOError:
            panel.turn()
            continue
        if not more:
            break
        text += more
    last = json.loads(text.splitlines()[-1])
    assert last == {"kind": "farewell", "reason": "it does not read what it is sent"}


def test_the_end_of_the_service_is_reported(panel_with):
    panel = panel_with()
    client = panel.connect()
    panel.settle()
    panel.socket.close()
    assert json.loads(client.recv(1000)) == {"kind": "farewell", "reason": "the service ends"}
    assert not Path(panel.settings.path).exists()


def test_a_line_too_long_is_refused_once_and_the_next_is_read(panel):
    client = panel.connect(ORDINARY)
    answers = panel.ask(client, b"x" * 50_000, b"\n", {"kind": "subscribe", "id": 1})
    client.setblocking(False)
    assert [(answer["id"], answer.get("reason")) for answer in answers] == [
        (None, f"a line is at most {LINE_BYTES} bytes"),
        (1, None),
    ]


places = st.floats(allow_nan=False, allow_infinity=False)
fixed = [
    {"kind": "hello", "id": 1},
    {"kind": "subscribe", "id": 2},
    {"kind": "load_scene", "name": "a", "id": 3},
    {"kind": "figures", "id": "f"},
]
requests = st.builds(lambda number, x: POINT | {"id": number, "x_mm": x}, st.integers(0, 1000), places) | st.sampled_from(fixed)
valid = requests.map(lambda request: json.dumps(request).encode() + b"\n")
junk = st.binary(max_size=60) | st.sampled_from([b"\n", b"{}\n", b'{"kind":"play"}\n', b"q" * 9000, b'{"id":1}' + b"\n" * 30])
sent = st.lists(st.tuples(st.integers(0, 2), valid | junk, st.integers(0, 3)), max_size=30)


@settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(sent, st.randoms(use_true_random=False))
def test_whatever_clients_send_every_line_is_answered_once_and_no_exception_comes(panel_with, read_all, chunks, random):
    """Lines of three clients in any pieces, with turns and outcomes in any order in between."""
    panel = panel_with(burst=20)
    clients = [panel.connect() for _ in range(3)]
    streams, answers = [b"", b"", b""], [[], [], []]
    decided = 0

    def decide():
        nonlocal decided
        waiting = [ticket for ticket, *_ in panel.control.plays[decided:]]
        decided += len(waiting)
        random.shuffle(waiting)
        for ticket in waiting:
            panel.socket.outcome(ticket, random.choice(list(Outcome)), 1e-3)
        while panel.control.scenes:
            panel.socket.loaded(panel.control.scenes.pop()[0], "")

    for which, chunk, turns in chunks:
        panel.send(clients[which], chunk)
        streams[which] += chunk
        for _ in range(turns):
            panel.turn()
        if turns == 2:
            decide()
    panel.settle()
    decide()
    panel.settle()
    for which, (client, stream) in enumerate(zip(clients, streams, strict=True)):
        answers[which] += read_all(client)
        *lines, rest = stream.split(b"\n")
        assert len(answers[which]) == len(lines) + (len(rest) >= panel.settings.layer_bytes)
        wanted = Counter(json.loads(line)["id"] for line in lines if line.startswith(b'{"kind": ') and line.endswith(b"}"))
        assert not wanted - Counter(answer["id"] for answer in answers[which])
    assert panel.socket.waiting == panel.socket.counters.stray_outcomes == panel.socket.counters.unanswered == 0
    assert balanced(panel)
    panel.close()


def test_all_blocks_that_a_command_allocates_are_together_less_than_a_kilobyte_and_none_stays(panel_with):
    panel = panel_with(commands_per_s=10_000, burst=10_000)
    client = panel.connect()
    line = json.dumps({**POINT, "id": 123_456, "amplitude": 0.5}).encode() + b"\n"
    buffer = bytearray(4096)
    panel.settle()

    def rounds(count):
        for _ in range(count):
            client.send(line)
            panel.socket.serve(panel.now_s, panel.control)
            panel.socket.outcome(panel.control.plays.pop()[0], Outcome.PLAYED, 1e-3)
            client.recv_into(buffer)
            panel.now_s += 0.01

    def traced():
        rounds(200)
        gc.disable()
        tracemalloc.start(1)
        rounds(50)
        start, _ = tracemalloc.get_traced_memory()
        tracemalloc.reset_peak()
        rounds(200)
        left, peak = tracemalloc.get_traced_memory()
        assert buffer.startswith(b'{"kind":"answer","id":123456,"outcome":"played"')
        return left - start, peak - start

    kept_bytes, most_bytes = alone(traced)
    assert kept_bytes < 512
    assert most_bytes < 1024


def test_touches_that_the_kernel_does_not_take_at_once_arrive_when_the_client_reads(panel, read_all):
    slow = panel.connect()
    panel.ask(slow, {"kind": "subscribe"})
    for number in range(700):  # more than the kernel keeps, less than the queue
        panel.socket.touches([TouchSample(number, 0.1, 0.07, 1.0, True)])
    assert panel.turn()
    got = []
    while more := read_all(slow):
        got += more
        panel.settle()
    assert [touch["finger"] for touch in got] == list(range(700))


def test_one_whose_last_outcome_another_clients_command_brings_about_is_let_go(panel):
    one, other = panel.connect(), panel.connect()
    panel.ask(one, {**POINT, "id": 1})
    one.shutdown(socket.SHUT_WR)
    panel.ask(other, {"kind": "hello"})  # the turn after this begins behind the other
    ((ticket, *_),) = panel.control.plays
    panel.control.play = lambda *_: panel.socket.outcome(ticket, Outcome.MERGED, 0.0)
    panel.ask(other, POINT)
    assert json.loads(one.recv(1000))["outcome"] == "merged"
    assert one.recv(1) == b""
