"""The command line: arguments, exit codes, errors as one line. Each command is a module of `commands` and one call into a room.

Physics, simulation and benchmarks are imported only by the commands that need them: a device may lack their packages.
"""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Callable, Sequence

from controller import __version__
from controller.commands import bank, board, calibrate_touch, completion, doctor, focus, gateware, record, reload, run
from controller.errors import ConfigError, ControllerError
from controller.log import Priority, line
from controller.service.installation import missing_package

COMMANDS = (run, doctor, board, gateware, bank, focus, record, calibrate_touch, reload, completion)  # in the order of --help


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; its exit code (0, or 2 usage, 78 configuration, 69 device missing, 1 otherwise)."""
    options = parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # outside the event loop it ends a command as Ctrl-C does
    command: Callable[[argparse.Namespace], int] = options.command
    try:
        return command(options)
    except ControllerError as error:
        print(line(str(error), Priority.ERROR), file=sys.stderr)
        return error.exit_code
    except ModuleNotFoundError as error:
        missing = missing_package(error.name)
        if missing is None:
            raise
        print(line(missing, Priority.ERROR), file=sys.stderr)
        return ConfigError.exit_code
    except BrokenPipeError:
        sys.stderr.close()
        return 1
    except OSError as error:
        print(line(str(error), Priority.ERROR), file=sys.stderr)
        return 1
    except MemoryError:
        print(line("not enough memory for what was asked", Priority.ERROR), file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(line("interrupted", Priority.ERROR), file=sys.stderr)
        return 130


def parser() -> argparse.ArgumentParser:
    """The parser of the whole command line."""
    main_parser = argparse.ArgumentParser(
        prog="haptic-panel",
        description="Controller of a glass panel that pushes back under each finger.",
        epilog="exit codes: 0 done, 2 usage, 69 device missing, 78 configuration or bank, 1 otherwise",
    )
    main_parser.add_argument("--version", action="version", version=f"haptic-panel {__version__}")
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--board", default="simulated", metavar="B", help="name, or folder with a board.toml (default: simulated)")
    common.add_argument("--json", action="store_true", help="print one JSON object and nothing else on stdout")
    commands = main_parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in COMMANDS:
        command.add(commands, common)
    return main_parser
