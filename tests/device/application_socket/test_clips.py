"""Effects that a client sends as data: what is played of them where, how many are kept, what is refused; through the loop, too."""

import json

import pytest
from device.application_socket.test_with_the_loop import serve  # noqa: F401
from tables import each_row

from controller.device.application_socket.connections.peers import Peer
from controller.device.application_socket.protocol.client_messages import LINE_BYTES
from controller.device.application_socket.requests.play_requests import CLIP_LINES, MOST_KEPT, MOST_KEPT_POINTS
from controller.device.scene.effects.clips import MOST_PULSES
from controller.device.scene.layers import UNMOVED, Layer
from controller.device.scene.scene import Region, Scene, SpatialIndex
from controller.device.scene.shapes import Rectangle

HEART = {"pulses": [[0, 1], [120, 0.5], [140, 0]]}
POINT = {"x_mm": 100, "y_mm": 70}


def clip(effect, **more):
    return {"kind": "clip", "effect": effect, **more}


def test_a_clip_is_played_where_it_is_asked_for_with_the_times_that_it_has(panel):
    panel.ask(panel.connect(), clip(HEART, finger=7, amplitude=0.5))
    ((_, (name, train), *where),) = panel.control.plays
    assert (name, where) == ("clip", [0.0, 0.0, 7, 0.5])
    assert train.rhythm == ((0.0, 1.0), (0.12, 0.5))


def test_what_has_a_name_is_kept_for_this_client_alone_until_another_one_has_it(panel):
    one, other = panel.connect(), panel.connect()
    assert panel.ask(one, clip(HEART, name="heart", id=1)) == [{"kind": "answer", "id": 1, "outcome": "done"}]
    assert panel.control.plays == []
    panel.ask(one, {"kind": "play", "effect": "heart", **POINT})
    assert panel.control.plays[-1][1].train.pulses == 2
    (answer,) = panel.ask(other, {"kind": "play", "effect": "heart", **POINT})
    assert answer["reason"] == "effect 'heart' is unknown"
    panel.ask(one, clip({"effect": "buzz"}, name="heart", **POINT))  # kept and played
    panel.ask(one, {"kind": "play", "effect": "heart", **POINT})
    assert [play[1].train.rate_hz > 0 for play in panel.control.plays] == [True, True, True]
    assert panel.control.plays[-1][1] is panel.control.plays[-2][1]


def test_the_place_of_a_client_that_has_gone_keeps_nothing_for_the_next(panel):
    client = panel.connect()
    panel.ask(client, clip({}, name="mine"))
    client.close()
    panel.settle()
    (answer,) = panel.ask(panel.connect(), {"kind": "play", "effect": "mine", **POINT})
    assert answer["outcome"] == "refused"


def test_no_more_than_so_many_are_kept(panel_with):
    panel = panel_with(burst=1000)
    client = panel.connect()
    answers = [panel.ask(client, clip({}, name=f"name {number}"))[0] for number in range(MOST_KEPT + 1)]
    assert [answer["outcome"] for answer in answers] == ["done"] * MOST_KEPT + ["refused"]
    assert "kept for this client already" in answers[-1]["reason"]
    assert panel.ask(client, clip(HEART, name="name 0"))[0]["outcome"] == "done"


