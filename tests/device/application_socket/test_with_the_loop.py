"""Commands over a real socket into the product's own loop, scene, bank and simulated FPGA, in virtual time.

The loop runs in this thread. What clients do at which time is called from the loop's `progress`, so that every run
is the same.
"""

import json
import socket
from collections import Counter

import pytest
from prometheus_client import generate_latest
from prometheus_client.parser import text_string_to_metric_families

from controller.clocks import VirtualClock
from controller.device.application_socket.command_socket import CommandSocket
from controller.device.bank.reader import Bank
from controller.device.board.devices import ApplicationSocket
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.preparation import AcceptedLayer
from controller.device.loop.wiring import assemble
from controller.device.scene.layer_tables import off_plate, read_layer
from controller.device.scene.scene import SpatialIndex, load_scene
from controller.device.service.drivers import open_session, tracked
from controller.device.service.prometheus import PanelCollector, registry
from controller.device.touch.recordings.recording import Recording
from controller.device.touch.recordings.replay import RecordingSource
from controller.errors import LinkError
from controller.workshop.gateware.simulated_link import open_simulated

QUIET = '[[regions]]\nname = "corner"\nshape = "rectangle"\nx_mm = 5\ny_mm = 5\nwidth_mm = 3\nheight_mm = 3\neffects = ["click"]\n'
CIRCLE = '[[regions]]\nname = "spot"\nshape = "circle"\nx_mm = 60.0\ny_mm = 54.0\nradius_mm = 3.0\n'
SPOT = CIRCLE + 'effects = [{ effect = "always", rate_hz = 40.0 }]\n'
PLACES = [(30.0 + 20 * number % 160, 30.0 + 11 * number % 90) for number in range(40)]
GOES = {"kind": "its client closes"}
STALL_S = 0.2  # twice the heartbeat's timeout
ON_S = 0.1  # the outputs are on by then


class ChecksAtOnce:
    """A `LayerPreparation` without a process: what it begins is done in the next turn."""

    def __init__(self, board):
        self._board = board
        self._layer = None

    @property
    def busy(self):
        return self._layer is not None

    def begin(self, line, placement):
        layer = read_layer(line, self._board)
        lookup = SpatialIndex.of(layer.regions).lookup(layer.regions)
        off = off_plate(layer.regions, placement, self._board)
        self._layer = AcceptedLayer(layer.regions, lookup, off, layer.refused, len(layer.refused))

    def fileno(self):
        return None

    def take(self):
        layer, self._layer = self._layer, None
        return layer


@pytest.fixture
def serve(board, bank_file, folder, tmp_path, evemu_text, read_all):
    """Run the loop for a while with what clients send when; each client's answers, socket, loop's counters, what was played."""

    def run(script, *, until_s, scene_text=QUIET, reports=((0.0, {}), (0.001, {0: (200.0, 140.0)})), stalls_s=(), **settings):
        scene_file = tmp_path / "served.toml"
        scene_file.write_text(scene_text)
        scene, clock, played = load_scene(scene_file, board), VirtualClock(), []
        link = open_simulated(board, clock.now_s)
        recording = Recording(evemu_text(*reports))
        source = tracked(RecordingSource(recording, recording.axes(board), ON_S), board)
        settings = ApplicationSocket(path=str(folder / "loop.sock"), **{"burst": 1000, "commands_per_s": 10_000} | settings)
        commands = CommandSocket(board, settings)
        names = sorted({name for _, name, _ in script})
        clients = {name: socket.socket(socket.AF_UNIX) for name in names}
        answers = {name: [] for name in names}
        for client in clients.values():
            client.connect(settings.path)
            client.setblocking(False)
        pending = sorted(script, key=lambda entry: entry[0])
        stalls = list(stalls_s)

        def progress(now_s):
            while pending and pending[0][0] <= now_s:
                _, name, request = pending.pop(0)
                if request is GOES:
                    clients[name].close()
                    clients.pop(name)
                else:
                    clients[name].send(json.dumps(request).encode() + b"\n")
            for name, client in clients.items():
                answers[name] += read_all(client)
            if stalls and stalls[0] <= now_s:
                stalls.pop(0)
                clock._now_s += STALL_S
            if now_s >= until_s:
                made.loop.stop()

        with Bank.open(bank_file, board) as bank:
            session = open_session(link, board, clock.now_s)
            made = assemble(
                LoopContext(board, clock, session, source, layers=ChecksAtOnce(board)),
                scene,
                bank,
                commands=commands,
                played=played.append,
                watch=Watch(progress),
            )
            made.loop.run()
        assert not pending
        for name, client in clients.items():
            answers[name] += read_all(client)
            client.close()
        commands.close()
        link.close()
        return answers, commands, made.counters, played

    return run


