"""The bridge: files and one WebSocket per page on the same origin, behind the tables of `permissions`."""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import signal
from collections.abc import Callable
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
from pathlib import Path
from typing import Any, Final
from urllib.parse import parse_qs

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from controller.device.board.paths import state_folder
from controller.device.page.credentials import read_token, tls_context
from controller.device.page.files import Served, served
from controller.device.page.library_log import library_log
from controller.device.page.permissions import Permissions, Refusal
from controller.device.page.relay import relay
from controller.device.page.requests import FRAME_BYTES
from controller.device.page.screen import Screen
from controller.device.page.settings import PageSettings
from controller.device.page.stops import StopLine, page_name, stop_page, why
from controller.errors import ConfigError, ControllerError
from controller.log import Priority, log

SOCKET_PATH: Final = "/panel"
STOP_PATH: Final = "/stop"
COOKIE: Final = "haptic-panel-token"
OTHER_CONNECTIONS: Final = 64  # besides the pages: files that are fetched, and what is half open
HANDSHAKE_S: Final = 10.0
PING_S: Final = 20.0
REFUSALS_SHOWN: Final = 100  # in the log, each once


class PageConnection(ServerConnection):
    """A connection, with the rights of its page, and what it is called."""

    rights: frozenset[str] = frozenset()
    called = ""


