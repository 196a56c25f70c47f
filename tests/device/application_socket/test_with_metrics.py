"""Prometheus and the panel: one connection, one question a second, and a user who may only look."""

import asyncio
import grp
import os
import socket
import threading

import pytest

from controller.device.application_socket.connections.peers import Peer, Rights
from controller.device.board.devices import LOOK_GROUP, ApplicationSocket
from controller.device.loop.playing.due_emissions import MAX_WAITING_COMMANDS
from controller.device.service.metrics_server import MetricsServer
from controller.device.service.prometheus import PanelCollector, PanelFigures, registry
from controller.errors import ControllerError

LOOK, OPERATE_GROUP = [group for group in grp.getgrall() if group.gr_gid not in (0, os.getegid(), 65534)][:2]
PLAY = {"kind": "play", "effect": "click", "x_mm": 100, "y_mm": 70}
OPERATIONS = ({"kind": "arm"}, {"kind": "disarm"}, {"kind": "load_scene", "name": "drums"})
METRICS = Peer(50_009, 19, frozenset({50_009, LOOK.gr_gid, OPERATE_GROUP.gr_gid}))


@pytest.fixture
def panel(panel_with):
    return panel_with(look_group=LOOK.gr_name, operate_group=OPERATE_GROUP.gr_name)


def turning(panel, work):
    """What a function gives that talks with the panel, while the panel's loop turns."""
    result = []
    thread = threading.Thread(target=lambda: result.append(work()))
    thread.start()
    while thread.is_alive():
        panel.turn()
    thread.join()
    (value,) = result
    return value


def test_twenty_scrapers_make_two_lines_at_the_panel(panel):
    now_s = [50.0]
    panel.peers.append(METRICS)
    figures = PanelFigures(panel.settings.path)
    server = MetricsServer(registry(PanelCollector(figures)), now_s=lambda: now_s[0])

    async def scraped(times):
        listener = socket.create_server(("127.0.0.1", 0))
        serving = asyncio.create_task(server.serve(listener))

        async def scraper():
            answers = []
            for _ in range(times):
                reader, writer = await asyncio.open_connection(*listener.getsockname())
                writer.write(b"GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n")
                try:
                    answers.append(await reader.read())
                except ConnectionResetError:
                    answers.append(b"")  # more than it has connections for
                writer.close()
            return answers

        answers = await asyncio.gather(*(scraper() for _ in range(20)))
        serving.cancel()
        await asyncio.gather(serving, return_exceptions=True)
        return [answer for one in answers for answer in one if answer]

    answers = turning(panel, lambda: asyncio.run(scraped(10)))
    assert len(answers) >= 100
    assert all(b"haptic_panel_up 1.0\n" in answer and b"haptic_panel_emissions_total 7.0\n" in answer for answer in answers)
    counters = panel.socket.counters
    assert (counters.lines, counters.clients_accepted) == (2, 1)  # hello and figures
    now_s[0] += 1.0
    turning(panel, lambda: asyncio.run(scraped(1)))
    assert (counters.lines, counters.clients_accepted) == (3, 1)
    figures.close()


def test_a_panel_that_was_started_anew_is_asked_by_another_connection(panel):
    figures = PanelFigures(panel.settings.path)
    assert turning(panel, figures)[2]["emissions"] == 7
    for client in list(panel.socket._clients):
        panel.socket._clients._disconnect(client)
    assert turning(panel, figures)[2]["emissions"] == 7
    assert panel.socket.counters.clients_accepted == 2
    panel.close()
    for _ in range(2):
        with pytest.raises(ControllerError, match="no panel to talk to"):
            figures()


def test_one_who_may_look_sees_state_and_figures_and_nothing_more(panel):
    client = panel.connect(METRICS)
    (hello,) = panel.ask(client, {"kind": "hello"})
    assert hello["rights"] == ["look"]
    assert [answer["kind"] for answer in panel.ask(client, {"kind": "figures"}, {"kind": "state"})] == ["figures", "state"]
    assert [answer["kind"] for answer in panel.ask(client, {"kind": "subscribe", "to": ["state"]})] == ["answer", "state"]
    refused = [PLAY, {"kind": "subscribe"}, {"kind": "subscribe", "to": ["state", "touches"]}, *OPERATIONS]
    for request in refused:
        (answer,) = panel.ask(client, {**request, "id": 1})
        right = "operate" if request in OPERATIONS else "play"
        assert answer["outcome"] == "refused"
        assert f"uid 50009 (pid 19) does not have the right to {right}: " in answer["reason"]
    assert panel.control.plays == panel.control.switched == panel.control.scenes == []
    assert panel.socket.counters.not_allowed == len(refused)
    assert panel.socket._clients.touch_subscribers == 0


def test_one_who_may_only_look_takes_no_share_of_the_commands(panel_with):
    panel = panel_with(look_group=LOOK.gr_name, burst=1000)
    panel.ask(panel.connect(METRICS), {"kind": "hello"})
    panel.ask(panel.connect(Peer(50_001, 11, frozenset({50_001}))), *[PLAY] * MAX_WAITING_COMMANDS)
    assert len(panel.control.plays) == MAX_WAITING_COMMANDS


def test_the_group_that_may_only_look_need_not_exist_unless_it_was_named(settings, changed):
    assert settings.look_group == LOOK_GROUP == ApplicationSocket().look_group
    stranger = Peer(50_004, 14, frozenset({50_004}))
    for group in (LOOK_GROUP, ""):
        assert Rights(changed(settings, look_group=group)).of(stranger) == ("play",)
    with pytest.raises(ControllerError, match=r"application_socket.look_group = 'nobody-like-this': no such group"):
        Rights(changed(settings, look_group="nobody-like-this"))
    assert Rights(changed(settings, look_group=LOOK.gr_name)).of(Peer(0, 1, frozenset({LOOK.gr_gid}))) == (
        "play",
        "regions",
        "operate",
    )
