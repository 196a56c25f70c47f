"""`haptic-panel update rollback`: back to the release before, by hand."""

from __future__ import annotations

import argparse

from controller.commands.output import show
from controller.errors import UpdateError
from controller.update.identity import refuse_root
from controller.update.installed import update_state
from controller.update.layout import Layout
from controller.update.requests import ask


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.set_defaults(command=rollback)


def rollback(options: argparse.Namespace) -> int:
    """Ask for it; raises if there is nothing to go back to."""
    layout = Layout.from_environment()
    refuse_root(layout)
    state = update_state(layout)
    target = state.stays if state.trial else state.previous
    if not layout.is_complete(target):
        raise UpdateError(f"{layout.releases}: there is no release before {state.in_use or 'this one'} to go back to")
    leaves = state.trial or state.stays
    ask(layout, "rollback", leaves)
    show(options, {"from": leaves, "to": target}, lambda told: f"back to {told['to']}; {told['from']} is not tried again")
    return 0
