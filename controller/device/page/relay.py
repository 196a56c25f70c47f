"""One page and its own connection to the panel: each frame is a line, each line a frame, until either side ends."""

from __future__ import annotations

import asyncio
import contextlib
from pathlib import Path
from typing import Final

import msgspec
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode

from controller.device.application_socket.token_bucket import TokenBucket
from controller.device.page.names import load_names
from controller.device.page.outbox import Outbox, TooSlow
from controller.device.page.requests import OwnKinds, evaluated, outcome
from controller.device.page.screen import Screen, ScreenPlace
from controller.device.page.settings import PageSettings
from controller.device.page.tools import PageTools
from controller.device.page.traces import TraceFolder

LINE_BYTES_MAX: Final = 1 << 20  # of the panel, whose figures are the longest
SLOW_S: Final = 10.0  # that a frame may wait for a page to read
REFUSED_AT_ONCE: Final = 64  # messages of a page, of which a stop may be the next
PAUSE_S: Final = 0.001  # after as many: a page that floods takes no whole core
NAMES: Final = load_names()
PANEL_S: Final = 5.0  # that the panel's socket may take to accept


class Ended(Exception):
    """Why a page's connection ends, with the code of the WebSocket's close frame."""

    def __init__(self, code: CloseCode, reason: str) -> None:
        super().__init__(reason)
        self.code = code


async def relay(
    page: ServerConnection, rights: frozenset[str], called: str, settings: PageSettings, screen: Screen, running: set[str]
) -> None:
    """Pass messages on until page or panel ends the connection; the other side is then ended too.

    `called` is what the page is called where it stops the panel, `screen` where the screen lies on the plate: the page is greeted
    with it, and again when it changes. `running` is as in `PageTools`, of all pages.
    """
    try:
        async with asyncio.timeout(PANEL_S):
            from_panel, to_panel = await asyncio.open_unix_connection(settings.socket, limit=LINE_BYTES_MAX)
    except OSError as problem:  # TimeoutError among them
        reason = f"no panel at {settings.socket} ({problem.strerror or 'it does not answer'})"
        await page.close(CloseCode.TRY_AGAIN_LATER, _short(reason))
        return
    outbox, news = Outbox(), asyncio.Event()

    def put(line: bytes) -> None:
        with contextlib.suppress(TooSlow):  # which whatever comes from the panel finds out, too
            outbox.put(line)
        news.set()

    def greet() -> None:
        put(greeting(rights, screen.place))

    greet()
    forget = screen.watch(greet)
    tools = PageTools(settings.socket, page.remote_address[0], TraceFolder(Path(settings.socket).parent), running, put)
    own = {"screen": lambda message: {"kind": "answer"} | outcome(screen.keep(message))} | dict(tools.kinds)
    judge = _Judge(rights, TokenBucket(settings.messages_per_s, settings.burst), own, called)
    tasks = [
        asyncio.create_task(_requests(page, to_panel, outbox, news, judge)),
        asyncio.create_task(_lines(from_panel, outbox, news)),
        asyncio.create_task(_frames(page, outbox, news)),
    ]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        await _end(page, next(task.exception() for task in done))
    finally:
        forget()
        await tools.close()
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        to_panel.transport.abort()  # what it has not read was of a page that is gone


def greeting(rights: frozenset[str], place: ScreenPlace | None) -> bytes:
    """The first line that a page gets: rights, how the screen's pixels lie on the plate (null: unknown), other names of effects."""
    message = {
        "kind": "page",
        "rights": sorted(rights),
        "x_mm_from_pixels": None if place is None else place.x_mm_from_pixels,
        "y_mm_from_pixels": None if place is None else place.y_mm_from_pixels,
        "names": NAMES,
    }
    return msgspec.json.encode(message)


class _Judge:
    """Judges the frames of one page."""

    def __init__(self, rights: frozenset[str], rate: TokenBucket, own: OwnKinds, called: str = "") -> None:
        self._rights = rights
        self._rate = rate
        self._clock = asyncio.get_running_loop().time
        self._own = own
        self._called = called
        rate.fill(self._clock())

    def __call__(self, frame: str) -> tuple[bytes, str]:
        return evaluated(frame, self._rights, self._rate, self._clock(), self._own, self._called)


async def _requests(
    page: ServerConnection,
    to_panel: asyncio.StreamWriter,
    outbox: Outbox,
    news: asyncio.Event,
    judge: _Judge,
) -> None:
    refused = 0
    async for frame in page:
        if not isinstance(frame, str):
            raise Ended(CloseCode.UNSUPPORTED_DATA, "a frame has to be text: one JSON object")
        line, answer = judge(frame)
        if line:
            to_panel.write(line)
            await to_panel.drain()
        else:
            if answer:
                outbox.put_if_room(answer.encode())
                news.set()
            refused += 1
            await asyncio.sleep(0 if refused % REFUSED_AT_ONCE else PAUSE_S)


async def _lines(from_panel: asyncio.StreamReader, outbox: Outbox, news: asyncio.Event) -> None:
    while line := await from_panel.readline():
        outbox.put(line)
        news.set()
    with contextlib.suppress(TimeoutError):  # its farewell is to be read
        async with asyncio.timeout(1.0):
            while outbox:
                await asyncio.sleep(0.01)
    raise Ended(CloseCode.SERVICE_RESTART, "the panel has ended the connection")


async def _frames(page: ServerConnection, outbox: Outbox, news: asyncio.Event) -> None:
    while True:
        await news.wait()
        news.clear()
        while outbox:
            async with asyncio.timeout(SLOW_S):
                await page.send(outbox.take())


async def _end(page: ServerConnection, error: BaseException | None) -> None:
    """Close a page's connection with the reason; one that does not read is cut off."""
    match error:
        case None | ConnectionClosed():
            return
        case Ended():
            await page.close(error.code, _short(str(error)))
        case TooSlow() | TimeoutError():
            page.transport.abort()
        case OSError() | ValueError():  # of the panel's socket; a line that is too long
            await page.close(CloseCode.SERVICE_RESTART, _short(f"the panel has ended the connection ({error})"))
        case _:
            raise error


def _short(reason: str) -> str:
    """A reason as it fits into a close frame: 123 bytes."""
    return reason.encode()[:123].decode(errors="ignore")
