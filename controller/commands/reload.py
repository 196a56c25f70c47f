"""`haptic-panel reload`: the command of ExecReload= in the service's unit."""

import argparse
import os

from controller.commands.common.arguments import Declare
from controller.device.service.reloading import reload
from controller.errors import ConfigError


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser = declare(
        example="haptic-panel reload --pid 1234",
        description="Send SIGHUP to the service and wait until the scene is in force, or refused (exit code 78).",
    )
    parser.add_argument("--pid", type=int, metavar="N", help="its main process (default: $MAINPID)")
    parser.set_defaults(command=run)


def run(options: argparse.Namespace) -> int:
    """Reload the scene of the service; raises if it is refused."""
    named = os.environ.get("MAINPID", "")
    if options.pid is None and not named.isdecimal():
        raise ConfigError("$MAINPID is not set: give --pid, or use systemctl reload haptic-panel")
    reload(options.pid or int(named))
    return 0
