"""`haptic-panel update rollback`: back to the release before, by hand."""

import argparse

from controller.commands.common.output import show
from controller.device.update.identity import refuse_root
from controller.device.update.installed import update_state
from controller.device.update.layout import Layout
from controller.device.update.requests import ask
from controller.errors import UpdateError


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
    show(
        options, {"from": leaves, "to": target}, lambda reported: f"back to {reported['to']}; {reported['from']} is not tried again"
    )
    return 0
