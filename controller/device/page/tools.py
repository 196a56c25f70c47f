"""Commands of this program that the bridge runs for a page, as processes that end with it: what takes NumPy or minutes."""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, Final, Literal

import msgspec
from msgspec import Meta

from controller.device.page.mouse_steps import ArrivedSteps, MouseSteps
from controller.device.page.requests import OwnKinds, outcome
from controller.device.page.traces import TraceFolder
from controller.errors import ConfigError

LINE_BYTES: Final = 1 << 16
SAID_BYTES: Final = 1 << 12  # of what a command complains of: the last
ENVIRONMENT: Final = {"OPENBLAS_NUM_THREADS": "1", "COLUMNS": "1000"}
PointMm = tuple[float, float]
Fed = Callable[["asyncio.StreamWriter | None"], None]
WORDS: Final = {"axes": (), "ghosts": ("--ghosts",), "lag": ("--lag", "--reference", "-")}
ELSEWHERE: Final = (
    "the lag is measured in a browser on the panel's own machine, since the clock of another one runs at its own rate: open this"
    " page there, as localhost; or stop the service, then `haptic-panel calibrate-touch --lag --reference"
    " /dev/input/by-id/…-event-mouse`"
)
WAITING_BYTES: Final = 1 << 20  # of a mouse's steps


class Calibrate(msgspec.Struct, forbid_unknown_fields=True, tag_field="kind", tag="calibrate"):
    """Request to calibrate the touch panel, with targets of the page's own."""

    what: Literal["axes", "ghosts", "lag"]
    at_mm: Annotated[tuple[PointMm, ...], Meta(max_length=5)] = ()
    id: int | str | None = None


