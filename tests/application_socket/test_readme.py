"""The conversation of the room's README is one that a panel really has."""

import json
import re
from pathlib import Path

import controller.application_socket
from controller.board.panel_state import Condition, PanelState
from controller.loop.commands import Outcome
from controller.touch.source import TouchSample

README = Path(controller.application_socket.__file__).with_name("README.md")


def test_the_conversation_of_the_readme_is_real(panel):
    blocks = re.findall(r"^```\n(> .*?)^```", README.read_text(), re.MULTILINE | re.DOTALL)
    (lines,) = [block.splitlines() for block in blocks]
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
                off = {"state": PanelState.DISARMED, "cause": "a client has switched the panel off"}
                how = {"state": PanelState.ARMED, "outputs_on": True} if on else off
                panel.socket.changed(Condition(**how, temperature_c=23.5))
            panel.control.plays.clear()
            panel.control.scenes.clear()
            if line.endswith('"subscribe", "id": 5}'):
                panel.socket.touches([TouchSample(7, 0.1, 0.07, 12.5, True, 8e-3)])
            said += panel.ask(client)
        else:
            assert json.loads(line.removeprefix("< ")) == said.pop(0), line
    assert said == []
    assert len(lines) > 10