class Bridge:
    """Answers browsers, within the limits and rights of the settings, which come from `file`.

    Raises ConfigError if the token, the certificate or the folder of files cannot be read, or there is no folder for what is kept.
    """

    def __init__(self, settings: PageSettings, file: Path | None) -> None:
        self._settings = settings
        self._permissions = Permissions(settings, file)
        self._www = Path(settings.www) if settings.www else None
        if self._www is not None and not self._www.is_dir():
            raise ConfigError(f"www = {settings.www!r}: there is no such folder")
        self._field = Path(settings.field).resolve() if settings.field else None
        if self._field is not None and not self._field.is_file():
            raise ConfigError(f"field = {settings.field!r}: there is no such file; `haptic-panel focus --field-out FILE` makes one")
        self._screen = Screen(settings, state_folder() / "screen.json")
        self._token = read_token(Path(settings.token_file)) if settings.token_file else ""
        self._tls = tls_context(settings)
        self._connections = 0
        self._open = {SOCKET_PATH: 0, STOP_PATH: 0}  # at most `max_pages` of each
        self._stop_line = StopLine(settings.socket)
        self._shown: set[str] = set()
        self._running: set[str] = set()  # for its pages

    async def run(self, ready: Callable[[list[str]], None]) -> None:
        """Serve until SIGTERM or SIGINT; `ready` is given the addresses of the page, once they are open.

        Raises ControllerError if no address can be listened at.
        """
        ended = asyncio.Event()
        loop = asyncio.get_running_loop()
        for number in (signal.SIGTERM, signal.SIGINT):
            loop.add_signal_handler(number, ended.set)
        async with contextlib.AsyncExitStack() as stack:
            ready([self._address(server) for server in await self._listen(stack)])
            await ended.wait()

    async def _listen(self, stack: contextlib.AsyncExitStack) -> list[Server]:
        """Servers of all addresses that this machine has; one port serves them all."""
        servers: list[Server] = []
        problem = ""
        port = self._settings.port
        for address in self._settings.listen:
            try:
                server = await stack.enter_async_context(self._server(address, port))
            except OSError as error:
                problem = f"cannot listen at {address}, port {port} ({error.strerror or error})"
                log(problem, Priority.WARNING)
                continue
            servers.append(server)
            port = port or server.sockets[0].getsockname()[1]
        if not servers:
            raise ControllerError(problem)
        return servers

    def _server(self, address: str, port: int) -> Server:
        return serve(
            self._page,
            address,
            port,
            create_connection=self._connection,  # type: ignore[arg-type]  # a factory will do
            process_request=self._request,
            compression=None,  # memory and latency, for messages of 100 bytes
            max_size=FRAME_BYTES,
            open_timeout=HANDSHAKE_S,
            ping_interval=PING_S,
            ping_timeout=PING_S,
            close_timeout=1.0,
            server_header=None,
            ssl=self._tls,
            logger=library_log(),
        )

    def _address(self, server: Server) -> str:
        host, port = server.sockets[0].getsockname()[:2]
        return f"{self._settings.scheme}://{f'[{host}]' if ':' in host else host}:{port}/"

    def _connection(self, *arguments: Any, **options: Any) -> PageConnection:
        """A connection, or one that is cut off when there are too many."""
        bridge = self

        class Counted(PageConnection):
            def connection_made(self, transport: asyncio.BaseTransport) -> None:
                bridge._connections += 1
                super().connection_made(transport)
                if bridge._connections > 2 * bridge._settings.max_pages + OTHER_CONNECTIONS:
                    self.transport.abort()

            def connection_lost(self, error: Exception | None) -> None:
                bridge._connections -= 1
                super().connection_lost(error)

        return Counted(*arguments, **options)

    async def _request(self, connection: ServerConnection, request: Request) -> Response | None:
        """Answer to a request; None opens the socket."""
        assert isinstance(connection, PageConnection)
        hosts = request.headers.get_all("Host")
        refusal = self._permissions.host_refusal(hosts)
        if refusal is not None:
            return self._refused(refusal)
        if self._token and (answer := self._without_token(request)) is not None:
            return answer
        path = request.path.partition("?")[0]
        if path not in self._open:
            return _response(await asyncio.to_thread(served, self._www, request.path, self._field), self._settings)
        origins = request.headers.get_all("Origin")
        rights = self._permissions.rights(origins, hosts[0])
        if isinstance(rights, Refusal):
            return self._refused(rights)
        reason = await self._no_place(path)
        if reason:
            return self._refused(Refusal(HTTPStatus.SERVICE_UNAVAILABLE, reason))
        connection.rights, connection.called = rights, page_name(origins[0], connection)
        return None

    async def _no_place(self, path: str) -> str:
        """Why a page cannot be connected now; empty if it can."""
        if path == STOP_PATH:
            try:
                await self._stop_line.open()
            except OSError as error:
                self._stop_line.close()
                return f"no place for stops at {self._settings.socket} ({why(error)})"
        most = self._settings.max_pages
        return f"max_pages = {most} are open" if self._open[path] >= most else ""

    async def _page(self, connection: ServerConnection) -> None:
        assert isinstance(connection, PageConnection)
        assert connection.request is not None
        path = connection.request.path.partition("?")[0]
        self._open[path] += 1
        try:
            if path == STOP_PATH:
                await stop_page(connection, self._stop_line, connection.called)
            else:
                await relay(connection, connection.rights, connection.called, self._settings, self._screen, self._running)
        finally:
            self._open[path] -= 1
            if not self._open[STOP_PATH]:
                self._stop_line.close()

    def _refused(self, refusal: Refusal) -> Response:
        if refusal.reason not in self._shown and len(self._shown) < REFUSALS_SHOWN:
            self._shown.add(refusal.reason)
            log(f"refused: {refusal.reason}", Priority.WARNING)
        return _response(Served(refusal.status, f"{refusal.reason}\n".encode()), self._settings)

    def _without_token(self, request: Request) -> Response | None:
        """Answer to a request without the token; None if it has it. An address with `?token=` hands it over, once, for a cookie."""
        path, _, query = request.path.partition("?")
        given = parse_qs(query).get("token", [""])[0]
        if given and self._is_token(given):
            answer = _response(Served(HTTPStatus.FOUND, b"", location=path if not path.startswith("//") else "/"), self._settings)
            answer.headers["Set-Cookie"] = f"{COOKIE}={self._token}; Path=/; Max-Age=31536000; HttpOnly; SameSite=Strict; Secure"
            return answer
        try:
            cookie = SimpleCookie("; ".join(request.headers.get_all("Cookie"))).get(COOKIE)
        except CookieError:
            cookie = None
        if cookie is not None and self._is_token(cookie.value):
            return None
        reason = f"open {self._settings.scheme}://…/?token=TOKEN once; the token is in {self._settings.token_file}"
        return self._refused(Refusal(HTTPStatus.UNAUTHORIZED, reason))

    def _is_token(self, given: str) -> bool:
        return hmac.compare_digest(given.encode(), self._token.encode())


def _response(answer: Served, settings: PageSettings) -> Response:
    headers = Headers(
        {
            "Content-Type": answer.content_type,
            "Content-Length": str(len(answer.body)),
            "Content-Security-Policy": settings.content_security_policy,
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Cache-Control": "no-cache",
            "Connection": "close",
        }
    )
    if answer.location:
        headers["Location"] = answer.location
    return Response(answer.status.value, answer.status.phrase, headers, answer.body)
