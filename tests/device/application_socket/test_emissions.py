"""What subscribers are sent of emissions: each start once, with its place and amplitude; what was not played, by cause."""

import math

import pytest
from device.application_socket.test_readme import README
from device.application_socket.test_with_the_loop import serve  # noqa: F401
from device.bank.test_expectation import expected

from controller.device.application_socket.connections.peers import Peer
from controller.device.application_socket.protocol.panel_messages import Emissions, message_decoder
from controller.device.application_socket.subscriptions.emission_notices import PERIOD_S
from controller.device.loop.playing.records import ENDLESS, Batch, Plan
from controller.device.loop.rings.emission_ring import SLOTS, EmissionRing
from controller.device.scene.emission import Emission
from controller.metrics import NOT_PLAYED

SUBSCRIBE = {"kind": "subscribe", "to": ["emissions"], "id": 1}
SPOTS = '[[regions]]\nname = "pad"\nshape = "plate"\neffects = ["texture"]\n'


def plan(*points, **repeated):
    emissions = [Emission(0.0, x_m, y_m, finger, "pad") for finger, (x_m, y_m, _) in enumerate(points)]
    return Plan(Batch(emissions, **repeated), list(points), 0, None, 0.0, None)


def of_kind(messages, kind="emissions"):
    return [message for message in messages if message["kind"] == kind]


def test_it_is_noted_only_while_somebody_listens(panel):
    client, ring = panel.connect(), panel.control.emissions
    panel.ask(client)
    assert not ring.wanted
    panel.ask(client, SUBSCRIBE)
    assert ring.wanted
    assert panel.socket.next_time_s() == math.inf, "nothing is played: the loop sleeps"
    ring.started(7.5, plan((0.1, 0.07, 0.5), (0.05, 0.02, 1.0)))
    assert panel.socket.next_time_s() < math.inf
    (told,) = panel.ask(client)
    first, second = told["foci"]
    assert first == {"time_s": 7.5, "x_mm": 100.0, "y_mm": 70.0, "amplitude": 0.5, "of": "pad", "finger": 0}
    assert second["finger"] == 1
    assert (told["skipped"], told["lost"]) == ({}, 0)
    client.close()
    panel.settle()
    ring.started(7.6, plan((0.1, 0.07, 0.5)))
    panel.settle()
    assert not ring.wanted
    assert panel.socket.next_time_s() == math.inf


def test_thirty_times_a_second_at_most_and_each_start_once(panel):
    client, ring = panel.connect(), panel.control.emissions
    panel.ask(client, SUBSCRIBE)
    began_s = panel.now_s
    for number in range(100):
        panel.now_s = began_s + number * 5e-3
        ring.started(panel.now_s, plan((0.1, 0.07, 0.5)))
        panel.socket.serve(panel.now_s, panel.control)
    messages = panel.ask(client)
    starts = [focus["time_s"] for message in messages for focus in message["foci"]]
    assert starts == pytest.approx([began_s + number * 5e-3 for number in range(100)])
    assert 0.5 / PERIOD_S - 2 <= len(messages) <= 0.5 / PERIOD_S + 2


def test_more_than_fit_are_counted(panel):
    client, ring = panel.connect(), panel.control.emissions
    panel.ask(client, SUBSCRIBE)
    for number in range(SLOTS + 3):
        ring.started(float(number), plan((0.1, 0.07, 0.5)))
    (told,) = panel.ask(client)
    assert [focus["time_s"] for focus in told["foci"]] == list(range(3, SLOTS + 3))
    assert told["lost"] == 3


def test_what_no_message_can_hold_is_counted(panel):
    client, ring = panel.connect(), panel.control.emissions
    panel.ask(client, SUBSCRIBE)
    for number in range(SLOTS):
        points = [(0.01 * focus, 0.07, 0.5) for focus in range(1, 11)]
        emissions = [Emission(0.0, x_m, y_m, None, "a region with a long name " * 4) for x_m, y_m, _ in points]
        ring.started(float(number), Plan(Batch(emissions), points, 0, None, 0.0, None))
    (notice,) = panel.ask(client)
    assert (notice["foci"], notice["lost"]) == ([], SLOTS)


