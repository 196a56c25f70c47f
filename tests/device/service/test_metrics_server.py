"""The server for Prometheus: however many ask, and however they do, the panel is asked once a second."""

import asyncio
import contextlib
import socket

from prometheus_client import CollectorRegistry
from prometheus_client.core import GaugeMetricFamily
from tables import each_row

from controller.device.service.metrics_server import CONNECTIONS_MAX, KEPT_S, MetricsServer
from controller.errors import ControllerError

ASK = b"GET /metrics HTTP/1.1\r\nHost: localhost:9750\r\n\r\n"


class Counting:
    """A collector that counts how often it is asked."""

    def __init__(self, text="x" * 100):
        self.asked, self.text, self.error = 0, text, None

    def collect(self):
        self.asked += 1
        if self.error:
            raise self.error
        yield GaugeMetricFamily("metric_0", self.text, self.asked)


class Served:
    """A server on a free port, and the clock that it has."""

    def __init__(self, collector, hosts=(), connection_s=60.0):
        registry = CollectorRegistry()
        registry.register(collector)
        self.now_s = 100.0
        collector.asked = 0  # a registry looks at what it is given
        self.server = MetricsServer(registry, hosts, lambda: self.now_s, connection_s)

    async def __aenter__(self):
        listener = socket.create_server(("127.0.0.1", 0))
        self.port = listener.getsockname()[1]
        self._serving = asyncio.create_task(self.server.serve(listener))
        return self

    async def __aexit__(self, *_):
        self._serving.cancel()
        await asyncio.gather(self._serving, return_exceptions=True)

    async def connect(self):
        return await asyncio.open_connection("127.0.0.1", self.port)

    async def ask(self, request=ASK):
        """Status and body of an answer; nothing if there is none."""
        reader, writer = await self.connect()
        writer.write(request)
        answer = await everything(reader)
        writer.close()
        head, _, body = answer.partition(b"\r\n\r\n")
        return head.decode(), body.decode()

    async def connected(self):
        """Until a connection is accepted: it stays one for at least a turn of the loop."""
        while not self.server._connections:
            await asyncio.sleep(0)

    async def idle(self):
        """Until all connections are over."""
        while self.server._connections:
            await asyncio.sleep(0)


async def everything(reader):
    try:
        return await reader.read()
    except ConnectionError:
        return b""


def run(scenario, collector=None, **options):
    async def served():
        async with Served(collector or Counting(), **options) as server:
            return await scenario(server)

    return asyncio.run(served())


def test_all_who_ask_within_a_second_get_the_same_answer():
    collector = Counting()

    async def scenario(served):
        answers = await asyncio.gather(*(served.ask() for _ in range(CONNECTIONS_MAX)))
        answers += [await served.ask() for _ in range(200)]
        assert {body for _, body in answers} == {f"# HELP metric_0 {'x' * 100}\n# TYPE metric_0 gauge\nmetric_0 1.0\n"}
        assert {head.splitlines()[0] for head, _ in answers} == {"HTTP/1.1 200 OK"}
        assert "Content-Type: text/plain; version=0.0.4; charset=utf-8" in answers[0][0]
        assert collector.asked == 1
        served.now_s += KEPT_S
        assert (await served.ask())[1].endswith("metric_0 2.0\n")
        assert collector.asked == 2

    run(scenario, collector)


def changed(old, *new):
    return [ASK.replace(old, text) for text in new]


REQUESTS = {
    "200 OK": [
        ASK,
        *changed(b"/metrics", b"/metrics?name[]=x"),
        *changed(
            b"localhost:9750", b"LOCALHOST", b"127.0.0.1:9750", b"[::1]:9750", b"localhost.", b"panel-3.example:80", b"192.0.2.7"
        ),
    ],
    "404 Not Found": changed(b"/metrics", b"/", b"/metrics/", b"/metric", b"//metrics", b"http://x/metrics"),
    "421 Misdirected Request": [
        *changed(b"localhost", b"evil.example", b"", b"localhost.evil.example", b"["),
        *changed(b"Host", b"Hosts"),
        *changed(b"\r\n\r\n", b"\r\nHost: evil.example\r\n\r\n"),
    ],
    "405 Method Not Allowed": changed(b"GET", b"POST", b"HEAD", b"get", b"OPTIONS"),
    "400 Bad Request": changed(b"GET /metrics HTTP/1.1", b"", b"GET", b"GET /metrics", b"\xff\x00 x", b"GET / SIP/2.0"),
    "431 Request Header Fields Too Large": changed(b"Host", b"X: " + b"x" * 20_000 + b"\r\nHost"),
}


@each_row(("status", "request_"), [(status, request) for status, many in REQUESTS.items() for request in many])
def test_only_the_right_path_of_the_right_host_is_answered(status, request_):
    collector = Counting()

    async def scenario(served):
        head, body = await served.ask(request_)
        assert head.splitlines()[0] == f"HTTP/1.1 {status}"
        assert f"Content-Length: {len(body)}" in head.splitlines()

    run(scenario, collector, hosts=["Panel-3.example", "192.0.2.7"])
    assert collector.asked == (status == "200 OK")


def test_so_many_connections_and_no_more():
    async def scenario(served):
        held = [await served.connect() for _ in range(CONNECTIONS_MAX)]
        while served.server._connections < CONNECTIONS_MAX:
            await asyncio.sleep(0)
        assert await served.ask() == ("", "")
        for _, writer in held:
            writer.close()
        await served.idle()
        assert (await served.ask())[0].startswith("HTTP/1.1 200")

    run(scenario)


@each_row("sent", [b"", b"GET /met", ASK[:-1]])
def test_who_is_slow_to_ask_is_cut_off(sent):
    async def scenario(served):
        reader, writer = await served.connect()
        writer.write(sent)
        assert await everything(reader) == b""
        await served.idle()
        writer.close()

    run(scenario, connection_s=0.05)


def test_who_is_slow_to_read_is_cut_off():
    async def scenario(served):
        await served.server._metrics()
        with socket.socket() as reader:
            reader.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            reader.setblocking(False)
            loop = asyncio.get_running_loop()
            await loop.sock_connect(reader, ("127.0.0.1", served.port))
            await loop.sock_sendall(reader, ASK)
            await served.connected()
            await served.idle()
            got = 0
            with contextlib.suppress(ConnectionResetError):
                while more := len(await loop.sock_recv(reader, 1 << 16)):
                    got += more
        assert got < 50_000_000

    run(scenario, Counting(text="x" * 50_000_000), connection_s=0.3)


def test_one_whose_time_is_over_does_not_end_what_others_wait_for():
    """And nothing is asked twice at once: the connection to the panel is for one question at a time."""

    async def scenario(served):
        first = asyncio.create_task(served.server._metrics())
        second = asyncio.create_task(served.server._metrics())
        await asyncio.sleep(0)
        first.cancel()
        assert b"metric_0 1.0" in await second

    run(scenario)


def test_what_cannot_be_collected_is_said_and_tried_again_later():
    collector = Counting()

    async def scenario(served):
        collector.error = ControllerError("the disk is gone")
        for _ in range(2):
            head, body = await served.ask()
            assert (head.splitlines()[0], body) == ("HTTP/1.1 503 Service Unavailable", "the disk is gone\n")
        assert collector.asked == 1
        collector.error = None
        served.now_s += KEPT_S
        assert (await served.ask())[0].startswith("HTTP/1.1 200")

    run(scenario, collector)
