"""The command line: arguments, exit codes, errors as one line. Each command is a module of `commands` and one call into a room.

Only the module of the command that is called is imported: `--version`, `--help` and completion need none, and no NumPy. Physics,
simulation and benchmarks are imported only by the commands that need them: a device may lack their packages.
"""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Callable, Collection, Sequence
from functools import partial
from importlib import import_module

from controller import __version__
from controller.commands.common.arguments import Parser
from controller.console import program
from controller.errors import ConfigError

COMMANDS = {  # in the order of --help, which prints these texts; each is a module of `commands`
    "run": "run a panel; without devices, replay a touch recording on the simulated panel",
    "serve": "simulate a panel with an application socket, to develop a user interface against",
    "status": "show the state of the running panel and of its updates",
    "client": "ask a running panel to play, switch it off or on, load a scene, or show its state",
    "doctor": "check every device, file and permission of a panel, and name the remedies",
    "setup": "make the board folder of a new panel, from a few questions or options",
    "rehearse": "go the whole way of a new panel with a simulated one that is wrong as real ones are",
    "board": "check a board and its scene; describe the keys of both files",
    "gateware": "build, describe and load bitstreams; bring up an FPGA",
    "bank": "build, describe and verify banks of precomputed waveforms",
    "effect": "make effects of files from haptic designers, and such files of effects",
    "design": "estimate a panel's performance from its parameters",
    "tolerance": "draw plates from production tolerances: what yield will there be, and what does it depend on",
    "focus": "focus on given points of the plate model, and measure the result",
    "benchmark": "compare methods of finding drive words: time, memory, bytes and energy against error",
    "record": "store the events of a touch panel",
    "calibrate": "build a bank from measurements of the plate: plan, measure, check, build",
    "calibrate-touch": "map the touch panel's axes to the plate",
    "update": "check for, fetch, install and roll back signed releases; make and sign them",
    "page": "serve web pages that are felt, and a page that shows the panel",
    "trace": "say why pulses were late, from a trace that the service has written",
    "metrics": "export the figures of a running panel to Prometheus",
    "reload": "have the service read its scene again, and report the result (for ExecReload=)",
    "completion": "print the shell completion of this command line",
}


@program
def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; its exit code (0, or 2 usage, 78 configuration, 69 device missing, 1 otherwise)."""
    arguments = sys.argv[1:] if arguments is None else arguments
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # outside the event loop it ends a command as Ctrl-C does
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:  # as a shell starts what runs behind it
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        options = parser(arguments).parse_args(arguments)
        command: Callable[[argparse.Namespace], int] = options.command
        return command(options)
    except ModuleNotFoundError as error:
        from controller.device.service.installation import missing_package

        missing = missing_package(error.name)
        if missing is None:
            raise
        raise ConfigError(missing) from error


def parser(named: Collection[str] = tuple(COMMANDS)) -> argparse.ArgumentParser:
    """The parser of the command line.

    Modules of the commands in `named` are imported to declare their arguments; of the others only name and help text are known.
    Words that are no commands are ignored.
    """
    main_parser = Parser(
        prog="haptic-panel",
        example="haptic-panel run --speed max",
        description="Controller of a glass panel that pushes back under each finger.",
        epilog="exit codes: 0 done, 2 usage, 69 device missing, 78 configuration or bank, 1 otherwise",
    )
    main_parser.add_argument("--version", action="version", version=f"haptic-panel {__version__}")
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--board", default="simulated", metavar="B", help="name, or folder with a board.toml (default: simulated)")
    common.add_argument("--json", action="store_true", help="print one JSON object and nothing else on stdout")
    commands = main_parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, text in COMMANDS.items():
        declare = partial(commands.add_parser, name, help=text)
        if name in named:
            import_module(f"controller.commands.{name.replace('-', '_')}").add(declare, common)
        else:
            declare()
    return main_parser
