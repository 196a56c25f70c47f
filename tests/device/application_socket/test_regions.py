"""A client's regions: who may send them, how many, how long and how often, and that they go with their client."""

import contextlib
import grp
import json
import os
import signal
import socket

import pytest
from tables import each_row

from controller.device.application_socket.connections.connection import LAYER_BURST
from controller.device.application_socket.connections.peers import Peer
from controller.device.application_socket.protocol.client_messages import LINE_BYTES
from controller.device.loop.preparation import AcceptedLayer, LayerResult
from controller.device.scene.layers import Placement, RefusedRegion

REGIONS_GROUP, OPERATE_GROUP = [group for group in grp.getgrall() if group.gr_gid not in (0, os.getegid(), 65534)][:2]
PAGE = Peer(50_001, 11, frozenset({50_001, REGIONS_GROUP.gr_gid}))
OTHER = Peer(50_002, 12, frozenset({50_002}))
REGION = {"name": "ok", "shape": "rectangle", "x_mm": 20, "y_mm": 30, "width_mm": 40, "height_mm": 12, "effects": ["click"]}
REGIONS = {"kind": "regions", "regions": [REGION]}
MOVE = {"kind": "transform", "x_mm": 5, "y_mm": -2, "scale": 2}


@pytest.fixture
def panel(panel_with):
    return panel_with(regions_group=REGIONS_GROUP.gr_name, play_group=OPERATE_GROUP.gr_name)


def in_force(panel, refused=()):
    """The loop takes over the newest layer."""
    layer = AcceptedLayer((), None, 0, refused, len(refused))
    panel.socket.layered(panel.control.layers[-1][0], LayerResult(2e-3, layer))


def test_who_may_only_lay_regions_does_that_and_no_more(panel):
    client = panel.connect(PAGE)
    (hello,) = panel.ask(client, {"kind": "hello", "id": 1})
    assert hello["rights"] == ["regions"]
    assert panel.ask(client, {**REGIONS, "id": 2}) == []
    in_force(panel)
    assert panel.ask(client) == [
        {"kind": "layer", "id": 2, "regions": 0, "off_plate": 0, "age_ms": 2.0, "refused": [], "refused_count": 0}
    ]
    assert panel.ask(client, {**MOVE, "id": 3}) == [{"kind": "answer", "id": 3, "outcome": "done"}]
    assert panel.control.moves == [(panel.control.layers[0][1], Placement(5e-3, -2e-3, 2.0))]
    for forbidden in ({"kind": "play", "effect": "click", "x_mm": 1, "y_mm": 1}, {"kind": "arm"}, {"kind": "subscribe"}):
        (answer,) = panel.ask(client, forbidden)
        assert "does not have the right to" in answer["reason"]
    assert panel.control.plays == panel.control.switched == []


@pytest.mark.parametrize("request_", [REGIONS, MOVE])
def test_who_may_play_may_not_lay_regions_unless_the_settings_say_so(panel_with, request_):
    panel = panel_with()
    (answer,) = panel.ask(panel.connect(OTHER), {**request_, "id": 1})
    assert answer["outcome"] == "refused"
    assert answer["reason"] == (
        "uid 50002 (pid 12) does not have the right to lay regions over the scene:"
        " the board's application_socket names no regions_group that could give it"
    )
    assert panel.control.layers == []


def test_the_place_comes_with_the_regions_or_stays(panel):
    client = panel.connect(PAGE)
    panel.ask(client, REGIONS, {**REGIONS, "transform": {"x_mm": 10, "scale": 0.5}})
    assert [placement for *_, placement in panel.control.layers] == [None, Placement(10e-3, 0.0, 0.5)]
    assert json.loads(panel.control.layers[0][2])["regions"] == [REGION]


REFUSED = [
    ({**REGIONS, "region": []}, "region: unknown key; did you mean regions?"),
    ({"kind": "regions"}, "regions is missing"),
    ({**REGIONS, "regions": 7}, "regions = 7: must be a list"),
    ({**REGIONS, "regions": [REGION] * 251}, "regions: 251 of them, a client may have 250"),
    ({**REGIONS, "transform": {"scale": 0}}, "transform.scale = 0: must be a number from 0.05 to 20"),
    ({**REGIONS, "transform": {"x_mm": 1e9}}, "transform.x_mm = 1000000000.0: must be a number from -10000 to 10000"),
    ({**MOVE, "y_mm": "2"}, "y_mm = '2': must be a number from -10000 to 10000"),
    ({**MOVE, "scale": 21}, "scale = 21: must be a number from 0.05 to 20"),
]


@each_row(("request_", "reason"), REFUSED)
def test_what_is_no_layer_is_refused_with_its_key(panel, request_, reason):
    with panel.connect(PAGE) as client:
        (answer,) = panel.ask(client, {**request_, "id": 7})
    assert (answer["id"], answer["outcome"]) == (7, "refused")
    assert answer["reason"].startswith(reason)
    assert panel.control.layers == []


def test_there_is_nothing_to_move_without_regions(panel):
    (answer,) = panel.ask(panel.connect(PAGE), MOVE)
    assert answer["reason"] == "there is nothing to move: this client has sent no regions"