class PageTools:
    """What one page has had started.

    `socket` is the panel's, `address` the page's; `running` are the kinds of requests that are being carried out for any page: one
    of each at a time. `put` sends a line to the page.
    """

    def __init__(self, socket: str, address: str, traces: TraceFolder, running: set[str], put: Callable[[bytes], None]) -> None:
        self._socket = socket
        self._address = address
        self._feed: asyncio.StreamWriter | None = None  # of the lag that is being measured
        self._traces = traces
        self._running = running
        self._put = put
        self._tasks: dict[str, asyncio.Task[None]] = {}

    @property
    def kinds(self) -> OwnKinds:
        """What it answers."""
        return {
            "traces": self._traces.listed,
            "read_trace": self._traces.part,
            "explain_trace": self._explain,
            "calibrate": self._calibrate,
            "mouse": self._mouse,
            "cancel": self._cancel,
        }

    async def close(self) -> None:
        """End what still runs."""
        for task in self._tasks.values():
            task.cancel()
        await asyncio.gather(*self._tasks.values(), return_exceptions=True)

    def _explain(self, message: dict[str, Any]) -> None:
        lines: list[str] = []
        words = ["trace", str(self._traces.path(message.get("name")))]
        self._start(message, words, lines.append, lambda: {"kind": "explained", "lines": lines})

    def _calibrate(self, message: dict[str, Any]) -> None:
        try:
            asked = msgspec.convert(message, Calibrate)
        except msgspec.ValidationError as error:
            raise ConfigError(str(error)) from error
        if asked.what == "lag" and not ipaddress.ip_address(self._address).is_loopback:
            raise ConfigError(ELSEWHERE)
        words = ["calibrate-touch", "--socket", self._socket, "--json", *WORDS[asked.what]]
        for x_mm, y_mm in asked.at_mm:
            words += ["--at", repr(x_mm), repr(y_mm)]
        fed = self._fed if asked.what == "lag" else None
        self._start(message, words, self._progress, lambda: {"kind": "answer"} | outcome(""), fed)

    def _fed(self, feed: asyncio.StreamWriter | None) -> None:
        self._feed = feed

    def _mouse(self, message: dict[str, Any]) -> dict[str, Any]:
        try:
            steps = msgspec.convert(message, MouseSteps)
        except msgspec.ValidationError as error:
            raise ConfigError(str(error)) from error
        now_s = time.monotonic()
        if self._feed is None or self._feed.transport.get_write_buffer_size() > WAITING_BYTES:
            raise ConfigError("no lag is being measured")
        arrived = ArrivedSteps(sent_ms=steps.sent_ms, steps=steps.steps, answered=steps.answered, arrived_s=now_s)
        self._feed.write(msgspec.json.encode(arrived) + b"\n")
        return {"kind": "answer", "time_s": time.monotonic()} | outcome("")

    def _cancel(self, _: dict[str, Any]) -> dict[str, Any]:
        task = self._tasks.get("calibrate")
        if task is None:
            raise ConfigError("nothing to cancel: this page has no calibration running")
        task.cancel()
        return {"kind": "answer"} | outcome("")

    def _progress(self, line: str) -> None:
        with contextlib.suppress(msgspec.DecodeError):
            self._send(None, {"kind": "calibration"} | dict(msgspec.json.decode(line, type=dict[str, Any])))

    def _start(
        self,
        message: dict[str, Any],
        words: Sequence[str],
        heard: Callable[[str], None],
        done: Callable[[], Mapping[str, Any]],
        fed: Fed | None = None,
    ) -> None:
        """Run a command beside everything else; the answer to the message follows when it has ended."""
        kind = message["kind"]
        if kind in self._running:
            raise ConfigError(
                f"{kind}: {'this' if kind in self._tasks else 'another'} page has one running; wait until it has ended"
            )

        async def run() -> None:
            try:
                reason = await _run(words, heard, fed)
            except asyncio.CancelledError:
                self._send(message.get("id"), {"kind": "answer"} | outcome("it was cancelled"))
                raise
            self._send(message.get("id"), {"kind": "answer"} | outcome(reason) if reason else done())

        def ended(_: asyncio.Task[None]) -> None:
            self._running.discard(kind)
            del self._tasks[kind]

        self._running.add(kind)
        self._tasks[kind] = asyncio.create_task(run())
        self._tasks[kind].add_done_callback(ended)  # one that is cancelled at once does not even begin

    def _send(self, number: Any, fields: Mapping[str, Any]) -> None:
        self._put(msgspec.json.encode({"id": number} | dict(fields)))


async def _run(words: Sequence[str], heard: Callable[[str], None], fed: Fed | None) -> str:
    """Why a command of this program failed, empty if it did not; it is killed if nobody waits for it any more.

    `fed` is given what writes to its standard input, and None when it has ended.
    """
    process = await asyncio.create_subprocess_exec(
        sys.executable,
        "-m",
        "controller",
        *words,
        stdin=asyncio.subprocess.PIPE if fed else asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.PIPE,
        env=os.environ | ENVIRONMENT,
        limit=LINE_BYTES,
    )
    assert process.stdout is not None
    assert process.stderr is not None
    complaints = asyncio.create_task(_end_of(process.stderr))
    if fed:
        fed(process.stdin)
    try:
        while line := await process.stdout.readline():
            heard(line.decode(errors="replace").rstrip("\n"))
        said = await complaints
        return "" if await process.wait() == 0 else _last_line(said)
    finally:
        if fed:
            fed(None)
        complaints.cancel()
        if process.returncode is None:
            process.kill()
            await process.wait()


async def _end_of(stream: asyncio.StreamReader) -> str:
    """The end of what is written to a stream."""
    said = b""
    while more := await stream.read(SAID_BYTES):
        said = (said + more)[-SAID_BYTES:]
    return said.decode(errors="replace")


def _last_line(said: str) -> str:
    """Why a command failed, as it says without its name."""
    lines = [line.strip() for line in said.splitlines() if line.strip()] or ["it ended without a word"]
    return lines[-1].removeprefix("haptic-panel: ")
