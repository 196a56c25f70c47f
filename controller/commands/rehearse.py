"""`haptic-panel rehearse`: the way of a new panel, on a simulated one that is wrong as real ones are."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from controller.commands.common.arguments import Declare
from controller.commands.common.output import show
from controller.console import flush, say

if TYPE_CHECKING:
    from controller.workshop.simulation.rehearsal import Done


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        example="haptic-panel rehearse build/rehearsed",
        description="Go the whole way of a new panel (boards/README.md) with a simulated one that is wrong as real ones are: empty "
        "FPGA, swapped wires, a dead disc, stages, glass and measuring frame other than board.toml says, a dead interrupt line. "
        "Prints each command, what it found and how that was mended; its folder can be played with afterwards. Exit code 1 if "
        "something is not found.",
    )
    command.add_argument("folder", type=Path, help="board folder to make")
    command.add_argument("--wrong", type=Path, metavar="FILE", help="what is wrong (default: all of it)")
    command.add_argument(
        "--build", action="store_true", help="build bitstreams, not their headers alone: minutes, extra `gateware`"
    )
    command.add_argument("--json", action="store_true", help="print one JSON object and nothing else on stdout")
    command.set_defaults(command=rehearse)


def rehearse(options: argparse.Namespace) -> int:
    """Run each command, and print what came of it."""
    from controller.device.board.records import load_toml
    from controller.workshop.simulation.rehearsal import rehearse
    from controller.workshop.simulation.remedies import Bench
    from controller.workshop.simulation.wrong_panel import SHIPPED, WrongPanel

    began_s = time.monotonic()
    bench = Bench(options.folder, load_toml(options.wrong or SHIPPED, WrongPanel), options.build)
    steps = []
    for done in rehearse(bench):
        steps.append(done._asdict())
        if not options.json:
            say(_in_words(done))
            flush()
    figures = {"folder": str(options.folder), "found": sorted(bench.found), "seconds": round(time.monotonic() - began_s)}
    show(options, figures | {"steps": steps}, _table)
    return 0


def _in_words(done: Done) -> str:
    ended = f"  (exit code {done.code})" if done.code else ""
    return "\n".join([f"$ {done.command}{ended}", *(f"    {line}" for line in done.said), *(f"  -> {did}" for did in done.mended)])


def _table(figures: dict[str, Any]) -> str:
    return f"found and mended: {', '.join(figures['found'])}; {figures['seconds']} s. The panel stays in {figures['folder']}"