def click(number, place, **more):
    return {"kind": "play", "effect": "click", "x_mm": place[0], "y_mm": place[1], "id": number, **more}


def by_id(answers):
    return {answer["id"]: answer for answer in answers}


def test_one_command_is_one_emission_at_its_place_and_its_answer_tells_how_old_it_was(serve):
    answers, _, counters, played = serve([(0.2, "a", click(1, (100.0, 70.0), amplitude=0.5))], until_s=0.3)
    (answer,) = answers["a"]
    assert (answer["id"], answer["outcome"]) == (1, "played")
    (emission,) = played[0].emissions
    assert (emission.x_m, emission.y_m, emission.amplitude) == pytest.approx((0.1, 0.07, 0.5))
    assert answer["age_ms"] == pytest.approx(1.36, abs=0.1)  # the upload on the wire, 4,240 bytes at 25 MHz, and nothing else
    assert counters.emissions == len(played) == 1


def test_before_the_outputs_are_on_a_command_is_refused_with_that_reason(serve):
    answers, _, _, played = serve([(0.0, "a", click(1, (100.0, 70.0)))], until_s=0.2)
    (answer,) = answers["a"]
    assert answer["outcome"] == "refused"
    assert answer["reason"].startswith("the outputs are off")
    assert not played


def test_a_panel_that_is_disarmed_plays_nothing_through_a_stall_until_it_is_armed(serve):
    """Of three commands in one breath the last finds the panel disarmed already."""
    script = [
        (0.2, "a", click(1, PLACES[0])),
        (0.25, "o", {"kind": "disarm", "id": 2}),
        (0.25, "o", click(3, PLACES[1])),
        (0.9, "a", click(4, PLACES[2])),
        (1.0, "o", {"kind": "arm", "id": 5}),
        (1.2, "a", click(6, PLACES[3])),
    ]
    answers, commands, counters, played = serve(script, until_s=1.3, scene_text=SPOT, stalls_s=[0.5])
    reported = by_id(answers["a"]) | by_id(answers["o"])
    assert {number: answer["outcome"] for number, answer in reported.items()} == {
        1: "played",
        2: "done",
        3: "refused",
        4: "refused",
        5: "done",
        6: "played",
    }
    assert "the panel is disarmed; a client that may operate it has to arm it" in reported[3]["reason"]
    assert reported[4]["reason"] == reported[3]["reason"]
    assert not [one for one in played if 0.25 < one.trigger_s < 1.0], "nor the spot"
    assert any(one.trigger_s > 1.0 for one in played)
    assert (commands.waiting, counters.outages) == (0, 0)


def test_of_two_thousand_commands_a_second_each_is_answered_once_and_the_sums_are_exact(serve):
    script = [(0.2 + number / 2000, "ab"[number % 2], click(number, PLACES[number * 7 % 40])) for number in range(600)]
    answers, commands, counters, played = serve(script, until_s=0.7)
    assert sorted(answer["id"] for client in answers.values() for answer in client) == list(range(600))
    outcomes = Counter(answer["outcome"] for client in answers.values() for answer in client)
    reported = commands.counters
    assert outcomes == {name: count for name in ("played", "merged", "skipped", "refused") if (count := getattr(reported, name))}
    assert outcomes["played"] == sum(bool(emission.ticket) for one in played for emission in one.emissions)
    assert outcomes["merged"] == counters.skipped.merged
    assert outcomes["skipped"] == counters.skipped.no_room
    assert outcomes.total() == reported.lines == 600
    assert commands.waiting == reported.stray_outcomes == reported.unanswered == 0


def test_the_plate_is_never_idle_while_commands_wait(serve):
    script = [(0.2 + number / 2000, "a", click(number, PLACES[0])) for number in range(1000)]
    _, _, counters, played = serve(script, until_s=0.8)
    assert counters.resident == counters.emissions - 1
    starts_s = [one.trigger_s for one in played]
    assert len(starts_s) / (starts_s[-1] - starts_s[0]) > 490


