"""The conversation of the room's README is one that a panel really has."""

import json
import re
from pathlib import Path

import pytest

import controller.device.application_socket
from controller.device.board.panel_state import Condition, PanelState
from controller.device.loop.commands import Outcome
from controller.device.loop.preparation import AcceptedLayer, LayerResult
from controller.device.scene.layer_tables import off_plate, read_layer
from controller.device.scene.layers import UNMOVED
from controller.device.touch.source import TouchSample

README = Path(controller.device.application_socket.__file__).with_name("README.md")


def answer_layers(panel, board):
    """As the loop does, 3 ms later."""
    for ticket, _, line, placement in panel.control.layers[panel.answered :]:
        layer = read_layer(line, board)
        off = off_plate(layer.regions, placement or UNMOVED, board)
        accepted = AcceptedLayer(layer.regions, None, off, layer.refused, len(layer.refused))
        panel.socket.layered(ticket, LayerResult(3e-3, accepted))
        panel.answered += 1


def conversations():
    blocks = re.findall(r"^```\n(> .*?)^```", README.read_text(), re.MULTILINE | re.DOTALL)
    return [block.splitlines() for block in blocks]


@pytest.mark.parametrize("lines", conversations())
def test_the_conversations_of_the_readme_are_real(panel, board, lines):
    client = panel.connect()
    said = []
    for line in lines:
        if line.startswith("> "):
            assert said == []
            said += panel.ask(client, line[2:].encode() + b"\n")
            for ticket, *_ in panel.control.plays:
                panel.socket.outcome(ticket, Outcome.PLAYED, 1.5e-3)
            for ticket, _ in panel.control.scenes:
                panel.socket.loaded(ticket, "")
            if panel.control.switched:
                on = panel.control.switched.pop()
                off = {"state": PanelState.DISARMED, "cause": "switched off by user 'anna' (uid 1002, pid 358)"}
                how = {"state": PanelState.ARMED, "outputs_on": True} if on else off
                panel.socket.changed(Condition(**how, temperature_c=23.5))
            answer_layers(panel, board)
            panel.control.plays.clear()
            panel.control.scenes.clear()
            if line.endswith('"subscribe", "id": 5}'):
                panel.socket.touches([TouchSample(7, 0.1, 0.07, 12.5, True, 8e-3)])
            said += panel.ask(client)
        else:
            assert json.loads(line.removeprefix("< ")) == said.pop(0), line
    assert said == []
    assert len(lines) > 6
