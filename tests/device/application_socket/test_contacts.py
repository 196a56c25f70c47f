"""Contacts as the touch panel has them: sent to operators who subscribe, and listened to for as long as anybody does."""

import math

from controller.device.application_socket.connections.peers import Peer
from controller.device.touch.source import TouchSample

ASK = {"kind": "subscribe", "to": ["contacts"], "id": 1}
SAMPLES = [TouchSample(7, 0.1, 0.07, 12.5, True, 8e-3), TouchSample(8, 0.02, 0.03, 12.5, False, math.inf)]
ORDINARY = Peer(50_001, 11, frozenset())


def contact(finger, x_mm, y_mm, size_mm, *, down):
    place = {"x_mm": x_mm, "y_mm": y_mm, "size_mm": size_mm}
    return {"kind": "contact", "finger": finger, "time_s": 12.5, "contact": down} | place


def test_who_subscribes_is_sent_the_contacts_of_each_report_and_no_touches(panel):
    client, other = panel.connect(), panel.connect()
    assert panel.ask(client, ASK) == [{"kind": "answer", "id": 1, "outcome": "done"}]
    panel.control.heard(SAMPLES)
    panel.socket.touches(SAMPLES)
    assert panel.ask(client) == [contact(7, 100.0, 70.0, 8.0, down=True), contact(8, 20.0, 30.0, 0.0, down=False)]
    assert panel.ask(other) == []


def test_the_panel_is_listened_to_for_as_long_as_anybody_wants_it(panel):
    first, second = panel.connect(), panel.connect()
    panel.ask(first, ASK)
    panel.ask(second, ASK)
    first.close()
    panel.settle()
    panel.control.heard(SAMPLES)
    assert len(panel.ask(second)) == 2
    panel.ask(second, {"kind": "unsubscribe"})
    panel.control.heard(SAMPLES)
    assert panel.control.heard is None
    assert panel.ask(second) == []
    panel.ask(second, ASK)
    panel.control.heard(SAMPLES)
    assert len(panel.ask(second)) == 2


def test_contacts_are_for_operators(panel_with):
    panel = panel_with()
    client = panel.connect(ORDINARY)
    (answer,) = panel.ask(client, ASK)
    assert answer["outcome"] == "refused"
    assert "operate" in answer["reason"]
    assert panel.control.heard is None
