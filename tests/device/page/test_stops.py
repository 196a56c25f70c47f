"""A stop by the page's second connection: it waits for nothing that the page has sent, and names the page; places are bounded."""

import asyncio
import contextlib
import json
import threading

import pytest
from device.page.conftest import ask
from patience import wait_for
from websockets.exceptions import InvalidStatus
from websockets.frames import Frame, Opcode
from websockets.sync.client import connect

from controller.device.application_socket.protocol.client_messages import BY_CHARACTERS
from controller.device.page import relay, stops
from controller.device.page.bridge import Bridge
from controller.device.page.settings import PageSettings
from controller.device.page.stops import StopLine

PATIENCE_S = 60.0
FLOOD = 10_000
FRAMES_AHEAD = 10  # that a turn or two of the bridge's loop evaluate
STOP = json.dumps({"kind": "stop", "id": "s"})


class Panel:
    """The panel's end of the socket: what it was asked, in order, each with the frames of pages that were evaluated before."""

    def __init__(self):
        self.evaluated = 0
        self.heard = []
        self.full = False
        self.writers = []
        self.loop = asyncio.get_running_loop()

    def lose(self):
        """End the connection that was accepted last."""
        self.loop.call_soon_threadsafe(self.writers[-1].close)

    async def serve(self, reader, writer):
        if self.full:
            writer.write(b'{"kind":"farewell","reason":"8 clients are connected already"}\n')
            writer.close()
            return
        self.writers.append(writer)
        while line := await reader.readline():
            asked = json.loads(line)
            self.heard.append((self.evaluated, asked))
            writer.write(json.dumps({"kind": "answer", "id": asked["id"], "outcome": "done"}).encode() + b"\n")
        writer.close()

    @property
    def stops(self):
        return [(count, asked.get("by")) for count, asked in self.heard if asked["kind"] == "stop"]


@pytest.fixture
def bridged(folder, monkeypatch, tmp_path):
    """Runs a test's pages, in a thread, with a panel and the address of a bridge; all of the bridge runs in this thread."""
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))

    def run(pages, **settings):
        async def serve():
            panel = Panel()
            path = str(folder / "fake.sock")
            server = await asyncio.start_unix_server(panel.serve, path)
            bridge, opened = Bridge(PageSettings(listen=("127.0.0.1",), port=0, socket=path, **settings), None), asyncio.Event()
            addresses = []
            running = asyncio.create_task(bridge.run(lambda found: (addresses.extend(found), opened.set())))
            await opened.wait()
            await asyncio.to_thread(pages, panel, addresses[0].rstrip("/"))
            running.cancel()
            await asyncio.gather(running, return_exceptions=True)
            server.close()
            while any(not writer.is_closing() for writer in panel.writers):
                await asyncio.sleep(0)

        asyncio.run(serve())

    return run


def page(origin, way):
    address = f"{origin.replace('http', 'ws')}/{way}"
    return connect(address, origin=origin, compression=None, open_timeout=PATIENCE_S, close_timeout=0.1)


def stopped(stopper, frame=STOP):
    stopper.send(frame)
    return json.loads(stopper.recv(PATIENCE_S))


@pytest.mark.parametrize("second", [True, False])
def test_it_waits_for_none_of_ten_thousand_frames_before_it(bridged, monkeypatch, second):
    sent, evaluated = threading.Event(), relay.evaluated

    def counted(*arguments):
        sent.wait(PATIENCE_S)  # until all is there; meanwhile the bridge does nothing at all
        panels[0].evaluated += 1
        return evaluated(*arguments)

    monkeypatch.setattr(relay, "evaluated", counted)
    panels = []

    def pages(panel, origin):
        panels.append(panel)
        with page(origin, "panel") as flood, page(origin, "stop") as stopper:
            flood.socket.sendall(Frame(Opcode.TEXT, b"{}").serialize(mask=True) * FLOOD)
            (stopper if second else flood).send(STOP)
            sent.set()
            wait_for("the stop", lambda: panel.stops)

    bridged(pages)
    ((count, _),) = panels[0].stops
    assert count <= FRAMES_AHEAD if second else count == FLOOD + 1


