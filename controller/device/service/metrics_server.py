"""A small http server for Prometheus: one answer a second, however many ask, and bounded connections and times.

Whoever can reach the port may ask. So nothing that they do reaches the panel more than once a second, a client that is slow to
write or to read is cut off, and a request to another name than this server's, as a web page makes one whose name was rebound to
this address, is refused.
"""

from __future__ import annotations

import asyncio
import socket
import time
from collections.abc import Callable, Iterable
from email.parser import BytesHeaderParser
from http import HTTPStatus
from typing import Final

from prometheus_client import CollectorRegistry, generate_latest

from controller.errors import ControllerError

PATH: Final = "/metrics"
KEPT_S: Final = 1.0  # for which an answer is given again
CONNECTIONS_MAX: Final = 16
CONNECTION_S: Final = 10.0  # for request and answer together
REQUEST_SHARE: Final = 4  # of that time, in which the request has come
REQUEST_BYTES_MAX: Final = 8192
TEXT_FORMAT: Final = "text/plain; version=0.0.4; charset=utf-8"  # every Prometheus reads it
LOOPBACK: Final = frozenset({"localhost", "127.0.0.1", "::1"})


class MetricsServer:
    """Serves the metrics of a registry at `PATH`."""

    def __init__(
        self,
        registry: CollectorRegistry,
        hosts: Iterable[str] = (),  # names and addresses that requests may be made to, besides those of the loopback interface
        now_s: Callable[[], float] = time.monotonic,  # monotonic time
        connection_s: float = CONNECTION_S,  # longest time of a connection
    ) -> None:
        self._registry = registry
        self._hosts = LOOPBACK | {host.lower() for host in hosts}
        self._now_s = now_s
        self._connection_s = connection_s
        self._reported: asyncio.Task[bytes] | None = None
        self._until_s = 0.0
        self._connections = 0

    async def serve(self, listener: socket.socket) -> None:
        """Answer until cancelled."""
        server = await asyncio.start_server(self._connected, sock=listener, limit=REQUEST_BYTES_MAX)
        async with server:
            await server.serve_forever()

    async def _connected(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        if self._connections >= CONNECTIONS_MAX:
            writer.transport.abort()
            return
        self._connections += 1
        try:
            async with asyncio.timeout(self._connection_s):
                writer.write(await self._answer(reader))
                writer.close()
                await writer.wait_closed()
        except (TimeoutError, OSError, asyncio.IncompleteReadError):
            pass
        finally:
            writer.transport.abort()  # with whatever a slow reader has not taken
            self._connections -= 1

    async def _answer(self, reader: asyncio.StreamReader) -> bytes:
        try:
            async with asyncio.timeout(self._connection_s / REQUEST_SHARE):
                head = await reader.readuntil(b"\r\n\r\n")
        except asyncio.LimitOverrunError:
            return _response(HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE, "the request is too long")
        line, _, fields = head.partition(b"\r\n")
        method, _, rest = line.decode("latin-1").partition(" ")
        target, _, version = rest.rpartition(" ")
        if not target or not version.startswith("HTTP/1."):
            return _response(HTTPStatus.BAD_REQUEST, "no request of HTTP/1")
        hosts = BytesHeaderParser().parsebytes(fields).get_all("Host", [])
        if len(hosts) != 1 or _name(hosts[0]) not in self._hosts:
            return _response(HTTPStatus.MISDIRECTED_REQUEST, "no name of this server: `haptic-panel metrics --host NAME` adds one")
        if method != "GET":
            return _response(HTTPStatus.METHOD_NOT_ALLOWED, "GET only", "Allow: GET")
        if target.partition("?")[0] != PATH:
            return _response(HTTPStatus.NOT_FOUND, f"metrics are at {PATH}")
        try:
            return _response(HTTPStatus.OK, await self._metrics(), f"Content-Type: {TEXT_FORMAT}")
        except (ControllerError, OSError) as error:
            return _response(HTTPStatus.SERVICE_UNAVAILABLE, str(error))

    async def _metrics(self) -> bytes:
        """What is reported now, or was within the last second; whoever asks meanwhile waits for the same."""
        if self._reported is None or (self._reported.done() and self._now_s() >= self._until_s):
            self._reported = asyncio.create_task(self._collect())
        return await asyncio.shield(self._reported)  # one whose time is over does not end it for others

    async def _collect(self) -> bytes:
        try:
            return await asyncio.to_thread(generate_latest, self._registry)
        finally:
            self._until_s = self._now_s() + KEPT_S


def _name(host: str) -> str:
    """Name or address in a Host field, without its port."""
    name = host.strip().lower()
    if name.startswith("["):
        return name[1:].partition("]")[0]
    return name.partition(":")[0].removesuffix(".")


def _response(status: HTTPStatus, body: str | bytes, *fields: str) -> bytes:
    content = f"{body}\n".encode() if isinstance(body, str) else body
    lines = [f"HTTP/1.1 {status.value} {status.phrase}", f"Content-Length: {len(content)}", "Connection: close", *fields]
    if status is not HTTPStatus.OK:
        lines.append("Content-Type: text/plain; charset=utf-8")
    return "\r\n".join([*lines, "", ""]).encode() + content
