"""`haptic-panel client`: a running panel from a shell, through its application socket."""

import argparse

from controller.commands.common.arguments import Declare
from controller.device.application_socket.client.command_line import declare_requests, send


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser = declare(
        example="haptic-panel client play click --at 100 70",
        description="Send one request to a running panel through its application socket, as this user, for whom the board's groups "
        "say what is permitted. What the panel says goes to stdout, one JSON object a line. Exit code 0 if it was done, 1 if it "
        "was refused or not played, 69 if no panel runs.",
    )
    declare_requests(parser)
    parser.set_defaults(command=send)