def test_it_says_for_whom_by_either_way_whatever_the_page_says(bridged):
    def pages(panel, origin):
        with page(origin, "panel") as first, page(origin, "stop") as second:
            assert stopped(second) == {"kind": "answer", "id": "s", "outcome": "done"}
            assert ask(first, kind="stop", by="root")["outcome"] == "done"
        assert [by for _, by in panel.stops] == [f"a page of '{origin}' at 127.0.0.1"] * 2

    bridged(pages)


def test_the_panel_takes_the_longest_name_of_a_page(bridged, monkeypatch):
    origin = f"http://{'a' * 250}"

    def pages(panel, own):
        with connect(f"{own.replace('http', 'ws')}/stop", origin=origin, compression=None) as stopper:
            stopped(stopper)
        ((_, by),) = panel.stops
        assert len(by) <= BY_CHARACTERS
        assert "a" * 50 in by

    bridged(pages, origins={origin: ()})


def test_whatever_is_sent_there_is_a_stop_and_has_one_answer(bridged):
    def pages(panel, origin):
        with page(origin, "stop") as stopper:
            frames = ["", "[", "{}", '{"id": 7}', '{"id": "' + "x" * 65 + '"}', "[" * 60_000, b"\xff", '{"kind": "arm", "id": 8}']
            assert [stopped(stopper, frame)["id"] for frame in frames] == [None, None, None, 7, None, None, None, 8]
        assert len(panel.stops) == len(frames)
        assert {asked["kind"] for _, asked in panel.heard} == {"stop", "subscribe"}

    bridged(pages)


def refused(origin, way="stop"):
    with pytest.raises(InvalidStatus) as refusal:
        page(origin, way)
    return refusal.value.response.status_code, refusal.value.response.body.decode()


def test_places_for_stops_are_bounded_take_no_pages_place_and_are_free_again(bridged):
    def pages(panel, origin):
        with contextlib.ExitStack() as stoppers:
            for _ in range(2):
                stoppers.enter_context(page(origin, "stop"))
            with page(origin, "stop"), page(origin, "panel") as first:
                assert refused(origin) == (503, "max_pages = 3 are open\n")
                assert ask(first, kind="stop")["outcome"] == "done"  # how a page stops that has no place there
                assert len(panel.writers) == 2  # of the panel's places all of them take one
            with wait_for("the place that is free again", lambda: opened(origin)) as another:
                assert stopped(another)["outcome"] == "done"
        wait_for("the panel's place", lambda: all(writer.is_closing() for writer in panel.writers) or None)

    def opened(origin):
        try:
            return page(origin, "stop")
        except InvalidStatus:
            return None

    bridged(pages, max_pages=3)


def test_where_the_panel_has_no_place_for_it_pages_use_their_own(bridged):
    def pages(panel, origin):
        panel.full = True
        assert refused(origin)[1].startswith("no place for stops at ")
        panel.full = False
        with page(origin, "stop") as stopper:
            panel.lose()  # the panel begins again
            assert stopped(stopper)["outcome"] == "done"
            panel.full = True
            panel.lose()
            assert stopped(stopper)["reason"].startswith("no panel at ")

    bridged(pages)


def test_a_stop_amid_which_the_panel_ends_the_connection_is_sent_again_without_waiting_for_an_answer(tmp_path, monkeypatch):
    monkeypatch.setattr(stops, "PANEL_S", 1e6)
    heard = []

    async def stopped():
        ended = asyncio.Semaphore(0)

        async def serve(reader, writer):
            while line := await reader.readline():
                asked = json.loads(line)
                heard.append(asked["kind"])
                if heard == ["subscribe", "stop"]:
                    break
                writer.write(json.dumps({"kind": "answer", "id": asked["id"], "outcome": "done"}).encode() + b"\n")
            writer.close()
            ended.release()

        async with await asyncio.start_unix_server(serve, tmp_path / "panel.sock"), asyncio.timeout(PATIENCE_S):
            line = StopLine(str(tmp_path / "panel.sock"))
            said = await line.stop("somebody")
            line.close()
            for _ in range(2):
                await ended.acquire()
        return said

    assert asyncio.run(stopped()) == ""
    assert heard == ["subscribe", "stop"] * 2
