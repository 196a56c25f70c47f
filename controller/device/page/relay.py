"""One page and its own connection to the panel: each frame is a line, each line a frame, until either side ends."""

from __future__ import annotations

import asyncio
import contextlib
from typing import Final

import msgspec
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode

from controller.device.page.outbox import Outbox, TooSlow
from controller.device.page.requests import Rate, judged
from controller.device.page.settings import PageSettings

LINE_BYTES_MAX: Final = 1 << 20  # of the panel, whose figures are the longest
SLOW_S: Final = 10.0  # that a frame may wait for a page to read
PAUSE_S: Final = 0.005  # after each message that is refused: a page that floods is read slowly
PANEL_S: Final = 5.0  # that the panel's socket may take to accept


class Ended(Exception):
    """Why a page's connection ends, with the code of the WebSocket's close frame."""

    def __init__(self, code: CloseCode, reason: str) -> None:
        super().__init__(reason)
        self.code = code


async def relay(page: ServerConnection, rights: frozenset[str], settings: PageSettings) -> None:
    """Pass messages on until page or panel ends the connection; the other side is then ended too."""
    try:
        async with asyncio.timeout(PANEL_S):
            from_panel, to_panel = await asyncio.open_unix_connection(settings.socket, limit=LINE_BYTES_MAX)
    except OSError as problem:  # TimeoutError among them
        reason = f"no panel at {settings.socket} ({problem.strerror or 'it does not answer'})"
        await page.close(CloseCode.TRY_AGAIN_LATER, _short(reason))
        return
    outbox, news = Outbox(), asyncio.Event()
    outbox.put(greeting(rights, settings))
    news.set()
    tasks = [
        asyncio.create_task(_requests(page, to_panel, outbox, news, rights, settings)),
        asyncio.create_task(_lines(from_panel, outbox, news)),
        asyncio.create_task(_frames(page, outbox, news)),
    ]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        await _end(page, next(task.exception() for task in done))
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        to_panel.transport.abort()  # what it has not read was of a page that is gone


def greeting(rights: frozenset[str], settings: PageSettings) -> bytes:
    """The first line that a page gets: its rights, and how the screen's pixels lie on the plate, null where nobody has said."""
    message = {
        "kind": "page",
        "rights": sorted(rights),
        "x_mm_from_pixels": settings.x_mm_from_pixels,
        "y_mm_from_pixels": settings.y_mm_from_pixels,
    }
    return msgspec.json.encode(message)


async def _requests(
    page: ServerConnection,
    to_panel: asyncio.StreamWriter,
    outbox: Outbox,
    news: asyncio.Event,
    rights: frozenset[str],
    settings: PageSettings,
) -> None:
    clock = asyncio.get_running_loop().time
    rate = Rate(settings.messages_per_s, settings.burst, clock())
    async for frame in page:
        if not isinstance(frame, str):
            raise Ended(CloseCode.UNSUPPORTED_DATA, "a frame has to be text: one JSON object")
        line, refusal = judged(frame, rights, rate, clock())
        if line:
            to_panel.write(line)
            await to_panel.drain()
        else:
            outbox.put(refusal.encode())
            news.set()
            await asyncio.sleep(PAUSE_S)


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
