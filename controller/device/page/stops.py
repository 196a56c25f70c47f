"""Stops of pages, by connections that carry nothing else: one of each page, and one of the bridge to the panel."""

from __future__ import annotations

import asyncio
import contextlib
from typing import Any, Final

import msgspec
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

from controller.device.application_socket.protocol.client_messages import BY_CHARACTERS, Numbered
from controller.device.page.addresses import shown
from controller.device.page.requests import answer

ATTEMPTS: Final = 2  # the connection may have been lost since the last one
PANEL_S: Final = 5.0  # that the panel may take to answer
HOLD: Final = {"kind": "subscribe", "to": ["faults"]}  # a client that listens keeps its place
LINE_BYTES_MAX: Final = 1 << 16


class StopLine:
    """The bridge's own connection to the panel; opened again where it was lost."""

    def __init__(self, socket: str) -> None:
        self._socket = socket
        self._to_panel: asyncio.StreamWriter | None = None
        self._reading: asyncio.Task[None] | None = None
        self._waiting: dict[int, asyncio.Future[dict[str, Any]]] = {}
        self._last = 0
        self._opening = asyncio.Lock()

    async def open(self) -> None:
        """Connect, if it is not connected, and hold a place; raises OSError if there is no panel, or none that has a place."""
        async with self._opening, asyncio.timeout(PANEL_S):
            if self._to_panel is None:
                from_panel, self._to_panel = await asyncio.open_unix_connection(self._socket, limit=LINE_BYTES_MAX)
                self._reading = asyncio.create_task(self._read(from_panel))
                await self._ask(HOLD)

    async def stop(self, by: str) -> str:
        """Stop the panel for somebody; why it did not, empty if it did."""
        problem = OSError()
        for _ in range(ATTEMPTS):
            try:
                await self.open()
                async with asyncio.timeout(PANEL_S):
                    said = await self._ask({"kind": "stop", "by": by})
                return str(said.get("reason", ""))
            except OSError as error:  # TimeoutError among them
                problem = error
                self.close()
        return f"no panel at {self._socket} ({why(problem)})"

    def close(self) -> None:
        """Give up the panel's place."""
        if self._reading is not None:
            self._reading.cancel()
        self._lose()

    async def _ask(self, message: dict[str, Any]) -> dict[str, Any]:
        if self._to_panel is None:
            raise ConnectionError("the panel has ended the connection")
        self._last += 1
        asked: asyncio.Future[dict[str, Any]] = asyncio.get_running_loop().create_future()
        self._waiting[self._last] = asked
        self._to_panel.write(msgspec.json.encode(message | {"id": self._last}) + b"\n")
        return await asked

    async def _read(self, from_panel: asyncio.StreamReader) -> None:
        with contextlib.suppress(OSError, ValueError):
            while line := await from_panel.readline():
                said = msgspec.json.decode(line)
                asked = self._waiting.pop(said.get("id"), None)
                if asked is not None and not asked.done():
                    asked.set_result(said)
        self._lose()

    def _lose(self) -> None:
        if self._to_panel is not None:
            self._to_panel.transport.abort()
        self._to_panel = None
        for asked in self._waiting.values():
            if not asked.done():
                asked.set_exception(ConnectionError("the panel has ended the connection"))
        self._waiting.clear()


def why(problem: OSError) -> str:
    """What is wrong with the panel's socket."""
    return problem.strerror or str(problem) or "it does not answer"


def page_name(origin: str, page: ServerConnection) -> str:
    """What a page is called where it stops the panel: its origin, and its address."""
    return f"a page of {shown(origin)} at {page.remote_address[0]}"[:BY_CHARACTERS]


async def stop_page(page: ServerConnection, line: StopLine, by: str) -> None:
    """Take each frame of a page for a stop, one after the other, until the page ends the connection."""
    with contextlib.suppress(ConnectionClosed):
        async for frame in page:
            try:
                number = msgspec.json.decode(frame, type=Numbered).id
            except (msgspec.DecodeError, RecursionError, UnicodeError):
                number = None
            await page.send(answer(number, await line.stop(by)))