def test_more_places_at_once_than_one_waveform_has_foci_are_played_while_a_spot_repeats(serve):
    apart = [(20.0 + 34 * column, 15.0 + 38 * row) for column in range(6) for row in range(4)]
    script = [(0.2 + 0.011 * (number // 24), "a", click(number, apart[number % 24])) for number in range(144)]
    answers, _, _, played = serve(script, until_s=0.5, scene_text=SPOT)
    assert Counter(answer["outcome"] for answer in answers["a"])["played"] >= 24
    assert len(answers["a"]) == len(script)
    assert max(len(one.emissions) for one in played) == 10
    assert any(len(one.emissions) > 1 and any(emission.region == "spot" for emission in one.emissions) for one in played)


def test_a_command_for_a_finger_is_played_where_the_finger_is_then(serve):
    reports = [(0.01 * step, {0: (60.0 + step, 70.0)}) for step in range(40)] + [(0.4, {0: None})]
    script = [(0.15, "t", {"kind": "subscribe"}), (0.35, "a", {"kind": "play", "effect": "click", "finger": 0, "id": 1})]
    answers, _, _, played = serve(script, until_s=0.6, reports=reports)
    assert answers["a"][0]["outcome"] == "played"
    (emission,) = played[-1].emissions
    touched = [answer for answer in answers["t"] if answer["kind"] == "touch"]
    assert {touch["finger"] for touch in touched} == {0}
    assert not touched[-1]["contact"]
    at_s = played[-1].trigger_s + 2e-3
    assert emission.x_m * 1e3 == pytest.approx(60 + (at_s - ON_S) * 100, abs=1.5)


def test_a_finger_that_is_not_there_is_refused(serve):
    answers, *_ = serve([(0.2, "a", {"kind": "play", "effect": "click", "finger": 99, "id": 1})], until_s=0.3)
    assert answers["a"] == [{"kind": "answer", "id": 1, "outcome": "refused", "reason": "finger 99 is not on the panel"}]


def test_every_command_for_a_finger_that_is_lifted_meanwhile_has_its_outcome(serve):
    reports = [(0.0, {0: (60.0, 70.0)}), (0.15, {0: (60.5, 70.0)}), (0.2, {0: None})]
    requests = [{"kind": "play", "effect": effect, "finger": 0} for effect in ("click", "buzz", "double_click", "notification")]
    script = [(0.25 + 0.0005 * number, "a", requests[number % 4] | {"id": number}) for number in range(160)]
    answers, commands, *_ = serve(script, until_s=0.6, reports=reports)
    assert sorted(answer["id"] for answer in answers["a"]) == list(range(160))
    assert {answer["outcome"] for answer in answers["a"]} >= {"played", "merged", "refused"}
    assert commands.waiting == 0


LATE = '[effects.late]\nwhen = "command"\nrate_hz = 10.0\ncount = 2\nphase = 0.9\n' + QUIET  # 90 ms after the command


def test_a_command_whose_finger_is_lifted_before_its_first_pulse_is_skipped(serve):
    reports = [(0.0, {0: (60.0, 70.0)}), (0.15, {0: (60.5, 70.0)}), (0.2, {0: None})]
    script = [(0.28, "a", {"kind": "play", "effect": "late", "finger": 0, "id": 1})]
    answers, commands, _, played = serve(script, until_s=0.6, reports=reports, scene_text=LATE)
    assert [answer["outcome"] for answer in answers["a"]] == ["skipped"]
    assert commands.waiting == len(played) == 0


def test_when_the_outputs_go_off_every_command_under_way_is_answered(serve):
    """The host stands still for twice the heartbeat's timeout, four times."""
    script = [(0.2 + number / 500, "a", click(number, PLACES[number * 7 % 40])) for number in range(650)]
    script += [(0.29, "b", click(f"late {number}", PLACES[number]) | {"effect": "late"}) for number in range(5)]
    answers, commands, counters, _ = serve(script, until_s=2.0, scene_text=LATE, stalls_s=[0.3, 0.6, 0.9, 1.2])
    assert counters.host_silent == 4
    assert sorted(answer["id"] for answer in answers["a"]) == list(range(650))
    assert [answer["outcome"] for answer in answers["b"]] == ["refused"] * 5
    assert commands.waiting == 0


@pytest.mark.parametrize("resident", [True, False])
def test_a_command_that_finds_the_outputs_off_when_it_is_about_to_play_is_refused(serve, resident):
    """The host stands still in the middle of a turn, which a touch began: the command is the first to notice."""
    reports = [(0.0, {}), *[(0.39 + 0.001 * step, {0: (200.0 - step, 140.0)}) for step in range(30)]]
    script = [(0.4, "a", click(1, PLACES[0])), (0.5, "b", click(2, PLACES[0 if resident else 1]))]
    answers, commands, counters, played = serve(script, until_s=1.0, stalls_s=[0.5], reports=reports)
    assert counters.host_silent == 1
    assert [answer["outcome"] for answer in answers["b"]] == ["refused"]
    assert len(played) == 1
    assert commands.waiting == 0


def test_effects_of_every_kind_have_exactly_one_outcome_each(serve):
    effects = ("click", "double_click", "train", "buzz", "edge", "notification")
    script = [
        (0.2 + number / 400, "a", click(number, PLACES[number % 7]) | {"effect": effects[number % 6]}) for number in range(18)
    ]
    answers, commands, *_ = serve([*script, (0.1, "b", {"kind": "hello", "id": 1})], until_s=0.4)
    assert set(effects) <= set(answers["b"][0]["effects"])
    assert sorted(answer["id"] for answer in answers["a"]) == list(range(18))
    assert commands.waiting == 0


def test_figures_tell_what_the_loop_and_the_socket_counted(serve):
    script = [
        (0.2, "a", click(1, (100.0, 70.0))),
        (0.25, "a", {"kind": "figures", "id": 2}),
        (0.25, "a", {"kind": "hello", "id": 3}),
    ]
    answers, *_ = serve(script, until_s=0.3)
    figures = by_id(answers["a"])[2]["figures"]
    assert figures["emissions"] == 1
    assert figures["application_socket"]["played"] == 1
    assert figures["outputs"] == "on"
    assert set(by_id(answers["a"])) == {1, 2, 3}


def test_prometheus_gets_what_the_panel_counted(serve):
    """Read by Prometheus' own parser; the panel stalls once, and is disarmed at the end."""
    script = [(0.2 + 0.01 * number, "a", click(number, PLACES[number])) for number in range(20)]
    script += [(1.0, "o", {"kind": "disarm", "id": "d"}), (1.1, "o", {"kind": "figures", "id": "f"})]
    answers, _, counters, _ = serve(script, until_s=1.2, stalls_s=[0.5])
    figures = by_id(answers["o"])["f"]["figures"] | {"state": "disarmed"}  # which housekeeping tells
    text = generate_latest(registry(PanelCollector(lambda: ("0.1.0", "simulated", figures)))).decode()
    samples = [sample for metric in text_string_to_metric_families(text) for sample in metric.samples]
    reported = {(sample.name, *sample.labels.values()): sample.value for sample in samples}
    assert reported["haptic_panel_up",] == 1
    assert (reported["haptic_panel_state", "disarmed"], reported["haptic_panel_state", "armed"]) == (1, 0)
    assert reported["haptic_panel_outputs_on",] == 0
    assert reported["haptic_panel_emissions_total",] == counters.emissions > 0
    assert reported["haptic_panel_host_stalls_total",] == counters.host_silent == 1
    assert reported["haptic_panel_faults_total", "OVER_TEMPERATURE"] == 0
    assert reported["haptic_panel_skipped_total", "merged"] == counters.skipped.merged
    for play, stages in (("upload", counters.upload_latency), ("resident", counters.resident_latency)):
        assert reported["haptic_panel_emission_latency_seconds_count", play] == stages.total.count
        assert reported["haptic_panel_emission_latency_seconds_bucket", "+Inf", play] == stages.total.count
    assert reported["haptic_panel_emission_latency_seconds_sum", "upload"] > 0


def test_prometheus_is_informed_that_no_panel_answers():
    def nobody():
        raise LinkError("no panel")

    assert generate_latest(registry(PanelCollector(nobody))).decode().splitlines()[-1] == "haptic_panel_up 0.0"


def button(name, x_mm, effects=("click",)):
    return {"name": name, "shape": "circle", "x_mm": x_mm, "y_mm": 70, "radius_mm": 8, "effects": list(effects)}


def test_a_finger_feels_the_layer_that_is_in_force_when_it_touches(serve):
    """Two pages: the one that connected last is on top; then its layer moves away, and at last it closes."""

    def press(at_s, x_mm):
        return [(at_s, {0: (x_mm, 70.0)}), (at_s + 0.03, {0: None})]

    reports = [(0.0, {}), *press(0.2, 50), *press(0.4, 50), *press(0.6, 50), *press(0.8, 90), *press(1.0, 90), (1.2, {})]
    script = [
        (0.25, "a", {"kind": "regions", "regions": [button("a", 50), button("bad", 9, ["clik"])], "id": 1}),
        (0.45, "b", {"kind": "regions", "regions": [button("b", 50)], "id": 1}),
        (0.65, "b", {"kind": "transform", "x_mm": 40, "id": 2}),
        (0.95, "b", GOES),
    ]
    answers, commands, _, played = serve(script, until_s=1.4, reports=reports)
    assert [(answer["id"], answer.get("regions", answer.get("outcome"))) for answer in answers["a"] + answers["b"]] == [
        (1, 1),
        (1, 1),
        (2, "done"),
    ]
    assert [refused["name"] for refused in answers["a"][0]["refused"]] == ["bad"]
    felt = [emission.region for one in played for emission in one.emissions]
    assert felt == ["a", "b", "a", "b"]  # and nothing once b has gone
    assert commands.waiting == 0
