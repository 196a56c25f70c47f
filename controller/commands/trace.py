"""`haptic-panel trace`: what a trace of the loop says."""

import argparse
from pathlib import Path
from typing import Any

from controller.commands.common.arguments import Declare


def add(declare: Declare, common: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        example="haptic-panel trace /run/haptic-panel/trace-1.json",
        parents=[common],
        description="Say in plain words why pulses were late, from a trace that the service has written: after a fault, after a "
        "pulse that was more than 2 ms late or a turn that began as late, or when asked to (systemctl kill --kill-whom=main "
        "--signal=USR1 haptic-panel). Perfetto (ui.perfetto.dev) and chrome://tracing show the same file as a picture.",
    )
    command.add_argument("file", metavar="FILE", help="the trace, .json")
    command.set_defaults(command=run)


def run(options: argparse.Namespace) -> int:
    """Explain a trace."""
    from controller.commands.common.output import show
    from controller.device.service.tracing.trace_report import figures_of, read_trace

    show(options, figures_of(read_trace(Path(options.file))), _table)
    return 0


def _table(figures: dict[str, Any]) -> str:
    lines = [
        f"written because: {figures['reason']} (board {figures['board']!r}, release {figures['release']})",
        f"{figures['seconds']:g} s: {figures['turns']:,} turns of the loop, the longest {figures['longest_turn_ms']:g} ms; "
        f"{figures['starts']:,} emissions, {figures['pulses']:,} of them pulses that have to be on time",
    ]
    if not figures["pulses_late"]:
        latest = f"; the latest: {max(figures['latest_ms'], 0.0):g} ms" if figures["pulses"] else ""
        lines.append(f"no pulse was more than 2 ms late{latest}")
    else:
        lines.append(f"{figures['pulses_late']:,} pulses were more than 2 ms late; the latest:")
    for pulse in figures["explained"]:
        parts = ", ".join(f"{cause} for {part_ms:g} ms" for cause, part_ms in pulse["parts_ms"].items())
        lines.append(f"  due at {pulse['due_ms']:,.3f} ms, {pulse['late_ms']:g} ms late: {parts or 'no part of it is known'}")
    return "\n".join(lines)
