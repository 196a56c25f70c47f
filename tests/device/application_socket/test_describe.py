"""The panel describes itself: on request, whenever another scene is in force, and each fault as it comes."""

import json

import msgspec
import pytest

from controller.device.application_socket.connections.connection import QUEUE_BYTES
from controller.device.application_socket.protocol.panel_messages import Description
from controller.device.application_socket.subscriptions.description import MOST_FAULTS, MOST_REGIONS
from controller.device.board.panel_state import Condition, PanelState
from controller.device.scene.effects.trains import Train
from controller.device.scene.scene import FixedEmitter, Region, Scene
from controller.device.scene.shapes import Circle, Polygon, Rectangle
from controller.device.scene.spacings import Spacing

ASK = {"kind": "describe", "id": 1}
SHAPES = Rectangle(0.01, 0.02, 0.05, 0.03), Circle(0.06, 0.05, 0.01 / 3), Polygon(((0.0, 0.0), (0.1, 0.0), (0.1, 0.1)))
SCENE = Scene(
    (
        Region("bar", SHAPES[0], press=(Train(),), leave=(Train(),)),
        Region("spot", SHAPES[1], spacings=(Spacing(1e-3, None, 0.0, 1.0),), emitter=FixedEmitter(0.06, 0.05, 25.0, "spot")),
        Region("corner", SHAPES[2]),
    ),
    {"click": Train()},
)


def off(cause="the run permit is missing", state=PanelState.NO_PERMIT):
    return Condition(state, cause)


def test_plate_patches_axes_limits_and_versions_are_the_boards(panel, board):
    (answer,) = panel.ask(panel.connect(), ASK)
    said = msgspec.convert(answer, Description)
    assert (said.id, said.protocol, said.board, said.board_digest) == (1, 1, board.name, board.digest().hex())
    assert (said.length_mm, said.width_mm) == (board.plate.length_mm, board.plate.width_mm)
    assert [(p.channel, p.x_mm, p.y_mm, p.size_mm) for p in said.patches] == [
        (a.channel, a.x_mm, a.y_mm, a.size_mm) for a in board.actuators
    ]
    assert said.axes.x_mm_from_axes == board.touch.x_mm_from_axes
    assert (said.limits.layer_regions, said.limits.layer_bytes) == (panel.settings.layer_regions, panel.settings.layer_bytes)
    assert (said.clients.connected, said.clients.accepted) == (1, 1)
    assert (said.scene, said.regions, said.faults) == ("drums", (), ())


def test_regions_are_described_with_the_keys_of_a_scene_and_their_occasions(panel):
    panel.control.scene_in_force = "own", SCENE
    (answer,) = panel.ask(panel.connect(), ASK)
    assert (answer["scene"], answer["region_count"], answer["effects"]) == ("own", 3, ["click"])
    assert answer["regions"] == [
        {
            "name": "bar",
            "shape": {"shape": "rectangle", "x_mm": 10.0, "y_mm": 20.0, "width_mm": 40.0, "height_mm": 10.0},
            "occasions": ["press", "leave"],
        },
        {
            "name": "spot",
            "shape": {"shape": "circle", "x_mm": 60.0, "y_mm": 50.0, "radius_mm": 3.333333},
            "occasions": ["move", "always"],
        },
        {
            "name": "corner",
            "shape": {"shape": "polygon", "corners_mm": [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0]]},
            "occasions": [],
        },
    ]


def test_of_a_large_scene_the_first_regions_are_described_and_one_too_long_is_refused(panel):
    panel.control.scene_in_force = "many", Scene(tuple(Region(f"r{number}", SHAPES[0]) for number in range(MOST_REGIONS + 1)))
    client = panel.connect()
    (answer,) = panel.ask(client, ASK)
    assert (len(answer["regions"]), answer["region_count"]) == (MOST_REGIONS, MOST_REGIONS + 1)
    round_ = Polygon(tuple((0.1 * number / 999, 0.05) for number in range(1000)))
    panel.control.scene_in_force = "long", Scene(tuple(Region(f"r{number}", round_) for number in range(9)))
    (answer,) = panel.ask(client, ASK)
    assert answer["outcome"] == "refused"
    assert f"more than {QUEUE_BYTES}" in answer["reason"]
    assert panel.ask(client, {"kind": "subscribe", "to": ["description"], "id": 2}) == [
        {"kind": "answer", "id": 2, "outcome": "done"}
    ]


def test_who_subscribes_is_sent_each_new_scene_until_it_unsubscribes(panel):
    client, other = panel.connect(), panel.connect()
    done, now = panel.ask(client, {"kind": "subscribe", "to": ["description"], "id": 1})
    assert (done["outcome"], now["id"], now["scene"]) == ("done", None, "drums")
    panel.control.scene_in_force = "own", SCENE
    panel.socket.scene_changed()
    (pushed,) = panel.ask(client)
    assert (pushed["id"], pushed["scene"]) == (None, "own")
    assert panel.ask(other) == []
    panel.ask(client, {"kind": "unsubscribe"})
    panel.socket.scene_changed()
    assert panel.ask(client) == []


def test_each_fault_is_said_once_and_the_last_ones_are_kept(panel):
    client = panel.connect()
    panel.ask(client, {"kind": "subscribe", "to": ["faults"]})
    for condition in (off(), off(), Condition(PanelState.ARMED), off(), off("", PanelState.WAITING_FOR_FPGA)):
        panel.socket.changed(condition)
    faults = panel.ask(client)
    assert [(fault["kind"], fault["state"], fault["cause"]) for fault in faults] == [
        ("fault", "no permit", "the run permit is missing")
    ] * 2
    assert faults[0]["time_s"] <= faults[1]["time_s"]
    for number in range(MOST_FAULTS + 5):
        panel.socket.changed(off(f"cause {number}", PanelState.FAULTED))
    panel.ask(client)
    (answer,) = panel.ask(client, ASK)
    assert [fault["cause"] for fault in answer["faults"]] == [f"cause {number}" for number in range(5, MOST_FAULTS + 5)]


@pytest.mark.parametrize("topic", ["description", "faults"])
def test_a_subscriber_stays_where_a_silent_client_gives_way(panel_with, topic):
    panel = panel_with(max_clients=1, idle_s=0)
    client = panel.connect()
    panel.ask(client, {"kind": "subscribe", "to": [topic]})
    client.shutdown(1)
    panel.settle()
    assert panel.socket._clients.connected == 1


def test_the_example_of_the_readme_is_a_description():
    from device.application_socket.test_readme import README

    block, _ = [text.partition("```")[0] for text in README.read_text().split("```json\n")[1:]]
    said = msgspec.json.decode(block, type=Description)
    assert said.protocol == 1
    assert json.loads(block).keys() == set(Description.__struct_fields__) | {"kind"}