def test_what_is_not_played_is_said_with_its_cause_also_where_nothing_is(panel):
    client = panel.connect()
    panel.control.skipped.merged = 7
    panel.ask(client, SUBSCRIBE)
    panel.control.skipped.merged += 2
    panel.control.skipped.outputs_off += 1
    panel.control.skipped.between_emissions += 100
    panel.socket.touches([])
    (told,) = panel.ask(client)
    assert told == {"kind": "emissions", "foci": [], "skipped": {"merged": 2, "outputs_off": 1}, "lost": 0}
    panel.socket.touches([])
    assert panel.ask(client) == []


def test_what_is_to_be_expected_is_said_beside_it(panel):
    client, ring = panel.connect(), panel.control.emissions
    panel.ask(client, SUBSCRIBE)
    ring.expected = expected()
    ring.started(1.0, plan((0.03, 0.02, 0.5), (0.04, 0.03, 1.0), (0.001, 0.02, 1.0)))
    (told,) = panel.ask(client)
    half, whole, rim = told["foci"]
    assert "expected_um" not in rim
    assert whole["expected_um"] == pytest.approx(expected().felt(None, 3, 2), abs=1e-3)
    assert half["expected_um"] == pytest.approx(expected().felt(None, 3, 2).times(0.5), abs=1e-3)
    ring.expected = expected(panel="fedcba9876543210")
    emissions = [Emission(0.0, 0.03, 0.02, None, "pad")]
    ring.started(2.0, Plan(Batch(emissions), [(0.03, 0.02, 1.0)], 0, None, 0.0, None))
    (told,) = panel.ask(client)
    low_um, middle_um, high_um = told["foci"][0]["expected_um"]
    assert (low_um, middle_um) == (0, None)
    assert high_um > expected().free(None).high_um


def test_a_repetition_has_its_period(panel):
    client, ring = panel.connect(), panel.control.emissions
    panel.ask(client, SUBSCRIBE)
    ring.started(1.0, plan((0.1, 0.07, 0.5), repetitions=ENDLESS, period_s=0.025))
    (told,) = panel.ask(client)
    assert told["foci"][0]["period_ms"] == 25.0


def test_who_may_not_play_does_not_learn_where_fingers_are(panel_with):
    panel = panel_with(play_group="daemon", look_group="users")
    (answer,) = panel.ask(panel.connect(Peer(50_001, 11, frozenset({100}))), SUBSCRIBE)
    assert answer["outcome"] == "refused"
    assert not panel.control.emissions.wanted


def test_the_example_of_the_readme_is_such_a_message():
    _, block = [text.partition("```")[0] for text in README.read_text().split("```json\n")[1:]]
    told = message_decoder().decode(block)
    assert isinstance(told, Emissions)
    assert set(told.skipped) < set(NOT_PLAYED)


def test_a_ring_gives_what_came_since():
    ring = EmissionRing()
    assert ring.since(0) == []
    ring.started(1.0, plan((0.1, 0.07, 0.5)))
    ring.started(2.0, plan((0.1, 0.07, 0.5)))
    assert [start_s for start_s, _ in ring.since(1)] == [2.0]


def test_subscribers_see_what_the_loop_counts_and_where_it_played(serve):  # noqa: F811
    reports = [(0.0, {})] + [(0.05 + 0.01 * n, {0: (30.0 + 1.5 * n, 60.0)}) for n in range(80)] + [(0.9, {})]
    script = [(0.0, "page", SUBSCRIBE)]
    script += [(0.2 + 1e-4 * n, "page", {"kind": "play", "effect": "click", "x_mm": 150, "y_mm": 100}) for n in range(6)]
    answers, _, counters, played = serve(script, until_s=1.2, scene_text=SPOTS, reports=reports)
    told = of_kind(answers["page"])
    foci = [focus for message in told for focus in message["foci"]]
    assert len(foci) == counters.foci > 20
    assert sum(message["lost"] for message in told) == 0
    assert [(focus["time_s"], focus["x_mm"], focus["y_mm"], focus.get("finger")) for focus in foci] == [
        (start.trigger_s, pytest.approx(e.x_m * 1e3, abs=1e-3), pytest.approx(e.y_m * 1e3, abs=1e-3), e.finger)
        for start in played
        for e in start.emissions
    ]
    skipped = sum(sum(message["skipped"].values()) for message in told)
    assert skipped == counters.skipped.emissions > 0
