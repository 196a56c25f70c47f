"""What the bridge to browsers costs: its processor time and memory, the time of a message, and what the panel's loop notices of it.

    .venv/bin/haptic-panel serve --background /tmp/panel.sock
    .venv/bin/haptic-panel page --socket /tmp/panel.sock --port 8750 &
    .venv/bin/python -m tests.figures.page_load http://127.0.0.1:8750 $! --socket /tmp/panel.sock

Pages are clients of the library `websockets` in a process of their own, which subscribe to touches and emissions and ask for the
panel's state. What the loop notices: a client of the socket plays; how long it waits for each outcome is measured in turns with
seven pages and without any, each for some seconds.
"""

from __future__ import annotations

import argparse
import asyncio
import multiprocessing
import os
import time
from collections.abc import Sequence
from pathlib import Path

from websockets.asyncio.client import connect

from controller.console import program, say
from controller.device.application_socket.client import PanelClient
from controller.errors import ControllerError

MOST_PAGES, ASKED_HZ = 8, 5.0  # with 60 reports of two fingers and 30 messages of emissions a second to each
TURNS = 4  # with and without
COMMAND_S = 0.02
TICKS_HZ = os.sysconf("SC_CLK_TCK")


def processor_s(pid: int) -> float:
    """Seconds of processor time that a process has used."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_HZ


def memory_mb(pid: int) -> float:
    """Resident memory of a process."""
    (line,) = [line for line in Path(f"/proc/{pid}/status").read_text().splitlines() if line.startswith("VmRSS")]
    return int(line.split()[1]) / 1024


async def page(address: str, rate_hz: float, seconds: float, times_s: list[float]) -> int:
    """One page: asks so often, waits for each answer; how many touches it got meanwhile."""
    clock = asyncio.get_running_loop().time
    touches = 0
    async with connect(f"{address.replace('http', 'ws', 1)}/panel", origin=address, compression=None) as socket:  # type: ignore[arg-type]
        await socket.send('{"kind":"subscribe","to":["touches","emissions"]}')
        end_s = clock() + seconds
        due_s = clock()
        while due_s < end_s:
            await asyncio.sleep(due_s - clock())
            sent_s = clock()
            await socket.send('{"kind":"state","id":1}')
            while '"id":1' not in (text := await socket.recv()):
                touches += '"touch"' in text or '"emissions"' in text
            times_s.append(clock() - sent_s)
            due_s += 1 / rate_hz
    return touches


async def measured(address: str, pid: int, pages: int, rate_hz: float, seconds: float) -> str:
    """One row: what this number of pages at this rate costs."""
    before_s, times_s = processor_s(pid), list[float]()
    touches = await asyncio.gather(*(page(address, rate_hz, seconds, times_s) for _ in range(pages)))
    used = (processor_s(pid) - before_s) / seconds
    times_s.sort()
    p50, p99 = (1e3 * times_s[min(len(times_s) - 1, int(len(times_s) * share))] for share in (0.5, 0.99))
    sent = (len(times_s) + sum(touches)) / seconds
    return f"{pages} pages, {sent:.0f} messages/s: {100 * used:.1f} % of a core, {memory_mb(pid):.0f} MB; {p50:.1f} / {p99:.1f} ms"


def noticed(socket: str, address: str, seconds: float) -> str:
    """Median and p99 of a command's way, with seven pages and without, in turns."""
    ways_s: dict[bool, list[float]] = {True: [], False: []}
    with PanelClient(socket) as panel:
        (length_mm, width_mm), clock = (panel.hello().length_mm, panel.hello().width_mm), time.monotonic
        for turn in range(2 * TURNS):
            loaded = turn % 2 == 1
            pages = _in_background(address, seconds) if loaded else None
            end_s = clock() + seconds
            while (begun_s := clock()) < end_s:
                panel.play("click", at_mm=(length_mm / 2, width_mm / 2), amplitude=0.5)
                ways_s[loaded].append(clock() - begun_s)
                time.sleep(max(0.0, COMMAND_S - (clock() - begun_s)))
            if pages is not None:
                pages.join()
                time.sleep(1.0)
                if pages.exitcode:
                    raise ControllerError("the pages did not last to the end")
    figures = {}
    for loaded, ways in ways_s.items():
        ways.sort()
        figures[loaded] = [1e3 * ways[int(len(ways) * share)] for share in (0.5, 0.99)]
    (with_p50, with_p99), (p50, p99) = figures[True], figures[False]
    return (
        f"a command's way with {MOST_PAGES - 1} pages {with_p50:.2f} / {with_p99:.2f} ms, without {p50:.2f} / {p99:.2f} ms"
        f" (p50 / p99): {with_p50 / p50:.2f} and {with_p99 / p99:.2f} times"
    )


def _in_background(address: str, seconds: float) -> multiprocessing.process.BaseProcess:
    """Seven pages in a process of their own."""
    process = multiprocessing.get_context("spawn").Process(target=_pages, args=(address, seconds))
    process.start()
    return process


def _pages(address: str, seconds: float) -> None:
    asyncio.run(_all(address, seconds))


async def _all(address: str, seconds: float) -> None:
    times_s: list[float] = []
    await asyncio.gather(*(page(address, ASKED_HZ, seconds, times_s) for _ in range(MOST_PAGES - 1)))


@program
def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, and print a row for each number of pages."""
    parser = argparse.ArgumentParser(prog="python -m tests.figures.page_load", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("address", metavar="ADDRESS", help="the bridge's, without a path")
    parser.add_argument("pid", type=int, metavar="PID", help="the bridge's process")
    parser.add_argument("--seconds", type=float, default=20.0, metavar="S", help="of each row (default: 20)")
    parser.add_argument("--socket", metavar="S", help="the panel's: also measure what its loop notices")
    options = parser.parse_args(arguments)
    before_s = processor_s(options.pid)
    asyncio.run(asyncio.sleep(options.seconds))
    idle = (processor_s(options.pid) - before_s) / options.seconds
    say(f"idle: {100 * idle:.2f} % of a core, {memory_mb(options.pid):.0f} MB")
    for pages, rate_hz in ((1, 10.0), (4, 50.0), (MOST_PAGES, ASKED_HZ)):
        say(asyncio.run(measured(options.address.rstrip("/"), options.pid, pages, rate_hz, options.seconds)))
        time.sleep(1.0)  # the places of these pages are free again
    if options.socket:
        say(noticed(options.socket, options.address.rstrip("/"), options.seconds))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
