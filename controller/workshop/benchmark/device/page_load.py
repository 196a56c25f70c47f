"""What the bridge to browsers costs: its processor time and memory, and the time of a message through it and beside it.

    .venv/bin/haptic-panel page --demo --port 8750 &
    .venv/bin/python -m controller.workshop.benchmark.device.page_load http://127.0.0.1:8750 PID_OF_THE_BRIDGE

Pages are clients of the library `websockets` in one process of their own, which subscribe to touches and ask for the panel's state.
"""

from __future__ import annotations

import argparse
import asyncio
import os
from collections.abc import Sequence
from pathlib import Path

from websockets.asyncio.client import connect

from controller.console import program, say

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
        await socket.send('{"kind":"subscribe"}')
        end_s = clock() + seconds
        due_s = clock()
        while due_s < end_s:
            await asyncio.sleep(due_s - clock())
            sent_s = clock()
            await socket.send('{"kind":"state","id":1}')
            while '"id":1' not in (text := await socket.recv()):
                touches += '"touch"' in text
            times_s.append(clock() - sent_s)
            due_s += 1 / rate_hz
    return touches


async def measured(address: str, pid: int, pages: int, rate_hz: float, seconds: float) -> str:
    """One row: what so many pages at this rate cost."""
    before_s, times_s = processor_s(pid), list[float]()
    touches = await asyncio.gather(*(page(address, rate_hz, seconds, times_s) for _ in range(pages)))
    used = (processor_s(pid) - before_s) / seconds
    times_s.sort()
    p50, p99 = (1e3 * times_s[min(len(times_s) - 1, int(len(times_s) * share))] for share in (0.5, 0.99))
    sent = (len(times_s) + sum(touches)) / seconds
    return f"{pages} pages, {sent:.0f} messages/s: {100 * used:.1f} % of a core, {memory_mb(pid):.0f} MB; {p50:.1f} / {p99:.1f} ms"


@program
def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, and print a row for each number of pages."""
    parser = argparse.ArgumentParser(
        prog="python -m controller.workshop.benchmark.device.page_load", description=(__doc__ or "").partition("\n")[0]
    )
    parser.add_argument("address", metavar="ADDRESS", help="the bridge's, without a path")
    parser.add_argument("pid", type=int, metavar="PID", help="the bridge's process")
    parser.add_argument("--seconds", type=float, default=20.0, metavar="S", help="of each row (default: 20)")
    options = parser.parse_args(arguments)
    before_s = processor_s(options.pid)
    asyncio.run(asyncio.sleep(options.seconds))
    idle = (processor_s(options.pid) - before_s) / options.seconds
    say(f"idle: {100 * idle:.2f} % of a core, {memory_mb(options.pid):.0f} MB")
    for pages, rate_hz in ((1, 10.0), (4, 50.0)):
        say(asyncio.run(measured(options.address.rstrip("/"), options.pid, pages, rate_hz, options.seconds)))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