def test_only_regions_may_have_a_longer_line(panel):
    client = panel.connect(PAGE)
    padding = " " * LINE_BYTES
    panel.ask(client, json.dumps(REGIONS).encode() + padding.encode() + b"\n")
    assert len(panel.control.layers) == 1
    (answer,) = panel.ask(client, json.dumps({"kind": "hello", "id": 1}).encode() + padding.encode() + b"\n")
    assert answer["reason"] == f"a line of kind hello is at most {LINE_BYTES} bytes"
    (answer,) = panel.ask(client, b" " * panel.settings.layer_bytes + b"\n")
    assert answer["reason"] == f"a line is at most {panel.settings.layer_bytes} bytes"
    assert panel.ask(client, {"kind": "hello", "id": 1})[0]["kind"] == "hello"


def test_a_long_line_counts_as_several(panel_with):
    panel = panel_with(regions_group=REGIONS_GROUP.gr_name, burst=8, commands_per_s=1)
    client = panel.connect(PAGE)
    long = json.dumps(REGIONS).encode() + b" " * (4 * LINE_BYTES) + b"\n"
    assert panel.ask(client, long) == []
    (answer,) = panel.ask(client, long)
    assert (answer["outcome"], answer["reason"]) == ("refused", "rate")
    assert len(panel.control.layers) == 1


def test_regions_have_a_rate_of_their_own(panel):
    client = panel.connect(PAGE)
    for number in range(LAYER_BURST):
        assert panel.ask(client, {**REGIONS, "id": number}) == []
    (answer,) = panel.ask(client, {**REGIONS, "id": 9})
    assert answer == {"kind": "answer", "id": 9, "outcome": "refused", "reason": "rate"}
    panel.now_s += 1 / panel.settings.layers_per_s
    assert panel.ask(client, {**REGIONS, "id": 10}) == []
    assert len(panel.control.layers) == LAYER_BURST + 1


def test_a_refusal_and_a_replacement_are_answered(panel):
    client = panel.connect(PAGE)
    panel.ask(client, {**REGIONS, "id": 1}, {**REGIONS, "id": 2})
    (first, *_), (second, *_) = panel.control.layers
    panel.socket.layered(first, LayerResult(1e-3))
    panel.socket.layered(second, LayerResult(1e-3, reason="effects.a.when is missing"))
    assert panel.ask(client) == [
        {"kind": "answer", "id": 1, "outcome": "merged"},
        {"kind": "answer", "id": 2, "outcome": "refused", "reason": "effects.a.when is missing"},
    ]
    assert panel.socket.waiting == 0


def test_what_was_refused_of_a_layer_is_named(panel):
    client = panel.connect(PAGE)
    panel.ask(client, {**REGIONS, "id": 1})
    in_force(panel, (RefusedRegion(0, "ok", "no"),))
    (answer,) = panel.ask(client)
    assert (answer["refused"], answer["refused_count"]) == ([{"index": 0, "name": "ok", "reason": "no"}], 1)


def test_regions_go_with_their_client_and_only_with_it(panel):
    client, other = panel.connect(PAGE), panel.connect(PAGE)
    panel.ask(client, REGIONS)
    panel.ask(other, REGIONS)
    owners = [owner for _, owner, *_ in panel.control.layers]
    client.close()
    panel.settle()
    assert panel.control.dropped == owners[:1]
    in_force(panel)
    other.shutdown(1)  # it sends no more, but a client that has answers to come is still there
    panel.settle()
    assert panel.control.dropped == owners


def test_who_has_regions_does_not_give_way_as_silent(panel_with):
    panel = panel_with(regions_group=REGIONS_GROUP.gr_name, max_clients=1, idle_s=0)
    page = panel.connect(PAGE)
    panel.ask(page, REGIONS)
    in_force(panel)
    panel.ask(page)
    assert panel.ask(panel.connect(OTHER))[0]["reason"] == "1 clients are connected already"
    assert panel.control.dropped == []


@pytest.mark.parametrize("cut", [None, 10, 4000])
def test_the_regions_of_a_process_that_is_killed_are_gone_in_the_turn_that_sees_it(panel_with, cut):
    """Whether it waited for nothing, or was in the middle of its next line."""
    panel = panel_with()
    line = json.dumps(REGIONS).encode() + b"\n"
    sent = line + (b"" if cut is None else (line * 100)[:cut].replace(b"\n", b" "))
    reads, writes = os.pipe()
    pid = os.fork()
    if pid == 0:
        with contextlib.suppress(BaseException), socket.socket(socket.AF_UNIX) as client:
            client.connect(panel.settings.path)
            client.sendall(sent)
            os.write(writes, b"1")
            signal.pause()
        os._exit(1)
    os.read(reads, 1)
    panel.settle()
    in_force(panel)
    ((_, owner, *_),) = panel.control.layers
    assert panel.control.dropped == []
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    assert panel.turn()
    assert panel.control.dropped == [owner]
    assert panel.socket._clients.connected == 0
    os.close(reads)
    os.close(writes)


@pytest.mark.parametrize("region", ["{}", "1", '{"name":"a"}', "[" * 5 + "]" * 5])
def test_a_hundred_thousand_regions_are_one_refusal_however_long_a_line_may_be(panel_with, region):
    panel = panel_with(layer_regions=1000, layer_bytes=131_072)
    client = panel.connect()
    for count in (1001, 40_000, 100_000):
        line = b'{"kind":"regions","id":1,"regions":[' + ",".join([region] * count).encode() + b"]}\n"
        (answer,) = panel.ask(client, line)
        assert answer["outcome"] == "refused"
        too_long = len(line) > 131_072
        assert answer["reason"] == (
            "a line is at most 131072 bytes" if too_long else f"regions: {count} of them, a client may have 1000"
        )
    assert panel.control.layers == []
    assert panel.ask(client, {"kind": "unsubscribe"})[0]["outcome"] == "done"
