"""`haptic-panel status`: state of the running panel, in words or as JSON."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from controller.commands.common.arguments import Declare
from controller.console import say
from controller.device.board.panel_state import PLAYS, PanelState
from controller.device.board.panel_status import FOLDER, NAME, PanelStatus, is_running, read_now
from controller.device.service.installation import is_installed
from controller.device.service.unfelt import unfelt
from controller.device.touch.reports import describe_warnings
from controller.errors import LinkError

if TYPE_CHECKING:
    from controller.device.update.installed import UpdateState

START = "systemctl start haptic-panel; journalctl -u haptic-panel shows how it ended"


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser = declare(
        example="haptic-panel status",
        description="Show the state of the running panel, its release and its counters, from the file that the service replaces "
        "every second. Exit code 0 if it serves, 1 if it does not, 69 if no service runs.",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object and nothing else on stdout")
    parser.add_argument("--file", default=FOLDER / NAME, type=Path, metavar="FILE", help=f"default: {FOLDER / NAME}")
    parser.set_defaults(command=run)


def run(options: argparse.Namespace) -> int:
    """Show the state of the panel; 1 if it does not serve; raises LinkError if no service runs."""
    status, old = read_now(options.file)
    updates = _updates()
    if status is None:
        raise LinkError(f"no service runs: there is no {options.file}: {START}")
    gone = old and (status.ended or not is_running(status.pid))
    if not options.json:
        say(_in_words(status, old, updates))
    else:
        said: dict[str, Any] = msgspec.to_builtins(status)
        more = {"serves": status.serves and not old, "old": old, "uptime_s": status.uptime_s}
        say(json.dumps(said | more | ({"updates": updates.figures()} if updates else {})))
    if gone:
        raise LinkError(f"no service runs: {options.file} is its last word: {old}: {START}")
    return 0 if status.serves and not old else 1


def _updates() -> UpdateState | None:
    """Releases of this device; None without the room that has them."""
    if not is_installed("device.update"):
        return None
    from controller.device.update.installed import update_state
    from controller.device.update.layout import Layout

    return update_state(Layout.from_environment())


def _in_words(status: PanelStatus, old: str, updates: UpdateState | None) -> str:
    """The status as text, one matter a line."""
    causes = ", ".join(f"{name} {count}" for name, count in sorted(status.outage_causes.items()))
    plate = "unknown" if status.temperature_c is None else f"{status.temperature_c:.1f} °C"
    lines = [
        f"{status.state.value}: {status.cause}" if status.cause else status.state.value,
        f"board {status.board!r}, release {status.release}, process {status.pid}, for {_duration(status.uptime_s)}",
        f"outputs {_outputs(status)}; touch panel {'connected' if status.panel_present else 'absent'}; "
        f"temperature of the plate {plate}",
        f"emissions {status.emissions:,}, of them {status.late:,} late; not played {status.skipped:,}; waiting {status.waiting}",
        f"heartbeats {status.heartbeats:,}; stalls of this host {status.host_silent:,}"
        f"{f', armed again after a pause {status.stall_pauses:,}' if status.stall_pauses else ''}; "
        f"outages {status.outages:,}{f' ({causes})' if causes else ''}; log lines lost {status.log_lines_lost:,}",
    ]
    if status.touch_points:
        lines.append(f"positions of the touch panel {status.touch_points:,}, not a finger's {status.touch_points_refused:,}")
    if status.serves:
        lines += unfelt(status.touch_points, status.touch_points_refused, status.foci, status.left_out)
    for name, latency in (("an upload", status.upload), ("a resident play", status.resident)):
        if latency.count:
            p50_ms, p99_ms, worst_ms = (1e-3 * us for us in (latency.p50_us, latency.p99_us, latency.worst_us))
            lines.append(f"the host's work for {name}: median {p50_ms:.3f} ms, 99 % {p99_ms:.3f} ms, worst {worst_ms:.3f} ms")
    if status.touch_remark:
        lines.append(status.touch_remark)
    lines += [f"touch panel: {said}" for said in describe_warnings(status.touch_warnings)]
    if updates and updates.in_use:
        lines.append(f"release in use: {updates.in_use}{_trial(updates)}; `haptic-panel update status` has more")
    if old:
        lines.insert(0, f"NOT NOW: {old}")
    return "\n".join(lines)


def _outputs(status: PanelStatus) -> str:
    if not status.outputs_on:
        return "off"
    if status.state is PanelState.RAMPING:
        return "ramping"
    return "on" if status.state in PLAYS else "not known to be off yet"


def _trial(updates: UpdateState) -> str:
    """What there is to say of a trial, and of releases that were one."""
    on_trial = f", on trial, start {updates.tries}" if updates.trial == updates.in_use else ""
    failed = f", not tried again: {', '.join(updates.failed)}" if updates.failed else ""
    return on_trial + failed


def _duration(seconds: float) -> str:
    minutes, hours, days = int(seconds // 60), int(seconds // 3600), int(seconds // 86_400)
    if days:
        return f"{days} d {hours % 24} h"
    return f"{hours} h {minutes % 60} min" if hours else f"{minutes} min {int(seconds) % 60} s"
