"""`haptic-panel update status`: which releases this device has, and how a trial stands."""

import argparse
from typing import Any

from controller.commands.common.output import show
from controller.device.update.installed import update_state
from controller.device.update.layout import Layout


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.set_defaults(command=status)


def status(options: argparse.Namespace) -> int:
    """Show the releases; 1 if something is damaged."""
    state = update_state(Layout.from_environment())
    show(options, state.figures(), _table)
    return 1 if state.problems else 0


def _table(figures: dict[str, Any]) -> str:
    in_use, trial = figures["in_use"], figures["trial"]
    if not in_use:
        lines = ["no release is in use"]
    elif trial == in_use:
        stays = figures["stays"] or "none"
        lines = [f"{trial} is on trial, start {figures['tries']} of 3; if it does not serve, {stays} is used again"]
    else:
        lines = [f"{in_use} is in use" + (f"; {trial} is tried at the next start" if trial else "")]
    if figures["requested"]:
        lines.append(f"asked for, and not done yet: {', '.join(figures['requested'])}")
    for release in figures["releases"]:
        counter = "?" if release["counter"] is None else release["counter"]
        marks = [
            "" if release["complete"] else "not complete",
            "failed" if release["failed"] else "",
            "before" if release["version"] == figures["previous"] else "",
        ]
        size = "" if release["size_bytes"] is None else f", {release['size_bytes']:,} bytes"
        lines.append(f"  {release['version']} (counter {counter}{size}){''.join(f', {mark}' for mark in marks if mark)}")
    gone = [version for version in figures["failed"] if version not in {release["version"] for release in figures["releases"]}]
    if figures["not_installed"]:
        lines.append(f"{figures['not_installed']}: haptic-panel update install tries it again")
    if gone:
        lines.append(f"not tried again: {', '.join(gone)}")
    return "\n".join([*lines, *(f"WRONG {problem}" for problem in figures["problems"])])