def test_nor_more_points_than_a_megabyte(panel_with):
    panel = panel_with(burst=1000)
    client = panel.connect()
    long = {"pulses": [[index * 10, 0.5] for index in range(500)]}
    answers = [panel.ask(client, clip(long, name=f"name {number}"))[0] for number in range(MOST_KEPT_POINTS // 500 + 1)]
    assert [answer["outcome"] for answer in answers] == ["done"] * (len(answers) - 1) + ["refused"]
    assert answers[-1]["reason"].endswith(f"at most {MOST_KEPT_POINTS:,}")
    assert panel.ask(client, clip(long, name="name 0"))[0]["outcome"] == "done", "in place of another one"


def test_at_a_region_it_is_played_at_each_finger_in_it_with_one_outcome(panel):
    client = panel.connect()
    assert panel.ask(client, clip({}, region="ok", id=1)) == []
    (first, *_, one, _), (second, *_, other, _) = panel.control.plays
    assert (one, other) == (3, 7)
    assert first > 0
    assert second == 0
    (nobody,) = panel.ask(client, clip({}, region="nobody's", id=2))
    assert nobody == {"kind": "answer", "id": 2, "outcome": "skipped", "reason": 'no finger is in region "nobody\'s"'}
    (unknown,) = panel.ask(client, {"kind": "play", "effect": "click", "region": "no"})
    assert unknown["reason"] == "no region 'no': neither of this client nor of the scene"
    assert len(panel.control.plays) == 2


LONG = {"rate_envelope": [[0, 100]], "duration_ms": 10 * MOST_PULSES}
REFUSED = [
    (clip({}), "either x_mm and y_mm, or finger, or region, or with a name to keep it"),
    (clip({}, name="a", x_mm=3), "either x_mm and y_mm, or finger, or region"),
    (clip({}, finger=1, region="ok"), "either x_mm and y_mm, or finger, or region, or with a name to keep it"),
    (clip({}, finger=1, amplitude=0.05), "amplitude = 0.05 is not 0.1 to 1"),
    (clip({}, x_mm=300, y_mm=0), "x_mm = 300 is off the plate (0 to 210)"),
    ({"kind": "clip", "name": "a"}, "effect is missing"),
    (clip({}, name=""), "name = '': must be a text of 1 to 64 characters"),
    (clip(7, name="a"), "effect: Expected `object`, got `int`"),
    (clip("click", name="a"), "effect: Expected `object`, got `str`"),
    (clip(None, name="a"), "effect: Expected `object`, got `null`"),
    (clip({"effect": "clik"}, name="a"), "effect.effect = 'clik' is no effect; known: "),
    (clip({"rate": 80}, name="a"), "effect.rate = 80: unknown key"),
    (clip({"pulses": [[0, 2]]}, name="a"), "effect.pulses[0][1] = 2: must be a number from 0 to 1"),
    (clip({"pulses": [[0, 1], [0, 1]]}, name="a"), "effect.pulses[1] = [0.0, 1.0] is not later than the point before"),
    (clip({"pulses": [[0, 1], [1, 1]]}, name="a"), "effect.pulses[1], at 1 ms, is 1 ms after the one before"),
    (clip({"rate_hz": 900, "count": 3}, name="a"), "effect.rate_hz = 900 is above "),
    (clip({"pulses": [[0, 0.01]]}, name="a"), "effect.pulses[0] = [0.0, 0.01]: an amplitude is 0 (silence) or 0.1 to 1"),
    (clip({"when": "move", "spacing_mm": 3}, name="a"), "effect is a spacing along the path, which only a region can have"),
    (clip({"when": "always", "rate_hz": 30}, name="a"), "effect is a fixed emitter, which only a region can have"),
    (clip(LONG | {"duration_ms": 10 * MOST_PULSES + 10}, name="a"), "effect.rate_envelope makes up to 1,001 pulses"),
    (clip({"duration_ms": 1e9}, name="a"), "effect.duration_ms = 1000000000.0: must be a number above 0, at most 3600000 ms"),
    (clip({"pulses": [[index * 10, 1] for index in range(300)] + [[0, 1, 2]]}, name="a"), "effect: "),
]


@each_row(("request_", "reason"), REFUSED)
def test_what_is_refused_says_why_and_keeps_nothing(panel, request_, reason):
    with panel.connect() as client:
        (answer,) = panel.ask(client, {**request_, "id": 1})
        (unknown,) = panel.ask(client, {"kind": "play", "effect": "a", **POINT})
    assert (answer["id"], answer["outcome"]) == (1, "refused")
    assert answer["reason"].startswith(reason)
    assert unknown["reason"] == "effect 'a' is unknown"
    assert panel.control.plays == []


def test_as_many_pulses_as_are_allowed_are_taken(panel):
    assert panel.ask(panel.connect(), clip(LONG, name="a"))[0]["outcome"] == "done"


def test_a_clip_may_be_as_long_as_a_line_and_counts_as_several(panel_with):
    panel = panel_with(burst=CLIP_LINES + 1, commands_per_s=10)
    client = panel.connect()
    fulls = (clip({"pulses": [[index * 10, 0.5] for index in range(most)]}, name="a") for most in range(900, 0, -1))
    full = next(request for request in fulls if len(json.dumps(request)) < LINE_BYTES)
    assert panel.ask(client, full)[0]["outcome"] == "done"
    assert panel.ask(client, full)[0]["reason"] == "rate"
    assert panel.socket.counters.over_rate == 1


def test_who_may_not_play_may_send_no_clip(panel_with):
    panel = panel_with(play_group="daemon", look_group="users")
    (answer,) = panel.ask(panel.connect(Peer(50_001, 11, frozenset({100}))), clip({}, name="a"))
    assert "does not have the right to play" in answer["reason"]


def test_regions_are_found_by_name_in_the_clients_own_layer_first():
    def regions(*names):
        return tuple(Region(name, Rectangle(0.0, 0.0, 0.1, 0.1)) for name in names)

    def layer(owner, *names):
        found = regions(*names)
        return Layer(owner, found, SpatialIndex.of(found).lookup(found), UNMOVED)

    scene = Scene(regions("a", "b")).under((layer(5, "x", "a"), layer(2, "b")))
    assert [scene.named(owner, name) for owner, name in ((5, "a"), (5, "b"), (2, "b"), (2, "a"), (9, "b"))] == [1, 4, 2, 3, 4]


def test_a_rhythm_reaches_the_fingers_of_a_region_through_the_loop(serve):  # noqa: F811
    scene = '[[regions]]\nname = "pad"\nshape = "rectangle"\nx_mm = 20\ny_mm = 20\nwidth_mm = 100\nheight_mm = 100\neffects = []\n'
    reports = ((0.0, {}), (0.05, {0: (60.0, 50.0), 1: (100.0, 90.0), 2: (180.0, 140.0)}), (0.1, {0: (60.0, 50.0)}), (0.6, {}))
    script = [(0.3, "page", clip({"pulses": [[0, 1], [40, 0.5], [60, 0], [80, 1]]}, region="pad", id=1))]
    answers, _, counters, played = serve(script, until_s=0.8, scene_text=scene, reports=reports)
    assert [(answer["id"], answer["outcome"]) for answer in answers["page"]] == [(1, "played")]
    starts = [(round(start.trigger_s - played[0].trigger_s, 3), sorted(e.finger for e in start.emissions)) for start in played]
    assert [at for at, _ in starts] == pytest.approx([0.0, 0.04, 0.08], abs=2e-3)
    assert {finger for _, fingers in starts for finger in fingers} <= {0, 1}
    assert [round(start.emissions[0].amplitude, 3) for start in played] == [1.0, 0.5, 1.0]
    assert counters.emissions == 3
